/* bench_kernels: the kernels against their alternatives, on this machine. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bench/kernels/kernels.h"
#include "cli/output.h"
#include "cli/run.h"
#include "cli/values.h"

typedef struct bench_settings {
    const char *isa; /* NULL: all */
    int quick, json;
    const char *csv;
} bench_settings;

static cli_work bench_work;

static const cli_flag flags[] = {
    {.group = "Options",
     .name = "isa",
     .value = "NAME",
     .help = "one instruction set: auto, scalar, sse2, avx2, avx512, neon",
     .default_label = "all",
     .manual = "Measures the kernels of one instruction set: *auto* for the fastest, *scalar*, "
               "*sse2*, *avx2*, *avx512* or *neon*.",
     .handler = cli_flag_text,
     .offset = offsetof(bench_settings, isa)},
    {.name = "quick",
     .help = "fewer rounds, smaller arrays: seconds, and noisier",
     .manual = "Fewer and shorter rounds, and arrays of 128 MiB in memory instead of 512 MiB.",
     .handler = cli_flag_switch,
     .offset = offsetof(bench_settings, quick)},
    {.name = "json",
     .help = "one JSON object on standard output",
     .manual = "Prints the ratios as one JSON object instead of tables.",
     .handler = cli_flag_switch,
     .offset = offsetof(bench_settings, json)},
    {.name = "csv",
     .value = "FILE",
     .help = "write every row into a file as well",
     .manual = "Writes every row also into _FILE_ as comma-separated values.",
     .handler = cli_flag_text,
     .offset = offsetof(bench_settings, csv)},
};

static const cli_command command = {
    .name = "bench_kernels",
    .alone = 1,
    .operand = "",
    .summary = "time the kernels against pow, Schlick, tables and copies",
    .manual =
        "Times the m = 2 lobe of the kernels and its alternatives, taking turns in one "
        "run: a copy, m = 4, Schlick with a true division, squarings, a table, a tuned vector "
        "pow, SLEEF's and libmvec's powf (opened when they are installed) and libm's; over 2,048 "
        "floats in the first cache, from memory, and inside the whole lighting equation. Numbers "
        "are medians; no thread is pinned to a core.\n"
        "In the JSON object *isa* has an object for each instruction set, with the keys "
        "*lobe.l1.X_over*, *shade.directional.X_over*, *shade.point.X_over* and "
        "*root.l1.X_over*: X's time divided by the lobe's, larger being better for the lobe; "
        "*square.X_over* is the time of a square light in reach divided by whole lighting by a "
        "point "
        "light; *lobe.l1.over_copy* and *lobe.memory.over_nt_copy* are the lobe's time divided by "
        "the "
        "copy's. *SECTION.X_ns* is the time of one element in nanoseconds. The object *scalar* has "
        "*scalar.latency.X_over* and *scalar.throughput.X_over* of code that takes one value at a "
        "time, and *paper.latency.over_w*, *paper.latency.over_w_half* and the same of "
        "*paper.throughput*: Schlick's time divided by that of the paper's W and W_0.5, all from a "
        "whole exponent that is read anew for each value. What could not be measured is null, and "
        "*missing* says why. *machine*, *compiler*, "
        "*rounds* and *array_bytes* (of each array in memory) describe the run.",
    .operands_max = 0,
    .flags = flags,
    .flag_count = sizeof flags / sizeof *flags,
    .settings_size = sizeof(bench_settings),
    .work = bench_work,
};

/* The reference row and the bare loop have no ratio. */
static int has_ratio(const burnish_bench_table *table, int i) {
    const burnish_bench_row *row = &table->rows[i];
    int is_first = i == 0 || strcmp(table->rows[i - 1].section, row->section) != 0;
    return !is_first && strcmp(row->name, "loop") != 0;
}

