/* Rows of an ASCII PLY body that are one line each: read by threads.
 *
 * Line ends tell which row a part begins with, words how many triangles its faces become. Each row
 * is read as ever, and has to begin and end with its line. */
#include "mesh/read/ply_lines.h"

#include <stdatomic.h>
#include <string.h>

#include "mesh/mesh.h"
#include "mesh/read/append.h"
#include "mesh/read/parts.h"

typedef struct part {
    const uint8_t *first, *end;
    size_t first_row, rows; /* line ends */
    size_t first_triangle, triangles;
    size_t words;
} part;

typedef struct ply_lines {
    const burnish_ply_cursor *cursor; /* at the first row */
    burnish_source *source;
    part *parts;
    size_t count;
    size_t row_count;
    int has_normals, has_colors;
    const uint8_t *end; /* behind the last value of the last row */
    atomic_int give_up;
} ply_lines;

/* ---- counting ---- */

static void count_rows(void *of, size_t index, int thread) {
    part *p = &((ply_lines *)of)->parts[index];
    (void)thread;
    p->rows = burnish_count_newlines(p->first, p->end);
}

static void count_words(void *of, size_t index, int thread) {
    part *p = &((ply_lines *)of)->parts[index];
    (void)thread;
    p->words = burnish_count_words(p->first, p->end);
}

static int cut_parts(ply_lines *lines) {
    const burnish_text *text = &lines->cursor->text;
    lines->parts = calloc(burnish_parts_most((size_t)(text->end - text->next)), sizeof(part));
    if (!lines->parts) {
        return 0;
    }
    for (const uint8_t *first = text->next; first < text->end; ++lines->count) {
        part *p = &lines->parts[lines->count];
        p->first = first;
        p->end = first = burnish_part_end(first, text->end, 0);
    }
    return 1;
}

/* Cuts a part off behind so many lines. */
static void shorten(part *p, size_t rows) {
    p->rows = rows;
    const uint8_t *line = p->first;
    while (rows-- > 0) {
        line = burnish_find_newline(line, p->end);
        line += line < p->end;
    }
    p->end = line;
}

/* Finds the parts that hold the rows, and no more. Returns 0 when there are too few lines. */
static int find_rows(ply_lines *lines) {
    size_t rows = 0;
    for (size_t i = 0; i < lines->count; ++i) {
        part *p = &lines->parts[i];
        const size_t missing = lines->row_count - rows;
        const int open_end = p->end[-1] != '\n'; /* of the last line of the text */
        p->first_row = rows;
        if (p->rows + (size_t)open_end >= missing) {
            shorten(p, missing);
            lines->count = i + 1;
            return 1;
        }
        rows += p->rows;
    }
    return 0;
}

/* ---- reading ---- */

static burnish_ply_cursor open_part(const ply_lines *lines, const part *p) {
    const burnish_ply_cursor *from = lines->cursor;
    burnish_ply_cursor cursor = {.input = from->input,
                                 .header = from->header,
                                 .text = {p->first, p->end, 1, 0},
                                 .element = from->element,
                                 .vertex_count = from->vertex_count};
    memcpy(cursor.types, from->types, sizeof cursor.types);
    return cursor;
}

/* Reads one row; returns 0 unless it is a line, the `line`-th of the text, counted from 1. */
static int read_line(burnish_ply_cursor *cursor, size_t line) {
    burnish_text *text = &cursor->text;
    if (burnish_ply_read_row(cursor) != BURNISH_STATUS_OK || text->line != line) {
        return 0;
    }
    const uint8_t *p = text->next;
    while (p < text->end && burnish_text_blank(*p)) {
        ++p;
    }
    p += text->end - p > 1 && p[0] == '\r' && p[1] == '\n';
    return p == text->end || *p == '\n';
}

/* What is done with a row, the row-th of the element. Returns 0 to give up. */
typedef int take_row(const ply_lines *lines, const part *p, const burnish_ply_cursor *cursor,
                     size_t row, size_t *triangle);

static void read_part(ply_lines *lines, const part *p, take_row *take) {
    burnish_ply_cursor cursor = open_part(lines, p);
    size_t triangle = p->first_triangle;
    int good = !atomic_load(&lines->give_up);
    for (size_t i = 0; i < p->rows && good; ++i) {
        good = read_line(&cursor, i + 1) && take(lines, p, &cursor, p->first_row + i, &triangle);
        if (good && i + 1 < p->rows) {
            burnish_text_next_line(&cursor.text);
        }
    }
    if (p == lines->parts + lines->count - 1) {
        lines->end = cursor.text.next;
    }
    if (!good || triangle != p->first_triangle + p->triangles) {
        atomic_store(&lines->give_up, 1);
    }
    burnish_ply_close(&cursor);
}

static int take_vertex(const ply_lines *lines, const part *p, const burnish_ply_cursor *cursor,
                       size_t row, size_t *triangle) {
    burnish_source *source = lines->source;
    (void)p, (void)triangle;
    burnish_ply_get_position(cursor, source->positions + 3 * row);
    if (lines->has_normals) {
        burnish_ply_get_normal(cursor, source->normals + 3 * row);
    }
    if (lines->has_colors) {
        burnish_ply_get_color(cursor, source->colors + 4 * row);
    }
    return 1;
}

/* Of faces with fewer than 3 corners is warned. */
static int take_face(const ply_lines *lines, const part *p, const burnish_ply_cursor *cursor,
                     size_t row, size_t *triangle) {
    (void)row;
    if (cursor->corner_count < 3 ||
        cursor->corner_count - 2 > p->first_triangle + p->triangles - *triangle) {
        return 0;
    }
    burnish_place_polygon(lines->source, *triangle, cursor->corners, NULL, cursor->corner_count);
    *triangle += cursor->corner_count - 2;
    return 1;
}

