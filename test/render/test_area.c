/* Area lights and domes in whole pictures: a furnace, sums over many points of a light; environments
 * as the background. */
#include <math.h>

#include "burnish/light.h"
#include "core/vec3.h"
#include "environment/area_lights.h"
#include "pictures.h"
#include "shading/shading_ops.h"
#include "vec.h"

enum { SIDE = 96 };

/* A picture and what its pixels show. */
static struct picture {
    float rgba[SIDE][SIDE][4], depth[SIDE][SIDE], normal[SIDE][SIDE][3];
} picture;

/* One sample per pixel, no light, seen from +z in parallel projection or in perspective. */
static burnish_render_options dark_options(int is_parallel) {
    burnish_render_options options = front_options(SIDE, SIDE, is_parallel ? 2.2 : 0);
    options.camera.position[2] = 4;
    options.camera.view_angle = 35;
    options.light_count = 0;
    set_three(options.ambient_light, 0);
    return options;
}

static void draw(const burnish_mesh *mesh, const burnish_render_options *options) {
    const burnish_target target = make_target(floats_of(picture.rgba[0][0], SIDE, SIDE),
                                              picture.depth[0], picture.normal[0][0], NULL, NULL);
    draw_into(mesh, options, &target, NULL);
}

static void set_phong(burnish_mesh *mesh, float diffuse, float specular, float exponent) {
    burnish_material material = burnish_material_default();
    set_three(material.diffuse, diffuse);
    set_three(material.specular, specular);
    material.exponent = exponent;
    material.has_diffuse = 1;
    set_material(mesh, &material);
}

/* In uniform light of 1 everything white is 1: nothing is lost and nothing is added. */
static void test_furnace(burnish_mesh *mesh) {
    burnish_render_options options = dark_options(0);
    options.has_dome = 1;
    set_three(options.dome.zenith, 1);
    set_three(options.dome.horizon, 1);
    set_three(options.dome.nadir, 1);
    for (int i = 0; i < 2 * 11 + 1; ++i) {
        double least = 9, most = 0;
        if (i < 22) {
            set_metal(mesh, (float)(i / 11), (float)(i % 11) / 10);
        } else {
            set_phong(mesh, 1, 0, 20);
        }
        draw(mesh, &options);
        for (int k = 0; k < SIDE * SIDE; ++k) {
            if (isfinite(picture.depth[k / SIDE][k % SIDE])) {
                const double white = (double)picture.rgba[k / SIDE][k % SIDE][1];
                least = fmin(least, white);
                most = fmax(most, white);
            }
        }
        CHECK(least > 1 - 1e-5 && most < 1 + 1e-5, "material %d: %g to %g", i, least, most);
    }
}

/* ---- Sums over points of a light ---- */

typedef double vec[3];

/* A point of a sphere or tube from its centre, and its normal times the area over da db. */
static void find_round(const burnish_area_light *light, double a, double b, vec at, vec front) {
    const double *u = light->half_u, *v = light->half_v, turn = M_PI * b;
    const int is_line = light->shape == BURNISH_AREA_LINE;
    const double radius = sqrt(is_line ? dot(v, v) : dot(u, u));
    const double flat = is_line ? 1 : sqrt(1 - a * a), length = is_line ? sqrt(dot(u, u)) : radius;
    vec x = {0.3, 0.5, 0.7}, y, z = {u[0], u[1], u[2]};
    normalize(z);
    cross(z, x, y);
    normalize(y);
    cross(y, z, x);
    for (int k = 0; k < 3; ++k) {
        const double n = flat * (cos(turn) * x[k] + sin(turn) * y[k]);
        front[k] = M_PI * length * radius * (n + (is_line ? 0 : a * z[k]));
        at[k] = radius * n + a * length * z[k];
    }
}

