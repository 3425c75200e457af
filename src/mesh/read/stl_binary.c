/* Binary STL.
 *
 * Colours of a binary file's facets are 5 bits each in its two attribute bytes, in one of two ways.
 * VisCAM and SolidView: blue lowest, valid if bit 15 is set. Magics, recognised by "COLOR=" and 4
 * bytes RGBA in the header: red lowest, valid if bit 15 is not set; other facets have the header's
 * colour. Other programs leave noise in these bytes: of that, bit 15 says nothing. */
#include "mesh/read/stl.h"

#include <stdatomic.h>
#include <string.h>

#include "base/numbers.h"
#include "core/srgb.h"
#include "image/decode/decode.h"
#include "mesh/read/common/local_origin.h"
#include "mesh/read/io/budget.h"
#include "mesh/read/io/streaming.h"

enum {
    TITLE_SIZE = BURNISH_STL_TITLE_SIZE,
    HEADER_SIZE = BURNISH_STL_HEADER_SIZE,
    FACET_SIZE = BURNISH_STL_FACET_SIZE,
    NORMAL_SIZE = BURNISH_STL_NORMAL_SIZE,
    ATTRIBUTES_AT = 48 /* a facet's two attribute bytes */
};

enum { HAS_COLOR = 0x8000, BITS_OF_COLOR = 0x7FFF };

typedef struct facet_context {
    float *positions;
    atomic_size_t bad;        /* the first facet with a coordinate that is not finite */
    atomic_uint any, all;     /* the attribute bytes of all facets, joined by or and by and */
    atomic_size_t valid, odd; /* facets with bit 15, and with other bits alone */
    const uint8_t *announced; /* RGBA after "COLOR=" in the header; NULL: there is none */
    uint8_t *colors;          /* 4 bytes per corner */
} facet_context;

static void convert_facets(void *user_data, const uint8_t *facets, size_t first, size_t end) {
    facet_context *context = user_data;
    size_t bad = SIZE_MAX, valid = 0, odd = 0;
    unsigned any = 0, all = UINT16_MAX;
    for (size_t i = first; i < end; ++i, facets += FACET_SIZE) {
        const uint8_t *from = facets + NORMAL_SIZE;
        uint32_t bits[9], finite = 1;
        for (size_t k = 0; k < 9; ++k) {
            bits[k] = burnish_load32(from + 4 * k);
            finite &= (uint32_t)burnish_is_finite_bits(bits[k]);
        }
        memcpy(context->positions + 9 * i, bits, sizeof bits);
        bad = finite || i > bad ? bad : i;
        const unsigned found = burnish_load16(facets + ATTRIBUTES_AT);
        any |= found;
        all &= found;
        valid += found >> 15;
        odd += found - 1 < BITS_OF_COLOR;
    }
    burnish_lower_to(&context->bad, bad);
    atomic_fetch_or(&context->any, any);
    atomic_fetch_and(&context->all, all);
    atomic_fetch_add(&context->valid, valid);
    atomic_fetch_add(&context->odd, odd);
}

/* Of each facet from the first bad one on that has such a coordinate. */
static void note_bad_facets(burnish_reader *reader, size_t first, size_t count) {
    for (size_t i = first; i < count; ++i) {
        const uint8_t *at = reader->input->bytes + HEADER_SIZE + i * FACET_SIZE + NORMAL_SIZE;
        for (int k = 0; k < 9; ++k, at += 4) {
            if (!burnish_is_finite_bits(burnish_load32(at))) {
                burnish_reader_note(reader, &reader->damage, at,
                                    "coordinate is not finite; repair the mesh");
                break;
            }
        }
    }
}

/* If the count does not match the size, the facets decide whether these bytes are STL: the file is
 * rejected if more than a quarter of the first facets that are not all 0 have such coordinates. */
