/* KHR_draco_mesh_compression: primitives that Draco compressed (Khronos, glTF 2.0 extensions).
 *
 * The decoder in the load options decodes Draco. It receives all the streams of a file at once, and
 * every number of its answer is checked like a file's. docs/importers.md has the layout of both. */

#include "mesh/read/gltf/gltf.h"

enum { ANSWER_HEAD = 8, STREAM_HEAD = 12, ATTRIBUTE_HEAD = 12, ATTRIBUTES_MAX = 32 };

/* An attribute of a stream: as many values as the stream has points. */
typedef struct attribute {
    const uint8_t *bytes;
    uint32_t number, component, width;
} attribute;

/* A view whose bytes are a stream of Draco's. */
typedef struct stream {
    uint32_t view;
    burnish_gltf_bytes packed;
    size_t point_count, triangle_count, attribute_count;
    attribute attributes[ATTRIBUTES_MAX];
    const uint8_t *indices;
} stream;

typedef struct draco {
    burnish_gltf *gltf;
    stream *streams;
    size_t stream_count, stream_capacity;
    uint32_t *of_view; /* 1 + number of the stream of each view; 0: none */
} draco;

/* The decoder's request and answer consist of little-endian words. */
typedef struct cursor {
    const uint8_t *at, *end;
} cursor;

/* `count` items of `size` bytes, padded to 4; NULL if fewer are left. */
static const uint8_t *take_items(cursor *c, uint64_t count, uint64_t size) {
    const uint64_t left = (uint64_t)(c->end - c->at);
    const uint8_t *bytes = c->at;
    if (size > 0 && count > left / size) {
        return NULL;
    }
    const uint64_t padded = (count * size + 3) & ~(uint64_t)3;
    if (padded > left) {
        return NULL;
    }
    c->at += padded;
    return bytes;
}

/* ---- What is compressed ---- */

uint32_t burnish_gltf_draco(burnish_gltf *gltf, uint32_t primitive) {
    const uint32_t extension =
        burnish_gltf_extension(gltf, primitive, "KHR_draco_mesh_compression");
    if (extension == BURNISH_JSON_NONE) {
        return BURNISH_JSON_NONE;
    }
    /* if the file also has uncompressed positions, they are used */
    const uint32_t attributes = burnish_gltf_object(gltf, primitive, "attributes");
    const uint32_t number =
        burnish_gltf_reference(gltf, attributes, "POSITION", BURNISH_GLTF_ACCESSORS);
    const int has_values =
        number != BURNISH_GLTF_NONE &&
        burnish_json_member(&gltf->json, gltf->lists[BURNISH_GLTF_ACCESSORS][number],
                            "bufferView") != BURNISH_JSON_NONE;
    return has_values ? BURNISH_JSON_NONE : extension;
}

/* Records the stream of an extension's view, once. */
static void add_stream(draco *d, uint32_t extension) {
    burnish_gltf *gltf = d->gltf;
    const uint32_t view = burnish_gltf_reference(gltf, extension, "bufferView", BURNISH_GLTF_VIEWS);
    size_t stride;
    if (gltf->status != BURNISH_STATUS_OK) {
        return;
    }
    if (view == BURNISH_GLTF_NONE) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, extension, "names no bufferView");
        return;
    }
    if (d->of_view[view] > 0) {
        return;
    }
    d->streams = burnish_reserve(gltf->memory, d->streams, &d->stream_capacity, d->stream_count + 1,
                                 sizeof *d->streams, "compressed primitives");
    if (!burnish_gltf_is_fine(gltf)) {
        return;
    }
    stream *s = &d->streams[d->stream_count];
    *s = (stream){.view = view};
    if (burnish_gltf_view(gltf, view, &s->packed, &stride)) {
        d->of_view[view] = (uint32_t)++d->stream_count;
    }
}

/* Calls `visit` for each compressed primitive, until something fails. */
static void visit_primitives(draco *d,
                             void (*visit)(draco *, uint32_t primitive, uint32_t extension)) {
    burnish_gltf *gltf = d->gltf;
    for (size_t i = 0; i < gltf->counts[BURNISH_GLTF_MESHES]; ++i) {
        const uint32_t primitives =
            burnish_gltf_array(gltf, gltf->lists[BURNISH_GLTF_MESHES][i], "primitives");
        uint32_t primitive = primitives + 1;
        for (size_t left = burnish_json_length(&gltf->json, primitives);
             left > 0 && gltf->status == BURNISH_STATUS_OK; --left) {
            const uint32_t extension = burnish_gltf_draco(gltf, primitive);
            if (extension != BURNISH_JSON_NONE && gltf->status == BURNISH_STATUS_OK) {
                visit(d, primitive, extension);
            }
            primitive = gltf->json.nodes[primitive].next;
        }
    }
}

