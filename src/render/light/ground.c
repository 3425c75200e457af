#include "render/light/ground.h"

#include <string.h>

#include "render/space.h"

/* The texture reaches as far as the mesh and this many times its height, but no further than
 * LARGEST_REACH, in the raster's space, where the mesh fills the unit sphere. */
#define REACH 0.9
#define LARGEST_REACH 2.0

/* A point that sees nothing of the sky keeps 1 - STRENGTH of the background. */
#define STRENGTH 0.98f

/* The strongest area light's share of the ground's light, and from how many directions it comes,
 * about: all within 41 degrees, of 48. Fewer would jump as the light turns. It fades as it sets. */
#define KEY_SHARE 0.75
#define KEY_DIRECTIONS 6.0
#define KEY_SETTING 0.25

/* What the first light adds to the ground's, as a share of what is left in its shadow. */
#define LIGHT_STRENGTH 0.4f

/* Half the width of a silhouette's blur, in radii of a direction's cone: less shows silhouettes,
 * more lets light in at contacts. */
#define CONE 1.2

/* The borders at the sides, and at top and bottom, in which the shadow fades, as shares of the
 * image's shorter edge: a shadow that leaves the image would look cut off. Most that do leave at a
 * side; the object's contact is often near the bottom. */
#define BORDER_X 0.25f
#define BORDER_Y 0.09f

/* Texels along the texture's edge, by pixels along the picture's shorter one: small pictures show
 * no more, and most of their time would go there. */
static int edge_for(int side) {
    return side < 288 ? 96 : side < 384 ? 128 : BURNISH_GROUND_SIZE;
}

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

static burnish_vec3 light_of(const burnish_ground_light *light) {
    return light->shadow ? light->shadow->toward : light->key;
}

static int size_of(const burnish_shadow *shadow) {
    return shadow ? shadow->size : 0;
}

/* The lamp that rays from the ground look for: the sun, or the one that is the strongest; -1: none. */
static int lamp_of(const burnish_ground_light *light) {
    double most = 0.99;
    int best = -1;
    for (int i = 0; i < light->rays->lamp_count && light->sun < 0; ++i) {
        const burnish_vec3 toward =
            burnish_vec3_normalize(burnish_vec3_loadf(light->rays->lamps[i].center));
        if (burnish_vec3_dot(toward, light->key) > most) {
            most = burnish_vec3_dot(toward, light->key);
            best = i;
        }
    }
    return light->sun < 0 ? best : light->sun;
}

static int is_cast(const burnish_ground *ground, const burnish_ground_light *light) {
    const burnish_vec3 turned = burnish_vec3_sub(ground->light, light->key);
    const int lamp = lamp_of(light);
    static const burnish_ray_lamp none;
    return ground->maps == light->rays->tree->mesh && ground->count == 0 &&
           burnish_vec3_length(turned) == 0 && ground->edge == edge_for(light->side) &&
           memcmp(&ground->lamp, lamp < 0 ? &none : &light->rays->lamps[lamp],
                  sizeof ground->lamp) == 0;
}

int burnish_ground_is_drawn(const burnish_ground *ground, const burnish_ground_light *light) {
    const burnish_occlusion *occlusion = light->occlusion;
    if (light->rays) {
        return is_cast(ground, light);
    }
    const burnish_vec3 turned = burnish_vec3_sub(ground->light, light_of(light));
    return burnish_vec3_length(turned) == 0 && ground->light_size == size_of(light->shadow) &&
           ground->maps == occlusion->mesh && ground->count == occlusion->count &&
           ground->size == occlusion->size && ground->edge == edge_for(light->side);
}

static double middle_of(const burnish_ground *ground) {
    return (ground->edge - 1) * 0.5;
}

/* Texels per unit of the raster's space: those at the edge lie beyond `reach`. */
static double texels_of(const burnish_ground *ground) {
    return (middle_of(ground) - 1) / ground->reach;
}

/* What the tasks of a texture share. */
typedef struct ground_context {
    const burnish_ground *ground;
    const burnish_render_ops *ops;
    burnish_silhouette silhouettes[BURNISH_OCCLUSION_MAX];
    int count;
    int layers;     /* that are in use */
    float strength; /* what is left where all of the sky is hidden: 1 - strength */
} ground_context;

