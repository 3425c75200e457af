#!/bin/sh
# burnish lobe fit: known lobes are found again, noise is borne, every file that is no samples ends in
# one line.
# usage: cli_lobe_fit.sh BURNISH SCRATCH
. "$(dirname "$0")/lib.sh"

# best KEY: of the last output, the best lobe's value in JSON.
best() { tr -d '\n\t ' <"$out" | sed 's/.*"best":{//; s/"lobes":\[.*//' | grep -o "\"$1\":[^,}]*" | head -n 1 | sed 's/^.*"://; s/"//g'; }

# lobe ORDER ZETA SCALE OFFSET: angles from 0 to 60 degrees and intensities.
lobe() {
    awk -v m="$1" -v zeta="$2" -v scale="$3" -v offset="$4" 'BEGIN { for (a = 0; a <= 60; ++a) {
        u = 1 - zeta * 2 * sin(a * atan2(0, -1) / 360)^2
        printf "%d,%.17g\n", a, offset + scale * (u > 0 ? u^m : 0) } }'
}

# within VALUE WANTED RELATIVE
within() { awk -v v="$1" -v w="$2" -v e="$3" 'BEGIN { d = v / w - 1; exit !(v != "" && d < e && -d < e) }'; }

# ---- Round trips ----

# energy:m at n: zeta (n + 1) / (m + 1)
for order_n_scale in "2 10 1" "2 100 0.8" "4 60 37.5" "8 25 1e-6" "16 200 2e9" "32 64 1"; do
    # shellcheck disable=SC2086
    set -- $order_n_scale
    zeta=$(awk -v n="$2" -v m="$1" 'BEGIN { printf "%.17g", (n + 1) / (m + 1) }')
    lobe "$1" "$zeta" "$3" 0 >s.csv
    gives 0 lobe fit s.csv --format=json
    check "fit energy:$1 $2: JSON" valid_json
    check "fit energy:$1 $2: order $(best order)" [ "$(best order)" = "$1" ]
    check "fit energy:$1 $2: zeta $(best zeta)" within "$(best zeta)" "$zeta" 1e-6
    check "fit energy:$1 $2: scale $(best scale)" within "$(best scale)" "$3" 1e-6
    check "fit energy:$1 $2: exponent $(best "energy:$1")" within "$(best "energy:$1")" "$2" 1e-6
    # taylor's zeta is n / m
    check "fit energy:$1 $2: as taylor $(best "taylor:$1")" within "$(best "taylor:$1")" \
        "$(awk -v z="$zeta" -v m="$1" 'BEGIN { printf "%.17g", z * m }')" 1e-6
done
awk 'BEGIN { for (a = -80; a <= 80; a += 2) printf "%d;%.17g\n", a, 3 * cos(a * atan2(0, -1) / 180)^35.5 }' >s.csv
run lobe fit s.csv --format=json
check "the power: $(best lobe) $(best power)" sh -c "[ '$(best lobe)' = power ]"
check "the power's exponent $(best power)" within "$(best power)" 35.5 1e-6
check "the power has no order" [ "$(best order)" = null ]
awk 'BEGIN { for (i = 0; i <= 100; ++i) { c = i / 100; printf "%.17g\t%.17g\n", c, 2 * c / (40 - 39 * c) } }' >s.csv
run lobe fit s.csv --unit=cosine --format=json
check "schlick from cosines: $(best lobe)" [ "$(best lobe)" = schlick ]
check "schlick's exponent" within "$(best schlick)" 40 1e-6
lobe 4 12.2 0.8 0 | awk -F, '{ printf "%.17g %.17g\n", $1 * atan2(0, -1) / 180, $2 }' >s.csv
run lobe fit s.csv --unit=rad --format=json
check "radians" within "$(best zeta)" 12.2 1e-6
# an offset is found with --offset, and spoils the fit without
lobe 2 20 5 1.5 >s.csv
run lobe fit s.csv --offset --format=json
check "--offset: $(best offset)" within "$(best offset)" 1.5 1e-6
check "--offset: zeta $(best zeta)" within "$(best zeta)" 20 1e-6
check "--offset: order $(best order)" [ "$(best order)" = 2 ]
run lobe fit s.csv --format=json
check "no --offset: a bad fit all the same" awk -v r="$(best rms)" 'BEGIN { exit !(r > .1) }'

# noise of up to half a per cent, a fixed pattern
lobe 4 12.2 1 0 | awk -F, '{ e = sin(NR * 12.9898) * 43758.5453; e -= int(e); printf "%s,%.17g\n", $1, $2 + .005 * e }' >s.csv
run lobe fit s.csv --format=json
check "noise: order $(best order)" [ "$(best order)" = 4 ]
check "noise: zeta $(best zeta)" within "$(best zeta)" 12.2 0.05
check "noise: rms $(best rms)" awk -v r="$(best rms)" 'BEGIN { exit !(r > .001 && r < .005) }'

# what is printed for reading, and residuals that add up
run lobe fit s.csv
check "text is wide or ends in blanks" awk 'length($0) > 100 || / $/ { exit 1 }' "$out"
check "text names the lobe" grep -q '^61 samples. Best: .* times max(0, 1 - .* (1 - c))^4$' "$out"
check "text has all nine lobes" [ "$(grep -cE '^(order|power|schlick|gaussian|gx)' "$out")" -eq 9 ]
run lobe fit s.csv --format=csv
check "ranked" awk -F, 'NR > 2 && $6 < before { exit 1 } { before = $6 } END { exit NR != 10 }' "$out"
rms=$(sed -n 2p "$out" | cut -d, -f6)
run lobe fit s.csv --residuals --format=csv -o r.csv
check "residuals" awk -F, -v rms="$rms" 'NR == 1 { if ($0 != "angle_deg,intensity,fitted,residual") bad = 1; next }
    { d = $2 - $3 - $4; if (d > 1e-12 || d < -1e-12) bad = 1; s += $4 * $4 }
    END { q = sqrt(s / (NR - 1)) / rms - 1; exit bad || NR != 62 || q > 1e-9 || q < -1e-9 }' r.csv
