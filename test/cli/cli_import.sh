#!/bin/sh
# Importers: how burnish finds and starts them, and how it handles faulty ones. Scripts act as importers.
# Usage: cli_import.sh PROGRAM FOLDER
here=$(cd "$(dirname "$0")" && pwd)
. "$here/lib.sh"
mkdir "$scratch.bin"
bin=$scratch.bin
trap 'rm -rf "$bin"' EXIT
export BURNISH_IMPORTERS="$bin"
"$here/../fuzz/seeds" "$bin/seeds"
tail -c +5 "$bin/seeds/bms/all" >"$bin/all.bms"
tail -c +5 "$bin/seeds/bms/error" >"$bin/error.bms"
echo "an FBX" >a.fbx
name=burnish-import-assimp

# importer COMMANDS: replaces the importer by a script.
importer() {
    printf '#!/bin/sh\n%s\n' "$1" >"$bin/$name"
    chmod +x "$bin/$name"
}

boxed=$(draws --sandbox && echo --sandbox)

# fails FILE CODE LINE: expects this error of each way to load a mesh.
fails() {
    expect "$2" "burnish: $1: $3" info "$1"
    expect "$2" "burnish: $1: $3" compare "$1" :sphere
    for flag in --no-sandbox $boxed; do
        expect "$2" "burnish: $1: $3" render "$1" $flag -o p.png
    done
}

# refused CODE LINE: expects this error from the current importer.
refused() {
    fails a.fbx "$1" "$name $2"
    check "no picture" [ "$(ls -A)" = a.fbx ]
}

refused 4 "reads such files and is not installed; install the Debian package of that name, build it (-DBURNISH_IMPORT_ASSIMP=ON, Debian's libassimp-dev), name its folder in BURNISH_IMPORTERS, or convert the file to glTF, OBJ, PLY or STL"
importer 'exit 0'
refused 4 'ended without a mesh'
importer 'exit 3'
refused 4 'ended with exit code 3 and no mesh'
importer 'echo hello; kill -SEGV $$'
refused 4 'crashed by signal 11 (Segmentation fault); repair the file, or convert it'
importer 'kill -SYS $$'
refused 4 'made a system call that importing does not need, and was ended'
importer 'kill -KILL $$'
refused 6 'was ended by the system: out of memory'
importer 'exec yes'
refused 5 'makes a mesh of far more bytes than the file has; simplify the file'
importer "cat '$bin/error.bms'"
stream_refused() { # what a stream says comes after the importer's name and a colon
    name=$name: && refused "$@" && name=${name%:}
}
stream_refused 4 'text'
importer "echo 'what an importer says when it is something else, more than 64 bytes of it'"
stream_refused 4 'byte 0: not a mesh stream: its first 8 bytes are wrong, or it is shorter than 64 bytes'
importer "head -c 200 '$bin/all.bms'"
stream_refused 4 'byte 16: the stream states 400 bytes and needs at least 384 for its counts, but has 200; it is truncated or damaged'

# An importer has its three streams, and no descriptor that burnish was given.
if command -v python3 >/dev/null; then
    importer "[ -e /proc/\$\$/fd/300 ] && echo 300 >'$bin/held'; cat '$bin/all.bms'"
    check "with descriptor 300" python3 -c 'import os, sys
os.dup2(1, 300)
os.execv(sys.argv[1], sys.argv[1:])' "$burnish" info a.fbx
    check "an importer has descriptors of others" [ ! -e "$bin/held" ]
fi

# Some files are known by their first bytes: the importer is not started, and need not be there.
lfs='version https://git-lfs.github.com/spec/v1
oid sha256:4d7a214614ab2935c943f9e0ff69d22eadbb8f32b1258daaa5e2ca24d17e2393
size 12345'
for there in yes no; do
    importer "touch '$bin/started'; exit 3"
    [ $there = yes ] || rm "$bin/$name"
    for extension in fbx dae 3ds step; do
        printf '%s\n' "$lfs" >p.$extension
        fails p.$extension 4 'a Git LFS pointer, not the file; fetch the file (git lfs pull)'
        rm p.$extension
    done
    printf '\n<!DOCTYPE html>\n<html></html>\n' >p.fbx
    expect 4 'burnish: p.fbx: a web page, which contradicts its name; fetch or export it again' info p.fbx
    : >p.fbx
    expect 4 'burnish: p.fbx: the file is empty' info p.fbx
    check "no importer was started" [ ! -e "$bin/started" ]
    rm p.fbx
done

# A time limit ends the importer too. This one waits for a line that never comes.
mkfifo "$bin/never"
importer "echo \$\$ >'$bin/number'; read line <'$bin/never'"
for flag in --no-sandbox $boxed; do
    expect 5 'burnish: not done after 2 seconds, 10 times --max-seconds: raise the limit, or try again when the machine is less busy' \
        render a.fbx --max-seconds=0.2 "$flag" -o p.png
    check "the importer has ended" await ended "$(cat "$bin/number")"
