/* Light that passes: panes against the formulas of KHR_materials_transmission and
 * KHR_materials_volume, directions of refracted rays against angles, a ball in even light. */
#include <math.h>

#include "pictures.h"
#include "render/texture/texture.h"

static const float tint[3] = {0.9f, 0.5f, 0.2f}, absorbed[3] = {0.8f, 0.1f, 0.5f};

static double fresnel(double f0, double cosine) {
    return f0 + (0.75 - f0) * pow(1 - cosine, 5);
}

static burnish_material glass(float thickness) {
    burnish_material material = burnish_material_default();
    material.is_metallic = material.has_diffuse = 1;
    material.transmission = 1;
    material.thickness = thickness;
    material.attenuation_distance = 0.5f;
    material.edge_loss = 0.25f;
    set_three(material.reflectance, 0.04f);
    memcpy(material.diffuse, tint, sizeof tint);
    memcpy(material.attenuation_color, absorbed, sizeof absorbed);
    return material;
}

/* ---- Panes over a colour, without light of their own ---- */

/* A pane around the vertical axis, its front or its back toward the viewer. */
static burnish_mesh *make_pane(double degrees, int is_back) {
    const float x = 4 * (float)cos(degrees * M_PI / 180), z = 4 * (float)sin(degrees * M_PI / 180);
    const float s = is_back ? -1 : 1;
    const float corners[12] = {-s * x, -4, s * z,  s * x,  -4, -s * z,
                               s * x,  4,  -s * z, -s * x, 4,  s * z};
    return create_quads(corners, NULL, 1);
}

static void check_pane(double degrees, float thickness, int is_back, int samples, int transparent) {
    enum { SIDE = 8 };
    static float pixels[SIDE * SIDE][4];
    burnish_mesh *mesh = make_pane(degrees, is_back);
    burnish_render_options options = front_options(SIDE, SIDE, 0.5);
    const burnish_material material = glass(thickness);
    const double rest = 1 - fresnel((double)0.04f, cos(degrees * M_PI / 180));
    double expected[4] = {0}, through[3], least = 1;
    options.light_count = 0;
    options.samples = samples;
    options.transparent = transparent;
    set_three(options.ambient_light, 0);
    set_material(mesh, &material);
    for (int k = 0; k < 3; ++k) {
        options.background[k] = (uint8_t)(100 + 60 * k);
        through[k] = rest;
        if (thickness <= 0 || !is_back) { /* a volume tints where light enters */
            through[k] *= (double)tint[k] * pow((double)absorbed[k], (double)thickness / 0.5);
        }
        least = fmin(least, through[k]);
    }
    for (int k = 0; k < 3; ++k) {
        const double light = (double)burnish_srgb_decode((float)options.background[k] / 255);
        expected[k] = transparent ? (through[k] - least) / (1 - least) : through[k] * light;
    }
    expected[3] = transparent ? 1 - least : 1;
    draw_floats(mesh, &options, pixels[0], NULL);
    for (int i = 0; i < 4 * SIDE * SIDE; ++i) {
        CHECK(fabs((double)pixels[i / 4][i % 4] - expected[i % 4]) < 2e-6,
              "%g degrees, thickness %g, back %d: pixel %d[%d]: %.8f, not %.8f", degrees,
              (double)thickness, is_back, i / 4, i % 4, (double)pixels[i / 4][i % 4],
              expected[i % 4]);
    }
    burnish_mesh_destroy(mesh);
}

static void test_panes(void) {
    static const double angles[] = {0, 20, 45, 60, 75, 85};
    static const float depths[] = {0, 0.1f, 0.5f, 1, 3};
    for (int i = 0; i < 6 * 5 * 2; ++i) {
        check_pane(angles[i % 6], depths[i / 6 % 5], i / 30, 1 + 3 * (i % 2), i / 3 % 2);
    }
}

/* ---- Directions ---- */

enum { COUNT = 64 };

