/* The shadow of the first light: where its edge must be, and that convex shapes cast none. */
#include <math.h>

#include "draw_floats.h"
#include "kept_renderer.h"
#include "mesh_arrays.h"
#include "support.h"

enum { SIZE = 256 };

/* Straight from above, 4 high and wide, red of every pixel, no specular part. */
static float *draw_options(burnish_mesh *mesh, burnish_render_options options, int shadow) {
    float *pixels = malloc((size_t)SIZE * SIZE * 4 * sizeof *pixels);
    burnish_render_report report;
    burnish_error error = {BURNISH_STATUS_OK, ""};
    burnish_material material = *burnish_mesh_get_material(mesh, 0);
    for (int k = 0; k < 3; ++k) {
        material.ambient[k] = material.diffuse[k] = 1;
        material.specular[k] = 0;
    }
    burnish_mesh_set_material(mesh, 0, &material, &error);
    options.camera.position[1] = 10;
    options.camera.view_up[1] = 0;
    options.camera.view_up[2] = -1;
    options.camera.orthographic_height = 4;
    options.width = options.height = SIZE;
    options.samples = 1;
    options.shadow = shadow;
    draw_floats(mesh, &options, pixels, &report);
    CHECK(report.shadow == shadow, "shadow %d", report.shadow);
    return pixels;
}

static float *draw(burnish_mesh *mesh, const double light[3], int shadow) {
    burnish_render_options options = burnish_render_options_default();
    options.light_count = 1;
    options.lights[0].follows_camera = 0;
    for (int k = 0; k < 3; ++k) {
        options.lights[0].vector[k] = light[k];
        options.lights[0].color[k] = 1;
    }
    return draw_options(mesh, options, shadow);
}

static float *draw_light(burnish_mesh *mesh, const burnish_area_light *light, int shadow) {
    burnish_render_options options = burnish_render_options_default();
    options.light_count = 0;
    options.area_light_count = 1;
    options.area_lights[0] = *light;
    memset(options.ambient_light, 0, sizeof options.ambient_light);
    return draw_options(mesh, options, shadow);
}

/* A wall x = 0, 0 < y < 1, on a floor: under a light of 45 degrees from -x its shadow ends at x =
 * 1, where only the ambient light stays. */
static void test_edge(void) {
    static const float positions[] = {-2, 0, -2, 2, 0, -2, 2, 0, 2, -2, 0, 2,
                                      0,  0, -2, 0, 0, 2,  0, 1, 2, 0,  1, -2};
    static const uint32_t indices[] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7};
    static const double light[] = {-1, 1, 0};
    burnish_mesh_description arrays = describe_arrays(positions, NULL, NULL, 8, indices, 4);
    burnish_mesh *mesh = create_mesh(&arrays, NULL);
    float *lit = draw(mesh, light, 0), *shaded = draw(mesh, light, 1);
    const float *row = shaded + 4 * SIZE * (SIZE / 2), *open = lit + 4 * SIZE * (SIZE / 2);
    double edge = 0;
    for (int i = 0; i < SIZE; ++i) {
        const double x = (i + 0.5) * 4 / SIZE - 2, found = (double)row[4 * i];
        const double all = (double)open[4 * i], ambient = 0.08;
        if (fabs(x) < 0.04) {
            edge += x > 0 ? 4.0 / SIZE : 0; /* the wall's foot */
            continue;
        }
        if (x < 0 || x > 1.05) {
            CHECK(fabs(found - all) < 1e-5, "x %g: %g, lit %g", x, found, all);
        } else if (x < 0.95) {
            CHECK(fabs(found - ambient) < 1e-5, "x %g: %g, not dark", x, found);
        }
        edge += x > 0 ? (all - found) / (all - ambient) * 4 / SIZE : 0;
    }
    CHECK(fabs(edge - 1) < 0.05, "the shadow ends at %g", edge);
    printf("shadow: ends at %.3f, expected 1\n", edge);
    free(lit);
    free(shaded);
    burnish_mesh_destroy(mesh);
}

