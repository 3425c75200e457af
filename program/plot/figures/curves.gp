# The paper's figures 3 and 6a.
y_title = "value of the lobe" . condition
x_title = "lobe angle {/:Italic γ} in degrees"
names = "key"
low = 0
high = 1
