/* Decoding of KHR_meshopt_compression and EXT_meshopt_compression, which is version 0: bytes of
 * attributes are packed differences, triangles refer to the latest edges and vertices, and other
 * indices are differences.
 *
 * libmeshoptimizer is not used: it needs the C++ run-time library, with which the program starts in
 * 1.9 ms instead of 1.3 ms, and it calls libm, on which no pixel may depend. */
#include "mesh/read/gltf/meshopt.h"

#include <string.h>

#include "base/bytes.h"
#include "base/elementary.h"
#include "core/vec3.h"

enum {
    HEADER_ATTRIBUTES = 0xA0, /* and the version, 0 or 1 */
    HEADER_TRIANGLES = 0xE0,  /* the same */
    HEADER_INDICES = 0xD0,
    STRIDE_MAX = 256,
    BLOCK_BYTES = 8192,
    BLOCK_MAX = 256,
    GROUP = 16,
    TAIL_MIN = 32,   /* of attributes */
    TAIL_MIN_1 = 24, /* in version 1 */
    TABLE = 16,      /* behind the data of triangles */
    INDICES_TAIL = 4
};

const char *burnish_meshopt_check(burnish_meshopt_mode mode, burnish_meshopt_filter filter,
                                  size_t count, size_t stride) {
    if (mode == BURNISH_MESHOPT_ATTRIBUTES && (stride == 0 || stride > STRIDE_MAX || stride % 4)) {
        return "byteStride of ATTRIBUTES must be a multiple of 4 up to 256";
    }
    if (mode != BURNISH_MESHOPT_ATTRIBUTES && stride != 2 && stride != 4) {
        return "byteStride of indices must be 2 or 4";
    }
    if (mode != BURNISH_MESHOPT_ATTRIBUTES && filter != BURNISH_MESHOPT_NONE) {
        return "only ATTRIBUTES can have a filter";
    }
    if (mode == BURNISH_MESHOPT_TRIANGLES && count % 3 != 0) {
        return "count of TRIANGLES must be a multiple of 3";
    }
    if (((filter == BURNISH_MESHOPT_OCTAHEDRAL || filter == BURNISH_MESHOPT_COLOR) && stride != 4 &&
         stride != 8) ||
        (filter == BURNISH_MESHOPT_QUATERNION && stride != 8)) {
        return "byteStride of OCTAHEDRAL and COLOR must be 4 or 8, of QUATERNION 8";
    }
    return NULL;
}

/* ---- Attributes ---- */

/* Reads 16 differences of one byte; returns the next byte, NULL beyond the end. */
static const uint8_t *read_group(const uint8_t *p, const uint8_t *end, unsigned bits,
                                 uint8_t out[GROUP]) {
    const size_t packed = (size_t)bits * GROUP / 8;
    if ((size_t)(end - p) < packed) {
        return NULL;
    }
    if (bits == 0 || bits == 8) {
        bits == 0 ? (void)memset(out, 0, GROUP) : (void)memcpy(out, p, GROUP);
        return p + packed;
    }
    const unsigned most = (1u << bits) - 1; /* means a byte after the packed ones */
    const uint8_t *more = p + packed;
    for (unsigned i = 0; i < GROUP; ++i) {
        const unsigned at = i * bits, shift = bits == 1 ? i % 8 : 8 - bits - at % 8;
        const unsigned value = (unsigned)p[at / 8] >> shift & most;
        if (value == most && more == end) {
            return NULL;
        }
        out[i] = value == most ? *more++ : (uint8_t)value;
    }
    return more;
}

/* How the bytes at one place of a block's elements are packed. */
enum { CONTROL_SMALL, CONTROL_LARGE, CONTROL_ZERO, CONTROL_PLAIN, CONTROL_VERSION_0 };

/* One byte of each of a block's elements. */
typedef struct byte_column {
    uint8_t *out;
    size_t count, stride;
    uint8_t value; /* of the element before */
    int has_sums;  /* 1: the bytes are sums of differences; 0: the differences themselves */
} byte_column;

