/* OBJ (Wavefront, "Object Files", 1992): v, vn, vt, f, usemtl, mtllib; polygons; indices from
 * either end, which may refer to values anywhere in the file.
 *
 * Lines, points, curves, surfaces and statements of other programs are ignored with a warning each;
 * s and other statements that draw nothing are ignored silently. Vertex colours follow the
 * coordinates (v x y z r g b), or are in comments of ZBrush (#MRGB, a mask, red, green and blue in
 * eight hexadecimal digits each). */
#include <stdlib.h>

#include "base/numbers.h"
#include "mesh/read/common/damage.h"
#include "mesh/read/common/parts.h"
#include "mesh/read/common/points.h"
#include "mesh/read/common/textures.h"
#include "mesh/read/common/triangulate.h"
#include "mesh/read/io/streaming.h"
#include "mesh/read/obj/obj_materials.h"

typedef struct obj_state {
    burnish_reader *reader;
    int with_texcoords;
    burnish_obj_materials materials;
    burnish_part_list objects, groups; /* by o and by g */
    size_t triangle;                   /* those before it have their run of one material */
    int has_line_runs;                 /* the runs count lines: no face has been seen */
    burnish_segment *segments;         /* of lines, while no face has been seen */
    size_t segment_count, segment_capacity;
    uint8_t *paint; /* of #MRGB: 4 bytes a vertex */
    size_t paint_count, paint_capacity;
    burnish_warning_group elements, few_corners, colors, normals, free_form, unknown;
    size_t highest[BURNISH_ATTRIBUTE_COUNT]; /* index + 1 that a face refers to; SIZE_MAX: to one
                                                before the first */
} obj_state;

/* The first line from `from` on that is not joined to the previous one by '\'. */
static const uint8_t *find_start(const uint8_t *from, const uint8_t *end) {
    const uint8_t *newline = from;
    while ((newline = memchr(newline, '\n', (size_t)(end - newline)))) {
        const uint8_t *last = newline - (newline[-1] == '\r') - 1;
        ++newline;
        if (*last != '\\') {
            return newline;
        }
    }
    return end;
}

static void obj_parse(const void *state, burnish_chunk *chunk) {
    const obj_state *obj = state;
    burnish_obj_parse(chunk, obj->with_texcoords, obj->reader->mesh->origin);
}

/* A statement that is not read. */
static void note_other(obj_state *obj, const burnish_chunk_event *event, burnish_lexer *lexer) {
    burnish_token keyword;
    burnish_lexer_token(lexer, &keyword);
    if (event->kind == BURNISH_OBJ_FREE_FORM) {
        burnish_reader_note(obj->reader, &obj->free_form, event->at,
                            "curves and surfaces (\"%s\") are not drawn; export them as faces",
                            burnish_token_quote(keyword).text);
    } else {
        burnish_reader_note(obj->reader, &obj->unknown, event->at,
                            "\"%s\" is not a statement of OBJ and was ignored",
                            burnish_token_quote(keyword).text);
    }
}

/* l v v ...: lexer at the keyword, `before` positions stand before it. An index that is out of
 * range becomes BURNISH_NONE. */
static burnish_status read_line(obj_state *obj, burnish_lexer *lexer, size_t before) {
    burnish_memory *memory = &obj->reader->mesh->memory;
    burnish_token token;
    uint32_t last = BURNISH_NONE;
    burnish_lexer_token(lexer, &token);
    for (int i = 0; burnish_lexer_token(lexer, &token); ++i) {
        int64_t written = 0;
        burnish_parse_integer(burnish_obj_cut_part(&token), &written);
        const int64_t index = written < 0 ? (int64_t)before + written : written - 1;
        const uint32_t number = index >= 0 && index < BURNISH_NONE ? (uint32_t)index : BURNISH_NONE;
        if (i > 0) {
            obj->segments = burnish_reserve(memory, obj->segments, &obj->segment_capacity,
                                            obj->segment_count + 1, sizeof *obj->segments, "lines");
            if (memory->status != BURNISH_STATUS_OK) {
                return memory->status;
            }
            obj->segments[obj->segment_count++] = (burnish_segment){last, number};
        }
        last = number;
    }
    return BURNISH_STATUS_OK;
}

