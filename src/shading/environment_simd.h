/* Light from many directions: reflections of area lights, domes and environments, as
 * burnish/light.h says, over vectors of points. What arrives from far away comes from maps
 * (light_map.h); what near lights send is handed over. */
#ifndef BURNISH_SHADING_ENVIRONMENT_SIMD_H
#define BURNISH_SHADING_ENVIRONMENT_SIMD_H

#include "shading/shade_simd.h"

/* ---- Maps ---- */

/* A direction in a map of size 1: where it is from the middle, and whether in the second half. */
typedef struct environment_place {
    vf x, y;
    vm second;
} environment_place;

BURNISH_INLINE environment_place environment_find(const vf w[3]) {
    const vf one = vf_set(1.0f),
             magnitude = vf_from_bits(vi_and(vf_bits(w[2]), vi_set(0x7fffffff)));
    const vf d = vf_mul(vf_set(0.5f), vf_div(one, vf_add(one, magnitude)));
    return (environment_place){vf_mul(w[0], d), vf_mul(w[1], d), vf_greater(vf_set(0.0f), w[2])};
}

/* A column or row: the texel before and the share of the next one. A NaN is at 0. */
BURNISH_INLINE vf environment_texel(vf at, vf size, vf *share) {
    const vf half = vf_set(0.5f), middle = vf_mul(vf_add(size, vf_set(1.0f)), half);
    const vf texel = vf_min(vf_max(vf_add(vf_mul(at, size), middle), half), vf_add(size, half));
    const vf before = vf_from_int(vi_truncate(texel));
    *share = vf_sub(texel, before);
    return before;
}

BURNISH_INLINE vf environment_mix(vf a, vf b, vf share) {
    return vf_add(a, vf_mul(share, vf_sub(b, a)));
}

/* The first of the four texels around a direction, as a number from the map's first one, its cell, and
 * the shares of the others. */
typedef struct environment_tap {
    int32_t first[LANES];
    vi cell;
    vf x, y;
} environment_tap;

BURNISH_INLINE environment_tap environment_tap_of(const environment_place *at, vf size,
                                                  vi cells_across) {
    environment_tap tap;
    const vf stride = vf_add(size, vf_set(2.0f)); /* whole numbers are exact, the index too */
    const vf column = environment_texel(at->x, size, &tap.x);
    const vf row = vf_add(environment_texel(at->y, size, &tap.y), vf_and_mask(at->second, stride));
    vi_store(tap.first, vi_truncate(vf_add(vf_mul(row, stride), column)));
    const vi across = vi_shr(vi_truncate(column), BURNISH_LIGHT_CELL_BITS);
    const vi down = vi_shr(vi_truncate(row), BURNISH_LIGHT_CELL_BITS);
    tap.cell = vi_add(vi_mul(down, cells_across), across);
    return tap;
}

BURNISH_INLINE unsigned environment_state(const burnish_light_map *map, int32_t cell) {
    return atomic_load_explicit(&map->states[cell], memory_order_acquire);
}

/* Makes the cells of look-ups in some maps ready. */
__attribute__((noinline)) static void environment_fill(const burnish_light_map *const maps[LANES],
                                                       const int32_t cells[LANES]) {
    for (int lane = 0; lane < LANES; ++lane) {
        const burnish_light_map *map = maps[lane];
        if (map->states && environment_state(map, cells[lane]) != BURNISH_LIGHT_READY) {
            map->fill(map->cells, cells[lane]);
        }
    }
}

BURNISH_INLINE int environment_all_equal(vi x, int32_t number) {
    return vm_bits(vi_equal(x, vi_set(number))) == (1u << LANES) - 1;
}

/* In one map. Most vectors have one cell. */
BURNISH_INLINE void environment_need(const burnish_light_map *map, const environment_tap *tap) {
    unsigned states = BURNISH_LIGHT_READY;
    int32_t cells[LANES];
    if (!map->states) {
        return;
    }
    vi_store(cells, tap->cell);
    const int count = environment_all_equal(tap->cell, cells[0]) ? 1 : LANES;
    for (int lane = 0; lane < count; ++lane) {
        states &= environment_state(map, cells[lane]);
    }
    if (states != BURNISH_LIGHT_READY) {
        const burnish_light_map *maps[LANES];
        for (int lane = 0; lane < LANES; ++lane) {
            maps[lane] = map;
        }
        environment_fill(maps, cells);
    }
}

