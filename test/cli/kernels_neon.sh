#!/bin/sh
# AArch64, cross-compiled, under emulation: test_kernels (NEON against scalar, and the scalar bits against
# those of every other processor), test_kernel_values, test_arrays_q15, and test_visibility on some scenes. Skipped (77) without the cross
# compiler.
# Usage: kernels_neon.sh SOURCE_DIR SCRATCH
set -eu
compiler=aarch64-linux-gnu-gcc
for tool in $compiler qemu-aarch64; do
    command -v "$tool" >/dev/null || { echo "skipped: no $tool; scripts/install-deps cross"; exit 77; }
done
. "$(dirname "$0")/kernels_sources.sh"
mkdir -p "$2"
for name in kernels kernel_values; do
    # shellcheck disable=SC2046,SC2086
    $compiler $flags -static $(sources "$1" $name) -lm -o "$2/test_${name}_neon"
    qemu-aarch64 "$2/test_${name}_neon" >"$2/$name.txt" || { cat "$2/$name.txt"; exit 1; }
    cat "$2/$name.txt"
done
grep -q 'instruction sets: scalar neon' "$2/kernels.txt"
# shellcheck disable=SC2086
$compiler $flags -static -I"$1/include" -I"$1/test" "$1/test/test_arrays_q15.c" -lm -o "$2/test_arrays_q15_neon"
qemu-aarch64 "$2/test_arrays_q15_neon" | tee "$2/arrays_q15.txt"
grep -q 'lanes: 8' "$2/arrays_q15.txt" && grep -q '^arrays_q15: .* 0 failed' "$2/arrays_q15.txt"
for test in visibility large_triangles; do
    # shellcheck disable=SC2046,SC2086
    $compiler $flags -static "$1/test/test_$test.c" $(renderer_sources "$1") -lm -o "$2/test_${test}_neon"
    qemu-aarch64 "$2/test_${test}_neon" --scenes 100 --only scenes
done
