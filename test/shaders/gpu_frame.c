/* A frame whose points are shaded by the shaders on a Vulkan device: the CPU's hash.
 * Usage: gpu_frame FOLDER, which has light.spv (lobe/test/shaders/gpu.sh) */
#include "burnish/mesh.h"
#include "burnish/render.h"
#include "shading/shading_ops.h"
#include "support.h"
#include "vulkan.h"

enum { FRAME_WIDTH = 480, FRAME_HEIGHT = 360, POINT_ARRAYS = 7, POINTS_MAX = 1 << 19 };

/* The points that the renderer passes to its kernel, in order; in a replay, the colours that it
 * gets back. One renderer, one thread. */
static struct recording {
    burnish_shade_function *shade; /* NULL: colours come from `colors` */
    const burnish_kernels_shader *shader;
    size_t count;
    float *points[POINT_ARRAYS];
    const float *colors; /* of a replay: three arrays of `total` */
    size_t total;
} recording;

static void record(const burnish_kernels_shader *shader, const burnish_kernels_points *points,
                   size_t count, uint8_t *rgba, float *const rgb[3]) {
    const float *from[POINT_ARRAYS] = {
        points->normal[0],   points->normal[1],   points->normal[2], points->position[0],
        points->position[1], points->position[2], points->w};
    CHECK(recording.count + count <= POINTS_MAX && !points->diffuse[0] && !points->first_light,
          "a plain frame");
    recording.shader = shader;
    for (int k = 0; k < POINT_ARRAYS; ++k) {
        memcpy(recording.points[k] + recording.count, from[k], count * sizeof(float));
    }
    recording.count += count;
    recording.shade(shader, points, count, rgba, rgb);
}

static void replay(const burnish_kernels_shader *shader, const burnish_kernels_points *points,
                   size_t count, uint8_t *rgba, float *const rgb[3]) {
    (void)shader, (void)points, (void)rgba;
    for (size_t k = 0; k < 3; ++k) {
        memcpy(rgb[k], recording.colors + k * recording.total + recording.count,
               count * sizeof(float));
    }
    recording.count += count;
}

typedef struct light_constants {
    float viewer[3], ambient[3];
    float zeta;
    int32_t order, light_count;
    uint32_t count;
} light_constants;

/* The recorded points, shaded on the device. */
static void shade_on_gpu(gpu_device *gpu, const char *folder, const light_constants *constants,
                         gpu_buffer *colors, const gpu_buffer *lights) {
    char path[512];
    gpu_program program;
    gpu_buffer points;
    const size_t count = recording.count;
    gpu_buffer_create(gpu, POINT_ARRAYS * count * sizeof(float), &points);
    for (size_t k = 0; k < POINT_ARRAYS; ++k) {
        memcpy((float *)points.data + k * count, recording.points[k], count * sizeof(float));
    }
    snprintf(path, sizeof path, "%s/light.spv", folder);
    gpu_program_create(gpu, path, &program);
    gpu_run(gpu, &program, (const gpu_buffer *[]){&points, colors, lights}, constants,
            sizeof *constants, (uint32_t)count);
    gpu_program_destroy(gpu, &program);
    gpu_buffer_destroy(gpu, &points);
}

/* The lights and constants of the recorded shader, which lives as long as the renderer. */
static light_constants fold(const burnish_kernels_shader *shader, int order, float *lights) {
    light_constants constants = {.zeta = shader->lobe.zeta,
                                 .order = order,
                                 .light_count = shader->light_count,
                                 .count = (uint32_t)recording.count};
    CHECK(shader->local_viewer && !shader->phong && !shader->lyon, "the default shading");
    for (int k = 0; k < 3; ++k) {
        constants.viewer[k] = shader->viewer[k];
        constants.ambient[k] = shader->ambient[BURNISH_SHADE_FLOAT][k];
        for (int l = 0; l < shader->light_count; ++l) {
            const burnish_light_constants *light = &shader->lights[l];
            CHECK(!light->is_point, "a distant light");
            lights[9 * l + k] = light->vector[k];
            lights[9 * l + 3 + k] = light->diffuse[BURNISH_SHADE_FLOAT][k];
            lights[9 * l + 6 + k] = light->specular[BURNISH_SHADE_FLOAT][k];
        }
    }
    return constants;
}

