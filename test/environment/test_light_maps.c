/* Maps of light against formulas and sums over many directions. */
#include "environment/light_maps.h"

#include <math.h>

#include "environment/area_lights.h"
#include "support.h"
#include "vec.h"

enum { RINGS = 400 };

static const burnish_dome dome = {{1, 2, 3}, {0.5f, 0.25f, 1}, {0.125f, 0.5f, 0}, 0};
static const burnish_area_light softbox = {
    BURNISH_AREA_RECT, 1, 0, 0, {1, 2, 2.5}, {0.8, 0, 0}, {0, -0.6, 0.3}, {4, 2, 1}};
static const burnish_area_light disc = {BURNISH_AREA_DISC, 1,        0, 1, {-3, 0.5, -1}, {0, 1, 0},
                                        {0.2, 0, 0.9},     {1, 2, 4}};

/* The bilinear look-up that light_map.h describes. */
static double look_up(const burnish_light_map *map, int channel, const double w[3]) {
    const double d = 1 / (1 + fabs(w[2]));
    const double x = w[0] * d * map->size / 2 + (map->size + 1) / 2.0;
    const double y = w[1] * d * map->size / 2 + (map->size + 1) / 2.0;
    const int i = (int)x, stride = map->size + 2, j = (int)y + (w[2] < 0 ? stride : 0);
    const float *t = map->texels + 4 * (j * stride + i) + channel;
    burnish_light_map_need(map, j, i);
    const double top = (double)t[0] + (x - i) * ((double)t[4] - (double)t[0]);
    const double low =
        (double)t[4 * stride] + (x - i) * ((double)t[4 * stride + 4] - (double)t[4 * stride]);
    return top + (y - (int)y) * (low - top);
}

/* Whether direction w from the origin meets the light's shining side. */
static int meets(const burnish_area_light *light, const double w[3]) {
    const double *u = light->half_u, *v = light->half_v, *c = light->center;
    double n[3];
    cross(u, v, n);
    const double t = dot(n, c) / dot(n, w);
    if (!(t > 0) || (!light->is_two_sided && dot(n, w) > 0)) {
        return 0;
    }
    const double d[3] = {t * w[0] - c[0], t * w[1] - c[1], t * w[2] - c[2]};
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), det = uu * vv - uv * uv;
    const double a = (dot(d, u) * vv - dot(d, v) * uv) / det;
    const double b = (dot(d, v) * uu - dot(d, u) * uv) / det;
    return light->shape == BURNISH_AREA_RECT ? fabs(a) <= 1 && fabs(b) <= 1 : a * a + b * b <= 1;
}

/* Radiance of all sources. */
static double radiance(const burnish_light_sources *s, int k, const double w[3]) {
    double sum = 0;
    for (int i = 0; i < s->distant_count; ++i) {
        sum += meets(&s->distant[i], w) ? (double)s->distant[i].color[k] : 0;
    }
    if (s->dome) {
        const double y = dot(w, s->up), zenith = (double)s->dome->zenith[k];
        const double nadir = (double)s->dome->nadir[k], horizon = (double)s->dome->horizon[k];
        sum += horizon + y * (zenith - nadir) / 2 + y * y * ((zenith + nadir) / 2 - horizon);
    }
    return sum;
}

static double weigh(const burnish_light_lobes *lobes, double c) {
    double sum = 0;
    for (int j = 0; lobes && j < lobes->count; ++j) {
        const double zeta = (double)lobes->lobe[j].zeta, u = 1 + zeta * (c - 1);
        sum += u > 0 ? (double)lobes->lobe[j].weight * zeta * (lobes->lobe[j].order + 1) *
                           pow(u, lobes->lobe[j].order)
                     : 0;
    }
    return lobes ? sum : c > 0 ? 2 * c : 0;
}

/* The mean of the radiance around w: rings of constant c around it. */
static void mean(const burnish_light_sources *sources, const burnish_light_lobes *lobes,
                 const double w[3], double rgb[3]) {
    const double other[3] = {fabs(w[0]) < 0.5, fabs(w[0]) >= 0.5, 0};
    double x[3], y[3];
    cross(w, other, x);
    normalize(x);
    cross(w, x, y);
    rgb[0] = rgb[1] = rgb[2] = 0;
    double span = lobes ? 0 : 1; /* of c, where the weight is above 0 */
    for (int j = 0; lobes && j < lobes->count; ++j) {
        span = fmax(span, fmin(1 / (double)lobes->lobe[j].zeta, 2));
    }
    for (int i = 0; i < RINGS; ++i) {
        const double c = 1 - span * (i + 0.5) / RINGS, r = sqrt(1 - c * c),
                     weight = weigh(lobes, c);
        for (int j = 0; weight > 0 && j < RINGS; ++j) {
            const double a = 2 * M_PI * (j + 0.5) / RINGS;
            double d[3];
            for (int k = 0; k < 3; ++k) {
                d[k] = c * w[k] + r * (cos(a) * x[k] + sin(a) * y[k]);
            }
            for (int k = 0; k < 3; ++k) {
                rgb[k] += weight * radiance(sources, k, d) * span / RINGS / RINGS;
            }
        }
    }
}

