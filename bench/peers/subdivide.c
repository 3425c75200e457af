/* Subdivision at the edges' middles, each edge found by a hash table. */
#include "subdivide.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct soup {
    float *positions, *normals; /* 3 per vertex */
    uint32_t *indices;
    size_t vertices, triangles;
} soup;

/* Open addressing; key 0 is empty, since no edge has both ends at vertex 0. */
typedef struct edge_table {
    uint64_t *keys;
    uint32_t *middles;
    size_t mask;
} edge_table;

static void soup_free(soup *mesh) {
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->indices);
    memset(mesh, 0, sizeof *mesh);
}

static int soup_allocate(soup *mesh, size_t vertices, size_t triangles) {
    memset(mesh, 0, sizeof *mesh);
    mesh->positions = calloc(vertices, 3 * sizeof *mesh->positions);
    mesh->normals = calloc(vertices, 3 * sizeof *mesh->normals);
    mesh->indices = calloc(triangles, 3 * sizeof *mesh->indices);
    if (!mesh->positions || !mesh->normals || !mesh->indices) {
        soup_free(mesh);
        return 0;
    }
    return 1;
}

static void add_middle(soup *mesh, uint32_t a, uint32_t b) {
    float *position = mesh->positions + 3 * mesh->vertices;
    float *normal = mesh->normals + 3 * mesh->vertices;
    double sum[3], squared = 0;
    for (size_t k = 0; k < 3; ++k) {
        position[k] = (mesh->positions[3 * (size_t)a + k] + mesh->positions[3 * (size_t)b + k]) / 2;
        sum[k] = (double)mesh->normals[3 * (size_t)a + k] + mesh->normals[3 * (size_t)b + k];
        squared += sum[k] * sum[k];
    }
    for (size_t k = 0; k < 3; ++k) { /* opposite normals: either will do */
        normal[k] =
            squared > 0 ? (float)(sum[k] / sqrt(squared)) : mesh->normals[3 * (size_t)a + k];
    }
    ++mesh->vertices;
}

static uint32_t middle(edge_table *table, soup *mesh, uint32_t a, uint32_t b) {
    uint64_t key = a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
    size_t slot = (size_t)(key * 0x9e3779b97f4a7c15u >> 20) & table->mask;
    while (table->keys[slot] && table->keys[slot] != key) {
        slot = (slot + 1) & table->mask;
    }
    if (!table->keys[slot]) {
        table->keys[slot] = key;
        table->middles[slot] = (uint32_t)mesh->vertices;
        add_middle(mesh, a, b);
    }
    return table->middles[slot];
}

static void split(soup *out, edge_table *table, const uint32_t v[3]) {
    uint32_t ab = middle(table, out, v[0], v[1]);
    uint32_t bc = middle(table, out, v[1], v[2]);
    uint32_t ca = middle(table, out, v[2], v[0]);
    const uint32_t four[12] = {v[0], ab, ca, ab, v[1], bc, ca, bc, v[2], ab, bc, ca};
    memcpy(out->indices + 3 * out->triangles, four, sizeof four);
    out->triangles += 4;
}

/* Replaces the mesh by the finer one; returns 0 if memory is short. */
static int subdivide_once(soup *mesh) {
    soup out;
    edge_table table = {NULL, NULL, 1};
    size_t edges = 3 * mesh->triangles; /* at most */
    while (table.mask < 2 * edges) {
        table.mask *= 2;
    }
    table.keys = calloc(table.mask, sizeof *table.keys);
    table.middles = calloc(table.mask, sizeof *table.middles);
    --table.mask;
    int made = soup_allocate(&out, mesh->vertices + edges, 4 * mesh->triangles);
    if (made && table.keys && table.middles) {
        memcpy(out.positions, mesh->positions, 3 * mesh->vertices * sizeof *out.positions);
        memcpy(out.normals, mesh->normals, 3 * mesh->vertices * sizeof *out.normals);
        out.vertices = mesh->vertices;
        for (size_t i = 0; i < mesh->triangles; ++i) {
            split(&out, &table, mesh->indices + 3 * i);
        }
        soup_free(mesh);
        *mesh = out;
    } else if (made) {
        soup_free(&out);
        made = 0;
    }
    free(table.keys);
    free(table.middles);
    return made;
}

burnish_status burnish_peers_subdivide(const burnish_mesh *scene, int levels, burnish_mesh **finer,
                                       burnish_error *error) {
    const burnish_mesh_view *from = burnish_mesh_get_view(scene);
    burnish_load_options load = burnish_load_options_default();
    soup mesh;
    *finer = NULL;
    int made = soup_allocate(&mesh, from->vertex_count, from->triangle_count);
    if (made) {
        mesh.vertices = from->vertex_count;
        mesh.triangles = from->triangle_count;
        memcpy(mesh.positions, from->positions, 3 * mesh.vertices * sizeof *mesh.positions);
        memcpy(mesh.normals, from->normals, 3 * mesh.vertices * sizeof *mesh.normals);
        memcpy(mesh.indices, from->indices, 3 * mesh.triangles * sizeof *mesh.indices);
    }
    for (int i = 0; i < levels && made; ++i) {
        made = subdivide_once(&mesh);
    }
    if (!made) {
        soup_free(&mesh);
        snprintf(error->text, sizeof error->text, "subdivision: out of memory");
        return BURNISH_STATUS_MEMORY;
    }
    burnish_mesh_description arrays = burnish_mesh_description_default();
    arrays.positions = (burnish_array){mesh.positions, mesh.vertices, 0};
    arrays.normals = (burnish_array){mesh.normals, mesh.vertices, 0};
    arrays.indices = (burnish_array){mesh.indices, 3 * mesh.triangles, 0};
    burnish_status status = burnish_mesh_create(&arrays, &load, finer, error);
    soup_free(&mesh);
    return status;
}