static int draw(burnish_renderer *renderer, const burnish_mesh *mesh,
                burnish_render_options *options, burnish_kernels *kernels,
                burnish_shade_function *shade, burnish_image *image) {
    burnish_error error = {BURNISH_STATUS_OK, ""};
    for (int body = 0; body < BURNISH_LOBE_BODY_COUNT; ++body) {
        kernels->shade[body][BURNISH_SHADE_GENERAL][BURNISH_SHADE_FLOAT] = shade;
    }
    recording.count = 0;
    options->kernels = kernels;
    return CHECK_OK(burnish_renderer_draw(renderer, mesh, options, image, NULL, &error), error);
}

static void check_frame(gpu_device *gpu, const char *folder, int order) {
    const burnish_load_options load = burnish_load_options_default();
    burnish_framing framing = burnish_framing_default();
    burnish_render_options options = burnish_render_options_default();
    burnish_kernels kernels = *burnish_kernels_best();
    burnish_renderer *renderer = NULL;
    burnish_mesh *mesh = NULL;
    burnish_image cpu = {0}, mixed = {0};
    gpu_buffer colors, lights;
    options.width = FRAME_WIDTH;
    options.height = FRAME_HEIGHT;
    options.threads = 1;
    options.lobe.order = order;
    framing.aspect = (double)FRAME_WIDTH / FRAME_HEIGHT;
    recording.shade =
        kernels.shade[order == 2 ? BURNISH_LOBE_BODY_SQUARE : BURNISH_LOBE_BODY_SQUARES]
                     [BURNISH_SHADE_GENERAL][BURNISH_SHADE_FLOAT];
    for (int k = 0; k < POINT_ARRAYS; ++k) {
        recording.points[k] = malloc(POINTS_MAX * sizeof(float));
    }
    gpu_buffer_create(gpu, BURNISH_LIGHT_MAX * 9 * sizeof(float), &lights);
    if (CHECK1(burnish_renderer_create(NULL, &renderer, NULL) == BURNISH_STATUS_OK) &&
        CHECK1(burnish_mesh_load(":teapot", &load, &mesh, NULL) == BURNISH_STATUS_OK) &&
        CHECK1(burnish_camera_frame(mesh, &framing, &options.camera, NULL) == BURNISH_STATUS_OK) &&
        draw(renderer, mesh, &options, &kernels, record, &cpu)) {
        const light_constants constants = fold(recording.shader, order, lights.data);
        const size_t count = recording.count;
        gpu_buffer_create(gpu, 3 * count * sizeof(float), &colors);
        shade_on_gpu(gpu, folder, &constants, &colors, &lights);
        recording.colors = colors.data;
        recording.total = count;
        draw(renderer, mesh, &options, &kernels, replay, &mixed);
        printf("teapot, order %d: %zu points shaded here; hash %016llx, of the CPU %016llx\n",
               order, count, (unsigned long long)burnish_image_hash(&mixed),
               (unsigned long long)burnish_image_hash(&cpu));
        CHECK(count > 20000 && recording.count == count, "%zu points", count);
        CHECK1(burnish_image_hash(&mixed) == burnish_image_hash(&cpu));
        memset(colors.data, 0, 3 * count * sizeof(float)); /* shows the device's colours */
        draw(renderer, mesh, &options, &kernels, replay, &mixed);
        CHECK1(burnish_image_hash(&mixed) != burnish_image_hash(&cpu));
        gpu_buffer_destroy(gpu, &colors);
    }
    gpu_buffer_destroy(gpu, &lights);
    burnish_renderer_destroy(renderer);
    burnish_mesh_destroy(mesh);
    burnish_image_destroy(&cpu);
    burnish_image_destroy(&mixed);
    for (int k = 0; k < POINT_ARRAYS; ++k) {
        free(recording.points[k]);
    }
}

int main(int count, char **arguments) {
    gpu_device gpu;
    if (count < 2) {
        fprintf(stderr, "usage: gpu_frame FOLDER\n");
        return 2;
    }
    gpu_open(&gpu);
    check_frame(&gpu, arguments[1], 2);
    check_frame(&gpu, arguments[1], 16);
    gpu_close(&gpu);
    return test_end("gpu_frame");
}
