/* The one table of lobe words, as theory.h reads it: with the lobes that only it knows. */
#ifndef BURNISH_SHADING_LOBE_WORDS_H
#define BURNISH_SHADING_LOBE_WORDS_H

#include "burnish/shading.h"

/* Whether kernels have the lobe. */
static inline int burnish_lobe_is_drawn(burnish_lobe_kind kind) {
    return (unsigned)kind < BURNISH_LOBE_NV2X;
}

#define BURNISH_LOBE_DRAWN_WORDS                                                                   \
    "use FIT:ORDER with FIT taylor, energy, levelQ (0 < Q < 1), shift7, shift3, projected, "       \
    "minimax, leastsquares, affine or zetaZ and ORDER 2, 4, 8, 16 or 32, or lyon:ORDER, power, "   \
    "schlick, gaussian, gx"

#endif
