/* Before, after and their difference side by side, with a legend. */
#ifndef TOOL_PICTURE_PANELS_H
#define TOOL_PICTURE_PANELS_H

#include "burnish/compare.h"
#include "picture/formats.h"

typedef struct picture_panels {
    const burnish_image *pictures[2]; /* of one size */
    const char *labels[2];
    const burnish_comparison *numbers;
    const float *flip_map; /* FLIP of each pixel, shown instead of differences of codes; or NULL */
} picture_panels;

/* Composes a new picture and writes its file. Small pictures are enlarged by a whole factor; wide
 * panels are stacked. Errors: LIMIT (too large a picture), MEMORY; as for picture_encode and
 * writing. */
burnish_status picture_write_panels(const picture_panels *panels, const char *path,
                                    picture_format format, const picture_options *options,
                                    burnish_error *error);

#endif