/* A map's row for texels of the texture, which are looked up `shift` texels away. */
static void compose_row(const burnish_ground *ground, const float row[4], const double shift[2],
                        float out[3]) {
    const burnish_vec3 v = burnish_vec3_loadf(row);
    const double step = 1 / texels_of(ground);
    const double across[2] = {burnish_vec3_dot(v, ground->across[0]) * step,
                              burnish_vec3_dot(v, ground->across[1]) * step};
    const double start = burnish_vec3_dot(v, ground->up) * ground->height + (double)row[3];
    const double middle = middle_of(ground);
    out[0] = (float)(start + (shift[0] - middle) * across[0] + (shift[1] - middle) * across[1]);
    out[1] = (float)across[0];
    out[2] = (float)across[1];
}

/* A silhouette against the sky in direction -toward. Each is looked up at another place in texels:
 * together they smooth the edges of a contact, which all of them show.
 *   number  of the silhouette
 *   cone    tangent of the half angle of the part of the sky that it represents */
static burnish_silhouette silhouette_of(const burnish_ground *ground, const burnish_map_rows *map,
                                        const uint16_t *depths, int size, int number, double cone) {
    burnish_silhouette silhouette = {.depths = depths, .size = size};
    const double x = 0.5 + number * 0.7548776662, y = 0.5 + number * 0.5698402910; /* R2 */
    const double shift[2] = {x - (int)x - 0.5, y - (int)y - 0.5};
    compose_row(ground, map->column, shift, silhouette.column);
    compose_row(ground, map->row, shift, silhouette.row);
    compose_row(ground, map->depth, shift, silhouette.depth);
    silhouette.spread =
        (float)(CONE * cone * texels_of(ground) * BURNISH_MAP_RANGE / BURNISH_MAP_CODES);
    return silhouette;
}

/* How much of the key light comes from a direction of `count` over the sphere, smooth. A cone of
 * half angle a takes (1 - cos a) / 2 of them. */
static double key_weight(burnish_vec3 key, burnish_vec3 from, int count) {
    const double outside = (1 - burnish_vec3_dot(key, from)) * count / (2 * KEY_DIRECTIONS);
    return outside < 1 ? (1 - outside) * (1 - outside) : 0;
}

/* The strongest area light's share of the ground's light. */
static double key_share(const burnish_ground *ground, const burnish_ground_light *light) {
    const double share = burnish_vec3_dot(light->key, ground->up) / KEY_SETTING;
    return share > 0 ? KEY_SHARE * (share < 1 ? share : 1) : 0;
}

/* Those of the depth maps that see the plane from below. The light of the sky is 1 together. */
static void find_silhouettes(const burnish_ground_light *light, ground_context *context) {
    const burnish_ground *ground = context->ground;
    const burnish_occlusion *occlusion = light->occlusion;
    const double cone = burnish_sqrt(4.0 / occlusion->count), origin[3] = {0, 0, 0};
    double heights[BURNISH_OCCLUSION_MAX], keys[BURNISH_OCCLUSION_MAX], sky = 0, key = 0;
    for (int i = 0; i < occlusion->count; ++i) {
        const burnish_map_view view = burnish_occlusion_view(i, occlusion->count, occlusion->size);
        const burnish_vec3 from = burnish_vec3_scale(view.toward, -1);
        const double height = burnish_vec3_dot(from, ground->up);
        if (height > LOWEST) {
            const int n = context->count++;
            const burnish_map_rows map = burnish_map_rows_make(&view, origin);
            context->silhouettes[n] = silhouette_of(
                ground, &map, burnish_occlusion_depths(occlusion, i), occlusion->size, n, cone);
            heights[n] = height;
            keys[n] = height * key_weight(light->key, from, occlusion->count);
            sky += heights[n];
            key += keys[n];
        }
    }
    const double share = key > 0 ? key_share(ground, light) : 0;
    for (int n = 0; n < context->count; ++n) {
        const double direct = share > 0 ? share * keys[n] / key : 0;
        context->silhouettes[n].weight = (float)((1 - share) * heights[n] / sky + direct);
    }
}

static float *layer_of(const ground_context *context, size_t k) {
    const size_t edge = (size_t)context->ground->edge;
    return context->ground->layers + k * edge * edge;
}

static void add_rows(void *from, size_t first, size_t end) {
    const ground_context *context = from;
    const size_t edge = (size_t)context->ground->edge;
    for (size_t row = first; row < end; ++row) {
        float *layers[BURNISH_GROUND_LAYERS];
        for (size_t k = 0; k < BURNISH_GROUND_LAYERS; ++k) {
            layers[k] = layer_of(context, k) + row * edge;
            memset(layers[k], 0, edge * sizeof **layers);
        }
        for (int i = 0; i < context->count; ++i) {
            context->ops->add_silhouette(&context->silhouettes[i], (float)row, edge, layers);
        }
    }
}

