/* A map is the sum of a dome, an environment and polygons. The polygons' light through each lobe is
 * computed in a smaller map, because it costs the most time. */
#include "environment/map_fill.h"

#include <stddef.h>
#include <string.h>

#include "core/numbers.h"
#include "core/vector.h"
#include "environment/areas.h"
#include "environment/environment_ops.h"
#include "shading/shading_ops.h"

/* The diffuse map is off by 3 % of the peak at the terminator of a tiny light and 0.3 % for softboxes;
 * spherical harmonics of order 2 are off by 9 %, of order 4 by 6 %. */
enum { LARGEST_SIZE = BURNISH_LIGHT_MAP_LARGEST, LEAST_SIZE = 24, DIFFUSE_SIZE = 32 };

/* Texels per side of a map, and of a lobe's own map, if the lobe's radius is 1. */
#define MAP_TEXELS 12.0f
#define LOBE_TEXELS 6.0f

/* Red, green, blue and 0; maps are aligned. */
typedef float texel __attribute__((vector_size(16), may_alias));

/* ---- Directions ---- */

/* Texels are computed in bands of rows, 4 x 4 after 4 x 4: neighbours meet the same edges of lights,
 * which a vector of them shares. */
enum { BLOCK = 4, BAND_MAX = BLOCK * (LARGEST_SIZE + 6) };

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

/* Rows and columns around the texels of a map, and of a lobe's own map, where each is needed. */
enum { BORDER = 1, WIDE_BORDER = 3 };

/* Unit vectors of the texels of a band, and their numbers in the map. Returns how many. */
static int band_directions(int size, int border, int band, int *numbers, float *const w[3]) {
    const int stride = size + 2 * border, from = band * BLOCK;
    const int end = from + BLOCK < 2 * stride ? from + BLOCK : 2 * stride;
    const float half = (float)size / 2, middle = (float)(stride - 1) / 2;
    int first[BLOCK], last[BLOCK], count = 0;
    for (int row = from; row < end; ++row) {
        first[row - from] = 0;
        last[row - from] = stride - 1;
        if (border == BORDER) {
            find_columns(size, row, &first[row - from], &last[row - from]);
        }
    }
    for (int i = 0; i < BLOCK * BLOCK * ((stride + BLOCK - 1) / BLOCK); ++i) {
        const int row = from + i / BLOCK % BLOCK;
        const int column = i / (BLOCK * BLOCK) * BLOCK + i % BLOCK;
        if (row < end && column >= first[row - from] && column <= last[row - from]) {
            w[0][count] = ((float)column - middle) / half;
            w[1][count] = ((float)(row % stride) - middle) / half;
            w[2][count] = row < stride ? 1 : -1;
            numbers[count++] = row * stride + column;
        }
    }
    for (int i = 0; i < count; ++i) {
        const float p = w[0][i], q = w[1][i], squared = p * p + q * q, scale = 1 / (1 + squared);
        w[0][i] = 2 * p * scale;
        w[1][i] = 2 * q * scale;
        w[2][i] *= (1 - squared) * scale;
    }
    return count;
}

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

static void add_environment(const burnish_map_filler *filler, const burnish_light_lobes *lobes,
                            const float *const w[3], int count, float *const rgb[3]) {
    static const burnish_light_lobes cosine = {1, {{1, 1.0f, 1.0f}}};
    const burnish_environment_ops *ops = burnish_environment_ops_for(filler->kernels->isa);
    const burnish_light_sources *sources = filler->sources;
    const burnish_environment *environment = sources->environment;
    float turned[3][BAND_MAX];
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
        const float most = zeta_limit(environment, lobe.order);
        lobe.zeta = lobe.zeta < most ? lobe.zeta : most;
        const burnish_environment_filter filter = {choose_level(environment, &lobe), lobe.zeta,
                                                   __builtin_ctz((unsigned)lobe.order)};
        ops->filter_environment(&filter, sources->strength * lobe.weight, axis, (size_t)count, rgb);
    }
}

/* ---- Polygons ---- */

/* Which directions receive none of a polygon's light, and which all of it. */
typedef struct reach {
    float middle[3], least;                    /* with a smaller cosine: none */
    int edge_count;                            /* 0: not used */
    float edge[BURNISH_POLYGON_VERTEX_MAX][3]; /* unit vectors toward the polygon's side */
    float sine; /* farther from the edges than this: all or, on the other side of one, none; 2
                   without edges */
    float all;
} reach;

