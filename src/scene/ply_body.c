/* The body of a PLY file: ASCII, little-endian or big-endian, read value by value as the header
 * says.
 *
 * ASCII values may be spread over lines in any way. Counts are held against the bytes that are left
 * before memory is taken for them. */
#include <string.h>

#include "scene/append.h"
#include "scene/ply.h"
#include "scene/ply_rows.h"

typedef struct ply_body {
    const burnish_reader_input *input;
    burnish_source *source;
    burnish_error *error;
    burnish_ply_header header;
    burnish_text text;          /* the cursor of both encodings; lines count in ASCII only */
    const uint8_t *value_start; /* of the value read last, for messages */
    burnish_number_reader numbers;

    const burnish_ply_element *element; /* being read */
    uint64_t row;
    size_t vertex_count;
    double values[BURNISH_PLY_ROLE_COUNT]; /* of a vertex */
    burnish_ply_type types[BURNISH_PLY_ROLE_COUNT];
    uint32_t *corners; /* of a face or of strips */
    size_t corner_count, corner_capacity;
    int warned_corners;
} ply_body;

static int is_ascii(const ply_body *ply) {
    return ply->header.encoding == BURNISH_PLY_ASCII;
}

static burnish_place here(const ply_body *ply) {
    return is_ascii(ply) ? burnish_place_line(ply->input->name, ply->text.line)
                         : burnish_place_byte(ply->input->name,
                                              (size_t)(ply->value_start - ply->input->bytes));
}

static size_t bytes_left(const ply_body *ply) {
    return (size_t)(ply->text.end - ply->text.next);
}

/* How many values of a type may still follow: in ASCII each takes a character and a blank. */
static uint64_t room_for(const ply_body *ply, size_t binary_size) {
    uint64_t left = bytes_left(ply);
    return is_ascii(ply) ? left / 2 + left % 2 : left / binary_size;
}

/* ---- values ---- */

