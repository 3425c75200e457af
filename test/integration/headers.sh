#!/bin/sh
# Each public header compiles alone as strict C99, C17 and C++; lobe.h also without any other header, the integer headers with
# nothing but the compiler's own headers. Every source that computes refuses -ffast-math.
# Usage: headers.sh SOURCE_DIR SCRATCH
set -u
source=$1
scratch=$2
failures=0
checks=0
mkdir -p "$scratch"

# Both compilers, if installed.
c_compilers="gcc clang" cpp_compilers="g++ clang++"
command -v clang >/dev/null || { c_compilers=gcc cpp_compilers=g++ && echo "headers: SKIPPED: clang, not installed"; }

try() {
    checks=$((checks + 1))
    if ! "$@" -Wall -Wextra -Wpedantic -Werror -fsyntax-only; then
        echo "FAIL: $*"
        failures=$((failures + 1))
    fi
}

roots="-I$source/include -I$source/base/include -I$source/lobe/include"

for header in "$source"/include/burnish/*.h "$source"/*/include/burnish/*.h; do
    name=$(basename "$header")
    printf '#include "burnish/%s"\n#include "burnish/%s"\nint burnish_header_test;\n' "$name" "$name" >"$scratch/alone.c"
    cp "$scratch/alone.c" "$scratch/alone.cpp"
    for standard in c99 c17; do
        for compiler in $c_compilers; do
            try $compiler -std=$standard -pedantic-errors $roots "$scratch/alone.c"
        done
    done
    for compiler in $cpp_compilers; do
        try $compiler -std=c++11 -pedantic-errors $roots "$scratch/alone.cpp"
        try $compiler -std=c++20 -pedantic-errors $roots "$scratch/alone.cpp"
    done
done

# copied alone, with no standard header in reach
cp "$source/lobe/include/burnish/lobe.h" "$scratch/lobe.h"
cat >"$scratch/copied.c" <<'CODE'
#include "lobe.h"
float highlight(float cosine);
float highlight(float cosine) {
    burnish_lobe lobe;
    return burnish_lobe_create(&lobe, BURNISH_FIT_ENERGY, 2, 32.0f) == BURNISH_LOBE_OK
               ? burnish_lobe_at_cosine(lobe, cosine)
               : 0.0f;
}
CODE
for compiler in $c_compilers; do
    try $compiler -std=c99 -pedantic-errors -ffreestanding -nostdinc "$scratch/copied.c"
done

cp "$source/lobe/include/burnish/lobe_q15.h" "$source/lobe/include/burnish/shade_q15.h" "$scratch"
cat >"$scratch/integers.c" <<'CODE'
#include "shade_q15.h"
unsigned highlight(unsigned cosine);
unsigned highlight(unsigned cosine) {
    return burnish_shift7_q15(40, (uint16_t)cosine);
}
CODE
for compiler in $c_compilers; do
    try $compiler -std=c99 -pedantic-errors -ffreestanding "$scratch/integers.c"
    # no floating point and no 64 bits
    sed 's,/\*.*\*/,,' "$scratch/lobe_q15.h" "$scratch/shade_q15.h" | grep -nE '\b(float|double|u?int64_t|long long)\b' | grep -v '^[0-9]*: \*' && failures=$((failures + 1))
done

# every source that computes refuses what would change bits, with a sentence
checked=0
for file in $(cd "$source" && grep -rlE '\b(float|double)\b' --include='*.c' --exclude-dir=cli --exclude-dir=test --exclude-dir=wasm src base lobe/spec lobe/theory); do
    checked=$((checked + 1))
    # an instruction set's own file begins with its intrinsics
    if gcc -E -ffast-math -mavx512f -mavx512dq -mavx512bw -mavx512vl -D_GNU_SOURCE -I"$source" -I"$source/src" -I"$source/lobe" $roots \
        "$source/$file" >/dev/null 2>"$scratch/refusal" || ! grep -q 'error "burnish gives the same pixels' "$scratch/refusal"; then
        echo "FAIL: $file compiles with -ffast-math; include base/arithmetic.h"
        failures=$((failures + 1))
    fi
done
[ "$checked" -gt 30 ] || failures=$((failures + 1))

echo "headers: $checks checks, $failures failed"
[ "$checks" -gt 25 ] && [ "$failures" -eq 0 ]
