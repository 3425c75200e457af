#include "render/light/maps/casters.h"

#include <string.h>

#include "base/elementary.h"
#include "core/vec3.h"
#include "render/space.h"

/* Pieces' edges, per diagonal of the mesh's bounds, while the budget lasts. */
#define FINEST (1.0 / 512)

enum {
    PIECES_MOST = 1 << 17, /* parts of triangles that are looked at */
    HALVINGS_MOST = 12,    /* of a triangle's edges */
    TEXELS_MOST = 3        /* along a side of the texels that decide for a piece */
};

/* A corner of a piece: its position and its texture coordinates. */
typedef struct corner {
    float p[3];
    double uv[2];
} corner;

/* Pieces of one masked material. */
typedef struct cutter {
    burnish_casters *casters;
    burnish_memory *memory;
    const burnish_mesh_view *mesh;
    const burnish_textured_material *material;
    double carry;    /* area that should cast and does not */
    double finest;   /* squared length of edges that are not halved */
    size_t pieces;   /* so far */
    int is_too_many; /* 1: the budget or the memory is exhausted */
} cutter;

/* ---- Alpha ---- */

/* Least and greatest alpha, and its mean. */
typedef struct alpha_range {
    double least, most, mean;
} alpha_range;

static int wrapped_texel(long long i, int size, int wrap) {
    if (wrap == BURNISH_WRAP_CLAMP) {
        return i < 0 ? 0 : i >= size ? size - 1 : (int)i;
    }
    const long long period = wrap == BURNISH_WRAP_MIRROR ? 2LL * size : size;
    const long long at = ((i % period) + period) % period;
    return (int)(at < size ? at : period - 1 - at);
}

/* [0, 1] */
static double texel_at(const burnish_texture_levels *levels, int level, int x, int y, int channel) {
    const size_t i = 4 * ((size_t)levels->offset[level] +
                          (size_t)y * ((size_t)levels->width[level] + 1) + (size_t)x) +
                     (size_t)channel;
    return levels->texels ? (double)levels->texels[i] / BURNISH_TEXEL_ONE
                          : (double)levels->codes[i] / 255;
}

/* Texels of a level that a box of coordinates touches, along one axis: the first, and how many. */
static int side_of(double low, double high, int size, long long *first) {
    const double from = low * size, to = high * size;
    *first = (long long)from - (from < (double)(long long)from);
    const long long last = (long long)to - (to < (double)(long long)to);
    return last - *first < TEXELS_MOST ? (int)(last - *first) + 1 : TEXELS_MOST + 1;
}

/* A channel within the box of a piece's corners, from the largest level of which few texels decide.
 * A mean says that all is 0 or that all is 1, and nothing else. */
static alpha_range range_of(const burnish_texture_sampler *sampler, int channel,
                            const corner corners[3]) {
    const float *t = sampler->transform;
    const burnish_texture_levels *levels = sampler->levels;
    double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
    long long first[2];
    int count[2], level = 0;
    for (int i = 0; i < 3; ++i) {
        const double *uv = corners[i].uv;
        const double at[2] = {(double)t[0] * uv[0] + (double)t[1] * uv[1] + (double)t[2],
                              1 - ((double)t[3] * uv[0] + (double)t[4] * uv[1] + (double)t[5])};
        for (int k = 0; k < 2; ++k) {
            const double inside = at[k] > -0x1p20 ? at[k] < 0x1p20 ? at[k] : 0x1p20 : -0x1p20;
            low[k] = inside < low[k] ? inside : low[k];
            high[k] = inside > high[k] ? inside : high[k];
        }
    }
    for (;; ++level) {
        count[0] = side_of(low[0], high[0], levels->width[level], &first[0]);
        count[1] = side_of(low[1], high[1], levels->height[level], &first[1]);
        if ((count[0] <= TEXELS_MOST && count[1] <= TEXELS_MOST) || level == levels->count - 1) {
            break;
        }
    }
    alpha_range range = {1, 0, 0};
    for (int j = 0; j < count[1]; ++j) {
        for (int i = 0; i < count[0]; ++i) {
            const double value = texel_at(
                levels, level, wrapped_texel(first[0] + i, levels->width[level], sampler->wrap[0]),
                wrapped_texel(first[1] + j, levels->height[level], sampler->wrap[1]), channel);
            const double least = level == 0 ? value : value < 1 ? 0 : 1;
            const double most = level == 0 ? value : value > 0 ? 1 : 0;
            range.least = least < range.least ? least : range.least;
            range.most = most > range.most ? most : range.most;
            range.mean += value / (count[0] * count[1]);
        }
    }
    return range;
}

