// A wheel: a tyre, a rim, five spokes.
$fn = 96;
rotate_extrude() translate([26, 0]) difference() { offset(2, $fn = 24) square([6, 9], center = true); translate([-5, 0]) square([4, 6], center = true); }
translate([0, 0, -2]) difference() {
    union() {
        cylinder(r = 6, h = 5);
        for (i = [0 : 4]) rotate(72 * i) linear_extrude(4) hull() { translate([5, 0]) square([0.1, 7], center = true); translate([23.5, 0]) square([0.1, 11], center = true); }
    }
    for (i = [0 : 4]) rotate(72 * i) translate([0, 0, -1]) linear_extrude(7) hull() { translate([12, 0]) circle(1.2, $fn = 24); translate([19, 0]) circle(2.6, $fn = 24); }
    translate([0, 0, -1]) cylinder(r = 2.5, h = 8);
}
