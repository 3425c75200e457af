/* Which textures and coordinates a mesh keeps, and tangents for meshes with normal textures or
 * anisotropy.
 *
 * Tangents follow MikkTSpace (Mikkelsen 2008). The tangent of a triangle is the unit direction in
 * which u grows, projected onto the plane at right angles to the vertex normal, and weighted by the
 * triangle's angle at the vertex. The tangent of a vertex is their sum. Triangles whose image is
 * mirrored get separate vertices. MikkTSpace also separates triangles of one vertex that no edge
 * joins; here they share it. */
#include <string.h>

#include "mesh/build/builder.h"
#include "mesh/data/material.h"

/* ---- What is kept ---- */

/* Textures with coordinates that the mesh lacks are dropped. Returns how many use the second. */
static size_t settle_second(burnish_mesh_data *data) {
    const int has_second = data->streams[BURNISH_TEXCOORD2].count > 0;
    size_t count = 0;
    for (size_t i = 0; i < data->material_count * BURNISH_TEXTURE_SLOT_COUNT; ++i) {
        burnish_texture_use *use = &data->materials[i / BURNISH_TEXTURE_SLOT_COUNT]
                                        .textures[i % BURNISH_TEXTURE_SLOT_COUNT];
        count += use->coordinates != 0;
        if (use->coordinates && !has_second) {
            memset(use, 0, sizeof *use);
        }
    }
    return count;
}

static void drop_uses(burnish_mesh_data *data) {
    for (size_t i = 0; i < data->material_count; ++i) {
        memset(data->materials[i].textures, 0, sizeof data->materials[i].textures);
        memset(data->materials[i].anisotropy, 0, sizeof data->materials[i].anisotropy);
    }
    burnish_textures_release(data->memory.context, data->textures, data->texture_count);
    data->textures = NULL;
    data->texture_count = data->texture_capacity = 0;
}

void burnish_build_prepare_textures(burnish_builder *b, const burnish_load_options *options) {
    burnish_mesh_data *data = b->data;
    int any = 0;
    b->needs_tangents = 0;
    for (size_t i = 0; i < data->material_count; ++i) {
        any |= burnish_material_has_textures(&data->materials[i]);
        b->needs_tangents |= burnish_material_needs_tangents(&data->materials[i]);
    }
    if (any && !options->ignore_textures && data->streams[BURNISH_TEXCOORD].count == 0) {
        burnish_mesh_data_warn(data,
                               "%s: its materials use textures, but it has no texture coordinates; "
                               "it is drawn without textures",
                               burnish_show_name(b->name).text);
    }
    /* Images lie on triangles; the coordinates of points are values to colour by. */
    if (options->ignore_textures || data->streams[BURNISH_TEXCOORD].count == 0 ||
        data->point_count > 0) {
        drop_uses(data);
        any = b->needs_tangents = 0;
    }
    const size_t second = settle_second(data);
    if (second == 0) {
        burnish_mesh_data_drop(data, BURNISH_TEXCOORD2);
    } else if (data->streams[BURNISH_TEXCOORD2].count == 0) {
        burnish_mesh_data_warn(data,
                               "%s: %zu texture%s not drawn, as the mesh has no second set of "
                               "texture coordinates",
                               burnish_show_name(b->name).text, second,
                               second == 1 ? " is" : "s are");
    }
    if (!any && !b->needs_tangents && !options->keep_texture_coordinates) {
        burnish_mesh_data_drop(data, BURNISH_TEXCOORD);
    }
    if (!b->needs_tangents) {
        burnish_mesh_data_drop(data, BURNISH_TANGENT);
    }
}

/* ---- Triangles ---- */

static burnish_vec3 position_of(const burnish_mesh *mesh, uint32_t vertex) {
    return burnish_vec3_loadf((const float *)mesh->attributes[BURNISH_POSITION] +
                              3 * (size_t)vertex);
}

/* Edges of a triangle from its first corner, in space and in the image. */
typedef struct triangle_edges {
    burnish_vec3 edges[2];
    double u[2], v[2];
    double area; /* twice the area in the image: below 0 if it is mirrored */
} triangle_edges;

