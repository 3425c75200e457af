/* PLY (G. Turk, "The PLY Polygon File Format", 1994): the body, element by element.
 *
 * Rows are read one after the other (ply_rows.c). Binary rows that all have one size need no
 * decoding to be found: all threads convert vertices column by column, and triangles row by row
 * (ply_binary.c). */
#include "base/numbers.h"
#include "mesh/read/common/points.h"
#include "mesh/read/common/splats.h"
#include "mesh/read/common/textures.h"
#include "mesh/read/common/triangulate.h"
#include "mesh/read/io/budget.h"
#include "mesh/read/io/parallel_text.h"
#include "mesh/read/io/streaming.h"
#include "mesh/read/ply/ply_binary.h"
#include "mesh/read/ply/ply_header.h"
#include "mesh/read/ply/ply_packed.h"
#include "mesh/read/ply/ply_rows.h"

/* ---- Binary rows of one size ---- */

/* Vertices from `first` on with a coordinate that is not finite. */
static void note_bad_vertices(burnish_ply_state *ply, const burnish_ply_rows *rows,
                              const uint8_t *at, size_t first) {
    const burnish_mesh_data *mesh = ply->reader->mesh;
    for (size_t i = first; i < mesh->streams[BURNISH_POSITION].count; ++i) {
        const float *p = burnish_positions(mesh) + 3 * i;
        int axis = 0;
        while (axis < 3 && burnish_is_finitef(p[axis])) {
            ++axis;
        }
        if (axis < 3) {
            burnish_reader_note(
                ply->reader, &ply->reader->damage,
                at + i * rows->row_size + rows->columns[BURNISH_PLY_X + axis].offset,
                "vertex %zu: coordinate %c is not finite or beyond 3.4e38; repair the mesh", i,
                'x' + axis);
        }
    }
}

/* All values of the vertices, whose rows are all there. */
static burnish_status read_vertices(burnish_ply_state *ply, burnish_ply_rows *rows,
                                    const uint8_t **at) {
    static const int last_roles[BURNISH_ATTRIBUTE_COUNT] = {
        BURNISH_PLY_Z, BURNISH_PLY_NZ, BURNISH_PLY_BLUE,
        BURNISH_PLY_T, [BURNISH_SPLAT] = BURNISH_PLY_OPACITY};
    static const int first_roles[BURNISH_ATTRIBUTE_COUNT] = {
        BURNISH_PLY_X, BURNISH_PLY_NX, BURNISH_PLY_RED,
        BURNISH_PLY_S, [BURNISH_SPLAT] = BURNISH_PLY_SCALE};
    burnish_mesh_data *mesh = ply->reader->mesh;
    const size_t count = (size_t)ply->element->count;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        if (last_roles[i] > 0 && burnish_ply_has_roles(ply, first_roles[i], last_roles[i])) {
            if (burnish_mesh_data_reserve(mesh, (burnish_attribute)i, count) != BURNISH_STATUS_OK) {
                return mesh->memory.status;
            }
            mesh->streams[i].count = count;
        }
    }
    const burnish_status status =
        burnish_reader_rows(ply->reader, (size_t)(*at - ply->reader->input->bytes), rows->row_size,
                            count, burnish_ply_convert_vertices, rows);
    const size_t odd = atomic_load(&rows->odd);
    if (status == BURNISH_STATUS_OK && odd < count && !ply->header.may_lack) {
        note_bad_vertices(ply, rows, *at, odd);
    }
    *at += count * rows->row_size;
    return status == BURNISH_STATUS_OK && ply->reader->has_warned
               ? burnish_stop_streaming(ply->reader)
               : status;
}

