#!/bin/sh
# burnish serve-stdio: render's pictures, failures that do not end the server, limits, framing, sandboxed processes.
# Usage: cli_serve.sh PROGRAM FOLDER
here=$(cd "$(dirname "$0")" && pwd)
. "$here/lib.sh"

# A sanitizer can't bear seccomp; the sandbox may be missing.
options=$(unlimited)
is_locked=1
if ! draws --sandbox; then
    is_locked=
    skip "workers behind the sandbox, this system or build has none"
    options="$options --no-sandbox"
fi

# put32 NUMBER: four bytes.
put32() {
    printf "$(printf '\\%03o\\%03o\\%03o\\%03o' $(($1 & 255)) $(($1 >> 8 & 255)) $(($1 >> 16 & 255)) $(($1 >> 24)))"
}

# request ID LINE [FILE...]: a frame.
request() {
    request_id=$1
    request_line=$2
    shift 2
    printf '%s\n' "$request_line" | cat - "$@" >frame
    put32 "$(wc -c <frame)"
    put32 "$request_id"
    cat frame
    rm frame
}

# serve [FLAGS...]: replies to the requests of the file `in`; leaves ID.line and ID.picture of each, and their ids in $order.
serve() {
    "$burnish" serve-stdio $options "$@" <in >replies 2>"$err"
    code=$?
    at=1
    order=
    size=$(wc -c <replies)
    while [ $at -lt "$size" ]; do
        set -- $(tail -c +$at replies | head -c 8 | od -An -tu4)
        tail -c +$((at + 8)) replies | head -c "$1" >body
        head -n 1 body >"$2.line"
        tail -c +$(($(wc -c <"$2.line") + 1)) body >"$2.picture"
        order="$order $2"
        at=$((at + 8 + $1))
    done
    check "replies are whole" [ $at = $((size + 1)) ]
    rm -f in replies body
}

# failed ID CODE TEXT: a reply without a picture.
failed() {
    check "request $1: $(cat "$1.line")" grep -qF "{\"code\":$2,\"error\":\"$3" "$1.line"
    check "request $1: a picture" [ ! -s "$1.picture" ]
}

printf 'mtllib m.mtl\nusemtl r\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >a.obj
printf 'newmtl r\nKd 1 0 0\n' >m.mtl
printf 'v 0 0\n' >bad.obj
: >empty

# Pictures and reports are the same as render's.
{
    request 7 '{"name": "a.obj", "flags": ["--size=32"], "files": [{"name": "m.mtl", "bytes": 18}]}' a.obj m.mtl
    request 4294967295 '{"name": ":teapot", "flags": ["--views=front,top", "--color-by=height", "--no-labels"]}'
    request 3 '{"flags": ["--output-format=jpeg", "--quality=50"]}' a.obj
    request 0 '{"name": "a.obj", "flags": ["--no-libraries", "--animation=walk", "--columns=2"]}' a.obj
} >in
serve -j1 --size=24
check "exit code $code: $(cat "$err")" [ "$code" = 0 ]
check "one worker, the order of the requests: $order" [ "$order" = " 7 4294967295 3 0" ]
"$burnish" render a.obj --size=32 -o 7.png
"$burnish" render :teapot --views=front,top --color-by=height --no-labels --size=24 -o 4294967295.png
"$burnish" render - --quality=50 --size=24 -o 3.jpg <a.obj 2>/dev/null
"$burnish" render a.obj --no-libraries --size=24 -o 0.png
for id in 7 4294967295 0; do
    check "request $id: as render draws it" cmp $id.png $id.picture
done
check "request 3: as render draws it" cmp 3.jpg 3.picture
for id in 7 4294967295 3 0; do
    cp $id.line "$out"
    check "request $id: JSON" valid_json
    check "request $id: $(cat $id.line)" grep -q '^{"code":0,"error":null,"report":{"burnish":' $id.line