run lobe fit s.csv --residuals --format=json
check "residuals as JSON" valid_json
"$burnish" lobe fit - <s.csv >piped.txt
check "standard input" sh -c "'$burnish' lobe fit s.csv | cmp -s - piped.txt"

# ---- Forms of files ----

lobe 2 20 1 0 >plain.csv
run lobe fit plain.csv --format=csv
cp "$out" plain.out
same_fit() {
    run lobe fit "$2" --format=csv
    check "$1 reads differently: $(cat "$err")" cmp -s "$out" plain.out
}
{ printf 'angle,intensity\r\n# a comment\r\n\r\n'; sed 's/$/\r/' plain.csv; } >a.csv
same_fit "heading, comment, CR LF" a.csv
tr ',' ';' <plain.csv >a.csv && same_fit "semicolons" a.csv
tr ',' '\t' <plain.csv >a.csv && same_fit "tabs" a.csv
sed 's/,/   /; s/^/  /; s/$/ /' plain.csv >a.csv && same_fit "blanks" a.csv
{ printf '\357\273\277'; cat plain.csv; } >a.csv && same_fit "a byte order mark" a.csv
sed 's/,/" , "/; s/^/"/; s/$/"/' plain.csv >a.csv && same_fit "quotes" a.csv
printf '%s' "$(cat plain.csv)" >a.csv && same_fit "no newline at the end" a.csv
rm -f ./*

# ---- What is no samples ----

bad() {
    printf "$3" >bad.csv
    expect "$1" "burnish: bad.csv$2" lobe fit bad.csv
}
expect 2 'burnish: lobe fit: no FILE; give CSV with angle and intensity per line, or see "burnish lobe fit --help"' lobe fit
expect 3 "burnish: none.csv: can't be opened: No such file or directory" lobe fit none.csv
expect 3 "burnish: .: can't be read: Is a directory" lobe fit .
bad 4 ': 0 samples; a fit needs 3 at least' ''
bad 4 ': 0 samples; a fit needs 3 at least' 'angle,intensity\n'
bad 4 ': 2 samples; a fit needs 3 at least' '0,1\n5,0.5\n'
bad 4 ':3: the intensity "x" is not a number' '0,1\n5,0.5\n9,x\n'
bad 4 ':3: the angle "" is not a number' '0,1\n5,0.5\n,2\n'
bad 4 ':2: 1 field; give two: angle and intensity' '0,1\n5\n9,2\n'
bad 4 ':2: 3 fields; give two: angle and intensity' '0,1\n5,2,3\n9,2\n'
bad 4 ':1: the angle "0,5" is not a number; write numbers with a decimal point' '0,5;1\n'
bad 4 ':2: the angle "nan" is not a number' '0,1\nnan,1\n'
bad 4 ':2: the intensity "inf" is not a number' '0,1\n1,inf\n'
bad 4 ':2: the intensity "0x10" is not a number' '0,1\n1,0x10\n'
bad 4 ':2: the angle "c" is not a number' 'a,b\nc,d\n'
bad 4 ':1: the angle 200 is not from -180 to 180 degrees; is --unit right?' '200,1\n'
bad 4 ':1: a zero byte: not a text file; give CSV with angle and intensity' '\000\001'
bad 4 ': all samples are at one angle; a fit needs several' '5,1\n5,2\n5,3\n'
bad 4 ': every intensity is 0; a fit needs positive ones' '1,0\n2,0\n3,0\n'
hopeless=': no lobe explains half of the variation; check that the intensity falls with the angle, check --unit, or try --offset'
bad 4 "$hopeless" '0,1\n10,1\n20,1\n30,1\n'
bad 4 "$hopeless" '0,1\n10,2\n20,3\n30,4\n40,9\n'
bad 4 "$hopeless" '0,-1\n10,-2\n20,-3\n30,-1\n'
printf '2,1\n' >bad.csv
expect 4 'burnish: bad.csv:1: the cosine 2 is not from -1 to 1; use --unit=deg or rad for angles' lobe fit bad.csv --unit=cosine
printf '0,1\n5,.5\n9,.1\n' >bad.csv
expect 4 'burnish: bad.csv: 3 samples; a fit with --offset needs 4 at least' lobe fit bad.csv --offset
head -c 5000 /dev/zero | tr '\0' 1 >bad.csv
expect 4 'burnish: bad.csv:1: the line is longer than 4095 bytes; give angle and intensity, one pair per line' lobe fit bad.csv
expect 4 'burnish: /dev/zero:1: a zero byte: not a text file; give CSV with angle and intensity' lobe fit /dev/zero
awk 'BEGIN { for (i = 0; i <= 1000000; ++i) print "1,1" }' >bad.csv
expect 5 'burnish: bad.csv:1000001: more than 1000000 samples; give fewer' lobe fit bad.csv
rm bad.csv
# numbers at the ends of the range of doubles
printf '0,1e300\n5,5e299\n10,1e299\n20,1e297\n' >big.csv
gives 0 lobe fit big.csv  # huge intensities
check "huge intensities: no inf, no nan" sh -c "! grep -qiE 'nan|inf' '$out'"
rm big.csv
nothing_left "broken files"

finish
