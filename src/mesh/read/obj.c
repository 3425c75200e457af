/* OBJ (Wavefront, "Object Files", 1992): v, vn, f, usemtl, mtllib; polygons; indices from either
 * end.
 *
 * vt, o, g, s and unknown keywords are passed over; l and p too, with one warning. Vertex colours
 * follow the coordinates (v x y z r g b). An index refers to what stands before it in the file.
 * Large files are read by threads where they can be (obj_parts.h); all others, and those with
 * something wrong or unusual in them, statement by statement here. */
#include "mesh/read/append.h"
#include "mesh/read/obj_line.h"
#include "mesh/read/obj_materials.h"
#include "mesh/read/obj_parts.h"

typedef struct obj_state {
    const burnish_reader_input *input;
    burnish_source *source;
    burnish_error *error;
    burnish_obj_line line;
    burnish_obj_materials materials;
    int warned_elements, warned_corners;
} obj_state;

static burnish_status append_vertex(obj_state *obj) {
    float values[BURNISH_OBJ_VERTEX_MOST];
    int count;
    burnish_status status = burnish_obj_read_vertex(&obj->line, values, &count);
    if (status == BURNISH_STATUS_OK) {
        status =
            burnish_append_position(obj->source, burnish_obj_here(&obj->line), values, obj->error);
    }
    if (status != BURNISH_STATUS_OK || count < 6) {
        return status;
    }
    uint8_t rgba[4];
    burnish_obj_color(values, rgba);
    return burnish_append_color(obj->source, rgba, obj->error);
}

static burnish_status append_normal(obj_state *obj) {
    float normal[3];
    burnish_status status = burnish_obj_read_normal(&obj->line, normal);
    return status != BURNISH_STATUS_OK
               ? status
               : burnish_append_normal(obj->source, burnish_obj_here(&obj->line), normal,
                                       obj->error);
}

static burnish_status append_face(obj_state *obj) {
    burnish_obj_line *line = &obj->line;
    burnish_source *source = obj->source;
    const burnish_place place = burnish_obj_here(line);
    burnish_status status =
        burnish_obj_read_face(line, source->position_count, source->normal_count);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (line->corner_count < 3) {
        if (!obj->warned_corners++) {
            burnish_warn_at(source, place, "faces with fewer than 3 corners were ignored");
        }
        return BURNISH_STATUS_OK;
    }
    status = burnish_obj_begin_run(&obj->materials, source->triangle_count);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_append_polygon(source, obj->input->options, place, line->corners,
                                        line->has_normals ? line->corner_normals : NULL,
                                        line->corner_count, obj->error);
    }
    return status;
}

static burnish_status read_statement(obj_state *obj) {
    switch (burnish_obj_read_keyword(&obj->line)) {
    case BURNISH_OBJ_VERTEX:
        return append_vertex(obj);
    case BURNISH_OBJ_NORMAL:
        return append_normal(obj);
    case BURNISH_OBJ_FACE:
        return append_face(obj);
    case BURNISH_OBJ_MATERIAL:
        burnish_obj_use_material(&obj->materials, burnish_text_rest(&obj->line.text));
        break;
    case BURNISH_OBJ_LIBRARY:
        return burnish_obj_read_libraries(&obj->materials, &obj->line.text);
    case BURNISH_OBJ_ELEMENT:
        if (!obj->warned_elements++) {
            burnish_warn_at(obj->source, burnish_obj_here(&obj->line),
                            "lines and points were ignored");
        }
        break;
    case BURNISH_OBJ_NOTHING:
    case BURNISH_OBJ_OTHER:
        break;
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_statements(obj_state *obj) {
    burnish_status status;
    obj->line =
        (burnish_obj_line){.name = obj->input->name,
                           .text = burnish_text_open(obj->input->bytes, obj->input->size, 1),
                           .error = obj->error};
    do {
        status = read_statement(obj);
    } while (status == BURNISH_STATUS_OK && burnish_text_next_line(&obj->line.text));
    burnish_obj_line_close(&obj->line);
    return status;
}

burnish_status burnish_read_obj(const burnish_reader_input *input, burnish_source *source,
                                burnish_error *error) {
    obj_state obj = {.input = input,
                     .source = source,
                     .error = error,
                     .materials = {.input = input, .source = source, .error = error, .changed = 1}};
    if (input->size == 0) {
        return burnish_fail_at(error, BURNISH_STATUS_FORMAT, burnish_place_byte(input->name, 0),
                               "the file is empty; fetch it again");
    }
    int done;
    burnish_status status = burnish_obj_read_parts(input, source, &obj.materials, &done);
    if (status == BURNISH_STATUS_OK && !done) {
        status = read_statements(&obj);
    }
    if (status == BURNISH_STATUS_OK && source->triangle_count == 0) {
        status = burnish_fail_at(error, BURNISH_STATUS_FORMAT, burnish_place_file(input->name),
                                 "no faces among %zu vertices; export the mesh with its faces",
                                 source->position_count);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_obj_resolve_materials(&obj.materials);
    }
    burnish_obj_materials_close(&obj.materials);
    return status;
}
