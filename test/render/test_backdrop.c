/* The environment as the background, against the gradient that it is. */
#include <math.h>

#include "burnish/light.h"
#include "core/vec3.h"
#include "pictures.h"

enum { WIDTH = 90, HEIGHT = 70, COLUMNS = 256, ROWS = 128 };

static const double turn = 25, strength = 1.5;

/* Red: linear in the polar angle; green: a wave of the azimuth. */
static burnish_environment *make_environment(void) {
    static float rgb[ROWS][COLUMNS][3];
    burnish_environment *environment;
    burnish_error error;
    for (int y = 0; y < ROWS; ++y) {
        for (int x = 0; x < COLUMNS; ++x) {
            rgb[y][x][0] = (float)((y + 0.5) / ROWS);
            rgb[y][x][1] = (float)(0.5 + 0.4 * cos(2 * M_PI * (x + 0.5) / COLUMNS - M_PI));
            rgb[y][x][2] = 0.25f;
        }
    }
    CHECK_OK(burnish_environment_create(NULL, COLUMNS, ROWS, rgb[0][0], &environment, &error),
             error);
    return environment;
}

static burnish_render_options make_options(const burnish_environment *environment) {
    burnish_render_options options = burnish_render_options_default();
    const burnish_camera camera = {{3, 2, 5}, {0, 0.5, 0}, {0, 1, 0}, 50, 0};
    options.width = WIDTH;
    options.height = HEIGHT;
    options.camera = camera;
    options.up[1] = 1;
    options.environment = environment;
    options.environment_strength = (float)strength;
    options.environment_turn = turn;
    options.background_environment = 1;
    return options;
}

/* What the background shows at a pixel. */
static void expect(const burnish_camera *camera, int x, int y, double rgb[3]) {
    const double t = 2 * tan(camera->view_angle * M_PI / 360) / HEIGHT;
    const double across = (x + 0.5 - WIDTH / 2.0) * t, up = (HEIGHT / 2.0 - y - 0.5) * t;
    const burnish_vec3 forward = burnish_vec3_normalize(burnish_vec3_sub(
        burnish_vec3_load(camera->focal_point), burnish_vec3_load(camera->position)));
    const burnish_vec3 right =
        burnish_vec3_normalize(burnish_vec3_cross(forward, burnish_vec3_load(camera->view_up)));
    burnish_vec3 d = burnish_vec3_add(
        forward, burnish_vec3_add(burnish_vec3_scale(right, across),
                                  burnish_vec3_scale(burnish_vec3_cross(right, forward), up)));
    d = burnish_vec3_normalize(d);
    const double azimuth = atan2(d.z, d.x) + turn * M_PI / 180; /* counter-clockwise: -z from x */
    rgb[0] = strength * acos(d.y) / M_PI;
    rgb[1] = strength * (0.5 + 0.4 * cos(azimuth));
    rgb[2] = strength * 0.25;
}

static void test_gradient(const burnish_mesh *mesh, const burnish_environment *environment) {
    static float pixels[HEIGHT][WIDTH][4], black[HEIGHT][WIDTH][4], parallel[HEIGHT][WIDTH][4];
    burnish_render_options options = make_options(environment);
    double worst = 0;
    int shown = 0;
    options.samples = 1;
    draw_floats(mesh, &options, pixels[0][0], NULL);
    options.background_environment = 0;
    options.transparent = 1;
    draw_floats(mesh, &options, black[0][0], NULL);
    options = make_options(environment);
    options.camera.orthographic_height = 100; /* the object is a dot in the middle */
    draw_floats(mesh, &options, parallel[0][0], NULL);
    for (int y = 0; y < HEIGHT; ++y) {
        for (int x = 0; x < WIDTH; ++x) {
            double rgb[3];
            const int is_shown = black[y][x][3] == 0;
            expect(&options.camera, x, y, rgb);
            shown += is_shown;
            for (int k = 0; k < 3; ++k) {
                const double is = (double)pixels[y][x][k], should = rgb[k];
                worst = is_shown && fabs(is - should) > worst ? fabs(is - should) : worst;
                CHECK(is_shown || is == (double)black[y][x][k], "the object at %d, %d", x, y);
                CHECK(!is_shown || abs(x - WIDTH / 2) < 3 || parallel[y][x][k] == pixels[y][x][k],
                      "parallel at %d, %d", x, y);
            }
        }
    }
    CHECK(shown > 1000 && shown < WIDTH * HEIGHT - 100 && worst < 4e-4,
          "%d pixels of background, at most %g from the gradient", shown, worst);
    printf("gradient: at most %.1e away\n", worst);
}

/* Rows drawn alone, and shares of pixels: alpha of the transparent picture. */
static void test_rows_and_shares(const burnish_mesh *mesh, const burnish_environment *environment) {
    static float whole[HEIGHT][WIDTH][4], part[HEIGHT][WIDTH][4], object[HEIGHT][WIDTH][4];
    burnish_render_options options = make_options(environment);
    draw_floats(mesh, &options, whole[0][0], NULL);
    options.first_row = 21;
    options.row_count = 30;
    const burnish_target target =
        make_target(floats_of(part[0][0], WIDTH, options.row_count), NULL, NULL, NULL, NULL);
    draw_into(mesh, &options, &target, NULL);
    CHECK1(memcmp(part, whole[options.first_row], sizeof part[0] * 30) == 0);
    options = make_options(environment);
    options.background_environment = 0;
    options.transparent = 1;
    draw_floats(mesh, &options, object[0][0], NULL);
    for (int i = 0; i < HEIGHT * WIDTH; ++i) {
        const float *all = whole[i / WIDTH][i % WIDTH], *own = object[i / WIDTH][i % WIDTH];
        double rgb[3];
        expect(&options.camera, i % WIDTH, i / WIDTH, rgb);
        for (int k = 0; k < 3; ++k) {
            const double mixed = (double)(own[3] * own[k]) + (1 - (double)own[3]) * rgb[k];
            CHECK(fabs((double)all[k] - mixed) < 5e-4, "pixel %d: %g, expected %g", i,
                  (double)all[k], mixed);
        }
    }
}

int main(void) {
    burnish_mesh *mesh = load_mesh(":sphere", NULL);
    burnish_environment *environment = make_environment();
    RUN(test_gradient(mesh, environment));
    RUN(test_rows_and_shares(mesh, environment));
    burnish_environment_destroy(environment);
    burnish_mesh_destroy(mesh);
    return test_end("backdrop");
}
