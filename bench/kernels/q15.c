/* bench_q15: the integer arrays compared with the kernels in floating point, on this machine.
 * Usage: bench_q15 [FOLDER [quick]]: prints the tables as Markdown; with FOLDER also writes
 * FOLDER/machine, lobes, memory and pixels. Contenders of a table take turns; times are medians. */
#include "bench/kernels/q15.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bench/kernels/clock.h"
#include "bench/kernels/kernels.h"
#include "bench/kernels/machine.h"

enum {
    POINTS = 2048,
    LARGE = 1 << 24,
    LARGE_QUICK = 1 << 20,
    ROUNDS = 101,
    KINDS_MAX = 4,
    ROWS_MAX = 8
};

/* What a row measures. The first, in floating point, is the reference. */
typedef enum what {
    FLOAT_LOBE,
    FLOAT_LOBE_4,
    CONVERTED,
    FAST,
    FAST_4,
    NEAR,
    FAST8,
    FLOAT_LARGE,
    CONVERTED_LARGE,
    FAST_LARGE,
    FAST8_LARGE,
    FLOAT_PIXEL,
    PIXEL_CHORD,
    PIXEL_COSINE,
    PIXEL_565,
} what;

typedef struct row {
    what what;
    const char *label;
} row;

typedef struct input {
    uint16_t cosines[POINTS];
    float float_cosines[POINTS];
    int16_t normals[3][POINTS];
    float float_normals[3][POINTS];
    uint16_t words[POINTS];
    float floats[POINTS];
    uint8_t rgba[4 * POINTS];
    burnish_lobe_q15 lobe, lobe4;
    burnish_lobe_spec float_lobe, float_lobe4;
    burnish_q15_shader chord, cosine; /* n = 32, n = 31 */
    burnish_q15_light light;
    burnish_kernels_shader *shader;
    size_t count; /* of the large arrays */
    uint16_t *large, *large_out;
    float *float_large, *float_large_out;
} input;

typedef struct kind {
    const char *name;
    const burnish_bench_q15 *integers;
    const burnish_kernels *kernels;
} kind;

typedef struct context {
    const kind *kind;
    input *input;
    what what;
} context;

static void float_lobe(const context *at, const burnish_lobe_spec *lobe, size_t count,
                       const float *from, float *to) {
    (void)burnish_kernels_lobe_of_cosines(at->kind->kernels, lobe, 32, count, from, to, NULL);
}

/* Words through the lobe in floating point, a block in the first cache at a time. */
static void converted(const context *at, size_t count, const uint16_t *from, uint16_t *to) {
    input *in = at->input;
    for (size_t i = 0; i < count; i += POINTS) {
        at->kind->integers->to_floats(POINTS, from + i, in->floats);
        float_lobe(at, &in->float_lobe, POINTS, in->floats, in->floats);
        at->kind->integers->to_words(POINTS, in->floats, to + i);
    }
}

static void run(const void *given) {
    const context *at = given;
    input *in = at->input;
    const burnish_bench_q15 *integers = at->kind->integers;
    const int16_t *const normals[3] = {in->normals[0], in->normals[1], in->normals[2]};
    const burnish_kernels_points points = {
        .normal = {in->float_normals[0], in->float_normals[1], in->float_normals[2]}};
    switch (at->what) {
    case FLOAT_LOBE:
        float_lobe(at, &in->float_lobe, POINTS, in->float_cosines, in->floats);
        break;
    case FLOAT_LOBE_4:
        float_lobe(at, &in->float_lobe4, POINTS, in->float_cosines, in->floats);
        break;
    case CONVERTED:
        converted(at, POINTS, in->cosines, in->words);
        break;
    case FAST:
        integers->fast(&in->lobe, POINTS, in->cosines, in->words);
        break;
    case FAST_4:
        integers->fast(&in->lobe4, POINTS, in->cosines, in->words);
        break;
    case NEAR:
        integers->near(&in->lobe, POINTS, in->cosines, in->words);
        break;
    case FAST8:
        integers->fast8(&in->lobe, POINTS, in->cosines, in->words);
        break;
    case FLOAT_LARGE:
        float_lobe(at, &in->float_lobe, in->count, in->float_large, in->float_large_out);
        break;
    case CONVERTED_LARGE:
        converted(at, in->count, in->large, in->large_out);
        break;
    case FAST_LARGE:
        integers->fast(&in->lobe, in->count, in->large, in->large_out);
        break;
    case FAST8_LARGE:
        integers->fast8(&in->lobe, in->count, in->large, in->large_out);
        break;
    case FLOAT_PIXEL:
        (void)burnish_kernels_shade_rgba8(at->kind->kernels, in->shader, &points, POINTS, in->rgba,
                                          NULL);
        break;
    case PIXEL_CHORD:
        integers->rgba8(&in->chord, &in->light, POINTS, normals, in->rgba);
        break;
    case PIXEL_COSINE:
        integers->rgba8(&in->cosine, &in->light, POINTS, normals, in->rgba);
        break;
    case PIXEL_565:
        integers->rgb565(&in->chord, &in->light, POINTS, normals, in->rgba);
        break;
    }
}

