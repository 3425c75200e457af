#include "render/light/ground.h"

#include <string.h>

#include "render/space.h"

/* The texture reaches as far as the mesh and this many times its height, but no further than
 * LARGEST_REACH, in the raster's space, where the mesh fills the unit sphere; from FADE of that on
 * the shadow fades. */
#define REACH 1.6
#define LARGEST_REACH 2.5
#define FADE 0.5

/* A point that sees nothing of the sky keeps 1 - STRENGTH of the background. */
#define STRENGTH 0.85

/* What the first light adds to the ground's, as a share of what is left in its shadow. */
#define LIGHT_STRENGTH 0.4

/* Half the width of a silhouette's blur, in radii of a direction's cone: less shows silhouettes,
 * more lets light in at contacts. */
#define CONE 1.2

/* The border in which the shadow fades, as a share of the image's shorter edge: a shadow that leaves
 * the image would look cut off. */
#define BORDER 0.2f

/* Directions nearer to the horizon count for nothing. */
#define LOWEST 0.02

/* ---- The plane ---- */

/* Lowest and highest vertex along `up`, and how far vertices are from the centre across it, in the
 * raster's space. */
typedef struct mesh_extent {
    double low, high, radius;
} mesh_extent;

static mesh_extent extent_of(const burnish_mesh_view *mesh, burnish_vec3 up) {
    const burnish_vec3 center = burnish_space_center(mesh);
    const double scale = burnish_space_scale(mesh);
    mesh_extent extent = {1e300, -1e300, 0};
    for (size_t i = 0; i < mesh->vertex_count; ++i) {
        const burnish_vec3 p =
            burnish_vec3_sub(burnish_vec3_loadf(mesh->positions + 3 * i), center);
        const double height = burnish_vec3_dot(p, up);
        const double squared = burnish_vec3_dot(p, p) - height * height;
        extent.low = height < extent.low ? height : extent.low;
        extent.high = height > extent.high ? height : extent.high;
        extent.radius = squared > extent.radius ? squared : extent.radius;
    }
    return (mesh_extent){extent.low * scale, extent.high * scale,
                         burnish_sqrt(extent.radius) * scale};
}

void burnish_ground_place(burnish_ground *ground, const burnish_mesh_view *mesh, burnish_vec3 up) {
    const burnish_vec3 difference = burnish_vec3_sub(ground->up, up);
    if (ground->mesh == mesh->serial && burnish_vec3_length(difference) == 0) {
        return;
    }
    ground->mesh = mesh->serial;
    ground->maps = 0;
    ground->up = up;
    ground->across[0] = burnish_space_across(up);
    ground->across[1] = burnish_vec3_cross(up, ground->across[0]);
    const mesh_extent extent = extent_of(mesh, up);
    const double reach = 0.1 + extent.radius + REACH * (extent.high - extent.low);
    ground->height = extent.low;
    ground->reach = reach < LARGEST_REACH ? reach : LARGEST_REACH;
}

/* Parallel rays count as level below this slope, which rounding leaves them. */
#define LEVEL 1e-3

int burnish_ground_is_seen(const burnish_ground *ground, const burnish_rays *rays,
                           burnish_vec3 eye) {
    const burnish_vec3 forward = burnish_vec3_normalize(burnish_vec3_loadf(rays->ray_depth));
    const int is_parallel = rays->q_per_depth == 0;
    return is_parallel ? burnish_vec3_dot(forward, ground->up) < -LEVEL
                       : burnish_vec3_dot(eye, ground->up) > ground->height;
}

/* ---- The texture ---- */

static burnish_vec3 light_of(const burnish_shadow *shadow) {
    return shadow ? shadow->toward : (burnish_vec3){0, 0, 0};
}

int burnish_ground_is_drawn(const burnish_ground *ground, const burnish_occlusion *occlusion,
                            const burnish_shadow *shadow) {
    const burnish_vec3 turned = burnish_vec3_sub(ground->light, light_of(shadow));
    return burnish_vec3_length(turned) == 0 && ground->light_size == (shadow ? shadow->size : 0) &&
           ground->maps == occlusion->mesh && ground->count == occlusion->count &&
           ground->size == occlusion->size;
}