/* #MRGB: from `at` on, up to what is no digit. */
static burnish_status read_paint(obj_state *obj, const uint8_t *at, const uint8_t *end) {
    enum { DIGITS = 8 };
    burnish_memory *memory = &obj->reader->mesh->memory;
    for (; end - at >= DIGITS; at += DIGITS) {
        char digits[DIGITS + 1] = {0};
        memcpy(digits, at, DIGITS);
        if (strspn(digits, "0123456789abcdefABCDEF") < DIGITS) {
            break;
        }
        const unsigned long value = strtoul(digits, NULL, 16);
        obj->paint = burnish_reserve(memory, obj->paint, &obj->paint_capacity, obj->paint_count + 1,
                                     4, "colours");
        if (memory->status != BURNISH_STATUS_OK) {
            return memory->status;
        }
        const uint8_t rgba[4] = {(uint8_t)(value >> 16), (uint8_t)(value >> 8), (uint8_t)value,
                                 255};
        memcpy(obj->paint + 4 * obj->paint_count++, rgba, sizeof rgba);
    }
    return BURNISH_STATUS_OK;
}

/* The lines of a file with faces are not drawn. */
static void forget_line_runs(obj_state *obj) {
    if (obj->has_line_runs) {
        obj->triangle = obj->materials.run_count = 0;
        obj->materials.changed = 1;
        obj->has_line_runs = 0;
    }
}

/* Begins a run of the current material if triangles, or else lines, have it. */
static burnish_status begin_run(obj_state *obj, size_t triangle) {
    const size_t drawn = triangle > 0 ? triangle : obj->segment_count;
    burnish_status status = BURNISH_STATUS_OK;
    if (triangle > 0) {
        forget_line_runs(obj);
    }
    if (drawn > obj->triangle) {
        status = burnish_obj_begin_run(&obj->materials, obj->triangle);
        obj->has_line_runs = triangle == 0;
        obj->triangle = drawn;
    }
    return status;
}

/* Begins the part of an o or g statement. */
static burnish_status begin_part(obj_state *obj, int kind, burnish_lexer *lexer, size_t triangle) {
    burnish_part_list *list = kind == BURNISH_OBJ_OBJECT ? &obj->objects : &obj->groups;
    const burnish_token name = burnish_lexer_rest(lexer);
    const burnish_part part = burnish_part_of((const char *)name.bytes, name.size);
    burnish_parts_begin(list, &part, triangle);
    return list->memory->status;
}

/* The objects are the parts, or the groups if no two objects have names. */
static burnish_status finish_parts(obj_state *obj) {
    const size_t triangles = obj->reader->mesh->triangle_count;
    const size_t objects = burnish_parts_count(&obj->objects, triangles);
    const int has_others = objects > 0 && !*obj->objects.parts[0].name;
    const int by_object =
        objects > 1 + (size_t)has_others || burnish_parts_count(&obj->groups, triangles) < 2;
    return burnish_parts_finish(by_object ? &obj->objects : &obj->groups, obj->reader->mesh, 1);
}

