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
expect 2 'burnish: --view-angle: unknown flag; did you mean --camera-view-angle?' render :sphere --view-angle 4
expect 2 'burnish: --output: a value is missing before --json: --output=FILE' render :sphere -o --json
expect 2 'burnish: --output: a value is missing before --help: --output=FILE' render :sphere -o --help
expect 2 'burnish: --timing: takes no value; write --timing alone' render :sphere --timing=1
expect 2 'burnish: --resolution: "0,5" is not a width and a height from 1 to 16384, such as 1024x768, or one number for both' render :sphere --resolution=0,5
expect 2 'burnish: --camera-intrinsics: "9,0,1,1" is not four numbers of which the first two are above 0, such as 900,900,319.5,239.5' render :sphere --camera-intrinsics=9,0,1,1
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
expect 2 'burnish: --help: "nonsense" is not one of picture, files, camera, light, input, report, all' render --help=nonsense
for name in picture.bmp out/picture.TIF; do
    expect 2 "burnish: --output: \"$name\": pictures are written as PNG, JPEG, WebP, EXR, NPY, SVG or PDF; end the name in .png, .jpg, .webp, .exr, .npy, .svg or .pdf" render :sphere -o $name
done
expect 2 'burnish: --output: "a.svg": an SVG has lines, not shading; use --look=drawing, or the extension .png' render :sphere -o a.svg
expect 2 'burnish: --edges: "corners" is not one of silhouettes, creases, boundaries, materials, tangents, none' render :sphere --edges=creases,corners
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
# Letters in groups, one meaning of --size, all views, words of other programs.
size_of() { png_size x.png; rm -f x.png; }
for words in '-qs64' '-qs 64' '-q -s64x64' '--resolution=64' '--size=64X64'; do
    expect 0 '' render :sphere $words -o x.png
    same "$words" "$(size_of)" '64 64'
done
expect 2 'burnish: -z: unknown flag; "burnish render --help" lists the flags' render :sphere -qz
expect 0 '' render :sphere -q --views=all --size=16 -o x.png
same "seven views" "$(size_of)" "$(run render :sphere -q --views=front,right,top,iso,back,left,bottom --size=16 -o x.png; size_of)"
expect 2 'burnish: --views: all is a whole sheet; omit the other views' render :sphere --views=top,all
for pair in padding:margin trim:margin alpha:no-background scale:zoom force:overwrite format:output-format engine:look resize:size world:environment bom:callouts balloons:callouts exploded:explode cut:section cross-section:section \
    paper-size:paper raytrace:raytracing rt:raytracing; do
    expect 2 "burnish: --${pair%:*}: unknown flag; did you mean --${pair#*:}?" render :sphere "--${pair%:*}"
done
expect 2 'burnish: -y: unknown flag; did you mean --overwrite?' render :sphere -y
expect 2 'burnish: -resize: unknown flag; did you mean --size?' render :sphere -resize 50%
expect 2 'burnish: -quality: unknown flag; did you mean --quality?' render :sphere -quality 90
expect 2 'burnish: -density: unknown flag; did you mean --dpi?' render :sphere -density=300
for pair in convert:render identify:info montage:batch; do
    expect 2 "burnish: \"${pair%:*}\": unknown command; did you mean ${pair#*:}?" "${pair%:*}" :sphere x.png
