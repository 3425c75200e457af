#include "environment/maps.h"

#include <string.h>

#include "core/memory.h"
#include "core/numbers.h"
#include "core/vector.h"
#include "environment/areas.h"
#include "environment/environment_ops.h"
#include "shading/shading_ops.h"

/* The diffuse map is off by 3 % of the peak at the terminator of a tiny light and 0.3 % for softboxes;
 * spherical harmonics of order 2 are off by 9 %, of order 4 by 6 %. */
enum { LARGEST_SIZE = 256, LEAST_SIZE = 24, DIFFUSE_SIZE = 32 };

/* A map and its memory; texels NULL: not computed. */
typedef struct table {
    float alpha;   /* 0: diffuse */
    int is_needed; /* 1: since the sources were last set */
    int size;
    float *texels;
} table;

/* What maps depend on. Padding is 0: it is compared byte by byte. */
typedef struct key {
    burnish_area_light distant[BURNISH_AREA_LIGHT_MAX];
    burnish_dome dome;
    int distant_count, has_dome;
    float strength;
    double up[3], axes[3][3];
    uint64_t environment; /* its hash */
} key;

struct burnish_light_maps {
    const burnish_context *context;
    const burnish_kernels *kernels;
    burnish_tasks *tasks;
    const burnish_environment *environment;
    int is_set;
    key key;
    table diffuse, levels[BURNISH_LIGHT_LEVELS], alphas[BURNISH_LIGHT_ALPHAS_MAX];
    burnish_light_map diffuse_map;
};

static burnish_light_map map_of(const table *t) {
    return (burnish_light_map){t->size, t->texels};
}

/* ---- Directions ---- */

/* Texels are computed in bands of rows, 4 x 4 after 4 x 4: neighbours meet the same edges of lights,
 * which a vector of them shares. */
enum { BLOCK = 4, BAND_MAX = BLOCK * (LARGEST_SIZE + 2) };

/* The columns of a row that look-ups need, [*first, *last]: within a texel's diagonal of the disc
 * that a half of the sphere is mapped to. size: of the map, which has a border. */
static void find_columns(int size, int row, int *first, int *last) {
    const float half = (float)size / 2, middle = (float)(size + 1) / 2;
    const float limit = 1 + 3 / (float)size, q = ((float)(row % (size + 2)) - middle) / half;
    const float room = limit * limit - q * q;
    const int reach = room > 0 ? (int)(__builtin_sqrtf(room) * half + 0.5f) : 0;
    *last = size / 2 + reach < size + 1 ? size / 2 + reach : size + 1;
    *first = size + 1 - *last;
}

static void find_direction(int size, int row, int column, float w[3]) {
    const float half = (float)size / 2, middle = (float)(size + 1) / 2;
    const float q = ((float)(row % (size + 2)) - middle) / half;
    const float p = ((float)column - middle) / half, squared = p * p + q * q;
    const float scale = 1 / (1 + squared), z = (1 - squared) * scale;
    w[0] = 2 * p * scale;
    w[1] = 2 * q * scale;
    w[2] = row < size + 2 ? z : -z;
}

/* Unit vectors of the texels of a band, and their numbers in the map. Returns how many. */
static int band_directions(int size, int band, int *numbers, float *const w[3]) {
    const int stride = size + 2, from = band * BLOCK;
    const int end = from + BLOCK < 2 * stride ? from + BLOCK : 2 * stride;
    int first[BLOCK], last[BLOCK], count = 0;
    for (int row = from; row < end; ++row) {
        find_columns(size, row, &first[row - from], &last[row - from]);
    }
    for (int i = 0; i < BLOCK * BLOCK * ((stride + BLOCK - 1) / BLOCK); ++i) {
        const int row = from + i / BLOCK % BLOCK;
        const int column = i / (BLOCK * BLOCK) * BLOCK + i % BLOCK;
        if (row < end && column >= first[row - from] && column <= last[row - from]) {
            float direction[3];
            find_direction(size, row, column, direction);
            for (int c = 0; c < 3; ++c) {
                w[c][count] = direction[c];
            }
            numbers[count++] = row * stride + column;
        }
    }
    return count;
}

