#include "mesh/read/io/zip.h"

#include "base/bytes.h"
#include "mesh/read/io/budget.h"

#include <stdlib.h>
#include <string.h>

enum {
    END_SIZE = 22,        /* the end record, without its comment */
    COMMENT_MOST = 65535, /* after it */
    LOCATOR_SIZE = 20,    /* of the end record in 64 bits, before the other one */
    END_64_SIZE = 56,
    ENTRY_SIZE = 46, /* of the directory, before its name */
    HEADER_SIZE = 30 /* before a part's bytes, without its name */
};

static uint8_t lower_case(uint8_t c) {
    return c >= 'A' && c <= 'Z' ? (uint8_t)(c + 32) : c;
}

/* Names in small letters, by their bytes. */
static int compare_names(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size) {
    const size_t size = a_size < b_size ? a_size : b_size;
    for (size_t i = 0; i < size; ++i) {
        if (lower_case(a[i]) != lower_case(b[i])) {
            return lower_case(a[i]) < lower_case(b[i]) ? -1 : 1;
        }
    }
    return (a_size > b_size) - (a_size < b_size);
}

/* Equal names keep the order of the archive. */
static int compare_parts(const void *left, const void *right) {
    const burnish_zip_part *a = left, *b = right;
    const int order = compare_names(a->name, a->name_size, b->name, b->name_size);
    return order ? order : (a->name > b->name) - (a->name < b->name);
}

/* ---- The directory ---- */

typedef struct directory {
    uint64_t offset, size, count;
} directory;

static burnish_status zip_fail(burnish_zip *zip, const uint8_t *at, const char *what) {
    return burnish_reader_fail(zip->reader, BURNISH_STATUS_FORMAT, at, "%s", what);
}

/* The end record: the last one whose comment reaches as far as the archive. NULL: there is none. */
static const uint8_t *find_end(const uint8_t *bytes, size_t size) {
    for (size_t comment = 0; comment <= COMMENT_MOST && comment + END_SIZE <= size; ++comment) {
        const uint8_t *p = bytes + size - END_SIZE - comment;
        if (p[0] == 'P' && memcmp(p, "PK\5\6", 4) == 0 && burnish_load16(p + 20) <= comment) {
            return p;
        }
    }
    return NULL;
}

/* Finds the directory, with 64-bit numbers if one does not fit the end record. */
static burnish_status find_directory(burnish_zip *zip, directory *found) {
    const burnish_reader_input *input = zip->reader->input;
    const uint8_t *end = find_end(input->bytes, input->size);
    if (!end) {
        return zip_fail(zip, NULL, "the archive has no end; the file is truncated");
    }
    const size_t at = (size_t)(end - input->bytes);
    *found =
        (directory){burnish_load32(end + 16), burnish_load32(end + 12), burnish_load16(end + 10)};
    const int is_64 =
        found->offset == UINT32_MAX || found->size == UINT32_MAX || found->count == 0xFFFF;
    if (is_64 && at >= LOCATOR_SIZE && memcmp(end - LOCATOR_SIZE, "PK\6\7", 4) == 0) {
        const uint64_t record = burnish_load64(end - LOCATOR_SIZE + 8);
        if (at < END_64_SIZE || record > at - END_64_SIZE ||
            memcmp(input->bytes + record, "PK\6\6", 4) != 0) {
            return zip_fail(zip, end - LOCATOR_SIZE,
                            "the archive's end is damaged; fetch it again");
        }
        const uint8_t *p = input->bytes + record;
        *found =
            (directory){burnish_load64(p + 48), burnish_load64(p + 40), burnish_load64(p + 32)};
    }
    if (found->offset > at || found->size > at - found->offset ||
        found->count > found->size / ENTRY_SIZE) {
        return zip_fail(zip, end,
                        "the archive's directory is outside the archive; the file is damaged");
    }
    return BURNISH_STATUS_OK;
}

/* An extra field has the 64-bit numbers that are needed, in this order. */
static void read_extra(burnish_zip_part *part, const uint8_t *extra, size_t size) {
    enum { FIELD_64 = 1, FIELD_HEADER = 4 };
    uint64_t *const numbers[3] = {&part->size, &part->packed_size, &part->header};
    while (size >= FIELD_HEADER) {
        const size_t length = burnish_load16(extra + 2);
        if (length > size - FIELD_HEADER) {
            return;
        }
        const uint8_t *p = extra + FIELD_HEADER, *end = p + length;
        for (int i = 0; burnish_load16(extra) == FIELD_64 && i < 3; ++i) {
            if (*numbers[i] == UINT32_MAX && end - p >= 8) {
                *numbers[i] = burnish_load64(p);
                p += 8;
            }
        }
        extra += FIELD_HEADER + length;
        size -= FIELD_HEADER + length;
    }
}

