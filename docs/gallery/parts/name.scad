// A name plate whose letters are strokes of a round pen.
$fn = 24;
pen = 1.7;
module stroke(points) for (i = [0 : len(points) - 2]) hull() { translate(points[i]) circle(pen); translate(points[i + 1]) circle(pen); }
function arc(x, y, r, from, to) = [for (i = [0 : 12]) [x + r * cos(from + (to - from) * i / 12), y + r * sin(from + (to - from) * i / 12)]];
linear_extrude(3) offset(4) square([78, 18]);
translate([0, 0, 2.9]) linear_extrude(2.6) {
    translate([4, 2]) { stroke([[0, 16], [0, 0]]); stroke(arc(4.5, 4.5, 4.5, 0, 360)); }
    translate([17, 2]) { stroke(concat([[0, 9]], arc(4.5, 4.5, 4.5, 180, 360), [[9, 9]])); stroke([[9, 4.5], [9, 0]]); }
    translate([31, 2]) { stroke([[0, 0], [0, 9]]); stroke(arc(4.5, 4.5, 4.5, 180, 70)); }
    translate([40, 2]) { stroke([[0, 0], [0, 9]]); stroke(concat(arc(4, 5, 4, 180, 0), [[8, 0]])); }
    translate([53, 2]) { stroke([[0, 0], [0, 9]]); stroke([[0, 13.5], [0, 13.6]]); }
    translate([57.5, 2]) stroke(concat([[6, 8]], arc(3, 6.8, 2.2, 60, 270), arc(3, 2.2, 2.4, 90, -120)));
    translate([68, 2]) { stroke([[0, 0], [0, 16]]); stroke(concat(arc(4, 5, 4, 180, 0), [[8, 0]])); }
}
