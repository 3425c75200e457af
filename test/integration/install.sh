#!/bin/sh
# What `make install DESTDIR=...` leaves is enough for others: docs/examples/picture.c is built from it by pkg-config and by
# CMake, with the shared and the static library, as C and as C++, after the tree was moved; each draws the program's pixels.
# Usage: install.sh BUILD SOURCE_DIR SCRATCH
set -u
build=$1
source=$2
rm -rf "$3"
mkdir -p "$3"
scratch=$(cd "$3" && pwd)
failures=0
checks=0

fail() {
    echo "FAIL: $*"
    failures=$((failures + 1))
}

DESTDIR=$scratch/staged cmake --install "$build" --prefix /opt/burnish >"$scratch/install.log" || fail "cmake --install"
mv "$scratch/staged/opt/burnish" "$scratch/moved"
[ -z "$(find "$scratch/staged" -type f)" ] || fail "files outside the prefix: $(find "$scratch/staged" -type f)"
libdir=$(dirname "$(find "$scratch/moved" -name libburnish.a)")
export PKG_CONFIG_PATH="$libdir/pkgconfig"
export LD_LIBRARY_PATH="$libdir"
"$scratch/moved/bin/burnish" render :teapot --no-ground -o "$scratch/expected.png" || fail "the installed program"
if [ -e "$build/burnish-import-draco" ]; then
    "$scratch/moved/bin/burnish" "$source/test/importers/ring.glb" "$scratch/ring.png" --strict --sandbox || fail "the installed decoder of Draco"
fi
"$scratch/moved/bin/burnish" lobe claims core-w >/dev/null || fail "the installed burnish-lobe"
for text in man/man1/burnish.1 man/man1/burnish-lobe.1 burnish/shaders/burnish.glsl burnish/shaders/glsl/lighting/specular/burnish.glsl bash-completion/completions/burnish zsh/site-functions/_burnish fish/vendor_completions.d/burnish.fish; do
    [ -s "$scratch/moved/share/$text" ] || fail "no $text"
done

# draws WHAT PROGRAM shared|static
draws() {
    checks=$((checks + 1))
    if ! "$2" :teapot "$scratch/picture.png" || ! cmp -s "$scratch/picture.png" "$scratch/expected.png"; then
        fail "$1: another picture"
    fi
    rm -f "$scratch/picture.png"
    found=static
    readelf -d "$2" | grep -q 'NEEDED.*libburnish' && found=shared
    [ "$found" = "$3" ] || fail "$1: linked $found, not $3"
}

shared=shared
[ -f "$libdir/libburnish.so" ] || shared=static
cp "$source/docs/examples/picture.c" "$scratch/picture.c"
cp "$source/docs/examples/picture.c" "$scratch/picture.cpp"
prefix=$(pkg-config --variable=prefix burnish)
[ "$(realpath "$prefix")" = "$scratch/moved" ] || fail "pkg-config's prefix is $prefix, not $scratch/moved"
pkg-config --atleast-version=0.1 burnish || fail "pkg-config does not know burnish 0.1"
for language in c cpp; do
    compiler="gcc -std=c99"
    [ $language = c ] || compiler="g++ -std=c++11 -Wno-missing-field-initializers"
    $compiler -Wall -Wextra -Werror "$scratch/picture.$language" $(pkg-config --cflags --libs burnish) -o "$scratch/$language" &&
        draws "$language by pkg-config" "$scratch/$language" $shared
    # the archive alone, as for a program that others copy
    $compiler "$scratch/picture.$language" $(pkg-config --static --cflags --libs burnish | sed 's/-lburnish/-l:libburnish.a/') -o "$scratch/$language" &&
        draws "$language by pkg-config --static" "$scratch/$language" static
done

mkdir -p "$scratch/project"
cat >"$scratch/project/CMakeLists.txt" <<'LISTS'
cmake_minimum_required(VERSION 3.16)
project(user C CXX)
find_package(burnish 0.1 REQUIRED)
foreach(language c cpp)
  add_executable(any_${language} ../picture.${language})
  target_link_libraries(any_${language} PRIVATE burnish::burnish)
  add_executable(static_${language} ../picture.${language})
  target_link_libraries(static_${language} PRIVATE burnish::static)
endforeach()
LISTS
if cmake -S "$scratch/project" -B "$scratch/project/build" -DCMAKE_PREFIX_PATH="$scratch/moved" >"$scratch/cmake.log" 2>&1 &&
    cmake --build "$scratch/project/build" >>"$scratch/cmake.log" 2>&1; then
    for language in c cpp; do
        draws "$language by find_package" "$scratch/project/build/any_$language" $shared
        draws "$language by find_package, static" "$scratch/project/build/static_$language" static
    done
else
    fail "find_package: $(tail -n 20 "$scratch/cmake.log")"
fi
sed 's/burnish 0.1 /burnish 0.2 /' "$scratch/project/CMakeLists.txt" >"$scratch/project/later"
mv "$scratch/project/later" "$scratch/project/CMakeLists.txt"
cmake -S "$scratch/project" -B "$scratch/project/later" -DCMAKE_PREFIX_PATH="$scratch/moved" >/dev/null 2>&1 && fail "version 0.2 was found"

echo "install: $checks pictures, $failures failed"
[ "$checks" -eq 8 ] && [ "$failures" -eq 0 ]
