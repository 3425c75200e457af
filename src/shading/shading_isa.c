/* The table of shading kernels for the instruction set that BURNISH_VECTOR_... chooses. */
#include "shading/each_simd.h"
#include "shading/environment_simd.h"
#include "shading/lobe_simd.h"
#include "shading/mixed_simd.h"
#include "shading/polygon_simd.h"
#include "shading/shade_simd.h"
#include "shading/shading_ops.h"
#include "shading/sheen_simd.h"
#include "simd/isa.h"

#define LOBE_FUNCTIONS(name, body)                                                                 \
    static void name##_of_cosines(const burnish_lobe_constants *lobe, size_t count,                \
                                  const float *in, float *out) {                                   \
        lobe_array(body, 0, lobe, count, in, out);                                                 \
    }                                                                                              \
    static void name##_of_lambdas(const burnish_lobe_constants *lobe, size_t count,                \
                                  const float *in, float *out) {                                   \
        lobe_array(body, 1, lobe, count, in, out);                                                 \
    }

LOBE_FUNCTIONS(none, BURNISH_LOBE_BODY_NONE)
LOBE_FUNCTIONS(square, BURNISH_LOBE_BODY_SQUARE)
LOBE_FUNCTIONS(squares, BURNISH_LOBE_BODY_SQUARES)
LOBE_FUNCTIONS(power, BURNISH_LOBE_BODY_POWER)
LOBE_FUNCTIONS(multiply, BURNISH_LOBE_BODY_MULTIPLY)
LOBE_FUNCTIONS(schlick, BURNISH_LOBE_BODY_SCHLICK)
LOBE_FUNCTIONS(gaussian, BURNISH_LOBE_BODY_GAUSSIAN)
LOBE_FUNCTIONS(gx, BURNISH_LOBE_BODY_GX)
LOBE_FUNCTIONS(composite, BURNISH_LOBE_BODY_COMPOSITE)
#undef LOBE_FUNCTIONS

#define LOBE_ROW(name)                                                                             \
    { name##_of_cosines, name##_of_lambdas }
#define SHADE_ROW(name)                                                                            \
    {                                                                                              \
        {shade_##name##_distant_rgba8, shade_##name##_distant_float}, {                            \
            shade_##name##_general_rgba8, shade_##name##_general_float                             \
        }                                                                                          \
    }
extern const burnish_shading_ops BURNISH_ISA_TABLE(burnish_shading_ops, VECTOR_WORD);
const burnish_shading_ops BURNISH_ISA_TABLE(burnish_shading_ops, VECTOR_WORD) = {
    .isa = (burnish_isa)VECTOR_ISA,
    .lobe = {[BURNISH_LOBE_BODY_NONE] = LOBE_ROW(none),
             [BURNISH_LOBE_BODY_SQUARE] = LOBE_ROW(square),
             [BURNISH_LOBE_BODY_SQUARES] = LOBE_ROW(squares),
             [BURNISH_LOBE_BODY_POWER] = LOBE_ROW(power),
             [BURNISH_LOBE_BODY_MULTIPLY] = LOBE_ROW(multiply),
             [BURNISH_LOBE_BODY_SCHLICK] = LOBE_ROW(schlick),
             [BURNISH_LOBE_BODY_GAUSSIAN] = LOBE_ROW(gaussian),
             [BURNISH_LOBE_BODY_GX] = LOBE_ROW(gx),
             [BURNISH_LOBE_BODY_COMPOSITE] = LOBE_ROW(composite)},
    .shade = {[BURNISH_LOBE_BODY_NONE] = SHADE_ROW(none),
              [BURNISH_LOBE_BODY_SQUARE] = SHADE_ROW(square),
              [BURNISH_LOBE_BODY_SQUARES] = SHADE_ROW(squares),
              [BURNISH_LOBE_BODY_POWER] = SHADE_ROW(power),
              [BURNISH_LOBE_BODY_MULTIPLY] = SHADE_ROW(multiply),
              [BURNISH_LOBE_BODY_SCHLICK] = SHADE_ROW(schlick),
              [BURNISH_LOBE_BODY_GAUSSIAN] = SHADE_ROW(gaussian),
              [BURNISH_LOBE_BODY_GX] = SHADE_ROW(gx),
              [BURNISH_LOBE_BODY_COMPOSITE] = SHADE_ROW(composite)},
    .shade_each = {[BURNISH_LOBE_BODY_NONE] = each_none,
                   [BURNISH_LOBE_BODY_SQUARE] = each_square,
                   [BURNISH_LOBE_BODY_SQUARES] = each_squares,
                   [BURNISH_LOBE_BODY_POWER] = each_power,
                   [BURNISH_LOBE_BODY_MULTIPLY] = each_power,
                   [BURNISH_LOBE_BODY_SCHLICK] = each_schlick,
                   [BURNISH_LOBE_BODY_GAUSSIAN] = each_gaussian,
                   [BURNISH_LOBE_BODY_GX] = each_gx,
                   [BURNISH_LOBE_BODY_COMPOSITE] = each_power},
    .shade_mixed = {[BURNISH_LOBE_BODY_SQUARE] = {mixed_square, mixed_square_alike},
                    [BURNISH_LOBE_BODY_SQUARES] = {mixed_squares, mixed_squares_alike},
                    [BURNISH_LOBE_BODY_COMPOSITE] = {mixed_composite, mixed_composite_alike}},
    .add_environment = add_environment,
    .see_environment = see_environment,
    .reflect_points = reflect_points,
    .lay_sheen = lay_sheen,
    .polygon_light = polygon_light,
    .normalize_array = normalize_array,
};
