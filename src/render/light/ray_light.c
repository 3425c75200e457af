#include "render/light/ray_light.h"

#include <string.h>

#include "base/elementary.h"
#include "core/vec3.h"
#include "environment/area_lights.h"

/* A point around which pixels of its own surface weigh less gets all pixels' rays. */
#define FEW 1.0f

/* Farther than points are from one another. */
#define EVERYWHERE 1e6f

/* Alpha of surfaces that mirror edges. */
#define SHARP 0.05f

/* What is seen of light is at least so much where light is divided by it. */
#define LEAST_SEEN 0x1p-10f

/* ---- Directions ---- */

burnish_vec3 burnish_ray_light_direction(int i) {
    enum { EDGE = BURNISH_RAY_LIGHT_EDGE };
    double x = 2.0 * (i % EDGE) / (EDGE - 1) - 1, y = 2.0 * (i / EDGE) / (EDGE - 1) - 1;
    const double across = x < 0 ? -x : x, down = y < 0 ? -y : y, z = 1 - across - down;
    if (z < 0) {
        x = x < 0 ? down - 1 : 1 - down;
        y = y < 0 ? across - 1 : 1 - across;
    }
    return burnish_vec3_normalize((burnish_vec3){x, y, z});
}

/* Number i of Sobol's sequence: of its first 4^k points, one is in each of 2^k x 2^k squares, and so it
 * is of the next. */
static void place_sample(uint32_t i, double *u, double *v) {
    uint32_t first = 0, second = 0, row = 0x80000000u;
    for (int bit = 0; bit < 32; ++bit, row ^= row >> 1) {
        first |= (i >> bit & 1) << (31 - bit);
        second ^= i >> bit & 1 ? row : 0;
    }
    const uint32_t count =
        i < BURNISH_RAY_DIRECTIONS ? BURNISH_RAY_DIRECTIONS : BURNISH_RAY_DIRECTIONS_MAX;
    const double middle = 0.5 / count;
    *u = first * 0x1p-32 + middle;
    *v = second * 0x1p-32 + middle;
}

void burnish_ray_light_prepare(burnish_ray_light *light) {
    for (int i = 0; i < BURNISH_RAY_DIRECTIONS_MAX; ++i) {
        double u, v, sine, cosine;
        place_sample((uint32_t)i, &u, &v);
        burnish_sincos(6.283185307179586 * v, &sine, &cosine);
        const double radius = burnish_sqrt(u);
        light->places[0][i][0] = (float)(2 * u - 1);
        light->places[0][i][1] = (float)(2 * v - 1);
        light->places[1][i][0] = light->directions[i][0] = (float)(radius * cosine);
        light->places[1][i][1] = light->directions[i][1] = (float)(radius * sine);
        light->directions[i][2] = (float)burnish_sqrt(1 - u);
        light->lobe[i][0] = (float)(burnish_sqrt(u / (1 - u)) * cosine);
        light->lobe[i][1] = (float)(burnish_sqrt(u / (1 - u)) * sine);
    }
}

void burnish_ray_light_add(burnish_ray_light *light, const burnish_area_light *from) {
    const double pi = 3.14159265358979;
    burnish_ray_lamp *lamp = &light->lamps[light->lamp_count++];
    const int is_flat = burnish_area_is_flat(from);
    const int is_round = from->shape == BURNISH_AREA_DISC || from->shape == BURNISH_AREA_SPHERE;
    const double luminance = 0.2126 * (double)from->color[0] + 0.7152 * (double)from->color[1] +
                             0.0722 * (double)from->color[2];
    memset(lamp, 0, sizeof *lamp); /* padding, too: the ground compares them */
    lamp->shape = from->shape;
    lamp->is_distant = from->is_distant;
    lamp->is_two_sided = from->is_two_sided || !is_flat;
    lamp->radius = is_flat ? 0 : (float)burnish_area_radius(from);
    lamp->strength = (float)(luminance * (is_round ? pi : 4) / pi);
    for (int k = 0; k < 3; ++k) {
        lamp->center[k] = (float)from->center[k];
        lamp->half[0][k] = (float)from->half_u[k];
        lamp->half[1][k] = (float)from->half_v[k];
    }
}

/* ---- What points see ---- */

/* Adds what pixels around a point found, each of a pattern's weight. Returns the weight of all.
 *   alike  the cosine from which on normals are of one surface; -1: all are, wherever they lie */
