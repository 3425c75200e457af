/* What GGX reflects of uniform light, against sums over visible normals; white metal and plastic in
 * pictures, under area lights and an environment, against walks on rough surfaces. */
#include "rough_surfaces.h"
#include "shading/shading_ops.h"

enum { STEPS = 40 };

/* ---- Walks on a rough surface (Heitz et al., Multiple-Scattering Microfacet BSDFs with the Smith
 * Model, 2016), N being z and heights uniform ---- */

/* The height in [0, 1] where a ray meets the surface; above 1: nowhere. */
static double next_height(const vec ray, double height, double alpha) {
    if (ray[2] > 0.9999) {
        return 2;
    }
    if (ray[2] < -0.9999) {
        return height * drawn();
    }
    const double lambda = smith(ray, alpha), u = drawn();
    return fabs(ray[2]) < 1e-4 ? height : height / pow(1 - u, 1 / lambda);
}

/* From a viewer in direction v to a light: its direction, and the share of light that comes. */
static double walk(const vec v, double alpha, double f0, double a, double b, vec ray) {
    double height = 1, share = 1;
    for (int k = 0; k < 3; ++k) {
        ray[k] = -v[k];
    }
    for (int i = 0; i < 32; ++i) {
        vec m;
        height = next_height(ray, height, alpha);
        if (height > 1) {
            return i > 0 ? share : 0;
        }
        const vec back = {-ray[0], -ray[1], -ray[2]};
        visible_normal(back, alpha, i > 0 ? drawn() : a, i > 0 ? drawn() : b, m);
        const double cosine = dot(back, m);
        share *= schlick(f0, cosine);
        for (int k = 0; k < 3; ++k) {
            ray[k] += 2 * cosine * m[k];
        }
    }
    return 0;
}

/* ---- Pixels ---- */

/* A white surface of reflectance f0, seen in direction v. The rest of its light is diffuse. */
static double reference(int light, const vec position, const vec normal, const vec v, double f0,
                        double alpha) {
    double shares = 0, specular = 0, diffuse = 0;
    vec axes[3], to_viewer;
    make_frame(normal, v, axes, to_viewer);
    for (int i = 0; i < STEPS * STEPS; ++i) {
        const double a = (i / STEPS + drawn()) / STEPS, b = (i % STEPS + drawn()) / STEPS;
        const double flat = sqrt(a), turn = 2 * M_PI * b;
        vec local;
        const double share = walk(to_viewer, alpha, f0, a, b, local);
        shares += share;
        specular += share > 0 ? share * local_radiance(light, position, axes, local) : 0;
        const vec around = {flat * cos(turn), flat * sin(turn), sqrt(1 - a)};
        diffuse += local_radiance(light, position, axes, around);
    }
    const double count = STEPS * STEPS;
    return (specular + (1 - shares / count) * diffuse) / count;
}

/* Differences in 8-bit codes over a grid of pixels. */
static void compare(int light, double f0, double roughness, errors *e) {
    for (int i = 3; i < SIDE * SIDE; i += 877) {
        const int x = i % SIDE, y = i / SIDE;
        vec position, normal;
        if (find_surface(x, y, position, normal)) {
            const double alpha = fmax(roughness * roughness, 1e-4);
            add_error(e, (double)picture.rgba[y][x][0],
                      reference(light, position, normal, (vec){0, 0, 1}, f0, alpha));
        }
    }
}

