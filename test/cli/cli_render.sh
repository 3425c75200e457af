#!/bin/sh
# burnish render as a user sees it: names of outputs, exit codes, JSON, cameras, sheets, nothing half-written.
# usage: cli_render.sh BURNISH SCRATCH
. "$(dirname "$0")/lib.sh"

# is_png FILE WIDTH HEIGHT
is_png() { [ "$(png_size "$1")" = "$2 $3" ]; }

# hash ARGUMENTS...: the hash of the picture.
# Few directions of ambient occlusion, which takes most of the time under sanitizers.
hash() {
    run render --occlusion=8 "$@" --json -o picture.png
    [ "$code" = 0 ] || fail "burnish render $*: exit code $code: $(cat "$err")"
    json hash
}

triangle() {
    printf 'solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n'
}

# Where the picture goes.
expect 0 '' render :torus --size=32
check "torus.png" is_png torus.png 32 32
expect 0 '' render :torus --resolution=40x30 -o a.png
check "a.png" is_png a.png 40 30
expect 0 '' render :torus --resolution 40,30 -ob.png
same "both forms" "$(cksum <a.png)" "$(cksum <b.png)"
mkdir in
triangle >in/part.v2.stl
expect 0 '' render in/part.v2.stl --size=16
check "part.v2.png in the current folder" is_png part.v2.png 16 16
"$burnish" render - --size=16 <in/part.v2.stl >piped.png
same "from pipe to pipe" "$(cksum <piped.png)" "$(cksum <part.v2.png)"
expect 0 '' render -o dash.png --size=16 -- in/part.v2.stl
expect 2 'burnish: --output: "in/part.v2.stl" is an input; name another file' render in/part.v2.stl -o in/part.v2.stl
check "the input is as it was" sh -c "grep -q endsolid in/part.v2.stl"

# Exit codes, and nothing left behind.
mkdir empty
cd empty || exit 1
expect 3 "burnish: none.stl: can't be opened: No such file or directory" render none.stl
expect 3 "burnish: https://a.b/c.stl: can't be opened: it is an address; download the file first" render https://a.b/c.stl
expect 2 'burnish: --turntable: a value is missing before -o: --turntable=FILE' render :torus --turntable -o t.gif
expect 2 'burnish: :tepot: unknown built-in object; there are :teapot, :sphere, :torus, :knot' render :tepot
printf 'solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n' >../broken.stl
gives 4 render ../broken.stl  # a broken file
check "a broken file: one line that names it" sh -c "[ \$(wc -l <'$err') = 1 ] && grep -q '^burnish: ../broken.stl' '$err'"
gives 5 render ../in/part.v2.stl --max-input-bytes=20
gives 5 render :sphere --max-triangles=3  # too many triangles
expect 7 "burnish: none/x.png: can't be written: No such file or directory; create the folder first" render :sphere --size=16 -o none/x.png
expect 7 "burnish: /dev/full: can't be written: No space left on device; free some space" render :sphere --size=16 -o /dev/full
away='--size=16 --camera-position=100,0,0 --camera-focal-point=200,0,0'
expect 8 'burnish: :sphere: the picture is blank; check the camera; no file was written' render :sphere $away --fail-on-blank
expect 8 'burnish: :sphere: the picture is blank; check the camera; no file was written' render :sphere $away --fail-on-blank --quiet
nothing_left "failed runs"
printf 'mine' >kept.png
expect 8 'burnish: :sphere: the picture is blank; check the camera; no file was written' render :sphere $away --fail-on-blank -o kept.png
run render ../broken.stl -o kept.png
check "an older picture stays" [ "$(cat kept.png)" = mine ]
expect 0 'burnish: warning: :sphere: the picture is blank: the object is not in it; check --camera-position' render :sphere $away
expect 0 '' render :sphere $away --quiet --overwrite
printf 'mine' >s.png
"$burnish" render :sphere --size=500 --json -o s.png 2>"$err" >/dev/full
check "a report that can't be printed: 7" [ $? = 7 ]
check "a report that can't be printed replaces a picture" [ "$(cat s.png)" = mine ]
(
    ulimit -f 1
    "$burnish" render :sphere --size=500 -o s.png 2>"$err"
    echo $? >../code
)
check "a file over the limit of the shell ends with 7, not a signal: $(cat ../code)" [ "$(cat ../code)" = 7 ]
check "a file over the limit: one line, not $(cat "$err")" grep -q "^burnish: s.png: can't be written: File too large" "$err"
check "a file over the limit replaces a picture" [ "$(cat s.png)" = mine ]

# A default output name replaces no file, which may be a texture of the mesh.
mkdir model
cd model || exit 1
triangle >part.stl
printf 'texture' >part.png
expect 2 'burnish: part.png: exists and was not written by burnish; replace it with --overwrite, or name the picture with --output=FILE' render part.stl
check "the texture is as it was" [ "$(cat part.png)" = texture ]
expect 0 '' render part.stl --size=16 -o part.png
check "-o replaces" is_png part.png 16 16
expect 0 '' render part.stl --size=17 --overwrite
check "--overwrite replaces" is_png part.png 17 17
expect 0 '' render part.stl --size=18
check "its own picture is replaced without asking" is_png part.png 18 18
cd ..
cd ..

