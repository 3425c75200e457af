#!/bin/sh
# render --sandbox: the same pictures, messages and exit codes, and nothing beyond; --max-seconds, --max-memory.
# Usage: cli_sandbox.sh PROGRAM FOLDER
here=$(cd "$(dirname "$0")" && pwd)
. "$here/lib.sh"

# Limits that the system keeps, in a sandbox and without.
awk 'BEGIN { for (i = 0; i < 9000; ++i) { z = i / 9000; print "v 0 0 " z "\nv 1 0 " z "\nv 0 1 " z "\nf -3 -2 -1" } }' >sheets.obj
limits() {
    expect 5 'burnish: not done after 0.2 seconds (--max-seconds): raise the limit or simplify the mesh' \
        render sheets.obj --views=front --max-overdraw=1e9 --size=4000 --samples=16 --max-seconds=0.2 -o h.png "$@"
    run render sheets.obj --views=front --size=8000 --max-memory=40M --threads=1 --max-overdraw=1e9 -o h.png "$@"
    check "--max-memory $*: exit code $code" [ "$code" = 6 ]
    check "--max-memory $*: one line: $(cat "$err")" [ "$(wc -l <"$err")" = 1 ]
    check "no picture, no temporary" [ "$(ls -A)" = sheets.obj ]
}
expect 2 'burnish: --max-seconds: "-1" is not a number from 0 to 1000000' render :sphere --max-seconds=-1
expect 2 'burnish: --max-memory: "x" is not a number of bytes, such as 500M or 2G (K, M, G: powers of 1024)' render :sphere --max-memory=x
if ! "$burnish" render :sphere --max-memory=1G --size=8 --threads=1 -o s.png 2>/dev/null; then
    echo "cli_sandbox: SKIPPED: limits of memory, which this build's sanitizer can't bear"
    rm -f sheets.obj
    finish
    exit
fi
rm -f s.png
limits

if ! "$burnish" render :sphere --size=8 --sandbox -o s.png 2>"$err"; then
    expect 2 'burnish: --sandbox: this program was built without libseccomp; install libseccomp-dev and build again, or use --no-sandbox' \
        render :sphere --sandbox -o s.png
    rm -f sheets.obj
    finish
    exit
fi
rm -f s.png
limits --sandbox
rm -f sheets.obj

# same FLAGS: OUT in them stands for the output.
same_there() {
    plain=$(echo "$*" | sed 's/OUT/plain/g') boxed=$(echo "$*" | sed 's/OUT/boxed/g')
    # shellcheck disable=SC2086
    "$burnish" render $plain >../plain.out 2>../plain.err </dev/null
    plain_code=$?
    # shellcheck disable=SC2086
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
expect 2 'burnish: --sandbox: no other picture is read in it; leave out --reference' render :knot --sandbox --reference=a.png

# A material library is one of the input's folder: what a link shows elsewhere is not read.
mkdir in
echo "newmtl a
Kd 1 0 0" >secret.mtl
ln -s ../secret.mtl in/link.mtl
cp secret.mtl in/beside.mtl
picture() { # LIBRARY
    printf 'mtllib %s\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n' "$1" >in/a.obj
    run render in/a.obj --sandbox --size=16 --json -o s.png
    rm -f s.png
    json hash
}
check "a library beside the input is read" [ "$(picture beside.mtl)" != "$(picture none.mtl)" ]
check "in other case, too" [ "$(picture BESIDE.Mtl)" = "$(picture beside.mtl)" ]
check "a library elsewhere is not" [ "$(picture link.mtl)" = "$(picture none.mtl)" ]
rm -rf in secret.mtl

# Killed in the middle: the other process goes too, and nothing is left.
"$burnish" render :knot --size=8000 --samples=16 --sandbox -o s.png 2>/dev/null &
sleep 0.3
kill $! 2>/dev/null
wait $!
check "killed: exit code $?" [ $? = 143 ]
nothing_left "sandbox"
finish
