/* A texture and its smaller levels, each half as wide and high as the one before, as the sampling
 * kernel reads them. */
#ifndef BURNISH_RENDER_TEXTURE_TEXTURE_LEVELS_H
#define BURNISH_RENDER_TEXTURE_TEXTURE_LEVELS_H

#include <stdatomic.h>
#include <stdint.h>

#include "base/memory.h"
#include "burnish/mesh.h"
#include "core/tasks.h"

enum { BURNISH_TEXTURE_LEVELS_MAX = 16 }; /* more than log2(BURNISH_TEXTURE_SIZE_MAX) + 1 */

enum { BURNISH_TEXTURE_PAD = 2 }; /* codes are read by four texels */

/* How texels are averaged. */
typedef enum burnish_texture_kind {
    BURNISH_TEXTURE_NUMBERS,  /* of codes */
    BURNISH_TEXTURE_COLORS,   /* of linear light */
    BURNISH_TEXTURE_WEIGHTED, /* of linear light weighted by alpha: what can't be seen leaves no
                                 halo */
    BURNISH_TEXTURE_MASKED,   /* the same, but alpha is how much of the area a mask leaves */
    BURNISH_TEXTURE_NORMALS,  /* of unit vectors: direction, and 1 - sqrt(1 - length) as alpha */
    BURNISH_TEXTURE_KIND_COUNT
} burnish_texture_kind;

/* Whether colours are weighted by alpha. */
static inline int burnish_texture_is_weighted(burnish_texture_kind kind) {
    return kind == BURNISH_TEXTURE_WEIGHTED || kind == BURNISH_TEXTURE_MASKED;
}

enum { BURNISH_TEXEL_ONE = 65535 }; /* what 1 is in 16 bits */

/* Level 0 of a texture takes most of the memory. It is built on demand, in blocks: a picture shows
 * only some of it, or none at a reduced size. Sides of blocks are powers of two, in texels. */
enum { BURNISH_TEXTURE_BLOCKS = 64 }; /* along a side, at most */
typedef struct burnish_texture_blocks {
    const burnish_texture *texture; /* of the mesh that is drawn */
    int is_normals;
    int column_bits, row_bits; /* logarithms of a block's width and height */
    int rows;                  /* of blocks */
    uint64_t all;              /* bit i: column i */
    _Atomic int missing;       /* blocks */
    /* Of each row of blocks: taken by the thread that makes it, made. */
    _Atomic uint64_t taken[BURNISH_TEXTURE_BLOCKS], ready[BURNISH_TEXTURE_BLOCKS];
    uint16_t light[256]; /* of codes */
} burnish_texture_blocks;

/* Texels of level 0 from the first to the last one, both included; empty where first[0] > last[0].
 * Columns go to the width, rows to the height. */
typedef struct burnish_texture_box {
    int32_t first[2], last[2]; /* column, row */
} burnish_texture_box;

/* All zero: none. Owned. */
typedef struct burnish_texture_levels {
    /* All levels, one after another, rows from the top; r, g, b, a. Colours are linear light, which
     * 16 bits hold to a twentieth of a step of sRGB's codes; others are codes, and have no texels.
     * A row ends with its first texel again, so that two neighbours lie together whatever the wrap,
     * and a level with its first row. */
    uint16_t *texels;
    uint8_t *codes;
    burnish_texture_blocks *blocks; /* NULL: level 0 is there */
    /* Of each level, in texels; items from count on repeat the last level. A row has width + 1. */
    int32_t offset[BURNISH_TEXTURE_LEVELS_MAX];
    int32_t width[BURNISH_TEXTURE_LEVELS_MAX], height[BURNISH_TEXTURE_LEVELS_MAX];
    int count;
    int is_weighted;  /* 1: colours are multiplied by alpha, which is below 1 somewhere */
    uint8_t least[4]; /* code of each channel in level 0 */
    float cutoff;     /* MASKED: alpha of level 0 from which on the mask leaves something */
    int is_taken;     /* MASKED: 1: a material of this frame has this cutoff */
} burnish_texture_levels;

/* A texel is the mean of the area that it covers in the level before, of any size.
 *   levels->cutoff  of kind MASKED: set before
 * Errors: MEMORY, CANCELLED; destroy it all the same. */
burnish_status burnish_texture_levels_create(burnish_texture_levels *levels,
                                             const burnish_texture *texture,
                                             burnish_texture_kind kind, burnish_tasks *tasks,
                                             burnish_memory *memory);
/* Makes sure that texels of level 0 are there, for any thread: those at some indices, which may be
 * of other levels too, and their neighbours on the right, below, and between these.
 *   box  contains them; nothing is done if all of it is there */
void burnish_texture_levels_need(const burnish_texture_levels *levels,
                                 const burnish_texture_box *box, const int32_t *indices,
                                 size_t count);
/* All of them. */
void burnish_texture_levels_need_all(const burnish_texture_levels *levels, burnish_tasks *tasks);
/* Whether some are there. */
int burnish_texture_levels_has_some(const burnish_texture_levels *levels);

void burnish_texture_levels_destroy(burnish_texture_levels *levels, const burnish_context *context);

#endif