#define SIZE BURNISH_GROUND_SIZE
#define MIDDLE ((SIZE - 1) * 0.5)

/* Texels per unit of the raster's space: those at the edge lie beyond `reach`. */
static double texels_of(const burnish_ground *ground) {
    return (MIDDLE - 1) / ground->reach;
}

/* What the tasks of a texture share. */
typedef struct ground_context {
    const burnish_ground *ground;
    const burnish_render_ops *ops;
    burnish_silhouette silhouettes[BURNISH_OCCLUSION_MAX];
    int count;
    double sky;      /* sum of the silhouettes' weights */
    double strength; /* what is left where all of it is hidden: 1 - strength */
    float *layer;    /* that is blurred */
    int radius;      /* of the blur */
} ground_context;

/* A map's row for texels of the texture. */
static void compose_row(const burnish_ground *ground, const float row[4], float out[3]) {
    const burnish_vec3 v = burnish_vec3_loadf(row);
    const double step = 1 / texels_of(ground);
    const double across[2] = {burnish_vec3_dot(v, ground->across[0]) * step,
                              burnish_vec3_dot(v, ground->across[1]) * step};
    const double start = burnish_vec3_dot(v, ground->up) * ground->height + (double)row[3];
    out[0] = (float)(start - MIDDLE * (across[0] + across[1]));
    out[1] = (float)across[0];
    out[2] = (float)across[1];
}

/* A silhouette against the sky in direction -toward.
 *   cone tangent of the half angle of the part of the sky that it represents */
static burnish_silhouette silhouette_of(const burnish_ground *ground, const burnish_map_rows *map,
                                        const uint16_t *depths, int size, double cone) {
    burnish_silhouette silhouette = {.depths = depths, .size = size};
    compose_row(ground, map->column, silhouette.column);
    compose_row(ground, map->row, silhouette.row);
    compose_row(ground, map->depth, silhouette.depth);
    silhouette.spread =
        (float)(CONE * cone * texels_of(ground) * BURNISH_MAP_RANGE / BURNISH_MAP_CODES);
    return silhouette;
}

/* Those of the depth maps that see the plane from below. */
static void find_silhouettes(const burnish_occlusion *occlusion, ground_context *context) {
    const burnish_ground *ground = context->ground;
    const double cone = burnish_sqrt(4.0 / occlusion->count);
    for (int i = 0; i < occlusion->count; ++i) {
        const burnish_map_view view = burnish_occlusion_view(i, occlusion->count, occlusion->size);
        const double height = -burnish_vec3_dot(view.toward, ground->up);
        const double origin[3] = {0, 0, 0};
        if (height > LOWEST) {
            const burnish_map_rows map = burnish_map_rows_make(&view, origin);
            burnish_silhouette *silhouette = &context->silhouettes[context->count++];
            *silhouette = silhouette_of(ground, &map, burnish_occlusion_depths(occlusion, i),
                                        occlusion->size, cone);
            silhouette->weight = (float)height;
            context->sky += height;
        }
    }
}

static void add_rows(void *from, size_t first, size_t end) {
    const ground_context *context = from;
    const size_t texels = (size_t)SIZE * SIZE;
    for (size_t row = first; row < end; ++row) {
        float *layers[BURNISH_GROUND_LAYERS];
        for (int k = 0; k < BURNISH_GROUND_LAYERS; ++k) {
            layers[k] = context->ground->layers + (size_t)k * texels + row * SIZE;
            memset(layers[k], 0, SIZE * sizeof **layers);
        }
        for (int i = 0; i < context->count; ++i) {
            context->ops->add_silhouette(&context->silhouettes[i], (float)row, SIZE, layers);
        }
    }
}

/* The mean of 2 radius + 1 numbers around each of SIZE; beyond the ends are zeros.
 */
static void blur_line(const float *from, int radius, float *to) {
    const double part = 1.0 / (2 * radius + 1);
    double sum = 0;
    for (int i = 0; i < radius; ++i) {
        sum += (double)from[i];
    }
    for (int i = 0; i < SIZE; ++i) {
        sum += i + radius < SIZE ? (double)from[i + radius] : 0;
        sum -= i - radius - 1 >= 0 ? (double)from[i - radius - 1] : 0;
        to[i] = (float)(sum * part);
    }
}

