/* `burnish info`: size, volume and validity of a mesh, as text or JSON. */
#include <stdlib.h>
#include <sys/stat.h>

#include "base/cli/output.h"
#include "batch/inputs.h"
#include "cli/contents.h"
#include "cli/input.h"
#include "cli/main.h"
#include "import/load_input.h"
#include "info/facts.h"
#include "render/scene/join_inputs.h"

typedef struct info_settings {
    cli_input load;
    const char *json, *csv; /* files; NULL: text on standard output */
    const char *files_from;
    int recursive, threads, quiet, scene_box;
    cli_given given;
} info_settings;

static cli_work work;

#define TARGET(member) .offset = offsetof(info_settings, member)

static const cli_flag flags[] = {
    {.group = "Options",
     CLI_JSON_FLAG(info_settings, json, "JSON instead of text", "FACTS IN JSON")},
    {CLI_FLAG("csv", "FILE", "a table in CSV instead of text", cli_flag_file, csv), .common = 1,
     .optional = 1, .file = CLI_REPORTS, .aliases = "table",
     .manual = "Writes a row for each input to _FILE_, or to standard output without *=*_FILE_. "
               "The columns have the names of the keys in JSON; *size* has three columns. A row of "
               "an input that can not be read has only input and error."},
    {CLI_SWITCH("recursive", "search folders recursively", recursive), .letter = 'r', .common = 1,
     .manual = "Measures the meshes in all folders below an _INPUT_ that is a folder."},
    {CLI_FLAG("files-from", "FILE", "read names of INPUTs; -: standard input", cli_flag_text,
              files_from),
     .file = CLI_READS, .aliases = "inputs-from,files0-from,from-file",
     .manual = "Reads names of inputs from _FILE_, as *burnish batch* does."},
    {CLI_INPUT_FORMAT_FLAG(info_settings, load)},
    {CLI_TESSELLATION_FLAG(info_settings, load)},
    {CLI_ANIMATION_TIME_FLAG(info_settings, load)},
    {CLI_ANIMATION_FLAG(info_settings, load)},
    {CLI_VARIANT_FLAG(info_settings, load)},
    {CLI_PLATE_FLAG(info_settings, load)},
    {CLI_JOINT_FLAG(info_settings, load)},
    {CLI_SCENE_FLAG(info_settings, load)},
    {CLI_THUMBNAIL_FLAG(info_settings, load)},
    {CLI_STRICT_FLAG(info_settings, load)},
    {CLI_NO_LIBRARIES_FLAG(info_settings, load)},
    {CLI_ROOT_FLAG(info_settings, load)},
    {CLI_MAX_TRIANGLES_FLAG(info_settings, load)},
    {CLI_MAX_INPUT_BYTES_FLAG(info_settings, load)},
    {CLI_SWITCH("quiet", "no warnings", quiet), .letter = 'q',
     .manual = "No warnings on standard error. Errors and the warnings in JSON remain."},
    {CLI_SWITCH("scene-box", "the bounding box as f3d prints it", scene_box),
     .manual = "Prints the line of *f3d --no-render --verbose* with the bounding box instead."},
    {CLI_FLAG("threads", "N", "number of threads (does not affect the result)", cli_flag_integer,
              threads),
     CLI_RANGE(0, 1024), .default_text = "0", .default_label = "all cores", .aliases = "jobs",
     .manual = "Number of threads, 0 for all processors. No digit depends on it."},
};

static const cli_example examples[] = {
    {"burnish info part.stl", "size, volume, whether it is closed"},
    {"burnish info part.stl --json", "for programs"},
    {"burnish info parts -r --csv=parts.csv", "a table of a folder"},
    {NULL, NULL},
};

