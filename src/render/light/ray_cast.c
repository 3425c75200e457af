/* A tile's points, and the rays that they cast. */
#include <string.h>

#include "core/srgb.h"
#include "core/vec3.h"
#include "render/light/ray_light.h"
#include "render/space.h"

/* Shares of a lamp that are hidden from neighbouring pixels differ by less, except at a sharp edge: by 4
 * rays, and by more. */
#define LEAST_STEP 0.15f
#define LEAST_FINER_STEP 0.25f

#define LEAST_GLOSS 0x1p-10f /* alpha of surfaces whose mirrored rays all go the same way */

/* Patterns of rays where one is not enough, and where these are not. */
enum { MORE_PATTERNS = 4, ALL_PATTERNS = BURNISH_RAY_PATTERNS, ROW = BURNISH_RAY_EDGE / 4 };

/* Where more of the sky is hidden from a block of pixels, light that comes over other surfaces is most of
 * what there is, and one set of directions would show as blotches. */
#define CLOSED 0.7f

#define FAR 1e6f /* longer than the way from the camera through the mesh */

/* Of the mean light, what surfaces get that cast no rays, and reflect as those to which they send it;
 * metals see no lamps there. */
#define LAST_LIGHT 0.6f

/* Metals reflect more along their normal; smoother surfaces mirror others, whatever they reflect. */
#define METAL 0.2f
#define SMOOTH 0.35f

/* ---- A tile ---- */

/* The normal of triangle `number`, on the side of another one; that one if it has no area. Its corners,
 * in the raster's space, unless there are none. Returns whether there are. */
static int find_face(const burnish_ray_light *light, const burnish_mesh_view *mesh, size_t number,
                     burnish_vec3 corner[3], burnish_vec3 *normal) {
    const burnish_vec3 center = burnish_vec3_loadf(light->center);
    for (size_t k = 0; k < 3 && number < mesh->triangle_count; ++k) {
        const float *at = mesh->positions + 3 * (size_t)mesh->indices[3 * number + k];
        corner[k] = burnish_vec3_scale(burnish_vec3_sub(burnish_vec3_loadf(at), center),
                                       (double)light->scale);
    }
    if (number >= mesh->triangle_count) {
        return 0;
    }
    const burnish_vec3 face = burnish_vec3_cross(burnish_vec3_sub(corner[1], corner[0]),
                                                 burnish_vec3_sub(corner[2], corner[0]));
    const double length = burnish_vec3_length(face), side = burnish_vec3_dot(face, *normal);
    *normal = length > 0 ? burnish_vec3_scale(face, (side < 0 ? -1 : 1) / length) : *normal;
    return 1;
}

static void store_lane(burnish_vec3 v, float *to, size_t step) {
    to[0] = (float)v.x;
    to[step] = (float)v.y;
    to[2 * step] = (float)v.z;
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
    const uint16_t *materials = light->mesh->triangle_materials;
    const size_t number = triangle / 2;
    const burnish_vec3 unit = burnish_vec3_normalize(burnish_vec3_loadf(normal));
    burnish_vec3 corner[3], face = unit;
    const int is_known = find_face(light, light->mesh, number, corner, &face);
    tile->rank[at] = rank;
    const size_t material = materials && is_known ? materials[number] : 0;
    tile->gloss[at] = is_known ? gloss_of(light, material, 1) : -1;
    tile->is_metal[at] = is_known && gloss_of(light, material, 0) >= 0;
    for (int k = 0; k < 3; ++k) {
        tile->position[k][at] = position[k];
    }
    store_lane(unit, tile->normal[0] + at, BURNISH_RAY_PIXELS);
    store_lane(face, tile->face[0] + at, BURNISH_RAY_PIXELS);
}

