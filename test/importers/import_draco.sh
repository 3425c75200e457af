#!/bin/sh
# burnish-import-draco: glTF with KHR_draco_mesh_compression; whole, damaged, in a sandbox.
# Usage: import_draco.sh PROGRAM FOLDER        (the importer is in the program's folder)
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../cli/lib.sh"
unset BURNISH_IMPORTERS
ring=$here/ring.glb

# The same mesh as the formula's, but for the order of its triangles and a last digit.
python3 "$here/ring.py" plain.glb
gives 0 compare "$ring" plain.glb --tolerance=2 --threshold=0.0001  # the picture is that of the mesh
run info "$ring" --json
check "triangles" [ "$(json triangles)" = 192 ]
check "closed" [ "$(json closed)" = true ]
check "size: $(json size)" [ "$(json size)" = 2.8,0.8,2.8 ]
for flags in --no-sandbox --sandbox; do
    run render "$ring" --size=100 $flags --json -o p.png
    check "$flags: $(cat "$err")" [ "$code" = 0 ] && json hash >>hashes
done
"$burnish" render - --size=100 --json -o p.png <"$ring" >"$out" 2>"$err"
json hash >>hashes
check "one picture from a file, in a sandbox and from standard input: $(cat hashes)" [ "$(sort -u hashes | wc -l)" = 1 ]
rm -f hashes p.png plain.glb

# Without the importer, and with faulty ones.
mkdir "$scratch.bin"
trap 'rm -rf "$scratch.bin"' EXIT
export BURNISH_IMPORTERS="$scratch.bin"
importer() {
    printf '#!/bin/sh\n%s\n' "$1" >"$BURNISH_IMPORTERS/burnish-import-draco"
    chmod +x "$BURNISH_IMPORTERS/burnish-import-draco"
}
cp "$ring" a.glb
refused() {
    expect "$1" "burnish: a.glb: $2" render a.glb -o p.png
    expect "$1" "burnish: a.glb: $2" render a.glb --sandbox -o p.png
}
refused 4 "burnish-import-draco reads such files and is not installed; install libdraco-dev and g++ and build burnish again, name its folder in BURNISH_IMPORTERS, or export the file without KHR_draco_mesh_compression"
importer 'exit 0'
refused 4 'burnish-import-draco ended without a mesh'
importer 'kill -SEGV $$'
refused 4 'burnish-import-draco crashed by signal 11 (Segmentation fault); repair the file, or convert it'
importer 'exec yes'
refused 5 'burnish-import-draco makes a mesh of far more bytes than the file has; simplify the file'
importer 'cat; exit 0'
refused 4 'the decoder of Draco answers with something else, or with less than it states'
unset BURNISH_IMPORTERS
rm -f a.glb

mkdir files
cp "$ring" files/ring.glb
python3 "$here/damage.py" "$burnish" files "${IMPORT_DAMAGED:-60}" >"$out" 2>&1
check "damaged files: $(tail -n 3 "$out")" [ $? = 0 ]
tail -n 1 "$out"
rm -rf files
nothing_left "import_draco"
finish