done
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' | gzip -c >x.obj.gz
expect 0 '' render x.obj.gz -q
same "the name of a compressed mesh" "$(size_of)" '1024 768'
rm -f x.obj.gz
expect 0 '' render :sphere --samples=1 --samples=4 --size=16 -o x.png
run render :sphere --size=16 -o y.png
check "of a repeated flag the last counts" cmp x.png y.png
gives 0 help version
gives 0 version
same "version" "$(cat "$out")" "$("$burnish" --version)"
# Command lines of Manyfold, FreeCAD and file managers, under f3d's name; then every option of docs/pictures.md.
ln -s "$burnish" f3d
block 10 6 5 >part.obj
run render :sphere --edges=1 --size=16 -o y.png
run render :sphere --wireframe --size=16 -o x.png
check "--edges=1 are all edges" cmp x.png y.png
run render :sphere --look=technical --edges=none --size=16 -o y.png
run render :sphere --look=technical --size=16 -o x.png
check "--edges=none is burnish's" [ "$(cmp x.png y.png | wc -l)" = 1 ]
expect 2 'burnish: --no-render: unknown flag; "burnish render --help" lists the flags' render :sphere --no-render
no_window='burnish has no window; draw a picture by "burnish INPUT -o OUTPUT", or use a viewer such as f3d'
expect 2 "burnish: view: $no_window" view part.obj
burnish_before=$burnish
burnish=$scratch/f3d
expect 1 "burnish: f3d: $no_window" part.obj --axis=1
gives 0 part.obj --ambient-occlusion=1 --anti-aliasing=true --axis=0 --background-color=0,0,0 --filename=0 --grid=1 \
    --grid-color=0,255,255 --grid-subdivisions=0 --grid-unit=10 --no-config=1 --output=- --resolution=64,64 \
    --tone-mapping=1 --translucency-support=1 --up=+z --camera-direction=-1,1,-0.5 --color=1,1,1
cp "$out" x.png
same "Manyfold's picture" "$(size_of)" '64 64'
same "its warnings" "$(grep -c 'no effect: burnish has nothing like it' "$err")" 3
gives 0 part.obj --verbose=debug --no-render=1 --no-config=1
same "its box" "$(cat "$out")" 'Scene bounding box: 0 ≤ x ≤ 10, 0 ≤ y ≤ 6, 0 ≤ z ≤ 5'
gives 0 --list-readers
same "its types" "$(grep -cE '(model/|application/vnd\.)[0-9a-z.+-]*$' "$out")" 7
gives 0 --version
check "FreeCAD's version: $(cat "$out")" grep -qE '^Version: [2-9]\.[0-9]+\.[0-9]+$' "$out"
freecad='--load-plugins=occt --config=thumbnail --verbose=quiet --resolution=64,48 --filename=0 --grid=0 --axis=0 --no-background --max-size=100'
for word in $freecad; do
    expect 0 '' "$word" --no-render
done
expect 0 '' $freecad --output x.png ./part.obj
same "a thumbnail" "$(size_of)" '64 48'
expect 0 '' part.obj --output=x.jpg -qatgx --camera-position -20,15,9 --edges --camera-view-up +Y
check "a PNG of this name" grep -q PNG x.jpg
gives 0 --scalars part.obj --output=x.png
for words in 'none.obj --output=x.png' 'part.obj --output=x.png --frobnicate' 'part.obj --output=no/x.png' 'part.obj --output=x.png -w'; do
    gives 1 $words
done
grep '^| `' "$(dirname "$0")/../../docs/pictures.md" >rows
while read -r row; do
    for word in $(printf '%s' "${row#|}" | cut -d'|' -f1 | grep -o '`[^`]*`' | tr -d '`'); do
        gives 0 :sphere --output=x.png --resolution=16,16 --reference-threshold=1 "$word"
        check "$word: $(cat "$err")" [ "$(grep -c 'nothing like it' "$err")" = "$(printf '%s' "$row" | grep -c 'no effect')" ]
    done
done <rows
burnish=$burnish_before
rm -f f3d part.obj rows x.png x.jpg y.png
nothing_left "f3d"
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
    truncate -s 100000084 many.stl
    printf '\200\204\036' | dd of=many.stl bs=1 seek=80 conv=notrunc 2>/dev/null # 2,000,000 triangles
    expect 6 'burnish: out of memory: no 72000000 bytes for positions; raise --max-memory, free memory, or use a smaller input' \
        render many.stl --max-memory=80M --threads=1 -o a.png
    rm -f many.stl
fi

finish
