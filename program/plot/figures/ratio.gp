# The paper's figure 5.
y_title = "{/:Italic R} = angle of cos^{{/:Italic n}} / angle of the lobe, at 2^{−{/:Italic q}}"
x_title = "specular exponent {/:Italic n}"
x_log = 1
names = "end"
guide = 1
guide_text = "as wide as cos^{{/:Italic n}}"
