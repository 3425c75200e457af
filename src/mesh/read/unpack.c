/* Gzip and UTF-16, before anything looks at the bytes. */
#include "mesh/read/read.h"

#include "image/decode/gunzip.h"
#include "mesh/read/io/budget.h"
#include "mesh/read/stl.h"

/* Whether the input is UTF-16 with a byte order mark. A binary STL may begin with any bytes. */
static int has_mark(const burnish_reader_input *input) {
    return burnish_has_utf16_mark(input->bytes, input->size) &&
           !burnish_is_binary_stl(input->bytes, input->size);
}

static size_t write_utf8(uint32_t c, uint8_t *to) {
    if (c < 0x80) {
        to[0] = (uint8_t)c;
        return 1;
    }
    const size_t more = c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
    static const uint8_t leads[4] = {0, 0xC0, 0xE0, 0xF0};
    to[0] = (uint8_t)(leads[more] | c >> 6 * more);
    for (size_t i = 1; i <= more; ++i) {
        to[i] = (uint8_t)(0x80 | (c >> 6 * (more - i) & 0x3F));
    }
    return more + 1;
}

/* A surrogate without its other half is U+FFFD. Returns NULL when memory is out. */
static uint8_t *convert_utf16(const burnish_reader_input *input, burnish_memory *memory,
                              size_t *size) {
    enum { REPLACEMENT = 0xFFFD };
    const int big = input->bytes[0] == 0xFE;
    const size_t units = input->size / 2;
    uint8_t *text = burnish_allocate(memory, units, 3, input->name), *to = text;
    for (size_t i = 1; i < units && text; ++i) {
        const uint8_t *at = input->bytes + 2 * i;
        uint32_t c = (uint32_t)at[!big] << 8 | at[big];
        if (c >= 0xD800 && c < 0xE000) {
            const int has_other = c < 0xDC00 && i + 1 < units && (at[2 + !big] & 0xFC) == 0xDC;
            const uint32_t other = has_other ? (uint32_t)at[2 + !big] << 8 | at[2 + big] : 0;
            c = has_other ? 0x10000 + ((c & 0x3FF) << 10 | (other & 0x3FF)) : REPLACEMENT;
            i += (size_t)has_other;
        }
        to += write_utf8(c, to);
    }
    *size = text ? (size_t)(to - text) : 0;
    return text;
}

burnish_status burnish_unpack_input(burnish_reader_input *input, burnish_memory *memory,
                                    uint8_t **unpacked) {
    burnish_status status = BURNISH_STATUS_OK;
    *unpacked = NULL;
    if (input->packed_size == 0) { /* else it is of an archive, whose size counts */
        input->packed_size = input->size;
    }
    if (burnish_is_gzip(input->bytes, input->size)) {
        const burnish_gzip_file file = {
            input->bytes, input->size, input->name, input->options->max_input_bytes,
            burnish_budget_of(input->packed_size, BURNISH_UNPACKED_PER_BYTE)};
        status = burnish_gunzip(&file, memory, unpacked, &input->size);
        input->bytes = *unpacked;
    }
    if (status == BURNISH_STATUS_OK && has_mark(input)) {
        size_t size;
        uint8_t *text = convert_utf16(input, memory, &size);
        burnish_release(memory->context, *unpacked);
        *unpacked = text;
        input->bytes = text;
        input->size = size;
        status = memory->status;
    }
    return status;
}
