#!/bin/sh
# The pixels of known pictures, by hash, with 1, 2 and 7 threads. A change of pixels is deliberate: rewrite
# the list with `make golden` and say it in CHANGELOG.md. Usage: golden.sh BURNISH SCRATCH [--update]
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
    # shellcheck disable=SC2086
    (cd "$here/data" && "$burnish" render $1 --threads="$2" --json -o "$scratch/golden.png") |
        sed -n 's/.*"hash":[[:space:]]*"\([0-9a-f]\{16\}\)".*/\1/p' | tail -n 1
}

if [ "${3:-}" = --update ]; then
    cut -d' ' -f2- "$list" | while read -r arguments; do
        hash=$(picture "$arguments" 2)
        echo "${hash:-none} $arguments"
    done >"$scratch/pixels.txt"
    if grep -n '^none' "$scratch/pixels.txt"; then
        echo "golden: these pictures failed; the list is unchanged"
        exit 1
    fi
    mv "$scratch/pixels.txt" "$list"
    exit
fi

while read -r expected arguments; do
    for threads in 1 2 7; do
        checks=$((checks + 1))
        got=$(picture "$arguments" $threads)
        if [ "$got" != "$expected" ]; then
            echo "FAIL: $arguments --threads=$threads: pixels hash to '$got', expected $expected"
            failures=$((failures + 1))
        fi
    done
done <"$list"
rm -f "$scratch/golden.png"
echo "golden: $checks checks, $failures failed"
[ "$checks" -ge 30 ] && [ "$failures" -eq 0 ]
