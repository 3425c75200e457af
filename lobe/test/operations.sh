#!/bin/sh
# lobe/firmware/operations: two multiplications and no division for W and W_0.5 wherever a multiplier takes 16
# by 16 bits, and, with the compilers of operations.csv, every number again. Usage: operations.sh LOBE_DIR SCRATCH
set -eu
lobe=$1
scratch=$2
list=$lobe/firmware/operations.csv
mkdir -p "$scratch"
"$lobe/firmware/operations" "$scratch" >"$scratch/again.csv"
awk -F, '
    /^#/ || $1 == "lobe" { next }
    { ++rows }
    $1 ~ /^w/ && ($7 != 0 || ($2 != "avr" && $3 != 2)) { print "operations: expected 2 multiplications and no division: " $0; bad = 1 }
    $1 == "schlick" && $8 < 100 && ($2 == "m0" || $2 == "avr") { print "operations: expected a division in steps: " $0; bad = 1 }
    END { exit bad || rows != 12 }' "$scratch/again.csv"
[ "$(head -n 1 "$list")" = "$(head -n 1 "$scratch/again.csv")" ] ||
    { echo "operations: other compilers than those of $list"; exit 0; }
diff -u "$list" "$scratch/again.csv" || { echo "operations: $list is out of date"; exit 1; }
