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
    GROUND = 12,    /* triangles of a plane around the rest, at most */
    FEW = 12,       /* vertices that may be strays, or ... */
    SHARE = 100     /* ... one of so many */
};
/* Area of strays in that of the rest, at most, per factor by which they enlarge the box. */
static const double AREA = 0.00125, MOST_AREA = 0.25;
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
    if (2 * others >= count || end - first > CORE || (others > FEW && others > count / SHARE)) {
        return 0;
    }
    rest->low[axis] = first > 0 ? (float)(low + side * (first - 0.5) / BINS) : rest->low[axis];
    rest->high[axis] = end < BINS ? (float)(low + side * (end + 0.5) / BINS) : rest->high[axis];
    return 1;
}

/* Cuts strays along one axis off the box. Returns whether there are any. */
static int cut_once(const burnish_mesh *mesh, size_t step, burnish_box *all) {
    const double longest = burnish_box_longest_side(all);
    for (int axis = 0; axis < 3; ++axis) {
        if ((double)all->high[axis] - (double)all->low[axis] > longest / 4 &&
            cut_axis(mesh, axis, step, all)) {
            burnish_box_inside(mesh->attributes[BURNISH_POSITION], mesh->view.vertex_count, step,
                               all, all);
            return 1;
        }
    }
    return 0;
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

/* Whether the box is a plane that extends beyond the rest on four sides, as the ground of a town. It
 * may be connected to the rest. */
static int is_ground(const burnish_box *box, const burnish_box *rest) {
    int flat = 0, wide = 0;
    for (int k = 0; k < 3; ++k) {
        flat += box->low[k] == box->high[k] && rest->low[k] < rest->high[k];
        wide += box->low[k] < rest->low[k] && box->high[k] > rest->high[k];
    }
    return flat == 1 && wide == 2;
}

/* The number of triangles outside the rest; 0 if they are no strays: too large and no ground, too
 * many, or connected to it.
 *   times  how much larger the box is with them */
static size_t count_strays(const burnish_mesh *mesh, const burnish_box *rest, double times) {
    const int may_touch = times > DRAWN;
    const double share = AREA * times < MOST_AREA ? AREA * times : MOST_AREA;
    const float *positions = mesh->attributes[BURNISH_POSITION];
    burnish_box outside = burnish_box_none();
    double areas[2] = {0, 0};
    size_t count = 0, connected = 0;
    for (size_t i = mesh->view.triangle_count; i-- > 0;) {
        const uint32_t *corners = mesh->indices + 3 * i;
        const int inside = corners_inside(mesh, rest, i);
        count += inside < 3;
        for (int k = 0; k < 3 && inside < 3; ++k) {
            if (!burnish_box_holds(rest, positions + 3 * (size_t)corners[k])) {
                burnish_box_extend(&outside, positions + 3 * (size_t)corners[k]);
            }
        }
        if (inside == 0 || inside == 3) {
            areas[inside / 3] +=
                area_of(positions + 3 * (size_t)corners[0], positions + 3 * (size_t)corners[1],
                        positions + 3 * (size_t)corners[2]);
        } else if (!may_touch && ++connected > GROUND) {
            return 0;
        }
    }
    const int are_few = count <= mesh->view.triangle_count / 4 * 3;
    const int are_strays = (areas[0] <= share * areas[1] && connected == 0) || may_touch ||
                           (count <= GROUND && is_ground(&outside, rest));
    return are_few && are_strays ? count : 0;
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

/* The box without strays, of which *strays receives the number. Small shapes have gaps of their own: a
 * cut counts if what it takes away is apart. */
static burnish_box cut_strays(const burnish_mesh *mesh, const burnish_box *all, size_t *strays) {
    burnish_box rest = *all, next = *all;
    for (int i = 0; i < TIMES && cut_once(mesh, 1, &next); ++i) {
        const double left = burnish_box_longest_side(&next);
        const size_t found =
            left > 0 ? count_strays(mesh, &next, burnish_box_longest_side(&rest) / left) : 0;
        if (found > 0) {
            rest = next;
            *strays = found;
        }
    }
    return rest;
}

/* A corner of the first triangle outside the rest. */
static void find_place(const burnish_mesh *mesh, const burnish_box *rest, float place[3]) {
    const float *p = mesh->attributes[BURNISH_POSITION];
    size_t corner = 0;
    while (burnish_box_holds(rest, p + 3 * (size_t)mesh->indices[corner])) {
        ++corner;
    }
    memcpy(place, p + 3 * (size_t)mesh->indices[corner], 3 * sizeof *place);
}

size_t burnish_find_strays(burnish_mesh *mesh, float low[3], float high[3], float place[3]) {
    const size_t count = mesh->view.vertex_count, step = count / SAMPLES + 1;
    burnish_box all;
    burnish_bound_positions(mesh->attributes[BURNISH_POSITION], count, all.low, all.high);
    const double size = burnish_box_longest_side(&all);
    burnish_box core = all;
    for (int i = 0; i < TIMES && cut_once(mesh, step, &core); ++i) {
    }
    if (!(size > 0) || burnish_box_longest_side(&core) > size * (CORE + 1) / BINS) {
        return 0;
    }
    size_t strays = 0;
    const burnish_box rest = cut_strays(mesh, &all, &strays);
    if (strays > 0) {
        find_place(mesh, &rest, place);
        memcpy(low, rest.low, sizeof rest.low);
        memcpy(high, rest.high, sizeof rest.high);
        mesh->has_strays = size <= DRAWN * burnish_box_longest_side(&rest);
    }
    if (strays > 0 && !mesh->has_strays) {
        drop_strays(mesh, &rest);
    }
    return strays;
}
