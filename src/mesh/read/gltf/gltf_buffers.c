/* glTF's bytes: buffers from the binary chunk, from data URIs and from files next to the input. */
#include "mesh/read/gltf/gltf.h"

#include "mesh/read/gltf/meshopt.h"
#include "mesh/read/io/base64.h"
#include "mesh/read/io/budget.h"
#include "mesh/read/io/companions.h"

enum { FILE_NAME_SIZE = 4096 };

/* ---- URIs ---- */

static int hex_digit(char c) {
    return c >= '0' && c <= '9'                 ? c - '0'
           : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10
                                                : -1;
}

/* Percent-decodes in place. Returns the length. A stray '%' is kept. */
static size_t decode_percents(char *text, size_t size) {
    size_t written = 0;
    for (size_t i = 0; i < size; ++i) {
        const int high = text[i] == '%' && i + 2 < size ? hex_digit(text[i + 1]) : -1;
        const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
        text[written++] = low >= 0 ? (char)(high << 4 | low) : text[i];
        i += low >= 0 ? 2 : 0;
    }
    text[written] = 0;
    return written;
}

static int decode_data(burnish_gltf *gltf, uint32_t uri, uint8_t *text, size_t size,
                       burnish_gltf_buffer *buffer) {
    static const char mark[] = ";base64";
    const size_t mark_size = sizeof mark - 1;
    const uint8_t *comma = memchr(text, ',', size);
    const size_t head = comma ? (size_t)(comma - text) : 0;
    buffer->owned = text;
    if (head < mark_size || memcmp(comma - mark_size, mark, mark_size) != 0) {
        return burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, uri,
                                 "a data URI without \";base64,\"; export the file again");
    }
    const size_t written = burnish_decode_base64(comma + 1, size - head - 1, text);
    if (written == SIZE_MAX) {
        return burnish_gltf_fail(
            gltf, BURNISH_STATUS_FORMAT, uri,
            "its base64 data contains an invalid character; the file is damaged");
    }
    buffer->bytes = (burnish_gltf_bytes){text, written};
    return 1;
}

static int load_file(burnish_gltf *gltf, uint32_t uri, const char *name, uint64_t max_bytes,
                     burnish_gltf_buffer *buffer) {
    const burnish_file_loader *companions = &gltf->reader->input->companions;
    burnish_error error = {0};
    const void *bytes = NULL;
    size_t size = 0;
    if (!companions->load) {
        return burnish_gltf_fail(
            gltf, BURNISH_STATUS_READ, uri,
            "names the file %s, but the input has no folder; give its path, or convert it to GLB",
            burnish_show_name(name).text);
    }
    const burnish_status status =
        companions->load(companions->user_data, name, max_bytes, &bytes, &size, &error);
    if (status != BURNISH_STATUS_OK) {
        return burnish_gltf_fail(gltf, status, uri, "%s", error.text);
    }
    buffer->companion = buffer->bytes = (burnish_gltf_bytes){bytes, size};
    if (!burnish_budget_companion(gltf->reader, burnish_companion_key(name), size)) {
        return burnish_gltf_is_fine(gltf) &&
               burnish_gltf_fail(gltf, BURNISH_STATUS_LIMIT, uri,
                                 "refers to the file %s too often; let buffers share it",
                                 burnish_show_name(name).text);
    }
    return 1;
}

int burnish_gltf_open_uri(burnish_gltf *gltf, uint32_t uri, burnish_gltf_buffer *data,
                          char **name) {
    *name = NULL;
    if (!burnish_json_is_kind(&gltf->json, uri, BURNISH_JSON_STRING)) {
        return burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, uri, "expected a URI in quotes");
    }
    const size_t room = (size_t)gltf->json.nodes[uri].size + 1;
    char *text = burnish_allocate(gltf->memory, room, 1, "a URI");
    if (!text) {
        return burnish_gltf_is_fine(gltf);
    }
    const size_t size = burnish_json_text(&gltf->json, uri, text, room);
    if (size >= 5 && memcmp(text, "data:", 5) == 0) {
        return decode_data(gltf, uri, (uint8_t *)text, size, data);
    }
    const size_t decoded = decode_percents(text, size);
    if (decoded >= FILE_NAME_SIZE || memchr(text, 0, decoded)) {
        *text = 0; /* no file has such a name */
    }
    *name = text;
    return 1;
}

