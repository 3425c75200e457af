/* For tests of the readers: runs one over an exact copy of the bytes, to let the address sanitizer
 * detect reads beyond their end. */
#ifndef BURNISH_TEST_READER_INPUT_H
#define BURNISH_TEST_READER_INPUT_H

#include <stdarg.h>

#include "core/srgb.h"
#include "mesh/read/obj/obj_materials.h"
#include "mesh/read/read.h"
#include "support.h"

typedef burnish_status load_function(void *user_data, const char *name, uint64_t max_bytes,
                                     const void **bytes, size_t *size, burnish_error *error);

/* One reading. */
typedef struct reader_run {
    burnish_format format;
    const void *bytes;
    size_t size;
    const burnish_load_options *options;
    load_function *load_companion;
    burnish_tasks *tasks; /* NULL: one thread */
    size_t chunk_size;    /* 0: the reader's */
} reader_run;

/* Always keeps texture coordinates. */
static inline burnish_status read_as(const reader_run *run, burnish_mesh_data *mesh,
                                     burnish_error *error) {
    burnish_load_options all = *run->options;
    burnish_format format = run->format;
    char name[16];
    uint8_t *copy = malloc(run->size > 0 ? run->size : 1);
    if (!copy) {
        abort();
    }
    memcpy(copy, run->bytes, run->size);
    snprintf(name, sizeof name, "mesh.%s", burnish_format_get_info(format)->name);
    all.keep_texture_coordinates = 1;
    burnish_reader_input input = {.bytes = copy,
                                  .size = run->size,
                                  .name = name,
                                  .options = &all,
                                  .companions = {run->load_companion, NULL, NULL},
                                  .chunk_size = run->chunk_size};
    *error = (burnish_error){0};
    *mesh = burnish_mesh_data_begin(NULL, run->tasks, error);
    burnish_reader reader = {.input = &input, .mesh = mesh, .error = error};
    burnish_status status = burnish_read(&reader, &format);
    free(copy);
    return status;
}

static inline int same_bytes(const void *a, const void *b, size_t bytes) {
    return bytes == 0 || (!a && !b) || (a && b && memcmp(a, b, bytes) == 0);
}

/* Every array, and every warning. */
static inline void compare_meshes(const char *what, const burnish_mesh_data *a,
                                  const burnish_mesh_data *b) {
    const size_t corners = 3 * a->triangle_count * sizeof(uint32_t);
    if (!CHECK(a->triangle_count == b->triangle_count && a->material_count == b->material_count &&
                   a->warning_count == b->warning_count,
               "%s: %zu %zu triangles, %zu %zu materials, %zu %zu warnings", what,
               a->triangle_count, b->triangle_count, a->material_count, b->material_count,
               a->warning_count, b->warning_count)) {
        return;
    }
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        const burnish_stream *x = &a->streams[i], *y = &b->streams[i];
        const size_t size = burnish_attribute_size((burnish_attribute)i);
        CHECK(x->count == y->count && same_bytes(x->items, y->items, x->count * size),
              "%s: stream %d", what, i);
        CHECK(same_bytes(x->corners, y->corners, corners), "%s: corners of stream %d", what, i);
    }
    CHECK(same_bytes(a->triangle_materials, b->triangle_materials,
                     a->triangle_count * sizeof(uint16_t)),
          "%s", what);
    CHECK(a->part_count == b->part_count && same_bytes(a->triangle_parts, b->triangle_parts,
                                                       a->triangle_count * sizeof(uint16_t)),
          "%s: %zu %zu parts", what, a->part_count, b->part_count);
    for (size_t i = 0; i < a->part_count && i < b->part_count; ++i) {
        const burnish_part *x = &a->parts[i], *y = &b->parts[i];
        if (!CHECK(strcmp(x->name, y->name) == 0 && x->id == y->id &&
                       x->triangle_count == y->triangle_count,
                   "%s: part %zu", what, i)) {
            break;
        }
    }
    CHECK(same_bytes(a->materials, b->materials, a->material_count * sizeof *a->materials), "%s",
          what);
    for (size_t i = 0; i < a->warning_count; ++i) {
        CHECK(strcmp(a->warnings[i], b->warnings[i]) == 0, "%s: \"%s\" \"%s\"", what,
              a->warnings[i], b->warnings[i]);
    }
}