static triangle_edges edges_of(const burnish_mesh *mesh, const uint32_t *vertices) {
    const float *coordinates = mesh->attributes[BURNISH_TEXCOORD];
    const float *from = coordinates + 2 * (size_t)vertices[0];
    triangle_edges e;
    for (int k = 0; k < 2; ++k) {
        const float *to = coordinates + 2 * (size_t)vertices[k + 1];
        e.edges[k] =
            burnish_vec3_sub(position_of(mesh, vertices[k + 1]), position_of(mesh, vertices[0]));
        e.u[k] = (double)to[0] - (double)from[0];
        e.v[k] = (double)to[1] - (double)from[1];
    }
    e.area = e.u[0] * e.v[1] - e.u[1] * e.v[0];
    return e;
}

/* ---- Mirrored triangles get vertices of their own ---- */

enum { PLAIN = 1, MIRRORED = 2 };

/* The vertices that plain and mirrored triangles share: numbers[v] becomes their copy's, else v. */
static size_t number_copies(const burnish_builder *b, uint8_t *sides, uint32_t *numbers) {
    const burnish_mesh *mesh = b->mesh;
    size_t count = b->vertex_count;
    for (size_t i = 0; i < b->triangle_count; ++i) {
        const triangle_edges e = edges_of(mesh, mesh->indices + 3 * i);
        for (size_t k = 3 * i; k < 3 * i + 3; ++k) {
            sides[mesh->indices[k]] |= e.area > 0 ? PLAIN : e.area < 0 ? MIRRORED : 0;
        }
    }
    for (size_t v = 0; v < b->vertex_count; ++v) {
        numbers[v] = sides[v] == (PLAIN | MIRRORED) ? (uint32_t)count++ : (uint32_t)v;
    }
    return count;
}

static burnish_status copy_vertices(burnish_builder *b, const uint32_t *numbers, size_t count) {
    burnish_mesh *mesh = b->mesh;
    if (count > BURNISH_VALUE_LIMIT) {
        return burnish_fail(b->memory->error, BURNISH_STATUS_LIMIT,
                            "%s: more than 2^32 - 2 vertices; simplify the mesh",
                            burnish_show_name(b->name).text);
    }
    for (int a = 0; a < BURNISH_ATTRIBUTE_COUNT; ++a) {
        const size_t size = burnish_attribute_size((burnish_attribute)a);
        uint8_t *from = mesh->attributes[a];
        if (!from) {
            continue;
        }
        uint8_t *to = burnish_allocate(b->memory, count, size, "vertices");
        if (!to) {
            return b->memory->status;
        }
        memcpy(to, from, b->vertex_count * size);
        for (size_t v = 0; v < b->vertex_count; ++v) {
            if (numbers[v] != v) {
                memcpy(to + numbers[v] * size, from + v * size, size);
            }
        }
        mesh->attributes[a] = to;
        burnish_release(b->memory->context, from);
    }
    return BURNISH_STATUS_OK;
}

static void use_copies(burnish_builder *b, const uint32_t *numbers) {
    for (size_t i = 0; i < b->triangle_count; ++i) {
        uint32_t *vertices = b->mesh->indices + 3 * i;
        const int is_mirrored = edges_of(b->mesh, vertices).area < 0;
        for (int k = 0; k < 3 && is_mirrored; ++k) {
            vertices[k] = numbers[vertices[k]];
        }
    }
}

static burnish_status part_mirrored(burnish_builder *b) {
    uint8_t *sides = burnish_allocate_zeroed(b->memory, b->vertex_count, 1, "tangents");
    uint32_t *numbers = burnish_allocate(b->memory, b->vertex_count, sizeof *numbers, "tangents");
    burnish_status status = b->memory->status;
    if (status == BURNISH_STATUS_OK) {
        const size_t count = number_copies(b, sides, numbers);
        if (count > b->vertex_count) {
            status = copy_vertices(b, numbers, count);
            if (status == BURNISH_STATUS_OK) {
                use_copies(b, numbers);
                b->vertex_count = count;
            }
        }
    }
    burnish_release(b->memory->context, numbers);
    burnish_release(b->memory->context, sides);
    return status;
}

/* ---- Tangents ---- */

static burnish_vec3 normal_of(const burnish_mesh *mesh, uint32_t vertex) {
    return burnish_vec3_loadf((const float *)mesh->attributes[BURNISH_NORMAL] + 3 * (size_t)vertex);
}

