y_title = "value relative to GGX at its peak; dashed: three lobes, dotted: one"
x_title = "angle from the mirror direction in degrees"
names = "key"
low = 0
high = 1