/* What the material's textures leave of a piece. */
static alpha_range alpha_of(const burnish_textured_material *material, const corner corners[3]) {
    static const int slots[2] = {BURNISH_TEXTURE_COLOR, BURNISH_TEXTURE_OPACITY};
    static const int channels[2] = {3, 0};
    const double solid = 1 - (double)material->material.transparency;
    alpha_range alpha = {solid, solid, solid};
    for (int i = 0; i < 2; ++i) {
        if (material->samplers[slots[i]].levels) {
            const alpha_range range = range_of(&material->samplers[slots[i]], channels[i], corners);
            alpha.least *= range.least;
            alpha.most *= range.most;
            alpha.mean *= range.mean;
        }
    }
    return alpha;
}

/* ---- Pieces ---- */

static double squared_edge(const corner *a, const corner *b) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double d = (double)a->p[k] - (double)b->p[k];
        sum += d * d;
    }
    return sum;
}

static corner middle_of(const corner *a, const corner *b) {
    corner c;
    for (int k = 0; k < 3; ++k) {
        c.p[k] = (float)(((double)a->p[k] + (double)b->p[k]) * 0.5);
    }
    for (int k = 0; k < 2; ++k) {
        c.uv[k] = (a->uv[k] + b->uv[k]) * 0.5;
    }
    return c;
}

static void add_indices(cutter *cut, const uint32_t vertices[3]) {
    burnish_casters *casters = cut->casters;
    const size_t own = 3 * cut->mesh->triangle_count;
    casters->indices =
        burnish_reserve(cut->memory, casters->indices, &casters->index_capacity,
                        own + casters->index_count + 3, sizeof *casters->indices, "casters");
    if (cut->memory->status == BURNISH_STATUS_OK) {
        memcpy(casters->indices + own + casters->index_count, vertices, 3 * sizeof *vertices);
        casters->index_count += 3;
    }
    cut->is_too_many |= cut->memory->status != BURNISH_STATUS_OK;
}

/* Appends a part of a triangle, with vertices of its own. */
static void add_piece(cutter *cut, const corner corners[3]) {
    burnish_casters *casters = cut->casters;
    const size_t own = 3 * cut->mesh->vertex_count;
    const uint32_t first = (uint32_t)((own + casters->position_count) / 3);
    const uint32_t vertices[3] = {first, first + 1, first + 2};
    casters->positions =
        burnish_reserve(cut->memory, casters->positions, &casters->position_capacity,
                        own + casters->position_count + 9, sizeof *casters->positions, "casters");
    if (cut->memory->status != BURNISH_STATUS_OK) {
        cut->is_too_many = 1;
        return;
    }
    for (int i = 0; i < 3; ++i) {
        memcpy(casters->positions + own + casters->position_count, corners[i].p,
               sizeof corners[i].p);
        casters->position_count += 3;
    }
    add_indices(cut, vertices);
}

static double area_of(const corner corners[3]) {
    burnish_vec3 p[3];
    for (int i = 0; i < 3; ++i) {
        p[i] = burnish_vec3_loadf(corners[i].p);
    }
    return burnish_vec3_length(
               burnish_vec3_cross(burnish_vec3_sub(p[1], p[0]), burnish_vec3_sub(p[2], p[0]))) *
           0.5;
}

/* Whether a partly opaque piece casts a full shadow. Error diffusion keeps the total area. */
static int takes_turn(cutter *cut, const corner corners[3], double share) {
    const double area = area_of(corners);
    cut->carry += share * area;
    if (cut->carry < area * 0.5 || area <= 0) {
        return 0;
    }
    cut->carry -= area;
    return 1;
}

