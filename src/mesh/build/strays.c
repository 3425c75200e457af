/* Triangles far from all others, which would shrink the object to a speck: a number that was damaged,
 * or a forgotten part. They are not framed. */
#include "mesh/build/strays.h"

#include <string.h>

#include "core/vec3.h"
#include "mesh/data/box.h"

enum {
    BINS = 64,      /* of the vertices along an axis */
    CORE = 8,       /* bins that the rest takes, at most */
    SAMPLES = 1024, /* vertices that rule out strays for nearly all meshes */
    TIMES = 8,      /* groups of strays, at most */
    FEW = 12,       /* vertices that may be strays, or ... */
    SHARE = 100     /* ... one of so many */
};
static const double AREA = 0.01; /* of strays, at most, in that of the rest */
/* Times the rest: strays beyond it may be connected to it, and are left out, as the floats of the
 * raster's space would overflow. */
static const double DRAWN = 1000;

/* The bins around the vertex in the middle up to an empty one on either side: [first, end). Returns
 * the number of vertices in the others. */
static size_t find_core(const size_t bins[BINS], int *first, int *end) {
    size_t all = 0, below = 0, inside = 0;
    int middle = 0;
    for (int i = 0; i < BINS; ++i) {
        all += bins[i];
    }
    while (2 * (below + bins[middle]) < all) {
        below += bins[middle++];
    }
    for (*first = middle; *first > 0 && bins[*first - 1] > 0; --*first) {
    }
    for (*end = middle; *end < BINS && bins[*end] > 0; ++*end) {
    }
    for (int i = *first; i < *end; ++i) {
        inside += bins[i];
    }
    return all - inside;
}

/* Cuts strays along an axis off the box. Returns whether there are any. */
static int cut_axis(const burnish_mesh *mesh, int axis, size_t step, burnish_box *rest) {
    const float *positions = mesh->attributes[BURNISH_POSITION];
    const double low = (double)rest->low[axis], side = (double)rest->high[axis] - low;
    size_t bins[BINS] = {0}, count = 0;
    int first, end;
    for (size_t i = 0; i < mesh->view.vertex_count; i += step) {
        const float *p = positions + 3 * i;
        if (burnish_box_holds(rest, p)) {
            const int bin = (int)(((double)p[axis] - low) / side * BINS);
            ++bins[bin < BINS ? bin : BINS - 1];
            ++count;
        }
    }
    const size_t others = find_core(bins, &first, &end);
    if (others == 0 || end - first > CORE || (others > FEW && others > count / SHARE)) {
        return 0;
    }
    rest->low[axis] = first > 0 ? (float)(low + side * (first - 0.5) / BINS) : rest->low[axis];
    rest->high[axis] = end < BINS ? (float)(low + side * (end + 0.5) / BINS) : rest->high[axis];
    return 1;
}

/* The box without strays. */
static burnish_box cut_strays(const burnish_mesh *mesh, burnish_box all, size_t step) {
    int was_cut = 1;
    for (int i = 0; i < TIMES && was_cut; ++i) {
        const double longest = burnish_box_longest_side(&all);
        was_cut = 0;
        for (int axis = 0; axis < 3 && !was_cut; ++axis) {
            was_cut = (double)all.high[axis] - (double)all.low[axis] > longest / 4 &&
                      cut_axis(mesh, axis, step, &all);
        }
        if (was_cut) {
            burnish_box_inside(mesh->attributes[BURNISH_POSITION], mesh->view.vertex_count, step,
                               &all, &all);
        }
    }
    return all;
}

static double area_of(const float *a, const float *b, const float *c) {
    const burnish_vec3 from = burnish_vec3_loadf(a);
    return burnish_vec3_length(burnish_vec3_cross(burnish_vec3_sub(burnish_vec3_loadf(b), from),
                                                  burnish_vec3_sub(burnish_vec3_loadf(c), from)));
}

