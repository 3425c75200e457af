#!/bin/sh
# burnish-lobe plot: the figures of lobe/docs/theory.md are what the program draws, their numbers agree with closed
# forms, runs repeat, errors are one line and leave nothing. Without gnuplot the drawings are skipped.
# usage: cli_figures.sh BURNISH SCRATCH
root=$(cd "$(dirname "$0")/../.." && pwd)
. "$(dirname "$0")/../../../base/test/lib.sh"
LC_ALL=C
export LC_ALL
command -v gnuplot >/dev/null && has_gnuplot=1 || has_gnuplot=0

# data FIGURE ARGUMENTS...: its CSV in data.csv.
data() {
    gives 0 plot "$@" --format=csv
    cp "$out" data.csv
}

# agrees TEXT PROGRAM: every row of data.csv for which the awk program sets `expected` agrees with it to eight digits
# (absolutely below 1), and there are at least `rows` of them, 50 unless told.
agrees() {
    checks=$((checks + 1))
    awk -F, '
        function abs(x) { return x < 0 ? -x : x }
        function max(a, b) { return a > b ? a : b }
        function acos(x) { return atan2(sqrt(max(0, 1 - x * x)), x) }
        function pow(x, y) { return x > 0 ? exp(y * log(x)) : 0 }
        BEGIN { degree = atan2(0, -1) / 180; wanted = 50 }
        function slope(lobe, n) { return lobe == "energy:2" ? (n + 1) / 3 : n / 2 }
        function value(lobe, n, c) {
            return lobe == "power" ? pow(c, n) : lobe == "schlick" ? c / (n - n * c + c) : max(0, 1 - slope(lobe, n) * (1 - c)) ^ 2
        }
        NR == 1 { next }
        { expected = "" }
        '"$2"'
        expected != "" {
            ++rows
            if (!(abs($3 - expected) <= 1e-8 * max(1, abs(expected)))) { print $0, expected; bad = 1 }
        }
        END { exit bad || rows < wanted }' data.csv >disagreements.txt ||
        fail "$1: $(head -3 disagreements.txt | tr '\n' ';')"
}

# ---- Numbers ---------------------------------------------------------------------------------------

data error --exponents=3,100
agrees "error: |W - cos^n|" '{ split($1, w, "="); c = cos($2 * degree); expected = abs(value("taylor:2", w[2], c) - pow(c, w[2])) }'
data curves
agrees "curves: power, W, Schlick" '{ split($1, w, " "); expected = value(w[1], 100, cos($2 * degree)) }'
data w1 --exponents=10
agrees "w1: power, W1" '{ split($1, w, " "); expected = value(w[1], 10, cos($2 * degree)) }'
data core
agrees "core: relative error at the inflection" '
    $1 == "taylor:2" && $2 > 1 { c = sqrt(($2 - 1) / $2); expected = 100 * abs(value("taylor:2", $2, c) / pow(c, $2) - 1) }'
data ratio --bits=1,8,15.5
agrees "ratio: R of W and of Schlick" '
    { split($1, w, "="); q = w[2]; level = 2 ^ -q; power = acos(2 ^ (-q / $2)) }
    $1 ~ /^taylor:2/ { expected = power / acos(1 - (1 - sqrt(level)) * 2 / $2) }
    $1 ~ /^schlick/ { expected = power / acos($2 / (2 ^ q + $2 - 1)) }'
data widths --exponents=50 --lobes=schlick,energy:2
agrees "widths: R over q" '
    { level = 2 ^ -$2; power = acos(2 ^ (-$2 / 50)) }
    $1 == "schlick" { expected = power / acos(50 / (2 ^ $2 + 49)) }
    $1 == "energy:2" { expected = power / acos(1 - (1 - sqrt(level)) * 3 / 51) }'
