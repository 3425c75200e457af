/* Listing the triangles of a tile by vectors. Included by the tiers after geometry_simd.h. */

enum { ALL_OF_BLOCK = (1 << BURNISH_BATCH_SIZE) - 1 };

/* Adds triangles of a block at the end of a chain; 0 when there is no room. Whether the last entry
 * is of the same block is too hard to foresee for a branch. */
static inline int add_lanes(burnish_bin_slice *slice, burnish_tile_list *chain, size_t block,
                            unsigned lanes) {
    uint32_t next = chain->next;
    const burnish_bin_entry before = slice->entries[next ? next - 1 : 0];
    const uint32_t is_same = (next > 0) & (before.batch == block);
    if (next % BURNISH_CHUNK_ENTRIES == 0 && !is_same) { /* full, or not begun */
        slice->status = burnish_list_start_piece(slice, chain);
        if (slice->status != BURNISH_STATUS_OK) {
            return 0;
        }
        next = chain->next;
    }
    slice->entries[next - is_same] =
        (burnish_bin_entry){(uint32_t)block, lanes | (before.mask & (0 - is_same))};
    chain->next = next + 1 - is_same;
    return 1;
}

/* A triangle into the lists of the band's tiles that it touches; 0 when there is no room. */
static int add_triangle(const burnish_bins *bins, burnish_bin_slice *slice, size_t block,
                        burnish_tile_box box, unsigned lane, unsigned back) {
    box.row0 = box.row0 < bins->first_row ? bins->first_row : box.row0;
    box.row1 = box.row1 >= bins->end_row ? bins->end_row - 1 : box.row1;
    for (int row = box.row0; row <= box.row1; ++row) {
        const int base = (row - bins->first_row) * bins->columns;
        for (int column = box.column0; column <= box.column1; ++column) {
            if (!add_lanes(slice, &slice->chains[2 * (size_t)(base + column) + back], block,
                           1u << lane)) {
                return 0;
            }
        }
    }
    return 1;
}

/* Triangles of a block that are in one tile alone into its lists; 0 when there is no room. */
static inline int add_to_tile(const burnish_bins *bins, burnish_bin_slice *slice, size_t block,
                              const burnish_batch_header *head, uint32_t tile, unsigned lanes) {
    const int column = (int)(tile & 0xffff), row = (int)(tile >> 16);
    if (row < bins->first_row || row >= bins->end_row) {
        return 1;
    }
    const size_t number = (size_t)((row - bins->first_row) * bins->columns + column);
    burnish_tile_list *chains = &slice->chains[2 * number];
    const unsigned front = head->lanes[0] & lanes, back = head->lanes[1] & lanes;
    return (!front || add_lanes(slice, chains, block, front)) &&
           (!back || add_lanes(slice, chains + 1, block, back));
}

/* The triangles of a block into the lists of all tiles of the band that they touch; 0 when there is
 * no room. */
static int add_block(const burnish_bins *bins, burnish_bin_slice *slice,
                     const burnish_triangle_batch *from, const burnish_batch_header *head,
                     size_t block) {
    unsigned rest = head->lanes[0] | head->lanes[1];
    unsigned alone = rest & ~find_apart(from); /* touch one tile each */
    rest &= ~alone;
    while (alone) {
        const uint32_t tile = from->first[__builtin_ctz(alone)] & BURNISH_TILE_BITS;
        const unsigned lanes = alone & ~find_elsewhere(from, tile);
        if (!add_to_tile(bins, slice, block, head, tile / BURNISH_HIZ_SIZE, lanes)) {
            return 0;
        }
        alone &= ~lanes;
    }
    for (; rest; rest &= rest - 1) {
        const unsigned lane = (unsigned)__builtin_ctz(rest);
        if (!add_triangle(bins, slice, block, burnish_tile_box_of(from, lane), lane,
                          head->lanes[1] >> lane & 1)) {
            return 0;
        }
    }
    return 1;
}

static void list_blocks(const burnish_bins *bins, burnish_bin_slice *slice,
                        const burnish_geometry *geometry, size_t first, size_t end, size_t limit) {
    int added = 1;
    for (size_t i = first; i < end && added && slice->piece_count <= limit; ++i) {
        const burnish_batch_header *head = &geometry->headers[i];
        added = head->tile != BURNISH_NO_TILE /* as small triangles mostly do */
                    ? add_to_tile(bins, slice, i, head, head->tile, ALL_OF_BLOCK)
                    : add_block(bins, slice, &geometry->batches[i], head, i);
    }
}
