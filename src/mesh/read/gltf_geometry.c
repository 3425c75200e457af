/* From glTF's nodes to the streams of mesh data: once to count, once to fill them.
 *
 * Only vertices that a triangle uses are taken: files often have one large array of vertices, of
 * which each primitive uses some. */
#include "core/elementary.h"
#include "core/srgb.h"
#include "mesh/read/gltf.h"

enum { STEP = 1 << 16 /* triangles after which it asks whether to end */ };

/* Triangles that nodes may make of one primitive again and again, where the caller sets no limit:
 * more than these must stand in the file. */
#define INSTANCED_ALWAYS ((uint64_t)1 << 25)

/* What is drawn at the moment: a primitive and its matrix. */
typedef struct gltf_drawer {
    burnish_gltf *gltf;
    burnish_mesh_data *mesh;
    int has[BURNISH_ATTRIBUTE_COUNT]; /* of any primitive */
    uint64_t triangles, vertices;     /* of all that is drawn */
    uint64_t limit;                   /* of triangles */
    size_t most_vertices;             /* of one primitive */
    uint32_t *slots;                  /* 1 + the vertex that became of one of the primitive's, where
                                         that is above `base` */
    uint32_t base;                    /* vertices before the primitive */
    uint16_t material;

    const burnish_gltf_primitive *primitive;
    const burnish_gltf_accessor *position, *normal, *color, *texcoord, *indices;
    double matrix[12];
    double cofactors[9]; /* turn normals, to their side where the matrix mirrors */
    int is_mirrored;
} gltf_drawer;

/* ---- Matrices ---- */

static void set_matrix(gltf_drawer *drawer, const double matrix[12]) {
    const double *m = matrix;
    double *c = drawer->cofactors;
    memcpy(drawer->matrix, matrix, sizeof drawer->matrix);
    for (int row = 0; row < 3; ++row) {
        const double *a = m + 4 * ((row + 1) % 3), *b = m + 4 * ((row + 2) % 3);
        for (int k = 0; k < 3; ++k) {
            const int i = (k + 1) % 3, j = (k + 2) % 3;
            c[3 * row + k] = a[i] * b[j] - a[j] * b[i];
        }
    }
    const double determinant = m[0] * c[0] + m[1] * c[1] + m[2] * c[2];
    drawer->is_mirrored = determinant < 0;
    for (int i = 0; i < 9 && drawer->is_mirrored; ++i) {
        c[i] = -c[i];
    }
}

static int put_position(gltf_drawer *drawer, size_t vertex, float *to) {
    double p[3];
    burnish_gltf_element(drawer->position, vertex, p);
    const double *m = drawer->matrix;
    for (int row = 0; row < 3; ++row, m += 4) {
        const double moved = m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3];
        if (!burnish_double_to_float(moved, &to[row])) {
            return burnish_gltf_fail(drawer->gltf, BURNISH_STATUS_FORMAT, drawer->position->value,
                                     "position %zu is not finite, or beyond 3.4e38; repair the "
                                     "mesh",
                                     vertex);
        }
    }
    return 1;
}

/* A unit vector; 0 where the file has none: it will be generated. */
static void put_normal(const gltf_drawer *drawer, size_t vertex, float *to) {
    double n[3], turned[3];
    to[0] = to[1] = to[2] = 0;
    if (!drawer->normal) {
        return;
    }
    burnish_gltf_element(drawer->normal, vertex, n);
    const double *c = drawer->cofactors;
    for (int row = 0; row < 3; ++row, c += 3) {
        turned[row] = c[0] * n[0] + c[1] * n[1] + c[2] * n[2];
    }
    const double length =
        burnish_sqrt(turned[0] * turned[0] + turned[1] * turned[1] + turned[2] * turned[2]);
    if (length > 0 && length < 1e300) {
        for (int i = 0; i < 3; ++i) {
            to[i] = (float)(turned[i] / length);
        }
    }
}

/* glTF's colours are linear light, the mesh's sRGB. */
static void put_color(const gltf_drawer *drawer, size_t vertex, uint8_t *to) {
    double color[4] = {1, 1, 1, 1};
    if (drawer->color) {
        burnish_gltf_element(drawer->color, vertex, color);
    }
    for (int i = 0; i < 3; ++i) {
        to[i] = burnish_linear_to_srgb((float)color[i]);
    }
    to[3] = 255; /* alpha counts only where the material says so */
}

