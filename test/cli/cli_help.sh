#!/bin/sh
# The help screens fit a screen, the man page is clean roff and covers every flag.
# usage: cli_help.sh BURNISH SCRATCH
. "$(dirname "$0")/lib.sh"

# fits FILE: at most 42 lines of at most 100 columns, no blanks at the ends of lines.
fits() { awk 'length($0) > 100 || / $/ { bad = 1 } END { exit bad || NR > 42 || NR < 5 }' "$1"; }

lobe="table claims choose boundary"
screens="--help;-h;help;--help=render;--help=lobe;render --help;render -h;help render;info --help;help info;batch --help;help batch;serve-stdio --help;help serve-stdio;compare --help;compare -h;help compare;help --help;lobe --help;lobe -h;help lobe"
for part in $lobe; do
    screens="$screens;lobe $part --help;help lobe $part"
done
printf '%s\n' "$screens" | tr ';' '\n' >screens.txt
while read -r screen; do
    gives 0 $screen
    check "burnish $screen: writes to standard error" [ ! -s "$err" ]
    check "burnish $screen: does not fit 42 lines of 100 columns" fits "$out"
done <screens.txt
for part in $lobe; do
    run lobe "$part" --help
    check "help lobe $part differs from lobe $part --help" sh -c "'$burnish' help lobe $part | cmp - '$out'"
    check "burnish lobe --help lacks $part" sh -c "'$burnish' lobe --help | grep -q '^  $part '"
    cat "$out" >>lobe.txt
done
run info --help
cat "$out" >>lobe.txt
"$burnish" help --json >flags.json
python3 -c 'import json
for command in json.load(open("flags.json"))["commands"]:
    for topic in dict.fromkeys(flag["topic"] for flag in command["flags"] if flag["topic"]):
        print(command["name"], topic)' >topics_of.txt
check "fewer than 20 topics" [ "$(wc -l <topics_of.txt)" -ge 20 ]
while read -r command topic; do
    run "$command" "--help=$topic"
    check "burnish $command --help=$topic does not fit 42 lines of 100 columns" fits "$out"
    check "burnish $command --help lacks $topic" sh -c "'$burnish' $command --help | grep -q -- '--help=$topic'"
    cat "$out" >>"topics.$command"
done <topics_of.txt
cat topics.* >>lobe.txt
run --help
cp "$out" main.txt
check "exit codes are not in order" sh -c "grep -o '^  [0-9] ' main.txt | sort -nc"
for code_text in '0  success' '8  a blank picture' '10  pictures differ' 'compare A B' 'render INPUT' 'help \[COMMAND\]'; do
    check "burnish --help lacks '$code_text'" grep -q -- "  $code_text" main.txt
done
run render --help
cp "$out" render.txt
run render --help=all
check "burnish render --help=all: a row is too long" awk 'length($0) > 100 { exit 1 }' "$out"
sed -n 's/^  \(-[a-z],\|   \) \(--[a-z-]*\).*/\2/p' "$out" | sort >all.txt
sed -n 's/^  \(-[a-z],\|   \) \(--[a-z-]*\).*/\2/p' topics.render | sort >by_topic.txt
check "the topics show all flags, each once: $(diff all.txt by_topic.txt | head -3 | tr '\n' ' ')" cmp all.txt by_topic.txt
check "fewer than 40 flags of render" [ "$(wc -l <all.txt)" -ge 40 ]
check "lobe table --help=all differs" sh -c "'$burnish' lobe table --help=all | grep -q -- --metrics"
check "burnish help render differs from render --help" sh -c "'$burnish' help render | cmp - render.txt"
check "flags before --help count" sh -c "'$burnish' render --samples=4 --help | cmp - render.txt"

run --version
check "version" grep -qx 'burnish [0-9]*\.[0-9]*\.[0-9]*' "$out"
check "-V" sh -c "'$burnish' -V | cmp - '$out'"

# `burnish lobe` is the program burnish-lobe.
lobes=$(dirname "$burnish")/burnish-lobe
for words in "lobe --help,--help" "help lobe,--help" "help lobe table,help table" "lobe claims core-w,claims core-w"; do
    check "burnish ${words%,*} is not burnish-lobe ${words#*,}" sh -c "'$burnish' ${words%,*} >a.txt; '$lobes' ${words#*,} | cmp - a.txt && [ -s a.txt ]"