static burnish_status convert_face_colors(burnish_ply_state *ply, burnish_ply_rows *rows,
                                          size_t offset, size_t count) {
    burnish_mesh_data *mesh = ply->reader->mesh;
    burnish_stream *colors = &mesh->streams[BURNISH_COLOR];
    colors->items = burnish_reserve(&mesh->memory, colors->items, &colors->capacity,
                                    rows->first_triangle + count, 4, "colours of faces");
    if (mesh->memory.status != BURNISH_STATUS_OK) {
        return mesh->memory.status;
    }
    colors->count = rows->first_triangle + count;
    return burnish_reader_rows(ply->reader, offset, rows->row_size, count,
                               burnish_ply_convert_face_colors, rows);
}

/* Whether the first row at `offset` of rows with one list is a triangle. */
static int begins_with_triangle(const burnish_ply_state *ply, const burnish_ply_rows *rows,
                                size_t offset) {
    uint8_t buffer[8];
    const uint8_t *length = burnish_reader_peek(ply->reader, offset + rows->length.offset,
                                                burnish_ply_type_size(rows->length.type), buffer);
    return length && burnish_ply_load_count(length, rows->length.type, rows->big_endian) == 3;
}

/* Reads the triangles at the start of the element. burnish_ply_read_rows() continues from the first
 * row that is not a triangle. */
static burnish_status read_triangles(burnish_ply_state *ply, burnish_ply_rows *rows,
                                     const uint8_t **at) {
    burnish_mesh_data *mesh = ply->reader->mesh;
    burnish_stream *positions = &mesh->streams[BURNISH_POSITION];
    const size_t limit = (size_t)ply->reader->input->options->max_triangles;
    const size_t left = (size_t)(ply->reader->input->bytes + ply->reader->input->size - *at);
    size_t count = (size_t)ply->element->count;
    count = count < left / rows->row_size ? count : left / rows->row_size;
    count = count < limit - mesh->triangle_count ? count : limit - mesh->triangle_count;
    const size_t offset = (size_t)(*at - ply->reader->input->bytes);
    burnish_status status =
        burnish_budget_check(ply->reader, positions->count, mesh->triangle_count + count);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (count > 0 && begins_with_triangle(ply, rows, offset)) {
        if (!positions->corners) { /* no more than it takes */
            burnish_mesh_data_reserve_corners(mesh, BURNISH_POSITION, count);
        }
        positions->corners = burnish_reserve(
            &mesh->memory, positions->corners, &positions->corner_capacity,
            mesh->triangle_count + count, 3 * sizeof *positions->corners, "triangles");
        if (mesh->memory.status != BURNISH_STATUS_OK) {
            return mesh->memory.status;
        }
        atomic_store(&rows->odd, count);
        rows->first_triangle = mesh->triangle_count;
        status = burnish_reader_rows(ply->reader, offset, rows->row_size, count,
                                     burnish_ply_convert_triangles, rows);
        ply->first_row = atomic_load(&rows->odd);
        if (status == BURNISH_STATUS_OK && ply->takes_face_colors) {
            status = convert_face_colors(ply, rows, offset, ply->first_row);
        }
        mesh->triangle_count += ply->first_row;
        *at += ply->first_row * rows->row_size;
    }
    return status == BURNISH_STATUS_OK && ply->first_row < ply->element->count
               ? burnish_ply_read_rows(ply, at, (size_t)ply->element->count - ply->first_row)
               : status;
}

/* ---- Elements ---- */

/* Whether S is a quantity alone. */
static int is_quantity(const burnish_ply_state *ply) {
    return ply->reader->input->options->scalar_property || ply->header.tint;
}

/* The layout of a row: its least size, the offsets of its columns if all lists have 3 items, and
 * how many lists there are. */
