/* A tile's points, and the rays that they cast. */
#include <string.h>

#include "core/srgb.h"
#include "core/vec3.h"
#include "render/light/ray_light.h"
#include "render/space.h"

/* Shares of a lamp that are hidden from neighbouring pixels differ by less, except at a sharp edge. */
#define LEAST_STEP 0.15f

/* Patterns of rays where one is not enough. */
enum { MORE_PATTERNS = 4 };

/* Longer than the way from the camera through the mesh. */
#define FAR 1e6f

/* Of the mean light, what surfaces get that no rays are cast from. */
#define LAST_LIGHT 0.25f

/* Metals reflect more along their normal. */
#define METAL 0.2f

/* Smoother surfaces mirror others, whatever they reflect. */
#define SMOOTH 0.35f

/* ---- A tile ---- */

/* The normal of a triangle, on the side of another one; that one if it has no area. */
static burnish_vec3 face_of(const burnish_mesh_view *mesh, uint32_t triangle, burnish_vec3 normal) {
    burnish_vec3 corner[3];
    if (triangle / 2 >= mesh->triangle_count) {
        return normal;
    }
    for (size_t k = 0; k < 3; ++k) {
        const size_t vertex = mesh->indices[3 * (size_t)(triangle / 2) + k];
        corner[k] = burnish_vec3_loadf(mesh->positions + 3 * vertex);
    }
    const burnish_vec3 face = burnish_vec3_cross(burnish_vec3_sub(corner[1], corner[0]),
                                                 burnish_vec3_sub(corner[2], corner[0]));
    const double length = burnish_vec3_length(face), side = burnish_vec3_dot(face, normal);
    return length > 0 ? burnish_vec3_scale(face, (side < 0 ? -1 : 1) / length) : normal;
}

/* The alpha of GGX by which a surface mirrors others, for the camera or for another surface; below 0: it
 * does not. */
static float gloss_of(const burnish_ray_light *light, size_t material, int is_first) {
    float most = 0;
    if (!light->reflecting || !light->reflecting[material].reflecting.reflects) {
        return -1;
    }
    const burnish_reflecting_material *reflecting = &light->reflecting[material].reflecting;
    for (int k = 0; k < 3; ++k) {
        most = reflecting->reflectance[k] > most ? reflecting->reflectance[k] : most;
    }
    const int is_glossy = most > METAL || (is_first && reflecting->roughness < SMOOTH);
    return is_glossy ? reflecting->roughness * reflecting->roughness : -1;
}

void burnish_ray_tile_add(burnish_ray_tile *tile, const burnish_ray_light *light, int at,
                          uint16_t rank, const float position[3], const float normal[3],
                          uint32_t triangle) {
    if (rank <= tile->rank[at]) {
        return;
    }
    const burnish_vec3 along = burnish_vec3_loadf(normal);
    const double length = burnish_vec3_length(along);
    const burnish_vec3 unit = length > 0 ? burnish_vec3_scale(along, 1 / length) : along;
    const burnish_vec3 face = face_of(light->mesh, triangle, unit);
    const float of_normal[3] = {(float)unit.x, (float)unit.y, (float)unit.z};
    const float of_face[3] = {(float)face.x, (float)face.y, (float)face.z};
    const size_t number = triangle / 2;
    const int is_known = number < light->mesh->triangle_count;
    tile->rank[at] = rank;
    tile->gloss[at] = -1;
    if (is_known) {
        const uint16_t *materials = light->mesh->triangle_materials;
        tile->gloss[at] = gloss_of(light, materials ? materials[number] : 0, 1);
    }
    for (int k = 0; k < 3; ++k) {
        tile->position[k][at] = position[k];
        tile->normal[k][at] = of_normal[k];
        tile->face[k][at] = of_face[k];
    }
}

static void store_lane(burnish_vec3 v, float (*to)[BURNISH_OCCLUDED_MAX], size_t i) {
    to[0][i] = (float)v.x;
    to[1][i] = (float)v.y;
    to[2][i] = (float)v.z;
}

