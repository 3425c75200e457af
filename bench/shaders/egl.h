/* OpenGL ES without a window, for the benchmarks. */
#ifndef BURNISH_BENCH_EGL_H
#define BURNISH_BENCH_EGL_H

/* Opens a context of that version: on Mesa's platform without a window, else on the first device.
 * Returns NULL, or what is missing. */
const char *burnish_bench_open_gl(int major, int minor);

/* Whether the open context draws on the processor. */
int burnish_bench_draws_on_processor(void);

/* Destroys it, if there is one. */
void burnish_bench_close_gl(void);

#endif
