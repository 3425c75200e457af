// A heat sink: thin fins on a base.
difference() {
    cube([50, 40, 24]);
    for (i = [0 : 9]) translate([2 + 4.8 * i, -1, 4]) cube([3, 42, 30]);
    translate([-1, 16, 8]) cube([52, 8, 30]);
}
