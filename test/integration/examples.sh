#!/bin/sh
# The examples of docs/examples: compiled as their comments say, run, and their pictures compared: the
# same sphere within one step of 255, with a highlight; the one in integers to the bit. Usage: examples.sh COMPILER ARCHIVE SOURCE_DIR SCRATCH
set -eu
compiler=$1
archive=$2
source=$3
scratch=$4
mkdir -p "$scratch"
decoders= # of textures and gzip: those that the archive may have been built with
for module in expat libzstd libpng libjpeg libwebp OpenEXR libisal zlib; do
    decoders="$decoders $(pkg-config --libs $module 2>/dev/null || true)"
done
$compiler -std=c17 -O2 -Wall -Wextra -Werror -I"$source/lobe/include/burnish" "$source/docs/examples/copy_lobe.c" -lm -o "$scratch/copy_lobe"
$compiler -std=c17 -O2 -Wall -Wextra -Werror -I"$source/include" -I"$source/base/include" -I"$source/lobe/include" "$source/docs/examples/link_kernels.c" "$archive" -lm -o "$scratch/link_kernels"
"$scratch/copy_lobe" >"$scratch/copy.ppm"
"$scratch/link_kernels" >"$scratch/link.ppm" 2>"$scratch/link.txt"
grep -q '^kernels: ' "$scratch/link.txt"
size=$(wc -c <"$scratch/copy.ppm")
[ "$size" -eq $((256 * 256 * 3 + 15)) ] && [ "$(wc -c <"$scratch/link.ppm")" -eq "$size" ]
far=$(cmp -l "$scratch/copy.ppm" "$scratch/link.ppm" |
    awk '{a = substr($2, 1); b = substr($3, 1); d = oct(a) - oct(b); if (d > 1 || d < -1) n++}
         function oct(s,   i, v) {v = 0; for (i = 1; i <= length(s); i++) v = v * 8 + substr(s, i, 1); return v}
         END {print n + 0}')
bright=$(tail -c +16 "$scratch/copy.ppm" | od -An -v -tu1 -w3 | awk '$1 >= 235 {n++} END {print n + 0}')
echo "examples: $far bytes differ by more than 1, $bright bright pixels"
[ "$far" -eq 0 ] && [ "$bright" -gt 50 ]

# Meshes from the program's own arrays and from memory.
$compiler -std=c17 -O2 -Wall -Wextra -Werror -I"$source/include" -I"$source/base/include" -I"$source/lobe/include" "$source/docs/examples/own_mesh.c" "$archive" $decoders -lm -pthread -o "$scratch/own_mesh"
"$scratch/own_mesh" | tee "$scratch/own_mesh.txt"
[ "$(cat "$scratch/own_mesh.txt")" = "square: 4 vertices, 2 triangles
red.obj: diffuse 1, 0 warnings" ]
