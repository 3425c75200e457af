#include "render/render_ops.h"

#define OPS burnish_render_ops
#include "simd/isa_table.h"