data w1-extreme
agrees "w1-extreme: the formula" '
    { n = $2; t = sqrt(2 * n + 1) / n; c = 1 / sqrt(1 + t * t) }
    n > 2 { expected = 100 * (value("energy:2", n, c) / pow(c, n) - 1) }'
data energy
agrees "energy: closed forms" '
    { n = $2 }
    $1 == "energy:2" { expected = 1 }
    $1 == "taylor:2" { expected = (n + 1) * 2 / (3 * n) }
    $1 == "schlick" { expected = (n + 1) * (n * log(n) / (n - 1) - 1) / (n - 1) }'
agrees "energy: order 2 stays within what the page says" '
    $1 !~ /schlick|gx/ { expected = $3; if ($3 < 0.65 || $3 > 1.35) expected = 1e9 }'
data orders
agrees "orders: limits published for the minimax fit, below them everywhere" '
    BEGIN { split("2 .07 4 .0333 8 .0163 16 .0081 32 .004", l, " "); for (i = 1; i < 10; i += 2) limit["minimax:" l[i]] = l[i + 1] }
    { expected = $3 <= limit[$1] ? $3 : limit[$1] }
    $2 == 5000 && $3 < 0.97 * limit[$1] { expected = limit[$1] }'
data cost
agrees "cost: the front is below every lobe to the right of it" '
    BEGIN { wanted = 16 }
    $1 == "front" { x[++f] = $2; y[f] = $3; next }
    { best = 1; for (i = 1; i <= f; ++i) if (x[i] <= $2 && y[i] < best) best = y[i]; expected = max($3, best) }'
agrees "cost: the front is the family and composites" '
    BEGIN { wanted = 7 }
    $1 == "front" && $3 > 0 { y[$3] = 1; next }
    $1 ~ /minimax|affine|composite/ && ($3 in y) { delete y[$3]; expected = $3 }
    $1 == "gaussian" { for (v in y) { expected = -1 } }'
agrees "cost: of one cost affine has the least error" '
    BEGIN { wanted = 5 }
    $1 ~ /^(taylor|energy|minimax):/ { split($1, w, ":"); if (!(w[2] in least) || $3 < least[w[2]]) least[w[2]] = $3 }
    $1 ~ /^affine:/ { split($1, w, ":"); expected = w[2] in least && least[w[2]] < $3 ? -1 : $3 }'
data radius --lobes=taylor:2,power --exponents=10,100
agrees "radius: (1 + S1^2)^1.5 / |S2| of W and of the power" '
    BEGIN { wanted = 250 }
    { split($1, w, "="); n = w[2]; x = $2 * degree; s = sin(x); c = cos(x); u = 1 - n / 2 * (1 - c) }
    $1 ~ /^taylor/ { first = n * s * u; second = n * n / 2 * s * s - n * c * u; if (u < 1e-9) { first = 0; second = 2 * n - 2 } }
    $1 ~ /^power/ { first = n * s * pow(c, n - 1); second = n * (n - 1) * s * s * pow(c, n - 2) - n * pow(c, n) }
    abs(second) > 1e-3 { expected = pow(1 + first * first, 1.5) / abs(second); if (expected > 10) expected = "" }'
check "radius: W's curve ends at its zero" awk -F, '
    $1 == "taylor:2 n=100" { angle = $2; radius = $3 }
    END { d = angle - 11.478340954533572; r = radius * 198 - 1; exit !(d < 1e-8 && d > -1e-8 && r < 1e-8 && r > -1e-8) }' data.csv
data multiplications
agrees "multiplications: with five a composite errs 30 times less than the family, with six 1000 times" '
    BEGIN { wanted = 2 }
    $1 == "affine" { family[$2] = $3 }
    $1 == "composite" && $2 > 4 { bound = family[$2] / ($2 == 5 ? 30 : 1000); expected = $3 < bound ? $3 : -1 }'
