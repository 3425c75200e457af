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

/* ---- An allocator of the caller's ---- */

typedef struct counted_memory {
    atomic_long left, live; /* until one fails (negative: none), and not given back */
} counted_memory;

static void *take(void *user_data, size_t size, size_t alignment) {
    counted_memory *memory = user_data;
    if (atomic_load(&memory->left) >= 0 && atomic_fetch_sub(&memory->left, 1) == 0) {
        return NULL;
    }
    atomic_fetch_add(&memory->live, 1);
    return __real_aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

static void give_back(void *user_data, void *memory) {
    counted_memory *counted = user_data;
    atomic_fetch_sub(&counted->live, 1);
    __real_free(memory);
}

/* All that a renderer takes comes from its context, and goes back there. */
static void test_context(int samples, int threads) {
    burnish_mesh *mesh = make_box();
    burnish_render_options options = box_options(samples, threads);
    burnish_context_options context_options = burnish_context_options_default();
    burnish_context *context;
    counted_memory memory = {-1, 0};
    burnish_target target = burnish_target_default();
    static uint8_t pixels[150][200 * 4];
    static float depth[150][200];
    burnish_status status = BURNISH_STATUS_MEMORY;
    int failed = 0;
    context_options.allocator = (burnish_allocator){take, give_back, &memory};
    CHECK1(burnish_context_create(&context_options, &context, NULL) == BURNISH_STATUS_OK);
    target.pixels = (burnish_pixels){options.width, options.height, BURNISH_PIXELS_BGRA8,
                                     sizeof pixels[0], pixels[0]};
    target.depth = depth[0];
    target.depth_stride = sizeof depth[0];
    for (long k = 0; status == BURNISH_STATUS_MEMORY; ++k) {
        const long before = atomic_load(&live), own_before = atomic_load(&memory.live);
        burnish_renderer *renderer;
        burnish_error error = {BURNISH_STATUS_OK, ""};
        atomic_store(&memory.left, k);
        status = burnish_renderer_create(context, &renderer, &error);
        if (status == BURNISH_STATUS_OK) {
            status = burnish_renderer_draw_into(renderer, mesh, &options, &target, NULL, &error);
        }
        CHECK(error.status == status && (status == BURNISH_STATUS_OK) == (memory.left >= 0),
              "allocation %ld: status %d, \"%s\"", k, (int)status, error.text);
        CHECK(atomic_load(&live) == before, "allocation %ld: %ld pieces that malloc gave", k,
              atomic_load(&live) - before);
        burnish_renderer_destroy(renderer);
        CHECK(atomic_load(&memory.live) == own_before, "allocation %ld: %ld pieces are lost", k,
              atomic_load(&memory.live) - own_before);
        atomic_store(&memory.left, -1);
        failed += status == BURNISH_STATUS_MEMORY;
    }
    CHECK(status == BURNISH_STATUS_OK && failed >= 20, "%d allocations, then status %d", failed,
          (int)status);
    burnish_context_destroy(context);
    CHECK1(atomic_load(&memory.live) == 0);
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_renderer(1, 1));
    RUN(test_renderer(4, 1));
    RUN(test_renderer(8, 3));
    RUN(test_single_call());
    RUN(test_context(1, 1));
    RUN(test_context(4, 3));
    return test_end("memory_shortage");
}
