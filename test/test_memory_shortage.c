/* Every allocation of rendering fails once: the call says so, nothing leaks (the sanitizers look),
 * and the same renderer then draws what it would have drawn. */
#include "burnish/render.h"
#include "mesh_arrays.h"
#include "short_memory.h"
#include "support.h"

/* Inside a coloured box: every kind of array is needed, those of clipped triangles too. */
static burnish_mesh *make_box(void) {
    static const float POSITIONS[24] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                                        -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
    static const uint32_t FACES[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                       2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    uint8_t colors[32];
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh;
    burnish_error error;
    for (int i = 0; i < 32; ++i) {
        colors[i] = (uint8_t)(40 + 6 * i);
    }
    const burnish_mesh_description arrays = describe_arrays(POSITIONS, NULL, colors, 8, FACES, 12);
    CHECK(burnish_mesh_create(&arrays, &options, &mesh, &error) == BURNISH_STATUS_OK, "%s",
          error.text);
    return mesh;
}

static burnish_render_options box_options(int samples, int threads) {
    burnish_render_options options = burnish_render_options_default();
    options.width = 200;
    options.height = 150;
    options.samples = samples;
    options.threads = threads;
    options.camera.position[0] = 0.9;
    options.camera.position[1] = 0.8;
    options.camera.position[2] = 0.7;
    options.camera.view_angle = 90;
    return options;
}

/* Allocation k of a fresh renderer's first frame fails, then the frame is drawn again. Returns 0
 * once there is no allocation k. */
static int fail_one(const burnish_mesh *mesh, const burnish_render_options *options, long k,
                    uint64_t expected) {
    burnish_renderer *renderer;
    burnish_image image = {0};
    burnish_render_report report;
    burnish_error error = {BURNISH_STATUS_OK, ""};
    if (!CHECK1(burnish_renderer_create(NULL, &renderer, NULL) == BURNISH_STATUS_OK)) {
        return 0;
    }
    allocations_left = k;
    burnish_status status = burnish_renderer_draw(renderer, mesh, options, &image, &report, &error);
    const int has_failed = allocations_left < 0;
    allocations_left = -1;
    CHECK(status == (has_failed ? BURNISH_STATUS_MEMORY : BURNISH_STATUS_OK) &&
              error.status == status && (image.pixels == NULL) == has_failed,
          "allocation %ld: status %d, \"%s\"", k, (int)status, error.text);
    status = burnish_renderer_draw(renderer, mesh, options, &image, &report, &error);
    CHECK(status == BURNISH_STATUS_OK && burnish_image_hash(&image) == expected,
          "after allocation %ld: status %d or other pixels", k, (int)status);
    burnish_image_destroy(&image);
    burnish_renderer_destroy(renderer);
    return has_failed;
}

static void test_renderer(int samples, int threads) {
    burnish_mesh *mesh = make_box();
    const burnish_render_options options = box_options(samples, threads);
    burnish_image image;
    CHECK1(burnish_render(mesh, &options, &image, NULL, NULL) == BURNISH_STATUS_OK);
    const uint64_t expected = burnish_image_hash(&image);
    burnish_image_destroy(&image);
    long k = 0;
    while (fail_one(mesh, &options, k, expected)) {
        ++k;
    }
    CHECK(k >= 20, "only %ld allocations", k);
    burnish_mesh_destroy(mesh);
}

/* The same where a call makes the renderer too. */
static void test_single_call(void) {
    burnish_mesh *mesh = make_box();
    const burnish_render_options options = box_options(4, 1);
    burnish_status status = BURNISH_STATUS_MEMORY;
    for (long k = 0; status != BURNISH_STATUS_OK && k < 1000; ++k) {
        burnish_image image;
        burnish_error error = {BURNISH_STATUS_OK, ""};
        allocations_left = k;
        status = burnish_render(mesh, &options, &image, NULL, &error);
        const int has_failed = allocations_left < 0;
        allocations_left = -1;
        CHECK(status == (has_failed ? BURNISH_STATUS_MEMORY : BURNISH_STATUS_OK) &&
                  error.status == status,
              "allocation %ld: status %d, \"%s\"", k, (int)status, error.text);
        burnish_image_destroy(&image);
    }
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_renderer(1, 1));
    RUN(test_renderer(4, 1));
    RUN(test_renderer(8, 3));
    RUN(test_single_call());
    return test_end("memory_shortage");
}
