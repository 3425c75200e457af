/* `burnish info`: size, volume and validity of a mesh, as text or JSON. */
#include <float.h>
#include <math.h>

#include "cli/input.h"
#include "cli/main.h"
#include "cli/origin.h"
#include "cli/output.h"
#include "import/importers.h"
#include "import/run.h"
#include "render/scene/up.h"

typedef struct info_settings {
    cli_input load;
    const char *json; /* file; NULL: text on standard output */
    int threads, quiet;
} info_settings;

static cli_work work;

#define TARGET(member) .offset = offsetof(info_settings, member)

static const cli_flag flags[] = {
    {.group = "Options",
     CLI_JSON_FLAG(info_settings, json, "one JSON object instead of text", "FACTS IN JSON")},
    {CLI_INPUT_FORMAT_FLAG(info_settings, load)},
    {CLI_TESSELLATION_FLAG(info_settings, load)},
    {CLI_ANIMATION_TIME_FLAG(info_settings, load)},
    {CLI_ANIMATION_FLAG(info_settings, load)},
    {CLI_STRICT_FLAG(info_settings, load)},
    {CLI_NO_LIBRARIES_FLAG(info_settings, load)},
    {CLI_MAX_TRIANGLES_FLAG(info_settings, load)},
    {CLI_MAX_INPUT_BYTES_FLAG(info_settings, load)},
    {CLI_SWITCH("quiet", "no warnings", quiet),
     .manual = "No warnings on standard error. Errors and the warnings in JSON remain."},
    {CLI_FLAG("threads", "N", "number of threads (does not affect the result)", cli_flag_integer,
              threads),
     CLI_RANGE(0, 1024), .default_text = "0", .default_label = "all cores", .aliases = "jobs",
     .manual = "Number of threads, 0 for all processors. No digit depends on it."},
};

static const cli_example examples[] = {
    {"burnish info part.stl", "size, volume, whether it is closed"},
    {"burnish info part.stl --json", "for programs"},
    {NULL, NULL},
};

static const cli_term json_terms[] = {
    {"*burnish*", "the version"},
    {"*input, format*", "the format that was read"},
    {"*triangles, vertices*", "of the file, with polygons divided into triangles; equal positions "
                              "are one vertex. 0 and null without faces"},
    {"*points, lines*", "number of points and lines of an input without faces; then *area* and "
                        "everything below it, except *origin* and *warnings*, is null"},
    {"*materials*", "after loading: at least 1"},
    {"*unit*", "of lengths, from 3MF or glTF: micron, millimeter, centimeter, inch, foot or meter; "
               "null if unknown"},
    {"*bounding_box*", "*min*, *max* and *size* of the triangles with area, or of the positions "
                       "of points or lines, in the units of the input"},
    {"*up, up_source*", "the up axis in pictures; format, or auto if it is not the axis of the "
                        "format because the object would fall over (docs/up.md)"},
    {"*tipping_angles*",
     "degrees by which the object can lean on +Y and +Z before it falls, "
     "negative if it falls; null for points, lines and formats that state their axis"},
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
     "those "
     "of the joined surface"},
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
     .text = "The output of *burnish info --json* is one object. Lengths are in *unit*. Numbers "
             "read back as exactly the computed values, in double precision from single precision "
             "coordinates.",
     .terms = json_terms},
    {.heading = NULL},
};

const cli_command info_command = {
    .name = "info",
    .operand = "INPUT",
    .summary = "size, volume and validity of a mesh",
    .operand_help = CLI_INPUT_HELP,
    .manual =
        "Measures _INPUT_, which can be any input of *burnish render*: bounding box, area, volume, "
        "centre of mass, whether the surface is closed and its winding consistent, open and "
        "non-manifold edges, shells, flipped, degenerate and duplicate triangles. For an input "
        "with points or lines instead of faces it prints their number and the box of their "
        "positions, regardless of the size in which *burnish render* draws them.\nThe results are "
        "about the triangles of the file, before *burnish render* flips triangles that contradict "
        "their normals and drops those without area. Vertices with exactly equal positions are the "
        "same. If the surface is not closed then, vertices of its open edges are joined if they "
        "are within a millionth of the longest side, the size of rounding errors; if that closes "
        "it, it counts as closed, and the tolerance is printed. Larger gaps stay open. A volume "
        "needs a closed surface with a consistent winding.",
    .operands_max = 1,
    .flags = flags,
    .flag_count = sizeof flags / sizeof *flags,
    .examples = examples,
    .sections = sections,
    .settings_size = sizeof(info_settings),
    .work = work,
};

