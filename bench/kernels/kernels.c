/* The sections of the benchmark, and their rows. */
#include "bench/kernels/kernels.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/kernels/clock.h"
#include "bench/kernels/input.h"
#include "bench/kernels/machine.h"
#include "bench/kernels/scalar.h"
#include "shading/shading_ops.h"

enum { JOBS_MAX = 16 };

/* The context of a job of any kind. */
typedef struct context {
    burnish_bench_input *input;
    const burnish_kernels *kernels;
    const burnish_bench_contenders *contenders;
    const burnish_bench_scalar *scalar;
    const burnish_bench_scalar_lobe *scalar_lobe;
    int scene, of; /* which shader */
    int which;     /* burnish_bench_lobe or burnish_bench_root */
} context;

/* A section under construction: jobs that take turns, and the rows that they fill. The first job is
 * the reference. */
typedef struct section {
    const char *name;
    burnish_bench_table *table;
    int is_inverse; /* of all rows; copies are without it */
    int first;      /* row */
    int count;      /* jobs */
    burnish_bench_job jobs[JOBS_MAX];
    int rows[JOBS_MAX];
    context contexts[JOBS_MAX];
} section;

const burnish_bench_contenders *burnish_bench_contenders_for(burnish_isa isa) {
    static const burnish_bench_contenders *(*const TABLES[])(void) = {
#define CONTENDERS(name, word, lanes) burnish_bench_contenders_##word,
        BURNISH_ISA_LIST(CONTENDERS)
#undef CONTENDERS
    };
    if ((unsigned)isa >= BURNISH_ISA_COUNT || !(burnish_isa_available() >> isa & 1)) {
        return NULL;
    }
#if defined(__SSE2__)
    if (isa == BURNISH_ISA_AVX2 && !__builtin_cpu_supports("fma")) {
        return NULL; /* the contenders use fused multiply-adds, the library does not */
    }
#endif
    return TABLES[isa]();
}

int burnish_bench_has(burnish_isa isa) {
    return burnish_bench_contenders_for(isa) != NULL;
}

void burnish_bench_key(const burnish_bench_row *row, char *key, size_t size) {
    snprintf(key, size, row->is_inverse ? "%s.over_%s" : "%s.%s_over", row->section, row->name);
}

static const burnish_bench_shader *shader_of(const context *given) {
    return &given->input->shaders[given->scene][given->of];
}

static void run_lobe(const void *given) {
    const context *at = given;
    at->contenders->lobe[BURNISH_BENCH_INDEX(at->which)](shader_of(at), BURNISH_BENCH_POINTS,
                                                         at->input->cosines, at->input->values);
}

static void run_library_lobe(const void *given) {
    const context *at = given;
    const burnish_lobe_constants *lobe = &shader_of(at)->shader.lobe;
    at->kernels->lobe[lobe->body][BURNISH_LOBE_INPUT_COSINE](lobe, BURNISH_BENCH_POINTS,
                                                             at->input->cosines, at->input->values);
}

static void run_lobe_in_memory(const void *given) {
    const context *at = given;
    at->contenders->lobe[BURNISH_BENCH_INDEX(at->which)](shader_of(at),
                                                         at->input->array_bytes / sizeof(float),
                                                         at->input->source, at->input->destination);
}

static void run_library_lobe_in_memory(const void *given) {
    const context *at = given;
    const burnish_lobe_constants *lobe = &shader_of(at)->shader.lobe;
    at->kernels->lobe[lobe->body][BURNISH_LOBE_INPUT_COSINE](
        lobe, at->input->array_bytes / sizeof(float), at->input->source, at->input->destination);
}

static void run_shade(const void *given) {
    const context *at = given;
    for (size_t block = 0; block < at->input->blocks; ++block) {
        burnish_kernels_points points = burnish_bench_block(at->input, block);
        at->contenders->shade[BURNISH_BENCH_INDEX(at->which)][at->scene](
            shader_of(at), &points, BURNISH_BENCH_POINTS, at->input->rgba);
    }
}

static void run_library_shade(const void *given) {
    const context *at = given;
    for (size_t block = 0; block < at->input->blocks; ++block) {
        burnish_kernels_points points = burnish_bench_block(at->input, block);
        (void)burnish_kernels_shade_rgba8(at->kernels, &shader_of(at)->shader, &points,
                                          BURNISH_BENCH_POINTS, at->input->rgba, NULL);
    }
}

