/* Ambient occlusion against integrals over the hidden part of the sky, and looks. */
#include <math.h>

#include "burnish/look.h"
#include "pictures.h"

enum { SIZE = 400 };

/* A square of the plane x = WINDOW_X, or -WINDOW_X. */
#define WINDOW_X 0.8
#define WINDOW_Z 0.6
#define WINDOW_HALF 0.4

enum { AMBIENT, DOME, SHADOW, WINDOW_LEFT, WINDOW_RIGHT, LAMP /* as the last, without shadow */ };

/* 1: by rays. */
static int raytracing;

/* Linear colours of every pixel, seen along `direction` in parallel projection, one sample each.
 * light: the same from everywhere, directional with its shadow, or a distant window. */
static float *draw(const burnish_mesh *mesh, const double direction[3], int occlusion, int light) {
    float *pixels = malloc((size_t)SIZE * SIZE * 4 * sizeof *pixels);
    burnish_framing framing = burnish_framing_default();
    burnish_render_options options = burnish_render_options_default();
    burnish_error error = {BURNISH_STATUS_OK, ""};
    memcpy(framing.direction, direction, sizeof framing.direction);
    framing.orthographic = 1;
    framing.up[1] = 1;
    framing.aspect = 1;
    burnish_camera_frame(mesh, &framing, &options.camera, &error);
    options.width = options.height = SIZE;
    options.samples = 1;
    options.light_count = light == SHADOW;
    options.shadow = light == SHADOW || (light > SHADOW && light < LAMP && occlusion > 0);
    options.lights[0] = (burnish_light){.vector = {0.4, 0.2, 1}, .color = {1, 1, 1}};
    options.area_light_count = light >= WINDOW_LEFT;
    options.area_lights[0] = (burnish_area_light){.is_distant = 1,
                                                  .is_two_sided = 1,
                                                  .center = {WINDOW_X, 0, WINDOW_Z},
                                                  .half_u = {0, WINDOW_HALF, 0},
                                                  .half_v = {0, 0, WINDOW_HALF},
                                                  .color = {1, 1, 1}};
    options.area_lights[0].center[0] *= light == WINDOW_LEFT ? -1 : 1;
    set_three(options.ambient_light, light == AMBIENT);
    options.has_dome = light == DOME;
    for (int k = 0; k < 3; ++k) {
        set_three((&options.dome.zenith)[k], 1);
    }
    options.occlusion = occlusion;
    options.occlusion_strength = 1;
    options.raytracing = raytracing;
    draw_floats(mesh, &options, pixels, NULL);
    return pixels;
}

static void set_colors(burnish_mesh *mesh, const float ambient[3], const float diffuse[3]) {
    burnish_material material = *burnish_mesh_get_material(mesh, 0);
    memcpy(material.ambient, ambient, sizeof material.ambient);
    memcpy(material.diffuse, diffuse, sizeof material.diffuse);
    set_three(material.specular, 0);
    material.has_diffuse = 1;
    set_material(mesh, &material);
}

static const float GREY[3] = {0.5f, 0.5f, 0.5f}, BLACK[3] = {0, 0, 0};

/* A floor and a wall, seen from above. materials: of both, or NULL. */
static burnish_mesh *make_wall(const burnish_material *materials) {
    static const uint16_t numbers[] = {0, 0, 1, 1};
    static const float positions[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, -1, 1, -1, 1, 1};
    static const uint32_t indices[] = {0, 1, 2, 0, 2, 3, 0, 3, 5, 0, 5, 4};
    burnish_mesh_description arrays = describe_arrays(positions, NULL, NULL, 6, indices, 4);
    arrays.up_axis[0] = arrays.up_axis[1] = 0;
    arrays.up_axis[2] = 1;
    arrays.triangle_materials = (burnish_array){materials ? numbers : NULL, materials ? 4 : 0, 0};
    arrays.materials = materials;
    arrays.material_count = materials ? 2 : 0;
    return create_mesh(&arrays, NULL);
}