/* Catmull and Rom's cubic through four texels. */
typedef struct cubic {
    int first;
    float weights[4];
} cubic;

/* The polygons' light through one lobe. */
typedef struct lobe_map {
    int size;
    float *texels;  /* with WIDE_BORDER */
    cubic *columns; /* of the map that it is added to */
} lobe_map;

typedef struct build {
    const burnish_map_filler *filler;
    int size, border;
    float *texels;
    const burnish_light_lobes *lobes; /* NULL: diffuse */
    lobe_map lobe_maps[BURNISH_LIGHT_LOBES_MAX];
    int lobe_map_count;
    burnish_polygon_constants polygons[BURNISH_AREA_LIGHT_MAX];
    reach reaches[BURNISH_AREA_LIGHT_MAX];
    const float *colors[BURNISH_AREA_LIGHT_MAX];
    int polygon_count;
} build;

/* The planes of the edges, for lobes that reach the cosine `lobe` < 1. */
static void find_edges(reach *r, const burnish_polygon_constants *polygon,
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

/* A cap around the polygon, wider by the widest lobe or, for diffuse light, by a right angle; and
 * the planes of its edges. */
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
    reach r = {.middle = {(float)middle.x, (float)middle.y, (float)middle.z},
               .least = is_cap ? (float)(radius * lobe - sines - 1e-5) : -2,
               .sine = 2};
    if (lobes && lobe > 0) {
        find_edges(&r, polygon, vertices, middle, lobe);
    }
    return r;
}

static void add_polygons(build *b) {
    const burnish_light_sources *from = b->filler->sources;
    for (int i = 0; i < from->distant_count; ++i) {
        burnish_area_light light = from->distant[i];
        burnish_polygon_constants *polygon = &b->polygons[b->polygon_count];
        light.is_distant = 1;
        if (burnish_area_polygon(&light, b->lobes, polygon)) {
            b->reaches[b->polygon_count] = find_reach(polygon, b->lobes);
            b->colors[b->polygon_count++] = from->distant[i].color;
        }
    }
}

/* Neighbouring texels, and how far they are from the first one. */
enum { GROUP = BLOCK * BLOCK, GROUPS_MAX = (BAND_MAX + GROUP - 1) / GROUP };

static void find_radii(const float *const w[3], int count, float radii[GROUPS_MAX]) {
    for (int g = 0; g * GROUP < count; ++g) {
        const int first = g * GROUP, end = first + GROUP < count ? first + GROUP : count;
        float most = 0;
        for (int i = first; i < end; ++i) {
            const float x = w[0][i] - w[0][first], y = w[1][i] - w[1][first];
            const float z = w[2][i] - w[2][first], squared = x * x + y * y + z * z;
            most = squared > most ? squared : most;
        }
        radii[g] = __builtin_sqrtf(most) + 1e-5f;
    }
}

/* How much of a polygon's light directions within a radius receive. */
typedef enum portion { NONE, SOME, ALL } portion;

static portion portion_of(const reach *r, const float w[3], float radius) {
    float nearest = r->edge_count > 0 ? 1 : 0;
    if (w[0] * r->middle[0] + w[1] * r->middle[1] + w[2] * r->middle[2] + radius <= r->least) {
        return NONE;
    }
    for (int e = 0; e < r->edge_count; ++e) {
        const float *n = r->edge[e], side = w[0] * n[0] + w[1] * n[1] + w[2] * n[2];
        nearest = side < nearest ? side : nearest;
    }
    return nearest - radius >= r->sine ? ALL : nearest + radius <= -r->sine ? NONE : SOME;
}