static int test_by_size(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Most RMS for metal; the bias is the mean of both shapes. */
static void test_light(burnish_mesh *const meshes[SHAPES], int light, double most,
                       burnish_environment *environment) {
    static const float roughnesses[] = {0.1f, 0.3f, 0.5f, 0.8f};
    const burnish_render_options options = options_for(light, environment);
    for (int i = 0; i < 8; ++i) {
        const float roughness = roughnesses[i % 4];
        const int is_metal = i / 4;
        errors e = {0};
        for (int shape = 0; shape < SHAPES; ++shape) {
            set_metal(meshes[shape], (float)is_metal, roughness);
            draw_shape(meshes[shape], &options);
            compare(light, is_metal ? 1 : 0.04, (double)roughness, &e);
        }
        const double rms = sqrt(e.squares / e.count), bias = e.sum / e.count;
        qsort(e.sizes, (size_t)e.count, sizeof *e.sizes, test_by_size);
        const double largest = e.sizes[e.count * 99 / 100];
        printf("  light %d, %s, roughness %.1f: RMS %.1f, bias %+.1f, 99 %% below %.0f of 255\n",
               light, is_metal ? "metal" : "plastic", (double)roughness, rms, bias, largest);
        CHECK(e.count > 100 && rms < (is_metal ? most : 2.5) && fabs(bias) < 2,
              "light %d, metallic %d, roughness %g: %g, %g", light, is_metal, (double)roughness,
              rms, bias);
    }
}

/* ---- Uniform light ---- */

/* What GGX reflects if F = 1, and if F = (1 - V.H)^5. */
static void albedo(double alpha, double n_dot_v, double out[2]) {
    enum { SUMS = 60 };
    const vec v = {sqrt(1 - n_dot_v * n_dot_v), 0, n_dot_v};
    out[0] = out[1] = 0;
    for (int i = 0; i < SUMS * SUMS; ++i) {
        vec m;
        visible_normal(v, alpha, (i / SUMS + 0.5) / SUMS, (i % SUMS + 0.5) / SUMS, m);
        const double cosine = dot(v, m);
        const vec w = {2 * cosine * m[0] - v[0], 2 * cosine * m[1], 2 * cosine * m[2] - v[2]};
        if (w[2] > 0) {
            const double to_v = 1 + smith(v, alpha), share = to_v / (to_v + smith(w, alpha));
            out[0] += share / (SUMS * SUMS);
            out[1] += share * pow(1 - cosine, 5) / (SUMS * SUMS);
        }
    }
}

/* F0 A + F90 B of the kernels for 1 and 1, 0 and 1, 0 and 1/4: what a black Phong material shows of
 * uniform light. */
static void test_albedo(void) {
    static float ones[2 * 10 * 10 * 4];
    const burnish_light_map map = {.size = 8, .texels = ones};
    double worst[2] = {0, 0};
    for (size_t i = 0; i < sizeof ones / sizeof *ones; ++i) {
        ones[i] = 1;
    }
    for (int i = 0; i < 11 * 20; ++i) {
        const double roughness = fmax(i / 20 / 10.0, 0.01), n_dot_v = 0.05 * (i % 20 + 1);
        double should[3];
        albedo(roughness * roughness, n_dot_v, should);
        should[2] = 0.25 * should[1];
        for (int k = 0; k < 3; ++k) {
            const burnish_environment_constants constants = {
                .viewer = {(float)sqrt(1 - n_dot_v * n_dot_v), 0, (float)n_dot_v},
                .axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                .diffuse = &map};
            const float f0 = k == 0;
            const burnish_reflecting_material material = {.reflectance = {f0, f0, f0},
                                                          .roughness = (float)roughness,
                                                          .edge_loss = k == 2 ? 0.75f : 0,
                                                          .reflects = 1,
                                                          .specular = &map};
            float normal[3][16] = {{0}}, rgb[3][16] = {{0}};
            for (int lane = 0; lane < 16; ++lane) {
                normal[2][lane] = 1;
            }
            const burnish_kernels_points points = {.normal = {normal[0], normal[1], normal[2]}};
            burnish_kernels_best()->add_environment(&constants, &material, &points,
                                                    &(burnish_reflecting_points){.open = NULL}, 1,
                                                    (float *const[3]){rgb[0], rgb[1], rgb[2]});
            worst[k > 0] = fmax(worst[k > 0], fabs((double)rgb[1][0] - should[k]));
        }
    }
    printf("albedo: at most %.4f and %.4f away\n", worst[0], worst[1]);
    CHECK1(worst[0] < 0.014 && worst[1] < 0.015);
}

int main(int count, char **arguments) {
    burnish_mesh *meshes[SHAPES];
    test_begin(count, arguments, NULL);
    seed = test_seed(5);
    burnish_environment *environment = make_room();
    make_shapes(meshes);
    RUN(test_albedo());
    for (int light = 0; light < LIGHTS; ++light) {
        RUN(test_light(meshes, light, 6.5, environment));
    }
    burnish_environment_destroy(environment);
    for (int i = 0; i < SHAPES; ++i) {
        burnish_mesh_destroy(meshes[i]);
    }
    return test_end("metals");
}
