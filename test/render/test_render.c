/* Whole pictures against formulas: perspective-correct attributes, point lights, edges, what is
 * hidden; what is counted. */
#include <math.h>

#include "pictures.h"
#include "shapes.h"

static double decode(uint8_t code) {
    return (double)burnish_srgb_decode((float)code / 255.0f);
}

static double pixel_value(const burnish_image *image, int x, int y, int channel) {
    return decode(image->pixels[(y * image->width + x) * image->channels + channel]);
}

static burnish_material phong(float diffuse, float specular, float exponent) {
    burnish_material material = matt_material(diffuse);
    set_three(material.specular, specular);
    material.exponent = exponent;
    material.has_diffuse = 1;
    return material;
}

/* A floor that runs from z = 4 to z = -40, black to white: the colour at a pixel is where its ray
 * meets the floor. The near end is on the camera's other side, so clipping is tested too. */
static void check_perspective_colors(void) {
    enum { SIZE = 200 };
    static const float POSITIONS[12] = {-50, -1, 14, 50, -1, 14, 50, -1, -40, -50, -1, -40};
    static const uint8_t COLORS[16] = {0,   0,   0,   255, 0,   0,   0,   255,
                                       255, 255, 255, 255, 255, 255, 255, 255};
    burnish_mesh *scene = create_quads(POSITIONS, COLORS, 1);
    burnish_render_options options = front_options(SIZE, SIZE, 0);
    double worst = 0;
    int checked = 0;
    options.camera.view_angle = 60;
    light_evenly(&options);
    burnish_image image = draw_image(scene, &options, NULL);
    for (int y = SIZE / 2 + 8; y < SIZE; ++y) {
        for (int x = 0; x < SIZE; x += 7) {
            double slope = (y + 0.5 - SIZE / 2.0) / (SIZE / 2.0) * tan(M_PI / 6);
            double z = 10 - 1 / slope;
            double expected = (14 - z) / 54;
            if (z > -39) {
                worst = fmax(worst, fabs(pixel_value(&image, x, y, 0) - expected));
                ++checked;
            }
        }
    }
    CHECK(checked > 1000, "%d pixels checked", checked);
    CHECK(worst < 0.005, "largest difference from the ray's hit: %.4f", worst);
    burnish_image_destroy(&image);
    burnish_mesh_destroy(scene);
}

/* kd N.L of a point light one unit above a plane, with the light in scene and in camera space: as
 * strong as its color at the distance 1.2, with a range of 5 and a cone to 60 degrees. */
