/* Drawing with what the caller brings: a context; rounding modes and flushed subnormals, which change
 * no bit and are put back. */
#include "counting_context.h"
#include "pictures.h"

enum { WIDTH = 131, HEIGHT = 77 };

static burnish_render_options make_options(const burnish_mesh *mesh, int width, int height,
                                           int threads) {
    burnish_render_options options = framed_options(mesh, width, height);
    options.samples = 4;
    options.threads = threads;
    return options;
}

/* A call's context cancels it; a renderer's image is of its context. */
static void test_contexts(void) {
    burnish_mesh *mesh = load_tessellated(":knot", 12);
    burnish_render_options options = make_options(mesh, WIDTH, HEIGHT, 1);
    counts c;
    burnish_context *context = make_context(&c);
    burnish_renderer *renderer = make_renderer(NULL);
    burnish_image image = {0};
    options.context = context;
    c.questions = 0;
    CHECK1(burnish_render(mesh, &options, &image, NULL, NULL) == BURNISH_STATUS_CANCELLED);
    CHECK1(burnish_renderer_draw(renderer, mesh, &options, &image, NULL, NULL) ==
           BURNISH_STATUS_ARGUMENT);
    burnish_renderer_destroy(renderer);
    burnish_context_destroy(context);
    CHECK(c.live == 0, "%ld blocks lost", c.live);
    burnish_mesh_destroy(mesh);
}

/* ---- The floating-point environment ---- */

/* Every plane of a picture. */
static uint64_t hash_picture(const burnish_mesh *mesh, int threads) {
    const burnish_render_options options = make_options(mesh, WIDTH, HEIGHT, threads);
    static uint8_t pixels[HEIGHT][WIDTH * 4];
    static uint8_t coverage[HEIGHT][WIDTH];
    static float depth[HEIGHT][WIDTH], normals[HEIGHT][WIDTH][3];
    static uint32_t triangles[HEIGHT][WIDTH];
    const burnish_target target = make_target(
        (burnish_pixels){WIDTH, HEIGHT, BURNISH_PIXELS_RGBA8, sizeof pixels[0], pixels[0]},
        depth[0], normals[0][0], triangles[0], coverage[0]);
    draw_into(mesh, &options, &target, NULL);
    uint64_t hash = test_add_hash(0, pixels, sizeof pixels);
    hash = test_add_hash(test_add_hash(hash, depth, sizeof depth), coverage, sizeof coverage);
    return test_add_hash(test_add_hash(hash, normals, sizeof normals), triangles, sizeof triangles);
}

/* The kernels' results. */
static uint64_t hash_kernels(void) {
    const burnish_kernels *kernels = burnish_kernels_best();
    burnish_kernels_lighting lighting = burnish_kernels_lighting_default();
    burnish_kernels_shader *shader;
    float values[7] = {0.1f, 0.5f, 0.83f, 0.97f, 0.995f, 1e-40f, 0.3f}, colors[3][7];
    float *const rgb[3] = {colors[0], colors[1], colors[2]};
    const float *const normal[3] = {values, values + 1, values};
    uint8_t rgba[7][4];
    const burnish_kernels_points points = {.normal = {values, values, values}};
    burnish_kernels_shader_create(&lighting, NULL, &shader, NULL);
    burnish_kernels_shade_rgba8(kernels, shader, &points, 7, rgba[0], NULL);
    uint64_t hash = test_add_hash(0, rgba, sizeof rgba);
    burnish_kernels_shade_float(kernels, shader, &points, 7, rgb, NULL);
    hash = test_add_hash(hash, colors, sizeof colors);
    burnish_kernels_shader_destroy(shader);
    burnish_kernels_normalize(kernels, 6, normal, rgb);
    hash = test_add_hash(hash, colors, sizeof colors);
    lighting.lobe.kind = BURNISH_LOBE_POWER;
    burnish_kernels_lobe_of_cosines(kernels, &lighting.lobe, 3.5f, 7, values, colors[0], NULL);
    burnish_kernels_lobe_of_lambdas(kernels, &lighting.lobe, 3.5f, 7, values, colors[1], NULL);
    return test_add_hash(hash, colors, sizeof colors);
}

static void test_environment(int threads) {
    burnish_mesh *mesh = load_tessellated(":knot", 12);
    const uint64_t picture = hash_picture(mesh, threads), kernels = hash_kernels();
    for (int mode = 1; mode < 8; ++mode) {
        set_mode(mode);
        const unsigned before = control_bits();
        const uint64_t own_picture = hash_picture(mesh, threads), own_kernels = hash_kernels();
        const int is_kept = control_bits() == before;
        set_mode(0);
        CHECK(own_picture == picture, "mode %d: another picture", mode);
        CHECK(own_kernels == kernels, "mode %d: other kernels", mode);
        CHECK(is_kept, "mode %d: not put back", mode);
    }
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_contexts());
    RUN(test_environment(1));
    RUN(test_environment(2));
    return test_end("render_context");
}
