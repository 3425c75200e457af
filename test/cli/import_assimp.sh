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
    check "$1: something is seen" [ "$(json covered_pixels)" -gt 100 ]
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

# Colours of materials and vertices, and a texture that the archive holds.
hash() { # FLAGS
    run render "$@" --size=64 --json --quiet -o p.png
    rm -f p.png
    json hash
}
check "a texture in the file is drawn" [ "$(hash $models/Collada/duck.zae)" != "$(hash $models/Collada/duck.zae --no-textures)" ]
check "materials have colours" [ "$(hash $models/FBX/cubes_with_names.fbx)" != "$(hash $models/FBX/cubes_with_names.fbx --color=1,1,1)" ]

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
