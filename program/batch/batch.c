/* `burnish batch`: flags and main steps. */
#include "batch/batch.h"
#include "batch/inputs.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/cli/output.h"
#include "base/cli/platform.h"
#include "base/clock.h"
#include "cli/main.h"
#include "picture/formats.h"
#include "render/flags.h"
#include "render/render.h"
#include "render/useless.h"
#include "sandbox/lock.h"

static cli_work batch_work;
static cli_handler flag_part;

#define TARGET(member) .offset = offsetof(batch_settings, member)

static const cli_word unit_words[] = {{"none", 0}, {"um", 1}, {"mm", 2}, {"cm", 3},
                                      {"m", 4},    {"in", 5}, {"ft", 6}, {NULL, 0}};

static const cli_flag flags[] = {
    {.group = "Many inputs",
     .topic = "batch",
     CLI_FLAG("output-dir", "FOLDER", "folder of the pictures", cli_flag_text, output_dir),
     .default_text = ".",
     .letter = 'd',
     .common = 1,
     .file = CLI_FOLDER,
     .aliases = "outdir,out-dir,path",
     .manual = "The folder of all pictures, created if missing. Only *--report* and *--sheet* can "
               "write files outside it; a name without a folder is in it, too."},
    {CLI_FLAG("output", "NAME", "file names: {model} {folder} {extension} {view}", cli_flag_text,
              output),
     .default_text = "{folder}{model}.png", .letter = 'o', .common = 1, .file = CLI_WRITES,
     .aliases = "out,template",
     .manual = "Names of the pictures in the folder. *{model}* is the input's name without its "
               "extension, *{extension}* the extension, *{folder}* its folders below the _INPUT_ "
               "folder, with a slash at the end, *{view}* the view: each of *--views* then has a "
               "picture of its own. The extension selects the format, as in *burnish render*. If "
               "two inputs would share a picture, the names keep their extensions (*part.stl.png*) "
               "and, if necessary, all folders."},
    {CLI_SWITCH("recursive", "include subfolders", recursive), .letter = 'r', .common = 1,
     .manual = "Includes the meshes in all subfolders of an _INPUT_ folder. Names that begin with "
               "a dot and links to folders are skipped."},
    {CLI_FLAG("files-from", "FILE",
              "list of inputs, one per line or separated by 0; -: standard input", cli_flag_text,
              files_from),
     .common = 1, .file = CLI_READS, .aliases = "inputs-from,files0-from,from-file",
     .manual =
         "Reads names of inputs from _FILE_, or from standard input for *-*: one per line or, if "
         "the list contains a byte 0, each followed by a 0, as *find -print0* prints them."},
    {CLI_SWITCH("index", "write index.html, a page with search", index), .common = 1,
     .manual = "Writes *index.html* to the output folder: a page with all pictures, facts about "
               "the meshes and a search box. It loads only the pictures. A file of that name that "
               "burnish did not write is replaced only with *--overwrite*."},
    {CLI_FLAG("title", "TEXT", "title of the page", cli_flag_text, title),
     .default_label = "the folder's name", .manual = "Title of *index.html*."},
    {CLI_SWITCH("facts", "measure volume, area and defects", render.input.measure),
     .phases = CLI_PHASE_LOAD, .common = 1, .aliases = "measure,volume,info",
     .manual = "Measures each mesh as *burnish info* does, and adds the results to the report and "
               "to *index.html*, which can then be sorted by volume, area and defects. Meshes that "
               "are not closed get a badge."},
    {CLI_FLAG("unit", "NAME", "unit of files that state none", cli_flag_word, unit),
     .words = unit_words, .default_text = "none",
     .manual =
         "Unit of length of files that state none, such as STL, for *index.html*: volumes are then "
         "in cm3, or in cubic inches for *in* and *ft*. Files in 3MF and glTF state their unit."},
    {CLI_FLAG("sheet", "FILE", "write a contact sheet", cli_flag_text, sheet), .common = 1,
     .file = CLI_WRITES, .aliases = "contact-sheet,montage",
     .manual =
         "Writes a contact sheet of all pictures, scaled down to at most 16384 pixels per side. "
         "*--columns* sets its columns, unless the pictures are sheets of views or lobes."},
    {CLI_FLAG("report", "FILE", "report in JSON lines, in the output folder", cli_flag_text,
              report),
     .default_label = "burnish-batch.jsonl", .common = 1, .file = CLI_REPORTS,
     .aliases = "json,log,state",
     .manual = "File name of the report, one JSON object per line; see *REPORT OF A BATCH*. *-* "
               "prints it at the end; the next run then draws everything."},
    {CLI_SWITCH("force", "draw unchanged inputs again", force), .letter = 'f', .common = 1,
     .manual = "Draws all pictures again. By default an input is skipped if its picture exists and "
               "the report lists it with the same content, the same content of files that it or a "
               "flag names, the same flags and the same version."},
    {CLI_FLAG("shard", "I/N", "draw part I of N, balanced by file size", flag_part, part),
     .common = 1, .aliases = "part,partition,array",
     .manual =
         "Draws part _I_ of _N_, counted from 1, for independent tasks such as a job array. All "
         "tasks must see the same inputs, which are divided by size. The report is "
         "*burnish-batch-*_I_*-of-*_N_*.jsonl*. Afterwards the same command without *--shard* "
         "draws what is missing, merges the reports and removes those of the parts.\n"
         "*--shard=rank* takes _I_ and _N_ from *mpirun* or *srun*, which has started the program. "
         "The exit code is then 0 even if inputs fail, because *mpirun* would end the other ranks; "
         "that of the last command counts."},
    {CLI_FLAG("jobs", "N", "pictures at a time", cli_flag_integer, jobs), CLI_RANGE(0, 1024),
     .default_text = "0", .default_label = "all cores", .letter = 'j', .common = 1,
     .aliases = "threads,parallel",
     .manual = "How many pictures are drawn at a time, each by one thread; 0 for as many as there "
               "are processors. It does not affect the pictures."},
    {CLI_FLAG("max-seconds", "N", "time limit per picture", cli_flag_real, render.job.max_seconds),
     CLI_RANGE(0, 1e6), .default_text = "60", .common = 1,
     .manual = "An input that takes more processor time fails, or ten times that in wall-clock "
               "time. 0: no limit."},
    {CLI_FLAG("max-memory", "N", "memory limit per picture, such as 500M", cli_flag_bytes,
              render.job.max_memory),
     CLI_RANGE(1, 9e18), .default_text = "2G", .common = 1,
     .manual = "An input that needs more memory fails. The total is at most this times *--jobs*. "
               "_N_ may end in *K*, *M* or *G*."},
    {CLI_SWITCH("no-sandbox", "workers may open files", no_sandbox),
     .manual =
         "Each input is read and drawn in a process of its own. If the program was built with "
         "libseccomp, that process can't open files (docs/security.md). With this flag it can; the "
         "next run then does not check referenced textures and material libraries for changes."},
    {CLI_SWITCH("no-seconds", "omit times from the report", no_seconds),
     .manual =
         "Leaves *seconds* out of the report, which is then identical on every run and machine."},
    {.group = "Picture",
     .topic = "picture",
     CLI_FLAG("size", "WxH", "width and height in pixels; N: a square", cli_flag_size,
              render.picture.size),
     .phases = CLI_PHASE_DRAW,
     CLI_RANGE(1, BURNISH_IMAGE_MAX_SIZE),
     .letter = 's',
     .default_text = "512x512",
     .common = 1,
     .also = "resolution",
     .aliases = "res",
     .manual = "Width and height of each picture."},
};