/* Rays that a ball turns twice, from spherical trigonometry. */
static void check_rays(burnish_isa isa, float index, burnish_texture_scratch *scratch) {
    const burnish_render_ops *ops = burnish_render_ops_for(isa);
    static float normal[3][COUNT], facing[COUNT];
    const burnish_kernels_shader shader = {.viewer = {0, 0, 1}};
    burnish_textured_material material = {.material = glass(1)};
    const burnish_passing passing = {
        &material, &shader, {.normal = {normal[0], normal[1], normal[2]}}, facing, 0};
    material.material.refractive_index = index;
    for (int i = 0; i < COUNT; ++i) {
        const double angle = i * M_PI / 2 / COUNT, turn = 0.7 * i;
        normal[0][i] = (float)(sin(angle) * cos(turn));
        normal[1][i] = (float)(sin(angle) * sin(turn));
        normal[2][i] = (float)cos(angle);
        facing[i] = i % 8 ? 1 : -1;
        for (int k = 0; k < 3; ++k) {
            scratch->reflectance[k][i] = 0.04f;
            scratch->passed[k][i] = 1;
        }
    }
    ops->pass_points(&passing, COUNT, scratch);
    for (int i = 0; i < COUNT; ++i) {
        const double angle = i * M_PI / 2 / COUNT, turn = 0.7 * i;
        const double bent = i % 8 ? 2 * (angle - asin(sin(angle) / (double)index)) : 0;
        const double to[3] = {-sin(bent) * cos(turn), -sin(bent) * sin(turn), -cos(bent)};
        const double t = fmin(1, fmax(0, (cos(bent / 2) - 0.8) / 0.17)),
                     share = t * t * (3 - 2 * t);
        for (int k = 0; k < 3; ++k) {
            CHECK(fabs((double)scratch->sample[k][i] - to[k]) < 1e-5, "%d, index %g, ray %d[%d]",
                  (int)isa, (double)index, i, k);
        }
        CHECK(fabs((double)scratch->sample[3][i] - share) < 5e-5, "%d, index %g, share %d: %g",
              (int)isa, (double)index, i, (double)scratch->sample[3][i]);
    }
}

static void test_rays(void) {
    static burnish_texture_scratch scratch[2];
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        for (int i = 0; i < 4 && burnish_render_ops_for((burnish_isa)isa); ++i) {
            static const float indices[] = {1, 1.33f, 1.5f, 2.42f};
            check_rays((burnish_isa)isa, indices[i], &scratch[1]);
            check_rays(BURNISH_ISA_SCALAR, indices[i], &scratch[0]);
            CHECK(memcmp(&scratch[0], &scratch[1], sizeof *scratch) == 0, "%d: other bits", isa);
        }
    }
}

/* ---- Light ---- */

/* Clear glass in even light and in front of it is seen by nothing but what the two fits of
 * Fresnel's term differ by. */
static void test_even_light(int raytracing) {
    enum { SIDE = 64 };
    static float pixels[SIDE * SIDE][4];
    burnish_mesh *mesh = load_mesh(":sphere", NULL);
    burnish_render_options options = framed_options(mesh, SIDE, SIDE);
    burnish_material material = glass(1);
    material.attenuation_distance = 0;
    set_three(material.diffuse, 1);
    set_material(mesh, &material);
    options.light_count = 0;
    options.has_dome = 1;
    options.raytracing = options.occlusion = raytracing;
    set_three(options.ambient_light, 0);
    set_three(options.dome.zenith, 1);
    set_three(options.dome.horizon, 1);
    set_three(options.dome.nadir, 1);
    memset(options.background, 255, sizeof options.background);
    draw_floats(mesh, &options, pixels[0], NULL);
    for (int i = 0; i < SIDE * SIDE; ++i) {
        CHECK(fabs((double)pixels[i][1] - 1) < 0.03, "pixel %d: %g", i, (double)pixels[i][1]);
    }
    burnish_mesh_destroy(mesh);
}

/* A plate that is tilted by 45 degrees, before a wall that is white on the left: rays move it by sin(i - r)
 * / cos r of the thickness. */
static void test_plate(void) {
    enum { SIDE = 64 };
    static float pixels[SIDE * SIDE][4];
    static const float corners[48] = {
        -3, -4, 3,  3, -4, -3, 3, 4, -3, -3, 4, 3,  2, -4, -4, -4, -4, 2,  -4, 4, 2,  2, 4, -4,
        -9, -9, -9, 0, -9, -9, 0, 9, -9, -9, 9, -9, 0, -9, -9, 9,  -9, -9, 9,  9, -9, 0, 9, -9};
    static const uint16_t numbers[8] = {0, 0, 0, 0, 1, 1, 2, 2};
    burnish_material materials[3] = {glass(1), burnish_material_default(),
                                     burnish_material_default()};
    burnish_mesh_description arrays = describe_quads(corners, NULL, 4);
    burnish_render_options options = front_options(SIDE, SIDE, 2);
    for (int i = 0; i < 3; ++i) {
        materials[i].attenuation_distance = 0;
        materials[i].has_diffuse = 1;
        set_three(materials[i].specular, 0);
        set_three(materials[i].diffuse, i == 2 ? 0 : 1);
        set_three(materials[i].ambient, i == 2 ? 0 : 1);
    }
    give_materials(&arrays, materials, 3);
    arrays.triangle_materials = (burnish_array){numbers, 8, 0};
    OWNED_MESH *mesh = create_mesh(&arrays, NULL);
    options.light_count = 0;
    options.has_dome = options.occlusion = options.raytracing = 1;
    set_three(options.dome.zenith, 1);
    set_three(options.dome.horizon, 1);
    set_three(options.dome.nadir, 1);
    draw_floats(mesh, &options, pixels[0], NULL);
    const double r = asin(sqrt(0.5) / 1.5), shift = sqrt(2) * sin(M_PI / 4 - r) / cos(r);
    for (int x = 0; x < SIDE; ++x) {
        const double off = (2 * x + 1.0) / SIDE - 1 - shift,
                     seen = (double)pixels[32 * SIDE + x][1];
        CHECK(fabs(off) < 0.05 || (seen > 0.5) == (off < 0), "at %d: %g", x, seen);
    }
}

