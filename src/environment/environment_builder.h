/* An environment whose pixels arrive one by one. */
#ifndef BURNISH_ENVIRONMENT_ENVIRONMENT_BUILDER_H
#define BURNISH_ENVIRONMENT_ENVIRONMENT_BUILDER_H

#include "environment/environment.h"

/* How a row or column of a given image is shared out to those of the first level. */
typedef struct burnish_environment_share {
    int first, count; /* [1, 3] */
    double weights[3];
} burnish_environment_share;

typedef struct burnish_environment_builder {
    burnish_memory *memory;
    const char *name; /* for messages */
    int width, height;
    int to_width, to_height; /* of the first level */
    burnish_environment_share *columns, *rows;
    double *sums;   /* red, green, blue of each texel */
    size_t clamped; /* how many values were out of range */
} burnish_environment_builder;

/* width, height: of the given image, checked here. Errors: LIMIT, FORMAT, MEMORY; then end with
 * burnish_environment_builder_cancel(). */
burnish_status burnish_environment_builder_begin(burnish_environment_builder *builder,
                                                 uint64_t width, uint64_t height, const char *name,
                                                 burnish_memory *memory);

/* Adds a pixel of the given image. Each must come once, in a fixed order. */
void burnish_environment_builder_add(burnish_environment_builder *builder, int x, int y,
                                     const float rgb[3]);

/* Releases the builder; *environment: NULL on error. Errors: MEMORY. */
burnish_status burnish_environment_builder_end(burnish_environment_builder *builder,
                                               burnish_environment **environment);
void burnish_environment_builder_cancel(burnish_environment_builder *builder);

#endif