/* The outcome must be a mesh that fulfils mesh.h, or a one-line error. */
static inline int is_sound(burnish_status status, const burnish_mesh_data *s,
                           const burnish_error *e) {
    if (status != BURNISH_STATUS_OK) {
        return e->status == status && e->text[0] != 0 && !strchr(e->text, '\n');
    }
    for (size_t i = 0; i < 3 * s->triangle_count; ++i) {
        if (s->streams[BURNISH_POSITION].corners[i] >= s->streams[BURNISH_POSITION].count ||
            (s->streams[BURNISH_NORMAL].corners &&
             s->streams[BURNISH_NORMAL].corners[i] != BURNISH_NONE &&
             s->streams[BURNISH_NORMAL].corners[i] >= s->streams[BURNISH_NORMAL].count)) {
            return 0;
        }
    }
    for (size_t i = 0; i < 3 * s->streams[BURNISH_POSITION].count; ++i) {
        if (!(burnish_positions(s)[i] - burnish_positions(s)[i] == 0)) {
            return 0;
        }
    }
    for (size_t i = 0; s->triangle_materials && i < s->triangle_count; ++i) {
        if (s->triangle_materials[i] >= s->material_count) {
            return 0;
        }
    }
    for (size_t i = 0; s->triangle_parts && i < s->triangle_count; ++i) {
        if (s->triangle_parts[i] >= s->part_count) {
            return 0;
        }
    }
    return s->point_count > 0 ? s->triangle_count == 0 && s->point_radius > 0 &&
                                    s->point_count == s->streams[BURNISH_POSITION].count &&
                                    s->point_count == s->streams[BURNISH_NORMAL].count
                              : s->triangle_count > 0;
}

/* Reads again in another way, which must give the same mesh or error. */
static inline void check_same_reading(const char *what, const reader_run *run,
                                      burnish_status status, const burnish_mesh_data *mesh,
                                      const burnish_error *error) {
    burnish_mesh_data other;
    burnish_error other_error;
    const burnish_status other_status = read_as(run, &other, &other_error);
    CHECK(status == other_status && strcmp(error->text, other_error.text) == 0,
          "%s, %d threads, chunks of %zu: %d \"%s\", not %d \"%s\"", what,
          burnish_tasks_threads(run->tasks), run->chunk_size, (int)other_status, other_error.text,
          (int)status, error->text);
    if (status == BURNISH_STATUS_OK && other_status == status) {
        compare_meshes(what, mesh, &other);
    }
    burnish_mesh_data_destroy(&other);
}

/* The outcome of the latest reading, which the next one releases. */
static burnish_mesh_data got;
static burnish_error fault;

static inline burnish_status read_run(const reader_run *run) {
    burnish_mesh_data_destroy(&got);
    return read_as(run, &got, &fault);
}

/* Text in chunks of 64 bytes, whose ends are everywhere, must make no difference. */
static inline burnish_status run_reader(burnish_format format, const void *bytes, size_t size,
                                        const burnish_load_options *options,
                                        load_function *load_companion) {
    reader_run run = {format, bytes, size, options, load_companion, NULL, 0};
    const burnish_status status = read_run(&run);
    const int is_text = format != BURNISH_FORMAT_GLTF && format != BURNISH_FORMAT_3MF &&
                        format != BURNISH_FORMAT_BMS;
    if (is_text && !options->context) { /* a context may count, or fail */
        run.chunk_size = 64;
        check_same_reading("input of a test", &run, status, &got, &fault);
    }
    return status;
}

static inline burnish_status read_bytes(burnish_format format, const void *bytes, size_t size) {
    const burnish_load_options options = burnish_load_options_default();
    return run_reader(format, bytes, size, &options, NULL);
}

static inline burnish_status read_text(burnish_format format, const char *text) {
    return read_bytes(format, text, strlen(text));
}

/* A reading that must fail, with the message. */
static inline void check_fault(burnish_status status, burnish_status expected,
                               const char *message) {
    CHECK(status == expected, "status %d: %s", (int)status, message);
    CHECK_TEXT(fault.text, message);
}

