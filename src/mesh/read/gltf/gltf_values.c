/* Members of glTF's objects. A member that is not of the specified kind fails, with its location.
 */
#include "mesh/read/gltf/gltf.h"

#include <stdarg.h>
#include <stdio.h>

enum { TEXT_SIZE = 260 };

/* "PATH: message" */
static void write_text(char text[TEXT_SIZE], const burnish_gltf *gltf, uint32_t value,
                       const char *format, va_list arguments) {
    const burnish_json_path path = burnish_json_path_of(&gltf->json, value);
    int used = *path.text ? snprintf(text, TEXT_SIZE, "%s: ", path.text) : 0;
    vsnprintf(text + used, TEXT_SIZE - (size_t)used, format, arguments);
}

static const uint8_t *text_of(const burnish_gltf *gltf, uint32_t value) {
    return value == BURNISH_JSON_NONE ? NULL : burnish_json_at(&gltf->json, value);
}

int burnish_gltf_fail(burnish_gltf *gltf, burnish_status status, uint32_t value, const char *format,
                      ...) {
    const int is_passed_over =
        gltf->is_lenient && status != BURNISH_STATUS_LIMIT && status != BURNISH_STATUS_MEMORY;
    if (gltf->status == BURNISH_STATUS_OK) {
        char text[TEXT_SIZE];
        va_list arguments;
        va_start(arguments, format);
        write_text(text, gltf, value, format, arguments);
        va_end(arguments);
        if (is_passed_over) {
            burnish_reader_note(gltf->reader, &gltf->odd_values, text_of(gltf, value),
                                "%s; ignored", text);
            return 0;
        }
        gltf->status = burnish_reader_fail(gltf->reader, status, text_of(gltf, value), "%s", text);
    }
    return 0;
}

void burnish_gltf_note(burnish_gltf *gltf, burnish_warning_group *group, uint32_t value,
                       const char *format, ...) {
    char text[TEXT_SIZE];
    va_list arguments;
    if (group->count > 0) { /* only the first is shown */
        ++group->count;
        return;
    }
    va_start(arguments, format);
    write_text(text, gltf, value, format, arguments);
    va_end(arguments);
    burnish_reader_note(gltf->reader, group, text_of(gltf, value), "%s", text);
}

int burnish_gltf_is_fine(burnish_gltf *gltf) {
    if (gltf->status == BURNISH_STATUS_OK) {
        gltf->status = gltf->memory->status;
    }
    return gltf->status == BURNISH_STATUS_OK;
}

/* A value of the wrong kind. Returns 0. */
static int fail_kind(burnish_gltf *gltf, uint32_t value, const char *expected) {
    const burnish_json_node *node = &gltf->json.nodes[value];
    const int is_string = node->kind == BURNISH_JSON_STRING;
    const burnish_token token = {
        burnish_json_at(&gltf->json, value) - is_string,
        node->kind >= BURNISH_JSON_ARRAY ? 1 : node->size + (is_string ? 2u : 0u)};
    const burnish_quote found = burnish_token_quote(token);
    return burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, value, "expected %s, found %s", expected,
                             found.text);
}

/* The member; a member of another kind counts as missing. */
static uint32_t typed_member(burnish_gltf *gltf, uint32_t object, const char *key,
                             burnish_json_kind kind, const char *expected) {
    const uint32_t value = burnish_json_member(&gltf->json, object, key);
    if (value == BURNISH_JSON_NONE || burnish_json_is_kind(&gltf->json, value, kind)) {
        return value;
    }
    fail_kind(gltf, value, expected);
    return BURNISH_JSON_NONE;
}

uint32_t burnish_gltf_object(burnish_gltf *gltf, uint32_t object, const char *key) {
    return typed_member(gltf, object, key, BURNISH_JSON_OBJECT, "an object");
}

uint32_t burnish_gltf_array(burnish_gltf *gltf, uint32_t object, const char *key) {
    return typed_member(gltf, object, key, BURNISH_JSON_ARRAY, "an array");
}

uint32_t burnish_gltf_extension(burnish_gltf *gltf, uint32_t object, const char *name) {
    return burnish_gltf_object(gltf, burnish_gltf_object(gltf, object, "extensions"), name);
}

/* Whether a value is a whole number of [0, most]. Doubles represent these numbers exactly, as
 * `most` is at most 2^53. */