static size_t describe_rows(const burnish_ply_state *ply, burnish_ply_rows *rows, size_t *least) {
    const burnish_ply_element *element = ply->element;
    const int is_ascii = ply->header.encoding == BURNISH_PLY_ASCII;
    size_t lists = 0;
    *least = 0;
    for (size_t i = 0; i < element->property_count; ++i) {
        const burnish_ply_property *property = &ply->header.properties[element->first_property + i];
        const size_t size = burnish_ply_type_size(property->type);
        const int is_list = property->count_type != BURNISH_PLY_NONE;
        const size_t length = burnish_ply_type_size(property->count_type);
        *least += is_ascii ? 1 : is_list ? length : size;
        if (is_list) {
            rows->length = (burnish_ply_column){rows->row_size, property->count_type};
            rows->corners = (burnish_ply_column){rows->row_size + length, property->type};
            ++lists;
        } else if (property->role < BURNISH_PLY_ROLE_COUNT) {
            rows->columns[property->role] = (burnish_ply_column){rows->row_size, property->type};
            if (property->role == BURNISH_PLY_S && is_quantity(ply)) {
                rows->columns[BURNISH_PLY_T] = rows->columns[BURNISH_PLY_S];
            }
        }
        rows->row_size += is_list ? length + 3 * size : size;
    }
    return lists;
}

/* Compares the announced count with the remaining bytes. */
static burnish_status check_count(const burnish_ply_state *ply, size_t left, size_t least) {
    burnish_reader *reader = ply->reader;
    const burnish_ply_element *element = ply->element;
    const int is_ascii = ply->header.encoding == BURNISH_PLY_ASCII, was_binary = reader->is_binary;
    const uint64_t room = least == 0 || ply->by_lines ? UINT64_MAX
                          : is_ascii                  ? (left / 2 + left % 2) / least
                                                      : left / least;
    burnish_status status = BURNISH_STATUS_OK;
    reader->is_binary = 0;
    if (element->count > room) {
        status = burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, element->at,
                                     "element %s announces %llu rows, but the rest of the file has "
                                     "room for %llu at most; the file is truncated or damaged",
                                     burnish_token_quote(element->name).text,
                                     (unsigned long long)element->count, (unsigned long long)room);
    } else if (element->kind == BURNISH_PLY_ELEMENT_VERTEX &&
               element->count > BURNISH_VALUE_LIMIT && !ply->header.is_open) {
        status = burnish_reader_fail(reader, BURNISH_STATUS_LIMIT, element->at,
                                     "%llu vertices are more than %zu; split or simplify the mesh",
                                     (unsigned long long)element->count, BURNISH_VALUE_LIMIT);
    }
    reader->is_binary = was_binary;
    return status;
}

/* Whether a value of the type may be more than a float holds. */
static int is_wide(burnish_ply_type type) {
    return type == BURNISH_PLY_FLOAT64 || (type >= BURNISH_PLY_INT32 && type < BURNISH_PLY_FLOAT32);
}

/* Whether rows with one list may be triangles. */
static int may_be_triangles(const burnish_ply_element *element, const burnish_ply_rows *rows) {
    return element->kind == BURNISH_PLY_ELEMENT_FACE && rows->length.type < BURNISH_PLY_FLOAT32 &&
           rows->corners.type < BURNISH_PLY_FLOAT32;
}

/* Whether all rows of a streamed file seem to be of one size per element, faces triangles; those
 * of an ASCII file may be anything. */
static int suits_streaming(burnish_ply_state *ply) {
    const burnish_reader_input *input = ply->reader->input;
    size_t offset = (size_t)(ply->header.body - input->bytes);
    int suits = ply->header.texture_count == 0 && !ply->reader->has_warned &&
                offset < input->streamed->head; /* all of the header */
    const int is_ascii = ply->header.encoding == BURNISH_PLY_ASCII;
    for (size_t i = 0; i < ply->header.element_count && suits && !is_ascii; ++i) {
        burnish_ply_rows rows = {.big_endian = ply->header.encoding == BURNISH_PLY_BIG_ENDIAN};
        size_t least;
        ply->element = &ply->header.elements[i];
        const uint64_t count = ply->element->count;
        const size_t lists = describe_rows(ply, &rows, &least);
        if (count == 0 || rows.row_size == 0) {
            continue;
        }
        suits = count <= (input->size - offset) / rows.row_size &&
                (lists == 0 || (lists == 1 && may_be_triangles(ply->element, &rows) &&
                                begins_with_triangle(ply, &rows, offset)));
        offset += suits ? (size_t)count * rows.row_size : 0;
    }
    return suits;
}

