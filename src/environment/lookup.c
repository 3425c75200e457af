#include "environment/lookup.h"

#include "base/numbers.h"
#include "core/elementary.h"

int burnish_environment_level_of(const burnish_environment *environment, double angle) {
    int level = 0;
    while (level + 1 < environment->level_count &&
           2 * BURNISH_PI / environment->levels[level + 1].width <= angle) {
        ++level;
    }
    return level;
}

/* Weights of four neighbours of a position, and the first of them, which can be -2. */
static int weigh(double position, float weights[4]) {
    const int second = (int)(position + 2) - 2; /* rounded down: positions begin at -1/2 */
    const float t = (float)(position - second), s = 1 - t;
    weights[0] = s * s * s * (1.0f / 6);
    weights[1] = (4 + t * t * (3 * t - 6)) * (1.0f / 6);
    weights[2] = (4 + s * s * (3 * s - 6)) * (1.0f / 6);
    weights[3] = t * t * t * (1.0f / 6);
    return second - 1;
}

void burnish_environment_lookup(const burnish_environment *environment, int level,
                                const double direction[3], float rgb[3]) {
    const burnish_environment_level *image = &environment->levels[level];
    const int width = image->width, height = image->height;
    const double x = direction[0], y = direction[1], z = direction[2];
    const double polar = burnish_atan2(__builtin_sqrt(x * x + z * z), y);
    const double azimuth = burnish_atan2(z, x) + BURNISH_PI;
    float across[4], down[4];
    const int left = weigh(azimuth / (2 * BURNISH_PI) * width - 0.5, across);
    const int top = weigh(polar / BURNISH_PI * height - 0.5, down);
    rgb[0] = rgb[1] = rgb[2] = 0;
    for (int j = 0; j < 4; ++j) {
        const int row = top + j, is_beyond = row < 0 || row >= height; /* over a pole */
        const int nearest = row < 0 ? -1 - row : row >= height ? 2 * height - 1 - row : row;
        const size_t first = (size_t)nearest * (size_t)width;
        for (int i = 0; i < 4; ++i) {
            const int column = left + i + (is_beyond ? width / 2 : 0);
            const size_t texel = first + (size_t)((column + width) % width);
            for (int k = 0; k < 3; ++k) {
                rgb[k] += down[j] * across[i] * image->texels[k][texel];
            }
        }
    }
}
