/* Made normals: union-find over the corners that meet in a vertex, joined across smooth edges. */
#include "scene/normals.h"

#include <float.h>

#include "base/memory.h"

#define DEGREE (3.14159265358979323846 / 180)

/* Edges with at most this many faces at a vertex are compared face by face, so that the order of
 * the faces does not matter; beyond it only neighbours in that order are, so that the cost stays
 * linear. */
enum { PAIRWISE_MAX = 8 };

/* A sum shorter than this share of its weights is rounding noise around zero. */
#define CANCELLED 1e-9

burnish_vec3 burnish_face_cross(const float *positions, const uint32_t vertices[3]) {
    burnish_vec3 a = burnish_vec3_loadf(positions + 3 * (size_t)vertices[0]);
    burnish_vec3 b = burnish_vec3_loadf(positions + 3 * (size_t)vertices[1]);
    burnish_vec3 c = burnish_vec3_loadf(positions + 3 * (size_t)vertices[2]);
    return burnish_vec3_cross(burnish_vec3_sub(b, a), burnish_vec3_sub(c, a));
}

/* Shorter vectors, sums weighted by the tip of a needle, have squares that lose bits to underflow;
 * a power of two lengthens them. */
#define SHORT_LENGTH 0x1p-400
#define LENGTHEN 0x1p600

void burnish_store_unit(burnish_vec3 v, float unit[3]) {
    double length = burnish_vec3_length(v);
    if (length < SHORT_LENGTH) {
        v = burnish_vec3_scale(v, LENGTHEN);
        length = burnish_vec3_length(v);
    }
    double scale = length > 0 && length <= DBL_MAX ? 1 / length : 0;
    unit[0] = unit[1] = unit[2] = 0;
    if (scale > 0) {
        /* Adding 0 turns -0 into 0, so that equal normals have equal bits. */
        unit[0] = (float)(v.x * scale) + 0.0f;
        unit[1] = (float)(v.y * scale) + 0.0f;
        unit[2] = (float)(v.z * scale) + 0.0f;
    }
}

burnish_status burnish_fan_create(burnish_fan *fan, size_t max_faces, double crease_angle,
                                  burnish_error *error) {
    const char *what = "making normals";
    double sine;
    *fan = (burnish_fan){.flat = crease_angle <= 0};
    burnish_sincos(crease_angle * DEGREE, &sine, &fan->crease_cosine);
    burnish_status status = burnish_allocate((void **)&fan->face_normals, max_faces,
                                             sizeof *fan->face_normals, what, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_allocate((void **)&fan->sums, max_faces, sizeof *fan->sums, what, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status =
            burnish_allocate((void **)&fan->angles, max_faces, sizeof *fan->angles, what, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status =
            burnish_allocate((void **)&fan->parents, max_faces, sizeof *fan->parents, what, error);
    }
    if (status == BURNISH_STATUS_OK) {
        /* Each face has two edges at the vertex. */
        status =
            burnish_allocate((void **)&fan->edges, max_faces, 2 * sizeof *fan->edges, what, error);
    }
    if (status != BURNISH_STATUS_OK) {
        burnish_fan_destroy(fan);
    }
    return status;
}

void burnish_fan_destroy(burnish_fan *fan) {
    free(fan->face_normals);
    free(fan->sums);
    free(fan->angles);
    free(fan->parents);
    free(fan->edges);
    *fan = (burnish_fan){0};
}

static uint32_t find_root(uint32_t *parents, uint32_t i) {
    while (parents[i] != i) {
        parents[i] = parents[parents[i]];
        i = parents[i];
    }
    return i;
}

/* Joins faces i and j when the edge between them is smooth; the smaller root stays one. */
static void join(burnish_fan *fan, uint32_t i, uint32_t j) {
    if (burnish_vec3_dot(fan->face_normals[i], fan->face_normals[j]) <= fan->crease_cosine) {
        return;
    }
    i = find_root(fan->parents, i);
    j = find_root(fan->parents, j);
    if (i < j) {
        fan->parents[j] = i;
    } else {
        fan->parents[i] = j;
    }
}

/* Joins across every edge at the vertex; edges: count records {other end, face}, sorted. */
static void join_edges(burnish_fan *fan, size_t count) {
    const burnish_weld_record *edges = fan->edges;
    for (size_t start = 0, end; start < count; start = end) {
        for (end = start + 1; end < count && edges[end].key[0] == edges[start].key[0]; ++end) {
        }
        size_t reach = end - start <= PAIRWISE_MAX ? PAIRWISE_MAX : 1;
        for (size_t i = start; i < end; ++i) {
            for (size_t j = i + 1; j < end && j <= i + reach; ++j) {
                join(fan, edges[i].value, edges[j].value);
            }
        }
    }
}

/* Face normal and angle of each corner, and the two edges that leave the vertex there. */
static void measure_faces(burnish_fan *fan, const float *positions, const uint32_t *corner_vertices,
                          const uint32_t *corners, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        const uint32_t *face = corner_vertices + corners[i] / 3 * (size_t)3;
        uint32_t at = corners[i] % 3;
        uint32_t next = face[(at + 1) % 3], previous = face[(at + 2) % 3];
        burnish_vec3 origin = burnish_vec3_loadf(positions + 3 * (size_t)face[at]);
        burnish_vec3 a = burnish_vec3_sub(burnish_vec3_loadf(positions + 3 * (size_t)next), origin);
        burnish_vec3 b =
            burnish_vec3_sub(burnish_vec3_loadf(positions + 3 * (size_t)previous), origin);
        burnish_vec3 cross = burnish_face_cross(positions, face);
        fan->face_normals[i] = burnish_vec3_normalize(cross);
        fan->angles[i] = burnish_atan2(burnish_vec3_length(cross), burnish_vec3_dot(a, b));
        fan->sums[i] = (burnish_vec3){0, 0, 0};
        fan->parents[i] = (uint32_t)i;
        fan->edges[2 * i] = (burnish_weld_record){{next}, (uint32_t)i};
        fan->edges[2 * i + 1] = (burnish_weld_record){{previous}, (uint32_t)i};
    }
}

void burnish_fan_normals(burnish_fan *fan, const float *positions, const uint32_t *corner_vertices,
                         const uint32_t *corners, size_t count, float *normals) {
    measure_faces(fan, positions, corner_vertices, corners, count);
    if (!fan->flat) {
        burnish_weld_sort(fan->edges, 2 * count);
        join_edges(fan, 2 * count);
    }
    for (size_t i = 0; i < count; ++i) {
        uint32_t root = find_root(fan->parents, (uint32_t)i);
        fan->sums[root] = burnish_vec3_add(
            fan->sums[root], burnish_vec3_scale(fan->face_normals[i], fan->angles[i]));
    }
    for (size_t i = 0; i < count; ++i) {
        burnish_vec3 sum = fan->sums[find_root(fan->parents, (uint32_t)i)];
        /* No angle is larger than pi, so this also is a share of the largest weight. */
        int cancelled = !(burnish_vec3_length(sum) > CANCELLED * fan->angles[i]);
        burnish_store_unit(fan->flat || cancelled ? fan->face_normals[i] : sum, normals + 3 * i);
    }
}