/* The normal of the mesh where a ray meets one of its triangles, on the side of the face that it meets.
 */
static burnish_vec3 met_normal(const burnish_ray_light *light, size_t triangle, burnish_vec3 point,
                               burnish_vec3 face) {
    const burnish_mesh_view *mesh = light->solid;
    const burnish_vec3 center = burnish_vec3_loadf(light->center);
    burnish_vec3 corner[3], normal = {0, 0, 0};
    for (size_t k = 0; k < 3; ++k) {
        const float *at = mesh->positions + 3 * (size_t)mesh->indices[3 * triangle + k];
        corner[k] = burnish_vec3_sub(
            burnish_vec3_scale(burnish_vec3_sub(burnish_vec3_loadf(at), center), light->scale),
            point);
    }
    for (size_t k = 0; k < 3; ++k) { /* by the areas of what lies across from the corners */
        const size_t vertex = mesh->indices[3 * triangle + k];
        const double part =
            burnish_vec3_dot(burnish_vec3_cross(corner[(k + 1) % 3], corner[(k + 2) % 3]), face);
        normal = burnish_vec3_add(
            normal, burnish_vec3_scale(burnish_vec3_loadf(mesh->normals + 3 * vertex), part));
    }
    /* parts are below 0 where the face is seen from behind, as the normals are to be turned */
    return burnish_vec3_normalize(normal);
}

/* Where ray i meets a triangle, from the eye, and the normal there, if it is wanted. Returns the
 * triangle's. */
static burnish_vec3 find_met(const burnish_started_rays *rays, const burnish_ray_light *light,
                             size_t i, float position[3], float *normal) {
    const uint32_t number = light->tree->numbers[rays->place[i]];
    const burnish_vec3 along = {rays->direction[0][i], rays->direction[1][i],
                                rays->direction[2][i]};
    const burnish_vec3 from = {rays->origin[0][i], rays->origin[1][i], rays->origin[2][i]};
    const burnish_vec3 point = burnish_vec3_add(from, burnish_vec3_scale(along, rays->distance[i]));
    const burnish_vec3 face = face_of(light->solid, 2 * number, burnish_vec3_scale(along, -1));
    burnish_space_store(burnish_vec3_sub(point, burnish_vec3_loadf(light->eye)), position);
    if (normal) {
        const int is_known = number < light->solid->triangle_count;
        burnish_space_store(is_known ? met_normal(light, number, point, face) : face, normal);
    }
    return face;
}

/* Casts the rays of count pixels that are known by them alone, and adds what they show. */
static void find_points(burnish_ray_tile *tile, const burnish_ray_light *light, const uint16_t *at,
                        size_t count) {
    burnish_started_rays *rays = &tile->rays;
    for (int k = 0; k < 3; ++k) {
        rays->batch.origin[k] = rays->origin[k];
        rays->batch.direction[k] = rays->direction[k];
    }
    rays->batch.reach = rays->reach;
    rays->batch.count = count;
    light->ops->find_hits(light->tree, &rays->batch, rays->hits, rays->distance, rays->place);
    for (size_t i = 0; i < count; ++i) {
        const uint32_t number =
            rays->hits[i] > 0 ? light->tree->numbers[rays->place[i]] : UINT32_MAX;
        if (number < light->solid->triangle_count) {
            float p[3], n[3];
            find_met(rays, light, i, p, n);
            burnish_ray_tile_add(tile, light, at[i], UINT16_MAX, p, n, 2 * number);
        }
    }
}

/* From the eye, what is seen at (x, y) at a depth, as burnish_rays says. */
static burnish_vec3 seen_at(const burnish_rays *rays, double x, double y, double depth) {
    const double q = depth * (double)rays->q_per_depth + (double)rays->q_constant;
    double at[3];
    for (int k = 0; k < 3; ++k) {
        at[k] = ((double)rays->ray[k] + x * (double)rays->ray_x[k] + y * (double)rays->ray_y[k] +
                 (1 - depth) * (double)rays->ray_depth[k]) /
                q;
    }
    return burnish_vec3_load(at);
}

