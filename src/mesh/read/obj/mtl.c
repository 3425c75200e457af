/* MTL: the material library of an OBJ (Wavefront, "MTL material format", 1995).
 *
 * Read: newmtl, Ka, Kd, Ks, Ke (sRGB values, made linear; outside [0, 1] clamped), Ns, illum, d, Tr
 * and textures (mtl_maps.c). Everything else is ignored. A faulty statement is also ignored, with
 * one warning for all of them: a mesh with a wrong colour should still be drawn.
 *
 * Ka is unreliable: exporters write 1 1 1 or 0 0 0 whatever the material is. So the ambient colour
 * is Kd when Ka is absent, all 0 or all 1.
 *
 * d is opacity, Tr mostly 1 - d, but older exporters (3ds Max) write d 1 and Tr 1 for opaque
 * materials: if both are given, d counts. A material that is fully transparent is not intended, and
 * becomes opaque. */
#include "mesh/read/obj/mtl.h"

#include <string.h>

#include "core/srgb.h"

/* The statements of the current material, which finish_entry() converts. */
typedef struct mtl_state {
    burnish_reader *reader;
    burnish_mtl *library;
    size_t first; /* entries from earlier files */
    burnish_lexer lexer;
    float ambient[3], diffuse[3], specular[3], emissive[3], exponent; /* colours as written */
    int has_ambient, has_diffuse, has_specular, has_emissive, has_exponent;
    int matt, is_dull; /* illum 0 or 1, Ns 0: no highlight */
    burnish_warning_group unsupported, exponents, faults;
    float opacity, transparency; /* d and Tr as written */
    int has_opacity, has_transparency;
} mtl_state;

/* A malformed statement. */
#define NOTE_FAULT(mtl, ...)                                                                       \
    burnish_reader_note((mtl)->reader, &(mtl)->faults, (mtl)->lexer.next, __VA_ARGS__)

static int all_are(const float color[3], float value) {
    return color[0] == value && color[1] == value && color[2] == value;
}

static void set_linear(float linear[3], const float srgb[3]) {
    for (int i = 0; i < 3; ++i) {
        linear[i] = burnish_srgb_value_to_linear(srgb[i]);
    }
}

/* Completes the last entry of the library. */
static void finish_entry(mtl_state *mtl) {
    if (mtl->library->count == mtl->first) {
        return;
    }
    burnish_material *material = &mtl->library->entries[mtl->library->count - 1].material;
    float *factor = mtl->library->entries[mtl->library->count - 1].diffuse;
    for (int k = 0; k < 3; ++k) {
        const float value = mtl->has_diffuse ? mtl->diffuse[k] : 1;
        factor[k] = value > 0 ? value < 1 ? value : 1 : 0;
    }
    if (mtl->has_diffuse) {
        set_linear(material->diffuse, mtl->diffuse);
        memcpy(material->ambient, material->diffuse, sizeof material->ambient);
        material->has_diffuse = 1;
    }
    if (mtl->has_ambient && !all_are(mtl->ambient, 0) && !all_are(mtl->ambient, 1)) {
        set_linear(material->ambient, mtl->ambient);
    }
    if (mtl->has_specular) {
        set_linear(material->specular, mtl->specular);
    }
    if (mtl->has_emissive) {
        set_linear(material->emissive, mtl->emissive);
    }
    if (mtl->has_exponent) {
        material->exponent = mtl->exponent;
        material->has_exponent = 1;
    }
    if (mtl->matt || mtl->is_dull) {
        memset(material->specular, 0, sizeof material->specular);
    }
    float value = mtl->has_opacity        ? 1 - mtl->opacity
                  : mtl->has_transparency ? mtl->transparency
                                          : 0;
    value = value > 0 ? value : 0;
    mtl->library->entries[mtl->library->count - 1].is_invisible = value >= 1;
    material->transparency = value < 1 ? value : 0;
}

