#include "environment/maps.h"

#include <string.h>

#include "core/memory.h"
#include "core/numbers.h"
#include "core/vector.h"
#include "environment/areas.h"

enum { SIZE_MAX_MAP = 256, DIFFUSE_SIZE = 32 };

/* A map and its memory; texels NULL: not computed. */
typedef struct table {
    float alpha; /* 0: diffuse */
    int size;
    float *texels;
} table;

/* What maps depend on. No padding: it is compared byte by byte. */
typedef struct key {
    burnish_area_light distant[BURNISH_AREA_LIGHT_MAX];
    burnish_dome dome;
    int distant_count, has_dome;
    float strength;
    double up[3], axes[3][3];
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
    int alpha_count;
};

static burnish_light_map map_of(const table *t) {
    return (burnish_light_map){t->size, t->texels};
}

/* ---- Directions ---- */

/* Unit vectors of a row of a map, `size` texels with the border. */
static void row_directions(int size, int row, float *const w[3]) {
    const float half = (float)(size - 2) / 2, middle = (float)(size - 1) / 2;
    const float q = ((float)(row % size) - middle) / half;
    for (int i = 0; i < size; ++i) {
        const float p = ((float)i - middle) / half, squared = p * p + q * q;
        const float scale = 1 / (1 + squared), z = (1 - squared) * scale;
        w[0][i] = 2 * p * scale;
        w[1][i] = 2 * q * scale;
        w[2][i] = row < size ? z : -z;
    }
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

/* ---- Maps ---- */

typedef struct build {
    const burnish_light_maps *maps;
    const table *table;
    const burnish_light_lobes *lobes; /* NULL: diffuse */
} build;

static void build_row(void *context, size_t row, int thread) {
    const build *b = context;
    const key *k = &b->maps->key;
    const int size = b->table->size + 2;
    float vectors[3][SIZE_MAX_MAP + 2], colors[3][SIZE_MAX_MAP + 2] = {{0}};
    const float *const w[3] = {vectors[0], vectors[1], vectors[2]};
    float *const rgb[3] = {colors[0], colors[1], colors[2]};
    float *texels = b->table->texels + 4 * row * (size_t)size;
    (void)thread;
    row_directions(size, (int)row, (float *const[3]){vectors[0], vectors[1], vectors[2]});
    if (k->has_dome) {
        add_dome(k, b->lobes, w, size, rgb);
    }
    for (int i = 0; i < k->distant_count; ++i) {
        burnish_light_add_area(&k->distant[i], b->lobes, w, (size_t)size, rgb);
    }
    for (int i = 0; i < size; ++i) {
        for (int c = 0; c < 3; ++c) {
            texels[4 * i + c] = rgb[c][i];
        }
    }
}

/* Texels per side for lobes of this alpha. */
static int size_for(float alpha) {
    const float size = 16 / alpha;
    return size < 32 ? 32 : size > SIZE_MAX_MAP ? SIZE_MAX_MAP : (int)(size / 16) * 16;
}

/* Computes a map unless it is there; alpha 0: diffuse. */
static burnish_status make(burnish_light_maps *maps, table *t, float alpha, burnish_error *error) {
    burnish_memory memory = burnish_memory_of(maps->context, error);
    if (t->texels) {
        return BURNISH_STATUS_OK;
    }
    const burnish_light_lobes lobes = burnish_light_lobes_for(alpha);
    build b = {maps, t, alpha > 0 ? &lobes : NULL};
    t->alpha = alpha;
    t->size = alpha > 0 ? size_for(alpha) : DIFFUSE_SIZE;
    const size_t rows = (size_t)t->size + 2;
    t->texels =
        burnish_allocate_zeroed(&memory, 2 * rows * rows, 4 * sizeof(float), "a map of light");
    if (!t->texels) {
        return memory.status;
    }
    burnish_tasks_run(maps->tasks, 2 * rows, 4, 0, build_row, &b);
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
    maps->alpha_count = 0;
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
    if (maps->is_set && maps->environment == sources->environment &&
        memcmp(&maps->key, &k, sizeof k) == 0) {
        return BURNISH_STATUS_OK;
    }
    drop_all(maps);
    maps->key = k;
    maps->environment = sources->environment;
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
    int i = 0;
    while (i < maps->alpha_count && maps->alphas[i].alpha != alpha) {
        ++i;
    }
    if (i == BURNISH_LIGHT_ALPHAS_MAX) {
        return burnish_fail(error, BURNISH_STATUS_LIMIT,
                            "more than %d maps of light; use the levels", i);
    }
    const burnish_status status = make_specular(maps, &maps->alphas[i], alpha, specular, error);
    if (status == BURNISH_STATUS_OK && i == maps->alpha_count) {
        maps->alpha_count += 1;
    }
    return status;
}

burnish_status burnish_light_maps_levels(burnish_light_maps *maps,
                                         burnish_light_map levels[BURNISH_LIGHT_LEVELS],
                                         burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    for (int i = 0; i < BURNISH_LIGHT_LEVELS && status == BURNISH_STATUS_OK; ++i) {
        const float roughness = (float)i / (BURNISH_LIGHT_LEVELS - 1);
        const float alpha = i > 0 ? roughness * roughness : BURNISH_LIGHT_ALPHA_MIN;
        status = make_specular(maps, &maps->levels[i], alpha, &levels[i], error);
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