static const cli_term json_terms[] = {
    {"*burnish*", "the version"},
    {"*input, format*", "the format that was read"},
    {"*triangles, vertices*", "of the file, with polygons divided into triangles; equal positions "
                              "are one vertex. 0 and null without faces"},
    {"*points, splats, lines*", "number of points, of splats, which also count with faces, and of "
                                "lines of an input without faces; then *area* and "
                                "everything below it, except *origin* and *warnings*, is null"},
    {"*materials*", "after loading: at least 1"},
    {"*transmissive*", "materials through which light passes (glTF)"},
    {"*variants*", "names for *--variant* (glTF)"},
    {"*thumbnail*", "true if there is only a picture, no geometry; *triangles* is then 0"},
    {"*layers*", "of G-code, whose *lines* are the moves with filament and whose *parts* are its "
                 "features; 0 for others"},
    {"*parts*",
     "name, role (solid, negative volume, modifier, support blocker, support "
     "enforcer, support, not printed), id of the object, item of the build, plate, filament, "
     "number of triangles, size, rows of the matrix that places it. Only solids are drawn and "
     "measured; volumes do not have negative "
     "volumes subtracted"},
    {"*plates, filaments*", "of a slicer's project: number, name and size; colours"},
    {"*filament_lengths*", "that G-code uses, in mm; 0 if unknown"},
    {"*unit*", "of lengths, from 3MF or glTF: micron, millimeter, centimeter, inch, foot or meter; "
               "null if unknown"},
    {"*bounding_box*", "*min*, *max* and *size* of the triangles with area, or of the positions of "
                       "points or lines, in the units of the input"},
    {"*up, up_source, up_reason*",
     "the up axis in pictures; format, or auto if it is not the axis of the format; then why: "
     "stability, as the object would fall over, or a point cloud of terrain, of geographic "
     "coordinates, or of a depth camera (docs/formats.md)"},
    {"*tipping_angles*",
     "degrees by which the object can lean on +Y and +Z before it falls, negative if it falls; "
     "null for points, lines and formats that state their axis"},
    {"*sheet*", "true if an extent of the object is at most 0.5 % of its longest one; the default "
                "view shows it face on"},
    {"*normals*", "in pictures: file; generated, if the file has none; replaced, if those of the "
                  "file smooth sharp edges (*--normals=auto*)"},
    {"*area*", "of all triangles, including duplicates"},
    {"*volume*",
     "enclosed volume, by the divergence theorem. It is meaningful if *solid* is true, negative "
     "for a surface that is inside out, and cavities with inward winding are subtracted"},
    {"*center_of_mass*", "of the volume if *solid* is true, else of the surface"},
    {"*origin*", "subtracted from coordinates, in double precision, before they are rounded to "
                 "single precision: 0, 0, 0, or a position near the middle of a file that is far "
                 "away from it. Positions in this report are coordinates of the file"},
    {"*solid*", "true if the surface is closed, its winding is consistent and its volume is not 0"},
    {"*closed*", "true if every edge belongs to an even number of triangles"},
    {"*join_tolerance, exact_open_edges*",
     "0 and *open_edges*, if equal positions are enough to know. A surface that is not closed by "
     "them, but is with vertices of its open edges joined that lie within a millionth of the "
     "longest side of *bounding_box* along each axis, is closed: *join_tolerance* is this "
     "distance, *exact_open_edges* counts without joining, and edges, shells and windings are "
     "those of the joined surface"},
    {"*consistent_winding*", "true if *inconsistent_edges* is 0"},
    {"*shells*", "parts connected by edges; parts that only share a vertex are separate"},
    {"*edges, open_edges, non_manifold_edges*",
     "all edges; edges with one triangle, at holes and borders; edges with three or more"},
    {"*inconsistent_edges*",
     "edges with an even number of triangles that do not run in both directions equally often"},
    {"*flipped_triangles*", "the least number of triangles to flip for a consistent winding"},
    {"*unorientable_parts*", "parts without a consistent winding, such as a Moebius strip; their "
                             "triangles are not in *flipped_triangles*"},
    {"*degenerate_triangles*", "triangles without area, which are not drawn. If their vertices "
                               "differ, they still connect their neighbours"},
    {"*duplicate_triangles*", "triangles with the vertices of an earlier one, in any order"},
    {"*warnings*", "lines, also with *--quiet*"},
    {NULL, NULL},
};

static const cli_section sections[] = {
    {.heading = "FACTS IN JSON",
     .text = "The output of *burnish info --json* is one object per line (JSON lines), also for a "
             "single input. Among several inputs, one that can not be read has the keys *input* "
             "and error. Lengths are in *unit*. Numbers read back as exactly the computed values, "
             "in double precision from single precision coordinates.",
     .terms = json_terms},
    {.heading = NULL},
};