/* The mean of four texels.
 *   from   the first texel of each lane
 *   below  bytes from there to the texel below */
BURNISH_INLINE void environment_mix_texels(const environment_tap *tap,
                                           const char *const from[LANES], const size_t below[LANES],
                                           vf out[3]) {
    enum { TEXEL = 4 * sizeof(float) };
    const void *at[LANES];
    vf left[4], right[4], upper[3];
    for (int i = 0; i < 2; ++i) {
        for (int lane = 0; lane < LANES; ++lane) {
            at[lane] = from[lane] + (i ? below[lane] : 0);
        }
        vf_load_aos4(at, left);
        for (int lane = 0; lane < LANES; ++lane) {
            at[lane] = from[lane] + (i ? below[lane] : 0) + TEXEL;
        }
        vf_load_aos4(at, right);
        for (int k = 0; k < 3; ++k) {
            const vf mean = environment_mix(left[k], right[k], tap->x);
            out[k] = i ? environment_mix(upper[k], mean, tap->y) : mean;
            upper[k] = mean;
        }
    }
}

/* One map for all lanes. */
BURNISH_INLINE void environment_look_up_one(const burnish_light_map *map,
                                            const environment_place *place, vf out[3]) {
    enum { TEXEL = 4 * sizeof(float) };
    const environment_tap tap = environment_tap_of(place, vf_set((float)map->size),
                                                   vi_set(burnish_light_cells_across(map->size)));
    const char *texels = (const char *)map->texels, *from[LANES];
    const size_t stride = ((size_t)map->size + 2) * TEXEL;
    size_t below[LANES];
    environment_need(map, &tap);
    for (int lane = 0; lane < LANES; ++lane) {
        from[lane] = texels + (size_t)(uint32_t)tap.first[lane] * TEXEL;
        below[lane] = stride;
    }
    environment_mix_texels(&tap, from, below, out);
}

/* A map for each lane. */
BURNISH_INLINE void environment_look_up_each(const burnish_light_map *const maps[LANES],
                                             const environment_place *place, vf out[3]) {
    enum { TEXEL = 4 * sizeof(float) };
    const char *from[LANES];
    float sizes[LANES];
    int32_t across[LANES], cells[LANES];
    size_t below[LANES];
    for (int lane = 0; lane < LANES; ++lane) {
        sizes[lane] = (float)maps[lane]->size;
        across[lane] = burnish_light_cells_across(maps[lane]->size);
    }
    const environment_tap tap = environment_tap_of(place, vf_load(sizes), vi_load(across));
    vi_store(cells, tap.cell);
    environment_fill(maps, cells);
    for (int lane = 0; lane < LANES; ++lane) {
        const burnish_light_map *map = maps[lane];
        from[lane] = (const char *)map->texels + (size_t)(uint32_t)tap.first[lane] * TEXEL;
        below[lane] = ((size_t)map->size + 2) * TEXEL;
    }
    environment_mix_texels(&tap, from, below, out);
}

/* Between the two levels next to each lane's roughness. */
BURNISH_INLINE void environment_look_up_levels(const burnish_light_map *levels, vf roughness,
                                               const environment_place *place, vf out[3]) {
    const vf steps = vf_set((float)(BURNISH_LIGHT_LEVELS - 1));
    const vf at = vf_min(vf_max(vf_mul(roughness, steps), vf_set(0.0f)),
                         vf_set((float)(BURNISH_LIGHT_LEVELS - 1) - 0x1p-10f));
    const vi level = vi_truncate(at);
    const vf share = vf_sub(at, vf_from_int(level));
    int32_t numbers[LANES];
    vi_store(numbers, level);
    const int has_one = environment_all_equal(level, numbers[0]);
    for (int i = 0; i < 2; ++i) {
        const burnish_light_map *maps[LANES];
        vf color[3];
        for (int lane = 0; lane < LANES; ++lane) {
            maps[lane] = &levels[numbers[lane] + i];
        }
        if (has_one) {
            environment_look_up_one(maps[0], place, color);
        } else {
            environment_look_up_each(maps, place, color);
        }
        for (int k = 0; k < 3; ++k) {
            out[k] = i ? environment_mix(out[k], color[k], share) : color[k];
        }
    }
}