/* The part of v at right angles to the unit vector n, as a unit vector. */
static burnish_vec3 orthogonal_part(burnish_vec3 v, burnish_vec3 n) {
    return burnish_vec3_normalize(
        burnish_vec3_sub(v, burnish_vec3_scale(n, burnish_vec3_dot(n, v))));
}

/* Adds a triangle's direction of u to its vertices' sums. */
static void add_triangle(const burnish_mesh *mesh, const uint32_t *vertices, float *tangents) {
    const triangle_edges e = edges_of(mesh, vertices);
    const double sign = e.area < 0 ? -1 : 1;
    const burnish_vec3 u =
        burnish_vec3_normalize(burnish_vec3_sub(burnish_vec3_scale(e.edges[0], sign * e.v[1]),
                                                burnish_vec3_scale(e.edges[1], sign * e.v[0])));
    for (int k = 0; k < 3 && e.area != 0; ++k) {
        const uint32_t vertex = vertices[k];
        const burnish_vec3 n = normal_of(mesh, vertex), at = position_of(mesh, vertex);
        const burnish_vec3 next =
            orthogonal_part(burnish_vec3_sub(position_of(mesh, vertices[(k + 1) % 3]), at), n);
        const burnish_vec3 previous =
            orthogonal_part(burnish_vec3_sub(position_of(mesh, vertices[(k + 2) % 3]), at), n);
        const double angle = burnish_acos(burnish_vec3_dot(next, previous));
        const burnish_vec3 part = burnish_vec3_scale(orthogonal_part(u, n), angle);
        float *sum = tangents + 4 * (size_t)vertex;
        sum[0] += (float)part.x;
        sum[1] += (float)part.y;
        sum[2] += (float)part.z;
        sum[3] = (float)sign;
    }
}

/* Any direction at right angles to n: along the axis from which n is farthest. */
static burnish_vec3 any_beside(burnish_vec3 n) {
    const double x = n.x < 0 ? -n.x : n.x, y = n.y < 0 ? -n.y : n.y, z = n.z < 0 ? -n.z : n.z;
    const burnish_vec3 axis = {x <= y && x <= z, !(x <= y && x <= z) && y <= z,
                               !(x <= y && x <= z) && !(y <= z)};
    return orthogonal_part(axis, n);
}

static void finish_tangent(const burnish_mesh *mesh, uint32_t vertex, float *tangent) {
    const burnish_vec3 n = normal_of(mesh, vertex);
    burnish_vec3 t = orthogonal_part(burnish_vec3_loadf(tangent), n);
    if (!(burnish_vec3_length(t) > 0.5)) {
        t = any_beside(n);
    }
    tangent[0] = (float)t.x;
    tangent[1] = (float)t.y;
    tangent[2] = (float)t.z;
    tangent[3] = tangent[3] < 0 ? -1.0f : 1.0f;
}

static void add_range(void *context, size_t first, size_t end) {
    const burnish_builder *b = context;
    for (size_t i = first; i < end; ++i) {
        add_triangle(b->mesh, b->mesh->indices + 3 * i, b->mesh->attributes[BURNISH_TANGENT]);
    }
}

static void finish_range(void *context, size_t first, size_t end) {
    const burnish_builder *b = context;
    float *tangents = b->mesh->attributes[BURNISH_TANGENT];
    for (size_t i = first; i < end; ++i) {
        finish_tangent(b->mesh, (uint32_t)i, tangents + 4 * i);
    }
}

burnish_status burnish_build_tangents(burnish_builder *b) {
    burnish_mesh *mesh = b->mesh;
    if (!b->needs_tangents) {
        return BURNISH_STATUS_OK;
    }
    if (!mesh->attributes[BURNISH_TANGENT]) {
        burnish_status status = part_mirrored(b);
        if (status == BURNISH_STATUS_OK) {
            mesh->attributes[BURNISH_TANGENT] =
                burnish_allocate_zeroed(b->memory, b->vertex_count, 4 * sizeof(float), "tangents");
            status = b->memory->status;
        }
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        burnish_tasks_in_order(b->data->tasks, b->triangle_count, BURNISH_BUILD_STEP, add_range, b);
    }
    burnish_tasks_ranges(b->data->tasks, b->vertex_count, BURNISH_BUILD_GRAIN, finish_range, b);
    return burnish_tasks_check(b->data->tasks, b->memory->error);
}