/* `count` differences, from element `first` on. */
static void put_differences(const uint8_t *differences, size_t first, size_t count,
                            byte_column *to) {
    for (size_t i = 0; i < count; ++i) {
        const unsigned d = differences[i];
        to->value = to->has_sums ? (uint8_t)(to->value + ((d >> 1) ^ (0u - (d & 1)))) : (uint8_t)d;
        to->out[(first + i) * to->stride] = to->value;
    }
}

/* Returns the next byte; NULL if there are too few. */
static const uint8_t *read_column(const uint8_t *p, const uint8_t *end, unsigned control,
                                  byte_column *to) {
    static const uint8_t all_bits[][4] = {[CONTROL_SMALL] = {0, 1, 2, 4},
                                          [CONTROL_LARGE] = {1, 2, 4, 8},
                                          [CONTROL_VERSION_0] = {0, 2, 4, 8}};
    if (control == CONTROL_ZERO) {
        for (size_t i = 0; i < to->count; ++i) {
            to->out[i * to->stride] = to->has_sums ? to->value : 0;
        }
        return p;
    }
    if (control == CONTROL_PLAIN) {
        if ((size_t)(end - p) < to->count) {
            return NULL;
        }
        put_differences(p, 0, to->count, to);
        return p + to->count;
    }
    const size_t groups = (to->count + GROUP - 1) / GROUP, header = (groups + 3) / 4;
    const uint8_t *kinds = p, *bits = all_bits[control];
    if ((size_t)(end - p) < header) {
        return NULL;
    }
    p += header;
    for (size_t group = 0; group < groups && p; ++group) {
        uint8_t deltas[GROUP];
        p = read_group(p, end, bits[kinds[group / 4] >> (group % 4 * 2) & 3], deltas);
        const size_t left = to->count - group * GROUP;
        if (p) {
            put_differences(deltas, group * GROUP, left < GROUP ? left : GROUP, to);
        }
    }
    return p;
}

/* The unit of the differences of four bytes: each byte, two 16-bit numbers, or one 32-bit number
 * that is combined by XOR and rotated. */
enum { CHANNEL_BYTES, CHANNEL_PAIRS, CHANNEL_XOR };

static uint32_t get_bytes(const uint8_t *p, size_t size) {
    uint32_t value = 0;
    for (size_t k = 0; k < size; ++k) {
        value |= (uint32_t)p[k] << 8 * k;
    }
    return value;
}

/* `size` bytes of each element, from differences to values. */
static void undo_differences(uint8_t *at, size_t count, size_t stride, size_t size, int is_xor,
                             unsigned rotation, const uint8_t *last) {
    uint32_t value = get_bytes(last, size);
    for (size_t i = 0; i < count; ++i, at += stride) {
        const uint32_t d = get_bytes(at, size);
        value = is_xor ? value ^ (d >> rotation | d << ((32 - rotation) & 31))
                       : value + ((d >> 1) ^ (0u - (d & 1)));
        for (size_t k = 0; k < size; ++k) {
            at[k] = (uint8_t)(value >> 8 * k);
        }
    }
}

/* One channel of a block, but for CHANNEL_BYTES; `last` has the four bytes of the element before.
 */
static void undo_channel(uint8_t *at, size_t count, size_t stride, unsigned channel,
                         const uint8_t *last) {
    const size_t size = channel == CHANNEL_PAIRS ? 2 : 4;
    for (size_t k = 0; k < 4; k += size) {
        undo_differences(at + k, count, stride, size, size == 4, channel >> 4, last + k);
    }
}

static int are_channels(const uint8_t *channels, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        if (channels[i] > CHANNEL_PAIRS && (channels[i] & 15) != CHANNEL_XOR) {
            return 0;
        }
    }
    return 1;
}

