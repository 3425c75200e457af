/* From glTF's nodes to the streams of mesh data: once to count, once to fill them.
 *
 * Only vertices that a triangle uses are read: files often have one large array of vertices, of
 * which each primitive uses a part. A scene without triangles is drawn as its lines, and a scene
 * without lines as its points: solids of the material's base colour. */
#include "mesh/read/gltf/gltf.h"

#include <stdatomic.h>

#include "base/elementary.h"
#include "base/numbers.h"
#include "core/srgb.h"
#include "core/vec3.h"
#include "mesh/read/common/beside_faces.h"
#include "mesh/read/common/damage.h"
#include "mesh/read/common/local_origin.h"
#include "mesh/read/common/parts.h"
#include "mesh/read/common/splats.h"
#include "mesh/read/common/textures.h"
#include "mesh/read/io/budget.h"

enum {
    STEP = 1 << 16, /* triangles between checks for cancellation */
    GRAIN = 1 << 12 /* vertices that a thread converts at once */
};

/* Faces with two sides have at most so many times the area of the others in a mesh of one-sided
 * ones: curtains and plants in a room. */
static const double TWO_SIDED_MOST = 0.25;

static const burnish_attribute texcoord_streams[2] = {BURNISH_TEXCOORD, BURNISH_TEXCOORD2};

/* The current primitive and its matrix. */
typedef struct gltf_drawer {
    burnish_gltf *gltf;
    burnish_mesh_data *mesh;
    burnish_gltf_kind kind;           /* of the primitives that are drawn */
    int has[BURNISH_ATTRIBUTE_COUNT]; /* of any primitive */
    uint64_t elements, vertices;      /* of all that is drawn */
    size_t most_vertices;             /* of one primitive */
    size_t most_used;                 /* vertices that one primitive can use */
    uint32_t *slots;   /* 1 + the new vertex of a primitive's vertex, if that is above `base` */
    uint32_t *sources; /* the primitive's vertices, from `base` on */
    uint32_t base;     /* vertices before the primitive */
    uint16_t material;
    double base_color[4];      /* of lines and points */
    burnish_segment *segments; /* lines */
    size_t segment_count;
    int sides;               /* 1: one-sided materials, 2: two-sided ones, 3: both */
    double areas[2];         /* twice those of their triangles; unless there are both, 1 instead */
    int is_beside;           /* 1: of a file with triangles, which has drawn those */
    burnish_part_list parts; /* of triangles, or of lines and points */

    const burnish_gltf_primitive *primitive;
    const burnish_gltf_accessor *position, *normal, *tangent, *color, *texcoords[2], *indices,
        *splats[4];
    int has_logarithms; /* 1: of splats' scales, as a draft had them */
    burnish_gltf_shape shape;
    int moves;         /* 1: morph targets or a skin move vertices one by one */
    atomic_size_t bad; /* the first vertex, from `base` on, that can't be placed */
} gltf_drawer;

/* A unit vector of the direction; 0 if there is none. */
static void put_unit(const double *direction, float *to) {
    const double *d = direction;
    const double length = d ? burnish_sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) : 0;
    for (int i = 0; i < 3; ++i) {
        to[i] = length > 0 && length < 1e300 ? (float)(d[i] / length) : 0;
    }
}

/* ---- Vertices ---- */

/* Writes position and normal; a missing normal becomes 0 and is generated later. Returns 0 if the
 * position exceeds single precision. p, n: of the file, or moved */
static int put_place(const gltf_drawer *drawer, const double p[3], const double n[3], float *to,
                     float *to_normal) {
    double turned[3];
    const double *m = drawer->shape.matrix, *c = drawer->shape.cofactors;
    for (int row = 0; row < 3; ++row, m += 4, c += 3) {
        const double moved = m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3];
        turned[row] = c[0] * n[0] + c[1] * n[1] + c[2] * n[2];
        if (!burnish_place(moved, drawer->mesh->origin[row], &to[row])) {
            return 0;
        }
    }
    if (to_normal) {
        put_unit(drawer->normal ? turned : NULL, to_normal);
    }
    return 1;
}

/* Bitangents are cross(n, t) times the sign, so mirroring changes the sign. */
static void put_tangent(const gltf_drawer *drawer, size_t vertex, float *to) {
    double t[4], turned[3];
    const double *m = drawer->shape.matrix;
    to[0] = to[1] = to[2] = to[3] = 0;
    if (!drawer->tangent) {
        return;
    }
    burnish_gltf_element(drawer->tangent, vertex, t);
    for (int row = 0; row < 3; ++row, m += 4) {
        turned[row] = m[0] * t[0] + m[1] * t[1] + m[2] * t[2];
    }
    put_unit(turned, to);
    to[3] = (t[3] < 0) != drawer->shape.is_mirrored ? -1.0f : 1.0f;
}

