/* A cursor over the body of a PLY file: values, lists and rows. */
#include "oracle/ply_cursor.h"

#include <stdlib.h>
#include <string.h>

void oracle_ply_close(oracle_ply_cursor *ply) {
    oracle_number_reader_close(&ply->numbers);
    free(ply->corners);
    ply->corners = NULL;
    ply->corner_capacity = 0;
}

oracle_place oracle_ply_here(const oracle_ply_cursor *ply) {
    return oracle_ply_is_ascii(ply)
               ? oracle_place_line(ply->input->name, ply->text.line)
               : oracle_place_byte(ply->input->name,
                                   (size_t)(ply->value_start - ply->input->bytes));
}

static size_t bytes_left(const oracle_ply_cursor *ply) {
    return (size_t)(ply->text.end - ply->text.next);
}

uint64_t oracle_ply_room(const oracle_ply_cursor *ply, size_t binary_size) {
    uint64_t left = bytes_left(ply);
    return oracle_ply_is_ascii(ply) ? left / 2 + left % 2 : left / binary_size;
}

/* ---- values ---- */

static burnish_status fail_truncated(oracle_ply_cursor *ply) {
    return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, oracle_ply_here(ply),
                          "the file ends in element %s, row %llu of %llu; it is truncated, fetch "
                          "it again",
                          oracle_token_quote(ply->element->name).text,
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

static double decode(uint64_t bits, oracle_ply_type type) {
    uint32_t low = (uint32_t)bits;
    float single;
    double wide;
    switch (type) {
    case ORACLE_PLY_INT8:
        return (double)low - (low & 0x80u ? 256.0 : 0.0);
    case ORACLE_PLY_INT16:
        return (double)low - (low & 0x8000u ? 65536.0 : 0.0);
    case ORACLE_PLY_INT32:
        return (double)low - (low & 0x80000000u ? 4294967296.0 : 0.0);
    case ORACLE_PLY_FLOAT32:
        memcpy(&single, &low, sizeof single);
        return (double)single;
    case ORACLE_PLY_FLOAT64:
        memcpy(&wide, &bits, sizeof wide);
        return wide;
    default:
        return (double)low;
    }
}

static burnish_status read_word(oracle_ply_cursor *ply, double *value) {
    oracle_token word;
    oracle_number_status number;
    if (!oracle_text_word_double(&ply->text, &ply->numbers, &word, value, &number)) {
        return fail_truncated(ply);
    }
    if (number == ORACLE_NUMBER_NOT_FINITE || number == ORACLE_NUMBER_RANGE) {
        *value = __builtin_nan(""); /* whether that matters is the property's to say */
        return BURNISH_STATUS_OK;
    }
    return number == ORACLE_NUMBER_OK
               ? BURNISH_STATUS_OK
               : oracle_fail_number(ply->error, oracle_ply_here(ply), "value", word, number);
}

static burnish_status read_value(oracle_ply_cursor *ply, oracle_ply_type type, double *value) {
    ply->value_start = ply->text.next;
    if (oracle_ply_is_ascii(ply)) {
        return read_word(ply, value);
    }
    size_t size = oracle_ply_type_size(type);
    if (bytes_left(ply) < size) {
        return fail_truncated(ply);
    }
    int big_endian = ply->header->encoding == ORACLE_PLY_BIG_ENDIAN;
    *value = decode(load_bits(ply->text.next, size, big_endian), type);
    ply->text.next += size;
    return BURNISH_STATUS_OK;
}

/* The same for what should be a count or an index. */
static burnish_status read_count(oracle_ply_cursor *ply, oracle_ply_type type, double *value) {
    uint64_t count;
    if (!oracle_ply_is_ascii(ply) || !oracle_text_count(&ply->text, &count)) {
        return read_value(ply, type, value);
    }
    *value = (double)count;
    return BURNISH_STATUS_OK;
}

static burnish_status skip_values(oracle_ply_cursor *ply, oracle_ply_type type, uint64_t count) {
    ply->value_start = ply->text.next;
    if (count > oracle_ply_room(ply, oracle_ply_type_size(type))) {
        return fail_truncated(ply);
    }
    if (!oracle_ply_is_ascii(ply)) {
        ply->text.next += count * oracle_ply_type_size(type);
        return BURNISH_STATUS_OK;
    }
    for (; count > 0; --count) {
        oracle_token word;
        if (!oracle_text_word(&ply->text, &word)) {
            return fail_truncated(ply);
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_list_count(oracle_ply_cursor *ply, const oracle_ply_property *property,
                                      uint64_t *count) {
    double value;
    burnish_status status = read_count(ply, property->count_type, &value);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    *count = value >= 0 && value <= UINT32_MAX ? (uint64_t)value : UINT64_MAX;
    if ((double)*count != value) {
        return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, oracle_ply_here(ply),
                              "element %s, row %llu: list length %g is no count; repair the file",
                              oracle_token_quote(ply->element->name).text,
                              (unsigned long long)ply->row + 1, value);
    }
    if (*count > oracle_ply_room(ply, oracle_ply_type_size(property->type))) {
        return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, oracle_ply_here(ply),
                              "element %s, row %llu: a list of %llu values does not fit the rest "
                              "of the file; it is truncated or damaged, fetch it again",
                              oracle_token_quote(ply->element->name).text,
                              (unsigned long long)ply->row + 1, (unsigned long long)*count);
    }
    return BURNISH_STATUS_OK;
}

/* A strip may hold -1, which starts a new one. */
static burnish_status read_corners(oracle_ply_cursor *ply, const oracle_ply_property *property,
                                   uint64_t count) {
    burnish_status status =
        oracle_legacy_reserve((void **)&ply->corners, &ply->corner_capacity, (size_t)count,
                              sizeof *ply->corners, "corners", ply->error);
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        double value;
        status = read_count(ply, property->type, &value);
        if (status != BURNISH_STATUS_OK) {
            break;
        }
        int restart = value == -1 && ply->element->kind == ORACLE_PLY_ELEMENT_STRIPS;
        int inside = value >= 0 && value < (double)ply->vertex_count;
        uint32_t index = inside ? (uint32_t)value : ORACLE_SOURCE_NONE;
        if (!restart && (!inside || (double)index != value)) {
            return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, oracle_ply_here(ply),
                                  "element %s, row %llu: vertex index %.10g is out of range; "
                                  "there are %zu vertices, counted from 0",
                                  oracle_token_quote(ply->element->name).text,
                                  (unsigned long long)ply->row + 1, value, ply->vertex_count);
        }
        ply->corners[i] = index;
    }
    ply->corner_count = (size_t)count;
    return status;
}

