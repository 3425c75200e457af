/* The shapes of URDF: boxes, and solids of revolution about Z, all around the origin. */
#include <string.h>

#include "base/elementary.h"
#include "mesh/read/scene/urdf.h"

enum { SIDES = 48, RINGS = 24, PROFILE = RINGS + 1 };

/* A point of the outline: its distance from the axis, and its height. */
typedef struct profile_point {
    double radius, height;
} profile_point;

typedef struct shape_writer {
    burnish_mesh_data *mesh;
    size_t vertices, triangles;
} shape_writer;

static void put_vertex(shape_writer *w, double x, double y, double z) {
    const float p[3] = {(float)x, (float)y, (float)z};
    memcpy(burnish_positions(w->mesh) + 3 * w->vertices++, p, sizeof p);
}

static void put_triangle(shape_writer *w, uint32_t a, uint32_t b, uint32_t c) {
    const uint32_t corners[3] = {a, b, c};
    memcpy(w->mesh->streams[BURNISH_POSITION].corners + 3 * w->triangles++, corners,
           sizeof corners);
}

static int reserve_shape(shape_writer *w, size_t vertices, size_t triangles) {
    w->mesh->streams[BURNISH_POSITION].count = vertices;
    return burnish_mesh_data_reserve(w->mesh, BURNISH_POSITION, vertices) == BURNISH_STATUS_OK &&
           burnish_mesh_data_reserve_corners(w->mesh, BURNISH_POSITION, triangles) ==
               BURNISH_STATUS_OK;
}

static void make_box(shape_writer *w, const double size[3]) {
    static const uint8_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    if (!reserve_shape(w, 8, 12)) {
        return;
    }
    for (int i = 0; i < 8; ++i) {
        put_vertex(w, (i & 1 ? 0.5 : -0.5) * size[0], (i & 2 ? 0.5 : -0.5) * size[1],
                   (i & 4 ? 0.5 : -0.5) * size[2]);
    }
    for (int i = 0; i < 6; ++i) {
        const uint8_t *f = faces[i];
        put_triangle(w, f[0], f[1], f[2]);
        put_triangle(w, f[0], f[2], f[3]);
    }
}

/* The outline runs from the lower to the upper end, both on the axis. */
static void revolve(shape_writer *w, const profile_point *outline, uint32_t count) {
    const uint32_t top = 1 + (count - 2) * SIDES;
    if (!reserve_shape(w, top + 1, (size_t)2 * SIDES * (count - 2))) {
        return;
    }
    put_vertex(w, 0, 0, outline[0].height);
    for (uint32_t i = 1; i + 1 < count; ++i) {
        for (uint32_t k = 0; k < SIDES; ++k) {
            double sine, cosine;
            burnish_sincos(2 * 3.14159265358979323846 * k / SIDES, &sine, &cosine);
            put_vertex(w, outline[i].radius * cosine, outline[i].radius * sine, outline[i].height);
        }
    }
    put_vertex(w, 0, 0, outline[count - 1].height);
    for (uint32_t k = 0; k < SIDES; ++k) {
        const uint32_t next = (k + 1) % SIDES;
        put_triangle(w, 0, 1 + next, 1 + k);
        for (uint32_t i = 0; i + 3 < count; ++i) {
            const uint32_t low = 1 + i * SIDES, high = low + SIDES;
            put_triangle(w, low + k, low + next, high + next);
            put_triangle(w, low + k, high + next, high + k);
        }
        put_triangle(w, top, top - SIDES + k, top - SIDES + next);
    }
}

burnish_scene_source *burnish_urdf_make_shape(burnish_urdf *urdf, burnish_urdf_shape shape,
                                              const double size[3]) {
    burnish_scene_source *source = burnish_scene_make(&urdf->scene);
    const double radius = size[0], half = size[1] / 2;
    profile_point outline[PROFILE] = {{0, -half}, {radius, -half}, {radius, half}, {0, half}};
    if (!source) {
        return NULL;
    }
    shape_writer w = {.mesh = &source->mesh};
    if (shape == BURNISH_URDF_BOX) {
        make_box(&w, size);
    } else if (shape == BURNISH_URDF_CYLINDER) {
        revolve(&w, outline, 4);
    } else {
        for (int i = 0; i < PROFILE; ++i) {
            double sine, cosine;
            burnish_sincos(3.14159265358979323846 * i / RINGS, &sine, &cosine);
            outline[i] = (profile_point){radius * sine, -radius * cosine};
        }
        revolve(&w, outline, PROFILE);
    }
    source->mesh.triangle_count = w.triangles;
    if (source->mesh.memory.status != BURNISH_STATUS_OK) {
        urdf->scene.reader->mesh->memory.status = source->mesh.memory.status;
        return NULL;
    }
    return source;
}
