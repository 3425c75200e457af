/* Encodes NumPy's array format. */
#ifndef TOOL_PICTURE_NPY_H
#define TOOL_PICTURE_NPY_H

#include "picture/formats.h"

typedef enum picture_kind { PICTURE_FLOAT, PICTURE_INT, PICTURE_BYTE } picture_kind;

/* Contiguous rows of items with `channels` numbers each. With one channel the array has two axes,
 * else three. */
typedef struct picture_array {
    picture_kind kind;
    int width, height, channels;
    const void *values;
} picture_array;

/* Errors: MEMORY. */
burnish_status picture_encode_npy(const picture_array *array, picture_file *file,
                                  burnish_error *error);

#endif
