/* A cursor over the body of a PLY file: values, lists and rows. */
#include "mesh/read/ply_cursor.h"

#include <stdlib.h>
#include <string.h>

void burnish_ply_close(burnish_ply_cursor *ply) {
    burnish_number_reader_close(&ply->numbers);
    free(ply->corners);
    ply->corners = NULL;
    ply->corner_capacity = 0;
}

burnish_place burnish_ply_here(const burnish_ply_cursor *ply) {
    return burnish_ply_is_ascii(ply)
               ? burnish_place_line(ply->input->name, ply->text.line)
               : burnish_place_byte(ply->input->name,
                                    (size_t)(ply->value_start - ply->input->bytes));
}

static size_t bytes_left(const burnish_ply_cursor *ply) {
    return (size_t)(ply->text.end - ply->text.next);
}

uint64_t burnish_ply_room(const burnish_ply_cursor *ply, size_t binary_size) {
    uint64_t left = bytes_left(ply);
    return burnish_ply_is_ascii(ply) ? left / 2 + left % 2 : left / binary_size;
}

/* ---- values ---- */

static burnish_status fail_truncated(burnish_ply_cursor *ply) {
    return burnish_fail_at(ply->error, BURNISH_STATUS_FORMAT, burnish_ply_here(ply),
                           "the file ends in element %s, row %llu of %llu; it is truncated, fetch "
                           "it again",
                           burnish_token_quote(ply->element->name).text,
                           (unsigned long long)ply->row + 1,
                           (unsigned long long)ply->element->count);
}

static uint64_t load_bits(const uint8_t *p, size_t size, int big_endian) {
    uint64_t bits = 0;
    for (size_t i = 0; i < size; ++i) {
        bits = bits << 8 | p[big_endian ? i : size - 1 - i];
    }
    return bits;
}

static double decode(uint64_t bits, burnish_ply_type type) {
    uint32_t low = (uint32_t)bits;
    float single;
    double wide;
    switch (type) {
    case BURNISH_PLY_INT8:
        return (double)low - (low & 0x80u ? 256.0 : 0.0);
    case BURNISH_PLY_INT16:
        return (double)low - (low & 0x8000u ? 65536.0 : 0.0);
    case BURNISH_PLY_INT32:
        return (double)low - (low & 0x80000000u ? 4294967296.0 : 0.0);
    case BURNISH_PLY_FLOAT32:
        memcpy(&single, &low, sizeof single);
        return (double)single;
    case BURNISH_PLY_FLOAT64:
        memcpy(&wide, &bits, sizeof wide);
        return wide;
    default:
        return (double)low;
    }
}

static burnish_status read_word(burnish_ply_cursor *ply, double *value) {
    burnish_token word;
    burnish_number_status number;
    if (!burnish_text_word_double(&ply->text, &ply->numbers, &word, value, &number)) {
        return fail_truncated(ply);
    }
    if (number == BURNISH_NUMBER_NOT_FINITE || number == BURNISH_NUMBER_RANGE) {
        *value = __builtin_nan(""); /* whether that matters is the property's to say */
        return BURNISH_STATUS_OK;
    }
    return number == BURNISH_NUMBER_OK
               ? BURNISH_STATUS_OK
               : burnish_fail_number(ply->error, burnish_ply_here(ply), "value", word, number);
}

static burnish_status read_value(burnish_ply_cursor *ply, burnish_ply_type type, double *value) {
    ply->value_start = ply->text.next;
    if (burnish_ply_is_ascii(ply)) {
        return read_word(ply, value);
    }
    size_t size = burnish_ply_type_size(type);
    if (bytes_left(ply) < size) {
        return fail_truncated(ply);
    }
    int big_endian = ply->header->encoding == BURNISH_PLY_BIG_ENDIAN;
    *value = decode(load_bits(ply->text.next, size, big_endian), type);
    ply->text.next += size;
    return BURNISH_STATUS_OK;
}

