/* The shaders' values on a Vulkan device against the CPU's, bit for bit.
 * Usage: gpu_values FOLDER LOBES_CSV AREA_CSV [--all]
 *   FOLDER  cases.spv, cases_hlsl.spv, area.spv, area_hlsl.spv, sweep.spv, light.spv, half.spv
 *   --all   one lobe at all 2^32 floats too (a minute) */
#include "vulkan.h"

#include "area.h"
#include "burnish/mesh.h"
#include "burnish/render.h"
#include "half.h"
#include "shading/shading_ops.h"
#include "support.h"

/* How values of two sides differ. A device that flushes numbers below 2^-126 to 0 is reported, not
 * rejected: Vulkan allows it. */
typedef struct value_tally {
    size_t values, flushed, others;
} value_tally;

static void compare(float actual, float expected, value_tally *tally, const char *what, double x) {
    ++tally->values;
    if (memcmp(&actual, &expected, sizeof actual) == 0) {
        return;
    }
    if (actual == 0.0f && expected > 0.0f && expected < 0x1p-126f) {
        ++tally->flushed;
    } else if (++tally->others < 10) {
        printf("%s of %a: %a, expected %a\n", what, x, (double)actual, (double)expected);
    }
}

static void report(const value_tally *tally, const char *what) {
    printf("%-34s %10zu values, %zu flushed to 0, %zu others\n", what, tally->values,
           tally->flushed, tally->others);
    CHECK(tally->values > 0 && tally->others == 0, "%s: %zu values differ", what, tally->others);
}

/* ---- The vectors of test/data/lobes.csv ---- */

enum { CASES_MAX = 1 << 13, SCHLICK = 5 };

typedef struct lobe_case {
    float cosine, zeta, n;
    int number;
} lobe_case;

static int number_of(int order) {
    int number = 0;
    while (2 << number < order) {
        ++number;
    }
    return number;
}

/* Lines of the family and of Schlick's lobe. */
static int read_cases(const char *path, lobe_case *cases) {
    char line[512];
    int count = 0;
    FILE *file = fopen(path, "r");
    while (file && count < CASES_MAX && fgets(line, sizeof line, file)) {
        char *at = line, *fields[7] = {NULL};
        for (int i = 0; i < 7 && at; ++i) {
            fields[i] = at;
            at = strchr(at, ',');
            if (at) {
                *at++ = 0;
            }
        }
        const int family = strcmp(fields[0], "family") == 0;
        if (!fields[6] || (!family && strcmp(fields[0], "schlick") != 0)) {
            continue;
        }
        cases[count].number = family ? number_of(atoi(fields[1])) : SCHLICK;
        cases[count].n = strtof(fields[3], NULL);
        cases[count].cosine = strtof(fields[4], NULL);
        cases[count++].zeta = strtof(fields[5], NULL);
    }
    if (file) {
        fclose(file);
    }
    return count;
}

static float lobe_on_cpu(const lobe_case *one) {
    if (one->number == SCHLICK) {
        return burnish_schlick_at_cosine(one->cosine, one->n);
    }
    const burnish_lobe lobe = {one->zeta, 2 << one->number};
    return burnish_lobe_at_cosine(lobe, one->cosine);
}

/* Vulkan rounds divisions within 2.5 units in the last place. */
static void compare_divided(float actual, float expected, value_tally *tally, const char *what,
                            double x) {
    const float unit = 0x1p-23f * expected;
    compare(fabsf(actual - expected) <= 2.5f * unit ? expected : actual, expected, tally, what, x);
}

