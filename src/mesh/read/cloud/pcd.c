/* PCD (Point Cloud Library, "The PCD (Point Cloud Data) file format"), 0.5 to 0.7: fields of points as
 * text, as records, or as columns that LZF packs. Points that are not numbers are missing ones of an
 * organized cloud. */
#include "base/bytes.h"
#include "base/memory.h"
#include "mesh/read/cloud/separators.h"
#include "mesh/read/io/budget.h"
#include "mesh/read/io/streaming.h"
#include "mesh/read/ply/ply_header.h"

enum { FIELDS = 256, VALUES = 1 << 16 /* of a point, at most */, PACKED_HEAD = 8 };

typedef enum pcd_data { PCD_NONE, PCD_ASCII, PCD_BINARY, PCD_COMPRESSED } pcd_data;

typedef struct pcd_field {
    burnish_token name;
    uint8_t kind; /* 'I', 'U', 'F'; 0: not said, a float */
    size_t size, count;
} pcd_field;

typedef struct pcd_file {
    burnish_reader *reader;
    pcd_field fields[FIELDS];
    size_t field_count, row_size;
    int64_t width, height, points; /* -1: not said */
    pcd_data data;
    burnish_ply_header header;
    burnish_reader_input unpacked;
} pcd_file;

#define FAIL(pcd, at, ...)                                                                         \
    burnish_reader_fail((pcd)->reader, BURNISH_STATUS_FORMAT, at, __VA_ARGS__)

/* ---- The header ---- */

/* The rest of a line that has a value per field. */
static burnish_status read_fields(pcd_file *pcd, burnish_lexer *lexer, char keyword) {
    burnish_token word;
    for (size_t i = 0; burnish_lexer_token(lexer, &word); ++i) {
        int64_t value = 0;
        if (i == FIELDS || (keyword != 'F' && i == pcd->field_count)) {
            return FAIL(pcd, word.bytes, "the line has more values than there are fields");
        }
        pcd_field *field = &pcd->fields[i];
        if (keyword == 'F') {
            *field = (pcd_field){.name = word, .size = 4, .count = 1};
            pcd->field_count = i + 1;
        } else if (keyword == 'T') {
            field->kind = word.bytes[0] & (uint8_t)~0x20;
        } else if (burnish_parse_integer(word, &value) != BURNISH_NUMBER_OK || value < 0 ||
                   value > VALUES) {
            return FAIL(pcd, word.bytes, "\"%s\" is not a size or count of a field; correct it",
                        burnish_token_quote(word).text);
        } else {
            *(keyword == 'S' ? &field->size : &field->count) = (size_t)value;
        }
    }
    return BURNISH_STATUS_OK;
}

/* A line of the header. Others than those are ignored. */
static burnish_status read_pcd_line(pcd_file *pcd, burnish_lexer *lexer) {
    burnish_token keyword, word = {0};
    if (!burnish_lexer_token(lexer, &keyword) || *keyword.bytes == '#') {
        return BURNISH_STATUS_OK;
    }
    if (burnish_token_is_caseless(keyword, "fields") ||
        burnish_token_is_caseless(keyword, "columns")) {
        return read_fields(pcd, lexer, 'F');
    }
    if (burnish_token_is_caseless(keyword, "size") || burnish_token_is_caseless(keyword, "type") ||
        burnish_token_is_caseless(keyword, "count")) {
        return read_fields(pcd, lexer, (char)(*keyword.bytes & ~0x20));
    }
    int64_t *number = burnish_token_is_caseless(keyword, "width")    ? &pcd->width
                      : burnish_token_is_caseless(keyword, "height") ? &pcd->height
                      : burnish_token_is_caseless(keyword, "points") ? &pcd->points
                                                                     : NULL;
    const int is_data = burnish_token_is_caseless(keyword, "data");
    if ((number || is_data) && !burnish_lexer_token(lexer, &word)) {
        return FAIL(pcd, lexer->next, "the line has no value");
    }
    if (number && (burnish_parse_integer(word, number) != BURNISH_NUMBER_OK || *number < 0)) {
        return FAIL(pcd, word.bytes, "\"%s\" is not a count; correct it",
                    burnish_token_quote(word).text);
    }
    if (is_data) {
        pcd->data = burnish_token_is_caseless(word, "ascii")               ? PCD_ASCII
                    : burnish_token_is_caseless(word, "binary")            ? PCD_BINARY
                    : burnish_token_is_caseless(word, "binary_compressed") ? PCD_COMPRESSED
                                                                           : PCD_NONE;
        if (pcd->data == PCD_NONE) {
            return FAIL(pcd, word.bytes,
                        "data \"%s\" is unknown; use ascii, binary or binary_compressed",
                        burnish_token_quote(word).text);
        }
    }
    return BURNISH_STATUS_OK;
}