/* ---- Area lights ---- */

/* The window of the studio, with its size scaled, in the scene's axes. */
static burnish_area_light window(double scale) {
    burnish_area_light light = {.is_distant = 1,
                                .center = {-0.4716, 0.6428, 0.6037},
                                .half_u = {0.1994 * scale, 0.3860 * scale, -0.2552 * scale},
                                .half_v = {0.3404 * scale, 0, 0.2659 * scale},
                                .color = {1, 1, 1}};
    return light;
}

/* The share of a light that arrives at (x, 0, z) below a square plate at a height, and what would
 * without the plate: sums over 32 x 32 parts of the light. */
static double sum_light(const burnish_area_light *light, double height, double x, double z,
                        double *open) {
    enum { PARTS = 32 };
    double shaded = 0;
    *open = 0;
    for (int i = 0; i < PARTS * PARTS; ++i) {
        const double s = (i / PARTS + 0.5) * 2 / PARTS - 1, t = (i % PARTS + 0.5) * 2 / PARTS - 1;
        double w[3], squared = 0, facing = 0;
        for (int k = 0; k < 3; ++k) {
            w[k] = light->center[k] + s * light->half_u[k] + t * light->half_v[k];
            squared += w[k] * w[k];
            facing += w[k] * light->center[k]; /* of length 1, the normal */
        }
        const double part = fmax(w[1], 0) * facing / (squared * squared);
        const double hit_x = x + height * w[0] / w[1], hit_z = z + height * w[2] / w[1];
        const int is_hit = w[1] > 0 && fabs(hit_x) < 0.5 && fabs(hit_z) < 0.5;
        *open += part;
        shaded += is_hit ? 0 : part;
    }
    return shaded;
}

/* A plate over a floor. Returns the root of the mean square of the shadow's error over the floor
 * beside the plate, as a share of the light. */
static double plate_error(double height, double scale) {
    const float y = (float)height;
    const float positions[] = {-2,    0, -2,    2,    0, -2,    2,    0, 2,    -2,    0, 2,
                               -0.5f, y, -0.5f, 0.5f, y, -0.5f, 0.5f, y, 0.5f, -0.5f, y, 0.5f};
    static const uint32_t indices[] = {0, 2, 1, 0, 3, 2, 4, 6, 5, 4, 7, 6};
    burnish_mesh_description arrays = describe_arrays(positions, NULL, NULL, 8, indices, 4);
    burnish_mesh *mesh = create_mesh(&arrays, NULL);
    const burnish_area_light light = window(scale);
    float *lit = draw_light(mesh, &light, 0), *shaded = draw_light(mesh, &light, 1);
    double sum = 0;
    int count = 0;
    for (int i = 0; i < SIZE * SIZE; i += 3) {
        const double px = (i % SIZE + 0.5) * 4 / SIZE - 2, pz = (i / SIZE + 0.5) * 4 / SIZE - 2;
        if (fabs(px) < 0.52 && fabs(pz) < 0.52) {
            continue;
        }
        double open;
        const double truth = sum_light(&light, height, px, pz, &open) / open;
        const double error = (double)shaded[4 * i] / (double)lit[4 * i] - truth;
        sum += error * error;
        ++count;
    }
    free(lit);
    free(shaded);
    burnish_mesh_destroy(mesh);
    return sqrt(sum / count);
}

/* The shadow of an area light is that of its centre with a soft edge: docs/light.md has the errors. */
static void test_area(void) {
    static const double heights[] = {0.05, 0.2, 0.8}, scales[] = {0.1, 0.5, 1};
    static const double most[3][3] = {
        {0.025, 0.018, 0.028}, {0.012, 0.029, 0.103}, {0.009, 0.05, 0.15}};
    for (int i = 0; i < 9; ++i) {
        const double error = plate_error(heights[i % 3], scales[i / 3]);
        printf("shadow: plate at %.2f, light x %.1f: %.4f\n", heights[i % 3], scales[i / 3], error);
        CHECK(error < most[i / 3][i % 3], "%g", error);
    }
}

