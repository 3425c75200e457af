/* Products of matrices of 3 rows of 4, which place objects. */
#ifndef BURNISH_MESH_READ_COMMON_MATRIX_H
#define BURNISH_MESH_READ_COMMON_MATRIX_H

#include <string.h>

#define BURNISH_MATRIX_IDENTITY                                                                    \
    { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 }

/* product = a b; it may be one of them. */
static inline void burnish_matrix_multiply(const double a[12], const double b[12],
                                           double product[12]) {
    double out[12];
    for (int row = 0; row < 3; ++row) {
        const double *r = a + 4 * row;
        for (int k = 0; k < 4; ++k) {
            out[4 * row + k] = r[0] * b[k] + r[1] * b[4 + k] + r[2] * b[8 + k];
        }
        out[4 * row + 3] += r[3];
    }
    memcpy(product, out, sizeof out);
}

#endif