static burnish_light_maps *maps_of(const burnish_light_sources *sources) {
    burnish_light_maps *maps;
    CHECK1(burnish_light_maps_create(NULL, &maps, NULL) == BURNISH_STATUS_OK);
    CHECK1(burnish_light_maps_set(maps, sources, NULL, NULL) == BURNISH_STATUS_OK);
    return maps;
}

static double drawn(void) {
    return rand() / (RAND_MAX + 1.0);
}

/* At texels, and the largest error between them. */
static void compare(const burnish_light_sources *sources, const burnish_light_lobes *lobes,
                    const burnish_light_map *map, double at_texels, double between) {
    double worst[2] = {0, 0};
    for (int i = 0; i < 60; ++i) {
        double p = 2 * drawn() - 1, q = 2 * drawn() - 1;
        if (i % 2) { /* texels */
            p = (2 * floor((p + 1) / 2 * map->size) + 1) / map->size - 1;
            q = (2 * floor((q + 1) / 2 * map->size) + 1) / map->size - 1;
        }
        const double s = 1 / (1 + p * p + q * q);
        const double w[3] = {2 * p * s, 2 * q * s, (i % 4 < 2 ? 1 : -1) * (2 * s - 1)};
        if (p * p + q * q > 1) {
            continue;
        }
        double expected[3];
        mean(sources, lobes, w, expected);
        for (int k = 0; k < 3; ++k) {
            worst[!(i % 2)] = fmax(worst[!(i % 2)], fabs(look_up(map, k, w) - expected[k]));
        }
    }
    CHECK(worst[0] <= at_texels, "error %.2g at texels", worst[0]);
    CHECK(worst[1] <= between, "error %.2g between texels", worst[1]);
    printf("  size %d: error %.2g at texels, %.2g between\n", map->size, worst[0], worst[1]);
}

/* bounds: of the diffuse map at texels and between, and of the specular ones. */
static void check_sources(const burnish_light_sources *sources, const double bounds[4]) {
    burnish_light_maps *maps = maps_of(sources);
    burnish_light_map map;
    compare(sources, NULL, burnish_light_maps_diffuse(maps), bounds[0], bounds[1]);
    for (float alpha = 0.1f; alpha < 1; alpha += 0.3f) {
        const burnish_light_lobes lobes = burnish_light_lobes_for(alpha);
        CHECK1(burnish_light_maps_need(maps, alpha, &map, NULL) == BURNISH_STATUS_OK);
        compare(sources, &lobes, &map, bounds[2], bounds[3]);
    }
    burnish_light_maps_destroy(maps);
}

static void test_sources(void) {
    const burnish_area_light lights[2] = {softbox, disc};
    const burnish_light_sources sky = {.dome = &dome, .up = {0.6, 0, 0.8}};
    const burnish_light_sources areas = {.distant = lights, .distant_count = 2};
    check_sources(&sky, (const double[4]){3e-5, 3e-3, 3e-4, 1e-2});
    check_sources(&areas, (const double[4]){2e-3, 3e-3, 6e-3, 6e-3});
}

/* ---- Sharpness ---- */

/* Degrees in which a mirror's light rises from 0.1 to 0.9 along an arc across an edge at azimuth 0. */
static double edge_width(const burnish_light_sources *sources, double tilt) {
    burnish_light_maps *maps = maps_of(sources);
    burnish_light_map map;
    double begin = 0, end = 0;
    CHECK1(burnish_light_maps_need(maps, 0, &map, NULL) == BURNISH_STATUS_OK);
    for (double degrees = -8; degrees < 8; degrees += 0.01) {
        const double a = degrees * M_PI / 180;
        double w[3] = {cos(a), sin(a) * sin(tilt), sin(a) * cos(tilt)};
        const double light = look_up(&map, 0, w);
        begin = light < 0.1 ? degrees : begin;
        end = light < 0.9 ? degrees : end;
    }
    burnish_light_maps_destroy(maps);
    return end - begin;
}

/* An image whose half is white. */
static burnish_environment *make_halves(int columns) {
    burnish_environment *environment = NULL;
    float *rgb = malloc(3 * sizeof *rgb * (size_t)columns * (size_t)columns / 2);
    for (int i = 0; i < 3 * columns * columns / 2; ++i) {
        rgb[i] = i / 3 % columns >= columns / 2;
    }
    CHECK1(burnish_environment_create(NULL, columns, columns / 2, rgb, &environment, NULL) ==
           BURNISH_STATUS_OK);
    free(rgb);
    return environment;
}

