// A pipe elbow with bolted flanges.
$fn = 48;
module flange() difference() { cylinder(r = 15, h = 4); for (i = [0 : 5]) rotate(60 * i) translate([12, 0, -1]) cylinder(r = 1.5, h = 6, $fn = 24); }
difference() {
    union() {
        rotate_extrude(angle = 90) translate([24, 0]) circle(8);
        translate([24, 0, 0]) rotate([90, 0, 0]) { cylinder(r = 8, h = 8); translate([0, 0, 6]) flange(); }
        translate([0, 24, 0]) rotate([0, -90, 0]) { cylinder(r = 8, h = 8); translate([0, 0, 6]) flange(); }
    }
    rotate_extrude(angle = 90) translate([24, 0]) circle(6);
    translate([24, 0.01, 0]) rotate([90, 0, 0]) cylinder(r = 6, h = 20);
    translate([0.01, 24, 0]) rotate([0, -90, 0]) cylinder(r = 6, h = 20);
}
