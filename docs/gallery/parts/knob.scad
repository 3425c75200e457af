// A knurled knob with a pointer.
$fn = 72;
difference() {
    union() { cylinder(r1 = 17, r2 = 16, h = 16); translate([0, 0, 16]) cylinder(r1 = 16, r2 = 13.5, h = 2.5); }
    for (i = [0 : 35]) rotate(10 * i) translate([17.4, 0, 3]) cylinder(r = 1.2, h = 20, $fn = 12);
    translate([0, -0.8, 17.5]) cube([20, 1.6, 5]);
    translate([0, 0, -1]) cylinder(d = 6, h = 12);
}
cylinder(r = 19, h = 2.5);
