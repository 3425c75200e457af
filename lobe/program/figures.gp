# Draws the figures of lobe/docs/theory.md:
#   burnish-lobe plot curves -o curves.gp              the numbers, which this file loads
#   gnuplot -c figures.gp curves.gp >curves.svg
# burnish-lobe plot does the same and adds colours for dark pages. To use a changed copy of this file, name it
# in BURNISH_FIGURES.
load ARG1

# ---- Each figure -----------------------------------------------------------------------------------
#   names        of the lines: "end": at their ends, "key", "inside"; "rows"
#   x_log y_log  1: logarithmic
#   guide        a line to read against; guide_text above it
#   low high     of y, in place of those of the data
#   drawing      in place of the lines
is(list) = strstrt(" " . list . " ", " " . figure . " ") > 0
power = "cos^{{/:Italic n}}"
names = is("cost") ? "rows" : is("w1-extreme") ? "inside" : is("curves error polygon radius rough w1") ? "key" : "end"
x_log = is("core cost energy orders polygon radius ratio w1-extreme")
y_log = is("energy multiplications orders polygon radius")
x_title = is("curves error radius w1") ? "lobe angle {/:Italic γ} in degrees" : "specular exponent {/:Italic n}"

if (is("error")) { y_title = "absolute error, |lobe − " . power . "{/:Italic γ}|" . condition }
if (is("core")) { y_title = "largest relative error in the core, in percent" }
if (is("curves w1")) { y_title = "value of the lobe" . condition }
if (is("curves w1 rough")) {
    low = 0
    high = 1
}
if (is("ratio")) { y_title = "{/:Italic R} = angle of " . power . " / angle of the lobe, at 2^{−{/:Italic q}}" }
if (is("widths")) {
    y_title = "{/:Italic R} = angle of " . power . " / angle of the lobe" . condition
    x_title = "threshold {/:Italic q} in bits: the lobe ends at 2^{−{/:Italic q}}"
}
if (is("energy")) { y_title = "integral over the hemisphere / that of " . power }
if (is("energy ratio widths")) {
    guide = 1
    guide_text = is("energy") ? "" : "as wide as " . power
}
# Lines by formula, points by search.
if (is("w1-extreme")) {
    y_title = "extreme relative error, in percent"
    half = lines / 2
    drawing = 'plot for [i = 1:half] $data index i - 1 using 1:2 with lines linewidth 2 linecolor rgb ink(color[i]) title text[i], for [i = half + 1:lines] $data index i - 1 using 1:2 with points pointtype 6 pointsize 0.7 linewidth 1.4 linecolor rgb ink(color[i]) title text[i]'
}
if (is("orders")) {
    y_title = "largest absolute error, angles from 0° to 90°"
    low = 5e-4
    high = 0.1
    guide = 1.0 / 510
    guide_text = "half a step of 8 bits"
}
if (is("multiplications")) {
    y_title = "largest absolute error, angles from 0° to 90°" . condition
    x_title = "multiplications"
    set xtics 1
    guide = 1.0 / 510
    guide_text = "half a step of 8 bits"
    drawing = 'plot for [i = 1:lines] $data index i - 1 using 1:2 with linespoints linewidth 2 pointtype 7 pointsize 0.6 linecolor rgb ink(color[i]) notitle'
}
# A dot where a lobe ends.
if (is("radius")) {
    y_title = "radius of curvature, in radians" . condition
    low = 2e-4
    high = 20
    array ends[lines]
    do for [i = 1:lines] {
        stats $data index i - 1 using 1:2 nooutput
        ends[i] = STATS_max_x < 0.999 * x_high ? STATS_records : 0
    }
    drawing = 'plot for [i = 1:lines] $data index i - 1 using 1:2 with lines linewidth 2 dashtype dash[i] linecolor rgb ink(color[i]) title text[i], for [i = 1:lines] $data index i - 1 using 1:(int($0) == ends[i] - 1 ? $2 : NaN) with points pointtype 7 pointsize 0.6 linecolor rgb ink(color[i]) notitle'
}
if (is("polygon")) {
    y_title = "largest error, of the whole lobe" . condition
    x_title = "slope {/:Italic ζ}"
    low = 1e-7
    high = 1
}
if (is("rough")) {
    y_title = "value, of the peak of GGX (dashed: 3 lobes, dotted: 1)"
    x_title = "angle from the mirror direction in degrees"
}
# A row per lobe, the cheapest of each kind first; no lobe down to a row lies left of the stairs there.
if (is("cost")) {
    y_title = "cost of one value, and lobe"
    x_title = "largest absolute error, angles from 0° to 90°" . condition
    set ytics ()
    do for [i = 2:lines] {
        if (dash[i] == 5) {
            set label "" . text[i] at screen 22.0 / width, first i - 1 left textcolor rgb "#6a737d"
            letters[i] = 0
        } else {
            set ytics add ("" . text[i] i - 1)
        }
        if (dash[i] == 4) { set label "no error" at graph 0.01, first i - 1 left textcolor rgb "#d55e00" }
    }
    drawing = 'plot $data index 0 using 2:1 with lines linewidth 1 linecolor rgb ink(2) notitle, for [i = 2:lines] $data index i - 1 using (dash[i] == 2 ? $2 : NaN):1 with points pointtype 7 pointsize 0.7 linecolor rgb ink(color[i]) notitle, for [i = 2:lines] $data index i - 1 using (dash[i] == 3 ? $2 : NaN):1 with points pointtype 6 pointsize 0.7 linewidth 1.4 linecolor rgb ink(color[i]) notitle'
}

