// A block whose edges are chamfered, with a V-groove, a pocket and a blind hole.
$fn = 48;
module chamfered(x, y, z, c) hull() {
    translate([c, c, 0]) cube([x - 2 * c, y - 2 * c, z]);
    translate([c, 0, c]) cube([x - 2 * c, y, z - 2 * c]);
    translate([0, c, c]) cube([x, y - 2 * c, z - 2 * c]);
}
difference() {
    chamfered(60, 36, 22, 3);
    translate([14, 18, 22]) rotate([0, 45, 0]) cube([9, 50, 9], center = true);
    translate([26, 8, 12]) cube([14, 20, 20]);
    translate([50, 18, 8]) { cylinder(d = 9, h = 20); translate([0, 0, 12.5]) cylinder(d1 = 9, d2 = 13, h = 2); }
}