/* glTF's colours are linear light, the mesh's sRGB. */
static void put_color(const gltf_drawer *drawer, size_t vertex, uint8_t *to) {
    double color[4] = {1, 1, 1, 1};
    if (drawer->color) {
        burnish_gltf_element(drawer->color, vertex, color);
    }
    for (int i = 0; i < 3; ++i) {
        to[i] = burnish_linear_to_srgb((float)(color[i] * drawer->base_color[i]));
    }
    to[3] = 255; /* alpha counts only if the material enables it */
    if (drawer->kind == BURNISH_GLTF_TRIANGLES &&
        drawer->mesh->materials[drawer->material].alpha_mode != BURNISH_ALPHA_IGNORE &&
        drawer->color && drawer->color->width == 4) {
        to[3] = color[3] > 0 ? (uint8_t)(255 * (color[3] < 1 ? color[3] : 1) + 0.5) : 0;
    }
}

/* v grows downwards in glTF, upwards in meshes. */
static void put_texcoord(const burnish_gltf_accessor *texcoord, size_t vertex, float *to) {
    double uv[2] = {0, 0};
    if (texcoord) {
        burnish_gltf_element(texcoord, vertex, uv);
    }
    if (!burnish_double_to_float(uv[0], &to[0]) || !burnish_double_to_float(1 - uv[1], &to[1])) {
        to[0] = to[1] = 0;
    }
}

static void put_splat(const gltf_drawer *drawer, size_t vertex, burnish_splat *to) {
    double values[4][4] = {{0}, {0, 0, 0, 1}, {1}, {0}}, color[4] = {1, 1, 1, 1};
    burnish_splat_values stated;
    for (int i = 0; i < 4; ++i) {
        if (drawer->splats[i]) {
            burnish_gltf_element(drawer->splats[i], vertex, values[i]);
        }
    }
    if (drawer->color) {
        burnish_gltf_element(drawer->color, vertex, color);
    }
    for (int i = 0; i < 4; ++i) {
        stated.rotation[(i + 1) % 4] = (float)values[1][i];
    }
    for (int i = 0; i < 3; ++i) {
        const double scale = values[0][i];
        stated.scale[i] = (float)(drawer->has_logarithms ? burnish_splat_exp(scale) : scale);
        stated.color[i] = drawer->splats[3] ? burnish_splat_color(values[3][i]) : (float)color[i];
    }
    stated.opacity = (float)(drawer->splats[2] ? values[2][0] : color[3]);
    *to = burnish_splat_of(&stated);
    for (int i = 0; i < 3; ++i) {
        const double *m = drawer->shape.matrix;
        const double x = (double)to->axes[i][0], y = (double)to->axes[i][1],
                     z = (double)to->axes[i][2];
        for (int k = 0; k < 3; ++k, m += 4) {
            to->axes[i][k] = (float)(m[0] * x + m[1] * y + m[2] * z);
        }
    }
}

/* Whether a splat has a negative scale. */
static int has_logarithms(const burnish_gltf_accessor *scales) {
    double scale[4] = {0};
    int any = 0;
    for (size_t i = 0; scales && i < scales->count && !any; ++i) {
        burnish_gltf_element(scales, i, scale);
        any = scale[0] < 0 || scale[1] < 0 || scale[2] < 0;
    }
    return any;
}

/* Vertex `from` of the primitive as vertex `at` of the mesh. Returns 0 if it can't be placed: its
 * position is NaN then. */
static int convert_vertex(gltf_drawer *drawer, uint32_t from, size_t at) {
    burnish_mesh_data *mesh = drawer->mesh;
    double p[3], n[3] = {0, 0, 0};
    burnish_gltf_element(drawer->position, from, p);
    if (drawer->normal) {
        burnish_gltf_element(drawer->normal, from, n);
    }
    float *to = burnish_positions(mesh) + 3 * at,
          *to_normal = drawer->has[BURNISH_NORMAL] ? burnish_normals(mesh) + 3 * at : NULL;
    if (drawer->moves && !burnish_gltf_move(drawer->gltf, &drawer->shape, from, p, n)) {
        return 0;
    }
    const int is_placed = put_place(drawer, p, n, to, to_normal);
    for (int i = 0; i < 3 && !is_placed; ++i) {
        to[i] = __builtin_nanf("");
        if (to_normal) {
            to_normal[i] = 0;
        }
    }
    if (drawer->has[BURNISH_TANGENT]) {
        put_tangent(drawer, from, (float *)mesh->streams[BURNISH_TANGENT].items + 4 * at);
    }
    if (drawer->has[BURNISH_SPLAT]) {
        put_splat(drawer, from, (burnish_splat *)mesh->streams[BURNISH_SPLAT].items + at);
    }
    if (drawer->has[BURNISH_COLOR]) {
        put_color(drawer, from, burnish_colors(mesh) + 4 * at);
    }
    for (int i = 0; i < 2; ++i) {
        if (drawer->has[texcoord_streams[i]]) {
            put_texcoord(drawer->texcoords[i], from,
                         (float *)mesh->streams[texcoord_streams[i]].items + 2 * at);
        }
    }
    return is_placed;
}

/* Records the first vertex of all threads that can't be placed. */
static void convert_range(void *context, size_t first, size_t end) {
    gltf_drawer *drawer = context;
    for (size_t i = first; i < end; ++i) {
        if (!convert_vertex(drawer, drawer->sources[i], drawer->base + i)) {
            burnish_lower_to(&drawer->bad, i);
        }
    }
}

/* The vertices that the primitive's triangles, lines or points have taken. Those that move share
 * the matrix that moves them. */