static const cli_example examples[] = {
    {"burnish batch parts --recursive -d thumbs --index", "a folder of models, and a page"},
    {"burnish batch *.stl --size=256 -d thumbs", "thumbnails"},
    {"burnish batch *.obj --views=front,top -o {model}_{view}.png", "a picture per view"},
    {"burnish batch parts -r -d thumbs --shard=3/100", "one of 100 tasks"},
    {"find . -name *.glb -print0 | burnish batch --files-from=- -d out", "a list of names"},
    {NULL, NULL},
};

static const cli_term report_terms[] = {
    {"*burnish, options*", "in the first line: the version, and the flags that affect pictures"},
    {"*options_hash*", "in the first line, if such flags name files: XXH64 of their bytes"},
    {"*passed_over*", "in the first line, if not 0: number of files in folders with a mesh "
                      "extension and other content, and of archives without exactly one model"},
    {"*id*", "hash of the names of input and output, 16 hexadecimal digits"},
    {"*input, output*", "names; bytes that are not UTF-8 are ?"},
    {"*input_bytes, output_bytes*",
     "a name that is not UTF-8, with such bytes as %XX, as in a URL"},
    {"*status, code, error*",
     "as *burnish render --json* has them; the keys from *input_hash* on are those of a picture"},
    {"*bytes, input_hash*", "of the input: its size, and XXH64 of its bytes"},
    {"*format, triangles, vertices, size*",
     "of the mesh; *size* along X, Y and Z, for points and lines without their drawn thickness"},
    {"*unit*", "of lengths, if the input states it"},
    {"*volume, area, closed, solid, open_edges, shells*",
     "with *--facts*, as *burnish info --json* has them; missing for points and lines"},
    {"*plates, filaments*", "of a print project, as *burnish info --json* has them, at most 64"},
    {"*width, height, hash, blank, legible, warnings*", "as *burnish render --json* has them"},
    {"*files, files_hash*", "files that the input names; XXH64 over names and bytes"},
    {"*seconds*", "*total*: wall-clock time, the only value that differs between runs"},
    {NULL, NULL},
};