static const double DOWN[] = {0, 0, -1};

/* The share of the sky that the wall x = -1, abs(y) < 1, 0 < z < 1 hides from (x, 0, 0), whose
 * normal is z: cos dA / r^2 over the wall, over the same integral of the hemisphere. */
static double hidden_by_wall(double x) {
    enum { STEPS = 400 };
    double sum = 0;
    for (int i = 0; i < STEPS; ++i) {
        for (int j = 0; j < STEPS; ++j) {
            const double y = 2 * (i + 0.5) / STEPS - 1, z = (j + 0.5) / STEPS, wide = x + 1;
            const double squared = wide * wide + y * y + z * z, r = sqrt(squared);
            sum += (z / r) * (wide / r) / squared * (2.0 / STEPS) * (1.0 / STEPS);
        }
    }
    return sum / acos(-1);
}

/* Few directions also approximate the integral: each represents a cone. */
static void test_wall(int directions, double tolerance) {
    double worst = 0;
    burnish_mesh *mesh = make_wall(NULL);
    set_colors(mesh, GREY, BLACK); /* nothing bounces */
    float *open = draw(mesh, DOWN, 0, AMBIENT), *occluded = draw(mesh, DOWN, directions, AMBIENT);
    int first = SIZE, last = 0;
    for (int x = 0; x < SIZE; ++x) { /* the floor's columns */
        if (open[4 * (SIZE / 2 * SIZE + x)] > 0 && open[4 * (SIZE / 2 * SIZE + x)] < 0.9f) {
            first = x < first ? x : first;
            last = x > last ? x : last;
        }
    }
    CHECK(last - first > SIZE / 2, "the floor is %d pixels wide", last - first + 1);
    for (int i = 1; i < 40; ++i) { /* where walls are near, but no nearer than a few texels */
        const double x = -1 + 0.05 * i;
        const int column = first + (int)((x + 1) / 2 * (last - first + 1));
        const int at = 4 * (SIZE / 2 * SIZE + column);
        const double found = 1 - (double)(occluded[at] / open[at]);
        worst = fmax(worst, fabs(found - hidden_by_wall(x)));
    }
    CHECK(worst < tolerance,
          "%d directions: a wall hides up to %g more or less than its share of the sky", directions,
          worst);
    printf("wall, %d directions: at most %.3f from the integral\n", directions, worst);
    free(open);
    free(occluded);
    burnish_mesh_destroy(mesh);
}

/* The share of a window's light that the wall hides from (x, 0, 0): both as seen through a pinhole, on
 * the plane at distance 1 in the window's direction. */
static double hidden_of_window(double x) {
    enum { STEPS = 200 };
    double all = 0, hidden = 0;
    for (int i = 0; i < STEPS * STEPS; ++i) {
        const double y = WINDOW_HALF * (2 * (i / STEPS + 0.5) / STEPS - 1) / WINDOW_X;
        const double z = (WINDOW_Z + WINDOW_HALF * (2 * (i % STEPS + 0.5) / STEPS - 1)) / WINDOW_X;
        const double squared = 1 + y * y + z * z, light = z / (squared * squared);
        all += light;
        hidden += (x + 1) * fabs(y) < 1 && (x + 1) * z < 1 ? light : 0;
    }
    return hidden / all;
}

/* Occlusion knows from where the light comes, and draws the shadow of a wide light: a wall hides a window
 * behind it, and none across. */
