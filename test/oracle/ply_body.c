/* The body of a PLY file: element by element, value by value, on one thread. */
#include <string.h>

#include "oracle/append.h"
#include "oracle/ply_cursor.h"

typedef struct ply_body {
    oracle_ply_cursor cursor;
    oracle_ply_header header;
    const burnish_load_options *options;
    oracle_source *source;
    burnish_error *error;
    int warned_corners;
} ply_body;

static oracle_place here(const ply_body *ply) {
    return oracle_ply_here(&ply->cursor);
}

/* ---- rows ---- */

static burnish_status append_vertex(ply_body *ply, int has_normals, int has_colors) {
    float position[3], normal[3];
    uint8_t rgba[4];
    oracle_ply_get_position(&ply->cursor, position);
    burnish_status status = oracle_append_position(ply->source, here(ply), position, ply->error);
    if (status == BURNISH_STATUS_OK && has_normals) {
        oracle_ply_get_normal(&ply->cursor, normal);
        status = oracle_append_normal(ply->source, here(ply), normal, ply->error);
    }
    if (status == BURNISH_STATUS_OK && has_colors) {
        oracle_ply_get_color(&ply->cursor, rgba);
        status = oracle_append_color(ply->source, rgba, ply->error);
    }
    return status;
}

static burnish_status append_face(ply_body *ply) {
    if (ply->cursor.corner_count < 3) {
        if (!ply->warned_corners++) {
            oracle_warn_at(ply->source, here(ply), "faces with fewer than 3 corners were ignored");
        }
        return BURNISH_STATUS_OK;
    }
    return oracle_append_polygon(ply->source, ply->options, here(ply), ply->cursor.corners, NULL,
                                 ply->cursor.corner_count, ply->error);
}

/* Triangles between three corners in a row, every second one the other way round; those that only
 * turn the strip (two corners the same) are left out. */
static burnish_status append_strips(ply_body *ply) {
    burnish_status status = BURNISH_STATUS_OK;
    size_t start = 0;
    for (size_t i = 0; i < ply->cursor.corner_count && status == BURNISH_STATUS_OK; ++i) {
        if (ply->cursor.corners[i] == ORACLE_SOURCE_NONE) {
            start = i + 1;
            continue;
        }
        if (i < start + 2) {
            continue;
        }
        size_t odd = (i - start) & 1;
        uint32_t corners[3] = {ply->cursor.corners[i - 2 + odd], ply->cursor.corners[i - 1 - odd],
                               ply->cursor.corners[i]};
        if (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]) {
            status = oracle_append_polygon(ply->source, ply->options, here(ply), corners, NULL, 3,
                                           ply->error);
        }
    }
    return status;
}

/* ---- elements ---- */

