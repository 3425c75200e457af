#!/bin/sh
# burnish compare: exit codes, numbers, both kinds of inputs, one camera, the picture.
# usage: cli_compare.sh BURNISH SCRATCH
. "$(dirname "$0")/lib.sh"

away='--camera-position=100,0,0 --camera-focal-point=200,0,0 --quiet'
flat() { "$burnish" render :sphere $away --size=64 --background-color="$1" -o "$2" || fail "render $2"; }
flat '#646464' a.png
flat '#676767' b.png
run compare a.png a.png
if grep -q 'built without libpng' "$err"; then
    echo "cli_compare: this burnish reads no pictures"
    exit 77
fi
check "the same picture: exit code $code, $(cat "$out" "$err")" [ "$code" = 0 ]
check "it says so" grep -q '^a.png and a.png, 64 x 64 pixels: the same$' "$out"

# Two greys: all numbers are known.
gives 10 compare a.png b.png --json
check "the JSON is valid" valid_json
check "nothing on standard error" [ ! -s "$err" ]
for pair in passes:false different_pixels:4096 different_share:1 different_bounds:0,0,64,64 largest_difference:3,3,3,0 \
    mean_difference:3,3,3,0 mean_squared_error:9 tolerance:0 threshold:null metric:ssim silhouette_iou:null output:null; do
    [ "$(json "${pair%%:*}")" = "${pair#*:}" ] || fail "${pair%%:*} is $(json "${pair%%:*}")"
done
check "PSNR is 20 log10(255 / 3): $(json psnr)" sh -c "echo $(json psnr) | grep -q '^38\.58837'"
check "SSIM of two greys: $(json ssim)" sh -c "echo $(json ssim) | grep -q '^0\.99956'"
passes() {
    gives 0 compare a.png b.png "$@"
}
fails() {
    gives 10 compare a.png b.png "$@"
}
echo old >old
gives 2 compare a.png b.png -o old
gives 10 compare a.png b.png -qo old --overwrite
check "--quiet prints nothing, --overwrite replaces: $(cat "$out" "$err")" [ ! -s "$out" -a ! -s "$err" -a "$(png_size old | wc -w)" = 2 ]
rm -f old
passes --tolerance=3
fails --tolerance=2
passes --threshold=0.001
fails --threshold=0.0001
fails --threshold=0.5 --metric=pixels
passes --threshold=1 --metric=pixels
fails --threshold=0.01 --metric=flip
passes --threshold=0.1 --metric=flip

# Meshes: the camera frames both, the reported facts differ, and a mesh equals its own picture.
"$burnish" render :teapot --size=48 -o teapot.png
gives 0 compare :teapot teapot.png --json  # a mesh and its picture
check "a mesh and its picture have one silhouette: $(json silhouette_iou)" [ "$(json silhouette_iou)" = 1 ]
"$burnish" compare :teapot :teapot --size=48 -o both.png
"$burnish" compare :teapot :teapot --size=48 --no-ground -o apart.png
"$burnish" compare :teapot :teapot --size=48 --ground -o ground.png
check "two meshes have no ground" cmp -s both.png apart.png
check "two meshes on a ground" [ "$(cmp -s both.png ground.png; echo $?)" = 1 ]
gives 10 compare :sphere :torus --size=64 --json=both.json -o both.png
check "no text beside JSON" [ ! -s "$out" ]
cp both.json "$out"
check "JSON in a file is valid" valid_json
check "one camera" [ "$(tr -d '\n\t ' <both.json | grep -o '"camera":{[^}]*}' | sort -u | wc -l)" = 1 ]
check "the torus is whole: $(json different_bounds)" sh -c "echo $(json different_bounds) | awk -F, '{exit !(\$1 > 1 && \$3 < 63)}'"
check "facts" grep -q '"volume":.*3.15' both.json
check "the picture is a PNG" [ "$(od -An -tx1 -N8 both.png | tr -d ' ')" = 89504e470d0a1a0a ]
run compare :sphere :torus --size=64 --look=plain
check "text names what differs in the meshes" grep -q '^  triangles  *12288 and 16384$' "$out"
gives 0 compare :sphere :sphere --size=32  # the same mesh
check "the same mesh: facts" grep -q 'the meshes have the same size' "$out"
run compare :sphere :sphere --tessellation=8 --size=32
for isa in scalar auto; do
    "$burnish" compare :sphere :knot --size=40 --isa=$isa --threads=3 --json=$isa.json
done
check "every instruction set has the same numbers" cmp scalar.json auto.json

