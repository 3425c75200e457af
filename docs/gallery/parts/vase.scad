// A twisted vase with twelve ribs and a hollow.
$fn = 64;
module outline(r) { circle(r); for (i = [0 : 11]) rotate(30 * i) translate([r, 0]) circle(r / 8, $fn = 16); }
difference() {
    linear_extrude(70, twist = 60, slices = 40, scale = 1.35) outline(20);
    translate([0, 0, 3]) linear_extrude(70, twist = 60, slices = 40, scale = 1.35) circle(18);
}
