# A row per lobe, the cheapest of each kind first; no lobe down to a row lies left of the stairs there.
y_title = "cost of one value, and lobe"
x_title = "largest absolute error, angles from 0° to 90°" . condition
names = "rows"
x_log = 1
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
