/* Which functions an instruction set has. */
#include "raster/tier.h"

const burnish_raster_tier *burnish_raster_tier_of(burnish_isa isa) {
    switch (isa) {
#if defined(__SSE2__)
    case BURNISH_ISA_SSE2:
        return &burnish_raster_sse2;
    case BURNISH_ISA_AVX2:
        return &burnish_raster_avx2;
    case BURNISH_ISA_AVX512:
        return &burnish_raster_avx512;
#endif
#if defined(__aarch64__)
    case BURNISH_ISA_NEON:
        return &burnish_raster_neon;
#endif
    default:
        return &burnish_raster_scalar;
    }
}