done
"$lobes" frobnicate 2>expected.txt
check "burnish-lobe: exit code" [ $? = 2 ]
run lobe frobnicate
check "burnish lobe: another error" sh -c "[ $code = 2 ] && cmp '$err' expected.txt"
cp "$burnish" alone
./alone lobe table 2>"$err"
check "without burnish-lobe: exit code and message" [ "$? $(cat "$err")" = \
    "12 burnish: lobe: burnish-lobe is not installed next to this program; install it, or build it by cmake -S lobe" ]
rm alone

run help --man
cp "$out" burnish.1
check "burnish help --man: exit code $code" [ "$code" = 0 ]
run lobe help --man
cp "$out" burnish-lobe.1
check "burnish-lobe help --man: exit code $code" [ "$code" = 0 ]
cat burnish.1 burnish-lobe.1 | tr -d '\\' >page.txt
grep -oh -- '--[a-z][a-z-]*' render.txt lobe.txt | sort -u >flags.txt
check "fewer than 50 flags on the help screens" [ "$(wc -l <flags.txt)" -ge 50 ]
while read -r flag; do
    check "$flag is not in the man page" grep -q "^f.*$flag" page.txt
done <flags.txt
# and the other way round
sed -n '/^.TP/{n;s/^.*fB\(--[a-z-]*\)fR.*$/\1/p}' page.txt | grep '^--' | sort -u >described.txt
check "the man page describes no flags" [ -s described.txt ]
while read -r flag; do
    check "$flag is not on a help screen" sh -c "grep -q -- $flag render.txt lobe.txt || '$burnish' help --help | grep -q -- $flag"
done <described.txt
for heading in NAME SYNOPSIS DESCRIPTION TABLE BOUNDARY LOBES METRICS '"EXIT STATUS"' ENVIRONMENT EXAMPLES; do
    check "burnish-lobe(1) lacks $heading" grep -q "^.SH \"*$(echo "$heading" | tr -d '"')" burnish-lobe.1
done
for heading in NAME SYNOPSIS DESCRIPTION RENDER LOBE COLOURS MATERIALS LIGHTS INFO '"JSON OUTPUT"' '"FACTS IN JSON"' \
    '"EXIT STATUS"' ENVIRONMENT EXAMPLES; do
    check "the man page lacks $heading" grep -q "^.SH \"*$(echo "$heading" | tr -d '"')" burnish.1
done
# The documented JSON keys are the keys that are written.
json_keys() { tr -d '\n\t ' <"$out" | grep -oE '"[a-z0-9_]+":' | tr -d '":'; }
for flags in '-o p.png' '-o p.png --views=front,top' '-o p.png --plane=depth:d.npy' '-o q.png --rows=4:8' '--frames=2 --turntable=t.gif' \
    '-o q.png --size=17 --reference=p.png'; do # of another size: no numbers
    run render :sphere --size=16 --json $flags
    json_keys >>keys.txt
done
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >t.obj
run render t.obj --scene --json --size=16 --camera-position=9,9,9 --camera-intrinsics=9,9,8,8 -o p.png
json_keys >>keys.txt
run render t.obj --scene --callouts --json --size=99 -o p.png
json_keys >>keys.txt
sort -u keys.txt >written.txt
awk '/^.SH/ { on = /JSON OUTPUT/ } on' page.txt >section.txt
grep -o 'fB[a-z_, ]*fR' section.txt | sed 's/^fB//; s/fR$//' | tr ', ' '\n\n' | grep . | sort -u >told.txt
check "JSON keys and the manual differ: $(diff written.txt told.txt | grep '^[<>]' | tr '\n' ' ')" cmp written.txt told.txt
check "fewer than 40 JSON keys" [ "$(wc -l <written.txt)" -ge 40 ]
rm -f p.png d.npy t.gif t.obj
# help --json has the flags of the help screens, and the keys that the manual lists.
sed -n '/^.SH "FLAGS IN JSON"/,/^.SH/p' page.txt | grep -o '^f[BI][a-z_, ]*fR$' | sed 's/^fB//; s/fR$//' | tr ', ' '\n\n' | grep . | sort >told.txt
check "flags in JSON" python3 - "$burnish" <<'END'
import json, re, subprocess, sys
with open("flags.json") as file:
    description = json.load(file)
