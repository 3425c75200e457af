#!/bin/sh
# --environment: names, files, errors. Usage: cli_environment.sh PROGRAM FOLDER
here=$(cd "$(dirname "$0")" && pwd)
. "$here/lib.sh"

hash() { "$burnish" render :teapot --size=48 --json=r.json -o r.png "$@" 2>"$err" && sed -n 's/.*"hash":[^"]*"\([0-9a-f]*\)".*/\1/p' r.json; }

# hdr FILE WIDTH HEIGHT PIXEL: an image of one colour
hdr() {
    python3 -c 'import sys
file, width, height, pixel = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), bytes.fromhex(sys.argv[4])
open(file, "wb").write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width) + pixel * (width * height))' "$@"
}

room=$(hash --environment=room)
sky=$(hash --environment=sky)
differs "room and the default" "$room" "$(hash)"
differs "room and sky" "$room" "$sky"
same "threads" "$(hash --environment=sky --threads=3)" "$sky"
differs "the turn" "$(hash --environment=sky --environment-turn=90)" "$sky"
same "a whole turn" "$(hash --environment=sky --environment-turn=360)" "$sky"
differs "the strength" "$(hash --environment=sky --environment-strength=0.5)" "$sky"
behind=--background-color=environment
differs "tone mapping" "$(hash --environment=sky $behind --tone-mapping=filmic)" "$(hash --environment=sky $behind)"
same "exposure, also of what is behind" "$(hash --environment=sky $behind --exposure=1 --tone-mapping)" \
    "$(hash --environment=sky $behind --environment-strength=2 --exposure=0 --tone-mapping=neutral)"
differs "a light in addition" "$(hash --environment=sky --light=directional:1,1,1)" "$sky"

# Images of one colour.
hdr white.hdr 64 32 80808081
hdr dark.hdr 64 32 8080807f
white=$(hash --environment=white.hdr)
same "a turned constant" "$(hash --environment=white.hdr --environment-turn=77)" "$white"
same "strength" "$(hash --environment=dark.hdr --environment-strength=4)" "$white"
differs "constants" "$(hash --environment=dark.hdr)" "$white"
if "$burnish" render :sphere --size=32,16 -o e.exr 2>/dev/null; then
    same "EXR: exit code" "$("$burnish" render :teapot --size=16 --environment=e.exr -o r.png 2>&1)" ""
    head -c 700 e.exr >short.exr
    gives 4 render :teapot --size=16 --environment=short.exr -o r.png
else
    skip "EXR, this build does not write it"
fi

# Every command that draws warns of it.
hdr hot.hdr 1 1 808080ff
hot='burnish: warning: hot.hdr: 3 values are negative, above 1000000 or not numbers; they are clamped'
expect 0 "$hot" render :sphere --size=16 --environment=hot.hdr -o x.png
run compare :sphere :sphere --size=16 --environment=hot.hdr
same "compare, a hot environment" "$(cat "$err")" "$hot"
rm -f x.png

head -c 5000 white.hdr >short.hdr
expect 4 'burnish: short.hdr: scan line 20 of 32 is damaged, or the file is truncated' render :teapot --environment=short.hdr -o x.png
hdr huge.hdr 1 1 80808081
sed -i 's/^-Y 1 +X 1$/-Y 40000 +X 40000/' huge.hdr
gives 5 render :teapot --environment=huge.hdr -o x.png
expect 4 'burnish: r.png: neither Radiance HDR nor EXR; convert it to one of them' render :teapot --environment=r.png -o x.png
expect 3 "burnish: none.hdr: can't be opened: No such file or directory" render :teapot --environment=none.hdr -o x.png
expect 5 'burnish: white.hdr: larger than 99 bytes; raise --max-input-bytes' render :teapot --environment=white.hdr --max-input-bytes=99 -o x.png
gives 2 render :teapot --environment-strength=-1 -o x.png
check "no picture" [ ! -e x.png ]

if draws --sandbox; then
    same "sandbox" "$(hash --environment=white.hdr --sandbox)" "$white"
else
    skip "an environment in the sandbox, this system or build has none"
fi
finish
