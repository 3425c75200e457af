/* Material libraries of an OBJ file, and which of its triangles have which material.
 *
 * Names are sorted and resolved at the end, so a file of nothing but usemtl stays O(n log n). Of
 * two materials with one name, the first counts. */

#include "mesh/read/obj/obj_materials.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/read/common/textures.h"
#include "mesh/read/io/companions.h"
#include "mesh/read/obj/mtl.h"

enum {
    MATERIAL_LIMIT = 65536, /* what 16 bits a triangle can tell apart */
    LIBRARY_NAME_SIZE = 4096
};

/* ---- runs ---- */

static int same_token(burnish_token a, burnish_token b) {
    return a.size == b.size && (a.size == 0 || memcmp(a.bytes, b.bytes, a.size) == 0);
}

void burnish_obj_use_material(burnish_obj_materials *materials, burnish_token name) {
    materials->changed |= !same_token(name, materials->name);
    materials->name = name;
}

burnish_status burnish_obj_begin_run(burnish_obj_materials *materials, size_t first_triangle) {
    burnish_memory *memory = &materials->reader->mesh->memory;
    if (!materials->changed) {
        return BURNISH_STATUS_OK;
    }
    materials->runs =
        burnish_reserve(memory, materials->runs, &materials->run_capacity, materials->run_count + 1,
                        sizeof *materials->runs, "material runs");
    if (memory->status == BURNISH_STATUS_OK) {
        materials->runs[materials->run_count++] =
            (burnish_obj_run){.name = materials->name, .first_triangle = first_triangle};
        materials->changed = 0;
    }
    return memory->status;
}

void burnish_obj_materials_close(burnish_obj_materials *materials) {
    const burnish_context *context = materials->reader->mesh->memory.context;
    burnish_mtl_destroy(context, &materials->library);
    burnish_release(context, materials->runs);
    *materials = (burnish_obj_materials){0};
}

/* ---- material libraries ---- */

static int is_separator(uint8_t c) {
    return c == '/' || c == '\\';
}

/* The next byte of a path, with separators and "." parts folded into one '/'. *at moves past it.
 * Returns 0 at the end; trailing separators don't count. */
static uint8_t next_byte(burnish_token path, size_t *at) {
    size_t i = *at;
    int separated = i == 0;
    while (i < path.size &&
           (is_separator(path.bytes[i]) ||
            (path.bytes[i] == '.' && (separated || is_separator(path.bytes[i - 1])) &&
             (i + 1 == path.size || is_separator(path.bytes[i + 1]))))) {
        separated |= is_separator(path.bytes[i]);
        ++i;
    }
    if (i == path.size) {
        *at = i;
        return 0;
    }
    if (i > *at && *at > 0) {
        *at = i;
        return '/';
    }
    *at = i + 1;
    return path.bytes[i];
}

/* Whether two names mean one file: a library must not be read again under another spelling. Ends at
 * the first difference. */
static int same_path(burnish_token a, burnish_token b) {
    size_t at_a = 0, at_b = 0;
    for (;;) {
        const uint8_t byte_a = next_byte(a, &at_a), byte_b = next_byte(b, &at_b);
        if (byte_a != byte_b) {
            return 0;
        }
        if (at_a >= a.size || at_b >= b.size) {
            return next_byte(a, &at_a) == next_byte(b, &at_b);
        }
    }
}

static int is_file_name(burnish_token token) {
    return token.size < LIBRARY_NAME_SIZE && !memchr(token.bytes, 0, token.size);
}

/* Returns 1 if the library was requested before, or if there are too many. */
static int pass_over_library(burnish_obj_materials *materials, burnish_token token) {
    if (!is_file_name(token)) { /* nothing will be read */
        return 0;
    }
    for (size_t i = 0; i < materials->library_count; ++i) {
        if (same_path(materials->libraries[i], token)) {
            return 1;
        }
    }
    if (materials->library_count == BURNISH_OBJ_LIBRARIES) {
        if (!materials->library_limit++) {
            burnish_reader_warn(materials->reader, token.bytes,
                                "only the first %d material libraries are read; merge them",
                                BURNISH_OBJ_LIBRARIES);
        }
        return 1;
    }
    materials->libraries[materials->library_count++] = token;
    return 0;
}

/* Reads an opened library; name is the file's. */
static burnish_status read_library(burnish_obj_materials *materials, const char *name,
                                   const uint8_t *bytes, size_t size) {
    const burnish_reader_input input = {
        .bytes = bytes, .size = size, .name = name, .options = materials->reader->input->options};
    burnish_reader reader = {
        .input = &input, .mesh = materials->reader->mesh, .error = materials->reader->error};
    return burnish_read_mtl(&reader, &materials->library);
}

