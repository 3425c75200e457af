/* The shadow of the first light: where its edge must be, that convex shapes cast none, and masked
 * triangles that of what the mask leaves. */
#include <math.h>

#include "pictures.h"

enum { SIZE = 256 };

#define AMBIENT 0.08f

/* 1: by rays. */
static int raytracing;

/* Straight from above, 4 high and wide, red of every pixel, no specular part. */
static float *draw_options(burnish_mesh *mesh, burnish_render_options options, int shadow) {
    float *pixels = malloc((size_t)SIZE * SIZE * 4 * sizeof *pixels);
    burnish_render_report report;
    const burnish_material material = matt_material(1);
    set_material(mesh, &material);
    options.camera = (burnish_camera){{0, 10, 0}, {0, 0, 0}, {0, 0, -1}, 30, 4};
    options.width = options.height = SIZE;
    options.samples = 1;
    options.shadow = shadow;
    options.raytracing = raytracing;
    draw_floats(mesh, &options, pixels, &report);
    CHECK(report.shadow == shadow, "shadow %d", report.shadow);
    return pixels;
}

static float *draw(burnish_mesh *mesh, const double light[3], int shadow) {
    burnish_render_options options = burnish_render_options_default();
    light_from(&options, light[0], light[1], light[2]);
    set_three(options.ambient_light, AMBIENT);
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
    static const float positions[] = {-2, 0, -2, -2, 0, 2, 2, 0, 2, 2, 0, -2,
                                      0,  0, -2, 0,  0, 2, 0, 1, 2, 0, 1, -2};
    static const double light[] = {-1, 1, 0};
    burnish_mesh *mesh = create_quads(positions, NULL, 2);
    float *lit = draw(mesh, light, 0), *shaded = draw(mesh, light, 1);
    const float *row = shaded + 4 * SIZE * (SIZE / 2), *open = lit + 4 * SIZE * (SIZE / 2);
    double edge = 0;
    for (int i = 0; i < SIZE; ++i) {
        const double x = (i + 0.5) * 4 / SIZE - 2, found = (double)row[4 * i];
        const double all = (double)open[4 * i], ambient = (double)AMBIENT;
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
    const float positions[] = {-2,    0, -2,    -2,    0, 2,    2,    0, 2,    2,    0, -2,
                               -0.5f, y, -0.5f, -0.5f, y, 0.5f, 0.5f, y, 0.5f, 0.5f, y, -0.5f};
    burnish_mesh *mesh = create_quads(positions, NULL, 2);
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

/* The shadow of an area light is that of its centre with a soft edge: docs/light.md has the errors.
 * Rays draw its penumbra. */
static void test_area(void) {
    static const double heights[] = {0.05, 0.2, 0.8}, scales[] = {0.1, 0.5, 1};
    static const double most[3][3] = {
        {0.025, 0.018, 0.028}, {0.012, 0.029, 0.103}, {0.009, 0.05, 0.15}};
    for (int i = 0; i < 9; ++i) {
        const double error = plate_error(heights[i % 3], scales[i / 3]);
        printf("shadow: plate at %.2f, light x %.1f: %.4f\n", heights[i % 3], scales[i / 3], error);
        CHECK(error < (raytracing ? 0.015 : most[i / 3][i % 3]), "%g", error);
    }
}

/* A beam over a floor hides the same share of a light along its length. */
static void test_beam(void) {
    static const float positions[] = {-2,     0, -2, -2,     0, 2, 2,     0, 2, 2,     0, -2,
                                      -0.03f, 1, -2, -0.03f, 1, 2, 0.03f, 1, 2, 0.03f, 1, -2};
    burnish_mesh *mesh = create_quads(positions, NULL, 2);
    const burnish_area_light light = window(1);
    float *shaded = draw_light(mesh, &light, 1);
    double worst = 0;
    for (int i = SIZE * 7 / 16; i < SIZE * 9 / 16; ++i) {
        for (int x = SIZE * 9 / 16; x < SIZE; ++x) { /* two pixels on, other rays are cast */
            const float *at = shaded + 4 * (i * SIZE + x);
            worst = fmax(worst, fabs((double)(at[8 * SIZE] / at[0]) - 1));
        }
    }
    printf("shadow: along a beam it differs by up to %.4f\n", worst);
    CHECK(worst < 0.02, "%g", worst);
    free(shaded);
    burnish_mesh_destroy(mesh);
}

/* Convex shapes hide no light from themselves: no acne. */
static void test_convex(void) {
    static const double lights[][3] = {{0.3, 1, 0.2}, {-1, 0.5, 0.3}, {1, 0.1, 0}};
    burnish_mesh *mesh = load_mesh(":sphere", NULL);
    for (int l = 0; l < 3; ++l) {
        float *lit = draw(mesh, lights[l], 0), *shaded = draw(mesh, lights[l], 1);
        double worst = 0;
        for (int i = 0; i < SIZE * SIZE; ++i) {
            worst = fmax(worst, (double)(lit[4 * i] - shaded[4 * i]));
        }
        CHECK(worst < 0.01, "light %d: a sphere loses up to %g of its light", l, worst);
        free(lit);
        free(shaded);
    }
    burnish_mesh_destroy(mesh);
}

/* ---- Masks ---- */

enum { CARD_SIZE = 96 };

typedef struct picture {
    float pixels[CARD_SIZE * CARD_SIZE * 4];
} picture;

/* A floor and a card above it, from x = -1 to `right`; alpha: of the right half of its image. */
static void draw_card(const burnish_material *card, float right, uint8_t alpha, int shadow,
                      int occlusion, picture *to) {
    const uint8_t texels[] = {255, 255, 255, 255, 255, 255, 255, alpha};
    static const float coordinates[] = {0, 0, 1, 0, 1, 1, 0, 1, 0, 0, 1, 0, 1, 1, 0, 1};
    static const uint16_t triangle_materials[] = {0, 0, 1, 1};
    const float positions[] = {-2, -2, 0, 2,     -2, 0, 2,     2, 0, -2, 2, 0,
                               -1, -1, 1, right, -1, 1, right, 1, 1, -1, 1, 1};
    const burnish_texture texture = {NULL, 2, 1, texels, 1};
    const burnish_material materials[2] = {burnish_material_default(), *card};
    burnish_mesh_description arrays = describe_quads(positions, NULL, 2);
    burnish_render_options options = burnish_render_options_default();
    arrays.triangle_materials = (burnish_array){triangle_materials, 4, 0};
    give_materials(&arrays, materials, 2);
    give_textures(&arrays, coordinates, &texture, 1);
    burnish_mesh *mesh = create_mesh(&arrays, NULL);
    options.width = options.height = CARD_SIZE;
    options.camera = (burnish_camera){{3, -6, 5}, {0, 0, 0}, {0, 0, 1}, 45, 0};
    options.light_count = 1;
    options.lights[0] = (burnish_light){.vector = {0.2, 0.3, 0.9}, .color = {1, 1, 1}};
    options.shadow = shadow;
    options.occlusion = occlusion;
    draw_floats(mesh, &options, to->pixels, NULL);
    burnish_mesh_destroy(mesh);
}

/* Pixels whose light differs by more than a twentieth. */
static int different_pixels(const picture *a, const picture *b) {
    int count = 0;
    for (int i = 0; i < CARD_SIZE * CARD_SIZE; ++i) {
        count += fabsf(a->pixels[4 * i] - b->pixels[4 * i]) > 0.05f;
    }
    return count;
}

static burnish_material masked(float cutoff) {
    burnish_material material = burnish_material_default();
    material.textures[BURNISH_TEXTURE_COLOR].texture = 1;
    material.textures[BURNISH_TEXTURE_COLOR].wrap[0] = BURNISH_WRAP_CLAMP;
    material.alpha_mode = BURNISH_ALPHA_MASK;
    material.alpha_cutoff = cutoff;
    return material;
}

/* Half of the card casts what half a card does. */
static void test_half(int shadow, int occlusion) {
    static picture opaque, left, none;
    const burnish_material plain = burnish_material_default();
    const burnish_material half = masked(0.5f);
    draw_card(&plain, 0, 255, shadow, occlusion, &opaque);
    draw_card(&half, 1, 0, shadow, occlusion, &left);
    draw_card(&plain, 0, 255, 0, 0, &none);
    CHECK(different_pixels(&opaque, &none) > 150, "shadow %d: it shows in %d pixels", shadow,
          different_pixels(&opaque, &none));
    CHECK(different_pixels(&opaque, &left) < 40, "shadow %d: %d pixels differ", shadow,
          different_pixels(&opaque, &left));
}

/* A mask that leaves nothing casts nothing, one that leaves all casts as a whole card does. */
static void test_extremes(void) {
    static picture whole, all, nothing, without;
    const burnish_material plain = burnish_material_default();
    burnish_material material = masked(0.1f);
    draw_card(&plain, 1, 255, 1, 0, &whole);
    draw_card(&material, 1, 60, 1, 0, &all);
    CHECK(different_pixels(&whole, &all) == 0, "%d pixels differ", different_pixels(&whole, &all));
    material.alpha_cutoff = 0.5f;
    material.transparency = 0.6f;
    draw_card(&material, 1, 0, 1, 0, &nothing);
    draw_card(&material, 1, 0, 0, 0, &without);
    CHECK(different_pixels(&nothing, &without) == 0, "%d pixels differ",
          different_pixels(&nothing, &without));
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_edge());
    RUN(test_area());
    RUN(test_convex());
    RUN(test_half(1, 0));
    RUN(test_half(0, 48));
    RUN(test_extremes());
    raytracing = 1;
    RUN(test_edge());
    RUN(test_area());
    RUN(test_beam());
    RUN(test_convex());
    return test_end("shadow");
}