/* ---- Points ---- */

/* A vector of points: unit vectors toward the outside and along the lobe's axis. */
typedef struct environment_vectors {
    vf normal[3], axis[3], n_dot_v;
} environment_vectors;

/* bent: burnish_reflecting_points'.
 * is_tilted: the axis is moved toward the normal by alpha^2: rough surfaces reflect less from near
 * the horizon (as three.js does). With nearness it is moved by nearness times where the point is from
 * the object's middle, toward what it meets on a sphere whose radius is 1 / nearness. */
BURNISH_INLINE void environment_load(const burnish_environment_constants *constants,
                                     const burnish_kernels_points *points,
                                     const float *const bent[3], int is_tilted, vf roughness,
                                     size_t i, environment_vectors *at) {
    const vf one = vf_set(1.0f), two = vf_set(2.0f), alpha = vf_mul(roughness, roughness);
    vf viewer[3], mirror[3];
    for (int k = 0; k < 3; ++k) {
        at->normal[k] = vf_load(points->normal[k] + i);
        viewer[k] = vf_set(constants->viewer[k]);
        if (constants->local_viewer) {
            const vf w = points->w ? vf_load(points->w + i) : one;
            viewer[k] = vf_sub(vf_mul(viewer[k], w), vf_load(points->position[k] + i));
        }
    }
    const vf inverse_n = vector_inverse_sqrt(shade_dot(at->normal, at->normal));
    const vf inverse_v = vector_inverse_sqrt(shade_dot(viewer, viewer));
    for (int k = 0; k < 3; ++k) {
        at->normal[k] = vf_mul(at->normal[k], inverse_n);
        viewer[k] = vf_mul(viewer[k], inverse_v);
    }
    at->n_dot_v = shade_dot(at->normal, viewer);
    for (int k = 0; k < 3; ++k) {
        mirror[k] = bent[0] ? vf_load(bent[k] + i) : at->normal[k];
    }
    const vf cosine = bent[0] ? shade_dot(mirror, viewer) : at->n_dot_v;
    for (int k = 0; k < 3; ++k) {
        const vf mirrored = vf_sub(vf_mul(vf_mul(two, cosine), mirror[k]), viewer[k]);
        at->axis[k] = mirrored;
        if (is_tilted) {
            at->axis[k] = environment_mix(mirrored, mirror[k], vf_mul(alpha, alpha));
        }
    }
    for (int k = 0; k < 3 && constants->nearness > 0; ++k) {
        const vf place = vf_mul(vf_load(points->position[k] + i), vf_set(constants->nearness));
        const vf moved = vf_add(at->axis[k], vf_set(constants->offset[k]));
        at->axis[k] = vf_add(points->w ? vf_mul(moved, vf_load(points->w + i)) : moved, place);
    }
    if (is_tilted || constants->nearness > 0) {
        const vf inverse = vector_inverse_sqrt(shade_dot(at->axis, at->axis));
        for (int k = 0; k < 3; ++k) {
            at->axis[k] = vf_mul(at->axis[k], inverse);
        }
    }
}

BURNISH_INLINE void environment_turn(const burnish_environment_constants *constants, vf v[3]) {
    const vf from[3] = {v[0], v[1], v[2]};
    for (int k = 0; k < 3; ++k) {
        v[k] = shade_dot_constant(from, constants->axes[k]);
    }
}

/* A vector of materials. */
typedef struct environment_material {
    vf diffuse[3], reflectance[3], roughness, f90, open;
} environment_material;

BURNISH_INLINE void environment_material_at(const burnish_reflecting_material *material,
                                            const burnish_reflecting_points *each, size_t i,
                                            environment_material *at) {
    at->roughness = each->roughness ? vf_load(each->roughness + i) : vf_set(material->roughness);
    at->f90 = vf_sub(vf_set(1.0f),
                     each->edge_loss ? vf_load(each->edge_loss + i) : vf_set(material->edge_loss));
    at->open = each->open ? vf_load(each->open + i) : vf_set(1.0f);
    for (int k = 0; k < 3; ++k) {
        at->diffuse[k] = vf_set(material->diffuse[k]);
        if (each->diffuse[k]) {
            at->diffuse[k] = vf_mul(at->diffuse[k], vf_load(each->diffuse[k] + i));
        }
        at->reflectance[k] = each->reflectance[k] ? vf_load(each->reflectance[k] + i)
                                                  : vf_set(material->reflectance[k]);
    }
}

