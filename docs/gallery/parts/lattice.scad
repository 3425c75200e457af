// A lattice of bars: 3 x 3 x 3 cells.
cell = 12; n = 3; bar = 2.4;
for (i = [0 : n], j = [0 : n]) {
    translate([i * cell, j * cell, -bar / 2]) translate([-bar / 2, -bar / 2, 0]) cube([bar, bar, n * cell + bar]);
    translate([i * cell - bar / 2, -bar / 2, j * cell - bar / 2]) cube([bar, n * cell + bar, bar]);
    translate([-bar / 2, i * cell - bar / 2, j * cell - bar / 2]) cube([n * cell + bar, bar, bar]);
}
