/* Whole pictures against formulas: where a sphere's highlight lies and how wide it is,
 * perspective-correct attributes, point lights, edges, mirrored and turned scenes, threads, errors.
 */
#include <math.h>

#include "burnish/render.h"
#include "burnish/theory.h"
#include "mesh_arrays.h"
#include "support.h"

static double decode(uint8_t code) {
    return (double)burnish_srgb_decode((float)code / 255.0f);
}

static double pixel_value(const burnish_image *image, int x, int y, int channel) {
    return decode(image->pixels[(y * image->width + x) * image->channels + channel]);
}

/* A camera on the +z axis that looks at the origin in parallel projection. */
static burnish_render_options front_options(int width, int height, double view_height) {
    burnish_render_options options = burnish_render_options_default();
    options.width = width;
    options.height = height;
    options.samples = 1;
    options.camera.position[2] = 10;
    options.camera.orthographic_height = view_height;
    options.background[0] = options.background[1] = options.background[2] = 0;
    return options;
}

static void set_single_light(burnish_render_options *options, const double vector[3]) {
    burnish_light light = {BURNISH_LIGHT_DIRECTIONAL, 0, {0}, {1, 1, 1}};
    memcpy(light.vector, vector, sizeof light.vector);
    options->lights[0] = light;
    options->light_count = 1;
    memset(options->ambient_light, 0, sizeof options->ambient_light);
}

static void set_material(burnish_mesh *scene, float diffuse, float specular, float exponent) {
    burnish_material material = burnish_material_default();
    for (int i = 0; i < 3; ++i) {
        material.ambient[i] = diffuse;
        material.diffuse[i] = diffuse;
        material.specular[i] = specular;
    }
    material.exponent = exponent;
    material.has_diffuse = 1;
    CHECK(burnish_mesh_set_material(scene, 0, &material, NULL) == BURNISH_STATUS_OK, "material");
}

static void render(const burnish_mesh *scene, const burnish_render_options *options,
                   burnish_image *image, burnish_render_report *report) {
    burnish_error error = {BURNISH_STATUS_OK, ""};
    CHECK_OK(burnish_render(scene, options, image, report, &error), error);
}

typedef struct lobe_case {
    const char *name;
    float exponent;
} lobe_case;

static const lobe_case LOBES[] = {
    {"power", 20},       {"power", 200},      {"taylor:2", 40},       {"energy:2", 40},
    {"energy:8", 60},    {"level0.5:2", 100}, {"shift7", 32},         {"shift3", 32},
    {"projected:4", 50}, {"schlick", 30},     {"gaussian", 64},       {"gx", 30},
    {"minimax:4", 40},   {"affine:2", 30},    {"leastsquares:8", 50}, {"zeta6.645:2", 18},
};

/* The lobe's value in double precision. */
static double exact_lobe(const lobe_case *lobe, double cosine) {
    static const lobe_case *solved; /* the searched fits take a while */
    static burnish_lobe_spec choice;
    static double zeta, scale;
    if (lobe != solved) {
        solved = lobe;
        burnish_lobe_spec_parse(lobe->name, &choice, NULL);
        CHECK((choice.kind != BURNISH_LOBE_FAMILY && choice.kind != BURNISH_LOBE_LYON) ||
                  burnish_lobe_solve(&choice, (double)lobe->exponent, &zeta, &scale) ==
                      BURNISH_LOBE_OK,
              "zeta of %s", lobe->name);
    }
    switch (choice.kind) {
    case BURNISH_LOBE_POWER:
        return burnish_theory_power(cosine, (double)lobe->exponent);
    case BURNISH_LOBE_SCHLICK:
        return burnish_theory_schlick(cosine, (double)lobe->exponent);
    case BURNISH_LOBE_GAUSSIAN:
        return burnish_theory_gaussian(cosine, (double)lobe->exponent);
    case BURNISH_LOBE_GX:
        return burnish_theory_gx(cosine, (double)lobe->exponent);
    default:
        return scale * burnish_theory_family(zeta, choice.order, cosine);
    }
}