/* Halves the edges of a triangle that is opaque in parts, until a piece is so small that it casts
 * all or nothing. vertices: its own, where it is a whole triangle, else NULL. */
static void cut_piece(cutter *cut, const corner corners[3], const uint32_t *vertices,
                      int halvings) {
    cut->pieces += halvings > 0;
    cut->is_too_many |= cut->pieces > PIECES_MOST;
    if (cut->is_too_many) {
        return;
    }
    const alpha_range alpha = alpha_of(cut->material, corners);
    const double cutoff = (double)cut->material->material.alpha_cutoff;
    int is_small = halvings == HALVINGS_MOST;
    if (alpha.most < cutoff) {
        return;
    }
    is_small |= squared_edge(&corners[0], &corners[1]) <= cut->finest &&
                squared_edge(&corners[1], &corners[2]) <= cut->finest &&
                squared_edge(&corners[2], &corners[0]) <= cut->finest;
    if (alpha.least >= cutoff || (is_small && takes_turn(cut, corners, alpha.mean))) {
        if (vertices) {
            add_indices(cut, vertices);
        } else {
            add_piece(cut, corners);
        }
    } else if (!is_small) {
        const corner *c = corners;
        const corner m[3] = {middle_of(&c[0], &c[1]), middle_of(&c[1], &c[2]),
                             middle_of(&c[2], &c[0])};
        const corner parts[4][3] = {
            {c[0], m[0], m[2]}, {m[0], c[1], m[1]}, {m[2], m[1], c[2]}, {m[0], m[1], m[2]}};
        for (int i = 0; i < 4; ++i) {
            cut_piece(cut, parts[i], NULL, halvings + 1);
        }
    }
}

/* Coordinates are the colour's; an opacity texture is taken to share them. */
static void load_corners(const burnish_mesh_view *mesh, const burnish_textured_material *material,
                         size_t triangle, corner corners[3]) {
    const float *coordinates = material->samplers[BURNISH_TEXTURE_COLOR].coordinates
                                   ? mesh->second_coordinates
                                   : mesh->texture_coordinates;
    const uint32_t *vertices = mesh->indices + 3 * triangle;
    for (int i = 0; i < 3; ++i) {
        const size_t v = vertices[i];
        memcpy(corners[i].p, mesh->positions + 3 * v, sizeof corners[i].p);
        for (size_t k = 0; k < 2; ++k) {
            corners[i].uv[k] = coordinates ? (double)coordinates[2 * v + k] : 0;
        }
    }
}

/* ---- The mesh that casts ---- */

static const burnish_textured_material *masked_material(const burnish_mesh_view *mesh,
                                                        const burnish_transparency *transparency,
                                                        size_t triangle) {
    const size_t number = mesh->triangle_materials ? mesh->triangle_materials[triangle] : 0;
    const burnish_textured_material *material =
        transparency->texturing ? &transparency->texturing->materials[number] : NULL;
    const int is_masked = material && material->is_alpha && !material->passes &&
                          material->material.alpha_mode == BURNISH_ALPHA_MASK;
    return is_masked ? material : NULL;
}

/* Pieces with edges of at most so long; returns 0 where they are too many. */
static int cut_all(burnish_casters *casters, const burnish_mesh_view *mesh,
                   const burnish_transparency *transparency, double finest,
                   burnish_memory *memory) {
    cutter cut = {.casters = casters, .memory = memory, .mesh = mesh, .finest = finest * finest};
    casters->position_count = casters->index_count = 0;
    for (size_t i = 0; i < mesh->triangle_count && !cut.is_too_many; ++i) {
        corner corners[3];
        cut.material = masked_material(mesh, transparency, i);
        if (cut.material) {
            load_corners(mesh, cut.material, i, corners);
            cut_piece(&cut, corners, mesh->indices + 3 * i, 0);
        }
    }
    return !cut.is_too_many;
}

