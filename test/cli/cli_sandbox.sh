#!/bin/sh
# render --sandbox: the same pictures, messages and exit codes, and nothing beyond; --max-seconds, --max-memory.
# Usage: cli_sandbox.sh PROGRAM FOLDER
here=$(cd "$(dirname "$0")" && pwd)
. "$here/lib.sh"

# Limits that the system keeps, in a sandbox and without.
sheets >sheets.obj
mkfifo endless.obj
exec 9<>endless.obj # a writer that never writes
limits() {
    expect 5 'burnish: not done after 2 seconds, 10 times --max-seconds: raise the limit, or try again when the machine is less busy' \
        render endless.obj --max-seconds=0.2 -o h.png "$@"
    gives 5 render sheets.obj --views=front --size=8000 --max-seconds=0.2 --threads=1 --max-overdraw=1e9 -o h.png "$@"
    check "--max-seconds $*: $(cat "$err")" late 0.2
    gives 6 render sheets.obj --views=front --size=8000 --max-memory=100M --threads=1 --max-overdraw=1e9 -o h.png "$@"
    check "--max-memory $*: one line: $(cat "$err")" [ "$(wc -l <"$err")" = 1 ]
    check "no picture, no temporary" [ "$(ls -A | tr '\n' ' ')" = 'endless.obj sheets.obj ' ]
}
expect 2 'burnish: --max-seconds: "-1" is not a number from 0 to 1000000' render :sphere --max-seconds=-1
expect 2 'burnish: --max-memory: "x" is not a number of bytes, such as 500M or 2G (K, M, G: powers of 1024)' render :sphere --max-memory=x
if ! draws --max-memory=1G; then
    skip "limits of memory, this build's sanitizer needs more"
    rm -f sheets.obj endless.obj
    finish
    exit
fi
limits

if ! draws --sandbox; then
    expect 2 'burnish: --sandbox: this program was built without libseccomp; install libseccomp-dev and build again, or use --no-sandbox' \
        render :sphere --sandbox -o s.png
    skip "everything in the sandbox, built without libseccomp"
    rm -f sheets.obj endless.obj
    finish
    exit
fi
limits --sandbox
exec 9>&-
rm -f sheets.obj endless.obj

# same FLAGS: OUT in them stands for the output.
same_there() {
    plain=$(echo "$*" | sed 's/OUT/plain/g') boxed=$(echo "$*" | sed 's/OUT/boxed/g')
    "$burnish" render $plain >../plain.out 2>../plain.err </dev/null
    plain_code=$?
    "$burnish" render $boxed --sandbox >"$out" 2>"$err" </dev/null
    boxed_code=$?
    check "$*: exit codes $plain_code, $boxed_code: $(cat "$err")" [ $plain_code = $boxed_code ]
    sed 's/plain/boxed/g' ../plain.err >../wanted.err
    check "$*: '$(cat "$err")'" cmp -s ../wanted.err "$err"
    check "$*: standard output" [ "$(grep -c . ../plain.out)" = "$(grep -c . "$out")" ]
    for file in plain*; do
        [ ! -e "$file" ] || check "$*: $file" cmp -s "$file" "boxed${file#plain}"
    done
    rm -f plain* boxed* ../plain.out ../plain.err ../wanted.err
}
data=$here/../data
same_there :knot --size=100 -o OUT.png
same_there "$data/cube.obj" --size=100 --json -o OUT.png
same_there "$data/cube.obj" --size=100 --threads=7 --ground --shadow --edges --annotate=axes,dimensions -o OUT.png
same_there "$data/colors.ply" --size=64 --views=front,top -o OUT.png
same_there :knot --size=64 -o OUT.npy --plane=depth:OUT.d.npy --plane=normal:OUT.n.png
same_there :knot --size=64 -o OUT.jpg
same_there :knot --size=64 -o OUT.webp
same_there :knot --size=64 -o OUT.exr
same_there :knot --size=32 --turntable=OUT.gif --frames=3
same_there :knot --size=64 --look=drawing -o OUT.svg
same_there :knot --size=64 --views=front,top "--labels=K\303\266rper,b" -o OUT.png
same_there none.stl -o OUT.png
same_there "$data" -o OUT.png
same_there "$data/wedge.stl" -o OUT.png
same_there :knot --size=16 -o /dev/full
same_there :knot --size=16 --json=no/folder.json -o OUT.png
same_there :knot --size=16 -o no/OUT.png
check "standard input" [ "$("$burnish" render - --sandbox --size=64 -o - <"$data/colors.ply" | cksum)" = \
    "$("$burnish" render - --size=64 -o - <"$data/colors.ply" | cksum)" ]
expect 2 'burnish: --sandbox: the reference can not be read in it; omit --reference' render :knot --sandbox --reference=a.png