static void check_cases(gpu_device *gpu, const char *folder, const char *name, const char *csv) {
    char path[512];
    gpu_program program;
    gpu_buffer in, out;
    value_tally lobes = {0}, divided = {0};
    snprintf(path, sizeof path, "%s/%s.spv", folder, name);
    gpu_program_create(gpu, path, &program);
    gpu_buffer_create(gpu, CASES_MAX * sizeof(lobe_case), &in);
    gpu_buffer_create(gpu, CASES_MAX * sizeof(float), &out);
    const lobe_case *cases = in.data;
    const float *values = out.data;
    const int count = read_cases(csv, in.data);
    gpu_run(gpu, &program, (const gpu_buffer *[]){&in, &out, &in}, NULL, 0, (uint32_t)count);
    for (int i = 0; i < count; ++i) {
        (cases[i].number == SCHLICK ? compare_divided : compare)(
            values[i], lobe_on_cpu(&cases[i]), cases[i].number == SCHLICK ? &divided : &lobes, name,
            (double)cases[i].cosine);
    }
    report(&lobes, strcmp(name, "cases") == 0 ? "vectors, GLSL" : "vectors, HLSL");
    report(&divided, "vectors, Schlick, 2.5 ulp");
    gpu_buffer_destroy(gpu, &in);
    gpu_buffer_destroy(gpu, &out);
    gpu_program_destroy(gpu, &program);
}

/* ---- Area lights: test/data/area.csv ---- */

static void check_area(gpu_device *gpu, const char *folder, const char *name, const char *csv) {
    char path[512];
    gpu_program program;
    gpu_buffer in, out;
    double largest[AREA_SHAPES] = {0};
    snprintf(path, sizeof path, "%s/%s.spv", folder, name);
    gpu_program_create(gpu, path, &program);
    gpu_buffer_create(gpu, AREA_CASES_MAX * sizeof(area_case), &in);
    gpu_buffer_create(gpu, AREA_CASES_MAX * 2 * sizeof(float), &out);
    const area_case *cases = in.data;
    const float *values = out.data;
    const int count = read_area_cases(csv, in.data);
    CHECK(count > 300, "%s: %d cases", csv, count);
    gpu_run(gpu, &program, (const gpu_buffer *[]){&in, &out, &in}, NULL, 0, (uint32_t)count);
    for (int i = 0; i < count; ++i) {
        const area_case *one = &cases[i];
        const float error =
            fmaxf(fabsf(values[2 * i] - one->diffuse), fabsf(values[2 * i + 1] - one->specular));
        const int shape = (int)one->shape;
        largest[shape] = fmax(largest[shape], (double)error);
        CHECK(error <= AREA_ERRORS[shape], "%s, case %d: %g", name, i, (double)error);
    }
    printf("%-34s %10d values, errors %.1e, discs %.1e, GGX %.3f\n", name, count,
           largest[AREA_RECT], largest[AREA_DISC], largest[AREA_GGX]);
    gpu_buffer_destroy(gpu, &in);
    gpu_buffer_destroy(gpu, &out);
    gpu_program_destroy(gpu, &program);
}

/* ---- Floats in order ---- */

typedef struct sweep_constants {
    float zeta, n;
    int32_t number;
    uint32_t first, step;
} sweep_constants;

enum { SWEEP_BATCH = 1 << 21 }; /* 2^15 groups: every device takes 65,535 */

static void sweep(gpu_device *gpu, gpu_program *program, const gpu_buffer *out, int order,
                  float zeta, uint32_t step, value_tally *tally) {
    const uint64_t total = ((uint64_t)1 << 32) / step;
    const burnish_lobe lobe = {zeta, order};
    const float *values = out->data;
    for (uint64_t first = 0; first < total; first += SWEEP_BATCH) {
        const uint32_t count =
            (uint32_t)(total - first < SWEEP_BATCH ? total - first : SWEEP_BATCH);
        const sweep_constants constants = {zeta, 0, number_of(order), (uint32_t)(first * step),
                                           step};
        gpu_run(gpu, program, (const gpu_buffer *[]){out, out, out}, &constants, sizeof constants,
                count);
        for (uint32_t i = 0; i < count; ++i) {
            const float x = test_float_of_bits(constants.first + step * i);
            const float expected = burnish_lobe_at_cosine(lobe, x);
            if (memcmp(&values[i], &expected, sizeof expected) != 0) {
                compare(values[i], expected, tally, "cosine", (double)x);
                --tally->values;
            }
        }
        tally->values += count;
    }
}

