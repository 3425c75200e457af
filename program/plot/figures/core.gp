# The paper's figure 4.
y_title = "largest relative error in the core, in percent"
x_title = "specular exponent {/:Italic n}"
x_log = 1
names = "end"
