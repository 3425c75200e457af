y_title = "integral over the hemisphere / that of cos^{{/:Italic n}}"
x_title = "specular exponent {/:Italic n}"
x_log = 1
y_log = 1
names = "end"
guide = 1
guide_text = ""
