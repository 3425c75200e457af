#!/bin/sh
# The shaders are up to date, and scripts/shaders --check finds files that are not. Usage: shaders.sh SOURCE_DIR SCRATCH
set -eu
write=$1/scripts/shaders
"$write" --check
rm -rf "$2"
"$write" "$2"
"$write" --check "$2"
touch "$2/glsl/left.glsl"
! "$write" --check "$2" 2>"$2/left.txt" || { echo "FAILED: a left-over file is not found"; exit 1; }
grep -q 'left.glsl: no source describes this file' "$2/left.txt"
rm "$2/glsl/left.glsl"
echo >>"$2/burnish.osl"
! "$write" --check "$2" 2>"$2/changed.txt" || { echo "FAILED: a changed file is not found"; exit 1; }
grep -q 'burnish.osl is out of date' "$2/changed.txt"
echo "shaders: as they are written"