static void test_window(double tolerance) {
    static const float dark[3] = {1e-5f, 1e-5f, 1e-5f};
    double squares = 0;
    burnish_mesh *mesh = make_wall(NULL);
    set_colors(mesh, dark, dark); /* nothing bounces */
    for (int light = WINDOW_LEFT; light <= WINDOW_RIGHT; ++light) {
        float *open = draw(mesh, DOWN, 0, light), *occluded = draw(mesh, DOWN, 72, light);
        int width = 0; /* of the floor, in pixels */
        for (int column = 0; column < SIZE; ++column) {
            width += open[4 * (SIZE / 2 * SIZE + column)] < 0.9f;
        }
        for (int column = SIZE / 8; column < SIZE * 7 / 8; ++column) {
            const int at = 4 * (SIZE / 2 * SIZE + column);
            const double x = 2 * (column + 0.5 - SIZE / 2) / width;
            const double exact = light == WINDOW_LEFT ? hidden_of_window(x) : 0;
            const double error = 1 - (double)(occluded[at] / open[at]) - exact;
            squares += error * error / (2 * SIZE * 3 / 4);
        }
        free(open);
        free(occluded);
    }
    printf("window behind a wall: root of the mean square of the error %.3f\n", sqrt(squares));
    CHECK(squares < tolerance * tolerance, "a wall hides %g more or less of a window",
          sqrt(squares));
    burnish_mesh_destroy(mesh);
}

/* A convex surface hides nothing of itself. */
static void test_sphere(void) {
    static const double along[] = {1, -2, 3};
    double worst = 0;
    burnish_mesh *mesh = load_mesh(":sphere", NULL);
    set_colors(mesh, GREY, BLACK);
    float *open = draw(mesh, along, 0, AMBIENT), *occluded = draw(mesh, along, 64, AMBIENT);
    for (int i = 0; i < SIZE * SIZE; ++i) {
        worst = fmax(worst, 1 - (double)(occluded[4 * i] / open[4 * i]));
    }
    CHECK(worst < 0.005, "a sphere hides %g of the sky from itself", worst);
    free(open);
    free(occluded);
    burnish_mesh_destroy(mesh);
}

/* Where the colours of a bowl are: the paths of shading differ. */
enum { OF_MATERIAL, OF_VERTICES, OF_TWO_MATERIALS, OF_METALLIC_ROUGHNESS };

enum { RINGS = 24, SECTORS = 64, BOWL_POINTS = (RINGS + 1) * SECTORS, QUADS = RINGS * SECTORS };

/* Half of a sphere, open toward +z. */
static burnish_mesh *make_bowl(int way, const float albedo[3], const uint8_t codes[3]) {
    static float positions[BOWL_POINTS][3];
    static uint8_t colors[BOWL_POINTS][4];
    static uint32_t indices[QUADS][6];
    static uint16_t numbers[2 * QUADS];
    burnish_material materials[2];
    for (uint32_t i = 0; i < BOWL_POINTS; ++i) {
        const double polar = acos(0) * (i / SECTORS) / RINGS;
        const double turn = 4 * acos(0) * (i % SECTORS) / SECTORS;
        positions[i][0] = (float)(sin(polar) * cos(turn));
        positions[i][1] = (float)(sin(polar) * sin(turn));
        positions[i][2] = (float)-cos(polar);
        memcpy(colors[i], codes, 3);
        colors[i][3] = 255;
    }
    for (uint32_t i = 0; i < QUADS; ++i) {
        const uint32_t next = i % SECTORS == SECTORS - 1 ? i + 1 - SECTORS : i + 1;
        const uint32_t corners[] = {i, i + SECTORS, next, next, i + SECTORS, next + SECTORS};
        memcpy(indices[i], corners, sizeof corners);
        numbers[2 * i] = way == OF_TWO_MATERIALS && i % 2;
        numbers[2 * i + 1] = numbers[2 * i];
    }
    for (int i = 0; i < 2; ++i) {
        materials[i] = burnish_material_default();
        set_three(materials[i].specular, 0);
        materials[i].has_diffuse = way != OF_VERTICES;
        materials[i].is_metallic = way == OF_METALLIC_ROUGHNESS;
        materials[i].roughness = (float)materials[i].is_metallic;
        memcpy(materials[i].ambient, albedo, sizeof materials[i].ambient);
        memcpy(materials[i].diffuse, albedo, sizeof materials[i].diffuse);
    }
    burnish_mesh_description arrays =
        describe_arrays(positions[0], NULL, way == OF_VERTICES ? colors[0] : NULL, BOWL_POINTS,
                        indices[0], 2 * QUADS);
    arrays.triangle_materials = (burnish_array){numbers, 2 * QUADS, 0};
    arrays.materials = materials;
    arrays.material_count = 2;
    return create_mesh(&arrays, NULL);
}