# As many outputs as the flags allow.
planes=
for number in $(seq 18); do
    planes="$planes --plane=depth:OUT.$number.npy"
done
same_there :knot --size=8 --json=r.json $planes -o OUT.png
rm -f r.json

# Material libraries are read only from the input's folder, not through links that lead out of it.
mkdir in in/folder.mtl
echo "newmtl a
Kd 1 0 0" >secret.mtl
ln -s ../secret.mtl in/link.mtl
mkfifo in/fifo.mtl
cp secret.mtl in/beside.mtl
name_library() {
    printf 'mtllib %s\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n' "$1" >in/a.obj
}
picture() { # LIBRARY
    name_library "$1"
    run render in/a.obj --sandbox --size=16 --json -o s.png
    rm -f s.png
    json hash
}
check "a library beside the input is read" [ "$(picture beside.mtl)" != "$(picture none.mtl)" ]
check "in other case, too" [ "$(picture BESIDE.Mtl)" = "$(picture beside.mtl)" ]
check "by its folder, too" [ "$(picture .//Beside.mtl)" = "$(picture beside.mtl)" ]
check "a library elsewhere is not" [ "$(picture link.mtl)" = "$(picture none.mtl)" ]
long=$(printf 'x%.0s' $(seq 300))
for library in link.mtl fifo.mtl folder.mtl none.mtl "$long" "folder.mtl/$long" ../secret.mtl FOLDER.mtl/../../secret.mtl; do
    name_library "$library"
    same_there in/a.obj --size=16 -o OUT.png
    check "$library is told: $(cat "$err")" grep -q 'was not read' "$err"
done
same_there in/a.obj --max-input-bytes=5 -o OUT.png
name_library beside.mtl
cat secret.mtl secret.mtl secret.mtl secret.mtl secret.mtl >in/beside.mtl
same_there in/a.obj --max-input-bytes=80 --size=16 -o OUT.png
check "a library that is too large: $(cat "$err")" grep -q 'beside.mtl: larger than the limit of 80 bytes' "$err"
truncate -s 500M in/beside.mtl
same_there in/a.obj --max-memory=400M --threads=1 --size=16 -o OUT.png
check "a library without memory for it: $(cat "$err")" grep -q 'out of memory: no 524288000 bytes for beside.mtl' "$err"
rm -rf in

# With a root, files next to the input's folder are read as well, but none outside the root.
mkdir -p root/meshes root/lib root/textures root/Materials/Textures
cp secret.mtl root/lib/red.mtl
ln -s ../../secret.mtl root/lib/link.mtl
"$burnish" render :knot --size=8 -o root/textures/t.png
"$burnish" render :torus --size=8 -o root/Materials/Textures/u.png
rooted() { # LIBRARY; its hash with and without a sandbox, if they are equal
    printf 'mtllib %s\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl a\nf 1/1 2/2 3/3\n' "$1" >root/meshes/a.obj
    for wall in --sandbox --no-sandbox; do
        run render root/meshes/a.obj --root=$root "$wall" --size=16 --json -o s.png
        json hash
    done | uniq
    rm -f s.png
}
for root in root "$PWD/root/" root/meshes/../lib/..; do
    check "$root contains a library" [ "$(rooted ../lib/red.mtl)" != "$(rooted none.mtl)" ]
    check "no link leads out of $root" [ "$(rooted ../lib/link.mtl)" = "$(rooted none.mtl)" ]
    check "no name leads out of $root" [ "$(rooted ../../secret.mtl)" = "$(rooted none.mtl)" ]
done
check "the whole tree" [ "$(root=. rooted ../../secret.mtl)" = "$(root=root rooted ../lib/red.mtl)" ]
root=root
for texture in ../textures/t.png 'C:\Users\x\T.PNG' /home/x/t.png other/u.png; do
    printf 'newmtl a\nmap_Kd %s\n' "$texture" >root/meshes/t.mtl
    found=$(rooted t.mtl)
    check "$texture is found" [ "$found" != "$(root="$root --no-textures" rooted t.mtl)" ]
    same_there root/meshes/a.obj --root=root --size=16 -o OUT.png
    check "$texture: $(cat "$err")" [ ! -s "$err" ]
    same_there root/meshes/a.obj --size=16 -o OUT.png
done
check "the root of a lost texture: $(cat "$err")" grep -q 'No such file' "$err"
printf 'newmtl a\nmap_Kd ../textures/t.png\n' >root/meshes/t.mtl
same_there root/meshes/a.obj --size=16 -o OUT.png
check "the root that helps: $(cat "$err")" grep -q 'outside the folder of the file; --root=root/meshes/.. allows it$' "$err"
same_there root/meshes/a.obj --root=root/lib --size=16 -o OUT.png
check "a root elsewhere: $(cat "$err")" grep -q 'root: root/lib: does not contain the input; name a folder above it' "$err"
same_there root/meshes/a.obj --root=none --size=16 -o OUT.png
printf 'newmtl a\nmap_Kd ../textures/t.png\n' >root/meshes/t.mtl
cp root/meshes/a.obj root/lib/b.obj
(cd root && python3 -c "import shutil; shutil.make_archive('../kit', 'zip', '.')")
same_there kit.zip -o OUT.png
for name in kit.zip:a.obj kit.zip:meshes/A.obj kit.zip:lib/b.obj kit.zip:none.obj; do
    same_there "$name" --size=16 -o OUT.png
