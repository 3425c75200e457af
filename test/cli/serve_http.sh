#!/bin/sh
# The example of docs/serve.md behind its web server: the same pictures as render's, and HTTP errors for errors.
# Usage: serve_http.sh PROGRAM FOLDER SOURCES
for tool in waitress-serve curl; do
    command -v $tool >/dev/null || { echo "serve_http: $tool is missing (Debian: python3-waitress, curl)"; exit 77; }
done
here=$(cd "$(dirname "$0")" && pwd)
example=$(realpath "$3")/docs/examples/thumbnails.py
. "$here/lib.sh"
if ! draws --sandbox --max-memory=2G; then
    echo "serve_http: no sandbox here"
    exit 77
fi

mkdir bin
ln -s "$burnish" bin/burnish
cp "$example" .
PATH=$PWD/bin:$PATH PYTHONDONTWRITEBYTECODE=1 waitress-serve --threads=8 --unix-socket="$PWD/web" thumbnails:app >log 2>&1 &
server=$!
await [ -S web ]
ask() { curl -s --max-time 60 --unix-socket web "$@"; }

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >a.obj
printf 'v 0 0\n' >bad.obj
"$burnish" render a.obj --size=64 -o small.png
"$burnish" render a.obj --size=256 -o middle.png
check "small: $(cat log)" sh -c "$(command -v curl) -s --unix-socket web --data-binary @a.obj 'http://x/a.obj?size=64' | cmp - small.png"
for i in 1 2 3 4 5 6; do
    ask --data-binary @a.obj http://x/a.obj -o $i.png &
    clients="${clients:-} $!"
done
wait $clients
for i in 1 2 3 4 5 6; do
    check "six at a time: $i" cmp $i.png middle.png
done
check "an error" [ "$(ask --data-binary @bad.obj -w ' %{http_code}' http://x/bad.obj)" = "bad.obj:1: vertex has 2 numbers; write v x y z or v x y z r g b
 422" ]
check "a picture after it" [ "$(ask --data-binary @a.obj -o 7.png -w '%{http_code} %{content_type}' http://x/a.obj)" = "200 image/png" ]
kill $server
wait $server 2>/dev/null
rm -rf ./*.obj ./*.png bin log web thumbnails.py __pycache__
nothing_left "at the end"
finish
