/* From normals straight to sRGB codes: directional lights, a distant viewer, lobes of the family
 * and composites.
 *
 * The pixels of a flat face mostly have one code, though not one colour: in perspective a normal is
 * interpolated times 1/w, and rounding gives it other directions. Normals that point the way of an
 * earlier one get its code at once, where the least and the greatest cosines that they can have
 * lead to that code:
 *   sine of the angle: at most sqrt(2) (2^-17 + 2^-22), by the test's limit and its rounding
 *   rounding of the direction and of all cosines: less than 2^-20
 * which together is less than 0.8 of CODE_MARGIN. From the cosines on, all operations are
 * monotonic with their rounding: sums, products with numbers >= 0, and the code of a float. So
 * every cosine in between has the same code.
 *
 * A face whose normals the rasterizer knows to point one way, within 2^-18.4, is shaded before it is
 * drawn: the direction that is known then is within CODE_LIMIT / 2, so the same bounds hold. */
#ifndef BURNISH_RENDER_FRAME_CODES_SIMD_H
#define BURNISH_RENDER_FRAME_CODES_SIMD_H

#include "raster/tile.h"
#include "render/frame/pixels_simd.h"
#include "shading/shade_simd.h"

/* Bounds of a cosine with a vector: so far from it, times the sum of the vector's magnitudes. */
#define CODE_MARGIN 0x1p-16f
#define CODE_LIMIT 0x1p-18f
/* Lengths of normals whose directions are compared. */
#define CODE_LEAST 0x1p-20f
#define CODE_MOST 0x1p20f

enum {
    CODE_NONE,    /* no direction is known */
    CODE_UNKNOWN, /* it is, but its code is not */
    CODE_SPLIT,   /* the bounds have several codes */
    CODE_ONE      /* all normals that point there have its code */
};

static const uint8_t AXES[5] = {0, 1, 2, 0, 1};

/* The rasterizer stores the code of a flat face in place of its normals' first number: as the sign
 * and fraction of a float that is not finite. */
#define CODE_EXPONENT 0x7f800000

/* Whether the shown normals of `ways` vectors from i on point that way. */
BURNISH_INLINE int points_there(const burnish_code_direction *known, int ways,
                                const float *const normal[3], size_t i, const vm *shown) {
    const float *largest = normal[known->axis] + i;
    const vf limit = vf_set(known->limit), inverse = vf_set(known->inverse);
    vm off = vf_greater(limit, limit);
    for (int k = 0; k < 2; ++k) { /* most others fail at once */
        const float *other = normal[AXES[known->axis + 1 + k]] + i;
        for (int j = 0; j < ways; ++j) {
            const vf part = vf_mul(vf_load(largest + j * LANES), vf_set(known->others[k]));
            const vf rest = vf_sub(vf_load(other + j * LANES), part);
            const vf size = vf_from_bits(vi_and(vf_bits(rest), vi_set(INT32_MAX)));
            off = vm_or(off, vm_and_not(shown[j], vf_greater(limit, size)));
        }
        if (vm_any(off)) {
            return 0;
        }
    }
    for (int j = 0; j < ways; ++j) {
        const vf scale = vf_mul(vf_load(largest + j * LANES), inverse);
        off = vm_or(off, vm_and_not(shown[j], vf_greater(scale, vf_set(0.5f))));
    }
    return !vm_any(off);
}

BURNISH_INLINE void set_direction(burnish_code_direction *known, const float normal[3]) {
    /* the largest of three by their comparisons, without branches that are guessed wrong */
    static const uint8_t largest[8] = {0, 1, 0, 1, 0, 0, 2, 2};
    const float size[3] = {__builtin_fabsf(normal[0]), __builtin_fabsf(normal[1]),
                           __builtin_fabsf(normal[2])};
    known->state = CODE_UNKNOWN;
    known->axis =
        largest[(size[1] > size[0]) | (size[2] > size[0]) << 1 | (size[2] > size[1]) << 2];
    const float most = size[known->axis];
    known->inverse = 1.0f / normal[known->axis];
    known->limit = most > CODE_LEAST && most < CODE_MOST ? most * CODE_LIMIT : 0.0f;
    for (int k = 0; k < 2; ++k) {
        known->others[k] = normal[AXES[known->axis + 1 + k]] * known->inverse;
    }
}

/* After a vector that points elsewhere, of which normal i is one: the next one is not compared, but
 * a direction to compare with, because on a curved surface nothing is gained. There directions are
 * tried less and less often. */
