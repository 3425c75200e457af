/* For tests of readers: a wavy sheet of triangles, as a file of each format. */
#ifndef BURNISH_TEST_SHEET_H
#define BURNISH_TEST_SHEET_H

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "support.h"

/* A file under construction. */
typedef struct file_bytes {
    uint8_t *bytes;
    size_t size, capacity;
} file_bytes;

static inline void add(file_bytes *f, const void *bytes, size_t size) {
    if (f->capacity - f->size < size) {
        f->capacity = 2 * f->capacity + size;
        f->bytes = realloc(f->bytes, f->capacity);
        if (!f->bytes) {
            abort();
        }
    }
    memcpy(f->bytes + f->size, bytes, size);
    f->size += size;
}

__attribute__((format(printf, 2, 3))) static inline void say(file_bytes *f, const char *format,
                                                             ...) {
    char line[1024];
    va_list arguments;
    va_start(arguments, format);
    add(f, line, (size_t)vsnprintf(line, sizeof line, format, arguments));
    va_end(arguments);
}

static inline void add_bits(file_bytes *f, uint64_t bits, int size, int big_endian) {
    for (int i = 0; i < size; ++i) {
        const uint8_t byte = (uint8_t)(bits >> 8 * (big_endian ? size - 1 - i : i));
        add(f, &byte, 1);
    }
}

static inline void save_bytes(const char *path, const file_bytes *file) {
    FILE *to = fopen(path, "wb");
    CHECK(to && fwrite(file->bytes, 1, file->size, to) == file->size && fclose(to) == 0,
          "can't write %s", path);
}

/* z jumps from vertex to vertex, or is x y / 128; or a torus, whose squares go on at the other end. */
typedef enum sheet_shape { SHEET_WAVY, SHEET_SMOOTH, SHEET_TORUS } sheet_shape;

/* What a sheet has. */
typedef struct sheet {
    sheet_shape shape;
    const double *shift; /* added to coordinates; NULL: nothing */
    double scale;        /* of coordinates; 0: 1 */
    int side;            /* vertices of a side */
    int normals;         /* of vertices */
    int colors;          /* of vertices; OBJ: 1 all, 2 some, 3 from the middle on */
    int quads;           /* pairs of triangles of every fourth row are one face */
    const char *newline;
    const char *middle, *end; /* text before the middle face, and after the last one */
} sheet;

static inline unsigned sheet_vertices(const sheet *s) {
    return (unsigned)(s->side * s->side);
}

static inline unsigned sheet_squares(const sheet *s) {
    const int count = s->side - (s->shape != SHEET_TORUS);
    return (unsigned)(count * count);
}

/* Of a torus, multiples of 2^-16: any two of a survey differ exactly. */
static inline double sheet_torus(const sheet *s, unsigned vertex, int axis) {
    const double turn = 2 * 3.14159265358979323846 / s->side;
    const double u = turn * (vertex % (unsigned)s->side), v = turn * (vertex / (unsigned)s->side);
    const double ring = 1 + 0.375 * cos(v);
    const double exact[3] = {ring * cos(u), ring * sin(u), 0.375 * sin(v)};
    return round(exact[axis] * 0x1p16) * 0x1p-16;
}

/* Of a wavy sheet, multiples of 0.25, which all types and all ways to write them hold exactly. */
static inline double sheet_coordinate(const sheet *s, unsigned vertex, int axis) {
    const unsigned x = vertex % (unsigned)s->side, y = vertex / (unsigned)s->side;
    const double value = s->shape == SHEET_TORUS    ? sheet_torus(s, vertex, axis)
                         : axis < 2                 ? (axis == 0 ? x : y)
                         : s->shape == SHEET_SMOOTH ? x * y / 128.0
                                                    : 0.25 * (vertex * vertex % 17);
    return (s->shift ? s->shift[axis] : 0) + (s->scale > 0 ? s->scale : 1) * value;
}

