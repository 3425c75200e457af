#!/bin/sh
# The shaders are what scripts/shaders writes. Usage: written.sh LOBE_DIR SCRATCH
set -eu
rm -rf "$2"
"$1/scripts/shaders" "$2"
for file in "$2"/burnish.*; do
    cmp "$file" "$1/shaders/${file##*/}" || { echo "FAILED: shaders/${file##*/} is out of date with shaders/burnish.shade; run make shaders"; exit 1; }
done
echo "shaders: as they are written"
