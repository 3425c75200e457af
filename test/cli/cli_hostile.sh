#!/bin/sh
# Small files that want to become large: each ends as test/hostile/make.py says, with one line where it is refused, and in
# a bounded address space. Pictures are small.
# Usage: cli_hostile.sh PROGRAM FOLDER
here=$(cd "$(dirname "$0")" && pwd)
. "$here/lib.sh"

# What is refused takes this much at most, what is drawn as much as its textures and triangles. A sanitizer's program
# has no bounded address space.
refused=--max-memory=500M drawn=--max-memory=1500M
draws $refused || refused='' drawn=''

# FILE CODE FLAGS...: textures are drawn small; what covers too much is refused at the default size only.
ends_as() {
    file=$1 wanted=$2
    shift 2
    memory=$drawn
    [ "$wanted" = 0 ] || memory=$refused
    run render "$file" --threads=1 $memory -o h.png "$@"
    check "$file: exit code $code, not $wanted: $(cat "$err")" [ "$code" = "$wanted" ]
    if [ "$wanted" = 0 ]; then
        check "$file: no picture" [ -s h.png ]
    else
        check "$file: not one line: $(cat "$err")" [ "$(grep -vc '^burnish: warning: ' "$err")" = 1 ]
        check "$file: $(cat "$err")" grep -q "^burnish: .*; " "$err"
        check "$file: a picture" [ ! -e h.png ]
    fi
    rm -f h.png
}

mkdir files
python3 "$here/../hostile/make.py" files >../list
while read -r file code flags; do
    check "$file: more than 1 MB" [ "$(($(wc -c <"$file")))" -le 1000000 ]
    [ "$code" = 0 ] && ends_as "$file" 0 $flags --size=64 || ends_as "$file" "$code" $flags
done <../list
rm -rf files ../list
nothing_left "hostile"
finish
