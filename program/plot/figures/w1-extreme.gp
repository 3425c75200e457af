# The paper's figure 6b: lines by formula, points by search.
y_title = "extreme relative error, in percent"
x_title = "specular exponent {/:Italic n}"
x_log = 1
names = "inside"
half = lines / 2
drawing = 'plot for [i = 1:half] $data index i - 1 using 1:2 with lines linewidth 2 linecolor rgb ink(color[i]) title text[i], for [i = half + 1:lines] $data index i - 1 using 1:2 with points pointtype 6 pointsize 0.7 linewidth 1.4 linecolor rgb ink(color[i]) title text[i]'