/* Reads or skips one element from *at on. */
static burnish_status read_element(burnish_ply_state *ply, const uint8_t **at) {
    const burnish_ply_element *element = ply->element;
    const size_t left = (size_t)(ply->reader->input->bytes + ply->reader->input->size - *at);
    const int is_ascii = ply->header.encoding == BURNISH_PLY_ASCII;
    burnish_ply_rows rows = {.big_endian = ply->header.encoding == BURNISH_PLY_BIG_ENDIAN,
                             .vertex_count = ply->vertex_count,
                             .scale = ply->header.scale,
                             .offset = ply->header.offset,
                             .mesh = ply->reader->mesh};
    size_t least;
    const size_t lists = describe_rows(ply, &rows, &least);
    burnish_status status = check_count(ply, left, least);
    if (status == BURNISH_STATUS_OK && element->kind == BURNISH_PLY_ELEMENT_VERTEX &&
        !ply->header.is_open) {
        status = burnish_budget_check(ply->reader, element->count, 0);
    }
    if (status != BURNISH_STATUS_OK || least == 0 || element->count == 0) {
        return status;
    }
    atomic_init(&rows.odd, SIZE_MAX);
    ply->first_row = 0;
    if (element->kind == BURNISH_PLY_ELEMENT_VERTEX) {
        for (int i = 0; i < BURNISH_PLY_ROLE_COUNT; ++i) {
            ply->types[i] = rows.columns[i].type;
        }
        for (int i = BURNISH_PLY_X; i <= BURNISH_PLY_Z; ++i) {
            ply->reader->is_wide |= is_ascii || is_wide(ply->types[i]);
        }
        if (!ply->keeps_coordinates || ply->takes_face_coordinates) {
            ply->types[BURNISH_PLY_S] = BURNISH_PLY_NONE;
        }
        for (int i = 0; i < 3 && ply->types[BURNISH_PLY_PACKED] != BURNISH_PLY_NONE; ++i) {
            ply->types[BURNISH_PLY_RED + i] = BURNISH_PLY_UINT8;
        }
    }
    ply->takes_face_colors =
        element->kind == BURNISH_PLY_ELEMENT_FACE && ply->header.has_face_colors &&
        (!ply->header.has_vertex_colors || ply->ignores_vertex_colors) &&
        ply->reader->mesh->streams[BURNISH_COLOR].count == ply->reader->mesh->triangle_count;
    for (int i = 0; i < BURNISH_PLY_ROLE_COUNT && ply->takes_face_colors; ++i) {
        ply->face_types[i] = rows.columns[i].type;
    }
    if (!is_ascii && lists == 0 && element->kind == BURNISH_PLY_ELEMENT_VERTEX) {
        return read_vertices(ply, &rows, at);
    }
    if (!is_ascii && lists == 0) { /* every face has corners */
        *at += element->count * rows.row_size;
        return BURNISH_STATUS_OK;
    }
    if (!is_ascii && lists == 1 && may_be_triangles(element, &rows)) {
        return read_triangles(ply, &rows, at);
    }
    return burnish_ply_read_rows(ply, at, (size_t)element->count);
}

/* Whether the first line of an element's rows is a whole row. Rows that are too short may still end
 * where lines do, so each row's end is checked again while reading. */