/* In a bowl, a point gets the same from equal areas of the sphere around it, wherever they are. So the
 * light E after any number of reflections is the same everywhere: E = f + (1 - f) r E, if a share f of
 * it comes from outside and the surface reflects r. */
static void test_bowl(int way) {
    static const uint8_t codes[3] = {231, 188, 1};
    float albedo[3];
    double worst = 0;
    for (int k = 0; k < 3; ++k) { /* sRGB */
        const double code = codes[k] / 255.0;
        albedo[k] = (float)(code < 0.04 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4));
    }
    burnish_mesh *mesh = make_bowl(way, albedo, codes);
    float *light = draw(mesh, DOWN, 128, AMBIENT);
    for (int i = SIZE / 3; i < 2 * SIZE / 3; ++i) {
        const float *at = light + 4 * (SIZE / 2 * SIZE + i);
        const double f = (double)(at[2] / albedo[2]);
        CHECK(f > 0.3 && f < 0.7, "a bowl sees %g of the sky", f);
        for (int k = 0; k < 2; ++k) {
            const double r = (double)albedo[k], found = (double)at[k] / r;
            worst = fmax(worst, fabs(found - f / (1 - (1 - f) * r)));
        }
    }
    CHECK(worst < (raytracing ? 0.035 : 0.03), "in a bowl, reflected light is up to %g off", worst);
    free(light);
    burnish_mesh_destroy(mesh);
}

/* A light whose shadow is drawn is not darkened by occlusion as well. */
static void test_shadowed_light(void) {
    static const float dark[3] = {1e-5f, 1e-5f, 1e-5f};
    double worst = 0;
    burnish_mesh *mesh = make_wall(NULL);
    set_colors(mesh, dark, dark); /* nothing bounces */
    float *open = draw(mesh, DOWN, 0, SHADOW), *occluded = draw(mesh, DOWN, 64, SHADOW);
    for (int i = 0; i < SIZE * SIZE; ++i) {
        worst = fmax(worst, fabs(1 - (double)(occluded[4 * i] / open[4 * i])));
    }
    CHECK(worst < 1e-4, "occlusion takes %g of a light whose shadow is drawn", worst);
    free(open);
    free(occluded);
    burnish_mesh_destroy(mesh);
}

/* A floor that mirrors all light, and a wall that reflects as much. */
static burnish_mesh *make_mirrors(float of_wall) {
    burnish_material materials[2] = {burnish_material_default(), burnish_material_default()};
    for (int i = 0; i < 2; ++i) {
        set_three(materials[i].diffuse, i ? of_wall : 1);
        set_three(materials[i].ambient, i ? of_wall : 1);
        materials[i].has_diffuse = 1;
        materials[i].is_metallic = !i || of_wall > 0;
        materials[i].metallic = (float)materials[i].is_metallic;
    }
    return make_wall(materials);
}

/* A mirror, and a black wall, in light that is 1 from everywhere. Seen along (-0.8, 0, -1), what is up to
 * 0.8 from the wall's foot mirrors it, and is black. */
static void test_mirror(void) {
    static const double along[] = {-0.8, 0, -1};
    int first = SIZE, last = 0;
    burnish_mesh *mesh = make_mirrors(0);
    float *light = draw(mesh, along, 1, DOME);
    const float *row = light + 4 * SIZE * (SIZE / 2);
    for (int i = 0; i < SIZE; ++i) {
        first = row[4 * i] < 0.5f && i < first ? i : first;
        last = row[4 * i] < 0.5f ? i : last;
        CHECK(row[4 * i] < 0.02f || fabs((double)row[4 * i] - 1) < 0.02 || abs(i - last) < 3,
              "pixel %d: %g", i, (double)row[4 * i]);
    }
    /* the middle of the bounds is 1.4 from the wall's upper edge and 0.2 from that of its image */
    const double expected = SIZE / 2 + (SIZE / 2 - first) / 7.0;
    CHECK(fabs(last - expected) < 2, "a wall is mirrored up to %d, not %g", last, expected);
    free(light);
    burnish_mesh_destroy(mesh);
}