# The sets of flags that the manual gives for these looks.
same "look technical" "$(hash :knot --size=64 --look=technical --color=red)" \
    "$(hash :knot --size=64 --look=plain --edges --light=directional:-0.45,0.75,0.85:0.5 --ambient=0.36 --specular=0 --color=red)"
same "look drawing" "$(hash :knot --size=64 --look=drawing)" \
    "$(hash :knot --size=64 --look=plain --edges --color=white --specular=0 --light=none --ambient=1)"
same "look lobes" "$(hash :knot --size=64 --look=lobes --color=red)" \
    "$(hash :knot --size=64 --look=plain --light=directional:-0.55,0.75,0.85 --specular=0.9 --color=red)"
same "opacity 1" "$(hash :knot --size=64 --opacity=1)" "$(hash :knot --size=64)"
check "opacity 0.5 shows" [ "$(hash :knot --size=64 --opacity=0.5)" != "$(hash :knot --size=64)" ]
for value in 1.1 -0.1 x nan ''; do
    gives 2 render :knot --size=64 "--opacity=$value" -o opacity.png
done

# Cuts.
gives 0 render :sphere --size=64 --clip=0,1,0,0.5 --clip=1,0,0,9 --json -o cut.png
same "cuts" "$(tr -d '\n\t ' <"$out" | grep -o '"cuts":[^a-z]*')" '"cuts":[[0,1,0,0.5]],"'
same "filled" "$(json filled)" true
check "a plane beyond the mesh gives a line" grep -q 'no part of the mesh is beyond' "$err"
run render :teapot --size=64 --clip=0,0,1,0 -o cut.png
check "an open mesh gives a line: $(cat "$err")" grep -q 'cut but not filled' "$err"
for value in 0,0,1 0,0,0,1 0,0,1,1,1 a,b,c,d 0,0,1,nan 0,0,1,-9 ''; do
    gives 2 render :sphere --size=64 "--clip=$value" -o cut.png
done
gives 2 render :sphere --size=64 --clip=1,0,0,1 --clip=1,0,0,1 --clip=1,0,0,1 --clip=1,0,0,1 --clip=1,0,0,1 --clip=1,0,0,1 --clip=1,0,0,1 -o cut.png  # seven planes