/* The corners of a square, counterclockwise; which comes first differs. */
static inline void sheet_corners(const sheet *s, unsigned square, unsigned corners[4]) {
    const unsigned side = (unsigned)s->side;
    const unsigned row_size = side - (s->shape != SHEET_TORUS);
    const unsigned x = square % row_size, y = square / row_size * side;
    const unsigned right = (x + 1) % side, above = (y + side) % (side * side);
    const unsigned around[4] = {y + x, y + right, above + right, above + x};
    for (unsigned k = 0; k < 4; ++k) {
        corners[k] = around[(k + square) % 4];
    }
}

static inline int sheet_is_quad(const sheet *s, unsigned square) {
    return s->quads && square / (unsigned)(s->side - 1) % 4 == 0;
}

/* The faces of a square: 1 or 2, with 4 or 3 corners each. Returns their number. */
static inline int sheet_faces(const sheet *s, unsigned square, unsigned faces[2][4]) {
    unsigned c[4];
    sheet_corners(s, square, c);
    memcpy(faces[0], c, sizeof c);
    memcpy(faces[1], (unsigned[]){c[0], c[2], c[3], 0}, sizeof c);
    return sheet_is_quad(s, square) ? 1 : 2;
}

static inline unsigned sheet_face_count(const sheet *s) {
    unsigned count = 0;
    for (unsigned i = 0; i < sheet_squares(s); ++i) {
        count += sheet_is_quad(s, i) ? 1 : 2;
    }
    return count;
}

/* ---- Text ---- */

/* The coordinates of a vertex in the ways that files write numbers. */
static inline void say_position(file_bytes *f, const sheet *s, unsigned vertex) {
    static const char *const forms[] = {" %g",   " %.6f",   "  %.6e", "\t%.17g",
                                        " %.3f", " %+.25f", " %.4E",  " %.1f0e1"};
    for (int axis = 0; axis < 3; ++axis) {
        const unsigned form =
            s->shape || s->shift || s->scale > 0 ? 3 : (vertex + (unsigned)axis) % 8;
        const double value = sheet_coordinate(s, vertex, axis);
        const int is_exact = form != 6 || value < 100; /* by 4 digits */
        char word[64];
        snprintf(word, sizeof word, form == 7 || !is_exact ? " %.2f" : forms[form], value);
        add(f, word, strlen(word));
    }
}

static inline const char *middle_of(const sheet *s, unsigned square) {
    return s->middle && square == sheet_squares(s) / 2 ? s->middle : "";
}

static inline void write_stl(file_bytes *f, const sheet *s) {
    say(f, "solid sheet%s", s->newline);
    for (unsigned i = 0; i < sheet_squares(s); ++i) {
        unsigned faces[2][4];
        const int is_odd = i % 7 == 3, count = sheet_faces(s, i, faces);
        say(f, "%s", middle_of(s, i));
        for (int n = 0; n < count; ++n) {
            say(f, "%s nan 0 1%s outer loop%s%s", is_odd ? "  FACET  Normal" : "facet normal",
                s->newline, s->newline, is_odd ? s->newline : "");
            for (int k = 0; k < 3; ++k) {
                say(f, "%s", is_odd ? " Vertex" : "vertex");
                say_position(f, s, faces[n][k]);
                say(f, "%s", is_odd ? "  " : s->newline);
            }
            say(f, "endloop%sendfacet%s", s->newline, s->newline);
        }
    }
    say(f, "%s", s->end ? s->end : "endsolid");
}

static inline void say_ply_head(file_bytes *f, const sheet *s, const char *encoding,
                                const char *types[3]) {
    const char *n = s->newline;
    say(f, "ply%sformat %s 1.0%selement vertex %u%sproperty %s x%sproperty %s y%sproperty %s z%s",
        n, encoding, n, sheet_vertices(s), n, types[0], n, types[0], n, types[0], n);
    if (s->normals) {
        say(f, "property float nx%sproperty float ny%sproperty float nz%s", n, n, n);
    }
    if (s->colors) {
        say(f, "property uchar red%sproperty uchar green%sproperty uchar blue%s", n, n, n);
    }
    say(f, "element face %u%sproperty list %s %s vertex_indices%send_header%s", sheet_face_count(s),
        n, types[1], types[2], n, n);
}

