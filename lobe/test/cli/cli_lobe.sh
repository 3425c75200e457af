#!/bin/sh
# burnish lobe: every example of the help runs, numbers against closed forms, formats, claims, usage.
# usage: cli_lobe.sh BURNISH SCRATCH
docs=$(realpath "$(dirname "$0")/../../docs")
. "$(dirname "$0")/../../../base/test/lib.sh"

# near VALUE AWK-EXPRESSION TOLERANCE: absolute, 1 for the unit. The expression may use pi and acos.
near() {
    awk -v v="$1" "function acos(x) { return atan2(sqrt(1 - x * x), x) }
        BEGIN { pi = atan2(0, -1); d = v - ($2); exit !(v != \"\" && d <= $3 && d >= -$3) }"
}

# cell LOBE KEY: of the last output, a CSV table.
cell() {
    awk -F, -v lobe="$1" -v key="$2" '
        NR == 1 { for (i = 1; i <= NF; ++i) if ($i == key) column = i }
        NR > 1 && $2 == lobe { print $column; exit }' "$out"
}

# number TEXT LOBE KEY EXPRESSION TOLERANCE
number() {
    checks=$((checks + 1))
    value=$(cell "$2" "$3")
    near "$value" "$4" "$5" || fail "$1: $2 $3 is '$value', not $4"
}

# ---- Numbers ----

gives 0 table --lobes=taylor:2,energy:4,level0.5:2,schlick,power,minimax:2 --exponents=18 --metrics=all --format=csv
number zeta taylor:2 zeta "9" 1e-14
number zeta energy:4 zeta "19/5" 1e-14
number zeta level0.5:2 zeta "(1 - sqrt(.5)) / (1 - exp(log(.5) / 18))" 1e-12
number "minimax (Beaudoin and Guardado)" minimax:2 zeta "6.645" 6e-4
number "minimax (Beaudoin and Guardado)" minimax:2 max_error ".0631" 6e-5
number zero taylor:2 zero_angle_deg "acos(16/18) * 180 / pi" 1e-11
number zero taylor:2 cutoff_cosine "16/18" 1e-14
number zero schlick zero_angle_deg "90" 1e-12
number radius taylor:2 curvature_radius_rad "1 / 34" 1e-14
number inflection power inflection_deg "acos(sqrt(17/18)) * 180 / pi" 1e-11
number angle power angle_deg_8 "acos(exp(-8 * log(2) / 18)) * 180 / pi" 1e-11
number angle schlick angle_deg_8 "acos(18 / (256 + 17)) * 180 / pi" 1e-11
number angle taylor:2 angle_deg_8 "acos(1 - (1 - 1/16) / 9) * 180 / pi" 1e-11
number ratio taylor:2 ratio_8 "acos(exp(-8 * log(2) / 18)) / acos(1 - (1 - 1/16) / 9)" 1e-12
number boundary taylor:2 boundary_cosine_8 "1 - (1 - 1/16) / 9" 1e-14
number integral energy:4 integral_sr "2 * pi / 19" 1e-13
number integral power integral_sr "2 * pi / 19" 1e-13
number energy energy:4 energy "1" 1e-13
number energy taylor:2 energy "(1 / 27) * 19" 1e-13
number integral taylor:2 cosine_integral_sr "2 * pi * (9 * 4 - 1) / (81 * 12)" 1e-13
number factor power normal_factor_per_sr "20 / (2 * pi)" 1e-12
number factor power phong_factor_per_sr "20 / (2 * pi)" 1e-12
number factor power blinn_factor_per_sr "20 * 22 / (8 * pi * (exp(-9 * log(2)) + 18))" 1e-10
number factor power blinn_factor_common_per_sr "26 / (8 * pi)" 1e-13
number extreme energy:4 extreme_angle_deg "acos(18 * (3.8 - 1) / (3.8 * 14)) * 180 / pi" 1e-10
number extreme energy:4 extreme_searched_deg "acos(18 * (3.8 - 1) / (3.8 * 14)) * 180 / pi" 1e-5
number alpha power alpha "sqrt(2 / 20)" 1e-14
number toksvig power toksvig_exponent_0.9 "18 * .9 / (.9 + 1.8)" 1e-12
number phong power phong_exponent "4.5" 1e-14
number value taylor:2 value_10 "(1 - 9 * (1 - cos(pi / 18)))^2" 1e-13
number slope taylor:2 slope_per_rad_10 "-18 * sin(pi / 18) * (1 - 9 * (1 - cos(pi / 18)))" 1e-12
number second taylor:2 second_per_rad2_10 \
    "162 * sin(pi / 18)^2 - 18 * cos(pi / 18) * (1 - 9 * (1 - cos(pi / 18)))" 1e-11
number radius taylor:2 radius_rad_10 \
    "(1 + (18 * sin(pi / 18) * (1 - 9 * (1 - cos(pi / 18))))^2)^1.5 / (18 * cos(pi / 18) * (1 - 9 * (1 - cos(pi / 18))) - 162 * sin(pi / 18)^2)" 1e-11
number relative taylor:2 relative_percent_10 \
    "100 * ((1 - 9 * (1 - cos(pi / 18)))^2 / cos(pi / 18)^18 - 1)" 1e-10
number cost energy:4 multiplications "3" 0
number cost schlick divisions "1" 0
number cost power functions "1" 0
check "no number is an empty field" [ -z "$(cell power zeta)" ]
# the maximum by a scan that knows nothing of the library
scan=$(awk 'BEGIN { for (i = 0; i <= 200000; ++i) { c = i / 200000; u = 1 - 9 * (1 - c); w = u > 0 ? u * u : 0
    d = w - c^18; d = d < 0 ? -d : d; if (d > m) m = d } printf "%.12f", m }')
number "maximum error" taylor:2 max_error "$scan" 1e-8

run table --lobes=taylor:2,schlick --exponents=100 --range=inflection --metrics=max-relative --format=csv
number "paper's figure 4" taylor:2 max_relative_percent "7.18" 5e-3
number "paper's figure 4" schlick max_relative_percent "9.9146" 5e-5
run table --lobes=shift7 --exponents=21 --range=level:0.45 --metrics=max-error --format=csv
number "down to a level" shift7:2 max_error ".0181" 5e-5

# lists
run table --exponents=3-5,10-30:10,2-16x2 --lobes=power --metrics=zeta --format=csv
check "exponents: $(cut -d, -f1 "$out" | tr '\n' ' ')" \
    [ "$(cut -d, -f1 "$out" | tr '\n' ' ')" = "exponent 3 4 5 10 20 30 2 4 8 16 " ]
run table --exponents=8,1.5e1 --lobes=taylor:16,minimax:8 --metrics=zeta --format=csv
check "an order that an exponent does not allow is an empty field" \
    [ "$(sed -n 2p "$out")" = "8,taylor:16," ]
check "a lobe that exists has a number" [ "$(sed -n 3p "$out" | cut -d, -f3)" != "" ]

# ---- Formats ----

run table --metrics=all --lobes=power,schlick,table16,taylor:32,gaussian,zeta4:2 --exponents=1,10
check "text is wider than 100 columns or ends in blanks" awk 'length($0) > 100 || / $/ { exit 1 }' "$out"
check "units" grep -q 'deg' "$out"
run table --metrics=all --exponents=1,10,100 --format=json
check "table --format=json" valid_json
check "JSON has no nan or inf" sh -c "! grep -qiE 'nan|inf[^l]' '$out'"
run table --metrics=all --exponents=1,10,100 --format=csv
check "CSV rows have one width" awk -F, 'NR == 1 { n = NF } NF != n { exit 1 } END { exit NR != 22 }' "$out"
run table --format=markdown
check "Markdown" awk -F'|' 'NR == 1 { n = NF } NF != n || !/^\|.*\|$/ { exit 1 } END { exit NR != 16 }' "$out"
LC_ALL=de_DE.UTF-8 "$burnish" table --format=csv >german.txt
"$burnish" table --format=csv | cmp -s - german.txt
check "the locale changes a table" [ $? = 0 ]
rm german.txt

# ---- Claims ----

gives 0 claims
check "claims: count" sh -c "tail -n 2 '$out' | tr '\n' ' ' | grep -qx '43 claims. holds: 18; holds in part: 18; does not hold: 2; measured by benchmark: 2; counted in machine code: 3 '"
check "claims: too wide" awk 'length($0) > 100 || / $/ { exit 1 }' "$out"
run claims --format=json
check "claims --format=json" valid_json
check "claims: 43 in JSON" [ "$(json id | wc -l)" -eq 43 ]
run claims --format=csv
sed '1d; s/^.*,//' "$out" | sort -u >commands.txt
check "hardly any commands" [ "$(wc -l <commands.txt)" -ge 38 ]
mkdir bin
ln -s "$burnish" bin/burnish-lobe
while read -r command; do
    case $command in
    "make bench" | "make operations") ;;
    "burnish-lobe "*) check "a claim's command fails: $command" sh -c "PATH='$scratch/bin':\$PATH; $command" ;;
    *) check "a claim's command is no command: $command" false ;;
    esac
