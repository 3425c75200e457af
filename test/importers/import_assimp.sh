#!/bin/sh
# burnish-import-assimp over the files of Debian's assimp-testmodels, whole and damaged.
# Usage: import_assimp.sh PROGRAM FOLDER        (the importer is in the program's folder)
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../cli/lib.sh"
models=/usr/share/assimp/models
[ -d $models ] || {
    echo "import_assimp: no $models; scripts/install-deps importers"
    exit 77
}
unset BURNISH_IMPORTERS

# holds FILE TRIANGLES UP: the results of info and render.
holds() {
    run info "$models/$1" --json
    check "$1: $(json triangles) triangles, not $2: $(cat "$err")" [ "$(json triangles)" = "$2" ]
    run render "$models/$1" --size=100 --json --quiet -o p.png
    check "$1: up is $(json up), not $3" [ "$(json up)" = "$3" ]
    check "$1: something is seen" [ "$(json covered_pixels)" -gt 100 -a "$(json blank)" = false ]
    run render "$models/$1" --size=100 --sandbox --quiet -o q.png
    check "$1: the same in a sandbox: $(cat "$err")" cmp -s p.png q.png
    rm -f p.png q.png
}
holds FBX/box.fbx 12 +Y
holds FBX/spider.fbx 1368 +Y
holds Collada/duck.zae 4212 +Y
holds 3DS/fels.3ds 768 +Y
holds BLEND/HUMAN.blend 8560 +Z
holds DXF/wuson.dxf 3732 -Z
holds BLEND/BlenderDefault_250.blend 12 +Z
holds Collada/cube_UTF16LE.dae 12 +Y

# Colours of materials and vertices, and a texture that the archive holds.
hash() { # FLAGS
    run render "$@" --size=64 --json --quiet -o p.png
    rm -f p.png
    json hash
}
check "a texture in the file is drawn" [ "$(hash $models/Collada/duck.zae)" != "$(hash $models/Collada/duck.zae --no-textures)" ]
check "materials have colours" [ "$(hash $models/FBX/cubes_with_names.fbx)" != "$(hash $models/FBX/cubes_with_names.fbx --color=1,1,1)" ]

run info $models/FBX/cubes_with_names.fbx --quiet
check "parts have the names of nodes: $(cat "$out")" grep -q '^  part 3  *"Cube3", solid' "$out"

# A shininess below 1 is a share of 128, and fainter.
for shine in 0.125 0; do
    sed '/<shininess/,/<\/shininess/s/>16</>'$shine'</' $models/Collada/cube_UTF8BOM.dae >shine$shine.dae
done
check "a share has a highlight" [ "$(hash shine0.125.dae)" != "$(hash shine0.dae)" ]
sed '/<float_array/s/>-*[0-9.]* />nan /' $models/Collada/cube_UTF8BOM.dae >nan.dae
run info nan.dae --quiet --json
check "a corner that is not a number costs its triangles" grep -q '"degenerate_triangles":6' "$out"
rm -f shine*.dae nan.dae

check "coordinates that the file leaves to be made" \
    [ "$(hash $models/LWO/LWO2/MappingModes/earth_spherical_y.lwo)" != "$(hash $models/LWO/LWO2/MappingModes/earth_spherical_y.lwo --no-textures)" ]
run render $models/LWO/LWO2/MappingModes/earth_spherical_y.lwo --size=32 -o p.png
check "no warning of them: $(cat "$err")" [ ! -s "$err" ]
run info $models/X3D/HelloWorld.x3d
check "of a list of names the first: $(cat "$err")" sh -c "! grep -q '\"http' '$err'"
# libassimp's default grey has an alpha of 0.6, but DXF has no opacity
inside="$models/DXF/wuson.dxf --views=left --zoom=12"
check "DXF is opaque" [ "$(hash $inside --background-color=1,0,0)" = "$(hash $inside --background-color=0,0,1)" -a -n "$(json hash)" ]
rm -f p.png

# burnish's grey replaces libassimp's invented default colours; colours in the file are drawn.
printf 'v 0 0 0\nv 1 0 0\nv 0 0 -1\nf 1 2 3\n' >grey.obj
printf '0\nSECTION\n2\nENTITIES\n0\n3DFACE\n8\n0\n10\n0\n20\n0\n30\n0\n11\n1\n21\n0\n31\n0\n12\n0\n22\n1\n32\n0\n13\n0\n23\n1\n33\n0\n0\nENDSEC\n0\nEOF\n' >grey.dxf
check "DXF without colours" [ "$(hash grey.dxf)" = "$(hash grey.obj --up=-Z)" ]
holds Q3D/earth.q3o 2937 +Z
nff() { # COLOUR UP
    printf 'v\nfrom 0 -5 0\nat 0 0 0\nup %s\nangle 40\nhither 1\nresolution 9 9\n' "$2"
    printf 'f %s 1 0 0 0 0\np 3\n0 0 0\n1 0 0\n0 1 0\n' "$1"
}
nff '1 0 0' '0 1 0' >red.nff
nff '0 1 0' '0 0 1' >green.nff
check "materials of NFF" [ "$(hash red.nff --up=+Y)" != "$(hash green.nff --up=+Y)" ]
hash green.nff >/dev/null
check "NFF says what is up: $(json up)" [ "$(json up)" = +Z ]
hash red.nff >/dev/null
check "it may be Y: $(json up)" [ "$(json up)" = +Y ]
glowing() { # EMISSIVE: a .x with a black texture
    printf 'xof 0303txt 0032\nMesh m {\n 3;\n 0;0;0;,\n 1;0;0;,\n 0;1;0;;\n 1;\n 3;0,2,1;;\n MeshTextureCoords {\n 3;\n 0;0;,\n 0;1;,\n 1;0;;\n }\n'
    printf 'MeshMaterialList {\n 1;\n 1;\n 0;;\n Material a {\n 1;1;1;1;;\n 0;\n 0;0;0;;\n %s;;\n TextureFilename { "black.png"; }\n }\n }\n}\n' "$1"
}
python3 -c "
import struct, sys, zlib
def chunk(name, data):
    return struct.pack('>I', len(data)) + name + data + struct.pack('>I', zlib.crc32(name + data))
