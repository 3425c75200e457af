/* The shaders' values on a Vulkan device against the CPU's, bit for bit.
 * Usage: gpu_values FOLDER LOBES_CSV AREA_CSV [--all]
 *   FOLDER  cases.spv, cases_hlsl.spv, area.spv, area_hlsl.spv, sweep.spv, half.spv, falloff.spv,
 *           falloff_exact.spv
 *   --all   one lobe at all 2^32 floats too (a minute), e^-x and composites at 2^24 inputs */
#include "vulkan.h"

#include "area.h"
#include "burnish/lobe.h"
#include "half.h"
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

/* ---- e^-x, and composite lobes ---- */

typedef struct falloff_constants {
    float top, slope, offset[4], scale; /* x or lambda = scale * i */
    int32_t number;
    uint32_t first, step;
} falloff_constants;

static float falloff_on_cpu(const falloff_constants *at, float x) {
    burnish_composite lobe = {at->top, at->slope, {0}, at->number};
    memcpy(lobe.offset, at->offset, sizeof lobe.offset);
    return at->number == 13   ? burnish_exp_falloff3(x)
           : at->number == 14 ? burnish_exp_falloff4(x)
           : at->number == 15 ? burnish_exp_falloff5(x)
                              : burnish_composite_at_lambda(lobe, x);
}

/* Compares 2^24 / step values with the CPU's: the same bits if the shader is exact, else an error
 * within 2^-20 of the CPU's. n: of cos^n, 0 for e^-x. */
static void falloff_compare(gpu_device *gpu, gpu_program *program, const gpu_buffer *out,
                            falloff_constants constants, double n, const char *name) {
    const float *values = out->data;
    const int is_exact = strstr(name, "exact") != NULL;
    value_tally tally = {0};
    double error = 0, cpu_error = 0;
    const uint32_t total = (1u << 24) / constants.step;
    const uint32_t count = total < SWEEP_BATCH ? total : SWEEP_BATCH;
    for (; constants.first < 1u << 24; constants.first += count * constants.step) {
        gpu_run(gpu, program, (const gpu_buffer *[]){out, out, out}, &constants, sizeof constants,
                count);
        for (uint32_t i = 0; i < count; ++i) {
            const float x = constants.scale * (float)(constants.first + constants.step * i);
            const float expected = falloff_on_cpu(&constants, x);
            const double exact = n > 0 ? pow(1 - (double)x, n) : exp(-(double)x);
            error = fmax(error, fabs((double)values[i] - exact));
            cpu_error = fmax(cpu_error, fabs((double)expected - exact));
            compare(is_exact ? values[i] : expected, expected, &tally, name, (double)x);
        }
    }
    printf("%-13s %2d, n = %-5g %14zu values, error %.6f, the CPU's %.6f\n", name, constants.number,
           n, tally.values, error, cpu_error);
    CHECK(tally.others == 0 && error <= cpu_error + 0x1p-20, "%s, %d: %zu, %g", name,
          constants.number, tally.others, error);
}

static void check_falloffs(gpu_device *gpu, const char *folder, const char *name, int all) {
    static const float exponents[] = {24, 64, 4096};
    char path[512];
    gpu_program program;
    gpu_buffer out;
    snprintf(path, sizeof path, "%s/%s.spv", folder, name);
    gpu_program_create(gpu, path, &program);
    gpu_buffer_create(gpu, SWEEP_BATCH * sizeof(float), &out);
    falloff_constants constants = {.scale = 0x1p-20f, .step = all ? 1 : 64};
    for (constants.number = 13; constants.number <= 15; ++constants.number) {
        falloff_compare(gpu, &program, &out, constants, 0, name);
    }
    constants.scale = 0x1p-24f;
    for (int i = 0; i < 12; ++i) {
        const float n = exponents[i / 4];
        burnish_composite lobe;
        CHECK1(burnish_composite_create(&lobe, BURNISH_COMPOSITE_MINIMAX, 3 + i % 4, n) ==
               BURNISH_LOBE_OK);
        constants.top = lobe.top;
        constants.slope = lobe.slope;
        memcpy(constants.offset, lobe.offset, sizeof lobe.offset);
        constants.number = lobe.multiplications;
        falloff_compare(gpu, &program, &out, constants, (double)n, name);
    }
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
    check_half(&gpu, arguments[1]);
    check_falloffs(&gpu, arguments[1], "falloff", count > 4);
    check_falloffs(&gpu, arguments[1], "falloff_exact", count > 4);
    gpu_close(&gpu);
    return test_end("gpu_values");
}