done <commands.txt
rm -r bin commands.txt
run claims --format=csv
check "claims CSV: core-w at 200" sh -c "grep '^core-w,' '$out' | grep -q ',n=200,7\.2206.*,1,at most,7.2,0.1,holds in part,the paper,burnish-lobe claims core-w$'"
for id_verdict in "peak holds" "core-w holds in part" "w05-large does not hold" "speed-w measured by benchmark"; do
    run claims "${id_verdict%% *}"
    check "claims $id_verdict" sh -c "head -n 1 '$out' | grep -q ' ${id_verdict#* }\$' && [ '$code' = 0 ]"
done
run claims --format=markdown
check "claims: not the paper" sh -c "grep -c 'Lyon 1993, not the paper' '$out' | grep -qx 1"
check "claims --format=markdown" awk -F'|' 'NF != 7 { exit 1 } END { exit NR != 45 }' "$out"

# ---- Choose ----

run choose --exponent=100 --epsilon=0.02 --format=json
check "choose --format=json" valid_json
check "choose: $(json lobe | head -n 1)" [ "$(json lobe | head -n 1)" = minimax:8 ]
check "A + B is 1" near "$(json a)" "1 - ($(json b))" 1e-6
check "error within epsilon" awk -v e="$(json max_error | head -n 1)" 'BEGIN { exit !(e > .014 && e <= .02) }'
run choose --exponent=20 --epsilon=0.024 --affine
check "choose --affine" grep -q '^affine:4 is the cheapest lobe within 0.024 of c^20 ' "$out"
run choose --exponent=20 --epsilon=0.024
check "without: one squaring more" grep -q '^minimax:8 is the cheapest' "$out"
# what is printed, compiled by the reader's own eyes: awk takes A and B and must find the error stated
error=$(awk '/float A/ { a = $6 + 0 } /float B/ { b = $6 + 0 } END {
    for (i = 0; i <= 20000; ++i) { c = i / 20000; u = a * c + b; u = u > 0 ? u : 0
        d = u^8 - c^20; d = d < 0 ? -d : d; m = d > m ? d : m } printf "%.5f", m }' "$out")
