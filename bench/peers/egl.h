/* OpenGL ES without a window, for the benchmark of frames. */
#ifndef BURNISH_BENCH_PEERS_EGL_H
#define BURNISH_BENCH_PEERS_EGL_H

/* Opens a context of that version: on Mesa's platform without a window, else on the first device.
 * Returns NULL, or what is missing. */
const char *burnish_peers_open_gl(int major, int minor);

/* Destroys it, if there is one. */
void burnish_peers_close_gl(void);

#endif
