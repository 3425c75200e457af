#include "render/scene/winding.h"

#include <math.h>

/* Walls that enclose a box have its volume; without one wall or some, a large part of it. */
static const double ROOM = 0.4;

render_winding render_measure_winding(const burnish_mesh_view *view) {
    double middle[3], sum[3] = {0}, area = 0, volume = 0, box = 1;
    for (int k = 0; k < 3; ++k) {
        middle[k] = ((double)view->bounds_min[k] + (double)view->bounds_max[k]) / 2;
        box *= (double)view->bounds_max[k] - (double)view->bounds_min[k];
    }
    for (size_t t = 0; t < view->triangle_count; ++t) {
        double p[3][3], normal[3];
        for (int i = 0; i < 9; ++i) {
            const size_t vertex = view->indices[3 * t + (size_t)i / 3];
            p[i / 3][i % 3] = (double)view->positions[3 * vertex + (size_t)i % 3] - middle[i % 3];
        }
        for (int k = 0; k < 3; ++k) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            normal[k] = (p[1][a] - p[0][a]) * (p[2][b] - p[0][b]) -
                        (p[1][b] - p[0][b]) * (p[2][a] - p[0][a]);
            sum[k] += normal[k];
            volume += normal[k] * p[0][k] / 6;
        }
        area += sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    }
    const double rest = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
    return (render_winding){volume, box, rest <= 1e-6 * area};
}

int render_is_room(const burnish_mesh *mesh) {
    if (!burnish_mesh_get_info(mesh)->is_one_sided) {
        return 0;
    }
    const render_winding winding = render_measure_winding(burnish_mesh_get_view(mesh));
    return !winding.is_closed && winding.volume < -ROOM * winding.box;
}
