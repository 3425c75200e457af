#!/bin/sh
# burnish view without a user: errors; saved pictures are the same as those of the
# printed command. Windows use SDL's dummy driver.
# Usage: cli_view.sh PROGRAM FOLDER
here=$(cd "$(dirname "$0")" && pwd)
. "$here/lib.sh"
export SDL_VIDEODRIVER=dummy

expect 2 'burnish: view: no INPUT; try "burnish view :teapot" or "burnish view --help"' view
expect 2 "burnish: view: standard input can't be reloaded for cuts and changes; name a file" view -
expect 2 'burnish: --views: the window starts with one view; use only one' view :sphere --views=front,top
expect 2 'burnish: --lobe: the window shows at most two lobes; omit some' view :sphere --lobe=power,schlick,gx
expect 2 'burnish: --do: "section-q": unknown action; did you mean section-x?' view :sphere --do=front,section-q
run view --help
check "the help screen names --do" grep -q -- --do "$out"
run help --man
check "the manual has the keys" grep -q 'exponent.*down' "$out"
if ! "$burnish" view :sphere --resolution=64,64 --do=quit 2>"$err"; then
    expect 2 'burnish: view: this program was built without SDL2; install libsdl2-dev and build again, or use burnish render' view :sphere
    skip "everything in a window, built without SDL2"
    finish
    exit
fi
expect 3 'burnish: none.stl: can'"'"'t be opened: No such file or directory' view none.stl --do=quit
SDL_VIDEODRIVER=none run view :sphere --do=quit
check "no display: exit code $code" [ "$code" = 3 ]
check "no display: one line: $(cat "$err")" grep -q '^burnish: view: no window can be opened: .*; use burnish render without a display$' "$err"

# Warnings about an input, its lights and cuts: once, although each section loads it again.
printf 'solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n' >open.stl
run view open.stl --resolution=64,64 --clip=1,0,0,0.5 --shadow --light=none --do=section-x,section-y,quit
same "warnings" "$(cat "$err")" 'burnish: warning: open.stl:8: "endsolid" is missing
burnish: warning: open.stl: cut but not filled: the mesh is not closed; 3 of its edges are open
burnish: warning: --shadow: no effect: a directional light that comes first casts it, or an area light; use --light=directional:X,Y,Z'
rm -f open.stl

# SDL starts no other program.
mkdir bin && printf '#!/bin/sh\ntouch "%s/started"\n' "$PWD" >bin/dbus-launch && chmod +x bin/dbus-launch
check "a window without a bus" env -u DBUS_SESSION_BUS_ADDRESS DISPLAY=:0 PATH="$PWD/bin:$PATH" \
    "$burnish" view :sphere --resolution=64,64 --do=quit
check "a bus was started" [ ! -e started ]
rm -rf bin started

# same_picture ACTIONS INPUT FLAGS...: key P saves the picture that the command printed by key C writes.
same_picture() {
    actions=$1
    shift
    gives 0 view "$@" --resolution=97,71 --do="${actions:+$actions,}screenshot,command,quit" -o shown.png
    command=$(sed "s|^burnish|'$burnish'|" "$out")
    input=$1
    shift
    eval "$command $* -o drawn.png" 2>"$err"
    check "$input, $actions: not the picture of $(cat "$out")" cmp -s shown.png drawn.png
    rm -f shown.png drawn.png
}
same_picture '' :teapot
same_picture front :teapot --material=metal
same_picture top,section-y,section-on "$here/../data/cube.obj"
same_picture turn-left,turn-up,zoom-in,exponent-up,lobe :knot
same_picture projection,turn-down,exponent-down,other-lobe,split :torus --ground --shadow
same_picture look,wireframe,iso,section-x,section-x :sphere
same_picture bottom,turn-up,lobe-back :teapot --up=+Z --samples=1

# The number in the file name, and a split view with the same lobe on both sides.
run view :sphere --resolution=64,64 --do=screenshot,screenshot,quit
check "two pictures of two names" cmp -s sphere-1.png sphere-2.png
run view :sphere --resolution=64,64 --lobe=power,schlick --do=screenshot,quit
for lobe in power schlick; do
    "$burnish" render :sphere --resolution=64,64 --lobe=$lobe -o $lobe.png 2>/dev/null
    run compare $lobe.png sphere-3.png --json
    check "$lobe on its side alone: $(json different_bounds)" [ "$(json different_pixels)" -gt 50 ]
done
run compare power.png sphere-3.png --json
check "power on the left: $(json different_bounds)" [ "$(json different_bounds | cut -d, -f1)" -ge 32 ]
run compare schlick.png sphere-3.png --json
check "schlick on the right: $(json different_bounds)" [ "$(json different_bounds | cut -d, -f3)" -le 32 ]
rm -f sphere-[1-3].png power.png schlick.png
run view :sphere --resolution=64,64 --frames=3
check "times: $(cat "$out")" grep -q '^3 frames of 64 x 64: median ' "$out"
nothing_left "view"
finish
