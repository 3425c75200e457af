#!/bin/sh
# burnish batch: the pictures of render, what is left unchanged, failures, limits, names, a report that does not depend on
# the number of workers.
# Usage: cli_batch.sh PROGRAM FOLDER
here=$(cd "$(dirname "$0")" && pwd)
. "$here/lib.sh"

# batch ARGUMENTS...: a run.
memory=$(unlimited)
batch() {
    run batch "$@" $memory
}

# lines FILE: a report without times.
lines() {
    sed 's/,"seconds":{[^}]*}//' "$1"
}

# A folder of meshes: one stem twice, a material, two that are broken, names that shells dislike.
mkdir -p in/sub in/sub/.hidden
triangle='v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'
strange=$(printf 'in/sub/new\nline \377<&".obj')
for file in in/a.obj in/sub/a.obj in/sub/-x.obj "$strange" in/sub/.hidden/h.obj; do
    printf "$triangle" >"$file"
done
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >in/a.off
printf 'mtllib m.mtl\nusemtl r\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >in/sub/m.obj
printf 'newmtl r\nKd 1 0 0\n' >in/sub/m.mtl
echo junk >in/broken.stl
printf 'v 0 0\n' >in/bad.obj
echo text >in/readme.txt

# Pictures are the same as render's in every folder, and a failure does not stop the batch.
batch in -r -d out --size=32 --index --sheet=sheet.png -j7
check "some failed: exit code $code" [ "$code" = 11 ]
check "failures are listed: $(cat "$err")" [ "$(grep -c '^burnish: in/' "$err")" = 2 ]
check "and counted" grep -q '^burnish: 2 of 8 failed$' "$err"
check "nothing on standard output" [ ! -s "$out" ]
for pair in a.obj:a.obj a.off:a.off sub/a:sub/a.obj sub/-x:sub/-x.obj sub/m:sub/m.obj; do
    "$burnish" render "in/${pair#*:}" --size=32 --threads=1 -o one.png
    check "${pair%:*}: as render draws it" cmp one.png "out/${pair%:*}.png"
    rm -f one.png
