/* The first way in: copy lobe.h beside your shader and call it in the loop that you already have.
 *
 *     cc -I../../lobe/include/burnish copy_lobe.c -lm -o copy_lobe && ./copy_lobe > sphere.ppm
 */
#include <math.h>
#include <stdio.h>

#include "lobe.h"

enum { SIZE = 256 };

static float dot(const float a[3], const float b[3]) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/* Phong's equation for one white light: ambient, diffuse, and a highlight where it is lit. */
static float shade(burnish_lobe lobe, const float normal[3], const float light[3],
                   const float half[3]) {
    const float n_dot_l = dot(normal, light);
    if (n_dot_l <= 0.0f) {
        return 0.05f;
    }
    return 0.05f + 0.6f * n_dot_l + 0.35f * burnish_lobe_at_cosine(lobe, dot(normal, half));
}

int main(void) {
    const float light[3] = {-0.48f, 0.6f, 0.64f};
    float half[3] = {light[0], light[1], light[2] + 1.0f}; /* between the light and +z */
    const float scale = 1.0f / sqrtf(dot(half, half));
    burnish_lobe lobe;
    for (int k = 0; k < 3; ++k) {
        half[k] *= scale;
    }
    if (burnish_lobe_create(&lobe, BURNISH_FIT_ENERGY, 2, 32.0f) != BURNISH_LOBE_OK) {
        return 1;
    }
    printf("P6\n%d %d\n255\n", SIZE, SIZE);
    for (int row = 0; row < SIZE; ++row) {
        for (int column = 0; column < SIZE; ++column) {
            const float x = (float)(2 * column + 1 - SIZE) / SIZE;
            const float y = (float)(SIZE - 1 - 2 * row) / SIZE;
            const float rest = 1.0f - (x * x + y * y);
            float color = 0.0f;
            if (rest > 0.0f) {
                const float normal[3] = {x, y, sqrtf(rest)};
                color = shade(lobe, normal, light, half);
            }
            for (int channel = 0; channel < 3; ++channel) {
                putchar((int)(255.0f * burnish_lobe_saturate(color) + 0.5f));
            }
        }
    }
    return 0;
}
