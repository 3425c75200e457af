#!/bin/sh
# Planes of numbers: errors. planes.py tests the values.
# usage: cli_planes.sh BURNISH SCRATCH
. "$(dirname "$0")/lib.sh"
here=$(dirname "$(realpath "$0")")

expect 2 'burnish: --plane: "mist" is not one of depth, normal, triangle, material, coverage, color' render :sphere --plane=mist:x.png
expect 2 'burnish: --plane: "depth" has no file name; write depth:FILE' render :sphere --plane=depth
expect 2 'burnish: --plane: "depth:" has no file name; write depth:FILE' render :sphere --plane=depth:
expect 2 'burnish: --plane: "d.tif": planes are written as PNG, EXR or NPY; end the name in .png, .exr or .npy' render :sphere --plane=depth:d.tif
expect 2 'burnish: --plane: "d": planes are written as PNG, EXR or NPY; end the name in .png, .exr or .npy' render :sphere --plane=depth:d
expect 2 'burnish: --plane: "-": planes are written as PNG, EXR or NPY; end the name in .png, .exr or .npy' render :sphere --plane=depth:-
expect 2 'burnish: --plane: "d.jpg": planes are written as PNG, EXR or NPY; end the name in .png, .exr or .npy' render :sphere --plane=depth:d.jpg
expect 2 "burnish: --plane: linear colour can be written as NPY or EXR; --output writes PNG in sRGB" render :sphere --plane=color:c.png
expect 2 'burnish: --plane: "p.png" is another file of this run; name another one' render :sphere -o p.png --plane=depth:p.png
expect 2 'burnish: --plane: "d.npy" is another file of this run; name another one' render :sphere --plane=depth:d.npy --plane=normal:d.npy
expect 2 'burnish: --plane: a sheet has no planes; draw one view and one lobe' render :sphere --views=top,front --plane=depth:d.npy
expect 2 'burnish: --output: a sheet has no planes; draw one view and one lobe' render :sphere --views=top,front -o x.npy
nothing_left "wrong usage"

# Nothing shows: the range of depths is 0, every id none. A folder that is missing is the plane's.
gives 0 render :sphere --size=8 --camera-position=9,0,0 --camera-focal-point=20,0,0 --quiet -o p.png --plane=depth:d.png --json  # a blank plane
check "a blank plane: low" [ "$(json low)" = 0 ]
rm -f p.png d.png
expect 7 "burnish: none/d.npy: can't be written: No such file or directory; create the folder first" render :sphere --size=8 --plane=depth:none/d.npy
nothing_left "a plane that can't be written"

if ! "$burnish" render :sphere --size=8 -o x.exr 2>/dev/null; then
    skip "values, this build writes no EXR"
else
    check "$(PYTHONDONTWRITEBYTECODE=1 python3 "$here/planes.py" "$burnish" 2>&1 | tail -1)" \
        env PYTHONDONTWRITEBYTECODE=1 python3 "$here/planes.py" "$burnish"
fi
finish