# Parts: left out as if the file did not have them, and moved as if they were there.
part() { # NAME X Y Z SIDE
    awk -v o="$2 $3 $4" -v s="$5" 'BEGIN { split(o, at)
        for (i = 0; i < 8; ++i) print "v", at[1] + i % 2 * s, at[2] + int(i / 2) % 2 * s, at[3] + int(i / 4) * s }'
    echo "o $1"
    printf 'f %s\n' '-8 -6 -5 -7' '-4 -3 -1 -2' '-8 -7 -3 -4' '-6 -2 -1 -5' '-8 -4 -2 -6' '-7 -5 -1 -3'
}
{ part base 0 0 0 2; part lid 2 0 0 2; } >two.obj
{ part base 0 0 0 2; part lid 2 0 0 2; part screw.1 8 1 1 1; } >three.obj
{ part base -3 0 0 2; part lid 5 0 0 2; } >apart.obj
two=$(hash two.obj --size=64)
same "--hide" "$(hash three.obj --size=64 '--hide=s?rew*')" "$two"
same "--only" "$(hash three.obj --size=64 --only=base --only=lid)" "$two"
same "--explode" "$(hash two.obj --size=64 --explode=3)" "$(hash apart.obj --size=64)"
check "a part has its colour" [ "$(hash two.obj --size=64 --color-by=part --no-legend)" != "$two" ]
gives 0 render three.obj --size=300 --callouts --look=drawing --json -o a.svg
same "callouts" "$(tr -d '\n\t ' <"$out" | grep -o '"count":1,"part":[0-9],"point":\[[0-9,]*\],"balloon":true' | wc -l)" 3
same "rows and balloons" "$(grep -cE 'aria-label="(1x (base|lid|screw.1)|[123])"' a.svg)" 9
{ part Gehäuse 0 0 0 2; part д 3 0 0 2; part axle_of_the_very_long_rear_left 6 0 0 2; part axle_of_the_very_long_rear_right 9 0 0 2; } >names.obj
gives 0 render names.obj --size=400 --callouts --look=drawing -o a.svg
same "names" "$(grep -oE 'aria-label="1x [^"]*"' a.svg | cut -d'"' -f2 | sed 's/\.\.\..*_/../' | tr '\n' ' ')" '1x Gehäuse 1x #2 1x ..left 1x ..right '
check "letters: $(cat "$err")" grep -q '2 of 4 names have letters beyond ASCII, such as "Gehäuse"' "$err"
for i in $(seq 30); do part "p${i}x" "$i" 0 0 .5; done >many.obj
run render many.obj --size=150 --callouts --look=drawing -o a.svg
same "a long list" "$(grep -cE 'aria-label="1x p' a.svg)" "$(sed -n 's/.*aria-label="and \([0-9]*\) more".*/\1/p' a.svg | awk '{ print 30 - $1 }')"
expect 0 '' render three.obj --size=200 --only=base --callouts -o a.png # a single part
expect 0 'burnish: warning: two.obj: --annotate: dimensions: --explode moves parts, so lengths of the whole are not drawn; omit one of them' render two.obj --size=64 --explode=3 --annotate=dimensions -o a.png
same "dimensions of moved parts" "$(hash two.obj --size=64 --explode=3 --annotate=dimensions)" "$(hash apart.obj --size=64)"
for gap in 0 0.001 0.1; do # below a block without its lower side
    { block 4 2 1 | grep -vx 'f 4 3 2 1'; printf 'v %s -'$gap'\n' '0 0' '4 0' '4 2' '0 2'; echo f -1 -2 -3 -4; } >gap.obj
    run render gap.obj --clip=0,-1,0,-1 --size=64 --json -o a.png
    same "a gap of $gap" "$(json filled)" "$(case $gap in 0.1) echo false ;; *) echo true ;; esac)"
done
gives 0 render three.obj --look=drawing --clip=0,1,0,1.5 -o a.svg
same "hatching of parts" "$(grep -c '<path fill="none" stroke' a.svg)" 3
expect 2 'burnish: --callouts: a turntable shows only one view and one lobe; omit the flag' render three.obj --callouts --turntable=a.gif
check "more parts than a list has" sh -c "awk 'BEGIN { print \"v 0 0 0\\nv 1 0 0\"; for (i = 1; i <= 1003; ++i) print \"v 0 \" i / 9 \" 0\\no \" i \"\\nf 1 2 \" i + 2 }' | '$burnish' render - --input-format=obj --callouts --look=drawing --size=64 -o a.svg 2>&1 | grep -q ': 3 more parts, which differ'"
expect 0 'burnish: warning: --callouts: no effect: INPUT has no parts; omit the flag' render :sphere --size=64 --callouts -o a.png
rm a.svg
gives 0 render three.obj --size=16 --hide=screw -o a.png
check "no such name: $(cat "$err")" grep -qx 'burnish: warning: three.obj: no part is named "screw"; there is "screw.1" and 2 more' "$err"
expect 2 'burnish: three.obj: no part is named "axle"; there is "base", "lid", "screw.1"' render three.obj --only=axle -o a.png
expect 2 'burnish: --hide: more than 1022 bytes of names; use * for several' render three.obj "--hide=$(printf %1023s)"
gives 2 render three.obj --hide= -o a.png
run info three.obj
check "info: $(cat "$out")" grep -qx '  part 3                "screw.1", solid, 1 x 1 x 1' "$out"

# The report.
run render :teapot --size=64 --occlusion=8 --json -o t.png
check "JSON is valid" valid_json
check "JSON alone: nothing on standard error" [ ! -s "$err" ]
for key in burnish input format output width height triangles vertices materials exponents bounding_box up \
    triangles_drawn hidden cuts filled covered_pixels layers_dropped pixel_bounds near_white near_black like_ground contrast camera pixels_per_unit lobe equation viewer lights samples threads seconds hash \
    hash_algorithm blank legible warnings; do
    check "JSON lacks $key" grep -q "\"$key\":" "$out"
done
same "input" "$(json input)" :teapot
same "output" "$(json output)" t.png
same "width" "$(json width)" 64
same "lobe" "$(json lobe)" auto
same "blank" "$(json blank)" false
check "hash has 16 digits" sh -c "echo $(json hash) | grep -qx '[0-9a-f]\{16\}'"
position=$(json position) focal=$(json focal_point) up=$(json view_up) plain=$(json hash)
same "the camera of the report makes the same picture" "$plain" \
    "$(hash :teapot --size=64 --camera-position=$position --camera-focal-point=$focal --camera-view-up=$up)"
gives 8 render :sphere $away --json -o blank.png --fail-on-blank  # JSON of a blank picture
check "JSON of a blank picture is valid" valid_json
same "blank" "$(json blank)" true
same "nothing was written" "$(json output)" null
check "no blank.png" [ ! -e blank.png ]
name=$(printf 'a"b\\\377\303\251.stl')
triangle >"$name"
run render "$name" --size=8 --json -o q.png
check "JSON with an odd file name is valid" valid_json
run render :sphere --size=16 --timing -o t.png
check "--timing" grep -qx 'burnish: start [0-9.]* ms, read [0-9.]* ms, build [0-9.]* ms, transform [0-9.]* ms, draw [0-9.]* ms, encode [0-9.]* ms, write [0-9.]* ms, total [0-9.]* ms' "$err"
check "--timing leaves standard output alone" [ ! -s "$out" ]

# The report's description of the picture: flat white on black, on white, and black on a
# dark and on no background.
tones() {
    run render :sphere --look=plain --size=32 --samples=1 --light=none --specular=0 "$@" --json --quiet -o t.png
    same "tones of $*" "$(json near_white) $(json near_black) $(json like_ground) $(json contrast | cut -c1-6) $(json blank)" "$wanted"
}
wanted='1 0 0 21 false' tones --color=white --ambient=1 --background-color=black
wanted='1 0 1 1 true' tones --color=white --ambient=1 --background-color=white
wanted='0 1 0 1.0485 false' tones --ambient=0 --background-color=#080808
wanted='0 1 null null false' tones --ambient=0 --no-background
run render :teapot --size=64 --color=white --light=directional:0,0,1:3 --background-color=white --json -o t.png
check "a share of white: $(json near_white)" sh -c "echo $(json near_white) | grep -qx '0\.[0-9]*[1-9][0-9]*'"
same "lost in a white ground" "$(json near_white)" "$(json like_ground)"

# The ground: in studio under what stands, if nothing is measured and no flag decides; nothing else changes.
grounds() {
    wanted=$1
    shift
    gives 0 render "$@" --size=48 --quiet --json -o t.png
    same "ground of $*" "$(tr -d '\t' <"$out" | grep '^"ground"')" "\"ground\":$wanted,"
}
printf 'v 0 0 -1\nv 4 0 -1\nv 0 1 0\nv 4 1 0\nv 0 1 -2\nv 4 1 -2\nf 1 2 4 3\nf 1 5 6 2\nf 3 4 6 5\nf 1 3 5\nf 2 6 4\n' >edge.obj
sed 's/ 1 / -1 /' edge.obj >lying.obj
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n' >points.ply
grounds true :torus
same "pixels of the object" "$(json covered_pixels) $(json pixel_bounds) $(json position)" \
    "$(gives 0 render :torus --size=48 --no-ground --json -o t.png; json covered_pixels) $(json pixel_bounds) $(json position)"
grounds true :torus --no-background
grounds true :torus --no-ground --ground
grounds true :torus --look=plain --ground
grounds true :torus --environment=sky
grounds true lying.obj --up=+Y
for flags in --no-ground '--ground --no-ground' --look=plain --look=technical --look=drawing --look=three-point --views=front --views=iso --occlusion=none --plane=depth:d.npy \
    --elevation=-30 '--camera-orthographic --camera-direction=0,0,-1'; do
    # shellcheck disable=SC2086
    grounds false :torus $flags
done
grounds false edge.obj --up=+Y
grounds true edge.obj --up=-Y
grounds false points.ply
unseen='--look=plain --size=16 --color=white --light=none --ambient=1 --background-color=white'
mkdir unseen
cd unseen || exit 1
expect 8 'burnish: :sphere: the picture has one colour; check colours, lights and background; no file was written' render :sphere $unseen --fail-on-blank
expect 8 'burnish: :sphere: 2 of 2 cells are blank; check colours, lights and background; no file was written' render :sphere $unseen --views=front,top --fail-on-blank
nothing_left "a picture of one colour"
cd ..
run render :sphere $unseen --json -o t.png
check "a picture of one colour is written with a warning: $(cat "$err")" grep -q 'warning: :sphere: the picture has only one colour' "$err"
expect 0 '' render :sphere --size=16 --fail-on-blank -o t.png

# Where walls that are seen from behind are not drawn, edges of tiles are not seen either: the step of light from column 127 to 128.
printf 'v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 0 0 3\nv 4 0 3\nv 4 4 3\nv 0 4 3\nf 1 2 3 4\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n' >room.obj
gives 0 render room.obj --raytracing --cull-back-faces --size=192 --samples=1 -o room.npy
check "no seam" python3 -c '
import array
d = array.array("f", open("room.npy", "rb").read()[-192 * 192 * 16:])
step = sum(abs(d[(192 * y + 128) * 4 + 1] - d[(192 * y + 127) * 4 + 1]) for y in range(60, 130))
assert step < 0.15, step'
# A glTF room shows its inside, unless more than a few faces have two sides, it is closed, or a flag says so.
room() { # FILE FACES MATERIALS [INDICES of material 1]
    python3 - "$@" <<'END'
import base64, json, struct, sys
faces = [(0, 2, 1), (1, 2, 3), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5), (4, 5, 6), (5, 7, 6)]
faces = [(a, c, b) for a, b, c in faces][:int(sys.argv[2])]  # without the last two: open toward +Z
data = b"".join(struct.pack("<3f", i & 1, i >> 1 & 1, i >> 2) for i in range(8)) + b"".join(struct.pack("<3H", *f) for f in faces)
json.dump({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0, "materials": json.loads(f"[{sys.argv[3]}]"),
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1 + i, "material": i} for i in range(len(sys.argv) - 3)]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
                  {"bufferView": 1, "componentType": 5123, "count": 3 * len(faces), "type": "SCALAR"},
                  {"bufferView": 1, "componentType": 5123, "count": int(sys.argv[-1]) if len(sys.argv) > 4 else 3, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0, "byteLength": 96}, {"buffer": 0, "byteOffset": 96, "byteLength": 6 * len(faces)}],
    "buffers": [{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}]}, open(sys.argv[1], "w"))
