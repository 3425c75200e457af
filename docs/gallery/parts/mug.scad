// A mug with a handle.
$fn = 72;
difference() {
    union() {
        rotate_extrude() polygon([[0, 0], [16, 0], [18, 2], [18, 38], [17, 40], [0, 40]]);
        translate([17, 0, 20]) rotate([90, 0, 0]) rotate_extrude(angle = 360, $fn = 48) translate([11, 0]) scale([1, 1.4]) circle(2.2, $fn = 20);
    }
    translate([0, 0, 3]) cylinder(r = 15.5, h = 40);
}