static void find_stream(draco *d, uint32_t primitive, uint32_t extension) {
    if (!d->gltf->reader->input->options->decoder.decode) {
        burnish_gltf_fail(d->gltf, BURNISH_STATUS_FORMAT, primitive,
                          "is compressed by KHR_draco_mesh_compression, but no decoder is "
                          "available; export the file without it");
        return;
    }
    add_stream(d, extension);
}

/* ---- Asking ---- */

/* All streams, each after its size. NULL on failure. */
static uint8_t *pack_streams(draco *d, size_t *size) {
    uint64_t total = 0;
    for (size_t i = 0; i < d->stream_count; ++i) {
        total += 4 + (((uint64_t)d->streams[i].packed.size + 3) & ~(uint64_t)3);
        if (d->streams[i].packed.size > UINT32_MAX) {
            burnish_gltf_fail(d->gltf, BURNISH_STATUS_LIMIT,
                              d->gltf->lists[BURNISH_GLTF_VIEWS][d->streams[i].view],
                              "has more than 4 GiB of compressed primitives");
            return NULL;
        }
    }
    uint8_t *bytes =
        burnish_allocate_zeroed(d->gltf->memory, (size_t)total, 1, "compressed primitives");
    if (!burnish_gltf_is_fine(d->gltf)) {
        return NULL;
    }
    uint8_t *to = bytes;
    for (size_t i = 0; i < d->stream_count; ++i) {
        const burnish_gltf_bytes packed = d->streams[i].packed;
        for (int k = 0; k < 4; ++k) {
            to[k] = (uint8_t)(packed.size >> 8 * k);
        }
        memcpy(to + 4, packed.bytes, packed.size);
        to += 4 + ((packed.size + 3) & ~(size_t)3);
    }
    *size = (size_t)total;
    return bytes;
}

static void draco_request(draco *d) {
    burnish_gltf *gltf = d->gltf;
    const burnish_stream_decoder *decoder = &gltf->reader->input->options->decoder;
    burnish_error error = {BURNISH_STATUS_OK, ""};
    size_t size;
    uint8_t *bytes = pack_streams(d, &size);
    if (bytes) {
        gltf->status = decoder->decode(decoder->user_data, "draco", bytes, size, &gltf->draco.bytes,
                                       &gltf->draco.size, &error);
    }
    burnish_release(gltf->memory->context, bytes);
    if (gltf->status != BURNISH_STATUS_OK) {
        if (bytes) {
            *gltf->reader->error = error;
        }
        gltf->draco = (burnish_gltf_bytes){NULL, 0};
        return;
    }
    burnish_gltf_fill(gltf, gltf->lists[BURNISH_GLTF_VIEWS][d->streams->view], gltf->draco.size,
                      "compressed primitives");
}

/* ---- What comes back ---- */

static int read_attribute(cursor *c, size_t point_count, attribute *a) {
    const uint8_t *head = take_items(c, 1, ATTRIBUTE_HEAD);
    if (!head) {
        return 0;
    }
    *a = (attribute){.number = burnish_load32(head),
                     .component = burnish_load32(head + 4),
                     .width = burnish_load32(head + 8)};
    const size_t size = burnish_gltf_component_size((int)(a->component & 0xFFFF));
    if (size == 0 || a->component > 0xFFFF || a->width < 1 || a->width > 16) {
        return 0;
    }
    a->bytes = take_items(c, point_count, size * a->width);
    return a->bytes != NULL;
}

/* Returns 0 if the answer is malformed. */
static int read_stream(cursor *c, stream *s) {
    const uint8_t *head = take_items(c, 1, STREAM_HEAD);
    if (!head) {
        return 0;
    }
    s->point_count = burnish_load32(head);
    s->triangle_count = burnish_load32(head + 4);
    s->attribute_count = burnish_load32(head + 8);
    if (s->attribute_count > ATTRIBUTES_MAX || s->point_count >= BURNISH_VALUE_LIMIT ||
        s->triangle_count >= BURNISH_VALUE_LIMIT / 3) {
        return 0;
    }
    for (size_t i = 0; i < s->attribute_count; ++i) {
        if (!read_attribute(c, s->point_count, &s->attributes[i])) {
            return 0;
        }
    }
    s->indices = take_items(c, s->triangle_count, 12);
    return s->indices != NULL;
}