END
}
room open.gltf 10 '{}'
room two.gltf 10 '{"doubleSided":true}'
room closed.gltf 12 '{}'
room unused.gltf 10 '{},{"doubleSided":true}'
room lamp.gltf 10 '{},{"doubleSided":true}' 3
room screens.gltf 10 '{},{"doubleSided":true}' 9
inside=$(hash open.gltf --size=64 --cull-back-faces) outside=$(hash open.gltf --size=64 --no-cull-back-faces)
check "the sides of a room differ" [ "$inside" != "$outside" ]
same "a room" "$(hash open.gltf --size=64)" "$inside"
same "a room in a scene" "$(hash open.gltf --scene --size=64)" "$inside"
same "a room next to an unused material" "$(hash unused.gltf --size=64)" "$inside"
same "a room with a two-sided lamp" "$(hash lamp.gltf --size=64)" "$(hash lamp.gltf --size=64 --cull-back-faces)"
same "a room with large two-sided faces" "$(hash screens.gltf --size=64)" "$(hash screens.gltf --size=64 --no-cull-back-faces)"
same "a room of two-sided walls" "$(hash two.gltf --size=64)" "$outside"
same "a closed room, or a solid that is inside out" "$(hash closed.gltf --size=64)" "$(hash closed.gltf --size=64 --no-cull-back-faces)"
same "an open part whose faces look outward" "$(hash :teapot --size=64)" "$(hash :teapot --size=64 --no-cull-back-faces)"

