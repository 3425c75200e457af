/* Random points, shaded by the shaders on a Vulkan device: the bits of the CPU's kernels.
 * Usage: gpu_light FOLDER, which has light.spv (lobe/test/shaders/gpu.sh) */
#include "burnish/kernels.h"
#include "shading/shading_ops.h"
#include "support.h"
#include "vulkan.h"

enum { POINTS = 1 << 17, ARRAYS = 7, LIGHTS = 2 };

typedef struct light_constants {
    float viewer[3], ambient[3];
    float zeta;
    int32_t order, light_count;
    uint32_t count;
} light_constants;

/* The lights and constants that the kernels have. */
static light_constants fold(const burnish_kernels_shader *shader, int order, float *lights) {
    light_constants constants = {.zeta = shader->lobe.zeta,
                                 .order = order,
                                 .light_count = shader->light_count,
                                 .count = POINTS};
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

static void check_points(gpu_device *gpu, const char *folder, int order) {
    burnish_kernels_lighting lighting = burnish_kernels_lighting_default();
    burnish_kernels_shader *shader;
    gpu_program program;
    gpu_buffer points, colors, lights;
    static float expected[3][POINTS];
    char path[512];
    uint64_t state = test_seed((uint64_t)order);
    size_t different = 0, lit = 0;
    lighting.local_viewer = 1;
    lighting.viewer[2] = 4;
    lighting.lobe.order = order;
    lighting.light_count = LIGHTS;
    lighting.lights[1] = lighting.lights[0];
    lighting.lights[1].vector[0] = -lighting.lights[0].vector[0];
    if (!CHECK1(!burnish_kernels_shader_create(&lighting, NULL, &shader, NULL))) {
        return;
    }
    gpu_buffer_create(gpu, sizeof(float[ARRAYS][POINTS]), &points);
    gpu_buffer_create(gpu, sizeof expected, &colors);
    gpu_buffer_create(gpu, LIGHTS * 9 * sizeof(float), &lights);
    float(*const at)[POINTS] = points.data; /* normal, position, w */
    for (size_t i = 0; i < (size_t)ARRAYS * POINTS; ++i) {
        at[i / POINTS][i % POINTS] = i / POINTS == 6 ? test_uniform_float(&state, 0.5f, 2)
                                                     : test_uniform_float(&state, -1, 1);
    }
    const burnish_kernels_points arrays = {
        .normal = {at[0], at[1], at[2]}, .position = {at[3], at[4], at[5]}, .w = at[6]};
    CHECK1(!burnish_kernels_shade_float(NULL, shader, &arrays, POINTS,
                                        (float *const[3]){expected[0], expected[1], expected[2]},
                                        NULL));
    const light_constants constants = fold(shader, order, lights.data);
    snprintf(path, sizeof path, "%s/light.spv", folder);
    gpu_program_create(gpu, path, &program);
    gpu_run(gpu, &program, (const gpu_buffer *[]){&points, &colors, &lights}, &constants,
            sizeof constants, POINTS);
    for (size_t i = 0; i < (size_t)3 * POINTS; ++i) {
        different += memcmp((const float *)colors.data + i, *expected + i, sizeof(float)) != 0;
        lit += expected[i / POINTS][i % POINTS] > 0.1f;
    }
    printf("order %d: %d points, %zu values above 0.1, %zu differ\n", order, POINTS, lit,
           different);
    CHECK1(different == 0 && lit > POINTS);
    gpu_program_destroy(gpu, &program);
    gpu_buffer_destroy(gpu, &points);
    gpu_buffer_destroy(gpu, &colors);
    gpu_buffer_destroy(gpu, &lights);
    burnish_kernels_shader_destroy(shader);
}

int main(int count, char **arguments) {
    gpu_device gpu;
    if (count < 2) {
        fprintf(stderr, "usage: gpu_light FOLDER\n");
        return 2;
    }
    gpu_open(&gpu);
    check_points(&gpu, arguments[1], 2);
    check_points(&gpu, arguments[1], 16);
    gpu_close(&gpu);
    return test_end("gpu_light");
}