/* The facts to print. */
typedef struct report {
    const char *input;
    int format; /* of --input-format */
    const burnish_mesh *mesh;
    const burnish_mesh_view *view;
    const burnish_mesh_facts *facts; /* NULL: the input has points or lines instead of faces */
    float low[3], high[3], size[3];
    render_stance stance;
} report;

static const char *up_name(const report *r) {
    const float *axis = r->view->up_axis;
    const int usual = axis[0] > 0.5F ? 0 : axis[1] > 0.5F ? 1 : 2;
    static const char *const names[] = {"+X", "+Y", "+Z"};
    return names[r->stance.is_other ? r->stance.other : usual];
}

static const char *format_name(const report *r, char extension[IMPORT_EXTENSION_SIZE]) {
    return import_format_word(r->input, r->format, burnish_mesh_get_info(r->mesh)->format,
                              extension);
}

/* ---- JSON ---- */

static cJSON *warning_at(const void *mesh, size_t i) {
    return cli_json_text(burnish_mesh_get_warning(mesh, i));
}

static void add_sizes(cJSON *root, const report *r, int *failed) {
    const burnish_mesh_facts *f = r->facts;
    cJSON *box = cJSON_CreateObject();
    cJSON *center =
        f ? cli_json_real_position(f->center_of_mass, r->view->origin) : cJSON_CreateNull();
    cli_json_add(box, "min", cli_json_position(r->low, r->view->origin), failed);
    cli_json_add(box, "max", cli_json_position(r->high, r->view->origin), failed);
    cli_json_add(box, "size", cli_json_floats(3, r->size), failed);
    cli_json_add(root, "unit", cli_json_text(burnish_mesh_get_info(r->mesh)->unit), failed);
    cli_json_add(root, "bounding_box", box, failed);
    cli_json_add(root, "up", cJSON_CreateString(up_name(r)), failed);
    cli_json_add(root, "up_source", cJSON_CreateString(r->stance.is_other ? "auto" : "format"),
                 failed);
    cJSON *tipping = r->stance.usual > 0 ? cJSON_CreateObject() : cJSON_CreateNull();
    if (r->stance.usual > 0) {
        cli_json_add(tipping, "+Y", cli_json_real(r->stance.tipping[1]), failed);
        cli_json_add(tipping, "+Z", cli_json_real(r->stance.tipping[2]), failed);
    }
    cli_json_add(root, "tipping_angles", tipping, failed);
    cli_json_add(root, "area", cli_json_real(f ? f->area : NAN), failed);
    cli_json_add(root, "volume", cli_json_real(f ? f->volume : NAN), failed);
    cli_json_add(root, "center_of_mass", center, failed);
    cli_json_add(root, "origin", cli_json_reals(3, r->view->origin), failed);
}

/* null if the input has no faces. */
static cJSON *bool_or_null(const burnish_mesh_facts *facts, int value) {
    return facts ? cJSON_CreateBool(value) : cJSON_CreateNull();
}

static void add_counts(cJSON *root, const burnish_mesh_facts *facts, int *failed) {
    static const burnish_mesh_facts none;
    const burnish_mesh_facts *f = facts ? facts : &none;
    const struct {
        const char *key;
        size_t count;
    } counts[] = {
        {"shells", f->shell_count},
        {"edges", f->edge_count},
        {"open_edges", f->open_edge_count},
        {"exact_open_edges", f->join_tolerance > 0 ? f->exact_open_edge_count : f->open_edge_count},
        {"non_manifold_edges", f->non_manifold_edge_count},
        {"inconsistent_edges", f->inconsistent_edge_count},
        {"flipped_triangles", f->flipped_count},
        {"unorientable_parts", f->unorientable_count},
        {"degenerate_triangles", f->degenerate_count},
        {"duplicate_triangles", f->duplicate_count}};
    cli_json_add(root, "solid", bool_or_null(facts, f->is_solid), failed);
    cli_json_add(root, "closed", bool_or_null(facts, f->is_closed), failed);
    cli_json_add(root, "join_tolerance", cli_json_real(facts ? f->join_tolerance : NAN), failed);
    cli_json_add(root, "consistent_winding", bool_or_null(facts, f->is_consistent), failed);
    for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i) {
        cli_json_add(root, counts[i].key,
                     facts ? cli_json_count(counts[i].count) : cJSON_CreateNull(), failed);
    }
}