/* Reads one library by a name that ends in 0. *missing becomes 0 if the file exists. */
static burnish_status load_library(burnish_obj_materials *materials, const char *name,
                                   burnish_error *why, int *missing) {
    char path[BURNISH_COMPANION_SIZE];
    const burnish_reader_input *input = materials->reader->input;
    const burnish_file_loader *companions = &input->companions;
    const void *bytes = NULL;
    size_t size = 0;
    if (!companions->load) {
        burnish_fail(why, BURNISH_STATUS_READ, "the input has no folder");
        return BURNISH_STATUS_OK;
    }
    if (!burnish_companion_path(input, name, path)) {
        burnish_companion_outside(input, name, why);
        return BURNISH_STATUS_OK;
    }
    burnish_status status = companions->load(companions->user_data, path,
                                             input->options->max_input_bytes, &bytes, &size, why);
    if (status == BURNISH_STATUS_MEMORY && materials->reader->error) {
        *materials->reader->error = *why;
    }
    if (status != BURNISH_STATUS_OK) {
        return status == BURNISH_STATUS_MEMORY ? status : BURNISH_STATUS_OK;
    }
    *missing = 0;
    status = read_library(materials, name, bytes, size);
    if (companions->release) {
        companions->release(companions->user_data, bytes, size);
    }
    return status;
}

/* The token as a name with slashes, in which blanks may be escaped. Returns whether any was. */
static int write_name(burnish_token token, int unescape, char *name) {
    int escaped = 0;
    for (size_t i = 0; i < token.size; ++i) {
        const int is_escape =
            token.bytes[i] == '\\' && i + 1 < token.size && burnish_is_blank(token.bytes[i + 1]);
        escaped |= is_escape;
        if (!is_escape || !unescape) {
            *name++ = (char)(token.bytes[i] == '\\' ? '/' : token.bytes[i]);
        }
    }
    *name = 0;
    return escaped;
}

/* Reads one library: the file of that name, with escaped blanks, or else its last part next to the
 * input, if the name is a path of another machine. *missing becomes 1 without a report if the file
 * does not exist. */
static burnish_status open_library(burnish_obj_materials *materials, burnish_token token,
                                   burnish_error *why, int *missing) {
    char name[LIBRARY_NAME_SIZE];
    burnish_status status = BURNISH_STATUS_OK;
    *missing = 1;
    if (!is_file_name(token)) {
        burnish_fail(why, BURNISH_STATUS_READ, "its name is not a file name");
        return status;
    }
    const int escaped = write_name(token, 0, name);
    status = load_library(materials, name, why, missing);
    if (status == BURNISH_STATUS_OK && *missing && escaped) {
        write_name(token, 1, name);
        status = load_library(materials, name, why, missing);
    }
    const char *slash = strrchr(name, '/');
    burnish_error unused = {0};
    if (status == BURNISH_STATUS_OK && *missing && slash && slash[1]) {
        status = load_library(materials, slash + 1, &unused, missing);
        if (status == BURNISH_STATUS_OK && !*missing) {
            burnish_reader_note(materials->reader, &materials->elsewhere, token.bytes,
                                "material library \"%s\" is next to the file",
                                burnish_token_quote(token).text);
        }
    }
    return status;
}

static void warn_library(burnish_obj_materials *materials, burnish_token token,
                         const burnish_error *why) {
    materials->library_missing = 1;
    burnish_reader_warn(
        materials->reader, token.bytes,
        "material library \"%s\" was not read (%s); its materials are burnish's grey",
        burnish_token_quote(token).text, why->text);
}

/* The text before a comment: a '#' after a blank. File names may contain that, so it is used only
 * where no file has the whole name. */
static burnish_token cut_comment(burnish_token line) {
    for (size_t i = 1; i < line.size; ++i) {
        if (line.bytes[i] == '#' && burnish_is_blank(line.bytes[i - 1])) {
            line.size = i;
        }
    }
    while (line.size > 0 && burnish_is_blank(line.bytes[line.size - 1])) {
        --line.size;
    }
    return line;
}

