// An angle bracket: two plates, a rib, four holes, rounded ends.
$fn = 48;
module plate() difference() {
    hull() { translate([0, -20, 0]) cube([2, 40, 5]); for (y = [-12, 12]) translate([40, y, 0]) cylinder(r = 8, h = 5); }
    for (y = [-11, 11]) translate([36, y, -1]) { cylinder(d = 6, h = 7); translate([0, 0, 4]) cylinder(d1 = 6, d2 = 10, h = 2.01); }
}
plate();
translate([5, 0, 0]) rotate([0, -90, 0]) plate();
rotate([90, 0, 0]) translate([0, 0, -2.5]) linear_extrude(5) polygon([[4, 4], [26, 4], [4, 26]]);
