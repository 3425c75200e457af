#!/bin/sh
# The library as a part of another project, without pkg-config and other libraries: docs/examples/picture.c draws the program's pixels.
#   cmake  by add_subdirectory()
#   cc     by the command of docs/api.md, but for its optimisation
#   lobe   not the library, but the lobes with base/ alone
# Usage: embed.sh cmake|cc|lobe BURNISH CC SOURCE_DIR SCRATCH
set -eu
burnish=$(realpath "$2")
cc=$3
source=$4
rm -rf "$5"
mkdir -p "$5"
cd "$5"
case $1 in
lobe)
    cp -r "$source/base" "$source/lobe" .
    { cmake -S lobe -B build -G Ninja -DCMAKE_C_COMPILER="$cc" -DCMAKE_BUILD_TYPE=Debug -DBURNISH_TESTS=OFF && cmake --build build; } >log || { tail -n 20 log; exit 1; }
    "$burnish" lobe claims >expected
    build/burnish-lobe claims | cmp - expected
    exit
    ;;
cmake)
    cat >CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.16)
project(user C)
add_subdirectory(${SOURCE} burnish)
add_executable(picture ${SOURCE}/docs/examples/picture.c)
target_link_libraries(picture PRIVATE burnish::burnish)
END
    cmake -S . -B build -G Ninja -DSOURCE="$source" -DCMAKE_C_COMPILER="$cc" -DCMAKE_BUILD_TYPE=None -DCMAKE_C_FLAGS=-O0 -DBURNISH_VECTORS=OFF \
        -DCMAKE_DISABLE_FIND_PACKAGE_PkgConfig=ON -DCMAKE_DISABLE_FIND_PACKAGE_ZLIB=ON >log
    cmake --build build >>log || { tail -n 20 log; exit 1; }
    [ -z "$(find build -name '*.a' ! -name libburnish.a)" ] || { echo "embed: more than the library is built"; exit 1; }
    mv build/picture picture
    ;;
cc)
    cd "$source"
    "$cc" -std=c17 -O0 -ffp-contract=off -fno-tree-slp-vectorize -D_GNU_SOURCE -I . -I include -I base/include -I lobe/include -I src \
        $(find src base/*.c lobe/spec -name '*.c' ! -name '*_isal.c' ! -name '*_zlib.c') docs/examples/picture.c -o "$OLDPWD/picture" -pthread -lm
    cd "$OLDPWD"
    ;;
esac
if readelf -d picture | grep 'NEEDED' | grep -vE 'lib(c|m|pthread)\.so|ld-linux'; then
    echo "embed: the program needs other libraries"
    exit 1
fi
for input in "$source/test/data/wedge.stl" :teapot "$source/test/data/cube.obj" "$source/test/data/colors.ply"; do
    ./picture "$input" own.png
    "$burnish" render "$input" --no-ground -o program.png
    "$burnish" compare own.png program.png >compared || { echo "embed: another picture of $input"; cat compared; exit 1; }
done