static void read_answer(draco *d) {
    burnish_gltf *gltf = d->gltf;
    cursor c = {gltf->draco.bytes, gltf->draco.bytes + gltf->draco.size};
    const uint8_t *head = take_items(&c, 1, ANSWER_HEAD);
    int is_good = head && memcmp(head, BURNISH_DRACO_MAGIC, ANSWER_HEAD) == 0;
    for (size_t i = 0; i < d->stream_count && is_good; ++i) {
        is_good = read_stream(&c, &d->streams[i]);
    }
    if (!is_good) {
        burnish_gltf_fail(
            gltf, BURNISH_STATUS_FORMAT, BURNISH_GLTF_NONE,
            "the decoder of Draco answers with something else, or with less than it states");
    }
}

/* ---- Accessors ---- */

/* Gives an accessor the values of a stream, unless it already has values. */
static void give_stream(burnish_gltf *gltf, uint32_t number, uint32_t value, const uint8_t *bytes,
                        size_t count, uint32_t component, uint32_t width) {
    const burnish_gltf_accessor accessor = {
        .bytes = bytes, .count = count, .component = (int)component, .width = (int)width};
    if (number == BURNISH_GLTF_NONE || gltf->status != BURNISH_STATUS_OK) {
        return;
    }
    if (count == 0) {
        burnish_gltf_fail(
            gltf, BURNISH_STATUS_FORMAT, value,
            "its stream of Draco can't be decoded, or holds nothing; the file is damaged");
        return;
    }
    burnish_gltf_give(gltf, number, value, &accessor);
}

static void give_values(draco *d, uint32_t primitive, uint32_t extension) {
    burnish_gltf *gltf = d->gltf;
    const uint32_t view = burnish_gltf_reference(gltf, extension, "bufferView", BURNISH_GLTF_VIEWS);
    const stream *s = &d->streams[d->of_view[view] - 1];
    const uint32_t names = burnish_gltf_object(gltf, primitive, "attributes");
    const uint32_t numbers = burnish_gltf_object(gltf, extension, "attributes");
    const uint32_t members = names == BURNISH_JSON_NONE ? 0 : gltf->json.nodes[names].size;
    uint32_t key = names + 1;
    for (uint32_t i = 0; i < members && i < BURNISH_JSON_MEMBERS; ++i) {
        char name[32];
        burnish_json_text(&gltf->json, key, name, sizeof name);
        const uint32_t number =
            (uint32_t)burnish_gltf_whole(gltf, numbers, name, UINT32_MAX, UINT32_MAX);
        const attribute *a = s->attributes, *end = a + s->attribute_count;
        while (a < end && a->number != number) {
            ++a;
        }
        if (a < end || s->point_count == 0) {
            give_stream(gltf, burnish_gltf_reference(gltf, names, name, BURNISH_GLTF_ACCESSORS),
                        extension, a < end ? a->bytes : NULL, s->point_count,
                        a < end ? a->component : 0, a < end ? a->width : 0);
        }
        key = gltf->json.nodes[gltf->json.nodes[key].next].next;
    }
    give_stream(gltf, burnish_gltf_reference(gltf, primitive, "indices", BURNISH_GLTF_ACCESSORS),
                extension, s->indices, 3 * s->triangle_count, BURNISH_GLTF_UNSIGNED_INT, 1);
}

/* ---- The step ---- */

void burnish_gltf_decode_draco(burnish_gltf *gltf) {
    draco d = {.gltf = gltf};
    d.of_view = burnish_allocate_zeroed(gltf->memory, gltf->counts[BURNISH_GLTF_VIEWS],
                                        sizeof *d.of_view, "buffer views");
    if (burnish_gltf_is_fine(gltf)) {
        visit_primitives(&d, find_stream);
    }
    if (gltf->status == BURNISH_STATUS_OK && d.stream_count > 0) {
        draco_request(&d);
        if (gltf->status == BURNISH_STATUS_OK) {
            read_answer(&d);
        }
        if (gltf->status == BURNISH_STATUS_OK) {
            visit_primitives(&d, give_values);
        }
    }
    burnish_release(gltf->memory->context, d.streams);
    burnish_release(gltf->memory->context, d.of_view);
}

void burnish_gltf_release_draco(burnish_gltf *gltf) {
    const burnish_stream_decoder *decoder = &gltf->reader->input->options->decoder;
    if (gltf->draco.bytes && decoder->release) {
        decoder->release(decoder->user_data, gltf->draco.bytes, gltf->draco.size);
    }
}