static const cli_section sections[] = {
    {.heading = "REPORT OF A BATCH",
     .text = "JSON lines in the order of the inputs; an unchanged input keeps its line from the "
             "run that drew it. Lines are added as pictures are finished, so an interrupted batch "
             "can be continued.",
     .terms = report_terms},
    {.heading = NULL},
};

const cli_command batch_command = {
    .name = "batch",
    .aliases = "montage,mogrify",
    .operand = "INPUT...",
    .summary = "draw many meshes, on all cores",
    .operand_help = "files, built-in objects such as :teapot, or folders of meshes",
    .manual =
        "Draws a picture of each _INPUT_, with the same bytes as *burnish render --sandbox* would. "
        "Each input has its own process, time limit and memory limit. Failed inputs are listed at "
        "the end and do not stop the batch; the exit code is then 11. Pictures whose input and "
        "flags have not changed since the last run are skipped. Control-C stops at once and keeps "
        "finished pictures. A flag that needs a property of the input, such as *--animation*, is a "
        "warning at the end if it had no effect on any picture of this run.\n"
        "The flags of *burnish render* for camera, light, surface and input have the same meaning "
        "here.",
    .operands_max = SIZE_MAX,
    .flags = flags,
    .flag_count = sizeof flags / sizeof *flags,
    .base = &render_command,
    .base_phases = CLI_PHASE_LOAD | CLI_PHASE_DRAW | CLI_PHASE_FILE | CLI_PHASE_PROCESS,
    .heir = HEIR_BATCH,
    .examples = examples,
    .sections = sections,
    .settings_size = sizeof(batch_settings),
    .given = offsetof(batch_settings, given),
    .work = batch_work,
};

/* ---- Work ---- */

/* Returns 0 if this is no part. */
static int set_part(batch_part *part, double index, double count, int is_rank) {
    if (!(index >= 1 && index <= count && count <= 1e6) || index != (double)(int)index ||
        count != (double)(int)count) {
        return 0;
    }
    *part = (batch_part){(int)index, (int)count, is_rank};
    return 1;
}

/* Takes the rank and the number of ranks from what Open MPI's mpirun, MPICH's or srun has set. */
static int find_rank(batch_part *part) {
    static const char *const names[][2] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                           {"PMI_RANK", "PMI_SIZE"},
                                           {"SLURM_PROCID", "SLURM_STEP_NUM_TASKS"}};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        const char *rank = getenv(names[i][0]), *size = getenv(names[i][1]);
        if (rank && size) {
            double index, count;
            return cli_read_real(rank, strlen(rank), &index) &&
                   cli_read_real(size, strlen(size), &count) && set_part(part, index + 1, count, 1);
        }
    }
    return 0;
}

