y_title = "{/:Italic R} = angle of the power / angle of the lobe" . condition
x_title = "threshold {/:Italic q} in bits: the lobe ends at 2^{−{/:Italic q}}"
names = "end"
guide = 1
guide_text = "as wide as the power"