static int load_uri(burnish_gltf *gltf, uint32_t uri, burnish_gltf_buffer *buffer) {
    char *name, path[BURNISH_COMPANION_SIZE];
    burnish_error why = {0};
    if (!burnish_gltf_open_uri(gltf, uri, buffer, &name) || !name) {
        return gltf->status == BURNISH_STATUS_OK;
    }
    int good = 0;
    if (!*name || *name == '/' || strchr(name, '\\') || strchr(name, ':')) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_READ, uri,
                          "\"%s\" is not a file in the folder of the input; put it there",
                          burnish_show_name(name).text);
    } else if (!burnish_companion_path(gltf->reader->input, name, path)) {
        burnish_companion_outside(gltf->reader->input, name, &why);
        burnish_gltf_fail(gltf, BURNISH_STATUS_READ, uri, "\"%s\": %s",
                          burnish_show_name(name).text, why.text);
    } else {
        good = load_file(gltf, uri, path, gltf->bytes_left, buffer);
    }
    burnish_release(gltf->memory->context, name);
    return good;
}

void burnish_gltf_release_buffer(burnish_gltf *gltf, burnish_gltf_buffer *buffer) {
    const burnish_file_loader *companions = &gltf->reader->input->companions;
    if (buffer->companion.bytes && companions->release) {
        companions->release(companions->user_data, buffer->companion.bytes, buffer->companion.size);
    }
    burnish_release(gltf->memory->context, buffer->owned);
    *buffer = (burnish_gltf_buffer){0};
}

/* ---- Buffers and views ---- */

static const burnish_gltf_bytes *load_buffer(burnish_gltf *gltf, uint32_t number) {
    burnish_gltf_buffer *buffer = &gltf->buffers[number];
    const uint32_t value = gltf->lists[BURNISH_GLTF_BUFFERS][number];
    if (buffer->is_loaded) {
        return &buffer->bytes;
    }
    const uint64_t size = burnish_gltf_whole(gltf, value, "byteLength", 0, (uint64_t)1 << 53);
    const uint32_t uri = burnish_json_member(&gltf->json, value, "uri");
    if (uri != BURNISH_JSON_NONE) {
        if (!load_uri(gltf, uri, buffer)) {
            return NULL;
        }
        gltf->bytes_left -= buffer->companion.size; /* all files together are one input */
    } else if (number == 0 && gltf->binary.bytes) {
        buffer->bytes = gltf->binary;
    } else {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, value,
                          "has no uri, and the binary chunk is missing; export the file again");
        return NULL;
    }
    if (gltf->status == BURNISH_STATUS_OK && size > buffer->bytes.size) {
        burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, value,
                          "has %zu bytes where byteLength is %llu; the file is truncated",
                          buffer->bytes.size, (unsigned long long)size);
    }
    buffer->is_loaded = 1;
    return gltf->status == BURNISH_STATUS_OK ? &buffer->bytes : NULL;
}

int burnish_gltf_fill(burnish_gltf *gltf, uint32_t value, uint64_t bytes, const char *what) {
    burnish_reader *reader = gltf->reader;
    if (bytes <= burnish_budget_unpacked_left(reader)) {
        reader->unpacked_bytes += bytes;
        return 1;
    }
    return burnish_gltf_fail(gltf, BURNISH_STATUS_LIMIT, value,
                             "%s unpack to %llu bytes, of a file of %llu; write them in full", what,
                             (unsigned long long)(reader->unpacked_bytes + bytes),
                             (unsigned long long)burnish_budget_bytes(reader));
}

/* The index of the word under a key among `count` words; the last index if it is unknown. */
static int read_word(burnish_gltf *gltf, uint32_t object, const char *key, const char *const *words,
                     int count) {
    const uint32_t value = burnish_json_member(&gltf->json, object, key);
    int i = value == BURNISH_JSON_NONE ? 0 : 1;
    while (i > 0 && i < count && !burnish_json_is_text(&gltf->json, value, words[i])) {
        ++i;
    }
    return i;
}