sys.stdout.buffer.write(b'\\x89PNG\\r\\n\\x1a\\n' + chunk(b'IHDR', struct.pack('>IIBBBBB', 1, 1, 8, 2, 0, 0, 0)) +
                        chunk(b'IDAT', zlib.compress(bytes(4))) + chunk(b'IEND', b''))" >black.png
glowing '0;0;0' >dark.x
glowing '1;1;1' >bright.x
check "light of a material goes through its texture" [ "$(hash dark.x)" = "$(hash bright.x)" ]
check "it is there without: $(hash bright.x --no-textures)" [ "$(hash dark.x --no-textures)" != "$(hash bright.x --no-textures)" ]
rm -f grey.* red.nff green.nff dark.x bright.x black.png

# blend NAME SAVER HEAD: a file of a newer Blender.
blend() {
    { printf "$3" && head -c 200 /dev/zero; } >"$1.blend"
    expect 4 "burnish: $1.blend: burnish-import-assimp: Blender $2 it, and libassimp can't read it; export it from Blender as glTF" info "$1.blend"
}
blend four '4.2 saved' 'BLENDER-v402REND'
blend five '5.x saved' 'BLENDER17-01v0500REND'
blend zstd '3.0 or later compressed' '\050\265\057\375'
rm four.blend five.blend zstd.blend
printf '<?xml version="1.0"?><amf/>' >part.amf
expect 4 "burnish: part.amf: an AMF file, which burnish can't read; convert it to one of gltf, obj, off, ply, stl, 3mf, gcode, splat, spz, bms, scene, urdf, pcd, las, xyz" info part.amf
rm part.amf

# Packed, and damaged so.
gzip -c $models/FBX/box.fbx >BOX.FBX.GZ
check "gzip" [ "$(hash BOX.FBX.GZ)" = "$(hash $models/FBX/box.fbx)" ]
check "gzip in a sandbox" [ "$(hash BOX.FBX.GZ --sandbox)" = "$(hash $models/FBX/box.fbx)" ]
head -c 2000 BOX.FBX.GZ >cut.fbx.gz
expect 4 "burnish: cut.fbx.gz: burnish-import-assimp: gzip: byte 2000: the gzip file is truncated" info cut.fbx.gz
head -c 70000000 /dev/zero | gzip >large.fbx.gz
expect 5 "burnish: large.fbx.gz: burnish-import-assimp: gzip: its $(wc -c <large.fbx.gz) bytes unpack to more than 67108864; unpack it first if that is right" info large.fbx.gz
run batch . -d out
check "a folder's: $(cat "$err")" [ -s out/BOX.FBX.png ]

# An archive with a file of the format; a bomb; and one that ends early.
zipped() { # NAME PART: NAME holds the file PART
    python3 -c 'import sys, zipfile; zipfile.ZipFile(sys.argv[1], "w", zipfile.ZIP_DEFLATED).write(sys.argv[2])' "$1" "$2"
}
cp $models/FBX/box.fbx part.fbx
zipped zip.fbx part.fbx
check "in an archive: $(cat "$err")" [ "$(hash zip.fbx)" = "$(hash $models/FBX/box.fbx)" ]
check "through standard input" [ "$("$burnish" render - --input-format=fbx --size=64 --json --quiet -o p.png <zip.fbx | grep '"hash"')" = \
    "$("$burnish" render zip.fbx --size=64 --json --quiet -o p.png | grep '"hash"')" ]
head -c 300 zip.fbx >cut.fbx
expect 4 "burnish: cut.fbx: burnish-import-assimp: zip: the archive has no end; the file is truncated" info cut.fbx
head -c 70000000 /dev/zero >part.fbx
zipped bomb.fbx part.fbx
expect 5 "burnish: bomb.fbx: burnish-import-assimp: zip: part.fbx: the archive's $(wc -c <bomb.fbx) bytes unpack to more than 67108864; export it flat, or as glTF" info bomb.fbx
rm -f ./*.fbx p.png
rm -rf BOX.FBX.GZ cut.fbx.gz large.fbx.gz out

expect 4 "burnish: $models/MDL/MDL (HL1)/man.mdl: burnish-import-assimp: Missing file inputT.mdl; parts in other files are not read: convert it whole" \
    info "$models/MDL/MDL (HL1)/man.mdl"

# By hand: a stream is a file like others.
"$(dirname "$burnish")/burnish-import-assimp" fbx <$models/FBX/spider.fbx >a.bms
check "a saved stream" [ "$(hash a.bms)" = "$(hash $models/FBX/spider.fbx)" ]
rm -f a.bms

# Damaged files give one line and an exit code, or a picture, whatever libassimp does.
python3 "$here/damage.py" "$burnish" $models "${IMPORT_DAMAGED:-150}" >"$out" 2>&1
check "damaged files: $(tail -n 3 "$out")" [ $? = 0 ]
tail -n 1 "$out" # what became of them
nothing_left "import_assimp"
finish