# One warning of a picture that hardly shows its object, which names a flag that helps.
illegible() {
    wanted=$1
    shift
    expect 0 "burnish: warning: $wanted" render "$@" -o t.png
}
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 900 0 900\nv 901 0 900\nv 900 1 900\nf 1 2 3\nf 4 5 6\n' >apart.obj
printf 'v 0 0 0\nv 900 0 0\nv 0 .1 0\nf 1 2 3\n' >wire.obj
illegible ':sphere: the picture is nearly black; raise --exposure or --ambient, or use --color' :sphere --light=none --ambient=0
illegible ':knot: the picture is nearly black; raise --exposure or --ambient, or use --color' :knot --light=none --ambient=0 --size=32
illegible ':sphere: the picture has only one colour: the object is invisible; check --color, --light and --background-color' :sphere $unseen
illegible ':sphere: the picture shows the object in the colour of its background; change --background-color' \
    :sphere --look=plain --light=none --ambient=.97 --specular=0 --color=white --edges=none --size=64
illegible ':sphere: the picture shows the object in only 44 of 786432 pixels; check --zoom' :sphere --zoom=0.01
illegible 'apart.obj: the picture shows the object in only 1 of 65536 pixels; use --zoom with --camera-focal-point' \
    apart.obj --size=256 --samples=16
illegible 'wire.obj: the picture is blank: the object is too thin or too small in it, or transparent; use --edges, --opacity, or --zoom with --camera-focal-point' wire.obj
illegible 'points.ply: the picture is empty: points have no lines to draw; use another --look' points.ply --look=drawing
for flag in --edges --wireframe; do
    expect 0 "burnish: warning: $flag: no effect: points have no edges; omit the flag" render points.ply --size=64 $flag -o t.png
done
expect 0 '' render wire.obj --size=64 --look=drawing --edges -o t.png
expect 0 '' render :sphere --look=plain --light=none --ambient=.97 --specular=0 --color=white --edges --size=512 -o t.png
for flags in '--look=drawing' '--color=white --background-color=white' '--environment=sky --background-color=environment' '--no-background'; do
    # shellcheck disable=SC2086
    expect 0 '' render :teapot --size=64 $flags -o t.png
done
# All columns are looked at: these posts are between each tenth.
printf 'v -218 -200 0\nv -212 -200 0\nv -212 200 0\nv -218 200 0\nv 212 -200 0\nv 218 -200 0\nv 218 200 0\nv 212 200 0\nf 1 2 3 4\nf 5 6 7 8\n' >posts.obj
expect 0 '' render posts.obj --size=640x480 --color=red --camera-direction=0,0,-1 --camera-orthographic --camera-orthographic-height=480 -o t.png
same "legible" "$(gives 0 render :sphere --json -o t.png; json legible) $(run render :sphere --zoom=0.01 --json -o t.png; json legible)" 'true false'

# The report in a file, the picture on standard output.
"$burnish" render :torus --size=16 --json=report.json -o - >piped.png
check "a picture beside its report" is_png piped.png 16 16
cp report.json "$out"
check "a report in a file is valid" valid_json
same "its output" "$(json output)" -
expect 0 '' render :torus --size=16 --json=report.json -o t.png
expect 2 'burnish: --json: standard output is used for the picture; name a file with --output=FILE or --json=FILE' render :torus --json -o -
expect 2 'burnish: --json: "t.png" is the picture; name another file' render :torus --json=t.png -o t.png
expect 2 'burnish: --json: "in/part.v2.stl" is an input; name another file' render in/part.v2.stl --json=in/part.v2.stl -o t.png
expect 2 'burnish: --json: the value is empty: --json=FILE' render :torus --json=
printf 'mine' >kept.png
expect 7 "burnish: none/r.json: can't be written: No such file or directory; create the folder first" render :torus --size=16 --json=none/r.json -o kept.png
check "a report that can't be written replaces a picture" [ "$(cat kept.png)" = mine ]

# Flags that must not change the picture, and flags that must.
same "threads" "$plain" "$(hash :teapot --size=64 --threads=3)"
same "defaults written out" "$plain" "$(hash :teapot --size=64 --samples=4 --lobe=auto \
    --equation=blinn --viewer=local --margin=0.05 --camera-view-angle=30 --zoom=1 --up=+Y \
    --normals=auto --tessellation=16 --background-color=#eeeff1 --look=studio --threads=1)"
for flag in --samples=8 --up=+Z --azimuth=20 --elevation=-20 --zoom=2 \
    --camera-view-angle=50 --camera-orthographic --margin=0.2 --camera-direction=1,-1,0 --camera-view-up=1,1,0 \
    --camera-focal-point=0,0,0 --background-color=navy --no-background --color=gold --material=metal \
    --specular=0 --exponent=9 --lobe=power --lobe=schlick --lobe=taylor:8 --equation=phong --viewer=distant \
    --light=point:0,0,0 --light=none --ambient=0.5 --tessellation=3 --normals=own --crease-angle=0 --cull-back-faces --look=plain --look=clay --occlusion=none --occlusion=9 --exposure=1 --tone-mapping=none; do
    differs "$flag" "$plain" "$(hash :teapot --size=64 $flag)"
