#include "info/facts.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/cli/output.h"
#include "base/cli/values.h"
#include "cli/contents.h"
#include "cli/coordinates.h"
#include "import/importers.h"

/* The facts to print. */
static const char *up_name(const info_report *r) {
    const float *axis = r->view->up_axis;
    const int usual = axis[0] > 0.5F ? 0 : axis[1] > 0.5F ? 1 : 2;
    static const char *const names[] = {"+X", "+Y", "+Z"};
    const int is_camera = r->stance.reason && *r->stance.reason == 'c';
    if (is_camera || axis[1] < -0.5F) { /* -0.5: splats */
        return "-Y";
    }
    return names[r->stance.reason ? r->stance.other : usual];
}

static const char *format_name(const info_report *r, char extension[IMPORT_EXTENSION_SIZE]) {
    return import_format_word(r->input, r->format, burnish_mesh_get_info(r->mesh), extension);
}

/* The source of the normals. */
static const char *normals_name(const burnish_mesh_info *info) {
    return info->normals_replaced                  ? "replaced"
           : info->normals == BURNISH_NORMALS_FILE ? "file"
                                                   : "generated";
}

/* ---- JSON ---- */

static cJSON *variant_at(const void *mesh, size_t i) {
    return cli_json_text(burnish_mesh_get_variant(mesh, i));
}

static cJSON *warning_at(const void *mesh, size_t i) {
    return cli_json_text(burnish_mesh_get_warning(mesh, i));
}

/* ---- Contents ---- */

static void add_contents(cJSON *root, const info_report *r, int *failed) {
    cJSON *contents = cli_contents_json(r->mesh, r->boxes, failed);
    while (contents && contents->child) {
        cJSON *list = cJSON_DetachItemViaPointer(contents, contents->child);
        cli_json_add(root, list->string, list, failed);
    }
    cJSON_Delete(contents);
}

static void print_size(FILE *stream, const info_report *r, int plate, size_t part) {
    float size[3];
    const burnish_box box = plate ? cli_bound_plate(r->mesh, r->boxes, plate) : r->boxes[part];
    if (cli_box_size(&box, size)) {
        fprintf(stream, ", %.6g x %.6g x %.6g", (double)size[0], (double)size[1], (double)size[2]);
    }
}

static void print_contents(FILE *stream, const info_report *r) {
    enum { SHOWN = 40 };
    const burnish_contents *c = burnish_mesh_get_contents(r->mesh);
    for (size_t i = 0; i < c->filament_count; ++i) {
        const uint8_t *srgb = c->filaments[i].srgb;
        fprintf(stream, "  filament %-11zu  #%02X%02X%02X", i + 1, srgb[0], srgb[1], srgb[2]);
        if (c->filaments[i].length > 0) {
            fprintf(stream, ", %.2f m", c->filaments[i].length / 1000);
        }
        fputc('\n', stream);
    }
    for (size_t i = 0; i < c->plate_count; ++i) {
        fprintf(stream, "  plate %-14d  \"", c->plates[i].number);
        cli_print_clean(stream, c->plates[i].name, 0);
        fputs("\"", stream);
        print_size(stream, r, c->plates[i].number, 0);
        fputc('\n', stream);
    }
    for (size_t i = 0; i < c->part_count && i < SHOWN; ++i) {
        const burnish_part *part = &c->parts[i];
        fprintf(stream, "  part %-15zu  \"", i + 1);
        cli_print_clean(stream, part->name, 0);
        fprintf(stream, "\", %s", burnish_part_role_name(part->role));
        if (part->filament > 0) {
            fprintf(stream, ", filament %d", part->filament);
        }
        if (part->plate > 0) {
            fprintf(stream, ", plate %d", part->plate);
        }
        print_size(stream, r, 0, i);
        fputc('\n', stream);
    }
    if (c->part_count > SHOWN) {
        fprintf(stream, "  %zu more parts: see --json\n", c->part_count - SHOWN);
    }
}

static void add_sizes(cJSON *root, const info_report *r, int *failed) {
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
    cli_json_add(root, "up_source", cJSON_CreateString(r->stance.reason ? "auto" : "format"),
                 failed);
    cli_json_add(root, "up_reason", cli_json_text(r->stance.reason), failed);
    cJSON *tipping = r->stance.usual > 0 ? cJSON_CreateObject() : cJSON_CreateNull();
    if (r->stance.usual > 0) {
        cli_json_add(tipping, "+Y", cli_json_real(r->stance.tipping[1]), failed);
        cli_json_add(tipping, "+Z", cli_json_real(r->stance.tipping[2]), failed);
    }
    cli_json_add(root, "tipping_angles", tipping, failed);
    cli_json_add(root, "sheet", cJSON_CreateBool(r->stance.flat_axis > 0), failed);
    cli_json_add(root, "area", cli_json_real(f ? f->area : NAN), failed);
    cli_json_add(root, "volume", cli_json_real(f ? f->volume : NAN), failed);
    cli_json_add(root, "center_of_mass", center, failed);
    cli_json_add(root, "origin", cli_json_reals(3, r->view->origin), failed);
}

