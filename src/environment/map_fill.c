#include "environment/map_fill.h"

#include <string.h>

#include "base/numbers.h"
#include "core/vec3.h"
#include "environment/area_lights.h"
#include "environment/environment_ops.h"
#include "shading/shading_ops.h"

/* ---- The dome ---- */

/* Adds the dome: its polynomial is a sum of Legendre polynomials, and averaging around a direction
 * multiplies each by a constant. */
static void add_dome(const burnish_light_sources *from, const burnish_light_lobes *lobes,
                     const float *const w[3], int count, float *const rgb[3]) {
    double first = 2.0 / 3, second = 1.0 / 4; /* of the cosine, over pi */
    if (lobes) {
        first = second = 0;
        for (int j = 0; j < lobes->count; ++j) {
            const burnish_light_lobe *l = &lobes->lobe[j];
            const double m = l->order, x = 1 / (double)l->zeta, weight = (double)l->weight;
            first += weight * (1 - x / (m + 2));
            second += weight * (1 - 3 * x / (m + 2) + 3 * x * x / ((m + 2) * (m + 3)));
        }
    }
    const burnish_dome *dome = from->dome;
    const float up[3] = {(float)from->up[0], (float)from->up[1], (float)from->up[2]};
    for (int c = 0; c < 3; ++c) {
        const double zenith = (double)dome->zenith[c], nadir = (double)dome->nadir[c];
        const double horizon = (double)dome->horizon[c], bend = (zenith + nadir) / 2 - horizon;
        const float linear = (float)(first * (zenith - nadir) / 2), square = (float)(second * bend);
        const float constant = (float)(horizon + bend / 3 - second * bend / 3);
        for (int i = 0; i < count; ++i) {
            const float y = (w[0][i] * up[0] + w[1][i] * up[1]) + w[2][i] * up[2];
            rgb[c][i] += constant + y * (linear + y * square);
        }
    }
}

/* ---- The environment ---- */

/* The radius of a cap with the integral of the lobe. */
float burnish_map_lobe_radius(const burnish_light_lobe *lobe) {
    return __builtin_sqrtf(2 / (lobe->zeta * (float)(lobe->order + 1)));
}

/* The smallest image in which a lobe's radius has enough texels: then the result is at most 0.5 % of
 * the brightest one off what the first image gives. A cosine alone gets more: 0.25 %. */
static const burnish_environment_level *choose_level(const burnish_environment *environment,
                                                     const burnish_light_lobe *lobe) {
    const float texels = lobe->order > 1 ? 3 : lobe->zeta > 1 ? 4 : 10;
    const float height = texels * 3.14159265f / burnish_map_lobe_radius(lobe);
    int i = environment->level_count - 1;
    while (i > 0 && (float)environment->levels[i].height < height) {
        --i;
    }
    return &environment->levels[i];
}

/* Sums need lobes with a radius of at least 1.5 pixels, so there are pixels in their caps, and a small
 * image is seen without its pixels. Narrower ones become a mean of such a lobe and of cubic B-splines,
 * whose variance is 1/3 pixel^2, with the variance of the lobe: (m + 1) r^2 / (2 (m + 2)) for the radius
 * r and the order m. Narrowest are the splines. Returns their share, and widens the lobe. */
static float spline_share(const burnish_environment *environment, burnish_light_lobe *lobe) {
    const float pixel = 3.14159265f / (float)environment->levels[0].height;
    const float radius = burnish_map_lobe_radius(lobe) / pixel, m = (float)lobe->order;
    const float scale = (m + 1) / (2 * (m + 2)), splines = 1.0f / 3;
    const float share =
        scale * (2.25f - radius * radius) / (scale * 2.25f - splines); /* of the variance */
    if (radius >= 1.5f) {
        return 0;
    }
    lobe->zeta = 2 / (2.25f * pixel * pixel * (m + 1));
    return share < 1 ? share : 1;
}

static void add_splines(const burnish_environment *environment, float scale,
                        const float *const axis[3], int count, float *const rgb[3]) {
    for (int i = 0; i < count; ++i) {
        const double w[3] = {(double)axis[0][i], (double)axis[1][i], (double)axis[2][i]};
        float color[3];
        burnish_environment_lookup(environment, 0, w, color);
        for (int k = 0; k < 3; ++k) {
            rgb[k][i] += scale * color[k];
        }
    }
}

