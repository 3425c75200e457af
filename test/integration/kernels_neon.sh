#!/bin/sh
# AArch64, cross-compiled, under emulation: test_kernels (NEON against scalar, and the scalar bits against
# those of every other processor), test_kernel_values, and test_visibility on some scenes. Skipped (77) without the cross compiler.
# Usage: kernels_neon.sh SOURCE_DIR SCRATCH
set -eu
compiler=aarch64-linux-gnu-gcc
for tool in $compiler qemu-aarch64; do
    command -v "$tool" >/dev/null || { echo "skipped: no $tool; scripts/install-deps cross"; exit 77; }
done
. "$(dirname "$0")/kernels_sources.sh"
mkdir -p "$2/objects"
rm -f "$2"/objects/*
# Everything once, then a link for each test.
(cd "$2/objects" && $compiler $flags $(built_isas neon) -ffunction-sections -c -pthread $(includes "$1") $(renderer_sources "$1") &&
    compile_isa $compiler "$1" neon environment raster rays render shading && ar rcs renderer.a ./*.o)

# program NAME: test_NAME.c for that processor. GCC 12.2 ends with an internal error if it vectorises sums in test_kernel_values.c.
program() {
    $compiler $flags -fno-tree-vectorize -static -Wl,--gc-sections -pthread $(includes "$source") "$source"/test/*/test_"$1".c "$scratch/objects/renderer.a" -lm -o "$scratch/test_$1_neon"
}
source=$1
scratch=$2
for name in kernels kernel_values; do
    program $name
    qemu-aarch64 "$scratch/test_${name}_neon" >"$scratch/$name.txt" || { cat "$scratch/$name.txt"; exit 1; }
    cat "$scratch/$name.txt"
done
grep -q 'instruction sets: scalar neon' "$scratch/kernels.txt"
for name in visibility large_triangles; do
    program $name
    qemu-aarch64 "$scratch/test_${name}_neon" --scenes 100 --only scenes
done
