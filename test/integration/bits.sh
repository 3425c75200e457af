#!/bin/sh
# The same pixels from every compiler and optimisation level: builds the program four ways, or two of them with BITS=short, and compares
# each with the golden hashes. -march=native offers FMA, which must not be used. Both compilers' -O3 are the
# presets release and clang, whose pictures `make test` and `make clang` compare.
# Usage: bits.sh SOURCE_DIR SCRATCH
set -u
source=$1
scratch=$2
failures=0
mkdir -p "$scratch"
# Threads are golden's own test; without optimisation every picture takes seconds.
set -- "gcc -O0" "clang -O2 -march=native"
[ "${BITS:-}" = short ] || set -- "$@" "clang -O0" "gcc -O3 -march=native"
for variant; do
    compiler=${variant%% *}
    flags=${variant#* }
    case $flags in
    -O0*) how=$([ "$compiler" = gcc ] && echo 2:auto || echo 1:scalar) ;;
    *) how=each ;;
    esac
    build=$scratch/$(echo "$variant" | tr -d '= ')
    if cmake -S "$source" -B "$build" -G Ninja -DBURNISH_TESTS=OFF -DCMAKE_C_COMPILER="$compiler" \
        -DCMAKE_BUILD_TYPE=None -DCMAKE_C_FLAGS="$flags" >"$scratch/log" 2>&1 &&
        cmake --build "$build" --target burnish_cli >"$scratch/log" 2>&1 &&
        GOLDEN_HOW=$how "$source/test/integration/golden.sh" "$build/burnish" "$build" >"$build/result"; then
        echo "$variant: $(tail -n 1 "$build/result")"
    else
        echo "FAIL: $variant"
        cat "$scratch/log" "$build/result" 2>/dev/null | tail -n 20
        failures=$((failures + 1))
    fi
done
[ "$failures" -eq 0 ]