done
run render kit.zip:a.obj --sandbox --size=16 --json -o s.png
in_archive=$(json hash)
run render root/meshes/a.obj --root=root --size=16 --json -o s.png
check "an archive is drawn as its folder" [ "$in_archive" = "$(json hash)" ]
run batch kit.zip:lib/b.obj -d made --size=16
check "a batch of an archive: $(cat "$err")" [ -s made/b.png ]
mkdir kits named
(cd root/lib && python3 -c "import shutil; shutil.make_archive('../../kits/one', 'zip', '.')")
cp kit.zip kits/several.zip
cp root/lib/b.obj named/a.obj && cp root/lib/b.obj named
echo '{"burnish_scene":1,"items":[{"file":"a.obj"},{"file":"b.obj"}]}' >named/s.scene.json
(cd named && python3 -c "import shutil; shutil.make_archive('../kits/scene', 'zip', '.')" && rm ./*)
(cd named && python3 -c "import shutil; shutil.make_archive('../kits/none', 'zip', '.')")
gives 0 batch kits -d made --size=16
check "archives in a folder: $(ls made)" [ -s made/one.png -a -s made/scene.png ]
check "archives of no or several models are passed over" sh -c "head -n 1 made/burnish-batch.jsonl | grep -q '\"passed_over\":2}\$'"
gives 11 batch kits/several.zip -d made --size=16
run batch kit.zip:lib/b.obj kits/one.zip:b.obj -d made --size=16
check "two models of one name in archives: $(cat "$err")" [ -s made/kit.zip:lib/b.png -a -s made/kits/one.zip:b.png ]
(cd named && "$burnish" render ../kit.zip:a.obj --size=16 2>"$err")
check "the name of a model in an archive: $(ls named)" [ -s named/a.png ]
rm -rf kits named
same_there root/meshes/a.obj root/lib/b.obj --scene --size=16 -o OUT.png
printf '{"burnish_scene": 1, "items": [{"file": "meshes/a.obj"}, {"file": "lib/b.obj", "scale": 2}]}' >root/s.scene.json
same_there root/s.scene.json --size=16 -o OUT.png
rm -rf root secret.mtl kit.zip s.png made

# A wall that can't be built is an error of each process that has one: where Landlock has no room for another domain.
full() { # ARGUMENTS...
    python3 "$here/landlock.py" "$burnish" "$@" >"$out" 2>"$err" </dev/null
    code=$?
}
full --version
if [ $code = 77 ]; then
    skip "a wall that can't be built, this kernel has no Landlock"
else
    full render :sphere --size=16 --sandbox -o s.png
    check "render: $code, $(cat "$err")" [ "$code $(cat "$err")" = \
        "2 burnish: --sandbox: this system can't create a sandbox (Landlock: Argument list too long); use --no-sandbox" ]
    full serve-stdio
    check "serve-stdio: $code, $(cat "$err")" [ "$code $(cat "$err")" = \
        "2 burnish: serve-stdio: this system can't create a sandbox (Landlock: Argument list too long); use --no-sandbox" ]
    cp "$here/../data/cube.obj" c.obj
    full batch c.obj -d out
    check "batch: $code, $(cat "$err")" [ "$code" = 11 ]
    check "batch: $(cat "$err")" grep -q "this system can't create a sandbox (Landlock: Argument list too long); use --no-sandbox" "$err"
    run batch c.obj -d out
    full batch c.obj -d out --sheet=out/sheet.png
    check "sheet: $code, $(cat "$err")" grep -q "sheet: this system can't create a sandbox (Landlock: Argument list too long); use --no-sandbox" "$err"
    check "no sheet" [ ! -e out/sheet.png ]
    rm -rf out c.obj
fi

# Killed while it reads: the other process, which holds the pipe's end, goes too, and nothing is left.
mkfifo pipe.obj
"$burnish" render pipe.obj --sandbox -o s.png 2>/dev/null &
exec 9>pipe.obj
yes 'v 0 0 0' | head -c 1000000 >&9
kill $! 2>/dev/null
wait $!
check "killed: exit code $?" [ $? = 143 ]
timeout 60 yes >&9 2>/dev/null
check "nobody reads any more: exit code $?" [ $? = 141 ]
exec 9>&-
rm -f pipe.obj
nothing_left "sandbox"
finish