done
check "a strange name" [ -s "$(printf 'out/sub/new\nline \377<&".png')" ]
check "six pictures, the sheet, and no temporary" [ "$(find out -type f | wc -l)" = 10 ]
check "a line each" [ "$(wc -l <out/burnish-batch.jsonl)" = 9 ]
check "bytes of a name that is not UTF-8" grep -q '"input_bytes":"in/sub/new%0Aline%20%FF%3C%26%22.obj"' out/burnish-batch.jsonl
for line in 1 2 4; do
    sed -n ${line}p out/burnish-batch.jsonl >"$out"
    check "line $line is JSON" valid_json
done
check "the page: cards" [ "$(grep -c '^<article ' out/index.html)" = 6 ]
check "the page: markup in names" grep -q 'new?line ?&lt;&amp;&quot;.obj' out/index.html
check "the page: links" grep -q 'src="sub/new%0Aline%20%FF%3C%26%22.png"' out/index.html
check "the page: search and order stay in one row" \
    [ "$(tr -d '\n' <out/index.html | grep -c '<div id="tools"><input[^>]*><select.*</select></div>')" = 1 ]
check "the page: By name sorts by name, also at first" [ "$(grep -cE "names\[a\].localeCompare\(names\[b\],'en',\{numeric:true\}\)|^show\(\);sort\(\);" out/index.html)" = 2 ]
check "the page: failures" grep -q '<a class="bad" href="#failed">2 failed</a>' out/index.html
printf 'v 0 0 0\nv 10 0 0\nv 0 20 0\nv 0 0 30\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' >tet.obj
batch tet.obj in/a.obj -d facts --size=16 --facts --unit=mm --index --title='Parts & more'
check "facts: a tetrahedron has a sixth of its box" grep -q '"volume":1000,"area":.*"closed":true,"solid":true,"open_edges":0,"shells":1' facts/burnish-batch.jsonl
check "the page: volume" grep -q '10 &times; 20 &times; 30 mm<br>1 cm&sup3;' facts/index.html
python3 - <<'END'
import zipfile
vertices = "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in [(0, 0, 0), (10, 0, 0), (0, 20, 0), (0, 0, 30)])
mesh = f"<mesh><vertices>{vertices}</vertices><triangles>" + "".join(
    '<triangle v1="%d" v2="%d" v3="%d"/>' % face for face in [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]) + "</triangles></mesh>"
with zipfile.ZipFile("plates.3mf", "w") as archive:
    archive.writestr("3D/3dmodel.model", '<model xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object '
        f'id="1">{mesh}</object></resources><build><item objectid="1"/><item objectid="1"/></build></model>')
    archive.writestr("Metadata/project_settings.config", '{"filament_colour":["#FF8000"]}')
    archive.writestr("Metadata/model_settings.config", "<config>" + "".join(
        f'<plate><metadata key="plater_name" value="&lt;{i}"/><model_instance><metadata key="object_id" value="1"/><metadata '
        f'key="instance_id" value="{i}"/></model_instance></plate>' for i in range(2)) + "<plate/></config>")
END
batch plates.3mf -d project --size=16 --index
plate='"name":"<1","size":[10,20,30]},{"number":3,"name":"","size":null}],"filaments":["#FF8000"]'
check "plates in the report" grep -qF "$plate" project/burnish-batch.jsonl
check "the page: plates" grep -q 'style="background:#FF8000"></i><br>Plate 1, &lt;0: 10 &times; 20 &times; 30 mm<br>Plate 2' project/index.html
rm -r project plates.3mf
check "the page: a badge" [ "$(grep -c 'not closed</span>, 3 open edges' facts/index.html)" = 1 ]
check "the page: its title" grep -q '<h1>Parts &amp; more</h1>' facts/index.html
for flags in '' --overwrite; do
    echo mine >facts/index.html
    batch tet.obj -d facts --size=16 --index $flags
    check "a page of somebody else $flags" [ "$(grep -c mine facts/index.html)" = "$([ "$flags" ] && echo 0 || echo 1)" ]
done
for flag in sheet report; do
    expect 2 "burnish: --$flag: \"other/tet.png\" is a picture of this batch; name another file" \
        batch tet.obj -d other --size=16 --$flag=tet.png
done
for target in mine.png linked.png; do
    echo mine >facts/mine.png
    ln -sf mine.png facts/linked.png
    gives 2 batch tet.obj -d facts --size=16 --sheet=$target
    check "a sheet over $target: $(cat "$err")" grep -q 'exists and was not written by burnish; replace it with --overwrite' "$err"
    check "$target stays" [ "$(cat facts/mine.png)" = mine ]
done
batch tet.obj -d facts --size=16 --sheet=mine.png --overwrite
batch tet.obj -d facts --size=16 --sheet=mine.png
check "a sheet of burnish is replaced: $(cat "$err")" [ "$code" = 0 ]
expect 2 'burnish: --report: "facts/index.html" is the page of --index; name another file' \
    batch tet.obj -d facts --size=16 --index --report=index.html
batch tet.obj in/a.obj -d facts --size=16
check "without facts all is drawn again" [ "$(grep -c volume facts/burnish-batch.jsonl)" = 0 ]
rm -r facts tet.obj
check "the page asks for nothing else" [ "$(grep -cE 'https?:|url\(|@import' out/index.html)" = 0 ]
cp in/a.obj b.obj
batch b.obj in/a.obj -d columns --size=32 --sheet=tall.png --columns=1
check "columns: $(cat "$err")" [ ! -s "$err" ]
check "a column of two" sh -c '[ "$1" -lt "$2" ]' - $(png_size columns/tall.png)
rm -r columns b.obj
check "the sheet is a PNG" [ "$(head -c 4 out/sheet.png | tail -c 3)" = PNG ]

# Labels that are too long lose their middle: parts often differ at the end of their names.
sheet_of() {
    cp in/a.obj "$1.obj" && batch "$1.obj" -d labels --size=128 --sheet="./$2.png" && rm "$1.obj"
}
sheet_of Mount_for_a_screw_left left
sheet_of Mount_for_a_screw_rear rear
sheet_of Mount_for_the_screw_left middle
check "a label shows the end of a name" test "$(cmp left.png rear.png >difference; echo $?)" = 1
check "and not its middle" cmp left.png middle.png
rm -r left.png rear.png middle.png difference labels

# No byte depends on the number of workers.
lines out/burnish-batch.jsonl >seven
batch in -r -d out --size=32 -j1 --force
lines out/burnish-batch.jsonl >one
check "one worker, the same report" cmp one seven
rm -f one seven out/sheet.png

# Unchanged pictures stay. A changed input, referenced file or flag, or a missing picture, causes a new drawing.
# drawn WANTED ARGUMENTS...: the pictures that a run writes.
drawn() {
    wanted=$1
    shift
    find out -name '*.png' -exec touch -d @1000000000 {} +
    batch in -r -d out "$@"
    now=$(find out -newermt @1000000000 -name '*.png' | sort | tr '\n' ' ')
    check "drawn: '$now', not '$wanted'" [ "$now" = "$wanted" ]
}
drawn '' --size=32
if draws --sandbox; then
    printf 'newmtl r\nKd 0 1 0\n' >in/sub/m.mtl
    drawn 'out/sub/m.png ' --size=32
else
    skip "a library that changed, no sandbox here reports what was read"
fi
echo 'v 5 0 0' >>in/a.obj
rm out/sub/a.png
drawn 'out/a.obj.png out/sub/a.png ' --size=32
rm -rf in/sub/new*
drawn 'out/a.obj.png out/a.off.png out/sub/-x.png out/sub/a.png out/sub/m.png ' --size=33
rm -rf out marker
# A file that a flag names: changed bytes count, of the same length and time too; the same bytes with another time do not.
# hdr BYTE: an environment of two pixels of that grey.
hdr() {
    printf "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\\$1\\$1\\$1\\201\\$1\\$1\\$1\\201" >e.hdr
    touch -d @1000000000 e.hdr
}
hdr 100
batch in/a.off -d out --size=16 --environment=e.hdr
drawn_as() {
    touch -d @1000000000 out/a.png
    batch in/a.off -d out --size=16 --environment=e.hdr "$@"
    "$burnish" render in/a.off --size=16 --environment=e.hdr -o one.png
    check "with --environment=e.hdr: as render draws it" cmp one.png out/a.png
}
drawn_as
check "the same environment: drawn again" [ -z "$(find out -newermt @1000000000 -name a.png)" ]
cp out/a.png first.png
hdr 300
drawn_as
differs "a changed environment" "$(cksum <first.png)" "$(cksum <out/a.png)"
check "its hash: $(head -n 1 out/burnish-batch.jsonl)" [ "$(head -n 1 out/burnish-batch.jsonl | grep -cE '"options_hash":"[0-9a-f]{16}"')" = 1 ]
touch e.hdr
drawn_as
check "the same bytes with another time: drawn again" [ -z "$(find out -newermt @1000000000 -name a.png)" ]
rm -rf out e.hdr one.png first.png
# Parts: each input in one of them, as equal in bytes as can be; together they are the whole, and a part that is missing is drawn
# by the run that writes the report of all.
batch in -r -d out --size=16 --no-seconds
check "--no-seconds" [ "$(grep -c seconds out/burnish-batch.jsonl)" = 0 ]
mv out reference
for part in 1 3 7; do
    batch in -r -d out --size=16 --no-seconds --shard=$part/7
    check "part $part: some failed or none: $code" [ "$code" = 0 -o "$code" = 11 ]
done
check "three parts of 7" [ "$(cat out/*.jsonl | grep -c '"id"')" = 3 ]
check "no input twice" [ -z "$(cat out/*.jsonl | grep '"id"' | cut -c1-30 | sort | uniq -d)" ]
touch -d '2001-01-01' out/*.png out/*/*.png
batch in -r -d out --size=16 --no-seconds
check "what parts have drawn is left" [ -n "$(find out -name '*.png' ! -newermt 2002-01-01)" ]
check "what no part has drawn is not" [ -n "$(find out -name '*.png' -newermt 2002-01-01)" ]
check "the parts are the whole: $(diff -r out reference 2>&1 | head -n 3)" diff -r out reference
rm -rf out
for part in 1 2 3 9; do batch in -r -d out --size=16 --no-seconds --shard=$part/9; done # more parts than inputs
check "parts without inputs" [ "$(find out -name '*.jsonl' | wc -l)" = 4 ]
rm -rf out reference
for part in 0/3 4/3 1.5/3 3 /; do
    expect 2 "burnish: --shard: \"$part\": expected I/N with 1 <= I <= N <= 1000000, such as 3/100, or rank" batch in --shard=$part
done
for wrong in "x 2" "2 2" "-1 2" "0 1000001" "0 2x" "1e9 2e9"; do
    OMPI_COMM_WORLD_RANK=${wrong% *} OMPI_COMM_WORLD_SIZE=${wrong#* } gives 2 batch in --shard=rank
done
expect 2 'burnish: --shard: neither mpirun nor srun has set a rank; start burnish with one of them, or give I/N, such as 3/100' batch in --shard=rank
# Ranks: mpirun would end the others if one had another exit code than 0.
for rank in 0 1 2; do
    export PMI_RANK=$rank PMI_SIZE=3
    batch in -r -d out --size=16 --shard=rank
    check "rank $rank: exit code $code, $(cat "$err")" [ "$code" = 0 ]
done
unset PMI_RANK PMI_SIZE
check "ranks are parts" [ "$(find out -name '*-of-3.jsonl' | wc -l)" = 3 ]
check "a rank has a failed input" grep -q '"status":"failed"' out/burnish-batch-*.jsonl
rm -rf out
expect 2 'burnish: --shard: not with --index or --sheet; after all parts, run the same command without --shard to write them' \
    batch in --shard=1/2 --index
rm -rf out

# Names: lists, templates, views; nothing outside the folder, no duplicate pictures.
printf 'in/a.obj\nin/a.obj\n' >list
batch --files-from=list -d out --size=8
check "a list: $(cat "$err")" [ "$code$(wc -l <out/burnish-batch.jsonl)" = 02 ]
find in/sub -name '-x.obj' -print0 >list
batch --files-from=list in/a.obj -d out --size=8 --views=front,top -o '{extension}/{model}_{view}.png'
check "a template's pictures" [ -s out/obj/-x_front.png -a -s out/obj/a_top.png -a -s out/a.png ]
expect 2 'burnish: --output: "../x.png" leads out of --output-dir; name the folder there' batch in -o ../x.png
expect 2 'burnish: --output: "{name}" is none of {model}, {folder}, {extension} and {view}' batch in -o '{name}.png'
expect 2 'burnish: --output: {view} needs views, such as --views=front,top' batch in -o '{view}.png'
expect 2 'burnish: --output: "in/a.obj" and another input would both be written to "out/x.png"; put {folder} or {model} into the name' \
    batch in/a.obj in/a.off -d out -o x.png
expect 2 'burnish: batch: no INPUT; try "burnish batch FOLDER --output-dir=thumbs" or "burnish batch --help"' batch
mkdir empty
expect 2 'burnish: no meshes there; --recursive looks into folders below' batch empty
expect 2 'burnish: --report: "in/readme.txt" exists but is not a report of burnish batch; name another file' batch :sphere --report=in/readme.txt -d out
expect 2 'burnish: --report: "in/a.obj" has the extension of a mesh, which this file is not; end the name otherwise' batch :sphere --report=in/a.obj -d out
for name in in/a.obj s.exr; do
    gives 2 batch :sphere --sheet=$name -d sheets
    check "no sheet $name, and no pictures" [ ! -e sheets ]
done
# Folders that are not searched are mentioned once, unless they hold the pictures.
mkdir -p tree/below
cp in/a.obj tree
expect 0 'burnish: warning: 1 folder in INPUT was skipped; --recursive searches it' batch tree -d skipping --size=8 $memory
mkdir tree/another tree/thumbs
expect 0 'burnish: warning: 2 folders in INPUT were skipped; --recursive searches them' batch tree -d tree/thumbs --size=8 $memory
expect 0 'burnish: warning: 3 folders in INPUT were skipped; --recursive searches them' tree -d skipping -s 8
expect 0 '' batch tree -d tree/thumbs --size=8 --quiet $memory
run info tree
check "info skips folders: $(cat "$err")" grep -q '^burnish: warning: 3 folders' "$err"
rm -r tree skipping
# Files of the batch are in its folder, unless they name another one.
expect 0 '' batch :sphere -d files --size=8 --sheet=s.png --report=r.jsonl $memory
expect 0 '' batch :sphere -d files --size=8 --sheet=./s.png --report=./r.jsonl $memory
check "files in the folder" [ -s files/s.png -a -s files/r.jsonl -a -s s.png -a -s r.jsonl ]
rm -r files s.png r.jsonl
# The name of an input can have dots.
cp in/a.obj in/a.v2.obj
expect 0 '' batch in/a.v2.obj -o '{model}' -d dots --size=8 $memory
check "a template without an extension" [ "$(head -c 4 dots/a.v2 | tail -c 3)" = PNG ]
rm -r dots in/a.v2.obj
echo text >out/sphere.png
batch :sphere -d out --size=8
check "a file that is no picture of ours stays: $(cat "$err")" [ "$code" = 11 -a "$(cat out/sphere.png)" = text ]
rm -rf out list empty

# render with many inputs: the same pictures, and no other files.
gives 11 render in/a.obj in/a.off in/bad.obj --size=32 --output-dir=thumbs $memory  # render, some failed
check "render lists them: $(cat "$err")" grep -q '^burnish: in/bad.obj:1: vertex has 2 numbers' "$err"
check "render: two pictures" [ "$(ls -A thumbs | tr '\n' ' ')" = 'a.obj.png a.off.png ' ]
"$burnish" render in/a.off --size=32 -o one.png
check "render: the same picture" cmp one.png thumbs/a.off.png
run render in/a.obj in/sub/m.obj --size=16 --views=front,top -o thumbs/{model}_{view}.jpg $memory
check "a template: $(cat "$err")" [ "$code$(ls thumbs | grep -c '^[am]_[a-z]*[.]jpg$')" = 04 ]
run render in/a.obj in/sub/m.obj --size=16 --views=front,top -o "$PWD/thumbs/{model}_{view}.jpg" --json $memory
check "again, whole: $(cat "$err")" [ "$code$(wc -l <"$out")" = 04 ]
# A line is the object of one input, without what depends on the run: times, threads, and the picture's folder.
object() { python3 -c 'import json, sys; r = json.loads(sys.stdin.readline()); del r["seconds"], r["output"]; r.pop("threads", 0); print(r)'; }
run render in/a.obj in/bad.obj --views=front,top --size=16 -d thumbs --json $memory
object <"$out" >many
sed -n 2p "$out" | object >failed
check "one of several that failed" [ "$(sed "s/'error': '.*', //" failed)" = \
    "{'burnish': '$("$burnish" version | cut -d ' ' -f 2)', 'input': 'in/bad.obj', 'status': 'failed', 'code': 4, 'hash': None, 'warnings': []}" ]
check "one that is drawn" grep -q "'status': 'done', 'code': 0, 'error': None, .*'hash': '" many
run render in/bad.obj --size=16 -o one.png --json
tr -d '\n' <"$out" | object | check "alone, sandboxed or not: $code" cmp - failed
rm failed
run render in/a.obj --views=front,top --size=16 -o one.png --json $memory
tr -d '\n' <"$out" | object >one
check "several inputs have the objects of one" cmp one many
run render in/a.obj --size=16 -o 'thumbs/{model}-{extension}.png' --no-sandbox $memory
check "one input, a template: $(cat "$err")" [ -s thumbs/a-obj.png ]
(cd thumbs && "$burnish" render ../in/a.obj ../in/sub/m.obj --size=16 --quiet $memory)
check "their own names" [ -s thumbs/a.png -a -s thumbs/m.png ]
expect 2 'burnish: --output: "in/a.obj" and another input would both be written to "x.png"; put {folder} or {model} into the name' \
    render in/a.obj in/a.off -o x.png
# Folders and lists, as batch takes them; a folder alone has no picture.
expect 3 'burnish: in: is a folder; use --output-dir=FOLDER to draw all its meshes' render in
run render in --json
check "an object of a folder" grep -q '"code":.*3' "$out"
run render in -r -d thumbs --size=32 $memory
check "a folder and those below: $(cat "$err")" [ -f thumbs/sub/a.png -a -f thumbs/a.off.png -a ! -e thumbs/burnish-batch.jsonl ]
rm -rf thumbs
"$burnish" render --files-from=- -d thumbs --size=32 $memory >"$out" 2>"$err" <<END
in/a.off
in/sub/a.obj
END
check "a list: $(cat "$err")" [ "$(find thumbs -type f | wc -l)" = 2 ]
rm -rf thumbs
expect 2 'burnish: --plane: is of one picture; draw one INPUT, without --output-dir' render in/a.obj in/a.off --plane=depth:d.npy
expect 2 'burnish: --output: a batch can'\''t write to standard output; leave it out' render in/a.obj in/a.off -o -
rm -rf thumbs one.png one many

# Pictures that hardly show their object are counted, also those of an earlier run.
few='burnish: warning: 2 of 2 pictures are blank, nearly black, like their background, or specks, such as out/a.obj.png'
for time in first second; do
    expect 0 "$few; see its line in the report for the reason" batch in/a.obj in/a.off -d out --size=64 --zoom=0.01 $memory # the $time
done
check "the report names the reason" grep -q '"legible":false,"warnings":\["in/a.off: the picture ' out/burnish-batch.jsonl
expect 0 "$few; draw it alone for the reason" \
    render in/a.obj in/a.off -d out --overwrite --size=64 --zoom=0.01 $memory
rm -rf out

# Limits: only the worker that takes too long ends.
sheets >in/sheets.obj
batch in/sheets.obj in/a.obj -d out --views=front --max-overdraw=1e9 --size=3000 --samples=16 --max-seconds=0.2
check "--max-seconds: exit code $code" [ "$code" = 11 ]
check "--max-seconds: $(cat "$err")" late 0.2
check "--max-seconds: the input: $(cat "$err")" grep -q '^burnish: in/sheets.obj: not done' "$err"
check "nothing half done" [ "$(find out -name '.*' -o -name 'sheets*' | wc -l)" = 0 ]
rm -rf out

# A file that burnish did not write is not replaced, however long its name is.
part=$(printf '%0200d' 0)
mkdir -p "long/$part/$part/$part" "out/$part/$part/$part"
cp in/a.obj "long/$part/$part/$part/a.obj"
echo mine >"out/$part/$part/$part/a.png"
batch long -r -d out --size=16
check "a foreign file of a long name: exit code $code" [ "$code" = 11 ]
check "a foreign file of a long name: $(cat "$err")" grep -q 'exists and was not written by burnish' "$err"
check "it is replaced" [ "$(cat "out/$part/$part/$part/a.png")" = mine ]
rm -rf long out

# Links: the output folder can be one, folders below it can not.
mkdir -p elsewhere real
ln -s real out
mkdir -p in/sub
cp in/a.obj in/sub/b.obj
batch in/a.obj -d out --size=16
check "a link as the output folder: $(cat "$err")" [ -s real/a.png ]
ln -s ../elsewhere real/sub
batch in/sub/b.obj in/a.obj -d out -o 'sub/x/{model}.png' --size=16
check "a link below: exit code $code, $(cat "$err")" grep -q '^burnish: in/sub/b.obj: out/sub/x/b.png: one of its folders is a link' "$err"
check "written elsewhere: $(ls elsewhere)" [ -z "$(ls elsewhere)" ]
rm real/sub
batch in/sub/b.obj in/a.obj -d out/ -o 'sub/x/{model}.png' --size=16
check "the same without it: exit code $code, $(cat "$err")" [ -s real/sub/x/b.png ]
rm -rf out real elsewhere

# A worker that ends as if all were well, without a picture.
printf '#include <sys/prctl.h>\n#include <unistd.h>\nint prctl(int what, ...) {\n    if (what == PR_SET_NO_NEW_PRIVS) {\n        _exit(0);\n    }\n    return 0;\n}\n' >lie.c
if draws --sandbox && cc -shared -fPIC -o lie.so lie.c 2>/dev/null; then
    LD_PRELOAD=$PWD/lie.so "$burnish" batch in/a.obj -d out --size=16 $memory 2>"$err" || true
    check "a worker that lies: $(cat "$err")" grep -qx 'burnish: in/a.obj: the program that draws ended without a picture' "$err"
    check "its line" grep -q '"code":1,"error":"the program that draws ended without a picture"' out/burnish-batch.jsonl
else
    skip "a worker that lies, no sandbox or no compiler here"
fi
rm -rf lie.c lie.so out

# A signal: finished pictures stay, and the next run continues.
mkdir many
for i in 1 2 3 4 5 6 7 8 9; do cp in/a.obj many/$i.obj; done
cp in/sheets.obj many
"$burnish" batch many -d out --size=2000 --samples=16 --max-overdraw=1e9 --views=front -j2 $memory >"$out" 2>"$err" &
await [ -s out/burnish-batch.jsonl ]
kill -TERM $!
wait $! 2>/dev/null
code=$?
check "SIGTERM: exit code $code" [ "$code" = 143 ]
check "SIGTERM: one line: $(cat "$err")" grep -q '^burnish: stopped: [0-9]* of 10 are done; the same command goes on$' "$err"
check "SIGTERM: no temporary" [ "$(find out -name '.*' | wc -l)" = 0 ]
rm -rf in out many
nothing_left "at the end"
finish