static burnish_status print_json(FILE *stream, const report *r, burnish_error *error) {
    const burnish_mesh_info *info = burnish_mesh_get_info(r->mesh);
    int failed = 0;
    char extension[IMPORT_EXTENSION_SIZE];
    cJSON *root = cJSON_CreateObject();
    cli_json_add(root, "burnish", cJSON_CreateString(burnish_version()), &failed);
    cli_json_add(root, "input", cli_json_text(r->input), &failed);
    cli_json_add(root, "format", cJSON_CreateString(format_name(r, extension)), &failed);
    cli_json_add(root, "triangles", cli_json_count(r->facts ? r->facts->triangle_count : 0),
                 &failed);
    cli_json_add(root, "vertices",
                 r->facts ? cli_json_count(r->facts->vertex_count) : cJSON_CreateNull(), &failed);
    cli_json_add(root, "points", cli_json_count(info->point_count), &failed);
    cli_json_add(root, "lines", cli_json_count(info->line_count), &failed);
    cli_json_add(root, "materials", cli_json_count(burnish_mesh_get_material_count(r->mesh)),
                 &failed);
    add_sizes(root, r, &failed);
    add_counts(root, r->facts, &failed);
    cli_json_add(root, "warnings",
                 cli_json_array(burnish_mesh_get_warning_count(r->mesh), warning_at, r->mesh),
                 &failed);
    return cli_json_print(stream, root, failed, error);
}

/* ---- Text ---- */

static void print_count(FILE *stream, const char *name, size_t count) {
    fprintf(stream, "  %-20s  %zu\n", name, count);
}

/* Digits of a coordinate: 6 for coordinates of the mesh's size, more for larger ones. */
static int coordinate_digits(double origin, double size) {
    int digits = 6;
    for (double reach = size; reach > 0 && reach < fabs(origin) && digits < DBL_DECIMAL_DIG;
         reach *= 10) {
        ++digits;
    }
    return digits;
}

static void print_vector(FILE *stream, const char *name, const double v[3], const report *r,
                         const char *separator) {
    const double size = fmax(r->size[0], fmax(r->size[1], r->size[2]));
    fprintf(stream, "  %-20s  ", name);
    for (int k = 0; k < 3; ++k) {
        fprintf(stream, "%s%.*g", k > 0 ? separator : "",
                coordinate_digits(r->view->origin[k], size), v[k]);
    }
}

static void print_position(FILE *stream, const char *name, const float v[3], const report *r) {
    const double *origin = r->view->origin;
    const double file[3] = {cli_file_coordinate(v[0], origin[0]),
                            cli_file_coordinate(v[1], origin[1]),
                            cli_file_coordinate(v[2], origin[2])};
    print_vector(stream, name, file, r, ", ");
    fputc('\n', stream);
}

/* Why the volume can be misleading, or "". */
static const char *volume_remark(const burnish_mesh_facts *f) {
    return !f->is_closed       ? " (meaningless: the surface is not closed)"
           : !f->is_consistent ? " (meaningless: triangles are wound both ways)"
           : !f->is_solid      ? " (the surface is flat)"
           : f->volume < 0     ? " (inside out: triangles are clockwise seen from outside)"
                               : "";
}

/* 0 for rounding errors. */
static double snap(double value, double rounding) {
    return fabs(value) < rounding ? 0 : value;
}

/* Such as "unstable on +Y" or "stable up to 31 degrees on +Z". */
static void print_tipping(FILE *stream, const render_stance *stance, int axis) {
    if (stance->tipping[axis] < 0) {
        fprintf(stream, "unstable on +%c", "XYZ"[axis]);
    } else {
        fprintf(stream, "stable up to %.0f degrees on +%c", stance->tipping[axis], "XYZ"[axis]);
    }
}

/* The up axis of pictures, and why. */
static void print_up(FILE *stream, const report *r) {
    fprintf(stream, "  %-20s  %s, ", "up", up_name(r));
    if (r->stance.usual == 0) {
        fprintf(stream, "the axis of the format\n");
        return;
    }
    fprintf(stream, r->stance.is_other ? "guessed: " : "the axis of the format: ");
    print_tipping(stream, &r->stance, r->stance.usual);
    fprintf(stream, ", ");
    print_tipping(stream, &r->stance, r->stance.other);
    fputc('\n', stream);
}

/* All facts of points and lines. */
static void print_box(FILE *stream, const report *r) {
    const char *unit = burnish_mesh_get_info(r->mesh)->unit;
    if (unit) {
        fprintf(stream, "  %-20s  %s\n", "unit", unit);
    }
    fprintf(stream, "  %-20s  %.6g x %.6g x %.6g\n", "size", (double)r->size[0], (double)r->size[1],
            (double)r->size[2]);
    print_position(stream, "from", r->low, r);
    print_position(stream, "to", r->high, r);
    print_up(stream, r);
}

