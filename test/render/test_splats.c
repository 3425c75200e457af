/* Splats against the formulas of splatting.h in double precision with libm's exp, by every
 * instruction set, with and without a background. */
#include <math.h>

#include "pictures.h"

enum { SIDE = 64, ROW = 32 };

/* Pixels are units; the eye looks along -z at the origin, which is in the middle of the picture. */
static burnish_render_options make_options(void) {
    burnish_render_options options = burnish_render_options_default();
    options.width = options.height = SIDE;
    options.camera = (burnish_camera){
        .position = {0, 0, 100}, .view_up = {0, 1, 0}, .orthographic_height = SIDE};
    options.transparent = 1;
    return options;
}

typedef struct splat {
    float position[3], scale[3];
    uint8_t color[4], rotation[4];
} splat;

static burnish_mesh *load_splats(const splat *splats, size_t count) {
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = NULL;
    burnish_error error = {0};
    _Static_assert(sizeof *splats == ROW, "the rows of a .splat file");
    CHECK_OK(burnish_mesh_load_memory(splats, count * ROW, "a.splat", &options, &mesh, &error),
             error);
    return mesh;
}

/* The opacity of a splat without tilt, turned by `angle`, in a pixel. */
static double alpha_at(const splat *s, double angle, int x, int y) {
    const double dx = x + 0.5 - SIDE / 2.0 - (double)s->position[0],
                 dy = SIDE / 2.0 - y - 0.5 - (double)s->position[1];
    const double c = cos(angle), n = sin(angle), a = (double)(s->scale[0] * s->scale[0]),
                 b = (double)(s->scale[1] * s->scale[1]);
    const double xx = a * c * c + b * n * n + 0.3, yy = a * n * n + b * c * c + 0.3;
    const double xy = (a - b) * c * n, determinant = xx * yy - xy * xy;
    const double d = (yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy) / (2 * determinant);
    return s->color[3] / 255.0 * exp(-d);
}

static void check_splats(const splat *splats, size_t count, double angle, int transparent) {
    burnish_mesh *mesh = load_splats(splats, count);
    burnish_render_options options = make_options();
    double worst = 0;
    uint64_t hash = 0;
    options.transparent = transparent;
    for (burnish_isa isa = BURNISH_ISA_SCALAR; isa < BURNISH_ISA_COUNT; ++isa) {
        options.kernels = burnish_kernels_for(isa);
        if (!options.kernels) {
            continue;
        }
        burnish_render_report report;
        burnish_image image = draw_image(mesh, &options, &report);
        hash = isa == BURNISH_ISA_SCALAR ? burnish_image_hash(&image) : hash;
        CHECK1(burnish_image_hash(&image) == hash && report.covered_pixels > 0);
        for (int i = 0; i < SIDE * SIDE; ++i) {
            const uint8_t *pixel = image.pixels + i * image.channels;
            double light[3] = {0, 0, 0}, through = 1;
            for (size_t s = 0; s < count; ++s) { /* from near to far */
                const double alpha = alpha_at(splats + s, angle, i % SIDE, i / SIDE);
                for (int k = 0; k < 3; ++k) {
                    light[k] += through * alpha * splats[s].color[k];
                }
                through *= 1 - alpha;
            }
            for (int k = 0; k < 3; ++k) { /* of the background, which is white, or of none */
                const double right = light[k] + (transparent ? 0 : 255 * through);
                const double got = transparent ? pixel[k] * pixel[3] / 255.0 : pixel[k];
                worst = fmax(worst, fabs(got - right));
            }
            worst = fmax(worst, transparent ? fabs(pixel[3] - 255 * (1 - through)) : 0);
        }
        burnish_image_destroy(&image);
    }
    CHECK(worst < 1, "%zu splats: off by %g", count, worst); /* rounding, and e^-x's 0.035 */
    burnish_mesh_destroy(mesh);
}

/* The quaternion's bytes are exact for 0 and 90 degrees; 45 is a little off. */
static void test_formulas(void) {
    const splat round[1] = {{{0, 0, 0}, {5, 5, 5}, {255, 128, 0, 200}, {255, 128, 128, 128}}};
    const splat thin[1] = {{{3, -2, 9}, {6, 0.5F, 1}, {0, 255, 90, 255}, {219, 128, 128, 219}}};
    const splat two[2] = {{{2, 1, 5}, {4, 3, 1}, {255, 0, 0, 128}, {255, 128, 128, 128}},
                          {{-2, 0, 0}, {3, 4, 1}, {0, 64, 255, 230}, {255, 128, 128, 128}}};
    for (int transparent = 0; transparent < 2; ++transparent) {
        check_splats(round, 1, 0, transparent);
        check_splats(thin, 1, acos(-1) / 2, transparent);
        check_splats(two, 2, 0, transparent);
    }
}

/* A splat twice as far away looks half as large; equal depths keep the file's order. */
static void test_views(void) {
    const splat same[2] = {{{0, 0, 0}, {4, 4, 4}, {255, 0, 0, 255}, {255, 128, 128, 128}},
                           {{0, 0, 0}, {4, 4, 4}, {0, 0, 255, 255}, {255, 128, 128, 128}}};
    burnish_mesh *mesh = load_splats(same, 2);
    burnish_render_options options = make_options();
    burnish_render_report near, far;
    options.camera.orthographic_height = 0;
    options.camera.view_angle = 30;
    burnish_image image = draw_image(mesh, &options, &near);
    const uint8_t *middle = image.pixels + (SIDE / 2 * SIDE + SIDE / 2) * image.channels;
    CHECK(middle[0] > 240 && middle[2] < 20, "%d, %d", middle[0], middle[2]);
    burnish_image_destroy(&image);
    options.camera.position[2] *= 2;
    image = draw_image(mesh, &options, &far);
    const double ratio =
        (double)(near.bounds[2] - near.bounds[0]) / (far.bounds[2] - far.bounds[0]);
    CHECK(ratio > 1.8 && ratio < 2.2, "%g", ratio);
    burnish_image_destroy(&image);
    burnish_mesh_destroy(mesh);
}

int main(void) {
    RUN(test_formulas());
    RUN(test_views());
    return test_end("splats");
}