/* The same for what should be a count or an index. */
static burnish_status read_count(burnish_ply_cursor *ply, burnish_ply_type type, double *value) {
    uint64_t count;
    if (!burnish_ply_is_ascii(ply) || !burnish_text_count(&ply->text, &count)) {
        return read_value(ply, type, value);
    }
    *value = (double)count;
    return BURNISH_STATUS_OK;
}

static burnish_status skip_values(burnish_ply_cursor *ply, burnish_ply_type type, uint64_t count) {
    ply->value_start = ply->text.next;
    if (count > burnish_ply_room(ply, burnish_ply_type_size(type))) {
        return fail_truncated(ply);
    }
    if (!burnish_ply_is_ascii(ply)) {
        ply->text.next += count * burnish_ply_type_size(type);
        return BURNISH_STATUS_OK;
    }
    for (; count > 0; --count) {
        burnish_token word;
        if (!burnish_text_word(&ply->text, &word)) {
            return fail_truncated(ply);
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_list_count(burnish_ply_cursor *ply, const burnish_ply_property *property,
                                      uint64_t *count) {
    double value;
    burnish_status status = read_count(ply, property->count_type, &value);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    *count = value >= 0 && value <= UINT32_MAX ? (uint64_t)value : UINT64_MAX;
    if ((double)*count != value) {
        return burnish_fail_at(ply->error, BURNISH_STATUS_FORMAT, burnish_ply_here(ply),
                               "element %s, row %llu: list length %g is no count; repair the file",
                               burnish_token_quote(ply->element->name).text,
                               (unsigned long long)ply->row + 1, value);
    }
    if (*count > burnish_ply_room(ply, burnish_ply_type_size(property->type))) {
        return burnish_fail_at(ply->error, BURNISH_STATUS_FORMAT, burnish_ply_here(ply),
                               "element %s, row %llu: a list of %llu values does not fit the rest "
                               "of the file; it is truncated or damaged, fetch it again",
                               burnish_token_quote(ply->element->name).text,
                               (unsigned long long)ply->row + 1, (unsigned long long)*count);
    }
    return BURNISH_STATUS_OK;
}

/* A strip may hold -1, which starts a new one. */
static burnish_status read_corners(burnish_ply_cursor *ply, const burnish_ply_property *property,
                                   uint64_t count) {
    burnish_status status =
        burnish_legacy_reserve((void **)&ply->corners, &ply->corner_capacity, (size_t)count,
                               sizeof *ply->corners, "corners", ply->error);
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        double value;
        status = read_count(ply, property->type, &value);
        if (status != BURNISH_STATUS_OK) {
            break;
        }
        int restart = value == -1 && ply->element->kind == BURNISH_PLY_ELEMENT_STRIPS;
        int inside = value >= 0 && value < (double)ply->vertex_count;
        uint32_t index = inside ? (uint32_t)value : BURNISH_SOURCE_NONE;
        if (!restart && (!inside || (double)index != value)) {
            return burnish_fail_at(ply->error, BURNISH_STATUS_FORMAT, burnish_ply_here(ply),
                                   "element %s, row %llu: vertex index %.10g is out of range; "
                                   "there are %zu vertices, counted from 0",
                                   burnish_token_quote(ply->element->name).text,
                                   (unsigned long long)ply->row + 1, value, ply->vertex_count);
        }
        ply->corners[i] = index;
    }
    ply->corner_count = (size_t)count;
    return status;
}

/* ---- rows ---- */

burnish_status burnish_ply_read_row(burnish_ply_cursor *ply) {
    const burnish_ply_property *property = ply->header->properties + ply->element->first_property;
    const burnish_ply_property *end = property + ply->element->property_count;
    burnish_status status = BURNISH_STATUS_OK;
    for (; property < end && status == BURNISH_STATUS_OK; ++property) {
        uint64_t count = 1;
        if (property->role < BURNISH_PLY_ROLE_COUNT) {
            status = read_value(ply, property->type, &ply->values[property->role]);
            if (property->role <= BURNISH_PLY_Z && status == BURNISH_STATUS_OK) {
                float unused;
                if (!burnish_double_to_float(ply->values[property->role], &unused)) {
                    return burnish_fail_at(ply->error, BURNISH_STATUS_FORMAT, burnish_ply_here(ply),
                                           "vertex %llu: coordinate %c is not finite or beyond "
                                           "3.4e38; repair the mesh",
                                           (unsigned long long)ply->row, 'x' + (int)property->role);
                }
            }
            continue;
        }
        if (property->count_type != BURNISH_PLY_NONE) {
            status = read_list_count(ply, property, &count);
        }
        if (status == BURNISH_STATUS_OK) {
            status = property->role == BURNISH_PLY_CORNERS
                         ? read_corners(ply, property, count)
                         : skip_values(ply, property->type, count);
        }
    }
    return status;
}

burnish_status burnish_ply_skip_row(burnish_ply_cursor *ply) {
    const burnish_ply_property *property = ply->header->properties + ply->element->first_property;
    const burnish_ply_property *end = property + ply->element->property_count;
    burnish_status status = BURNISH_STATUS_OK;
    for (; property < end && status == BURNISH_STATUS_OK; ++property) {
        uint64_t count = 1;
        if (property->count_type != BURNISH_PLY_NONE) {
            status = read_list_count(ply, property, &count);
        }
        if (status == BURNISH_STATUS_OK) {
            status = skip_values(ply, property->type, count);
        }
    }
    return status;
}

/* ---- vertices ---- */

/* floats count from 0 to 1, 16 bits to 65535, anything else to 255 */
static uint8_t to_color(double value, burnish_ply_type type) {
    if (type == BURNISH_PLY_FLOAT32 || type == BURNISH_PLY_FLOAT64) {
        value *= 255;
    } else if (type == BURNISH_PLY_UINT16) {
        value /= 257;
    }
    return (uint8_t)(value > 0 ? (value < 255 ? value + 0.5 : 255) : 0);
}

static int has_roles(const burnish_ply_cursor *ply, burnish_ply_role first, burnish_ply_role last) {
    for (int role = (int)first; role <= (int)last; ++role) {
        if (ply->types[role] == BURNISH_PLY_NONE) {
            return 0;
        }
    }
    return 1;
}

int burnish_ply_has_normals(const burnish_ply_cursor *ply) {
    return has_roles(ply, BURNISH_PLY_NX, BURNISH_PLY_NZ);
}

int burnish_ply_has_colors(const burnish_ply_cursor *ply) {
    return has_roles(ply, BURNISH_PLY_RED, BURNISH_PLY_BLUE);
}

void burnish_ply_get_position(const burnish_ply_cursor *ply, float position[3]) {
    for (int i = 0; i < 3; ++i) {
        burnish_double_to_float(ply->values[BURNISH_PLY_X + i], &position[i]);
    }
}

void burnish_ply_get_normal(const burnish_ply_cursor *ply, float normal[3]) {
    for (int i = 0; i < 3; ++i) {
        normal[i] = 0;
        burnish_double_to_float(ply->values[BURNISH_PLY_NX + i], &normal[i]);
    }
}

void burnish_ply_get_color(const burnish_ply_cursor *ply, uint8_t rgba[4]) {
    static const uint8_t black[4] = {0, 0, 0, 255};
    memcpy(rgba, black, sizeof black);
    for (int i = 0; i < 4; ++i) {
        if (ply->types[BURNISH_PLY_RED + i] != BURNISH_PLY_NONE) {
            rgba[i] = to_color(ply->values[BURNISH_PLY_RED + i], ply->types[BURNISH_PLY_RED + i]);
        }
    }
}
