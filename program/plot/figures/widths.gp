y_title = "{/:Italic R} = angle of cos^{{/:Italic n}} / angle of the lobe" . condition
x_title = "threshold {/:Italic q} in bits: the lobe ends at 2^{−{/:Italic q}}"
names = "end"
guide = 1
guide_text = "as wide as cos^{{/:Italic n}}"