static void print_table(const burnish_bench_table *table) {
    static const struct {
        const char *section, *text;
    } TITLES[] = {{"lobe.l1", "lobes, 2,048 floats in the first cache, n = 32"},
                  {"lobe.memory", "lobes, arrays in memory"},
                  {"shade.directional", "whole lighting, directional light, distant viewer"},
                  {"shade.point", "whole lighting, point light, local viewer"},
                  {"square", "a square light in reach, diffuse and specular"},
                  {"root.l1", "inverse square roots, 2,048 floats in the first cache"},
                  {"scalar.latency", "one value at a time: latency"},
                  {"scalar.throughput", "one value at a time: throughput"},
                  {"paper.latency", "the paper's forms: latency (2.3 W, 1.69 W_0.5)"},
                  {"paper.throughput", "the paper's forms: throughput (2.3 W, 1.69 W_0.5)"}};
    for (int i = 0; i < table->count; ++i) {
        const burnish_bench_row *row = &table->rows[i];
        const int is_paper = strncmp(row->section, "paper", 5) == 0;
        const int has_cycles = is_paper || strncmp(row->section, "scalar", 6) == 0;
        if (i == 0 || strcmp(table->rows[i - 1].section, row->section) != 0) {
            const char *title = row->section;
            for (size_t k = 0; k < sizeof TITLES / sizeof *TITLES; ++k) {
                title = strcmp(TITLES[k].section, row->section) == 0 ? TITLES[k].text : title;
            }
            printf("  %-50s %8s %8s%s\n", title, "ns", is_paper ? "faster" : "x lobe",
                   has_cycles ? "   cycles" : "");
        }
        if (row->missing) {
            printf("    %-48s %8s %8s\n", row->label, "-", "-");
            continue;
        }
        /* what a copy costs; how much faster than Schlick the paper's forms are */
        double over = row->is_inverse && !is_paper ? 1 / row->ratio : row->ratio;
        printf("    %-48s %8.4f %8.2f", row->label, row->nanoseconds, over);
        printf(has_cycles && row->cycles == row->cycles ? " %8.2f\n" : "\n", row->cycles);
    }
}

static void print_missing(const burnish_bench_report *report) {
    const char *said[8];
    int count = 0;
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        const burnish_bench_table *table = &report->isa[isa];
        for (int i = 0; report->has_isa[isa] && i < table->count; ++i) {
            const char *reason = table->rows[i].missing;
            int known = !reason || count == 8;
            for (int k = 0; !known && k < count; ++k) {
                known = strcmp(said[k], reason) == 0;
            }
            if (!known) {
                printf("-: %s\n", reason);
                said[count++] = reason;
            }
        }
    }
}

static void print_text(const burnish_bench_report *report) {
    const burnish_bench_machine *machine = &report->machine;
    printf("%s; caches %zu KiB, %zu KiB, %zu KiB; %s\n", machine->processor,
           machine->cache_bytes[0] / 1024, machine->cache_bytes[1] / 1024,
           machine->cache_bytes[2] / 1024, machine->compiler);
    printf("Medians of %d rounds, taking turns; arrays in memory %zu MiB each; no thread "
           "is pinned.\n",
           report->rounds, report->array_bytes >> 20);
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        if (report->has_isa[isa]) {
            printf("\n%s\n", burnish_isa_name((burnish_isa)isa));
            print_table(&report->isa[isa]);
        }
    }
    printf("\nscalar code\n");
    print_table(&report->scalar);
    print_missing(report);
}

/* Times and ratios are accurate to fewer than five digits. */
static cJSON *number(double value) {
    char text[32];
    snprintf(text, sizeof text, "%.5g", value);
    return value - value == 0 ? cJSON_CreateRaw(text) : cJSON_CreateNull();
}

static cJSON *table_object(const burnish_bench_table *table, cJSON *missing, int *failed) {
    cJSON *object = cJSON_CreateObject();
    for (int i = 0; object && i < table->count; ++i) {
        const burnish_bench_row *row = &table->rows[i];
        char key[96];
        if (has_ratio(table, i)) {
            burnish_bench_key(row, key, sizeof key);
            cli_json_add(object, key, number(row->ratio), failed);
            if (row->missing && !cJSON_GetObjectItemCaseSensitive(missing, key)) {
                cli_json_add(missing, key, cJSON_CreateString(row->missing), failed);
            }
        }
        snprintf(key, sizeof key, "%s.%s_ns", row->section, row->name);
        cli_json_add(object, key, number(row->nanoseconds), failed);
        if (row->cycles == row->cycles) {
            snprintf(key, sizeof key, "%s.%s_cycles", row->section, row->name);
            cli_json_add(object, key, number(row->cycles), failed);
        }
    }
    return object;
}

static cJSON *machine_object(const burnish_bench_machine *machine, int *failed) {
    static const char *const KEYS[] = {"cache_l1_bytes", "cache_l2_bytes", "cache_l3_bytes"};
    cJSON *object = cJSON_CreateObject();
    cli_json_add(object, "processor", cJSON_CreateString(machine->processor), failed);
    for (int i = 0; i < 3; ++i) {
        cli_json_add(object, KEYS[i], cli_json_count(machine->cache_bytes[i]), failed);
    }
    return object;
}