/* v grows downwards in glTF, upwards in meshes. */
static void put_texcoord(const gltf_drawer *drawer, size_t vertex, float *to) {
    double uv[2] = {0, 0};
    if (drawer->texcoord) {
        burnish_gltf_element(drawer->texcoord, vertex, uv);
    }
    if (!burnish_double_to_float(uv[0], &to[0]) || !burnish_double_to_float(1 - uv[1], &to[1])) {
        to[0] = to[1] = 0;
    }
}

/* ---- Triangles ---- */

/* The vertex of the mesh for one of the primitive's; BURNISH_NONE on failure. */
static uint32_t take_vertex(gltf_drawer *drawer, uint32_t vertex) {
    burnish_mesh_data *mesh = drawer->mesh;
    if (vertex >= drawer->position->count) {
        burnish_gltf_fail(drawer->gltf, BURNISH_STATUS_FORMAT, drawer->indices->value,
                          "index %u is not below the %zu positions; the file is damaged", vertex,
                          drawer->position->count);
        return BURNISH_NONE;
    }
    if (drawer->slots[vertex] > drawer->base) {
        return drawer->slots[vertex] - 1;
    }
    const size_t at = mesh->streams[BURNISH_POSITION].count;
    if (!put_position(drawer, vertex, burnish_positions(mesh) + 3 * at)) {
        return BURNISH_NONE;
    }
    if (drawer->has[BURNISH_NORMAL]) {
        put_normal(drawer, vertex, burnish_normals(mesh) + 3 * at);
    }
    if (drawer->has[BURNISH_COLOR]) {
        put_color(drawer, vertex, burnish_colors(mesh) + 4 * at);
    }
    if (drawer->has[BURNISH_TEXCOORD]) {
        put_texcoord(drawer, vertex, (float *)mesh->streams[BURNISH_TEXCOORD].items + 2 * at);
    }
    ++mesh->streams[BURNISH_POSITION].count;
    drawer->slots[vertex] = (uint32_t)at + 1;
    return (uint32_t)at;
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

static void draw_triangles(gltf_drawer *drawer) {
    burnish_gltf *gltf = drawer->gltf;
    burnish_mesh_data *mesh = drawer->mesh;
    for (size_t i = 0; i < drawer->primitive->triangle_count; ++i) {
        uint32_t *corners = mesh->streams[BURNISH_POSITION].corners + 3 * mesh->triangle_count;
        for (unsigned k = 0; k < 3; ++k) {
            const uint32_t vertex = take_vertex(drawer, corner_of(drawer, i, k));
            if (vertex == BURNISH_NONE) {
                return;
            }
            corners[drawer->is_mirrored && k > 0 ? 3 - k : k] = vertex;
        }
        if (mesh->triangle_materials) {
            mesh->triangle_materials[mesh->triangle_count] = drawer->material;
        }
        ++mesh->triangle_count;
        if (i % STEP == STEP - 1) {
            gltf->status = burnish_tasks_check(mesh->tasks, gltf->reader->error);
            if (gltf->status != BURNISH_STATUS_OK) {
                return;
            }
        }
    }
}

static const burnish_gltf_accessor *accessor_of(const burnish_gltf *gltf, uint32_t number) {
    return number == BURNISH_GLTF_NONE ? NULL : &gltf->accessors[number];
}

static void draw_primitive(gltf_drawer *drawer, const burnish_gltf_primitive *primitive) {
    const burnish_gltf *gltf = drawer->gltf;
    drawer->primitive = primitive;
    drawer->position = accessor_of(gltf, primitive->position);
    drawer->normal = accessor_of(gltf, primitive->normal);
    drawer->color = accessor_of(gltf, primitive->color);
    drawer->texcoord = accessor_of(gltf, primitive->texcoord);
    drawer->indices = accessor_of(gltf, primitive->indices);
    drawer->base = (uint32_t)drawer->mesh->streams[BURNISH_POSITION].count;
    drawer->material =
        (uint16_t)(primitive->material == BURNISH_GLTF_NONE ? gltf->counts[BURNISH_GLTF_MATERIALS]
                                                            : primitive->material);
    draw_triangles(drawer);
}

static void count_primitive(gltf_drawer *drawer, const burnish_gltf_primitive *primitive) {
    burnish_gltf *gltf = drawer->gltf;
    const size_t vertices = gltf->accessors[primitive->position].count;
    const uint64_t used = 3 * (uint64_t)primitive->triangle_count;
    drawer->triangles += primitive->triangle_count;
    drawer->vertices += used < vertices ? used : vertices;
    drawer->most_vertices = vertices > drawer->most_vertices ? vertices : drawer->most_vertices;
    drawer->has[BURNISH_NORMAL] |= primitive->normal != BURNISH_GLTF_NONE;
    drawer->has[BURNISH_COLOR] |= primitive->color != BURNISH_GLTF_NONE;
    drawer->has[BURNISH_TEXCOORD] |= primitive->texcoord != BURNISH_GLTF_NONE;
    if (drawer->triangles > drawer->limit) {
        const uint64_t limit = gltf->reader->input->options->max_triangles;
        if (drawer->limit == limit) {
            gltf->status = burnish_fail_triangles(gltf->reader, NULL);
        } else {
            burnish_gltf_fail(gltf, BURNISH_STATUS_LIMIT, BURNISH_JSON_NONE,
                              "its nodes make more than %llu triangles of what a file of %zu bytes "
                              "holds; set a limit of triangles to draw them",
                              (unsigned long long)drawer->limit, gltf->reader->input->size);
        }
    }
}

/* Calls `use` for each primitive of each node that is drawn. */
static void for_each_primitive(gltf_drawer *drawer,
                               void (*use)(gltf_drawer *, const burnish_gltf_primitive *)) {
    const burnish_gltf *gltf = drawer->gltf;
    for (size_t i = 0; i < gltf->counts[BURNISH_GLTF_NODES]; ++i) {
        const burnish_gltf_node *node = &gltf->nodes[i];
        if (!node->is_drawn || node->mesh == BURNISH_GLTF_NONE) {
            continue;
        }
        set_matrix(drawer, node->matrix);
        for (uint32_t k = gltf->mesh_primitives[node->mesh];
             k < gltf->mesh_primitives[node->mesh + 1]; ++k) {
            use(drawer, &gltf->primitives[k]);
            if (gltf->status != BURNISH_STATUS_OK) {
                return;
            }
        }
    }
}

static void reserve(gltf_drawer *drawer) {
    burnish_gltf *gltf = drawer->gltf;
    burnish_mesh_data *mesh = drawer->mesh;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        if (drawer->has[i]) {
            burnish_mesh_data_reserve(mesh, (burnish_attribute)i, (size_t)drawer->vertices);
        }
    }
    burnish_mesh_data_reserve_corners(mesh, BURNISH_POSITION, (size_t)drawer->triangles);
    if (mesh->material_count > 1) {
        mesh->triangle_materials = burnish_reserve_discard(
            gltf->memory, mesh->triangle_materials, &mesh->triangle_material_capacity,
            (size_t)drawer->triangles, sizeof *mesh->triangle_materials, "triangle materials");
    }
    drawer->slots = burnish_allocate_zeroed(gltf->memory, drawer->most_vertices,
                                            sizeof *drawer->slots, "vertices");
    burnish_gltf_is_fine(gltf);
}

