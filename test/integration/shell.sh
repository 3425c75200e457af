#!/bin/sh
# Shell scripts under `set -e`: "! command" alone on a line never fails there, whatever the command
# does (POSIX, set -e), so that a test written like that can't fail.
# usage: shell.sh SOURCE_FOLDER SCRATCH
set -eu
source=$1
mkdir -p "$2"
cd "$2"

# idle FILES...: the lines of scripts with set -e that begin with "!" and are no part of a list
idle() {
    awk 'FNR == 1 { exits = 0; shell = /^#!.*sh$/ }
        shell && /^set -[a-z]*e/ { exits = 1 }
        exits && /^[ \t]*! / && !/\|\||&&/ { print FILENAME ":" FNR ": " $0; found = 1 }
        END { exit !found }' "$@"
}

printf '#!/bin/sh\nset -eu\n! true\n' >wrong
printf '#!/bin/sh\nset -eu\n! true || { echo passes >&2; exit 1; }\n' >right
idle wrong >/dev/null || { echo "shell: the search finds nothing" >&2; exit 1; }
if idle right; then exit 1; fi

find "$source/.ci" "$source/hardware" "$source/bench" "$source/packaging" "$source/scripts" \
    "$source/test" -type f ! -name '*.[chv]' -size -64k >files 2>/dev/null || true
[ "$(wc -l <files)" -gt 20 ]
xargs awk 'FNR == 1 && /^#!.*sh$/ { print FILENAME }' <files >shells
xargs grep -l '^set -[a-z]*e' <shells >scripts
[ "$(wc -l <scripts)" -gt 10 ]
# shellcheck disable=SC2046
if idle $(cat scripts); then
    echo "shell: these lines can't fail; write \"! command || { ...; exit 1; }\"" >&2
    exit 1
fi
echo "shell: $(wc -l <scripts) scripts looked through"

# A make target fails before it builds anything if its folder is missing.
for call in "bench-peers MESHES" "bench-peers PARTS" "bench-load FILES"; do
    name=${call#* }
    # shellcheck disable=SC2086
    if timeout 60 make -s -C "$source" $call="$PWD/none" >made 2>&1; then
        echo "shell: make $call=FOLDER takes a folder that is missing" >&2
        exit 1
    fi
    grep -qF "$name=$PWD/none: no such folder" made || { cat made >&2; exit 1; }
done