static burnish_status read_pcd_head(pcd_file *pcd) {
    const uint8_t *bytes = pcd->reader->input->bytes;
    burnish_lexer lexer = burnish_lexer_open(bytes, burnish_reader_head(pcd->reader), 0);
    burnish_status status = BURNISH_STATUS_OK;
    int more = 1;
    while (more && pcd->data == PCD_NONE && status == BURNISH_STATUS_OK) {
        status = read_pcd_line(pcd, &lexer);
        more = burnish_lexer_next_line(&lexer);
    }
    if (status == BURNISH_STATUS_OK && (pcd->data == PCD_NONE || pcd->field_count == 0)) {
        return FAIL(pcd, lexer.next,
                    "the header lacks FIELDS, or DATA at its end; the file is truncated");
    }
    if (pcd->points < 0) {
        const int64_t height = pcd->height < 0 ? 1 : pcd->height;
        pcd->points = pcd->width < 0 || __builtin_mul_overflow(pcd->width, height, &pcd->points)
                          ? 0
                          : pcd->points;
    }
    if (status == BURNISH_STATUS_OK && pcd->points == 0) {
        return FAIL(pcd, NULL, "the file has no points; export it again");
    }
    pcd->header.body = lexer.next;
    return status;
}

/* ---- Fields ---- */

static burnish_ply_type pcd_type(const pcd_field *field) {
    const size_t log = field->size == 8 ? 3 : field->size == 4 ? 2 : field->size - 1;
    return (field->size > 4 && field->size != 8) || field->size == 0 || field->size == 3
               ? BURNISH_PLY_NONE
           : field->kind == 'I' ? (burnish_ply_type)(BURNISH_PLY_INT8 + 2 * log)
           : field->kind == 'U' ? (burnish_ply_type)(BURNISH_PLY_UINT8 + 2 * log)
           : log < 2            ? BURNISH_PLY_NONE
                                : (burnish_ply_type)(BURNISH_PLY_FLOAT32 + log - 2);
}

static burnish_ply_role pcd_role(burnish_token name) {
    static const char *const normals[3] = {"normal_x", "normal_y", "normal_z"};
    for (int k = 0; k < 3; ++k) {
        if (burnish_token_is(name, normals[k])) {
            return (burnish_ply_role)(BURNISH_PLY_NX + k);
        }
    }
    const burnish_ply_role role = burnish_ply_role_of(name);
    return role >= BURNISH_PLY_ALPHA && role <= BURNISH_PLY_T ? BURNISH_PLY_OTHER : role;
}

static int is_packed_color(const pcd_field *field) {
    return field->size == 4 && field->count == 1 &&
           (burnish_token_is(field->name, "rgb") || burnish_token_is(field->name, "rgba"));
}

