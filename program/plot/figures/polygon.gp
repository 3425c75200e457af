y_title = "largest error, of the whole lobe" . condition
x_title = "slope {/:Italic ζ}"
x_log = 1
y_log = 1
names = "key"
low = 1e-7
high = 1
