// A spiral stair around a post.
$fn = 48;
cylinder(r = 4, h = 74);
cylinder(r = 30, h = 2);
for (i = [0 : 17]) rotate(20 * i) translate([0, 0, 4 * i + 2]) linear_extrude(2) polygon([[0, -2.5], [28, -6], [28, 6], [0, 2.5]]);
for (i = [0 : 17]) rotate(20 * i) translate([26.5, 0, 4 * i + 3]) cylinder(r = 0.8, h = 13, $fn = 12);
