#!/bin/sh
# Limits of time and memory: small files that would take long, endless streams.
# Usage: cli_limits.sh PROGRAM FOLDER
here=$(cd "$(dirname "$0")" && pwd)
. "$here/lib.sh"

# Streams: rejected within their first 64 KiB, unless they may be a mesh.
refusal='burnish: standard input: its first 65536 bytes match no supported format; give a mesh'
stream() { # COMMAND FLAGS...: what the command writes
    command=$1
    shift
    eval "$command" 2>/dev/null | "$burnish" render - -o s.png "$@" >"$out" 2>"$err"
    code=$?
    checks=$((checks + 1))
    [ "$code" = 4 ] && [ "$(cat "$err")" = "$refusal" ] && [ ! -e s.png ] || fail "$command: $code, $(cat "$err")"
}
stream yes
stream 'cat /dev/zero'
stream 'cat /dev/urandom'
for first in v '{' '#' '\376\377' '\037\213'; do # what a mesh may begin with, and no mesh behind it
    stream "printf '$first ' && cat /dev/zero"
done
refusal='burnish: standard input: its first 65536 bytes match no supported format, or not the named one; give a mesh'
stream yes --input-format=obj
stream yes --input-format=ply
stream 'cat /dev/zero' --input-format=stl

# Of other files, too, only the beginning is read if they are of another kind.
expect 4 'burnish: /dev/zero: neither Radiance HDR nor EXR; convert it to one of them' render :sphere --environment=/dev/zero -o s.png
expect 4 'burnish: /dev/zero: not a PNG file; convert the picture to PNG' render :sphere --reference=/dev/zero -o s.png
expect 3 "burnish: --files-from: .: can't be read: Is a directory" render --files-from=. -d s
expect 5 'burnish: --files-from: /dev/zero: larger than 256 MiB' render --files-from=/dev/zero -d s

# A long mesh comes through a pipe as from a file; the limit holds there too.
awk 'BEGIN { print "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3"; for (i = 0; i < 400000; ++i) print "v 1 1 1" }' >long.obj
cat long.obj | "$burnish" info - >"$out" 2>/dev/null && "$burnish" info long.obj >file.txt 2>/dev/null
check "a mesh of more than a part" [ "$(sed 1d "$out")" = "$(sed 1d file.txt)" ]
{ printf '\377\376' && iconv -f UTF-8 -t UTF-16LE long.obj; } | "$burnish" info - >"$out" 2>/dev/null
check "a mesh in UTF-16" [ "$(sed 1d "$out")" = "$(sed 1d file.txt)" ]
cat long.obj | "$burnish" info - --max-input-bytes=1M 2>"$err"
check "a stream beyond the limit: $?" grep -q 'standard input: larger than the limit of 1048576 bytes' "$err"
{ awk 'BEGIN { for (i = 0; i < 20000; ++i) print "# a comment" }' && cat long.obj; } | "$burnish" info - >"$out" 2>&1
check "a stream that begins with comments" grep -q '1 triangle' "$out"
rm -f long.obj file.txt

too_much() { # FILE WHERE FLAGS...
    file=$1 where=$2
    shift 2
    gives 5 render "$file" --up=format --threads=1 -o h.png "$@"
    check "$file $*: $(cat "$err")" grep -qx "burnish: the triangles cover $where [0-9]* times, which takes long; the limit is [0-9]*: raise --max-overdraw, or leave out what is hidden" "$err"
    check "$file $*: no picture" [ ! -e h.png ]
}
# layers COUNT: triangles behind one another, of each of which a picture from above shows half.
layers() { awk -v n="$1" 'BEGIN { for (i = 0; i < n; ++i) { y = i / n; print "v 0", y, "0\nv 1", y, "0\nv 0", y, "1\nf -3 -2 -1" } }'; }
for count in 500 4000 20000; do
    layers $count >sheets-$count.obj
done
awk 'BEGIN { print "v 0 0 0\nv 1 0 0\nv 0 1 0"; for (i = 0; i < 120000; ++i) print "f 1 2 3" }' >same-120000.obj
{ echo "newmtl m
d 0.08" >transparent.mtl && echo "mtllib transparent.mtl
usemtl m" && layers 500; } >transparent-500.obj
too_much sheets-4000.obj "the picture" --views=top --occlusion=none
too_much sheets-20000.obj "a depth map (ambient occlusion, ground, shadow)" --views=front
too_much sheets-20000.obj "a depth map (ambient occlusion, ground, shadow)" --views=front --occlusion=none --shadow --max-overdraw=250
too_much sheets-20000.obj "a depth map (ambient occlusion, ground, shadow)" --occlusion=none --ground --margin=0.15 --max-overdraw=2000
too_much same-120000.obj "the picture" --views=front --look=drawing
too_much transparent-500.obj "the picture" --views=top --occlusion=none
too_much sheets-500.obj "the picture" --views=top --occlusion=none --max-overdraw=10
gives 0 render sheets-500.obj --up=format --views=top --size=640 --samples=1 --occlusion=none --max-overdraw=1e6 --json -o h.png  # a higher limit
# 500 sheets of half the object's square, 0.9 of the picture's side each: a little more for cells at their edges
check "overdraw: $(json overdraw)" awk "BEGIN { exit !($(json overdraw) >= 202 && $(json overdraw) < 320) }"
# A bundle of long thin triangles, as tubes in a tube have: at any size, also with the sky's depth maps.
awk 'BEGIN {
    for (i = 0; i < 4000; ++i) {
        a = i * 2.399963; c = cos(a); s = sin(a); z = i / 4000
        printf "v %.4f %.4f %.4f\nv %.4f %.4f %.4f\nv %.4f %.4f %.4f\n", -c, -s, z, c, s, z, c + .004, s + .004, z + .002
    }
    for (i = 0; i < 4000; ++i) print "f", 3 * i + 1, 3 * i + 2, 3 * i + 3
}' >bundle.obj
for size in 64 256 768; do
    gives 0 render bundle.obj --size=$size --max-overdraw=120 -o h.png
done
rm -f ./*.obj ./*.mtl h.png
expect 2 'burnish: --max-overdraw: "0.5" is not a number from 1 to 1000000000' render :sphere --max-overdraw=0.5
nothing_left "limits"
finish
