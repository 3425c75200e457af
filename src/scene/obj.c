/* OBJ (Wavefront, "Object Files", 1992): v, vn, f, usemtl, mtllib; polygons; indices from either
 * end.
 *
 * vt, o, g, s and unknown keywords are passed over; l and p too, with one warning. Vertex colours
 * follow the coordinates (v x y z r g b). An index refers to what stands before it in the file.
 * Material names are resolved at the end, sorted, so that a file of nothing but usemtl stays
 * O(n log n); of two materials with one name the first counts. */
#include <string.h>

#include "scene/append.h"
#include "scene/mtl.h"

enum {
    LIBRARY_LIMIT = 64,     /* material libraries that one file may name */
    MATERIAL_LIMIT = 65536, /* what 16 bits a triangle can tell apart */
    LIBRARY_NAME_SIZE = 4096
};

/* Triangles from first_triangle on have this material. */
typedef struct material_run {
    burnish_token name; /* bytes of the input; empty: no usemtl yet */
    size_t first_triangle;
    const struct material_run *head; /* the first run of this name */
    const burnish_mtl_entry *entry;  /* of a head; NULL: in no library */
    uint32_t material;
} material_run;

typedef struct obj_state {
    const burnish_reader_input *input;
    burnish_source *source;
    burnish_error *error;
    burnish_text text;
    burnish_number_reader numbers;

    uint32_t *corners, *corner_normals; /* the face at hand */
    size_t corner_capacity, corner_normal_capacity;

    material_run *runs;
    size_t run_count, run_capacity;
    burnish_token material; /* of the last usemtl */
    int material_changed;

    burnish_mtl library;
    burnish_token libraries[LIBRARY_LIMIT]; /* names already asked for */
    size_t library_count;
    int library_missing; /* said so already: no word about the materials in it */
    int warned_elements, warned_corners, warned_libraries;
} obj_state;

static burnish_place here(const obj_state *obj) {
    return burnish_place_line(obj->input->name, obj->text.line);
}

/* ---- vertices ---- */

static burnish_status read_vertex(obj_state *obj) {
    enum { MOST = 7 }; /* x y z [w], or x y z r g b [a] */
    float values[MOST];
    int count = 0;
    burnish_token token;
    while (count < MOST && burnish_text_token(&obj->text, &token)) {
        burnish_number_status number =
            burnish_parse_float(&obj->numbers, token.bytes, token.size, &values[count]);
        if (number != BURNISH_NUMBER_OK) {
            return burnish_fail_number(obj->error, here(obj), count < 3 ? "coordinate" : "colour",
                                       token, number);
        }
        ++count;
    }
    if (count < 3 || count == 5) {
        return burnish_fail_at(obj->error, BURNISH_STATUS_FORMAT, here(obj),
                               "vertex has %d number%s; write v x y z or v x y z r g b", count,
                               count == 1 ? "" : "s");
    }
    burnish_status status = burnish_append_position(obj->source, here(obj), values, obj->error);
    if (status != BURNISH_STATUS_OK || count < 6) {
        return status;
    }
    uint8_t rgba[4] = {0, 0, 0, 255};
    for (int i = 0; i < 3; ++i) {
        float c = values[3 + i];
        rgba[i] = (uint8_t)(c <= 0 ? 0 : c >= 1 ? 255 : c * 255 + 0.5f);
    }
    return burnish_append_color(obj->source, rgba, obj->error);
}

static burnish_status read_normal(obj_state *obj) {
    float normal[3];
    burnish_token token;
    for (int i = 0; i < 3; ++i) {
        if (!burnish_text_token(&obj->text, &token)) {
            return burnish_fail_at(obj->error, BURNISH_STATUS_FORMAT, here(obj),
                                   "normal has %d number%s; write vn x y z", i, i == 1 ? "" : "s");
        }
        burnish_number_status number =
            burnish_parse_float(&obj->numbers, token.bytes, token.size, &normal[i]);
        if (number == BURNISH_NUMBER_NOT_FINITE || number == BURNISH_NUMBER_RANGE) {
            normal[i] = 0; /* exporters write nan for faces without area; such a normal is remade */
        } else if (number != BURNISH_NUMBER_OK) {
            return burnish_fail_number(obj->error, here(obj), "normal", token, number);
        }
    }
    return burnish_append_normal(obj->source, here(obj), normal, obj->error);
}

/* ---- faces ---- */

