// A hinge, half open: two leaves and five knuckles on a pin.
$fn = 48;
module leaf(first) {
    difference() {
        translate([0, 0, -2]) linear_extrude(2) difference() {
            union() { translate([0, -25]) square([26, 50]); }
            for (y = [-15, 0, 15]) translate([17, y]) circle(2.4);
        }
        for (i = [0 : 4]) if (i % 2 != first) translate([-1, -25.2 + 10 * i, -5]) cube([5.2, 10.4, 10]);
    }
    for (i = [0 : 4]) if (i % 2 == first) translate([0, -24.8 + 10 * i, 0]) rotate([-90, 0, 0]) cylinder(r = 4, h = 9.6);
}
leaf(0);
rotate([0, 230, 0]) mirror([0, 0, 1]) leaf(1);
translate([0, -27, 0]) rotate([-90, 0, 0]) cylinder(r = 2, h = 54);