static void convert_vertices(gltf_drawer *drawer) {
    burnish_gltf *gltf = drawer->gltf;
    const size_t count = drawer->mesh->streams[BURNISH_POSITION].count - drawer->base;
    atomic_init(&drawer->bad, SIZE_MAX);
    if (drawer->moves) {
        convert_range(drawer, 0, count);
    } else {
        burnish_tasks_ranges(drawer->mesh->tasks, count, GRAIN, convert_range, drawer);
        gltf->status = burnish_tasks_check(drawer->mesh->tasks, gltf->reader->error);
    }
    for (size_t i = atomic_load(&drawer->bad); i < count && gltf->status == BURNISH_STATUS_OK;
         ++i) {
        if (!burnish_is_finitef(burnish_positions(drawer->mesh)[3 * (drawer->base + i)])) {
            burnish_gltf_note(gltf, &gltf->reader->damage, drawer->position->value,
                              "position %u is not finite, or beyond 3.4e38; repair the mesh",
                              drawer->sources[i]);
        }
    }
}

/* ---- Triangles ---- */

/* The vertex of the mesh for a vertex of the primitive; BURNISH_NONE if that is out of range. */
static uint32_t take_vertex(gltf_drawer *drawer, uint32_t vertex) {
    if (vertex >= drawer->position->count) {
        return BURNISH_NONE;
    }
    if (drawer->slots[vertex] > drawer->base) {
        return drawer->slots[vertex] - 1;
    }
    const uint32_t at = (uint32_t)drawer->mesh->streams[BURNISH_POSITION].count++;
    drawer->sources[at - drawer->base] = vertex;
    drawer->slots[vertex] = at + 1;
    return at;
}

/* Of a triangle, line or point, which is left out. */
static void note_index(gltf_drawer *drawer, uint32_t index) {
    burnish_gltf_note(drawer->gltf, &drawer->gltf->reader->damage, drawer->indices->value,
                      "index %u is not below the %zu positions; the file is damaged", index,
                      drawer->position->count);
}

/* Corner k of triangle i, in the order that keeps the winding (section 3.7.2.1). */
static uint32_t corner_of(const gltf_drawer *drawer, size_t i, unsigned k) {
    size_t at;
    switch (drawer->primitive->mode) {
    case 5:
        at = k == 0 ? i : k == 1 ? i + 1 + i % 2 : i + 2 - i % 2;
        break;
    case 6:
        at = k == 2 ? 0 : i + 1 + k;
        break;
    default:
        at = 3 * i + k;
    }
    return drawer->indices ? burnish_gltf_integer(drawer->indices, at, 0) : (uint32_t)at;
}

static int is_two_sided(const burnish_gltf *gltf, const burnish_gltf_primitive *primitive) {
    if (primitive->material == BURNISH_GLTF_NONE) {
        return 0;
    }
    const uint32_t value = gltf->lists[BURNISH_GLTF_MATERIALS][primitive->material];
    return burnish_json_is_kind(&gltf->json, burnish_json_member(&gltf->json, value, "doubleSided"),
                                BURNISH_JSON_TRUE);
}

/* Adds the primitive's triangles to the area of its kind, which nothing asks for if it is the only
 * one. */
static void add_area(gltf_drawer *drawer, size_t first) {
    const burnish_mesh_data *mesh = drawer->mesh;
    const float *positions = burnish_positions(mesh);
    double *area = &drawer->areas[is_two_sided(drawer->gltf, drawer->primitive)];
    const int is_asked = drawer->sides == 3 && drawer->gltf->status == BURNISH_STATUS_OK;
    *area = is_asked ? *area : 1;
    for (size_t i = first; i < mesh->triangle_count && is_asked; ++i) {
        const uint32_t *corners = mesh->streams[BURNISH_POSITION].corners + 3 * i;
        burnish_vec3 p[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = burnish_vec3_loadf(positions + 3 * (size_t)corners[k]);
        }
        const double twice = burnish_vec3_length(
            burnish_vec3_cross(burnish_vec3_sub(p[1], p[0]), burnish_vec3_sub(p[2], p[0])));
        *area += twice > 0 ? twice : 0; /* a bad position is NaN */
    }
}

static void draw_triangles(gltf_drawer *drawer) {
    burnish_gltf *gltf = drawer->gltf;
    burnish_mesh_data *mesh = drawer->mesh;
    const size_t first = mesh->triangle_count;
    for (size_t i = 0; i < drawer->primitive->element_count; ++i) {
        uint32_t *corners = mesh->streams[BURNISH_POSITION].corners + 3 * mesh->triangle_count;
        unsigned k = 0;
        for (; k < 3; ++k) {
            const uint32_t index = corner_of(drawer, i, k), vertex = take_vertex(drawer, index);
            if (vertex == BURNISH_NONE) {
                note_index(drawer, index);
                break;
            }
            corners[drawer->shape.is_mirrored && k > 0 ? 3 - k : k] = vertex;
        }
        if (mesh->triangle_materials) {
            mesh->triangle_materials[mesh->triangle_count] = drawer->material;
        }
        mesh->triangle_count += k == 3;
        if (i % STEP == STEP - 1) {
            gltf->status = burnish_tasks_check(mesh->tasks, gltf->reader->error);
            if (gltf->status != BURNISH_STATUS_OK) {
                return;
            }
        }
    }
    convert_vertices(drawer);
    add_area(drawer, first);
}