/* Text that must be read. */
static inline void read_good_text(burnish_format format, const char *text) {
    CHECK_OK(read_text(format, text), fault);
}

/* Exactly these warnings, `count` texts. */
static inline void check_warnings(size_t count, ...) {
    va_list texts;
    va_start(texts, count);
    CHECK(got.warning_count == count, "%zu warnings", got.warning_count);
    for (size_t i = 0; i < count && i < got.warning_count; ++i) {
        CHECK_TEXT(got.warnings[i], va_arg(texts, const char *));
    }
    va_end(texts);
}

/* warning: receives the first one, 300 bytes; NULL: not wanted. */
static inline burnish_status read_mtl(const char *text, burnish_mtl *library, char *warning,
                                      burnish_error *error) {
    const burnish_reader_input input = {
        .bytes = (const uint8_t *)text, .size = strlen(text), .name = "a.mtl"};
    burnish_mesh_data mesh = burnish_mesh_data_begin(NULL, NULL, error);
    burnish_reader reader = {.input = &input, .mesh = &mesh, .error = error};
    burnish_status status = burnish_read_mtl(&reader, library);
    if (warning) {
        snprintf(warning, 300, "%s", mesh.warning_count > 0 ? mesh.warnings[0] : "");
    }
    burnish_mesh_data_destroy(&mesh);
    return status;
}

/* Whether position i is x, y, z, and the corners of triangle i are positions a, b, c. */
static inline int position_is(size_t i, float x, float y, float z) {
    return i < got.streams[BURNISH_POSITION].count && burnish_positions(&got)[3 * i] == x &&
           burnish_positions(&got)[3 * i + 1] == y && burnish_positions(&got)[3 * i + 2] == z;
}

static inline int triangle_is(size_t i, uint32_t a, uint32_t b, uint32_t c) {
    return i < got.triangle_count && got.streams[BURNISH_POSITION].corners[3 * i] == a &&
           got.streams[BURNISH_POSITION].corners[3 * i + 1] == b &&
           got.streams[BURNISH_POSITION].corners[3 * i + 2] == c;
}

/* Whether corner k of triangle i is at x, y, z, to 1e-5. */
static inline int corner_is(size_t i, size_t k, double x, double y, double z) {
    const double expected[3] = {x, y, z};
    for (size_t axis = 0; axis < 3 && i < got.triangle_count; ++axis) {
        const uint32_t corner = got.streams[BURNISH_POSITION].corners[3 * i + k];
        const double value = (double)burnish_positions(&got)[3 * (size_t)corner + axis];
        if (!(value - expected[axis] < 1e-5 && expected[axis] - value < 1e-5)) {
            return 0;
        }
    }
    return i < got.triangle_count;
}

/* text: the only warning; NULL: there is none */
static inline void check_warning(const char *text) {
    CHECK(got.warning_count == (text != NULL), "%zu warnings: %s", got.warning_count,
          got.warning_count > 0 ? got.warnings[0] : "");
    if (text && got.warning_count == 1) {
        CHECK_TEXT(got.warnings[0], text);
    }
}

/* Whether a linear colour equals sRGB values. */
static inline int color_is(const float color[3], float r, float g, float b) {
    return color[0] == burnish_srgb_value_to_linear(r) &&
           color[1] == burnish_srgb_value_to_linear(g) &&
           color[2] == burnish_srgb_value_to_linear(b);
}

/* The signed area of a triangle in x and y. */
static inline double triangle_area(const float *p, const float *q, const float *r) {
    return 0.5 * (((double)q[0] - p[0]) * ((double)r[1] - p[1]) -
                  ((double)q[1] - p[1]) * ((double)r[0] - p[0]));
}

/* Bytes under construction. */
typedef struct byte_list {
    uint8_t bytes[8192];
    size_t size;
} byte_list;

static inline void put(byte_list *list, const void *bytes, size_t size) {
    if (size > sizeof list->bytes - list->size) {
        abort();
    }
    memcpy(list->bytes + list->size, bytes, size);
    list->size += size;
}
static inline void put_text(byte_list *list, const char *text) {
    put(list, text, strlen(text));
}