static burnish_status flag_part(const cli_flag *flag, const char *text, void *target,
                                burnish_error *error) {
    batch_part *part = target;
    if (strcmp(text, "rank") == 0) {
        return find_rank(part) ? BURNISH_STATUS_OK
                               : cli_fail(error, BURNISH_STATUS_ARGUMENT,
                                          "--%s: neither mpirun nor srun has set a rank; start "
                                          "burnish with one of them, or give I/N, such as 3/100",
                                          flag->name);
    }
    const char *slash = strchr(text, '/');
    double index, count;
    if (!slash || !cli_read_real(text, (size_t)(slash - text), &index) ||
        !cli_read_real(slash + 1, strlen(slash + 1), &count) || !set_part(part, index, count, 0)) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "--%s: \"%.60s\": expected I/N with 1 <= I <= N <= 1000000, such as 3/100, or rank",
            flag->name, text);
    }
    return BURNISH_STATUS_OK;
}

#ifdef _WIN32

static burnish_status batch_work(void *from, cli_call *call, burnish_error *error) {
    (void)from, (void)call;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "batch: not supported on this system; run burnish render for each input");
}

#else

/* Whether a flag affects pictures. */
static int is_about_pictures(const cli_flag *flag) {
    return flag->phases != 0 && !(flag->phases & CLI_PHASE_PROCESS);
}

/* Lists the flags that affect pictures, and hashes the files that they name. b->options stays NULL
 * without memory. */
static void list_options(batch *b, const cli_call *call) {
    size_t size = 0;
    FILE *stream = cli_open_memory(&b->options, &size);
    if (!stream) {
        return;
    }
    for (size_t i = 0; i < call->argument_count; ++i) {
        const cli_argument *argument = &call->arguments[i];
        uint64_t hash;
        if (!argument->flag || !is_about_pictures(argument->flag)) {
            continue;
        }
        fprintf(stream, "%s--%s%s%s", ftell(stream) > 0 ? " " : "", argument->flag->name,
                argument->text ? "=" : "", argument->text ? argument->text : "");
        if (argument->flag->file == CLI_READS &&
            batch_hash_file(argument->text, &hash, b->options_hash)) { /* not "sky" */
            b->options_hash = hash;
        }
    }
    if (cli_close_memory(stream, &b->options, &size) != 0) {
        free(b->options);
        b->options = NULL;
    }
}

static char *choose_report(const batch_settings *settings) {
    const batch_part *part = &settings->part;
    char name[64] = "burnish-batch.jsonl";
    if (settings->report) {
        return strdup(settings->report);
    }
    if (part->count > 0) {
        snprintf(name, sizeof name, "burnish-batch-%d-of-%d.jsonl", part->index, part->count);
    }
    return cli_join_path(settings->output_dir, name);
}

/* The settings of one picture, which can show one of several views. */
static render_settings first_picture(const batch_settings *given) {
    render_settings settings = given->render;
    settings.input.name = ":sphere";
    settings.output.path = given->output;
    settings.picture.is_on_sheet = given->sheet != NULL;
    if (strstr(given->output, "{view}") && settings.picture.views.count > 1) {
        settings.picture.views.count = 1;
    }
    return settings;
}

/* Checks the settings once, before any input. */
static burnish_status batch_check(batch_settings *given, burnish_error *error) {
    render_settings settings = first_picture(given);
    picture_format unused;
    if (*given->output_dir == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--output-dir: the name is empty");
    }
    if (strcmp(given->output, "-") == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--output: a batch can't write to standard output; leave it out");
    }
    if (given->part.count > 0 && (given->index || given->sheet)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--shard: not with --index or --sheet; after all parts, run the same "
                        "command without --shard to write them");
    }
    burnish_status status = render_finish(&settings, error);
    given->render.output.format = settings.output.format; /* the name of an input can have dots */
    if (status == BURNISH_STATUS_OK && given->sheet) {
        status = picture_choose("sheet", given->sheet, PICTURE_8_BIT, PICTURE_AUTO, &unused, error);
    }
    if (status == BURNISH_STATUS_OK && given->sheet &&
        (settings.output.format == PICTURE_EXR || settings.output.format == PICTURE_NPY ||
         picture_is_drawing((picture_format)settings.output.format))) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--sheet: needs pictures in PNG, JPEG or WebP; see --output");
    }
    return status;
}