static burnish_status obj_accept(void *state, const burnish_chunk *chunk) {
    obj_state *obj = state;
    burnish_status status = BURNISH_STATUS_OK;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        const size_t highest = chunk->back[i] > chunk->before[i] ? SIZE_MAX : chunk->highest[i];
        obj->highest[i] = highest > obj->highest[i] ? highest : obj->highest[i];
    }
    for (size_t i = 0; i < chunk->event_count && status == BURNISH_STATUS_OK; ++i) {
        const burnish_chunk_event *event = &chunk->events[i];
        const size_t triangle = chunk->triangles_before + event->triangle;
        burnish_lexer lexer = {event->at, chunk->text_end, 1};
        if (event->kind == BURNISH_OBJ_ELEMENT) {
            burnish_reader_note(obj->reader, &obj->elements, event->at,
                                "lines and points are not drawn in a file with faces");
            if (triangle == 0 && *event->at == 'l') {
                status = read_line(obj, &lexer, chunk->before[BURNISH_POSITION] + event->position);
            }
            continue;
        }
        if (event->kind == BURNISH_OBJ_FEW_CORNERS) {
            burnish_reader_note(obj->reader, &obj->few_corners, event->at,
                                "a face with fewer than 3 corners was ignored");
            continue;
        }
        if (event->kind == BURNISH_OBJ_COLOR) {
            burnish_reader_note(
                obj->reader, &obj->colors, event->at,
                "the values after a vertex's coordinates are not a colour; it is white");
            continue;
        }
        if (event->kind == BURNISH_OBJ_NORMAL) {
            burnish_reader_note(obj->reader, &obj->normals, event->at,
                                "a normal is not 3 numbers; it was generated");
            continue;
        }
        if (event->kind == BURNISH_OBJ_PAINT) {
            status = read_paint(obj, event->at, chunk->text_end);
            continue;
        }
        if (event->kind == BURNISH_OBJ_OTHER || event->kind == BURNISH_OBJ_FREE_FORM) {
            note_other(obj, event, &lexer);
            continue;
        }
        if (event->kind == BURNISH_OBJ_OBJECT || event->kind == BURNISH_OBJ_GROUP) {
            status = begin_part(obj, event->kind, &lexer, triangle);
            continue;
        }
        if (obj->reader->input->streamed) { /* names refer to the input's bytes */
            return burnish_stop_streaming(obj->reader);
        }
        status = begin_run(obj, triangle);
        if (status == BURNISH_STATUS_OK && event->kind == BURNISH_OBJ_LIBRARY) {
            status = burnish_obj_read_libraries(&obj->materials, &lexer);
        } else if (status == BURNISH_STATUS_OK) {
            burnish_obj_use_material(&obj->materials, burnish_lexer_rest(&lexer));
        }
    }
    return status;
}

static void drop_missing(void *user_data, size_t first, size_t end) {
    const burnish_stream *stream = user_data;
    for (size_t i = first; i < end; ++i) {
        stream->corners[i] = stream->corners[i] < stream->count ? stream->corners[i] : BURNISH_NONE;
    }
}

/* Corners may refer to missing normals and texture coordinates: some exporters split a file and
 * keep the indices, or write indices without any values. */
static void settle_corners(obj_state *obj, burnish_attribute attribute, const char *what) {
    burnish_mesh_data *mesh = obj->reader->mesh;
    burnish_stream *stream = &mesh->streams[attribute];
    if (!stream->corners) { /* no face refers to one */
        burnish_mesh_data_drop(mesh, attribute);
    }
    if (stream->corners && obj->highest[attribute] > stream->count) {
        burnish_tasks_ranges(mesh->tasks, 3 * mesh->triangle_count, 1 << 16, drop_missing, stream);
        burnish_reader_warn(obj->reader, NULL, "faces refer to %s that the file does not have",
                            what);
    }
    if (stream->count == 0) {
        burnish_mesh_data_drop(mesh, attribute);
    }
}

/* Rescales colours that count to 255, if one is too bright to count to 1. */
static void settle_colors(obj_state *obj) {
    burnish_mesh_data *mesh = obj->reader->mesh;
    burnish_stream *colors = &mesh->streams[BURNISH_COLOR];
    const size_t painted = obj->paint_count;
    if (painted > 0 && painted == mesh->streams[BURNISH_POSITION].count && colors->count == 0 &&
        burnish_mesh_data_reserve(mesh, BURNISH_COLOR, painted) == BURNISH_STATUS_OK) {
        memcpy(colors->items, obj->paint, 4 * painted);
        colors->count = painted;
    }
    uint8_t *rgba = burnish_colors(mesh);
    int count_to_255 = 0;
    for (size_t i = 0; i < colors->count && !count_to_255; ++i) {
        count_to_255 = rgba[4 * i + 3] == BURNISH_OBJ_COUNTS_TO_255;
    }
    for (size_t i = 0; i < colors->count; ++i, rgba += 4) {
        for (int k = 0; k < 3 && count_to_255 && rgba[3] == BURNISH_OBJ_COUNTS_TO_1; ++k) {
            rgba[k] = rgba[k] >= 128;
        }
        rgba[3] = 255;
    }
    if (count_to_255) {
        burnish_reader_warn(obj->reader, NULL, "vertex colours exceed 1 and were read as 0 to 255");
    }
}