/* NULL: out of memory. */
static char *copy_text(mtl_state *mtl, burnish_token token) {
    char *copy = burnish_allocate(&mtl->reader->mesh->memory, token.size + 1, 1, "a name");
    if (copy) {
        memcpy(copy, token.bytes, token.size);
        copy[token.size] = 0;
    }
    return copy;
}

static burnish_status begin_entry(mtl_state *mtl) {
    burnish_token name = burnish_lexer_rest(&mtl->lexer);
    burnish_mtl *library = mtl->library;
    if (name.size == 0) {
        /* Blender writes a material without a name so, and then "usemtl" alone. */
        NOTE_FAULT(mtl, "newmtl has no name; faces without a material have this one");
    }
    burnish_memory *memory = &mtl->reader->mesh->memory;
    library->entries = burnish_reserve(memory, library->entries, &library->capacity,
                                       library->count + 1, sizeof *library->entries, "materials");
    char *copy = copy_text(mtl, name);
    if (memory->status != BURNISH_STATUS_OK) {
        burnish_release(memory->context, copy);
        return memory->status;
    }
    library->entries[library->count++] =
        (burnish_mtl_entry){.name = copy, .material = burnish_material_default()};
    mtl->has_ambient = mtl->has_diffuse = mtl->has_specular = mtl->has_exponent = mtl->matt = 0;
    mtl->has_emissive = mtl->is_dull = 0;
    mtl->has_opacity = mtl->has_transparency = 0;
    return BURNISH_STATUS_OK;
}

/* One colour: "r g b", or "r" for a grey. */
static void read_color(mtl_state *mtl, const char *what, float color[3], int *has) {
    burnish_token token;
    float values[3];
    int count = 0;
    while (count < 3 && burnish_lexer_token(&mtl->lexer, &token)) {
        if (count == 0 && (burnish_token_is(token, "spectral") || burnish_token_is(token, "xyz"))) {
            burnish_reader_note(mtl->reader, &mtl->unsupported, mtl->lexer.next,
                                "%s %s is not supported and was ignored", what,
                                burnish_token_quote(token).text);
            return;
        }
        burnish_number_status number = burnish_parse_float(token, &values[count]);
        if (number != BURNISH_NUMBER_OK) {
            NOTE_FAULT(mtl, "%s; the statement was ignored",
                       burnish_describe_number(what, token, number).text);
            return;
        }
        ++count;
    }
    if (count != 1 && count != 3) {
        NOTE_FAULT(mtl, "%s has %d numbers, not 3; the statement was ignored", what, count);
        return;
    }
    for (int i = 0; i < 3; ++i) {
        color[i] = values[count == 1 ? 0 : i];
    }
    *has = 1;
}

/* Returns 0 if there is none. */
static int read_number(mtl_state *mtl, const char *what, float *value) {
    burnish_token token;
    if (!burnish_lexer_token(&mtl->lexer, &token)) {
        NOTE_FAULT(mtl, "%s has no number; the statement was ignored", what);
        return 0;
    }
    burnish_number_status number = burnish_parse_float(token, value);
    if (number != BURNISH_NUMBER_OK) {
        NOTE_FAULT(mtl, "%s; the statement was ignored",
                   burnish_describe_number(what, token, number).text);
    }
    return number == BURNISH_NUMBER_OK;
}

static void read_exponent(mtl_state *mtl) {
    float written;
    if (!read_number(mtl, "Ns", &written)) {
        return;
    }
    mtl->exponent = written < 1 ? 1 : written > 65536 ? 65536 : written;
    mtl->has_exponent = 1;
    mtl->is_dull = written == 0;
    /* Exporters write Ns 0 for "dull", which deserves no warning. */
    if (mtl->exponent != written && written != 0) {
        burnish_reader_note(mtl->reader, &mtl->exponents, mtl->lexer.next,
                            "Ns %g is not in [1, 65536] and was taken as %g", (double)written,
                            (double)mtl->exponent);
    }
}