/* Angle at which the lobe falls to a half, by bisection on the exact lobe. */
static double half_angle(const lobe_case *lobe) {
    double low = 0, high = 1.5;
    for (int i = 0; i < 60; ++i) {
        double middle = (low + high) / 2;
        *(exact_lobe(lobe, cos(middle)) > 0.5 ? &low : &high) = middle;
    }
    return low;
}

/* Place along row y where the value falls through a half, going right (step 1) or left (-1). */
static double half_crossing(const burnish_image *image, int start, int y, int step) {
    int x = start;
    while (x > 0 && x + 1 < image->width && pixel_value(image, x, y, 0) > 0.5) {
        x += step;
    }
    double outside = pixel_value(image, x, y, 0), inside = pixel_value(image, x - step, y, 0);
    return x - step + step * (inside - 0.5) / (inside - outside) + 0.5;
}

/* Light from the viewer: a round highlight in the middle, half-width R sin(half angle). */
static void check_highlight_width(burnish_mesh *sphere) {
    enum { SIZE = 401 };
    const double radius = SIZE / 2.2;
    static const double TOWARD_VIEWER[3] = {0, 0, 1};
    for (size_t i = 0; i < sizeof LOBES / sizeof LOBES[0]; ++i) {
        burnish_render_options options = front_options(SIZE, SIZE, 2.2);
        burnish_image image;
        set_single_light(&options, TOWARD_VIEWER);
        set_material(sphere, 0, 1, LOBES[i].exponent);
        burnish_lobe_spec_parse(LOBES[i].name, &options.lobe, NULL);
        render(sphere, &options, &image, NULL);
        double left = half_crossing(&image, SIZE / 2, SIZE / 2, -1);
        double right = half_crossing(&image, SIZE / 2, SIZE / 2, 1);
        double expected = radius * sin(half_angle(&LOBES[i]));
        CHECK(fabs((left + right) / 2 - SIZE / 2.0) < 0.5, "%s: centre at %.3f", LOBES[i].name,
              (left + right) / 2);
        CHECK(fabs((right - left) / 2 - expected) < 0.5,
              "%s, n = %g: half-width %.3f, expected %.3f", LOBES[i].name,
              (double)LOBES[i].exponent, (right - left) / 2, expected);
        burnish_image_destroy(&image);
    }
    /* half width of cos^n: acos(0.5^(1/n)) */
    CHECK(fabs(half_angle(&LOBES[0]) - acos(pow(0.5, 1 / 20.0))) < 1e-9, "half angle of power");
}

/* Every pixel well inside the sphere against the equation itself, for an oblique light. */
static void check_highlight_everywhere(burnish_mesh *sphere, burnish_specular_model equation) {
    enum { SIZE = 301 };
    const double radius = SIZE / 2.2;
    const double light[3] = {0.48, 0.6, 0.64};
    double length =
        sqrt(light[0] * light[0] + light[1] * light[1] + (light[2] + 1) * (light[2] + 1));
    double half[3] = {light[0] / length, light[1] / length, (light[2] + 1) / length};
    for (size_t i = 0; i < sizeof LOBES / sizeof LOBES[0]; ++i) {
        burnish_render_options options = front_options(SIZE, SIZE, 2.2);
        burnish_image image;
        double worst = 0, weight = 0, center[2] = {0, 0}, peak = exact_lobe(&LOBES[i], 1);
        set_single_light(&options, light);
        set_material(sphere, 0.25f, 0.5f, LOBES[i].exponent);
        burnish_lobe_spec_parse(LOBES[i].name, &options.lobe, NULL);
        options.specular_model = equation;
        render(sphere, &options, &image, NULL);
        for (int y = 0; y < SIZE; ++y) {
            for (int x = 0; x < SIZE; ++x) {
                double nx = (x + 0.5 - SIZE / 2.0) / radius, ny = (SIZE / 2.0 - y - 0.5) / radius;
                double squared = nx * nx + ny * ny;
                if (squared > 0.9) {
                    continue;
                }
                double nz = sqrt(1 - squared);
                double n_dot_l = nx * light[0] + ny * light[1] + nz * light[2];
                double cosine = equation == BURNISH_SPECULAR_BLINN
                                    ? nx * half[0] + ny * half[1] + nz * half[2]
                                    : 2 * n_dot_l * nz - light[2];
                double lobe = exact_lobe(&LOBES[i], cosine);
                double expected = n_dot_l > 0 ? 0.25 * n_dot_l + 0.5 * lobe : 0;
                double error = fabs(pixel_value(&image, x, y, 1) - expected);
                worst = error > worst ? error : worst;
                if (lobe > 0.97 * peak) {
                    double got = pixel_value(&image, x, y, 1);
                    weight += got;
                    center[0] += got * nx * radius;
                    center[1] += got * ny * radius;
                }
            }
        }
        /* half a code of sRGB near 0.75 is 0.004; the tessellated normals add a little */
        CHECK(worst < 0.008, "%s: largest difference %.4f", LOBES[i].name, worst);
        if (equation == BURNISH_SPECULAR_BLINN) {
            CHECK(weight > 0 && fabs(center[0] / weight - half[0] * radius) < 0.5 &&
                      fabs(center[1] / weight - half[1] * radius) < 0.5,
                  "%s: centre (%.2f, %.2f), expected (%.2f, %.2f)", LOBES[i].name,
                  center[0] / weight, center[1] / weight, half[0] * radius, half[1] * radius);
        }
        burnish_image_destroy(&image);
    }
}

