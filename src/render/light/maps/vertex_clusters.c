#include "render/light/maps/vertex_clusters.h"

#include <string.h>

#include "raster/geometry.h"
#include "render/space.h"

/* Cells along an axis have so many bits; vertices that no triangle uses may be outside. */
enum { AXIS_BITS = 10, AXIS_CELLS = 1 << AXIS_BITS };

enum {
    BLOCK = 256, /* vertices whose cells are found before they are looked up */
    PROBES = 8,
    LEAST_SLOTS = 1024,
    MOST_SLOTS = 1 << 19
};

/* The cells of vertices. */
static void find_cells(const float *positions, int count, const float origin[3], float scale,
                       uint32_t *cells) {
    for (int i = 0; i < count; ++i) {
        uint32_t cell = 0;
        for (int k = 0; k < 3; ++k) {
            const float most = AXIS_CELLS - 1;
            float at = (positions[3 * i + k] - origin[k]) * scale + (float)(AXIS_CELLS / 2);
            at = at > 0 ? at : 0;
            at = at < most ? at : most;
            cell = cell << AXIS_BITS | (uint32_t)(int32_t)at;
        }
        cells[i] = cell;
    }
}

/* The slot of a cell, or one that can be given to it. After PROBES slots another cell loses its own:
 * then two clusters are in one cell, but no mesh takes long. */
static uint64_t *find_slot(uint64_t *slots, size_t mask, uint32_t cell) {
    const size_t first = (uint32_t)(cell * 0x9e3779b1u) >> 12;
    for (size_t i = 0; i < PROBES; ++i) {
        uint64_t *slot = &slots[(first + i) & mask];
        if (!*slot || *slot >> 32 == cell + 1) {
            return slot;
        }
    }
    return &slots[first & mask];
}

/* Finds the cluster of each vertex, numbered by first use; returns how many there are. */
static uint32_t cluster_vertices(burnish_clusters *clusters, const burnish_mesh_view *mesh,
                                 float scale, size_t slot_count) {
    float origin[3];
    uint32_t cells[BLOCK], count = 0;
    burnish_space_store(burnish_space_center(mesh), origin);
    for (size_t first = 0; first < mesh->vertex_count; first += BLOCK) {
        const size_t rest = mesh->vertex_count - first;
        const int some = rest < BLOCK ? (int)rest : BLOCK;
        find_cells(mesh->positions + 3 * first, some, origin, scale, cells);
        for (int i = 0; i < some; ++i) {
            uint64_t *slot = find_slot(clusters->slots, slot_count - 1, cells[i]);
            if (!*slot || *slot >> 32 != cells[i] + 1) {
                *slot = (uint64_t)(cells[i] + 1) << 32 | count++;
            }
            clusters->cluster[first + (size_t)i] = (uint32_t)*slot;
        }
    }
    return count;
}

/* A cluster is where its first vertex is. */
static void place_clusters(burnish_clusters *clusters, const burnish_mesh_view *mesh,
                           uint32_t count) {
    uint32_t next = 0;
    for (size_t i = 0; next < count; ++i) {
        if (clusters->cluster[i] == next) {
            memcpy(clusters->positions + 3 * (size_t)next++, mesh->positions + 3 * i,
                   3 * sizeof *mesh->positions);
        }
    }
}

/* Writes the triangles that are left, and one more at most, or only counts them if `indices` is
 * NULL. */
static size_t cluster_triangles(const uint32_t *cluster, const burnish_mesh_view *mesh,
                                const uint16_t *transparent, uint32_t *indices) {
    size_t left = 0;
    uint32_t counted[3];
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        uint32_t *to = indices ? indices + 3 * left : counted;
        for (size_t k = 0; k < 3; ++k) {
            to[k] = cluster[mesh->indices[3 * i + k]];
        }
        const int is_left = (to[0] != to[1]) & (to[1] != to[2]) & (to[2] != to[0]);
        left += (size_t)is_left & ~(size_t)(transparent ? transparent[i / BURNISH_BATCH_SIZE] >>
                                                              i % BURNISH_BATCH_SIZE
                                                        : 0);
    }
    return left;
}

burnish_status burnish_clusters_make(burnish_clusters *clusters, const burnish_mesh_view *mesh,
                                     double cell, const uint16_t *transparent,
                                     burnish_memory *memory, burnish_mesh_view *coarse) {
    size_t slot_count = LEAST_SLOTS;
    while (slot_count < MOST_SLOTS && slot_count < 2 * mesh->vertex_count) {
        slot_count *= 2;
    }
    clusters->cluster =
        burnish_reserve_discard(memory, clusters->cluster, &clusters->cluster_capacity,
                                mesh->vertex_count, sizeof *clusters->cluster, "clusters");
    clusters->slots =
        burnish_reserve_discard(memory, clusters->slots, &clusters->slot_capacity, slot_count,
                                sizeof *clusters->slots, "cells of clusters");
    if (memory->status != BURNISH_STATUS_OK) {
        return memory->status;
    }
    memset(clusters->slots, 0, slot_count * sizeof *clusters->slots);
    const uint32_t count =
        cluster_vertices(clusters, mesh, (float)(burnish_space_scale(mesh) / cell), slot_count);
    const size_t left = cluster_triangles(clusters->cluster, mesh, transparent, NULL);
    clusters->positions =
        burnish_reserve_discard(memory, clusters->positions, &clusters->position_capacity, count,
                                3 * sizeof *clusters->positions, "positions of clusters");
    clusters->indices =
        burnish_reserve_discard(memory, clusters->indices, &clusters->index_capacity, left + 1,
                                3 * sizeof *clusters->indices, "triangles of clusters");
    if (memory->status == BURNISH_STATUS_OK) {
        place_clusters(clusters, mesh, count);
        *coarse = *mesh;
        coarse->positions = clusters->positions;
        coarse->indices = clusters->indices;
        coarse->vertex_count = count;
        coarse->triangle_count = left;
        cluster_triangles(clusters->cluster, mesh, transparent, clusters->indices);
    }
    return memory->status;
}

void burnish_clusters_destroy(burnish_clusters *clusters, const burnish_context *context) {
    burnish_release(context, clusters->positions);
    burnish_release(context, clusters->indices);
    burnish_release(context, clusters->cluster);
    burnish_release(context, clusters->slots);
    memset(clusters, 0, sizeof *clusters);
}
