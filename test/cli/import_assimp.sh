#!/bin/sh
# burnish-import-assimp over the files of Debian's assimp-testmodels, whole and damaged.
# Usage: import_assimp.sh PROGRAM FOLDER        (the importer lies beside the program)
here=$(cd "$(dirname "$0")" && pwd)
. "$here/lib.sh"
models=/usr/share/assimp/models
[ -d $models ] || {
    echo "import_assimp: no $models; scripts/install-deps importers"
    exit 77
}
unset BURNISH_IMPORTERS

# holds FILE TRIANGLES UP: what info and render say of it.
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
holds AMF/test2.amf 4 +Z
holds AMF/test1.amf 4 +Z # colours of vertices that are wholly transparent are none
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

check "coordinates that the file leaves to be made" \
    [ "$(hash $models/LWO/LWO2/MappingModes/earth_spherical_y.lwo)" != "$(hash $models/LWO/LWO2/MappingModes/earth_spherical_y.lwo --no-textures)" ]
run render $models/LWO/LWO2/MappingModes/earth_spherical_y.lwo --size=32 -o p.png
check "no warning of them: $(cat "$err")" [ ! -s "$err" ]
run info $models/X3D/HelloWorld.x3d
check "of a list of names the first: $(cat "$err")" sh -c "! grep -q '\"http' '$err'"
# libassimp's grey of what has no colour has an alpha of 0.6, which DXF does not know
inside="$models/DXF/wuson.dxf --views=left --camera-zoom-factor=12"
# shellcheck disable=SC2086
check "DXF is opaque" [ "$(hash $inside --background-color=1,0,0)" = "$(hash $inside --background-color=0,0,1)" -a -n "$(json hash)" ]
rm -f p.png

# Packed, and damaged so.
gzip -c $models/FBX/box.fbx >BOX.FBX.GZ
check "gzip" [ "$(hash BOX.FBX.GZ)" = "$(hash $models/FBX/box.fbx)" ]
check "gzip in a sandbox" [ "$(hash BOX.FBX.GZ --sandbox)" = "$(hash $models/FBX/box.fbx)" ]
head -c 2000 BOX.FBX.GZ >cut.fbx.gz
expect 4 "burnish: cut.fbx.gz: burnish-import-assimp: gzip: byte 2000: the gzip file is truncated" info cut.fbx.gz
head -c 9000000 /dev/zero | gzip >large.fbx.gz
expect 5 "burnish: large.fbx.gz: burnish-import-assimp: gzip: unpacks to more than 200 times its size; unpack it first if that is right" info large.fbx.gz
run batch . -d out
check "a folder's: $(cat "$err")" [ -s out/BOX.FBX.png ]

# An archive of one file, as AMF often is, whatever the file is called; a bomb; and one that ends early.
zipped() { # NAME PART: NAME holds the file PART
    python3 -c 'import sys, zipfile; zipfile.ZipFile(sys.argv[1], "w", zipfile.ZIP_DEFLATED).write(sys.argv[2])' "$1" "$2"
}
cp $models/AMF/test2.amf box.amf
cp $models/AMF/test2.amf model.xml
zipped zip.amf box.amf
zipped other.amf model.xml
check "AMF in an archive: $(cat "$err")" [ "$(hash zip.amf)" = "$(hash $models/AMF/test2.amf)" ]
check "in one of another name" [ "$(hash other.amf)" = "$(hash $models/AMF/test2.amf)" ]
check "through standard input" [ "$("$burnish" render - --input-format=amf --size=64 --json --quiet -o p.png <zip.amf | grep '"hash"')" = \
    "$("$burnish" render zip.amf --size=64 --json --quiet -o p.png | grep '"hash"')" ]
head -c 300 zip.amf >cut.amf
expect 4 "burnish: cut.amf: burnish-import-assimp: zip: the archive has no end; the file is truncated" info cut.amf
{ cat box.amf && head -c 20000000 /dev/zero; } >bomb.xml
zipped bomb.amf bomb.xml
expect 5 "burnish: bomb.amf: burnish-import-assimp: zip: bomb.xml: the archive unpacks to more than 200 times its size, or to more than the limit of 17179869184 bytes" info bomb.amf
rm -f ./*.amf ./*.xml p.png
rm -rf BOX.FBX.GZ cut.fbx.gz large.fbx.gz out

expect 4 "burnish: $models/MDL/MDL (HL1)/man.mdl: burnish-import-assimp: Missing file inputT.mdl; parts in files beside it are not read: convert it whole" \
    info "$models/MDL/MDL (HL1)/man.mdl"

# By hand: a stream is a file like others.
"$(dirname "$burnish")/burnish-import-assimp" fbx <$models/FBX/spider.fbx >a.bms
check "a saved stream" [ "$(hash a.bms)" = "$(hash $models/FBX/spider.fbx)" ]
rm -f a.bms

# What is damaged ends as one line and an exit code, or is drawn: whatever libassimp does with it.
python3 "$here/../import/damage.py" "$burnish" $models "${IMPORT_DAMAGED:-150}" >"$out" 2>&1
check "damaged files: $(tail -n 3 "$out")" [ $? = 0 ]
tail -n 1 "$out" # what became of them
nothing_left "import_assimp"
finish
