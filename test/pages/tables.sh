#!/bin/sh
# scripts/check-tables and fill-tables: a table that can't be right is refused in one line and leaves the page as it was.
# Under every awk and shell that is there. usage: tables.sh SOURCE_DIR SCRATCH
scripts=$1/scripts
docs=$1/docs
rm -rf "$2" && mkdir -p "$2/made" && cd "$2" || exit 1
failures=0
checks=0

# is CODE LINE COMMAND...: that exit code, and that on standard error
is() {
    checks=$((checks + 1))
    wanted=$1 line=$2
    shift 2
    "$@" >out 2>err
    code=$?
    if [ "$code" != "$wanted" ] || [ "$(cat err)" != "$line" ]; then
        failures=$((failures + 1))
        echo "$*: exit code $code, says '$(cat err)', not $wanted, '$line'"
    fi
}

# page CELL: a page with that cell in its table
page() { printf 'Text | with a bar\n\n<!-- table: made -->\n\n| unit | cells | blocks |\n| --- | ---: | ---: |\n| a | %s | 0 |\n\n<!-- end of table -->\n' "$1"; }

all() {
    for good in 12 0.01 '1 / 0 / 0' - '10 (9 to 11)' 'infinite sum'; do
        page "$good" >good.md
        is 0 "" $shell "$scripts/check-tables" good.md blocks
    done
    for bad in 0 0.00 -0 "" nan -nan inf 'nan (1 to 2)'; do
        page "$bad" >bad.md
        is 1 "check-tables: bad.md: line 7: row a, column cells: expected a number above 0, found \"$bad\"; mend the script that fills the table" \
            $shell "$scripts/check-tables" bad.md blocks
    done
    page 3 >bad.md
    is 1 'check-tables: bad.md: line 7: row a, column blocks: expected a number above 0, found "0"; mend the script that fills the table' \
        $shell "$scripts/check-tables" bad.md
    page "" >good.md
    is 0 "" $shell "$scripts/check-tables" --empty good.md blocks
    printf '| a | b |\n| - | - |\n' >bad.md
    echo >>bad.md
    is 1 "check-tables: bad.md: line 3: expected rows below the heading, found none; mend the script that fills the table" \
        $shell "$scripts/check-tables" bad.md
    printf '| a | b |\n| - | - |\n| 1 | 2 | 3 |\n' >bad.md
    is 1 "check-tables: bad.md: line 3: expected 2 cells as in the heading, found 3" $shell "$scripts/check-tables" bad.md
    echo text >bad.md
    is 1 "check-tables: bad.md: line 1: expected a table, found none" $shell "$scripts/check-tables" bad.md

    page 1 >page.md
    page 2 | sed -n '/^|/p' >made/made
    is 0 "" $shell "$scripts/fill-tables" made page.md blocks
    page 2 | cmp -s - page.md || { failures=$((failures + 1)); echo "fill-tables: the page isn't filled"; }
    page 0 | sed -n '/^|/p' >made/made
    $shell "$scripts/fill-tables" made page.md blocks 2>/dev/null && { failures=$((failures + 1)); echo "fill-tables: takes a 0"; }
    page 2 | cmp -s - page.md || { failures=$((failures + 1)); echo "fill-tables: a wrong table changes the page"; }
    mv made/made made/other
    is 1 "fill-tables: page.md: line 3: no table made was made; expected it in made" $shell "$scripts/fill-tables" made page.md blocks
    page 2 | sed -n '/^|/p' >made/made
    is 1 'fill-tables: page.md: expected a line "<!-- table: other -->", found none; add it' \
        $shell "$scripts/fill-tables" made page.md blocks
    rm made/other
    is 0 "" $shell "$scripts/check-tables" "$docs/hardware.md" MAC RAM
    is 0 "" $shell "$scripts/check-tables" "$docs/firmware.md" "exact 1 - cosine in UQ0.24"
}

mkdir -p tools
for awk in mawk gawk awk; do
    command -v $awk >/dev/null || continue
    ln -sf "$(command -v $awk)" tools/awk
    for shell in dash "bash --posix" sh; do
        command -v ${shell%% *} >/dev/null || continue
        PATH=$PWD/tools:$PATH all
    done
done
echo "tables: $checks checks, $failures failed"
[ "$failures" -eq 0 ] && [ "$checks" -gt 20 ]