/* An index as written, counted from 1 or backwards from -1, becomes one counted from 0. */
static burnish_status resolve_index(obj_state *obj, burnish_token token, const char *what,
                                    size_t count, uint32_t *index) {
    int64_t written;
    burnish_number_status number = burnish_parse_integer(token.bytes, token.size, &written);
    if (number == BURNISH_NUMBER_GARBAGE) {
        return burnish_fail_at(obj->error, BURNISH_STATUS_FORMAT, here(obj),
                               "face corner \"%s\" is not an index; write v, v/t, v//n or v/t/n",
                               burnish_token_quote(token).text);
    }
    if (number == BURNISH_NUMBER_OK && written == 0) {
        return burnish_fail_at(obj->error, BURNISH_STATUS_FORMAT, here(obj),
                               "face refers to %s 0; indices start at 1", what);
    }
    int64_t resolved =
        number == BURNISH_NUMBER_OK && written < 0 ? written + (int64_t)count : written - 1;
    if (number != BURNISH_NUMBER_OK || resolved < 0 || resolved >= (int64_t)count) {
        return burnish_fail_at(obj->error, BURNISH_STATUS_FORMAT, here(obj),
                               "face refers to %s %s, but %zu stand%s before it; correct the index",
                               what, burnish_token_quote(token).text, count, count == 1 ? "s" : "");
    }
    *index = (uint32_t)resolved;
    return BURNISH_STATUS_OK;
}

/* Cuts the part before the next '/' off token. */
static burnish_token cut_part(burnish_token *token) {
    size_t size = 0;
    while (size < token->size && token->bytes[size] != '/') {
        ++size;
    }
    burnish_token part = {token->bytes, size};
    size_t used = size < token->size ? size + 1 : size;
    token->bytes += used;
    token->size -= used;
    return part;
}

