/* MTL: the material library of an OBJ (Wavefront, "MTL material format", 1995).
 *
 * Read: newmtl, Ka, Kd, Ks (sRGB values, made linear; outside [0, 1] clamped), Ns, illum. All else,
 * maps and transparency among it, is passed over. Ka is unreliable: exporters write 1 1 1 or 0 0 0
 * whatever the material is. So the ambient colour is Kd when Ka is absent, all 0 or all 1. */
#include <string.h>

#include "core/srgb.h"
#include "oracle/mtl.h"
#include "oracle/text.h"

/* The statements seen for the material at hand; finish() makes it of them. */
typedef struct mtl_state {
    const char *name;
    oracle_mtl *library;
    size_t first; /* entries that were there before this file */
    oracle_source *source;
    burnish_error *error;
    oracle_text text;
    oracle_number_reader numbers;
    float ambient[3], diffuse[3], specular[3], exponent; /* colours as written */
    int has_ambient, has_diffuse, has_specular, has_exponent;
    int matt; /* illum 0 or 1: no highlight */
} mtl_state;

static oracle_place here(const mtl_state *mtl) {
    return oracle_place_line(mtl->name, mtl->text.line);
}

static int all_are(const float color[3], float value) {
    return color[0] == value && color[1] == value && color[2] == value;
}

static void set_linear(float linear[3], const float srgb[3]) {
    for (int i = 0; i < 3; ++i) {
        linear[i] = burnish_srgb_value_to_linear(srgb[i]);
    }
}

/* Completes the last entry of the library. */
static void finish(mtl_state *mtl) {
    if (mtl->library->count == mtl->first) {
        return;
    }
    burnish_material *material = &mtl->library->entries[mtl->library->count - 1].material;
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
    if (mtl->has_exponent) {
        material->exponent = mtl->exponent;
    }
    if (mtl->matt) {
        memset(material->specular, 0, sizeof material->specular);
    }
}