check "constants give $error" grep -q "largest error  $error\$" "$out"
for exponent in 20 65536; do
    run choose --exponent=$exponent --epsilon=0.0002
    error=$(awk -v n=$exponent '/float [AT]/ { k[$4] = $6 + 0 } /float C/ { c_[++steps] = $6 + 0 } END {
        for (i = 0; i <= 20000; ++i) { x = 12 / n * i / 20000; u = k["T"] - k["A"] * x; u = u > 0 ? u * u : 0
            for (j = 1; j <= steps; ++j) u *= u + c_[j]
            d = u - (1 - x)^n; d = d < 0 ? -d : d; m = d > m ? d : m } printf "%.8f", m }' "$out")
    check "a composite's constants give $error" near "$error" "$(awk '/largest error/ { print $3 }' "$out")" 1e-6
done
run choose --roughness=0.4 --epsilon=0.07
check "two lobes for GGX" grep -q '^2 lobes are within 0.07 of the energy of GGX at roughness 0.4' "$out"
# the weights of the code at c = 1 are the peak: share of the energy times zeta (order + 1) / (2 pi)
peak=$(awk '/specular/ { sum += $3 + 0 } END { print sum }' "$out")
run choose --roughness=0.4 --epsilon=0.07 --format=json
check "its code has the peak" near "$peak" "($(json weight | head -n 1) * $(json zeta | head -n 1) * 5 + $(json weight | tail -n 1) * $(json zeta | tail -n 1) * 2) / 6.2831853" 1e-5
run table --lobes=power --exponents=76.125 --metrics=ggx-moved:2 --format=json
check "table knows the sums" near "$(json ggx_moved_percent_2)" 6.85 0.01
run choose --exponent=20 --epsilon=1e-7
check "nothing but the power" grep -q '^power is the cheapest' "$out"

gives 0 table --lobes=power,energy:2 --exponents=20 --metrics=phong-albedo,blinn-albedo --format=csv
number albedo power phong_albedo 1 1e-12
number albedo power blinn_albedo "28 / (8 * pi) * 0.952039" 1e-5
number albedo energy:2 blinn_albedo "28 / (8 * pi) * 0.99738915" 1e-8

# ---- The pages ----

