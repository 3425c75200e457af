#!/bin/sh
# burnish-import-occt: one part in three formats, and an assembly of two in STEP; intact and damaged.
# Usage: import_occt.sh PROGRAM FOLDER        (the importer is in the program's folder)
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../cli/lib.sh"
unset BURNISH_IMPORTERS
files=$here

# near VALUE WANTED: within a thousandth.
near() {
    awk -v a="$1" -v b="$2" 'BEGIN { exit !(a - b < b / 1000 && b - a < b / 1000) }'
}

# A box of 20 x 30 x 10 without a quarter of a cylinder of radius 5.
volume=5803.650
for file in part.igs part.brep part.brp two.step; do
    run info "$files/$file" --json
    wanted=$volume
    [ $file != two.step ] || wanted=$(awk "BEGIN { print 2 * $volume }")
    check "$file: volume $(json volume), not $wanted: $(cat "$err")" near "$(json volume)" "$wanted"
    check "$file: called $(json format)" [ "$(json format)" = "${file#*.}" ]
    check "$file: closed" [ "$(json closed)" = true ]
    run render "$files/$file" --size=100 --json -o p.png
    check "$file: up is $(json up)" [ "$(json up)" = +Z ]
    check "$file: no message: $(cat "$err")" [ ! -s "$err" ]
    run render "$files/$file" --size=100 --sandbox -o q.png
    check "$file: the same in a sandbox: $(cat "$err")" cmp -s p.png q.png
    rm -f p.png q.png
done

gzip -c "$files/part.igs" >part.igs.gz
run render "$files/part.igs" --size=100 -o p.png
run render part.igs.gz --size=100 -o q.png
check "gzip: $(cat "$err")" cmp -s p.png q.png
run render part.igs.gz --size=100 --json -o q.png
check "gzip: called $(json format)" [ "$(json format)" = igs ]
run batch part.igs.gz -d out --size=16
check "a batch calls it so, too" grep -q '"format":"igs"' out/burnish-batch.jsonl
rm -rf out
rm -f part.igs.gz p.png q.png

# An assembly of two, red with one face of another colour.
run info "$files/two.step" --json
check "box: $(json size)" [ "$(json size)" = 50,30,10 ]
check "millimetres" grep -q '"unit":"millimeter"' "$out"
check "materials: $(json materials)" [ "$(json materials)" = 3 ]
check "a part for each of two places: $(cat "$out")" [ "$(grep -o '"name":"COMPOUND"' "$out" | wc -l)" = 2 ]
check "shells: $(json shells)" [ "$(json shells)" = 2 ]

echo no >a.step
expect 4 "burnish: a.step: burnish-import-occt: Open CASCADE can't read it as STEP; repair the file, or export it again" info a.step
printf 'DBRep_DrawableShape\n\nCASCADE Topology V1, (c) Matra-Datavision\nno\n' >a.brep # of which the library speaks to standard output
expect 4 "burnish: a.brep: burnish-import-occt: Open CASCADE can't read it as BREP; repair the file, or export it again" info a.brep
rm -f a.step a.brep

python3 "$files/damage.py" "$burnish" "$files" "${IMPORT_DAMAGED:-40}" >"$out" 2>&1
check "damaged files: $(tail -n 3 "$out")" [ $? = 0 ]
tail -n 1 "$out"
nothing_left "import_occt"
finish