static void check_point_light(int follows_camera, double orthographic_height) {
    enum { SIZE = 150 };
    static const float POSITIONS[12] = {-9, -9, 0, 9, -9, 0, 9, 9, 0, -9, 9, 0};
    const burnish_material material = phong(0.8f, 0, 32);
    burnish_mesh *scene = create_quads(POSITIONS, NULL, 1);
    burnish_render_options options = front_options(SIZE, SIZE, orthographic_height);
    double worst = 0, extent = orthographic_height / 2;
    if (extent == 0) {
        options.camera.view_angle = 30;
        extent = 10 * tan(M_PI / 12);
    }
    light_from(&options, follows_camera ? 0.05 : 0.5, 0, follows_camera ? -0.9 : 1);
    burnish_light *light = &options.lights[0];
    light->kind = BURNISH_LIGHT_POINT;
    light->follows_camera = follows_camera;
    light->distance = follows_camera ? 0.12 : 1.2;
    light->range = follows_camera ? 0.5 : 5;
    light->axis[2] = -2;
    light->cone[0] = 0.8;
    light->cone[1] = 0.5;
    set_material(scene, &material);
    burnish_image image = draw_image(scene, &options, NULL);
    for (int y = 0; y < SIZE; ++y) {
        for (int x = 0; x < SIZE; ++x) {
            double px = (x + 0.5 - SIZE / 2.0) / (SIZE / 2.0) * extent - 0.5;
            double py = (SIZE / 2.0 - y - 0.5) / (SIZE / 2.0) * extent;
            double squared = px * px + py * py + 1, t = (1 / sqrt(squared) - 0.5) / 0.3;
            double expected = 0.8 / sqrt(squared) * 1.44 / squared * (1 - pow(squared / 25, 2)) *
                              pow(fmin(fmax(t, 0), 1), 2);
            expected = fmin(expected, 1);
            worst = fmax(worst, fabs(pixel_value(&image, x, y, 2) - expected));
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
    const burnish_material material = matt_material(1);
    burnish_mesh *scene = create_quads(POSITIONS, NULL, 1);
    burnish_render_report report;
    burnish_render_options options = front_options(5, 5, 5); /* the edge crosses pixel 2's middle */
    options.samples = 16;
    light_evenly(&options);
    set_material(scene, &material);
    burnish_image image = draw_image(scene, &options, &report);
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
    image = draw_image(scene, &options, NULL);
    CHECK(image.channels == 4, "alpha wanted");
    const uint8_t *edge = image.pixels + 4 * (2 * 5 + 2);
    CHECK(edge[0] == 255 && abs(edge[3] - (int)(covered * 255 / 16 + 0.5)) <= 1,
          "straight alpha: %d %d", edge[0], edge[3]);
    CHECK(image.pixels[3] == 255 && image.pixels[4 * 4 + 3] == 0, "opaque and empty");
    burnish_image_destroy(&image);
    burnish_mesh_destroy(scene);
}

/* Of a box of 2 x 1 x 3 seen from its front, all but that face is hidden; beside the camera all. */
static void check_hidden_share(void) {
    shape s = box_at(-1, -0.5, -1.5, 2, 1, 3);
    burnish_mesh *box = create_shape(&s);
    burnish_render_options options = front_options(40, 40, 4);
    burnish_render_report report;
    options.counts = BURNISH_COUNTS_AREA;
    burnish_image image = draw_image(box, &options, &report);
    CHECK(fabs(report.hidden_share - 20.0 / 22) < 1e-12 && report.triangles_drawn == 2,
          "the front hides %.17g", report.hidden_share);
    burnish_image_destroy(&image);
    options.camera.position[0] = options.camera.focal_point[0] = 10;
    image = draw_image(box, &options, &report);
    CHECK(report.hidden_share == 1, "beside it: %.17g", report.hidden_share);
    burnish_image_destroy(&image);
    burnish_mesh_destroy(box);
}

/* Only what is asked for is counted; a drawing that fails leaves no pixels of the one before. */
static void check_renderer(burnish_mesh *sphere) {
    burnish_renderer *renderer = make_renderer(NULL);
    burnish_image image = {0};
    burnish_render_options options = front_options(64, 64, 2.2);
    burnish_render_report report;
    for (int i = 0; i < 3; ++i) {
        options.counts = (burnish_counts)i;
        CHECK1(burnish_renderer_draw(renderer, sphere, &options, &image, &report, NULL) ==
               BURNISH_STATUS_OK);
        CHECK((report.covered_pixels > 0) == (options.counts != BURNISH_COUNTS_NONE) &&
                  (report.triangles_drawn > 0) == (options.counts == BURNISH_COUNTS_ALL),
              "counts %d", i);
    }
    options.samples = 3;
    CHECK1(burnish_renderer_draw(renderer, sphere, &options, &image, NULL, NULL) ==
               BURNISH_STATUS_ARGUMENT &&
           !image.pixels);
    burnish_renderer_destroy(renderer);
}

static void check_blank(burnish_mesh *sphere) {
    burnish_render_options options = front_options(64, 64, 0);
    burnish_render_report report;
    options.camera.focal_point[2] = 20; /* look away */
    options.background[1] = 77;
    burnish_image image = draw_image(sphere, &options, &report);
    CHECK(report.covered_pixels == 0 && report.triangles_drawn == 0, "nothing to see");
    CHECK(report.bounds[2] == 0, "empty bounds");
    CHECK(image.pixels[0] == 0 && image.pixels[64 * 64 * 3 - 2] == 77, "only background");
    burnish_image_destroy(&image);
}

/* Without back faces a closed surface looks the same, and an open one shows from its front only. */
static void check_culling(burnish_mesh *sphere) {
    static const float sheet[12] = {-1, -0.8f, 0, 0.9f, -1, 0.2f, 1, 0.7f, 0, -0.6f, 1, -0.3f};
    burnish_mesh *const scenes[] = {sphere, create_quads(sheet, NULL, 1)};
    for (int i = 0; i < 4; ++i) {
        const int is_open = i / 2, back = i % 2;
        burnish_render_options options = front_options(96, 96, 2.2);
        burnish_render_report all, fronts;
        options.camera.position[2] *= back ? -1 : 1;
        burnish_image both = draw_image(scenes[is_open], &options, &all);
        options.cull_back_faces = 1;
        burnish_image culled = draw_image(scenes[is_open], &options, &fronts);
        const int is_same = burnish_image_hash(&both) == burnish_image_hash(&culled);
        CHECK(all.covered_pixels > 0, "scene %d shows", is_open);
        CHECK(is_open && back ? fronts.covered_pixels == 0 : is_same, "scene %d, back %d: %zu",
              is_open, back, fronts.covered_pixels);
        burnish_image_destroy(&both);
        burnish_image_destroy(&culled);
    }
    burnish_mesh_destroy(scenes[1]);
}

/* A lobe whose order is too high for a material falls back and is counted. */
static void check_fallback(burnish_mesh *sphere) {
    const burnish_material material = phong(0.2f, 0.5f, 6);
    burnish_render_options options = front_options(64, 64, 2.2);
    burnish_render_report report;
    uint64_t hashes[2];
    set_material(sphere, &material);
    for (int i = 0; i < 2; ++i) {
        burnish_lobe_spec_parse(i ? "energy:4" : "energy:32", &options.lobe, NULL);
        burnish_image image = draw_image(sphere, &options, &report);
        CHECK(report.lobe_fallbacks == (size_t)!i, "fallbacks %zu", report.lobe_fallbacks);
        hashes[i] = burnish_image_hash(&image);
        burnish_image_destroy(&image);
    }
    CHECK(hashes[0] == hashes[1], "order 4 is the highest for 6");
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    burnish_mesh *sphere = load_tessellated(":sphere", 96);
    RUN(check_perspective_colors());
    RUN(check_point_light(0, 4));
    RUN(check_point_light(1, 4));
    RUN(check_point_light(0, 0));
    RUN(check_point_light(1, 0));
    RUN(check_edges());
    RUN(check_hidden_share());
    RUN(check_renderer(sphere));
    RUN(check_blank(sphere));
    RUN(check_fallback(sphere));
    RUN(check_culling(sphere));
    burnish_mesh_destroy(sphere);
    return test_end("render");
}