/* Corner k of line or point i. */
static uint32_t end_of(const gltf_drawer *drawer, size_t i, size_t k) {
    const size_t at = drawer->primitive->mode == 1   ? 2 * i + k
                      : drawer->primitive->mode == 2 ? (i + k) % drawer->primitive->corner_count
                                                     : i + k;
    return drawer->indices ? burnish_gltf_integer(drawer->indices, at, 0) : (uint32_t)at;
}

static void draw_lines_or_points(gltf_drawer *drawer) {
    burnish_gltf *gltf = drawer->gltf;
    const size_t ends = drawer->kind == BURNISH_GLTF_LINES ? 2 : 1;
    for (size_t i = 0; i < drawer->primitive->element_count; ++i) {
        uint32_t vertices[2] = {0, 0};
        int is_good = 1;
        for (size_t k = 0; k < ends && is_good; ++k) {
            const uint32_t index = end_of(drawer, i, k);
            vertices[k] = take_vertex(drawer, index);
            is_good = vertices[k] != BURNISH_NONE;
            if (!is_good) {
                note_index(drawer, index);
            }
        }
        if (drawer->segments && is_good) {
            drawer->segments[drawer->segment_count++] =
                (burnish_segment){vertices[0], vertices[ends - 1]};
        }
        if (i % STEP == STEP - 1) {
            gltf->status = burnish_tasks_check(drawer->mesh->tasks, gltf->reader->error);
            if (gltf->status != BURNISH_STATUS_OK) {
                return;
            }
        }
    }
    convert_vertices(drawer);
}

/* Lines and points use only the base colour of a material. */
static void read_base_color(gltf_drawer *drawer) {
    burnish_gltf *gltf = drawer->gltf;
    const uint32_t material = drawer->primitive->material;
    for (int i = 0; i < 4; ++i) {
        drawer->base_color[i] = 1;
    }
    if (drawer->kind != BURNISH_GLTF_TRIANGLES && material != BURNISH_GLTF_NONE) {
        const uint32_t value = gltf->lists[BURNISH_GLTF_MATERIALS][material];
        gltf->is_lenient = 1;
        burnish_gltf_numbers(gltf, burnish_gltf_object(gltf, value, "pbrMetallicRoughness"),
                             "baseColorFactor", 4, drawer->base_color);
        gltf->is_lenient = 0;
    }
}

static const burnish_gltf_accessor *accessor_of(const burnish_gltf *gltf, uint32_t number) {
    return number == BURNISH_GLTF_NONE ? NULL : &gltf->accessors[number];
}

enum { SCALES_MAX = 256 };

/* A primitive's material. Nodes scale the thickness of volumes: each scale makes another material,
 * up to a limit. */
static uint16_t material_at(gltf_drawer *drawer, const burnish_gltf_primitive *primitive,
                            const double matrix[12]) {
    burnish_mesh_data *mesh = drawer->mesh;
    burnish_gltf *gltf = drawer->gltf;
    const size_t plain = gltf->counts[BURNISH_GLTF_MATERIALS];
    const size_t own = primitive->material == BURNISH_GLTF_NONE ? plain : primitive->material;
    size_t number = plain;
    double squares = 0;
    if (drawer->is_beside) { /* unlit, of materials of its own */
        return (uint16_t)own;
    }
    burnish_material scaled = mesh->materials[own];
    for (int i = 0; i < 12; ++i) {
        squares += i % 4 < 3 ? matrix[i] * matrix[i] / 3 : 0;
    }
    if (!(scaled.thickness > 0) || (squares > 0.9999 && squares < 1.0001)) {
        return (uint16_t)own;
    }
    const double thickness = (double)scaled.thickness * burnish_sqrt(squares);
    scaled.thickness = (float)(thickness < 1e30 ? thickness : 1e30);
    for (; number < mesh->material_count; ++number) {
        if (memcmp(&scaled, &mesh->materials[number], sizeof scaled) == 0) {
            return (uint16_t)number;
        }
    }
    mesh->materials = burnish_reserve(gltf->memory, mesh->materials, &mesh->material_capacity,
                                      number + 1, sizeof *mesh->materials, "materials");
    if (!burnish_gltf_is_fine(gltf) || number > plain + SCALES_MAX || number > UINT16_MAX) {
        return (uint16_t)own;
    }
    mesh->materials[mesh->material_count++] = scaled;
    return (uint16_t)number;
}

/* Splats are drawn apart. */
static int is_undrawn(const gltf_drawer *drawer, const burnish_gltf_primitive *primitive) {
    return drawer->has[BURNISH_SPLAT] != (primitive->splats[0] != BURNISH_GLTF_NONE);
}

static void find_splats(gltf_drawer *drawer, const burnish_gltf_node *node, const double matrix[12],
                        const burnish_gltf_primitive *primitive) {
    (void)node, (void)matrix;
    drawer->has[BURNISH_SPLAT] |= primitive->splats[0] != BURNISH_GLTF_NONE;
}

