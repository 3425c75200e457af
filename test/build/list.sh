#!/bin/sh
# src/sources.txt is the list of files for builds without CMake, ISA-L, zlib and theory.h. Usage: list.sh SOURCE_DIR [--update]
set -eu
cd "$1"
list=$(find src -name '*.c' ! -name '*_isal.c' ! -name '*_zlib.c' ! -path 'src/theory/*' | LC_ALL=C sort)
[ "${2:-}" != --update ] || echo "$list" >src/sources.txt
echo "$list" | diff src/sources.txt - || { echo "src/sources.txt is out of date; run test/build/list.sh . --update"; exit 1; }
