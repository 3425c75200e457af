/* Options for drawing that are refused, with a message that names them. */
#include <math.h>

#include "burnish/look.h"
#include "burnish/render.h"
#include "mesh_arrays.h"
#include "support.h"

static void expect_error(const burnish_mesh *scene, const burnish_render_options *options,
                         const char *part) {
    burnish_image image;
    burnish_error error = {BURNISH_STATUS_OK, ""};
    burnish_status status = burnish_render(scene, options, &image, NULL, &error);
    CHECK(status == BURNISH_STATUS_ARGUMENT && error.status == status, "status %d", (int)status);
    CHECK(strstr(error.text, part), "\"%s\" says nothing of \"%s\"", error.text, part);
    CHECK(!image.pixels && image.width == 0, "the image stays empty");
}

static void test_options(burnish_mesh *sphere) {
    burnish_render_options good = burnish_render_options_default();
    burnish_render_options options;
    good.width = good.height = 64;
    good.camera.position[2] = 10;
    good.camera.orthographic_height = 2.2;
    memset(&options, 0, sizeof options);
    expect_error(sphere, &options, "burnish_render_options_default");
    expect_error(sphere, NULL, "burnish_render_options_default");
    expect_error(NULL, &good, "mesh");
#define WRONG(change, part)                                                                        \
    options = good;                                                                                \
    change;                                                                                        \
    expect_error(sphere, &options, part)
    WRONG(options.width = 0, "resolution 0x64");
    WRONG(options.height = 16385, "16384");
    WRONG(options.samples = 3, "samples: 3");
    WRONG(options.threads = -1, "threads");
    WRONG(options.lobe.order = 3, "order 3");
    WRONG(options.light_count = 65, "lights: 65");
    WRONG(options.lights[1].vector[0] = NAN, "light 2");
    WRONG(options.lights[0].color[2] = -1, "light 1");
    WRONG(options.camera.position[0] = INFINITY, "camera");
    WRONG(options.camera.position[2] = 0, "are the same");
    WRONG(options.camera.view_up[1] = 0; options.camera.view_up[2] = 1, "parallel");
    WRONG(options.camera.position[2] = 1e9, "scene sizes away");
    WRONG(options.camera.orthographic_height = 0; options.camera.view_angle = 180, "view angle");
    WRONG(options.camera.orthographic_height = -1, "orthographic height");
    WRONG(options.ambient_light[0] = NAN, "ambient");
    WRONG(options.ground = 2, "ground: 2");
    WRONG(options.ground = 1; options.up[1] = INFINITY, "up: ");
    WRONG(options.shadow = 2, "shadow: 2");
    WRONG(options.shadow = 1; options.lights[0].kind = BURNISH_LIGHT_POINT, "point light");
    WRONG(options.shadow = 1; options.light_count = 0, "there is no light");
    WRONG(options.occlusion = -2, "occlusion: -2 directions");
    WRONG(options.occlusion = BURNISH_OCCLUSION_MAX + 1, "directions");
    WRONG(options.occlusion = 1; options.occlusion_strength = NAN, "occlusion: a strength");
    WRONG(options.edges = UINT32_MAX, "edges: 4294967295");
    WRONG(options.edges = 256, "edges: 256");
    WRONG(options.edge_width = 0, "edges: a width of 0");
    WRONG(options.edge_width = NAN, "edges: a width");
    WRONG(options.edge_width = 101, "edges: a width of 101");
    WRONG(options.edge_opacity = 1.5f, "edges: an opacity");
    WRONG(options.outline_contrast = 256, "outline: a contrast");
#undef WRONG
}

static void test_looks(burnish_mesh *mesh) {
    burnish_render_options options = burnish_render_options_default();
    CHECK1(burnish_render_options_set_look(&options, BURNISH_LOOK_COUNT, NULL) ==
           BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_look_set_materials(BURNISH_LOOK_COUNT, mesh, NULL) == BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_render_options_set_look(NULL, BURNISH_LOOK_CLAY, NULL) ==
           BURNISH_STATUS_ARGUMENT);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    burnish_mesh *sphere = load_mesh(":sphere", NULL);
    RUN(test_options(sphere));
    RUN(test_looks(sphere));
    burnish_mesh_destroy(sphere);
    return test_end("render_options");
}
