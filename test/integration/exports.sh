#!/bin/sh
# The library exports only burnish_ names, its shared form only documented ones, and it does not use libm.
# Usage: exports.sh ARCHIVE SOURCE_DIR SCRATCH
set -u
archive=$1
source=$2
scratch=$3
failures=0
mkdir -p "$scratch"

fail() {
    echo "FAIL: $*"
    failures=$((failures + 1))
}

nm -g --defined-only "$archive" 2>/dev/null | awk 'NF == 3 {print $3}' | sort -u >"$scratch/names"
count=$(wc -l <"$scratch/names")
[ "$count" -gt 50 ] || fail "only $count global names found in $archive"
# compilers and sanitizers add names that start with two underscores or a dot
grep -vE '^(burnish_|__|\.)' "$scratch/names" >"$scratch/foreign" && fail "foreign names: $(tr '\n' ' ' <"$scratch/foreign")"

# every exported name is declared BURNISH_API in a public header
readelf -Ws "$archive" | awk '$5 == "GLOBAL" && $6 == "DEFAULT" && $7 != "UND" {print $8}' |
    grep '^burnish_' | sort -u >"$scratch/exported"
[ "$(wc -l <"$scratch/exported")" -gt 20 ] || fail "hardly any exported names"
find "$source"/include/burnish "$source"/*/include/burnish -name '*.h' ! -name theory.h -exec cat {} + | tr '\n' ' ' | sed 's/;/;\n/g' >"$scratch/api"
while read -r name; do
    grep -qE "BURNISH_API[^;]*[ *]$name\(" "$scratch/api" || fail "$name is exported but not declared BURNISH_API"
done <"$scratch/exported"

# ... and the other way round, but for the functions that headers define themselves
grep -oE 'BURNISH_API[^;(]*[ *]burnish_[a-z0-9_]+\(' "$scratch/api" | grep -oE 'burnish_[a-z0-9_]+\($' | tr -d '(' | sort -u >"$scratch/declared"
comm -23 "$scratch/declared" "$scratch/exported" >"$scratch/undefined"
[ -s "$scratch/undefined" ] && fail "declared BURNISH_API but not exported: $(tr '\n' ' ' <"$scratch/undefined")"

# the shared library exports the same names
shared=$(dirname "$archive")/libburnish.so
if [ -f "$shared" ]; then
    nm -D --defined-only "$shared" | awk '{print $3}' | sort -u >"$scratch/dynamic"
    diff "$scratch/exported" "$scratch/dynamic" >"$scratch/differences" || fail "the shared library's names: $(cat "$scratch/differences")"
    readelf -d "$shared" | grep -q 'SONAME.*libburnish.so.0' || fail "no SONAME libburnish.so.0"
    readelf -d "$shared" | grep -q NODELETE || fail "its threads could lose their code: no NODELETE"
fi

# libm: names that the system's libm defines and the image path must not use
libm=$(gcc -print-file-name=libm.so.6)
nm -D --defined-only "$libm" | awk '{print $3}' | sed 's/@.*//' | sort -u >"$scratch/libm"
grep -qx pow "$scratch/libm" || fail "could not read libm's names"
# "object name" for everything that an object of the archive needs
nm -u "$archive" 2>/dev/null | awk '/:$/ {object = $1; sub(/(\.c)?\.o:$/, ".c", object)} NF == 2 {print $2, object}' |
    sort >"$scratch/needed"
join "$scratch/needed" "$scratch/libm" >"$scratch/used"
[ "$(wc -l <"$scratch/needed")" -gt 50 ] || fail "could not read what the objects need"
while read -r name object; do
    fail "$object uses libm: $name"
done <"$scratch/used"

echo "exports: $count names, $failures failed"
[ "$failures" -eq 0 ]