/* The low `size` bytes of bits in either order. */
static inline void put_bits(byte_list *list, uint64_t bits, size_t size, int big_endian) {
    for (size_t i = 0; i < size; ++i) {
        uint8_t byte = (uint8_t)(bits >> 8 * (big_endian ? size - 1 - i : i));
        put(list, &byte, 1);
    }
}
static inline void put_float(byte_list *list, float value, int big_endian) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_bits(list, bits, 4, big_endian);
}

/* A binary STL of `count` facets; facet i has corners (i,0,0) (i+1,0,0) (i,1,0.5). */
static inline void put_stl(byte_list *list, const char *header, uint32_t count) {
    uint8_t head[80] = {0};
    memcpy(head, header, strlen(header));
    put(list, head, sizeof head);
    put_bits(list, count, 4, 0);
    for (uint32_t i = 0; i < count; ++i) {
        const float values[12] = {0, 0, 1, (float)i, 0, 0, (float)i + 1, 0, 0, (float)i, 1, 0.5f};
        for (int k = 0; k < 12; ++k) {
            put_float(list, values[k], 0);
        }
        put_bits(list, 0x3EEF, 2, 0); /* no colour: bit 15 is not set */
    }
}

/* A value of a PLY row in one of the three encodings: 0 ASCII, 1 little, 2 big endian. type: c
 * uchar, s short, i int, f float, d double, n the end of the row. */
static inline void put_ply_value(byte_list *list, int encoding, char type, double value) {
    uint64_t bits = (uint64_t)(int64_t)value;
    if (type == 'd') {
        memcpy(&bits, &value, sizeof bits);
    }
    if (encoding == 0) {
        char word[32];
        snprintf(word, sizeof word, "%g ", value);
        put_text(list, type == 'n' ? "\n" : word);
    } else if (type == 'f') {
        put_float(list, (float)value, encoding == 2);
    } else if (type != 'n') {
        put_bits(list, bits,
                 type == 'c'   ? 1
                 : type == 's' ? 2
                 : type == 'i' ? 4
                               : 8,
                 encoding == 2);
    }
}

static const char *const ply_encodings[] = {"ascii", "binary_little_endian", "binary_big_endian"};

/* A square and a triangle with normals and colours. Unknown properties and elements are in
 * between. */
static inline void put_ply(byte_list *list, int encoding) {
    static const float xyz[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5f, 2, -1.25f}};
    static const int faces[2][5] = {{4, 0, 1, 2, 3}, {3, 3, 2, 4}};
    put_text(list, "ply\nformat ");
    put_text(list, ply_encodings[encoding]);
    put_text(list, " 1.0\ncomment made by hand\nobj_info none\nelement camera 1\n"
                   "property double view\nproperty list uchar short tags\nelement vertex 5\n"
                   "property float x\nproperty float y\nproperty float z\nproperty short quality\n"
                   "property float nx\nproperty float ny\nproperty float nz\n"
                   "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                   "property uchar alpha\nelement nothing 4000000000\nelement face 2\n"
                   "property uchar flags\nproperty list uchar int vertex_indices\nend_header\n");
    for (int k = 0; k < 5; ++k) {
        put_ply_value(
            list, encoding, "dcssn" [k], (const double[]) { 0.5, 2, -7, 9, 0 }[k]);
    }
    for (int i = 0; i < 5; ++i) {
        const double row[12] = {xyz[i][0], xyz[i][1], xyz[i][2], -3,     0,       0,
                                1,         10 * i,    20 * i,    30 * i, 255 - i, 0};
        for (int k = 0; k < 12; ++k) {
            put_ply_value(list, encoding, "fffsfffccccn"[k], row[k]);
        }
    }
    for (int f = 0; f < 2; ++f) {
        put_ply_value(list, encoding, 'c', 7);
        for (int k = 0; k <= faces[f][0]; ++k) {
            put_ply_value(list, encoding, k == 0 ? 'c' : 'i', faces[f][k]);
        }
        put_ply_value(list, encoding, 'n', 0);
    }
}

#endif