data polygon
agrees "polygon: four points suffice from slope 5 on, the closed form fails" '
    $1 == "narrow form 4 points" && $2 > 5 { expected = $3 < 1e-6 ? $3 : -1 }
    $1 == "closed form" && $2 > 25 && $3 != "" { expected = $3 > 1e-3 ? $3 : -1 }'
data rough
agrees "rough: GGX" '
    $1 ~ /^GGX/ { split($1, w, "="); a = w[2] ^ 4; b = (1 / a - 1) / 2; l = 1 - cos($2 * degree); expected = (1 - l) / (1 + b * l) ^ 2 }'
rm -f data.csv disagreements.txt

# ---- Errors ----------------------------------------------------------------------------------------

expect 2 'burnish: plot: "curvs": unknown figure; did you mean curves?' plot curvs
expect 2 'burnish: plot: no FIGURE; try "burnish-lobe plot curves" or "burnish-lobe plot --help"' plot
expect 2 'burnish: --exponents: more than 32 items; leave some out' plot curves --exponents=1-33
expect 2 'burnish: --exponents: the figure core has an axis of exponents; give its two ends, such as 2,1000' \
    plot core --exponents=5
expect 2 'burnish: --exponents: the figure cost is drawn for one exponent' plot cost --exponents=5,6
expect 2 'burnish: --bits: "0" is not a number above 0 up to 64' plot ratio --bits=0
expect 2 'burnish: --size: "9,9" is not a width and a height from 160 to 4096, such as 1024x768, or one number for both' plot curves --size=9,9
expect 2 "burnish: --size: the names in the figure ratio take 400,250 or more" \
    plot ratio --size=200,300
expect 2 'burnish: --output: the figure curves is written as svg, png, csv or gp' plot curves -o curves.pdf
expect 2 'burnish: curves: more than 48 curves; leave out some lobes, exponents or bits' \
    plot curves --exponents=1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17
expect 7 "burnish: none/x.csv: can't be written: No such file or directory; create the folder first" plot curves -o none/x.csv
nothing_left "errors"
# with_gnuplot SCRIPT LINE: with that as gnuplot, or without one for "", plotting ends with that line.
with_gnuplot() {
    mkdir -p "$out.tools"
    if [ -n "$1" ]; then
        printf '#!/bin/sh\n%s\n' "$1" >"$out.tools/gnuplot"
        chmod +x "$out.tools/gnuplot"
    fi
    real=$burnish
    burnish=$out.tools/burnish
    printf '#!/bin/sh\nPATH=%s exec %s "$@"\n' "$out.tools" "$real" >"$burnish"
    chmod +x "$burnish"
    expect 7 "burnish: gnuplot: $2" plot curves
    burnish=$real
    rm -r "$out.tools"
}
with_gnuplot "" "not found, but needed to draw figures; install it (Debian: gnuplot-nox), or take --format=gp and figures.gp to another machine, or --format=csv"
with_gnuplot 'printf "warning\n\n\"x\" line 7: out of luck\n\n" >&2; exit 1' "failed: \"x\" line 7: out of luck; version 5.4 is known to work"
with_gnuplot 'read -r line' "wrote no drawing; version 5.4 is known to work"
nothing_left "a gnuplot that fails"

# ---- Drawings --------------------------------------------------------------------------------------

run plot curves -o kept.csv
cp kept.csv again.csv
check "by the extension: csv" grep -q '^series,angle_deg,value$' kept.csv
check "to standard output: the same" sh -c "'$burnish' plot curves --format=csv | cmp - kept.csv"
run plot curves -o script.gp
check "by the extension: gp" grep -q '^figure = "curves"$' script.gp
cp "$burnish" alone
burnish=./alone expect 7 "burnish: figures.gp: not found beside the program; name the file in BURNISH_FIGURES" plot curves
rm -f alone
check "an output that can't be written is kept as it was" sh -c "chmod 400 kept.csv; '$burnish' plot curves --lobes=foo -o kept.csv; cmp kept.csv again.csv"
rm -f kept.csv again.csv script.gp