# ---- What all figures share ------------------------------------------------------------------------

ink(i) = word(light, i)

if (format eq "png") {
    set terminal pngcairo size width,height enhanced font "DejaVu Sans,10" rounded dashlength 1 background ink(4)
} else {
    set terminal svg size width,height enhanced font "DejaVu Sans,13" name id rounded dashlength 1 background ink(4)
}
set encoding utf8
set datafile missing "NaN"
set dashtype 1 solid
set dashtype 2 (9,6)
set dashtype 3 (9,5,1,5)
set dashtype 4 (1,5)
set dashtype 5 (9,4,1,4,1,4)
set dashtype 6 (4,4)

# Ranges: 1, 2, 5 times a power of ten on logarithmic axes, whole steps on others.
decade(x) = 10**floor(log10(x) + 1e-9)
up(x) = x <= decade(x) * 1.0001 ? decade(x) : x <= 2.0001 * decade(x) ? 2 * decade(x) : x <= 5.0001 * decade(x) ? 5 * decade(x) : 10 * decade(x)
down(x) = x >= 4.9999 * decade(x) ? 5 * decade(x) : x >= 1.9999 * decade(x) ? 2 * decade(x) : decade(x)
larger(a, b) = a > b ? a : b
if (names eq "rows") {
    low = x_high + 0.5 # rows are numbered downward
    high = 0.5
    x_low = down(y_low)
    x_high = up(1.08 * y_high)
}
if (!exists("high")) {
    if (y_log) {
        low = down(larger(y_low, y_high * 1e-6))
        high = up(1.08 * y_high)
    } else {
        step = up(larger(y_high - (y_low < 0 ? y_low : 0), 1e-9) / 7.0)
        low = y_low < 0 ? floor(y_low / step) * step : 0
        high = ceil(y_high / step - 1e-6) * step
        set ytics step
    }
}
# Lines at 0 stay clear of the axis.
if (!y_log && names ne "rows" && low == 0 && y_low < 0.005 * high) { low = -0.015 * high }
set xrange [x_low:x_high]
set yrange [low:high]
if (x_log) { set logscale x }
if (y_log) { set logscale y }

# Labels at 1, 2, 5, on long axes at 1; small marks between.
do for [axis = 1:2] {
    if (axis == 1 ? x_log : y_log) {
        if (axis == 1) { set xtics () } else { set ytics () }
        long = log10(axis == 1 ? 1.0 * x_high / x_low : 1.0 * high / low) > 3.6
        do for [power = -6:5] {
            do for [digit = 1:9] {
                at = digit * 10.0**power
                level = digit == 1 || (!long && (digit == 2 || digit == 5)) ? 0 : 1
                label = level ? "" : axis == 2 && low < 1e-4 ? sprintf("10^{%d}", power) : sprintf("%.6g", at)
                if (axis == 1 && at > 0.999 * x_low && at < 1.001 * x_high) { set xtics add (label at level) }
                if (axis == 2 && level == 0 && at > 0.999 * low && at < 1.001 * high) { set ytics add (label at level) }
            }
        }
        # The ends of an axis of exponents, where no other label is near.
        if (axis == 1 && names ne "rows") {
            do for [end = 1:2] {
                at = end == 1 ? x_low : x_high
                far = 1
                do for [power = -6:5] {
                    do for [digit in (long ? "1" : "1 2 5")] {
                        label = digit * 10.0**power
                        if (label > 0.999 * x_low && label < 1.001 * x_high && abs(log10(label / at)) < 0.05 * log10(1.0 * x_high / x_low)) { far = 0 }
                    }
                }
                if (far) { set xtics add (sprintf("%.6g", at) at) }
            }
        }
    }
}