void burnish_ray_tile_add_margin(burnish_ray_tile *tile, const burnish_ray_light *light,
                                 const burnish_rays *from, const burnish_tile *place, int width,
                                 int height) {
    enum { EDGE = BURNISH_RAY_EDGE, MARGIN = BURNISH_RAY_MARGIN, SIZE = BURNISH_TILE_SIZE };
    const burnish_vec3 eye = burnish_vec3_loadf(light->eye);
    burnish_started_rays *rays = &tile->rays;
    uint16_t at[BURNISH_OCCLUDED_MAX];
    size_t count = 0;
    for (int i = 0; i < BURNISH_RAY_PIXELS; ++i) {
        const int column = i % EDGE - MARGIN, row = i / EDGE - MARGIN;
        const int x = place->x + column, y = place->y + row;
        const int is_own = column >= 0 && row >= 0 && column < SIZE && row < SIZE;
        if (!is_own && x >= 0 && y >= 0 && x < width && y < height) {
            const double right = x + 0.5 - width * 0.5, up = height * 0.5 - y - 0.5;
            const burnish_vec3 start = seen_at(from, right, up, 1);
            const burnish_vec3 along =
                burnish_vec3_normalize(burnish_vec3_sub(seen_at(from, right, up, 0.5), start));
            store_lane(burnish_vec3_add(start, eye), rays->origin, count);
            store_lane(along, rays->direction, count);
            rays->reach[count] = FAR;
            at[count++] = (uint16_t)i;
        }
        if (count == BURNISH_OCCLUDED_MAX || (i + 1 == BURNISH_RAY_PIXELS && count > 0)) {
            memset(rays->reach + count, 0, (BURNISH_OCCLUDED_MAX - count) * sizeof *rays->reach);
            find_points(tile, light, at, count);
            count = 0;
        }
    }
}

static burnish_ray_points ray_points(burnish_gathered_points *points) {
    float(*const values)[BURNISH_OCCLUDED_MAX + 16] = points->values;
    for (int k = 0; k < BURNISH_RAY_VALUES; ++k) {
        memset(values[k] + points->count, 0, 16 * sizeof *values[k]);
    }
    return (burnish_ray_points){
        {values[0], values[1], values[2]},
        {values[3], values[4], values[5]},
        {values[6], values[7], values[8]},
        points->has_gloss ? values[BURNISH_RAY_GLOSS] : NULL,
        {values[BURNISH_RAY_BACK], values[BURNISH_RAY_BACK + 1], values[BURNISH_RAY_BACK + 2]},
        points->count};
}

/* Rays to a lamp. */
static void cast_rays(burnish_gathered_points *points, const burnish_ray_light *light,
                      const burnish_render_ops *ops, int lamp, int first, int count) {
    const burnish_ray_points cast = ray_points(points);
    float *const sums[3] = {points->sums[0], points->sums[1], points->sums[2]};
    ops->sample_lamp(light, lamp, &cast, first, count, sums);
}

/* ---- Light that comes over other surfaces ---- */

/* What the surface of a triangle of the mesh reflects. Pieces of masked ones are gray. Returns its
 * gloss: matt surfaces see all as matt, for few rays find what others mirror. */