static int first_line_is_row(const burnish_ply_state *ply, const uint8_t *at) {
    enum { LONG = 1 << 12 };
    const burnish_ply_element *element = ply->element;
    const burnish_reader_input *input = ply->reader->input;
    uint8_t buffer[LONG];
    const size_t left = (size_t)(input->bytes + input->size - at),
                 size = input->streamed && left > LONG ? LONG : left;
    const uint8_t *text =
        burnish_reader_peek(ply->reader, (size_t)(at - input->bytes), size, buffer);
    burnish_lexer line = {text, text ? text + size : text, 0};
    burnish_token token;
    burnish_lexer_skip_blank_lines(&line);
    for (size_t i = 0; i < element->property_count; ++i) {
        int64_t count = 1;
        if (ply->header.properties[element->first_property + i].count_type != BURNISH_PLY_NONE &&
            (!burnish_lexer_token(&line, &token) ||
             burnish_parse_integer(token, &count) != BURNISH_NUMBER_OK)) {
            return 0;
        }
        for (; count > 0; --count) {
            if (!burnish_lexer_token(&line, &token)) {
                return 0;
            }
        }
    }
    return !burnish_lexer_token(&line, &token);
}

/* *left: bytes of an ASCII file after the last row and blanks. */
/* Vertices that all have one colour say less than the faces, whose colours are taken then. */
static void judge_colors(burnish_ply_state *ply) {
    burnish_mesh_data *mesh = ply->reader->mesh;
    const burnish_stream *stream = &mesh->streams[BURNISH_COLOR];
    const uint8_t *colors = stream->items;
    size_t i = 1;
    while (i < stream->count && memcmp(colors, colors + 4 * i, 4) == 0) {
        ++i;
    }
    if (stream->count > 0 && i == stream->count) {
        burnish_mesh_data_drop(mesh, BURNISH_COLOR);
        ply->per_triangle |= 1U << BURNISH_COLOR;
        ply->ignores_vertex_colors = 1;
    }
}

static burnish_status read_elements(burnish_ply_state *ply, size_t *left) {
    const uint8_t *at = ply->header.body,
                  *end = ply->reader->input->bytes + ply->reader->input->size;
    burnish_status status = BURNISH_STATUS_OK;
    ply->few_corners = ply->fields = (burnish_warning_group){0};
    ply->reader->damage = (burnish_warning_group){0};
    ply->reader->odd = ply->header_odd;
    ply->per_triangle = (unsigned)(ply->header.has_face_colors && !ply->header.has_vertex_colors)
                            << BURNISH_COLOR |
                        (unsigned)ply->takes_face_coordinates << BURNISH_TEXCOORD;
    ply->ignores_vertex_colors = 0;
    ply->run_start = 0;
    ply->run_texture = 0;
    for (size_t i = 0; i < ply->header.element_count && status == BURNISH_STATUS_OK; ++i) {
        ply->element = &ply->header.elements[i];
        if (ply->header.encoding == BURNISH_PLY_ASCII && ply->element->count > 0 &&
            ply->element->property_count > 0 && !ply->by_lines && !first_line_is_row(ply, at)) {
            ply->is_odd = 1;
        }
        status = read_element(ply, &at);
        if (status == BURNISH_STATUS_OK && ply->element->kind == BURNISH_PLY_ELEMENT_VERTEX &&
            ply->header.has_vertex_colors && ply->header.has_face_colors) {
            judge_colors(ply);
        }
    }
    while (!ply->reader->is_binary && !ply->reader->input->streamed && at < end &&
           (burnish_is_blank(*at) || burnish_is_line_end(*at))) {
        ++at;
    }
    *left = (size_t)(end - at);
    return status;
}

/* Whether an ASCII body has as many lines, but for blank ones, as rows. */
static int rows_are_lines(const burnish_ply_state *ply) {
    const uint8_t *end = ply->reader->input->bytes + ply->reader->input->size;
    burnish_lexer lexer = {ply->header.body, end, 0};
    uint64_t lines = 0, rows = 0;
    for (size_t i = 0; i < ply->header.element_count; ++i) {
        const burnish_ply_element *element = &ply->header.elements[i];
        const uint64_t count = element->property_count > 0 ? element->count : 0;
        rows = rows + count < rows ? UINT64_MAX : rows + count;
    }
    burnish_lexer_skip_blank_lines(&lexer);
    while (lexer.next < end) {
        ++lines;
        lexer.next = burnish_ply_line_end(lexer.next, end);
        burnish_lexer_skip_blank_lines(&lexer);
    }
    return lines == rows;
}

