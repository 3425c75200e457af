y_title = "value, of the peak of GGX (dashed: 3 lobes, dotted: 1)"
x_title = "angle from the mirror direction in degrees"
names = "key"
low = 0
high = 1