/* null if the input has no faces. */
static cJSON *bool_or_null(const burnish_mesh_facts *facts, int value) {
    return facts ? cJSON_CreateBool(value) : cJSON_CreateNull();
}

enum { COUNTS = 10 };

typedef struct named_count {
    const char *key, *name; /* name: as text has it, or NULL */
    size_t count;
} named_count;

static void list_counts(const burnish_mesh_facts *f, named_count counts[COUNTS]) {
    const named_count all[COUNTS] = {
        {"shells", "shells", f->shell_count},
        {"edges", "edges", f->edge_count},
        {"open_edges", "open edges", f->open_edge_count},
        {"exact_open_edges", NULL,
         f->join_tolerance > 0 ? f->exact_open_edge_count : f->open_edge_count},
        {"non_manifold_edges", "non-manifold edges", f->non_manifold_edge_count},
        {"inconsistent_edges", "inconsistent edges", f->inconsistent_edge_count},
        {"flipped_triangles", "flipped triangles", f->flipped_count},
        {"unorientable_parts", "unorientable parts", f->unorientable_count},
        {"degenerate_triangles", "degenerate triangles", f->degenerate_count},
        {"duplicate_triangles", "duplicate triangles", f->duplicate_count}};
    memcpy(counts, all, sizeof all);
}

static void add_counts(cJSON *root, const burnish_mesh_facts *facts, int *failed) {
    static const burnish_mesh_facts none;
    const burnish_mesh_facts *f = facts ? facts : &none;
    named_count counts[COUNTS];
    list_counts(f, counts);
    cli_json_add(root, "solid", bool_or_null(facts, f->is_solid), failed);
    cli_json_add(root, "closed", bool_or_null(facts, f->is_closed), failed);
    cli_json_add(root, "join_tolerance", cli_json_real(facts ? f->join_tolerance : NAN), failed);
    cli_json_add(root, "consistent_winding", bool_or_null(facts, f->is_consistent), failed);
    for (size_t i = 0; i < COUNTS; ++i) {
        cli_json_add(root, counts[i].key,
                     facts ? cli_json_count(counts[i].count) : cJSON_CreateNull(), failed);
    }
}

static size_t count_transmissive(const burnish_mesh *mesh) {
    size_t count = 0;
    for (size_t i = 0; i < burnish_mesh_get_material_count(mesh); ++i) {
        count += burnish_mesh_get_material(mesh, i)->transmission > 0;
    }
    return count;
}

static size_t count_splats(const info_report *r) {
    const burnish_mesh_view *splats = burnish_mesh_get_view(burnish_mesh_get_splats(r->mesh));
    return splats ? splats->vertex_count : 0;
}

cJSON *info_make_json(const info_report *r, int *failed) {
    const burnish_mesh_info *info = burnish_mesh_get_info(r->mesh);
    char extension[IMPORT_EXTENSION_SIZE];
    cJSON *root = cJSON_CreateObject();
    cli_json_add(root, "burnish", cJSON_CreateString(burnish_version()), failed);
    cli_json_add(root, "input", cli_json_text(r->input), failed);
    cli_json_add(root, "format", cJSON_CreateString(format_name(r, extension)), failed);
    cli_json_add(root, "triangles", cli_json_count(r->facts ? r->facts->triangle_count : 0),
                 failed);
    cli_json_add(root, "vertices",
                 r->facts ? cli_json_count(r->facts->vertex_count) : cJSON_CreateNull(), failed);
    cli_json_add(root, "points", cli_json_count(info->point_count), failed);
    cli_json_add(root, "splats", cli_json_count(count_splats(r)), failed);
    cli_json_add(root, "lines", cli_json_count(info->line_count), failed);
    cli_json_add(root, "layers", cli_json_count(info->layer_count), failed);
    cli_json_add(root, "thumbnail", cJSON_CreateBool(info->is_thumbnail), failed);
    cli_json_add(root, "materials", cli_json_count(burnish_mesh_get_material_count(r->mesh)),
                 failed);
    cli_json_add(root, "transmissive", cli_json_count(count_transmissive(r->mesh)), failed);
    cli_json_add(root, "variants",
                 cli_json_array(burnish_mesh_get_variant_count(r->mesh), variant_at, r->mesh),
                 failed);
    add_contents(root, r, failed);
    cli_json_add(root, "normals",
                 r->facts ? cJSON_CreateString(normals_name(info)) : cJSON_CreateNull(), failed);
    add_sizes(root, r, failed);
    add_counts(root, r->facts, failed);
    cli_json_add(root, "warnings",
                 cli_json_array(burnish_mesh_get_warning_count(r->mesh), warning_at, r->mesh),
                 failed);
    return root;
}