size_t burnish_ray_met(const burnish_started_rays *rays, const burnish_ray_tree *tree,
                       const burnish_ray_light *light, size_t i, float position[3], float *normal,
                       float face[3]) {
    const size_t number = tree->numbers[rays->place[i]];
    burnish_vec3 corner[3], point = {rays->origin[0][i], rays->origin[1][i], rays->origin[2][i]};
    burnish_vec3 back = {-rays->direction[0][i], -rays->direction[1][i], -rays->direction[2][i]};
    point = burnish_vec3_sub(point, burnish_vec3_scale(back, (double)rays->distance[i]));
    const int is_known = find_face(light, light->solid, number, corner, &back);
    burnish_vec3 sum = is_known ? (burnish_vec3){0, 0, 0} : back;
    for (size_t k = 0; k < 3 && is_known && normal; ++k) {
        /* by the area of what lies across from the corner; below 0 where the back is seen, whose
         * normals are to be turned */
        const size_t vertex = light->solid->indices[3 * number + k];
        const burnish_vec3 across =
            burnish_vec3_cross(burnish_vec3_sub(corner[(k + 1) % 3], point),
                               burnish_vec3_sub(corner[(k + 2) % 3], point));
        sum = burnish_vec3_add(
            sum, burnish_vec3_scale(burnish_vec3_loadf(light->solid->normals + 3 * vertex),
                                    burnish_vec3_dot(across, back)));
    }
    burnish_space_store(burnish_vec3_sub(point, burnish_vec3_loadf(light->eye)), position);
    burnish_space_store(back, face);
    if (normal) {
        burnish_space_store(burnish_vec3_normalize(sum), normal);
    }
    return number;
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

int burnish_ray_met_back(const burnish_started_rays *rays, const burnish_ray_tree *tree,
                         const burnish_ray_light *light, size_t i) {
    const burnish_vec3 along = {rays->direction[0][i], rays->direction[1][i],
                                rays->direction[2][i]};
    burnish_vec3 corner[3], normal = along;
    return find_face(light, light->solid, tree->numbers[rays->place[i]], corner, &normal) &&
           burnish_vec3_dot(burnish_vec3_cross(burnish_vec3_sub(corner[1], corner[0]),
                                               burnish_vec3_sub(corner[2], corner[0])),
                            along) > 0;
}

/* Lets rays go on that met the back of a triangle. Returns whether there are any. */
static int pass_backs(const burnish_ray_light *light, burnish_started_rays *rays, size_t count) {
    int are_any = 0;
    for (size_t i = 0; i < count; ++i) {
        if (rays->hits[i] > 0 && burnish_ray_met_back(rays, light->tree, light, i)) {
            for (int k = 0; k < 3; ++k) {
                rays->origin[k][i] += rays->direction[k][i] * (rays->distance[i] + light->offset);
            }
            are_any = 1;
        }
    }
    return are_any;
}

void burnish_ray_tile_add_margin(burnish_ray_tile *tile, const burnish_ray_light *light,
                                 const burnish_rays *from, const burnish_tile *place,
                                 const burnish_raster_view *view) {
    enum {
        EDGE = BURNISH_RAY_EDGE,
        MARGIN = BURNISH_RAY_MARGIN,
        SIZE = BURNISH_TILE_SIZE,
        LAYERS = 8
    };
    const burnish_vec3 eye = burnish_vec3_loadf(light->eye);
    const int width = view->width, height = view->height;
    burnish_started_rays *rays = &tile->rays;
    burnish_ray_batch batch = {{rays->origin[0], rays->origin[1], rays->origin[2]},
                               {rays->direction[0], rays->direction[1], rays->direction[2]},
                               rays->reach,
                               0};
    uint16_t at[BURNISH_OCCLUDED_MAX];
    for (int i = 0; i < BURNISH_RAY_PIXELS; ++i) {
        const int column = i % EDGE - MARGIN, row = i / EDGE - MARGIN;
        const int x = place->x + column, y = place->y + row;
        const int is_own = column >= 0 && row >= 0 && column < SIZE && row < SIZE;
        if (!is_own && x >= 0 && y >= 0 && x < width && y < height) {
            const double right = x + 0.5 - width * 0.5, up = height * 0.5 - y - 0.5;
            const burnish_vec3 start = seen_at(from, right, up, 1);
            const burnish_vec3 along =
                burnish_vec3_normalize(burnish_vec3_sub(seen_at(from, right, up, 0.5), start));
            store_lane(burnish_vec3_add(start, eye), rays->origin[0] + batch.count,
                       BURNISH_OCCLUDED_MAX);
            store_lane(along, rays->direction[0] + batch.count, BURNISH_OCCLUDED_MAX);
            rays->reach[batch.count] = FAR;
            at[batch.count++] = (uint16_t)i;
        }
        if (batch.count < BURNISH_OCCLUDED_MAX && i + 1 < BURNISH_RAY_PIXELS) {
            continue;
        }
        memset(rays->reach + batch.count, 0, (BURNISH_OCCLUDED_MAX - batch.count) * sizeof(float));
        for (int layer = 0; layer < LAYERS; ++layer) {
            light->ops->find_hits(light->tree, &batch, rays->hits, rays->distance, rays->place);
            if (!view->cull_back_faces || !pass_backs(light, rays, batch.count)) {
                break;
            }
        }
        for (size_t ray = 0; ray < batch.count; ++ray) {
            float p[3], n[3], face[3];
            const size_t number = rays->hits[ray] > 0
                                      ? burnish_ray_met(rays, light->tree, light, ray, p, n, face)
                                      : SIZE_MAX;
            if (number < light->solid->triangle_count) {
                burnish_ray_tile_add(tile, light, at[ray], UINT16_MAX, p, n, 2 * (uint32_t)number);
            }
        }
        batch.count = 0;
    }
}

static burnish_ray_points ray_points(burnish_gathered_points *points) {
    float(*const values)[BURNISH_OCCLUDED_MAX + 16] = points->values;
    for (int k = 0; k < BURNISH_RAY_VALUES; ++k) {
        memset(values[k] + points->count, 0, 16 * sizeof *values[k]);
    }
    return (burnish_ray_points){.position = {values[0], values[1], values[2]},
                                .normal = {values[3], values[4], values[5]},
                                .face = {values[6], values[7], values[8]},
                                .gloss = points->has_gloss ? values[BURNISH_RAY_GLOSS] : NULL,
                                .back = {values[BURNISH_RAY_BACK], values[BURNISH_RAY_BACK + 1],
                                         values[BURNISH_RAY_BACK + 2]},
                                .count = points->count};
}

static void cast_rays(burnish_gathered_points *points, const burnish_ray_light *light,
                      const burnish_render_ops *ops, int lamp, int first, int count) {
    const burnish_ray_points cast = ray_points(points);
    float *const sums[3] = {points->sums[0], points->sums[1], points->sums[2]};
    ops->sample_lamp(light, lamp, &cast, first, count, sums);
}

/* ---- Light that comes over other surfaces ---- */

float burnish_ray_albedo(const burnish_ray_light *light, size_t triangle, int is_mirrored,
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
        float position[3], normal[3], face[3], albedo[3];
        if (!(rays->hits[i] > 0)) {
            continue;
        }
        const size_t to = met->count++;
        const int is_smooth = points->values[BURNISH_RAY_GLOSS][i] >= 0;
        const size_t number =
            burnish_ray_met(rays, light->tree, light, i, position, is_smooth ? normal : NULL, face);
        const float gloss = burnish_ray_albedo(light, number, is_smooth, albedo);
        for (int k = 0; k < 3; ++k) {
            met->values[k][to] = position[k];
            met->values[3 + k][to] = is_smooth ? normal[k] : face[k];
            met->values[6 + k][to] = face[k];
            met->values[BURNISH_RAY_BACK + k][to] = -rays->direction[k][i];
            met->albedo[k][to] = albedo[k];
        }
        met->values[BURNISH_RAY_GLOSS][to] = gloss;
        met->has_gloss |= gloss >= 0;
        met->from[to] = (uint16_t)i;
    }
}