/* ---- rows ---- */

burnish_status oracle_ply_read_row(oracle_ply_cursor *ply) {
    const oracle_ply_property *property = ply->header->properties + ply->element->first_property;
    const oracle_ply_property *end = property + ply->element->property_count;
    burnish_status status = BURNISH_STATUS_OK;
    for (; property < end && status == BURNISH_STATUS_OK; ++property) {
        uint64_t count = 1;
        if (property->role < ORACLE_PLY_ROLE_COUNT) {
            status = read_value(ply, property->type, &ply->values[property->role]);
            if (property->role <= ORACLE_PLY_Z && status == BURNISH_STATUS_OK) {
                float unused;
                if (!oracle_double_to_float(ply->values[property->role], &unused)) {
                    return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, oracle_ply_here(ply),
                                          "vertex %llu: coordinate %c is not finite or beyond "
                                          "3.4e38; repair the mesh",
                                          (unsigned long long)ply->row, 'x' + (int)property->role);
                }
            }
            continue;
        }
        if (property->count_type != ORACLE_PLY_NONE) {
            status = read_list_count(ply, property, &count);
        }
        if (status == BURNISH_STATUS_OK) {
            status = property->role == ORACLE_PLY_CORNERS ? read_corners(ply, property, count)
                                                          : skip_values(ply, property->type, count);
        }
    }
    return status;
}

burnish_status oracle_ply_skip_row(oracle_ply_cursor *ply) {
    const oracle_ply_property *property = ply->header->properties + ply->element->first_property;
    const oracle_ply_property *end = property + ply->element->property_count;
    burnish_status status = BURNISH_STATUS_OK;
    for (; property < end && status == BURNISH_STATUS_OK; ++property) {
        uint64_t count = 1;
        if (property->count_type != ORACLE_PLY_NONE) {
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
static uint8_t to_color(double value, oracle_ply_type type) {
    if (type == ORACLE_PLY_FLOAT32 || type == ORACLE_PLY_FLOAT64) {
        value *= 255;
    } else if (type == ORACLE_PLY_UINT16) {
        value /= 257;
    }
    return (uint8_t)(value > 0 ? (value < 255 ? value + 0.5 : 255) : 0);
}

static int has_roles(const oracle_ply_cursor *ply, oracle_ply_role first, oracle_ply_role last) {
    for (int role = (int)first; role <= (int)last; ++role) {
        if (ply->types[role] == ORACLE_PLY_NONE) {
            return 0;
        }
    }
    return 1;
}

int oracle_ply_has_normals(const oracle_ply_cursor *ply) {
    return has_roles(ply, ORACLE_PLY_NX, ORACLE_PLY_NZ);
}

int oracle_ply_has_colors(const oracle_ply_cursor *ply) {
    return has_roles(ply, ORACLE_PLY_RED, ORACLE_PLY_BLUE);
}

void oracle_ply_get_position(const oracle_ply_cursor *ply, float position[3]) {
    for (int i = 0; i < 3; ++i) {
        oracle_double_to_float(ply->values[ORACLE_PLY_X + i], &position[i]);
    }
}

void oracle_ply_get_normal(const oracle_ply_cursor *ply, float normal[3]) {
    for (int i = 0; i < 3; ++i) {
        normal[i] = 0;
        oracle_double_to_float(ply->values[ORACLE_PLY_NX + i], &normal[i]);
    }
}

void oracle_ply_get_color(const oracle_ply_cursor *ply, uint8_t rgba[4]) {
    static const uint8_t black[4] = {0, 0, 0, 255};
    memcpy(rgba, black, sizeof black);
    for (int i = 0; i < 4; ++i) {
        if (ply->types[ORACLE_PLY_RED + i] != ORACLE_PLY_NONE) {
            rgba[i] = to_color(ply->values[ORACLE_PLY_RED + i], ply->types[ORACLE_PLY_RED + i]);
        }
    }
}