if [ "$has_gnuplot" = 1 ]; then
    mkdir one
    for name in energy orders cost radius widths w1-extreme multiplications polygon rough; do
        gives 0 plot "$name" -o "one/$name.svg"
    done
    for file in "$root"/docs/figures/*.svg; do
        name=$(basename "$file")
        gives 0 plot "${name%.*}" -o "one/$name"
        check "lobe/docs/figures/$name is not what the program draws; run make figures" cmp "one/$name" "$file"
        check "lobe/docs/figures/$name is not in lobe/docs/theory.md" grep -q "(figures/$name)" "$root/docs/theory.md"
    done
    for file in one/*.svg; do
        check "$file: no end" sh -c "tail -n 2 '$file' | grep -q '</svg>'"
        check "$file: no forms for light and dark pages" grep -q 'prefers-color-scheme:dark' "$file"
        check "$file: a number that is none" sh -c "! grep -qi '[^a-z]nan[^a-z]' '$file'"
        check "$file: not well-formed" python3 -c 'import sys, xml.dom.minidom as dom; dom.parse(sys.argv[1])' "$file"
    done
    run plot energy -o energy.gp
    check "figures.gp by hand" sh -c "gnuplot -d -c '$root/program/figures.gp' energy.gp | tail -n 2 | grep -q '</svg>'"
    rm energy.gp
    run plot energy -o -
    check "standard output" cmp "$out" one/energy.svg
    # Other lobes and exponents: nothing to draw, long axes, many names; as PNG too.
    for arguments in "core --lobes=power" "error --lobes=power" "cost --lobes=power" "ratio --exponents=1,65536" \
        "ratio --lobes=taylor:2,schlick,minimax:8,gaussian,gx --bits=2,4,8,12" "curves --exponents=1" "energy --size=400,250"; do
        gives 0 plot $arguments -o other.svg
    done
    run plot core --exponents=3,700 -o other.svg
    for end in 3 700; do
        check "an axis of exponents ends without its label $end" grep -q "> *$end</tspan>" other.svg
    done
    run plot curves -o other.png
    check "burnish-lobe plot curves -o other.png: $(cat "$err")" \
        [ "$(png_size other.png)" = "720 440" ]
    rm other.svg other.png
fi
rm -rf one
nothing_left "figures"

# ---- The page --------------------------------------------------------------------------------------

# Rounded numbers in its text.
# says LOBE N METRIC VALUE DIGITS [RANGE]: with that many digits after the point.
says() {
    run table --lobes="$1" --exponents="$2" --metrics="$3" --range="${6:-all}" --format=csv
    check "$3 of $1 at n = $2 is not $4" awk -F, -v said="$4" -v digits="$5" \
        'NR == 2 { exit !(sprintf("%." digits "f", $3) == sprintf("%." digits "f", said)) }' "$out"
    check "lobe/docs/theory.md doesn't say $4" grep -qF "${4#0}" "$root/docs/theory.md"
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

# Every command of the page and of the help screens and the man page.
{
    grep -o '`burnish-lobe plot [^`]*`' "$root/docs/theory.md" | tr -d '`'
    for screen in --help "plot --help" "help --man"; do
        "$burnish" $screen 2>/dev/null | tr -d '\\' | grep -o 'burnish-lobe plot [a-z0-9].*' | sed 's/  .*//; s/fR$//'
    done
} | sort -u | grep -v '^burnish-lobe plot FIGURE' >"$out.commands"
check "no examples" [ "$(wc -l <"$out.commands")" -ge 10 ]
while read -r command; do
    [ "$has_gnuplot" = 1 ] || continue
    check "fails: $command" sh -c "PATH=$(dirname "$burnish"):\$PATH; $command"
done <"$out.commands"
rm -f "$out.commands" ./*

finish || exit 1
[ "$has_gnuplot" = 1 ] || { echo "drawings, no gnuplot"; exit 77; }