/* Lines have become triangles, equally many each. */
static burnish_status color_lines(obj_state *obj, size_t count) {
    const size_t each = obj->reader->mesh->triangle_count / count;
    const burnish_status status = begin_run(obj, 0);
    for (size_t i = 0; i < obj->materials.run_count; ++i) {
        obj->materials.runs[i].first_triangle *= each;
    }
    return status == BURNISH_STATUS_OK ? burnish_obj_resolve_materials(&obj->materials) : status;
}

/* Draws a file without faces as its lines, or its vertices as points. */
static burnish_status make_points(obj_state *obj) {
    const burnish_mesh_data *mesh = obj->reader->mesh;
    const size_t positions = mesh->streams[BURNISH_POSITION].count;
    size_t count = 0, missing = 0;
    for (size_t i = 0; i < obj->segment_count; ++i) {
        const burnish_segment segment = obj->segments[i];
        if (burnish_is_good_position(mesh, segment.from) &&
            burnish_is_good_position(mesh, segment.to)) {
            obj->segments[count++] = segment;
        } else {
            missing += segment.from >= positions || segment.to >= positions;
        }
    }
    if (missing > 0) {
        burnish_reader_warn(obj->reader, NULL,
                            "%zu of %zu lines refer to vertices that the file does not have",
                            missing, obj->segment_count);
    }
    settle_colors(obj);
    const burnish_status status = burnish_make_points(obj->reader, obj->segments, count);
    return status == BURNISH_STATUS_OK && count > 0 && count == obj->segment_count
               ? color_lines(obj, count)
               : status;
}

/* If no vertex of faces or lines has a third number, two are x and y, and no damage. */
static void settle_flat(burnish_reader *reader) {
    const size_t count = reader->mesh->streams[BURNISH_POSITION].count;
    float *positions = burnish_positions(reader->mesh);
    size_t flat = 0;
    for (size_t i = 0; i < count; ++i) {
        if (burnish_is_finitef(positions[3 * i + 2])) {
            return;
        }
        flat += burnish_is_finitef(positions[3 * i]);
    }
    for (size_t i = 0; i < count && flat > 0; ++i) {
        positions[3 * i + 2] = 0;
    }
    if (flat > 0) {
        reader->damage.count -= flat;
        burnish_fail(&reader->damage.first, BURNISH_STATUS_OK,
                     "%s: a vertex or a corner of a face is not one", reader->input->name);
        burnish_reader_warn(reader, NULL, "vertices have two numbers, x and y; z was taken as 0");
    }
}

static burnish_status obj_finish(obj_state *obj) {
    burnish_mesh_data *mesh = obj->reader->mesh;
    if (mesh->triangle_count > 0 || obj->segment_count > 0) {
        settle_flat(obj->reader);
    }
    const burnish_warning_group *groups[] = {&obj->elements, &obj->few_corners, &obj->colors,
                                             &obj->normals,  &obj->free_form,   &obj->unknown};
    /* without faces, lines and points are what is drawn */
    for (size_t i = mesh->triangle_count == 0; i < sizeof groups / sizeof *groups; ++i) {
        burnish_reader_warn_group(obj->reader, groups[i]);
    }
    if (mesh->triangle_count == 0 && mesh->streams[BURNISH_POSITION].count > 0 &&
        !obj->reader->has_bad_faces) {
        return make_points(obj);
    }
    if (mesh->triangle_count == 0) {
        return burnish_reader_fail(obj->reader, BURNISH_STATUS_FORMAT, NULL,
                                   "no faces among %zu vertices; export the mesh with its faces",
                                   mesh->streams[BURNISH_POSITION].count);
    }
    settle_corners(obj, BURNISH_NORMAL, "normals");
    settle_corners(obj, BURNISH_TEXCOORD, "texture coordinates");
    settle_colors(obj);
    burnish_status status = mesh->memory.status;
    status = status == BURNISH_STATUS_OK ? burnish_cut_polygons(obj->reader) : status;
    if (status == BURNISH_STATUS_OK) {
        status = finish_parts(obj);
    }
    if (status == BURNISH_STATUS_OK) {
        status = begin_run(obj, mesh->triangle_count);
    }
    return status == BURNISH_STATUS_OK ? burnish_obj_resolve_materials(&obj->materials) : status;
}