# The same mesh in two formats with different up axes: both use the axis of the first.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\n' >corner.obj
{
    echo solid corner
    for points in '0 0 0,1 0 0,0 1 0' '0 0 0,1 0 0,0 0 1' '0 0 0,0 1 0,0 0 1'; do
        echo facet normal 0 0 0 outer loop
        echo "$points" | tr , '\n' | sed 's/^/vertex /'
        echo endloop endfacet
    done
    echo endsolid corner
} >corner.stl
gives 0 compare corner.stl corner.obj --size=64  # two formats, A is STL
check "they are the same" grep -q 'corner.stl and corner.obj, 64 x 64 pixels: the same' "$out"
gives 0 compare corner.obj corner.stl --size=64 --json  # two formats, A is OBJ
check "both with A's up: $(json up)" [ "$(tr -d '\n\t ' <"$out" | grep -o '"up":"[^"]*"' | sort -u)" = '"up":"+Y"' ]
run compare corner.obj corner.stl --size=64 --json --up=+X
check "both with the flag's up" [ "$(tr -d '\n\t ' <"$out" | grep -o '"up":"[^"]*"' | sort -u)" = '"up":"+X"' ]

# One mesh, two lobes.
gives 10 compare :teapot --lobe=power,energy:2 --size=64 --specular=0.9 --json
check "lobes are named" grep -q '"lobe":.*"power"' "$out"
check "lobes: the silhouettes are one: $(json silhouette_iou)" [ "$(json silhouette_iou)" = 1 ]
gives 0 compare :teapot --lobe=power,power --size=64  # the same lobe

# The panels: three of them, enlarged; the map of FLIP is another picture.
run compare a.png b.png -o codes.png
check "three panels of 320 pixels: $(png_size codes.png)" [ "$(png_size codes.png | cut -d " " -f 1)" -gt 960 ]
run compare a.png b.png -o flip.png --map=flip
check "the maps differ" sh -c "! cmp -s codes.png flip.png"
"$burnish" compare a.png b.png -o - >piped.png
check "a picture on standard output" cmp piped.png codes.png

# Pipes tell what they carry.
"$burnish" render :teapot --size=48 -o - | "$burnish" compare teapot.png - >"$out" 2>&1
check "a picture from a pipe: $(cat "$out")" grep -q 'teapot.png and -, 48 x 48 pixels: the same' "$out"
printf 'solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid x\n' >part.stl
"$burnish" compare part.stl - --size=32 <part.stl >"$out" 2>&1
check "a mesh from a pipe: $(cat "$out")" grep -q 'the same' "$out"

# --align: B at another place; far away too, and only its place is changed.
block 1 2 3 >here.obj
awk '$1 == "v" { $2 += 64; $3 -= 8; $4 += 0.5 } 1' here.obj >there.obj
awk '$1 == "v" { $2 += 4194304; $3 -= 8 } 1' here.obj >far.obj
run compare here.obj there.obj --size=64
check "a hint: exit code $code, $(cat "$out")" sh -c "[ $code = 10 ] && grep -q 'A and B are at different places; --align moves B onto A' '$out'"
for moved in there.obj:-64,8,-0.5 far.obj:-4194304,8,0; do
    gives 0 compare here.obj "${moved%:*}" --align --size=64 --json
    same "moved" "$(json moved) $(json different_pixels)" "${moved#*:} 0"
done
run compare here.obj there.obj --align --size=64
check "the text says so: $(cat "$out")" grep -q 'B is moved by *-64, 8, -0.5$' "$out"
expect 2 'burnish: --align: needs two meshes, B in a file; omit the flag' compare here.obj teapot.png --align
rm -f here.obj there.obj far.obj

# render --reference.
expect 0 '' render :teapot --size=48 --reference=teapot.png -o again.png
expect 10 'burnish: teapot.png: the picture has 47 x 47 pixels, the reference 48 x 48' render :teapot --size=47 --reference=teapot.png -o again.png
gives 10 render :teapot --size=48 --color=red --reference=teapot.png --reference-difference=panels.png --json -o red.png  # a red teapot
check "one line says how it differs: $(cat "$err")" grep -qx 'burnish: teapot.png: the picture differs: error 0\.[0-9]*, allowed 0; [0-9]* of 2304 pixels in [0-9, to]*, SSIM 0\.[0-9]*, FLIP 0\.[0-9]*' "$err"
check "the report is valid" valid_json
check "the report has the numbers" grep -q '"passes":.*false' "$out"
check "the picture is written" [ -s red.png -a -s panels.png ]
error=$(json error | tail -1) # after the message
"$burnish" compare teapot.png red.png --json >"$out"
check "compare has the same error: $(json error), $error" [ "$(json error)" = "$error" ]
expect 0 '' render :teapot --size=48 --color=red --reference=teapot.png --reference-threshold="$error" -o again.png
expect 2 'burnish: --output: "teapot.png" is an input; name another file' render :teapot --reference=teapot.png -o teapot.png
expect 2 'burnish: --reference-difference: "again.png" is used for another file; choose another name' render :teapot --reference=teapot.png --reference-difference=again.png -o again.png
expect 3 "burnish: none.png: can't be opened: No such file or directory" render :teapot --reference=none.png -o again.png

# What is wrong is said in a line.
expect 10 'burnish: a.png has 64 x 64 pixels, teapot.png 48 x 48: nothing else was compared' compare a.png teapot.png
expect 2 'burnish: compare: no A and B; try "burnish compare before.png after.png" or "burnish compare --help"' compare
expect 2 'burnish: compare: only one input, "a.png"; name another one, or two lobes, such as --lobe=power,energy:2' compare a.png
expect 2 'burnish: compare: a.png is a picture, which has no lobes; name another picture or a mesh' compare a.png --lobe=power,lyon:2
expect 2 'burnish: --lobe: 2 lobes for two inputs; use one lobe, or two lobes and one input' compare :torus :sphere --lobe=power,energy:2
expect 2 'burnish: --views: 2 views; only one view can be compared' compare :torus :sphere --views=front,top
expect 2 'burnish: --resolution: teapot.png has 48 x 48 pixels; leave the flag out' compare :teapot teapot.png --size=50
expect 2 'burnish: --output: "a.png" is an input; name another file' compare a.png b.png -o a.png
expect 2 'burnish: --json: "both.png" is the picture; name another file' compare a.png b.png -o both.png --json=both.png
expect 2 'burnish: compare: both are standard input; name a file for one of them' compare - -
expect 3 "burnish: none.png: can't be opened: No such file or directory" compare none.png a.png
printf 'not a picture' >text.png
expect 4 'burnish: text.png: not a PNG file; convert the picture to PNG' compare text.png a.png
gives 2 compare a.png b.png --columns=2  # flags of sheets are none of compare
gives 2 compare a.png b.png --threshold=2  # a threshold above 1

finish