enum { STRIP = 16 /* columns that are blurred at once, and rows that are worth a thread */ };

/* Strips of columns of all layers. */
static void blur_strips(void *from, size_t first, size_t end) {
    const ground_context *context = from;
    const size_t edge = (size_t)context->ground->edge, strips = edge / STRIP;
    float scratch[BURNISH_GROUND_SIZE * STRIP];
    for (size_t i = first; i < end; ++i) {
        const size_t k = i / strips;
        const int radius = k > 0 ? 1 << (k - 1) : 1; /* 0 would show texels */
        context->ops->blur_columns(layer_of(context, k) + i % strips * STRIP, edge, radius,
                                   scratch);
    }
}

/* Columns become rows, in all layers. */
static void transpose_layers(void *from, size_t first, size_t end) {
    const ground_context *context = from;
    const size_t edge = (size_t)context->ground->edge;
    for (size_t k = first; k < end; ++k) {
        float *texels = layer_of(context, k);
        for (size_t y = 0; y < edge; ++y) {
            for (size_t x = 0; x < y; ++x) {
                const float upper = texels[x * edge + y];
                texels[x * edge + y] = texels[y * edge + x];
                texels[y * edge + x] = upper;
            }
        }
    }
}

/* Layers to darkness, over what is stored. */
static void darken_rows(void *from, size_t first, size_t end) {
    const ground_context *context = from;
    const size_t edge = (size_t)context->ground->edge;
    for (size_t row = first; row < end; ++row) {
        context->ops->darken_ground(layer_of(context, 0) + row * edge, edge, context->layers,
                                    context->strength, (float)row,
                                    context->ground->texels + row * edge);
    }
}

/* The silhouettes' shadow, with columns of the texture across rows of silhouettes. */
static void darken(ground_context *context, burnish_tasks *tasks) {
    const size_t edge = (size_t)context->ground->edge, layers = (size_t)context->layers;
    burnish_tasks_ranges(tasks, edge, STRIP, add_rows, context);
    burnish_tasks_ranges(tasks, layers * edge / STRIP, 1, blur_strips, context);
    burnish_tasks_ranges(tasks, layers, 1, transpose_layers, context);
    burnish_tasks_ranges(tasks, layers * edge / STRIP, 1, blur_strips, context);
    burnish_tasks_ranges(tasks, edge, STRIP, darken_rows, context);
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
    context->count = context->layers = 1;
    context->silhouettes[0] =
        silhouette_of(context->ground, &map, shadow->depths, shadow->size, 0, 0);
    context->silhouettes[0].weight = 1;
    context->strength = LIGHT_STRENGTH;
    darken(context, tasks);
}

/* ---- By rays ---- */

/* How far above the plane rays start. */
#define RAY_OFFSET 0x1p-13f

typedef struct ground_rays {
    ground_context *ground;
    burnish_ray_light light;
    int lamp;
    float lamp_share; /* of the ground's light */
} ground_rays;

/* What is hidden from every second texel of a row. Four of them together cast rays in all directions. */
static void cast_texels(const ground_rays *rays, size_t row, size_t first) {
    enum { POINTS = BURNISH_GROUND_SIZE / 2 + 16, LAMP_RAYS = BURNISH_RAY_DIRECTIONS };
    const burnish_ground *ground = rays->ground->ground;
    const double step = 1 / texels_of(ground), middle = middle_of(ground);
    const int pattern = (int)(row % 2 * 2 + first);
    float values[6][POINTS] = {{0}}, sums[3][POINTS];
    float *const to[3] = {sums[0], sums[1], sums[2]};
    const burnish_ray_points points = {.position = {values[0], values[1], values[2]},
                                       .normal = {values[3], values[4], values[5]},
                                       .face = {values[3], values[4], values[5]},
                                       .count = (size_t)ground->edge / 2};
    float *hidden = ground->layers + row * (size_t)ground->edge + first;
    for (size_t i = 0; i < points.count; ++i) {
        const double x = ((double)(2 * i + first) - middle) * step;
        const double y = ((double)row - middle) * step;
        const burnish_vec3 p =
            burnish_vec3_add(burnish_vec3_scale(ground->up, ground->height),
                             burnish_vec3_add(burnish_vec3_scale(ground->across[0], x),
                                              burnish_vec3_scale(ground->across[1], y)));
        const float at[6] = {(float)p.x,          (float)p.y,          (float)p.z,
                             (float)ground->up.x, (float)ground->up.y, (float)ground->up.z};
        for (int k = 0; k < 6; ++k) {
            values[k][i] = at[k];
        }
    }
    rays->ground->ops->sample_sky(&rays->light, &points, pattern * BURNISH_RAY_DIRECTIONS,
                                  BURNISH_RAY_DIRECTIONS, NULL, to);
    for (size_t i = 0; i < points.count; ++i) {
        hidden[2 * i] = (1 - rays->lamp_share) * (sums[0][i] / BURNISH_RAY_DIRECTIONS);
    }
    if (rays->lamp_share > 0) {
        rays->ground->ops->sample_lamp(&rays->light, rays->lamp, &points, pattern * LAMP_RAYS,
                                       LAMP_RAYS, to);
    }
    for (size_t i = 0; i < points.count && rays->lamp_share > 0; ++i) {
        hidden[2 * i] += sums[1][i] > 0 ? rays->lamp_share * (sums[2][i] / sums[1][i]) : 0;
    }
}

