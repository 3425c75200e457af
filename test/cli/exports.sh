#!/bin/sh
# The library exports only burnish_ names, its shared form only documented ones, and nothing but the
# double-precision comparison functions uses libm. Usage: exports.sh ARCHIVE SOURCE_DIR SCRATCH
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
objects=$scratch/objects
rm -rf "$objects" && mkdir -p "$objects"
(cd "$objects" && ar x "$archive")
for object in "$objects"/*.o; do
    readelf -Ws "$object" | awk '$5 == "GLOBAL" && $6 == "DEFAULT" && $7 != "UND" {print $8}'
done | grep '^burnish_' | sort -u >"$scratch/exported"
[ "$(wc -l <"$scratch/exported")" -gt 20 ] || fail "hardly any exported names"
while read -r name; do
    grep -qE "BURNISH_API[^;]*[ *]$name\(" "$scratch/api" 2>/dev/null || {
        [ -f "$scratch/api" ] || cat "$source"/include/burnish/*.h | tr '\n' ' ' | sed 's/;/;\n/g' >"$scratch/api"
        grep -qE "BURNISH_API[^;]*[ *]$name\(" "$scratch/api" || fail "$name is exported but not declared BURNISH_API"
    }
done <"$scratch/exported"

# libm: names that the system's libm defines and the image path must not use
libm=$(gcc -print-file-name=libm.so.6)
nm -D --defined-only "$libm" | awk '{print $3}' | sed 's/@.*//' | sort -u >"$scratch/libm"
grep -qx pow "$scratch/libm" || fail "could not read libm's names"
for object in "$objects"/*.o; do
    case $(basename "$object") in comparison*) continue ;; esac
    nm -u "$object" | awk '{print $2}' | sort -u | comm -12 - "$scratch/libm" >"$scratch/used"
    [ -s "$scratch/used" ] && fail "$(basename "$object") uses libm: $(tr '\n' ' ' <"$scratch/used")"
done

echo "exports: $count names, $failures failed"
[ "$failures" -eq 0 ]