# Margins and frame: a line below, faint lines across.
longest = 0
do for [i = 1:lines] { longest = larger(longest, letters[i]) }
set lmargin at screen (names eq "rows" ? 34 + 7.6 * longest : 82.0) / width
set bmargin at screen 66.0 / height
set tmargin at screen 1 - (names eq "rows" ? 48.0 : 34.0) / height
set rmargin at screen 1 - (names eq "end" ? 42 + 8 * longest : names eq "key" ? 76 + 8 * longest : 26.0) / width
set border 1 linecolor rgb ink(2) linewidth 1
set tics nomirror out scale 0.6,0.3 textcolor rgb ink(1)
if (names eq "rows") { set grid xtics linecolor rgb ink(3) linewidth 1 linetype 1 }
if (names ne "rows") { set grid ytics linecolor rgb ink(3) linewidth 1 linetype 1 }
set ytics scale 0
set xlabel x_title offset 0, 0.4 textcolor rgb ink(1)
if (names eq "rows") { set label y_title at screen 22.0 / width, screen 1 - 24.0 / height textcolor rgb ink(1) }
if (names ne "rows") { set label y_title at screen 18.0 / width, graph 0.5 center rotate textcolor rgb ink(1) }
if (panel ne "") { set label "{/:Bold " . panel . "}" at screen 22.0 / width, screen 1 - 20.0 / height textcolor rgb ink(1) }
if (exists("guide")) {
    set arrow from graph 0, first guide to graph 1, first guide nohead linewidth 1 dashtype (4,4) linecolor rgb ink(2) back
    set label guide_text at graph 0.99, first guide right offset 0, 0.6 textcolor rgb ink(1)
}
set key Left reverse samplen 2.2 spacing 1.3 textcolor rgb ink(1)
if (names eq "end") { unset key }
if (names eq "key") { set key at screen 1 - (66 + 8.0 * longest) / width, screen 1 - 40.0 / height left top }
if (names eq "inside") { set key at graph 1, 0.03 right bottom }

# Names at the right ends of the lines, in their order, each at least a line of text above the one below:
# neighbours that are nearer move apart by half of what is missing, again and again. (A label's text
# begins with "" . because gnuplot takes text[i] for a number.)
share(y) = y_log ? log(larger(y, low) / low) / log(1.0 * high / low) : (y - low) / (high - low)
gap = 17.0 / (height - 100)
array order[lines]
array height_of[lines]
if (names eq "end") {
    do for [i = 1:lines] {
        rank = 1
        do for [k = 1:lines] {
            if (end_y[k] < end_y[i] || (end_y[k] == end_y[i] && k < i)) { rank = rank + 1 }
        }
        order[rank] = i
        height_of[i] = share(end_y[i])
    }
    do for [pass = 1:200] {
        do for [k = 2:lines] {
            near = gap - (height_of[order[k]] - height_of[order[k - 1]])
            if (near > 0) {
                height_of[order[k]] = height_of[order[k]] + near / 2
                height_of[order[k - 1]] = height_of[order[k - 1]] - near / 2
            }
        }
        if (height_of[order[1]] < 0) { height_of[order[1]] = 0 }
    }
    do for [i = 1:lines] {
        set label "" . text[i] at graph 1, graph height_of[i] left offset 2.6, 0 textcolor rgb ink(color[i])
        set arrow from graph 1, first larger(end_y[i], low) to graph 1 + 14.0 / (width - 124 - 8 * longest), graph height_of[i] nohead linewidth 0.7 linecolor rgb ink(color[i])
    }
}

# On a logarithmic axis a line that begins at 0 comes from below.
from_below(y) = y_log && y < 0.1 * low ? 0.1 * low : y
if (!exists("drawing")) {
    drawing = 'plot for [i = 1:lines] $data index i - 1 using 1:(from_below($2)) with lines linewidth 2 dashtype dash[i] linecolor rgb ink(color[i]) title text[i]'
}
eval drawing