static float albedo_of(const burnish_ray_light *light, size_t triangle, int is_mirrored,
                       float albedo[3]) {
    const burnish_mesh_view *mesh = light->solid;
    if (triangle >= mesh->triangle_count) {
        albedo[0] = albedo[1] = albedo[2] = 0.5f;
        return -1;
    }
    const size_t material = mesh->triangle_materials ? mesh->triangle_materials[triangle] : 0;
    const float gloss = is_mirrored ? gloss_of(light, material, 0) : -1;
    for (size_t k = 0; k < 3; ++k) {
        float sum = light->has_colors ? 0 : 3;
        for (size_t corner = 0; corner < 3 && light->has_colors; ++corner) {
            const size_t vertex = mesh->indices[3 * triangle + corner];
            sum += burnish_srgb_to_linear[mesh->colors[4 * vertex + k]];
        }
        albedo[k] = sum / 3 *
                    (gloss < 0 ? light->shaders[material].albedo[k]
                               : light->reflecting[material].reflecting.reflectance[k]);
    }
    return gloss;
}

/* Brings the points together that rays have met. */
static void gather_met(const burnish_started_rays *rays, const burnish_ray_light *light,
                       const burnish_gathered_points *points, burnish_gathered_points *met) {
    met->count = met->has_gloss = 0;
    for (size_t i = 0; i < points->count; ++i) {
        float position[3], normal[3], albedo[3];
        if (!(rays->hits[i] > 0)) {
            continue;
        }
        const size_t to = met->count++;
        const int is_smooth = points->values[BURNISH_RAY_GLOSS][i] >= 0;
        const float gloss =
            albedo_of(light, light->tree->numbers[rays->place[i]], is_smooth, albedo);
        const burnish_vec3 face = find_met(rays, light, i, position, is_smooth ? normal : NULL);
        const float of_face[3] = {(float)face.x, (float)face.y, (float)face.z};
        for (int k = 0; k < 3; ++k) {
            met->values[k][to] = position[k];
            met->values[3 + k][to] = is_smooth ? normal[k] : of_face[k];
            met->values[6 + k][to] = of_face[k];
            met->values[BURNISH_RAY_BACK + k][to] = -rays->direction[k][i];
            met->albedo[k][to] = albedo[k];
        }
        met->values[BURNISH_RAY_GLOSS][to] = gloss;
        met->has_gloss |= gloss >= 0;
        met->from[to] = (uint16_t)i;
    }
}

/* The sample of a bounce that goes with a sample: another order of the same, whose halves are in
 * quarters of what was chosen last. */
static int bounced_sample(int sample, int turn) {
    int turned = 0;
    for (int bit = 0; bit < 6; ++bit) {
        turned |= (sample >> bit & 1) << (turn + 5 - bit) % 6;
    }
    return turned;
}

/* Adds to `light` of points what one ray of each brings over other surfaces: to the sky, or mirrored.
 * The kernel's sums are of it. */
static void cast_sky(burnish_ray_tile *tile, burnish_gathered_points *points,
                     const burnish_ray_light *light, const burnish_render_ops *ops, int sample,
                     int bounce) {
    const burnish_ray_points cast = ray_points(points);
    float *const sums[3] = {points->sums[0], points->sums[1], points->sums[2]};
    burnish_gathered_points *met = &tile->met[bounce];
    ops->sample_sky(light, &cast, sample, 1, &tile->rays, sums);
    if (bounce == BURNISH_RAY_BOUNCES) {
        for (size_t i = 0; i < 3 * points->count; ++i) {
            points->light[i % 3][i / 3] += tile->rays.hits[i / 3] * (LAST_LIGHT * light->mean);
        }
        return;
    }
    gather_met(&tile->rays, light, points, met);
    memset(met->light, 0, sizeof met->light);
    memset(met->met, 0, sizeof met->met);
    for (int lamp = -1; lamp < light->lamp_count && met->count > 0; ++lamp) {
        if (lamp < 0) {
            cast_sky(tile, met, light, ops, bounced_sample(sample, bounce), bounce + 1);
        } else {
            cast_rays(met, light, ops, lamp, bounced_sample(sample, bounce + 3), 1);
        }
        for (size_t i = 0; i < met->count; ++i) {
            const int is_lit = lamp < 0 || met->values[BURNISH_RAY_GLOSS][i] < 0;
            for (int k = 0; k < 3 && is_lit; ++k) {
                met->light[k][i] += met->sums[1][i] - met->sums[2][i];
            }
        }
    }
    for (size_t i = 0; i < 3 * met->count; ++i) {
        const float albedo = met->albedo[i % 3][i / 3];
        points->light[i % 3][met->from[i / 3]] += albedo * met->light[i % 3][i / 3];
        points->met[i % 3][met->from[i / 3]] += albedo;
    }
}

