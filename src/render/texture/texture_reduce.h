/* A level of a texture from the one before. */
#ifndef BURNISH_RENDER_TEXTURE_TEXTURE_REDUCE_H
#define BURNISH_RENDER_TEXTURE_TEXTURE_REDUCE_H

#include "render/texture/texture_levels.h"

/* From one level to the next, both codes; rows of `to` are burnish_texture_row_size apart. */
typedef struct burnish_texture_step {
    const uint8_t *from;
    size_t from_row; /* bytes */
    uint8_t *to;
    int from_width, from_height, to_width, to_height;
    int is_image; /* 1: from is the image; its normals are not unit vectors yet, sides are halved */
    burnish_texture_kind kind;
} burnish_texture_step;

/* Bytes of a row of codes. */
static inline size_t burnish_texture_row_size(int width) {
    return 4 * ((size_t)width + 1);
}

/* Rows of `width` texels that are worth a task. */
static inline size_t burnish_texture_row_grain(int width) {
    return 1 + 16384 / (size_t)width;
}

/* Whether four texels make one, as nearly always. */
static inline int burnish_texture_is_halved(const burnish_texture_step *step) {
    return step->from_width == 2 * step->to_width && step->from_height == 2 * step->to_height;
}

void burnish_texture_reduce(burnish_texture_step *step, burnish_tasks *tasks);

/* Turns an image's normals into codes of unit vectors, whatever its alpha is.
 *   count  [0, BURNISH_TEXTURE_NORMALS_MAX] */
enum { BURNISH_TEXTURE_NORMALS_MAX = 64 };
void burnish_texture_unit_normals(uint8_t *texels, int count);

#endif
