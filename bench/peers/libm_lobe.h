/* The renderer's kernels with libm's powf as cos^n. */
#ifndef BURNISH_BENCH_PEERS_LIBM_LOBE_H
#define BURNISH_BENCH_PEERS_LIBM_LOBE_H

#include "shading/shading_ops.h"

/* Copies batch and replaces its power kernels, for directional lights and a distant viewer, by
 * loops over arrays around one powf per lit point. */
burnish_shading_ops burnish_peers_libm_batch(const burnish_kernels *batch);

/* The same with kernels that shade everything black, to detect whether a renderer calls them. */
burnish_shading_ops burnish_peers_dark_batch(const burnish_kernels *batch);

#endif
