// A box and its lid beside it.
$fn = 32;
module rounded(x, y, z, r) linear_extrude(z) offset(r) square([x - 2 * r, y - 2 * r], center = true);
difference() { rounded(50, 34, 24, 5); translate([0, 0, 2]) rounded(46, 30, 24, 3); }
translate([62, 10, 0]) { rounded(50, 34, 3, 5); rounded(45.6, 29.6, 6, 3); translate([0, 0, 5.9]) rounded(20, 6, 4, 2); }