done
check "a warning: $(cat 3.line)" grep -q '"warnings":\["mesh:1: material library \\"m.mtl\\" was not read (m.mtl: is not one of the files' 3.line
check "flags in vain: $(cat 0.line)" grep -q '"warnings":\["--columns: no effect: only a sheet [^"]*","--animation: no effect: [^"]*"\]' 0.line
rm -f ./*.line ./*.picture ./*.png ./*.jpg

# What fails ends nothing.
sheets >sheets.obj
{
    request 1 '{"name": "bad.obj"}' bad.obj
    request 2 '{"flags": ["--sise=8"]}' a.obj
    request 3 '{"flags": ["--jobs=8"]}' a.obj
    request 4 '{"flags": ["-o", "x.png"]}' a.obj
    request 5 '{"flags": "--size=8"}' a.obj
    request 6 '{"size": 8}' a.obj
    request 7 '{"name": 8}' a.obj
    request 8 '{"name": "a.obj", "files": [{"name": "m.mtl", "bytes": 1000}]}' a.obj
    request 9 '{"name": "a.obj"} {' a.obj
    request 10 '{"name": "a.obj"' a.obj
    request 11 '{"name": ":teapot"}' a.obj
    request 12 '{}'
    request 13 '{"name": "big.obj"}' sheets.obj
    request 14 '{"name": "a.obj", "flags": ["--camera-position=0,0,9", "--camera-focal-point=0,0,99", "--fail-on-blank"]}' a.obj
    request 15 '{"name": "../../etc/passwd"}'
    request 16 '{"name": "a.obj", "flags": ["--size=9"]}' a.obj
} >in
serve -j2 --size=24 --max-request-bytes=1K
check "after failures: exit code $code: $(cat "$err")" [ "$code" = 0 ]
failed 1 4 'bad.obj:1: vertex has 2 numbers'
failed 2 2 '--sise: unknown flag; did you mean --size?'
failed 3 2 '--jobs: unknown flag; '
failed 4 2 '-o: unknown flag; '
failed 5 2 'request: \"flags\": give an array of at most 256 texts'
failed 6 2 'request: \"size\": unknown key; there are name, flags and files'
failed 7 2 'request: \"name\": give a text'
failed 8 2 'request: \"files\": give at most 256 of'
failed 9 2 'request: byte 17: the line is not one JSON object'
failed 10 2 'request: byte 15: the line is not one JSON object'
failed 11 2 'request: \"name\": a built-in object has no bytes'
failed 12 4 'mesh: byte 0: the file is empty'
failed 13 5 'request: '
check "too large: $(cat 13.line)" grep -q ' bytes; the limit is 1024 (--max-request-bytes)' 13.line
failed 14 8 'a.obj: the picture is blank (--fail-on-blank)'
check "blank: the report" grep -q '"report":{"burnish"' 14.line
failed 15 4 '../../etc/passwd: byte 0: the file is empty'
check "the last one is drawn" [ -s 16.picture ]
rm -f ./*.line ./*.picture

# A request has the server's flags of render, except those of its operator, and no others. Without its value, a flag is known or
# not.
flag_names() { "$burnish" "$1" --help=all | sed -n 's/^  \(-[a-z],\|   \) --\([a-z-]*\).*/\2/p' | sort; }
flag_names render >names
id=0
while read -r flag; do
    request $((id += 1)) "{\"name\": \":sphere\", \"flags\": [\"--$flag\"]}"
done <names >in
serve -j1 --size=8
id=0
while read -r flag; do
    ! grep -qF "\"error\":\"--$flag: unknown flag" $((id += 1)).line || echo "$flag"
