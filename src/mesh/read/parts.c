/* Cutting text into parts that threads read side by side. */
#include "mesh/read/parts.h"

#include <string.h>

#include "mesh/read/decimal.h"

const uint8_t *burnish_find_newline(const uint8_t *line, const uint8_t *end) {
    const uint8_t *newline = line < end ? memchr(line, '\n', (size_t)(end - line)) : NULL;
    return newline ? newline : end;
}

static int is_joined(const uint8_t *first, const uint8_t *newline) {
    newline -= newline > first && newline[-1] == '\r';
    return newline > first && newline[-1] == '\\';
}

const uint8_t *burnish_part_end(const uint8_t *first, const uint8_t *end, int wavefront) {
    if (end - first <= BURNISH_PART_SIZE) {
        return end;
    }
    const uint8_t *newline = first + BURNISH_PART_SIZE - 1;
    while ((newline = burnish_find_newline(newline, end)) < end) {
        ++newline;
        if (!wavefront || !is_joined(first, newline - 1)) {
            return newline;
        }
    }
    return end;
}

size_t burnish_count_tokens(const uint8_t *line, const uint8_t *line_end, const uint8_t *text_end) {
    const uint64_t each = UINT64_C(0x0101010101010101), high = each << 7;
    uint64_t before = 0; /* in its lowest byte: the byte before was in a token */
    size_t tokens = 0;
    if (text_end - line_end < 8) {
        return 0;
    }
    for (; line < line_end; line += 8) {
        uint64_t word = burnish_load_characters(line);
        if (line_end - line < 8) { /* what follows the line counts as blank */
            word &= ~UINT64_C(0) >> 8 * (8 - (line_end - line));
        }
        uint64_t hash = word ^ each * '#';
        if ((hash - each) & ~hash & high) {
            return 0;
        }
        uint64_t in_token = (((word & ~high) + each * (0x7F - ' ')) | word) & high;
        uint64_t begins = in_token & ~(in_token << 8 | before);
        tokens += (begins >> 7) * each >> 56;
        before = in_token >> 56;
    }
    return tokens;
}

/* Sums of bytes, as many as one holds, so that the compiler compares as many as a vector holds. */
enum { STRIDE = 240 };

size_t burnish_count_newlines(const uint8_t *first, const uint8_t *end) {
    size_t count = 0;
    while (first < end) {
        const ptrdiff_t size = end - first < STRIDE ? end - first : STRIDE;
        uint8_t found = 0;
        for (ptrdiff_t i = 0; i < size; ++i) {
            found = (uint8_t)(found + (first[i] == '\n'));
        }
        count += found;
        first += size;
    }
    return count;
}

size_t burnish_count_words(const uint8_t *first, const uint8_t *end) {
    size_t count = 0;
    while (first < end) {
        const ptrdiff_t size = end - first < STRIDE ? end - first : STRIDE;
        uint8_t found = 0;
        for (ptrdiff_t i = 0; i < size; ++i) {
            found = (uint8_t)(found + ((first[i] > ' ') & (first[i - 1] <= ' ')));
        }
        count += found;
        first += size;
    }
    return count;
}