/* Convex shapes hide no light from themselves: no acne. */
static void test_convex(void) {
    static const double lights[][3] = {{0.3, 1, 0.2}, {-1, 0.5, 0.3}, {1, 0.1, 0}};
    burnish_mesh *mesh = load_mesh(":sphere", NULL);
    for (int l = 0; l < 3; ++l) {
        float *lit = draw(mesh, lights[l], 0), *shaded = draw(mesh, lights[l], 1);
        double worst = 0;
        for (int i = 0; i < SIZE * SIZE; ++i) {
            const double difference = (double)(lit[4 * i] - shaded[4 * i]);
            worst = difference > worst ? difference : worst;
        }
        CHECK(worst < 0.01, "light %d: a sphere loses up to %g of its light", l, worst);
        free(lit);
        free(shaded);
    }
    burnish_mesh_destroy(mesh);
}

/* The holes of a mask cast no shadow, also after its cutoff changes. */
static void test_cutoffs_again(void) {
    static const float positions[] = {-2, -2, 0, 2, -2, 0, 2, 2, 0, -2, 2, 0,
                                      -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, 1};
    static const float coordinates[] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 1, 0, 1};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    static const uint16_t materials_of[] = {0, 0, 1, 1};
    static const float cutoffs[] = {0.2f, 0.8f, 0.5f, 0.2f};
    static uint8_t texels[4 * 8 * 8];
    const burnish_texture texture = {NULL, 8, 8, texels, 1};
    burnish_material materials[2] = {burnish_material_default(), burnish_material_default()};
    burnish_mesh_description arrays = describe_arrays(positions, NULL, NULL, 8, indices, 4);
    burnish_load_options load = burnish_load_options_default();
    burnish_render_options options = burnish_render_options_default();
    burnish_error error = {BURNISH_STATUS_OK, ""};
    burnish_renderer *kept = NULL;
    burnish_mesh *mesh = NULL;
    burnish_image image = {0};
    for (int i = 0; i < 8 * 8; ++i) { /* alpha rises along x */
        memset(texels + 4 * i, 255, 3);
        texels[4 * i + 3] = (uint8_t)(36 * (i % 8));
    }
    materials[1].alpha_mode = BURNISH_ALPHA_MASK;
    materials[1].textures[BURNISH_TEXTURE_COLOR] =
        (burnish_texture_use){.texture = 1, .strength = 1};
    arrays.texture_coordinates = (burnish_array){coordinates, 8, 0};
    arrays.triangle_materials = (burnish_array){materials_of, 4, 0};
    arrays.materials = materials;
    arrays.material_count = 2;
    arrays.textures = &texture;
    arrays.texture_count = 1;
    options.width = options.height = 100;
    options.shadow = 1;
    options.occlusion = 8;
    burnish_renderer_create(NULL, &kept, &error);
    if (CHECK_OK(burnish_mesh_create(&arrays, &load, &mesh, &error), error)) {
        uint64_t hashes[4];
        for (int i = 0; i < 4; ++i) {
            materials[1].alpha_cutoff = cutoffs[i];
            CHECK_OK(burnish_mesh_set_material(mesh, 1, &materials[1], &error), error);
            check_kept_renderer(kept, &image, mesh, &options, "a cutoff");
            hashes[i] = burnish_image_hash(&image);
        }
        CHECK(hashes[0] != hashes[1] && hashes[1] != hashes[2] && hashes[0] == hashes[3],
              "cutoffs make no difference");
    }
    burnish_mesh_destroy(mesh);
    burnish_image_destroy(&image);
    burnish_renderer_destroy(kept);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_edge());
    RUN(test_area());
    RUN(test_convex());
    RUN(test_cutoffs_again());
    return test_end("shadow");
}
