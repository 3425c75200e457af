/* From normals straight to sRGB codes: directional lights, a distant viewer, lobes of the family.
 *
 * The pixels of a flat face mostly have one code, though not one colour: in perspective a normal is
 * interpolated times 1/w, and rounding gives it other directions. Normals that point the way of an
 * earlier one get its code at once, where the least and the greatest cosines that they can have
 * lead to that code:
 *   sine of the angle: at most sqrt(3) (2^-18 + 2^-23), by the test's limit and its rounding
 *   rounding of the direction and of all cosines: less than 2^-20
 * which together is little more than half of CODE_MARGIN. From the cosines on, all operations are
 * monotonic with their rounding: sums, products with numbers >= 0, and the code of a float. So
 * every cosine in between has the same code. */
#ifndef BURNISH_RENDER_FRAME_CODES_SIMD_H
#define BURNISH_RENDER_FRAME_CODES_SIMD_H

#include "raster/tile.h"
#include "render/frame/pixels_simd.h"
#include "shading/shade_simd.h"

/* Bounds of a cosine with a vector: so far from it, times the sum of the vector's magnitudes. */
#define CODE_MARGIN 0x1p-16f
#define CODE_LIMIT 0x1p-18f

/* What is known of a direction. */
enum {
    CODE_UNKNOWN, /* nothing yet */
    CODE_SPLIT,   /* the bounds have several codes */
    CODE_ONE      /* all normals that point there have its code */
};

typedef struct code_of_direction {
    int state;
    float direction[3]; /* of any length; 0: no normal points there */
    int32_t code;
} code_of_direction;

/* Whether the normals of the lanes `shown` point that way. */
BURNISH_INLINE int points_there(const code_of_direction *known, const vf n[3], vm shown) {
    const vf d[3] = {vf_set(known->direction[0]), vf_set(known->direction[1]),
                     vf_set(known->direction[2])};
    const vf limit = vf_mul(shade_dot(n, d), vf_set(CODE_LIMIT));
    for (int k = 0; k < 3; ++k) { /* most others fail at once */
        const int a = k == 2 ? 0 : k + 1, b = k == 0 ? 2 : k - 1;
        const vf cross = vf_sub(vf_mul(n[a], d[b]), vf_mul(n[b], d[a]));
        const vf size = vf_from_bits(vi_and(vf_bits(cross), vi_set(INT32_MAX)));
        if (vm_any(vm_and_not(shown, vf_greater(limit, size)))) {
            return 0;
        }
    }
    return 1;
}

/* Bounds of the cosine of a unit vector with another vector; side: -1 for the least, 1 for the
 * greatest. */
BURNISH_INLINE vf bound_cosine(const float unit[3], const float vector[3], vf side) {
    float cosine = 0, size = 0;
    for (int k = 0; k < 3; ++k) {
        cosine += unit[k] * vector[k];
        size += __builtin_fabsf(vector[k]);
    }
    return vf_add(vf_set(cosine), vf_mul(side, vf_set(size * CODE_MARGIN)));
}

/* Whether all channels have the same constants, and so the same light. */
static int is_grey(const burnish_kernels_shader *shader) {
    enum { OUTPUT = BURNISH_SHADE_FLOAT };
    int different = 0;
    for (int k = 1; k < 3; ++k) {
        different |= shader->ambient[OUTPUT][k] != shader->ambient[OUTPUT][0];
        for (int l = 0; l < shader->light_count; ++l) {
            const float *diffuse = shader->lights[l].diffuse[OUTPUT];
            const float *specular = shader->lights[l].specular[OUTPUT];
            different |= diffuse[k] != diffuse[0] || specular[k] != specular[0];
        }
    }
    return !different;
}

BURNISH_INLINE vi encode_channels(const burnish_srgb_encoder *encoder, int channels,
                                  const vf light[3]) {
    if (channels == 1) {
        const vi code = encode_vector(encoder, light[0]);
        return vi_or(vi_or(code, vi_shl(code, 8)), vi_shl(code, 16));
    }
    return encode_light(encoder, light);
}