/* Reads the body once more, from the beginning. */
static burnish_status read_again(burnish_ply_state *ply, int by_lines, size_t *left) {
    burnish_reader *reader = ply->reader;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        burnish_mesh_data_drop(reader->mesh, (burnish_attribute)i);
    }
    reader->mesh->triangle_count = reader->polygon_count = 0;
    if (reader->error) {
        *reader->error = (burnish_error){0};
    }
    ply->by_lines = by_lines;
    return read_elements(ply, left);
}

/* A body that could not be read may have comments, or lines with too few or too many values. */
static burnish_status read_otherwise(burnish_ply_state *ply, burnish_status first, size_t *left) {
    int any;
    burnish_status status = burnish_ply_hide_comments(ply, &any);
    if (status == BURNISH_STATUS_OK && any) {
        ply->is_odd = 0;
        status = first = read_again(ply, 0, left);
    } else if (status == BURNISH_STATUS_OK) {
        status = first;
    }
    if ((status == BURNISH_STATUS_FORMAT || (status == BURNISH_STATUS_OK && ply->is_odd &&
                                             (*left > 0 || ply->reader->damage.count > 0))) &&
        rows_are_lines(ply)) {
        status = read_again(ply, 1, left);
        if (status == BURNISH_STATUS_FORMAT && first == BURNISH_STATUS_OK) {
            status = read_again(ply, 0, left);
        }
    }
    burnish_ply_show_comments(ply);
    return status;
}

/* Alpha 0 everywhere comes from programs that do not fill it. */
static void check_alpha(const burnish_ply_state *ply) {
    const burnish_mesh_data *mesh = ply->reader->mesh;
    const size_t count = mesh->streams[BURNISH_COLOR].count;
    uint8_t *rgba = burnish_colors(mesh);
    const burnish_ply_type *types = ply->takes_face_colors ? ply->face_types : ply->types;
    unsigned any = types[BURNISH_PLY_ALPHA] == BURNISH_PLY_NONE;
    for (size_t i = 0; i < count && !any; ++i) {
        any = rgba[4 * i + 3];
    }
    if (any || count == 0) {
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        rgba[4 * i + 3] = 255;
    }
    burnish_reader_warn(ply->reader, NULL, "alpha is 0 everywhere: drawn opaque");
}

static burnish_status read_body(burnish_ply_state *ply) {
    const burnish_ply_header *header = &ply->header;
    int has_faces = 0;
    ply->keeps_coordinates =
        burnish_reader_keeps_coordinates(ply->reader, header->texture_count > 0) || header->tint;
    ply->by_lines = header->is_open;
    ply->reader->may_lack = header->may_lack;
    ply->takes_face_coordinates = ply->keeps_coordinates && header->has_face_coordinates &&
                                  !ply->reader->input->options->scalar_property;
    ply->takes_textures = ply->takes_face_coordinates && header->texture_count > 0;
    for (size_t i = 0; i < ply->header.element_count; ++i) {
        const burnish_ply_element *element = &ply->header.elements[i];
        has_faces |= element->count > 0 && element->kind > BURNISH_PLY_ELEMENT_VERTEX;
        if (element->kind == BURNISH_PLY_ELEMENT_VERTEX && !header->is_open) {
            ply->vertex_count = (size_t)element->count;
        }
    }
    ply->reader->is_binary = ply->header.encoding != BURNISH_PLY_ASCII;
    ply->is_odd = 0;
    size_t left;
    burnish_status status = ply->reader->input->streamed && !suits_streaming(ply)
                                ? burnish_stop_streaming(ply->reader)
                                : read_elements(ply, &left);
    if (ply->reader->input->streamed && status == BURNISH_STATUS_OK && ply->is_odd) {
        return burnish_stop_streaming(ply->reader);
    }
    if (!ply->reader->is_binary && !ply->reader->input->streamed &&
        (status == BURNISH_STATUS_FORMAT || (status == BURNISH_STATUS_OK && ply->is_odd &&
                                             (left > 0 || ply->reader->damage.count > 0)))) {
        status = read_otherwise(ply, status, &left);
    }
    if (header->is_open) {
        ply->vertex_count = ply->reader->mesh->streams[BURNISH_POSITION].count;
    }
    if (status == BURNISH_STATUS_OK && ply->reader->mesh->triangle_count == 0 && !has_faces &&
        ply->vertex_count > 0) {
        check_alpha(ply);
        const int has_splats = ply->reader->mesh->streams[BURNISH_SPLAT].count > 0;
        status = burnish_ply_tint_points(ply);
        if (status == BURNISH_STATUS_OK) {
            status = has_splats ? burnish_make_splats(ply->reader, 1)
                                : burnish_make_points(ply->reader, NULL, 0);
        }
    } else if (status == BURNISH_STATUS_OK && ply->reader->mesh->triangle_count == 0) {
        status =
            burnish_reader_fail(ply->reader, BURNISH_STATUS_FORMAT, NULL,
                                has_faces ? "no face has 3 different corners; export the mesh again"
                                          : "no vertices or faces; export the mesh again");
    }
    return status;
}