static inline void write_ply(file_bytes *f, const sheet *s) {
    say_ply_head(f, s, "ascii", (const char *[]){"double", "uchar", "int"});
    for (unsigned i = 0; i < sheet_vertices(s); ++i) {
        say_position(f, s, i);
        say(f, "%s", s->normals ? i % 3 == 0 ? " 1 0 0" : " 0 0 1" : "");
        if (s->colors) {
            say(f, " %u 7 255", i & 255);
        }
        say(f, "%s", s->newline);
    }
    for (unsigned i = 0; i < sheet_squares(s); ++i) {
        unsigned faces[2][4];
        const int count = sheet_faces(s, i, faces);
        say(f, "%s", middle_of(s, i));
        for (int n = 0; n < count; ++n) {
            const unsigned *c = faces[n];
            say(f, count == 1 ? "4 %u %u %u %u" : "3 %u %u %u", c[0], c[1], c[2], c[3]);
            say(f, "%s", s->newline);
        }
    }
    say(f, "%s", s->end ? s->end : "");
}

/* A corner of OBJ: a position, sometimes with a texture coordinate or a normal, or from the end. */
static inline void say_corner(file_bytes *f, const sheet *s, unsigned square, unsigned vertex) {
    const int back = (int)vertex - (int)sheet_vertices(s);
    switch (square % 5) {
    case 0:
        say(f, " %d/%u", back, vertex + 1);
        break;
    case 1:
        say(f, s->normals ? " %u/7/%d" : " %u/7", vertex + 1, back);
        break;
    case 2:
        say(f, s->normals ? " %u//%d" : " %u", vertex + 1, back);
        break;
    default:
        say(f, " %u", vertex + 1);
    }
}

static inline void write_obj(file_bytes *f, const sheet *s) {
    say(f, "\xEF\xBB\xBF# a sheet%smtllib a.mtl missing.mtl%s", s->newline, s->newline);
    for (unsigned i = 0; i < sheet_vertices(s); ++i) {
        const int is_colored = s->colors == 1 || (s->colors == 2 && i % 3 == 0) ||
                               (s->colors == 3 && i > sheet_vertices(s) / 2);
        say(f, i % 20 == 3 ? "  \tv" : "v");
        say_position(f, s, i);
        say(f, "%s%s%svt .%u .5%s",
            is_colored   ? " 1 0.5 .25"
            : i % 9 == 1 ? " 1.0"
                         : "",
            i % 40 == 7 ? " # behind" : "", s->newline, i % 1000, s->newline);
        if (s->normals) {
            say(f, "vn 0 %s 1%s", i % 30 == 4 ? "nan" : "0", s->newline);
        }
    }
    for (unsigned i = 0; i < sheet_squares(s); ++i) {
        unsigned faces[2][4];
        const int count = sheet_faces(s, i, faces);
        say(f, "%s", middle_of(s, i));
        if (i % 50 == 6) {
            say(f, "usemtl %s%sg group v f%s%so thing%s", i % 3 ? "red" : "none", s->newline,
                s->newline, s->newline, s->newline);
        }
        for (int n = 0; n < count; ++n) {
            say(f, "f");
            for (int k = 0; k < (count == 1 ? 4 : 3); ++k) {
                say_corner(f, s, i, faces[n][k]);
                if (i % 11 == 5 && *s->newline != ' ') {
                    say(f, " \\%s", s->newline);
                }
            }
            say(f, "%s%s", i % 40 == 9 ? "  # 1 2 3" : "", s->newline);
        }
    }
    say(f, "%s", s->end ? s->end : "f 1 2 3");
}