BURNISH_INLINE vf environment_polynomial(const float *coefficients, int count, vf x) {
    vf value = vf_set(coefficients[count - 1]);
    for (int i = count - 2; i >= 0; --i) {
        value = vf_add(vf_mul(value, x), vf_set(coefficients[i]));
    }
    return value;
}

/* What GGX (Smith, heights correlated) does not reflect of uniform light if F = 1, and what it
 * reflects if F = (1 - V.H)^5. Fitted to sums over 160,000 visible normals: from N.V = 0.05 on
 * `lost` is within 0.013 (0.007 up to roughness 0.4) and `edge` within 0.015. shaders/burnish.shade
 * has the same. */
BURNISH_INLINE void environment_albedo(vf roughness, vf n_dot_v, vf *lost, vf *edge) {
    static const float widths[4][4] = {{0.0902f, -1.6499f, 16.1298f, -30.1591f},
                                       {-1.2358f, -12.2444f, -3.6416f, 92.1318f},
                                       {23.1922f, -38.3755f, 39.2847f, -135.1644f},
                                       {-21.1263f, 50.4039f, -45.6626f, 73.1733f}};
    static const float falls[3][3] = {
        {0.1829f, 0.2027f, 0.6153f}, {-0.0182f, 0.4253f, -3.192f}, {-0.0746f, -0.7393f, 2.9062f}};
    const vf zero = vf_set(0.0f), one = vf_set(1.0f);
    const vf r = vf_min(vf_max(roughness, zero), one), alpha = vf_mul(r, r);
    const vf x = vf_min(vf_max(n_dot_v, zero), one), fall = vf_sub(one, x);
    const vf wide = vf_add(vf_mul(vf_set(1.5f), alpha), vf_set(0x1p-20f));
    const vf above = vf_div(x, vf_add(x, wide)), below = vf_sub(one, above);
    const vf cubed = vf_mul(vf_mul(fall, fall), fall);
    const vf narrow = vf_add(vf_add(x, vf_set(0.3f)), vf_add(alpha, alpha));
    vf l = zero, e = zero;
    for (int i = 3; i >= 0; --i) {
        l = vf_add(vf_mul(l, below), environment_polynomial(widths[i], 4, r));
    }
    for (int i = 2; i >= 0; --i) {
        e = vf_add(vf_mul(e, cubed), environment_polynomial(falls[i], 3, r));
    }
    *lost = vf_max(vf_mul(vf_mul(l, r), above), zero);
    *edge = vf_max(vf_div(vf_mul(e, cubed), vf_mul(narrow, narrow)), zero);
}

/* Shares of uniform light: what is reflected once, and after that several times (Fdez-Aguera, A
 * Multiple-Scattering Microfacet Model for Real-Time Image Based Lighting, 2019). */
BURNISH_INLINE void environment_reflectance(const environment_material *material, vf n_dot_v,
                                            vf once[3], vf again[3]) {
    const vf one = vf_set(1.0f);
    vf lost, edge;
    environment_albedo(material->roughness, n_dot_v, &lost, &edge);
    const vf most = vf_mul(material->f90, edge);
    for (int k = 0; k < 3; ++k) {
        const vf f = material->reflectance[k];
        const vf mean = vf_add(f, vf_mul(vf_sub(material->f90, f), vf_set(1.0f / 21.0f)));
        const vf back = vf_mul(lost, mean);
        once[k] = vf_add(vf_mul(f, vf_sub(vf_sub(one, lost), edge)), most);
        again[k] = vf_div(vf_mul(once[k], back), vf_sub(one, back));
    }
}

/* kd D + (F0 A + B) Spec, and for metallic-roughness the light of several reflections, kd being
 * what is not reflected; Phong's kd is at most that. Spec's lobes end where GGX's tails go on:
 * these are diffuse light instead, a share of 0.8 roughness^3 (fitted to walks on rough metal under
 * near and distant lights and a window). */
