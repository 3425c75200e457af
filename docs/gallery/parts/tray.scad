// A tray of hexagonal cells.
r = 7; wall = 1.4; d = r * sqrt(3);
difference() {
    linear_extrude(14) offset(2) for (i = [0 : 4], j = [0 : 3]) translate([i * d + (j % 2) * d / 2, j * r * 1.5]) rotate(30) circle(r, $fn = 6);
    for (i = [0 : 4], j = [0 : 3]) translate([i * d + (j % 2) * d / 2, j * r * 1.5, 1.5]) rotate(30) cylinder(r = r - wall / 2, h = 14, $fn = 6);
}
