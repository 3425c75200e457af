/* Light that passes through points, with SIMD: what a surface does not reflect (Schlick 1994) times
 * its base colour, what a volume behind it absorbs (Beer), and where a refracted ray goes.
 *
 * Rays leave a plate as they came, and a ball turned twice by the angle by which the front refracts
 * them. A volume is between the two: up to some angle most light is from straight behind, and the
 * rest from where a ball turns it. */
#ifndef BURNISH_RENDER_TEXTURE_PASSING_SIMD_H
#define BURNISH_RENDER_TEXTURE_PASSING_SIMD_H

#include "render/texture/texture_surface_simd.h"

/* Cosines of the front's angle: from the first one on all light is from straight behind, up to the
 * second one none. By eye, on bottles, balls and machine parts. */
#define PASSING_STRAIGHT 0.97f
#define PASSING_TURNED 0.8f

/* The exponent of 65536 is the roughness 0.0743: from there on straight light becomes less. */
#define PASSING_SMOOTH (1.0f / (1.0f - 0.0743f))

/* Of rays from the viewer at a cosine c: where they go, and the share of straight light. */
BURNISH_INLINE vf passing_turn(const vf normal[3], const vf viewer[3], vf c, vf inverse_index,
                               vf to[3]) {
    const vf one = vf_set(1.0f), two = vf_set(2.0f);
    const vf sine2 = vf_mul(vf_sub(one, vf_mul(c, c)), vf_mul(inverse_index, inverse_index));
    const vf inside = texture_root(vf_max(vf_sub(one, sine2), vf_set(0x1p-40f)));
    const vf bent = vf_sub(inside, vf_mul(c, inverse_index));
    const vf once = vf_add(vf_mul(vf_sub(one, vf_mul(c, c)), inverse_index), vf_mul(c, inside));
    const vf twice = vf_sub(vf_mul(two, vf_mul(once, once)), one);
    for (int k = 0; k < 3; ++k) {
        const vf across = vf_sub(vf_mul(c, viewer[k]), normal[k]);
        to[k] = vf_sub(vf_mul(vf_mul(two, vf_mul(once, bent)), across), vf_mul(twice, viewer[k]));
    }
    const vf share = vector_saturate(vf_mul(vf_sub(once, vf_set(PASSING_TURNED)),
                                            vf_set(1.0f / (PASSING_STRAIGHT - PASSING_TURNED))));
    return vf_mul(vf_mul(share, share), vf_sub(vf_set(3.0f), vf_mul(two, share)));
}

static void pass_points(const burnish_passing *passing, size_t count,
                        burnish_texture_scratch *scratch) {
    const vf zero = vf_set(0.0f), one = vf_set(1.0f);
    const burnish_material *material = &passing->material->material;
    const int has_thickness = passing->material->samplers[BURNISH_TEXTURE_THICKNESS].levels != NULL;
    const int has_edge = passing->material->has_edge;
    const float index = material->refractive_index >= 1 ? material->refractive_index : 1.5f;
    const float distance = passing->is_traced ? 0 : material->attenuation_distance;
    for (size_t i = 0; i < count; i += LANES) {
        vf normal[3], viewer[3], to[3];
        texture_vectors(passing->shader, &passing->points, i, normal, viewer);
        const vf c = vector_saturate(texture_dot(normal, viewer)), fall = vf_sub(one, c);
        const vf squared = vf_mul(fall, fall), edge = vf_mul(vf_mul(squared, squared), fall);
        vf depth = vf_set(material->thickness);
        const vm solid = vf_greater(depth, zero);
        const vm front = vf_greater(vf_load(passing->facing + i), zero);
        const vf f90 = vf_sub(one, has_edge ? vf_load(scratch->edge_loss + i) : zero);
        if (has_thickness) {
            depth = vf_mul(depth, vf_load(scratch->thickness + i));
        }
        const vf ratio = vf_min(vf_div(depth, vf_set(distance)), vf_set(0x1p100f)); /* finite */
        const vm enters = vm_and(front, vf_greater(depth, zero));
        for (int k = 0; k < 3; ++k) {
            const vf f0 = vf_load(scratch->reflectance[k] + i);
            const vf rest = vf_sub(one, vf_add(f0, vf_mul(vf_sub(f90, f0), edge)));
            vf passed = vf_blend(vm_and(solid, vm_not(front)), vf_load(scratch->transmission + i),
                                 vf_load(scratch->passed[k] + i));
            if (distance > 0) {
                const float color = material->attenuation_color[k];
                const vf bits = vector_log2(vf_set(color > 0x1p-126f ? color : 0x1p-126f));
                const vf left = vector_exp2(vf_mul(bits, ratio));
                passed = vf_mul(passed, vf_blend(enters, vf_min(left, one), one));
            }
            vf_store(scratch->passed[k] + i, vf_mul(passed, rest));
        }
        const vf inverse = vf_blend(enters, vf_set(1.0f / index), one);
        const vf share = passing_turn(normal, viewer, c, inverse, to);
        const vf smooth = vf_sub(one, vf_load(scratch->roughness + i));
        vf_store(scratch->sample[3] + i,
                 vf_mul(share, vf_min(vf_mul(smooth, vf_set(PASSING_SMOOTH)), one)));
        for (int k = 0; k < 3; ++k) {
            vf_store(scratch->sample[k] + i, to[k]);
        }
    }
}

#endif