/* ---- The dome ---- */

/* Adds the dome: its polynomial is a sum of Legendre polynomials, and averaging around a direction
 * multiplies each by a constant. */
static void add_dome(const key *k, const burnish_light_lobes *lobes, const float *const w[3],
                     int count, float *const rgb[3]) {
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
    const float up[3] = {(float)k->up[0], (float)k->up[1], (float)k->up[2]};
    for (int c = 0; c < 3; ++c) {
        const double zenith = (double)k->dome.zenith[c], nadir = (double)k->dome.nadir[c];
        const double horizon = (double)k->dome.horizon[c], bend = (zenith + nadir) / 2 - horizon;
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
static float lobe_radius(const burnish_light_lobe *lobe) {
    return __builtin_sqrtf(2 / (lobe->zeta * (float)(lobe->order + 1)));
}

/* The smallest image in which a lobe's radius has enough texels: then the result is at most 0.5 % of
 * the brightest one off what the first image gives. A cosine alone gets more: 0.25 %. */
static const burnish_environment_level *choose_level(const burnish_environment *environment,
                                                     const burnish_light_lobe *lobe) {
    const float texels = lobe->order > 1 ? 3 : lobe->zeta > 1 ? 4 : 10;
    const float height = texels * 3.14159265f / lobe_radius(lobe);
    int i = environment->level_count - 1;
    while (i > 0 && (float)environment->levels[i].height < height) {
        --i;
    }
    return &environment->levels[i];
}

/* Lobes have a radius of at least 1.5 pixels, so there are pixels in their caps, and a small image
 * is seen without its pixels. */
static float zeta_limit(const burnish_environment *environment, int order) {
    const float radius = 1.5f * 3.14159265f / (float)environment->levels[0].height;
    return 2 / (radius * radius * (float)(order + 1));
}

static void add_environment(const burnish_light_maps *maps, const burnish_light_lobes *lobes,
                            const float *const w[3], int count, float *const rgb[3]) {
    static const burnish_light_lobes cosine = {1, {{1, 1.0f, 1.0f}}};
    const burnish_environment_ops *ops = burnish_environment_ops_for(maps->kernels->isa);
    const key *k = &maps->key;
    float turned[3][BAND_MAX];
    const float *const axis[3] = {turned[0], turned[1], turned[2]};
    lobes = lobes ? lobes : &cosine;
    for (int c = 0; c < 3; ++c) {
        const float *const *from = w;
        const float x = (float)k->axes[c][0], y = (float)k->axes[c][1], z = (float)k->axes[c][2];
        for (int i = 0; i < count; ++i) {
            turned[c][i] = (from[0][i] * x + from[1][i] * y) + from[2][i] * z;
        }
    }
    for (int j = 0; j < lobes->count; ++j) {
        burnish_light_lobe lobe = lobes->lobe[j];
        const float most = zeta_limit(maps->environment, lobe.order);
        lobe.zeta = lobe.zeta < most ? lobe.zeta : most;
        const burnish_environment_filter filter = {choose_level(maps->environment, &lobe),
                                                   lobe.zeta, __builtin_ctz((unsigned)lobe.order)};
        ops->filter_environment(&filter, k->strength * lobe.weight, axis, (size_t)count, rgb);
    }
}

/* ---- Maps ---- */

/* Directions whose cosine with the middle of a polygon is smaller receive none of its light. */
typedef struct reach {
    float middle[3], least;
} reach;

typedef struct build {
    const burnish_light_maps *maps;
    const table *table;
    const burnish_light_lobes *lobes; /* NULL: diffuse */
    burnish_polygon_constants polygons[BURNISH_AREA_LIGHT_MAX];
    reach reaches[BURNISH_AREA_LIGHT_MAX];
    const float *colors[BURNISH_AREA_LIGHT_MAX];
    int polygon_count;
} build;

/* A cap around the polygon, wider by the widest lobe or, for diffuse light, by a right angle. */
static reach find_reach(const burnish_polygon_constants *polygon,
                        const burnish_light_lobes *lobes) {
    burnish_vec3 vertices[BURNISH_POLYGON_VERTEX_MAX], middle = {0, 0, 0};
    double radius = 1, lobe = lobes ? 1 : 0; /* cosines */
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
    for (int j = 0; lobes && j < lobes->count; ++j) {
        const double cosine = 1 - 1 / (double)lobes->lobe[j].zeta;
        lobe = cosine < lobe ? cosine : lobe;
    }
    const double sines = burnish_sqrt((1 - radius * radius) * (1 - lobe * lobe));
    const int is_cap = radius > 0 && radius + lobe > 0; /* else it may reach all directions */
    return (reach){{(float)middle.x, (float)middle.y, (float)middle.z},
                   is_cap ? (float)(radius * lobe - sines - 1e-5) : -2};
}

static void add_polygons(build *b) {
    const key *k = &b->maps->key;
    for (int i = 0; i < k->distant_count; ++i) {
        burnish_polygon_constants *polygon = &b->polygons[b->polygon_count];
        if (burnish_area_polygon(&k->distant[i], b->lobes, polygon)) {
            b->reaches[b->polygon_count] = find_reach(polygon, b->lobes);
            b->colors[b->polygon_count++] = k->distant[i].color;
        }
    }
}

static int is_reached(const reach *r, const float *const w[3], int i) {
    return w[0][i] * r->middle[0] + w[1][i] * r->middle[1] + w[2][i] * r->middle[2] > r->least;
}

/* Adds a polygon in `count` directions, which are normals or the lobes' axes. */
static void add_polygon(const build *b, int number, const float *const w[3], int count,
                        float *const rgb[3]) {
    float reached[3][BAND_MAX], light[BAND_MAX];
    int numbers[BAND_MAX], reached_count = 0;
    for (int i = 0; i < count; ++i) {
        if (is_reached(&b->reaches[number], w, i)) {
            for (int c = 0; c < 3; ++c) {
                reached[c][reached_count] = w[c][i];
            }
            numbers[reached_count++] = i;
        }
    }
    const burnish_kernels_axes axes = {.axis = {reached[0], reached[1], reached[2]}};
    burnish_kernels_points points = {.normal = {NULL}};
    for (int c = 0; c < 3 && !b->lobes; ++c) {
        points.normal[c] = reached[c];
    }
    b->maps->kernels->polygon_light(
        &b->polygons[number], &points, &axes, (size_t)reached_count,
        (float *const[2]){b->lobes ? NULL : light, b->lobes ? light : NULL});
    for (int c = 0; c < 3; ++c) {
        for (int i = 0; i < reached_count; ++i) {
            rgb[c][numbers[i]] += b->colors[number][c] * light[i];
        }
    }
}

static void build_band(void *context, size_t band, int thread) {
    const build *b = context;
    const key *k = &b->maps->key;
    float vectors[3][BAND_MAX], colors[3][BAND_MAX] = {{0}};
    int numbers[BAND_MAX];
    const float *const w[3] = {vectors[0], vectors[1], vectors[2]};
    float *const rgb[3] = {colors[0], colors[1], colors[2]};
    const int count = band_directions(b->table->size, (int)band, numbers,
                                      (float *const[3]){vectors[0], vectors[1], vectors[2]});
    (void)thread;
    if (k->has_dome) {
        add_dome(k, b->lobes, w, count, rgb);
    }
    for (int i = 0; i < b->polygon_count; ++i) {
        add_polygon(b, i, w, count, rgb);
    }
    if (b->maps->environment && k->strength > 0) {
        add_environment(b->maps, b->lobes, w, count, rgb);
    }
    for (int i = 0; i < count; ++i) {
        for (int c = 0; c < 3; ++c) {
            b->table->texels[4 * numbers[i] + c] = colors[c][i];
        }
    }
}

/* Texels per side: a texel has at most a third of the radius of the narrowest lobe. Then a bilinear
 * look-up across the edge of a light is at most 0.7 % of its radiance off. */
static int size_for(const burnish_light_lobes *lobes) {
    float radius = 1;
    for (int j = 0; j < lobes->count; ++j) {
        const float own = lobe_radius(&lobes->lobe[j]);
        radius = own < radius ? own : radius;
    }
    const int size = (int)(12 / radius + 1) / 2 * 2;
    return size < LEAST_SIZE ? LEAST_SIZE : size > LARGEST_SIZE ? LARGEST_SIZE : size;
}

/* Computes a map unless it is there; alpha 0: diffuse. */
static burnish_status make(burnish_light_maps *maps, table *t, float alpha, burnish_error *error) {
    burnish_memory memory = burnish_memory_of(maps->context, error);
    if (t->texels) {
        return BURNISH_STATUS_OK;
    }
    const burnish_light_lobes lobes = burnish_light_lobes_for(alpha);
    build b = {.maps = maps, .table = t, .lobes = alpha > 0 ? &lobes : NULL};
    add_polygons(&b);
    t->alpha = alpha;
    t->size = alpha > 0 ? size_for(&lobes) : DIFFUSE_SIZE;
    const size_t rows = (size_t)t->size + 2;
    t->texels =
        burnish_allocate_zeroed(&memory, 2 * rows * rows, 4 * sizeof(float), "a map of light");
    if (!t->texels) {
        return memory.status;
    }
    burnish_tasks_run(maps->tasks, (2 * rows + BLOCK - 1) / BLOCK, 1, 0, build_band, &b);
    return maps->tasks ? burnish_tasks_check(maps->tasks, error) : BURNISH_STATUS_OK;
}

static void drop(burnish_light_maps *maps, table *t) {
    burnish_release(maps->context, t->texels);
    *t = (table){0};
}

static void drop_all(burnish_light_maps *maps) {
    drop(maps, &maps->diffuse);
    for (int i = 0; i < BURNISH_LIGHT_LEVELS; ++i) {
        drop(maps, &maps->levels[i]);
    }
    for (int i = 0; i < BURNISH_LIGHT_ALPHAS_MAX; ++i) {
        drop(maps, &maps->alphas[i]);
    }
    maps->is_set = 0;
}

burnish_status burnish_light_maps_create(const burnish_context *context, burnish_light_maps **maps,
                                         burnish_error *error) {
    burnish_memory memory = burnish_memory_of(context, error);
    *maps = burnish_allocate_zeroed(&memory, 1, sizeof **maps, "maps of light");
    if (*maps) {
        (*maps)->context = context;
    }
    return memory.status;
}

void burnish_light_maps_destroy(burnish_light_maps *maps) {
    if (maps) {
        drop_all(maps);
        burnish_release(maps->context, maps);
    }
}

/* Padding and members that do not matter become 0. */
static void fill_key(const burnish_light_sources *sources, key *k) {
    memset(k, 0, sizeof *k);
    k->distant_count = sources->distant_count;
    for (int i = 0; i < sources->distant_count; ++i) {
        const burnish_area_light *from = &sources->distant[i];
        burnish_area_light *to = &k->distant[i];
        to->shape = from->shape;
        to->is_distant = 1;
        to->is_two_sided = from->is_two_sided;
        memcpy(to->center, from->center, sizeof to->center);
        memcpy(to->half_u, from->half_u, sizeof to->half_u);
        memcpy(to->half_v, from->half_v, sizeof to->half_v);
        memcpy(to->color, from->color, sizeof to->color);
    }
    if (sources->dome) {
        k->has_dome = 1;
        memcpy(k->dome.zenith, sources->dome->zenith, sizeof k->dome.zenith);
        memcpy(k->dome.horizon, sources->dome->horizon, sizeof k->dome.horizon);
        memcpy(k->dome.nadir, sources->dome->nadir, sizeof k->dome.nadir);
        memcpy(k->up, sources->up, sizeof k->up);
    }
    if (sources->environment) {
        k->environment = sources->environment->hash;
        k->strength = sources->strength;
        memcpy(k->axes, sources->environment_axes, sizeof k->axes);
    }
}

burnish_status burnish_light_maps_set(burnish_light_maps *maps,
                                      const burnish_light_sources *sources,
                                      const burnish_kernels *kernels, burnish_tasks *tasks,
                                      burnish_error *error) {
    key k;
    fill_key(sources, &k);
    maps->kernels = kernels ? kernels : burnish_kernels_best();
    maps->tasks = tasks;
    maps->environment = sources->environment;
    for (int i = 0; i < BURNISH_LIGHT_ALPHAS_MAX; ++i) {
        maps->alphas[i].is_needed = 0;
    }
    if (maps->is_set && memcmp(&maps->key, &k, sizeof k) == 0) {
        return BURNISH_STATUS_OK;
    }
    drop_all(maps);
    maps->key = k;
    burnish_status status = make(maps, &maps->diffuse, 0, error);
    if (status == BURNISH_STATUS_OK) {
        maps->diffuse_map = map_of(&maps->diffuse);
        maps->is_set = 1;
    }
    return status;
}

const burnish_light_map *burnish_light_maps_diffuse(const burnish_light_maps *maps) {
    return &maps->diffuse_map;
}

/* Computes a specular map, or leaves the table empty. */
static burnish_status make_specular(burnish_light_maps *maps, table *t, float alpha,
                                    burnish_light_map *map, burnish_error *error) {
    burnish_status status = make(maps, t, alpha, error);
    if (status == BURNISH_STATUS_OK) {
        *map = map_of(t);
    } else {
        drop(maps, t);
    }
    return status;
}

burnish_status burnish_light_maps_need(burnish_light_maps *maps, float alpha,
                                       burnish_light_map *specular, burnish_error *error) {
    alpha = alpha > BURNISH_LIGHT_ALPHA_MIN ? alpha < 1 ? alpha : 1 : BURNISH_LIGHT_ALPHA_MIN;
    table *found = NULL;
    for (int i = 0; i < BURNISH_LIGHT_ALPHAS_MAX; ++i) {
        table *t = &maps->alphas[i];
        if (t->texels && t->alpha == alpha) {
            found = t;
            break;
        }
        found = t->is_needed || (found && !found->texels) ? found : t;
    }
    if (!found) {
        return burnish_fail(error, BURNISH_STATUS_LIMIT,
                            "more than %d maps of light; use the levels", BURNISH_LIGHT_ALPHAS_MAX);
    }
    if (found->alpha != alpha) {
        drop(maps, found);
    }
    found->is_needed = 1;
    return make_specular(maps, found, alpha, specular, error);
}

burnish_status burnish_light_maps_levels(burnish_light_maps *maps, int first,
                                         burnish_light_map levels[BURNISH_LIGHT_LEVELS],
                                         burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    first = first > 1 ? first : 1;
    for (int i = first; i < BURNISH_LIGHT_LEVELS && status == BURNISH_STATUS_OK; ++i) {
        const float roughness = (float)i / (BURNISH_LIGHT_LEVELS - 1);
        status = make_specular(maps, &maps->levels[i], roughness * roughness, &levels[i], error);
    }
    for (int i = 0; i < first; ++i) {
        levels[i] = levels[first];
    }
    return status;
}

void burnish_light_axes(const double up[3], double degrees, double axes[3][3]) {
    const burnish_vec3 u = burnish_vec3_normalize(burnish_vec3_load(up));
    burnish_vec3 x = {1, 0, 0}, z = {0, 0, -1};
    double sine, cosine;
    if (u.y > -0.999999) { /* the rotation that takes y to up; below it, half a turn about x */
        const double f = 1 / (1 + u.y);
        x = (burnish_vec3){1 - f * u.x * u.x, -u.x, -f * u.x * u.z};
        z = (burnish_vec3){-f * u.x * u.z, -u.z, 1 - f * u.z * u.z};
    }
    burnish_sincos(degrees * BURNISH_DEGREE, &sine, &cosine);
    burnish_vec3_store(burnish_vec3_sub(burnish_vec3_scale(x, cosine), burnish_vec3_scale(z, sine)),
                       axes[0]);
    burnish_vec3_store(u, axes[1]);
    burnish_vec3_store(burnish_vec3_add(burnish_vec3_scale(x, sine), burnish_vec3_scale(z, cosine)),
                       axes[2]);
}
