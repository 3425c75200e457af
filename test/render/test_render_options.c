/* Options for drawing that are refused, with a message that names them. */
#include <math.h>

#include "burnish/light.h"
#include "burnish/look.h"
#include "pictures.h"

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
    const burnish_render_options good = front_options(64, 64, 2.2);
    burnish_render_options options = {0};
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
    WRONG(options.exposure = NAN, "exposure: nan stops are not in [-20, 20]");
    WRONG(options.tone_mapping = BURNISH_TONES_COUNT, "tone mapping 4 does not exist");
    WRONG(options.edges = UINT32_MAX, "edges: 4294967295");
    WRONG(options.edges = 512, "edges: 512");
    WRONG(options.edge_width = 0, "edges: a width of 0");
    WRONG(options.edge_width = NAN, "edges: a width");
    WRONG(options.edge_width = 101, "edges: a width of 101");
    WRONG(options.edge_opacity = 1.5f, "edges: an opacity");
    WRONG(options.outline_contrast = 256, "outline: a contrast");
    WRONG(options.background_environment = 1, "no environment");
    WRONG(options.area_light_count = 9, "area lights: 9 is not in [0, 8]");
    WRONG(options.has_dome = 1;
          options.dome.nadir[0] = INFINITY, "dome: needs radiances in [0, 1e6]");
    WRONG(options.has_dome = 1;
          options.dome.nadir[0] = 1,
          "dome: the radiance is negative between zenith, horizon and nadir; raise the horizon's");
    WRONG(options.reflection_distance = 1,
          "reflection distance: 1 is neither 0 nor in [1.25, 1e6]");
    WRONG(options.reflection_distance = NAN, "reflection distance: nan");
    WRONG(options.environment_strength = NAN, "environment: a strength of nan is not in [0, 1e6]");
    WRONG(options.environment_turn = INFINITY,
          "environment: the turn must be a finite number of degrees");
#define SIDES "area light 1: needs two finite half sides that are not parallel"
    options = good;
    options.area_light_count = 1;
    burnish_area_light *light = &options.area_lights[0];
#define WRONG_LIGHT(change, part)                                                                  \
    *light = (burnish_area_light){                                                                 \
        .center = {0, 0, 2}, .half_u = {1, 0, 0}, .half_v = {0, 1, 0}, .color = {1, 1, 1}};        \
    change;                                                                                        \
    expect_error(sphere, &options, part)
    WRONG_LIGHT(light->half_v[0] = 1e9, SIDES);
    WRONG_LIGHT(light->half_u[0] = 0, SIDES);
    WRONG_LIGHT(light->half_v[1] = NAN, SIDES);
    WRONG_LIGHT(light->color[2] = -1, "area light 1: needs a radiance in [0, 1e6]");
    WRONG_LIGHT(light->is_distant = 1;
                light->center[2] = 0,
                "area light 1: needs a finite center (not 0 for a distant light)");
    WRONG_LIGHT(light->shape = (burnish_area_shape)4,
                "area light 1: has a shape that does not exist");
    WRONG_LIGHT(light->shape = BURNISH_AREA_SPHERE;
                light->half_u[0] = 0, "area light 1: needs a finite half_u that is not 0");
    WRONG_LIGHT(light->shape = BURNISH_AREA_LINE;
                light->half_v[1] = INFINITY,
                "area light 1: needs finite half_u and half_v that are not 0");
    WRONG_LIGHT(light->shape = BURNISH_AREA_LINE; light->is_distant = 1;
                light->half_v[1] = 2, "its radius must be less than the length of center");
#undef SIDES
#undef WRONG
#undef WRONG_LIGHT
}

static void test_environment(burnish_mesh *sphere) {
    const float light[3] = {1, 1, 1};
    burnish_render_options options = front_options(64, 64, 2.2);
    burnish_environment *environment;
    burnish_error error;
    CHECK_OK(burnish_environment_create(NULL, 1, 1, light, &environment, &error), error);
    options.environment = environment;
    options.background_environment = options.transparent = 1;
    expect_error(sphere, &options, "transparent");
    burnish_environment_destroy(environment);
}

static void test_materials(burnish_mesh *sphere) {
    static const float wrong[] = {-0.1f, 1.1f, NAN, INFINITY};
    burnish_material material = *burnish_mesh_get_material(sphere, 0);
    burnish_error error;
    for (int i = 0; i < 4; ++i) {
        material.transparency = wrong[i];
        CHECK1(burnish_mesh_set_material(sphere, 0, &material, &error) == BURNISH_STATUS_ARGUMENT);
        CHECK(strstr(error.text, "transparency"), "%s", error.text);
    }
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
    RUN(test_environment(sphere));
    RUN(test_materials(sphere));
    RUN(test_looks(sphere));
    burnish_mesh_destroy(sphere);
    return test_end("render_options");
}
