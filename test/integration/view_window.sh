#!/bin/sh
# burnish view under an X server: what keys and the mouse show, pixel by pixel as burnish render draws it; files
# that change.
# Usage: view_window.sh PROGRAM FOLDER
for tool in Xvfb xdotool import convert; do
    command -v "$tool" >/dev/null 2>&1 || { echo "view_window: SKIPPED: no $tool" && exit 77; }
done
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../cli/lib.sh"
"$burnish" view :sphere --help >/dev/null && SDL_VIDEODRIVER=dummy "$burnish" view :sphere --resolution=64,64 --do=quit ||
    { echo "view_window: SKIPPED: built without SDL2" && exit 77; }

# Xvfb prints a free display number.
mkfifo display
Xvfb -displayfd 3 -screen 0 640x480x24 -nolisten tcp -noreset 3>display >/dev/null 2>&1 &
server=$!
viewer=
trap 'kill $viewer $server 2>/dev/null' EXIT
read -r number <display
rm -f display
export DISPLAY=":$number" SDL_VIDEODRIVER=x11
mkdir ../shots 2>/dev/null || rm -rf ../shots/*
shots=$(realpath ../shots)

# open INPUT FLAGS...: a window of 320 x 240 without texts.
open() {
    "$burnish" view "$@" --resolution=320,240 --do=text >../view.out 2>../view.err &
    viewer=$!
    window=
    await xdotool search --onlyvisible --class burnish
    window=$(xdotool search --onlyvisible --class burnish 2>/dev/null | head -n 1)
    check "no window of $*: $(cat ../view.err)" [ -n "$window" ]
}

close() {
    xdotool key q
    check "Q does not end it" await ended $viewer
    wait $viewer
    code=$?
    check "exit code $code: $(cat ../view.err)" [ "$code" = 0 ]
    viewer=
}

# becomes TEXT PICTURE: waits until the window shows that picture.
is_seen() {
    import -silent -window "$window" png24:"$shots/seen.png" && "$burnish" compare "$shots/seen.png" "$1"
}
becomes() {
    await is_seen "$2"
    check "$1: $("$burnish" compare "$shots/seen.png" "$2" | head -n 3)" "$burnish" compare "$shots/seen.png" "$2"
}

draw() {
    name=$1
    shift
    "$burnish" render "$@" --resolution=320,240 -o "$shots/$name.png" || fail "render $*"
}

# Keys.
open :teapot --lobe=energy:2,power --exponent=40
xdotool key s
draw start :teapot --look=three-point --lobe=energy:2 --exponent=40
becomes "at the start" "$shots/start.png"
xdotool key f
draw front :teapot --look=three-point --lobe=energy:2 --exponent=40 --views=front
becomes "F" "$shots/front.png"
xdotool key t
draw top :teapot --look=three-point --lobe=energy:2 --exponent=40 --views=top
becomes "T" "$shots/top.png"
xdotool key Home w
draw wires :teapot --look=three-point --lobe=energy:2 --exponent=40 --wireframe
becomes "Home, W" "$shots/wires.png"
xdotool key w s
draw power :teapot --look=three-point --exponent=40 --lobe=power

# Dragging the divider of two lobes: one on the left, the other on the right.
xdotool mousemove --window "$window" 160 60 mousedown 1 mousemove --window "$window" 200 60 mousemove --window "$window" 240 60 mouseup 1
convert "$shots/start.png" \( "$shots/power.png" -crop 70x240+250+0 +repage \) -geometry +250+0 -composite png24:"$shots/both.png"
# the divider and its handle cover 18 columns
for picture in both start; do
    convert "$shots/$picture.png" -fill black -draw 'rectangle 230,0 249,239' png24:"$shots/$picture-0.png"
done
is_divided() {
    import -silent -window "$window" png24:"$shots/seen.png" &&
        convert "$shots/seen.png" -fill black -draw 'rectangle 230,0 249,239' png24:"$shots/seen-0.png" &&
        "$burnish" compare "$shots/seen-0.png" "$shots/both-0.png"
}
check "two lobes, divided at 240" await is_divided
xdotool key s
becomes "S again" "$shots/start.png"

# The mouse: dragging and the wheel change the command that key C prints.
xdotool mousemove --window "$window" 100 100 mousedown 1 mousemove --window "$window" 130 110 mouseup 1 click 4
xdotool key c
await [ -s ../view.out ]
check "C prints a camera: $(cat ../view.out)" grep -q -- '--camera-position=' ../view.out
eval "$(sed "s|^burnish|'$burnish'|" ../view.out) -o '$shots/dragged.png'"
becomes "dragged, and nearer by the wheel" "$shots/dragged.png"
close

# A file that changes.
printf 'solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n' >part.stl
draw one part.stl
open part.stl
becomes "a file" "$shots/one.png"
cp part.stl old.stl
mkfifo next.stl && mv next.stl part.stl # nobody writes to it
sleep 1
sed 's/vertex 0 1 0/vertex 0 2 1/' old.stl >next.stl && mv next.stl part.stl
rm -f old.stl
draw two part.stl
becomes "the file has changed" "$shots/two.png"
check "which is no other picture" sh -c "! '$burnish' compare '$shots/one.png' '$shots/two.png'"
close

# An environment that changes.
hdr='#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n'
printf "$hdr"'\200\100\100\200' >light.hdr
draw red :sphere --environment=light.hdr
open :sphere --environment=light.hdr
becomes "red light" "$shots/red.png"
printf "$hdr"'\100\100\200\200' >next.hdr && mv next.hdr light.hdr
draw blue :sphere --environment=light.hdr
becomes "the environment has changed" "$shots/blue.png"
check "which is no other light" sh -c "! '$burnish' compare '$shots/red.png' '$shots/blue.png'"
close
rm -f part.stl light.hdr
nothing_left "view"
rm -rf "$shots"
finish