/* ---- CSV ---- */

static const char csv_head[] =
    "input,format,triangles,vertices,points,lines,materials,unit,size_x,size_y,size_z,up,normals,"
    "area,volume,solid,closed,consistent_winding,shells,edges,open_edges,non_manifold_edges,"
    "inconsistent_edges,flipped_triangles,unorientable_parts,degenerate_triangles,"
    "duplicate_triangles,error";

void info_print_csv_head(FILE *stream) {
    fprintf(stream, "%s\n", csv_head);
}

static void print_csv_value(FILE *stream, const cJSON *item) {
    if (cJSON_IsString(item)) {
        cli_csv_text(stream, item->valuestring);
    } else if (cJSON_IsNumber(item) || cJSON_IsRaw(item)) {
        cli_csv_real(stream,
                     cJSON_IsRaw(item) ? strtod(item->valuestring, NULL) : item->valuedouble);
    } else if (cJSON_IsBool(item)) {
        fputs(cJSON_IsTrue(item) ? "yes" : "no", stream);
    }
}

void info_print_csv_row(FILE *stream, const cJSON *root) {
    const cJSON *box = cJSON_GetObjectItemCaseSensitive(root, "bounding_box");
    const cJSON *size = cJSON_GetObjectItemCaseSensitive(box, "size");
    for (const char *list = csv_head, *word; list;) {
        char key[32];
        const size_t length = cli_next_item(&list, ',', &word);
        snprintf(key, sizeof key, "%.*s", (int)length, word);
        fputs(word == csv_head ? "" : ",", stream);
        print_csv_value(stream, strncmp(key, "size_", 5) == 0
                                    ? cJSON_GetArrayItem(size, key[5] - 'x')
                                    : cJSON_GetObjectItemCaseSensitive(root, key));
    }
    fputc('\n', stream);
}

/* ---- Text ---- */

/* Digits of a coordinate: 6 for coordinates of the mesh's size, more for larger ones. */
static int coordinate_digits(double origin, double size) {
    int digits = 6;
    for (double reach = size; reach > 0 && reach < fabs(origin) && digits < DBL_DECIMAL_DIG;
         reach *= 10) {
        ++digits;
    }
    return digits;
}

static void print_vector(FILE *stream, const char *name, const double v[3], const info_report *r,
                         const char *separator) {
    const double size = fmax(r->size[0], fmax(r->size[1], r->size[2]));
    fprintf(stream, "  %-20s  ", name);
    for (int k = 0; k < 3; ++k) {
        fprintf(stream, "%s%.*g", k > 0 ? separator : "",
                coordinate_digits(r->view->origin[k], size), v[k]);
    }
}

static void print_position(FILE *stream, const char *name, const float v[3], const info_report *r) {
    const double *origin = r->view->origin;
    const double file[3] = {cli_file_coordinate(v[0], origin[0]),
                            cli_file_coordinate(v[1], origin[1]),
                            cli_file_coordinate(v[2], origin[2])};
    print_vector(stream, name, file, r, ", ");
    fputc('\n', stream);
}