BURNISH_INLINE void next_direction(burnish_code_direction *known, const float *const normal[3],
                                   size_t i) {
    enum { LONGEST_PAUSE = 15 };
    if (known->state != CODE_NONE) {
        known->state = CODE_NONE;
        known->left = known->pause;
        known->pause = known->pause < LONGEST_PAUSE ? 2 * known->pause + 1 : LONGEST_PAUSE;
    } else if (known->left > 0) {
        --known->left;
    } else {
        set_direction(known, (const float[3]){normal[0][i], normal[1][i], normal[2][i]});
    }
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
        return join_grey(encode_vector(encoder, light[0]));
    }
    return encode_light(encoder, light);
}

/* Finds the code of a direction, if it has one. */
BURNISH_INLINE void find_code(shade_kernel kernel, const burnish_kernels_shader *shader,
                              const burnish_srgb_encoder *encoder, burnish_code_direction *known) {
    const int channels = kernel.channels;
    const vf side = vf_sub(vf_from_int(vi_and(vi_ramp(2), vi_set(2))), vf_set(1.0f));
    const float *d = known->others;
    const float length = __builtin_sqrtf((1.0f + d[0] * d[0]) + d[1] * d[1]);
    const float most = (known->inverse < 0 ? -1.0f : 1.0f) / length;
    float unit[3];
    unit[known->axis] = most;
    unit[AXES[known->axis + 1]] = d[0] * most;
    unit[AXES[known->axis + 2]] = d[1] * most;
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

/* The codes of faces among LANES first numbers, which `left` loses. */
BURNISH_INLINE vi load_face_codes(const float *numbers, vm *left) {
    const vi bits = vf_bits(vf_load(numbers)), exponent = vi_set(CODE_EXPONENT);
    *left = vm_and_not(*left, vi_equal(vi_and(bits, exponent), exponent));
    return vi_or(vi_and(bits, vi_set(0x7fffff)), vi_and(vi_shr(bits, 8), vi_set(0x800000)));
}

/* Pixels that are shaded before any is encoded: a look-up waits for its light, and meanwhile the next
 * vectors' lights are computed. */
enum { CODE_VECTORS = 16 };
typedef struct code_chunk {
    _Alignas(64) float light[3][CODE_VECTORS * LANES];
    size_t first;    /* of its pixels */
    unsigned shaded; /* bits of the vectors whose light is here; the others have codes */
} code_chunk;

typedef struct code_vector {
    vm shown, left; /* pixels that show a triangle; of these the ones without a face's code */
    vi of_face;
} code_vector;

BURNISH_INLINE code_vector load_code_vector(const burnish_code_batch *batch, size_t i) {
    code_vector v;
    v.shown = vf_greater(vf_load(batch->depths + i), vf_set(BURNISH_FARTHEST));
    v.left = v.shown;
    v.of_face = batch->has_codes ? load_face_codes(batch->normal[0] + i, &v.left) : vi_set(0);
    return v;
}

BURNISH_INLINE void store_codes(const burnish_code_batch *batch, const code_vector *v, vi own,
                                size_t i) {
    const vi alpha = vi_set((int32_t)batch->alpha), background = vi_set((int32_t)batch->background);
    own = batch->has_codes ? vi_blend(v->left, own, v->of_face) : own;
    vi_store((int32_t *)batch->codes + i, vi_blend(v->shown, vi_or(own, alpha), background));
}

/* `ways` vectors of pixels from i on: their light, or their codes if all have one that is known. */
BURNISH_INLINE void shade_some_codes(shade_kernel kernel, int ways,
                                     const burnish_kernels_shader *shader,
                                     const burnish_code_batch *batch,
                                     const burnish_kernels_points *points, size_t i,
                                     code_chunk *chunk) {
    burnish_code_direction *known = batch->known;
    const size_t at = i - chunk->first;
    code_vector v[SHADE_WAYS];
    vm left[SHADE_WAYS];
    int any = 0;
    for (int j = 0; j < ways; ++j) {
        v[j] = load_code_vector(batch, i + (size_t)j * LANES);
        left[j] = v[j].left;
        any |= vm_any(left[j]);
    }
    const int is_known = LANES > 1 && known->state != CODE_NONE &&
                         points_there(known, ways, points->normal, i, left);
    if (any && is_known && known->state == CODE_UNKNOWN) {
        find_code(kernel, shader, batch->encoder, known);
    }
    if (!any || (is_known && known->state == CODE_ONE)) {
        known->pause = any ? 0 : known->pause;
        for (int j = 0; j < ways; ++j) {
            store_codes(batch, &v[j], vi_set(known->code), i + (size_t)j * LANES);
        }
        return;
    }
    vf light[SHADE_WAYS][3];
    shade_points(kernel, ways, shader, points, i, light);
    chunk->shaded |= ((1u << ways) - 1) << at / LANES;
    for (int j = 0; j < ways; ++j) {
        for (int k = 0; k < kernel.channels; ++k) {
            vf_store(chunk->light[k] + at + (size_t)j * LANES, light[j][k]);
        }
    }
    if (!is_known) {
        const unsigned bits = vm_bits(left[ways - 1]);
        next_direction(known, points->normal,
                       i + (size_t)(ways - 1) * LANES + (bits ? (size_t)__builtin_ctz(bits) : 0));
    }
}

BURNISH_INLINE void shade_codes(int body, int channels, const burnish_kernels_shader *shader,
                                const burnish_code_batch *given, size_t count) {
    enum { PAIR = SHADE_WAYS * LANES };
    const shade_kernel kernel = {body, BURNISH_SHADE_DISTANT, BURNISH_SHADE_FLOAT, channels};
    burnish_code_direction known = *given->known; /* which no store can change */
    burnish_code_batch batch = *given;
    const burnish_kernels_points points = {
        .normal = {given->normal[0], given->normal[1], given->normal[2]}};
    code_chunk chunk;
    batch.known = &known;
    if (known.shader != shader) {
        known.shader = shader;
        known.state = CODE_NONE;
    }
    for (size_t i = 0; i < count;) {
        const size_t end = i + CODE_VECTORS * LANES < count ? i + CODE_VECTORS * LANES : count;
        chunk.first = i;
        chunk.shaded = 0;
        for (; i + PAIR <= end; i += PAIR) {
            shade_some_codes(kernel, SHADE_WAYS, shader, &batch, &points, i, &chunk);
        }
        for (; i < end; i += LANES) {
            shade_some_codes(kernel, 1, shader, &batch, &points, i, &chunk);
        }
        for (; chunk.shaded; chunk.shaded &= chunk.shaded - 1) {
            const size_t at = (size_t)__builtin_ctz(chunk.shaded) * LANES;
            const code_vector v = load_code_vector(&batch, chunk.first + at);
            vf light[3] = {vf_load(chunk.light[0] + at)};
            for (int k = 1; k < channels; ++k) {
                light[k] = vf_load(chunk.light[k] + at);
            }
            store_codes(&batch, &v, encode_channels(batch.encoder, channels, light),
                        chunk.first + at);
        }
    }
    *given->known = known;
}

/* As render_ops.h says. known: the direction before, whose code is taken up to half the limit from
 * it. */
BURNISH_INLINE int32_t face_code(int body, const burnish_kernels_shader *shader,
                                 const burnish_srgb_encoder *encoder, const float normal[3],
                                 burnish_code_direction *known) {
    burnish_code_direction own = {.shader = shader};
    set_direction(&own, normal);
    int is_new = known->shader != shader || known->axis != own.axis ||
                 (known->inverse > 0) != (own.inverse > 0);
    for (int k = 0; k < 2; ++k) {
        is_new |= !(__builtin_fabsf(known->others[k] - own.others[k]) < 0.5f * CODE_LIMIT);
    }
    if (is_new) {
        const shade_kernel grey = {body, BURNISH_SHADE_DISTANT, BURNISH_SHADE_FLOAT, 1};
        const shade_kernel colored = {body, BURNISH_SHADE_DISTANT, BURNISH_SHADE_FLOAT, 3};
        *known = own;
        if (is_grey(shader)) {
            find_code(grey, shader, encoder, known);
        } else {
            find_code(colored, shader, encoder, known);
        }
    }
    const uint32_t code = (uint32_t)known->code;
    return LANES > 1 && known->state == CODE_ONE
               ? (int32_t)((code & 0x7fffffu) | (code & 0x800000u) << 8 | CODE_EXPONENT)
               : 0;
}

#define CODE_FUNCTION(name, body)                                                                  \
    static void codes_##name(const burnish_kernels_shader *shader,                                 \
                             const burnish_code_batch *batch, size_t count) {                      \
        if (is_grey(shader)) {                                                                     \
            shade_codes(body, 1, shader, batch, count);                                            \
        } else {                                                                                   \
            shade_codes(body, 3, shader, batch, count);                                            \
        }                                                                                          \
    }                                                                                              \
    static int32_t face_##name(const burnish_kernels_shader *shader,                               \
                               const burnish_srgb_encoder *encoder, const float normal[3],         \
                               burnish_code_direction *known) {                                    \
        return face_code(body, shader, encoder, normal, known);                                    \
    }
CODE_FUNCTION(none, BURNISH_LOBE_BODY_NONE)
CODE_FUNCTION(square, BURNISH_LOBE_BODY_SQUARE)
CODE_FUNCTION(squares, BURNISH_LOBE_BODY_SQUARES)
CODE_FUNCTION(composite, BURNISH_LOBE_BODY_COMPOSITE)
#undef CODE_FUNCTION

#endif
