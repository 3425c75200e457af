#!/bin/sh
# Rows of a picture: errors, the report, and files of rows that form the whole picture together.
# usage: cli_rows.sh BURNISH SCRATCH
. "$(dirname "$0")/lib.sh"

for text in 5 5: :5 -1:5 0:0 0:5:7 0,5 x:y 1.5:2 16384:1 0:16385; do
    expect 2 "burnish: --rows: \"$text\" is not a first row, counted from 0, and a number of rows, such as 0:64" render :sphere --rows=$text
done
expect 2 'burnish: --rows: the picture has no row 100; its 100 are counted from 0' render :sphere --size=100 --rows=50:51
expect 2 'burnish: --turntable: not available with --rows; omit one of them' render :sphere --rows=0:5 --turntable=t.gif
expect 2 'burnish: --annotate: not available with --rows; omit one of them' render :sphere --rows=0:5 --annotate=axes
expect 2 'burnish: --views: not available with --rows; omit one of them' render :sphere --rows=0:5 --views=top,front
expect 2 'burnish: --rows: is of one picture; draw one INPUT, without --output-dir' render :sphere :knot --rows=0:5 -d out
expect 2 'burnish: --rows: an SVG has the lines of all rows; omit the flag, or use the extension .png' render :sphere --rows=0:5 --look=drawing -o s.svg
nothing_left "wrong usage"

# The report, and no warning of rows that show nothing.
gives 0 render :sphere --resolution=60,200 --rows=150:30 --json -o p.png
check "rows: $(json rows)" [ "$(json rows)" = 150,30 ]
check "rows: height $(json height)" [ "$(json height)" = 30 ]
valid_json
gives 0 render :sphere --resolution=60,200 --rows=0:3 -o p.png
check "empty rows: $(cat "$err")" [ ! -s "$err" ]
run render :sphere --size=50 --views=front --json -o p.png
scale=$(json pixels_per_unit)
run render :sphere --size=50 --views=front --rows=3:7 --json -o p.png
check "rows have another scale" [ "$(json pixels_per_unit)" = "$scale" ]

# values FILE BYTES: the numbers at the end of a file.
values() {
    tail -c "$2" "$1"
}
for flags in "--look=studio --ground" "--look=three-point --shadow" "--look=technical --no-background" "--look=drawing --samples=8" \
    "--look=studio --opacity=0.5 --clip=0,0,1,0.1"; do
    gives 0 render :knot --resolution=90,150 $flags -o whole.npy --plane=depth:depth.npy
    values whole.npy $((90 * 150 * 16)) >whole.raw
    values depth.npy $((90 * 150 * 4)) >depth.raw
    rm -f rows.raw depths.raw
    for rows in 0:1 1:63 64:70 134:16; do
        gives 0 render :knot --resolution=90,150 $flags --rows=$rows -o rows.npy --plane=depth:depth.npy
        values rows.npy $((90 * ${rows#*:} * 16)) >>rows.raw
        values depth.npy $((90 * ${rows#*:} * 4)) >>depths.raw
    done
    check "$flags: rows together are not the picture" cmp rows.raw whole.raw
    check "$flags: depths of rows together are not the picture's" cmp depths.raw depth.raw
done
finish
