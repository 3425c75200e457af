/* Deflate for the filtered rows of pictures.
 *
 * Of a rendered picture, most filtered rows are zero or repeat with the pixel, and what is left is
 * noise: a search for matches finds next to nothing there, and it is what costs libdeflate's
 * fastest level most of its time (bench/NOTES.md). So repetitions at the distance of one pixel are
 * taken, and everything else is coded by Huffman's method. Integers only: the same bytes on every
 * machine. */
#include "image/deflate.h"

#include <string.h>

enum {
    LITERALS = 286,   /* symbols of literals and lengths */
    END = 256,        /* the symbol that ends a block */
    LENGTH_BITS = 12, /* of a code word: four of them fit the bit buffer together */
    PRECODES = 19,
    PRECODE_BITS = 7,
    LEAST_MATCH = 4,
    MOST_MATCH = 258,
    LEAST_PIECE = 3,
    STORED_MOST = 65535,
    HISTOGRAMS = 4 /* side by side, so that equal bytes in a row need not wait for one another */
};

size_t burnish_deflate_sequence_bound(size_t size) {
    return size / (LEAST_MATCH + 1) + 2;
}

/* Stored blocks: 5 bytes each; the blocks' ends and the bit buffer add less than 32. */
size_t burnish_deflate_bound(size_t size) {
    return size + 5 * (size / STORED_MOST + 1) + 32;
}

/* ---- sequences ---- */

static uint64_t load64(const uint8_t *from) {
    uint64_t value;
    memcpy(&value, from, sizeof value);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    value = __builtin_bswap64(value);
#endif
    return value;
}

/* Bytes from `at` on that equal those one distance before, up to end. */
static size_t repeated_bytes(const uint8_t *at, size_t distance, const uint8_t *end) {
    const uint8_t *p = at;
    while (end - p >= 32) {
        uint64_t different = 0;
        for (int i = 0; i < 32; i += 8) {
            different |= load64(p + i) ^ load64(p + i - distance);
        }
        if (different != 0) {
            break;
        }
        p += 32;
    }
    while (p < end && *p == *(p - distance)) {
        ++p;
    }
    return (size_t)(p - at);
}

/* The first byte at or after p from which on four bytes equal those one distance before; end when
 * there is none. */
static const uint8_t *find_repetition(const uint8_t *p, size_t distance, const uint8_t *end) {
    const uint64_t low7 = UINT64_C(0x7f7f7f7f7f7f7f7f);
    while (end - p >= 8) {
        uint64_t difference = load64(p) ^ load64(p - distance);
        /* the upper bit of every byte that is 0, and then of every one that begins four of them */
        uint64_t equal = ~(((difference & low7) + low7) | difference | low7);
        uint64_t four = equal & equal >> 8;
        four &= four >> 16;
        if (four != 0) {
            return p + (__builtin_ctzll(four) >> 3);
        }
        p += 5; /* no repetition begins in the first five bytes */
    }
    for (; end - p >= LEAST_MATCH; ++p) {
        if (memcmp(p, p - distance, LEAST_MATCH) == 0) {
            return p;
        }
    }
    return end;
}

/* Returns the number of sequences; the last one has literals only, or nothing. */
static size_t find_sequences(const uint8_t *bytes, size_t size, size_t distance,
                             burnish_deflate_sequence *sequences) {
    const uint8_t *end = bytes + size, *start = bytes;
    const uint8_t *p = find_repetition(bytes + (size < distance ? size : distance), distance, end);
    size_t count = 0;
    while (p < end) {
        size_t length = LEAST_MATCH + repeated_bytes(p + LEAST_MATCH, distance, end);
        sequences[count++] = (burnish_deflate_sequence){(uint32_t)(p - start), (uint32_t)length};
        start = p + length;
        p = find_repetition(start, distance, end);
    }
    sequences[count++] = (burnish_deflate_sequence){(uint32_t)(end - start), 0};
    return count;
}

/* The first piece of a repetition: at most 258 bytes, and none under 3 is left over. */
static uint32_t first_piece(uint32_t repeated) {
    if (repeated <= MOST_MATCH) {
        return repeated;
    }
    return repeated - MOST_MATCH >= LEAST_PIECE ? MOST_MATCH : repeated - LEAST_PIECE;
}

/* The symbol of a length in [3, 258], and the bits behind it (RFC 1951, 3.2.5). */
static unsigned length_symbol(uint32_t length, unsigned *extra_bits, uint32_t *extra) {
    uint32_t over = length - LEAST_PIECE;
    *extra_bits = 0;
    *extra = 0;
    if (length == MOST_MATCH) {
        return 285;
    }
    if (over < 8) {
        return 257 + over;
    }
    *extra_bits = 29 - (unsigned)__builtin_clz(over);
    *extra = over & ((1U << *extra_bits) - 1);
    return 257 + (*extra_bits << 2) + (over >> *extra_bits);
}