# says LOBE N METRIC VALUE DIGITS [RANGE]: with that many digits after the point, also in theory.md.
says() {
    run table --lobes="$1" --exponents="$2" --metrics="$3" --range="${6:-all}" --format=csv
    check "$3 of $1 at n = $2 is not $4" awk -F, -v said="$4" -v digits="$5" \
        'NR == 2 { exit !(sprintf("%." digits "f", $3) == sprintf("%." digits "f", said)) }' "$out"
    check "theory.md doesn't say $4" grep -qF "${4#0}" "$docs/theory.md"
}
says taylor:2 100 zero-angle 11 0
says energy:2 10 zero-angle 43 0
says schlick 100 angle:8 73.6 1
says power 100 angle:8 18.9 1
says taylor:2 100 angle:8 11.1 1
says taylor:2 100 curvature-radius 0.005 3
says power 10 radius:36.86989765 0.49 2
says power 100 radius:11.47834095 0.58 2
says power 1000 radius:3.62430750 1.57 2
says shift7 1000 max-relative 1.9 1 inflection

# Their commands run.
cat "$docs"/*.md | grep -o '`burnish-lobe [a-z]* [^`]*`' | tr -d '`' >"$out.commands"
check "hardly any commands in lobe/docs" [ "$(wc -l <"$out.commands")" -ge 8 ]
while read -r program arguments; do
    case $arguments in *[A-Z]*) continue ;; esac
    gives 0 $arguments
done <"$out.commands"

# ---- Usage ----

expect 2 'burnish: no command; try "burnish-lobe table" or "burnish-lobe --help"'
expect 2 'burnish: "tabel": unknown command; did you mean table?' tabel
expect 2 'burnish: "tabel": unknown command; did you mean table?' help tabel
expect 2 'burnish: "frobnicate": unknown command; "burnish-lobe --help" lists the commands' frobnicate
expect 2 'burnish: "--format": unknown command; "burnish-lobe --help" lists the commands' --format
expect 2 'burnish: help: "x": table has no subcommands; try burnish-lobe help table' help table x
expect 2 'burnish: table: "x" is not a flag; "burnish-lobe table --help" lists the flags' table x
expect 2 'burnish: --metric: unknown flag; did you mean --metrics?' table --metric=zeta
expect 2 'burnish: --metrics: "zetta": unknown metric; did you mean zeta?' table --metrics=zetta
expect 2 'burnish: --metrics: "frobnicate": unknown metric; "burnish-lobe help --man" lists them' table --metrics=zeta,frobnicate
expect 2 'burnish: --metrics: "angle:0": angle takes bits above 0 and up to 1024, as in angle:8' table --metrics=angle:0
expect 2 'burnish: --metrics: "zeta:2": zeta takes no number; remove the text after the colon' table --metrics=zeta:2
expect 2 'burnish: --exponents: "0" is not an exponent from 1 to 65536, nor a range such as 1-1023, 10-100:10 or 2-1024x2' table --exponents=0
expect 2 'burnish: --exponents: "9-3" is not an exponent from 1 to 65536, nor a range such as 1-1023, 10-100:10 or 2-1024x2' table --exponents=9-3
expect 2 'burnish: --exponents: more than 65536 exponents; give fewer or wider steps' table --exponents=1-65536:0.001
expect 2 'burnish: --range: "level:2" is not all, inflection, nor level:L with L between 0 and 1, such as level:0.5' table --range=level:2
expect 2 'burnish: --format: "xml" is not one of text, csv, json, markdown' table --format=xml
expect 5 'burnish: table: 458752 rows of 14 columns are more than 4194304 cells; use fewer lobes, exponents or metrics' table --exponents=1-65536
expect 2 'burnish: claims: "core": unknown claim; did you mean core-w?' claims core
expect 2 'burnish: claims: "b" is an extra operand; usage: burnish-lobe claims [ID] [options]' claims a b
expect 2 'burnish: choose: --exponent is missing; try "burnish-lobe choose --exponent=100 --epsilon=0.02"' choose
expect 2 'burnish: choose: --epsilon is missing; try "burnish-lobe choose --exponent=100 --epsilon=0.02"' choose --exponent=9
expect 2 'burnish: --roughness: not available with --exponent; omit one of them' choose --exponent=9 --roughness=0.5 --epsilon=0.1
expect 2 'burnish: --epsilon: no sum of 3 lobes is that close; use at least 0.029' choose --roughness=0.4 --epsilon=0.01
expect 2 'burnish: --metrics: "ggx-moved:4": ggx-moved takes 1, 2 or 3 lobes, as in ggx-moved:2' table --metrics=ggx-moved:4
expect 2 'burnish: --epsilon: "1" is not a number between 0 and 1' choose --exponent=9 --epsilon=1
nothing_left "wrong usage"

finish