/* The positions on the unit sphere are the axes. */
static void run_square(const void *given) {
    const context *at = given;
    float *const light[2] = {at->input->values, at->input->others};
    for (size_t block = 0; block < at->input->blocks; ++block) {
        const burnish_kernels_points points = burnish_bench_block(at->input, block);
        burnish_kernels_axes axes = {.stretch = {NULL}};
        memcpy(axes.axis, points.position, sizeof axes.axis);
        (void)burnish_kernels_polygon_light(at->kernels, &at->input->squares[at->which], &points,
                                            &axes, BURNISH_BENCH_POINTS, light, NULL);
    }
}

/* Cosines above 2^-126 serve as squared lengths. */
static void run_root(const void *given) {
    const context *at = given;
    at->contenders->root[at->which](BURNISH_BENCH_POINTS, at->input->cosines, at->input->values);
}

static void run_through(const void *given) {
    const context *at = given;
    (void)at->scalar->through(at->scalar_lobe, BURNISH_BENCH_POINTS, at->input->cosines,
                              at->input->values);
}

static void run_chain(const void *given) {
    const context *at = given;
    (void)at->scalar->chain(at->scalar_lobe, BURNISH_BENCH_POINTS, at->input->bright,
                            at->input->values);
}

static void section_begin(section *made, const char *name, burnish_bench_table *table) {
    made->name = name;
    made->table = table;
    made->is_inverse = strncmp(name, "paper.", 6) == 0;
    made->first = table->count;
    made->count = 0;
}

/* Adds a row, and a job unless the contender is missing. */
static void section_add(section *to, const char *name, const char *label, void (*run)(const void *),
                        const context *given, double items, const char *missing) {
    burnish_bench_row *row = &to->table->rows[to->table->count];
    *row = (burnish_bench_row){.section = to->name,
                               .name = name,
                               .label = label,
                               .is_inverse = to->is_inverse || strstr(name, "copy"),
                               .nanoseconds = NAN,
                               .cycles = NAN,
                               .ratio = NAN,
                               .missing = missing};
    if (!missing) {
        burnish_bench_job *job = &to->jobs[to->count];
        to->contexts[to->count] = *given;
        job->run = run;
        job->context = &to->contexts[to->count];
        job->items = items;
        to->rows[to->count++] = to->table->count;
    }
    ++to->table->count;
}

static void section_run(section *given, int rounds, double seconds) {
    burnish_bench_take_turns(given->jobs, given->count, rounds, seconds);
    for (int i = 0; i < given->count; ++i) {
        burnish_bench_row *row = &given->table->rows[given->rows[i]];
        const burnish_bench_job *job = &given->jobs[i], *lobe = &given->jobs[0];
        row->nanoseconds = burnish_bench_median(job, rounds);
        row->ratio = row->is_inverse ? burnish_bench_median_ratio(lobe, job, rounds)
                                     : burnish_bench_median_ratio(job, lobe, rounds);
    }
}

/* Shared by the sections of an instruction set. */
typedef struct isa_run {
    section section;
    context context;
    burnish_bench_symbol libmvec, sleef;
} isa_run;

static void add(isa_run *run, const char *name, const char *label, void (*function)(const void *),
                int of, int which, const char *missing) {
    context given = run->context;
    const int is_shade =
        function == run_shade || function == run_library_shade || function == run_square;
    double items = is_shade ? (double)given.input->blocks * BURNISH_BENCH_POINTS
                   : function == run_lobe_in_memory || function == run_library_lobe_in_memory
                       ? (double)(given.input->array_bytes / sizeof(float))
                       : BURNISH_BENCH_POINTS;
    given.of = of;
    given.which = which;
    section_add(&run->section, name, label, function, &given, items, missing);
}

