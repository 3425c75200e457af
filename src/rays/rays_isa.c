/* The table of ray kernels for the instruction set that BURNISH_VECTOR_... chooses. */
#include "rays/rays.h"
#include "rays/rays_simd.h"

extern const burnish_ray_ops BURNISH_ISA_TABLE(burnish_ray_ops, VECTOR_WORD);
const burnish_ray_ops BURNISH_ISA_TABLE(burnish_ray_ops, VECTOR_WORD) = {.find_hits = find_hits};