/* Cosines uniform in [0, 1]; normals of a sphere's visible side in an unpredictable order, 0 to 4 %
 * short, as after interpolation. */
static void fill_points(input *in) {
    uint32_t state = 1;
    for (int i = 0; i < POINTS; ++i) {
        state = state * 1664525u + 1013904223u;
        in->cosines[i] = (uint16_t)((state >> 16) * 0x8000u / 0xFFFF);
        in->float_cosines[i] = (float)in->cosines[i] / 32768.0f;
        const double z = (i * 797 % POINTS + .5) / POINTS, r = sqrt(1 - z * z);
        const double angle = i * 2.399963229728653, length = 1 - .04 * (state >> 16) / 65536;
        const double v[3] = {r * cos(angle), r * sin(angle), z};
        for (int k = 0; k < 3; ++k) {
            in->normals[k][i] = (int16_t)lrint(32767 * length * v[k]);
            in->float_normals[k][i] = (float)(length * v[k]);
        }
    }
    for (size_t i = 0; i < in->count; ++i) {
        in->large[i] = in->cosines[i % POINTS];
        in->float_large[i] = in->float_cosines[i % POINTS];
        in->large_out[i] = 0;
        in->float_large_out[i] = 0;
    }
}

static int fill(input *in) {
    static const burnish_q15_material surface = {
        {0x1000, 0x1000, 0x1000}, {0x5000, 0x4000, 0x3000}, {0x3000, 0x3000, 0x3000}};
    static const uint16_t white[3] = {0x8000, 0x8000, 0x8000};
    static const int16_t to_light[3] = {-15729, 19661, 20972}, to_viewer[3] = {0, 0, 0x7FFF};
    const burnish_kernels_lighting lighting = burnish_kernels_lighting_default();
    in->large = malloc(in->count * sizeof *in->large);
    in->large_out = malloc(in->count * sizeof *in->large_out);
    in->float_large = malloc(in->count * sizeof *in->float_large);
    in->float_large_out = malloc(in->count * sizeof *in->float_large_out);
    if (!in->large || !in->large_out || !in->float_large || !in->float_large_out) {
        return 0;
    }
    fill_points(in);
    (void)burnish_lobe_spec_parse("energy:2", &in->float_lobe, NULL);
    (void)burnish_lobe_spec_parse("energy:4", &in->float_lobe4, NULL);
    burnish_lobe_q15_create(&in->lobe, BURNISH_Q15_ENERGY, 2, 32);
    burnish_lobe_q15_create(&in->lobe4, BURNISH_Q15_ENERGY, 4, 32);
    burnish_q15_shader_create(&in->chord, BURNISH_Q15_ENERGY, 2, 32, &surface, white);
    burnish_q15_shader_create(&in->cosine, BURNISH_Q15_ENERGY, 2, 31, &surface, white);
    burnish_q15_light_create(&in->light, to_light, to_viewer, white, &surface);
    return burnish_kernels_shader_create(&lighting, NULL, &in->shader, NULL) == BURNISH_STATUS_OK;
}

static void release(input *in) {
    burnish_kernels_shader_destroy(in->shader);
    free(in->large);
    free(in->large_out);
    free(in->float_large);
    free(in->float_large_out);
    free(in);
}

