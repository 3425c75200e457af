/* The shadow on the ground against integrals over the part of the sky that is hidden. */
#include <math.h>

#include "pictures.h"

enum { SIZE = 201 };

/* As render/ground.c has it: what is left of the background where no sky is seen. */
#define STRENGTH 0.98
/* And what the first light adds to the rest. */
#define LIGHT_STRENGTH 0.4

/* 1: the first light, from (1, 1, 0), casts a shadow. */
static int casts_shadow;

/* Straight from above, `height` high and wide, red, green, blue and alpha of every pixel. */
static float *draw(const burnish_mesh *mesh, double height, int transparent, int samples,
                   burnish_render_report *report) {
    float *pixels = malloc((size_t)SIZE * SIZE * 4 * sizeof *pixels);
    burnish_render_options options = burnish_render_options_default();
    options.camera = (burnish_camera){{0, 10, 0}, {0, 0, 0}, {0, 0, -1}, 30, height};
    options.width = options.height = SIZE;
    options.samples = samples;
    options.transparent = transparent;
    options.ground = 1;
    options.shadow = casts_shadow;
    options.lights[0] = (burnish_light){.vector = {1, 1, 0}, .color = {1, 1, 1}};
    options.occlusion = BURNISH_OCCLUSION_MAX;
    options.up[1] = 2;
    draw_floats(mesh, &options, pixels, report);
    return pixels;
}

static const float *pixel_at(const float *pixels, int x, int y) {
    return pixels + 4 * ((size_t)y * SIZE + (size_t)x);
}

/* A ball on the ground hides (R/d)^2 cos of the sky, d from its centre: R^3 / d^3. */
static void test_ball(void) {
    burnish_mesh *mesh = load_mesh(":sphere", NULL);
    burnish_render_report report;
    const double height = 6;
    float *pixels = draw(mesh, height, 0, 1, &report);
    double worst = 0;
    CHECK(report.ground == 1, "no ground");
    for (int i = 0; i < SIZE; ++i) { /* on a diagonal; nearer it is hidden, further away fades */
        const double x = (i - SIZE / 2) * height / SIZE, distance = sqrt(2) * fabs(x);
        const double hidden = pow(1 / (1 + distance * distance), 1.5);
        const float *pixel = pixel_at(pixels, i, i);
        if (distance > 1.05 && distance < 2.1) {
            worst = fmax(worst, fabs((1 - (double)pixel[0]) / STRENGTH - hidden));
        }
    }
    CHECK(worst < 0.02, "a ball hides up to %g more or less than its share of the sky", worst);
    printf("ball: at most %.3f from the formula\n", worst);
    for (int i = 0; i < SIZE; ++i) {
        CHECK(pixel_at(pixels, i, 0)[0] <= 1 && pixel_at(pixels, i, 0)[3] == 1, "pixel %d", i);
    }
    free(pixels);
    burnish_mesh_destroy(mesh);
}

/* A plate at height 1, and a splinter under it, which says where the ground is. */
static burnish_mesh *make_plate(float half) {
    const float positions[] = {-half, 1, -half, half,  1, -half, half, 1, half,  -half, 1, half,
                               0,     0, 0,     0.05f, 0, 0,     0,    0, 0.05f, 0,     0, 0.05f};
    return create_quads(positions, NULL, 2);
}

/* Of a plate 1 x 1 at height 1 the light from (1, 1, 0) makes a shadow as large around (-1, 0, 0).
 */
static void test_light(void) {
    const double height = 4;
    double edges[2] = {0, 0}, before = 1;
    burnish_mesh *mesh = make_plate(0.5f);
    float *sky = draw(mesh, height, 0, 1, NULL);
    casts_shadow = 1;
    float *both = draw(mesh, height, 0, 1, NULL);
    casts_shadow = 0;
    for (int i = 0; i < SIZE; ++i) {
        const double at = (i - SIZE / 2) * height / SIZE;
        const int column = SIZE / 2 - (int)(SIZE / height + 0.5); /* x = -1 */
        const double along =
            (double)pixel_at(both, i, SIZE / 2)[0] / (double)pixel_at(sky, i, SIZE / 2)[0];
        const double across =
            (double)pixel_at(both, column, i)[0] / (double)pixel_at(sky, column, i)[0];
        if (at > -1.05 && at < -0.65) {
            CHECK(fabs(along - (1 - LIGHT_STRENGTH)) < 3e-3, "in the shadow %g is left", along);
        }
        if (at > 0.55 || at < -1.6) {
            CHECK(fabs(along - 1) < 1e-4, "beside it %g is left", along);
        }
        if ((across < 0.8) != (before < 0.8)) {
            edges[across > 0.8] = at;
        }
        before = across;
    }
    CHECK(fabs(edges[0] + 0.5) < 0.03 && fabs(edges[1] - 0.5) < 0.03, "edges at %g and %g",
          edges[0], edges[1]);
    free(sky);
    free(both);
    burnish_mesh_destroy(mesh);
}

/* The shadow of an area light falls to the other side, and is as dark there in small pictures; from
 * below the ground none falls. */
