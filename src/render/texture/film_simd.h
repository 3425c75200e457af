/* What a film as thin as light's wavelength makes of a reflectance (Belcour and Barla, A Practical
 * Extension to Microfacet Theory for the Modeling of Varying Iridescence, 2017), with the constants
 * and simplifications of KHR_materials_iridescence: Schlick's terms, light that is not polarised, and
 * the two strongest interferences. */
#ifndef BURNISH_RENDER_TEXTURE_FILM_SIMD_H
#define BURNISH_RENDER_TEXTURE_FILM_SIMD_H

#include "simd/vector_math.h"

/* cos(2 pi t), at most 4e-6 off for |t| below 2^21; [-1, 1] or so for others. */
BURNISH_INLINE vf film_cosine(vf t) {
    const vf rounder = vf_set(12582912.0f);
    const vf rest = vf_sub(t, vf_sub(vf_add(t, rounder), rounder)), z = vf_mul(rest, rest);
    vf sine = vf_set(0.08214588661112823f); /* Taylor's terms of sin(pi rest) / rest */
    sine = vf_sub(vf_mul(sine, z), vf_set(0.5992645293207921f));
    sine = vf_add(vf_mul(sine, z), vf_set(2.550164039877345f));
    sine = vf_sub(vf_mul(sine, z), vf_set(5.16771278004997f));
    sine = vf_mul(vf_add(vf_mul(sine, z), vf_set(3.141592653589793f)), rest);
    return vf_sub(vf_set(1.0f), vf_mul(vf_set(2.0f), vf_mul(sine, sine)));
}

BURNISH_INLINE vf film_schlick(vf f0, vf cosine) {
    const vf x = vf_sub(vf_set(1.0f), cosine), squared = vf_mul(x, x);
    return vf_add(f0, vf_mul(vf_sub(vf_set(1.0f), f0), vf_mul(vf_mul(squared, squared), x)));
}

BURNISH_INLINE vf film_root(vf x) {
    return vf_mul(x, vector_inverse_sqrt(vf_max(x, vf_set(0x1p-60f))));
}

/* What the eye sees, in linear sRGB, of interference along a path of `length` nanometres, with the
 * signs that phases give the three primaries: Gaussians for CIE's matching functions, transformed to
 * frequencies; x has two. */
BURNISH_INLINE void film_colors(vf length, const vf sign[3], vf rgb[3]) {
    static const struct {
        float scale, turns, fall; /* of the sum at 0; per nanometre; of exp2(-fall length^2) */
    } lobes[4] = {{0.8465900f, 1.6810e-3f, 2.4649122e-7f},
                  {1.0002219f, 1.7953e-3f, 5.2994645e-7f},
                  {1.0011225f, 2.2084e-3f, 3.7659425e-7f},
                  {0.1538683f, 2.2399e-3f, 2.5790507e-7f}};
    static const float from_xyz[3][3] = {{3.2404542f, -1.5371385f, -0.4985314f},
                                         {-0.9692660f, 1.8760108f, 0.0415560f},
                                         {0.0556434f, -0.2040259f, 1.0572252f}};
    const vf squared = vf_mul(length, length);
    vf xyz[3];
    for (int k = 0; k < 4; ++k) {
        const vf wave = film_cosine(vf_mul(length, vf_set(lobes[k].turns)));
        const vf fall = vector_exp2(vf_mul(squared, vf_set(-lobes[k].fall)));
        const vf value = vf_mul(vf_set(lobes[k].scale), vf_mul(sign[k % 3], vf_mul(wave, fall)));
        xyz[k % 3] = k < 3 ? value : vf_add(xyz[0], value);
    }
    for (int k = 0; k < 3; ++k) {
        rgb[k] = vf_add(
            vf_add(vf_mul(vf_set(from_xyz[k][0]), xyz[0]), vf_mul(vf_set(from_xyz[k][1]), xyz[1])),
            vf_mul(vf_set(from_xyz[k][2]), xyz[2]));
    }
}

/* The reflectance at normal incidence that, with Schlick's term, gives what a film in front of a
 * surface of reflectance f0 reflects where cos(N.V) is `facing`.
 *   thickness  nanometres */
BURNISH_INLINE void film_reflectance(vf facing, vf film_index, vf thickness, const vf f0[3],
                                     vf out[3]) {
    const vf zero = vf_set(0.0f), one = vf_set(1.0f), two = vf_set(2.0f);
    const vf most = vf_set(0.9999f);
    const vf t = vector_saturate(vf_mul(thickness, vf_set(1 / 0.03f)));
    const vf step = vf_mul(vf_mul(t, t), vf_sub(vf_set(3.0f), vf_mul(two, t)));
    const vf index = vf_add(one, vf_mul(step, vf_sub(film_index, one)));
    const vf inverse = vf_div(one, index);
    const vf sine_squared = vf_mul(vf_mul(inverse, inverse), vf_sub(one, vf_mul(facing, facing)));
    const vf cosine = film_root(vf_max(vf_sub(one, sine_squared), zero));
    const vf outer = vf_div(vf_sub(index, one), vf_add(index, one));
    const vf r12 = film_schlick(vf_mul(outer, outer), facing), t121 = vf_sub(one, r12);
    const vf length = vf_mul(vf_mul(two, index), vf_mul(thickness, cosine));
    vf sign[3], sums[3], scale[3], root[3], colors[3];
    for (int k = 0; k < 3; ++k) {
        const vf base_root = film_root(vf_min(vf_max(f0[k], zero), most));
        const vf base = vf_div(vf_add(one, base_root), vf_sub(one, base_root));
        const vf inner = vf_div(vf_sub(base, index), vf_add(base, index));
        const vf r23 = film_schlick(vf_mul(inner, inner), cosine);
        const vf r123 = vf_min(vf_max(vf_mul(r12, r23), vf_set(1e-5f)), most);
        const vf rs = vf_div(vf_mul(vf_mul(t121, t121), r23), vf_sub(one, r123));
        sign[k] = vf_blend(vf_greater(index, base), one, vf_set(-1.0f));
        root[k] = film_root(r123);
        sums[k] = vf_add(r12, rs);
        scale[k] = vf_sub(rs, t121);
    }
    for (int m = 1; m <= 2; ++m) {
        film_colors(vf_mul(vf_set((float)m), length), sign, colors);
        for (int k = 0; k < 3; ++k) {
            scale[k] = vf_mul(scale[k], root[k]);
            sums[k] = vf_add(sums[k], vf_mul(vf_mul(two, scale[k]), colors[k]));
            sign[k] = one;
        }
    }
    const vf x = vf_sub(one, facing), squared = vf_mul(x, x);
    const vf edge = vf_min(vf_mul(vf_mul(squared, squared), x), most);
    for (int k = 0; k < 3; ++k) {
        const vf value = vf_div(vf_sub(vf_max(sums[k], zero), edge), vf_sub(one, edge));
        out[k] = vector_saturate(value);
    }
}

#endif
