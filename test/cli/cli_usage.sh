#!/bin/sh
# Wrong usage: one line on standard error, literally, exit code 2, and no file.
# usage: cli_usage.sh BURNISH SCRATCH
. "$(dirname "$0")/lib.sh"

expect 2 'burnish: no command; try "burnish render :teapot" or "burnish --help"'
expect 2 'burnish: "rendr": unknown command; did you mean render?' rendr
expect 2 'burnish: "frobnicate": unknown command; "burnish --help" lists the commands' frobnicate
expect 3 "burnish: bunny.obj: can't be opened: No such file or directory" bunny.obj
expect 2 'burnish: render: no INPUT; try "burnish render :teapot" or "burnish render --help"' --json
expect 2 'burnish: render: no INPUT; try "burnish render :teapot" or "burnish render --help"' render
expect 2 'burnish: compare: "c" is an extra operand; usage: burnish compare A B [options]' compare a b c
expect 2 'burnish: --sampels: unknown flag; did you mean --samples?' render :sphere --sampels=4
expect 2 'burnish: --view-angle: unknown flag; did you mean --camera-view-angle?' render :sphere --view-angle 4
expect 2 'burnish: --samples: a value is missing: --samples=N' render :sphere --samples
expect 2 'burnish: --output: a value is missing before --json: --output=FILE' render :sphere -o --json
expect 2 'burnish: --output: a value is missing before --help: --output=FILE' render :sphere -o --help
expect 2 'burnish: --timing: takes no value; write --timing alone' render :sphere --timing=1
expect 2 'burnish: --resolution: "0,5" is not a width and a height from 1 to 16384, such as 1024,768' render :sphere --resolution=0,5
expect 2 'burnish: --camera-view-angle: "nan" is not a number from 0.001 to 179' render :sphere --camera-view-angle=nan
expect 2 'burnish: --camera-position: "1,2" is not three numbers, such as 1,0.5,-2' render :sphere --camera-position=1,2
expect 2 'burnish: --camera-direction: 0,0,0 has no direction; give a vector that is not zero' render :sphere --camera-direction=0,0,0
expect 2 'burnish: --camera-position: it is equal to the focal point; move one of them' render :sphere --camera-position=1,2,3 --camera-focal-point=1,2,3
expect 2 'burnish: --camera-view-up: it is parallel to the direction of view; use another vector' render :sphere --camera-position=0,9,0 --camera-focal-point=0,0,0 --camera-view-up=0,1,0
expect 2 'burnish: --camera-position: --views already sets the camera; omit one of them' render :sphere --views=top --camera-position=1,2,3
expect 2 'burnish: --azimuth: --camera-position already sets the camera; omit one of them' render :sphere --camera-position=1,2,3 --azimuth=30
expect 2 'burnish: --light: "sphere:1,1,1:1e38" is not sphere:X,Y,Z:RADIUS[:OPTION][:INTENSITY[:COLOR]]: a radius above 0 and at most 1e30 follows, as in sphere:-1,1,1:0.2' render :sphere --light=sphere:1,1,1:1e38
expect 2 'burnish: --light: "line:1,1,1:2,1,1" is not line:X,Y,Z:X,Y,Z:RADIUS[:OPTION][:INTENSITY[:COLOR]]: a radius above 0 and at most 1e30 follows, as in line:-1,1,0:1,1,0:0.05' render :sphere --light=line:1,1,1:2,1,1
expect 2 'burnish: --light: "disc:1,1,1:1e38,1" is not disc:X,Y,Z:WIDTH,HEIGHT[:OPTION][:INTENSITY[:COLOR]]: width and height above 0 and at most 1e30 follow the position, as in rect:-1,1,1:0.5,0.5' render :sphere --light=disc:1,1,1:1e38,1
expect 2 'burnish: --light: "line:1,1" is not line:X,Y,Z:X,Y,Z:RADIUS[:OPTION][:INTENSITY[:COLOR]]: the kind is followed by two positions, as in line:-1,1,0:1,1,0:0.05' render :sphere --light=line:1,1
expect 2 'burnish: --light: "sun:1,2,3" is not KIND:X,Y,Z[:INTENSITY[:COLOR]]: the kind is directional, point, rect, disc, sphere or line, or one of these after world-; or the whole is none or file' render :sphere --light=sun:1,2,3
expect 2 'burnish: --ambient: "-1" is not a number from 0 to 16, nor a colour: #rgb, #rrggbb, r,g,b from 0 to 1, or a name' render :sphere --ambient=-1
expect 2 'burnish: --material: "wood" is not one of matte, satin, plastic, polished, metal, glass' render :sphere --material=wood
expect 2 'burnish: sheet: 2 pictures of 16384 x 16 in 2 columns exceed 16384 pixels; use smaller pictures or another number of columns' render :sphere --views=front,top --resolution=16384,16
expect 2 'burnish: --json: standard output is used for the picture; name a file with --output=FILE or --json=FILE' render - --json
expect 3 'burnish: /: is a folder; use --output-dir=FOLDER to draw all its meshes' render /
expect 2 'burnish: "nonsense": unknown command; "burnish --help" lists the commands' help nonsense
expect 2 'burnish: --labels: 2 labels for 3 cells; use one label per cell, between commas' render :sphere --views=front,top,iso --labels=one,two
# A sheet too large is refused before the input is looked at.
expect 2 'burnish: sheet: 3 pictures of 16 x 8000 in 1 columns exceed 16384 pixels; use smaller pictures or another number of columns' render none.obj --views=front,top,iso --columns=1 --resolution=16,8000
expect 2 'burnish: --camera-position: "1e308,0,0" has a number beyond 1e100; give a smaller one' render :sphere --camera-position=1e308,0,0
expect 2 'burnish: --help: "nonsense" is not one of picture, files, camera, light, report, all' render --help=nonsense
for name in picture.bmp out/picture.TIF; do
    expect 2 "burnish: --output: \"$name\": pictures are written as PNG, JPEG, WebP, EXR, NPY, SVG or PDF; end the name in .png, .jpg, .webp, .exr, .npy, .svg or .pdf" render :sphere -o $name