static burnish_status print_json(FILE *stream, const burnish_bench_report *report,
                                 burnish_error *error) {
    int failed = 0;
    cJSON *root = cJSON_CreateObject(), *isas = cJSON_CreateObject();
    cJSON *missing = cJSON_CreateObject();
    cli_json_add(root, "burnish", cJSON_CreateString(burnish_version()), &failed);
    cli_json_add(root, "machine", machine_object(&report->machine, &failed), &failed);
    cli_json_add(root, "compiler", cJSON_CreateString(report->machine.compiler), &failed);
    cli_json_add(root, "rounds", cJSON_CreateNumber(report->rounds), &failed);
    cli_json_add(root, "array_bytes", cli_json_count(report->array_bytes), &failed);
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        if (report->has_isa[isa]) {
            cli_json_add(isas, burnish_isa_name((burnish_isa)isa),
                         table_object(&report->isa[isa], missing, &failed), &failed);
        }
    }
    cli_json_add(root, "isa", isas, &failed);
    cli_json_add(root, "scalar", table_object(&report->scalar, missing, &failed), &failed);
    cli_json_add(root, "missing", missing, &failed);
    return cli_json_print(stream, root, failed, error);
}

static void write_number(FILE *file, double value) {
    char text[32] = "";
    if (value == value) {
        snprintf(text, sizeof text, "%.5g", value);
    }
    fprintf(file, ",%s", text);
}

static void write_rows(FILE *file, const char *isa, const burnish_bench_table *table) {
    for (int i = 0; i < table->count; ++i) {
        const burnish_bench_row *row = &table->rows[i];
        fprintf(file, "%s,%s,%s,", isa, row->section, row->name);
        cli_csv_text(file, row->label);
        write_number(file, row->nanoseconds);
        write_number(file, row->cycles);
        write_number(file, has_ratio(table, i) ? row->ratio : NAN);
        fputc('\n', file);
    }
}

static void write_fact(FILE *file, const char *name, const char *text) {
    fprintf(file, "run,machine,%s,", name);
    cli_csv_text(file, text);
    fprintf(file, ",,,\n");
}

static void write_size(FILE *file, const char *name, size_t count, const char *unit) {
    char text[40];
    snprintf(text, sizeof text, "%zu%s", count, unit);
    write_fact(file, name, text);
}

static burnish_status write_csv(const burnish_bench_report *report, const char *path,
                                burnish_error *error) {
    static const char *const caches[] = {"cache_l1", "cache_l2", "cache_l3"};
    const burnish_bench_machine *machine = &report->machine;
    cli_output output;
    burnish_status status = cli_output_begin(&output, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    FILE *file = output.stream;
    fprintf(file, "isa,section,name,label,nanoseconds,cycles,ratio\n");
    write_fact(file, "processor", machine->processor);
    write_fact(file, "compiler", machine->compiler);
    for (int i = 0; i < 3; ++i) {
        write_size(file, caches[i], machine->cache_bytes[i] / 1024, " KiB");
    }
    write_size(file, "rounds", (size_t)report->rounds, "");
    write_size(file, "array", report->array_bytes >> 20, " MiB");
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        if (report->has_isa[isa]) {
            write_rows(file, burnish_isa_name((burnish_isa)isa), &report->isa[isa]);
        }
    }
    write_rows(file, "code", &report->scalar);
    return cli_output_end(&output, path, BURNISH_STATUS_OK, error);
}

static burnish_status bench_work(void *from, cli_call *call, burnish_error *error) {
    const bench_settings *settings = from;
    burnish_bench_settings bench = {.quick = settings->quick, .isa_mask = ~0u};
    (void)call;
    if (settings->isa) {
        burnish_isa isa;
        burnish_status status = cli_choose_isa(settings->isa, &isa, error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        bench.isa_mask = 1u << isa;
    }
    burnish_bench_report *report = malloc(sizeof *report);
    if (!report) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the report");
    }
    burnish_status status = burnish_bench_run(&bench, report, error);
    if (status == BURNISH_STATUS_OK && settings->csv) {
        status = write_csv(report, settings->csv, error);
    }
    if (status == BURNISH_STATUS_OK && settings->json) {
        status = print_json(stdout, report, error);
    } else if (status == BURNISH_STATUS_OK) {
        print_text(report);
    }
    free(report);
    return status;
}

int main(int argc, char **argv) {
    cli_handle_signals();
    return cli_run(&command, argc - 1, argv + 1);
}