static double masked_area(const burnish_mesh_view *mesh, const burnish_transparency *transparency) {
    double area = 0;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        corner corners[3];
        const burnish_textured_material *material = masked_material(mesh, transparency, i);
        if (material) {
            load_corners(mesh, material, i, corners);
            area += area_of(corners);
        }
    }
    return area;
}

/* Pieces as fine as the budget lets them be; in the end triangles are whole. */
static burnish_status cut_mesh(burnish_casters *casters, const burnish_mesh_view *mesh,
                               const burnish_transparency *transparency, burnish_memory *memory) {
    const double diagonal = 2 / burnish_space_scale(mesh);
    const double fits = burnish_sqrt(masked_area(mesh, transparency) / PIECES_MOST);
    double finest = fits > FINEST * diagonal ? fits : FINEST * diagonal;
    while (!cut_all(casters, mesh, transparency, finest, memory) &&
           memory->status == BURNISH_STATUS_OK) {
        finest = finest < diagonal ? finest * 2 : 1e300;
    }
    return memory->status;
}

/* Puts the mesh's own before the pieces'. */
static burnish_status join_arrays(burnish_casters *casters, const burnish_mesh_view *mesh,
                                  const burnish_transparency *transparency,
                                  burnish_memory *memory) {
    const size_t all = mesh->triangle_count + casters->index_count / 3;
    const size_t own = (mesh->triangle_count + BURNISH_BATCH_SIZE - 1) / BURNISH_BATCH_SIZE;
    const size_t batches = (all + BURNISH_BATCH_SIZE - 1) / BURNISH_BATCH_SIZE;
    casters->positions = burnish_reserve(memory, casters->positions, &casters->position_capacity,
                                         3 * mesh->vertex_count + casters->position_count,
                                         sizeof *casters->positions, "casters");
    casters->indices = burnish_reserve(memory, casters->indices, &casters->index_capacity, 3 * all,
                                       sizeof *casters->indices, "casters");
    casters->masks = burnish_reserve_discard(memory, casters->masks, &casters->mask_capacity,
                                             batches, sizeof *casters->masks, "casters");
    if (memory->status != BURNISH_STATUS_OK) {
        return memory->status;
    }
    memcpy(casters->positions, mesh->positions,
           3 * mesh->vertex_count * sizeof *casters->positions);
    memcpy(casters->indices, mesh->indices, 3 * mesh->triangle_count * sizeof *casters->indices);
    memset(casters->masks, 0, batches * sizeof *casters->masks);
    memcpy(casters->masks, transparency->masks, own * sizeof *casters->masks);
    casters->mesh.positions = casters->positions;
    casters->mesh.vertex_count = mesh->vertex_count + casters->position_count / 3;
    casters->mesh.indices = casters->indices;
    casters->mesh.triangle_count = all;
    casters->transparent = casters->masks;
    return BURNISH_STATUS_OK;
}

burnish_status burnish_casters_update(burnish_casters *casters, const burnish_mesh_view *mesh,
                                      const burnish_transparency *transparency,
                                      burnish_memory *memory) {
    const int is_known = casters->version == transparency->version;
    if (is_known && casters->index_count > 0) {
        return BURNISH_STATUS_OK;
    }
    casters->version = transparency->version;
    casters->mesh = *mesh;
    casters->mesh.serial = transparency->version;
    casters->transparent = transparency->has_some ? transparency->masks : NULL;
    if (is_known || !transparency->has_some || !(masked_area(mesh, transparency) > 0)) {
        casters->index_count = 0;
        return BURNISH_STATUS_OK;
    }
    casters->version = 0;
    burnish_status status = cut_mesh(casters, mesh, transparency, memory);
    if (status == BURNISH_STATUS_OK) {
        status = join_arrays(casters, mesh, transparency, memory);
    }
    casters->version = status == BURNISH_STATUS_OK ? transparency->version : 0;
    return status;
}

void burnish_casters_destroy(burnish_casters *casters, const burnish_context *context) {
    burnish_release(context, casters->positions);
    burnish_release(context, casters->indices);
    burnish_release(context, casters->masks);
    memset(casters, 0, sizeof *casters);
}