static void add_environment(const burnish_map_filler *filler, const burnish_light_lobes *lobes,
                            const float *const w[3], int count, float *const rgb[3]) {
    static const burnish_light_lobes cosine = {1, {{1, 1.0f, 1.0f}}};
    const burnish_environment_ops *ops = burnish_environment_ops_for(filler->kernels->isa);
    const burnish_light_sources *sources = &filler->sources;
    const burnish_environment *environment = sources->environment;
    float turned[3][BURNISH_MAP_POINTS];
    const float *const axis[3] = {turned[0], turned[1], turned[2]};
    lobes = lobes ? lobes : &cosine;
    for (int c = 0; c < 3; ++c) {
        const float *const *from = w;
        const double *to = sources->environment_axes[c];
        const float x = (float)to[0], y = (float)to[1], z = (float)to[2];
        for (int i = 0; i < count; ++i) {
            turned[c][i] = (from[0][i] * x + from[1][i] * y) + from[2][i] * z;
        }
    }
    for (int j = 0; j < lobes->count; ++j) {
        burnish_light_lobe lobe = lobes->lobe[j];
        const float share = spline_share(environment, &lobe);
        const float scale = sources->strength * lobe.weight;
        if (share > 0) {
            add_splines(environment, scale * share, axis, count, rgb);
        }
        if (share < 1) {
            const burnish_environment_filter filter = {choose_level(environment, &lobe), lobe.zeta,
                                                       __builtin_ctz((unsigned)lobe.order)};
            ops->filter_environment(&filter, scale * (1 - share), axis, (size_t)count, rgb);
        }
    }
}

/* ---- Polygons ---- */

/* The planes of the edges, for lobes that reach the cosine `lobe` < 1. */
static void find_edges(burnish_map_reach *r, const burnish_polygon_constants *polygon,
                       const burnish_vec3 vertices[], burnish_vec3 middle, double lobe) {
    r->edge_count = polygon->vertex_count;
    r->sine = (float)(burnish_sqrt(1 - lobe * lobe) + 1e-4);
    for (int v = 0; v < r->edge_count; ++v) {
        burnish_vec3 n = burnish_vec3_cross(vertices[v], vertices[(v + 1) % r->edge_count]);
        const double length = burnish_vec3_length(n);
        n = burnish_vec3_scale(n, (burnish_vec3_dot(n, middle) < 0 ? -1 : 1) / length);
        r->edge[v][0] = (float)n.x;
        r->edge[v][1] = (float)n.y;
        r->edge[v][2] = (float)n.z;
    }
    for (int j = 0; j < polygon->lobe_count; ++j) {
        r->all += polygon->lobes[j].weight;
    }
}

/* A cap around a sphere or tube. */
static burnish_map_reach find_round_reach(const burnish_polygon_constants *polygon, double lobe) {
    const burnish_vec3 center = {(double)polygon->center[0], (double)polygon->center[1],
                                 (double)polygon->center[2]};
    const burnish_vec3 middle = burnish_vec3_normalize(center);
    const double sine = (double)polygon->radius / burnish_vec3_length(center);
    const double cosine = sine < 1 ? burnish_sqrt(1 - sine * sine) : -1;
    const double both = cosine * lobe - sine * burnish_sqrt(1 - lobe * lobe);
    const int is_cap = cosine > 0 && cosine + lobe > 0; /* else it may reach all directions */
    return (burnish_map_reach){.middle = {(float)middle.x, (float)middle.y, (float)middle.z},
                               .least = is_cap ? (float)(both - 1e-5) : -2,
                               .sine = 2};
}

/* A cap around the polygon, wider by the widest lobe or, for diffuse light, by a right angle; and
 * the planes of its edges. */