static burnish_mesh *make_scene(const float *positions, const uint8_t *colors, size_t vertex_count,
                                const uint32_t *indices, size_t triangle_count) {
    const burnish_mesh_description arrays =
        describe_arrays(positions, NULL, colors, vertex_count, indices, triangle_count);
    return create_mesh(&arrays, NULL);
}

static const uint32_t QUAD[6] = {0, 1, 2, 0, 2, 3};

/* A floor that runs from z = 4 to z = -40, black to white: the colour at a pixel is where its ray
 * meets the floor. The near end is on the camera's other side, so clipping is tested too. */
static void check_perspective_colors(void) {
    enum { SIZE = 200 };
    static const float POSITIONS[12] = {-50, -1, 14, 50, -1, 14, 50, -1, -40, -50, -1, -40};
    static const uint8_t COLORS[16] = {0,   0,   0,   255, 0,   0,   0,   255,
                                       255, 255, 255, 255, 255, 255, 255, 255};
    burnish_mesh *scene = make_scene(POSITIONS, COLORS, 4, QUAD, 2);
    burnish_render_options options = front_options(SIZE, SIZE, 0);
    burnish_image image;
    double worst = 0;
    int checked = 0;
    options.camera.view_angle = 60;
    options.light_count = 0;
    options.ambient_light[0] = options.ambient_light[1] = options.ambient_light[2] = 1;
    render(scene, &options, &image, NULL);
    for (int y = SIZE / 2 + 8; y < SIZE; ++y) {
        for (int x = 0; x < SIZE; x += 7) {
            double slope = (y + 0.5 - SIZE / 2.0) / (SIZE / 2.0) * tan(M_PI / 6);
            double z = 10 - 1 / slope;
            double expected = (14 - z) / 54;
            if (z > -39) {
                double error = fabs(pixel_value(&image, x, y, 0) - expected);
                worst = error > worst ? error : worst;
                ++checked;
            }
        }
    }
    CHECK(checked > 1000, "%d pixels checked", checked);
    CHECK(worst < 0.005, "largest difference from the ray's hit: %.4f", worst);
    burnish_image_destroy(&image);
    burnish_mesh_destroy(scene);
}