static int find_kinds(kind kinds[KINDS_MAX]) {
    int count = 0;
#define KIND(word, isa)                                                                            \
    if (burnish_kernels_for(isa)) {                                                                \
        kinds[count++] = (kind){#word, burnish_bench_q15_##word(), burnish_kernels_for(isa)};      \
    }
#if defined(__SSE2__)
    KIND(avx512, BURNISH_ISA_AVX512)
    KIND(avx2, BURNISH_ISA_AVX2)
    KIND(sse2, BURNISH_ISA_SSE2)
#elif defined(__aarch64__)
    KIND(neon, BURNISH_ISA_NEON)
#elif defined(__wasm_simd128__)
    KIND(wasm, BURNISH_ISA_WASM)
#endif
    KIND(scalar, BURNISH_ISA_SCALAR)
    return count;
}

/* Opens FOLDER/NAME; NULL without a folder. */
static FILE *open_table(const char *folder, const char *name) {
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", folder ? folder : "", name);
    return folder ? fopen(path, "w") : NULL;
}

static void put(FILE *file, const char *line) {
    fputs(line, stdout);
    if (file) {
        fputs(line, file);
    }
}

typedef struct table {
    const char *name, *heading;
    const row *rows;
    int row_count;
    double items, seconds;
} table;

/* Measures rows for every kind and writes them: nanoseconds per element, and times the first row.
 */
static void write_table(const char *folder, const table *t, const kind *kinds, int kind_count,
                        input *in) {
    const int rounds = t->seconds > 0 ? ROUNDS : 15;
    static burnish_bench_job jobs[KINDS_MAX][ROWS_MAX];
    static context contexts[KINDS_MAX][ROWS_MAX];
    FILE *file = open_table(folder, t->name);
    char text[128];
    snprintf(text, sizeof text, "| %s |", t->heading);
    put(file, text);
    for (int k = 0; k < kind_count; ++k) {
        for (int i = 0; i < t->row_count; ++i) {
            contexts[k][i] = (context){&kinds[k], in, t->rows[i].what};
            jobs[k][i] =
                (burnish_bench_job){.run = run, .context = &contexts[k][i], .items = t->items};
        }
        burnish_bench_take_turns(jobs[k], t->row_count, rounds, t->seconds);
        snprintf(text, sizeof text, " %s | x float |", kinds[k].name);
        put(file, text);
    }
    put(file, "\n| --- |");
    for (int k = 0; k < kind_count; ++k) {
        put(file, " ---: | ---: |");
    }
    for (int i = 0; i < t->row_count; ++i) {
        snprintf(text, sizeof text, "\n| %s |", t->rows[i].label);
        put(file, text);
        for (int k = 0; k < kind_count; ++k) {
            snprintf(text, sizeof text, " %.3f | %.2f |", burnish_bench_median(&jobs[k][i], rounds),
                     burnish_bench_median_ratio(&jobs[k][i], &jobs[k][0], rounds));
            put(file, text);
        }
    }
    put(file, "\n");
    puts("");
    if (file) {
        fclose(file);
    }
}

int main(int count, char **arguments) {
    static const row lobes[] = {
        {FLOAT_LOBE, "floats, order 2"},        {FLOAT_LOBE_4, "floats, order 4"},
        {CONVERTED, "words, by way of floats"}, {FAST, "words, `fast`, order 2"},
        {FAST_4, "words, `fast`, order 4"},     {NEAR, "words, `near`, order 2"},
        {FAST8, "words to bytes, `fast8`"},
    };
    static const row large[] = {
        {FLOAT_LARGE, "floats, order 2"},
        {CONVERTED_LARGE, "words, by way of floats"},
        {FAST_LARGE, "words, `fast`, order 2"},
        {FAST8_LARGE, "words to bytes, `fast8`"},
    };
    static const row pixels[] = {
        {FLOAT_PIXEL, "floats to RGBA8"},
        {PIXEL_CHORD, "words to RGBA8, n = 32, from the chord"},
        {PIXEL_COSINE, "words to RGBA8, n = 31, from the cosine"},
        {PIXEL_565, "words to RGB565, n = 32"},
    };
    const char *folder = count > 1 ? arguments[1] : NULL;
    burnish_bench_machine machine;
    kind kinds[KINDS_MAX];
    const int kind_count = find_kinds(kinds);
    input *in = calloc(1, sizeof *in);
    if (in) {
        in->count = count > 2 ? LARGE_QUICK : LARGE; /* quick */
    }
    if (!in || !fill(in)) {
        fputs("bench_q15: out of memory\n", stderr);
        return 1;
    }
    burnish_bench_find_machine(&machine);
    FILE *file = open_table(folder, "machine");
    char text[256];
    snprintf(text, sizeof text, "%s, %s. Medians of %d rounds.\n", machine.processor,
             machine.compiler, (int)ROUNDS);
    put(file, text);
    puts("");
    if (file) {
        fclose(file);
    }
    const table tables[] = {
        {"lobes", "nanoseconds per value", lobes, 7, POINTS, 0.05e-3},
        {"memory", "nanoseconds per value", large, 4, (double)in->count, 0},
        {"pixels", "nanoseconds per pixel", pixels, 4, POINTS, 0.05e-3},
    };
    for (int i = 0; i < 3; ++i) {
        write_table(folder, &tables[i], kinds, kind_count, in);
    }
    release(in);
    return 0;
}
