/* The second way in: link libburnish and hand over arrays. The fastest kernels of the processor do
 * the rest, with the same bits as every other.
 *
 *     cc link_kernels.c $(pkg-config --cflags --libs burnish) -lm -o link_kernels && ./link_kernels > sphere.ppm
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>

#include "burnish/kernels.h"

enum { SIZE = 256 };

int main(void) {
    const burnish_kernels *kernels = burnish_kernels_best();
    burnish_kernels_lighting lighting = burnish_kernels_lighting_default(); /* a white light, energy:2 */
    burnish_kernels_shader *shader;
    burnish_error error;
    if (burnish_kernels_shader_create(&lighting, NULL, &shader, &error) != BURNISH_STATUS_OK) {
        fprintf(stderr, "%s\n", error.text);
        return 1;
    }
    fprintf(stderr, "kernels: %s\n", burnish_isa_name(burnish_kernels_get_isa(kernels)));
    printf("P6\n%d %d\n255\n", SIZE, SIZE);
    for (int row = 0; row < SIZE; ++row) {
        static float x[SIZE], y[SIZE], z[SIZE];
        static uint8_t rgba[4 * SIZE];
        for (int column = 0; column < SIZE; ++column) {
            x[column] = (float)(2 * column + 1 - SIZE) / SIZE;
            y[column] = (float)(SIZE - 1 - 2 * row) / SIZE;
            const float rest = 1.0f - (x[column] * x[column] + y[column] * y[column]);
            z[column] = rest > 0.0f ? sqrtf(rest) : 0.0f;
        }
        /* any length will do: the kernel makes unit vectors of normals itself */
        const burnish_kernels_points points = {.normal = {x, y, z}};
        if (burnish_kernels_shade_rgba8(kernels, shader, &points, SIZE, rgba, &error) !=
            BURNISH_STATUS_OK) {
            fprintf(stderr, "%s\n", error.text);
            return 1;
        }
        for (int column = 0; column < SIZE; ++column) {
            for (int channel = 0; channel < 3; ++channel) {
                putchar(z[column] > 0.0f ? rgba[4 * column + channel] : 0);
            }
        }
    }
    burnish_kernels_shader_destroy(shader);
    return 0;
}