/* Why the volume can be misleading, or "". */
static const char *volume_remark(const info_report *r) {
    const burnish_mesh_facts *f = r->facts;
    return !f->is_closed       ? " (meaningless: the surface is not closed)"
           : !f->is_consistent ? " (meaningless: triangles are wound both ways)"
           : !f->is_solid      ? " (the surface is flat)"
           : f->volume < 0     ? " (inside out: triangles are clockwise seen from outside)"
           : burnish_mesh_get_negatives(r->mesh) ? " (before negative volumes are subtracted)"
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
static void print_up(FILE *stream, const info_report *r) {
    fprintf(stream, "  %-20s  %s, ", "up", up_name(r));
    if (r->stance.reason && r->stance.usual == 0) {
        fprintf(stream, "guessed: a cloud of %s\n",
                *r->stance.reason == 't'   ? "terrain or buildings, low along z"
                : *r->stance.reason == 'c' ? "a depth camera, y downwards"
                                           : "geographic coordinates");
        return;
    }
    if (r->stance.usual == 0 || r->stance.flat_axis) {
        fprintf(stream, "the axis of the format%s\n",
                r->stance.flat_axis ? ": a sheet, drawn face on" : "");
        return;
    }
    fprintf(stream, r->stance.reason ? "guessed: " : "the axis of the format: ");
    print_tipping(stream, &r->stance, r->stance.usual);
    fprintf(stream, ", ");
    print_tipping(stream, &r->stance, r->stance.other);
    fputc('\n', stream);
}

/* All facts of points and lines. */
static void print_box(FILE *stream, const info_report *r) {
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

static void print_variants(FILE *stream, const burnish_mesh *mesh) {
    const size_t count = burnish_mesh_get_variant_count(mesh);
    if (count > 0) {
        fprintf(stream, "  %-20s  ", "variants");
    }
    for (size_t i = 0; i < count; ++i) {
        cli_print_clean(stream, burnish_mesh_get_variant(mesh, i), 0);
        fputs(i + 1 < count ? ", " : "\n", stream);
    }
}

static void print_surface(FILE *stream, const info_report *r) {
    const burnish_mesh_facts *f = r->facts;
    const double size = fmax(r->size[0], fmax(r->size[1], r->size[2])), *c = f->center_of_mass;
    const double rounding = 4 * FLT_EPSILON * size; /* of the coordinates */
    const double *o = r->view->origin;
    const double center[3] = {snap(c[0], rounding) + o[0], snap(c[1], rounding) + o[1],
                              snap(c[2], rounding) + o[2]};
    const burnish_mesh_info *info = burnish_mesh_get_info(r->mesh);
    named_count counts[COUNTS];
    fprintf(stream, "  %-20s  %s%s\n", "normals", normals_name(info),
            info->normals_replaced ? ": those of the file smooth sharp edges" : "");
    fprintf(stream, "  %-20s  %.6g\n", "area", f->area);
    fprintf(stream, "  %-20s  %.6g%s\n", "volume", snap(f->volume, 1e-12 * f->area * size),
            volume_remark(r));
    print_vector(stream, "centre of mass", center, r, ", ");
    fprintf(stream, " (of the %s)\n", f->is_solid ? "solid" : "surface");
    fprintf(stream, "\n  %-20s  %s", "closed", f->is_closed ? "yes" : "no");
    if (f->join_tolerance > 0) {
        fprintf(stream, ", with vertices within %.2g joined (%zu open edges without)",
                f->join_tolerance, f->exact_open_edge_count);
    }
    fputc('\n', stream);
    fprintf(stream, "  %-20s  %s\n", "consistent winding", f->is_consistent ? "yes" : "no");
    list_counts(f, counts);
    for (int i = 0; i < COUNTS; ++i) {
        if (counts[i].name) {
            fprintf(stream, "  %-20s  %zu\n", counts[i].name, counts[i].count);
        }
    }
}

void info_print_text(FILE *stream, const info_report *r) {
    const burnish_mesh_info *info = burnish_mesh_get_info(r->mesh);
    const size_t materials = burnish_mesh_get_material_count(r->mesh);
    const size_t count = r->facts               ? r->facts->triangle_count
                         : info->line_count > 0 ? info->line_count
                                                : info->point_count;
    char extension[IMPORT_EXTENSION_SIZE];
    cli_print_clean(stream, r->input, 0);
    if (info->is_thumbnail) {
        fprintf(stream, " (%s): a picture, no geometry\n", format_name(r, extension));
        return;
    }
    fprintf(stream, " (%s): %zu %s%s, ", format_name(r, extension), count,
            r->facts               ? "triangle"
            : info->line_count > 0 ? "line"
            : r->view->splats      ? "splat"
                                   : "point",
            count == 1 ? "" : "s");
    if (r->facts) {
        fprintf(stream, "%zu vertices, ", r->facts->vertex_count);
    }
    if (r->facts && count_splats(r) > 0) {
        fprintf(stream, "%zu splats, ", count_splats(r));
    }
    fprintf(stream, "%zu material%s\n\n", materials, materials == 1 ? "" : "s");
    print_variants(stream, r->mesh);
    if (info->layer_count > 0) {
        fprintf(stream, "  %-20s  %zu\n", "layers", info->layer_count);
    }
    print_contents(stream, r);
    print_box(stream, r);
    if (r->facts) {
        print_surface(stream, r);
    }
}
