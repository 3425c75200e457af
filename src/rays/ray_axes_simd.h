/* Axes around the directions of rays. */
#ifndef BURNISH_RAYS_RAY_AXES_SIMD_H
#define BURNISH_RAYS_RAY_AXES_SIMD_H

#include "simd/vector.h"

BURNISH_INLINE vf ray_dot(const vf a[3], const vf b[3]) {
    return vf_add(vf_add(vf_mul(a[0], b[0]), vf_mul(a[1], b[1])), vf_mul(a[2], b[2]));
}

/* Two vectors across a unit vector (Duff et al., Building an Orthonormal Basis, Revisited, 2017). */
BURNISH_INLINE void find_across(const vf d[3], vf first[3], vf second[3]) {
    const vf zero = vf_set(0.0f), one = vf_set(1.0f);
    const vf sign = vf_blend(vf_greater(zero, d[2]), vf_set(-1.0f), one);
    const vf a = vf_div(vf_set(-1.0f), vf_add(sign, d[2]));
    const vf b = vf_mul(vf_mul(d[0], d[1]), a);
    first[0] = vf_add(one, vf_mul(vf_mul(sign, vf_mul(d[0], d[0])), a));
    first[1] = vf_mul(sign, b);
    first[2] = vf_sub(zero, vf_mul(sign, d[0]));
    second[0] = b;
    second[1] = vf_add(sign, vf_mul(vf_mul(d[1], d[1]), a));
    second[2] = vf_sub(zero, d[1]);
}

#endif