static void draw_primitive(gltf_drawer *drawer, const burnish_gltf_node *node,
                           const double matrix[12], const burnish_gltf_primitive *primitive) {
    burnish_gltf *gltf = drawer->gltf;
    if (burnish_gltf_kind_of(primitive) != drawer->kind || is_undrawn(drawer, primitive)) {
        return;
    }
    drawer->primitive = primitive;
    drawer->position = accessor_of(gltf, primitive->position);
    drawer->normal = accessor_of(gltf, primitive->normal);
    drawer->tangent = accessor_of(gltf, primitive->tangent);
    drawer->color = accessor_of(gltf, primitive->color);
    drawer->indices = accessor_of(gltf, primitive->indices);
    for (int i = 0; i < 2; ++i) {
        drawer->texcoords[i] = accessor_of(gltf, primitive->texcoords[i]);
    }
    for (int i = 0; i < 4; ++i) {
        drawer->splats[i] = accessor_of(gltf, primitive->splats[i]);
    }
    drawer->has_logarithms = has_logarithms(drawer->splats[0]);
    drawer->base = (uint32_t)drawer->mesh->streams[BURNISH_POSITION].count;
    drawer->material = material_at(drawer, primitive, matrix);
    burnish_gltf_set_shape(gltf, &drawer->shape, node, matrix, primitive);
    drawer->moves = drawer->shape.target_count > 0 || drawer->shape.set_count > 0;
    read_base_color(drawer);
    if (gltf->status == BURNISH_STATUS_OK) {
        if (drawer->kind == BURNISH_GLTF_TRIANGLES) {
            draw_triangles(drawer);
        } else {
            draw_lines_or_points(drawer);
        }
    }
}

static void count_primitive(gltf_drawer *drawer, const burnish_gltf_node *node,
                            const double matrix[12], const burnish_gltf_primitive *primitive) {
    burnish_gltf *gltf = drawer->gltf;
    (void)node;
    static const char *const kinds[] = {"points", "lines", "triangles"};
    const burnish_gltf_kind kind = burnish_gltf_kind_of(primitive);
    if (kind != drawer->kind || is_undrawn(drawer, primitive)) {
        const int is_later = drawer->is_beside || drawer->kind == BURNISH_GLTF_TRIANGLES ||
                             primitive->splats[0] != BURNISH_GLTF_NONE; /* add_beside, add_splats */
        if (!is_later) {
            burnish_gltf_note(gltf, &gltf->undrawn, primitive->value,
                              "%s are not drawn in a file with %s", kinds[kind],
                              drawer->has[BURNISH_SPLAT] ? "splats" : kinds[drawer->kind]);
        }
        return;
    }
    const size_t vertices = gltf->accessors[primitive->position].count;
    const uint64_t used = 3 * (uint64_t)primitive->element_count;
    drawer->elements += primitive->element_count;
    const size_t most = used < vertices ? (size_t)used : vertices;
    drawer->vertices += most;
    drawer->most_used = most > drawer->most_used ? most : drawer->most_used;
    drawer->most_vertices = vertices > drawer->most_vertices ? vertices : drawer->most_vertices;
    drawer->sides |= 1 << is_two_sided(gltf, primitive);
    drawer->has[BURNISH_NORMAL] |= primitive->normal != BURNISH_GLTF_NONE;
    drawer->has[BURNISH_TANGENT] |= primitive->tangent != BURNISH_GLTF_NONE;
    drawer->has[BURNISH_COLOR] |=
        primitive->color != BURNISH_GLTF_NONE ||
        (kind != BURNISH_GLTF_TRIANGLES && primitive->material != BURNISH_GLTF_NONE);
    for (int i = 0; i < 2; ++i) {
        drawer->has[texcoord_streams[i]] |= primitive->texcoords[i] != BURNISH_GLTF_NONE;
    }
    drawer->has[BURNISH_TEXCOORD] |= drawer->has[BURNISH_TEXCOORD2];
    material_at(drawer, primitive, matrix);
    if (drawer->is_beside && !drawer->has[BURNISH_SPLAT]) {
        return; /* burnish_fits_beside */
    }
    if (drawer->elements > gltf->reader->input->options->max_triangles) {
        gltf->status = burnish_fail_triangles(gltf->reader, NULL);
    } else if (kind == BURNISH_GLTF_TRIANGLES) {
        gltf->status = burnish_budget_check(gltf->reader, drawer->vertices, drawer->elements);
    } else {
        gltf->status = burnish_check_points(gltf->reader, (size_t)drawer->elements,
                                            kind == BURNISH_GLTF_LINES);
    }
}

typedef void use_primitive(gltf_drawer *drawer, const burnish_gltf_node *node,
                           const double matrix[12], const burnish_gltf_primitive *primitive);

static void for_each_of_mesh(gltf_drawer *drawer, const burnish_gltf_node *node,
                             const double matrix[12], use_primitive *use) {
    const burnish_gltf *gltf = drawer->gltf;
    for (uint32_t k = gltf->mesh_primitives[node->mesh];
         k < gltf->mesh_primitives[node->mesh + 1] && gltf->status == BURNISH_STATUS_OK; ++k) {
        use(drawer, node, matrix, &gltf->primitives[k]);
    }
}

