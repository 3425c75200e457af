#!/bin/sh
# SVG from the command line: every flag of render is drawn, refused, or changes no picture at all; flags
# without effect; sheets, millimetres and warnings.
# usage: cli_drawing.sh BURNISH SCRATCH
. "$(dirname "$0")/lib.sh"

# What the table of flags says about each: drawn (the drawing of a teapot differs), same (it does not), or
# refused (exit code 2). A value is in the middle of the flag's range, or one of its words, unless it is
# given here. Flags of no effect on a teapot, and those that need several inputs or another output, are not
# tried.
python3 - "$burnish" >../drawing.table <<'END'
import json, subprocess, sys
VALUES = {
    "resolution": "300,200", "rows": "0:5", "background-color": "silver", "plane": "depth:../d.npy", "up": "+Z", "lobe": "power",
    "light": "headlight", "environment": "room", "occlusion": "8", "camera-orthographic-height": "9", "clip": "0,1,0,1", "elevation": "10",
    "color-by": "height", "isa": "scalar", "json": "../j.json", "look": "drawing", "material": "metal", "viewer": "distant",
    "max-memory": "8000000000G", "max-input-bytes": "1000000", "camera-focal-point": "1,0,0", "camera-direction": "0,0,-1",
    "edges": "creases", "annotate": "axes,box,dimensions,grid", "section": "y",
}
UNTRIED = set("""paper camera-intrinsics output output-dir recursive files-from columns labels font no-labels output-format turntable camera
    environment-strength environment-turn center-lines input-format color-map color-range no-legend normals crease-angle
    animation-time animation variant plate joint scene hide only explode callouts thumbnail point-size no-libraries root sandbox reference reference-threshold reference-difference look""".split())
def value(flag):
    if flag["type"] == "switch" or flag["optional"]:
        return None
    if flag["words"]:
        return next(word for word in flag["words"] if word not in (flag["default"], "none"))
    if flag["type"] in ("integer", "number", "size"):
        middle = min((flag["low"] + flag["high"]) / 2, 100)
        number = min(2 * float(flag["default"]) or 20, flag["high"]) if (flag["default"] or "-")[0].isdigit() else middle
        return number if flag["type"] == "number" else int(number)
    return {"color": "red", "number or color": "0.5", "vector": "3,4,9"}[flag["type"]]
table = json.loads(subprocess.run([sys.argv[1], "help", "--json"], capture_output=True, check=True).stdout)
for flag in table["commands"][0]["flags"]:
    name = flag["name"]
    if name in UNTRIED:
        continue
    text = VALUES.get(name) or value(flag)
    kind = "same" if "process" in flag["phases"] else flag["svg"]
    print(kind, name + (f"={text}" if text else ""))
END
check "flags that are tried: $(wc -l <../drawing.table)" [ "$(wc -l <../drawing.table)" -gt 60 ]
gives 0 render :teapot --look=drawing --size=240 -o plain.svg
while read -r kind flag; do
    rm -f a.svg
    run render :teapot --look=drawing --size=240 -o a.svg "--$flag"
    if [ "$kind" = refused ]; then
        check "--$flag: exit code $code" [ "$code" = 2 ]
        check "--$flag: says $(cat "$err")" grep -q "^burnish: --${flag%%=*}: " "$err"
        check "--$flag: a file" [ ! -e a.svg ]
        continue
    fi
    check "--$flag: exit code $code: $(cat "$err")" [ "$code" = 0 ]
    if [ "$kind" = same ]; then
        check "--$flag: another drawing" cmp plain.svg a.svg
    else
        check "--$flag: the same drawing" sh -c '! cmp -s plain.svg a.svg'
    fi
done <../drawing.table
rm -f a.svg plain.svg
nothing_left "flags"

# Dimensions are labels; a scale is one of a parallel projection, and a perspective keeps the others.
run render :teapot --look=drawing --annotate=dimensions,scale --camera-orthographic -o a.svg
check "scale: $(cat "$err")" [ ! -s "$err" ]
check "labels: $(grep -o 'aria-label="[^"]*"' a.svg)" \
    [ "$(grep -o 'aria-label="[^"]*"' a.svg | sort | tr '\n' ' ')" = 'aria-label="1" aria-label="3.15" aria-label="4" aria-label="6.434" ' ]
for name in a.svg a.png; do
    expect 0 'burnish: warning: :teapot: --annotate: scale: a perspective has no scale, so the picture has no bar; use --camera-orthographic, or omit it' \
        render :teapot --look=drawing --annotate=box,dimensions,scale -o $name