BURNISH_INLINE void environment_color(const environment_material *material, int is_metallic,
                                      const vf once[3], const vf again[3], const vf diffuse[3],
                                      const vf specular[3], vf out[3]) {
    const vf r = material->roughness;
    vf kept = vf_set(1.0f), tail = vf_set(0.0f);
    if (is_metallic) {
        vf most = vf_set(0.0f);
        for (int k = 0; k < 3; ++k) {
            most = vf_max(most, vf_add(once[k], again[k]));
        }
        kept = vf_sub(kept, vf_min(most, kept));
        tail = vf_mul(vf_mul(vf_set(0.8f), r), vf_mul(r, r));
    }
    for (int k = 0; k < 3; ++k) {
        const vf left = vf_sub(vf_set(1.0f), once[k]);
        const vf matt = is_metallic ? vf_add(vf_mul(material->diffuse[k], kept), again[k])
                                    : vf_min(material->diffuse[k], left);
        const vf mirrored = environment_mix(specular[k], diffuse[k], tail);
        out[k] =
            vf_mul(vf_add(vf_mul(matt, diffuse[k]), vf_mul(once[k], mirrored)), material->open);
    }
}

BURNISH_INLINE void environment_add_near(const burnish_reflecting_points *each, size_t i,
                                         vf diffuse[3], vf specular[3]) {
    for (int k = 0; k < 3 && each->near_diffuse[0]; ++k) {
        diffuse[k] = vf_add(diffuse[k], vf_load(each->near_diffuse[k] + i));
        specular[k] = vf_add(specular[k], vf_load(each->near_specular[k] + i));
    }
}

/* has_map: 1: one map of specular light; 0: levels. */
BURNISH_INLINE void environment_vector(const burnish_environment_constants *constants,
                                       const burnish_reflecting_material *material,
                                       const burnish_kernels_points *points,
                                       const burnish_reflecting_points *each, int has_levels,
                                       size_t i, vf color[3]) {
    const vf zero = vf_set(0.0f);
    environment_vectors at;
    environment_material surface;
    vf diffuse[3] = {zero, zero, zero}, specular[3] = {zero, zero, zero};
    vf once[3] = {zero, zero, zero}, again[3] = {zero, zero, zero};
    environment_material_at(material, each, i, &surface);
    environment_load(constants, points, each->bent, material->is_metallic, surface.roughness, i,
                     &at);
    if (constants->diffuse) {
        environment_turn(constants, at.normal);
        const environment_place place = environment_find(at.normal);
        environment_look_up_one(constants->diffuse, &place, diffuse);
    }
    if (constants->diffuse && material->reflects) {
        environment_turn(constants, at.axis);
        const environment_place place = environment_find(at.axis);
        if (has_levels) {
            environment_look_up_levels(material->specular, surface.roughness, &place, specular);
        } else {
            environment_look_up_one(material->specular, &place, specular);
        }
    }
    environment_add_near(each, i, diffuse, specular);
    for (int k = 0; k < 3 && each->clear; ++k) {
        specular[k] =
            vf_add(vf_mul(specular[k], vf_load(each->clear + i)), vf_load(each->mirrored[k] + i));
    }
    if (material->reflects) {
        environment_reflectance(&surface, at.n_dot_v, once, again);
    }
    environment_color(&surface, material->is_metallic, once, again, diffuse, specular, color);
    for (int k = 0; k < 3 && each->clear; ++k) {
        color[k] = vf_add(color[k], vf_mul(surface.reflectance[k], vf_load(each->around[k] + i)));
    }
}

static void add_environment(const burnish_environment_constants *constants,
                            const burnish_reflecting_material *material,
                            const burnish_kernels_points *points,
                            const burnish_reflecting_points *each, size_t count,
                            float *const rgb[3]) {
    const int only_normals = !constants->local_viewer && !(constants->nearness > 0) &&
                             !each->roughness && !each->open && !each->diffuse[0] &&
                             !each->reflectance[0] && !each->near_diffuse[0] && !each->clear;
    vf color[3] = {vf_set(0.0f), vf_set(0.0f), vf_set(0.0f)};
    for (size_t i = 0; i < count; i += LANES) {
        if (i > 0 && only_normals && shade_repeats(points->normal, i)) {
            /* color is that of the vector before */
        } else if (material->has_levels) {
            environment_vector(constants, material, points, each, 1, i, color);
        } else {
            environment_vector(constants, material, points, each, 0, i, color);
        }
        for (int k = 0; k < 3; ++k) { /* a NaN has other bits on other processors */
            vf_store(rgb[k] + i, vf_max(vf_add(vf_load(rgb[k] + i), color[k]), vf_set(0.0f)));
        }
    }
}