static burnish_map_reach find_reach(const burnish_polygon_constants *polygon,
                                    const burnish_light_lobes *lobes) {
    burnish_vec3 vertices[BURNISH_POLYGON_VERTEX_MAX], middle = {0, 0, 0};
    double radius = 1, lobe = lobes ? 1 : 0; /* cosines */
    for (int j = 0; lobes && j < lobes->count; ++j) {
        const double cosine = 1 - 1 / (double)lobes->lobe[j].zeta;
        lobe = cosine < lobe ? cosine : lobe;
    }
    if (polygon->shape != BURNISH_POLYGON_FLAT) {
        return find_round_reach(polygon, lobe);
    }
    for (int v = 0; v < polygon->vertex_count; ++v) {
        const float *from = polygon->vertex[v];
        const burnish_vec3 vertex = {(double)from[0], (double)from[1], (double)from[2]};
        vertices[v] = burnish_vec3_scale(vertex, 1 / burnish_vec3_length(vertex));
        middle = burnish_vec3_add(middle, vertices[v]);
    }
    middle = burnish_vec3_scale(middle, 1 / burnish_vec3_length(middle));
    for (int v = 0; v < polygon->vertex_count; ++v) {
        const double cosine = burnish_vec3_dot(middle, vertices[v]);
        radius = cosine < radius ? cosine : radius;
    }
    const double sines = burnish_sqrt((1 - radius * radius) * (1 - lobe * lobe));
    const int is_cap = radius > 0 && radius + lobe > 0; /* else it may reach all directions */
    burnish_map_reach r = {.middle = {(float)middle.x, (float)middle.y, (float)middle.z},
                           .least = is_cap ? (float)(radius * lobe - sines - 1e-5) : -2,
                           .sine = 2};
    if (lobes && lobe > 0) {
        find_edges(&r, polygon, vertices, middle, lobe);
    }
    return r;
}

void burnish_map_light_add_polygons(burnish_map_light *to) {
    const burnish_light_sources *from = &to->filler->sources;
    const burnish_light_lobes *lobes = to->lobes.count > 0 ? &to->lobes : NULL;
    for (int i = 0; i < from->distant_count; ++i) {
        burnish_area_light light = from->distant[i];
        burnish_polygon_constants *polygon = &to->polygons[to->polygon_count];
        light.is_distant = 1;
        if (burnish_area_polygon(&light, lobes, polygon)) {
            to->reaches[to->polygon_count] = find_reach(polygon, lobes);
            to->colors[to->polygon_count++] = from->distant[i].color;
        }
    }
}

/* Neighbours, and how far they are from the first one. */
enum { GROUP = BURNISH_MAP_GROUP, GROUPS_MAX = BURNISH_MAP_POINTS / GROUP };

static void find_radii(const float *const w[3], int count, float radii[GROUPS_MAX]) {
    for (int g = 0; g * GROUP < count; ++g) {
        const int first = g * GROUP, end = first + GROUP < count ? GROUP : count - first;
        const float *x = w[0] + first, *y = w[1] + first, *z = w[2] + first;
        int32_t bits[GROUP], most = 0; /* integers, which compilers compare by vectors */
        for (int i = 0; i < end; ++i) {
            const float dx = x[i] - x[0], dy = y[i] - y[0], dz = z[i] - z[0];
            const float squared = dx * dx + dy * dy + dz * dz;
            memcpy(&bits[i], &squared, sizeof squared);
        }
        for (int i = 0; i < end; ++i) {
            most = bits[i] > most ? bits[i] : most;
        }
        float squared;
        memcpy(&squared, &most, sizeof squared);
        radii[g] = __builtin_sqrtf(squared) + 1e-5f;
    }
}

/* How much of a polygon's light some directions receive. */
typedef enum portion { NONE, SOME, ALL } portion;

/* Directions as a polygon sees them: the cosine to its middle, and the least height above its edges. */
typedef struct heights {
    float middle[GROUP], nearest[GROUP];
} heights;

static void find_heights(const burnish_map_reach *r, const float *const w[3], int count,
                         heights *out) {
    const float *x = w[0], *y = w[1], *z = w[2];
    for (int i = 0; i < count; ++i) {
        out->middle[i] = x[i] * r->middle[0] + y[i] * r->middle[1] + z[i] * r->middle[2];
        out->nearest[i] = r->edge_count > 0 ? 1 : 0;
    }
    for (int e = 0; e < r->edge_count; ++e) {
        const float *n = r->edge[e];
        for (int i = 0; i < count; ++i) {
            const float side = x[i] * n[0] + y[i] * n[1] + z[i] * n[2];
            out->nearest[i] = side < out->nearest[i] ? side : out->nearest[i];
        }
    }
}

