#!/bin/sh
# Runs the shaders for Metal and OSL as C++. Usage: stand_in.sh "ARCHIVES" SOURCE_DIR SCRATCH
set -eu
mkdir -p "$3"
for language in METAL OSL; do
    # in both languages a literal without a suffix is a float
    g++ -std=c++17 -O1 -ffp-contract=off -fsingle-precision-constant -Wall -Wextra -Werror -Wno-unused-function -D$language \
        -I"$2/test/shaders" -I"$2/test/shaders/metal" -I"$2/shaders" -I"$2/include" "$2/test/shaders/stand_in.cc" $1 -lm \
        -o "$3/$language"
    "$3/$language" "$2/test/data/lobes.csv" "$2/test/data/area.csv"
done
