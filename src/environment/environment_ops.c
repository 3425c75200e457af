#include "environment/environment_ops.h"

#define OPS burnish_environment_ops
#include "simd/isa_table.h"