static inline void write_off(file_bytes *f, const sheet *s) {
    say(f, "%sOFF%s%u %u 0%s", s->colors ? "C" : "", s->newline, sheet_vertices(s),
        sheet_face_count(s), s->newline);
    for (unsigned i = 0; i < sheet_vertices(s); ++i) {
        say_position(f, s, i);
        say(f, "%s%s", s->colors ? " 1 .5 0 1" : "", s->newline);
    }
    for (unsigned i = 0; i < sheet_squares(s); ++i) {
        unsigned faces[2][4];
        const int count = sheet_faces(s, i, faces);
        say(f, "%s", middle_of(s, i));
        for (int n = 0; n < count; ++n) {
            const unsigned *c = faces[n];
            say(f, "%d%s", count == 1 ? 4 : 3, i % 6 == 1 ? s->newline : ""); /* goes on below */
            say(f, count == 1 ? " %u %u %u %u" : " %u %u %u", c[0], c[1], c[2], c[3]);
            say(f, "%s%s", i % 5 == 2 && !s->shape ? " 255 0 0 # red" : "", s->newline);
        }
    }
    say(f, "%s", s->end ? s->end : "");
}

/* ---- Binary files ---- */

static inline void add_float(file_bytes *f, double value, int is_double, int big_endian) {
    const float single = (float)value;
    uint64_t bits = 0;
    uint32_t word;
    if (is_double) {
        memcpy(&bits, &value, sizeof bits);
    } else {
        memcpy(&word, &single, sizeof word);
        bits = word;
    }
    add_bits(f, bits, is_double ? 8 : 4, big_endian);
}

/* A GLB of a JSON text, which is padded, and a binary chunk of whole words. */
static inline void add_glb(file_bytes *f, file_bytes *json, const file_bytes *binary) {
    add(json, "   ", (4 - json->size % 4) % 4);
    add(f, "glTF\2\0\0\0", 8);
    add_bits(f, 28 + json->size + binary->size, 4, 0);
    add_bits(f, json->size, 4, 0);
    add(f, "JSON", 4);
    add(f, json->bytes, json->size);
    add_bits(f, binary->size, 4, 0);
    add(f, "BIN", 4);
    add(f, binary->bytes, binary->size);
}

/* How a binary PLY is laid out. */
typedef struct ply_layout {
    const char *length, *corner; /* types of a face's list */
    int length_size, corner_size, big_endian, has_doubles;
} ply_layout;

/* Returns where the faces begin. */
static inline size_t write_binary_ply(file_bytes *f, const sheet *s, const ply_layout *how) {
    say_ply_head(f, s, how->big_endian ? "binary_big_endian" : "binary_little_endian",
                 (const char *[]){how->has_doubles ? "double" : "float", how->length, how->corner});
    for (unsigned i = 0; i < sheet_vertices(s); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            add_float(f, sheet_coordinate(s, i, axis), how->has_doubles, how->big_endian);
        }
        for (int axis = 0; axis < 3 && s->normals; ++axis) {
            add_float(f, axis == (i % 3 == 0 ? 0 : 2), 0, how->big_endian);
        }
        if (s->colors) {
            add(f, (uint8_t[]){(uint8_t)i, 7, 255}, 3);
        }
    }
    const size_t begin = f->size;
    for (unsigned i = 0; i < sheet_squares(s); ++i) {
        unsigned faces[2][4];
        const int count = sheet_faces(s, i, faces), corners = count == 1 ? 4 : 3;
        for (int n = 0; n < count; ++n) {
            add_bits(f, (unsigned)corners, how->length_size, how->big_endian);
            for (int k = 0; k < corners; ++k) {
                add_bits(f, faces[n][k], how->corner_size, how->big_endian);
            }
        }
    }
    return begin;
}

static inline void write_binary_stl(file_bytes *f, const sheet *s, const char *title) {
    char head[80] = {0};
    memcpy(head, title, strlen(title));
    add(f, head, sizeof head);
    add_bits(f, 2 * (uint64_t)sheet_squares(s), 4, 0);
    for (unsigned i = 0; i < sheet_squares(s); ++i) {
        unsigned faces[2][4];
        sheet_faces(s, i, faces);
        for (int n = 0; n < 2; ++n) {
            for (int k = -3; k < 9; ++k) {
                add_float(f, k < 0 ? 0 : sheet_coordinate(s, faces[n][k / 3], k % 3), 0, 0);
            }
            add_bits(f, s->colors ? 0x8000 | (i & 0x7fff) : 0, 2, 0);
        }
    }
}

#endif