static void add_lobes(isa_run *run) {
    const int n = BURNISH_BENCH_OF_EXPONENT;
    section_begin(&run->section, "lobe.l1", run->section.table);
    run->context.scene = BURNISH_BENCH_DIRECTIONAL;
    add(run, "lobe", "the lobe, m = 2", run_library_lobe, BURNISH_BENCH_OF_FAMILY, 0, NULL);
    add(run, "copy", "plain copy", run_lobe, n, BURNISH_BENCH_COPY, NULL);
    add(run, "order4", "m = 4", run_library_lobe, BURNISH_BENCH_OF_FAMILY_4, 0, NULL);
    add(run, "schlick", "schlick, true division", run_lobe, n, BURNISH_BENCH_SCHLICK, NULL);
    add(run, "schlick_robust", "schlick of the library", run_library_lobe, n, 0, NULL);
    add(run, "squarings", "c^32 by five squarings", run_lobe, n, BURNISH_BENCH_SQUARINGS, NULL);
    add(run, "squarings_plain", "the same with subnormals", run_lobe, n,
        BURNISH_BENCH_SQUARINGS_PLAIN, NULL);
    add(run, "table", "table of 1,024, gather", run_lobe, n, BURNISH_BENCH_TABLE, NULL);
    add(run, "vector_pow", "tuned vector pow, 1.2e-4", run_lobe, n, BURNISH_BENCH_VECTOR_POW, NULL);
    add(run, "sleef", "SLEEF powf u10", run_lobe, BURNISH_BENCH_OF_SLEEF, BURNISH_BENCH_LIBRARY,
        run->sleef.missing);
    add(run, "libmvec", "libmvec powf", run_lobe, BURNISH_BENCH_OF_LIBMVEC, BURNISH_BENCH_LIBRARY,
        run->libmvec.missing);
    add(run, "libm", "libm powf", run_lobe, n, BURNISH_BENCH_LIBM, NULL);
}

static void add_roots(isa_run *run) {
    section_begin(&run->section, "root.l1", run->section.table);
    add(run, "ours", "1/sqrt of the library", run_root, 0, BURNISH_BENCH_ROOT_OURS, NULL);
    add(run, "ieee", "IEEE root and division", run_root, 0, BURNISH_BENCH_ROOT_IEEE, NULL);
    add(run, "tuned2", "two tuned Newton steps", run_root, 0, BURNISH_BENCH_ROOT_TUNED, NULL);
    add(run, "newton3", "three plain Newton steps", run_root, 0, BURNISH_BENCH_ROOT_NEWTON, NULL);
}

static void add_memory(isa_run *run) {
    const char *missing =
        run->context.input->array_bytes > 0 ? NULL : "not enough free memory for two arrays";
    const int n = BURNISH_BENCH_OF_EXPONENT;
    section_begin(&run->section, "lobe.memory", run->section.table);
    add(run, "lobe", "the lobe, m = 2", run_library_lobe_in_memory, BURNISH_BENCH_OF_FAMILY, 0,
        missing);
    add(run, "nt_copy", "non-temporal copy", run_lobe_in_memory, n, BURNISH_BENCH_STREAM_COPY,
        missing);
    add(run, "copy", "plain copy", run_lobe_in_memory, n, BURNISH_BENCH_COPY, missing);
}

static void add_shading(isa_run *run, const char *name, int scene) {
    const int n = BURNISH_BENCH_OF_EXPONENT;
    section_begin(&run->section, name, run->section.table);
    run->context.scene = scene;
    add(run, "lobe", "the lobe, m = 2", run_library_shade, BURNISH_BENCH_OF_FAMILY, 0, NULL);
    add(run, "none", "no specular", run_library_shade, BURNISH_BENCH_OF_NONE, 0, NULL);
    add(run, "schlick", "schlick, true division", run_shade, n, BURNISH_BENCH_SCHLICK, NULL);
    add(run, "table", "table of 1,024, gather", run_shade, n, BURNISH_BENCH_TABLE, NULL);
    add(run, "vector_pow", "tuned vector pow, 1.2e-4", run_shade, n, BURNISH_BENCH_VECTOR_POW,
        NULL);
    add(run, "sleef", "SLEEF powf u10", run_shade, BURNISH_BENCH_OF_SLEEF, BURNISH_BENCH_LIBRARY,
        run->sleef.missing);
    add(run, "libmvec", "libmvec powf", run_shade, BURNISH_BENCH_OF_LIBMVEC, BURNISH_BENCH_LIBRARY,
        run->libmvec.missing);
}