/* ---- Huffman codes ---- */

/* Code words by symbol, with their bits in the order in which they are written. */
typedef struct code {
    uint16_t words[LITERALS];
    uint8_t lengths[LITERALS]; /* 0: the symbol does not occur */
} code;

/* Symbols that occur, by frequency and then by symbol; returns how many. A radix sort by two
 * digits would do; at 286 symbols a shell sort costs less than clearing its counters. */
static int sort_symbols(const uint32_t *frequencies, int symbols, uint16_t *sorted) {
    static const int gaps[] = {109, 41, 19, 5, 1};
    int count = 0;
    for (int symbol = 0; symbol < symbols; ++symbol) {
        if (frequencies[symbol] > 0) {
            sorted[count++] = (uint16_t)symbol;
        }
    }
    for (size_t g = 0; g < sizeof gaps / sizeof *gaps; ++g) {
        int gap = gaps[g];
        for (int i = gap; i < count; ++i) {
            uint16_t symbol = sorted[i];
            uint64_t key = (uint64_t)frequencies[symbol] << 16 | symbol;
            int k = i;
            for (; k >= gap; k -= gap) {
                uint16_t other = sorted[k - gap];
                if (((uint64_t)frequencies[other] << 16 | other) <= key) {
                    break;
                }
                sorted[k] = other;
            }
            sorted[k] = symbol;
        }
    }
    return count;
}

/* How many leaves of the optimal tree have each depth, those deeper than `most` counted as `most`.
 * The two queues of J. van Leeuwen, "On the construction of Huffman trees", 1976. */
static void count_depths(const uint32_t *frequencies, const uint16_t *sorted, int count, int most,
                         int *depth_counts) {
    uint32_t weights[LITERALS];
    uint16_t parents[2 * LITERALS], depths[2 * LITERALS];
    int leaf = 0, inner = 0;
    for (int made = 0; made < count - 1; ++made) {
        uint32_t weight = 0;
        for (int child = 0; child < 2; ++child) {
            int takes_leaf =
                inner == made || (leaf < count && frequencies[sorted[leaf]] <= weights[inner]);
            weight += takes_leaf ? frequencies[sorted[leaf]] : weights[inner];
            parents[takes_leaf ? leaf++ : count + inner++] = (uint16_t)(count + made);
        }
        weights[made] = weight;
    }
    memset(depth_counts, 0, (size_t)(most + 1) * sizeof *depth_counts);
    depths[2 * count - 2] = 0;
    for (int node = 2 * count - 3; node >= 0; --node) {
        depths[node] = (uint16_t)(depths[parents[node]] + 1);
        if (node < count) {
            ++depth_counts[depths[node] < most ? depths[node] : most];
        }
    }
}

/* Makes a code of at most `most` bits a word of at least two symbols. */
static void make_code(const uint32_t *frequencies, int symbols, int most, code *made) {
    uint16_t sorted[LITERALS];
    int depth_counts[16];
    uint32_t next[16] = {0}, space = 0;
    int count = sort_symbols(frequencies, symbols, sorted);
    count_depths(frequencies, sorted, count, most, depth_counts);
    for (int bits = 1; bits <= most; ++bits) {
        space += (uint32_t)depth_counts[bits] << (most - bits);
    }
    /* Too deep a tree takes up more than there is: a leaf moves down to make room for one from the
     * deepest level beside it, until it fits. */
    for (; space > 1U << most; --space) {
        int bits = most - 1;
        while (depth_counts[bits] == 0) {
            --bits;
        }
        --depth_counts[bits];
        depth_counts[bits + 1] += 2;
        --depth_counts[most];
    }
    memset(made->lengths, 0, sizeof made->lengths);
    for (int bits = most, symbol = 0; bits > 0; --bits) { /* the rarest get the longest words */
        for (int i = 0; i < depth_counts[bits]; ++i) {
            made->lengths[sorted[symbol++]] = (uint8_t)bits;
        }
    }
    for (int bits = 1; bits < most; ++bits) {
        next[bits + 1] = (next[bits] + (uint32_t)depth_counts[bits]) << 1;
    }
    for (int symbol = 0; symbol < symbols; ++symbol) {
        uint32_t word = next[made->lengths[symbol]]++, mirrored = 0;
        for (int bit = 0; bit < made->lengths[symbol]; ++bit) {
            mirrored = mirrored << 1 | (word >> bit & 1);
        }
        made->words[symbol] = (uint16_t)mirrored;
    }
}