/* Holds the count against the bytes left. */
static burnish_status check_count(ply_body *ply, size_t *row_size, int *has_lists) {
    const oracle_ply_element *element = ply->cursor.element;
    *row_size = 0;
    *has_lists = 0;
    for (size_t i = 0; i < element->property_count; ++i) {
        const oracle_ply_property *property = &ply->header.properties[element->first_property + i];
        int is_list = property->count_type != ORACLE_PLY_NONE;
        *has_lists |= is_list;
        *row_size += oracle_ply_is_ascii(&ply->cursor)
                         ? 1
                         : oracle_ply_type_size(is_list ? property->count_type : property->type);
    }
    uint64_t room = *row_size == 0 ? UINT64_MAX
                    : oracle_ply_is_ascii(&ply->cursor)
                        ? oracle_ply_room(&ply->cursor, 1) / *row_size
                        : oracle_ply_room(&ply->cursor, *row_size);
    if (element->count > room) {
        return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT,
                              oracle_place_line(ply->cursor.input->name, element->line),
                              "element %s announces %llu rows, but the rest of the file has room "
                              "for %llu at most; it is truncated or damaged, fetch it again",
                              oracle_token_quote(element->name).text,
                              (unsigned long long)element->count, (unsigned long long)room);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status skip_element(ply_body *ply, size_t row_size, int has_lists) {
    if (row_size == 0) {
        return BURNISH_STATUS_OK;
    }
    if (!has_lists && !oracle_ply_is_ascii(&ply->cursor)) {
        ply->cursor.text.next += ply->cursor.element->count * row_size;
        return BURNISH_STATUS_OK;
    }
    burnish_status status = BURNISH_STATUS_OK;
    oracle_ply_cursor *cursor = &ply->cursor;
    for (cursor->row = 0; cursor->row < cursor->element->count && status == BURNISH_STATUS_OK;
         ++cursor->row) {
        status = oracle_ply_skip_row(cursor);
    }
    return status;
}

static burnish_status begin_vertices(ply_body *ply) {
    const oracle_ply_element *element = ply->cursor.element;
    if (element->count > ORACLE_POSITION_LIMIT) {
        return oracle_fail_at(ply->error, BURNISH_STATUS_LIMIT,
                              oracle_place_line(ply->cursor.input->name, element->line),
                              "%llu vertices are more than %zu; split or simplify the mesh",
                              (unsigned long long)element->count, ORACLE_POSITION_LIMIT);
    }
    memset(ply->cursor.types, 0, sizeof ply->cursor.types);
    for (size_t i = 0; i < element->property_count; ++i) {
        const oracle_ply_property *property = &ply->header.properties[element->first_property + i];
        if (property->role < ORACLE_PLY_ROLE_COUNT) {
            ply->cursor.types[property->role] = property->type;
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_element(ply_body *ply) {
    const oracle_ply_element *element = ply->cursor.element;
    int is_vertex = element->kind == ORACLE_PLY_ELEMENT_VERTEX;
    burnish_status status = is_vertex ? begin_vertices(ply) : BURNISH_STATUS_OK;
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    int has_normals = is_vertex && oracle_ply_has_normals(&ply->cursor);
    int has_colors = is_vertex && oracle_ply_has_colors(&ply->cursor);
    for (ply->cursor.row = 0; ply->cursor.row < element->count && status == BURNISH_STATUS_OK;
         ++ply->cursor.row) {
        status = oracle_ply_read_row(&ply->cursor);
        if (status == BURNISH_STATUS_OK) {
            status = is_vertex ? append_vertex(ply, has_normals, has_colors)
                     : element->kind == ORACLE_PLY_ELEMENT_FACE ? append_face(ply)
                                                                : append_strips(ply);
        }
    }
    return status;
}

/* Walks the body once; reads the vertices, the faces, or both, and passes over all else. */
static burnish_status walk(ply_body *ply, int vertices, int faces) {
    ply->cursor.text =
        (oracle_text){ply->cursor.input->bytes + ply->header.body_offset,
                      ply->cursor.input->bytes + ply->cursor.input->size, ply->header.body_line, 0};
    ply->cursor.value_start = ply->cursor.text.next;
    for (size_t i = 0; i < ply->header.element_count; ++i) {
        size_t row_size;
        int has_lists;
        ply->cursor.element = &ply->header.elements[i];
        ply->cursor.row = 0;
        burnish_status status = check_count(ply, &row_size, &has_lists);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        oracle_ply_kind kind = ply->cursor.element->kind;
        int read = kind == ORACLE_PLY_ELEMENT_VERTEX  ? vertices
                   : kind == ORACLE_PLY_ELEMENT_OTHER ? 0
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
        const oracle_ply_element *element = &ply->header.elements[i];
        if (element->kind == ORACLE_PLY_ELEMENT_VERTEX) {
            has_vertices = 1;
            ply->cursor.vertex_count = (size_t)element->count;
        } else if (element->kind != ORACLE_PLY_ELEMENT_OTHER && element->count > 0) {
            has_faces = 1;
            faces_first |= !has_vertices;
        }
    }
    burnish_status status = walk(ply, 1, !faces_first);
    if (status == BURNISH_STATUS_OK && faces_first) {
        status = walk(ply, 0, 1); /* polygons are cut by their positions */
    }
    if (status == BURNISH_STATUS_OK && ply->source->triangle_count == 0) {
        status = oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT,
                                oracle_place_file(ply->cursor.input->name),
                                has_faces ? "no face has 3 different corners; export the mesh again"
                                          : "a point cloud: no faces; make a surface of it first, "
                                            "for example with MeshLab");
    }
    return status;
}

/* A vertex and its normal have one index. */
static burnish_status copy_normal_indices(oracle_source *source, burnish_error *error) {
    if (source->normal_count == 0) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status = oracle_legacy_reserve(
        (void **)&source->corner_normals, &source->corner_normal_capacity, source->triangle_count,
        3 * sizeof(uint32_t), "normal indices", error);
    if (status == BURNISH_STATUS_OK) {
        memcpy(source->corner_normals, source->corner_positions,
               source->triangle_count * 3 * sizeof(uint32_t));
    }
    return status;
}

burnish_status oracle_read_ply(const oracle_reader_input *input, oracle_source *source,
                               burnish_error *error) {
    if (input->size == 0) {
        return oracle_fail_at(error, BURNISH_STATUS_FORMAT, oracle_place_byte(input->name, 0),
                              "the file is empty; fetch it again");
    }
    ply_body ply = {.options = input->options, .source = source, .error = error};
    ply.cursor = (oracle_ply_cursor){.input = input, .header = &ply.header, .error = error};
    burnish_status status = oracle_ply_read_header(input, &ply.header, error);
    if (status == BURNISH_STATUS_OK) {
        status = read_body(&ply);
    }
    if (status == BURNISH_STATUS_OK) {
        status = copy_normal_indices(source, error);
    }
    oracle_ply_close(&ply.cursor);
    oracle_ply_destroy_header(&ply.header);
    return status;
}