/* Plates of an index of 1 behind clear sheets absorb along their way once each, as far as paths go: over 16
 * surfaces. What is behind costs no paths of its own, whether it is among the nearest 32 layers or not. */
static void test_stack(int sheets, int plates) {
    enum { SIDE = 8, MOST = 80 };
    static float corners[MOST][12], pixels[SIDE * SIDE][4];
    static uint16_t numbers[2 * MOST];
    const int count = sheets + 2 * plates;
    burnish_material materials[2] = {glass(0), glass(9)};
    for (int i = 0; i < count; ++i) {
        const int is_back = i >= sheets && (i - sheets) % 2, x = is_back ? -1 : 1;
        for (int corner = 0; corner < 4; ++corner) {
            corners[i][3 * corner] = (float)(corner % 3 ? x : -x);
            corners[i][3 * corner + 1] = corner < 2 ? -1 : 1;
            corners[i][3 * corner + 2] = -0.02f * (float)i;
        }
        numbers[2 * i] = numbers[2 * i + 1] = i >= sheets;
    }
    for (int i = 0; i < 2; ++i) {
        set_three(materials[i].diffuse, 1);
        set_three(materials[i].reflectance, 0);
        materials[i].edge_loss = materials[i].refractive_index = 1;
        materials[i].attenuation_distance = 0.2f;
    }
    burnish_mesh_description arrays = describe_quads(corners[0], NULL, (size_t)count);
    give_materials(&arrays, materials, 2);
    arrays.triangle_materials = (burnish_array){numbers, 2 * (size_t)count, 0};
    OWNED_MESH *mesh = create_mesh(&arrays, NULL);
    burnish_render_options options = front_options(SIDE, SIDE, 1);
    options.light_count = 0;
    options.has_dome = options.occlusion = options.raytracing = 1;
    set_three(options.dome.zenith, 1);
    set_three(options.dome.horizon, 1);
    set_three(options.dome.nadir, 1);
    memset(options.background, 255, sizeof options.background);
    draw_floats(mesh, &options, pixels[0], NULL);
    for (int i = 0; i < 3 * SIDE * SIDE; ++i) {
        const double times = log((double)pixels[i / 3][i % 3]) / log((double)absorbed[i % 3]);
        CHECK(fabs(times / (0.1 * fmin(plates, 8)) - 1) < 0.05,
              "%d and %d, pixel %d: absorbed %g times", sheets, plates, i, times);
    }
}

/* No triangle has the first material, whose maps are not made. */
static void test_unused(void) {
    static const float corners[12] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    static const uint16_t second[2] = {1, 1};
    const burnish_material materials[2] = {glass(1), burnish_material_default()};
    burnish_mesh_description arrays = describe_quads(corners, NULL, 1);
    give_materials(&arrays, materials, 2);
    arrays.triangle_materials = (burnish_array){second, 2, 0};
    OWNED_MESH *mesh = create_mesh(&arrays, NULL);
    burnish_render_options options = framed_options(mesh, 64, 64);
    options.has_dome = 1;
    set_three(options.dome.zenith, 1);
    set_three(options.dome.horizon, 1);
    set_three(options.dome.nadir, 1);
    CHECK1(hash_drawn(mesh, &options) != 0);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_panes());
    RUN(test_rays());
    RUN(test_even_light(0));
    RUN(test_even_light(1));
    RUN(test_plate());
    RUN(test_stack(0, 2));
    RUN(test_stack(0, 40));
    RUN(test_stack(40, 1));
    RUN(test_unused());
    return test_end("transmission");
}
