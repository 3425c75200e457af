#!/bin/sh
# AArch64, cross-compiled, under emulation: test_kernels (NEON against scalar, and the scalar bits against
# those of every other processor), test_kernel_values, and test_visibility on some scenes. Skipped (77) without the cross compiler.
# Usage: kernels_neon.sh SOURCE_DIR SCRATCH
set -eu
compiler=aarch64-linux-gnu-gcc
for tool in $compiler qemu-aarch64; do
    command -v "$tool" >/dev/null || { echo "skipped: no $tool; scripts/install-deps cross"; exit 77; }
done
source=$1 scratch=$2 src=$1/src
flags="-std=c17 -O2 -ffp-contract=off -fno-math-errno -Wall -Wextra -Werror -D_GNU_SOURCE -pthread"
includes="-I$source -I$source/include -I$source/base/include -I$source/lobe/include -I$source/src -I$source/base/test -I$source/test/support"
mkdir -p "$scratch/objects"
rm -f "$scratch"/objects/*
# Everything once, the kernels once for each instruction set, then a link for each test.
(
    cd "$scratch/objects"
    $compiler $flags "-DBURNISH_BUILT_ISAS=X(SCALAR,scalar)X(NEON,neon)" -ffunction-sections -c $includes \
        $(find "$src/simd" "$src/raster" "$src/shading" "$src/environment" "$src/rays" "$src/render" -name '*.c' ! -name '*_isa.c') \
        "$src"/mesh/data/*.c "$source"/lobe/spec/*.c "$src/core/processors.c" "$src/core/srgb.c" "$src/core/tasks.c" "$src/core/pool.c" \
        "$source/base/context.c" "$source/base/elementary.c" "$source/base/error.c" "$source/base/layout.c" "$source/base/memory.c"
    for file in $(find "$src" -name '*_isa.c'); do
        for isa in SCALAR NEON; do
            $compiler $flags -c $includes -DBURNISH_VECTOR_$isa "$file" -o "$(basename "$file" .c)_$isa.o"
        done
    done
    ar rcs renderer.a ./*.o
)
# program NAME: test_NAME.c for that processor. GCC 12.2 ends with an internal error if it vectorises sums in test_kernel_values.c.
program() {
    $compiler $flags -fno-tree-vectorize -static -Wl,--gc-sections $includes "$source"/test/*/test_"$1".c "$scratch/objects/renderer.a" -lm -o "$scratch/test_$1_neon"
}
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
