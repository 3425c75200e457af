#!/bin/sh
# burnish info as a user sees it: text, JSON, exit codes, one line per error.
# usage: cli_info.sh BURNISH SCRATCH
. "$(dirname "$0")/lib.sh"

# A box from 0 to 1, 2, 3 as ASCII STL. box [SED SCRIPT]
box() {
    {
        echo solid box
        while read -r a b c; do
            echo facet normal 0 0 0 outer loop
            for point in $a $b $c; do
                echo "vertex $(echo "$point" | sed 's/,/ /g')"
            done
            echo endloop endfacet
        done <<'END'
0,0,0 0,0,3 0,2,3
0,0,0 0,2,3 0,2,0
1,0,0 1,2,0 1,2,3
1,0,0 1,2,3 1,0,3
0,0,0 1,0,0 1,0,3
0,0,0 1,0,3 0,0,3
0,2,0 0,2,3 1,2,3
0,2,0 1,2,3 1,2,0
0,0,0 0,2,0 1,2,0
0,0,0 1,2,0 1,0,0
0,0,3 1,0,3 1,2,3
0,0,3 1,2,3 0,2,3
END
        echo endsolid box
    } | sed "${1:-}"
}

box >box.stl
gives 0 info box.stl
check "silent on standard error" [ ! -s "$err" ]
cat >expected.txt <<'END'
box.stl (stl): 12 triangles, 8 vertices, 1 material

  size                  1 x 2 x 3
  from                  0, 0, 0
  to                    1, 2, 3
  up                    +Z, the axis of the format: stable up to 18 degrees on +Z, stable up to 27 degrees on +Y
  normals               generated
  area                  22
  volume                6
  centre of mass        0.5, 1, 1.5 (of the solid)

  closed                yes
  consistent winding    yes
  shells                1
  edges                 18
  open edges            0
  non-manifold edges    0
  inconsistent edges    0
  flipped triangles     0
  unorientable parts    0
  degenerate triangles  0
  duplicate triangles   0
END
check "text: $(diff "$out" expected.txt | head -3 | tr '\n' ' ')" cmp "$out" expected.txt

# Points and lines: their number and the box of their positions, nothing about the solids that are drawn for them.
printf 'v 0 0 0\nv 1 0 2\nv 0 3 1\n' >points.obj
run info points.obj
printf 'points.obj (obj): 3 points, 1 material\n\n  size                  1 x 3 x 2\n' >expected.txt
printf '  from                  0, 0, 0\n  to                    1, 3, 2\n  up                    +Y, the axis of the format\n' >>expected.txt
check "points: $(diff "$out" expected.txt | head -3 | tr '\n' ' ')" cmp "$out" expected.txt
run info points.obj --json
for wanted in triangles:0 vertices:null points:3 lines:0 min:0,0,0 max:1,3,2 size:1,3,2 area:null volume:null \
    center_of_mass:null solid:null closed:null consistent_winding:null shells:null open_edges:null; do
    same "points: ${wanted%%:*}" "$(json "${wanted%%:*}")" "${wanted#*:}"
done
check "JSON of points is valid" valid_json
run render points.obj --size=16 --json -o points.png
check "render reports the same box" [ "$(json min) $(json max) $(json points)" = "0,0,0 1,3,2 3" ]
printf 'v 0 0 0\nv 1 0 2\nl 1 2\n' >lines.obj
run info lines.obj
check "a line: $(head -1 "$out")" grep -qx 'lines.obj (obj): 1 line, 1 material' "$out"
expect 0 '' render lines.obj --clip=1,0,0,0.5 --size=16 -o points.png
run compare points.obj lines.obj --size=16 --json
check "compare: $(json size_y), $(json volume)" grep -q '"vertices":[[:space:]]*null' "$out"

# One vertex differs in its last digit: the mesh counts as closed, and the report shows the tolerance.
box '0,/vertex 1 2 3/s//vertex 1.0000005 2 3/' >rounded.stl
run info rounded.stl
check "closed by joining: $(grep closed "$out")" grep -qx '  closed                yes, with vertices within 3e-06 joined (4 open edges without)' "$out"
check "its volume means something: $(grep volume "$out")" grep -qx '  volume                6' "$out"
run info rounded.stl --json
for wanted in closed:true open_edges:0 exact_open_edges:4 edges:18 vertices:9 solid:true; do
    same "joined: ${wanted%%:*}" "$(json "${wanted%%:*}")" "${wanted#*:}"
done
check "the tolerance: $(json join_tolerance)" [ "$(json join_tolerance)" = 3e-06 ]
run render rounded.stl --clip=0,0,1,1 --size=16 --json -o cut.png
check "a cut of it is filled: $(cat "$err")" [ "$(json filled)" = true ]