done
# Colours by name, and none.
same "a CSS name" "$(hash :torus --size=32 --color=LightSteelBlue)" "$(hash :torus --size=32 --color=#b0c4de)"
printf 'newmtl red\nKd 1 0 0\nKs 1 1 1\n' >colored.mtl
printf 'v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n' >colors.obj
printf 'newmtl m\nKa 0 0 0\nKd 0.1 0.1 0.1\nKs 0 0 0\n' >black.mtl
printf 'mtllib black.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >black.obj
lifted='materials that reflect almost nothing: 1; drawn as dark grey with a highlight, use --look=plain to see them black'
expect 0 "burnish: warning: $lifted" render black.obj --size=32 --json=report.json -o b.png
check "the report names black materials" grep -qF "\"$lifted\"" report.json
printf 'newmtl m\nKa 0 0 0\nKd 0 0 0\nKs 0 0 0\n' >black.mtl
expect 0 "burnish: warning: no material reflects light: drawn in the look's grey; use --color=black --look=plain for black" \
    render black.obj --size=32 -o b.png
same "a file of black alone" "$(hash black.obj --size=32)" "$(hash black.obj --size=32 --no-colors)"
printf 'mtllib colored.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >colored.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >grey.obj
for file in colored.obj colors.obj; do
    differs "the colours of $file" "$(hash $file --size=32)" "$(hash grey.obj --size=32)"
    same "$file without colours" "$(hash $file --size=32 --no-colors)" "$(hash grey.obj --size=32)"
done
same "--color after --no-colors" "$(hash colored.obj --size=32 --no-colors --color=gold)" "$(hash grey.obj --size=32 --color=gold)"
rm -f black.mtl black.obj colored.mtl colors.obj colored.obj grey.obj
lit_gltf() { # TYPE
    printf '%s' '{"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],' \
        '"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],' \
        '"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"extensions":{"KHR_lights_punctual":{"lights":[{"type":"'"$1"'",' \
        '"intensity":900,"color":[1,0,0]}]}},"nodes":[{"mesh":0},{"translation":[0.5,0.5,2],"extensions":{"KHR_lights_punctual":{"light":0}}}]}'
}
lit_gltf directional >lit.gltf
same "a directional light of the file" "$(hash lit.gltf --size=32 --light=file)" "$(hash lit.gltf --size=32 --light=world-directional:0,0,1:1:#f00)"
lit_gltf point >lit.gltf
differs "a point light of the file falls off" "$(hash lit.gltf --size=32 --light=file)" "$(hash lit.gltf --size=32 --light=world-point:0.5,0.5,2:1:#f00)"
rm -f lit.gltf
same "no light and no ambient light is black" "$(hash :teapot --size=64 --light=none --ambient=0 --specular=1)" \
    "$(hash :teapot --size=64 --light=none --ambient=0 --color=red)"
same "a closed surface has no back that shows" "$(hash :sphere --size=64 --samples=1)" \
    "$(hash :sphere --size=64 --samples=1 --cull-back-faces)"
same "specular 0 has no lobe" "$(hash :teapot --size=64 --specular=0 --look=plain)" \
    "$(hash :teapot --size=64 --specular=0 --look=plain --lobe=power)"
same "a lobe needs lights that have one" "$(hash :teapot --size=64 --lobe=power)" \
    "$(hash :teapot --size=64 --lobe=power --look=three-point)"
differs "rays are not depth maps" "$(hash :teapot --size=64 --raytracing)" "$(hash :teapot --size=64)"
differs "a softbox casts a shadow" "$(hash :teapot --size=64 --shadow --occlusion=none)" "$(hash :teapot --size=64 --occlusion=none)"
expect 2 'burnish: --lobe: the look studio has no lights with a lobe; use --look=three-point, or omit the flag' render :sphere --look=studio --lobe=power
same "a turn of 360 degrees and --size" "$(hash :teapot --resolution=64,64 --camera-direction=0,0,-1 --no-ground)" \
    "$(hash :teapot --size=64 --views=front --camera-orthographic=no)"
same "standard views are parallel projections" "$(hash :teapot --size=64 --camera-direction=0,0,-1 --camera-orthographic)" \
    "$(hash :teapot --size=64 --views=front)"
same "STL stands on +Z" "$(hash in/part.v2.stl --size=32)" "$(hash in/part.v2.stl --size=32 --up=+Z)"
# A binary STL file with a header that begins like PLY: the flag selects the format.
{
    printf 'ply\n'
    head -c 76 /dev/zero
    printf '\1\0\0\0'
    head -c 24 /dev/zero # a normal and the corners 0 0 0, 1 0 0, 0 1 0
    printf '\0\0\200\77'
    head -c 12 /dev/zero
    printf '\0\0\200\77'
    head -c 6 /dev/zero
} >in/header.stl
gives 0 render in/header.stl --size=32  # a size that fits says more than a title that begins as a PLY
same "--input-format" "$(hash in/part.v2.stl --size=32)" "$(hash in/header.stl --size=32 --input-format=stl)"

