/* PLY files of Gaussian splats as PlayCanvas' SuperSplat packs them: an element `chunk` has the
 * bounds of 256 splats, and an element `vertex` four words of each, fractions between the bounds
 * (github.com/playcanvas/splat-transform). Harmonics above the constant one are not read. */
#include "mesh/read/ply/ply_packed.h"

#include "mesh/read/common/splats.h"
#include "mesh/read/io/streaming.h"
#include "mesh/read/ply/ply_binary.h"

enum { PER_CHUNK = 256, BOUNDS = 18, NEEDED_BOUNDS = 12, WORDS = 4, GRAIN = 1 << 12 };
enum { POSITION, ROTATION, SCALE, COLOR }; /* words */

static const char *const bound_names[BOUNDS] = {
    "min_x",       "min_y",       "min_z",       "max_x",       "max_y",       "max_z",
    "min_scale_x", "min_scale_y", "min_scale_z", "max_scale_x", "max_scale_y", "max_scale_z",
    "min_r",       "min_g",       "min_b",       "max_r",       "max_g",       "max_b"};
static const char *const word_names[WORDS] = {"packed_position", "packed_rotation", "packed_scale",
                                              "packed_color"};

/* Rows of an element, and where in a row its named properties are. */
typedef struct packed_rows {
    const uint8_t *bytes;
    size_t count, size, offsets[BOUNDS];
    int found;
} packed_rows;

typedef struct packed_splats {
    burnish_reader *reader;
    packed_rows chunks, splats;
    int is_big; /* endian */
} packed_splats;

static packed_rows find_rows(const burnish_ply_header *header, const burnish_ply_element *element,
                             const char *const *names, int count, burnish_ply_type type) {
    packed_rows rows = {.count = (size_t)element->count};
    for (size_t i = 0; i < element->property_count; ++i) {
        const burnish_ply_property *property = &header->properties[element->first_property + i];
        if (property->count_type != BURNISH_PLY_NONE) {
            return (packed_rows){0};
        }
        if (rows.found < count && property->type == type &&
            burnish_token_is(property->name, names[rows.found])) {
            rows.offsets[rows.found++] = rows.size;
        }
        rows.size += burnish_ply_type_size(property->type);
    }
    return rows;
}

int burnish_ply_is_packed(const burnish_ply_header *header) {
    return header->element_count >= 2 && header->encoding != BURNISH_PLY_ASCII &&
           burnish_token_is(header->elements[0].name, "chunk") &&
           find_rows(header, &header->elements[0], bound_names, BOUNDS, BURNISH_PLY_FLOAT32)
                   .found >= NEEDED_BOUNDS &&
           header->elements[1].kind == BURNISH_PLY_ELEMENT_VERTEX &&
           find_rows(header, &header->elements[1], word_names, WORDS, BURNISH_PLY_UINT32).found ==
               WORDS;
}

/* The fraction that `count` bits of a word from `first` on stand for. */
static double fraction(uint32_t word, int first, int count) {
    const uint32_t most = (1u << count) - 1;
    return (word >> first & most) / (double)most;
}

/* Fractions of x in 11 bits, y in 10 and z in 11. */
static void unpack_vector(uint32_t word, double to[3]) {
    to[0] = fraction(word, 21, 11);
    to[1] = fraction(word, 11, 10);
    to[2] = fraction(word, 0, 11);
}

/* w, x, y and z without the largest, whose number is in the highest bits; each in 10 bits. */
static void unpack_rotation(uint32_t word, float q[4]) {
    const unsigned largest = word >> 30;
    double rest = 1;
    for (unsigned k = 0, first = 20; k < 4; ++k) {
        if (k != largest) {
            const double value = (fraction(word, (int)first, 10) - 0.5) * 1.4142135623730951;
            q[k] = (float)value;
            rest -= value * value;
            first -= 10;
        }
    }
    q[largest] = (float)burnish_sqrt(rest > 0 ? rest : 0);
}

/* Between the bounds `first` and `first` + 3 of a splat's chunk. */
static double between(const packed_splats *p, const uint8_t *chunk, int first, double x) {
    const size_t *offsets = p->chunks.offsets;
    const double least = burnish_ply_load(chunk + offsets[first], BURNISH_PLY_FLOAT32, p->is_big);
    const double most =
        burnish_ply_load(chunk + offsets[first + 3], BURNISH_PLY_FLOAT32, p->is_big);
    return least * (1 - x) + most * x;
}

static void convert(void *user_data, size_t first, size_t end) {
    const packed_splats *p = user_data;
    const burnish_mesh_data *mesh = p->reader->mesh;
    burnish_splat *splats = mesh->streams[BURNISH_SPLAT].items;
    for (size_t i = first; i < end; ++i) {
        const uint8_t *chunk = p->chunks.bytes + i / PER_CHUNK * p->chunks.size;
        uint32_t words[WORDS];
        for (int k = 0; k < WORDS; ++k) {
            words[k] = (uint32_t)burnish_ply_load(p->splats.bytes + i * p->splats.size +
                                                      p->splats.offsets[k],
                                                  BURNISH_PLY_UINT32, p->is_big);
        }
        burnish_splat_values values = {.opacity = (float)fraction(words[COLOR], 0, 8)};
        double position[3], scale[3];
        unpack_vector(words[POSITION], position);
        unpack_vector(words[SCALE], scale);
        unpack_rotation(words[ROTATION], values.rotation);
        for (int k = 0; k < 3; ++k) {
            const double color = fraction(words[COLOR], 24 - 8 * k, 8);
            burnish_positions(mesh)[3 * i + (size_t)k] =
                (float)(between(p, chunk, k, position[k]) - mesh->origin[k]);
            values.scale[k] = (float)burnish_splat_exp(between(p, chunk, 6 + k, scale[k]));
            values.color[k] =
                (float)(p->chunks.found == BOUNDS ? between(p, chunk, 12 + k, color) : color);
        }
        splats[i] = burnish_splat_of(&values);
    }
}

burnish_status burnish_ply_read_packed(burnish_reader *reader, const burnish_ply_header *header) {
    packed_splats p = {.reader = reader, .is_big = header->encoding == BURNISH_PLY_BIG_ENDIAN};
    if (reader->input->streamed) {
        return burnish_stop_streaming(reader);
    }
    p.chunks = find_rows(header, &header->elements[0], bound_names, BOUNDS, BURNISH_PLY_FLOAT32);
    p.splats = find_rows(header, &header->elements[1], word_names, WORDS, BURNISH_PLY_UINT32);
    reader->is_binary = 1;
    size_t left = (size_t)(reader->input->bytes + reader->input->size - header->body);
    const size_t room = p.chunks.count <= left / p.chunks.size
                            ? (left - p.chunks.count * p.chunks.size) / p.splats.size
                            : 0;
    if (p.splats.count == 0 || p.splats.count > room ||
        (p.splats.count - 1) / PER_CHUNK >= p.chunks.count) {
        return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, NULL,
                                   "%zu packed splats are announced, but the file has room for "
                                   "%zu, and its %zu chunks for "
                                   "256 each; it is empty, truncated or damaged",
                                   p.splats.count, room, p.chunks.count);
    }
    p.chunks.bytes = header->body;
    p.splats.bytes = header->body + p.chunks.count * p.chunks.size;
    const burnish_status status = burnish_reserve_splats(reader, p.splats.count);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_tasks_ranges(reader->mesh->tasks, p.splats.count, GRAIN, convert, &p);
    reader->mesh->up_axis[1] = -1; /* as in training */
    return burnish_make_splats(reader, 0);
}