done <names >unknown
{
    { flag_names serve-stdio; echo resolution; } | sort | comm -23 names - # its other name there
    printf '%s\n' isa threads no-sandbox max-triangles max-texture-pixels max-input-bytes max-overdraw max-seconds max-memory
} | sort >expected
check "flags of a request: $(diff expected unknown | grep '^[<>]' | tr '\n' ' ')" cmp expected unknown
rm -f ./*.line ./*.picture names unknown expected

# Many at a time: every id once, the same bytes.
for i in 1 2 3 4 5 6 7 8 9 10 11 12; do
    request $i '{"name": "a.obj"}' a.obj
done >in
serve -j3 --size=16
check "one reply each: $order" [ "$(printf '%s\n' $order | sort -n | tr '\n' ' ')" = "1 2 3 4 5 6 7 8 9 10 11 12 " ]
"$burnish" render a.obj --no-libraries --size=16 --color=#ff0000 -o one.png
for i in 2 3 4 5 6 7 8 9 10 11 12; do
    check "request $i: the same picture" cmp 1.picture $i.picture
done
rm -f ./*.line ./*.picture one.png

# A request that takes too long, and one that needs too much memory.
{
    request 1 '{"flags": ["--views=front", "--size=3000", "--samples=16"]}' sheets.obj
    request 2 '{}' a.obj
} >in
serve -j1 --size=8 --max-overdraw=1e9 --max-seconds=0.2
failed 1 5 'not done after '
check "after one that was late" [ -s 2.picture ]
if [ "$options" = "${options#*--max-memory}" ]; then
    {
        request 3 '{"flags": ["--size=9000"]}' a.obj
        request 4 '{}' a.obj
    } >in
    serve -j1 --size=8 --max-memory=200M
    check "--max-memory: $(cat 3.line)" grep -q '^{"code":6,"error":"' 3.line
    check "after one that was too large" [ -s 4.picture ]
fi
rm -f ./*.line ./*.picture

# Workers wait, locked in; one that is ended while it draws, or before, is replaced.
if [ -d /proc/self/fd ]; then
    mkfifo pipe
    ulimit -c 0
    "$burnish" serve-stdio $options -j2 --size=8 --max-overdraw=1e9 <pipe >later 2>"$err" &
    server=$!
    exec 9>pipe
    both_wait() { [ "$(children $server | wc -l)" = 2 ]; }
    await both_wait
    if [ -n "$is_locked" ]; then
        for worker in $(children $server); do
            check "a worker is locked in before its request" await grep -q '^Seccomp:.*2' /proc/"$worker"/status
            check "its descriptors: $(ls /proc/"$worker"/fd)" [ "$(echo $(ls /proc/"$worker"/fd))" = "0 1 2 3 4 5" ]
        done
    fi
    request 1 '{"flags": ["--views=front", "--size=3000", "--samples=16"]}' sheets.obj >&9
    # busy: the number of workers that use processor time, so draw a picture.
    busy() { for worker in $(children $server); do ! computes "$worker" || echo "$worker"; done; }
    is_drawn() { [ -n "$(busy)" ]; }
    await is_drawn
    kill -ABRT $(busy)
    request 2 '{}' a.obj >&9
    exec 9>&-
    wait $server
    code=$?
    check "after a crash: exit code $code: $(cat "$err")" [ "$code" = 0 ]
    check "a crash: $(head -c 300 later | tr -d '\0')" grep -qa '"code":1,"error":".*signal 6 ' later
    check "a picture after it" grep -qa '{"code":0,"error":null,"report"' later
    check "nothing is left of it" [ -z "$(children $server)" ]
    rm -f pipe later
else
    skip "workers that crash, no /proc"
fi

# Importers: chosen by extension or flag, with the request's files as textures and its limits. A script acts as an importer.
bin=$scratch.bin
rm -rf "$bin"
mkdir "$bin"
trap 'rm -rf "$bin"' EXIT
export BURNISH_IMPORTERS="$bin"
"$here/../fuzz/seeds" "$bin/seeds"
tail -c +5 "$bin/seeds/bms/all" >"$bin/all.bms"
importer() {
    printf '#!/bin/sh\n%s\n' "$1" >"$bin/burnish-import-assimp"
    chmod +x "$bin/burnish-import-assimp"
}
echo 'an FBX' >a.fbx
cp "$here/../data/tiles.png" a.png
tiles=$(($(wc -c <a.png)))
importer "cat >>'$bin/input'; echo \"\$* \$(ls /proc/self/fd | wc -l)\" >>'$bin/arguments'; cat '$bin/all.bms'"
{
    request 1 "{\"name\": \"a.fbx\", \"files\": [{\"name\": \"a.png\", \"bytes\": $tiles}]}" a.fbx a.png
    request 2 '{"flags": ["--input-format=dae"]}' a.fbx
    request 3 '{"name": "a.fbx", "flags": ["--input-format=obj"]}' a.obj
    request 4 '{"name": ":teapot", "flags": ["--input-format=dae"]}'
} >in
serve -j1 --size=24
"$burnish" render a.fbx --size=24 --quiet --no-sandbox -o 1.png
check "an importer: $(head -c 300 1.line)" cmp 1.png 1.picture
check "its format" grep -q '"format":"fbx"' 1.line
check "by a flag: $(head -c 300 2.line)" grep -q '"format":"dae"' 2.line
check "without the texture" grep -q 'texture \\\"a.png\\\" was skipped' 2.line
check "what is named is not imported" grep -q '"format":"obj"' 3.line
check "a built-in object" grep -q '"format":"builtin"' 4.line
check "what it is given: $(cat "$bin/arguments")" [ "$(cut -d' ' -f1 "$bin/arguments" | tr '\n' ' ')" = "fbx dae fbx " ]
check "no descriptors: $(cat "$bin/arguments")" awk '$2 > 4 { exit 1 }' "$bin/arguments"
cat a.fbx a.fbx a.fbx >three.fbx
check "the file" cmp three.fbx "$bin/input"
rm -f three.fbx ./*.line ./*.picture 1.png
importer 'kill -SEGV $$'
{
    request 1 '{"name": "a.fbx"}' a.fbx
    request 2 '{"name": "a.step"}' a.fbx
    request 3 '{"name": "a.dae"}' a.obj
    request 4 '{"name": "a.obj"}' a.obj
} >in
serve -j1 --size=24
failed 1 4 'a.fbx: burnish-import-assimp crashed by signal 11'
failed 2 4 'a.step: burnish-import-occt reads such files and is not installed'
check "one that is something else: $(head -c 300 3.line)" [ -s 3.picture ]
check "the next one is drawn" [ -s 4.picture ]
rm -f ./*.line ./*.picture
mkfifo "$bin/never"
importer "echo \$\$ >'$bin/number'; read line <'$bin/never'"
{
    request 1 '{"name": "a.fbx"}' a.fbx
    request 2 '{"name": "a.obj"}' a.obj
} >in
serve -j1 --size=24 --max-seconds=0.2
failed 1 5 '' # the server's limit or the importer's own ends first
check "its reason: $(cat 1.line)" grep -qE 'takes too long; raise --max-seconds|10 times --max-seconds' 1.line
check "the next one is drawn" [ -s 2.picture ]
check "the importer has ended" await ended "$(cat "$bin/number")"
rm -f ./*.line ./*.picture a.fbx a.png

# An invalid frame ends the server after it has replied to the requests.
request 1 '{}' a.obj >in
printf 'GET / HTTP/1.0\r\n\r\n' >>in
serve -j1 --size=8
check "text: exit code $code" [ "$code" = 4 ]
check "text: $(cat "$err")" grep -q '^burnish: standard input: request 2: does not begin with a JSON object; see docs/serve.md$' "$err"
check "the reply before it" [ -s 1.picture ]
request 1 '{"name": "a.obj"}' a.obj | head -c 40 >in
serve
check "cut off: exit code $code: $(cat "$err")" grep -q '^burnish: standard input: request 1: incomplete$' "$err"
head -c 8 /dev/zero >in
serve
check "empty: exit code $code: $(cat "$err")" grep -q '^burnish: standard input: request 1: is empty; see docs/serve.md$' "$err"
rm -f ./*.line ./*.picture a.obj bad.obj sheets.obj m.mtl empty
expect 0 '' serve-stdio $options
expect 2 'burnish: serve-stdio: "x.stl" is not a flag; "burnish serve-stdio --help" lists the flags' serve-stdio x.stl
expect 2 'burnish: --no-background: .jpg has no alpha; write PNG or WebP' serve-stdio $options --no-background --output-format=jpeg
nothing_left "at the end"
finish
