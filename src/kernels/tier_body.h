/* One tier: defined BURNISH_VECTOR_... chooses the vector type, BATCH names the table, ISA the
 * tier. */
#include "kernels/lobe_body.h"
/* needs the vector type */
#include "kernels/encode_body.h"
#include "kernels/normalize_body.h"
#include "kernels/shade_body.h"

#define LOBE_ROW(name)                                                                             \
    { name##_of_cosines, name##_of_lambdas }
#define SHADE_ROW(name)                                                                            \
    {                                                                                              \
        {shade_##name##_distant_rgba8, shade_##name##_distant_float}, {                            \
            shade_##name##_general_rgba8, shade_##name##_general_float                             \
        }                                                                                          \
    }

const struct burnish_batch BATCH = {
    .isa = ISA,
    .lobe = {[BURNISH_LOBE_BODY_NONE] = LOBE_ROW(none),
             [BURNISH_LOBE_BODY_SQUARE] = LOBE_ROW(square),
             [BURNISH_LOBE_BODY_SQUARES] = LOBE_ROW(squares),
             [BURNISH_LOBE_BODY_POWER] = LOBE_ROW(power),
             [BURNISH_LOBE_BODY_MULTIPLY] = LOBE_ROW(multiply),
             [BURNISH_LOBE_BODY_SCHLICK] = LOBE_ROW(schlick),
             [BURNISH_LOBE_BODY_GAUSSIAN] = LOBE_ROW(gaussian),
             [BURNISH_LOBE_BODY_GX] = LOBE_ROW(gx)},
    .normalize = normalize_array,
    .encode = encode_pixels,
    .shade = {[BURNISH_LOBE_BODY_NONE] = SHADE_ROW(none),
              [BURNISH_LOBE_BODY_SQUARE] = SHADE_ROW(square),
              [BURNISH_LOBE_BODY_SQUARES] = SHADE_ROW(squares),
              [BURNISH_LOBE_BODY_POWER] = SHADE_ROW(power),
              [BURNISH_LOBE_BODY_MULTIPLY] = SHADE_ROW(multiply),
              [BURNISH_LOBE_BODY_SCHLICK] = SHADE_ROW(schlick),
              [BURNISH_LOBE_BODY_GAUSSIAN] = SHADE_ROW(gaussian),
              [BURNISH_LOBE_BODY_GX] = SHADE_ROW(gx)},
};