/* The rays of points to the sky, or mirrored: their sums, and light. */
static void cast_skies(burnish_ray_tile *tile, burnish_gathered_points *points,
                       const burnish_ray_light *light, const burnish_render_ops *ops, int first,
                       int count) {
    float sums[3][BURNISH_OCCLUDED_MAX] = {{0}};
    memset(points->light, 0, sizeof points->light);
    memset(points->met, 0, sizeof points->met);
    for (int sample = first; sample < first + count; ++sample) {
        cast_sky(tile, points, light, ops, sample, 0);
        for (size_t i = 0; i < points->count; ++i) {
            for (int k = 0; k < 3; ++k) {
                sums[k][i] += points->sums[k][i];
            }
        }
    }
    for (int k = 0; k < 3; ++k) {
        memcpy(points->sums[k], sums[k], sizeof sums[k]);
    }
}

static int is_wanted(const burnish_ray_light *light, int lamp) {
    return light->has_sky || (lamp >= 0 && lamp == light->key);
}

static void store_sums(burnish_ray_tile *tile, const burnish_gathered_points *points, size_t i,
                       int lamp, float scale) {
    tile->sums[burnish_ray_sums(lamp)][points->from[i]] = scale * points->sums[1][i];
    tile->sums[burnish_ray_sums(lamp) + 1][points->from[i]] = scale * points->sums[2][i];
}

/* Whether the rays of a pixel to a lamp do not agree, with one another or with those of its neighbours
 * on the same surface. */
static int is_mixed(const burnish_ray_tile *tile, int at, int sums) {
    const float share = burnish_ray_share(tile, at, sums);
    const int x = at % BURNISH_RAY_EDGE, y = at / BURNISH_RAY_EDGE;
    int is_mixed = share > 0 && (share < 1 || tile->cut[at] >> (sums - BURNISH_RAY_LAMPS) / 2 & 1);
    for (int i = 0; i < 4 && !is_mixed; ++i) {
        const int column = x + i % 2 * (i - 2), row = y + (1 - i % 2) * (i - 1);
        const int beside = row * BURNISH_RAY_EDGE + column;
        if (column < 0 || row < 0 || column >= BURNISH_RAY_EDGE || row >= BURNISH_RAY_EDGE ||
            tile->rank[beside] == 0) {
            continue;
        }
        const float step = burnish_ray_share(tile, beside, sums) - share;
        float cosine = 0;
        for (int k = 0; k < 3; ++k) {
            cosine += tile->normal[k][at] * tile->normal[k][beside];
        }
        is_mixed = cosine > BURNISH_RAY_ALIKE && (step > LEAST_STEP || step < -LEAST_STEP);
    }
    return is_mixed;
}

/* Casts the rays of a pattern's pixels to a lamp. */
static void cast_to_lamp(burnish_ray_tile *tile, const burnish_ray_light *light,
                         const burnish_render_ops *ops, int lamp, int pattern,
                         burnish_gathered_points *points) {
    cast_rays(points, light, ops, lamp, pattern * BURNISH_RAY_SAMPLES, BURNISH_RAY_SAMPLES);
    for (size_t i = 0; i < points->count; ++i) {
        store_sums(tile, points, i, lamp, 1);
        tile->cut[points->from[i]] |=
            (uint16_t)((points->sums[0][i] < BURNISH_RAY_SAMPLES) << lamp);
    }
}