static portion portion_of(const burnish_map_reach *r, float middle, float nearest, float radius) {
    return middle + radius <= r->least    ? NONE
           : nearest - radius >= r->sine  ? ALL
           : nearest + radius <= -r->sine ? NONE
                                          : SOME;
}

/* Of the directions within a radius of number i. */
static portion portion_within(const burnish_map_reach *r, const float *const w[3], int i,
                              float radius) {
    const float x = w[0][i], y = w[1][i], z = w[2][i];
    const float middle = x * r->middle[0] + y * r->middle[1] + z * r->middle[2];
    float nearest = r->edge_count > 0 ? 1 : 0;
    if (middle + radius <= r->least) {
        return NONE;
    }
    for (int e = 0; e < r->edge_count; ++e) {
        const float *n = r->edge[e], side = x * n[0] + y * n[1] + z * n[2];
        nearest = side < nearest ? side : nearest;
    }
    return portion_of(r, middle, nearest, radius);
}

/* Adds a polygon in `count` directions. */
static void add_polygon(const burnish_map_light *b, int number, const float *const w[3], int count,
                        const float radii[GROUPS_MAX], float *const rgb[3]) {
    const burnish_map_reach *r = &b->reaches[number];
    const float *color = b->colors[number];
    const int is_diffuse = b->lobes.count == 0;
    float reached[3][BURNISH_MAP_POINTS], light[BURNISH_MAP_POINTS];
    int numbers[BURNISH_MAP_POINTS], reached_count = 0;
    for (int first = 0, end; first < count; first = end) {
        const float *const group[3] = {w[0] + first, w[1] + first, w[2] + first};
        heights at;
        end = first + GROUP < count ? first + GROUP : count;
        const portion all = portion_within(r, w, first, radii[first / GROUP]);
        for (int c = 0; c < 3 && all == ALL; ++c) {
            for (int i = first; i < end; ++i) {
                rgb[c][i] += color[c] * r->all;
            }
        }
        if (all != SOME) {
            continue;
        }
        find_heights(r, group, end - first, &at);
        for (int i = first; i < end; ++i) {
            const portion one = portion_of(r, at.middle[i - first], at.nearest[i - first], 0);
            numbers[reached_count] = i;
            reached_count += one == SOME;
            for (int c = 0; c < 3 && one == ALL; ++c) {
                rgb[c][i] += color[c] * r->all;
            }
        }
    }
    for (int c = 0; c < 3; ++c) {
        for (int i = 0; i < reached_count; ++i) {
            reached[c][i] = w[c][numbers[i]];
        }
    }
    if (reached_count == 0) {
        return;
    }
    const burnish_kernels_axes axes = {.axis = {reached[0], reached[1], reached[2]}};
    burnish_kernels_points points = {.normal = {NULL}};
    for (int c = 0; c < 3 && is_diffuse; ++c) {
        points.normal[c] = reached[c];
    }
    b->filler->kernels->polygon_light(
        &b->polygons[number], &points, &axes, (size_t)reached_count,
        (float *const[2]){is_diffuse ? light : NULL, is_diffuse ? NULL : light});
    for (int c = 0; c < 3; ++c) {
        for (int i = 0; i < reached_count; ++i) {
            rgb[c][numbers[i]] += color[c] * light[i];
        }
    }
}

/* ---- All ---- */

void burnish_map_light_add(const burnish_map_light *light, const float *const w[3], int count,
                           float *const rgb[3]) {
    const burnish_light_sources *sources = &light->filler->sources;
    const burnish_light_lobes *lobes = light->lobes.count > 0 ? &light->lobes : NULL;
    float radii[GROUPS_MAX];
    if (sources->dome && light->has_dome) {
        add_dome(sources, lobes, w, count, rgb);
    }
    if (light->polygon_count > 0) {
        find_radii(w, count, radii);
    }
    for (int i = 0; i < light->polygon_count; ++i) {
        add_polygon(light, i, w, count, radii, rgb);
    }
    if (sources->environment && sources->strength > 0 && light->has_environment) {
        add_environment(light->filler, lobes, w, count, rgb);
    }
}

/* ---- The tables of kernels ---- */

#define OPS burnish_environment_ops
#include "simd/isa_table.h"