/* kd N.L of a point light one unit above a plane, with the light in scene and in camera space. */
static void check_point_light(int follows_camera, double orthographic_height) {
    enum { SIZE = 150 };
    static const float POSITIONS[12] = {-9, -9, 0, 9, -9, 0, 9, 9, 0, -9, 9, 0};
    burnish_mesh *scene = make_scene(POSITIONS, NULL, 4, QUAD, 2);
    burnish_render_options options = front_options(SIZE, SIZE, orthographic_height);
    burnish_image image;
    double worst = 0, extent = orthographic_height / 2;
    static const double NOWHERE[3] = {1, 0, 0};
    if (extent == 0) {
        options.camera.view_angle = 30;
        extent = 10 * tan(M_PI / 12);
    }
    set_single_light(&options, NOWHERE);
    options.lights[0].kind = BURNISH_LIGHT_POINT;
    options.lights[0].follows_camera = follows_camera;
    options.lights[0].vector[0] = follows_camera ? 0.05 : 0.5;
    options.lights[0].vector[2] = follows_camera ? -0.9 : 1;
    set_material(scene, 0.8f, 0, 32);
    render(scene, &options, &image, NULL);
    for (int y = 0; y < SIZE; ++y) {
        for (int x = 0; x < SIZE; ++x) {
            double px = (x + 0.5 - SIZE / 2.0) / (SIZE / 2.0) * extent - 0.5;
            double py = (SIZE / 2.0 - y - 0.5) / (SIZE / 2.0) * extent;
            double expected = 0.8 / sqrt(px * px + py * py + 1);
            double error = fabs(pixel_value(&image, x, y, 2) - expected);
            worst = error > worst ? error : worst;
        }
    }
    CHECK(worst < 0.005, "camera space %d, height %g: largest difference %.4f", follows_camera,
          orthographic_height, worst);
    burnish_image_destroy(&image);
    burnish_mesh_destroy(scene);
}

/* Half-covered pixels mix with the background in linear light, or become alpha. */
static void check_edges(void) {
    static const float POSITIONS[12] = {-3, -3, 0, 0, -3, 0, 0, 3, 0, -3, 3, 0};
    burnish_mesh *scene = make_scene(POSITIONS, NULL, 4, QUAD, 2);
    burnish_image image;
    burnish_render_report report;
    burnish_render_options options = front_options(5, 5, 5); /* the edge crosses pixel 2's middle */
    options.samples = 16;
    options.light_count = 0;
    options.ambient_light[0] = options.ambient_light[1] = options.ambient_light[2] = 1;
    set_material(scene, 1, 0, 32);
    render(scene, &options, &image, &report);
    CHECK(image.pixels[0] == 255 && image.pixels[3] == 255, "covered: %d %d", image.pixels[0],
          image.pixels[3]);
    CHECK(image.pixels[12] == 0, "background: %d", image.pixels[12]);
    double covered = pixel_value(&image, 2, 2, 0) * 16;
    CHECK(fabs(covered - 7) < 0.1 || fabs(covered - 8) < 0.1, "half covered: %.3f/16", covered);
    CHECK(report.covered_pixels == 15, "covered pixels %zu", report.covered_pixels);
    CHECK(report.bounds[0] == 0 && report.bounds[1] == 0 && report.bounds[2] == 3 &&
              report.bounds[3] == 5,
          "bounds %d %d %d %d", report.bounds[0], report.bounds[1], report.bounds[2],
          report.bounds[3]);
    CHECK(report.triangles_drawn == 2, "drawn %zu", report.triangles_drawn);
    burnish_image_destroy(&image);
    options.transparent = 1;
    render(scene, &options, &image, NULL);
    CHECK(image.channels == 4, "alpha wanted");
    const uint8_t *edge = image.pixels + 4 * (2 * 5 + 2);
    CHECK(edge[0] == 255 && abs(edge[3] - (int)(covered * 255 / 16 + 0.5)) <= 1,
          "straight alpha: %d %d", edge[0], edge[3]);
    CHECK(image.pixels[3] == 255 && image.pixels[4 * 4 + 3] == 0, "opaque and empty");
    burnish_image_destroy(&image);
    burnish_mesh_destroy(scene);
}

/* Counts pixels that differ by more than one code where `map` says the same thing should be. */
static int count_differences(const burnish_image *a, const burnish_image *b, int turned) {
    int size = a->width, different = 0;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            int bx = turned ? y : size - 1 - x, by = turned ? size - 1 - x : y;
            for (int channel = 0; channel < 3; ++channel) {
                int difference = a->pixels[3 * (y * size + x) + channel] -
                                 b->pixels[3 * (by * size + bx) + channel];
                different += difference > 1 || difference < -1;
            }
        }
    }
    return different;
}

