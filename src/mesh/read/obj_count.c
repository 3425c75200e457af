/* Counts what is in a part of an OBJ file: line by line, or many lines at once. */
#include "mesh/read/obj_count.h"

#include <string.h>

#include "mesh/read/obj_line.h"
#include "mesh/read/parts.h"

/* ---- line by line ---- */

/* Corners of a face are the tokens behind its keyword. */
static int count_face(burnish_obj_part *p, size_t tokens) {
    p->has_statements = 1;
    p->own.triangles += tokens > 3 ? tokens - 3 : 0;
    return tokens > 3;
}

/* Counts the statement at *line token by token, and moves *line behind its last line. Returns 0 for
 * what gives up. */
static int count_slowly(burnish_obj_part *p, const uint8_t **line) {
    burnish_obj_line statement = {.text = {*line, p->end, 1, 1}};
    burnish_token token;
    size_t tokens = 1;
    int good = 1;
    switch (burnish_obj_read_keyword(&statement)) {
    case BURNISH_OBJ_VERTEX:
        while (tokens <= BURNISH_OBJ_VERTEX_MOST && burnish_text_token(&statement.text, &token)) {
            ++tokens;
        }
        ++p->own.vertices;
        p->has_values = 1;
        p->has_colors |= tokens > 6;
        break;
    case BURNISH_OBJ_NORMAL:
        while (tokens <= 3 && burnish_text_token(&statement.text, &token)) {
            ++tokens;
        }
        ++p->own.normals;
        p->has_values = 1;
        break;
    case BURNISH_OBJ_FACE:
        while (burnish_text_token(&statement.text, &token)) {
            ++tokens;
        }
        good = count_face(p, tokens);
        break;
    case BURNISH_OBJ_MATERIAL:
    case BURNISH_OBJ_LIBRARY:
        p->has_statements = 1;
        break;
    case BURNISH_OBJ_ELEMENT: /* of which the sequential reader warns */
        good = 0;
        break;
    case BURNISH_OBJ_NOTHING:
    case BURNISH_OBJ_OTHER:
        break;
    }
    burnish_text_next_line(&statement.text);
    p->own.lines += statement.text.line - 1 + (statement.text.next == p->end);
    *line = statement.text.next;
    return good;
}

/* The same by a look at the first letters, for a line that ends at a '\n' without a '\' before it.
 */
static int count_line(burnish_obj_part *p, const uint8_t **line, const uint8_t *newline) {
    const uint8_t *letter = *line;
    while (letter < newline && burnish_text_blank(*letter)) {
        ++letter;
    }
    const uint8_t first = *letter, second = letter < newline ? letter[1] : 0;
    if (first == 'v' && burnish_text_blank(second)) {
        if (p->own.vertices == 0) { /* the first one tells of the others, usually */
            return count_slowly(p, line);
        }
        ++p->own.vertices;
    } else if (first == 'v' && second == 'n') {
        if (!burnish_text_blank(letter[2])) {
            return count_slowly(p, line);
        }
        ++p->own.normals;
        p->has_values = 1;
    } else if (first == 'f') {
        size_t tokens =
            burnish_text_blank(second) ? burnish_count_tokens(letter, newline, p->end) : 0;
        if (tokens == 0) {
            return count_slowly(p, line);
        }
        if (!count_face(p, tokens)) {
            return 0;
        }
    } else if (first == 'u' || first == 'm' || first == 'l' || first == 'p' ||
               (first == 'v' && second != 't')) {
        return count_slowly(p, line);
    }
    ++p->own.lines;
    *line = newline + 1;
    return 1;
}

/* ---- counting many lines at once ---- */

enum {
    BLOCK = 4096, /* bytes of lines that are looked at together, if they are all of one kind */
    STRIDE = 240  /* as many counts as a byte holds, in whole vectors */
};

typedef struct line_counts {
    size_t lines, faces, tokens;    /* faces: lines that begin with 'f' */
    size_t values, normals, others; /* 'v', of these 'vn', and 'vt' and the like */
    size_t strange;                 /* '#', '\\', words that begin with 'f' */
} line_counts;

/* The compiler makes these loops compare as many bytes as a vector holds; there is a byte before
 * the block. */