/* Prints the error of a failed input, preceded by its name. */
static void print_failure(const batch_item *item) {
    cJSON *line = item->line ? cJSON_Parse(item->line) : NULL;
    cJSON *text = cJSON_GetObjectItemCaseSensitive(line, "error");
    char memory[] = "out of memory", *message = cJSON_IsString(text) ? text->valuestring : memory;
    char *input = strdup(item->input);
    cli_clean(message);
    if (input) {
        cli_clean(input);
    }
    if (!input || strncmp(message, input, strlen(input)) == 0) {
        fprintf(stderr, "burnish: %s\n", message);
    } else {
        fprintf(stderr, "burnish: %s: %s\n", input, message);
    }
    cJSON_Delete(line);
    free(input);
}

static void list_failures(const batch *b) {
    for (size_t i = 0; i < b->list.count; ++i) {
        if (b->list.items[i].has_failed) {
            print_failure(&b->list.items[i]);
        }
    }
    if (b->failed > 0) {
        fprintf(stderr, "burnish: %zu of %zu failed\n", b->failed, b->list.count);
    }
}

/* Warns about pictures of which a warning in their lines says that they hardly show the object. */
static void warn_illegible(const batch *b) {
    const char *first = NULL;
    size_t count = 0;
    for (size_t i = b->list.count; i-- > 0;) {
        const batch_item *item = &b->list.items[i];
        if (item->line && strstr(item->line, "\"legible\":false")) {
            first = item->output;
            ++count;
        }
    }
    if (first && !b->settings->render.job.quiet) {
        burnish_error text;
        cli_fail(&text, BURNISH_STATUS_OK,
                 "%zu of %zu pictures are blank, nearly black, like their background, or specks, "
                 "such as %.200s; %s for the reason",
                 count, b->list.count, first,
                 b->report ? "see its line in the report" : "draw it alone");
        cli_warn(text.text);
    }
}

static void print_summary(const batch *b, double seconds) {
    const size_t drawn = b->done - b->kept - b->failed;
    if (b->is_stopped) {
        fprintf(stderr, "burnish: stopped: %zu of %zu are done; the same command goes on\n",
                b->done, b->list.count);
    } else if (!b->settings->render.job.quiet && isatty(STDERR_FILENO)) {
        fprintf(stderr, "burnish: %zu drawn in %.1f s (%.0f per second), %zu unchanged\n", drawn,
                seconds, (double)drawn / (seconds > 0 ? seconds : 1), b->kept);
    }
}

/* Flags in vain: before drawing about other flags and the list of inputs, then those that had no
 * effect on any input that was drawn. */
static burnish_status warn_useless(const batch *b, int is_drawn, burnish_error *error) {
    const batch_settings *settings = b->settings;
    const int strict = settings->render.input.load.strict, quiet = settings->render.job.quiet;
    const cli_need own[] = {
        {"title,unit", settings->index, "only the page shows it; use --index"},
        {"recursive", b->folders > 0, "no INPUT is a folder; omit the flag"},
    };
    const render_settings picture = first_picture(settings);
    cli_need needs[RENDER_NEEDS_MAX];
    const size_t count = is_drawn ? render_list_input_needs(&picture, NULL, needs)
                                  : render_list_needs(&picture, needs);
    for (size_t i = 0; is_drawn && i < count; ++i) {
        needs[i].is_met = !(b->unmet >> i & 1) || b->done == b->kept + b->failed;
    }
    burnish_status status = is_drawn
                                ? BURNISH_STATUS_OK
                                : cli_check_needs(&batch_command, settings, own,
                                                  sizeof own / sizeof *own, strict, quiet, error);
    return status == BURNISH_STATUS_OK ? cli_check_needs(&render_command, &settings->render, needs,
                                                         count, strict, quiet, error)
                                       : status;
}

/* Neither the report nor the sheet is one of the pictures, and sheet and page replace only their like. */
static burnish_status check_other_files(batch *b, burnish_error *error) {
    const char *paths[] = {b->report, b->settings->sheet}, *names[] = {"report", "sheet"};
    for (size_t k = 0; k < sizeof paths / sizeof *paths; ++k) {
        const char *last = paths[k] ? cli_base_name(paths[k]) : "";
        for (size_t i = 0; i < b->list.count && *last; ++i) {
            const char *picture = b->list.items[i].output;
            if (strcmp(cli_base_name(picture), last) == 0 && cli_same_output(picture, paths[k])) {
                return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                                "--%s: \"%.200s\" is a picture of this batch; name another file",
                                names[k], paths[k]);
            }
        }
    }
    burnish_error unused;
    if (b->settings->sheet && !b->settings->render.output.overwrite &&
        picture_check_existing(b->settings->sheet, 1, &unused) != BURNISH_STATUS_OK) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--sheet: \"%.200s\" exists and was not written by burnish; replace it "
                        "with --overwrite, or name another file",
                        b->settings->sheet);
    }
    return b->settings->index ? batch_check_index(b, error) : BURNISH_STATUS_OK;
}