static burnish_status begin(mtl_state *mtl) {
    oracle_token name = oracle_text_rest(&mtl->text);
    oracle_mtl *library = mtl->library;
    if (name.size == 0) {
        return oracle_fail_at(mtl->error, BURNISH_STATUS_FORMAT, here(mtl),
                              "newmtl without a name; write newmtl NAME");
    }
    burnish_status status =
        oracle_legacy_reserve((void **)&library->entries, &library->capacity, library->count + 1,
                              sizeof *library->entries, "materials", mtl->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    char *copy = malloc(name.size + 1);
    if (!copy) {
        return burnish_fail_memory(mtl->error, "material name", name.size + 1);
    }
    memcpy(copy, name.bytes, name.size);
    copy[name.size] = 0;
    library->entries[library->count++] = (oracle_mtl_entry){copy, burnish_material_default()};
    mtl->has_ambient = mtl->has_diffuse = mtl->has_specular = mtl->has_exponent = mtl->matt = 0;
    return BURNISH_STATUS_OK;
}

/* One colour: "r g b", or "r" for a grey. */
static burnish_status read_color(mtl_state *mtl, const char *what, float color[3], int *has) {
    oracle_token token;
    int count = 0;
    while (count < 3 && oracle_text_token(&mtl->text, &token)) {
        if (count == 0 && (oracle_token_is(token, "spectral") || oracle_token_is(token, "xyz"))) {
            oracle_warn_at(mtl->source, here(mtl), "%s %s is not supported and was ignored", what,
                           oracle_token_quote(token).text);
            return BURNISH_STATUS_OK;
        }
        oracle_number_status number =
            oracle_parse_float(&mtl->numbers, token.bytes, token.size, &color[count]);
        if (number != ORACLE_NUMBER_OK) {
            return oracle_fail_number(mtl->error, here(mtl), what, token, number);
        }
        ++count;
    }
    if (count != 1 && count != 3) {
        return oracle_fail_at(mtl->error, BURNISH_STATUS_FORMAT, here(mtl),
                              "%s has %d numbers; write %s r g b", what, count, what);
    }
    if (count == 1) {
        color[1] = color[2] = color[0];
    }
    *has = 1;
    return BURNISH_STATUS_OK;
}

static burnish_status read_number(mtl_state *mtl, const char *what, float *value) {
    oracle_token token;
    if (!oracle_text_token(&mtl->text, &token)) {
        return oracle_fail_at(mtl->error, BURNISH_STATUS_FORMAT, here(mtl),
                              "%s has no number; write %s and its value", what, what);
    }
    oracle_number_status number = oracle_parse_float(&mtl->numbers, token.bytes, token.size, value);
    return number == ORACLE_NUMBER_OK
               ? BURNISH_STATUS_OK
               : oracle_fail_number(mtl->error, here(mtl), what, token, number);
}

static burnish_status read_exponent(mtl_state *mtl) {
    float written;
    burnish_status status = read_number(mtl, "Ns", &written);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    mtl->exponent = written < 1 ? 1 : written > 65536 ? 65536 : written;
    mtl->has_exponent = 1;
    /* Ns 0 is how exporters say "dull": no cause for a warning. */
    if (mtl->exponent != written && written != 0) {
        oracle_warn_at(mtl->source, here(mtl), "Ns %g is not in [1, 65536] and was taken as %g",
                       (double)written, (double)mtl->exponent);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_illumination(mtl_state *mtl) {
    float model;
    burnish_status status = read_number(mtl, "illum", &model);
    if (status == BURNISH_STATUS_OK) {
        mtl->matt = model == 0 || model == 1;
    }
    return status;
}

static burnish_status read_statement(mtl_state *mtl, oracle_token keyword) {
    static const char *const known[] = {"Ka", "Kd", "Ks", "Ns", "illum"};
    int which = 0;
    if (oracle_token_is(keyword, "newmtl")) {
        finish(mtl);
        return begin(mtl);
    }
    while (which < 5 && !oracle_token_is(keyword, known[which])) {
        ++which;
    }
    if (which < 5 && mtl->library->count == mtl->first) {
        return oracle_fail_at(mtl->error, BURNISH_STATUS_FORMAT, here(mtl),
                              "%s stands before the first newmtl; name a material first",
                              known[which]);
    }
    switch (which) {
    case 0:
        return read_color(mtl, "Ka", mtl->ambient, &mtl->has_ambient);
    case 1:
        return read_color(mtl, "Kd", mtl->diffuse, &mtl->has_diffuse);
    case 2:
        return read_color(mtl, "Ks", mtl->specular, &mtl->has_specular);
    case 3:
        return read_exponent(mtl);
    case 4:
        return read_illumination(mtl);
    default:
        return BURNISH_STATUS_OK;
    }
}

burnish_status oracle_read_mtl_into(const uint8_t *bytes, size_t size, const char *name,
                                    oracle_mtl *library, oracle_source *source,
                                    burnish_error *error) {
    mtl_state mtl = {.name = name,
                     .library = library,
                     .first = library->count,
                     .source = source,
                     .error = error,
                     .text = oracle_text_open(bytes, size, 1)};
    burnish_status status = BURNISH_STATUS_OK;
    do {
        oracle_token keyword;
        if (oracle_text_token(&mtl.text, &keyword)) {
            status = read_statement(&mtl, keyword);
        }
    } while (status == BURNISH_STATUS_OK && oracle_text_next_line(&mtl.text));
    finish(&mtl);
    oracle_number_reader_close(&mtl.numbers);
    return status;
}

burnish_status oracle_read_mtl(const uint8_t *bytes, size_t size, const char *name,
                               oracle_mtl *library, burnish_error *error) {
    return oracle_read_mtl_into(bytes, size, name, library, NULL, error);
}

void oracle_mtl_destroy(oracle_mtl *library) {
    if (!library) {
        return;
    }
    for (size_t i = 0; i < library->count; ++i) {
        free(library->entries[i].name);
    }
    free(library->entries);
    *library = (oracle_mtl){0};
}
