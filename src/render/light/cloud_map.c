#include "render/light/cloud_map.h"

#include <string.h>

#include "core/vector.h"
#include "raster/maps.h"

/* Radius of a disc, in texels, from which on every point is drawn: 11 of smaller ones, which are as
 * dense as points.c makes them, are in each texel, so all but 1 in 60,000 texels get one. At least
 * so many points per texel of the map are drawn, for other sizes. */
#define LEAST_RADIUS 0.5
enum { LEAST_POINTS = 16 };

static inline void raise(uint16_t *to, uint16_t from) {
    *to = from > *to ? from : *to;
}

/* One in so many points is drawn. */
static size_t choose_step(size_t count, int size, float radius) {
    const double share = LEAST_RADIUS / (double)radius,
                 most = (double)count / (LEAST_POINTS * (double)size * (double)size);
    const double step = share * share < most ? share * share : most;
    return step < 2 ? 1 : (size_t)step;
}

/* One texel of both maps per point. */
static void draw_middles(const burnish_mesh_view *mesh, const burnish_raster_view *view, int size,
                         float radius, uint16_t *const depths[2]) {
    const float middle = (float)size * 0.5f, most = (float)(size / 2 - 1) - radius;
    const size_t step = choose_step(mesh->vertex_count, size, radius);
    for (size_t point = 0; point < mesh->vertex_count; point += step) {
        const float *p = mesh->positions + 3 * point;
        const float d[3] = {p[0] - view->origin[0], p[1] - view->origin[1], p[2] - view->origin[2]};
        float at[3];
        for (int k = 0; k < 3; ++k) {
            const float *r = view->rows[k];
            at[k] = ((r[0] * d[0] + r[1] * d[1]) + r[2] * d[2]) + r[3];
        }
        if (at[0] > -most && at[0] < most && at[1] > -most && at[1] < most && at[2] > 0 &&
            at[2] < 1) {
            const int texel = (int)(middle - at[1]) * size + (int)(middle + at[0]);
            const int code = (int)(at[2] * (float)BURNISH_MAP_CODES + 0.5f);
            raise(&depths[0][texel], (uint16_t)code);
            raise(&depths[1][texel], (uint16_t)((int)BURNISH_MAP_CODES - code));
        }
    }
}

/* The maximum of each texel and the `reach` next ones and those before, along columns. Twice as many
 * are joined by each step. */
static void widen_columns(uint16_t *depths, size_t size, size_t reach) {
    for (size_t done = 0, step; done < reach; done += step) {
        step = done + 1 < reach - done ? done + 1 : reach - done;
        for (size_t i = 0; i < (size - step) * size; ++i) {
            raise(&depths[i], depths[i + step * size]);
        }
    }
    for (size_t done = 0, step; done < reach; done += step) {
        step = done + 1 < reach - done ? done + 1 : reach - done;
        for (size_t y = size - 1; y >= step; --y) {
            for (size_t x = 0; x < size; ++x) {
                raise(&depths[y * size + x], depths[(y - step) * size + x]);
            }
        }
    }
}

static void widen_rows(uint16_t *depths, size_t size, size_t reach) {
    for (size_t y = 0; y < size; ++y, depths += size) {
        for (size_t done = 0, step; done < reach; done += step) {
            step = done + 1 < reach - done ? done + 1 : reach - done;
            for (size_t x = 0; x + step < size; ++x) {
                raise(&depths[x], depths[x + step]);
            }
        }
        for (size_t done = 0, step; done < reach; done += step) {
            step = done + 1 < reach - done ? done + 1 : reach - done;
            for (size_t x = size - 1; x >= step; --x) {
                raise(&depths[x], depths[x - step]);
            }
        }
    }
}

void burnish_cloud_map_draw(const burnish_mesh_view *mesh, const burnish_raster_view *view,
                            int size, uint16_t *const depths[2]) {
    const burnish_vec3 row = burnish_vec3_loadf(view->rows[0]);
    const double length = burnish_vec3_length(row), radius = length * (double)mesh->point_radius;
    const float used = radius < (double)(size / 2) ? (float)radius : (float)(size / 2);
    const size_t reach = (size_t)((double)used + 0.5);
    draw_middles(mesh, view, size, used, depths);
    for (int side = 0; side < 2 && reach > 0; ++side) {
        widen_columns(depths[side], (size_t)size, reach);
        widen_rows(depths[side], (size_t)size, reach);
    }
}
