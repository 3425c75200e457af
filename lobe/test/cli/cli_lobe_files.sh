#!/bin/sh
# burnish-lobe boundary: words against closed forms, C that compiles, Verilog that loads; and that -o writes the whole file or none.
# usage: cli_lobe_files.sh BURNISH SCRATCH
. "$(dirname "$0")/../../../base/test/lib.sh"

# ---- Boundary ----

# energy:2 at q = 8: cosine 1 - (1 - 2^-4) 3 / (n + 1), 0 where that is below 0; rounded down
run boundary --as=csv
check "boundary CSV against the formula" awk -F, 'NR == 1 { if ($0 != "exponent,word,hex,value,cosine") bad = 1; next }
    { n = NR - 1; c = 1 - 15 / 16 * 3 / (n + 1); c = c > 0 ? c : 0; d = $5 - c
      if ($1 != n || $2 != int(32768 * c) || d > 1e-14 || d < -1e-14 || $4 != $2 / 32768) bad = 1 }
    END { exit bad || NR != 1024 }' "$out"
run boundary --as=csv --lambda --lobe=power --exponents=2-4096x2 --bits=10 --format-word=UQ0.24
check "lambda of the power" awk -F, 'NR > 1 { l = 1 - exp(-10 * log(2) / $1); d = $5 - l; w = l * 2^24
    if (d > 1e-13 || d < -1e-13 || $2 < w || $2 > w + 1.00001) bad = 1 } END { exit bad || NR != 13 }' "$out"
run boundary --as=csv --exponents=100 --bits=0 --lobe=taylor:2 --rounding=nearest
check "the zero of taylor: $(sed -n 2p "$out")" [ "$(sed -n 2p "$out")" = "100,32113,7d71,0.980010986328125,0.98" ]

gives 0 boundary --exponents=1-40 -o ok.c --name=table
check "nothing on standard output" [ ! -s "$out" ]
run boundary --exponents=1-40 --as=csv
cp "$out" words.csv
cat >main.c <<'CODE'
#include <stdio.h>
#include "ok.c"
int main(void) {
    for (unsigned i = 0; i < sizeof table / sizeof table[0]; ++i) {
        printf("%d\n", (int)table[i]);
    }
    return 0;
}
CODE
check "the C array does not compile" gcc -std=c99 -pedantic-errors -Wall -Wextra -Werror -o words main.c
check "the C array holds other words" sh -c "./words >a.txt; sed 1d words.csv | cut -d, -f2 | cmp - a.txt && [ -s a.txt ]"
run boundary --exponents=1,10,100.5 --format-word=Q0.7 --lambda -o ok.c --name=table
cat >>main.c <<'CODE'
const float *last_exponent(void);
const float *last_exponent(void) { return &table_exponents[2]; }
CODE
check "the C array with exponents does not compile" gcc -std=c99 -pedantic-errors -Wall -Wextra -Werror -o words main.c
check "signed words" [ "$(./words | tr '\n' ' ')" = "127 33 4 " ]

# The same words by the reader that is printed with them, and in an AVR's program memory.
run boundary --exponents=1-40 --as=progmem -o ok.c --name=table
cat >at.c <<'CODE'
#include <stdio.h>
#include "ok.c"
int main(void) {
    for (uint16_t i = 0; i < 40; ++i) {
        printf("%d\n", (int)table_at(i));
    }
    return 0;
}
CODE
check "progmem does not compile" gcc -std=c99 -pedantic-errors -Wall -Wextra -Werror -o words at.c
check "progmem holds other words" sh -c "./words >a.txt; sed 1d words.csv | cut -d, -f2 | cmp - a.txt && [ -s a.txt ]"
has "progmem on AVR" avr-gcc && has_avr=1 || has_avr=
for format in UQ0.7 UQ0.15 Q0.31; do
    run boundary --exponents=1,10,100.5 --format-word=$format --lambda --as=progmem -o ok.c --name=table
    check "progmem, $format, does not compile" gcc -std=c99 -pedantic-errors -Wall -Wextra -Werror -fsyntax-only ok.c
    if [ -n "$has_avr" ]; then
        printf '#include "ok.c"\nfloat user(uint16_t i);\nfloat user(uint16_t i) { return table_at(i) + table_exponents_at(i); }\n' >user.c
        check "progmem, $format, does not compile on AVR" avr-gcc -mmcu=atmega328p -std=c99 -Os -Wall -Wextra -Werror -c user.c -o user.o
        check "progmem, $format, is not in program memory" sh -c "avr-objdump -t user.o | grep -q '[.]progmem.*table_exponents' && avr-objdump -d user.o | grep -q lpm"
    fi