static burnish_status warn_before(batch *b, burnish_error *error) {
    return warn_useless(b, 0, error);
}

static burnish_status make_report_folder(batch *b, burnish_error *error) {
    return !b->report || batch_make_folders(b->report)
               ? BURNISH_STATUS_OK
               : cli_fail(error, BURNISH_STATUS_WRITE, "%.300s: no folder for it: %s", b->report,
                          strerror(errno));
}

static burnish_status write_others(batch *b, burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    if (b->settings->index && !b->is_stopped) {
        status = batch_write_index(b, error);
    }
    if (status == BURNISH_STATUS_OK && b->settings->sheet && !b->is_stopped) {
        status = batch_write_sheet(b, error);
    }
    if (status == BURNISH_STATUS_OK && !b->is_stopped) {
        batch_remove_past_parts(b);
    }
    return status;
}

static burnish_status draw_all(batch *b, batch_settings *settings, const cli_call *call,
                               burnish_error *error) {
    static burnish_status (*const steps[])(batch * b, burnish_error * error) = {
        batch_name_outputs, batch_take_part, check_other_files,  warn_before, make_report_folder,
        batch_read_past,    batch_run,       batch_write_report, write_others};
    const double start = burnish_seconds_now();
    burnish_status status = batch_check(settings, error);
    if (status == BURNISH_STATUS_OK) {
        status = batch_collect(b, call, error);
    }
    for (size_t i = 0; i < sizeof steps / sizeof *steps && status == BURNISH_STATUS_OK; ++i) {
        status = steps[i](b, error);
    }
    if (status == BURNISH_STATUS_OK) {
        batch_warn_inputs(b);
        list_failures(b);
        warn_illegible(b);
        print_summary(b, burnish_seconds_now() - start);
        status = warn_useless(b, 1, error);
    }
    return status;
}

static void batch_release(batch *b) {
    for (size_t i = 0; i < b->list.count; ++i) {
        free(b->list.items[i].input);
        free(b->list.items[i].output);
        free(b->list.items[i].line);
    }
    free(b->list.items);
    batch_release_past(&b->past);
    free(b->options);
    free(b->report);
}

burnish_status batch_draw(batch_settings *settings, cli_call *call, burnish_error *error) {
    settings->render.job.sandbox = sandbox_is_built() && !settings->no_sandbox;
    batch b = {.settings = settings,
               .unmet = ~0U,
               .report = settings->has_no_report ? NULL : choose_report(settings)};
    list_options(&b, call);
    burnish_status status = b.options && (b.report || settings->has_no_report)
                                ? draw_all(&b, settings, call, error)
                                : cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory");
    const int signal_number = status == BURNISH_STATUS_OK ? b.is_stopped : 0;
    call->exit_code = b.failed > 0 && !settings->part.is_rank ? CLI_EXIT_SOME_FAILED : 0;
    batch_release(&b);
    if (signal_number) {
        signal(signal_number, SIG_DFL);
        raise(signal_number);
    }
    return status;
}

/* A file of the batch: a name without a folder is in the folder of the pictures. NULL: no file, or
 * no memory. */
static char *place_file(const batch_settings *settings, const char *name) {
    return !name ? NULL
           : strchr(name, '/') || strcmp(name, "-") == 0
               ? strdup(name)
               : cli_join_path(settings->output_dir, name);
}

static burnish_status batch_work(void *from, cli_call *call, burnish_error *error) {
    batch_settings *settings = from;
    char *report = place_file(settings, settings->report),
         *sheet = place_file(settings, settings->sheet);
    const int is_short = (settings->report && !report) || (settings->sheet && !sheet);
    settings->report = report;
    settings->sheet = sheet;
    const burnish_status status = is_short ? cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory")
                                           : batch_draw(settings, call, error);
    free(report);
    free(sheet);
    return status;
}

#endif
