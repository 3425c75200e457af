/* The table of environment kernels for the instruction set that BURNISH_VECTOR_... chooses. */
#include "environment/environment_ops.h"
#include "environment/filter_simd.h"

extern const burnish_environment_ops BURNISH_ISA_TABLE(burnish_environment_ops, VECTOR_WORD);
const burnish_environment_ops BURNISH_ISA_TABLE(burnish_environment_ops, VECTOR_WORD) = {
    .filter_environment = filter_environment,
};