/* Adds a polygon in `count` directions, which are normals or the lobes' axes. */
static void add_polygon(const build *b, int number, const float *const w[3], int count,
                        const float radii[GROUPS_MAX], float *const rgb[3]) {
    const reach *r = &b->reaches[number];
    const float *color = b->colors[number];
    float reached[3][BAND_MAX], light[BAND_MAX];
    int numbers[BAND_MAX], reached_count = 0;
    for (int first = 0, end; first < count; first = end) {
        const float axis[3] = {w[0][first], w[1][first], w[2][first]};
        const portion all = portion_of(r, axis, radii[first / GROUP]);
        end = first + GROUP < count ? first + GROUP : count;
        for (int i = first; i < end && all != NONE; ++i) {
            const portion one =
                all == ALL ? ALL : portion_of(r, (float[3]){w[0][i], w[1][i], w[2][i]}, 0);
            for (int c = 0; c < 3; ++c) {
                reached[c][reached_count] = w[c][i];
                rgb[c][i] += one == ALL ? color[c] * r->all : 0;
            }
            numbers[reached_count] = i;
            reached_count += one == SOME;
        }
    }
    const burnish_kernels_axes axes = {.axis = {reached[0], reached[1], reached[2]}};
    burnish_kernels_points points = {.normal = {NULL}};
    for (int c = 0; c < 3 && !b->lobes; ++c) {
        points.normal[c] = reached[c];
    }
    b->filler->kernels->polygon_light(
        &b->polygons[number], &points, &axes, (size_t)reached_count,
        (float *const[2]){b->lobes ? NULL : light, b->lobes ? light : NULL});
    for (int c = 0; c < 3; ++c) {
        for (int i = 0; i < reached_count; ++i) {
            rgb[c][numbers[i]] += color[c] * light[i];
        }
    }
}

/* ---- Maps of lobes ---- */

static cubic find_cubic(int at, int size, int smaller) {
    const float middle = (float)(size + 1) / 2, scale = (float)smaller / (float)size;
    const float x = ((float)at - middle) * scale + (float)(smaller - 1) / 2 + WIDE_BORDER;
    const int before = (int)x; /* x is at least 2 */
    const float f = x - (float)before, f2 = f * f, f3 = f2 * f;
    return (cubic){before - 1,
                   {f2 - 0.5f * (f + f3), 1 - 2.5f * f2 + 1.5f * f3, 0.5f * f + 2 * f2 - 1.5f * f3,
                    0.5f * (f3 - f2)}};
}

/* Adds a lobe's map to some rows of a map. */
static void add_lobe_map(const build *b, const lobe_map *from, int band) {
    const int stride = b->size + 2 * BORDER, less = from->size + 2 * WIDE_BORDER;
    const texel *texels = (const texel *)from->texels;
    texel line[LARGEST_SIZE + 2 * WIDE_BORDER], *to = (texel *)b->texels;
    for (int row = band * BLOCK; row < band * BLOCK + BLOCK && row < 2 * stride; ++row) {
        const int half = row >= stride;
        const cubic c = find_cubic(row - half * stride, b->size, from->size);
        const texel *rows = texels + (ptrdiff_t)less * (half * less + c.first);
        int first, last;
        find_columns(b->size, row, &first, &last);
        for (int i = 0; i < less; ++i) {
            line[i] = rows[i] * c.weights[0] + rows[i + less] * c.weights[1] +
                      rows[i + 2 * less] * c.weights[2] + rows[i + 3 * less] * c.weights[3];
        }
        for (int i = first; i <= last; ++i) {
            const texel *t = line + from->columns[i].first;
            const float *w = from->columns[i].weights;
            to[row * stride + i] += t[0] * w[0] + t[1] * w[1] + t[2] * w[2] + t[3] * w[3];
        }
    }
}

/* ---- Maps ---- */

static void build_band(void *context, size_t band, int thread) {
    const build *b = context;
    const burnish_light_sources *sources = b->filler->sources;
    const int stride = b->size + 2 * b->border, from = (int)band * BLOCK * stride;
    float vectors[3][BAND_MAX], colors[3][BAND_MAX], radii[GROUPS_MAX];
    texel *texels = (texel *)b->texels;
    int numbers[BAND_MAX];
    const float *const w[3] = {vectors[0], vectors[1], vectors[2]};
    float *const rgb[3] = {colors[0], colors[1], colors[2]};
    const int count = band_directions(b->size, b->border, (int)band, numbers,
                                      (float *const[3]){vectors[0], vectors[1], vectors[2]});
    (void)thread;
    for (int i = from; i < from + BLOCK * stride && i < 2 * stride * stride; ++i) {
        texels[i] = (texel){0, 0, 0, 0};
    }
    for (int c = 0; c < 3; ++c) {
        memset(rgb[c], 0, (size_t)count * sizeof *rgb[c]);
    }
    if (sources->dome && b->border == BORDER) {
        add_dome(sources, b->lobes, w, count, rgb);
    }
    if (b->polygon_count > 0) {
        find_radii(w, count, radii);
    }
    for (int i = 0; i < b->polygon_count; ++i) {
        add_polygon(b, i, w, count, radii, rgb);
    }
    if (sources->environment && sources->strength > 0 && b->border == BORDER) {
        add_environment(b->filler, b->lobes, w, count, rgb);
    }
    for (int i = 0; i < count; ++i) {
        texels[numbers[i]] = (texel){rgb[0][i], rgb[1][i], rgb[2][i], 0};
    }
    for (int i = 0; i < b->lobe_map_count; ++i) {
        add_lobe_map(b, &b->lobe_maps[i], (int)band);
    }
}