static void add_squares(isa_run *run) {
    section_begin(&run->section, "square", run->section.table);
    run->context.scene = BURNISH_BENCH_POINT;
    add(run, "point", "whole lighting by a point light", run_library_shade, BURNISH_BENCH_OF_FAMILY,
        0, NULL);
    add(run, "diffuse", "a square light: diffuse", run_square, 0, BURNISH_BENCH_SQUARE_DIFFUSE,
        NULL);
    add(run, "wide", "and a lobe of zeta 3, m = 4", run_square, 0, BURNISH_BENCH_SQUARE_WIDE, NULL);
    add(run, "narrow", "and a lobe of zeta 100, m = 4", run_square, 0, BURNISH_BENCH_SQUARE_NARROW,
        NULL);
    add(run, "ggx", "and three lobes, GGX of roughness 0.5", run_square, 0,
        BURNISH_BENCH_SQUARE_GGX, NULL);
}

/* Opens the libraries of an instruction set and hands their functions to the shaders. */
static void isa_begin(isa_run *run, burnish_isa isa, burnish_bench_input *input,
                      burnish_bench_table *table) {
    memset(run, 0, sizeof *run);
    run->context.input = input;
    run->context.contenders = burnish_bench_contenders_for(isa);
    run->context.kernels = burnish_kernels_for(isa);
    run->section.table = table;
    table->count = 0;
    run->libmvec = burnish_bench_open_libmvec(run->context.contenders);
    run->sleef = burnish_bench_open_sleef(run->context.contenders);
    for (int scene = 0; scene < BURNISH_BENCH_SCENES; ++scene) {
        input->shaders[scene][BURNISH_BENCH_OF_LIBMVEC].library = run->libmvec.function;
        input->shaders[scene][BURNISH_BENCH_OF_SLEEF].library = run->sleef.function;
    }
}

static void isa_end(isa_run *run) {
    burnish_bench_close(&run->libmvec);
    burnish_bench_close(&run->sleef);
}

static void measure_isa(isa_run *run, int rounds, int quick) {
    const double seconds = quick ? 0.2e-3 : 1e-3;
    add_lobes(run);
    section_run(&run->section, rounds, seconds);
    add_shading(run, "shade.directional", BURNISH_BENCH_DIRECTIONAL);
    section_run(&run->section, rounds, seconds);
    add_shading(run, "shade.point", BURNISH_BENCH_POINT);
    section_run(&run->section, rounds, seconds);
    add_squares(run);
    section_run(&run->section, rounds, seconds);
    add_roots(run);
    section_run(&run->section, rounds, seconds);
    add_memory(run);
    section_run(&run->section, quick ? 3 : 13, 0);
}

/* Subtracts the time of the bare loop from the latencies; throughputs hide it. */
static void finish_scalar(burnish_bench_table *table, int first, int is_chain, double hertz) {
    burnish_bench_row *rows = table->rows + first;
    const int count = table->count - first;
    const double loop = is_chain ? rows[1].nanoseconds : 0;
    for (int i = 0; i < count; ++i) {
        rows[i].nanoseconds -= i == 1 ? 0 : loop;
        rows[i].cycles = hertz > 0 ? rows[i].nanoseconds * hertz * 1e-9 : NAN;
        if (is_chain) {
            rows[i].ratio = rows[i].nanoseconds / rows[0].nanoseconds;
            rows[i].ratio = rows[i].is_inverse ? 1 / rows[i].ratio : rows[i].ratio;
        }
    }
}

static void measure_scalar(section *made, burnish_bench_input *input, int rounds, int quick,
                           burnish_bench_report *report) {
    static const struct {
        const char *name;
        const burnish_bench_scalar *list;
        int is_chain;
    } SECTIONS[] = {{"scalar.latency", burnish_bench_scalars, 1},
                    {"scalar.throughput", burnish_bench_scalars, 0},
                    {"paper.latency", burnish_bench_paper, 1},
                    {"paper.throughput", burnish_bench_paper, 0}};
    burnish_bench_scalar_lobe lobe;
    (void)burnish_lobe_create(&lobe.family, BURNISH_FIT_ENERGY, 2, BURNISH_BENCH_EXPONENT);
    lobe.exponent = BURNISH_BENCH_EXPONENT;
    lobe.whole_exponent = BURNISH_BENCH_EXPONENT;
    lobe.offset = (float)(1.0 - (double)lobe.family.zeta);
    report->scalar.count = 0;
    for (size_t i = 0; i < sizeof SECTIONS / sizeof *SECTIONS; ++i) {
        const int is_chain = SECTIONS[i].is_chain;
        section_begin(made, SECTIONS[i].name, &report->scalar);
        for (const burnish_bench_scalar *scalar = SECTIONS[i].list; scalar->name; ++scalar) {
            context given = {.input = input, .scalar = scalar, .scalar_lobe = &lobe};
            section_add(made, scalar->name, scalar->label, is_chain ? run_chain : run_through,
                        &given, BURNISH_BENCH_POINTS, NULL);
        }
        section_run(made, rounds, quick ? 0.2e-3 : 1e-3);
        finish_scalar(&report->scalar, made->first, is_chain, report->tsc_hertz);
    }
}