const cli_command info_command = {
    .name = "info",
    .aliases = "identify,stats",
    .operand = "INPUT...",
    .summary = "size, volume and validity of meshes",
    .operand_help = CLI_INPUT_HELP,
    .manual =
        "Measures each _INPUT_, which can be any input of *burnish render* or a folder: bounding "
        "box, area, volume, centre of mass, whether the surface is closed and its winding "
        "consistent, open and non-manifold edges, shells, flipped, degenerate and duplicate "
        "triangles. For an input with points or lines instead of faces it prints their number and "
        "the box of their positions, regardless of the size in which *burnish render* draws "
        "them.\nThe results are about the triangles of the file, before *burnish render* flips "
        "triangles that contradict their normals and drops those without area. Vertices with "
        "exactly equal positions are the same. If the surface is not closed then, vertices of its "
        "open edges are joined if they are within a millionth of the longest side, the size of "
        "rounding errors; if that closes it, it counts as closed, and the tolerance is printed. "
        "Larger gaps stay open. A volume needs a closed surface with a consistent winding.",
    .operands_max = SIZE_MAX,
    .flags = flags,
    .flag_count = sizeof flags / sizeof *flags,
    .examples = examples,
    .sections = sections,
    .settings_size = sizeof(info_settings),
    .given = offsetof(info_settings, given),
    .work = work,
};

/* ---- Inputs ---- */

/* A run over its inputs. */
typedef struct survey {
    const info_settings *settings;
    burnish_load_options options;
    cli_output output;
    int is_many; /* failures do not end the run */
    size_t done, failed;
    cli_need needs[CLI_INPUT_NEEDS + 1]; /* is_met: by one of the inputs so far */
} survey;

static burnish_status print_object(survey *s, cJSON *root, int failed, burnish_error *error) {
    if (!failed && s->settings->csv) {
        info_print_csv_row(s->output.stream, root);
    }
    char *text = cli_json_string(root, failed, 0);
    if (text && s->settings->json) {
        fprintf(s->output.stream, "%s\n", text);
    }
    const int is_printed = text != NULL;
    free(text);
    return is_printed ? BURNISH_STATUS_OK
                      : cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the output");
}

static burnish_status print_facts(survey *s, const char *input, const burnish_mesh *mesh,
                                  burnish_error *error) {
    info_report r = {.input = input,
                     .format = s->settings->load.format,
                     .mesh = mesh,
                     .view = burnish_mesh_get_view(mesh),
                     .facts = burnish_mesh_get_facts(mesh),
                     .stance = render_find_stance(mesh)};
    int failed = 0;
    burnish_mesh_get_bounds(mesh, r.low, r.high);
    for (int axis = 0; axis < 3; ++axis) {
        r.size[axis] = r.high[axis] - r.low[axis];
    }
    burnish_status status = BURNISH_STATUS_OK;
    r.boxes = cli_bound_parts(mesh);
    if (!r.boxes) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the parts");
    }
    if (s->settings->scene_box) {
        fprintf(s->output.stream,
                "Scene bounding box: %g \u2264 x \u2264 %g, %g \u2264 y \u2264 %g, %g \u2264 z "
                "\u2264 %g\n",
                (double)r.low[0], (double)r.high[0], (double)r.low[1], (double)r.high[1],
                (double)r.low[2], (double)r.high[2]);
    } else if (s->settings->json || s->settings->csv) {
        cJSON *root = info_make_json(&r, &failed);
        status = print_object(s, root, failed, error);
    } else {
        fputs(s->done > 0 ? "\n" : "", s->output.stream);
        info_print_text(s->output.stream, &r);
    }
    free(r.boxes);
    return status;
}

/* Reports an input that can not be read, and goes on. */
static burnish_status print_failure(survey *s, const char *input, burnish_error *failure,
                                    burnish_error *error) {
    int failed = 0;
    fprintf(stderr, "burnish: %s\n", failure->text);
    ++s->failed;
    if (!s->settings->json && !s->settings->csv) {
        return BURNISH_STATUS_OK;
    }
    cJSON *root = cJSON_CreateObject();
    cli_json_add(root, "input", cli_json_text(input), &failed);
    cli_json_add(root, "error", cli_json_text(failure->text), &failed);
    return print_object(s, root, failed, error);
}

