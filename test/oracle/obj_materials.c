/* Material libraries of an OBJ file, and which of its triangles have which material.
 *
 * Names are resolved at the end, sorted, so that a file of nothing but usemtl stays O(n log n); of
 * two materials with one name the first counts. */
#include "oracle/obj_materials.h"

#include <stdlib.h>
#include <string.h>

enum {
    MATERIAL_LIMIT = 65536, /* what 16 bits a triangle can tell apart */
    LIBRARY_NAME_SIZE = 4096
};

/* ---- runs ---- */

static int same_token(oracle_token a, oracle_token b) {
    return a.size == b.size && (a.size == 0 || memcmp(a.bytes, b.bytes, a.size) == 0);
}

void oracle_obj_use_material(oracle_obj_materials *materials, oracle_token name) {
    materials->changed |= !same_token(name, materials->name);
    materials->name = name;
}

burnish_status oracle_obj_begin_run(oracle_obj_materials *materials, size_t first_triangle) {
    if (!materials->changed) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status = oracle_legacy_reserve(
        (void **)&materials->runs, &materials->run_capacity, materials->run_count + 1,
        sizeof *materials->runs, "material runs", materials->error);
    if (status == BURNISH_STATUS_OK) {
        materials->runs[materials->run_count++] =
            (oracle_obj_run){.name = materials->name, .first_triangle = first_triangle};
        materials->changed = 0;
    }
    return status;
}