static void count_face_bytes(const uint8_t *at, const uint8_t *end, line_counts *c) {
    while (at < end) {
        const ptrdiff_t size = end - at < STRIDE ? end - at : STRIDE;
        uint8_t lines = 0, faces = 0, tokens = 0, strange = 0;
        for (ptrdiff_t i = 0; i < size; ++i) {
            const uint8_t byte = at[i], before = at[i - 1];
            lines = (uint8_t)(lines + (byte == '\n'));
            faces = (uint8_t)(faces + ((byte == 'f') & (before == '\n')));
            tokens = (uint8_t)(tokens + ((byte > ' ') & (before <= ' ')));
            strange |= (byte == '#') | (byte == '\\') | ((byte > ' ') & (before == 'f'));
        }
        c->lines += lines;
        c->faces += faces;
        c->tokens += tokens;
        c->strange += strange;
        at += size;
    }
}

static void count_value_bytes(const uint8_t *at, const uint8_t *end, line_counts *c) {
    while (at < end) {
        const ptrdiff_t size = end - at < STRIDE ? end - at : STRIDE;
        uint8_t lines = 0, values = 0, normals = 0, others = 0, strange = 0;
        for (ptrdiff_t i = 0; i < size; ++i) {
            const uint8_t byte = at[i], before = at[i - 1];
            lines = (uint8_t)(lines + (byte == '\n'));
            values = (uint8_t)(values + ((byte == 'v') & (before == '\n')));
            normals = (uint8_t)(normals + ((byte == 'n') & (before == 'v')));
            others = (uint8_t)(others + ((byte > ' ') & (byte != 'n') & (before == 'v')));
            strange |= (byte == '#') | (byte == '\\');
        }
        c->lines += lines;
        c->values += values;
        c->normals += normals;
        c->others += others;
        c->strange += strange;
        at += size;
    }
}

/* Counts some 4 KiB of lines from *line on, which is not the part's first, if all of them are
 * faces, or none but v, vn, vt and vp; returns 0 and moves nothing if they are not. */
static int count_block(burnish_obj_part *p, const uint8_t **line) {
    line_counts c = {0};
    const uint8_t *limit = p->end - *line > 2 * BLOCK ? *line + 2 * BLOCK : p->end;
    if (limit - *line <= BLOCK) {
        return 0;
    }
    const uint8_t *end = burnish_find_newline(*line + BLOCK, limit);
    if (end++ == limit) { /* a long line: not to be looked at again and again */
        return 0;
    }
    if (**line == 'f') {
        count_face_bytes(*line, end, &c);
        if (c.strange || c.faces != c.lines || c.tokens < 4 * c.lines) {
            return 0;
        }
        p->has_statements = 1;
        p->own.triangles += c.tokens - 3 * c.lines;
    } else if (**line == 'v' && p->own.vertices > 0) { /* count_line() looks at the first */
        count_value_bytes(*line, end, &c);
        if (c.strange || c.values != c.lines || c.normals + c.others > c.values) {
            return 0;
        }
        p->has_values = 1;
        p->own.normals += c.normals;
        p->own.vertices += c.values - c.normals - c.others;
    } else {
        return 0;
    }
    p->own.lines += c.lines;
    *line = end;
    return 1;
}

/* A '\r' that ends a line alone, which no newline tells. */
static int has_lone_return(const burnish_obj_part *p) {
    for (const uint8_t *at = p->first; at < p->end; ++at) {
        at = memchr(at, '\r', (size_t)(p->end - at));
        if (!at) {
            break;
        }
        if (at + 1 == p->end || at[1] != '\n') {
            return 1;
        }
    }
    return 0;
}

int burnish_obj_count_part(burnish_obj_part *p) {
    const uint8_t *line = p->first, *tried = p->first; /* no block before it */
    int good = !has_lone_return(p);
    while (good && line < p->end) {
        if (line > tried) {
            if (count_block(p, &line)) {
                continue;
            }
            tried = line + BLOCK;
        }
        const uint8_t *newline = burnish_find_newline(line, p->end);
        const uint8_t *last = newline - (newline - line > 1 && newline[-1] == '\r');
        int plain = newline < p->end && (last == line || last[-1] != '\\');
        good = plain ? count_line(p, &line, newline) : count_slowly(p, &line);
    }
    return good;
}