static int corners_inside(const burnish_mesh *mesh, const burnish_box *rest, size_t triangle) {
    const float *positions = mesh->attributes[BURNISH_POSITION];
    int inside = 0;
    for (int k = 0; k < 3; ++k) {
        inside += burnish_box_holds(rest, positions + 3 * (size_t)mesh->indices[3 * triangle + k]);
    }
    return inside;
}

/* The number of triangles outside the rest; 0 if they are no strays: too large, too many, or connected
 * to it.
 *   first  receives the first one */
static size_t count_strays(const burnish_mesh *mesh, const burnish_box *rest, int may_touch,
                           size_t *first) {
    const float *positions = mesh->attributes[BURNISH_POSITION];
    double areas[2] = {0, 0};
    size_t count = 0;
    for (size_t i = mesh->view.triangle_count; i-- > 0;) {
        const uint32_t *corners = mesh->indices + 3 * i;
        const int inside = corners_inside(mesh, rest, i);
        if (inside < 3) {
            ++count;
            *first = i;
        }
        if (inside == 0 || inside == 3) {
            areas[inside / 3] +=
                area_of(positions + 3 * (size_t)corners[0], positions + 3 * (size_t)corners[1],
                        positions + 3 * (size_t)corners[2]);
        } else if (!may_touch) {
            return 0;
        }
    }
    const int are_few = count <= mesh->view.triangle_count / 4 * 3;
    return are_few && (areas[0] <= AREA * areas[1] || may_touch) ? count : 0;
}

/* Leaves out triangles outside the rest; their vertices, now unused, move into it. */
static void drop_strays(burnish_mesh *mesh, const burnish_box *rest) {
    float *positions = mesh->attributes[BURNISH_POSITION];
    size_t kept = 0;
    for (size_t i = 0; i < mesh->view.triangle_count; ++i) {
        if (corners_inside(mesh, rest, i) < 3) {
            continue;
        }
        memmove(mesh->indices + 3 * kept, mesh->indices + 3 * i, 3 * sizeof *mesh->indices);
        if (mesh->triangle_materials) {
            mesh->triangle_materials[kept] = mesh->triangle_materials[i];
        }
        if (mesh->triangle_parts) {
            mesh->triangle_parts[kept] = mesh->triangle_parts[i];
        }
        ++kept;
    }
    mesh->view.triangle_count = kept;
    for (size_t i = 0; i < mesh->view.vertex_count; ++i) {
        if (!burnish_box_holds(rest, positions + 3 * i)) {
            memcpy(positions + 3 * i, positions + 3 * (size_t)mesh->indices[0], 3 * sizeof(float));
        }
    }
}

size_t burnish_find_strays(burnish_mesh *mesh, float low[3], float high[3], float place[3]) {
    const size_t count = mesh->view.vertex_count, step = count / SAMPLES + 1;
    burnish_box all;
    burnish_bound_positions(mesh->attributes[BURNISH_POSITION], count, all.low, all.high);
    const double size = burnish_box_longest_side(&all);
    const burnish_box core = cut_strays(mesh, all, step);
    if (!(size > 0) || burnish_box_longest_side(&core) > size * (CORE + 1) / BINS) {
        return 0;
    }
    const burnish_box rest = cut_strays(mesh, all, 1);
    const double left = burnish_box_longest_side(&rest);
    size_t first = 0;
    const size_t strays =
        left > 0 && left < size ? count_strays(mesh, &rest, size > DRAWN * left, &first) : 0;
    if (strays > 0) {
        const float *p = mesh->attributes[BURNISH_POSITION];
        memcpy(place, p + 3 * (size_t)mesh->indices[3 * first], 3 * sizeof *place);
        memcpy(low, rest.low, sizeof rest.low);
        memcpy(high, rest.high, sizeof rest.high);
        mesh->has_strays = size <= DRAWN * left;
    }
    if (strays > 0 && !mesh->has_strays) {
        drop_strays(mesh, &rest);
    }
    return strays;
}
