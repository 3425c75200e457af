// A plate with a boss, a slot and countersunk corners.
$fn = 64;
difference() {
    union() { linear_extrude(6) offset(6) square([58, 38], center = true); translate([-12, 0, 0]) cylinder(d = 24, h = 14); }
    translate([-12, 0, -1]) cylinder(d = 14, h = 20);
    translate([18, 0, -1]) hull() for (y = [-9, 9]) translate([0, y, 0]) cylinder(d = 7, h = 8);
    for (x = [-28, 28], y = [-18, 18]) translate([x, y, -1]) { cylinder(d = 4, h = 9); translate([0, 0, 4.5]) cylinder(d1 = 4, d2 = 9, h = 2.6); }
}