/* ---- bits ---- */

typedef struct bit_writer {
    uint64_t bits;
    unsigned count; /* in bits, below 8 after a flush */
    uint8_t *next;
} bit_writer;

/* At most 56 bits between two flushes. */
static inline void put_bits(bit_writer *writer, uint64_t bits, unsigned count) {
    writer->bits |= bits << writer->count;
    writer->count += count;
}

/* Writes 8 bytes and moves on by the complete ones. */
static inline void flush(bit_writer *writer) {
    uint64_t bits = writer->bits;
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    bits = __builtin_bswap64(bits);
#endif
    memcpy(writer->next, &bits, sizeof bits);
    writer->next += writer->count >> 3;
    writer->bits >>= writer->count & 56;
    writer->count &= 7;
}

static void align(bit_writer *writer) {
    writer->count = (writer->count + 7) & ~7U;
    flush(writer);
}

/* ---- the block's head: the codes, by their lengths ---- */

/* Runs of equal lengths (RFC 1951, 3.2.7). */
typedef struct head {
    uint8_t symbols[LITERALS + 8];
    uint8_t extra[LITERALS + 8];
    int count;
    int literals, distances; /* lengths that are told */
    uint32_t frequencies[PRECODES];
    code precode;
    int precodes; /* of precode that are told */
} head;

static const uint8_t precode_order[PRECODES] = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                11, 4,  12, 3, 13, 2, 14, 1, 15};

static unsigned precode_extra_bits(unsigned symbol) {
    return symbol < 16 ? 0 : symbol == 16 ? 2 : symbol == 17 ? 3 : 7;
}

static void put_run(head *h, unsigned symbol, int extra) {
    h->symbols[h->count] = (uint8_t)symbol;
    h->extra[h->count++] = (uint8_t)extra;
    ++h->frequencies[symbol];
}

static void make_head(head *h, const code *literals, size_t distance) {
    uint8_t lengths[LITERALS + 4];
    memset(h, 0, sizeof *h);
    h->literals = LITERALS;
    while (literals->lengths[h->literals - 1] == 0) { /* ends at END at the latest */
        --h->literals;
    }
    h->distances = (int)distance; /* the code of distance d is d - 1, up to 4 */
    memcpy(lengths, literals->lengths, (size_t)h->literals);
    memset(lengths + h->literals, 0, (size_t)h->distances);
    int all = h->literals + h->distances;
    lengths[all - 1] = 1;
    for (int i = 0, run; i < all; i += run) {
        for (run = 1; i + run < all && lengths[i + run] == lengths[i]; ++run) {
        }
        if (lengths[i] == 0 && run >= 3) {
            run = run < 138 ? run : 138;
            put_run(h, run < 11 ? 17 : 18, run < 11 ? run - 3 : run - 11);
        } else if (i > 0 && lengths[i] == lengths[i - 1] && run >= 3) {
            run = run < 6 ? run : 6;
            put_run(h, 16, run - 3);
        } else {
            put_run(h, lengths[i], 0);
            run = 1;
        }
    }
    make_code(h->frequencies, PRECODES, PRECODE_BITS, &h->precode);
    h->precodes = PRECODES;
    while (h->precodes > 4 && h->precode.lengths[precode_order[h->precodes - 1]] == 0) {
        --h->precodes;
    }
}

static size_t head_bits(const head *h) {
    size_t bits = 14 + 3 * (size_t)h->precodes;
    for (unsigned symbol = 0; symbol < PRECODES; ++symbol) {
        bits += (size_t)h->frequencies[symbol] *
                (h->precode.lengths[symbol] + precode_extra_bits(symbol));
    }
    return bits;
}

static void put_head(bit_writer *writer, const head *h) {
    put_bits(writer, (uint64_t)(h->literals - 257), 5);
    put_bits(writer, (uint64_t)(h->distances - 1), 5);
    put_bits(writer, (uint64_t)(h->precodes - 4), 4);
    flush(writer);
    for (int i = 0; i < h->precodes; ++i) {
        put_bits(writer, h->precode.lengths[precode_order[i]], 3);
        flush(writer);
    }
    for (int i = 0; i < h->count; ++i) {
        unsigned symbol = h->symbols[i];
        put_bits(writer, h->precode.words[symbol], h->precode.lengths[symbol]);
        put_bits(writer, h->extra[i], precode_extra_bits(symbol));
        flush(writer);
    }
}

/* ---- the block ---- */