/* 512 MiB per array, at most a quarter of free memory; a quick run takes 128 MiB. */
static size_t find_array_bytes(const burnish_bench_machine *machine, int quick) {
    size_t bytes = (size_t)(quick ? 128 : 512) << 20;
    while (machine->free_bytes > 0 && bytes > machine->free_bytes / 4) {
        bytes /= 2;
    }
    return bytes;
}

burnish_status burnish_bench_run(const burnish_bench_settings *settings,
                                 burnish_bench_report *report, burnish_error *error) {
    burnish_bench_input *input;
    burnish_status status = burnish_bench_input_create(&input, error);
    isa_run *run = malloc(sizeof *run);
    if (status != BURNISH_STATUS_OK || !run) {
        burnish_bench_input_destroy(input);
        free(run);
        return status != BURNISH_STATUS_OK ? status : BURNISH_STATUS_MEMORY;
    }
    memset(report, 0, sizeof *report);
    report->rounds = settings->quick ? 7 : 41;
    report->tsc_hertz = burnish_bench_tsc_hertz();
    burnish_bench_find_machine(&report->machine);
    burnish_bench_input_map(input, find_array_bytes(&report->machine, settings->quick));
    report->array_bytes = input->array_bytes;
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        if (settings->isa_mask >> isa & 1 && burnish_bench_contenders_for((burnish_isa)isa)) {
            isa_begin(run, (burnish_isa)isa, input, &report->isa[isa]);
            measure_isa(run, report->rounds, settings->quick);
            isa_end(run);
            report->has_isa[isa] = 1;
        }
    }
    measure_scalar(&run->section, input, report->rounds, settings->quick, report);
    free(run);
    burnish_bench_input_destroy(input);
    return BURNISH_STATUS_OK;
}

static void find_errors(const burnish_bench_input *input, int is_root, burnish_bench_row *row) {
    row->absolute = row->relative = 0;
    for (int i = 0; i < BURNISH_BENCH_POINTS; ++i) {
        const double c = (double)input->cosines[i];
        if (is_root && c <= 0) {
            continue;
        }
        const double exact = is_root ? 1 / sqrt(c) : pow(c, BURNISH_BENCH_EXPONENT);
        const double error = fabs((double)input->values[i] - exact);
        if (!isfinite(error)) {
            row->absolute = row->relative = NAN;
            return;
        }
        row->absolute = fmax(row->absolute, error);
        row->relative = exact >= 1e-6 ? fmax(row->relative, error / exact) : row->relative;
    }
}

burnish_status burnish_bench_errors(burnish_isa isa, burnish_bench_table *errors,
                                    burnish_error *error) {
    burnish_bench_input *input;
    burnish_status status = burnish_bench_input_create(&input, error);
    isa_run *run = malloc(sizeof *run);
    if (status == BURNISH_STATUS_OK && run) {
        isa_begin(run, isa, input, errors);
        for (int roots = 0; roots < 2; ++roots) {
            roots ? add_roots(run) : add_lobes(run);
            for (int i = 0; i < run->section.count; ++i) {
                memset(input->values, 0xff, sizeof input->values);
                run->section.jobs[i].run(run->section.jobs[i].context);
                find_errors(input, roots, &errors->rows[run->section.rows[i]]);
            }
        }
        isa_end(run);
    }
    status = status == BURNISH_STATUS_OK && !run ? BURNISH_STATUS_MEMORY : status;
    free(run);
    burnish_bench_input_destroy(input);
    return status;
}
