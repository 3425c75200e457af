// A spur gear with a keyed bore and lightening holes.
$fn = 64;
teeth = 22; radius = 22;
difference() {
    linear_extrude(8) difference() {
        union() {
            circle(radius - 2.2);
            for (i = [0 : teeth - 1]) rotate(360 / teeth * i)
                polygon([[radius - 3, -2.1], [radius - 3, 2.1], [radius, 1.5], [radius + 2, 0.7], [radius + 2, -0.7], [radius, -1.5]]);
        }
        circle(4);
        translate([0, -1.25]) square([6, 2.5]);
        for (i = [0 : 5]) rotate(60 * i) translate([12.5, 0]) circle(3.5);
    }
    translate([0, 0, 6]) difference() { cylinder(r = 18, h = 3); translate([0, 0, -1]) cylinder(r = 7.5, h = 5); }
}