/* The sample of a bounce that goes with a sample: another order of the same 64. In a bowl, whose light is
 * known, of all odd factors this one's mean is the nearest to it. */
static int bounced_sample(int sample, int turn) {
    int turned = sample / BURNISH_RAY_DIRECTIONS * BURNISH_RAY_DIRECTIONS;
    for (int bit = 0; bit < 6; ++bit) {
        turned |= (sample * 19 >> bit & 1) << (turn + 5 - bit) % 6;
    }
    return turned;
}

/* Adds to `light` of points what one ray of each brings over other surfaces: to the sky, or mirrored.
 * The kernel's sums are of it. */
static void cast_sky(burnish_ray_tile *tile, burnish_gathered_points *points,
                     const burnish_ray_light *light, const burnish_render_ops *ops, int sample,
                     int bounce) {
    burnish_ray_points cast = ray_points(points);
    float *const sums[3] = {points->sums[0], points->sums[1], points->sums[2]};
    burnish_gathered_points *met = &tile->met[bounce];
    cast.lamps = bounce > 0 ? light->mirrored_lamps : 0; /* first rays' light is not used */
    ops->sample_sky(light, &cast, sample, 1, &tile->rays, sums);
    if (bounce == BURNISH_RAY_BOUNCES) {
        for (size_t i = 0; i < 3 * points->count; ++i) {
            const int is_glossy = points->values[BURNISH_RAY_GLOSS][i / 3] >= 0;
            points->light[i % 3][i / 3] +=
                tile->rays.hits[i / 3] * points->albedo[i % 3][i / 3] *
                (LAST_LIGHT * (is_glossy ? light->sky_mean : light->mean));
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

void burnish_ray_shine(burnish_ray_tile *tile, const burnish_ray_light *light,
                       const burnish_render_ops *ops, int pattern) {
    const int first = pattern * BURNISH_RAY_SAMPLES;
    burnish_gathered_points *points = &tile->points;
    cast_skies(tile, points, light, ops, first, BURNISH_RAY_SAMPLES);
    for (int lamp = -1; lamp < light->lamp_count; ++lamp) {
        if (lamp >= 0) {
            cast_rays(points, light, ops, lamp, first, BURNISH_RAY_SAMPLES);
        }
        for (size_t i = 0; i < points->count; ++i) {
            for (int k = 0; k < 3; ++k) {
                points->light[k][i] += points->sums[1][i] - points->sums[2][i];
            }
        }
    }
    for (size_t i = 0; i < points->count; ++i) {
        for (int k = 0; k < 3; ++k) {
            points->light[k][i] *= points->albedo[k][i] * (light->tint[k] / BURNISH_RAY_SAMPLES);
        }
    }
}

/* Whether neighbours of a pixel on the same surface see so much more or less of a lamp, or mirrored. */
static int is_apart(const burnish_ray_tile *tile, int at, int sums, float least) {
    const float share = burnish_ray_share(tile, at, sums);
    const int x = at % BURNISH_RAY_EDGE, y = at / BURNISH_RAY_EDGE;
    const int is_mirrored = sums == BURNISH_RAY_GLOSSY;
    int is_apart = 0;
    for (int i = 0; i < 9 && !is_apart; ++i) {
        const int column = x + i % 3 - 1, row = y + i / 3 - 1;
        const int beside = row * BURNISH_RAY_EDGE + column;
        if (column < 0 || row < 0 || column >= BURNISH_RAY_EDGE || row >= BURNISH_RAY_EDGE ||
            tile->rank[beside] == 0 || (is_mirrored && tile->gloss[beside] < 0)) {
            continue;
        }
        float step = burnish_ray_share(tile, beside, sums) - share;
        if (is_mirrored && step == 0 && share > 0) {
            float own = 0, other = 0;
            for (int k = BURNISH_RAY_SENT; k < BURNISH_RAY_SENT + 3; ++k) {
                own += tile->sums[k][at];
                other += tile->sums[k][beside];
            }
            step = own + other > 0 ? (own - other) / (own + other) : 0;
        }
        float cosine = 0;
        for (int k = 0; k < 3; ++k) {
            cosine += tile->normal[k][at] * tile->normal[k][beside];
        }
        is_apart = cosine > BURNISH_RAY_ALIKE && (step > least || step < -least);
    }
    return is_apart;
}

/* Whether the rays of a pixel to a lamp, or mirrored ones, do not agree, with one another or with those of
 * its neighbours. */
static int is_mixed(const burnish_ray_tile *tile, int at, int sums) {
    const float share = burnish_ray_share(tile, at, sums);
    const int is_cut =
        sums != BURNISH_RAY_GLOSSY && tile->cut[at] >> (sums - BURNISH_RAY_LAMPS) / 2 & 1;
    return (share > 0 && (share < 1 || is_cut)) || is_apart(tile, at, sums, LEAST_STEP);
}

static int even_bits(int i) { /* every other one */
    return (i & 1) | (i >> 1 & 2) | (i >> 2 & 4) | (i >> 3 & 8);
}

/* The pattern of a block's pixel to lamps. The four that make one finer are two pixels apart, so that
 * fine ones alternate from pixel to pixel; to the sky, they lie side by side. */
static int lamp_pattern(int pixel) {
    const int x = pixel % 4, y = pixel / 4;
    return x / 2 + y / 2 * 2 + x % 2 * 4 + y % 2 * 8;
}

enum {
    ALL = -2,
    GLOSSY,
    MIXED_GLOSSY = BURNISH_RAY_LAMPS_MAX,
    IN_CLOSED,
    BATCHES = 2 /* of a pixel of all blocks, with those in the margin */
};

/* Brings pixel `pixel` of all blocks together, in squares: their rays stay together. The last of 17 in a
 * row or column are a batch of their own.
 *   which  ALL, GLOSSY or bit `which` of wanted */
static void gather_pixels(burnish_ray_tile *tile, const burnish_ray_light *light, int pixel,
                          int batch, int which, const uint16_t *wanted) {
    enum { BLOCKS = BURNISH_TILE_BLOCKS * BURNISH_TILE_BLOCKS, SIDE = BURNISH_TILE_BLOCKS };
    _Static_assert((int)BLOCKS <= (int)BURNISH_OCCLUDED_MAX, "a pixel of all blocks is a batch");
    burnish_gathered_points *points = &tile->points;
    points->count = 0;
    points->has_gloss = which == GLOSSY || which == MIXED_GLOSSY;
    for (int block = 0; block < (batch ? 2 * SIDE + 1 : BLOCKS); ++block) {
        const int column = !batch ? even_bits(block) : block < SIDE ? SIDE : block - SIDE;
        const int row = !batch ? even_bits(block >> 1) : block < SIDE ? block : SIDE;
        const int x = pixel % 4, y = pixel / 4;
        const int at =
            burnish_ray_place(column * 4 + x - (x < 2 ? 0 : 4), row * 4 + y - (y < 2 ? 0 : 4));
        const size_t to = points->count;
        if (tile->rank[at] == 0 || (which == GLOSSY && tile->gloss[at] < 0) ||
            (which >= 0 && !(wanted[at] >> which & 1))) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            points->values[k][to] = tile->position[k][at];
            points->values[3 + k][to] = tile->normal[k][at];
            points->values[6 + k][to] = tile->face[k][at];
            points->values[BURNISH_RAY_BACK + k][to] =
                light->is_parallel ? light->viewer[k] : -tile->position[k][at];
        }
        points->values[BURNISH_RAY_GLOSS][to] = points->has_gloss ? tile->gloss[at] : -1;
        points->from[points->count++] = (uint16_t)at;
    }
}

/* Casts the mirrored rays of the pixels that are together. */
static void cast_mirrored(burnish_ray_tile *tile, const burnish_ray_light *light,
                          const burnish_render_ops *ops, int pattern, int patterns) {
    burnish_gathered_points *points = &tile->points;
    const int count = patterns * BURNISH_RAY_SAMPLES;
    const float part = 1.0f / (float)patterns;
    if (points->count > 0) {
        cast_skies(tile, points, light, ops, pattern / patterns * patterns * BURNISH_RAY_SAMPLES,
                   count);
    }
    for (size_t i = 0; i < points->count; ++i) {
        const size_t at = points->from[i];
        tile->sums[BURNISH_RAY_MET][at] = part * points->sums[0][i];
        tile->sums[BURNISH_RAY_GLOSSY][at] = BURNISH_RAY_SAMPLES;
        tile->sums[BURNISH_RAY_METALS][at] = tile->is_metal[at] ? BURNISH_RAY_SAMPLES : 0;
        for (int k = 0; k < 3; ++k) {
            tile->sums[BURNISH_RAY_MIRRORED + k][at] = part * points->met[k][i];
            tile->sums[BURNISH_RAY_SENT + k][at] = part * points->light[k][i];
            tile->sums[BURNISH_RAY_SENT + 3 + k][at] = part * points->met[k][i];
        }
    }
}

/* Casts rays of the pixels to a lamp, or for -1 to the sky. Of several patterns, pixels share those to a
 * lamp; those to the sky are each pixel's own. */
static void cast_to_lamp(burnish_ray_tile *tile, const burnish_ray_light *light,
                         const burnish_render_ops *ops, int lamp, int pattern, int patterns) {
    const burnish_gathered_points *points = &tile->points;
    const int count = patterns * BURNISH_RAY_SAMPLES;
    const float part = 1.0f / (float)patterns;
    if (points->count > 0 && lamp < 0) {
        cast_skies(tile, &tile->points, light, ops, pattern * count, count);
    } else if (points->count > 0) {
        cast_rays(&tile->points, light, ops, lamp,
                  pattern / patterns * patterns * BURNISH_RAY_SAMPLES, count);
    }
    for (size_t i = 0; i < points->count; ++i) {
        const int is_cut = lamp >= 0 && points->sums[0][i] < (float)count;
        const size_t at = points->from[i];
        tile->sums[burnish_ray_sums(lamp)][at] = part * points->sums[1][i];
        tile->sums[burnish_ray_sums(lamp) + 1][at] = part * points->sums[2][i];
        for (int k = 0; k < 3 && lamp < 0; ++k) {
            tile->sums[BURNISH_RAY_BOUNCED + k][at] = part * points->light[k][i];
        }
        tile->cut[at] |= (uint16_t)(is_cut ? 1 << lamp : 0);
    }
}

static void cast_pixels(burnish_ray_tile *tile, const burnish_ray_light *light,
                        const burnish_render_ops *ops, int pixel, int batch) {
    if (light->has_sky) {
        gather_pixels(tile, light, pixel, batch, GLOSSY, NULL);
        cast_mirrored(tile, light, ops, pixel, 1);
    }
    gather_pixels(tile, light, pixel, batch, ALL, NULL);
    for (int lamp = -1; lamp < light->lamp_count; ++lamp) {
        if (light->has_sky || (lamp == light->key && lamp >= 0)) {
            cast_to_lamp(tile, light, ops, lamp, lamp < 0 ? pixel : lamp_pattern(pixel), 1);
        }
    }
}

/* Casts rays of more patterns to a lamp, or to the sky. */
static void cast_more(burnish_ray_tile *tile, const burnish_ray_light *light,
                      const burnish_render_ops *ops, int lamp, int patterns,
                      const uint16_t *wanted) {
    for (int i = 0; i < BURNISH_BLOCK_PIXELS * BATCHES; ++i) {
        gather_pixels(tile, light, i / BATCHES, i % BATCHES, lamp < 0 ? IN_CLOSED : lamp, wanted);
        cast_to_lamp(tile, light, ops, lamp, lamp_pattern(i / BATCHES), patterns);
    }
}

/* Marks pixels that need more rays; those of a block to a lamp or to the sky together: a pixel whose own
 * rays happen to agree, among others that get more, would be too light or too dark. */
static void mark_block(burnish_ray_tile *tile, const burnish_ray_light *light, int first) {
    float all = 0, hidden = 0;
    int marks = 0;
    for (int i = 0; i < BURNISH_BLOCK_PIXELS; ++i) {
        const int at = first + i / 4 * BURNISH_RAY_EDGE + i % 4;
        const int is_point = tile->rank[at] > 0;
        for (int lamp = 0; lamp < light->lamp_count && is_point; ++lamp) {
            marks |= is_mixed(tile, at, burnish_ray_sums(lamp)) << lamp;
        }
        if (light->has_sky && is_point && tile->gloss[at] > LEAST_GLOSS) {
            tile->mixed[at] = (uint16_t)(is_mixed(tile, at, BURNISH_RAY_GLOSSY) << MIXED_GLOSSY);
        }
        all += is_point ? tile->sums[BURNISH_RAY_SKY][at] : 0;
        hidden += is_point ? tile->sums[BURNISH_RAY_SKY + 1][at] : 0;
    }
    marks |= (light->has_sky && hidden > CLOSED * all) << IN_CLOSED;
    for (int i = 0; i < BURNISH_BLOCK_PIXELS; ++i) {
        tile->mixed[first + i / 4 * BURNISH_RAY_EDGE + i % 4] |= (uint16_t)marks;
    }
}

void burnish_ray_tile_cast(burnish_ray_tile *tile, const burnish_ray_light *light,
                           const burnish_render_ops *ops) {
    if (!light->has_sky) {
        memset(tile->sums, 0, sizeof tile->sums);
    }
    memset(tile->cut, 0, sizeof tile->cut);
    memset(tile->mixed, 0, sizeof tile->mixed);
    memset(tile->rough, 0, sizeof tile->rough);
    for (int i = 0; i < BURNISH_BLOCK_PIXELS * BATCHES; ++i) {
        cast_pixels(tile, light, ops, i / BATCHES, i % BATCHES);
    }
    for (int block = 0; block < BURNISH_RAY_PIXELS / BURNISH_BLOCK_PIXELS; ++block) {
        mark_block(tile, light, block % ROW * 4 + block / ROW * 4 * BURNISH_RAY_EDGE);
    }
    for (int i = 0; i < BURNISH_BLOCK_PIXELS * BATCHES; ++i) {
        gather_pixels(tile, light, i / BATCHES, i % BATCHES, MIXED_GLOSSY, tile->mixed);
        cast_mirrored(tile, light, ops, lamp_pattern(i / BATCHES), MORE_PATTERNS);
    }
    cast_more(tile, light, ops, -1, MORE_PATTERNS, tile->mixed);
    for (int lamp = 0; lamp < light->lamp_count; ++lamp) {
        cast_more(tile, light, ops, lamp, MORE_PATTERNS, tile->mixed);
        for (int at = 0; at < BURNISH_RAY_PIXELS; ++at) {
            const int is_rough = tile->mixed[at] >> lamp & 1 &&
                                 is_apart(tile, at, burnish_ray_sums(lamp), LEAST_FINER_STEP);
            tile->rough[at] |= (uint16_t)(is_rough << lamp);
        }
        cast_more(tile, light, ops, lamp, ALL_PATTERNS, tile->rough);
    }
}
