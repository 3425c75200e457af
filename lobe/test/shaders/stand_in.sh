#!/bin/sh
# Compiles the shaders for each language but WGSL as C++, with a test that includes stand_in.h, and runs it.
# Usage: stand_in.sh SOURCE.cc "ARCHIVES" LOBE_DIR SCRATCH [COMPILER_OPTION...]
set -eu
test=$1 archives=$2 lobe=$3 scratch=$4
shift 4
for tool in python3 g++; do
    command -v "$tool" >/dev/null || { echo "shaders: $tool is missing; run scripts/install-deps shaders"; exit 77; }
done
"$lobe/scripts/shaders" "$scratch"
"$lobe/scripts/shaders" --half "$scratch/half.glsl"
for language in METAL OSL GLSL HLSL; do
    # in these languages a literal without a suffix is a float
    g++ -std=c++17 -O1 -ffp-contract=off -fsingle-precision-constant -Wall -Wextra -Werror -Wno-unused-function -D$language \
        -I"$lobe/test/shaders" -I"$lobe/test/shaders/metal" -I"$scratch" -I"$lobe/include" -I"$lobe/../base/include" "$@" "$test" $archives -lm \
        -o "$scratch/$language"
    "$scratch/$language" "$lobe/test/data/lobes.csv" "$lobe/test/data/area.csv"
done