/* Warns of data that is not drawn or kept. */
static void warn_undrawn(const burnish_ply_state *ply) {
    burnish_reader_warn_group(ply->reader, &ply->few_corners);
    burnish_reader_warn_group(ply->reader, &ply->fields);
    burnish_reader_warn_group(ply->reader, &ply->comments);
    if (ply->header.has_face_colors && !ply->takes_face_colors) {
        burnish_reader_warn(ply->reader, NULL, "colours of faces are not drawn%s",
                            ply->header.has_vertex_colors ? ", the colours of vertices are" : "");
    }
}

/* Training has its cameras' axes: y points down. */
static void stand_splats(burnish_mesh_data *mesh) {
    if (mesh->point_count == 0) {
        burnish_mesh_data_drop(mesh, BURNISH_SPLAT);
    } else if (mesh->streams[BURNISH_SPLAT].count > 0) {
        mesh->up_axis[1] = -1;
    }
}

burnish_status burnish_ply_read_described(burnish_reader *reader, burnish_ply_header *header,
                                          burnish_status status) {
    burnish_ply_state ply = {.reader = reader, .header = *header, .header_odd = reader->odd};
    if (status == BURNISH_STATUS_OK) {
        status = burnish_ply_check_header(reader, &ply.header);
    }
    if (status == BURNISH_STATUS_OK) {
        status = read_body(&ply);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_ply_settle_triangles(&ply);
    }
    if (status == BURNISH_STATUS_OK) {
        stand_splats(reader->mesh);
        check_alpha(&ply);
        warn_undrawn(&ply);
        status = burnish_ply_load_textures(&ply);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_cut_polygons(reader);
    }
    burnish_ply_destroy_header(reader->mesh->memory.context, &ply.header);
    return status;
}

static burnish_status ply_read(burnish_reader *reader) {
    burnish_ply_header header;
    burnish_status status = burnish_ply_read_header(reader, &header);
    if (status == BURNISH_STATUS_OK && burnish_ply_is_packed(&header)) {
        status = burnish_ply_read_packed(reader, &header);
        burnish_ply_destroy_header(reader->mesh->memory.context, &header);
        return status;
    }
    return burnish_ply_read_described(reader, &header, status);
}

/* Certain by its first line. */
static int ply_recognise(const uint8_t *bytes, size_t size) {
    const burnish_lexer lexer = burnish_lexer_open(bytes, size, 0);
    return lexer.end - lexer.next >= 4 &&
                   burnish_bytes_are_caseless(lexer.next, (const uint8_t *)"ply", 3) &&
                   burnish_is_line_end(lexer.next[3])
               ? 2
               : 0;
}

const burnish_format_reader burnish_reader_ply = {
    .recognise = ply_recognise, .read = ply_read, .averages_normals = 1, .can_stream = 1};
