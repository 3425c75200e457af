/* OBJ files by threads.
 *
 * Three passes over parts of the file. The first counts vertices, normals and triangles line by
 * line without reading a number, so that every part knows what stands before it and where its
 * values go. The second reads vertices and normals, the third faces, which refer to positions that
 * are all there by then. The last two are the sequential reader's own functions, and what they find
 * must be what was counted: a count that is wrong, as one can make it be with joined lines, is a
 * reason to give up, never a wrong place. */
#include "mesh/read/obj_parts.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/mesh.h"
#include "mesh/read/append.h"
#include "mesh/read/obj_count.h"
#include "mesh/read/obj_line.h"
#include "mesh/read/parts.h"

typedef struct obj_parts {
    const burnish_reader_input *input;
    burnish_source *source;
    burnish_obj_part *parts;
    size_t count;
    burnish_obj_counts total;
    atomic_int give_up, normals_used;
} obj_parts;

/* ---- counting ---- */

static void count_part(void *of, size_t index, int thread) {
    obj_parts *obj = of;
    (void)thread;
    if (!atomic_load(&obj->give_up) && !burnish_obj_count_part(&obj->parts[index])) {
        atomic_store(&obj->give_up, 1);
    }
}

/* Sums up what stands before each part. Returns 0 when there is nothing to read or too much. */
static int add_up(obj_parts *obj) {
    burnish_obj_counts sum = {0};
    for (size_t i = 0; i < obj->count; ++i) {
        burnish_obj_part *p = &obj->parts[i];
        p->before = sum;
        sum.vertices += p->own.vertices;
        sum.normals += p->own.normals;
        sum.triangles += p->own.triangles;
        sum.lines += p->own.lines;
    }
    obj->total = sum;
    return sum.vertices < BURNISH_POSITION_LIMIT && sum.normals < BURNISH_POSITION_LIMIT &&
           sum.triangles > 0 && sum.triangles <= BURNISH_TRIANGLES_MAX &&
           sum.triangles <= obj->input->options->max_triangles;
}

/* ---- values ---- */

/* A cursor at the start of a part. */
static burnish_obj_line open_part(const burnish_obj_part *p) {
    return (burnish_obj_line){.text = {p->first, p->end, 1, 1}};
}

/* What stands before the statement at hand moves on by it. Returns 0 where that is more than was
 * counted. */
static int pass_one(size_t *at, size_t before, size_t own) {
    return (*at)++ < before + own;
}

static int read_vertex(obj_parts *obj, burnish_obj_part *p, burnish_obj_line *line, size_t vertex) {
    float values[BURNISH_OBJ_VERTEX_MOST];
    int count;
    if (burnish_obj_read_vertex(line, values, &count) != BURNISH_STATUS_OK) {
        return 0;
    }
    memcpy(obj->source->positions + 3 * vertex, values, 3 * sizeof(float));
    p->has_colors |= count >= 6;
    if (obj->source->colors) {
        uint8_t *rgba = obj->source->colors + 4 * vertex;
        memset(rgba, 255, 4);
        if (count >= 6) {
            burnish_obj_color(values, rgba);
        }
    }
    return 1;
}

static void read_values(void *of, size_t index, int thread) {
    obj_parts *obj = of;
    burnish_obj_part *p = &obj->parts[index];
    burnish_obj_line line = open_part(p);
    size_t vertices = p->before.vertices, normals = p->before.normals;
    int good = 1;
    (void)thread;
    if (!p->has_values || atomic_load(&obj->give_up)) {
        return;
    }
    p->has_colors = 0;
    do {
        switch (burnish_obj_read_keyword(&line)) {
        case BURNISH_OBJ_VERTEX:
            good = pass_one(&vertices, p->before.vertices, p->own.vertices) &&
                   read_vertex(obj, p, &line, vertices - 1);
            break;
        case BURNISH_OBJ_NORMAL:
            good = pass_one(&normals, p->before.normals, p->own.normals) &&
                   burnish_obj_read_normal(&line, obj->source->normals + 3 * (normals - 1)) ==
                       BURNISH_STATUS_OK;
            break;
        default:
            break;
        }
    } while (good && burnish_text_next_line(&line.text));
    if (!good || vertices != p->before.vertices + p->own.vertices ||
        normals != p->before.normals + p->own.normals) {
        atomic_store(&obj->give_up, 1);
    }
    burnish_obj_line_close(&line);
}