def all_keys(value):
    if isinstance(value, dict):
        return set(value).union(*map(all_keys, value.values()))
    return set().union(*map(all_keys, value)) if isinstance(value, list) else set()
told = set(open("told.txt").read().split())
assert all_keys(description) == told | {"summary", "operand", "flags"}, all_keys(description) ^ told
assert [command["name"] for command in description["commands"] if command["program"]] == ["lobe"]
for command in description["commands"]:
    if command["program"]:
        continue
    screen = subprocess.run([sys.argv[1], *command["name"].split(), "--help=all"], capture_output=True, text=True, check=True).stdout
    listed = re.findall(r"^  (?:-., |    )--([a-z-]+)", screen, re.M)
    names = [flag["name"] for flag in command["flags"]]
    assert len(set(names)) == len(names), f"twice: {sorted(names)}"  # a command's own replaces the inherited one
    assert sorted(names + ["help"]) in (sorted(listed), sorted(listed + ["help"])), command["name"]
render = {flag["name"]: flag for flag in description["commands"][0]["flags"]}
def picked(name, *keys):
    return [render[name][key] for key in keys]
assert picked("output", "letter", "type", "value", "topic", "phases", "file") == ["o", "text", "FILE", "picture", ["file"], "writes"]
assert picked("zoom", "also", "type", "low", "high", "default", "topic") == [["camera-zoom-factor"], "number", 0.001, 1000, "1", "camera"]
assert picked("edges", "type", "optional", "off", "phases", "svg") == ["words", True, "none", ["draw"], "drawn"]
assert picked("light", "repeats", "svg") == [True, "refused"] and render["samples"]["words"] == ["1", "4", "8", "16"]
assert picked("max-triangles", "type", "phases") == ["integer", ["load", "process"]] and picked("up", "type", "phases") == ["word", ["load"]]
options = {flag["name"] for flag in description["options"]}
assert options < set(render) and {"up", "zoom", "threads"} < options and not {"output", "columns", "sandbox"} & options, options
END
for variable in BURNISH_ISA PATH; do
    check "the manual's ENVIRONMENT lacks $variable" sh -c "sed -n '/^.SH \"ENVIRONMENT/,/^.SH EXAMPLES/p' page.txt | grep -q $variable"
done
check "the manual takes an underscore inside a word for italics" grep -q 'Default: burnish_boundary\.' page.txt
# Marks of *bold* and _italics_ are balanced, and none remains in the output.
check "marks that are not closed: $(awk 'gsub(/\\f[BI]/, "&") != gsub(/\\fR/, "&")' burnish.1 | head -1)" \
    awk 'gsub(/\\f[BI]/, "&") != gsub(/\\fR/, "&") { exit 1 }' burnish.1
check "marks in the text: $(grep -F '*' burnish.1 | head -1)" sh -c '! grep -qF "*" burnish.1'
check "defaults that say nothing: $(grep -E 'Default: ([-.\\]*|.*: [^ ,]*)\.$' burnish.1 | head -1)" \
    sh -c "! grep -qE 'Default: ([-.\\\\]*|.*: [^ ,]*)\\.\$' burnish.1"
for text in 'Default: all cores (0).' 'Default: the current folder.' 'Default: standard output (-).'; do
    check "the manual lacks '$text'" sh -c "sed 's/f[BIR]//g' page.txt | grep -qF '$text'"
done
check "the manual has the C interface's words" sh -c '! grep -q initialised burnish.1'
for exit_code in 0 1 2 3 4 5 6 7 8; do
    check "the man page lacks exit code $exit_code" grep -q "^.B $exit_code\$" burnish.1
done
if has "check of the man page by mandoc" mandoc; then
    check "mandoc: $(mandoc -T lint -W warning burnish.1)" mandoc -T lint -W warning burnish.1
fi
if has "check of the man page by man" groff man; then
    warnings=$(LC_ALL=C MANROFFSEQ='' man --warnings -E UTF-8 -l burnish.1 2>&1 >/dev/null)
    check "man: $warnings" [ -z "$warnings" ]
fi
check "help into a full device ends with 7" sh -c "'$burnish' --help >/dev/full 2>/dev/null; [ \$? = 7 ]"

finish