/* D and Spec at a point, by the midpoint rule over a light of 100 x 100 points. */
static void integrate(const burnish_area_light *light, const vec position, const vec normal,
                      const vec axis, double alpha, double out[2]) {
    enum { STEPS = 100 };
    const burnish_light_lobes lobes = burnish_light_lobes_for((float)alpha);
    const double *u = light->half_u, *v = light->half_v;
    out[0] = out[1] = 0;
    for (int i = 0; i < STEPS * STEPS; ++i) {
        const double a = 2 * (i / STEPS + 0.5) / STEPS - 1, b = 2 * (i % STEPS + 0.5) / STEPS - 1;
        vec w, front, at;
        cross(u, v, front);
        if (light->shape == BURNISH_AREA_DISC && a * a + b * b > 1) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            at[k] = a * u[k] + b * v[k];
        }
        if (light->shape > BURNISH_AREA_DISC) {
            find_round(light, a, b, at, front);
        }
        for (int k = 0; k < 3; ++k) {
            w[k] = light->center[k] + at[k] - (light->is_distant ? 0 : position[k]);
        }
        const double squared = dot(w, w);
        normalize(w);
        const double facing = light->is_two_sided ? fabs(dot(w, front)) : fmax(0, -dot(w, front));
        const double solid_angle = 4 * facing / squared / (STEPS * STEPS);
        const double cosine = dot(w, normal);
        out[0] += fmax(0, cosine) * solid_angle / 3.14159265358979323846;
        for (int j = 0; j < lobes.count; ++j) {
            const burnish_light_lobe *lobe = &lobes.lobe[j];
            const double zeta = (double)lobe->zeta, c = fmax(0, 1 + zeta * (dot(w, axis) - 1));
            const double energy = 2 * 3.14159265358979323846 / (zeta * (lobe->order + 1));
            const int counts = light->is_distant || cosine > 0;
            out[1] += counts * (double)lobe->weight * pow(c, lobe->order) * solid_angle / energy;
        }
    }
}

/* Where a pixel's point is, and toward the viewer. */
static void find_point(const burnish_render_options *options, int x, int y, vec position,
                       vec viewer) {
    const burnish_camera *camera = &options->camera;
    const double depth = (double)picture.depth[y][x], tangent = tan(35 * 3.14159265358979 / 360);
    const double height =
        camera->orthographic_height > 0 ? camera->orthographic_height : 2 * tangent * depth;
    position[0] = ((x + 0.5) / SIDE - 0.5) * height;
    position[1] = (0.5 - (y + 0.5) / SIDE) * height;
    position[2] = camera->position[2] - depth;
    for (int k = 0; k < 3; ++k) {
        viewer[k] = camera->orthographic_height > 0 ? (k == 2) : camera->position[k] - position[k];
    }
    normalize(viewer);
}

/* F0 A + B of each pixel: what a black surface shows of uniform light. */
static float shares[SIDE][SIDE];

static void draw_shares(burnish_mesh *mesh, burnish_render_options options, float exponent) {
    options.has_dome = 1;
    set_three(options.dome.zenith, 1);
    set_three(options.dome.horizon, 1);
    set_three(options.dome.nadir, 1);
    set_phong(mesh, 0, 1, exponent);
    draw(mesh, &options);
    for (int i = 0; i < SIDE * SIDE; ++i) {
        shares[i / SIDE][i % SIDE] = picture.rgba[i / SIDE][i % SIDE][0];
    }
}

/* The largest difference between a picture of one light and the sum, in colour per radiance, over a
 * grid of pixels. */
static double compare(const burnish_render_options *options, const burnish_material *material) {
    const burnish_area_light *light = &options->area_lights[0];
    const double alpha = sqrt(2 / ((double)material->exponent + 2));
    double worst = 0;
    for (int i = 0; i < SIDE * SIDE; i += 173) {
        const int x = i % SIDE, y = i / SIDE;
        vec position, viewer, normal, axis;
        double sums[2];
        if (!isfinite(picture.depth[y][x])) {
            continue;
        }
        find_point(options, x, y, position, viewer);
        for (int k = 0; k < 3; ++k) {
            normal[k] = (double)picture.normal[y][x][k];
        }
        const double n_dot_v = dot(normal, viewer);
        for (int k = 0; k < 3; ++k) {
            axis[k] = 2 * n_dot_v * normal[k] - viewer[k];
        }
        integrate(light, position, normal, axis, alpha, sums);
        const double share = (double)shares[y][x];
        const double kd = fmin((double)material->diffuse[0], 1 - share);
        const double want = kd * sums[0] + share * sums[1];
        const double got = (double)picture.rgba[y][x][0] / (double)light->color[0];
        worst = fmax(worst, fabs(got - want));
    }
    return worst;
}

