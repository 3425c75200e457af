#!/bin/sh
# The golden pixels from another compiler or other flags.
# Usage: bits.sh SOURCE_DIR SCRATCH HOW COMPILER FLAGS [CMAKE_OPTION...]        HOW: each, or GOLDEN_HOW of golden.sh
set -eu
source=$1 build=$2
[ "$3" = each ] || export GOLDEN_HOW="$3"
compiler=$4 flags=$5
shift 5
cmake -S "$source" -B "$build" -G Ninja -DBURNISH_TESTS=OFF -DCMAKE_BUILD_TYPE=None -DCMAKE_C_COMPILER="$compiler" \
    -DCMAKE_C_FLAGS="$flags" "$@" >/dev/null
cmake --build "$build" --target burnish_cli
"$source/test/integration/golden.sh" "$build/burnish" "$build"