static burnish_status add_field(pcd_file *pcd, const pcd_field *field, int has_colors) {
    /* The bytes of a colour in a record; many programs leave alpha at 0. */
    static const burnish_ply_role bytes[4] = {BURNISH_PLY_BLUE, BURNISH_PLY_GREEN, BURNISH_PLY_RED,
                                              BURNISH_PLY_OTHER};
    const int is_packed = is_packed_color(field), are_bytes = is_packed && pcd->data != PCD_ASCII;
    const int is_tint = !has_colors && (burnish_token_is(field->name, "intensity") ||
                                        burnish_token_is(field->name, "i"));
    burnish_ply_property property = {.type = are_bytes ? BURNISH_PLY_UINT8 : pcd_type(field),
                                     .role = is_packed ? BURNISH_PLY_PACKED
                                             : is_tint ? BURNISH_PLY_S
                                                       : pcd_role(field->name),
                                     .name = field->name};
    burnish_status status = BURNISH_STATUS_OK;
    if (property.type == BURNISH_PLY_NONE) {
        return FAIL(pcd, field->name.bytes,
                    "field \"%s\" has no type of PCD; correct SIZE and TYPE",
                    burnish_token_quote(field->name).text);
    }
    pcd->header.tint = is_tint ? BURNISH_PLY_GREY : pcd->header.tint;
    for (size_t i = 0; i < (are_bytes ? 4 : field->count) && status == BURNISH_STATUS_OK; ++i) {
        property.role = are_bytes ? bytes[i] : i == 0 ? property.role : BURNISH_PLY_OTHER;
        status = burnish_ply_add_property(pcd->reader, &pcd->header, property);
    }
    return status;
}

static burnish_status describe_fields(pcd_file *pcd) {
    burnish_status status =
        burnish_ply_add_element(pcd->reader, &pcd->header,
                                (burnish_ply_element){.name = {(const uint8_t *)"points", 6},
                                                      .kind = BURNISH_PLY_ELEMENT_VERTEX,
                                                      .count = (uint64_t)pcd->points,
                                                      .at = pcd->reader->input->bytes});
    size_t values = 0, kept = 0;
    int has_colors = 0;
    for (size_t i = 0; i < pcd->field_count; ++i) {
        const pcd_field field = pcd->fields[i];
        has_colors |= is_packed_color(&field) || pcd_role(field.name) == BURNISH_PLY_RED;
        values += field.count;
        if (pcd->data != PCD_COMPRESSED || !burnish_token_is(field.name, "_")) {
            pcd->fields[kept++] = field; /* gaps of records are in no column */
            pcd->row_size += field.size * field.count;
        }
    }
    pcd->field_count = kept;
    if (values > VALUES) {
        return FAIL(pcd, NULL, "more than %d values of a point; export fewer fields", VALUES);
    }
    for (size_t i = 0; i < kept && status == BURNISH_STATUS_OK; ++i) {
        status = add_field(pcd, &pcd->fields[i], has_colors);
    }
    return status;
}

/* ---- Packed columns ---- */

/* LZF (M. Lehmann, LibLZF): runs of bytes, and of bytes that were there before. Returns the number
 * of bytes; SIZE_MAX if there are more than `room`, or the data is damaged. */
static size_t unpack_lzf(const uint8_t *from, const uint8_t *end, uint8_t *to, size_t room) {
    size_t at = 0;
    while (from < end) {
        const size_t control = *from++;
        size_t size = control < 32 ? control + 1 : (control >> 5) + 2, back = 0;
        if (control >= 224 && from < end) {
            size += *from++;
        }
        if (control >= 32) {
            if (from == end) {
                return SIZE_MAX;
            }
            back = ((control & 31) << 8 | *from++) + 1;
        }
        if (size > room - at || back > at || (back == 0 && size > (size_t)(end - from))) {
            return SIZE_MAX;
        }
        for (size_t i = 0; i < size; ++i, ++at) { /* may overlap */
            to[at] = back > 0 ? to[at - back] : *from++;
        }
    }
    return at;
}

/* Makes records of the columns. */
static void join_columns(const pcd_file *pcd, const uint8_t *columns, uint8_t *to) {
    size_t offset = 0;
    for (size_t f = 0; f < pcd->field_count; ++f) {
        const size_t size = pcd->fields[f].size * pcd->fields[f].count;
        for (size_t i = 0; size > 0 && i < (size_t)pcd->points; ++i, columns += size) {
            memcpy(to + i * pcd->row_size + offset, columns, size);
        }
        offset += size;
    }
}