static void check_sweep(gpu_device *gpu, const char *folder, int all) {
    char path[512];
    gpu_program program;
    gpu_buffer out;
    value_tally some = {0}, every = {0};
    snprintf(path, sizeof path, "%s/sweep.spv", folder);
    gpu_program_create(gpu, path, &program);
    gpu_buffer_create(gpu, SWEEP_BATCH * sizeof(float), &out);
    for (int order = 2; order <= 32; order *= 2) {
        for (float n = (float)order; n <= 65536.0f; n *= 8.0f) {
            sweep(gpu, &program, &out, order, (n + 1.0f) / (float)(order + 1), 16411, &some);
        }
    }
    report(&some, "every 16,411th float");
    if (all) {
        sweep(gpu, &program, &out, 32, 129.0f / 33.0f, 1, &every);
        report(&every, "all floats, order 32, n = 128");
    }
    gpu_buffer_destroy(gpu, &out);
    gpu_program_destroy(gpu, &program);
}

/* ---- A frame ---- */

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

/* ---- Half precision ---- */

static void check_half(gpu_device *gpu, const char *folder) {
    char path[512];
    gpu_program program;
    gpu_buffer out;
    value_tally tally = {0};
    size_t flushed = 0;
    if (!gpu->has_half) {
        printf("half precision: not supported by this device\n");
        return;
    }
    snprintf(path, sizeof path, "%s/half.spv", folder);
    gpu_program_create(gpu, path, &program);
    gpu_buffer_create(gpu, 65536 * sizeof(float), &out);
    const float *values = out.data;
    for (int number = 0; number < 5; ++number) {
        for (float n = (float)(2 << number); n <= 65536.0f; n *= 2.0f) {
            const struct {
                float zeta;
                int32_t number;
            } constants = {half_round((n + 1.0f) / (float)((2 << number) + 1)), number};
            gpu_run(gpu, &program, (const gpu_buffer *[]){&out, &out, &out}, &constants,
                    sizeof constants, 65536);
            for (uint32_t i = 0; i < 65536; ++i) {
                const float c = half_to_float((uint16_t)i);
                const float expected = half_lobe(c, constants.zeta, number);
                CHECK(values[i] >= 0.0f && values[i] <= 1.0f, "%g of %g", (double)values[i],
                      (double)c);
                if (values[i] == 0.0f && expected > 0.0f && expected < 0x1p-14f) {
                    ++flushed;
                } else {
                    compare(values[i], expected, &tally, "half", (double)c);
                }
            }
        }
    }
    printf("half precision: %zu of them flushed below 2^-14\n", flushed);
    report(&tally, "half precision, all inputs");
    gpu_buffer_destroy(gpu, &out);
    gpu_program_destroy(gpu, &program);
}

int main(int count, char **arguments) {
    gpu_device gpu;
    if (count < 4) {
        fprintf(stderr, "usage: gpu_values FOLDER LOBES_CSV AREA_CSV [--all]\n");
        return 2;
    }
    gpu_open(&gpu);
    printf("%s: denormal floats %s, round to nearest %s\n", gpu.name,
           gpu.keeps_denormals ? "can be kept" : "may be flushed",
           gpu.has_round_even ? "can be had" : "is not promised");
    check_cases(&gpu, arguments[1], "cases", arguments[2]);
    check_cases(&gpu, arguments[1], "cases_hlsl", arguments[2]);
    check_area(&gpu, arguments[1], "area", arguments[3]);
    check_area(&gpu, arguments[1], "area_hlsl", arguments[3]);
    check_sweep(&gpu, arguments[1], count > 4);
    check_frame(&gpu, arguments[1], 2);
    check_frame(&gpu, arguments[1], 16);
    check_half(&gpu, arguments[1]);
    gpu_close(&gpu);
    return test_end("gpu_values");
}
