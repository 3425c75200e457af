/* Material libraries of an OBJ file, and which of its triangles have which material.
 *
 * Names are resolved at the end, sorted, so that a file of nothing but usemtl stays O(n log n); of
 * two materials with one name the first counts. */
#include "mesh/read/obj_materials.h"

#include <stdlib.h>
#include <string.h>

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
    if (!materials->changed) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status = burnish_legacy_reserve(
        (void **)&materials->runs, &materials->run_capacity, materials->run_count + 1,
        sizeof *materials->runs, "material runs", materials->error);
    if (status == BURNISH_STATUS_OK) {
        materials->runs[materials->run_count++] =
            (burnish_obj_run){.name = materials->name, .first_triangle = first_triangle};
        materials->changed = 0;
    }
    return status;
}

void burnish_obj_materials_close(burnish_obj_materials *materials) {
    burnish_mtl_destroy(&materials->library);
    free(materials->runs);
    *materials = (burnish_obj_materials){0};
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
static int pass_over_library(burnish_obj_materials *materials, burnish_place place,
                             burnish_token token) {
    for (size_t i = 0; i < materials->library_count; ++i) {
        if (same_path(materials->libraries[i], token)) {
            return 1;
        }
    }
    if (materials->library_count == BURNISH_OBJ_LIBRARIES) {
        if (!materials->warned_libraries++) {
            burnish_warn_at(materials->source, place,
                            "only the first %d material libraries are read; merge them",
                            BURNISH_OBJ_LIBRARIES);
        }
        return 1;
    }
    materials->libraries[materials->library_count++] = token;
    return 0;
}

/* Reads one library. *missing becomes 1 when the file is not there; nothing is reported then. */
static burnish_status open_library(burnish_obj_materials *materials, burnish_token token,
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
    status = burnish_read_mtl_into(bytes, size, name, &materials->library, materials->source,
                                   materials->error);
    free(bytes);
    return status;
}

static void warn_library(burnish_obj_materials *materials, burnish_place place, burnish_token token,
                         const burnish_error *why) {
    materials->library_missing = 1;
    burnish_warn_at(materials->source, place,
                    "material library \"%s\" was not read (%s); its materials are burnish's grey",
                    burnish_token_quote(token).text, why->text);
}

burnish_status burnish_obj_read_libraries(burnish_obj_materials *materials, burnish_text *text) {
    const burnish_place place = burnish_place_line(materials->input->name, text->line);
    burnish_text names = *text;
    burnish_token whole = burnish_text_rest(text), token;
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
    if (burnish_text_token(&names, &token) && token.size == whole.size) {
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

/* Sorts pointers to `count` elements of `size` bytes; *sorted is released with free(). */
static burnish_status sort_pointers(void *array, size_t count, size_t size,
                                    int (*compare)(const void *, const void *), void ***sorted,
                                    burnish_error *error) {
    void *memory;
    burnish_status status =
        burnish_legacy_allocate(&memory, count, sizeof(void *), "sorting materials", error);
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

static burnish_status add_material(burnish_obj_materials *materials,
                                   const burnish_material *material, uint32_t *index) {
    burnish_source *source = materials->source;
    if (source->material_count == MATERIAL_LIMIT) {
        return burnish_fail_at(materials->error, BURNISH_STATUS_LIMIT,
                               burnish_place_file(materials->input->name),
                               "more than %d materials are in use; merge some", MATERIAL_LIMIT);
    }
    burnish_status status = burnish_legacy_reserve(
        (void **)&source->materials, &source->material_capacity, source->material_count + 1,
        sizeof *source->materials, "materials", materials->error);
    if (status == BURNISH_STATUS_OK) {
        *index = (uint32_t)source->material_count;
        source->materials[source->material_count++] = *material;
    }
    return status;
}

static void warn_material(burnish_obj_materials *materials, burnish_token name) {
    burnish_place place = burnish_place_file(materials->input->name);
    if (name.size == 0 || materials->library_missing) {
        return;
    }
    if (materials->library_count == 0) {
        materials->library_missing = 1;
        burnish_warn_at(materials->source, place,
                        "usemtl without mtllib: its materials are burnish's grey");
        return;
    }
    burnish_warn_at(materials->source, place,
                    "material \"%s\" is in no material library; it is burnish's grey",
                    burnish_token_quote(name).text);
}

/* Numbers the materials in use in the order of the file; those in no library share one grey. */
static burnish_status number_materials(burnish_obj_materials *materials) {
    uint32_t grey = UINT32_MAX;
    for (size_t i = 0; i < materials->run_count; ++i) {
        burnish_obj_run *run = &materials->runs[i];
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

static burnish_status write_triangle_materials(burnish_obj_materials *materials) {
    burnish_source *source = materials->source;
    if (source->material_count < 2) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status = burnish_legacy_reserve(
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

burnish_status burnish_obj_resolve_materials(burnish_obj_materials *materials) {
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