/* Twice along each line: a tent. */
static void blur_rows(void *from, size_t first, size_t end) {
    const ground_context *context = from;
    float line[SIZE];
    for (size_t row = first; row < end; ++row) {
        float *texels = context->layer + row * SIZE;
        blur_line(texels, context->radius, line);
        blur_line(line, context->radius, texels);
    }
}

static void blur_columns(void *from, size_t first, size_t end) {
    const ground_context *context = from;
    float line[SIZE], blurred[SIZE];
    for (size_t column = first; column < end; ++column) {
        float *texels = context->layer + column;
        for (int i = 0; i < SIZE; ++i) {
            line[i] = texels[(size_t)i * SIZE];
        }
        blur_line(line, context->radius, blurred);
        blur_line(blurred, context->radius, line);
        for (int i = 0; i < SIZE; ++i) {
            texels[(size_t)i * SIZE] = line[i];
        }
    }
}

/* 1 in the middle, 0 from the circle in the square of the texture on, smooth. */
static double fade_at(double x, double y) {
    double t = (1 - burnish_sqrt(x * x + y * y) / (MIDDLE - 1)) / (1 - FADE);
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return t * t * (3 - 2 * t);
}

/* Layers to darkness, over what is stored. */
static void darken_rows(void *from, size_t first, size_t end) {
    const ground_context *context = from;
    const size_t texels = (size_t)SIZE * SIZE;
    for (size_t i = first * SIZE; i < end * SIZE; ++i) {
        double hidden = 0;
        for (size_t k = 0; k < BURNISH_GROUND_LAYERS; ++k) {
            hidden += (double)context->ground->layers[k * texels + i];
        }
        hidden /= context->sky;
        hidden = hidden < 0 ? 0 : hidden > 1 ? 1 : hidden;
        const double x = (double)(i % SIZE) - MIDDLE, y = (double)(i / SIZE) - MIDDLE;
        const double before = (double)context->ground->texels[i];
        const double more = context->strength * hidden * fade_at(x, y) * (65535 - before);
        context->ground->texels[i] = (uint16_t)(before + more + 0.5);
    }
}

enum { GRAIN = 16 /* rows that are worth a thread */ };

static void blur_layer(ground_context *context, int layer, int radius, burnish_tasks *tasks) {
    context->layer = context->ground->layers + (size_t)layer * SIZE * SIZE;
    context->radius = radius;
    burnish_tasks_ranges(tasks, SIZE, GRAIN, blur_rows, context);
    burnish_tasks_ranges(tasks, SIZE, GRAIN, blur_columns, context);
}

static void add_sky(ground_context *context, const burnish_occlusion *occlusion,
                    burnish_tasks *tasks) {
    find_silhouettes(occlusion, context);
    if (context->count == 0) {
        return; /* of very few directions none sees the plane from below */
    }
    context->strength = STRENGTH;
    burnish_tasks_ranges(tasks, SIZE, GRAIN, add_rows, context);
    for (int k = 1; k < BURNISH_GROUND_LAYERS; ++k) {
        blur_layer(context, k, 1 << (k - 1), tasks);
    }
    burnish_tasks_ranges(tasks, SIZE, GRAIN, darken_rows, context);
}

/* Where the light stands above the plane: its silhouette, with an edge of a few texels. */
static void add_light(ground_context *context, const burnish_shadow *shadow, burnish_tasks *tasks) {
    const burnish_vec3 toward = shadow->toward;
    const double origin[3] = {0, 0, 0};
    const burnish_map_view view =
        burnish_map_view_make(toward, burnish_space_across(toward), shadow->size);
    const burnish_map_rows map = burnish_map_rows_make(&view, origin);
    if (burnish_vec3_dot(toward, context->ground->up) <= LOWEST) {
        return;
    }
    context->count = 1;
    context->silhouettes[0] = silhouette_of(context->ground, &map, shadow->depths, shadow->size, 0);
    context->silhouettes[0].weight = 1;
    context->sky = 1;
    context->strength = LIGHT_STRENGTH;
    burnish_tasks_ranges(tasks, SIZE, GRAIN, add_rows, context);
    blur_layer(context, 0, 1, tasks);
    burnish_tasks_ranges(tasks, SIZE, GRAIN, darken_rows, context);
}

