y_title = "radius of curvature, in radians" . condition
x_title = "lobe angle {/:Italic γ} in degrees"
x_log = 1
y_log = 1
names = "key"
low = 2e-4
high = 20

# A dot where a lobe ends.
array ends[lines]
do for [i = 1:lines] {
    stats $data index i - 1 using 1:2 nooutput
    ends[i] = STATS_max_x < 0.999 * x_high ? STATS_records : 0
}
drawing = 'plot for [i = 1:lines] $data index i - 1 using 1:2 with lines linewidth 2 dashtype dash[i] linecolor rgb ink(color[i]) title text[i], for [i = 1:lines] $data index i - 1 using 1:(int($0) == ends[i] - 1 ? $2 : NaN) with points pointtype 7 pointsize 0.6 linecolor rgb ink(color[i]) notitle'