/* A bent, coloured surface without symmetry of its own. */
static burnish_mesh *make_surface(int mirrored, int turned) {
    enum { N = 40 };
    static float positions[3 * N * N];
    static uint8_t colors[4 * N * N];
    static uint32_t indices[6 * (N - 1) * (N - 1)];
    size_t count = 0;
    for (int y = 0; y < N; ++y) {
        for (int x = 0; x < N; ++x) {
            float px = (float)(x - N / 2) / 14 + 0.07f, py = (float)(y - N / 2) / 17 - 0.11f;
            float pz = 0.4f * px * py + 0.3f * px * px * px - 0.5f * py * py + 0.1f * px;
            float *p = positions + 3 * (y * N + x);
            p[0] = turned ? -py : mirrored ? -px : px;
            p[1] = turned ? px : py;
            p[2] = pz;
            uint8_t *color = colors + 4 * (y * N + x);
            color[0] = (uint8_t)(60 + 4 * x);
            color[1] = (uint8_t)(60 + 4 * y);
            color[2] = 128;
            color[3] = 255;
            if (x + 1 < N && y + 1 < N) {
                uint32_t a = (uint32_t)(y * N + x), b = a + 1, c = a + N, d = c + 1;
                uint32_t quad[6] = {a, mirrored ? d : b, mirrored ? b : d,
                                    a, mirrored ? c : d, mirrored ? d : c};
                memcpy(indices + count, quad, sizeof quad);
                count += 6;
            }
        }
    }
    return make_scene(positions, colors, N * N, indices, count / 3);
}

static void check_symmetry(int turned, double orthographic_height, int samples) {
    enum { SIZE = 240 };
    burnish_mesh *scene = make_surface(0, 0);
    burnish_mesh *other = make_surface(!turned, turned);
    burnish_render_options options = front_options(SIZE, SIZE, orthographic_height);
    burnish_image image, changed;
    options.camera.view_angle = 24;
    options.samples = samples;
    render(scene, &options, &image, NULL);
    for (int i = 0; i < options.light_count; ++i) {
        double *v = options.lights[i].vector, x = v[0], y = v[1];
        v[0] = turned ? -y : -x;
        v[1] = turned ? x : y;
    }
    render(other, &options, &changed, NULL);
    int different = count_differences(&image, &changed, turned);
    /* with more samples their pattern is not symmetric: only pixels at edges may differ */
    CHECK(different <= (samples == 1 ? 12 : 3 * 8 * SIZE), "turned %d, height %g: %d values differ",
          turned, orthographic_height, different);
    int same = count_differences(&image, &image, turned);
    CHECK(same > 3 * SIZE * SIZE / 8, "the scene itself has no such symmetry: %d", same);
    burnish_image_destroy(&image);
    burnish_image_destroy(&changed);
    burnish_mesh_destroy(scene);
    burnish_mesh_destroy(other);
}