static void see_environment(const burnish_environment_constants *constants,
                            const burnish_reflecting_material *material,
                            const float *const direction[3], const float *roughness, size_t count,
                            float *const rgb[3]) {
    for (size_t i = 0; i < count; i += LANES) {
        vf toward[3], color[3];
        for (int k = 0; k < 3; ++k) {
            toward[k] = vf_load(direction[k] + i);
        }
        environment_turn(constants, toward);
        const environment_place place = environment_find(toward);
        if (material->has_levels) {
            environment_look_up_levels(material->specular, vf_load(roughness + i), &place, color);
        } else {
            environment_look_up_one(material->specular, &place, color);
        }
        for (int k = 0; k < 3; ++k) { /* a NaN has other bits on other processors */
            vf_store(rgb[k] + i, vf_max(color[k], vf_set(0.0f)));
        }
    }
}

/* ---- Axes ---- */

/* GGX leans its mirror direction toward N, and is narrower across the plane of N and V: a stretch makes
 * it round. Fitted together with burnish_light_lobes_near(); shaders/burnish.shade has the same. */
BURNISH_INLINE void environment_lean(environment_vectors *at, vf r, vf stretch[3]) {
    const vf one = vf_set(1.0f), x = vf_max(at->n_dot_v, vf_set(0.0f));
    const vf power = vector_power(r, vf_add(vf_set(1.7f), vf_mul(vf_set(3.3f), x)));
    const vf lean = vf_div(vf_mul(vf_mul(power, vf_set(1.1f)), r), vf_add(r, vf_set(0.1f)));
    const vf near_edge = vf_min(vf_max(x, vf_set(0.03f)), one), squared = vf_mul(r, r);
    const vf root = vf_mul(r, vector_inverse_sqrt(vf_max(r, vf_set(0x1p-40f))));
    const vf wider = vf_mul(vf_mul(vf_set(1.5f), squared), root);
    const vf width = vf_add(near_edge, vf_mul(vf_sub(one, near_edge), wider));
    const vf strength = vf_max(vf_sub(vf_div(one, width), one), vf_set(0.0f));
    const vf *n = at->normal, *m = at->axis;
    vf across[3];
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        across[k] = vf_sub(vf_mul(n[i], m[j]), vf_mul(n[j], m[i]));
    }
    const vf inverse = vector_inverse_sqrt(vf_max(shade_dot(across, across), vf_set(1e-12f)));
    const vf size = vf_mul(strength, vector_inverse_sqrt(vf_max(strength, vf_set(0x1p-40f))));
    for (int k = 0; k < 3; ++k) {
        stretch[k] = vf_mul(vf_mul(across[k], inverse), size);
        at->axis[k] = environment_mix(m[k], n[k], lean);
    }
    const vf scale = vector_inverse_sqrt(shade_dot(at->axis, at->axis));
    for (int k = 0; k < 3; ++k) {
        at->axis[k] = vf_mul(at->axis[k], scale);
    }
}

static void reflect_points(const burnish_environment_constants *constants,
                           const burnish_reflecting_material *material,
                           const burnish_kernels_points *points, const float *roughness,
                           size_t count, float *const axis[3], float *const stretch[3]) {
    const float *const none[3] = {NULL, NULL, NULL};
    for (size_t i = 0; i < count; i += LANES) {
        environment_vectors at;
        vf wide[3];
        const vf r = roughness ? vf_load(roughness + i) : vf_set(material->roughness);
        environment_load(constants, points, none, material->is_metallic && !stretch, r, i, &at);
        if (stretch) {
            environment_lean(&at, r, wide);
        }
        for (int k = 0; k < 3; ++k) {
            vf_store(axis[k] + i, at.axis[k]);
            if (stretch) {
                vf_store(stretch[k] + i, wide[k]);
            }
        }
    }
}

#endif
