#include "mesh/read/common/local_origin.h"

#include <string.h>

#include "core/vec3.h"
#include "mesh/read/common/damage.h"
#include "mesh/read/common/textures.h"

enum {
    SAMPLES = 64, /* sampled positions, which rule out a distant origin for nearly all meshes */
    STEP = 1 << 14
};

static const double FAR = 32;             /* times its size: too far for floats */
static const double NEAR = 2;             /* times its size: needs no origin */
static const double FLOAT_STEP = 0x1p-22; /* times the distance: the resolution of floats */

typedef struct box {
    double center[3]; /* in the file's coordinates */
    double size;      /* the largest side, but at least a step of the floats */
    double distance;  /* the largest of center */
} box;

/* The box of every `step`-th position that a triangle uses, or of all positions if there are no
 * triangles. */
static box measure_box(const burnish_mesh_data *mesh, size_t step) {
    const float *positions = burnish_positions(mesh);
    const uint32_t *corners = mesh->streams[BURNISH_POSITION].corners;
    const size_t count = corners ? 3 * mesh->triangle_count : mesh->streams[BURNISH_POSITION].count;
    float low[3], high[3], far = 0;
    box found = {.size = 0};
    for (size_t i = 0; i < count; i += step) {
        const float *p = positions + 3 * (corners ? (size_t)corners[i] : i);
        for (int k = 0; k < 3; ++k) {
            /* NaN, which is left out later, gives way */
            low[k] = i == 0 || p[k] < low[k] || low[k] != low[k] ? p[k] : low[k];
            high[k] = i == 0 || p[k] > high[k] || high[k] != high[k] ? p[k] : high[k];
        }
    }
    for (int k = 0; k < 3 && count > 0; ++k) {
        const double size = (double)high[k] - low[k], middle = ((double)low[k] + high[k]) / 2;
        const float reach = -low[k] > high[k] ? -low[k] : high[k];
        found.center[k] = mesh->origin[k] + middle;
        found.distance = burnish_magnitude(found.center[k]) > found.distance
                             ? burnish_magnitude(found.center[k])
                             : found.distance;
        found.size = size > found.size ? size : found.size;
        far = reach > far ? reach : far;
    }
    found.size = found.size > FLOAT_STEP * (double)far ? found.size : FLOAT_STEP * (double)far;
    return found;
}

/* The power of two below a positive number. */
static double power_below(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    bits &= UINT64_C(0x7FF) << 52;
    memcpy(&x, &bits, sizeof bits);
    return x;
}

/* Rounds to a multiple of the grid, which is a power of two. */
static double snap_to_grid(double x, double grid) {
    const double cells = x / grid;
    return burnish_magnitude(cells) < 0x1p52
               ? (double)(int64_t)(cells + (x < 0 ? -0.5 : 0.5)) * grid
               : x;
}

int burnish_find_origin(const burnish_mesh_data *mesh, double origin[3]) {
    const double *old = mesh->origin;
    const size_t count = mesh->streams[BURNISH_POSITION].corners
                             ? 3 * mesh->triangle_count
                             : mesh->streams[BURNISH_POSITION].count;
    if (old[0] == 0 && old[1] == 0 && old[2] == 0) {
        /* a part of the box is at most as large as the box, and at most half its size away */
        const box sampled = measure_box(mesh, count / SAMPLES + 1);
        if (!(sampled.distance > (FAR - 1) * sampled.size)) {
            return 0;
        }
    }
    const box all = measure_box(mesh, 1);
    if (!(all.distance > FAR * all.size) || !(all.size > 0)) {
        return 0;
    }
    int is_other = 0;
    for (int k = 0; k < 3; ++k) {
        origin[k] = burnish_magnitude(all.center[k]) < NEAR * all.size
                        ? 0
                        : snap_to_grid(all.center[k], power_below(all.size) / 16);
        is_other |= origin[k] != old[k];
    }
    return is_other;
}

/* Empty data for another reading, without materials, textures, cameras and warnings. */
static burnish_mesh_data begin_again(const burnish_mesh_data *mesh, const double origin[3]) {
    burnish_mesh_data again = {
        .memory = mesh->memory, .tasks = mesh->tasks, .start = mesh->start, .is_silent = 1};
    memcpy(again.origin, origin, sizeof again.origin);
    return again;
}

burnish_status burnish_read_from_origin(burnish_reader *reader,
                                        burnish_status (*read)(burnish_reader *reader)) {
    burnish_mesh_data *mesh = reader->mesh;
    burnish_reader_input input = *reader->input;
    burnish_status status = BURNISH_STATUS_OK;
    double origin[3];
    input.companions = (burnish_file_loader){0};
    for (int i = 0; i < BURNISH_ORIGIN_TIMES && status == BURNISH_STATUS_OK &&
                    burnish_find_origin(mesh, origin);
         ++i) {
        burnish_mesh_data again = begin_again(mesh, origin);
        burnish_reader other = {.input = &input,
                                .mesh = &again,
                                .error = reader->error,
                                .companion_bytes = reader->companion_bytes};
        for (int k = 0; k < BURNISH_ATTRIBUTE_COUNT; ++k) { /* the old ones make room */
            burnish_mesh_data_drop(mesh, (burnish_attribute)k);
        }
        status = read(&other);
        if (status == BURNISH_STATUS_OK) {
            status = burnish_drop_damage(&other);
        }
        if (status == BURNISH_STATUS_OK && (again.triangle_count != mesh->triangle_count ||
                                            again.point_count != mesh->point_count)) {
            status = burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, NULL,
                                         "coordinates are too large; scale the mesh");
        }
        burnish_reader_close(&other);
        memcpy(mesh->streams, again.streams, sizeof mesh->streams);
        burnish_mesh_data *const old = mesh->negatives;
        mesh->negatives = again.negatives;
        again.negatives = old;
        memcpy(mesh->points_min, again.points_min, sizeof mesh->points_min);
        memcpy(mesh->points_max, again.points_max, sizeof mesh->points_max);
        memcpy(mesh->inner_min, again.inner_min, sizeof mesh->inner_min);
        memcpy(mesh->inner_max, again.inner_max, sizeof mesh->inner_max);
        mesh->point_radius = again.point_radius;
        memset(again.streams, 0, sizeof again.streams);
        memcpy(mesh->origin, origin, sizeof mesh->origin);
        mesh->memory.status = again.memory.status;
        burnish_mesh_data_destroy(&again);
    }
    return status;
}

typedef struct move {
    float *positions;
    const double *origin;
} move;

static void move_some(void *user_data, size_t first, size_t end) {
    const move *m = user_data;
    for (size_t i = first; i < end; ++i) {
        for (size_t k = 0; k < 3; ++k) {
            float *p = &m->positions[3 * i + k];
            burnish_place((double)*p, m->origin[k], p);
        }
    }
}

void burnish_move_positions(burnish_mesh_data *mesh) {
    const double *origin = mesh->origin;
    move m = {burnish_positions(mesh), origin};
    if (origin[0] != 0 || origin[1] != 0 || origin[2] != 0) {
        burnish_tasks_ranges(mesh->tasks, mesh->streams[BURNISH_POSITION].count, STEP, move_some,
                             &m);
    }
}