burnish_status burnish_ground_draw(burnish_ground *ground, const burnish_render_ops *ops,
                                   const burnish_occlusion *occlusion, const burnish_shadow *shadow,
                                   burnish_tasks *tasks, burnish_memory *memory) {
    const size_t texels = (size_t)SIZE * SIZE;
    ground_context context = {.ground = ground, .ops = ops};
    ground->maps = 0;
    ground->texels = burnish_reserve_discard(memory, ground->texels, &ground->capacity, texels,
                                             sizeof *ground->texels, "the ground's shadow");
    ground->layers = burnish_reserve_discard(memory, ground->layers, &ground->layer_capacity,
                                             texels * BURNISH_GROUND_LAYERS, sizeof *ground->layers,
                                             "the ground's shadow");
    burnish_status status = memory->status;
    if (status == BURNISH_STATUS_OK) {
        memset(ground->texels, 0, texels * sizeof *ground->texels);
        add_sky(&context, occlusion, tasks);
        if (shadow) {
            add_light(&context, shadow, tasks);
        }
        status = burnish_tasks_check(tasks, memory->error);
    }
    if (status == BURNISH_STATUS_OK) {
        ground->maps = occlusion->mesh;
        ground->count = occlusion->count;
        ground->size = occlusion->size;
        ground->light = light_of(shadow);
        ground->light_size = shadow ? shadow->size : 0;
    }
    return status;
}

/* ---- A picture ---- */

/* The three numbers whose product with (1, x, y) is v . (ray + x ray_x + y ray_y). */
static void along_rays(const burnish_rays *rays, burnish_vec3 v, double out[3]) {
    out[0] = burnish_vec3_dot(v, burnish_vec3_loadf(rays->ray));
    out[1] = burnish_vec3_dot(v, burnish_vec3_loadf(rays->ray_x));
    out[2] = burnish_vec3_dot(v, burnish_vec3_loadf(rays->ray_y));
}

/* A ray in perspective is eye + t d with d = ray + x ray_x + y ray_y and meets the plane where t =
 * (eye . up - height) / -(d . up); times -(d . up), a coordinate is linear in x and y. A parallel
 * one starts at eye + d and goes along ray_depth; everything is linear. */
burnish_ground_view burnish_ground_look(const burnish_ground *ground, const burnish_rays *rays,
                                        burnish_vec3 eye, int width, int height) {
    const int is_parallel = rays->q_per_depth == 0;
    const double above = burnish_vec3_dot(eye, ground->up) - ground->height;
    const double texels = texels_of(ground);
    const burnish_vec3 forward = burnish_vec3_loadf(rays->ray_depth);
    const double fall = -burnish_vec3_dot(forward, ground->up);
    burnish_ground_view view = {.texels = ground->texels,
                                .half = {(float)width / 2, (float)height / 2},
                                .per_border =
                                    1 / (BORDER * (float)(width < height ? width : height))};
    double down[3], coordinates[2][3];
    along_rays(rays, burnish_vec3_scale(ground->up, -1), down);
    for (int axis = 0; axis < 2; ++axis) {
        const burnish_vec3 across = ground->across[axis];
        const double start = burnish_vec3_dot(eye, across);
        const double drift = is_parallel ? burnish_vec3_dot(forward, across) / fall : 0;
        double along[3];
        along_rays(rays, across, along);
        for (int i = 0; i < 3; ++i) {
            coordinates[axis][i] =
                is_parallel ? along[i] - down[i] * drift + (i == 0 ? start + above * drift : 0)
                            : start * down[i] + above * along[i];
        }
    }
    for (int i = 0; i < 3; ++i) {
        const double depth = is_parallel ? i == 0 : down[i];
        view.depth[i] = (float)depth;
        view.column[i] = (float)(coordinates[0][i] * texels + MIDDLE * depth);
        view.row[i] = (float)(coordinates[1][i] * texels + MIDDLE * depth);
    }
    return view;
}

void burnish_ground_destroy(burnish_ground *ground, const burnish_context *context) {
    burnish_release(context, ground->texels);
    burnish_release(context, ground->layers);
    memset(ground, 0, sizeof *ground);
}
