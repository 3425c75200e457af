#!/bin/sh
# Runs the guides: every block of docs/guides/*.md that is marked sh, as its reader would, one folder per guide.
# Usage: guides.sh PROGRAM COMPILER SOURCE_DIR BUILD_DIR SCRATCH
#
# What stands right above a block, as a comment of HTML that no reader sees:
#   needs: TOOL...   run only where these commands are there; python3:NAME: that Python imports it; npm: build/npm was made
#   exits: CODE      the block ends with this exit code instead of 0
#   file: NAME       the block is written to a file of that name instead
# A block marked text right below shows what the commands print, on both outputs: its lines must come in this order,
# "..." stands for any others. part.stl, before.stl, after.stl and the folder parts are the reader's own files, made here.
set -eu
program=$(realpath "$1")
compiler=$2
source=$(realpath "$3")
build=$(realpath "$4")
scratch=$5
rm -rf "$scratch"
mkdir -p "$scratch/bin"
scratch=$(realpath "$scratch")
ln -s "$program" "$scratch/bin/burnish"
ln -s "$(command -v "$compiler")" "$scratch/bin/cc"
PATH=$scratch/bin:$PATH
BURNISH=$source # the guides' name for the folder of the sources
# packages, where they were made: by the test python, make python, make npm
for venv in "$build/test/scratch/python/venv" "$source/build/python/venv"; do
    [ ! -x "$venv/bin/python3" ] || PATH=$venv/bin:$PATH
done
package=$source/build/npm
export PATH BURNISH

# box X Y Z: a closed box from the origin, as STL.
box() {
    awk -v x="$1" -v y="$2" -v z="$3" '
        function corner(n) { return sprintf("vertex %g %g %g", n % 2 * x, int(n / 2) % 2 * y, int(n / 4) * z) }
        BEGIN {
            print "solid box"
            split("0 2 3 0 3 1 4 5 7 4 7 6 0 1 5 0 5 4 2 6 7 2 7 3 0 4 6 0 6 2 1 3 7 1 7 5", c)
            for (i = 1; i <= 36; i += 3)
                print "facet normal 0 0 0\nouter loop\n" corner(c[i]) "\n" corner(c[i + 1]) "\n" corner(c[i + 2]) "\nendloop\nendfacet"
            print "endsolid box"
        }'
}

# have TOOL...: whether all are there.
have() {
    for tool in "$@"; do
        case $tool in
        python3:*) python3 -c "import ${tool#*:}" 2>/dev/null || return 1 ;;
        npm) [ -f "$package/wasm.js" ] && command -v node >/dev/null || return 1 ;;
        *) command -v "$tool" >/dev/null || return 1 ;;
        esac
    done
}

# In the folder's .blocks: N.KIND, the text of block N, KIND the word behind the fence, and N.needs, N.exits, N.file.
split_blocks() {
    awk '
        /^<!-- (needs|exits|file): .* -->$/ { word = $2; sub(":", "", word); mark[word] = $0; sub(/^<!-- [a-z]*: /, "", mark[word]); sub(/ -->$/, "", mark[word]); next }
        /^```/ && !inside {
            inside = 1; kind = substr($0, 4); if (kind == "") kind = "plain"
            n++; name = sprintf(".blocks/%03d", n); out = name "." kind
            printf "" >out
            print NR >(name ".line"); close(name ".line")
            for (word in mark) { print mark[word] >(name "." word); close(name "." word) }
            delete mark; next
        }
        /^```/ { inside = 0; close(out); next }
        inside { print >out; next }
        NF { if (!follows) delete mark }
    ' "$1"
}

# shows WANTED GOT: whether the lines of one file come in the other, "..." standing for any.
shows() {
    awk '
        NR == FNR { wanted[++count] = $0; next }
        { got[++lines] = $0 }
        END {
            at = 1; skip = 0
            for (i = 1; i <= count; i++) {
                if (wanted[i] ~ /^ *\.\.\.$/) { skip = 1; continue }
                while (skip && at <= lines && got[at] != wanted[i]) at++
                if (at > lines || got[at] != wanted[i]) { print "shows \"" wanted[i] "\", prints \"" got[at] "\""; exit 1 }
                at++; skip = 0
            }
            if (!skip && at <= lines) { print "does not show \"" got[at] "\""; exit 1 }
        }' "$1" "$2"
}

failures=0
blocks=0
skipped=0
fail() {
    failures=$((failures + 1))
    echo "docs/guides/$guide.md:$(cat ".blocks/$n.line"): $*"
}

for page in "$source"/docs/guides/*.md; do
    guide=$(basename "$page" .md)
    mkdir -p "$scratch/$guide/.blocks" "$scratch/$guide/parts/left"
    cd "$scratch/$guide"
    box 40 20 10 >part.stl
    box 40 20 10 >before.stl
    box 40 20 12 >after.stl
    box 30 10 10 >parts/base.stl
    box 10 10 40 >parts/left/arm.stl
    [ ! -d "$package" ] || { mkdir node_modules && ln -s "$package" node_modules/burnish; }
    split_blocks "$page"
    ran=0
    for line in .blocks/*.line; do
        n=$(basename "$line" .line)
        if [ -f ".blocks/$n.file" ]; then
            for text in ".blocks/$n".*; do
                case $text in *.line | *.file) ;; *) cp "$text" "$(cat ".blocks/$n.file")" ;; esac
            done
            continue
        fi
        [ -f ".blocks/$n.sh" ] || continue
        if [ -f ".blocks/$n.needs" ]; then
            # shellcheck disable=SC2046
            have $(cat ".blocks/$n.needs") || {
                echo "docs/guides/$guide.md:$(cat ".blocks/$n.line"): skipped: it needs $(cat ".blocks/$n.needs")"
                skipped=$((skipped + 1))
                continue
            }
        fi
        wanted=0
        [ ! -f ".blocks/$n.exits" ] || wanted=$(cat ".blocks/$n.exits")
        code=0
        sh -eu ".blocks/$n.sh" >".blocks/$n.out" 2>&1 </dev/null || code=$?
        blocks=$((blocks + 1))
        ran=$((ran + 1))
        [ "$code" = "$wanted" ] || fail "exit code $code, not $wanted: $(tail -n 2 ".blocks/$n.out")"
        next=.blocks/$(printf %03d $((${n#"${n%%[!0]*}"} + 1))).text
        [ ! -f "$next" ] || shows "$next" ".blocks/$n.out" >".blocks/difference" || fail "$(cat .blocks/difference)"
    done
    [ "$ran" -ge 2 ] || { failures=$((failures + 1)) && echo "docs/guides/$guide.md: only $ran blocks of commands were run"; }
done
echo "guides: $blocks blocks of commands, $failures failed, $skipped skipped"
[ "$failures" -eq 0 ]
