# The paper's figure 2.
y_title = "absolute error, |lobe − cos^{{/:Italic n}}{/:Italic γ}|" . condition
x_title = "lobe angle {/:Italic γ} in degrees"
names = "key"