static void test_sums(burnish_mesh *mesh) {
    static const struct {
        burnish_area_light light;
        double most; /* error of the maps' look-up, or of the cells' quadratics (near_cells.h) */
    } cases[] = {
        {{BURNISH_AREA_RECT, 1, 0, 0, {-2, 1.5, 1}, {-0.6, 0, -0.8}, {0, 0.8, -0.2}, {4, 4, 4}},
         4e-3},
        {{BURNISH_AREA_DISC, 1, 1, 1, {1, 0.5, 1}, {0.6, 0, -0.6}, {0, 0.5, 0}, {2, 2, 2}}, 6e-3},
        {{BURNISH_AREA_RECT, 0, 0, 0, {0.3, 1.5, 1}, {-0.5, 0, 0}, {0, 0.2, -0.3}, {4, 4, 4}},
         3e-3},
        {{BURNISH_AREA_RECT, 0, 0, 1, {-1.2, 0, 0.5}, {0, 0.5, 0}, {0.2, 0, 0.6}, {4, 4, 4}}, 3e-3},
        {{BURNISH_AREA_DISC, 0, 0, 1, {1, 1, 1}, {0.3, 0, -0.3}, {0, 0.4, 0}, {4, 4, 4}}, 3e-3},
        {{BURNISH_AREA_SPHERE, 0, 0, 0, {-0.9, 0.9, 0.9}, {0.3, 0, 0}, {0, 0, 0}, {4, 4, 4}}, 3e-3},
        {{BURNISH_AREA_SPHERE, 1, 0, 0, {1, 2, 0.5}, {0.5, 0, 0}, {0, 0, 0}, {4, 4, 4}}, 4e-3},
        {{BURNISH_AREA_LINE, 0, 0, 0, {0, 1, 1}, {0.9, 0, 0}, {0, 0.06, 0}, {4, 4, 4}}, 4e-3},
        {{BURNISH_AREA_LINE, 1, 1, 0, {1, 0.5, 1}, {0.2, 0.7, 0}, {0.1, 0, 0}, {4, 4, 4}}, 4e-3},
    };
    for (int is_parallel = 0; is_parallel < 2; ++is_parallel) {
        for (float exponent = 4; exponent < 300; exponent *= 8) {
            draw_shares(mesh, dark_options(is_parallel), exponent);
            for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
                burnish_render_options options = dark_options(is_parallel);
                options.area_lights[0] = cases[i].light;
                options.area_light_count = 1;
                set_phong(mesh, 0.5f, 1, exponent);
                draw(mesh, &options);
                const double worst = compare(&options, burnish_mesh_get_material(mesh, 0));
                CHECK(worst < cases[i].most, "light %zu, parallel %d, exponent %g: off by %g", i,
                      is_parallel, (double)exponent, worst);
            }
        }
    }
}

/* ---- GGX under near lights ---- */

static double drawn(void) {
    return (rand() + 0.5) / (RAND_MAX + 1.0);
}

/* Whether a ray from the origin meets a rectangle or a sphere. */
static int meets(const burnish_area_light *light, const vec w) {
    const double *u = light->half_u, *v = light->half_v, *c = light->center;
    vec n;
    if (light->shape == BURNISH_AREA_SPHERE) {
        return dot(w, c) > 0 && dot(c, c) - pow(dot(w, c), 2) <= dot(u, u) * dot(w, w);
    }
    cross(u, v, n);
    const double t = dot(n, c) / dot(n, w);
    const vec d = {t * w[0] - c[0], t * w[1] - c[1], t * w[2] - c[2]};
    return t > 0 && fabs(dot(d, u)) <= dot(u, u) && fabs(dot(d, v)) <= dot(v, v);
}

/* The mean of a light of radiance 1 under GGX with Smith's correlated shadowing, N being z: sums over
 * half vectors drawn from the distribution. */
static double ggx_mean(const burnish_area_light *light, const vec viewer, double alpha) {
    const double a2 = alpha * alpha;
    double sum = 0, all = 0;
    for (int i = 0; i < 2000; ++i) {
        const double r = drawn(), phi = 2 * M_PI * drawn();
        const double z = sqrt((1 - r) / (1 + (a2 - 1) * r)), s = sqrt(1 - z * z);
        const vec h = {s * cos(phi), s * sin(phi), z};
        const double v_h = dot(viewer, h);
        const vec w = {2 * v_h * h[0] - viewer[0], 2 * v_h * h[1] - viewer[1],
                       2 * v_h * h[2] - viewer[2]};
        if (v_h > 0 && w[2] > 0) {
            const double to_v = w[2] * sqrt(a2 + (1 - a2) * viewer[2] * viewer[2]);
            const double to_w = viewer[2] * sqrt(a2 + (1 - a2) * w[2] * w[2]);
            const double weight = w[2] / (to_v + to_w) * v_h / z;
            all += weight;
            sum += meets(light, w) ? weight : 0;
        }
    }
    return sum / all;
}