static burnish_status read_directory(burnish_zip *zip, const directory *from) {
    const uint8_t *p = zip->reader->input->bytes + from->offset;
    size_t left = (size_t)from->size;
    for (size_t i = 0; i < from->count; ++i) {
        size_t name = 0, extra = 0, comment = 0;
        const int is_entry = left >= ENTRY_SIZE && memcmp(p, "PK\1\2", 4) == 0;
        if (is_entry) {
            name = burnish_load16(p + 28);
            extra = burnish_load16(p + 30);
            comment = burnish_load16(p + 32);
        }
        if (!is_entry || name + extra + comment > left - ENTRY_SIZE) {
            return zip_fail(zip, p, "the archive's directory is damaged; fetch the file again");
        }
        burnish_zip_part *part = &zip->parts[zip->count++];
        *part = (burnish_zip_part){.name = p + ENTRY_SIZE,
                                   .name_size = (uint32_t)name,
                                   .crc = burnish_load32(p + 16),
                                   .method = (uint16_t)burnish_load16(p + 10),
                                   .flags = (uint16_t)burnish_load16(p + 8),
                                   .packed_size = burnish_load32(p + 20),
                                   .size = burnish_load32(p + 24),
                                   .header = burnish_load32(p + 42)};
        read_extra(part, p + ENTRY_SIZE + name, extra);
        p += ENTRY_SIZE + name + extra + comment;
        left -= ENTRY_SIZE + name + extra + comment;
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_zip_open(burnish_zip *zip, burnish_reader *reader) {
    const burnish_reader_input *input = reader->input;
    directory found = {0};
    *zip = (burnish_zip){.reader = reader, .left = input->options->max_input_bytes};
    reader->is_binary = 1;
    burnish_status status = find_directory(zip, &found);
    if (status == BURNISH_STATUS_OK && found.count > 0) {
        zip->parts = burnish_allocate(&reader->mesh->memory, (size_t)found.count,
                                      sizeof *zip->parts, "the archive's directory");
        status = zip->parts ? read_directory(zip, &found) : reader->mesh->memory.status;
    }
    if (zip->count > 0) {
        qsort(zip->parts, zip->count, sizeof *zip->parts, compare_parts);
    }
    return status;
}

void burnish_zip_close(burnish_zip *zip) {
    burnish_release(zip->reader->mesh->memory.context, zip->parts);
    zip->parts = NULL;
    zip->count = 0;
}

burnish_zip_part *burnish_zip_find(const burnish_zip *zip, const char *name) {
    size_t first = 0, end = zip->count;
    while (first < end) {
        const size_t middle = first + (end - first) / 2;
        const burnish_zip_part *part = &zip->parts[middle];
        if (compare_names(part->name, part->name_size, (const uint8_t *)name, strlen(name)) < 0) {
            first = middle + 1;
        } else {
            end = middle;
        }
    }
    if (first == zip->count) {
        return NULL;
    }
    burnish_zip_part *part = &zip->parts[first];
    const uint8_t *wanted = (const uint8_t *)name;
    return compare_names(part->name, part->name_size, wanted, strlen(name)) == 0 ? part : NULL;
}

/* ---- Parts ---- */

static burnish_status fail_part(burnish_zip_stream *stream, const char *what) {
    return burnish_reader_fail(stream->zip->reader, BURNISH_STATUS_FORMAT, NULL, "%s: %s",
                               stream->name, what);
}

burnish_status burnish_zip_begin(burnish_zip *zip, const burnish_zip_part *part,
                                 burnish_zip_stream *stream) {
    enum { STORED = 0, DEFLATED = 8, IS_ENCRYPTED = 1 };
    const burnish_reader_input *input = zip->reader->input;
    const size_t shown =
        part->name_size < sizeof stream->name ? part->name_size : sizeof stream->name - 1;
    *stream = (burnish_zip_stream){.zip = zip, .part = part};
    memcpy(stream->name, part->name + part->name_size - shown, shown);
    if (part->header > input->size || input->size - part->header < HEADER_SIZE ||
        memcmp(input->bytes + part->header, "PK\3\4", 4) != 0) {
        return fail_part(stream, "the part is not where the archive says; the file is damaged");
    }
    const uint8_t *header = input->bytes + part->header;
    const uint64_t start =
        part->header + HEADER_SIZE + burnish_load16(header + 26) + burnish_load16(header + 28);
    if (start > input->size || part->packed_size > input->size - start) {
        return fail_part(stream, "the part reaches beyond the archive; the file is truncated");
    }
    stream->from = input->bytes + start;
    stream->from_left = (size_t)part->packed_size;
    if (part->flags & IS_ENCRYPTED) {
        return fail_part(stream, "the part is encrypted; export it without a password");
    }
    if (part->method == DEFLATED) {
        stream->inflate = burnish_inflate_create(&zip->reader->mesh->memory, 1);
        return zip->reader->mesh->memory.status;
    }
    if (part->method != STORED) {
        return fail_part(stream,
                         "the part is packed in a way that is not read; pack it by deflate");
    }
    return BURNISH_STATUS_OK;
}

void burnish_zip_end(burnish_zip_stream *stream) {
    if (stream->inflate) {
        burnish_inflate_destroy(stream->zip->reader->mesh->memory.context, stream->inflate);
    }
    stream->inflate = NULL;
}

/* Some bytes of the part; has_ended becomes 1 at its end. */
static burnish_status inflate_step(burnish_zip_stream *stream, uint8_t *to, size_t room,
                                   size_t *got) {
    const size_t before = stream->from_left;
    burnish_inflate_result result = BURNISH_INFLATE_MORE;
    if (stream->inflate) {
        result =
            burnish_inflate_step(stream->inflate, &stream->from, &stream->from_left, to, room, got);
        if (result == BURNISH_INFLATE_MEMORY) {
            return stream->zip->reader->mesh->memory.status = BURNISH_STATUS_MEMORY;
        }
        if (result == BURNISH_INFLATE_MORE && *got == 0 &&
            (before == 0 || stream->from_left == before)) {
            return fail_part(stream, "the part is truncated; fetch the file again");
        }
    } else {
        *got = room < before ? room : before;
        memcpy(to, stream->from, *got);
        stream->from += *got;
        stream->from_left -= *got;
        result = stream->from_left == 0 ? BURNISH_INFLATE_END : result;
    }
    stream->has_ended = result == BURNISH_INFLATE_END;
    stream->crc = burnish_inflate_crc32(stream->crc, to, *got);
    stream->written += *got;
    if (result == BURNISH_INFLATE_DAMAGED ||
        (stream->has_ended &&
         (stream->crc != stream->part->crc || stream->written != stream->part->size))) {
        return fail_part(stream,
                         "the part's size or checksum does not match; fetch the file again");
    }
    return BURNISH_STATUS_OK;
}

static burnish_status count_unpacked(burnish_zip_stream *stream, size_t got) {
    burnish_zip *zip = stream->zip;
    burnish_reader *reader = zip->reader;
    if (got > zip->left) {
        return burnish_reader_fail(reader, BURNISH_STATUS_LIMIT, NULL,
                                   "%s: the archive unpacks to more than the limit of %llu bytes; "
                                   "raise the limit or simplify the mesh",
                                   stream->name,
                                   (unsigned long long)reader->input->options->max_input_bytes);
    }
    if (got > burnish_budget_unpacked_left(reader)) {
        return burnish_reader_fail(
            reader, BURNISH_STATUS_LIMIT, NULL,
            "%s: the archive's %llu bytes unpack to more than %llu; export it flat, or as glTF",
            stream->name, (unsigned long long)burnish_budget_bytes(reader),
            (unsigned long long)burnish_budget_of(burnish_budget_bytes(reader),
                                                  BURNISH_UNPACKED_PER_BYTE));
    }
    zip->left -= got;
    reader->unpacked_bytes += got;
    return BURNISH_STATUS_OK;
}

burnish_status burnish_zip_next(burnish_zip_stream *stream, uint8_t *to, size_t room,
                                size_t *written) {
    burnish_status status = BURNISH_STATUS_OK;
    *written = 0;
    while (status == BURNISH_STATUS_OK && *written < room && !stream->has_ended) {
        size_t got = 0;
        status = inflate_step(stream, to + *written, room - *written, &got);
        *written += got;
        if (status == BURNISH_STATUS_OK) {
            status = count_unpacked(stream, got);
        }
    }
    return status;
}

burnish_status burnish_zip_read(burnish_zip *zip, const burnish_zip_part *part, uint8_t **bytes,
                                size_t *size) {
    burnish_memory *memory = &zip->reader->mesh->memory;
    burnish_zip_stream stream;
    size_t capacity = 0;
    *bytes = NULL;
    *size = 0;
    burnish_status status = burnish_zip_begin(zip, part, &stream);
    while (status == BURNISH_STATUS_OK && !stream.has_ended) {
        size_t written = 0;
        *bytes = burnish_reserve(memory, *bytes, &capacity, *size + 2, 1, stream.name);
        status = memory->status;
        if (status == BURNISH_STATUS_OK) {
            status = burnish_zip_next(&stream, *bytes + *size, capacity - *size - 1, &written);
            *size += written;
            (*bytes)[*size] = 0;
        }
    }
    burnish_zip_end(&stream);
    if (status != BURNISH_STATUS_OK) {
        burnish_release(memory->context, *bytes);
        *bytes = NULL;
        *size = 0;
    }
    return status;
}