burnish_status burnish_obj_read_libraries(burnish_obj_materials *materials, burnish_lexer *lexer) {
    burnish_lexer names = *lexer;
    burnish_token whole = burnish_lexer_rest(lexer), token;
    burnish_error why = {0};
    int missing = 0;
    if (materials->reader->input->options->ignore_referenced_files) {
        materials->library_missing = 1;
        return BURNISH_STATUS_OK;
    }
    if (whole.size == 0 || materials->library_limit || pass_over_library(materials, whole)) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status = open_library(materials, whole, &why, &missing);
    const burnish_token plain = cut_comment(whole);
    if (status == BURNISH_STATUS_OK && missing && plain.size < whole.size) {
        whole = plain;
        if (pass_over_library(materials, whole)) {
            return BURNISH_STATUS_OK;
        }
        status = open_library(materials, whole, &why, &missing);
    }
    if (status != BURNISH_STATUS_OK || !missing) {
        return status;
    }
    names.obj_rules = 0; /* file names may hold '#' */
    names.end = whole.bytes + whole.size;
    if (burnish_lexer_token(&names, &token) && token.size == whole.size) {
        warn_library(materials, whole, &why);
        return BURNISH_STATUS_OK;
    }
    do {
        if (!pass_over_library(materials, token)) {
            status = open_library(materials, token, &why, &missing);
            if (status == BURNISH_STATUS_OK && missing) {
                warn_library(materials, token, &why);
            }
        }
    } while (status == BURNISH_STATUS_OK && !materials->library_limit &&
             burnish_lexer_token(&names, &token));
    return status;
}

/* ---- materials of triangles ---- */

static int compare_bytes(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size) {
    size_t size = a_size < b_size ? a_size : b_size;
    int order = size > 0 ? memcmp(a, b, size) : 0;
    return order != 0 ? order : (a_size > b_size) - (a_size < b_size);
}

static int compare_runs(const void *a, const void *b) {
    const burnish_obj_run *x = *(burnish_obj_run *const *)a, *y = *(burnish_obj_run *const *)b;
    int order = compare_bytes(x->name.bytes, x->name.size, y->name.bytes, y->name.size);
    return order != 0 ? order : (x > y) - (x < y);
}

static int compare_entries(const void *a, const void *b) {
    const burnish_mtl_entry *x = *(const burnish_mtl_entry *const *)a;
    const burnish_mtl_entry *y = *(const burnish_mtl_entry *const *)b;
    int order = strcmp(x->name, y->name);
    return order != 0 ? order : (x > y) - (x < y);
}

/* Sorts pointers to `count` elements of `size` bytes; NULL for none, and when memory is out. */
static void **sort_pointers(burnish_memory *memory, void *array, size_t count, size_t size,
                            int (*compare)(const void *, const void *)) {
    void **sorted = burnish_allocate(memory, count, sizeof *sorted, "sorting materials");
    for (size_t i = 0; i < count && sorted; ++i) {
        sorted[i] = (char *)array + i * size;
    }
    if (sorted) {
        qsort(sorted, count, sizeof *sorted, compare);
    }
    return sorted;
}

static int compare_names(const burnish_mtl_entry *entry, burnish_token name) {
    return compare_bytes((const uint8_t *)entry->name, strlen(entry->name), name.bytes, name.size);
}