static void test_area_light(void) {
    static const double heights[] = {1, -0.5};
    burnish_mesh *mesh = load_mesh(":sphere", NULL);
    for (int i = 0; i < 4; ++i) {
        burnish_render_options options = burnish_render_options_default();
        float *pixels = malloc((size_t)SIZE * SIZE * 4 * sizeof *pixels);
        const int size = i < 2 ? SIZE : SIZE / 2;
        double moment = 0, sum = 0, darkest = 0;
        options.camera = (burnish_camera){{0, 10, 0}, {0, 0, 0}, {0, 0, -1}, 30, 5};
        options.width = options.height = size;
        options.transparent = options.ground = 1;
        options.up[1] = 1;
        options.light_count = 0;
        options.area_light_count = 1;
        options.area_lights[0] = (burnish_area_light){.shape = BURNISH_AREA_RECT,
                                                      .is_distant = 1,
                                                      .center = {-1, heights[i % 2], 0},
                                                      .half_u = {0, 0, -0.4},
                                                      .half_v = {0.3, 0.3, 0},
                                                      .color = {1, 1, 1}};
        draw_floats(mesh, &options, pixels, NULL);
        for (int k = 0; k < size * size; ++k) {
            const double x = k % size - 0.5 * (size - 1), y = (int)(k / size) - 0.5 * (size - 1);
            const double alpha = (double)pixels[4 * k + 3];
            if (x * x + y * y > 0.041 * size * size) { /* not the ball, of radius 0.2 */
                sum += alpha;
                moment += alpha * x / size;
                darkest = alpha > darkest ? alpha : darkest;
            }
        }
        moment /= sum;
        CHECK(i % 2 ? fabs(moment) < 0.02 : moment > 0.05, "light %d: moved by %g", i, moment);
        CHECK(i % 2 ? darkest < 0.55 : darkest > 0.6, "light %d: at most %g", i, darkest);
        free(pixels);
    }
    burnish_mesh_destroy(mesh);
}

/* A shadow that leaves the image has faded at its edge. */
static void test_border(void) {
    burnish_mesh *mesh = load_mesh(":sphere", NULL);
    float *pixels;
    double darkest = 0;
    casts_shadow = 1;
    pixels = draw(mesh, 3, 0, 1, NULL);
    casts_shadow = 0;
    for (int i = 0; i < SIZE; ++i) {
        darkest = fmax(darkest, 1 - (double)pixel_at(pixels, 0, i)[0]);
    }
    CHECK(darkest < 0.02, "the edge of the image loses %g", darkest);
    CHECK((double)pixel_at(pixels, 30, SIZE / 2)[0] < 0.7, "no shadow further inside");
    free(pixels);
    burnish_mesh_destroy(mesh);
}

/* Over white, a transparent picture is the opaque one. */
static void test_transparent(void) {
    burnish_mesh *mesh = load_mesh(":teapot", NULL);
    float *opaque = draw(mesh, 9, 0, 4, NULL), *clear = draw(mesh, 9, 1, 4, NULL);
    double worst = 0;
    int partly = 0;
    for (int i = 0; i < SIZE * SIZE; ++i) {
        const double alpha = (double)clear[4 * i + 3];
        partly += alpha > 0 && alpha < 1;
        for (int k = 0; k < 3; ++k) {
            const double over = (double)clear[4 * i + k] * alpha + (1 - alpha);
            worst = fmax(worst, fabs(over - (double)opaque[4 * i + k]));
        }
    }
    CHECK(worst < 1e-5, "over white %g off", worst);
    CHECK(partly > SIZE * SIZE / 10, "%d pixels are partly transparent", partly);
    free(opaque);
    free(clear);
    burnish_mesh_destroy(mesh);
}

/* Bytes of an object seen along `direction`. */
static burnish_image draw_along(const burnish_mesh *mesh, const double direction[3], int parallel,
                                int ground, burnish_render_report *report) {
    burnish_framing framing = burnish_framing_default();
    burnish_render_options options = burnish_render_options_default();
    burnish_error error = {BURNISH_STATUS_OK, ""};
    memcpy(framing.direction, direction, sizeof framing.direction);
    framing.orthographic = parallel;
    framing.margin = 0.2;
    burnish_camera_frame(mesh, &framing, &options.camera, &error);
    options.width = options.height = 64;
    options.ground = ground;
    options.occlusion = 8;
    return draw_image(mesh, &options, report);
}

/* The ground is not drawn from below, or in parallel projection from the side. */
static void test_directions(void) {
    static const struct {
        double direction[3];
        int parallel, is_seen;
    } cases[] = {{{0, -1, -2}, 0, 1}, {{0, 1, -2}, 0, 0}, {{0, 0, -1}, 0, 1},
                 {{0, -1, -2}, 1, 1}, {{0, 1, -2}, 1, 0}, {{0, 0, -1}, 1, 0}};
    burnish_mesh *mesh = load_mesh(":torus", NULL);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        burnish_render_report report;
        burnish_image with = draw_along(mesh, cases[i].direction, cases[i].parallel, 1, &report);
        burnish_image without = draw_along(mesh, cases[i].direction, cases[i].parallel, 0, NULL);
        CHECK(report.ground == cases[i].is_seen, "case %zu: ground %d", i, report.ground);
        CHECK((memcmp(with.pixels, without.pixels, 3 * 64 * 64) != 0) == cases[i].is_seen,
              "case %zu: shadow", i);
        burnish_image_destroy(&with);
        burnish_image_destroy(&without);
    }
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_ball());
    RUN(test_light());
    RUN(test_area_light());
    RUN(test_border());
    RUN(test_transparent());
    RUN(test_directions());
    return test_end("ground");
}