static void read_vertices(void *of, size_t index, int thread) {
    ply_lines *lines = of;
    (void)thread;
    read_part(lines, &lines->parts[index], take_vertex);
}

static void read_faces(void *of, size_t index, int thread) {
    ply_lines *lines = of;
    (void)thread;
    read_part(lines, &lines->parts[index], take_face);
}

/* ---- elements ---- */

static int reserve_vertices(const ply_lines *lines) {
    burnish_source *source = lines->source;
    const size_t count = lines->row_count;
    return burnish_legacy_reserve_discard((void **)&source->positions, &source->position_capacity,
                                          count, 3 * sizeof(float), "positions",
                                          NULL) == BURNISH_STATUS_OK &&
           (!lines->has_normals || burnish_legacy_reserve_discard(
                                       (void **)&source->normals, &source->normal_capacity, count,
                                       3 * sizeof(float), "normals", NULL) == BURNISH_STATUS_OK) &&
           (!lines->has_colors ||
            burnish_legacy_reserve_discard((void **)&source->colors, &source->color_capacity, count,
                                           4, "colours", NULL) == BURNISH_STATUS_OK);
}

/* Sums up the triangles before each part, and makes room for all. The corners are the only list of
 * a row, so words tell how many there are. */
static int reserve_triangles(ply_lines *lines, const burnish_load_options *options) {
    burnish_source *source = lines->source;
    const size_t words_besides = lines->cursor->element->property_count; /* their number is one */
    size_t triangles = 0;
    for (size_t i = 0; i < lines->count; ++i) {
        part *p = &lines->parts[i];
        size_t least;
        if (!burnish_size_multiply(p->rows, words_besides + 3, &least) || p->words < least) {
            return 0;
        }
        p->first_triangle = triangles;
        p->triangles = p->words - least + p->rows;
        triangles += p->triangles;
    }
    return triangles <= BURNISH_TRIANGLES_MAX && triangles <= options->max_triangles &&
           burnish_legacy_reserve_discard((void **)&source->corner_positions,
                                          &source->corner_capacity, triangles, 3 * sizeof(uint32_t),
                                          "triangles", NULL) == BURNISH_STATUS_OK;
}

static int has_other_lists(const burnish_ply_cursor *ply) {
    const burnish_ply_property *first = ply->header->properties + ply->element->first_property;
    int others = 0;
    for (size_t i = 0; i < ply->element->property_count; ++i) {
        others |= first[i].count_type != BURNISH_PLY_NONE && first[i].role != BURNISH_PLY_CORNERS;
    }
    return others;
}

/* A cursor at the first row, and the parts that hold all of them. */
static int open_rows(ply_lines *lines, burnish_ply_cursor *first_row) {
    burnish_token token;
    burnish_text text = first_row->text;
    if (!burnish_parts_pay(lines->source->pool, (size_t)(text.end - text.next)) ||
        !burnish_text_word(&text, &token)) {
        return 0;
    }
    text.next = token.bytes;
    first_row->text = text;
    lines->cursor = first_row;
    if (!cut_parts(lines)) {
        return 0;
    }
    burnish_tasks_run(lines->source->pool, lines->count, 1, 0, count_rows, lines);
    return find_rows(lines);
}

static int run_pass(ply_lines *lines, burnish_task *task) {
    burnish_tasks_run(lines->source->pool, lines->count, 1, 0, task, lines);
    return !atomic_load(&lines->give_up);
}

/* Releases what reading took, and moves the cursor where it has read on. */
static int close_rows(ply_lines *lines, int done, burnish_ply_cursor *ply) {
    if (done) {
        ply->text.next = lines->end;
        ply->text.line = lines->cursor->text.line + lines->row_count - 1;
    }
    free(lines->parts);
    return done;
}

int burnish_ply_vertex_lines(burnish_ply_cursor *ply, burnish_source *source) {
    burnish_ply_cursor first_row = *ply;
    ply_lines lines = {.source = source,
                       .row_count = (size_t)ply->element->count,
                       .has_normals = burnish_ply_has_normals(ply),
                       .has_colors = burnish_ply_has_colors(ply)};
    if (source->positions || source->normals || source->colors) {
        return 0;
    }
    int done = open_rows(&lines, &first_row) && reserve_vertices(&lines) &&
               run_pass(&lines, read_vertices);
    if (done) {
        source->position_count = lines.row_count;
        source->normal_count = lines.has_normals ? lines.row_count : 0;
    } else {
        burnish_parts_drop((void **)&source->positions, &source->position_capacity);
        burnish_parts_drop((void **)&source->normals, &source->normal_capacity);
        burnish_parts_drop((void **)&source->colors, &source->color_capacity);
    }
    return close_rows(&lines, done, ply);
}

int burnish_ply_face_lines(burnish_ply_cursor *ply, const burnish_load_options *options,
                           burnish_source *source) {
    burnish_ply_cursor first_row = *ply;
    ply_lines lines = {.source = source, .row_count = (size_t)ply->element->count};
    int done = 0;
    if (source->corner_positions || source->corner_normals || has_other_lists(ply)) {
        return 0;
    }
    if (open_rows(&lines, &first_row)) {
        burnish_tasks_run(source->pool, lines.count, 1, 0, count_words, &lines);
        done = reserve_triangles(&lines, options) && run_pass(&lines, read_faces);
    }
    if (done) {
        const part *last = &lines.parts[lines.count - 1];
        source->triangle_count = last->first_triangle + last->triangles;
    } else {
        burnish_parts_drop((void **)&source->corner_positions, &source->corner_capacity);
    }
    return close_rows(&lines, done, ply);
}