static int decode_attributes(const uint8_t *bytes, size_t size, size_t count, size_t stride,
                             uint8_t *out) {
    const size_t fitting = BLOCK_BYTES / stride / GROUP * GROUP, quarter = stride / 4;
    const size_t block = fitting < BLOCK_MAX ? fitting : BLOCK_MAX;
    const int version = size > 0 ? bytes[0] & 1 : 0;
    const size_t least = version ? TAIL_MIN_1 : TAIL_MIN, used = stride + (version ? quarter : 0);
    const size_t tail = used < least ? least : used;
    if (size < 1 + tail || (bytes[0] & 0xFE) != HEADER_ATTRIBUTES) {
        return 0;
    }
    const uint8_t *channels = bytes + size - quarter; /* in version 1 */
    if (version && !are_channels(channels, quarter)) {
        return 0;
    }
    const uint8_t *p = bytes + 1, *end = bytes + size - tail;
    const uint8_t *last = bytes + size - used; /* the first element's predecessor */
    for (size_t first = 0; first < count; first += block) {
        const size_t some = count - first < block ? count - first : block;
        const uint8_t *controls = p;
        uint8_t *to = out + first * stride;
        if (version && (size_t)(end - p) < quarter) {
            return 0;
        }
        p += version ? quarter : 0;
        for (size_t k = 0; k < stride; ++k) {
            const unsigned control =
                version ? controls[k / 4] >> k % 4 * 2 & 3u : (unsigned)CONTROL_VERSION_0;
            byte_column column = {to + k, some, stride, last[k],
                                  !version || channels[k / 4] == CHANNEL_BYTES};
            p = read_column(p, end, control, &column);
            if (!p) {
                return 0;
            }
        }
        for (size_t k = 0; k < quarter && version; ++k) {
            if (channels[k] != CHANNEL_BYTES) {
                undo_channel(to + 4 * k, some, stride, channels[k], last + 4 * k);
            }
        }
        last = to + (some - 1) * stride;
    }
    return p == end;
}

/* ---- Indices ---- */

typedef struct reader {
    const uint8_t *p, *end;
    int is_short; /* it has read beyond the end */
} reader;

static uint32_t read_byte(reader *r) {
    r->is_short |= r->p == r->end;
    return r->is_short ? 0 : *r->p++;
}

/* Seven bits a byte, the lowest first. */
static uint32_t read_varint(reader *r) {
    uint32_t value = 0;
    for (int shift = 0; shift < 35; shift += 7) {
        const uint32_t byte = read_byte(r);
        value |= (byte & 127) << shift;
        if (byte < 128) {
            break;
        }
    }
    return value;
}

static uint32_t unzigzag(uint32_t v) {
    return (v >> 1) ^ (0u - (v & 1));
}

static void put_index(uint8_t *out, size_t i, size_t stride, uint32_t index) {
    for (size_t k = 0; k < stride; ++k) {
        out[i * stride + k] = (uint8_t)(index >> 8 * k);
    }
}

static int decode_indices(const uint8_t *bytes, size_t size, size_t count, size_t stride,
                          uint8_t *out) {
    if (size < 1 + INDICES_TAIL || (bytes[0] & 0xFE) != HEADER_INDICES) {
        return 0;
    }
    reader r = {bytes + 1, bytes + size - INDICES_TAIL, 0};
    uint32_t last[2] = {0, 0};
    for (size_t i = 0; i < count && !r.is_short; ++i) {
        const uint32_t value = read_varint(&r);
        last[value & 1] += unzigzag(value >> 1);
        put_index(out, i, stride, last[value & 1]);
    }
    return !r.is_short && r.p == r.end;
}

/* ---- Triangles ---- */

/* The 16 edges and vertices seen last; numbers count back from the latest, 0. */
typedef struct history {
    uint32_t edges[16][2], vertices[16];
    unsigned edge, vertex; /* where the next one goes */
    uint32_t next;         /* the lowest index not seen yet */
    uint32_t last;         /* the last one that was written in full */
    reader data;
} history;

static void push_edge(history *h, uint32_t a, uint32_t b) {
    h->edges[h->edge & 15][0] = a;
    h->edges[h->edge++ & 15][1] = b;
}

static void push_vertex(history *h, uint32_t vertex) {
    h->vertices[h->vertex++ & 15] = vertex;
}

static uint32_t read_index(history *h) {
    h->last += unzigzag(read_varint(&h->data));
    return h->last;
}