/* Gives the reader an input of records. */
static burnish_status unpack_records(pcd_file *pcd) {
    burnish_reader *reader = pcd->reader;
    burnish_memory *memory = &reader->mesh->memory;
    const uint8_t *p = pcd->header.body;
    const size_t left = (size_t)(reader->input->bytes + reader->input->size - p);
    size_t size;
    if (left < PACKED_HEAD || burnish_load32(p) > left - PACKED_HEAD ||
        __builtin_mul_overflow((size_t)pcd->points, pcd->row_size, &size) ||
        size != burnish_load32(p + 4) || size == 0) {
        return FAIL(pcd, p, "the packed data does not fit the header; the file is truncated");
    }
    if (size > burnish_budget_unpacked_left(reader)) {
        return burnish_reader_fail(reader, BURNISH_STATUS_LIMIT, p,
                                   "its data unpacks to more than 64 times its size; save it as "
                                   "binary");
    }
    reader->unpacked_bytes += size;
    uint8_t *columns = burnish_allocate(memory, size, 1, "columns of points");
    uint8_t *records = burnish_allocate(memory, size, 1, "records of points");
    burnish_status status = memory->status;
    const uint8_t *from = p + PACKED_HEAD;
    if (status == BURNISH_STATUS_OK &&
        unpack_lzf(from, from + burnish_load32(p), columns, size) != size) {
        status = FAIL(pcd, p, "the packed data is damaged; export the file again");
    }
    if (status == BURNISH_STATUS_OK) {
        join_columns(pcd, columns, records);
        pcd->unpacked = *reader->input;
        pcd->unpacked.bytes = pcd->header.body = pcd->header.elements[0].at = records;
        pcd->unpacked.size = size;
        reader->input = &pcd->unpacked;
        records = NULL;
    }
    burnish_release(memory->context, columns);
    burnish_release(memory->context, records);
    return status;
}

/* Text in which commas or semicolons separate values, though the format has blanks. */
static burnish_status accept_separators(pcd_file *pcd) {
    burnish_reader *reader = pcd->reader;
    const size_t at = (size_t)(pcd->header.body - reader->input->bytes);
    const burnish_status status = burnish_blank_separators(reader, at, &pcd->unpacked);
    if (pcd->unpacked.bytes) {
        pcd->header.body = pcd->header.elements[0].at = reader->input->bytes + at;
        reader->counted = NULL;
        burnish_reader_warn(reader, pcd->header.body, "commas or semicolons separate values");
    }
    return status;
}

static burnish_status pcd_read(burnish_reader *reader) {
    const burnish_reader_input *input = reader->input;
    pcd_file pcd = {.reader = reader, .width = -1, .height = -1, .points = -1};
    burnish_status status = read_pcd_head(&pcd);
    pcd.header.may_lack = 1;
    pcd.header.encoding = pcd.data == PCD_ASCII ? BURNISH_PLY_ASCII : BURNISH_PLY_LITTLE_ENDIAN;
    if (status == BURNISH_STATUS_OK) {
        status = describe_fields(&pcd);
    }
    reader->is_binary = pcd.data != PCD_ASCII;
    if (status == BURNISH_STATUS_OK && pcd.data == PCD_COMPRESSED) {
        status = input->streamed ? burnish_stop_streaming(reader) : unpack_records(&pcd);
    }
    if (status == BURNISH_STATUS_OK && pcd.data == PCD_ASCII) {
        status = accept_separators(&pcd);
    }
    status = burnish_ply_read_described(reader, &pcd.header, status);
    reader->input = input;
    reader->counted = NULL;
    burnish_release(reader->mesh->memory.context, (void *)(uintptr_t)pcd.unpacked.bytes);
    return status;
}

/* Certain by the comment that writers put first; without it, by the first keyword. */
static int pcd_recognise(const uint8_t *bytes, size_t size) {
    burnish_lexer lexer = burnish_lexer_open(bytes, size, 0);
    burnish_token word, version;
    if (size >= 6 && burnish_bytes_are_caseless(bytes, (const uint8_t *)"# .pcd", 6)) {
        return 2;
    }
    return burnish_lexer_token(&lexer, &word) && burnish_token_is_caseless(word, "version") &&
           burnish_lexer_token(&lexer, &version) &&
           (burnish_token_is(version, ".7") || burnish_token_is(version, "0.7"));
}

const burnish_format_reader burnish_reader_pcd = {
    .recognise = pcd_recognise, .read = pcd_read, .can_stream = 1};