void oracle_obj_materials_close(oracle_obj_materials *materials) {
    oracle_mtl_destroy(&materials->library);
    free(materials->runs);
    *materials = (oracle_obj_materials){0};
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

/* Takes the next part of a path off it, "." passed over; empty at the end. */
static oracle_token next_part(oracle_token *path) {
    oracle_token part;
    do {
        part = (oracle_token){path->bytes, 0};
        while (part.size < path->size && path->bytes[part.size] != '/' &&
               path->bytes[part.size] != '\\') {
            ++part.size;
        }
        size_t used = part.size + (part.size < path->size);
        path->bytes += used;
        path->size -= used;
    } while (path->size > 0 && (part.size == 0 || oracle_token_is(part, ".")));
    return part;
}

/* Names of one file: a library in disguise must not be read, and kept, many times over. */
static int same_path(oracle_token a, oracle_token b) {
    for (;;) {
        oracle_token part_a = next_part(&a), part_b = next_part(&b);
        if (!same_token(part_a, part_b)) {
            return 0;
        }
        if (part_a.size == 0) {
            return 1;
        }
    }
}

/* Returns 1 when the library was asked for before, or when there were too many. */
static int pass_over_library(oracle_obj_materials *materials, oracle_place place,
                             oracle_token token) {
    for (size_t i = 0; i < materials->library_count; ++i) {
        if (same_path(materials->libraries[i], token)) {
            return 1;
        }
    }
    if (materials->library_count == ORACLE_OBJ_LIBRARIES) {
        if (!materials->warned_libraries++) {
            oracle_warn_at(materials->source, place,
                           "only the first %d material libraries are read; merge them",
                           ORACLE_OBJ_LIBRARIES);
        }
        return 1;
    }
    materials->libraries[materials->library_count++] = token;
    return 0;
}

/* Reads one library. *missing becomes 1 when the file is not there; nothing is reported then. */
static burnish_status open_library(oracle_obj_materials *materials, oracle_token token,
                                   burnish_error *why, int *missing) {
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
    if (!materials->input->open_beside) {
        burnish_fail(why, BURNISH_STATUS_READ, "the input has no folder");
        return BURNISH_STATUS_OK;
    }
    uint8_t *bytes = NULL;
    size_t size = 0;
    burnish_status status = materials->input->open_beside(
        materials->input->name, name, materials->input->options->max_input_bytes, &bytes, &size,
        why);
    if (status == BURNISH_STATUS_MEMORY && materials->error) {
        *materials->error = *why;
    }
    if (status != BURNISH_STATUS_OK) {
        return status == BURNISH_STATUS_MEMORY ? status : BURNISH_STATUS_OK;
    }
    *missing = 0;
    status = oracle_read_mtl_into(bytes, size, name, &materials->library, materials->source,
                                  materials->error);
    free(bytes);
    return status;
}

static void warn_library(oracle_obj_materials *materials, oracle_place place, oracle_token token,
                         const burnish_error *why) {
    materials->library_missing = 1;
    oracle_warn_at(materials->source, place,
                   "material library \"%s\" was not read (%s); its materials are burnish's grey",
                   oracle_token_quote(token).text, why->text);
}

burnish_status oracle_obj_read_libraries(oracle_obj_materials *materials, oracle_text *text) {
    const oracle_place place = oracle_place_line(materials->input->name, text->line);
    oracle_text names = *text;
    oracle_token whole = oracle_text_rest(text), token;
    burnish_error why = {0};
    int missing = 0;
    if (whole.size == 0 || pass_over_library(materials, place, whole)) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status = open_library(materials, whole, &why, &missing);
    if (status != BURNISH_STATUS_OK || !missing) {
        return status;
    }
    names.wavefront = 0; /* file names may hold '#' */
    names.end = whole.bytes + whole.size;
    if (oracle_text_token(&names, &token) && token.size == whole.size) {
        warn_library(materials, place, whole, &why);
        return BURNISH_STATUS_OK;
    }
    do {
        if (!pass_over_library(materials, place, token)) {
            status = open_library(materials, token, &why, &missing);
            if (status == BURNISH_STATUS_OK && missing) {
                warn_library(materials, place, token, &why);
            }
        }
    } while (status == BURNISH_STATUS_OK && oracle_text_token(&names, &token));
    return status;
}

/* ---- materials of triangles ---- */

static int compare_bytes(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size) {
    size_t size = a_size < b_size ? a_size : b_size;
    int order = size > 0 ? memcmp(a, b, size) : 0;
    return order != 0 ? order : (a_size > b_size) - (a_size < b_size);
}

static int compare_runs(const void *a, const void *b) {
    const oracle_obj_run *x = *(oracle_obj_run *const *)a, *y = *(oracle_obj_run *const *)b;
    int order = compare_bytes(x->name.bytes, x->name.size, y->name.bytes, y->name.size);
    return order != 0 ? order : (x > y) - (x < y);
}

static int compare_entries(const void *a, const void *b) {
    const oracle_mtl_entry *x = *(const oracle_mtl_entry *const *)a;
    const oracle_mtl_entry *y = *(const oracle_mtl_entry *const *)b;
    int order = strcmp(x->name, y->name);
    return order != 0 ? order : (x > y) - (x < y);
}

/* Sorts pointers to `count` elements of `size` bytes; *sorted is released with free(). */
static burnish_status sort_pointers(void *array, size_t count, size_t size,
                                    int (*compare)(const void *, const void *), void ***sorted,
                                    burnish_error *error) {
    void *memory;
    burnish_status status =
        oracle_legacy_allocate(&memory, count, sizeof(void *), "sorting materials", error);
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

static int compare_names(const oracle_mtl_entry *entry, oracle_token name) {
    return compare_bytes((const uint8_t *)entry->name, strlen(entry->name), name.bytes, name.size);
}

/* Gives every run its head, and every head its entry: one walk along two sorted lists. */
static void match_runs(void **runs, size_t run_count, void **entries, size_t entry_count) {
    size_t e = 0;
    const oracle_obj_run *head = NULL;
    for (size_t i = 0; i < run_count; ++i) {
        oracle_obj_run *run = runs[i];
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

static burnish_status add_material(oracle_obj_materials *materials,
                                   const burnish_material *material, uint32_t *index) {
    oracle_source *source = materials->source;
    if (source->material_count == MATERIAL_LIMIT) {
        return oracle_fail_at(materials->error, BURNISH_STATUS_LIMIT,
                              oracle_place_file(materials->input->name),
                              "more than %d materials are in use; merge some", MATERIAL_LIMIT);
    }
    burnish_status status = oracle_legacy_reserve(
        (void **)&source->materials, &source->material_capacity, source->material_count + 1,
        sizeof *source->materials, "materials", materials->error);
    if (status == BURNISH_STATUS_OK) {
        *index = (uint32_t)source->material_count;
        source->materials[source->material_count++] = *material;
    }
    return status;
}

static void warn_material(oracle_obj_materials *materials, oracle_token name) {
    oracle_place place = oracle_place_file(materials->input->name);
    if (name.size == 0 || materials->library_missing) {
        return;
    }
    if (materials->library_count == 0) {
        materials->library_missing = 1;
        oracle_warn_at(materials->source, place,
                       "usemtl without mtllib: its materials are burnish's grey");
        return;
    }
    oracle_warn_at(materials->source, place,
                   "material \"%s\" is in no material library; it is burnish's grey",
                   oracle_token_quote(name).text);
}

/* Numbers the materials in use in the order of the file; those in no library share one grey. */
static burnish_status number_materials(oracle_obj_materials *materials) {
    uint32_t grey = UINT32_MAX;
    for (size_t i = 0; i < materials->run_count; ++i) {
        oracle_obj_run *run = &materials->runs[i];
        burnish_status status = BURNISH_STATUS_OK;
        if (run->head != run) {
            run->material = run->head->material;
        } else if (run->entry) {
            status = add_material(materials, &run->entry->material, &run->material);
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
    return BURNISH_STATUS_OK;
}

static burnish_status write_triangle_materials(oracle_obj_materials *materials) {
    oracle_source *source = materials->source;
    if (source->material_count < 2) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status = oracle_legacy_reserve(
        (void **)&source->triangle_materials, &source->triangle_material_capacity,
        source->triangle_count, sizeof *source->triangle_materials, "triangle materials",
        materials->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    for (size_t i = 0; i < materials->run_count; ++i) {
        size_t end = i + 1 < materials->run_count ? materials->runs[i + 1].first_triangle
                                                  : source->triangle_count;
        for (size_t t = materials->runs[i].first_triangle; t < end; ++t) {
            source->triangle_materials[t] = (uint16_t)materials->runs[i].material;
        }
    }
    return BURNISH_STATUS_OK;
}

burnish_status oracle_obj_resolve_materials(oracle_obj_materials *materials) {
    void **runs = NULL, **entries = NULL;
    burnish_status status =
        sort_pointers(materials->runs, materials->run_count, sizeof *materials->runs, compare_runs,
                      &runs, materials->error);
    if (status == BURNISH_STATUS_OK) {
        status = sort_pointers(materials->library.entries, materials->library.count,
                               sizeof *materials->library.entries, compare_entries, &entries,
                               materials->error);
    }
    if (status == BURNISH_STATUS_OK) {
        match_runs(runs, materials->run_count, entries, materials->library.count);
        status = number_materials(materials);
    }
    free(entries);
    free(runs);
    return status == BURNISH_STATUS_OK ? write_triangle_materials(materials) : status;
}