/* Across an edge of a softbox and of images. Their pixels are 360 degrees over the columns, and a cubic
 * B-spline rises in 1.7 pixels. */
static void test_sharpness(void) {
    static const struct {
        int largest, columns;
        double most;
    } rows[] = {{256, 0, 4.8},  {512, 0, 1.9},    {1024, 0, 1},   {64, 128, 6},
                {1024, 128, 5}, {1024, 512, 1.3}, {1024, 1024, 1}};
    const burnish_area_light half = {BURNISH_AREA_RECT, 1,         0,         1,
                                     {1, 0, 1},         {0, 0, 1}, {0, 2, 0}, {1, 1, 1}};
    for (int i = 0; i < (int)(sizeof rows / sizeof *rows); ++i) {
        burnish_light_sources sources = {.strength = 1,
                                         .environment_axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                         .largest = rows[i].largest};
        burnish_environment *environment = rows[i].columns ? make_halves(rows[i].columns) : NULL;
        sources.distant = &half;
        sources.distant_count = environment == NULL;
        sources.environment = environment;
        const double width = edge_width(&sources, 0.3);
        printf("  %d texels, %d columns: %.2f degrees\n", rows[i].largest, rows[i].columns, width);
        CHECK(width > 0.1 && width < rows[i].most, "%d texels, %d columns: %g degrees",
              rows[i].largest, rows[i].columns, width);
        burnish_environment_destroy(environment);
    }
}

/* Maps are kept until a source changes. */
static void test_keys(void) {
    burnish_area_light light = softbox;
    burnish_light_sources sources = {.distant = &light, .distant_count = 1};
    burnish_light_maps *maps = maps_of(&sources);
    burnish_light_map first, second, levels[BURNISH_LIGHT_LEVELS];
    CHECK1(burnish_light_maps_need(maps, 0.5f, &first, NULL) == BURNISH_STATUS_OK);
    light.follows_camera = 1; /* is not read */
    CHECK1(burnish_light_maps_set(maps, &sources, NULL, NULL) == BURNISH_STATUS_OK);
    CHECK1(burnish_light_maps_need(maps, 0.5f, &second, NULL) == BURNISH_STATUS_OK);
    CHECK1(first.texels == second.texels);
    burnish_light_map_need(&first, 20, 20);
    const float before = first.texels[4 * (20 * (first.size + 2) + 20)];
    light.color[0] *= 2;
    CHECK1(burnish_light_maps_set(maps, &sources, NULL, NULL) == BURNISH_STATUS_OK);
    CHECK1(burnish_light_maps_need(maps, 0.5f, &second, NULL) == BURNISH_STATUS_OK);
    burnish_light_map_need(&second, 20, 20);
    CHECK1(second.texels[4 * (20 * (second.size + 2) + 20)] == 2 * before);
    for (int i = 1; i < BURNISH_LIGHT_ALPHAS_MAX; ++i) {
        CHECK1(burnish_light_maps_need(maps, 0.5f + 0.03f * (float)i, &second, NULL) ==
               BURNISH_STATUS_OK);
    }
    CHECK1(burnish_light_maps_need(maps, 0.99f, &second, NULL) == BURNISH_STATUS_LIMIT);
    CHECK1(burnish_light_maps_levels(maps, 0, levels, NULL) == BURNISH_STATUS_OK);
    CHECK1(levels[0].texels == levels[1].texels);
    CHECK1(burnish_light_maps_set(maps, &sources, NULL, NULL) == BURNISH_STATUS_OK);
    CHECK1(burnish_light_maps_need(maps, 0.5f, &first, NULL) == BURNISH_STATUS_OK);
    CHECK1(burnish_light_maps_need(maps, 0.99f, &second, NULL) == BURNISH_STATUS_OK);
    CHECK1(first.texels != second.texels);
    burnish_light_maps_destroy(maps);
}

static void test_axes(void) {
    static const double ups[][3] = {{0, 1, 0}, {0, 0, 5}, {0, -2, 0}, {1, 2, -3}};
    for (int i = 0; i < 4; ++i) {
        double a[3][3];
        burnish_light_axes(ups[i], 30, a);
        for (int j = 0; j < 9; ++j) {
            CHECK1(fabs(dot(a[j / 3], a[j % 3]) - (j % 4 == 0)) < 1e-12);
        }
        CHECK1(fabs(dot(a[1], ups[i]) - sqrt(dot(ups[i], ups[i]))) < 1e-12);
        double z[3];
        cross(a[0], a[1], z);
        CHECK1(dot(a[2], z) > 0.999999);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_sources());
    RUN(test_sharpness());
    RUN(test_keys());
    RUN(test_axes());
    return test_end("light_maps");
}