/* Two mirrors. Seen along (-0.8, 0, -0.6), the floor shows the wall, where the window is that the floor
 * alone does not show. */
static void test_mirrors(void) {
    static const double along[] = {-WINDOW_X, 0, -WINDOW_Z};
    burnish_mesh *black = make_mirrors(0), *bright = make_mirrors(1);
    float *wall = draw(black, along, 1, DOME), *window = draw(bright, along, 1, LAMP);
    int edge = 0, first = SIZE;
    for (int i = 0; i < SIZE; ++i) {
        const int at = 4 * (SIZE / 2 * SIZE + i);
        edge = wall[at] < 0.5f ? i : edge; /* of the wall's image */
        first = window[at] < 0.5f && i < first ? i : first;
    }
    for (int i = 0; i < SIZE; ++i) {
        const double seen = (double)window[4 * (SIZE / 2 * SIZE + i)];
        CHECK(seen < 0.02 || fabs(seen - 1) < 0.02 || abs(i - edge) < 3, "pixel %d: %g", i, seen);
    }
    CHECK(abs(first - edge - 1) < 3 && edge > 0, "a window is mirrored twice up to %d, not %d",
          first, edge);
    free(wall);
    free(window);
    burnish_mesh_destroy(black);
    burnish_mesh_destroy(bright);
}

/* Whatever its colour, no matt surface is cut off, and a fully lit white one is between `low` and
 * `high`. */
static void test_exposure(burnish_look look, int low, int high) {
    burnish_error error = {BURNISH_STATUS_OK, ""};
    int brightest = 0;
    burnish_mesh *mesh = load_mesh(":sphere", NULL);
    burnish_render_options options = framed_options(mesh, 200, 200);
    burnish_material material = *burnish_mesh_get_material(mesh, 0);
    CHECK(burnish_render_options_set_look(&options, look, &error) == BURNISH_STATUS_OK &&
              burnish_look_set_materials(look, mesh, &error) == BURNISH_STATUS_OK,
          "%s", error.text);
    set_three(material.diffuse, 1);
    set_three(material.ambient, 1);
    set_three(material.specular, 0);
    set_material(mesh, &material);
    options.transparent = 1;
    burnish_image image = draw_image(mesh, &options, NULL);
    for (int i = 0; i < 4 * 200 * 200; ++i) {
        const int code = i % 4 < 3 ? image.pixels[i] : 0;
        brightest = code > brightest ? code : brightest;
    }
    CHECK(brightest >= low && brightest <= high, "white comes out as %d of 255", brightest);
    burnish_image_destroy(&image);
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_wall(BURNISH_OCCLUSION_MAX, 0.015));
    RUN(test_wall(72, 0.04));
    RUN(test_wall(54, 0.045));
    RUN(test_exposure(BURNISH_LOOK_THREE_POINT, 222, 238));
    RUN(test_exposure(BURNISH_LOOK_STUDIO, 238, 252));
    for (int i = 0; i < 2; ++i) {
        raytracing = i;
        RUN(test_window(i ? 0.02 : 0.1));
        RUN(test_sphere());
        for (int way = OF_MATERIAL; way <= OF_METALLIC_ROUGHNESS; ++way) {
            RUN(test_bowl(way));
        }
        RUN(test_shadowed_light());
    }
    RUN(test_wall(1, 0.04));
    RUN(test_mirror());
    RUN(test_mirrors());
    return test_end("occlusion");
}