done
check "the rest is drawn" grep -q 'aria-label="6.434"' a.svg
rm a.png

# Cut faces have an area and hatching, of each plane its own.
run render :torus --look=drawing --clip=0,0,1,0.1 --clip=1,0,0,0.2 -o a.svg
check "areas: $(grep -c evenodd a.svg)" [ "$(grep -c evenodd a.svg)" = 2 ]
check "hatching" [ "$(grep -c '<path fill="none" stroke' a.svg)" = 2 ]

# A section is a cut, seen square on from the side that a sign chooses.
for section in x:0.5=1,0,0,0.5=right y:1=0,1,0,1=top -z=0,0,-1,0=back +z:-0.5=0,0,1,-0.5=front; do
    gives 0 render :teapot "--section=${section%%=*}" --size=64 -o a.png
    cut=${section#*=}
    gives 0 render :teapot "--clip=${cut%=*}" "--views=${cut#*=}" --size=64 -o b.png
    check "--section=${section%%=*}" cmp a.png b.png
done
rm a.png b.png
expect 2 'burnish: --section: z = 9 does not cut the object; use an offset between -2 and 2' render :teapot --section=z:9
expect 2 'burnish: --section: "z:" is not an axis, such as x or -y, or an axis and an offset, such as z:5' render :teapot --section=z:
expect 2 'burnish: --views: --section already sets the camera; omit one of them, or cut with --clip' render :teapot --section=z --views=top
expect 2 'burnish: --azimuth: --section already sets the camera; omit one of them' render :teapot --section=z --azimuth=9
gives 0 render :teapot --section=z --turntable=a.gif --frames=2 --size=16
rm a.gif

# A PDF has the same lines, on a page in points.
run render :teapot --look=drawing --annotate=dimensions --size=100 --dpi=72 -o a.pdf
check "a PDF: $(cat "$err")" grep -q '/MediaBox \[0 0 100 100\]' a.pdf
check "labels of a PDF" grep -q '(6.434) Tj' a.pdf
expect 2 'burnish: --output: "a.pdf": a PDF has lines, not shading; use --look=drawing, or the extension .png' render :teapot -o a.pdf
rm a.pdf

# A sheet is as large as the picture of it, with its labels; dots per inch make millimetres.
run render :teapot --look=drawing --views=front,right,top,iso --size=100 --dpi=254 -o a.svg
run render :teapot --look=drawing --views=front,right,top,iso --size=100 --json -o a.png
check "a sheet's size: $(head -n 1 a.svg)" grep -q \
    "width=\"$(json width | sed 's/.$/.&/; s/\.0$//')mm\" .* viewBox=\"0 0 $(json width) $(json height)\"" a.svg
check "a sheet's cells" [ "$(grep -c '<svg x=' a.svg)" = 4 ]
check "a sheet's labels" [ "$(grep -cE 'aria-label="(front|right|top|iso)"' a.svg)" = 4 ]
rm a.svg a.png

block 4 2 1 >../block.obj
# Aligned views: top and front share columns, front and side rows, and the scale on paper is round.
for angle in third first; do
    run render ../block.obj --look=drawing --views=$angle-angle --annotate=dimensions,axes --hidden-lines --dpi=100 --size=1000x700 --json -o a.png
    check "$angle angle" python3 - "$out" $angle <<'END'
import json, sys
report = json.load(open(sys.argv[1]))
assert (report["width"], report["height"]) == (1000, 700), report
front, top, side, free = report["cells"]
assert side["view"] == {"third": "right", "first": "left"}[sys.argv[2]]
assert [c["column"] for c in report["cells"]] == [0, 0, 1, 1]
assert [c["row"] for c in report["cells"]] == {"third": [1, 0, 1, 0], "first": [0, 1, 0, 1]}[sys.argv[2]]
assert front["pixel_bounds"][0::2] == top["pixel_bounds"][0::2] and front["width"] == top["width"]
assert front["pixel_bounds"][1::2] == side["pixel_bounds"][1::2] and front["height"] == side["height"]
scale = front["pixels_per_unit"] * 25.4 / 100
assert abs(top["pixels_per_unit"] / front["pixels_per_unit"] - 1) < 1e-9 and side["pixels_per_unit"] == front["pixels_per_unit"]
assert any(abs(scale - d * 10.0**p) < 1e-9 * scale for d in (1, 2, 5) for p in range(-3, 4)), scale
END
done
run render ../block.obj --look=drawing --views=third-angle --annotate=dimensions,axes --dpi=100 -o a.svg
check "each length once: $(grep -o 'aria-label="[^"]*"' a.svg)" [ "$(grep -c 'aria-label="[0-9.]*"' a.svg)" = 3 ]
for sides in 24 12; do # a prism of 24 sides is round
    python3 -c "
from math import cos, sin, tau
n = $sides
for k in range(2 * n): print('v', 5 * cos(k % n * tau / n), 5 * sin(k % n * tau / n), k // n)
print('f', *range(n, 0, -1), '\nf', *range(n + 1, 2 * n + 1))
for k in range(n): print('f', k + 1, (k + 1) % n + 1, (k + 1) % n + n + 1, k + n + 1)" >prism.obj
    run render prism.obj --up=+Z --look=drawing --views=top --annotate=dimensions -o a.svg
    check "$sides sides: $(grep -o 'aria-label="[^"]*"' a.svg)" [ "$(grep -c 'aria-label="Ø10"' a.svg)" = "$((sides / 24))" ]
done
rm prism.obj
for label in 180=R5 270=Ø10; do # arcs have a radius, longer ones a diameter
    python3 -c "
from math import cos, radians, sin
points = [(0, 0)] + [(5 * cos(radians(a)), 5 * sin(radians(a))) for a in range(0, ${label%=*} + 1, 10)]
n = len(points)
for z in 0, 1:
    for x, y in points: print('v', x, y, z)
print('f', *range(n, 0, -1), '\nf', *range(n + 1, 2 * n + 1))
for k in range(n): print('f', k + 1, (k + 1) % n + 1, (k + 1) % n + n + 1, k + n + 1)" >arc.obj
    run render arc.obj --up=+Z --look=drawing --views=third-angle --annotate=dimensions -o a.svg
    check "${label%=*} degrees: $(grep -o 'aria-label="[^"]*"' a.svg)" grep -q "aria-label=\"${label#*=}\"" a.svg
done
rm arc.obj
# A plate with six pins, which are polygons of 48 sides; the fourth is larger.
block 60 40 1 >pins.obj
python3 - <<'END' >>pins.obj
from math import cos, sin, tau
for pin in range(6):
    first, x, y, r = 9 + 96 * pin, 10 + 20 * (pin % 3), 10 + 20 * (pin // 3), 6 if pin == 3 else 2.5
    for k in range(96):
        print("v %.9g %.9g %d" % (x + r * cos(k // 2 * tau / 48), y + r * sin(k // 2 * tau / 48), 1 + 4 * (k % 2)))
    for face in [range(1, 96, 2), range(94, -1, -2)] + [(k, (k + 2) % 96, (k + 3) % 96, k + 1) for k in range(0, 96, 2)]:
        print("f", *[first + corner for corner in face])
END
# Diameters once for equal circles, and positions from the left and the lower edge.
for angle in third first; do
    run render pins.obj --up=+Z --look=drawing --views=$angle-angle --paper=a3 --annotate=dimensions -o a.svg
    check "holes: $(cat "$err")$(grep -o 'aria-label="[^"]*"' a.svg)" [ "$(grep -o 'aria-label="[0-9Ø][^":]*"' a.svg | tr -d '\n')" = \
        "$(printf 'aria-label="%s"' 60 5 10 30 50 10 30 '5x Ø5' Ø12 40)" ]
done
expect 0 '' render pins.obj --up=+Z --look=drawing --views=third-angle --size=400 --annotate=dimensions -o a.svg # numbers are turned
run render pins.obj --up=+Z --look=drawing --views=third-angle --size=240 --annotate=dimensions -o a.svg
check "too small: $(cat "$err")" grep -q 'top has no room for [1-9]' "$err"
run render pins.obj --up=+Z --look=drawing --views=third-angle --annotate=dimensions -o a.pdf
check "a diameter in PDF" grep -aqF '(5x \3305) Tj' a.pdf
rm pins.obj a.pdf
# A section is one more view, at the same scale, in line with the front or the top view; the others are whole.
for section in x=front y=front z=top; do
    for angle in third first; do
        run render ../block.obj --up=+Z --look=drawing --views=$angle-angle --section=${section%%=*} --json -o a.svg
        check "a sheet with a section across ${section%%=*}" python3 - "$out" "$section" <<'END'
import json, re, sys
report, svg = json.load(open(sys.argv[1])), open("a.svg").read()
axis, row = sys.argv[2].split("=")
front, top, side, free, section = report["cells"]
beside, third = (front, section) if row == "front" else (top, free)
assert section["view"] == "section" and abs(section["pixels_per_unit"] / front["pixels_per_unit"] - 1) < 1e-9
assert (section["row"], third["column"], third["row"]) == (beside["row"], 2, front["row"]), report["cells"]
like = {"x": side, "y": front, "z": top}[axis]
size = lambda b: (b[2] - b[0], b[3] - b[1])
assert all(abs(a - b) <= 1 for a, b in zip(size(section["pixel_bounds"]), size(like["pixel_bounds"]))), (section, like)
assert [abs(n) for n in report["cuts"][0][:3]] == [axis == k for k in "xyz"] and len(report["cuts"]) == 1
assert svg.count("evenodd") == 1 and re.findall('aria-label="(A[^"]*)"', svg) == ["A", "A", "A-A"]
END
    done
done
block 100 100 40 >a.obj # the letters of the plane leave room for the height
expect 0 '' render a.obj --up=+Z --look=drawing --views=third-angle --paper=a4 --annotate=dimensions --section=z -o a.svg
block 200 58 14 >a.obj # longer arrows are no help here
expect 0 'burnish: warning: a.obj: front has no room for 1 of the annotations; enlarge the picture or its margin' \
    render a.obj --up=+Z --look=drawing --views=third-angle --size=300 --annotate=dimensions --section=x -o a.svg
# Pages have the size of their paper and a title block, which cuts names that are too long.
cp ../block.obj "a-part-whose-name-is-much-too-long-for-the-title-block-of-a-drawing-on-a-page-of-paper.obj"
for page in a4=297=210 a3=420=297; do
    run render a-part*.obj --look=drawing --views=first-angle --paper=${page%%=*} --dpi=254 -o a.svg
    size=${page#*=}
    check "visible edges are half a millimetre wide" grep -q 'stroke-width="5"' a.svg
    check "a page: $(head -n 1 a.svg)" grep -q "width=\"${size%=*}mm\" height=\"${size#*=}mm\"" a.svg
    for text in "${page%%=*}" mm '[0-9]*:1' 'a-part-whose-name-.*-the-[^"]*[.][.][.]'; do
        check "$text in $(grep -o 'aria-label="[^"]*"' a.svg)" grep -qi "aria-label=\"$text\"" a.svg
    done
done
rm a-part*.obj
# A page is not empty, whatever the size of its object.
for size in 1e-30 1e30; do
    block $size $size $size >a.obj
    expect 0 'burnish: warning: a.obj: a unit counts as a millimetre, which needs a scale beyond the 1:10000 to 50:1 of ISO 5455' \
        render a.obj --look=drawing --views=third-angle --paper=a4 --json=a.json -o a.svg
    check "an object of $size" python3 -c 'import json; assert min(c["covered_pixels"] for c in json.load(open("a.json"))["cells"]) > 9999'
done
rm a.obj a.json
expect 0 'burnish: warning: --size: no effect: --paper sets the size of the page; omit one of them' \
    render ../block.obj --views=third-angle --paper=a4 --size=800 -o a.svg --look=drawing
expect 2 'burnish: --views: first-angle is a whole sheet; omit the other views' render :sphere --views=top,first-angle
expect 2 'burnish: --lobe: a sheet of aligned views shows one lobe; omit the others' render :sphere --views=third-angle --lobe=power,schlick
expect 2 'burnish: --camera-orthographic: aligned views are parallel; omit the flag' render :sphere --views=third-angle --camera-orthographic=no
expect 2 'burnish: sheet: 100 x 100 pixels; aligned views need 240 to 16384 a side' render :sphere --views=third-angle --size=100
rm a.svg a.png

# The same bytes in the sandbox, by other threads and instruction sets.
run render :torus --look=drawing --clip=0,0,1,0.1 --annotate=dimensions --threads=1 --isa=scalar -o a.svg
run render :torus --look=drawing --clip=0,0,1,0.1 --annotate=dimensions --threads=3 -o b.svg
check "threads and instruction sets" cmp a.svg b.svg
rm a.svg b.svg

# Flags without an effect: a warning, the same picture, and an error with --strict.
useless() { # FLAG WHY ARGUMENTS...
    flag=$1
    why=$2
    shift 2
    expect 0 "burnish: warning: --$flag: no effect: $why" render "$@" -s 64 -o with.png
    gives 2 render "$@" -s 64 -o strict.png --strict
    check "$flag --strict: $(cat "$err")" grep -qxF "burnish: --$flag: no effect: $why" "$err"
    for argument; do
        shift
        case $argument in
        "--${flag%%=*}" | "--${flag%%=*}="*) ;;
        *) set -- "$@" "$argument" ;;
        esac
    done
    expect 0 '' render "$@" -s 64 -o without.png
    check "$flag: the same picture" cmp with.png without.png
    rm -f with.png without.png
}
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' >part.obj
frames='only a turntable has frames; use --turntable=FILE'
useless frames "$frames" --frames=10 :sphere
useless fps "$frames" --fps=10 :sphere
sheet='only a sheet has cells; use several --views or lobes'
useless columns "$sheet" --columns=2 --views=front :sphere
useless no-labels "$sheet" --no-labels :sphere
useless labels "$sheet" --labels=a,b :sphere
useless font "$sheet" --font=a.ttf :sphere
useless labels '--no-labels omits the labels; omit it' --labels=a,b --no-labels --views=front,top :sphere
useless same-scale 'only a sheet has several scales; use several --views or lobes' --same-scale --views=front :sphere
useless paper 'only aligned views have a page; use --views=third-angle' --paper=a4 :sphere
values='values of vertices are not shown; use --color-by'
useless color-map "$values" --color-map=grey :sphere
useless color-range "$values" --color-range=0:1 :sphere
useless no-legend "$values" --no-legend :sphere
useless color-map 'the colours of --color-by=normal are directions; use another value' --color-map=grey --color-by=normal :sphere
lines='no lines are drawn; use --edges'
useless edge-color "$lines" --edge-color=red :sphere
useless edge-width "$lines" --edge-width=3 --look=plain --views=front :sphere
useless camera-intrinsics 'they belong to one perspective at an exact position; use --camera-position' --camera-intrinsics=90,90,9,9 :sphere
useless camera-view-angle 'a parallel projection has no angle; use --camera-orthographic=no' --camera-view-angle=40 --views=front :sphere
useless viewer 'the viewer of a parallel projection is distant; use --camera-orthographic=no' --viewer=distant --look=plain --views=top :sphere
framed='other flags set the camera, so the object is not framed; omit one of them'
useless margin "$framed" --margin=0.1 --camera-position=1,2,3 :sphere
useless margin "$framed" --margin=0.1 --camera-orthographic-height=3 :sphere
environment='there is no environment; use --environment=sky, room or a file'
useless environment-turn "$environment" --environment-turn=20 :sphere
useless environment-strength "$environment" --environment-strength=2 :sphere
useless outline-contrast 'a transparent background has no colour; omit --no-background' --outline-contrast=99 --no-background :sphere
shaded='a drawing is not shaded; use another --look'
for flag in exposure=1 tone-mapping=filmic opacity=0.5 specular=1 exponent=9 equation=phong viewer=distant light=directional:1,1,1 lobe=power raytracing; do
    useless "${flag%%=*}" "$shaded" --look=drawing "--$flag" :teapot
done
useless quality 'only JPEG and WebP have it; use the extension .jpg or .webp' --quality=50 :sphere
useless reference-threshold 'there is no reference; use --reference=FILE' --reference-threshold=0.1 :sphere
expect 0 'burnish: warning: --exposure: no effect: EXR and NPY hold linear light; use another extension' \
    render :sphere -s 16 --exposure=1 -o light.npy
rm -f light.npy
# What the input decides
useless camera 'INPUT has no cameras; omit the flag' --camera=0 part.obj
useless camera '--views already sets the camera; omit one of them' --camera=0 --views=top part.obj
useless light=file 'INPUT has no lights; omit the flag' --light=file part.obj
useless animation 'only glTF files have animations; omit the flag' --animation=walk part.obj
useless variant 'INPUT has no variants; omit the flag' --variant=red part.obj
useless plate 'INPUT has no plates; omit the flag' --plate=2 part.obj
useless hide 'INPUT has no parts; omit the flag' --hide=a part.obj
useless thumbnail 'only 3MF files and G-code hold pictures of themselves; omit the flag' --thumbnail=only part.obj
useless animation-time 'only glTF files have animations; omit the flag' --animation-time=3 part.obj
useless tessellation 'only built-in objects such as :teapot have patches; omit the flag' --tessellation=3 part.obj
useless point-size 'only points and lines have a size, and INPUT has faces; omit the flag' --point-size=3 part.obj
expect 0 'burnish: warning: --zoom: no effect: a sheet of aligned views has its own layout; use other --views' \
    :sphere --views=third-angle --zoom=2 --size=300 -o with.png
expect 0 '' :sphere --views=third-angle --size=300 -o without.png
check "zoom: the same sheet" cmp with.png without.png
for flags in '--environment=sky' '--light=point:3,3,3' '--look=drawing'; do
    shadow='--shadow: no effect: a directional light that comes first casts it, or an area light; use --light=directional:X,Y,Z'
    expect 0 "burnish: warning: $shadow" :sphere $flags --shadow --size=64 -o with.png
    expect 0 '' :sphere $flags --size=64 -o without.png
    check "$flags --shadow: the same picture" cmp with.png without.png
    expect 2 "burnish: $shadow" :sphere $flags --shadow --strict --size=64 -o with.png
done
expect 0 'burnish: warning: --recursive: no effect: no INPUT is a folder; omit the flag' part.obj -r -s 8
run part.obj --columns=2 --point-size=3 -s 8 --json -q
same "warnings in JSON" "$(json warnings | grep -o noeffect | wc -l)$(cat "$err")" 2
# Of several inputs one is enough; otherwise there is one line.
memory=$(unlimited)
expect 0 '' part.obj :sphere --tessellation=3 -d several -s 8
expect 0 'burnish: warning: --point-size: no effect: only points and lines have a size, and INPUT has faces; omit the flag' \
    batch part.obj :sphere --point-size=3 -d several -s 8 $memory
gives 2 batch part.obj :sphere --point-size=4 --strict -d several -s 8 $memory
gives 0 compare part.obj :sphere --tessellation=3 --size=8 --threshold=1
check "one side is enough: $(cat "$err")" [ ! -s "$err" ]
gives 0 compare part.obj part.obj --tessellation=3 --size=8
check "no side: $(cat "$err")" [ "$(grep -c '^burnish: warning: --tessellation: no effect' "$err")" = 1 ]
gives 0 compare with.png with.png --azimuth=30
check "pictures: $(cat "$err")" grep -qx 'burnish: warning: --azimuth: no effect: pictures are not drawn; name a mesh, or omit the flag' "$err"
gives 0 compare with.png with.png --map=flip
check "no picture: $(cat "$err")" grep -qx 'burnish: warning: --map: no effect: only the picture has panels; use --output=FILE' "$err"
for flags in -r '--animation=a' '--tessellation=3'; do
    gives 0 info part.obj $flags
    check "info $flags: $(cat "$err")" grep -q -- "^burnish: warning: -.*: no effect: " "$err"
    gives 2 info part.obj $flags --strict
done
gives 0 batch part.obj --title=a -d several -s 8 $memory
check "title: $(cat "$err")" grep -qx 'burnish: warning: --title: no effect: only the page shows it; use --index' "$err"
rm -r several with.png without.png part.obj part.png
expect 2 'burnish: --color-by: a drawing has no colours; use another --look, or omit the flag' :sphere --color-by=height --look=drawing
nothing_left "useless flags"
for flags in '--edge-color=red --views=front' '--edge-width=2 --edges' '--margin=0.1 --camera-orthographic' \
    '--views=front --camera-orthographic=no --camera-view-angle=40' '--columns=1 --views=front,top' \
    '--look=drawing --color=red --light=directional:1,1,1' '--look=drawing --no-background --opacity=0.5' \
    '--look=drawing --environment=sky --specular=0.9 --lobe=power' \
    '--views=front --environment=sky --background-color=environment --camera-view-angle=80'; do
    expect 0 '' render :sphere --size=64 $flags -o a.png
done
rm a.png
cat >camera.gltf <<END
{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},{"camera":0,"translation":[0,0,4]}],
"cameras":[{"type":"perspective","perspective":{"yfov":0.8,"znear":0.1}}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}
END
expect 0 'burnish: warning: --camera: no effect: a turntable has cameras of its own; omit one of them' \
    render camera.gltf --camera=0 --azimuth=30 --turntable=with.gif --frames=2 --size=32
expect 0 '' render camera.gltf --azimuth=30 --turntable=without.gif --frames=2 --size=32
check "camera: the same turntable" cmp with.gif without.gif
rm camera.gltf with.gif without.gif

# Names of outputs among inputs, and of formats elsewhere.
expect 2 'burnish: render: "out.png" is an image, not a mesh; for several pictures, name a folder with -d' \
    render :sphere :torus out.png
expect 2 'burnish: --output: "a.mp4": only a turntable moves; write one with --turntable=FILE, in WebP, GIF, MP4 or WebM' \
    render :sphere -o a.mp4
expect 2 'burnish: render: "a.png" is an image, not a mesh; for several pictures, name a folder with -d' a.png :sphere
nothing_left "names"

# No output replaces a mesh, an input, or another file that is not a picture.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >part.obj
for format in stl gltf glb obj off ply 3mf bms stl.gz step FBX; do
    cp part.obj "keep.$format"
    for flags in 'part.obj --output=' 'part.obj --output-format=png --output=' 'part.obj --turntable=' 'part.obj --json=' \
        'part.obj --plane=depth:' 'info part.obj --json=' 'info part.obj --csv=' 'compare :sphere :torus --output=' \
        'compare :sphere :torus --json=' 'batch part.obj --sheet=' 'batch part.obj --report=' 'lobe table --output=' \
        'lobe table -o '; do
        gives 2 ${flags}keep.$format
    done
    check "keep.$format stays" cmp part.obj "keep.$format"
    rm "keep.$format"
done
expect 2 'burnish: --plane: "./new.png" is another file of this run; name another one' \
    part.obj -o a.png --plane=depth:new.png --plane=normal:./new.png
expect 2 'burnish: --json: "./new.png" is the picture; name another file' part.obj -o new.png --json=./new.png
expect 2 'burnish: --json: "./new.png" is the picture; name another file' compare part.obj part.obj -o new.png --json=./new.png
cp part.obj kept.obj
ln -s kept.obj link.png
for flags in 'part.obj --output=' 'part.obj --plane=depth:' 'compare :sphere :torus --output=' 'batch part.obj -d . --sheet=' \
    'lobe table --output='; do
    gives 2 ${flags}link.png
    check "${flags}link.png: $(cat "$err")" grep -q 'is a link to a mesh; name another file' "$err"
done
check "a mesh behind a link stays" cmp part.obj kept.obj
rm link.png kept.obj
ln part.obj other.obj
for flags in 'part.obj --json=' 'info part.obj --json=' 'batch part.obj --report=' 'part.obj -o s.png --plane=depth:' \
    ':sphere --font=part.obj --json=' ':sphere --files-from=part.obj --json='; do
    gives 2 ${flags}other.obj
    check "$flags: $(cat "$err")" grep -q '"other.obj" is an input; name another file' "$err"
done
check "no pictures" [ "$(ls)" = "$(printf 'other.obj\npart.obj')" ]
echo text >note
for extension in txt '' abc; do
    mv note* "note${extension:+.$extension}"
    gives 2 part.obj -o note* -s 8 --output-format=png
    check "note.$extension stays" [ "$(cat note*)" = text ]
    [ -z "$extension" ] || gives 2 part.obj -o note* -s 8
done
expect 0 '' part.obj -o note.abc -s 8 --output-format=png --overwrite
expect 0 '' part.obj -o note.abc -s 9 --output-format=png
same "a picture under another name" "$(png_size note.abc)" "9 9"
: >note.abc
expect 0 '' part.obj -o note.abc -s 8 --output-format=png
rm note.abc other.obj
expect 2 'burnish: -dash.obj: a mesh, or a value of -d? Write ./-dash.obj, or --output-dir=ash.obj' part.obj -dash.obj

# A folder, as cp takes it.
mkdir to
cp part.obj two.obj
for arguments in 'part.obj to' 'part.obj -o to' 'part.obj -o to/' 'part.obj to/ --json=r.json --plane=depth:to/d.npy'; do
    expect 0 '' $arguments -s 8
    check "$arguments: to/part.png" [ -s to/part.png ]
    rm to/part.png
done
check "one picture, with a report and a plane" [ -s r.json -a -s to/d.npy ]
rm r.json to/d.npy
for arguments in 'part.obj two.obj to' 'part.obj two.obj -o to/'; do
    expect 0 '' $arguments -s 8
    check "$arguments: two pictures" [ -s to/part.png -a -s to/two.png ]
    rm to/*
done
echo texture >to/part.png
gives 11 part.obj two.obj to -s 8
gives 2 part.obj to -s 8
same "a texture in the folder stays" "$(cat to/part.png)" texture
rm -r to
for arguments in 'part.obj to/' 'part.obj -o to/' 'part.obj two.obj to/' 'part.obj two.obj -o to/'; do
    expect 7 'burnish: to/: there is no such folder; create it, or use --output-dir=to/, which creates it' $arguments
done
run part.obj - -s 8
same "a picture on standard output" "$code$(png_size "$out")" "08 8"
expect 2 'burnish: render: standard output takes one picture; for several, name a folder with -d' part.obj two.obj -
rm part.obj two.obj
nothing_left "folders"

# Plates: cells with their names, in one scale; empty plates are left out.
run :sphere --no-background -s 16 -o own.png
python3 - <<'END'
import zipfile
corners = ["0 0 0", "8 0 0", "0 8 0", "0 0 8"]
vertices = "".join('<vertex x="%s" y="%s" z="%s"/>' % tuple(c.split()) for c in corners)
faces = "".join('<triangle v1="%s" v2="%s" v3="%s"/>' % tuple(f) for f in ["021", "013", "032", "123"])
with zipfile.ZipFile("plates.3mf", "w") as archive:
    archive.write("own.png", "Metadata/plate_1.png")
    archive.writestr("3D/3dmodel.model", '<model><resources><object id="1"><mesh><vertices>%s</vertices><triangles>%s</triangles></mesh>'
        '</object></resources><build><item objectid="1"/><item objectid="1" transform="2 0 0 0 2 0 0 0 2 90 0 0"/></build></model>'
        % (vertices, faces))
    archive.writestr("Metadata/model_settings.config", "<config>%s<plate/></config>" % "".join(
        '<plate><metadata key="plater_name" value="p"/><model_instance><metadata key="object_id" value="1"/>'
        '<metadata key="instance_id" value="%d"/></model_instance></plate>' % i for i in range(2)))
END
run plates.3mf --plate=sheet -s 40 -o sheet.png --json=-
same "cells of plates" "$code $(python3 -c 'import json, sys
cells = json.load(sys.stdin)["cells"]
print(*[c["plate"] for c in cells], cells[1]["covered_pixels"] > 2 * cells[0]["covered_pixels"])' <"$out")" '0 1 2 True'
gives 2 plates.3mf --plate=sheet --views=front,top -o x.png
same "a picture of the file has no hairline" "$(for contrast in 0 255; do
    "$burnish" -q plates.3mf --thumbnail=only --outline-contrast=$contrast -s 40 -o - | cksum; done | uniq | wc -l)" 1
rm plates.3mf sheet.png own.png
nothing_left "plates"

# Without a command; an output as the second operand; short flags and sides.
expect 0 '' :sphere -s 40
same "the default name" "$(png_size sphere.png)" "40 40"
expect 0 '' :sphere out.png --size=50x40
same "W x H" "$(png_size out.png)" "50 40"
expect 0 '' --width=512 :sphere out.png
same "the height follows" "$(png_size out.png)" "512 384"
expect 0 '' render :sphere --height=30 --size=20x10 -o out.png
same "the width follows" "$(png_size out.png)" "60 30"
expect 0 '' render :sphere --height=30 --width=70 -o out.png
same "both sides" "$(png_size out.png)" "70 30"
expect 0 '' :sphere turn.gif -q --size=8 --frames=2
same "an animation" "$(head -c 3 turn.gif)" GIF
expect 0 '' :sphere own.npy -q --size=8 && expect 0 '' :sphere own.npy -q --size=8
echo texture >foreign.png
expect 2 'burnish: foreign.png: exists and was not written by burnish; replace it with --overwrite, or name the picture with --output=FILE' \
    :sphere foreign.png
same "a file of others stays" "$(cat foreign.png)" texture
if script -qec : /dev/null >/dev/null 2>&1; then
    script -qec "'$burnish' :sphere -s 40 terminal.png; '$burnish' -q :sphere -s 40 terminal.png" /dev/null >"$out"
    same "a terminal gets the name" "$(tr -d '\r' <"$out")" 'burnish: wrote terminal.png, 40 x 40'
else
    skip "the line for a terminal, no pseudo-terminal here"
fi
same "an axis without sign" "$(for up in +Z Z z; do "$burnish" :teapot --up=$up -s 16 -o - | cksum; done | sort -u | wc -l)" 1
for extension in jpg exr webp gif svg pdf mp4 webm; do
    ! "$burnish" -q :sphere --look=drawing -s 16 "own.$extension" 2>/dev/null ||
        expect 0 "" :sphere --look=drawing -s 16 "own.$extension" # a build can lack the format
done
rm -f ./*.png turn.gif own.*
nothing_left "short command lines"

finish
