#include "render/frame/caps.h"

#include <string.h>

#include "core/vec3.h"

/* Solves rows^T x = b for x by elimination with partial pivoting; 0 if the system is singular. */
static int solve_transposed(const float rows[4][4], const double b[4], double x[4]) {
    double m[4][5];
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 4; ++k) {
            m[i][k] = (double)rows[k][i];
        }
        m[i][4] = b[i];
    }
    for (int column = 0; column < 4; ++column) {
        int pivot = column;
        for (int i = column + 1; i < 4; ++i) {
            pivot = m[i][column] * m[i][column] > m[pivot][column] * m[pivot][column] ? i : pivot;
        }
        double row[5];
        memcpy(row, m[pivot], sizeof row);
        memcpy(m[pivot], m[column], sizeof row);
        memcpy(m[column], row, sizeof row);
        if (row[column] == 0) {
            return 0;
        }
        for (int i = 0; i < 4; ++i) {
            const double factor = i == column ? 0 : m[i][column] / row[column];
            for (int k = column; k < 5; ++k) {
                m[i][k] -= factor * row[k];
            }
        }
    }
    for (int i = 0; i < 4; ++i) {
        x[i] = m[i][4] / m[i][i];
    }
    return 1;
}

/* In clip coordinates c = rows (p - origin, 1) a plane is L . c = 0, with w > 0 and L . c <= 0 on
 * the side that stays. So depth = z / w is linear in x / w and y / w, and what stays is farther
 * than the plane where L's z is above 0. */
/* 1 where what stays is farther, -1 where it is nearer, 0 where the plane is seen edge on. */
static int make_cap(const burnish_clip_plane *plane, const burnish_raster_view *view,
                    burnish_cap *cap) {
    const burnish_vec3 normal = burnish_vec3_load(plane->normal);
    const burnish_vec3 unit = burnish_vec3_normalize(normal);
    const double in_space[4] = {normal.x, normal.y, normal.z,
                                burnish_vec3_dot(normal, burnish_vec3_loadf(view->origin)) -
                                    plane->offset};
    double in_clip[4];
    if (!solve_transposed(view->rows, in_space, in_clip) || in_clip[2] == 0) {
        return 0;
    }
    cap->right = -in_clip[0] / in_clip[2];
    cap->up = -in_clip[1] / in_clip[2];
    cap->middle = -in_clip[3] / in_clip[2];
    cap->normal[0] = (float)unit.x;
    cap->normal[1] = (float)unit.y;
    cap->normal[2] = (float)unit.z;
    return in_clip[2] > 0 ? 1 : -1;
}

burnish_caps burnish_caps_create(const burnish_mesh_view *mesh, const burnish_raster_view *view) {
    burnish_caps caps = {.inside = mesh->inside == BURNISH_INSIDE_BACK,
                         .triangles = mesh->triangle_count,
                         .regions = burnish_hatch_regions(mesh)};
    const int cuts = mesh->inside == BURNISH_INSIDE_UNKNOWN ? 0 : mesh->cut_count;
    for (int i = 0; i < cuts; ++i) {
        caps.items[caps.count].number = i;
        caps.count += make_cap(&mesh->cuts[i], view, &caps.items[caps.count]) > 0;
    }
    return caps;
}

burnish_cap_range burnish_caps_range(const burnish_mesh_view *mesh,
                                     const burnish_raster_view *view) {
    burnish_cap_range range = {.count = 0};
    for (int i = 0; i < mesh->cut_count; ++i) {
        const int side = make_cap(&mesh->cuts[i], view, &range.items[range.count]);
        range.is_exit[range.count] = side < 0;
        range.count += side != 0;
    }
    return range;
}

const burnish_cap *burnish_caps_find(const burnish_caps *caps, double x, double y, float *depth) {
    /* at the border both are equal but for rounding */
    const double margin = ((double)*depth < 0 ? -(double)*depth : (double)*depth) * 1e-4 + 1e-6;
    const burnish_cap *last = NULL;
    double least = 0;
    for (int i = 0; i < caps->count; ++i) {
        const burnish_cap *cap = &caps->items[i];
        const double at = (cap->right * x + cap->up * y) + cap->middle;
        if (!last || at < least) {
            last = cap;
            least = at;
        }
    }
    if (!last || least < (double)*depth - margin) {
        return NULL;
    }
    *depth = (float)least;
    return last;
}

/* ---- Hatching ---- */

#define DIAGONAL 0.70710678f

float burnish_cap_hatch(int style, int x, int y) {
    const int period = burnish_hatch_period(style);
    const int along = (style & 1 ? x - y : x + y) % period;
    const int step = along < 0 ? along + period : along;
    const float distance = (float)(step < period - step ? step : period - step) * DIAGONAL;
    const float cover = BURNISH_HATCH_WIDTH * 0.5f + 0.5f - distance;
    return cover < 0 ? 0 : cover > 1 ? 1 : cover;
}