void burnish_gltf_read_geometry(burnish_gltf *gltf) {
    const burnish_load_options *options = gltf->reader->input->options;
    gltf_drawer drawer = {.gltf = gltf,
                          .mesh = gltf->reader->mesh,
                          .has = {[BURNISH_POSITION] = 1},
                          .limit = options->max_triangles};
    if (options->max_triangles == BURNISH_TRIANGLES_MAX) { /* the caller sets none */
        const uint64_t held = gltf->reader->input->size;
        drawer.limit = held < INSTANCED_ALWAYS ? INSTANCED_ALWAYS : held;
        drawer.limit =
            drawer.limit < options->max_triangles ? drawer.limit : options->max_triangles;
    }
    for_each_primitive(&drawer, count_primitive);
    drawer.has[BURNISH_TEXCOORD] &= options->keep_texture_coordinates;
    if (gltf->status == BURNISH_STATUS_OK && drawer.triangles == 0) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, BURNISH_JSON_NONE, "no triangles%s",
                          gltf->unsupported_modes.count > 0 ? ", and points and lines are not drawn"
                                                            : "; export the scene's meshes");
    }
    if (gltf->status != BURNISH_STATUS_OK) {
        return;
    }
    reserve(&drawer);
    if (gltf->status == BURNISH_STATUS_OK) {
        for_each_primitive(&drawer, draw_primitive);
    }
    const size_t count = drawer.mesh->streams[BURNISH_POSITION].count;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        drawer.mesh->streams[i].count = drawer.has[i] ? count : 0;
    }
    burnish_release(gltf->memory->context, drawer.slots);
}
