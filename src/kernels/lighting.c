/* The steps of the Phong equation around the lobe. */
#include "kernels/kernels.h"

void burnish_kernel_normalize(size_t count, float *x, float *y, float *z, float *length) {
    for (size_t i = 0; i < count; ++i) {
        float squared = (x[i] * x[i] + y[i] * y[i]) + z[i] * z[i];
        float root = __builtin_sqrtf(squared);
        float scale = root > 0.0f ? 1.0f / root : 0.0f;
        x[i] *= scale;
        y[i] *= scale;
        z[i] *= scale;
        if (length) {
            length[i] = root;
        }
    }
}

void burnish_kernel_dot(size_t count, const float *ax, const float *ay, const float *az,
                        const float *bx, const float *by, const float *bz, float *out) {
    for (size_t i = 0; i < count; ++i) {
        out[i] = (ax[i] * bx[i] + ay[i] * by[i]) + az[i] * bz[i];
    }
}

void burnish_kernel_dot_uniform(size_t count, const float *ax, const float *ay, const float *az,
                                const float b[3], float *out) {
    for (size_t i = 0; i < count; ++i) {
        out[i] = (ax[i] * b[0] + ay[i] * b[1]) + az[i] * b[2];
    }
}

void burnish_kernel_reflect(size_t count, const float *n_dot_l, const float *n_dot_v,
                            const float *l_dot_v, float *out) {
    for (size_t i = 0; i < count; ++i) {
        out[i] = 2.0f * n_dot_l[i] * n_dot_v[i] - l_dot_v[i];
    }
}

void burnish_kernel_accumulate(size_t count, float light, const float *diffuse, float specular,
                               const float *n_dot_l, const float *lobe_values, float *sum) {
    for (size_t i = 0; i < count; ++i) {
        float reflected = diffuse[i] * n_dot_l[i] + specular * lobe_values[i];
        sum[i] += n_dot_l[i] > 0.0f ? light * reflected : 0.0f;
    }
}