/* Whether the file may have textures: a library is named at its head, if at all. */
static int names_library(const uint8_t *bytes, size_t size) {
    enum { HEAD = 1 << 20 };
    static const char word[] = "mtllib";
    const size_t length = sizeof word - 1, end = size < HEAD ? size : HEAD;
    for (size_t i = 0; i + length <= end; ++i) {
        const uint8_t *at = memchr(bytes + i, 'm', end - i - length + 1);
        if (!at || memcmp(at, word, length) == 0) {
            return at != NULL;
        }
        i = (size_t)(at - bytes);
    }
    return 0;
}

static burnish_status obj_read(burnish_reader *reader) {
    static const burnish_grammar grammar = {
        .find_start = find_start,
        .parse = obj_parse,
        .accept = obj_accept,
        .indexed = 1u << BURNISH_POSITION | 1u << BURNISH_NORMAL | 1u << BURNISH_TEXCOORD,
        .lenient = 1u << BURNISH_NORMAL | 1u << BURNISH_TEXCOORD};
    const size_t head = burnish_reader_head(reader);
    const int has_library = names_library(reader->input->bytes, head);
    burnish_memory *memory = &reader->mesh->memory;
    const burnish_part unnamed = burnish_part_of("", 0);
    obj_state obj = {.reader = reader,
                     .with_texcoords = burnish_reader_keeps_coordinates(reader, has_library),
                     .materials = {.reader = reader, .changed = 1},
                     .objects = {.memory = memory, .join = BURNISH_JOIN_NAMES, .next = unnamed},
                     .groups = {.memory = memory, .join = BURNISH_JOIN_NAMES, .next = unnamed}};
    const uint8_t *at = burnish_lexer_open(reader->input->bytes, head, 1).next;
    if (reader->input->streamed && has_library) {
        return burnish_stop_streaming(reader);
    }
    reader->is_wide = 1;
    burnish_status status = burnish_chunks_read(&grammar, &obj, reader, &at, NULL);
    if (status == BURNISH_STATUS_OK) {
        status = obj_finish(&obj);
    }
    burnish_obj_materials_close(&obj.materials);
    burnish_parts_release(&obj.objects);
    burnish_parts_release(&obj.groups);
    burnish_release(memory->context, obj.segments);
    burnish_release(memory->context, obj.paint);
    return status;
}

/* The first word of the first line that is not a comment is a keyword of the format. */
static int obj_recognise(const uint8_t *bytes, size_t size) {
    static const char *const words[] = {"v", "vn", "vt", "f",      "o",      "g",
                                        "s", "l",  "p",  "mtllib", "usemtl", "vp"};
    burnish_lexer lexer = burnish_lexer_open(bytes, size, 1);
    burnish_token token;
    if (!burnish_lexer_word(&lexer, &token)) {
        return 0;
    }
    for (size_t i = 0; i < sizeof words / sizeof *words; ++i) {
        if (burnish_token_is(token, words[i])) {
            return 1;
        }
    }
    return 0;
}

const burnish_format_reader burnish_reader_obj = {
    .recognise = obj_recognise, .read = obj_read, .averages_normals = 1, .can_stream = 1};