static float gather_sums(const burnish_ray_tile *tile, const burnish_ray_light *light, int pixel,
                         const float p[3], const float n[3], float alike,
                         float sums[BURNISH_RAY_SUMS]) {
    static const float tent[5] = {0.5f, 1, 1, 1, 0.5f};     /* each pattern once */
    static const float of_finer[5] = {0, 0.5f, 1, 0.5f, 0}; /* each finer one */
    const int column = burnish_pixel_x(pixel), row = burnish_pixel_y(pixel);
    const int sum_count = burnish_ray_sums(light->lamp_count);
    float all = 0, beside[BURNISH_RAY_LAMPS_MAX][2] = {{0}};
    const int middle = burnish_ray_place(column, row);
    const int is_mirror = tile->rank[middle] > 0 && tile->gloss[middle] < SHARP;
    const float near = alike < 0 ? EVERYWHERE : light->near;
    int own = -1;
    for (int i = 0; i < 25; ++i) {
        const int at = burnish_ray_place(column + i % 5 - 2, row + i / 5 - 2);
        if (tile->rank[at] == 0) {
            continue;
        }
        float height = 0, cosine = 0;
        for (int k = 0; k < 3; ++k) {
            height += (tile->position[k][at] - p[k]) * n[k];
            cosine += tile->normal[k][at] * n[k];
        }
        height = (height < 0 ? -height : height) / near;
        if (height < 1 && cosine > alike) {
            const float weight = tent[i % 5] * tent[i / 5] * (1 - height * height) *
                                 ((cosine - alike) / (1 - alike));
            const int is_glossy = tile->gloss[at] >= 0;
            for (int s = is_glossy ? BURNISH_RAY_SENT : BURNISH_RAY_BOUNCED; s < sum_count; ++s) {
                sums[s] += weight * tile->sums[s][at];
            }
            all += weight;
            own = i == 12 ? at : own;
            const float finer = weight * of_finer[i % 5] * of_finer[i / 5];
            for (int s = 0; s < BURNISH_RAY_SENT && is_glossy; ++s) {
                sums[s] += (is_mirror ? finer : weight) * tile->sums[s][at];
            }
            for (int lamp = 0; lamp < light->lamp_count && finer > 0; ++lamp) {
                beside[lamp][0] += finer * tile->sums[burnish_ray_sums(lamp)][at];
                beside[lamp][1] += finer * tile->sums[burnish_ray_sums(lamp) + 1][at];
            }
        }
    }
    for (int lamp = 0; lamp < light->lamp_count && own >= 0; ++lamp) {
        const int sum = burnish_ray_sums(lamp);
        if (tile->rough[own] >> lamp & 1) { /* the mean would blur an edge */
            sums[sum + 1] = sums[sum] * burnish_ray_share(tile, own, sum);
        } else if (tile->mixed[own] >> lamp & 1 && beside[lamp][0] > 0) {
            sums[sum + 1] = sums[sum] * (beside[lamp][1] / beside[lamp][0]);
        }
    }
    return all;
}

/* What a point sees, from sums of so many pixels' rays. */
static void set_seen(const burnish_ray_light *light, const float sums[BURNISH_RAY_SUMS],
                     float weight, int i, burnish_share_scratch *scratch, float *lit) {
    const float scale = 1 / (weight * BURNISH_RAY_SAMPLES);
    float all = 0, hidden = 0;
    lit[i] = 1;
    for (int lamp = -1; lamp < light->lamp_count; ++lamp) {
        const float *own = sums + burnish_ray_sums(lamp);
        if (lamp >= 0 && lamp == light->key) {
            lit[i] = own[0] > 0 ? 1 - own[1] / own[0] : 1;
        } else {
            all += own[0];
            hidden += own[1];
        }
    }
    scratch->open[0][i] = all > 0 ? 1 - hidden / all : 1;
    const float glossy = sums[BURNISH_RAY_GLOSSY], *sent = sums + BURNISH_RAY_SENT;
    const float part = glossy > 0 ? 1 / glossy : 0;
    /* what is mirrored is multiplied by what is seen of light from everywhere */
    const float open =
        scratch->open[BURNISH_SEEN_LIGHT][i] > LEAST_SEEN ? scratch->open[0][i] : LEAST_SEEN;
    const float metals = glossy > 0 ? sums[BURNISH_RAY_METALS] / glossy : 0;
    const float clear = glossy > 0 ? 1 - part * sums[BURNISH_RAY_MET] : open;
    scratch->open[BURNISH_SEEN_CLEAR][i] = glossy > 0 ? clear / open : 1;
    for (int k = 0; k < 3; ++k) {
        const float mirrored = sent[3 + k] > 0 ? part * (sent[k] / sent[3 + k]) : 0;
        scratch->open[BURNISH_SEEN_MIRRORED + k][i] =
            mirrored * light->tint[k] * sums[BURNISH_RAY_MIRRORED + k] / open;
        scratch->open[BURNISH_SEEN_AROUND + k][i] =
            metals * light->ambient[k] * (clear - open) / open;
        scratch->open[BURNISH_SEEN_BOUNCED + k][i] =
            scale * light->tint[k] * sums[BURNISH_RAY_BOUNCED + k];
    }
}

void burnish_ray_tile_look(const burnish_ray_tile *tile, const burnish_ray_light *light,
                           const burnish_render_ops *ops, const burnish_share_points *points,
                           int count, burnish_share_scratch *scratch, float *lit) {
    burnish_share_prepare(ops, points, count, scratch);
    for (int i = 0; i < count; ++i) {
        const int pixel = points->pixels ? points->pixels[i] : points->first_pixel + i;
        float p[3], n[3], sums[BURNISH_RAY_SUMS] = {0}, weight = 0;
        for (int k = 0; k < BURNISH_SEEN_VALUES; ++k) {
            scratch->open[k][i] = k == BURNISH_SEEN_LIGHT || k == BURNISH_SEEN_CLEAR;
        }
        lit[i] = 1;
        for (int k = 0; k < 3; ++k) {
            p[k] = scratch->position[k][i];
            n[k] = scratch->normal[k][i];
        }
        if (!points->shown || points->shown[i] >= 0) {
            weight = gather_sums(tile, light, pixel, p, n, BURNISH_RAY_ALIKE, sums);
        }
        if (weight < FEW && !points->are_layers && (!points->shown || points->shown[i] >= 0)) {
            weight += gather_sums(tile, light, pixel, p, n, -1, sums);
        }
        if (weight > 0) {
            set_seen(light, sums, weight, i, scratch, lit);
        }
    }
}
