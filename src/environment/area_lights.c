#include "environment/area_lights.h"

#include "base/arithmetic.h"
#include "base/numbers.h"
#include "core/vec3.h"

/* The polynomials are fitted to the lobe that split-sum methods integrate (Karis, Real Shading in
 * Unreal Engine 4, 2013: N = V = R), K(c) ~ D(h) max(0, c) with h^2 = (1 + c) / 2. Energy in wrong
 * directions: 6.2 % at alpha 0.01, 2.9 % at 0.16, 0.2 % from 0.5 on. */
static float polynomial(const float p[5], float x) {
    return p[0] + x * (p[1] + x * (p[2] + x * (p[3] + x * p[4])));
}

burnish_light_lobes burnish_light_lobes_for(float alpha) {
    static const float zetas[3][5] = {{0.195991f, -0.038349f, 2.437220f, -4.349801f, 2.777889f},
                                      {0.070456f, 0.049457f, 1.228855f, -1.088043f, 0.823176f},
                                      {0.020008f, 0.024145f, 0.752692f, 0.344416f, -0.140196f}};
    static const float weights[2][5] = {{0.433745f, 0.095864f, 0.223609f, -1.405286f, 0.656158f},
                                        {0.187038f, 0.186449f, 0.333351f, 0.745939f, -0.446119f}};
    static const int orders[3] = {4, 2, 1};
    const float a = alpha > 0.0025f ? alpha < 1.0f ? alpha : 1.0f : 0.0025f;
    const float second = polynomial(weights[0], a), third = polynomial(weights[1], a);
    const float first = 1 - second - third > 0 ? 1 - second - third : 0;
    const float share[3] = {first, second, third}, sum = first + second + third;
    burnish_light_lobes lobes = {.count = 3};
    for (int j = 0; j < 3; ++j) {
        const float zeta = polynomial(zetas[j], a) / (a * a);
        lobes.lobe[j] = (burnish_light_lobe){orders[j], zeta > 1 ? zeta : 1, share[j] / sum};
    }
    return lobes;
}

burnish_light_lobes burnish_light_lobes_near(float alpha) {
    static const float zetas[2][5] = {{0.130873f, 0.145536f, 0.125278f, 0.244102f, 0.399355f},
                                      {0.045493f, 0.060453f, 0.474393f, 0.793652f, -0.361736f}};
    static const float weight[5] = {0.398137f, 0.546989f, -2.960546f, 6.946654f, -3.944059f};
    const float a = alpha > 0.0025f ? alpha < 1.0f ? alpha : 1.0f : 0.0025f;
    const float tail = polynomial(weight, a);
    burnish_light_lobes lobes = {.count = 2};
    for (int j = 0; j < lobes.count; ++j) {
        const float zeta = 0.78f * polynomial(zetas[j], a) / (a * a);
        lobes.lobe[j] =
            (burnish_light_lobe){j == 0 ? 4 : 1, zeta > 1 ? zeta : 1, j == 0 ? 1 - tail : tail};
    }
    return lobes;
}

static void find_corners(const burnish_area_light *light, burnish_kernels_polygon *polygon) {
    const int is_rect = light->shape == BURNISH_AREA_RECT;
    const int count = is_rect ? 4 : BURNISH_POLYGON_VERTEX_MAX;
    const burnish_vec3 center = burnish_vec3_load(light->center);
    const double scale = light->is_distant ? 1 / burnish_vec3_length(center) : 1;
    double sine, cosine, size;
    burnish_sincos(2 * BURNISH_PI / count, &sine, &cosine);
    size = is_rect ? burnish_sqrt(2) : burnish_sqrt(2 * BURNISH_PI / (count * sine));
    polygon->vertex_count = count;
    for (int i = 0; i < count; ++i) {
        burnish_sincos(2 * BURNISH_PI * (i + 0.5) / count, &sine, &cosine);
        const burnish_vec3 u = burnish_vec3_scale(burnish_vec3_load(light->half_u), size * cosine);
        const burnish_vec3 v = burnish_vec3_scale(burnish_vec3_load(light->half_v), size * sine);
        const burnish_vec3 corner = burnish_vec3_add(center, burnish_vec3_add(u, v));
        polygon->vertices[i][0] = (float)(corner.x * scale);
        polygon->vertices[i][1] = (float)(corner.y * scale);
        polygon->vertices[i][2] = (float)(corner.z * scale);
    }
}

double burnish_area_radius(const burnish_area_light *light) {
    const int is_line = light->shape == BURNISH_AREA_LINE;
    return burnish_vec3_length(burnish_vec3_load(is_line ? light->half_v : light->half_u));
}

/* A sphere's centre, or a line's ends. Directions keep their length. */
static void find_ends(const burnish_area_light *light, burnish_kernels_polygon *polygon) {
    polygon->vertex_count = light->shape == BURNISH_AREA_LINE ? 2 : 1;
    polygon->radius = (float)burnish_area_radius(light);
    for (int i = 0; i < polygon->vertex_count; ++i) {
        for (int k = 0; k < 3; ++k) {
            const double half = i > 0 ? light->half_u[k] : -light->half_u[k];
            polygon->vertices[i][k] =
                (float)(light->center[k] + (polygon->vertex_count == 2 ? half : 0));
        }
    }
}

int burnish_area_polygon(const burnish_area_light *light, const burnish_light_lobes *lobes,
                         burnish_polygon_constants *polygon) {
    burnish_kernels_polygon shape = burnish_kernels_polygon_default();
    shape.is_distant = light->is_distant;
    shape.is_two_sided = light->is_two_sided;
    shape.lobe_count = lobes ? lobes->count : 0;
    for (int j = 0; j < shape.lobe_count; ++j) {
        const burnish_light_lobe *lobe = &lobes->lobe[j];
        shape.lobes[j] = (burnish_kernels_lobe){
            .order = lobe->order, .zeta = lobe->zeta, .weight = lobe->weight};
    }
    if (burnish_area_is_flat(light)) {
        find_corners(light, &shape);
    } else {
        find_ends(light, &shape);
    }
    return burnish_polygon_constants_make(&shape, polygon, NULL) == BURNISH_STATUS_OK;
}
