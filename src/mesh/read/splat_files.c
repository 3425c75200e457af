/* Files of Gaussian splats: .splat (K. Kwok's viewer) and .spz (Niantic,
 * github.com/nianticlabs/spz: versions 2 and 3, whose gzip is unpacked before, and version 4, arrays
 * packed by zstd). Of spherical harmonics only the constant one is read. */
#include "base/bytes.h"
#include "mesh/read/common/points.h"
#include "mesh/read/common/splats.h"

#if BURNISH_HAS_ZSTD
#include <zstd.h>
enum { SPZ_NEWEST = 4 };
#else
enum { SPZ_NEWEST = 3 };
#endif

enum { GRAIN = 1 << 12 };

/* ---- .splat: position, scale, 4 bytes sRGB and opacity, 4 bytes of a quaternion ---- */

enum { ROW = 32, COLOR_AT = 24, ROTATION_AT = 28 };

static void splat_convert(void *user_data, size_t first, size_t end) {
    const burnish_reader *reader = user_data;
    float *position = burnish_positions(reader->mesh) + 3 * first;
    burnish_splat *splats = reader->mesh->streams[BURNISH_SPLAT].items;
    const uint8_t *row = reader->input->bytes + ROW * first;
    for (size_t i = first; i < end; ++i, row += ROW, position += 3) {
        burnish_splat_values splat = {.opacity = (float)row[COLOR_AT + 3] / 255.0F};
        for (size_t k = 0; k < 3; ++k) {
            position[k] =
                (float)((double)burnish_load_float(row + 4 * k) - reader->mesh->origin[k]);
            splat.scale[k] = burnish_load_float(row + 12 + 4 * k);
            splat.color[k] = (float)row[COLOR_AT + k] / 255.0F;
        }
        for (int k = 0; k < 4; ++k) {
            splat.rotation[k] = (float)row[ROTATION_AT + k] - 128.0F;
        }
        splats[i] = burnish_splat_of(&splat);
    }
}

static burnish_status splat_read(burnish_reader *reader) {
    const size_t count = reader->input->size / ROW;
    reader->is_binary = 1;
    if (count == 0) {
        return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, NULL,
                                   "%zu bytes are less than the 32 of a splat; export it again",
                                   reader->input->size);
    }
    const burnish_status status = burnish_reserve_splats(reader, count);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_tasks_ranges(reader->mesh->tasks, count, GRAIN, splat_convert, reader);
    if (reader->input->size % ROW != 0) {
        burnish_reader_warn(reader, NULL,
                            "the last %zu bytes are not a whole splat of 32; the file is truncated",
                            reader->input->size % ROW);
    }
    reader->mesh->up_axis[1] = -1; /* as in training */
    return burnish_make_splats(reader, 0);
}

/* There is no mark: the first row has usual numbers, and a quaternion of length 1. */
static int splat_recognise(const uint8_t *bytes, size_t size) {
    int square = 0, is_text = 1, good = size >= ROW;
    for (size_t k = 0; k < ROW && good; ++k) {
        is_text &= bytes[k] >= '\t' && bytes[k] < 0x7F;
    }
    good &= !is_text;
    for (size_t k = 0; k < 6 && good; ++k) {
        const float value = burnish_load_float(bytes + 4 * k);
        good = value >= (k < 3 ? -1e6F : 0) && value <= 1e6F;
    }
    for (int k = 0; k < 4 && good; ++k) {
        square += (bytes[ROTATION_AT + k] - 128) * (bytes[ROTATION_AT + k] - 128);
    }
    return square > 110 * 110 && square < 140 * 140;
}

const burnish_format_reader burnish_reader_splat = {.recognise = splat_recognise,
                                                    .read = splat_read};

/* ---- .spz: one array after another ---- */

enum { SPZ_HEAD = 16, SPZ_MARK = 0x5053474E, FRACTION_MOST = 23 };

typedef struct spz_arrays {
    burnish_reader *reader;
    const uint8_t *positions, *opacities, *colors, *scales, *rotations;
    double unit;     /* of coordinates, in 24 bits */
    int is_smallest; /* version 3: three smallest numbers of a quaternion in 32 bits */
} spz_arrays;

/* x, y and z in 8 bits each; w is not negative. */
static void unpack_first(const uint8_t *bytes, float q[4]) {
    double rest = 1;
    for (int k = 0; k < 3; ++k) {
        const double value = bytes[k] / 127.5 - 1;
        q[k + 1] = (float)value;
        rest -= value * value;
    }
    q[0] = (float)burnish_sqrt(rest > 0 ? rest : 0);
}

/* From the last to the first of x, y, z and w but for the largest: 9 bits up to sqrt(1/2), and a
 * sign. The number of the largest is above them. */
static void unpack_smallest(const uint8_t *bytes, float q[4]) {
    enum { BITS = 10, SIGN = 1 << 9 };
    uint32_t bits = burnish_load32(bytes);
    const unsigned largest = bits >> 30;
    double rest = 1;
    for (unsigned k = 4; k-- > 0;) {
        if (k != largest) {
            const double size = 0.70710678118654752 * (bits & (SIGN - 1)) / (SIGN - 1);
            q[(k + 1) % 4] = (float)(bits & SIGN ? -size : size);
            rest -= size * size;
            bits >>= BITS;
        }
    }
    q[(largest + 1) % 4] = (float)burnish_sqrt(rest > 0 ? rest : 0);
}