static burnish_status fail_truncated(ply_body *ply) {
    return burnish_fail_at(ply->error, BURNISH_STATUS_FORMAT, here(ply),
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

static burnish_status read_word(ply_body *ply, double *value) {
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
               : burnish_fail_number(ply->error, here(ply), "value", word, number);
}

static burnish_status read_value(ply_body *ply, burnish_ply_type type, double *value) {
    ply->value_start = ply->text.next;
    if (is_ascii(ply)) {
        return read_word(ply, value);
    }
    size_t size = burnish_ply_type_size(type);
    if (bytes_left(ply) < size) {
        return fail_truncated(ply);
    }
    int big_endian = ply->header.encoding == BURNISH_PLY_BIG_ENDIAN;
    *value = decode(load_bits(ply->text.next, size, big_endian), type);
    ply->text.next += size;
    return BURNISH_STATUS_OK;
}

static burnish_status skip_values(ply_body *ply, burnish_ply_type type, uint64_t count) {
    ply->value_start = ply->text.next;
    if (count > room_for(ply, burnish_ply_type_size(type))) {
        return fail_truncated(ply);
    }
    if (!is_ascii(ply)) {
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

static burnish_status read_list_count(ply_body *ply, const burnish_ply_property *property,
                                      uint64_t *count) {
    double value;
    burnish_status status = read_value(ply, property->count_type, &value);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    *count = value >= 0 && value <= UINT32_MAX ? (uint64_t)value : UINT64_MAX;
    if ((double)*count != value) {
        return burnish_fail_at(ply->error, BURNISH_STATUS_FORMAT, here(ply),
                               "element %s, row %llu: list length %g is no count; repair the file",
                               burnish_token_quote(ply->element->name).text,
                               (unsigned long long)ply->row + 1, value);
    }
    if (*count > room_for(ply, burnish_ply_type_size(property->type))) {
        return burnish_fail_at(ply->error, BURNISH_STATUS_FORMAT, here(ply),
                               "element %s, row %llu: a list of %llu values does not fit the rest "
                               "of the file; it is truncated or damaged, fetch it again",
                               burnish_token_quote(ply->element->name).text,
                               (unsigned long long)ply->row + 1, (unsigned long long)*count);
    }
    return BURNISH_STATUS_OK;
}

/* A strip may hold -1, which starts a new one. */
static burnish_status read_corners(ply_body *ply, const burnish_ply_property *property,
                                   uint64_t count) {
    burnish_status status =
        burnish_grow((void **)&ply->corners, &ply->corner_capacity, (size_t)count,
                     sizeof *ply->corners, "corners", ply->error);
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        double value;
        status = read_value(ply, property->type, &value);
        if (status != BURNISH_STATUS_OK) {
            break;
        }
        int restart = value == -1 && ply->element->kind == BURNISH_PLY_ELEMENT_STRIPS;
        int inside = value >= 0 && value < (double)ply->vertex_count;
        uint32_t index = inside ? (uint32_t)value : BURNISH_SOURCE_NONE;
        if (!restart && (!inside || (double)index != value)) {
            return burnish_fail_at(ply->error, BURNISH_STATUS_FORMAT, here(ply),
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

static burnish_status read_row(ply_body *ply) {
    const burnish_ply_property *property = ply->header.properties + ply->element->first_property;
    const burnish_ply_property *end = property + ply->element->property_count;
    burnish_status status = BURNISH_STATUS_OK;
    for (; property < end && status == BURNISH_STATUS_OK; ++property) {
        uint64_t count = 1;
        if (property->role < BURNISH_PLY_ROLE_COUNT) {
            status = read_value(ply, property->type, &ply->values[property->role]);
            if (property->role <= BURNISH_PLY_Z && status == BURNISH_STATUS_OK) {
                float unused;
                if (!burnish_double_to_float(ply->values[property->role], &unused)) {
                    return burnish_fail_at(ply->error, BURNISH_STATUS_FORMAT, here(ply),
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

/* floats count from 0 to 1, 16 bits to 65535, anything else to 255 */
static uint8_t to_color(double value, burnish_ply_type type) {
    if (type == BURNISH_PLY_FLOAT32 || type == BURNISH_PLY_FLOAT64) {
        value *= 255;
    } else if (type == BURNISH_PLY_UINT16) {
        value /= 257;
    }
    return (uint8_t)(value > 0 ? (value < 255 ? value + 0.5 : 255) : 0);
}

static int has_roles(const ply_body *ply, burnish_ply_role first, burnish_ply_role last) {
    for (int role = (int)first; role <= (int)last; ++role) {
        if (ply->types[role] == BURNISH_PLY_NONE) {
            return 0;
        }
    }
    return 1;
}

static burnish_status append_vertex(ply_body *ply, int has_normals, int has_colors) {
    float position[3], normal[3];
    for (int i = 0; i < 3; ++i) {
        burnish_double_to_float(ply->values[BURNISH_PLY_X + i], &position[i]);
    }
    burnish_status status = burnish_append_position(ply->source, here(ply), position, ply->error);
    if (status == BURNISH_STATUS_OK && has_normals) {
        for (int i = 0; i < 3; ++i) {
            normal[i] = 0; /* stays when the file's is not finite: build makes one */
            burnish_double_to_float(ply->values[BURNISH_PLY_NX + i], &normal[i]);
        }
        status = burnish_append_normal(ply->source, here(ply), normal, ply->error);
    }
    if (status == BURNISH_STATUS_OK && has_colors) {
        uint8_t rgba[4] = {0, 0, 0, 255};
        for (int i = 0; i < 4; ++i) {
            if (ply->types[BURNISH_PLY_RED + i] != BURNISH_PLY_NONE) {
                rgba[i] =
                    to_color(ply->values[BURNISH_PLY_RED + i], ply->types[BURNISH_PLY_RED + i]);
            }
        }
        status = burnish_append_color(ply->source, rgba, ply->error);
    }
    return status;
}

static burnish_status append_face(ply_body *ply) {
    if (ply->corner_count < 3) {
        if (!ply->warned_corners++) {
            burnish_warn_at(ply->source, here(ply), "faces with fewer than 3 corners were ignored");
        }
        return BURNISH_STATUS_OK;
    }
    return burnish_append_polygon(ply->source, ply->input->options, here(ply), ply->corners, NULL,
                                  ply->corner_count, ply->error);
}

/* Triangles between three corners in a row, every second one the other way round; those that only
 * turn the strip (two corners the same) are left out. */
static burnish_status append_strips(ply_body *ply) {
    burnish_status status = BURNISH_STATUS_OK;
    size_t start = 0;
    for (size_t i = 0; i < ply->corner_count && status == BURNISH_STATUS_OK; ++i) {
        if (ply->corners[i] == BURNISH_SOURCE_NONE) {
            start = i + 1;
            continue;
        }
        if (i < start + 2) {
            continue;
        }
        size_t odd = (i - start) & 1;
        uint32_t corners[3] = {ply->corners[i - 2 + odd], ply->corners[i - 1 - odd],
                               ply->corners[i]};
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) {
            status = burnish_append_polygon(ply->source, ply->input->options, here(ply), corners,
                                            NULL, 3, ply->error);
        }
    }
    return status;
}

/* ---- elements ---- */

/* Holds the count against the bytes left. */
static burnish_status check_count(ply_body *ply, size_t *row_size, int *has_lists) {
    const burnish_ply_element *element = ply->element;
    *row_size = 0;
    *has_lists = 0;
    for (size_t i = 0; i < element->property_count; ++i) {
        const burnish_ply_property *property = &ply->header.properties[element->first_property + i];
        int is_list = property->count_type != BURNISH_PLY_NONE;
        *has_lists |= is_list;
        *row_size += is_ascii(ply)
                         ? 1
                         : burnish_ply_type_size(is_list ? property->count_type : property->type);
    }
    uint64_t room = *row_size == 0  ? UINT64_MAX
                    : is_ascii(ply) ? room_for(ply, 1) / *row_size
                                    : room_for(ply, *row_size);
    if (element->count > room) {
        return burnish_fail_at(ply->error, BURNISH_STATUS_FORMAT,
                               burnish_place_line(ply->input->name, element->line),
                               "element %s announces %llu rows, but the rest of the file has room "
                               "for %llu at most; it is truncated or damaged, fetch it again",
                               burnish_token_quote(element->name).text,
                               (unsigned long long)element->count, (unsigned long long)room);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status skip_element(ply_body *ply, size_t row_size, int has_lists) {
    if (row_size == 0) {
        return BURNISH_STATUS_OK;
    }
    if (!has_lists && !is_ascii(ply)) {
        ply->text.next += ply->element->count * row_size;
        return BURNISH_STATUS_OK;
    }
    burnish_status status = BURNISH_STATUS_OK;
    const burnish_ply_property *first = ply->header.properties + ply->element->first_property;
    for (ply->row = 0; ply->row < ply->element->count; ++ply->row) {
        for (size_t i = 0; i < ply->element->property_count; ++i) {
            uint64_t count = 1;
            if (first[i].count_type != BURNISH_PLY_NONE) {
                status = read_list_count(ply, &first[i], &count);
            }
            if (status == BURNISH_STATUS_OK) {
                status = skip_values(ply, first[i].type, count);
            }
            if (status != BURNISH_STATUS_OK) {
                return status;
            }
        }
    }
    return status;
}

static burnish_status begin_vertices(ply_body *ply) {
    const burnish_ply_element *element = ply->element;
    if (element->count > BURNISH_POSITION_LIMIT) {
        return burnish_fail_at(ply->error, BURNISH_STATUS_LIMIT,
                               burnish_place_line(ply->input->name, element->line),
                               "%llu vertices are more than %zu; split or simplify the mesh",
                               (unsigned long long)element->count, BURNISH_POSITION_LIMIT);
    }
    memset(ply->types, 0, sizeof ply->types);
    for (size_t i = 0; i < element->property_count; ++i) {
        const burnish_ply_property *property = &ply->header.properties[element->first_property + i];
        if (property->role < BURNISH_PLY_ROLE_COUNT) {
            ply->types[property->role] = property->type;
        }
    }
    return BURNISH_STATUS_OK;
}

/* Tries to convert all rows of a binary element at once; *done: whether that was possible. */
static burnish_status read_rows(ply_body *ply, int *done) {
    const burnish_ply_element *element = ply->element;
    burnish_ply_rows rows = {.bytes = ply->text.next,
                             .size = bytes_left(ply),
                             .count = (size_t)element->count,
                             .big_endian = ply->header.encoding == BURNISH_PLY_BIG_ENDIAN,
                             .properties = ply->header.properties + element->first_property,
                             .property_count = element->property_count};
    size_t used = 0;
    burnish_status status = BURNISH_STATUS_OK;
    if (is_ascii(ply) || element->count == 0 || element->kind == BURNISH_PLY_ELEMENT_STRIPS) {
        *done = 0;
        return BURNISH_STATUS_OK;
    }
    status = element->kind == BURNISH_PLY_ELEMENT_VERTEX
                 ? burnish_ply_vertex_rows(&rows, ply->source, &used, ply->error)
                 : burnish_ply_triangle_rows(&rows, ply->vertex_count, ply->input->options,
                                             ply->source, &used, ply->error);
    ply->text.next += used;
    *done = used > 0;
    return status;
}

static burnish_status read_element(ply_body *ply) {
    const burnish_ply_element *element = ply->element;
    int is_vertex = element->kind == BURNISH_PLY_ELEMENT_VERTEX, done = 0;
    burnish_status status = is_vertex ? begin_vertices(ply) : BURNISH_STATUS_OK;
    if (status == BURNISH_STATUS_OK) {
        status = read_rows(ply, &done);
    }
    if (status != BURNISH_STATUS_OK || done) {
        return status;
    }
    int has_normals = is_vertex && has_roles(ply, BURNISH_PLY_NX, BURNISH_PLY_NZ);
    int has_colors = is_vertex && has_roles(ply, BURNISH_PLY_RED, BURNISH_PLY_BLUE);
    for (ply->row = 0; ply->row < element->count && status == BURNISH_STATUS_OK; ++ply->row) {
        status = read_row(ply);
        if (status == BURNISH_STATUS_OK) {
            status = is_vertex ? append_vertex(ply, has_normals, has_colors)
                     : element->kind == BURNISH_PLY_ELEMENT_FACE ? append_face(ply)
                                                                 : append_strips(ply);
        }
    }
    return status;
}

/* Walks the body once; reads the vertices, the faces, or both, and passes over all else. */
static burnish_status walk(ply_body *ply, int vertices, int faces) {
    ply->text = (burnish_text){ply->input->bytes + ply->header.body_offset,
                               ply->input->bytes + ply->input->size, ply->header.body_line, 0};
    ply->value_start = ply->text.next;
    for (size_t i = 0; i < ply->header.element_count; ++i) {
        size_t row_size;
        int has_lists;
        ply->element = &ply->header.elements[i];
        ply->row = 0;
        burnish_status status = check_count(ply, &row_size, &has_lists);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        burnish_ply_kind kind = ply->element->kind;
        int read = kind == BURNISH_PLY_ELEMENT_VERTEX  ? vertices
                   : kind == BURNISH_PLY_ELEMENT_OTHER ? 0
                                                       : faces;
        status = read && row_size > 0 ? read_element(ply) : skip_element(ply, row_size, has_lists);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_body(ply_body *ply) {
    int faces_first = 0, has_faces = 0, has_vertices = 0;
    for (size_t i = 0; i < ply->header.element_count; ++i) {
        const burnish_ply_element *element = &ply->header.elements[i];
        if (element->kind == BURNISH_PLY_ELEMENT_VERTEX) {
            has_vertices = 1;
            ply->vertex_count = (size_t)element->count;
        } else if (element->kind != BURNISH_PLY_ELEMENT_OTHER && element->count > 0) {
            has_faces = 1;
            faces_first |= !has_vertices;
        }
    }
    burnish_status status = walk(ply, 1, !faces_first);
    if (status == BURNISH_STATUS_OK && faces_first) {
        status = walk(ply, 0, 1); /* polygons are cut by their positions */
    }
    if (status == BURNISH_STATUS_OK && ply->source->triangle_count == 0) {
        status =
            burnish_fail_at(ply->error, BURNISH_STATUS_FORMAT, burnish_place_file(ply->input->name),
                            has_faces ? "no face has 3 different corners; export the mesh again"
                                      : "a point cloud: no faces; make a surface of it first, "
                                        "for example with MeshLab");
    }
    return status;
}

/* A vertex and its normal have one index. */
static burnish_status copy_normal_indices(burnish_source *source, burnish_error *error) {
    if (source->normal_count == 0) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status =
        burnish_grow((void **)&source->corner_normals, &source->corner_normal_capacity,
                     source->triangle_count, 3 * sizeof(uint32_t), "normal indices", error);
    if (status == BURNISH_STATUS_OK) {
        memcpy(source->corner_normals, source->corner_positions,
               source->triangle_count * 3 * sizeof(uint32_t));
    }
    return status;
}

burnish_status burnish_read_ply(const burnish_reader_input *input, burnish_source *source,
                                burnish_error *error) {
    if (input->size == 0) {
        return burnish_fail_at(error, BURNISH_STATUS_FORMAT, burnish_place_byte(input->name, 0),
                               "the file is empty; fetch it again");
    }
    ply_body ply = {.input = input, .source = source, .error = error};
    burnish_status status = burnish_ply_read_header(input, &ply.header, error);
    if (status == BURNISH_STATUS_OK) {
        status = read_body(&ply);
    }
    if (status == BURNISH_STATUS_OK) {
        status = copy_normal_indices(source, error);
    }
    burnish_number_reader_close(&ply.numbers);
    burnish_ply_destroy_header(&ply.header);
    free(ply.corners);
    return status;
}