/* ---- faces ---- */

static int record_event(burnish_obj_part *p, const burnish_obj_line *line, size_t triangle,
                        int is_library) {
    if (burnish_legacy_reserve((void **)&p->events, &p->event_capacity, p->event_count + 1,
                               sizeof *p->events, "material statements",
                               NULL) != BURNISH_STATUS_OK) {
        return 0;
    }
    p->events[p->event_count++] = (burnish_obj_event){line->text.next, line->text.line,
                                                      triangle - p->before.triangles, is_library};
    return 1;
}

/* Reads a face behind what `at` counts, and moves its triangles on. */
static int read_face(obj_parts *obj, const burnish_obj_part *p, burnish_obj_line *line,
                     burnish_obj_counts *at) {
    if (burnish_obj_read_face(line, at->vertices, at->normals) != BURNISH_STATUS_OK ||
        line->corner_count < 3 ||
        line->corner_count - 2 > p->before.triangles + p->own.triangles - at->triangles) {
        return 0;
    }
    if (line->has_normals && !atomic_load_explicit(&obj->normals_used, memory_order_relaxed)) {
        atomic_store(&obj->normals_used, 1);
    }
    burnish_place_polygon(obj->source, at->triangles, line->corners,
                          line->has_normals ? line->corner_normals : NULL, line->corner_count);
    at->triangles += line->corner_count - 2;
    return 1;
}

static void read_faces(void *of, size_t index, int thread) {
    obj_parts *obj = of;
    burnish_obj_part *p = &obj->parts[index];
    burnish_obj_line line = open_part(p);
    burnish_obj_counts at = p->before;
    int good = 1;
    (void)thread;
    if (!p->has_statements || atomic_load(&obj->give_up)) {
        return;
    }
    do {
        const burnish_obj_keyword keyword = burnish_obj_read_keyword(&line);
        if (keyword == BURNISH_OBJ_VERTEX) {
            good = pass_one(&at.vertices, p->before.vertices, p->own.vertices);
        } else if (keyword == BURNISH_OBJ_NORMAL) {
            good = pass_one(&at.normals, p->before.normals, p->own.normals);
        } else if (keyword == BURNISH_OBJ_FACE) {
            good = read_face(obj, p, &line, &at);
        } else if (keyword == BURNISH_OBJ_MATERIAL || keyword == BURNISH_OBJ_LIBRARY) {
            good = record_event(p, &line, at.triangles, keyword == BURNISH_OBJ_LIBRARY);
        } else {
            good = keyword != BURNISH_OBJ_ELEMENT;
        }
    } while (good && burnish_text_next_line(&line.text));
    if (!good || at.triangles != p->before.triangles + p->own.triangles ||
        at.vertices != p->before.vertices + p->own.vertices ||
        at.normals != p->before.normals + p->own.normals) {
        atomic_store(&obj->give_up, 1);
    }
    burnish_obj_line_close(&line);
}

/* ---- materials ---- */

/* What usemtl and mtllib do, in the order of the file. */
static burnish_status replay_events(const obj_parts *obj, burnish_obj_materials *materials) {
    const uint8_t *end = obj->input->bytes + obj->input->size;
    burnish_status status = BURNISH_STATUS_OK;
    size_t triangle = 0; /* those before it have their run */
    for (size_t i = 0; i < obj->count; ++i) {
        const burnish_obj_part *p = &obj->parts[i];
        for (size_t k = 0; k < p->event_count && status == BURNISH_STATUS_OK; ++k) {
            const burnish_obj_event *e = &p->events[k];
            burnish_text text = {e->behind, end, p->before.lines + e->line, 1};
            if (p->before.triangles + e->triangle > triangle) {
                status = burnish_obj_begin_run(materials, triangle);
                triangle = p->before.triangles + e->triangle;
            }
            if (status == BURNISH_STATUS_OK && e->is_library) {
                status = burnish_obj_read_libraries(materials, &text);
            } else if (status == BURNISH_STATUS_OK) {
                burnish_obj_use_material(materials, burnish_text_rest(&text));
            }
        }
    }
    return status == BURNISH_STATUS_OK && triangle < obj->total.triangles
               ? burnish_obj_begin_run(materials, triangle)
               : status;
}

/* ---- the file ---- */