# JSON: valid, the keys of the manual, the values.
run info box.stl --json
check "JSON is valid" valid_json
for wanted in input:box.stl format:stl triangles:12 vertices:8 points:0 lines:0 materials:1 min:0,0,0 max:1,2,3 size:1,2,3 area:22 \
    volume:6 center_of_mass:0.5,1,1.5 solid:true closed:true consistent_winding:true shells:1 edges:18 open_edges:0 join_tolerance:0 exact_open_edges:0 \
    non_manifold_edges:0 inconsistent_edges:0 flipped_triangles:0 unorientable_parts:0 degenerate_triangles:0 \
    duplicate_triangles:0 warnings:; do
    same "${wanted%%:*}" "$(json "${wanted%%:*}")" "${wanted#*:}"
done
tr -d '\n\t ' <"$out" | grep -oE '"[a-z0-9_]+":' | tr -d '":' | sort -u >written.txt
"$burnish" help --man | tr -d '\\' | awk '/^.SH/ { on = /FACTS IN JSON/ } on' |
    grep -o 'fB[a-z_, ]*fR' | sed 's/^fB//; s/fR$//' | tr ', ' '\n\n' | grep . | sort -u >told.txt
check "JSON keys and the manual differ: $(diff written.txt told.txt | grep '^[<>]' | tr '\n' ' ')" cmp written.txt told.txt

cp "$out" printed.json
expect 0 '' info box.stl --json=facts.json
check "the same in a file" cmp facts.json printed.json

# Material variants.
cat >variants.gltf <<END
{"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAA"}],
"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"materials":[{},
{"extensions":{"KHR_materials_unlit":{}},"pbrMetallicRoughness":{"baseColorFactor":[1,0,0,1]}}],"extensions":{"KHR_materials_variants":{"variants":
[{"name":"plain"},{"name":"deep red"}]}},"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0,"extensions":
{"KHR_materials_variants":{"mappings":[{"material":1,"variants":[1]}]}}}]}],"nodes":[{"mesh":0}]}
END
run info variants.gltf
check "variants: $(cat "$out")" grep -qx '  variants              plain, deep red' "$out"
run info variants.gltf --json
check "variants in JSON: $(cat "$out")" grep -q '"variants":[[:space:]]*\["plain",[[:space:]]*"deep red"\]' "$out"
run render variants.gltf --size=16 --json -o v.png
without=$(json hash)
run render variants.gltf --size=16 --json -o v.png --variant="deep red"
check "a variant changes the picture" [ "$(json hash)" != "$without" ]
expect 2 'burnish: variants.gltf: variant "red" does not exist; the file has plain, deep red' render variants.gltf --variant=red

# Light that passes through glass.
sed 's/KHR_materials_unlit":{}/KHR_materials_transmission":{"transmissionFactor":1}/' variants.gltf >glass.gltf
run info glass.gltf --json
check "transmissive materials: $(cat "$out")" grep -q '"transmissive":[[:space:]]*1' "$out"

# What is wrong with a surface is said.
box '/^facet/{N;N;N;N;/vertex 0 0 3\nvertex 1 0 3\nvertex 1 2 3/d;}' >open.stl
run info open.stl
check "an open surface: $(cat "$out")" grep -q '^  volume  .* (meaningless: the surface is not closed)$' "$out"
check "the centre of an open surface" grep -q '^  centre of mass .* (of the surface)$' "$out"
run info open.stl --json
same "11 triangles" "$(json triangles)" 11
same "three open edges" "$(json open_edges)" 3
same "closed" "$(json closed)" false
box '/^vertex/{h;N;N;s/\(.*\)\n\(.*\)\n\(.*\)/\1\n\3\n\2/;}' >inward.stl
run info inward.stl
check "inside out: $(grep volume "$out")" grep -q '^  volume  *-6 (inside out: ' "$out"

# Warnings.
{
    box '/endsolid/d'
    echo facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 0 0 vertex 0 0 1 endloop endfacet endsolid box
} >flat.obj
run info flat.obj
check "a warning: $(cat "$err")" grep -qx 'burnish: warning: flat.obj: the file is STL, not OBJ as its name says' "$err"
check "a degenerate triangle" grep -qx '  degenerate triangles  1' "$out"
run info flat.obj --json --quiet
check "--quiet" [ ! -s "$err" ]
check "a warning in JSON" grep -q '"warnings":.*the file is STL' "$out"

# Lines beside faces do not count for the facts of the faces.
printf '%s' '{"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],' \
    '"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],' \
    '"meshes":[{"primitives":[{"attributes":{"POSITION":0}},{"attributes":{"POSITION":0},"mode":2}]}],"nodes":[{"mesh":0}]}' >lines.gltf
run info lines.gltf --json
same "lines beside faces" "$(json lines) $(json triangles) $(json area) $(json size) $(json open_edges)" "3 1 0.5 1,1,0 3"
run info lines.gltf --max-triangles=30 --json # as tetrahedra
same "room for thin lines" "$(json lines) $(json warnings)" "3 "
run info lines.gltf --max-triangles=9
check "too many lines: $(cat "$err")" grep -qx 'burnish: warning: lines.gltf: 3 lines and points are not drawn, as they are too many for a file with triangles; thin them out, or export them alone' "$err"
rm -f lines.gltf