/* A triangle next to an earlier edge. */
static void read_beside(history *h, unsigned code, unsigned first_free, uint32_t triangle[3]) {
    const uint32_t *edge = h->edges[(h->edge - 1 - (code >> 4)) & 15];
    const unsigned third = code & 15;
    uint32_t c;
    if (third != 0 && third < first_free) {
        c = h->vertices[(h->vertex - 1 - third) & 15];
    } else {
        c = third == 0    ? h->next++
            : third == 15 ? read_index(h)
                          : (h->last += third == 13 ? UINT32_MAX : 1); /* one before, or after */
        push_vertex(h, c);
    }
    triangle[0] = edge[0], triangle[1] = edge[1], triangle[2] = c;
    push_edge(h, c, triangle[1]);
    push_edge(h, triangle[0], c);
}

/* A triangle without a known edge. For each corner, 0 is a new vertex, 15 is written in full, and
 * others count back. */
static void read_apart(history *h, const unsigned kinds[3], uint32_t triangle[3]) {
    const unsigned vertex = h->vertex;
    for (int k = 0; k < 3; ++k) {
        triangle[k] = kinds[k] == 0 ? h->next++ : h->vertices[(vertex - kinds[k]) & 15];
    }
    for (int k = 0; k < 3; ++k) {
        if (kinds[k] == 15) {
            triangle[k] = read_index(h);
        }
    }
    for (int k = 0; k < 3; ++k) {
        if (kinds[k] == 0 || kinds[k] == 15) {
            push_vertex(h, triangle[k]);
        }
    }
    push_edge(h, triangle[1], triangle[0]);
    push_edge(h, triangle[2], triangle[1]);
    push_edge(h, triangle[0], triangle[2]);
}

static int decode_triangles(const uint8_t *bytes, size_t size, size_t count, size_t stride,
                            uint8_t *out) {
    const size_t triangles = count / 3;
    if (size < 1 + TABLE || triangles > size - 1 - TABLE || (bytes[0] & 0xFE) != HEADER_TRIANGLES) {
        return 0;
    }
    const uint8_t *codes = bytes + 1, *table = bytes + size - TABLE;
    const unsigned first_free = (bytes[0] & 1) ? 13 : 15;
    history h = {.data = {codes + triangles, table, 0}};
    memset(h.edges, -1, sizeof h.edges);
    memset(h.vertices, -1, sizeof h.vertices);
    for (size_t i = 0; i < triangles && !h.data.is_short; ++i) {
        uint32_t triangle[3];
        if (codes[i] < 0xF0) {
            read_beside(&h, codes[i], first_free, triangle);
        } else {
            const int is_free = codes[i] >= 0xFE;
            const uint32_t pair = is_free ? read_byte(&h.data) : table[codes[i] & 15];
            const unsigned kinds[3] = {codes[i] == 0xFF ? 15 : 0, pair >> 4, pair & 15};
            h.next = is_free && pair == 0 ? 0 : h.next; /* indices begin anew */
            /* the table's 15 is a step back like the others; no encoder writes it */
            read_apart(&h, kinds, triangle);
        }
        for (size_t k = 0; k < 3; ++k) {
            put_index(out, 3 * i + k, stride, triangle[k]);
        }
    }
    return !h.data.is_short && h.data.p == h.data.end;
}

int burnish_meshopt_decode(burnish_meshopt_mode mode, const uint8_t *bytes, size_t size,
                           size_t count, size_t stride, uint8_t *out) {
    return mode == BURNISH_MESHOPT_ATTRIBUTES  ? decode_attributes(bytes, size, count, stride, out)
           : mode == BURNISH_MESHOPT_TRIANGLES ? decode_triangles(bytes, size, count, stride, out)
                                               : decode_indices(bytes, size, count, stride, out);
}

/* ---- Filters ---- */

/* A number of `size` bytes, 1 or 2, not normalised. */
static int get_signed(const uint8_t *p, size_t size) {
    return size == 1 ? (int8_t)*p : (int16_t)burnish_load16(p);
}

static void put_rounded(uint8_t *p, size_t size, double value) {
    const int rounded = (int)(value + (value < 0 ? -0.5 : 0.5));
    p[0] = (uint8_t)rounded;
    if (size == 2) {
        p[1] = (uint8_t)((unsigned)rounded >> 8);
    }
}