/* Finds the code of a direction, if it has one. */
BURNISH_INLINE void find_code(int body, int channels, const burnish_kernels_shader *shader,
                              const burnish_srgb_encoder *encoder, code_of_direction *known) {
    const shade_kernel kernel = {body, BURNISH_SHADE_DISTANT, BURNISH_SHADE_FLOAT, channels};
    const vf side = vf_sub(vf_from_int(vi_and(vi_ramp(2), vi_set(2))), vf_set(1.0f));
    const float *d = known->direction;
    const float length = __builtin_sqrtf((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]);
    const float unit[3] = {d[0] / length, d[1] / length, d[2] / length};
    shade_sums sums;
    vf light[3];
    int32_t codes[LANES];
    for (int k = 0; k < channels; ++k) {
        sums.diffuse[k] = vf_set(shader->ambient[kernel.output][k]);
        sums.specular[k] = vf_set(0.0f);
    }
    for (int l = 0; l < shader->light_count; ++l) {
        const burnish_light_constants *of = &shader->lights[l];
        const vf n_dot_l = vf_max(bound_cosine(unit, of->vector, side), vf_set(0.0f));
        shade_add_distant(kernel, shader, of, n_dot_l, bound_cosine(unit, of->half, side), &sums);
    }
    for (int k = 0; k < channels; ++k) {
        light[k] = vf_max(vf_add(sums.diffuse[k], sums.specular[k]), vf_set(0.0f));
    }
    vi_store(codes, encode_channels(encoder, channels, light));
    known->code = codes[0];
    known->state = codes[0] == codes[LANES - 1] ? CODE_ONE : CODE_SPLIT;
}

BURNISH_INLINE void shade_codes(int body, int channels, const burnish_kernels_shader *shader,
                                const burnish_srgb_encoder *encoder,
                                const burnish_code_batch *batch, size_t count, uint32_t *codes) {
    const shade_kernel kernel = {body, BURNISH_SHADE_DISTANT, BURNISH_SHADE_FLOAT, channels};
    const burnish_kernels_points points = {
        .normal = {batch->normal[0], batch->normal[1], batch->normal[2]}};
    const vi alpha = vi_set((int32_t)batch->alpha), background = vi_set((int32_t)batch->background);
    code_of_direction known = {CODE_UNKNOWN, {0, 0, 0}, 0};
    for (size_t i = 0; i < count; i += LANES) {
        const vm shown = vf_greater(vf_load(batch->depths + i), vf_set(BURNISH_FARTHEST));
        const unsigned bits = vm_bits(shown);
        const vf n[3] = {vf_load(points.normal[0] + i), vf_load(points.normal[1] + i),
                         vf_load(points.normal[2] + i)};
        vi code = vi_set(known.code);
        const int is_known = LANES > 1 && bits && points_there(&known, n, shown);
        if (is_known && known.state == CODE_UNKNOWN) {
            find_code(body, channels, shader, encoder, &known);
            code = vi_set(known.code);
        }
        if (bits && !(is_known && known.state == CODE_ONE)) {
            vf light[3];
            shade_points(kernel, shader, &points, i, light);
            code = encode_channels(encoder, channels, light);
            for (int k = 0; k < 3 && !is_known; ++k) {
                known.direction[k] = batch->normal[k][i + (size_t)__builtin_ctz(bits)];
                known.state = CODE_UNKNOWN;
            }
        }
        vi_store((int32_t *)codes + i, vi_blend(shown, vi_or(code, alpha), background));
    }
}

#define CODE_FUNCTION(name, body)                                                                  \
    static void codes_##name(const burnish_kernels_shader *shader,                                 \
                             const burnish_srgb_encoder *encoder, const burnish_code_batch *batch, \
                             size_t count, uint32_t *codes) {                                      \
        if (is_grey(shader)) {                                                                     \
            shade_codes(body, 1, shader, encoder, batch, count, codes);                            \
        } else {                                                                                   \
            shade_codes(body, 3, shader, encoder, batch, count, codes);                            \
        }                                                                                          \
    }
CODE_FUNCTION(none, BURNISH_LOBE_BODY_NONE)
CODE_FUNCTION(square, BURNISH_LOBE_BODY_SQUARE)
CODE_FUNCTION(squares, BURNISH_LOBE_BODY_SQUARES)
#undef CODE_FUNCTION

#endif
