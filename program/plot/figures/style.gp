# What all figures share. Before it stand the numbers (burnish lobe plot NAME --format=gp shows them
# all) and the figure's own settings:
#   panel            its number in the paper, or ""
#   y_title x_title  texts           names    "end": at the lines' ends, "key", "inside"; "rows"
#   x_log y_log      1: logarithmic           guide    a line to read against; guide_text above it
#   low high         of y, in place of those of the data         drawing  in place of the lines

# Inks: text, axis, grid, paper, the power; seven hues for lobes; eight steps for numbers. Hues after
# Okabe and Ito 2008, which people with any colour vision tell apart, darkened for white and lightened
# for dark pages to a contrast of at least 3 to 1; the steps run in lightness, so that their order
# survives in grey. In an SVG burnish replaces each by its dark form where the page is dark.
light = "#2f363f #6a737d #e7eaee #ffffff #1b1f24 #0072b2 #d55e00 #008561 #aa4f8d #a87400 #6f3b00 #767676 #440154 #463480 #365c8d #277f8e #1a8f78 #2f9a50 #6b951c #c77700"
dark = "#c9d1d9 #7d8791 #2a313a #161b22 #f0f3f6 #58a6e8 #f5874a #33c39a #de8fc0 #e3ad3e #d8b48c #a0a7ae #c886e0 #a394f2 #79a8f0 #55bcd0 #45cfa8 #7ad97f #b5d64e #ffb454"
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
if (!exists("x_log")) { x_log = 0 }
if (!exists("y_log")) { y_log = 0 }
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