/* The renderer's mean for one point at the origin, with GGX's stretch or without. */
static double lobe_mean(const burnish_area_light *light, const vec viewer, float roughness,
                        int is_stretched) {
    const burnish_kernels *kernels = burnish_kernels_best();
    const float alpha = roughness * roughness;
    const burnish_light_lobes lobes =
        is_stretched ? burnish_light_lobes_near(alpha) : burnish_light_lobes_for(alpha);
    burnish_environment_constants constants = {.local_viewer = 0};
    const burnish_reflecting_material material = {
        .roughness = roughness, .is_metallic = 1, .reflects = 1};
    float arrays[14][16] = {{0}}, *a[14];
    burnish_polygon_constants polygon;
    for (int k = 0; k < 14; ++k) {
        a[k] = arrays[k];
    }
    for (int i = 0; i < 16; ++i) {
        arrays[2][i] = arrays[6][i] = 1;
    }
    const burnish_kernels_points points = {
        .normal = {a[0], a[1], a[2]}, .position = {a[3], a[4], a[5]}, .w = a[6]};
    const burnish_kernels_axes axes = {{a[7], a[8], a[9]},
                                       {is_stretched ? a[10] : NULL, a[11], a[12]}};
    for (int k = 0; k < 3; ++k) {
        constants.viewer[k] = (float)viewer[k];
    }
    CHECK1(burnish_area_polygon(light, &lobes, &polygon));
    kernels->reflect_points(&constants, &material, &points, NULL, 1,
                            (float *const[3]){a[7], a[8], a[9]},
                            is_stretched ? (float *const[3]){a[10], a[11], a[12]} : NULL);
    kernels->polygon_light(&polygon, &points, &axes, 1, (float *const[2]){NULL, a[13]});
    return (double)arrays[13][0];
}

/* The stretch makes the error of near lights smaller. */
static void test_ggx(void) {
    static const float roughnesses[] = {0.2f, 0.4f, 0.6f, 0.8f};
    for (int round = 0; round < 8; ++round) {
        const int k = round % 4, is_sphere = round / 4;
        const double r = (double)roughnesses[k];
        double squares[2] = {0, 0};
        for (int i = 0; i < 50; ++i) {
            const double tilt = 0.5 * M_PI * (0.05 + 0.85 * drawn());
            const vec viewer = {sin(tilt), 0, cos(tilt)};
            burnish_area_light light = {
                .shape = is_sphere ? BURNISH_AREA_SPHERE : BURNISH_AREA_RECT, .is_two_sided = 1};
            for (int j = 0; j < 3; ++j) { /* near the mirror direction */
                light.center[j] = (j < 2 ? -viewer[j] : viewer[j]) + 0.8 * (drawn() - 0.5);
            }
            light.center[2] = fmax(light.center[2], 0.1);
            light.half_u[0] = 0.1 + 0.4 * drawn();
            light.half_v[1] = 0.1 + 0.4 * drawn();
            const double truth = ggx_mean(&light, viewer, r * r);
            for (int j = 0; j < 2; ++j) {
                const double d = lobe_mean(&light, viewer, roughnesses[k], j) - truth;
                squares[j] += d * d / 50;
            }
        }
        printf("  GGX, %s, roughness %.1f: error %.4f, stretched %.4f\n",
               is_sphere ? "sphere" : "rect", r, sqrt(squares[0]), sqrt(squares[1]));
        CHECK(squares[1] < (k < 3 ? 0.5 : 1.2) * squares[0], "roughness %g", r);
    }
}

/* ---- The environment as the background, against the gradient that it is ---- */

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

static burnish_render_options backdrop_options(const burnish_environment *environment) {
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
    burnish_render_options options = backdrop_options(environment);
    double worst = 0;
    int shown = 0;
    options.samples = 1;
    draw_floats(mesh, &options, pixels[0][0], NULL);
    options.background_environment = 0;
    options.transparent = 1;
    draw_floats(mesh, &options, black[0][0], NULL);
    options = backdrop_options(environment);
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
    burnish_render_options options = backdrop_options(environment);
    draw_floats(mesh, &options, whole[0][0], NULL);
    options.first_row = 21;
    options.row_count = 30;
    const burnish_target target =
        make_target(floats_of(part[0][0], WIDTH, options.row_count), NULL, NULL, NULL, NULL);
    draw_into(mesh, &options, &target, NULL);
    CHECK1(memcmp(part, whole[options.first_row], sizeof part[0] * 30) == 0);
    options = backdrop_options(environment);
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

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    burnish_mesh *mesh = load_tessellated(":sphere", 64), *sphere = load_mesh(":sphere", NULL);
    burnish_environment *environment = make_environment();
    RUN(test_furnace(mesh));
    RUN(test_sums(mesh));
    RUN(test_ggx());
    RUN(test_gradient(sphere, environment));
    RUN(test_rows_and_shares(sphere, environment));
    burnish_environment_destroy(environment);
    burnish_mesh_destroy(mesh);
    burnish_mesh_destroy(sphere);
    return test_end("area");
}