/* EXT_mesh_gpu_instancing: the mesh at several places. */
static void for_each_instance(gltf_drawer *drawer, const burnish_gltf_node *node,
                              uint32_t instancing, use_primitive *use) {
    static const char *const names[3] = {"TRANSLATION", "ROTATION", "SCALE"};
    burnish_gltf *gltf = drawer->gltf;
    const uint32_t attributes = burnish_gltf_object(gltf, instancing, "attributes");
    const burnish_gltf_accessor *accessors[3] = {NULL, NULL, NULL};
    size_t count = SIZE_MAX;
    for (int i = 0; i < 3 && gltf->status == BURNISH_STATUS_OK; ++i) {
        const uint32_t number =
            burnish_gltf_reference(gltf, attributes, names[i], BURNISH_GLTF_ACCESSORS);
        if (number != BURNISH_GLTF_NONE) {
            accessors[i] = burnish_gltf_resolve(gltf, number, instancing, 1u << (i == 1 ? 4 : 3));
            count = accessors[i] && accessors[i]->count < count ? accessors[i]->count : count;
        }
    }
    count = count == SIZE_MAX ? 0 : count;
    for (size_t i = 0; i < count && gltf->status == BURNISH_STATUS_OK &&
                       gltf->mesh_primitives[node->mesh] < gltf->mesh_primitives[node->mesh + 1];
         ++i) {
        double parts[3][4] = {{0, 0, 0, 0}, {0, 0, 0, 1}, {1, 1, 1, 1}}, matrix[12];
        for (int k = 0; k < 3; ++k) {
            if (accessors[k]) {
                burnish_gltf_element(accessors[k], i, parts[k]);
            }
        }
        burnish_gltf_compose(parts[0], parts[1], parts[2], matrix);
        burnish_matrix_multiply(node->matrix, matrix, matrix);
        for_each_of_mesh(drawer, node, matrix, use);
    }
}

/* Triangles, or else lines and points, that have been drawn. */
static size_t count_drawn(const gltf_drawer *drawer) {
    return drawer->mesh->triangle_count + drawer->segment_count;
}

/* Calls `use` for each primitive of each node that is drawn. */
static void for_each_primitive(gltf_drawer *drawer, use_primitive *use) {
    burnish_gltf *gltf = drawer->gltf;
    for (size_t i = 0; i < gltf->counts[BURNISH_GLTF_NODES] && gltf->status == BURNISH_STATUS_OK;
         ++i) {
        const burnish_gltf_node *node = &gltf->nodes[i];
        if (!node->is_drawn || node->mesh == BURNISH_GLTF_NONE) {
            continue;
        }
        if (use == draw_primitive) {
            const burnish_part part = burnish_gltf_part_of(gltf, (uint32_t)i);
            burnish_parts_begin(&drawer->parts, &part, count_drawn(drawer));
        }
        const uint32_t instancing = burnish_gltf_extension(gltf, gltf->lists[BURNISH_GLTF_NODES][i],
                                                           "EXT_mesh_gpu_instancing");
        if (instancing != BURNISH_JSON_NONE) {
            for_each_instance(drawer, node, instancing, use);
        } else {
            for_each_of_mesh(drawer, node, node->matrix, use);
        }
    }
}

static void release_drawer(gltf_drawer *drawer) {
    const burnish_context *context = drawer->gltf->memory->context;
    burnish_release(context, drawer->segments);
    burnish_release(context, drawer->slots);
    burnish_release(context, drawer->sources);
    burnish_release(context, drawer->shape.targets);
    burnish_parts_release(&drawer->parts);
}

/* segments: lines, and points beside triangles */
static void reserve_streams(gltf_drawer *drawer, size_t segments) {
    burnish_gltf *gltf = drawer->gltf;
    burnish_mesh_data *mesh = drawer->mesh;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        if (drawer->has[i]) {
            burnish_mesh_data_reserve(mesh, (burnish_attribute)i, (size_t)drawer->vertices);
        }
    }
    if (drawer->kind == BURNISH_GLTF_TRIANGLES) {
        burnish_mesh_data_reserve_corners(mesh, BURNISH_POSITION, (size_t)drawer->elements);
    }
    if (segments > 0) {
        drawer->segments =
            burnish_allocate(gltf->memory, segments, sizeof *drawer->segments, "lines");
    }
    if (drawer->kind == BURNISH_GLTF_TRIANGLES && mesh->material_count > 1) {
        mesh->triangle_materials = burnish_reserve_discard(
            gltf->memory, mesh->triangle_materials, &mesh->triangle_material_capacity,
            (size_t)drawer->elements, sizeof *mesh->triangle_materials, "triangle materials");
    }
    drawer->slots = burnish_allocate_zeroed(gltf->memory, drawer->most_vertices,
                                            sizeof *drawer->slots, "vertices");
    drawer->sources =
        burnish_allocate(gltf->memory, drawer->most_used, sizeof *drawer->sources, "vertices");
    burnish_gltf_is_fine(gltf);
}

static void draw_all(gltf_drawer *drawer) {
    drawer->mesh->streams[BURNISH_POSITION].count = drawer->mesh->triangle_count = 0;
    drawer->segment_count = 0;
    drawer->areas[0] = drawer->areas[1] = 0;
    burnish_parts_release(&drawer->parts);
    drawer->gltf->reader->damage = (burnish_warning_group){0};
    if (drawer->gltf->status == BURNISH_STATUS_OK) {
        for_each_primitive(drawer, draw_primitive);
    }
}