static void cast_rows(void *from, size_t first, size_t end) {
    for (size_t row = first; row < end; ++row) {
        cast_texels(from, row, 0);
        cast_texels(from, row, 1);
    }
}

/* What is hidden of the sky and of an area light, or of the sun alone, to darkness. */
static void darken_by_rays(ground_context *context, const burnish_ground_light *from, double share,
                           int lamp, burnish_tasks *tasks) {
    const size_t edge = (size_t)context->ground->edge;
    ground_rays rays = {context, *from->rays, lamp, (float)share};
    memset(rays.light.eye, 0, sizeof rays.light.eye);
    rays.light.offset = RAY_OFFSET; /* whatever the camera */
    for (int i = 0; i < BURNISH_RAY_LIGHT_EDGE * BURNISH_RAY_LIGHT_EDGE; ++i) {
        rays.light.light[i] = 1;
    }
    context->layers = 1;
    burnish_tasks_ranges(tasks, edge, 1, cast_rows, &rays);
    burnish_tasks_ranges(tasks, edge / STRIP, 1, blur_strips, context);
    burnish_tasks_ranges(tasks, 1, 1, transpose_layers, context);
    burnish_tasks_ranges(tasks, edge, STRIP, darken_rows, context);
}

static void cast_ground(burnish_ground *ground, ground_context *context,
                        const burnish_ground_light *light, burnish_tasks *tasks) {
    const int lamp = lamp_of(light);
    const double share = lamp < 0 ? 0 : key_share(ground, light);
    darken_by_rays(context, light, light->sun < 0 ? share : 0, lamp, tasks);
    if (light->sun >= 0) {
        context->strength = LIGHT_STRENGTH;
        darken_by_rays(context, light, 1, lamp, tasks);
    }
    memset(&ground->lamp, 0, sizeof ground->lamp);
    if (lamp >= 0) {
        memcpy(&ground->lamp, &light->rays->lamps[lamp], sizeof ground->lamp);
    }
}

/* Where the texture is dark. */
static void find_dark(burnish_ground *ground) {
    const int edge = ground->edge;
    uint16_t columns[BURNISH_GROUND_SIZE] = {0}, rows[BURNISH_GROUND_SIZE] = {0};
    for (int y = 0; y < edge; ++y) {
        const uint16_t *texels = ground->texels + (size_t)y * (size_t)edge;
        for (int x = 0; x < edge; ++x) {
            const uint16_t is_dark = texels[x] >= BURNISH_GROUND_DARK * 65535;
            columns[x] |= is_dark;
            rows[y] |= is_dark;
        }
    }
    for (int axis = 0; axis < 2; ++axis) {
        const uint16_t *any = axis ? rows : columns;
        int *dark = ground->dark[axis];
        dark[0] = 0;
        dark[1] = edge - 1;
        while (dark[0] < dark[1] && !any[dark[0]]) {
            ++dark[0];
        }
        while (dark[0] < dark[1] && !any[dark[1]]) {
            --dark[1];
        }
    }
}