/* Casts more where a pattern's rays do not agree. */
static void refine_lamp(burnish_ray_tile *tile, const burnish_ray_light *light,
                        const burnish_render_ops *ops, int lamp, int pattern,
                        const burnish_gathered_points *points) {
    burnish_gathered_points mixed;
    mixed.count = 0;
    for (size_t i = 0; i < points->count; ++i) {
        if (tile->mixed[points->from[i]] >> lamp & 1) {
            for (int k = 0; k < 9; ++k) {
                mixed.values[k][mixed.count] = points->values[k][i];
            }
            mixed.from[mixed.count++] = points->from[i];
        }
    }
    if (mixed.count > 0) {
        cast_rays(&mixed, light, ops, lamp,
                  pattern / MORE_PATTERNS * MORE_PATTERNS * BURNISH_RAY_SAMPLES,
                  MORE_PATTERNS * BURNISH_RAY_SAMPLES);
    }
    for (size_t i = 0; i < mixed.count; ++i) {
        store_sums(tile, &mixed, i, lamp, 1.0f / MORE_PATTERNS);
        if (mixed.sums[0][i] < MORE_PATTERNS * BURNISH_RAY_SAMPLES) {
            tile->cut[mixed.from[i]] |= (uint16_t)(1u << lamp);
        }
    }
}

/* Every other bit of i. */
static int even_bits(int i) {
    return (i & 1) | (i >> 1 & 2) | (i >> 2 & 4) | (i >> 3 & 8);
}

/* The pattern of a block's pixel for what it mirrors: finer ones lie side by side. */
static int mirror_pattern(int pixel) {
    return pixel % 2 + pixel / 4 % 2 * 2 + pixel % 4 / 2 * 4 + pixel / 8 * 8;
}

/* The pattern of a block's pixel to lamps. The four that make one finer are two pixels apart, so that
 * fine ones alternate from pixel to pixel; to the sky, they lie side by side. */
static int lamp_pattern(int pixel) {
    const int x = pixel % 4, y = pixel / 4;
    return x / 2 + y / 2 * 2 + x % 2 * 4 + y % 2 * 8;
}

enum { BATCHES = 2 /* of a pixel of all blocks, with those in the margin */ };

/* Brings pixel `pixel` of all blocks together, in squares: their rays stay together. The last of 17 in a
 * row or column are a batch of their own. */
static void gather_pixels(const burnish_ray_tile *tile, const burnish_ray_light *light, int pixel,
                          int batch, int is_glossy, burnish_gathered_points *points) {
    enum { BLOCKS = BURNISH_TILE_BLOCKS * BURNISH_TILE_BLOCKS, SIDE = BURNISH_TILE_BLOCKS };
    _Static_assert((int)BLOCKS <= (int)BURNISH_OCCLUDED_MAX, "a pixel of all blocks is a batch");
    points->count = 0;
    points->has_gloss = is_glossy;
    for (int block = 0; block < (batch ? 2 * SIDE + 1 : BLOCKS); ++block) {
        const int column = !batch ? even_bits(block) : block < SIDE ? SIDE : block - SIDE;
        const int row = !batch ? even_bits(block >> 1) : block < SIDE ? block : SIDE;
        const int x = pixel % 4, y = pixel / 4;
        const int at =
            burnish_ray_place(column * 4 + x - (x < 2 ? 0 : 4), row * 4 + y - (y < 2 ? 0 : 4));
        const size_t to = points->count;
        if (tile->rank[at] == 0 || (is_glossy && tile->gloss[at] < 0)) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            points->values[k][to] = tile->position[k][at];
            points->values[3 + k][to] = tile->normal[k][at];
            points->values[6 + k][to] = tile->face[k][at];
            points->values[BURNISH_RAY_BACK + k][to] =
                light->is_parallel ? light->viewer[k] : -tile->position[k][at];
        }
        points->values[BURNISH_RAY_GLOSS][to] = is_glossy ? tile->gloss[at] : -1;
        points->from[points->count++] = (uint16_t)at;
    }
}