# Sheets.
run render :teapot --views=front,right,top,iso --size=40 --occlusion=8 --json -o sheet.png
check "a sheet's JSON is valid" valid_json
check "a sheet has four cells" [ "$(grep -c '"row":' "$out")" = 4 ]
check "a sheet of four is two cells wide: $(json width)" [ "$(json width)" -ge 80 ]
check "a sheet of four is two cells wide: $(json width)" [ "$(json width)" -lt 120 ]
check "sheet.png" is_png sheet.png "$(json width)" "$(json height)"
front=$(tr -d '\n\t ' <"$out" | sed 's/.*"view":"front"//; s/"view":"right".*//' | grep -o '"hash":"[^"]*' | cut -d'"' -f4)
same "a cell is the picture itself" "$front" "$(hash :teapot --size=40 --views=front)"
labelled=$(hash :teapot --views=front,top --size=40)
differs "--no-labels" "$labelled" "$(hash :teapot --views=front,top --size=40 --no-labels)"
run render :teapot --views=front,top --lobe=power,energy:2,taylor:4 --size=40 --json -o sheet.png
check "views times lobes" [ "$(grep -c '"row":' "$out")" = 6 ]
check "a row a view" [ "$(grep -c '"column":.*2' "$out")" = 2 ]
# One scale: a block of 40 x 20 x 10 measures the same in all cells, and in all runs.
block 40 20 10 >block.obj
# bounds: widths and heights of the silhouettes, one cell after another
bounds() { tr -d ' \n\t' <"$out" | grep -o '"pixel_bounds":\[[0-9,]*' | tr -c '0-9\n' ' ' | awk '{printf "%dx%d ", $3 - $1, $4 - $2}'; }
run render block.obj --views=front,right,top --same-scale --size=100 --margin=0.1 --occlusion=none --json -o s.png
same "silhouettes of one scale" "$(bounds)" "80x40 20x40 80x20 "
same "pixels per unit" "$(grep -c '"pixels_per_unit":[[:space:]]*2,' "$out")" 3
run render block.obj --views=front,right,top --size=100 --margin=0.1 --occlusion=none --json -o s.png
same "silhouettes of three scales" "$(bounds)" "80x40 40x80 80x20 "
run render block.obj --views=front,right,top --camera-orthographic-height=50 --size=100 --occlusion=none --json -o s.png
same "silhouettes of a given scale" "$(bounds)" "80x40 20x40 80x20 "
run render block.obj --camera-direction=1,0,0 --camera-orthographic-height=100 --size=100 --occlusion=none --json -o s.png
same "a scale without a view" "$(bounds)$(json pixels_per_unit)" "10x20 1"
expect 2 'burnish: --camera-orthographic: "x" is not one of yes, no, 1, 0' render block.obj --camera-orthographic=x
run render block.obj --size=16 --json -o s.png
same "a perspective has no scale" "$(json pixels_per_unit)" null
expect 2 'burnish: --same-scale: a perspective has no scale; omit --camera-orthographic=no' render block.obj --same-scale --camera-orthographic=no
expect 2 'burnish: --camera-orthographic-height: a perspective has no scale; omit --camera-orthographic=no' render block.obj --camera-orthographic=0 --camera-orthographic-height=3
expect 2 'burnish: --zoom: --camera-orthographic-height already sets the scale; omit one of them' render block.obj --camera-orthographic-height=3 --zoom=2

# A block that is flat in x and z keeps +Y as its up axis; a sheet on its edge does not.
block 9 7 .1 >sheet.obj
sed '/^f 5/d' sheet.obj >open.obj
up() {
    run render "$@" --size=16 --occlusion=none --json -o s.png
    echo "$(json up) $(json up_source)"
}
same "the format's axis" "$(up sheet.obj --up=format)" "+Y format"
same "a flag's axis" "$(up sheet.obj --up=-X)" "-X flag"
same "a sheet lies down" "$(up sheet.obj)" "+Z auto"
# A bust on a small foot in z leans by up to 18 degrees there, but falls over in y.
printf 'v 1 1 0\nv -1 1 0\nv -1 -1 0\nv 1 -1 0\nv 2 2 5\nv -2 2 5\nv -2 -2 5\nv 2 -2 5\nf 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n' >bust.obj
same "a bust stands" "$(up bust.obj) $(json up_reason)" "+Z auto stability"
same "an open relief stands" "$(up open.obj)" "+Y format"
same "a cut does not turn it" "$(up sheet.obj --clip=0,1,0,0.05)" "+Z auto"
same "a block stands" "$(up block.obj)" "+Y format"
printf 'v 0 0 0\nv 9 0 0\nv 9 7 0\nf 1 2 3\n' >flat.obj
same "a flat drawing does not" "$(up flat.obj)" "+Y format"
face_on=$(hash flat.obj --size=32 --camera-orthographic)
same "a drawing is seen from the front" "$face_on" "$(hash flat.obj --size=32 --views=front)"
check "unless asked otherwise" [ "$face_on" != "$(hash flat.obj --size=32 --camera-orthographic --azimuth=1)" ]
same "a floor is seen from above" "$(hash flat.obj --size=32 --up=+Z --camera-orthographic)" "$(hash flat.obj --size=32 --up=+Z --views=top)"
same "other formats state their axis" "$(up :sphere)" "+Y format"
same "the guess draws what its axis draws" "$(hash sheet.obj --size=32 --up=auto)" "$(hash sheet.obj --size=32 --up=+Z)"