/* The bytes that `object`, a view or its extension, names. */
static int locate_bytes(burnish_gltf *gltf, uint32_t object, burnish_gltf_bytes *bytes) {
    const uint32_t buffer = burnish_gltf_reference(gltf, object, "buffer", BURNISH_GLTF_BUFFERS);
    const uint64_t offset = burnish_gltf_whole(gltf, object, "byteOffset", 0, (uint64_t)1 << 53);
    const uint64_t size = burnish_gltf_whole(gltf, object, "byteLength", 0, (uint64_t)1 << 53);
    if (buffer == BURNISH_GLTF_NONE) {
        return burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, object, "names no buffer");
    }
    const burnish_gltf_bytes *all = load_buffer(gltf, buffer);
    if (!all || gltf->status != BURNISH_STATUS_OK) {
        return 0;
    }
    if (offset > all->size || size > all->size - offset) {
        return burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, object,
                                 "reaches to byte %llu of a buffer of %zu",
                                 (unsigned long long)(offset + size), all->size);
    }
    *bytes = (burnish_gltf_bytes){all->bytes + offset, (size_t)size};
    return 1;
}

/* A view of KHR_ or EXT_meshopt_compression, decoded on first use. The view's own buffer is a
 * fallback for other readers, and may have no bytes. */
static int decode_view(burnish_gltf *gltf, uint32_t view, uint32_t value,
                       burnish_gltf_bytes *bytes) {
    static const char *const modes[] = {"", "ATTRIBUTES", "TRIANGLES", "INDICES"};
    static const char *const filters[] = {"",           "NONE",        "OCTAHEDRAL",
                                          "QUATERNION", "EXPONENTIAL", "COLOR"};
    const int mode = read_word(gltf, value, "mode", modes, 4) - 1;
    const int filter = read_word(gltf, value, "filter", filters, 6);
    const size_t count =
        (size_t)burnish_gltf_whole(gltf, value, "count", 0, (uint64_t)BURNISH_VALUE_LIMIT - 1);
    const size_t stride = (size_t)burnish_gltf_whole(gltf, value, "byteStride", 0, 256);
    const burnish_meshopt_filter f = (burnish_meshopt_filter)(filter > 0 ? filter - 1 : 0);
    burnish_gltf_bytes packed;
    if (gltf->status != BURNISH_STATUS_OK) {
        return 0;
    }
    if (mode < 0 || mode > 2 || filter > 5) {
        return burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, value,
                                 "%s is unknown; export the file without meshopt's compression",
                                 filter > 5 ? "its filter" : "its mode");
    }
    const char *wrong = count == 0
                            ? "it has no elements"
                            : burnish_meshopt_check((burnish_meshopt_mode)mode, f, count, stride);
    if (wrong) {
        return burnish_gltf_fail(gltf, BURNISH_STATUS_FORMAT, value, "%s", wrong);
    }
    *bytes = (burnish_gltf_bytes){gltf->decoded[view], count * stride}; /* < 2^40 */
    if (bytes->bytes) {
        return 1;
    }
    if (!locate_bytes(gltf, value, &packed) ||
        !burnish_gltf_fill(gltf, value, (uint64_t)count * stride, "compressed buffer views")) {
        return 0;
    }
    uint8_t *out = burnish_allocate(gltf->memory, count, stride, "buffer views");
    if (!out) {
        return burnish_gltf_is_fine(gltf);
    }
    gltf->decoded[view] = out;
    if (!burnish_meshopt_decode((burnish_meshopt_mode)mode, packed.bytes, packed.size, count,
                                stride, out)) {
        return burnish_gltf_fail(
            gltf, BURNISH_STATUS_FORMAT, value,
            "its %zu bytes are no %zu elements compressed as %s; the file is damaged", packed.size,
            count, modes[mode + 1]);
    }
    burnish_meshopt_unfilter(f, count, stride, out);
    bytes->bytes = out;
    return 1;
}

int burnish_gltf_view(burnish_gltf *gltf, uint32_t view, burnish_gltf_bytes *bytes,
                      size_t *stride) {
    const uint32_t value = gltf->lists[BURNISH_GLTF_VIEWS][view];
    const uint32_t ratified = burnish_gltf_extension(gltf, value, "KHR_meshopt_compression");
    const uint32_t meshopt = ratified != BURNISH_JSON_NONE
                                 ? ratified
                                 : burnish_gltf_extension(gltf, value, "EXT_meshopt_compression");
    *stride = (size_t)burnish_gltf_whole(gltf, value, "byteStride", 0, 252);
    return meshopt != BURNISH_JSON_NONE ? decode_view(gltf, view, meshopt, bytes)
                                        : locate_bytes(gltf, value, bytes);
}
