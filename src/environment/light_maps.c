#include "environment/light_maps.h"

#include <stddef.h>
#include <string.h>

#include "base/memory.h"
#include "base/numbers.h"
#include "core/vec3.h"
#include "environment/environment.h"
#include "environment/map_fill.h"

/* A map. */
typedef struct table {
    float alpha;   /* 0: diffuse */
    int is_needed; /* 1: since the sources were last set */
    burnish_map_cells *cells;
} table;

/* What maps depend on. Padding is 0: it is compared byte by byte. */
typedef struct key {
    burnish_area_light distant[BURNISH_AREA_LIGHT_MAX];
    burnish_dome dome;
    int distant_count, has_dome, largest;
    float strength;
    double up[3], axes[3][3];
    uint64_t environment; /* its hash */
} key;

struct burnish_light_maps {
    const burnish_context *context;
    burnish_map_filler filler;
    int is_set;
    key key;
    table diffuse, levels[BURNISH_LIGHT_LEVELS], alphas[BURNISH_LIGHT_ALPHAS_MAX];
    burnish_light_map diffuse_map;
};

/* What the maps show. */
static burnish_light_sources sources_of(const burnish_light_maps *maps,
                                        const burnish_environment *environment) {
    const key *k = &maps->key;
    burnish_light_sources sources = {.distant = k->distant,
                                     .distant_count = k->distant_count,
                                     .dome = k->has_dome ? &k->dome : NULL,
                                     .environment = environment,
                                     .strength = k->strength,
                                     .largest = k->largest};
    memcpy(sources.up, k->up, sizeof k->up);
    memcpy(sources.environment_axes, k->axes, sizeof k->axes);
    return sources;
}

static void drop_table(burnish_light_maps *maps, table *t) {
    burnish_map_cells_destroy(t->cells, maps->context);
    *t = (table){0};
}

/* Makes a map unless it is there; alpha 0: diffuse. */
static burnish_status make_map(burnish_light_maps *maps, table *t, float alpha,
                               burnish_light_map *map, burnish_error *error) {
    burnish_memory memory = burnish_memory_of(maps->context, error);
    burnish_status status = BURNISH_STATUS_OK;
    if (!t->cells) {
        t->alpha = alpha;
        status = burnish_map_cells_create(&maps->filler, alpha, &memory, &t->cells);
    }
    if (status == BURNISH_STATUS_OK) {
        *map = burnish_map_cells_map(t->cells);
    }
    return status;
}

static void drop_all(burnish_light_maps *maps) {
    drop_table(maps, &maps->diffuse);
    for (int i = 0; i < BURNISH_LIGHT_LEVELS; ++i) {
        drop_table(maps, &maps->levels[i]);
    }
    for (int i = 0; i < BURNISH_LIGHT_ALPHAS_MAX; ++i) {
        drop_table(maps, &maps->alphas[i]);
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
    k->largest = sources->largest > 0 ? sources->largest : BURNISH_LIGHT_MAP_USUAL;
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
                                      const burnish_kernels *kernels, burnish_error *error) {
    key k;
    fill_key(sources, &k);
    maps->filler.kernels = kernels ? kernels : burnish_kernels_best();
    maps->filler.sources.environment = sources->environment;
    for (int i = 0; i < BURNISH_LIGHT_ALPHAS_MAX; ++i) {
        maps->alphas[i].is_needed = 0;
    }
    if (maps->is_set && memcmp(&maps->key, &k, sizeof k) == 0) {
        return BURNISH_STATUS_OK;
    }
    drop_all(maps);
    maps->key = k;
    maps->filler.sources = sources_of(maps, sources->environment);
    const burnish_status status = make_map(maps, &maps->diffuse, 0, &maps->diffuse_map, error);
    maps->is_set = status == BURNISH_STATUS_OK;
    return status;
}

const burnish_light_map *burnish_light_maps_diffuse(const burnish_light_maps *maps) {
    return &maps->diffuse_map;
}

burnish_status burnish_light_maps_need(burnish_light_maps *maps, float alpha,
                                       burnish_light_map *specular, burnish_error *error) {
    const float least = burnish_light_least_alpha(maps->key.largest);
    alpha = alpha > least ? alpha < 1 ? alpha : 1 : least;
    table *found = NULL;
    for (int i = 0; i < BURNISH_LIGHT_ALPHAS_MAX; ++i) {
        table *t = &maps->alphas[i];
        if (t->cells && t->alpha == alpha) {
            found = t;
            break;
        }
        found = t->is_needed || (found && !found->cells) ? found : t;
    }
    if (!found) {
        return burnish_fail(error, BURNISH_STATUS_LIMIT,
                            "more than %d maps of light; use the levels", BURNISH_LIGHT_ALPHAS_MAX);
    }
    if (found->alpha != alpha) {
        drop_table(maps, found);
    }
    found->is_needed = 1;
    return make_map(maps, found, alpha, specular, error);
}

burnish_status burnish_light_maps_levels(burnish_light_maps *maps, int first,
                                         burnish_light_map levels[BURNISH_LIGHT_LEVELS],
                                         burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    const float least = burnish_light_least_alpha(maps->key.largest);
    first = first > 0 || least < BURNISH_LIGHT_ALPHA_USUAL ? first : 1;
    for (int i = first; i < BURNISH_LIGHT_LEVELS && status == BURNISH_STATUS_OK; ++i) {
        const float roughness = (float)i / (BURNISH_LIGHT_LEVELS - 1);
        status = make_map(maps, &maps->levels[i], i > 0 ? roughness * roughness : least, &levels[i],
                          error);
    }
    for (int i = 0; i < first; ++i) {
        levels[i] = levels[first];
    }
    return status;
}

static void need_row(void *context, size_t row, int thread) {
    const burnish_light_map *map = context;
    (void)thread;
    for (int column = 0; column < map->size + 2; column += BURNISH_LIGHT_CELL) {
        burnish_light_map_need(map, (int)row * BURNISH_LIGHT_CELL, column);
    }
}

void burnish_light_map_complete(burnish_light_map *map, burnish_tasks *tasks) {
    const size_t rows = 2 * ((size_t)map->size + 2);
    burnish_tasks_run(tasks, (rows + BURNISH_LIGHT_CELL - 1) / BURNISH_LIGHT_CELL, 1, 0, need_row,
                      map);
    if (!tasks || !burnish_tasks_cancelled(tasks)) {
        map->states = NULL;
    }
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