/* Casts the mirrored rays of a pattern's glossy pixels. */
static void cast_mirrored(burnish_ray_tile *tile, const burnish_ray_light *light,
                          const burnish_render_ops *ops, int pixel, int batch) {
    burnish_gathered_points *points = &tile->points;
    gather_pixels(tile, light, pixel, batch, 1, points);
    if (points->count > 0) {
        cast_skies(tile, points, light, ops, mirror_pattern(pixel) * BURNISH_RAY_SAMPLES,
                   BURNISH_RAY_SAMPLES);
    }
    for (size_t i = 0; i < points->count; ++i) {
        const size_t at = points->from[i];
        tile->sums[BURNISH_RAY_MET][at] = points->sums[0][i];
        tile->sums[BURNISH_RAY_GLOSSY][at] = BURNISH_RAY_SAMPLES;
        tile->sums[BURNISH_RAY_SENT][at] = tile->sums[BURNISH_RAY_SENT + 1][at] = 0;
        for (int k = 0; k < 3; ++k) {
            tile->sums[BURNISH_RAY_MIRRORED + k][at] = points->met[k][i];
            tile->sums[BURNISH_RAY_SENT][at] += points->light[k][i];
            tile->sums[BURNISH_RAY_SENT + 1][at] += points->met[k][i];
        }
    }
}

/* Casts the first rays of pixel `pixel` of all blocks. */
static void cast_pixels(burnish_ray_tile *tile, const burnish_ray_light *light,
                        const burnish_render_ops *ops, int pixel, int batch) {
    burnish_gathered_points *points = &tile->points;
    if (light->has_sky) {
        cast_mirrored(tile, light, ops, pixel, batch);
    }
    gather_pixels(tile, light, pixel, batch, 0, points);
    if (light->has_sky) {
        cast_skies(tile, points, light, ops, pixel * BURNISH_RAY_SAMPLES, BURNISH_RAY_SAMPLES);
    }
    for (size_t i = 0; i < points->count && light->has_sky; ++i) {
        for (int k = 0; k < 3; ++k) {
            tile->sums[BURNISH_RAY_BOUNCED + k][points->from[i]] = points->light[k][i];
        }
        store_sums(tile, points, i, -1, 1);
    }
    for (int lamp = 0; lamp < light->lamp_count; ++lamp) {
        if (is_wanted(light, lamp)) {
            cast_to_lamp(tile, light, ops, lamp, lamp_pattern(pixel), points);
        }
    }
}

void burnish_ray_tile_cast(burnish_ray_tile *tile, const burnish_ray_light *light,
                           const burnish_render_ops *ops) {
    if (!light->has_sky) {
        memset(tile->sums, 0, sizeof tile->sums);
    }
    memset(tile->cut, 0, sizeof tile->cut);
    memset(tile->mixed, 0, sizeof tile->mixed);
    for (int i = 0; i < BURNISH_BLOCK_PIXELS * BATCHES; ++i) {
        cast_pixels(tile, light, ops, i / BATCHES, i % BATCHES);
    }
    for (int at = 0; at < BURNISH_RAY_PIXELS; ++at) {
        for (int lamp = 0; lamp < light->lamp_count && tile->rank[at] > 0; ++lamp) {
            tile->mixed[at] |= (uint16_t)(is_mixed(tile, at, burnish_ray_sums(lamp)) << lamp);
        }
    }
    for (int i = 0; i < BURNISH_BLOCK_PIXELS * BATCHES && light->lamp_count > 0; ++i) {
        gather_pixels(tile, light, i / BATCHES, i % BATCHES, 0, &tile->points);
        for (int lamp = 0; lamp < light->lamp_count; ++lamp) {
            refine_lamp(tile, light, ops, lamp, lamp_pattern(i / BATCHES), &tile->points);
        }
    }
}