/* Of a box of 2 x 1 x 3 seen from its front, all but that face is hidden; beside the camera all. */
static void check_hidden_share(void) {
    static const uint32_t BOX[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                     2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    float positions[24];
    for (int i = 0; i < 8; ++i) {
        positions[3 * i] = i & 1 ? 1 : -1;
        positions[3 * i + 1] = i & 2 ? .5f : -.5f;
        positions[3 * i + 2] = i & 4 ? 1.5f : -1.5f;
    }
    burnish_mesh *box = make_scene(positions, NULL, 8, BOX, 12);
    burnish_render_options options = front_options(40, 40, 4);
    burnish_image image;
    burnish_render_report report;
    options.counts = BURNISH_COUNTS_AREA;
    render(box, &options, &image, &report);
    CHECK(fabs(report.hidden_share - 20.0 / 22) < 1e-12 && report.triangles_drawn == 2,
          "the front hides %.17g", report.hidden_share);
    burnish_image_destroy(&image);
    options.camera.position[0] = options.camera.focal_point[0] = 10;
    render(box, &options, &image, &report);
    CHECK(report.hidden_share == 1, "beside it: %.17g", report.hidden_share);
    burnish_image_destroy(&image);
    burnish_mesh_destroy(box);
}

static void check_threads(void) {
    static const int THREADS[] = {1, 2, 7, 64};
    burnish_mesh *scene = load_tessellated(":knot", 16);
    uint64_t first = 0;
    burnish_render_report first_report = {0};
    for (int i = 0; i < 4; ++i) {
        burnish_render_options options = front_options(500, 300, 0);
        burnish_framing fit = burnish_framing_default();
        burnish_image image;
        burnish_render_report report;
        fit.aspect = 5.0 / 3;
        burnish_camera_frame(scene, &fit, &options.camera, NULL);
        options.threads = THREADS[i];
        options.counts = BURNISH_COUNTS_AREA;
        options.samples = 8;
        render(scene, &options, &image, &report);
        uint64_t hash = burnish_image_hash(&image);
        first = i == 0 ? hash : first;
        first_report = i == 0 ? report : first_report;
        CHECK(hash == first, "%d threads: other pixels", THREADS[i]);
        CHECK(report.covered_pixels == first_report.covered_pixels &&
                  report.triangles_drawn == first_report.triangles_drawn &&
                  report.hidden_share == first_report.hidden_share &&
                  memcmp(report.bounds, first_report.bounds, sizeof report.bounds) == 0,
              "%d threads: other counts", THREADS[i]);
        burnish_image_destroy(&image);
    }
    burnish_mesh_destroy(scene);
}

/* A renderer draws what burnish_render draws, whatever it drew before: other meshes, sizes,
 * samples, threads, lobes, with and without colours and alpha. */
static void check_renderer(burnish_mesh *sphere) {
    burnish_mesh *const scenes[] = {load_tessellated(":knot", 16), sphere, make_surface(0, 0)};
    burnish_renderer *renderer;
    burnish_image image = {0};
    CHECK(burnish_renderer_create(NULL, &renderer, NULL) == BURNISH_STATUS_OK, "a renderer");
    for (int i = 0; i < 36; ++i) {
        static const int SAMPLES[] = {1, 4, 1, 16, 8}, SIZES[] = {131, 64, 200, 64};
        burnish_render_options options = front_options(SIZES[i % 4], SIZES[i / 2 % 4], 0);
        burnish_image expected;
        burnish_render_report report, own;
        options.samples = SAMPLES[i % 5];
        options.threads = 1 + i % 3;
        options.transparent = i % 7 == 3;
        options.counts = (burnish_counts)(i % 4 % 3);
        options.ignore_colors = i % 6 == 2;
        options.lobe.kind = i % 5 == 4 ? BURNISH_LOBE_LYON : BURNISH_LOBE_FAMILY;
        render(scenes[i % 3], &options, &expected, &own);
        CHECK(burnish_renderer_draw(renderer, scenes[i % 3], &options, &image, &report, NULL) ==
                  BURNISH_STATUS_OK,
              "frame %d", i);
        CHECK(burnish_image_hash(&image) == burnish_image_hash(&expected) &&
                  image.channels == expected.channels && image.width == expected.width,
              "frame %d: other pixels", i);
        CHECK(report.covered_pixels == own.covered_pixels &&
                  report.triangles_drawn == own.triangles_drawn &&
                  memcmp(report.bounds, own.bounds, sizeof own.bounds) == 0,
              "frame %d: other counts", i);
        CHECK((report.covered_pixels > 0) == (options.counts != BURNISH_COUNTS_NONE) &&
                  (report.triangles_drawn > 0) == (options.counts == BURNISH_COUNTS_ALL),
              "frame %d: counts", i);
        burnish_image_destroy(&expected);
    }
    burnish_render_options wrong = front_options(64, 64, 2.2);
    wrong.samples = 3;
    CHECK(burnish_renderer_draw(renderer, sphere, &wrong, &image, NULL, NULL) ==
                  BURNISH_STATUS_ARGUMENT &&
              !image.pixels,
          "an error empties the image");
    burnish_renderer_destroy(renderer);
    burnish_mesh_destroy(scenes[0]);
    burnish_mesh_destroy(scenes[2]);
}

static void check_blank(burnish_mesh *sphere) {
    burnish_render_options options = front_options(64, 64, 0);
    burnish_image image;
    burnish_render_report report;
    options.camera.focal_point[2] = 20; /* look away */
    options.background[1] = 77;
    render(sphere, &options, &image, &report);
    CHECK(report.covered_pixels == 0 && report.triangles_drawn == 0, "nothing to see");
    CHECK(report.bounds[2] == 0, "empty bounds");
    CHECK(image.pixels[0] == 0 && image.pixels[64 * 64 * 3 - 2] == 77, "only background");
    burnish_image_destroy(&image);
}

/* Without back faces a closed surface looks the same, and an open one shows from its front only. */
static void check_culling(burnish_mesh *sphere) {
    burnish_mesh *const scenes[] = {sphere, make_surface(0, 0)};
    for (int i = 0; i < 2; ++i) {
        for (int back = 0; back < 2; ++back) {
            burnish_render_options options = front_options(96, 96, 2.2);
            burnish_image both, culled;
            burnish_render_report all, fronts;
            options.camera.position[2] *= back ? -1 : 1;
            options.samples = 1;
            render(scenes[i], &options, &both, &all);
            options.cull_back_faces = 1;
            render(scenes[i], &options, &culled, &fronts);
            const int is_same = burnish_image_hash(&both) == burnish_image_hash(&culled);
            CHECK(all.covered_pixels > 0, "scene %d shows", i);
            CHECK(i == 0 || !back ? is_same : fronts.covered_pixels == 0, "scene %d, back %d: %zu",
                  i, back, fronts.covered_pixels);
            burnish_image_destroy(&both);
            burnish_image_destroy(&culled);
        }
    }
    burnish_mesh_destroy(scenes[1]);
}

/* A lobe whose order is too high for a material falls back and is counted. */
static void check_fallback(burnish_mesh *sphere) {
    burnish_render_options options = front_options(64, 64, 2.2);
    burnish_image image, lower;
    burnish_render_report report;
    set_material(sphere, 0.2f, 0.5f, 6);
    burnish_lobe_spec_parse("energy:32", &options.lobe, NULL);
    render(sphere, &options, &image, &report);
    CHECK(report.lobe_fallbacks == 1, "fallbacks %zu", report.lobe_fallbacks);
    burnish_lobe_spec_parse("energy:4", &options.lobe, NULL);
    render(sphere, &options, &lower, &report);
    CHECK(report.lobe_fallbacks == 0, "fallbacks %zu", report.lobe_fallbacks);
    CHECK(burnish_image_hash(&image) == burnish_image_hash(&lower), "order 4 is the highest for 6");
    burnish_image_destroy(&image);
    burnish_image_destroy(&lower);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    burnish_mesh *sphere = load_tessellated(":sphere", 96);
    RUN(check_highlight_width(sphere));
    RUN(check_highlight_everywhere(sphere, BURNISH_SPECULAR_BLINN));
    RUN(check_highlight_everywhere(sphere, BURNISH_SPECULAR_PHONG));
    RUN(check_perspective_colors());
    RUN(check_point_light(0, 4));
    RUN(check_point_light(1, 4));
    RUN(check_point_light(0, 0));
    RUN(check_point_light(1, 0));
    RUN(check_edges());
    for (int samples = 1; samples <= 4; samples += 3) {
        RUN(check_symmetry(0, 3.7, samples));
        RUN(check_symmetry(1, 3.7, samples));
        RUN(check_symmetry(0, 0, samples));
        RUN(check_symmetry(1, 0, samples));
    }
    RUN(check_hidden_share());
    RUN(check_threads());
    RUN(check_renderer(sphere));
    RUN(check_blank(sphere));
    RUN(check_fallback(sphere));
    RUN(check_culling(sphere));
    burnish_mesh_destroy(sphere);
    return test_end("render");
}