/* Reads once more if nodes put the scene far away. */
static void draw_from_origin(gltf_drawer *drawer) {
    burnish_gltf *gltf = drawer->gltf;
    double origin[3];
    for (int i = 0; i < BURNISH_ORIGIN_TIMES && gltf->status == BURNISH_STATUS_OK &&
                    burnish_find_origin(drawer->mesh, origin);
         ++i) {
        memcpy(drawer->mesh->origin, origin, sizeof origin);
        memset(drawer->slots, 0, drawer->most_vertices * sizeof *drawer->slots);
        draw_all(drawer);
    }
}

/* Counts the elements that are drawn: triangles, or else lines, or else points. */
static void choose_kind(gltf_drawer *drawer) {
    burnish_gltf *gltf = drawer->gltf;
    for (int kind = BURNISH_GLTF_TRIANGLES;
         kind >= BURNISH_GLTF_POINTS && drawer->elements == 0 && gltf->status == BURNISH_STATUS_OK;
         --kind) {
        drawer->kind = (burnish_gltf_kind)kind;
        gltf->undrawn = (burnish_warning_group){0};
        if (kind == BURNISH_GLTF_POINTS) {
            for_each_primitive(drawer, find_splats);
        }
        for_each_primitive(drawer, count_primitive);
    }
}

/* Leaves out lines whose ends can't be placed. */
static void drop_segments(gltf_drawer *drawer) {
    size_t kept = 0;
    for (size_t i = 0; i < drawer->segment_count; ++i) {
        const burnish_segment segment = drawer->segments[i];
        if (burnish_is_good_position(drawer->mesh, segment.from) &&
            burnish_is_good_position(drawer->mesh, segment.to)) {
            drawer->segments[kept++] = segment;
        }
    }
    drawer->segment_count = kept;
    burnish_fill_positions(drawer->mesh);
}

/* Lines or points become solids, with the colours of vertices alone. */
static void make_solids(gltf_drawer *drawer) {
    burnish_gltf *gltf = drawer->gltf;
    if (gltf->reader->damage.count > 0 && drawer->segments) {
        drop_segments(drawer);
    }
    gltf->status = drawer->has[BURNISH_SPLAT]
                       ? burnish_make_splats(gltf->reader, 0)
                       : burnish_make_points(gltf->reader, drawer->segments, drawer->segment_count);
    drawer->mesh->materials[0] = burnish_material_default();
    drawer->mesh->material_count = 1;
}

/* Lists the parts of lines and points, which have become triangles, equally many each. */
static void add_parts_beside(gltf_drawer *drawer, burnish_part_list *parts) {
    const burnish_mesh_data *mesh = drawer->gltf->reader->mesh;
    const size_t each = mesh->beside_count / drawer->segment_count;
    const size_t base = mesh->triangle_count - mesh->beside_count;
    burnish_parts_count(&drawer->parts, count_drawn(drawer));
    for (size_t i = 0; i < drawer->parts.run_count; ++i) {
        const burnish_part_run *run = &drawer->parts.runs[i];
        burnish_part part = drawer->parts.parts[run->part];
        part.triangle_count = 0;
        burnish_parts_begin(parts, &part, base + each * run->first_triangle);
    }
}

/* Adds the lines and points of a file with triangles. */
static void add_beside(burnish_gltf *gltf, burnish_part_list *parts) {
    burnish_mesh_data *mesh = gltf->reader->mesh;
    burnish_mesh_data ends =
        burnish_mesh_data_begin(gltf->memory->context, mesh->tasks, gltf->reader->error);
    gltf_drawer drawer = {.gltf = gltf,
                          .mesh = &ends,
                          .has = {[BURNISH_POSITION] = 1},
                          .parts = {.memory = gltf->memory, .join = BURNISH_JOIN_IDS}};
    memcpy(ends.origin, mesh->origin, sizeof ends.origin);
    drawer.is_beside = 1;
    for (int kind = BURNISH_GLTF_POINTS; kind <= BURNISH_GLTF_LINES; ++kind) {
        drawer.kind = (burnish_gltf_kind)kind;
        for_each_primitive(&drawer, count_primitive);
    }
    if (gltf->status != BURNISH_STATUS_OK || drawer.elements == 0 ||
        !burnish_fits_beside(gltf->reader, drawer.elements)) {
        return;
    }
    drawer.has[BURNISH_NORMAL] = drawer.has[BURNISH_TANGENT] = 0;
    drawer.has[BURNISH_TEXCOORD] = drawer.has[BURNISH_TEXCOORD2] = 0;
    reserve_streams(&drawer, (size_t)drawer.elements);
    if (gltf->memory->status == BURNISH_STATUS_OK) {
        gltf->memory->status = ends.memory.status;
    }
    for (int kind = BURNISH_GLTF_POINTS; kind <= BURNISH_GLTF_LINES && burnish_gltf_is_fine(gltf);
         ++kind) {
        drawer.kind = (burnish_gltf_kind)kind;
        for_each_primitive(&drawer, draw_primitive);
    }
    if (gltf->reader->damage.count > 0) {
        drop_segments(&drawer);
    }
    if (gltf->status == BURNISH_STATUS_OK) {
        gltf->status =
            burnish_add_beside(gltf->reader, &ends, drawer.segments, drawer.segment_count);
    }
    if (gltf->status == BURNISH_STATUS_OK && drawer.segment_count > 0) {
        add_parts_beside(&drawer, parts);
    }
    release_drawer(&drawer);
    burnish_mesh_data_destroy(&ends);
}