static void print_surface(FILE *stream, const report *r) {
    const burnish_mesh_facts *f = r->facts;
    const double size = fmax(r->size[0], fmax(r->size[1], r->size[2])), *c = f->center_of_mass;
    const double rounding = 4 * FLT_EPSILON * size; /* of the coordinates */
    const double *o = r->view->origin;
    const double center[3] = {snap(c[0], rounding) + o[0], snap(c[1], rounding) + o[1],
                              snap(c[2], rounding) + o[2]};
    fprintf(stream, "  %-20s  %.6g\n", "area", f->area);
    fprintf(stream, "  %-20s  %.6g%s\n", "volume", snap(f->volume, 1e-12 * f->area * size),
            volume_remark(f));
    print_vector(stream, "centre of mass", center, r, ", ");
    fprintf(stream, " (of the %s)\n", f->is_solid ? "solid" : "surface");
    fprintf(stream, "\n  %-20s  %s", "closed", f->is_closed ? "yes" : "no");
    if (f->join_tolerance > 0) {
        fprintf(stream, ", with vertices within %.2g joined (%zu open edges without)",
                f->join_tolerance, f->exact_open_edge_count);
    }
    fputc('\n', stream);
    fprintf(stream, "  %-20s  %s\n", "consistent winding", f->is_consistent ? "yes" : "no");
    print_count(stream, "shells", f->shell_count);
    print_count(stream, "edges", f->edge_count);
    print_count(stream, "open edges", f->open_edge_count);
    print_count(stream, "non-manifold edges", f->non_manifold_edge_count);
    print_count(stream, "inconsistent edges", f->inconsistent_edge_count);
    print_count(stream, "flipped triangles", f->flipped_count);
    print_count(stream, "unorientable parts", f->unorientable_count);
    print_count(stream, "degenerate triangles", f->degenerate_count);
    print_count(stream, "duplicate triangles", f->duplicate_count);
}

static void print_text(FILE *stream, const report *r) {
    const burnish_mesh_info *info = burnish_mesh_get_info(r->mesh);
    const size_t materials = burnish_mesh_get_material_count(r->mesh);
    const size_t count = r->facts               ? r->facts->triangle_count
                         : info->line_count > 0 ? info->line_count
                                                : info->point_count;
    char extension[IMPORT_EXTENSION_SIZE];
    fprintf(stream, "%s (%s): %zu %s%s, ", r->input, format_name(r, extension), count,
            r->facts               ? "triangle"
            : info->line_count > 0 ? "line"
                                   : "point",
            count == 1 ? "" : "s");
    if (r->facts) {
        fprintf(stream, "%zu vertices, ", r->facts->vertex_count);
    }
    fprintf(stream, "%zu material%s\n\n", materials, materials == 1 ? "" : "s");
    print_box(stream, r);
    if (r->facts) {
        print_surface(stream, r);
    }
}

static burnish_status print(const info_settings *settings, const char *input,
                            const burnish_mesh *mesh, burnish_error *error) {
    report r = {.input = input,
                .format = settings->load.format,
                .mesh = mesh,
                .view = burnish_mesh_get_view(mesh),
                .facts = burnish_mesh_get_facts(mesh),
                .stance = render_find_stance(mesh)};
    cli_output output;
    burnish_mesh_get_bounds(mesh, r.low, r.high);
    for (int axis = 0; axis < 3; ++axis) {
        r.size[axis] = r.high[axis] - r.low[axis];
    }
    burnish_status status = cli_output_begin(&output, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (settings->json) {
        status = print_json(output.stream, &r, error);
    } else {
        print_text(output.stream, &r);
    }
    return cli_output_end(&output, settings->json ? settings->json : "-", status, error);
}

static burnish_status work(void *from, cli_call *call, burnish_error *error) {
    const info_settings *settings = from;
    burnish_load_options options = cli_load_options(&settings->load);
    options.ignore_textures = 1;
    burnish_mesh *mesh;
    if (call->operand_count == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "info: no INPUT; try \"burnish info :teapot\" or \"burnish info --help\"");
    }
    options.threads = settings->threads;
    options.measure = 1;
    burnish_status status = import_load(call->operands[0], &options, &mesh, error);
    for (size_t i = 0; i < burnish_mesh_get_warning_count(mesh) && !settings->quiet; ++i) {
        cli_warn(burnish_mesh_get_warning(mesh, i));
    }
    if (status == BURNISH_STATUS_OK) {
        status = print(settings, call->operands[0], mesh, error);
    }
    burnish_mesh_destroy(mesh);
    return status;
}
