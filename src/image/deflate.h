/* Deflate (RFC 1951) for the filtered rows of pictures: one Huffman block a band, and of matches
 * only those one pixel back. */
#ifndef BURNISH_IMAGE_DEFLATE_H
#define BURNISH_IMAGE_DEFLATE_H

#include <stddef.h>
#include <stdint.h>

/* Literal bytes, then a repetition of what stands one pixel before. */
typedef struct burnish_deflate_sequence {
    uint32_t literals;
    uint32_t repeated; /* 0 (the last sequence only) or at least 4 */
} burnish_deflate_sequence;

/* Sequences that size bytes may need. */
size_t burnish_deflate_sequence_bound(size_t size);

/* Room that size bytes may need, 8 bytes behind the last one included. */
size_t burnish_deflate_bound(size_t size);

/* Compresses a band on its own, so that bands can be made in any order and joined as they are.
 *
 * bytes:     size bytes
 * distance:  bytes a pixel, 3 or 4
 * last:      1: the stream ends here; 0: a further band follows, at a byte boundary
 * sequences: scratch, burnish_deflate_sequence_bound(size) of them
 * out:       burnish_deflate_bound(size) bytes, written
 * Returns the bytes written. */
size_t burnish_deflate_band(const uint8_t *bytes, size_t size, size_t distance, int last,
                            burnish_deflate_sequence *sequences, uint8_t *out);

#endif
