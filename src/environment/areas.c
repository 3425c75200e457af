#include "environment/areas.h"

#include "core/numbers.h"
#include "core/vector.h"

enum { CORNERS_MAX = 24 };

typedef burnish_vec3 vec3;

static double dot(vec3 a, vec3 b) {
    return burnish_vec3_dot(a, b);
}

/* Unit vectors to the corners, counter-clockwise as seen from the origin. Returns how many; 0: the
 * light is not seen. */
static int find_corners(const burnish_area_light *light, vec3 *corners) {
    const vec3 center = burnish_vec3_load(light->center);
    const vec3 u = burnish_vec3_load(light->half_u), v = burnish_vec3_load(light->half_v);
    const double facing = dot(burnish_vec3_cross(u, v), center);
    const int is_rect = light->shape == BURNISH_AREA_RECT, count = is_rect ? 4 : CORNERS_MAX;
    if (facing == 0 || (facing > 0 && !light->is_two_sided)) {
        return 0;
    }
    for (int i = 0; i < count; ++i) {
        double sine, cosine;
        burnish_sincos(2 * BURNISH_PI * (i + 0.5) / count, &sine, &cosine);
        const double size = is_rect ? __builtin_sqrt(2) : 1;
        const vec3 corner =
            burnish_vec3_add(center, burnish_vec3_add(burnish_vec3_scale(u, size * cosine),
                                                      burnish_vec3_scale(v, size * sine)));
        corners[facing > 0 ? i : count - 1 - i] = burnish_vec3_normalize(corner);
    }
    return count;
}

/* The azimuth around r from a to b. */
static double swept(vec3 r, vec3 a, vec3 b) {
    return burnish_atan2(dot(r, burnish_vec3_cross(a, b)), dot(a, b) - dot(r, a) * dot(r, b));
}

/* Integral of (1 - u^(m+1)) over the azimuth swept by an arc inside the lobe's cap, c = k cos(t),
 * by Gauss's rule. */
static double inside(const burnish_light_lobe *lobe, double k, double s, double from, double to) {
    static const double nodes[5] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                                    0.8650633666889845, 0.9739065285171717};
    static const double weights[5] = {0.2955242247147529, 0.2692667193099963, 0.2190863625159820,
                                      0.1494513491505806, 0.0666713443086881};
    double sum = 0;
    for (int i = 0; i < 10; ++i) {
        const double x = i < 5 ? nodes[i] : -nodes[i - 5];
        double sine, cosine;
        burnish_sincos((from + to) / 2 + x * (to - from) / 2, &sine, &cosine);
        const double c = k * cosine, u = 1 + (double)lobe->zeta * (c - 1);
        double powers = 0;
        for (int j = 0; j <= lobe->order; ++j) {
            powers = powers * u + 1;
        }
        sum += weights[i % 5] * powers * s / (1 + c);
    }
    return sum * (to - from) / 2 * (double)lobe->zeta;
}

/* The share of one edge in the integral of a lobe around r, times zeta (m + 1). */
static double edge(const burnish_light_lobe *lobe, vec3 r, vec3 a, vec3 b) {
    const vec3 n = burnish_vec3_normalize(burnish_vec3_cross(a, b));
    const double s = dot(r, n), c0 = 1 - 1 / (double)lobe->zeta;
    const vec3 nearest = burnish_vec3_sub(r, burnish_vec3_scale(n, s));
    const double k = burnish_vec3_length(nearest);
    const double whole = swept(r, a, b);
    if (k <= c0 || k < 1e-9) {
        return whole;
    }
    const vec3 x = burnish_vec3_normalize(nearest), y = burnish_vec3_cross(n, x);
    const double half = burnish_acos(c0 / k > -1 ? c0 / k : -1);
    const double start = burnish_atan2(dot(a, y), dot(a, x));
    const double end = start + burnish_acos(dot(a, b));
    double sum = whole;
    for (int turn = -1; turn <= 1; ++turn) {
        const double from =
            start > 2 * BURNISH_PI * turn - half ? start : 2 * BURNISH_PI * turn - half;
        const double to = end < 2 * BURNISH_PI * turn + half ? end : 2 * BURNISH_PI * turn + half;
        if (from < to) {
            double s0, c1, s2, c3;
            burnish_sincos(from, &s0, &c1);
            burnish_sincos(to, &s2, &c3);
            const vec3 p = burnish_vec3_add(burnish_vec3_scale(x, c1), burnish_vec3_scale(y, s0));
            const vec3 q = burnish_vec3_add(burnish_vec3_scale(x, c3), burnish_vec3_scale(y, s2));
            sum += inside(lobe, k, s, from, to) - swept(r, p, q);
        }
    }
    return sum;
}

/* The share of the lobes' energy that a polygon takes. */
static double specular(const burnish_light_lobes *lobes, vec3 r, const vec3 *corners, int count) {
    double sum = 0;
    for (int j = 0; j < lobes->count; ++j) {
        double share = 0;
        for (int i = 0; i < count; ++i) {
            share += edge(&lobes->lobe[j], r, corners[i], corners[(i + 1) % count]);
        }
        sum += (double)lobes->lobe[j].weight * share / (2 * BURNISH_PI);
    }
    return sum;
}

/* Lambert's formula for the part of a polygon above the horizon of n, divided by pi. */
static double diffuse(vec3 n, const vec3 *corners, int count) {
    vec3 above[CORNERS_MAX + 2];
    int kept = 0;
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        const vec3 a = corners[i], b = corners[(i + 1) % count];
        const double x = dot(n, a), y = dot(n, b);
        if (x > 0) {
            above[kept++] = a;
        }
        if ((x > 0) != (y > 0)) {
            above[kept++] = burnish_vec3_normalize(burnish_vec3_add(
                burnish_vec3_scale(a, y / (y - x)), burnish_vec3_scale(b, -x / (y - x))));
        }
    }
    for (int i = 0; i < kept; ++i) {
        const vec3 a = above[i], b = above[(i + 1) % kept], normal = burnish_vec3_cross(a, b);
        sum += dot(n, burnish_vec3_normalize(normal)) *
               burnish_atan2(burnish_vec3_length(normal), dot(a, b));
    }
    return sum / (2 * BURNISH_PI);
}

void burnish_light_add_area(const burnish_area_light *light, const burnish_light_lobes *lobes,
                            const float *const w[3], size_t count, float *const rgb[3]) {
    vec3 corners[CORNERS_MAX];
    const int corner_count = find_corners(light, corners);
    for (size_t i = 0; i < count && corner_count > 0; ++i) {
        const vec3 axis = {w[0][i], w[1][i], w[2][i]};
        const double share = lobes ? specular(lobes, axis, corners, corner_count)
                                   : diffuse(axis, corners, corner_count);
        for (int k = 0; k < 3; ++k) {
            rgb[k][i] += light->color[k] * (share > 0 ? (float)share : 0.0f);
        }
    }
}