static void spz_convert(void *user_data, size_t first, size_t end) {
    const spz_arrays *s = user_data;
    const burnish_mesh_data *mesh = s->reader->mesh;
    float *positions = burnish_positions(mesh);
    burnish_splat *splats = mesh->streams[BURNISH_SPLAT].items;
    for (size_t i = first; i < end; ++i) {
        burnish_splat_values splat = {.opacity = (float)s->opacities[i] / 255.0F};
        for (size_t k = 0; k < 3; ++k) {
            const size_t at = 3 * i + k;
            const uint8_t *p = s->positions + 3 * at;
            const int32_t high = p[2] < 128 ? p[2] : p[2] - 256;
            const double value = (high * 65536 + (p[1] << 8 | p[0])) * s->unit;
            positions[at] = (float)(value - mesh->origin[k]);
            splat.scale[k] = (float)burnish_splat_exp(s->scales[at] / 16.0 - 10);
            splat.color[k] = burnish_splat_color((s->colors[at] / 255.0 - 0.5) / 0.15);
        }
        (s->is_smallest ? unpack_smallest : unpack_first)(
            s->rotations + (s->is_smallest ? 4 : 3) * i, splat.rotation);
        splats[i] = burnish_splat_of(&splat);
    }
}

static int spz_recognise(const uint8_t *bytes, size_t size) {
    return size >= 4 && burnish_load32(bytes) == SPZ_MARK ? 2 : 0;
}

/* Where the arrays are in the bytes that begin with the positions. */
static void place_arrays(spz_arrays *s, const uint8_t *bytes, size_t count) {
    s->positions = bytes;
    s->opacities = s->positions + 9 * count;
    s->colors = s->opacities + count;
    s->scales = s->colors + 3 * count;
    s->rotations = s->scales + 3 * count;
}

static burnish_status convert_arrays(spz_arrays *s, const uint8_t *bytes, size_t count) {
    const burnish_status status = burnish_reserve_splats(s->reader, count);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    place_arrays(s, bytes, count);
    burnish_tasks_ranges(s->reader->mesh->tasks, count, GRAIN, spz_convert, s);
    return burnish_make_splats(s->reader, 0);
}

#if BURNISH_HAS_ZSTD
enum { STREAMS = 5, STREAM_ENTRY = 16 }; /* the harmonics are the sixth */

/* Unpacks the arrays, of `each` bytes a splat, one after the other. */
static burnish_status unpack_streams(burnish_reader *reader, size_t count, uint8_t *to) {
    static const uint8_t each[STREAMS] = {9, 1, 3, 3, 4};
    const uint8_t *bytes = reader->input->bytes, *end = bytes + reader->input->size;
    const uint64_t table = burnish_load32(bytes + SPZ_HEAD), streams = bytes[15];
    if (streams < STREAMS || table + streams * STREAM_ENTRY > reader->input->size) {
        return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, bytes + 15,
                                   "the table of %d arrays is not in the file; it is damaged",
                                   bytes[15]);
    }
    const uint8_t *entry = bytes + table, *from = entry + streams * STREAM_ENTRY;
    for (int i = 0; i < STREAMS; ++i, entry += STREAM_ENTRY) {
        const uint64_t packed = burnish_load64(entry);
        const size_t size = each[i] * count;
        if (packed > (size_t)(end - from) || burnish_load64(entry + 8) != size ||
            ZSTD_decompress(to, size, from, (size_t)packed) != size) {
            return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, entry,
                                       "array %d of the splats can't be unpacked; the file is "
                                       "truncated or damaged",
                                       i);
        }
        from += packed;
        to += size;
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_packed(spz_arrays *s, size_t count) {
    burnish_memory *memory = &s->reader->mesh->memory;
    burnish_status status = burnish_check_points(s->reader, count, 0);
    uint8_t *unpacked =
        status == BURNISH_STATUS_OK ? burnish_allocate(memory, count, 20, "splats") : NULL;
    if (unpacked) {
        status = unpack_streams(s->reader, count, unpacked);
    }
    if (unpacked && status == BURNISH_STATUS_OK) {
        status = convert_arrays(s, unpacked, count);
    }
    burnish_release(memory->context, unpacked);
    return status == BURNISH_STATUS_OK ? memory->status : status;
}
#endif

static burnish_status spz_read(burnish_reader *reader) {
    const uint8_t *bytes = reader->input->bytes;
    spz_arrays s = {.reader = reader};
    reader->is_binary = 1;
    if (reader->input->size < 2 * SPZ_HEAD || !spz_recognise(bytes, reader->input->size)) {
        return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, bytes,
                                   "no header of splats (NGSP); the file is damaged");
    }
    const uint32_t version = burnish_load32(bytes + 4);
    const size_t count = burnish_load32(bytes + 8), each = version == 3 ? 20 : 19;
    if (version < 2 || version > SPZ_NEWEST || bytes[13] > FRACTION_MOST) {
        return burnish_reader_fail(
            reader, BURNISH_STATUS_FORMAT, bytes + 4,
            "SPZ of version %u with %d fractional bits is not read%s; export "
            "version 2 or 3",
            version, bytes[13], version == 4 ? " without zstd, which this build lacks" : "");
    }
    s.unit = 1.0 / (1 << bytes[13]);
    s.is_smallest = version >= 3;
    if (count == 0 || (version < 4 && count > (reader->input->size - SPZ_HEAD) / each)) {
        return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, bytes + 8,
                                   "%zu splats are announced, but the file has room for %zu; it is "
                                   "empty, truncated or damaged",
                                   count, (reader->input->size - SPZ_HEAD) / each);
    }
#if BURNISH_HAS_ZSTD
    if (version == 4) {
        return read_packed(&s, count);
    }
#endif
    return convert_arrays(&s, bytes + SPZ_HEAD, count);
}

const burnish_format_reader burnish_reader_spz = {.recognise = spz_recognise, .read = spz_read};