burnish_status burnish_ground_draw(burnish_ground *ground, const burnish_render_ops *ops,
                                   const burnish_ground_light *light, burnish_tasks *tasks,
                                   burnish_memory *memory) {
    const size_t edge = (size_t)edge_for(light->side), texels = edge * edge;
    ground_context context = {
        .ground = ground, .ops = ops, .layers = BURNISH_GROUND_LAYERS, .strength = STRENGTH};
    ground->maps = 0;
    ground->edge = (int)edge;
    ground->texels = burnish_reserve_discard(memory, ground->texels, &ground->capacity, texels,
                                             sizeof *ground->texels, "the ground's shadow");
    ground->layers = burnish_reserve_discard(memory, ground->layers, &ground->layer_capacity,
                                             texels * BURNISH_GROUND_LAYERS, sizeof *ground->layers,
                                             "the ground's shadow");
    burnish_status status = memory->status;
    if (status == BURNISH_STATUS_OK) {
        memset(ground->texels, 0, texels * sizeof *ground->texels);
        if (light->rays) {
            cast_ground(ground, &context, light, tasks);
        } else {
            find_silhouettes(light, &context);
        }
        if (context.count > 0) { /* of very few directions none sees the plane from below */
            darken(&context, tasks);
        }
        if (light->shadow) {
            add_light(&context, light->shadow, tasks);
        }
        status = burnish_tasks_check(tasks, memory->error);
    }
    if (status == BURNISH_STATUS_OK) {
        find_dark(ground);
        ground->maps = light->rays ? light->rays->tree->mesh : light->occlusion->mesh;
        ground->count = light->rays ? 0 : light->occlusion->count;
        ground->size = light->occlusion->size;
        ground->light = light->rays ? light->key : light_of(light);
        ground->light_size = size_of(light->shadow);
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

/* The part of the screen that the dark part of the texture takes, and a margin for rounding; all of
 * it where a corner is not before the camera. */
static void find_bounds(const burnish_ground *ground, burnish_ground_view *view) {
    const burnish_vec3 column = burnish_vec3_loadf(view->column);
    const burnish_vec3 row = burnish_vec3_loadf(view->row), depth = burnish_vec3_loadf(view->depth);
    const burnish_vec3 from[3] = {burnish_vec3_cross(row, depth), burnish_vec3_cross(depth, column),
                                  burnish_vec3_cross(column, row)}; /* the inverse's columns */
    const double unit = burnish_vec3_dot(column, from[0]);
    for (int corner = 0; corner < 4; ++corner) {
        const double u = ground->dark[0][corner & 1] + (corner & 1 ? 2 : -2);
        const double v = ground->dark[1][corner >> 1] + (corner >> 1 ? 2 : -2);
        const burnish_vec3 along =
            burnish_vec3_add(burnish_vec3_scale(from[0], u), burnish_vec3_scale(from[1], v));
        const burnish_vec3 at = burnish_vec3_scale(burnish_vec3_add(along, from[2]), 1 / unit);
        const float x = (float)(at.y / at.x), y = (float)(at.z / at.x);
        if (!(at.x > 0 && unit != 0)) {
            view->least[0] = view->least[1] = -__builtin_inff();
            view->most[0] = view->most[1] = __builtin_inff();
            return;
        }
        view->least[0] = corner == 0 || x - 1 < view->least[0] ? x - 1 : view->least[0];
        view->least[1] = corner == 0 || y - 1 < view->least[1] ? y - 1 : view->least[1];
        view->most[0] = corner == 0 || x + 1 > view->most[0] ? x + 1 : view->most[0];
        view->most[1] = corner == 0 || y + 1 > view->most[1] ? y + 1 : view->most[1];
    }
}

/* A ray in perspective is eye + t d with d = ray + x ray_x + y ray_y and meets the plane where t =
 * (eye . up - height) / -(d . up); times -(d . up), a coordinate is linear in x and y. A parallel
 * one starts at eye + d and goes along ray_depth; everything is linear. */
burnish_ground_view burnish_ground_look(const burnish_ground *ground, const burnish_rays *rays,
                                        burnish_vec3 eye, int width, int height) {
    const int is_parallel = rays->q_per_depth == 0;
    const double above = burnish_vec3_dot(eye, ground->up) - ground->height;
    const double texels = texels_of(ground);
    const float side = (float)(width < height ? width : height);
    const burnish_vec3 forward = burnish_vec3_loadf(rays->ray_depth);
    const double fall = -burnish_vec3_dot(forward, ground->up);
    burnish_ground_view view = {.texels = ground->texels,
                                .size = ground->edge,
                                .half = {(float)width / 2, (float)height / 2},
                                .per_border = {1 / (BORDER_X * side), 1 / (BORDER_Y * side)}};
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
        view.row[i] = (float)(coordinates[0][i] * texels + middle_of(ground) * depth);
        view.column[i] = (float)(coordinates[1][i] * texels + middle_of(ground) * depth);
    }
    find_bounds(ground, &view);
    return view;
}

void burnish_ground_destroy(burnish_ground *ground, const burnish_context *context) {
    burnish_release(context, ground->texels);
    burnish_release(context, ground->layers);
    memset(ground, 0, sizeof *ground);
}