/* Texels per side: a texel of a map has at most a third of the radius of a lobe. Then a bilinear
 * look-up across the edge of a light is at most 0.7 % of its radiance off. Maps of lobes have fewer
 * texels, because they are read by cubics. */
static int size_for(const burnish_map_filler *filler, const burnish_light_lobe *lobe,
                    float texels) {
    const int size = (int)(texels / lobe_radius(lobe) + 1) / 2 * 2;
    const int least = texels < MAP_TEXELS ? LEAST_SIZE / 3 : LEAST_SIZE;
    const int most = filler->sources->largest;
    return size < least ? least : size > most ? most : size;
}

static burnish_status fill(build *b) {
    const burnish_map_filler *filler = b->filler;
    burnish_memory *memory = filler->memory;
    const size_t rows = (size_t)b->size + 2 * (size_t)b->border;
    b->texels = burnish_allocate(memory, 2 * rows * rows, 4 * sizeof(float), "a map of light");
    if (!b->texels) {
        return memory->status;
    }
    burnish_tasks_run(filler->tasks, (2 * rows + BLOCK - 1) / BLOCK, 1, 0, build_band, b);
    return filler->tasks ? burnish_tasks_check(filler->tasks, memory->error) : BURNISH_STATUS_OK;
}

static burnish_status make_columns(const build *b, lobe_map *map) {
    const int count = b->size + 2 * BORDER;
    burnish_memory *memory = b->filler->memory;
    map->columns = burnish_allocate(memory, (size_t)count, sizeof *map->columns, "a map of light");
    for (int i = 0; i < count && map->columns; ++i) {
        map->columns[i] = find_cubic(i, b->size, map->size);
    }
    return memory->status;
}

/* The polygons' light through each lobe. */
static burnish_status fill_lobe_maps(build *b) {
    burnish_status status = BURNISH_STATUS_OK;
    for (int j = 0; j < b->lobes->count && status == BURNISH_STATUS_OK; ++j) {
        const burnish_light_lobes one = {1, {b->lobes->lobe[j]}};
        build own = {.filler = b->filler,
                     .size = size_for(b->filler, &one.lobe[0], LOBE_TEXELS),
                     .border = WIDE_BORDER,
                     .lobes = &one};
        add_polygons(&own);
        status = fill(&own);
        lobe_map *made = &b->lobe_maps[b->lobe_map_count++];
        made->size = own.size;
        made->texels = own.texels;
        if (status == BURNISH_STATUS_OK) {
            status = make_columns(b, made);
        }
    }
    return status;
}

burnish_status burnish_light_map_fill(const burnish_map_filler *filler, float alpha, int *size,
                                      float **texels) {
    const burnish_light_lobes lobes = burnish_light_lobes_for(alpha);
    build b = {.filler = filler, .size = DIFFUSE_SIZE, .border = BORDER};
    burnish_status status = BURNISH_STATUS_OK;
    if (alpha > 0) {
        b.lobes = &lobes;
        b.size = LEAST_SIZE;
        for (int j = 0; j < lobes.count; ++j) {
            const int own = size_for(filler, &lobes.lobe[j], MAP_TEXELS);
            b.size = own > b.size ? own : b.size;
        }
        status = filler->sources->distant_count > 0 ? fill_lobe_maps(&b) : status;
    } else {
        add_polygons(&b);
    }
    status = status == BURNISH_STATUS_OK ? fill(&b) : status;
    for (int i = 0; i < b.lobe_map_count; ++i) {
        burnish_release(filler->memory->context, b.lobe_maps[i].texels);
        burnish_release(filler->memory->context, b.lobe_maps[i].columns);
    }
    *size = b.size;
    *texels = b.texels;
    return status;
}