static void read_illumination(mtl_state *mtl) {
    float model;
    if (read_number(mtl, "illum", &model)) {
        mtl->matt = model == 0 || model == 1;
    }
}

/* d FACTOR, d -halo FACTOR, or Tr FACTOR. A factor that is not a number is ignored. */
static void read_opacity(mtl_state *mtl, float *value, int *has) {
    burnish_token token;
    int found = burnish_lexer_token(&mtl->lexer, &token);
    if (found && burnish_token_is(token, "-halo")) {
        burnish_reader_note(mtl->reader, &mtl->unsupported, mtl->lexer.next,
                            "d -halo is not drawn: the opacity is the same from all sides");
        found = burnish_lexer_token(&mtl->lexer, &token);
    }
    *has |= found && burnish_parse_float(token, value) == BURNISH_NUMBER_OK;
}

static burnish_status read_statement(mtl_state *mtl, burnish_token keyword) {
    static const char *const known[] = {"Ka", "Kd", "Ks", "Ns", "illum", "Ke"};
    int which = 0;
    if (burnish_token_is(keyword, "newmtl")) {
        finish_entry(mtl);
        return begin_entry(mtl);
    }
    while (which < 6 && !burnish_token_is(keyword, known[which])) {
        ++which;
    }
    if (which < 6 && mtl->library->count == mtl->first) {
        NOTE_FAULT(mtl, "%s before the first newmtl was ignored", known[which]);
        return BURNISH_STATUS_OK;
    }
    switch (which) {
    case 0:
        read_color(mtl, "Ka", mtl->ambient, &mtl->has_ambient);
        break;
    case 1:
        read_color(mtl, "Kd", mtl->diffuse, &mtl->has_diffuse);
        break;
    case 2:
        read_color(mtl, "Ks", mtl->specular, &mtl->has_specular);
        break;
    case 3:
        read_exponent(mtl);
        break;
    case 4:
        read_illumination(mtl);
        break;
    case 5:
        read_color(mtl, "Ke", mtl->emissive, &mtl->has_emissive);
        break;
    default:
        break;
    }
    if (mtl->library->count == mtl->first) {
        return BURNISH_STATUS_OK;
    }
    if (burnish_token_is(keyword, "d")) {
        read_opacity(mtl, &mtl->opacity, &mtl->has_opacity);
    } else if (burnish_token_is(keyword, "Tr")) {
        read_opacity(mtl, &mtl->transparency, &mtl->has_transparency);
    }
    if (burnish_mtl_is_map(keyword)) {
        burnish_mtl_read_map(mtl->reader, &mtl->library->entries[mtl->library->count - 1], keyword,
                             &mtl->lexer, &mtl->unsupported);
    }
    return mtl->reader->mesh->memory.status;
}

burnish_status burnish_read_mtl(burnish_reader *library_file, burnish_mtl *library) {
    mtl_state mtl = {
        .reader = library_file,
        .library = library,
        .first = library->count,
        .lexer = burnish_lexer_open(library_file->input->bytes, library_file->input->size, 1)};
    burnish_status status = BURNISH_STATUS_OK;
    do {
        burnish_token keyword;
        if (burnish_lexer_token(&mtl.lexer, &keyword)) {
            status = read_statement(&mtl, keyword);
        }
    } while (status == BURNISH_STATUS_OK && burnish_lexer_next_line(&mtl.lexer));
    finish_entry(&mtl);
    burnish_reader_warn_group(library_file, &mtl.unsupported);
    burnish_reader_warn_group(library_file, &mtl.exponents);
    burnish_reader_warn_group(library_file, &mtl.faults);
    return status;
}

void burnish_mtl_destroy(const burnish_context *context, burnish_mtl *library) {
    for (size_t i = 0; i < library->count; ++i) {
        burnish_release(context, library->entries[i].name);
        burnish_mtl_release_maps(context, &library->entries[i]);
    }
    burnish_release(context, library->entries);
    *library = (burnish_mtl){0};
}