/* Gives every run its head, and every head its entry: one walk along two sorted lists. */
static void match_runs(void **runs, size_t run_count, void **entries, size_t entry_count) {
    size_t e = 0;
    const burnish_obj_run *head = NULL;
    for (size_t i = 0; i < run_count; ++i) {
        burnish_obj_run *run = runs[i];
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

static int compare_key(const void *name, const void *entry) {
    return -compare_names(*(const burnish_mtl_entry *const *)entry, *(const burnish_token *)name);
}

/* For heads whose whole name matches no entry, takes the entry that is named before a comment. */
static void match_before_comments(burnish_obj_materials *materials, void **entries, size_t count) {
    for (size_t i = 0; i < materials->run_count && count > 0; ++i) {
        burnish_obj_run *run = &materials->runs[i];
        const burnish_token plain = cut_comment(run->name);
        if (run->head == run && !run->entry && plain.size < run->name.size) {
            void **entry = bsearch(&plain, entries, count, sizeof *entries, compare_key);
            run->entry = entry ? *entry : NULL;
        }
    }
}

static burnish_status add_material(burnish_obj_materials *materials,
                                   const burnish_material *material, uint32_t *index) {
    burnish_mesh_data *mesh = materials->reader->mesh;
    if (mesh->material_count == MATERIAL_LIMIT) {
        return burnish_reader_fail(materials->reader, BURNISH_STATUS_LIMIT, NULL,
                                   "more than %d materials are in use; merge some", MATERIAL_LIMIT);
    }
    mesh->materials =
        burnish_reserve(&mesh->memory, mesh->materials, &mesh->material_capacity,
                        mesh->material_count + 1, sizeof *mesh->materials, "materials");
    if (mesh->memory.status == BURNISH_STATUS_OK) {
        *index = (uint32_t)mesh->material_count;
        mesh->materials[mesh->material_count++] = *material;
    }
    return mesh->memory.status;
}

/* Counts materials in use that are fully transparent in the file. */
static void warn_invisible(burnish_obj_materials *materials) {
    size_t invisible = 0;
    for (size_t i = 0; i < materials->run_count; ++i) {
        const burnish_obj_run *run = &materials->runs[i];
        const int has_map =
            run->entry && run->entry->maps[BURNISH_TEXTURE_OPACITY].file; /* which says more */
        invisible += run->head == run && run->entry && run->entry->is_invisible && !has_map;
    }
    if (invisible > 0) {
        burnish_reader_warn(materials->reader, NULL,
                            "%zu material%s fully transparent (d 0 or Tr 1) and drawn opaque",
                            invisible, invisible == 1 ? " is" : "s are");
    }
}

static void warn_material(burnish_obj_materials *materials, burnish_token name) {
    if (name.size == 0 || materials->library_missing) {
        return;
    }
    if (materials->library_count == 0) {
        materials->library_missing = 1;
        burnish_reader_warn(materials->reader, NULL,
                            "usemtl without mtllib: its materials are burnish's grey");
        return;
    }
    burnish_reader_note(materials->reader, &materials->missing, NULL,
                        "material \"%s\" is in no material library; it is burnish's grey",
                        burnish_token_quote(name).text);
}

/* Pictures of the materials in use, in the order in which they are loaded. */
static void decode_ahead(const burnish_obj_materials *materials) {
    enum { MOST = 256 };
    burnish_texture_source sources[MOST];
    size_t count = 0;
    for (size_t i = 0; i < materials->run_count && count < MOST; ++i) {
        const burnish_obj_run *run = &materials->runs[i];
        for (int slot = 0; slot < BURNISH_TEXTURE_SLOT_COUNT && run->head == run && run->entry;
             ++slot) {
            const char *file = run->entry->maps[slot].file;
            size_t known = 0;
            while (known < count && file && strcmp(sources[known].name, file) != 0) {
                ++known;
            }
            if (file && known == count && count < MOST) {
                sources[count++] = (burnish_texture_source){.name = file};
            }
        }
    }
    burnish_reader_decode_ahead(materials->reader, sources, count);
}

/* Numbers the materials in use in the order of the file; those in no library share one grey. */
static burnish_status number_materials(burnish_obj_materials *materials) {
    uint32_t grey = UINT32_MAX;
    decode_ahead(materials);
    for (size_t i = 0; i < materials->run_count; ++i) {
        burnish_obj_run *run = &materials->runs[i];
        burnish_status status = BURNISH_STATUS_OK;
        if (run->head != run) {
            run->material = run->head->material;
        } else if (run->entry) {
            const burnish_material material = burnish_mtl_load_maps(materials->reader, run->entry);
            status = add_material(materials, &material, &run->material);
        } else {
            warn_material(materials, run->name);
            if (grey == UINT32_MAX) {
                burnish_material material = burnish_material_default();
                status = add_material(materials, &material, &grey);
            }
            run->material = grey;
        }
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    burnish_reader_drop_ahead(materials->reader);
    return BURNISH_STATUS_OK;
}

static burnish_status write_triangle_materials(burnish_obj_materials *materials) {
    burnish_mesh_data *mesh = materials->reader->mesh;
    if (mesh->material_count < 2) {
        return BURNISH_STATUS_OK;
    }
    mesh->triangle_materials = burnish_reserve_discard(
        &mesh->memory, mesh->triangle_materials, &mesh->triangle_material_capacity,
        mesh->triangle_count, sizeof *mesh->triangle_materials, "triangle materials");
    for (size_t i = 0; i < materials->run_count && mesh->triangle_materials; ++i) {
        size_t end = i + 1 < materials->run_count ? materials->runs[i + 1].first_triangle
                                                  : mesh->triangle_count;
        for (size_t t = materials->runs[i].first_triangle; t < end; ++t) {
            mesh->triangle_materials[t] = (uint16_t)materials->runs[i].material;
        }
    }
    return mesh->memory.status;
}

burnish_status burnish_obj_resolve_materials(burnish_obj_materials *materials) {
    burnish_memory *memory = &materials->reader->mesh->memory;
    void **runs = sort_pointers(memory, materials->runs, materials->run_count,
                                sizeof *materials->runs, compare_runs);
    void **entries = sort_pointers(memory, materials->library.entries, materials->library.count,
                                   sizeof *materials->library.entries, compare_entries);
    burnish_status status = memory->status;
    if (status == BURNISH_STATUS_OK) {
        match_runs(runs, materials->run_count, entries, materials->library.count);
        match_before_comments(materials, entries, materials->library.count);
        status = number_materials(materials);
    }
    burnish_release(memory->context, entries);
    burnish_release(memory->context, runs);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_reader_warn_group(materials->reader, &materials->elsewhere);
    burnish_reader_warn_group(materials->reader, &materials->missing);
    warn_invisible(materials);
    return write_triangle_materials(materials);
}