# INPUT as render takes it.
"$burnish" info - --json <box.stl | sed '/"input"/d' >piped.json
run info box.stl --json --threads=3
check "from a pipe, with three threads" sh -c "sed '/\"input\"/d' '$out' | cmp - piped.json"
cp box.stl box.bin
run info box.bin --input-format=stl --json
same "--input-format" "$(json volume)" 6
run info :torus --tessellation=3 --json
same "--tessellation" "$(json triangles)" 576
rm -f ./*

# Far from the origin: same picture and size as at the origin; coordinates, also in flags, are those of the file.
get() { sed -n "s/^.*\"$1\":[[:space:]]*//p" "$2" | sed 's/,$//;q'; } # KEY FILE
moved() { # X Y Z
    for p in '0 0 0' '1 0 0' '0 2 0' '0 0 3'; do
        echo "$p" | awk -v x="$1" -v y="$2" -v z="$3" '{printf "v %.6f %.6f %.6f\n", $1 + x, $2 + y, $3 + z}'
    done
    printf 'f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n'
}
moved 0 0 0 >near.obj
moved 500000 4100000.5 -300 >far.obj
run info far.obj --json
same "far from the origin: from" "$(json min)" 500000,4100000.5,-300
same "far from the origin: to" "$(json max)" 500001,4100002.5,-297
same "far from the origin: volume" "$(json volume)" 1
same "one line for one input" "$(wc -l <"$out")" 1
for where in near:9,8,7:1.5 far:500009,4100008.5,-293:-298.5; do
    name=${where%%:*} rest=${where#*:}
    run render "$name.obj" --size=64 --camera-position="${rest%:*}" --clip=0,0,1,"${rest#*:}" -o "$name.png" --json="$name.json"
done
check "far from the origin: the same picture" [ "$(get hash near.json)" = "$(get hash far.json)" ]
check "far from the origin: the camera" [ "$(get position far.json)" = "[500009, 4100008.5, -293]" ]
check "far from the origin: the cut" [ "$(get cuts far.json)" = "[[0, 0, 1, -298.5]]" ]
"$burnish" render - --size=64 --camera-position=500009,4100008.5,-293 --clip=0,0,1,-298.5 -o stream.png --json=far.json <far.obj
check "far from the origin: a stream" [ "$(get hash near.json)" = "$(get hash far.json)" ]
moved 500000.3 4100000.5 -300 >beside.obj
gives 10 compare far.obj beside.obj --size=64 --json=far.json  # far from the origin: what lies 0.3 beside it is elsewhere
check "far from the origin: and is no larger" [ "$(grep -c '"size_x":[[:space:]]*1,' far.json)" = 2 ]
rm -f ./*

# Errors.
expect 2 'burnish: info: no INPUT; try "burnish info :teapot" or "burnish info --help"' info
# Many inputs: failures do not end the run.
mkdir -p many/sub
box >many/box.stl
box >many/sub/deep.stl
echo junk >many/bad.stl
run info many --csv
check "a folder: exit code $code" [ "$code" = 11 ]
check "CSV: a header and two rows" [ "$(wc -l <"$out")" = 3 ]
check "CSV: a box" grep -q '^many/box.stl,stl,12,8,0,0,1,,1,2,3,+Z,generated,22,6,yes,yes,yes,1,18,0,' "$out"
check "CSV: a failure" grep -q '^many/bad.stl,,.*,"\{0,1\}many/bad.stl: ' "$out"
check "the failures are counted" grep -q '^burnish: 1 of 2 failed$' "$err"
run info many many/box.stl -r --json --quiet
check "JSON lines" [ "$(grep -c '^{"burnish":.*"volume":6,.*}$' "$out")" = 3 ]
check "JSON lines: a failure" [ "$(grep -c '^{"input":"many/bad.stl","error":' "$out")" = 1 ]
printf 'many/box.stl\nmany/sub/deep.stl\n' >names.txt
gives 0 info --files-from=names.txt
check "text: two blocks" [ "$(grep -c '12 triangles, 8 vertices' "$out")" = 2 ]
expect 2 'burnish: --csv: not with --json; omit one of them' info many --csv --json
rm -r many names.txt
expect 3 "burnish: none.stl: can't be opened: No such file or directory" info none.stl
box '/endsolid/d;$d' | head -12 >../broken.stl
expect 4 "$("$burnish" render ../broken.stl 2>&1)" info ../broken.stl
run info ../broken.stl
check "a broken file: one line" [ "$(wc -l <"$err")" = 1 ]
rm ../broken.stl
gives 5 info :sphere --max-triangles=3  # too many triangles
expect 7 "burnish: none/r.json: can't be written: No such file or directory; create the folder first" info :torus --json=none/r.json
"$burnish" info :sphere >/dev/full 2>"$err"
check "a full device: 7" [ $? = 7 ]
nothing_left "info"

finish