done
expect 2 'burnish: --output: "a.svg": an SVG has lines, not shading; use --look=drawing, or the extension .png' render :sphere -o a.svg
expect 2 'burnish: --edges: "corners" is not one of silhouettes, creases, boundaries, materials, none' render :sphere --edges=creases,corners
expect 2 'burnish: --background-color: there is no environment to show; use --environment=sky, room or a file' \
    render :sphere --background=environment
expect 2 "burnish: --background-color: an SVG can't show an environment; use a colour, or the extension .png" \
    render :sphere --background=environment --environment=sky --look=drawing -o a.svg
expect 2 'burnish: --edge-width: "0" is not a number from 0.1 to 100' render :sphere --edge-width=0
expect 2 'burnish: --quality: "0" is not a whole number from 1 to 100' render :sphere --quality=0 -o x.jpg
expect 2 'burnish: --dpi: "0" is not a number from 1 to 65535' render :sphere --dpi=0
expect 2 'burnish: --output-format: "bmp" is not one of auto, png, jpeg, jpg, webp, svg, pdf, exr, npy, gif, mp4, webm' render :sphere --output-format=bmp
BURNISH_ISA=foo
export BURNISH_ISA
run render :sphere --size=16 -o x.png
check "BURNISH_ISA=foo: exit code $code, says $(cat "$err")" grep -q '^burnish: BURNISH_ISA: "foo" is not one of' "$err"
expect 0 '' render :sphere --size=16 --isa=scalar -o x.png
unset BURNISH_ISA
rm -f x.png
nothing_left "wrong usage"
# Names can't control a terminal: ESC [, the same as one character, an override of the writing direction, an isolate. They are
# replaced in text, tables and pages, and escaped in JSON, which keeps them.
name=$(printf 'a\033[31m\302\23331m\342\200\256b\342\201\246')
printf 'mtllib %s.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' "$name" >"$name.obj"
printf 'v 0 0\n' >"$name-bad.obj"
# is_harmless FILE...: no such bytes.
is_harmless() { ! cat "$@" | tr -d '\n\t' | LC_ALL=C grep -aqP '[\x00-\x1f\x7f]|\xc2[\x80-\x9f]|\xe2\x80[\xa8-\xae]|\xe2\x81[\xa6-\xa9]'; }
printf '\302\233' >x.png
check "the test sees no control character" [ "$(is_harmless x.png || echo seen)" = seen ]
harmless() {
    run "$@"
    check "$1 $code: $(od -c "$err" "$out" | head -n 20)" is_harmless "$err" "$out"
}
harmless render "$name.obj" --size=8 -o x.png
harmless render "$name.obj" --size=8 -o x.png --strict
harmless render "$name-bad.obj" --size=8 -o x.png
harmless render "no$name" -o x.png
harmless render :sphere --environment="$name.obj" -o x.png
harmless info "$name.obj"
harmless info "$name.obj" "$name-bad.obj" --csv
harmless render "$name.obj" --size=8 -o "$name.png"
harmless compare "$name.png" "$name.png"
for flags in 'info --json' 'compare --json'; do
    harmless $flags "$name.obj" "$name.obj"
    check "$flags: escaped: $(head -n 20 "$out")" grep -qF '"a\u001b[31m\u009b31m\u202eb\u2066.obj"' "$out"
done
harmless batch . -d . --size=8 --index --report=r.jsonl $(unlimited)
check "a page: $(grep h2 index.html | tail -n 2 | od -c | head)" is_harmless index.html r.jsonl
check "its names" grep -qF '<h2>a?[31m??31m???b???.obj</h2>' index.html
rm -f "$name"* x.png index.html r.jsonl
nothing_left "names"
# Out of memory, for one input or several. Sanitizers need more memory from the start.
run render :sphere --max-memory=5M -o a.png
if [ "$code" = 6 ]; then
    check "memory: $(cat "$err")" grep -qE '^burnish: out of memory: no [0-9]+ bytes for [^;]+; ' "$err"
fi

finish
