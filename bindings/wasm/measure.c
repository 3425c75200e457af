/* Facts of meshes, and comparisons of images. */
#include <math.h>

#include "base/wasm/module.h"
#include "burnish/compare.h"
#include "session.h"

WASM_EXPORT(session_request_facts) void open_request_facts(session *s);
WASM_EXPORT(session_fact) double open_fact(const session *s, int which);
WASM_EXPORT(images_compare)
int images_compare(const uint8_t *a, int a_channels, const uint8_t *b, int b_channels, int width,
                   int height, int tolerance);
WASM_EXPORT(images_number) double images_number(int which);

static burnish_comparison compared; /* by the last call of images_compare */

/* Call it before session_open. */
void open_request_facts(session *s) {
    session_request_facts(s);
}

/* In the order of wasm.js; NaN without facts and for what is undefined. */
double open_fact(const session *s, int which) {
    const burnish_mesh_facts *f = burnish_mesh_get_facts(session_mesh(s));
    const double *origin = burnish_mesh_get_view(session_mesh(s))->origin;
    if (!f) {
        return NAN;
    }
    const double numbers[] = {f->is_solid,
                              f->is_closed,
                              f->is_consistent,
                              (double)f->triangle_count,
                              (double)f->vertex_count,
                              (double)f->shell_count,
                              (double)f->edge_count,
                              (double)f->open_edge_count,
                              (double)f->non_manifold_edge_count,
                              (double)f->inconsistent_edge_count,
                              (double)f->flipped_count,
                              (double)f->unorientable_count,
                              (double)f->degenerate_count,
                              (double)f->duplicate_count,
                              f->area,
                              f->is_closed && f->is_consistent ? f->volume : NAN,
                              f->center_of_mass[0] + origin[0],
                              f->center_of_mass[1] + origin[1],
                              f->center_of_mass[2] + origin[2]};
    return which >= 0 && (size_t)which < sizeof numbers / sizeof *numbers ? numbers[which] : NAN;
}

static burnish_pixels describe(const uint8_t *pixels, int channels, int width, int height) {
    return (burnish_pixels){.width = width,
                            .height = height,
                            .format = channels == 4 ? BURNISH_PIXELS_RGBA8 : BURNISH_PIXELS_RGB8,
                            .stride = (size_t)channels * (size_t)width,
                            .pixels = (uint8_t *)(uintptr_t)pixels}; /* only read */
}

/* Compares images with 3 or 4 channels. Returns 1, or 0 after an error. */
int images_compare(const uint8_t *a, int a_channels, const uint8_t *b, int b_channels, int width,
                   int height, int tolerance) {
    burnish_compare_options options = burnish_compare_options_default();
    options.tolerance = tolerance;
    options.threads = 1;
    const burnish_pixels first = describe(a, a_channels, width, height),
                         second = describe(b, b_channels, width, height);
    return burnish_pixels_compare(&first, &second, &options, &compared, module_error()) ==
           BURNISH_STATUS_OK;
}

/* Numbers of the comparison, in the order of wasm.js. */
double images_number(int which) {
    const burnish_comparison *c = &compared;
    const double numbers[] = {(double)c->pixels,
                              (double)c->different_pixels,
                              c->mean_squared_error,
                              c->psnr,
                              c->ssim,
                              c->flip,
                              c->silhouette_iou,
                              c->bounds[0],
                              c->bounds[1],
                              c->bounds[2],
                              c->bounds[3],
                              c->largest[0],
                              c->largest[1],
                              c->largest[2],
                              c->largest[3]};
    return which >= 0 && (size_t)which < sizeof numbers / sizeof *numbers ? numbers[which] : NAN;
}