/* Adds the splats of a file with triangles or lines, which stay if no splat can be placed. */
static void add_splats(burnish_gltf *gltf) {
    burnish_mesh_data *mesh = gltf->reader->mesh, *splats;
    gltf_drawer drawer = {.gltf = gltf,
                          .kind = BURNISH_GLTF_POINTS,
                          .is_beside = 1,
                          .parts = {.memory = gltf->memory}};
    for_each_primitive(&drawer, find_splats);
    drawer.has[BURNISH_POSITION] = 1;
    if (drawer.has[BURNISH_SPLAT]) {
        for_each_primitive(&drawer, count_primitive);
    }
    if (drawer.elements == 0 || !burnish_gltf_is_fine(gltf)) {
        return;
    }
    gltf->status =
        burnish_check_points(gltf->reader, (size_t)drawer.elements + mesh->triangle_count, 0);
    splats = burnish_mesh_data_add_splats(mesh);
    if (gltf->status == BURNISH_STATUS_OK && splats) {
        drawer.mesh = splats;
        drawer.has[BURNISH_NORMAL] = drawer.has[BURNISH_TANGENT] = drawer.has[BURNISH_COLOR] = 0;
        drawer.has[BURNISH_TEXCOORD] = drawer.has[BURNISH_TEXCOORD2] = 0;
        reserve_streams(&drawer, 0);
        gltf->memory->status = splats->memory.status;
    }
    if (burnish_gltf_is_fine(gltf)) {
        for_each_primitive(&drawer, draw_primitive);
    }
    if (gltf->status == BURNISH_STATUS_OK) {
        splats->streams[BURNISH_SPLAT].count = splats->streams[BURNISH_POSITION].count;
        gltf->status = burnish_make_splats_beside(gltf->reader);
    }
    release_drawer(&drawer);
}

void burnish_gltf_read_geometry(burnish_gltf *gltf) {
    const burnish_load_options *options = gltf->reader->input->options;
    gltf_drawer drawer = {.gltf = gltf,
                          .mesh = gltf->reader->mesh,
                          .has = {[BURNISH_POSITION] = 1},
                          .parts = {.memory = gltf->memory, .join = BURNISH_JOIN_IDS}};
    choose_kind(&drawer);
    drawer.has[BURNISH_TEXCOORD] &=
        burnish_reader_keeps_coordinates(gltf->reader, drawer.mesh->texture_count > 0);
    drawer.has[BURNISH_TEXCOORD2] &= drawer.has[BURNISH_TEXCOORD];
    drawer.has[BURNISH_TANGENT] &= drawer.mesh->texture_count > 0;
    const char *scalar = options->scalar_property;
    if (gltf->status == BURNISH_STATUS_OK && scalar && !drawer.has[BURNISH_TEXCOORD]) {
        gltf->status = burnish_reader_fail(gltf->reader, BURNISH_STATUS_FORMAT, NULL,
                                           "no vertex attribute \"%.60s\" of one number to colour "
                                           "by; glTF's names of such attributes begin with _",
                                           scalar);
    }
    if (gltf->status == BURNISH_STATUS_OK && drawer.elements == 0) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, BURNISH_JSON_NONE,
                          "no triangles; export the scene's meshes");
    }
    if (gltf->status != BURNISH_STATUS_OK) {
        return;
    }
    reserve_streams(&drawer, drawer.kind == BURNISH_GLTF_LINES ? (size_t)drawer.elements : 0);
    draw_all(&drawer);
    if (!options->origin) {
        draw_from_origin(&drawer);
    }
    drawer.mesh->is_one_sided = drawer.areas[1] <= TWO_SIDED_MOST * drawer.areas[0];
    const size_t count = drawer.mesh->streams[BURNISH_POSITION].count;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        drawer.mesh->streams[i].count = drawer.has[i] ? count : 0;
    }
    if (gltf->status == BURNISH_STATUS_OK && drawer.kind != BURNISH_GLTF_TRIANGLES) {
        make_solids(&drawer);
    } else if (gltf->status == BURNISH_STATUS_OK && !scalar) {
        burnish_parts_count(&drawer.parts, drawer.mesh->triangle_count);
        add_beside(gltf, &drawer.parts);
    }
    if (gltf->status == BURNISH_STATUS_OK && drawer.kind != BURNISH_GLTF_POINTS) {
        add_splats(gltf);
    }
    if (drawer.kind == BURNISH_GLTF_TRIANGLES && burnish_gltf_is_fine(gltf)) {
        burnish_parts_finish(&drawer.parts, drawer.mesh, 1);
        burnish_gltf_is_fine(gltf);
    }
    release_drawer(&drawer);
}