static int cut_parts(obj_parts *obj) {
    const burnish_text text = burnish_text_open(obj->input->bytes, obj->input->size, 1);
    obj->parts = calloc(burnish_parts_most(obj->input->size), sizeof *obj->parts);
    if (!obj->parts) {
        return 0;
    }
    for (const uint8_t *first = text.next; first < text.end; ++obj->count) {
        burnish_obj_part *p = &obj->parts[obj->count];
        p->first = first;
        p->end = first = burnish_part_end(first, text.end, 1);
    }
    return 1;
}

/* Room for all vertices, with colours where `colors`. */
static int reserve_values(obj_parts *obj, int colors) {
    burnish_source *source = obj->source;
    return burnish_legacy_reserve_discard((void **)&source->positions, &source->position_capacity,
                                          obj->total.vertices, 3 * sizeof(float), "positions",
                                          NULL) == BURNISH_STATUS_OK &&
           burnish_legacy_reserve_discard((void **)&source->normals, &source->normal_capacity,
                                          obj->total.normals, 3 * sizeof(float), "normals",
                                          NULL) == BURNISH_STATUS_OK &&
           (!colors || burnish_legacy_reserve_discard((void **)&source->colors,
                                                      &source->color_capacity, obj->total.vertices,
                                                      4, "colours", NULL) == BURNISH_STATUS_OK);
}

static int run_pass(obj_parts *obj, burnish_task *task) {
    burnish_tasks_run(obj->source->pool, obj->count, 1, 0, task, obj);
    return !atomic_load(&obj->give_up);
}

static int any_colors(const obj_parts *obj) {
    int colors = 0;
    for (size_t i = 0; i < obj->count; ++i) {
        colors |= obj->parts[i].has_colors;
    }
    return colors;
}

static void drop_corner_normals(burnish_source *source) { /* an array says that there are some */
    burnish_parts_drop((void **)&source->corner_normals, &source->corner_normal_capacity);
}

static void drop_all(burnish_source *source) {
    drop_corner_normals(source);
    burnish_parts_drop((void **)&source->positions, &source->position_capacity);
    burnish_parts_drop((void **)&source->normals, &source->normal_capacity);
    burnish_parts_drop((void **)&source->corner_positions, &source->corner_capacity);
    burnish_parts_drop((void **)&source->colors, &source->color_capacity);
}

static int read_all_values(obj_parts *obj) {
    if (!reserve_values(obj, any_colors(obj)) || !run_pass(obj, read_values)) {
        return 0;
    }
    if (any_colors(obj) && !obj->source->colors) { /* the first ones of all parts had none */
        return reserve_values(obj, 1) && run_pass(obj, read_values);
    }
    return 1;
}

static int read_all_faces(obj_parts *obj) {
    burnish_source *source = obj->source;
    if (burnish_legacy_reserve_discard((void **)&source->corner_positions, &source->corner_capacity,
                                       obj->total.triangles, 3 * sizeof(uint32_t), "triangles",
                                       NULL) != BURNISH_STATUS_OK ||
        (obj->total.normals > 0 &&
         burnish_legacy_reserve_discard((void **)&source->corner_normals,
                                        &source->corner_normal_capacity, obj->total.triangles,
                                        3 * sizeof(uint32_t), "normal indices",
                                        NULL) != BURNISH_STATUS_OK)) {
        return 0;
    }
    return run_pass(obj, read_faces);
}

static int read_parts(obj_parts *obj) {
    return cut_parts(obj) && run_pass(obj, count_part) && add_up(obj) && read_all_values(obj) &&
           read_all_faces(obj);
}

burnish_status burnish_obj_read_parts(const burnish_reader_input *input, burnish_source *source,
                                      burnish_obj_materials *materials, int *done) {
    burnish_status status = BURNISH_STATUS_OK;
    obj_parts obj = {.input = input, .source = source};
    *done = 0;
    if (!burnish_parts_pay(source->pool, input->size)) {
        return status;
    }
    if (read_parts(&obj)) {
        *done = 1;
        source->position_count = obj.total.vertices;
        source->normal_count = obj.total.normals;
        source->triangle_count = obj.total.triangles;
        if (!atomic_load(&obj.normals_used)) {
            drop_corner_normals(source);
        }
        status = replay_events(&obj, materials);
    } else {
        drop_all(source);
    }
    for (size_t i = 0; i < obj.count; ++i) {
        free(obj.parts[i].events);
    }
    free(obj.parts);
    return status;
}
