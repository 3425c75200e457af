# The paper's figure 5.
y_title = "{/:Italic R} = angle of the power / angle of the lobe, both at level 2^{−{/:Italic q}}"
x_title = "specular exponent {/:Italic n}"
x_log = 1
names = "end"
guide = 1
guide_text = "as wide as the power"