done
expect 2 'burnish: --as=progmem: 16384 numbers of 2 bytes; an array on AVR has at most 32767 bytes: give fewer --exponents' boundary --as=progmem --exponents=1-16384

run boundary --exponents=1-40 --as=mem -o words.mem
check "mem: words, comments and an address only" awk '/^\/\// || /^@0$/ { next }
    !/^[0-9a-f][0-9a-f][0-9a-f][0-9a-f] \/\/ n = [0-9]+$/ { exit 1 }' words.mem
check "mem holds other words" sh -c "sed 1d words.csv | cut -d, -f3 >a.txt; sed -n 's/ .*n = .*//p' words.mem | grep -v '^//' | cmp - a.txt && [ -s a.txt ]"
if has "memories in Verilog" iverilog vvp; then
    cat >bench.v <<'CODE'
module bench;
    reg [14:0] words [0:39];
    integer i;
    initial begin
        $readmemh("words.mem", words);
        for (i = 0; i < 40; i = i + 1) $display("%0d", words[i]);
    end
endmodule
CODE
    check "iverilog" iverilog -o bench bench.v
    check "\$readmemh reads other words" sh -c "vvp bench >a.txt; sed 1d words.csv | cut -d, -f2 | cmp - a.txt"
fi
rm -rf ./*

expect 2 'burnish: --name: "2x" is not a name in C: letters, digits and _' boundary --name=2x
expect 2 'burnish: --lobe: "power,gx" is 2 lobes; a memory holds one' boundary --lobe=power,gx
expect 2 'burnish: --format-word: "Q40" is not a fixed-point format; use UQ0.15 (unsigned, 0 integer and 15 fraction bits), Q0.15 (and a sign bit) or Q15, at most 32 bits' boundary --format-word=Q40
expect 2 'burnish: boundary: 0.5 threshold bits; use 1 to 1024, or 0 for the lobe'"'"'s zero' boundary --bits=0.5
expect 2 'burnish: --as: "hex" is not one of c, progmem, mem, csv' boundary --as=hex

# ---- Whole or nothing ----

for part in "table" "claims peak" "boundary" "choose --exponent=9 --epsilon=.1"; do
    gives 0 $part -o whole.txt
    run $part
    check "lobe $part: -o writes something else" cmp -s whole.txt "$out"
    rm -f whole.txt
    nothing_left "lobe $part -o"
    expect 7 "burnish: no/where.txt: can't be written: No such file or directory; create the folder first" $part -o no/where.txt
    expect 7 "burnish: /dev/full: can't be written: No space left on device; free some space" $part -o /dev/full
    "$burnish" $part >/dev/full 2>"$err"
    check "lobe $part into a full device: code $?" grep -qx "burnish: standard output: can't be written: No space left on device; free some space" "$err"
    mkdir folder
    expect 7 "burnish: folder: can't be written: it is a folder; name a file in it" $part -o folder
    rmdir folder
done
echo kept >old.csv
expect 2 'burnish: --lobe: "nonsense" is not a lobe; use FIT:ORDER with FIT taylor, energy, levelQ (0 < Q < 1), shift7, shift3, projected, minimax, leastsquares, affine or zetaZ and ORDER 2, 4, 8, 16 or 32, or composite:2 to composite:6, display:5, display:6, lyon:ORDER, power, schlick, gaussian, gx, exact, auto, nv2x, kuijk-blake, tableN[:linear]' boundary --lobe=nonsense -o old.csv
check "a failed run touched the file" [ "$(cat old.csv)" = kept ]
rm old.csv
if [ "$(id -u)" -ne 0 ]; then
    mkdir locked
    chmod 555 locked
    expect 7 "burnish: locked/a.csv: can't be written: Permission denied" table -o locked/a.csv
    check "something in the locked folder" [ -z "$(ls -A locked)" ]
    rmdir locked
elif [ -d /proc/self ]; then
    gives 7 table -o /proc/self/a.csv  # a folder that takes no files
fi
nothing_left "all runs"

finish
