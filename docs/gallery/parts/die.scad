// A die: a rounded cube with pips.
$fn = 48;
module pips(n) for (p = [[], [[0, 0]], [[-1, -1], [1, 1]], [[-1, -1], [0, 0], [1, 1]], [[-1, -1], [-1, 1], [1, -1], [1, 1]],
    [[-1, -1], [-1, 1], [0, 0], [1, -1], [1, 1]], [[-1, -1], [-1, 0], [-1, 1], [1, -1], [1, 0], [1, 1]]][n])
    translate([5 * p[0], 5 * p[1], 10.6]) sphere(2.1, $fn = 16);
difference() {
    intersection() { cube(20, center = true); sphere(14); }
    pips(1); rotate([180, 0, 0]) pips(6);
    rotate([90, 0, 0]) pips(2); rotate([-90, 0, 0]) pips(5);
    rotate([0, 90, 0]) pips(3); rotate([0, -90, 0]) pips(4);
}
