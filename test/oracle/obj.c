/* OBJ (Wavefront, "Object Files", 1992): v, vn, f, usemtl, mtllib; polygons; indices from either
 * end.
 *
 * vt, o, g, s and unknown keywords are passed over; l and p too, with one warning. Vertex colours
 * follow the coordinates (v x y z r g b). An index refers to what stands before it in the file.
 * Statement by statement, on one thread. */
#include "oracle/append.h"
#include "oracle/obj_line.h"
#include "oracle/obj_materials.h"

typedef struct obj_state {
    const oracle_reader_input *input;
    oracle_source *source;
    burnish_error *error;
    oracle_obj_line line;
    oracle_obj_materials materials;
    int warned_elements, warned_corners;
} obj_state;

static burnish_status append_vertex(obj_state *obj) {
    float values[ORACLE_OBJ_VERTEX_MOST];
    int count;
    burnish_status status = oracle_obj_read_vertex(&obj->line, values, &count);
    if (status == BURNISH_STATUS_OK) {
        status =
            oracle_append_position(obj->source, oracle_obj_here(&obj->line), values, obj->error);
    }
    if (status != BURNISH_STATUS_OK || count < 6) {
        return status;
    }
    uint8_t rgba[4];
    oracle_obj_color(values, rgba);
    return oracle_append_color(obj->source, rgba, obj->error);
}

static burnish_status append_normal(obj_state *obj) {
    float normal[3];
    burnish_status status = oracle_obj_read_normal(&obj->line, normal);
    return status != BURNISH_STATUS_OK
               ? status
               : oracle_append_normal(obj->source, oracle_obj_here(&obj->line), normal, obj->error);
}

static burnish_status append_face(obj_state *obj) {
    oracle_obj_line *line = &obj->line;
    oracle_source *source = obj->source;
    const oracle_place place = oracle_obj_here(line);
    burnish_status status =
        oracle_obj_read_face(line, source->position_count, source->normal_count);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (line->corner_count < 3) {
        if (!obj->warned_corners++) {
            oracle_warn_at(source, place, "faces with fewer than 3 corners were ignored");
        }
        return BURNISH_STATUS_OK;
    }
    status = oracle_obj_begin_run(&obj->materials, source->triangle_count);
    if (status == BURNISH_STATUS_OK) {
        status = oracle_append_polygon(source, obj->input->options, place, line->corners,
                                       line->has_normals ? line->corner_normals : NULL,
                                       line->corner_count, obj->error);
    }
    return status;
}

static burnish_status read_statement(obj_state *obj) {
    switch (oracle_obj_read_keyword(&obj->line)) {
    case ORACLE_OBJ_VERTEX:
        return append_vertex(obj);
    case ORACLE_OBJ_NORMAL:
        return append_normal(obj);
    case ORACLE_OBJ_FACE:
        return append_face(obj);
    case ORACLE_OBJ_MATERIAL:
        oracle_obj_use_material(&obj->materials, oracle_text_rest(&obj->line.text));
        break;
    case ORACLE_OBJ_LIBRARY:
        return oracle_obj_read_libraries(&obj->materials, &obj->line.text);
    case ORACLE_OBJ_ELEMENT:
        if (!obj->warned_elements++) {
            oracle_warn_at(obj->source, oracle_obj_here(&obj->line),
                           "lines and points were ignored");
        }
        break;
    case ORACLE_OBJ_NOTHING:
    case ORACLE_OBJ_OTHER:
        break;
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_statements(obj_state *obj) {
    burnish_status status;
    obj->line = (oracle_obj_line){.name = obj->input->name,
                                  .text = oracle_text_open(obj->input->bytes, obj->input->size, 1),
                                  .error = obj->error};
    do {
        status = read_statement(obj);
    } while (status == BURNISH_STATUS_OK && oracle_text_next_line(&obj->line.text));
    oracle_obj_line_close(&obj->line);
    return status;
}

burnish_status oracle_read_obj(const oracle_reader_input *input, oracle_source *source,
                               burnish_error *error) {
    obj_state obj = {.input = input,
                     .source = source,
                     .error = error,
                     .materials = {.input = input, .source = source, .error = error, .changed = 1}};
    if (input->size == 0) {
        return oracle_fail_at(error, BURNISH_STATUS_FORMAT, oracle_place_byte(input->name, 0),
                              "the file is empty; fetch it again");
    }
    burnish_status status = read_statements(&obj);
    if (status == BURNISH_STATUS_OK && source->triangle_count == 0) {
        status = oracle_fail_at(error, BURNISH_STATUS_FORMAT, oracle_place_file(input->name),
                                "no faces among %zu vertices; export the mesh with its faces",
                                source->position_count);
    }
    if (status == BURNISH_STATUS_OK) {
        status = oracle_obj_resolve_materials(&obj.materials);
    }
    oracle_obj_materials_close(&obj.materials);
    return status;
}