static burnish_status check_facets(burnish_reader *reader, size_t count) {
    enum { FACETS_LOOKED_AT = 4096 };
    const size_t looked = count < FACETS_LOOKED_AT ? count : FACETS_LOOKED_AT;
    size_t odd = 0, filled = 0;
    for (size_t i = 0; i < looked; ++i) {
        const uint8_t *at = reader->input->bytes + HEADER_SIZE + i * FACET_SIZE + NORMAL_SIZE;
        int is_odd = 0;
        uint32_t any = 0;
        for (int k = 0; k < 9; ++k, at += 4) {
            is_odd |= burnish_is_odd_coordinate(burnish_load32(at));
            any |= burnish_load32(at);
        }
        odd += is_odd != 0;
        filled += any != 0;
    }
    return odd <= filled / 4
               ? BURNISH_STATUS_OK
               : burnish_reader_fail(
                     reader, BURNISH_STATUS_FORMAT, reader->input->bytes + TITLE_SIZE,
                     "not STL: the count does not fit the file's size, and %zu of the first %zu "
                     "triangles have coordinates below 1e-30 or above 1e30",
                     odd, looked);
}

/* *count: what the header announces; receives how many facets there are. */
static burnish_status check_count(burnish_reader *reader, size_t *count) {
    const burnish_reader_input *input = reader->input;
    const size_t room = (input->size - HEADER_SIZE) / FACET_SIZE;
    const int fits = burnish_is_binary_stl(input->bytes, input->size);
    if (!fits && !input->streamed) { /* for a streamed input, the warning causes a full reading */
        const burnish_status status = check_facets(reader, *count < room ? *count : room);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    if (*count != room && room > 0 && (input->size - HEADER_SIZE) % FACET_SIZE == 0) {
        if (*count > 0 || input->streamed) { /* programs that write to a pipe announce 0 */
            burnish_reader_warn(
                reader, input->bytes + TITLE_SIZE,
                "%zu triangles are announced, but the file has %zu, which are drawn", *count, room);
        }
        *count = room;
    }
    if (*count > room) {
        return burnish_reader_fail(
            reader, BURNISH_STATUS_FORMAT, input->bytes + TITLE_SIZE,
            "%zu triangles are announced, but the file ends after %zu; it is truncated or not STL",
            *count, room);
    }
    if (*count > input->options->max_triangles) {
        return burnish_fail_triangles(reader, input->bytes + TITLE_SIZE);
    }
    const burnish_status status = burnish_budget_check(reader, 3 * (uint64_t)*count, *count);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const size_t used = HEADER_SIZE + *count * FACET_SIZE;
    if (used < input->size) {
        /* for a streamed file, only the head is in memory, and the warning causes a full reading */
        burnish_reader_warn(reader, input->bytes + (input->streamed ? 0 : used),
                            "%zu bytes after the last triangle were ignored", input->size - used);
    }
    return BURNISH_STATUS_OK;
}

/* The bytes after "COLOR=" in the header; NULL without it. */
static const uint8_t *find_announced_color(const uint8_t *bytes) {
    static const char announcement[] = "COLOR=";
    const size_t length = sizeof announcement - 1;
    for (const uint8_t *at = bytes, *end = at + TITLE_SIZE - 4 - length; at <= end; ++at) {
        if (memcmp(at, announcement, length) == 0) {
            return at + length;
        }
    }
    return NULL;
}

/* A facet's colour by its attributes; white for none. */
static void write_facet_color(const facet_context *context, unsigned bits, uint8_t rgba[4]) {
    const int has_own = !(bits & HAS_COLOR) == (context->announced != NULL);
    memset(rgba, 255, 4);
    if (has_own) {
        rgba[0] = burnish_widen_5_bits(context->announced ? bits : bits >> 10);
        rgba[1] = burnish_widen_5_bits(bits >> 5);
        rgba[2] = burnish_widen_5_bits(context->announced ? bits >> 10 : bits);
    } else if (context->announced) {
        memcpy(rgba, context->announced, 3);
    }
}

static void convert_colors(void *user_data, const uint8_t *facets, size_t first, size_t end) {
    const facet_context *context = user_data;
    for (size_t i = first; i < end; ++i, facets += FACET_SIZE) {
        uint8_t *rgba = context->colors + 12 * i;
        write_facet_color(context, burnish_load16(facets + ATTRIBUTES_AT), rgba);
        memcpy(rgba + 4, rgba, 4);
        memcpy(rgba + 8, rgba, 4);
    }
}

/* One colour for all facets becomes the material's. */
static burnish_status set_material(burnish_mesh_data *mesh, const uint8_t rgba[4]) {
    mesh->materials = burnish_reserve(&mesh->memory, mesh->materials, &mesh->material_capacity, 1,
                                      sizeof *mesh->materials, "materials");
    if (mesh->memory.status == BURNISH_STATUS_OK) {
        burnish_material *material = &mesh->materials[mesh->material_count++];
        *material = burnish_material_default();
        for (int i = 0; i < 3; ++i) {
            material->diffuse[i] = material->ambient[i] =
                burnish_srgb_value_to_linear((float)rgba[i] / 255);
        }
        material->has_diffuse = 1;
    }
    return mesh->memory.status;
}

/* Colours, if the file has any. Attribute bytes that are all 0 or all 1 are not colours, nor are those
 * without an announced colour of which over two fifths lack bit 15 and have others. If they
 * are 0 in all facets and the header announces a colour, that colour applies: programs that write
 * such headers more often leave them unset than mean black. */
static burnish_status read_colors(burnish_reader *reader, facet_context *context, size_t count) {
    burnish_mesh_data *mesh = reader->mesh;
    const unsigned any = atomic_load(&context->any), all = atomic_load(&context->all);
    context->announced = find_announced_color(reader->input->bytes);
    if (!context->announced &&
        (!(any & HAS_COLOR) || !(any & BITS_OF_COLOR) || all == UINT16_MAX ||
         3 * atomic_load(&context->odd) > 2 * atomic_load(&context->valid))) {
        return BURNISH_STATUS_OK;
    }
    if (any == all) {
        uint8_t rgba[4];
        write_facet_color(context, any > 0 ? all : HAS_COLOR, rgba);
        return set_material(mesh, rgba);
    }
    if (burnish_mesh_data_reserve(mesh, BURNISH_COLOR, 3 * count) == BURNISH_STATUS_OK) {
        mesh->streams[BURNISH_COLOR].count = 3 * count;
        context->colors = burnish_colors(mesh);
        return burnish_reader_rows(reader, HEADER_SIZE, FACET_SIZE, count, convert_colors, context);
    }
    return mesh->memory.status;
}

/* ---- Reading ---- */

burnish_status burnish_stl_read_binary(burnish_reader *reader) {
    burnish_mesh_data *mesh = reader->mesh;
    size_t count = burnish_load32(reader->input->bytes + TITLE_SIZE);
    reader->is_binary = 1;
    burnish_status status = check_count(reader, &count);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_mesh_data_reserve(mesh, BURNISH_POSITION, 3 * count);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    facet_context context = {.positions = burnish_positions(mesh)};
    atomic_init(&context.bad, SIZE_MAX);
    atomic_init(&context.all, UINT16_MAX);
    atomic_init(&context.valid, 0);
    atomic_init(&context.odd, 0);
    status = burnish_reader_rows(reader, HEADER_SIZE, FACET_SIZE, count, convert_facets, &context);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const size_t bad = atomic_load(&context.bad);
    if (bad < count && reader->input->streamed) {
        return burnish_stop_streaming(reader);
    }
    note_bad_facets(reader, bad, count);
    mesh->streams[BURNISH_POSITION].count = 3 * count;
    mesh->triangle_count = count;
    burnish_move_positions(mesh);
    return read_colors(reader, &context, count);
}
