# Draws one figure from the rows that draw has written.
figure = ARG1
rows(lobe, n) = sprintf("< grep -E '^%s,%s(:2)?,' %s/%s", n, lobe, ARG2, figure)
power = "cos^{/:Italic n}"
paper(lobe) = lobe eq "power" ? power : lobe eq "schlick" ? "Schlick" : lobe eq "energy:8" ? lobe : "{/:Italic W}" . (lobe eq "energy" ? "_1" : lobe eq "shift7" ? "_{0.5}" : "")
color(lobe) = lobe eq "power" ? "#1b1f24" : lobe eq "schlick" ? "#d55e00" : lobe eq "energy:8" ? "#aa4f8d" : lobe eq "energy" ? "#008561" : lobe eq "shift7" ? "#6f3b00" : "#0072b2"
set terminal svg size 720,440 enhanced font "DejaVu Sans,13" rounded background "#ffffff"
set encoding utf8
set datafile separator ","
set border 3
set tics nomirror
set grid ytics linecolor "#e7eaee"
set key Left reverse outside right top samplen 2
set style data lines
set yrange [0:*]
any = "[^,]*"
set xlabel "lobe angle {/:Italic γ} in degrees"
if (figure eq "error") {
    set ylabel "absolute error, |{/:Italic W} − " . power . "{/:Italic γ}|"
    plot for [n in "3 10 30 100 300 1000"] rows("taylor", n) using 3:(abs($4 - cos($3 * pi / 180)**$1)) linewidth 2 title "{/:Italic n} = " . n
}
if (figure eq "curves" || figure eq "w1" || figure eq "lobes") {
    set ylabel "value of the lobe, {/:Italic n} = " . (figure eq "w1" ? "10" : figure eq "curves" ? "100" : "64")
    lobes = figure eq "w1" ? "power energy" : figure eq "curves" ? "power taylor schlick" : "power energy energy:8 schlick"
    plot for [lobe in lobes] rows(lobe, any) using 3:4 linewidth 2 linecolor rgb color(lobe) title paper(lobe)
}
if (figure eq "core" || figure eq "ratio") {
    set xlabel "specular exponent {/:Italic n}"
    set logscale x
    set xrange [2:1000]
    set xtics add (2)
    if (figure eq "core") {
        set ylabel "largest relative error in the core, in percent"
        plot for [lobe in "taylor shift7 schlick"] rows(lobe, any) using 1:3 linewidth 2 linecolor rgb color(lobe) title paper(lobe)
    } else {
        set ylabel "{/:Italic R} = angle of " . power . " / angle of the lobe, at 2^{−{/:Italic q}}"
        plot for [lobe in "taylor schlick"] for [i = 1:4] rows(lobe, any) using 1:(column(i + 2)) linewidth 2 linecolor rgb color(lobe) dashtype i title paper(lobe) . ", {/:Italic q} = " . word("2 4 8 12", i)
    }
}