done
if [ "$boxed" ]; then # a sanitizer can't bear limits of memory
    importer "ulimit -v >'$bin/memory'"
    run batch a.fbx -d out --max-memory=1G
    check "its memory in a batch: $(cat "$bin/memory")" [ "$(cat "$bin/memory")" = 1048576 ]
    rm -rf out
fi
importer "echo \$\$ >'$bin/number'; read line <'$bin/never'"
for flag in --no-sandbox $boxed; do
    run batch a.fbx -d out --max-seconds=0.2 --max-memory=8000000000G ${flag#--sandbox}
    check "a batch goes on: $code, $(cat "$err")" grep -qE '^burnish: a.fbx: .*(takes too long; raise|10 times) --max-seconds' "$err"
    rm -rf out
done
importer 'while :; do :; done'
gives 5 render a.fbx --max-seconds=0.5 -o p.png
check "an importer that computes: $(cat "$err")" grep -qE 'a.fbx: burnish-import-assimp takes too long|10 times' "$err"
check "the batch's importer has ended" await ended "$(cat "$bin/number")"

# One that works: it gets the extension, the file as standard input, and no other descriptor.
importer "echo \"\$*\" >'$bin/arguments'; cat >'$bin/input'; ls /proc/self/fd >'$bin/descriptors'; cat '$bin/all.bms'"
gives 0 render a.fbx --size=64 --json -o p.png
check "its format" [ "$(json format)" = fbx ]
check "the extension" [ "$(cat "$bin/arguments")" = fbx ]
check "the file" cmp -s a.fbx "$bin/input"
check "descriptors: $(cat "$bin/descriptors")" [ "$(wc -l <"$bin/descriptors")" -le 4 ] # ls has one of its own
check "warnings" [ "$(cat "$err")" = "burnish: warning: a.fbx: burnish-import-assimp: text
burnish: warning: a.fbx: burnish-import-assimp: texture \"a.png\" was skipped: a.png: can't be opened: No such file or directory; --root=.. searches there" ]
cp "$here/../data/tiles.png" a.png
for flag in --no-sandbox $boxed; do
    run render a.fbx --size=64 "$flag" -o q.png
    check "a texture beside the file, $flag: $(cat "$err")" [ "$(cat "$err")" = "burnish: warning: a.fbx: burnish-import-assimp: text" ]
    check "the same picture, $flag" cmp -s p.png q.png
done
gives 0 info a.fbx
gives 0 compare a.fbx a.fbx
expect 5 'burnish: a.fbx: larger than the limit of 3 bytes; raise the limit or simplify the mesh' \
    render a.fbx --max-input-bytes=3 -o r.png
gives 4 render a.fbx --input-format=stl -o r.png  # a format that is named is not imported

# With any file name, and from standard input: --input-format selects the format.
cp a.fbx a.dat
importer "echo \"\$*\" >'$bin/arguments'; cat >'$bin/input'; cat '$bin/all.bms'"
same_as_fbx() { # TEXT, of a picture r.png
    check "$1: exit code $code, $(cat "$err")" [ "$code" = 0 ]
    check "$1: the extension" [ "$(cat "$bin/arguments")" = dae ]
    check "$1: the file" cmp -s a.fbx "$bin/input"
    rm -f "$bin/arguments" "$bin/input"
}
for flag in --no-sandbox $boxed; do
    run render a.dat --input-format=dae --size=64 "$flag" --json -o q.png
    same_as_fbx "another extension, $flag"
    check "the same picture, another extension, $flag" cmp -s p.png q.png
    check "its format is the one named" [ "$(json format)" = dae ]
    run_with() { # FILE-OR-PIPE ARGUMENTS...
        "$burnish" "$@" >"$out" 2>"$err"
        code=$?
    }
    run_with render - --input-format=dae --size=64 "$flag" -o q.png <a.fbx
    same_as_fbx "standard input, $flag"
    check "it has no folder: $(cat "$err")" grep -q 'warning: standard input: burnish-import-assimp: texture "a.png" was skipped' "$err"
    cat a.fbx | "$burnish" render - --input-format=dae --no-textures --size=64 "$flag" -o r.png 2>"$err"
    code=$?
    same_as_fbx "a pipe, $flag"
    { read -r line && run_with render - --input-format=dae --no-textures --size=64 "$flag" -o r.png; } <a.fbx
    check "what was left of standard input, $flag" [ "$line" = "an FBX" -a ! -s "$bin/input" ]
    yes | run_with render - --input-format=dae --max-input-bytes=1M "$flag" -o s.png
    check "a stream without end, $flag: $(cat "$err")" grep -qx 'burnish: standard input: larger than the limit of 1048576 bytes; raise the limit or simplify the mesh' "$err"
done
run_with info - --input-format=dae --json <a.fbx
same_as_fbx info
check "info's format" [ "$(json format)" = dae ]
run_with compare - a.fbx --input-format=dae <a.fbx
same_as_fbx compare
importer "cat '$bin/error.bms'"
cp "$here/../data/colors.ply" other.dat
expect 4 "burnish: other.dat: $name: text" render other.dat --input-format=dae -o s.png
rm other.dat
expect 2 'burnish: --input-format: "exe" is not one of auto, gltf, obj, off, ply, stl, 3mf, gcode, splat, spz, bms, scene, urdf, pcd, las, xyz, nor a file extension of an importer (fbx, step ...; docs/importers.md)' info a.fbx --input-format=exe
mkfifo "$bin/open"
exec 5<>"$bin/open"
for flag in --no-sandbox $boxed; do # it does not wait for input that nobody would read
    BURNISH_IMPORTERS=$bin/none run_with render - --input-format=dae --max-seconds=60 "$flag" -o s.png <&5
    check "no importer, $flag: $(cat "$err")" grep -q "^burnish: standard input: $name reads such files and is not installed" "$err"
done
exec 5<&-
rm -f a.dat
importer "cat '$bin/all.bms'"
expect 3 "burnish: none.fbx: can't be opened: No such file or directory" render none.fbx -o r.png

# Folders of a batch include importers' files if the importer is installed.
mkdir models
cp a.fbx models
echo text >models/a.txt
run batch models -d models --size=16 --no-sandbox --max-memory=8000000000G # which a sanitizer bears
check "a batch: $(cat "$err")" [ "$code" = 0 -a -s models/a.png ]
rm models/a.png models/burnish-batch.jsonl
echo 'AC_INIT(what autoconf reads)' >models/configure.ac
printf 'AC3Db\n' >models/b.ac
echo 'on: push' >models/ci.yml.off
printf '\377\376A\000' >models/c.ac
printf 'IDSQ\012\000\000\000' >models/run.mdl
: >models/empty.x
printf '0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n0\nENDSEC\n' >models/flat.dxf
printf '0\r\nSECTION\r\n  2\r\nENTITIES\r\n  0\r\n3DFACE\r\n' >models/faces.dxf
for again in no yes; do # the first line of the first report is known in the second run
    run batch models -d models --size=16 --no-sandbox --no-seconds --max-memory=8000000000G
    check "files that are no meshes, $again: $(cat "$err")" [ "$code" = 0 -a -s models/a.png -a -s models/b.png -a -s models/c.png -a -s models/faces.png ]
    check "they are passed over, $again: $(ls models)" [ "$(grep -c '"done"' models/burnish-batch.jsonl)" = 4 ]
    check "and counted, $again" sh -c "head -n 1 models/burnish-batch.jsonl | grep -q '\"passed_over\":5}\$'"
    [ $again = yes ] || importer "exit 3"
done
importer "cat '$bin/all.bms'"
gives 0 batch models/configure.ac -d models --size=16 --no-sandbox --force --max-memory=8000000000G  # one that is named is tried
rm -f models/*.png models/*.jsonl models/*.ac models/*.off models/*.x models/*.mdl models/*.dxf
BURNISH_IMPORTERS=$bin/none expect 2 'burnish: no meshes there; --recursive looks into folders below' batch models
rm -r models

# A file that one of burnish's own readers reads, whatever it is called.
cp "$here/../data/colors.ply" other.dae
importer "cat '$bin/error.bms'"
other='burnish: warning: other.dae: the file is PLY, not .dae as its name says'
expect 0 "$other" render other.dae --size=16 -o r.png
[ -z "$boxed" ] || expect 0 "$other" render other.dae --size=16 --sandbox -o r.png
# A file of a scene.
echo 'a COLLADA file' >part.DAE
echo '{"burnish_scene": 1, "items": [{"file": "part.DAE"}]}' >s.scene.json
importer "[ \$1 = dae ] && cat '$bin/all.bms'"
for flag in --no-sandbox $boxed; do
    gives 0 render s.scene.json --size=16 $flag -o r.png
done
# A file of an archive, if it is named or the only model.
python3 -c "import zipfile; zipfile.ZipFile('kit.zip', 'w').write('part.DAE', 'x/part.DAE')"
for flag in --no-sandbox $boxed; do
    gives 0 render kit.zip:part.dae --size=16 $flag -o r.png
    gives 0 render kit.zip --size=16 $flag -o r.png
done
for kit in kit.zip:x/part.DAE kit.zip; do
    run info $kit
    check "the format of a file in an archive: $(cat "$out")" grep -q "^$kit (dae)" "$out"
done
importer 'exit 3'
expect 4 "burnish: kit.zip:part.DAE: $name ended with exit code 3 and no mesh" info kit.zip:part.DAE
for flag in --no-sandbox $boxed; do
    expect 4 "burnish: s.scene.json:1: items[0].file: part.DAE: s.scene.json: $name ended with exit code 3 and no mesh" render s.scene.json $flag -o r.png
done
rm -f part.DAE kit.zip s.scene.json a.fbx a.png p.png q.png r.png other.dae
nothing_left "importers"
finish