/* Frequencies of all symbols; returns the bits behind length symbols. */
static size_t count_symbols(const uint8_t *bytes, const burnish_deflate_sequence *sequences,
                            size_t count, uint32_t *frequencies) {
    uint32_t histograms[HISTOGRAMS][256] = {{0}};
    size_t extra_sum = 0;
    memset(frequencies, 0, LITERALS * sizeof *frequencies);
    for (size_t i = 0; i < count; ++i) {
        uint32_t literals = sequences[i].literals, k = 0;
        for (; k + HISTOGRAMS <= literals; k += HISTOGRAMS) {
            ++histograms[0][bytes[k]];
            ++histograms[1][bytes[k + 1]];
            ++histograms[2][bytes[k + 2]];
            ++histograms[3][bytes[k + 3]];
        }
        for (; k < literals; ++k) {
            ++histograms[0][bytes[k]];
        }
        bytes += literals + sequences[i].repeated;
        for (uint32_t left = sequences[i].repeated, piece; left > 0; left -= piece) {
            unsigned extra_bits;
            uint32_t extra;
            piece = first_piece(left);
            ++frequencies[length_symbol(piece, &extra_bits, &extra)];
            extra_sum += extra_bits + 1; /* and the distance's one bit */
        }
    }
    for (int symbol = 0; symbol < 256; ++symbol) {
        for (int k = 0; k < HISTOGRAMS; ++k) {
            frequencies[symbol] += histograms[k][symbol];
        }
    }
    frequencies[END] = 1;
    return extra_sum;
}

static void put_literals(bit_writer *writer, const code *literals, const uint8_t *bytes,
                         size_t count) {
    size_t i = 0;
    for (; i + 4 <= count; i += 4) {
        for (size_t k = i; k < i + 4; ++k) {
            put_bits(writer, literals->words[bytes[k]], literals->lengths[bytes[k]]);
        }
        flush(writer);
    }
    for (; i < count; ++i) {
        put_bits(writer, literals->words[bytes[i]], literals->lengths[bytes[i]]);
    }
    flush(writer);
}

static void put_symbols(bit_writer *writer, const code *literals, const uint8_t *bytes,
                        const burnish_deflate_sequence *sequences, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        put_literals(writer, literals, bytes, sequences[i].literals);
        bytes += sequences[i].literals + sequences[i].repeated;
        for (uint32_t left = sequences[i].repeated, piece; left > 0; left -= piece) {
            unsigned extra_bits;
            uint32_t extra;
            piece = first_piece(left);
            unsigned symbol = length_symbol(piece, &extra_bits, &extra);
            put_bits(writer, literals->words[symbol], literals->lengths[symbol]);
            put_bits(writer, extra, extra_bits);
            put_bits(writer, 0, 1); /* the only distance */
            flush(writer);
        }
    }
    put_bits(writer, literals->words[END], literals->lengths[END]);
    flush(writer);
}

static void put_stored(bit_writer *writer, const uint8_t *bytes, size_t size, int last) {
    do {
        size_t piece = size < STORED_MOST ? size : STORED_MOST;
        size -= piece;
        put_bits(writer, last && size == 0, 3);
        align(writer);
        put_bits(writer, piece | (piece ^ 0xffff) << 16, 32);
        flush(writer);
        if (piece > 0) {
            memcpy(writer->next, bytes, piece);
        }
        writer->next += piece;
        bytes += piece;
    } while (size > 0);
}

size_t burnish_deflate_band(const uint8_t *bytes, size_t size, size_t distance, int last,
                            burnish_deflate_sequence *sequences, uint8_t *out) {
    uint32_t frequencies[LITERALS];
    code literals;
    head h;
    bit_writer writer = {.next = out};
    size_t count = find_sequences(bytes, size, distance, sequences);
    size_t bits = count_symbols(bytes, sequences, count, frequencies);
    if (size > 0) {
        make_code(frequencies, LITERALS, LENGTH_BITS, &literals);
        make_head(&h, &literals, distance);
        bits += head_bits(&h);
        for (int symbol = 0; symbol < LITERALS; ++symbol) {
            bits += (size_t)frequencies[symbol] * literals.lengths[symbol];
        }
    }
    if (size == 0 || bits / 8 + 5 >= size + 5 * (size / STORED_MOST + 1)) {
        put_stored(&writer, bytes, size, last);
        return (size_t)(writer.next - out);
    }
    put_bits(&writer, last ? 5 : 4, 3); /* a block with codes of its own */
    put_head(&writer, &h);
    put_symbols(&writer, &literals, bytes, sequences, count);
    if (last) {
        align(&writer);
    } else {
        put_stored(&writer, bytes, 0, 0); /* an empty block ends at a byte boundary */
    }
    return (size_t)(writer.next - out);
}
