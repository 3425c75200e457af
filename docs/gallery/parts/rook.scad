// A chess rook with battlements and a stair of rings.
$fn = 72;
difference() {
    rotate_extrude() polygon([[0, 0], [16, 0], [16, 4], [13, 6], [12, 10], [9.5, 16], [9, 34], [10, 38], [13, 40], [13, 50], [0, 50]]);
    translate([0, 0, 43]) cylinder(r = 9.5, h = 10);
    for (i = [0 : 2]) rotate(60 * i) translate([0, 0, 49]) cube([40, 5, 8], center = true);
}