static int read_whole(burnish_gltf *gltf, uint32_t value, uint64_t most, uint64_t *whole) {
    double number;
    if (burnish_json_number(&gltf->json, value, &number) && number >= 0 && number <= (double)most &&
        number == (double)(uint64_t)number) {
        *whole = (uint64_t)number;
        return 1;
    }
    char expected[64];
    snprintf(expected, sizeof expected, "a whole number from 0 to %llu", (unsigned long long)most);
    return fail_kind(gltf, value, expected);
}

uint64_t burnish_gltf_whole(burnish_gltf *gltf, uint32_t object, const char *key,
                            uint64_t otherwise, uint64_t most) {
    const uint32_t value = burnish_json_member(&gltf->json, object, key);
    uint64_t whole = otherwise;
    return value != BURNISH_JSON_NONE && read_whole(gltf, value, most, &whole) ? whole : otherwise;
}

double burnish_gltf_number(burnish_gltf *gltf, uint32_t object, const char *key, double otherwise) {
    const uint32_t value = burnish_json_member(&gltf->json, object, key);
    double number = otherwise;
    if (value != BURNISH_JSON_NONE && !burnish_json_number(&gltf->json, value, &number)) {
        fail_kind(gltf, value, "a number");
        number = otherwise;
    }
    return number;
}

int burnish_gltf_numbers(burnish_gltf *gltf, uint32_t object, const char *key, int count,
                         double *numbers) {
    const uint32_t array = burnish_gltf_array(gltf, object, key);
    double read[16];
    if (array == BURNISH_JSON_NONE) {
        return 0;
    }
    uint32_t item = array + 1;
    int good = burnish_json_length(&gltf->json, array) == (size_t)count && count <= 16;
    for (int i = 0; i < count && good; ++i) {
        good = burnish_json_number(&gltf->json, item, &read[i]);
        item = gltf->json.nodes[item].next;
    }
    if (!good) {
        char expected[32];
        snprintf(expected, sizeof expected, "%d numbers in []", count);
        return fail_kind(gltf, array, expected);
    }
    memcpy(numbers, read, (size_t)count * sizeof *numbers);
    return 1;
}

int burnish_gltf_flag(burnish_gltf *gltf, uint32_t object, const char *key, int otherwise) {
    const uint32_t value = burnish_json_member(&gltf->json, object, key);
    if (burnish_json_is_kind(&gltf->json, value, BURNISH_JSON_TRUE)) {
        return 1;
    }
    if (value == BURNISH_JSON_NONE ||
        burnish_json_is_kind(&gltf->json, value, BURNISH_JSON_FALSE)) {
        return value == BURNISH_JSON_NONE ? otherwise : 0;
    }
    fail_kind(gltf, value, "true or false");
    return otherwise;
}

static const char *const list_keys[BURNISH_GLTF_LIST_COUNT] = {
#define KEY(name, key) [BURNISH_GLTF_##name] = key,
    BURNISH_GLTF_LISTS(KEY)
#undef KEY
};

uint32_t burnish_gltf_item(burnish_gltf *gltf, uint32_t value, burnish_gltf_list list) {
    uint64_t whole = 0;
    if (!read_whole(gltf, value, BURNISH_GLTF_LIST_MAX, &whole)) {
        return BURNISH_GLTF_NONE;
    }
    if (whole < gltf->counts[list]) {
        return (uint32_t)whole;
    }
    burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, value,
                      "%llu is not in %s, of which there are %zu", (unsigned long long)whole,
                      list_keys[list], gltf->counts[list]);
    return BURNISH_GLTF_NONE;
}

uint32_t burnish_gltf_reference(burnish_gltf *gltf, uint32_t object, const char *key,
                                burnish_gltf_list list) {
    const uint32_t value = burnish_json_member(&gltf->json, object, key);
    return value == BURNISH_JSON_NONE ? BURNISH_GLTF_NONE : burnish_gltf_item(gltf, value, list);
}

uint32_t *burnish_gltf_items(burnish_gltf *gltf, uint32_t array, size_t *count) {
    *count = burnish_json_length(&gltf->json, array);
    if (*count > BURNISH_GLTF_LIST_MAX) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_LIMIT, array, "more than %zu items; split the file",
                          BURNISH_GLTF_LIST_MAX);
        *count = 0;
    }
    uint32_t *items = burnish_allocate(gltf->memory, *count, sizeof *items, "glTF's arrays");
    if (!items) {
        *count = 0;
        burnish_gltf_is_fine(gltf);
    }
    uint32_t item = array + 1;
    for (size_t i = 0; i < *count; ++i) {
        items[i] = item;
        item = gltf->json.nodes[item].next;
    }
    return items;
}