# A tetrahedron that shows one face is turned.
printf 'v 0 -1 1\nv 0 1 1\nv -1 0 -1\nv 1 0 -1\nf 3 2 4\nf 3 4 1\nf 3 1 2\nf 4 2 1\n' >tet.obj
same "a tetrahedron is turned" "$(hash tet.obj --size=32)" "$(hash tet.obj --size=32 --azimuth=-30)"
run render tet.obj --size=16 --json -o s.png
same "a closed surface" "$(json inside_out)" false
sed 's/f \(.\) \(.\) \(.\)/f \1 \3 \2/' tet.obj >tot.obj
run render tot.obj --size=16 --json -o s.png
same "the same, inside out" "$(json inside_out)" true
run render flat.obj --size=16 --json -o s.png
same "a sheet" "$(json inside_out)" null

# Labels beyond ASCII.
expect 2 'burnish: --labels: byte 4, 0xff, is not UTF-8; use UTF-8' render :torus --views=front,top --labels="a,b$(printf '\377')" -o s.png
expect 2 'burnish: --labels: byte 3, 0xc3, is not UTF-8; use UTF-8' render :torus --views=front,top --labels="a,$(printf '\303')" -o s.png
run render :torus --views=front,top --size=60 --font=none.ttf -o s.png
check "a font that is none: exit code $code" [ "$code" = 2 -o "$code" = 3 ]
check "a font that is none: one line" [ "$(wc -l <"$err")" = 1 ]
umlaut=$(printf 'K\303\266rper')
gives 0 render :torus --views=front,top --size=60 --occlusion=none --labels="$umlaut,b" --json -o s.png  # labels beyond ASCII
if [ ! -s "$err" ]; then # where there is a font
    differs "a font has the letter" "$(json hash)" "$(hash :torus --views=front,top --size=60 --occlusion=none --labels="K?rper,b")"
else
    check "without a font: one warning" [ "$(wc -l <"$err")" = 1 ]
    same "without a font: ?" "$(json hash)" "$(hash :torus --views=front,top --size=60 --occlusion=none --labels="K?rper,b")"
fi

# Annotations: each changes the picture, and none the brightness in the report.
bare=$(hash block.obj --size=200 --camera-orthographic)
for kind in axes box dimensions scale grid axes,grid,scale; do
    differs "--annotate=$kind" "$bare" "$(hash block.obj --size=200 --camera-orthographic --annotate=$kind)"
done
same "annotations leave no trace in the report" "$(run render block.obj --size=200 --annotate=grid,dimensions --json -o s.png; json near_black)" 0
expect 0 'burnish: warning: block.obj: the picture has no room for 3 of the annotations; enlarge the picture or its margin' render block.obj --size=60 --zoom=4 --annotate=dimensions -o s.png
expect 0 'burnish: warning: block.obj: --annotate: scale: a perspective has no scale, so the picture has no bar; use --camera-orthographic, or omit it' \
    render block.obj --views=front --camera-orthographic=no --annotate=scale -o s.png
calibrated="block.obj --size=60 --camera-position=9,9,9 --camera-intrinsics=90,90,9,9"
run render $calibrated --json -o s.png
check "the report has intrinsics" grep -q '"intrinsics":.*90, 90, 9, 9' "$out"
same "no annotations at calibrated cameras" "$(hash $calibrated)" "$(hash $calibrated --annotate=box 2>/dev/null)"
expect 2 'burnish: --annotate: "ruler" is not one of axes, box, dimensions, scale, grid, none' render block.obj --annotate=axes,ruler

# Several inputs in one scene: the picture of one file with the same contents.
mkdir sub
block 1 2 3 >sub/a.obj
block 4 1 1 >b.obj
{ cat sub/a.obj && awk '/^f/ { $0 = "f " $2 + 8 " " $3 + 8 " " $4 + 8 " " $5 + 8 } { print }' b.obj; } >both.obj
both=$(hash both.obj --size=60 --up=+Y)
same "--scene" "$both" "$(hash sub/a.obj b.obj --scene --size=60)"
check "the report lists parts" [ "$(grep -c '"name":.*"[ab]"' "$out")" = 2 ]
printf '{"burnish_scene": 1, "items": [{"file": "sub/a.obj"}, {"file": "b.obj"}]}' >s.scene.json
same "a scene file" "$both" "$(hash s.scene.json --size=60)"
run batch s.scene.json -d made --size=60 --max-memory=8000000000G # which a sanitizer bears
run render s.scene.json --size=60 -o s.png
check "a batch" cmp s.png made/s.scene.png
run compare s.scene.json both.obj --up=+Y --size=60
check "compared: $(cat "$err")" [ "$code" = 0 ]
gives 0 info sub/a.obj b.obj --scene
check "facts of all" grep -q '^sub/a.obj (scene): 24 triangles' "$out"
expect 2 'burnish: --scene: sub: is a folder; name its files' render b.obj sub --scene -o s.png
expect 2 'burnish: --scene: :knot: is no file; only files can be joined' render b.obj :knot --scene -o s.png
expect 2 'burnish: --root: b.obj: does not contain the input; name a folder above it' render sub/a.obj b.obj --scene --root=sub -o s.png
expect 0 'burnish: warning: --joint: no effect: only robots (URDF) have joints; omit the flag' render b.obj --joint=a:1 --size=16 -o s.png
expect 2 'burnish: --joint: "a=1" is not NAME:VALUE, such as elbow:0.5' render b.obj --joint=a=1 -o s.png
rm -r sub made b.obj both.obj s.scene.json

run render :teapot --lobe=power,schlick,energy:2,taylor:2 --columns=4 --size=40 --json -o sheet.png
check "four columns" [ "$(json width)" -ge 160 ]

finish