/* v, v/t, v//n or v/t/n. */
static burnish_status read_corner(obj_state *obj, burnish_token token, uint32_t *position,
                                  uint32_t *normal) {
    burnish_token left = token, part = cut_part(&left);
    burnish_status status =
        resolve_index(obj, part, "vertex", obj->source->position_count, position);
    *normal = BURNISH_SOURCE_NONE;
    if (status != BURNISH_STATUS_OK || left.size == 0) {
        return status;
    }
    part = cut_part(&left);
    int64_t texture;
    int wrong = part.size > 0 &&
                burnish_parse_integer(part.bytes, part.size, &texture) == BURNISH_NUMBER_GARBAGE;
    if (left.size > 0) {
        part = cut_part(&left);
        wrong |= left.size > 0;
        if (!wrong) {
            return resolve_index(obj, part, "normal", obj->source->normal_count, normal);
        }
    }
    if (wrong) {
        return burnish_fail_at(obj->error, BURNISH_STATUS_FORMAT, here(obj),
                               "face corner \"%s\" is not an index; write v, v/t, v//n or v/t/n",
                               burnish_token_quote(token).text);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status begin_run(obj_state *obj) {
    burnish_status status =
        burnish_grow((void **)&obj->runs, &obj->run_capacity, obj->run_count + 1, sizeof *obj->runs,
                     "material runs", obj->error);
    if (status == BURNISH_STATUS_OK) {
        obj->runs[obj->run_count++] =
            (material_run){.name = obj->material, .first_triangle = obj->source->triangle_count};
        obj->material_changed = 0;
    }
    return status;
}

static burnish_status read_face(obj_state *obj) {
    size_t count = 0;
    int normals = 0;
    burnish_token token;
    burnish_status status = BURNISH_STATUS_OK;
    burnish_place place = here(obj);
    while (burnish_text_token(&obj->text, &token)) {
        if (count == obj->corner_capacity || count == obj->corner_normal_capacity) {
            status = burnish_grow((void **)&obj->corners, &obj->corner_capacity, count + 1,
                                  sizeof *obj->corners, "corners", obj->error);
            if (status == BURNISH_STATUS_OK) {
                status =
                    burnish_grow((void **)&obj->corner_normals, &obj->corner_normal_capacity,
                                 count + 1, sizeof *obj->corner_normals, "corners", obj->error);
            }
        }
        if (status == BURNISH_STATUS_OK) {
            status = read_corner(obj, token, &obj->corners[count], &obj->corner_normals[count]);
        }
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        normals |= obj->corner_normals[count] != BURNISH_SOURCE_NONE;
        ++count;
    }
    if (count < 3) {
        if (!obj->warned_corners++) {
            burnish_warn_at(obj->source, place, "faces with fewer than 3 corners were ignored");
        }
        return BURNISH_STATUS_OK;
    }
    if (obj->material_changed) {
        status = begin_run(obj);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_append_polygon(obj->source, obj->input->options, place, obj->corners,
                                        normals ? obj->corner_normals : NULL, count, obj->error);
    }
    return status;
}

/* ---- material libraries ---- */

/* A name that stays in the folder of the file: relative, without ".." */
static int stays_beside(const char *name) {
    if (*name == '/' || (*name && name[1] == ':')) {
        return 0;
    }
    for (const char *part = name; part; part = strchr(part, '/')) {
        part += *part == '/';
        if (strncmp(part, "..", 2) == 0 && (part[2] == '/' || part[2] == 0)) {
            return 0;
        }
    }
    return 1;
}

static int same_token(burnish_token a, burnish_token b) {
    return a.size == b.size && (a.size == 0 || memcmp(a.bytes, b.bytes, a.size) == 0);
}

/* Takes the next part of a path off it, "." passed over; empty at the end. */
static burnish_token next_part(burnish_token *path) {
    burnish_token part;
    do {
        part = (burnish_token){path->bytes, 0};
        while (part.size < path->size && path->bytes[part.size] != '/' &&
               path->bytes[part.size] != '\\') {
            ++part.size;
        }
        size_t used = part.size + (part.size < path->size);
        path->bytes += used;
        path->size -= used;
    } while (path->size > 0 && (part.size == 0 || burnish_token_is(part, ".")));
    return part;
}

/* Names of one file: a library in disguise must not be read, and kept, many times over. */
static int same_path(burnish_token a, burnish_token b) {
    for (;;) {
        burnish_token part_a = next_part(&a), part_b = next_part(&b);
        if (!same_token(part_a, part_b)) {
            return 0;
        }
        if (part_a.size == 0) {
            return 1;
        }
    }
}

/* Returns 1 when the library was asked for before, or when there were too many. */
static int pass_over_library(obj_state *obj, burnish_token token) {
    for (size_t i = 0; i < obj->library_count; ++i) {
        if (same_path(obj->libraries[i], token)) {
            return 1;
        }
    }
    if (obj->library_count == LIBRARY_LIMIT) {
        if (!obj->warned_libraries++) {
            burnish_warn_at(obj->source, here(obj),
                            "only the first %d material libraries are read; merge them",
                            LIBRARY_LIMIT);
        }
        return 1;
    }
    obj->libraries[obj->library_count++] = token;
    return 0;
}

/* Reads one library. *missing becomes 1 when the file is not there; nothing is reported then. */
static burnish_status open_library(obj_state *obj, burnish_token token, burnish_error *why,
                                   int *missing) {
    char name[LIBRARY_NAME_SIZE];
    *missing = 1;
    if (token.size >= sizeof name || memchr(token.bytes, 0, token.size)) {
        burnish_fail(why, BURNISH_STATUS_READ, "its name is no file name");
        return BURNISH_STATUS_OK;
    }
    for (size_t i = 0; i < token.size; ++i) {
        name[i] = (char)(token.bytes[i] == '\\' ? '/' : token.bytes[i]);
    }
    name[token.size] = 0;
    if (!stays_beside(name)) {
        burnish_fail(why, BURNISH_STATUS_READ, "it lies outside the folder of the file");
        return BURNISH_STATUS_OK;
    }
    if (!obj->input->open_beside) {
        burnish_fail(why, BURNISH_STATUS_READ, "the input has no folder");
        return BURNISH_STATUS_OK;
    }
    uint8_t *bytes = NULL;
    size_t size = 0;
    burnish_status status = obj->input->open_beside(
        obj->input->name, name, obj->input->options->max_input_bytes, &bytes, &size, why);
    if (status == BURNISH_STATUS_MEMORY && obj->error) {
        *obj->error = *why;
    }
    if (status != BURNISH_STATUS_OK) {
        return status == BURNISH_STATUS_MEMORY ? status : BURNISH_STATUS_OK;
    }
    *missing = 0;
    status = burnish_read_mtl_into(bytes, size, name, &obj->library, obj->source, obj->error);
    free(bytes);
    return status;
}

static void warn_library(obj_state *obj, burnish_token token, const burnish_error *why) {
    obj->library_missing = 1;
    burnish_warn_at(obj->source, here(obj),
                    "material library \"%s\" was not read (%s); its materials are burnish's grey",
                    burnish_token_quote(token).text, why->text);
}

/* mtllib FILE, where FILE may hold blanks, or mtllib FILE FILE ... */
static burnish_status read_mtllib(obj_state *obj) {
    burnish_text names = obj->text;
    burnish_token whole = burnish_text_rest(&obj->text), token;
    burnish_error why = {0};
    int missing = 0;
    if (whole.size == 0 || pass_over_library(obj, whole)) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status = open_library(obj, whole, &why, &missing);
    if (status != BURNISH_STATUS_OK || !missing) {
        return status;
    }
    names.wavefront = 0; /* file names may hold '#' */
    names.end = whole.bytes + whole.size;
    if (burnish_text_token(&names, &token) && token.size == whole.size) {
        warn_library(obj, whole, &why);
        return BURNISH_STATUS_OK;
    }
    do {
        if (!pass_over_library(obj, token)) {
            status = open_library(obj, token, &why, &missing);
            if (status == BURNISH_STATUS_OK && missing) {
                warn_library(obj, token, &why);
            }
        }
    } while (status == BURNISH_STATUS_OK && burnish_text_token(&names, &token));
    return status;
}

/* ---- materials of triangles ---- */

static int compare_bytes(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size) {
    size_t size = a_size < b_size ? a_size : b_size;
    int order = size > 0 ? memcmp(a, b, size) : 0;
    return order != 0 ? order : (a_size > b_size) - (a_size < b_size);
}

static int compare_runs(const void *a, const void *b) {
    const material_run *x = *(material_run *const *)a, *y = *(material_run *const *)b;
    int order = compare_bytes(x->name.bytes, x->name.size, y->name.bytes, y->name.size);
    return order != 0 ? order : (x > y) - (x < y);
}

static int compare_entries(const void *a, const void *b) {
    const burnish_mtl_entry *x = *(const burnish_mtl_entry *const *)a;
    const burnish_mtl_entry *y = *(const burnish_mtl_entry *const *)b;
    int order = strcmp(x->name, y->name);
    return order != 0 ? order : (x > y) - (x < y);
}

/* Sorts pointers to `count` elements of `size` bytes; *sorted is released with free(). */
static burnish_status sort_pointers(void *array, size_t count, size_t size,
                                    int (*compare)(const void *, const void *), void ***sorted,
                                    burnish_error *error) {
    void *memory;
    burnish_status status =
        burnish_allocate(&memory, count, sizeof(void *), "sorting materials", error);
    *sorted = memory;
    if (status != BURNISH_STATUS_OK || count == 0) {
        return status;
    }
    for (size_t i = 0; i < count; ++i) {
        (*sorted)[i] = (char *)array + i * size;
    }
    qsort(*sorted, count, sizeof(void *), compare);
    return BURNISH_STATUS_OK;
}

static int compare_names(const burnish_mtl_entry *entry, burnish_token name) {
    return compare_bytes((const uint8_t *)entry->name, strlen(entry->name), name.bytes, name.size);
}

/* Gives every run its head, and every head its entry: one walk along two sorted lists. */
static void match_runs(void **runs, size_t run_count, void **entries, size_t entry_count) {
    size_t e = 0;
    const material_run *head = NULL;
    for (size_t i = 0; i < run_count; ++i) {
        material_run *run = runs[i];
        if (head && same_token(head->name, run->name)) {
            run->head = head;
            continue;
        }
        run->head = head = run;
        while (e < entry_count && compare_names(entries[e], run->name) < 0) {
            ++e;
        }
        run->entry =
            e < entry_count && compare_names(entries[e], run->name) == 0 ? entries[e] : NULL;
    }
}

static burnish_status add_material(obj_state *obj, const burnish_material *material,
                                   uint32_t *index) {
    burnish_source *source = obj->source;
    if (source->material_count == MATERIAL_LIMIT) {
        return burnish_fail_at(obj->error, BURNISH_STATUS_LIMIT,
                               burnish_place_file(obj->input->name),
                               "more than %d materials are in use; merge some", MATERIAL_LIMIT);
    }
    burnish_status status = burnish_grow((void **)&source->materials, &source->material_capacity,
                                         source->material_count + 1, sizeof *source->materials,
                                         "materials", obj->error);
    if (status == BURNISH_STATUS_OK) {
        *index = (uint32_t)source->material_count;
        source->materials[source->material_count++] = *material;
    }
    return status;
}

static void warn_material(obj_state *obj, burnish_token name) {
    burnish_place place = burnish_place_file(obj->input->name);
    if (name.size == 0 || obj->library_missing) {
        return;
    }
    if (obj->library_count == 0) {
        obj->library_missing = 1;
        burnish_warn_at(obj->source, place,
                        "usemtl without mtllib: its materials are burnish's grey");
        return;
    }
    burnish_warn_at(obj->source, place,
                    "material \"%s\" is in no material library; it is burnish's grey",
                    burnish_token_quote(name).text);
}

/* Numbers the materials in use in the order of the file; those in no library share one grey. */
static burnish_status number_materials(obj_state *obj) {
    uint32_t grey = UINT32_MAX;
    for (size_t i = 0; i < obj->run_count; ++i) {
        material_run *run = &obj->runs[i];
        burnish_status status = BURNISH_STATUS_OK;
        if (run->head != run) {
            run->material = run->head->material;
        } else if (run->entry) {
            status = add_material(obj, &run->entry->material, &run->material);
        } else {
            warn_material(obj, run->name);
            if (grey == UINT32_MAX) {
                burnish_material material = burnish_material_default();
                status = add_material(obj, &material, &grey);
            }
            run->material = grey;
        }
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status write_triangle_materials(obj_state *obj) {
    burnish_source *source = obj->source;
    if (source->material_count < 2) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status =
        burnish_grow((void **)&source->triangle_materials, &source->triangle_material_capacity,
                     source->triangle_count, sizeof *source->triangle_materials,
                     "triangle materials", obj->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    for (size_t i = 0; i < obj->run_count; ++i) {
        size_t end =
            i + 1 < obj->run_count ? obj->runs[i + 1].first_triangle : source->triangle_count;
        for (size_t t = obj->runs[i].first_triangle; t < end; ++t) {
            source->triangle_materials[t] = (uint16_t)obj->runs[i].material;
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status resolve_materials(obj_state *obj) {
    void **runs = NULL, **entries = NULL;
    burnish_status status = sort_pointers(obj->runs, obj->run_count, sizeof *obj->runs,
                                          compare_runs, &runs, obj->error);
    if (status == BURNISH_STATUS_OK) {
        status = sort_pointers(obj->library.entries, obj->library.count,
                               sizeof *obj->library.entries, compare_entries, &entries, obj->error);
    }
    if (status == BURNISH_STATUS_OK) {
        match_runs(runs, obj->run_count, entries, obj->library.count);
        status = number_materials(obj);
    }
    free(entries);
    free(runs);
    return status == BURNISH_STATUS_OK ? write_triangle_materials(obj) : status;
}

/* ---- the file ---- */

static burnish_status read_statement(obj_state *obj, burnish_token keyword) {
    if (burnish_token_is(keyword, "v")) {
        return read_vertex(obj);
    }
    if (burnish_token_is(keyword, "vn")) {
        return read_normal(obj);
    }
    if (burnish_token_is(keyword, "f")) {
        return read_face(obj);
    }
    if (burnish_token_is(keyword, "usemtl")) {
        burnish_token name = burnish_text_rest(&obj->text);
        obj->material_changed |= !same_token(name, obj->material);
        obj->material = name;
        return BURNISH_STATUS_OK;
    }
    if (burnish_token_is(keyword, "mtllib")) {
        return read_mtllib(obj);
    }
    if ((burnish_token_is(keyword, "l") || burnish_token_is(keyword, "p")) &&
        !obj->warned_elements++) {
        burnish_warn_at(obj->source, here(obj), "lines and points were ignored");
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_statements(obj_state *obj) {
    burnish_status status = BURNISH_STATUS_OK;
    do {
        burnish_token keyword;
        if (burnish_text_token(&obj->text, &keyword)) {
            status = read_statement(obj, keyword);
        }
    } while (status == BURNISH_STATUS_OK && burnish_text_next_line(&obj->text));
    return status;
}

burnish_status burnish_read_obj(const burnish_reader_input *input, burnish_source *source,
                                burnish_error *error) {
    obj_state obj = {.input = input,
                     .source = source,
                     .error = error,
                     .text = burnish_text_open(input->bytes, input->size, 1),
                     .material_changed = 1};
    if (input->size == 0) {
        return burnish_fail_at(error, BURNISH_STATUS_FORMAT, burnish_place_byte(input->name, 0),
                               "the file is empty; fetch it again");
    }
    burnish_status status = read_statements(&obj);
    if (status == BURNISH_STATUS_OK && source->triangle_count == 0) {
        status = burnish_fail_at(error, BURNISH_STATUS_FORMAT, burnish_place_file(input->name),
                                 "no faces among %zu vertices; export the mesh with its faces",
                                 source->position_count);
    }
    if (status == BURNISH_STATUS_OK) {
        status = resolve_materials(&obj);
    }
    burnish_mtl_destroy(&obj.library);
    burnish_number_reader_close(&obj.numbers);
    free(obj.runs);
    free(obj.corner_normals);
    free(obj.corners);
    return status;
}
