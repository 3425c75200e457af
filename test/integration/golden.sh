#!/bin/sh
# The pixels of known pictures, by hash: by every instruction set that runs here, with 1, 2 or 3 threads. A change of pixels is
# deliberate: rewrite the list with `make golden` and say it in CHANGELOG.md.
# GOLDEN_HOW: other pairs THREADS:ISA, for slow builds. GOLDEN_EVERY=N: each N-th picture, for slow emulators.
# Usage: golden.sh BURNISH SCRATCH [--update]
set -u
mkdir -p "$2"
burnish=$(realpath "$1")
scratch=$(realpath "$2")
here=$(cd "$(dirname "$0")/.." && pwd)
list=$here/golden/pixels.txt
failures=0
checks=0

# prints the hash of one picture
picture() {
    (cd "$here/data" && "$burnish" render $1 --threads="$2" --isa="$3" --json -o "$scratch/golden.png") |
        sed -n 's/.*"hash":[[:space:]]*"\([0-9a-f]\{16\}\)".*/\1/p' | tail -n 1
}

if [ "${3:-}" = --update ]; then
    cut -d' ' -f2- "$list" | while read -r arguments; do
        hash=$(picture "$arguments" 2 auto)
        echo "${hash:-none} $arguments"
    done >"$scratch/pixels.txt"
    if grep -n '^none' "$scratch/pixels.txt"; then
        echo "golden: these pictures failed; the list is unchanged"
        exit 1
    fi
    mv "$scratch/pixels.txt" "$list"
    exit
fi

sets='' threads=1
for isa in scalar sse2 avx2 avx512 neon; do
    "$burnish" render :sphere --size=16 --isa=$isa -o "$scratch/golden.png" 2>/dev/null && threads=$((threads % 3 + 1)) && sets="$sets $threads:$isa"
done
# builds for other systems may have no decoder of textures
lacks=$(cd "$here/data" && "$burnish" render textured.obj --size=16 -o "$scratch/golden.png" 2>&1 | grep -c 'reads no PNG')
awk -v n="${GOLDEN_EVERY:-1}" -v lacks="$lacks" '!(lacks && $2 ~ /^textured/) && ++count % n == 0' "$list" >"$scratch/golden.txt"
while read -r expected arguments; do
    for how in ${GOLDEN_HOW:-$sets}; do
        checks=$((checks + 1))
        got=$(picture "$arguments" "${how%:*}" "${how#*:}")
        if [ "$got" != "$expected" ]; then
            echo "FAIL: $arguments --threads=${how%:*} --isa=${how#*:}: pixels hash to '$got', expected $expected"
            failures=$((failures + 1))
        fi
    done
done <"$scratch/golden.txt"
rm -f "$scratch/golden.png"
echo "golden: $checks checks, $failures failed; instruction sets:$sets"
[ "$checks" -ge 15 ] && [ "$failures" -eq 0 ]