static burnish_status measure_input(survey *s, const char *input, burnish_error *error) {
    burnish_error failure = {BURNISH_STATUS_OK, ""};
    burnish_mesh *mesh = NULL;
    const char *items = s->settings->load.items;
    burnish_status status = items ? import_load_items(input, items, &s->options, &mesh, &failure)
                                  : import_load(input, &s->options, &mesh, &failure);
    for (size_t i = 0; i < burnish_mesh_get_warning_count(mesh) && !s->settings->quiet; ++i) {
        cli_warn(burnish_mesh_get_warning(mesh, i));
    }
    if (status == BURNISH_STATUS_OK) {
        cli_need needs[CLI_INPUT_NEEDS];
        cli_list_input_needs(mesh, needs);
        for (size_t i = 0; i < CLI_INPUT_NEEDS; ++i) {
            s->needs[i].is_met |= needs[i].is_met;
        }
        status = print_facts(s, input, mesh, error);
    } else if (s->is_many) {
        status = print_failure(s, input, &failure, error);
    } else {
        *error = failure;
    }
    burnish_mesh_destroy(mesh);
    ++s->done;
    return status;
}

static burnish_status measure_many(survey *s, const cli_call *call, burnish_error *error) {
    const batch_settings settings = {.files_from = s->settings->files_from,
                                     .recursive = s->settings->recursive,
                                     .render.job.quiet = s->settings->quiet};
    batch b = {.settings = &settings};
    burnish_status status = batch_collect(&b, call, error);
    if (status == BURNISH_STATUS_OK) {
        batch_warn_inputs(&b);
    }
    s->needs[CLI_INPUT_NEEDS].is_met = b.folders > 0;
    for (size_t i = 0; i < b.list.count; ++i) {
        if (status == BURNISH_STATUS_OK) {
            status = measure_input(s, b.list.items[i].input, error);
        }
        free(b.list.items[i].input);
    }
    free(b.list.items);
    return status;
}

static burnish_status work(void *from, cli_call *call, burnish_error *error) {
    info_settings *settings = from;
    const char *path = settings->json ? settings->json : settings->csv;
    struct stat state;
    if (call->operand_count == 0 && !settings->files_from) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "info: no INPUT; try \"burnish info :teapot\" or \"burnish info --help\"");
    }
    if (settings->json && settings->csv) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--csv: not with --json; omit one of them");
    }
    if (settings->load.scene) {
        const burnish_status joined = render_join_inputs(call, &settings->load, error);
        if (joined != BURNISH_STATUS_OK) {
            return joined;
        }
    }
    survey s = {.settings = settings, .options = cli_load_options(&settings->load)};
    s.options.ignore_textures = 1;
    s.options.threads = settings->threads;
    s.options.measure = 1;
    s.is_many = (call->operand_count != 1 && !settings->load.scene) || settings->files_from ||
                (stat(call->operands[0], &state) == 0 && S_ISDIR(state.st_mode));
    cli_list_input_needs(NULL, s.needs);
    s.needs[CLI_INPUT_NEEDS] = (cli_need){"recursive", 0, "no INPUT is a folder; omit the flag"};
    burnish_status status = cli_output_begin(&s.output, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (settings->csv) {
        info_print_csv_head(s.output.stream);
    }
    status =
        s.is_many ? measure_many(&s, call, error) : measure_input(&s, call->operands[0], error);
    if (status == BURNISH_STATUS_OK && s.done > s.failed) {
        status = cli_check_needs(&info_command, settings, s.needs, CLI_INPUT_NEEDS + 1,
                                 settings->load.strict, settings->quiet, error);
    }
    status = cli_output_end(&s.output, path ? path : "-", status, error);
    render_release_inputs(&settings->load);
    if (status == BURNISH_STATUS_OK && s.failed > 0) {
        fprintf(stderr, "burnish: %zu of %zu failed\n", s.failed, s.done);
        call->exit_code = CLI_EXIT_SOME_FAILED;
    }
    return status;
}
