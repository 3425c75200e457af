/* Description structs of callers that were compiled with other headers than the library's. */
#include <stdint.h>
#include <string.h>

#include "burnish/annotate.h"
#include "burnish/compare.h"
#include "burnish/image.h"
#include "burnish/kernels.h"
#include "burnish/mesh.h"
#include "burnish/render.h"
#include "mesh_arrays.h"
#include "support.h"

#define OTHER                                                                                      \
    ": the program was compiled with the headers of another version; compile it with those of "    \
    "burnish 0.1.0"

static const uint64_t VERSION_STEP = (uint64_t)1 << 32;

/* Initialises a struct as a caller of another layout would: no byte after its size is written, and
 * its members are 0. */
static void check_bounds(void (*init)(void *, uint64_t), size_t size, const char *name) {
    static uint8_t bytes[1 << 14];
    CHECK1(size + 16 < sizeof bytes);
    for (int shorter = 0; shorter < 2; ++shorter) {
        const size_t older = shorter ? size - 8 : size;
        const uint64_t version = BURNISH_LAYOUT(char) - 1 - (shorter ? 0 : VERSION_STEP);
        memset(bytes, 0xA5, sizeof bytes);
        init(bytes, version + older);
        size_t wrong = 0;
        for (size_t i = 4; i < sizeof bytes; ++i) {
            wrong += bytes[i] != (i < older ? 0 : 0xA5);
        }
        CHECK(wrong == 0, "%s: %zu wrong bytes", name, wrong);
    }
}

#define INIT(type)                                                                                 \
    static void init_##type(void *value, uint64_t layout) {                                        \
        burnish_##type##_init(value, layout);                                                      \
    }
#define TYPES(take)                                                                                \
    take(context_options) take(png_options) take(compare_options) take(annotate_options)           \
        take(load_options) take(mesh_description) take(framing) take(render_options) take(target)  \
            take(kernels_lighting) take(kernels_polygon)

TYPES(INIT)

static void test_bounds(void) {
#define BOUNDS(type) check_bounds(init_##type, sizeof(burnish_##type), #type);
    TYPES(BOUNDS)
}

/* Calls with a struct of an older version: ARGUMENT, and a line that says what to do. */
static void test_refusals(void) {
    static uint8_t pixel[4] = {1, 2, 3, 4};
    const burnish_pixels pixels = {1, 1, BURNISH_PIXELS_RGBA8, 4, pixel};
    burnish_load_options load = burnish_load_options_default();
    burnish_error error;
    burnish_mesh *mesh = load_mesh(":sphere", &load);
    burnish_framing framing = burnish_framing_default();
    burnish_camera camera;
    CHECK_OK(burnish_camera_frame(mesh, &framing, &camera, &error), error);
#define REFUSED(type, value, call, what)                                                           \
    do {                                                                                           \
        burnish_##type value;                                                                      \
        burnish_##type##_init(&value, BURNISH_LAYOUT(burnish_##type) - VERSION_STEP);              \
        CHECK1((call) == BURNISH_STATUS_ARGUMENT);                                                 \
        CHECK_TEXT(error.text, what OTHER);                                                        \
    } while (0)
    burnish_context *context;
    burnish_mesh *none;
    burnish_image image = {0};
    uint8_t *bytes;
    size_t size;
    burnish_comparison found;
    burnish_kernels_shader *shader;
    REFUSED(context_options, old, burnish_context_create(&old, &context, &error),
            "context options");
    REFUSED(png_options, old, burnish_png_encode(&pixels, &old, &bytes, &size, &error),
            "PNG options");
    REFUSED(compare_options, old, burnish_pixels_compare(&pixels, &pixels, &old, &found, &error),
            "compare options");
    REFUSED(annotate_options, old, burnish_annotate(mesh, &old, &camera, &pixels, NULL, &error),
            "annotations");
    REFUSED(load_options, old, burnish_mesh_load(":sphere", &old, &none, &error), "options");
    REFUSED(mesh_description, old, burnish_mesh_create(&old, &load, &none, &error), "description");
    REFUSED(framing, old, burnish_camera_frame(mesh, &old, &camera, &error), "options");
    REFUSED(render_options, old, burnish_render(mesh, &old, &image, NULL, &error), "options");
    REFUSED(kernels_lighting, old, burnish_kernels_shader_create(&old, NULL, &shader, &error),
            "lighting");
    const burnish_kernels_points points = {.w = NULL};
    REFUSED(kernels_polygon, old,
            burnish_kernels_polygon_light(NULL, &old, &points, NULL, 0, NULL, &error), "polygon");
    burnish_render_options options = burnish_render_options_default();
    burnish_renderer *renderer;
    options.camera = camera;
    CHECK_OK(burnish_renderer_create(NULL, &renderer, &error), error);
    REFUSED(target, old, burnish_renderer_draw_into(renderer, mesh, &options, &old, NULL, &error),
            "target");
    burnish_renderer_destroy(renderer);
    burnish_mesh_destroy(mesh);
}

/* A cookie that was copied from a struct of another size is not the library's. */
static void test_cookies(void) {
    burnish_framing framing = burnish_framing_default();
    const burnish_load_options load = burnish_load_options_default();
    const burnish_target target = burnish_target_default();
    CHECK1(framing.cookie != load.cookie && framing.cookie != target.cookie);
    framing.cookie ^= 1;
    burnish_camera camera;
    burnish_error error;
    burnish_mesh *mesh = load_mesh(":sphere", &load);
    CHECK1(burnish_camera_frame(mesh, &framing, &camera, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "options: not initialised; start from burnish_framing_default()");
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_bounds());
    RUN(test_refusals());
    RUN(test_cookies());
    return test_end("layout");
}
