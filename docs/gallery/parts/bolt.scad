// A bolt: a hexagon head, chamfered, and rings in place of a thread.
$fn = 48;
intersection() { cylinder(r = 10, h = 7, $fn = 6); translate([0, 0, -1]) cylinder(r1 = 8.5, r2 = 15, h = 8); translate([0, 0, 0]) cylinder(r1 = 16, r2 = 8.8, h = 8); }
translate([0, 0, 6.9]) cylinder(d = 8, h = 12);
translate([0, 0, 18]) rotate_extrude() polygon(concat([[0, 0]],
    [for (i = [0 : 13]) each [[4, i * 1.6], [5, i * 1.6 + 0.8]]], [[4, 22.4], [3, 24], [0, 24]]));
