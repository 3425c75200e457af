// An impeller: a hub, a disc and nine swept blades.
$fn = 96;
cylinder(r = 26, h = 2);
cylinder(r1 = 9, r2 = 5, h = 16);
for (i = [0 : 8]) rotate(40 * i) linear_extrude(12, twist = -25, slices = 16, scale = 0.82)
    polygon(concat([for (t = [0 : 10]) let (a = 5 * t, r = 5 + 2 * t) [r * cos(a), r * sin(a)]],
                   [for (t = [10 : -1 : 0]) let (a = 5 * t + 8 - 0.4 * t, r = 5 + 2 * t) [r * cos(a), r * sin(a)]]));