/* A unit vector from two coordinates on an octahedron; the third number is the scale of these. */
static void undo_octahedral(uint8_t *p, size_t size) {
    const double most = size == 1 ? 127 : 32767;
    double v[3] = {get_signed(p, size), get_signed(p + size, size), get_signed(p + 2 * size, size)};
    v[2] -= burnish_magnitude(v[0]) + burnish_magnitude(v[1]);
    const double fold = v[2] < 0 ? v[2] : 0;
    v[0] += v[0] >= 0 ? fold : -fold;
    v[1] += v[1] >= 0 ? fold : -fold;
    const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const double scale = square > 0 ? most / burnish_sqrt(square) : 0;
    for (size_t k = 0; k < 3; ++k) {
        put_rounded(p + k * size, size, v[k] * scale);
    }
}

/* A rotation from three of its numbers, the largest of four left out. */
static void undo_quaternion(uint8_t *p) {
    const int last = get_signed(p + 6, 2), which = last & 3;
    const double scale = 0.70710678118654752440 / (last | 3);
    double q[4], sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double v = get_signed(p + 2 * k, 2) * scale;
        const double in_range = v < -1 ? -1 : v > 1 ? 1 : v; /* only damaged ones are not */
        sum += in_range * in_range;
        q[(which + 1 + k) & 3] = in_range;
    }
    q[which] = sum < 1 ? burnish_sqrt(1 - sum) : 0;
    for (size_t k = 0; k < 4; ++k) {
        put_rounded(p + 2 * k, 2, q[k] * 32767);
    }
}

/* 24 bits times a power of two, of 8 bits. */
static void undo_exponential(uint8_t *p) {
    const uint32_t bits = burnish_load24(p);
    const double mantissa = bits & 0x800000 ? (double)bits - 0x1000000 : bits;
    const uint64_t power = (uint64_t)(1023 + (int8_t)p[3]) << 52; /* 2^-128 to 2^127 */
    double scale;
    memcpy(&scale, &power, sizeof scale);
    const double exact = mantissa * scale;
    const float value = (float)(exact > 3.4028234663852886e38    ? 3.4028234663852886e38
                                : exact < -3.4028234663852886e38 ? -3.4028234663852886e38
                                                                 : exact);
    uint32_t out;
    memcpy(&out, &value, sizeof out);
    burnish_store32(p, out);
}

/* Red, green, blue and alpha from luma and two differences of K bits; alpha has one bit less, and
 * the bit above it says what K is. */
static void undo_color(uint8_t *p, size_t size) {
    const uint32_t scaled = get_bytes(p + 3 * size, size), most = size == 1 ? 255 : 65535;
    uint32_t full = scaled; /* all bits up to the highest */
    for (unsigned shift = 1; shift < 16; shift *= 2) {
        full |= full >> shift;
    }
    const int y = (int)get_bytes(p, size), co = get_signed(p + size, size),
              cg = get_signed(p + 2 * size, size);
    const uint32_t alpha = scaled & full >> 1;
    const int v[4] = {y + co - cg, y + cg, y - co - cg, (int)(alpha << 1 | (alpha & 1))};
    const double scale = full > 0 ? (double)most / full : 0;
    for (size_t k = 0; k < 4; ++k) {
        const double value = v[k] * scale;
        put_rounded(p + k * size, size, value > 0 ? value < most ? value : most : 0);
    }
}

void burnish_meshopt_unfilter(burnish_meshopt_filter filter, size_t count, size_t stride,
                              uint8_t *data) {
    for (size_t i = 0; i < count && filter != BURNISH_MESHOPT_NONE; ++i, data += stride) {
        if (filter == BURNISH_MESHOPT_OCTAHEDRAL) {
            undo_octahedral(data, stride / 4);
        } else if (filter == BURNISH_MESHOPT_QUATERNION) {
            undo_quaternion(data);
        } else if (filter == BURNISH_MESHOPT_COLOR) {
            undo_color(data, stride / 4);
        } else {
            for (size_t k = 0; k < stride; k += 4) {
                undo_exponential(data + k);
            }
        }
    }
}
