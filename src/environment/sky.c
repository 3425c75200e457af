/* A clear sky with the sun 40 degrees above the horizon, over grey ground. Luminance: the CIE
 * standard clear sky (CIE S 011, type 12); the colours are chosen by eye. The sun is a lobe of 1.4
 * degrees. Sky and sun light a white horizontal surface to 1. */
#include "environment/sky.h"

#include "base/numbers.h"
#include "core/vector.h"

typedef burnish_vec3 vec3;

static const vec3 sun = {-0.4596267, 0.6427876, 0.6128356};
static const double sun_share = 0.55;    /* of the light on a horizontal surface */
static const double sun_zeta = 400;      /* of its lobe, order 8 */
static const double ground_share = 0.22; /* reflected */

/* Linear colours. */
static const vec3 zenith_color = {0.26, 0.48, 1.0}, horizon_color = {0.74, 0.86, 1.0};
static const vec3 sun_color = {1.0, 0.93, 0.82}, ground_color = {1.0, 0.95, 0.87};

static vec3 of_luminance(vec3 color, double luminance) {
    const double own = 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
    return burnish_vec3_scale(color, luminance / own);
}

static vec3 mix(vec3 a, vec3 b, double share) {
    return burnish_vec3_add(burnish_vec3_scale(a, 1 - share), burnish_vec3_scale(b, share));
}

static double exponential(double x) {
    return burnish_expm1(x) + 1;
}

/* The sky in a direction above the horizon, in any unit. */
static vec3 sky(vec3 w) {
    const double a = -1, b = -0.32, c = 10, d = -3, e = 0.45;
    const double height = w.y > 0.005 ? w.y : 0.005, cosine = burnish_vec3_dot(w, sun);
    const double gradation = 1 + a * exponential(b / height);
    const double scattered =
        c * (exponential(d * burnish_acos(cosine)) - exponential(d * BURNISH_PI / 2));
    const double low = 1 - height, glow = scattered / c;
    const vec3 color = mix(zenith_color, horizon_color, low * low * low);
    return of_luminance(mix(color, sun_color, glow > 0 ? glow : 0),
                        gradation * (1 + scattered + e * cosine * cosine));
}

static double sun_lobe(vec3 w) {
    double u = 1 + sun_zeta * (burnish_vec3_dot(w, sun) - 1);
    u = u > 0 ? u * u : 0;
    return u * u * u * u;
}

static vec3 direction(int x, int y, int width, int height) {
    double s, c, sine, cosine;
    burnish_sincos(BURNISH_PI * (y + 0.5) / height, &s, &c);
    burnish_sincos(2 * BURNISH_PI * (x + 0.5) / width - BURNISH_PI, &sine, &cosine);
    return (vec3){s * cosine, c, s * sine};
}

void burnish_sky_fill(int width, int height, float *rgb) {
    /* the sky's luminance on a horizontal surface, over pi; the lobe's integral is exact */
    double light = 0;
    for (int y = 0; y < height / 2; ++y) {
        for (int x = 0; x < width; x += 8) {
            const vec3 w = direction(x, y, width, height), color = sky(w);
            const double area =
                2 * BURNISH_PI * BURNISH_PI * 8 / width / height * __builtin_sqrt(1 - w.y * w.y);
            light += (0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z) * w.y * area;
        }
    }
    const double sky_scale = (1 - sun_share) * BURNISH_PI / light;
    const vec3 sun_radiance =
        of_luminance(sun_color, sun_share * sun_zeta * 9 / (2 * sun.y)); /* E = 2 pi / (9 zeta) */
    const vec3 ground = of_luminance(ground_color, ground_share);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x, rgb += 3) {
            const vec3 w = direction(x, y, width, height);
            const vec3 above = burnish_vec3_add(burnish_vec3_scale(sky(w), sky_scale),
                                                burnish_vec3_scale(sun_radiance, sun_lobe(w)));
            const vec3 color = w.y > 0 ? above : ground;
            rgb[0] = (float)color.x;
            rgb[1] = (float)color.y;
            rgb[2] = (float)color.z;
        }
    }
}
