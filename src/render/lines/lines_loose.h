/* Loose ends of lines. */
#ifndef BURNISH_RENDER_LINES_LINES_LOOSE_H
#define BURNISH_RENDER_LINES_LINES_LOOSE_H

#include "render/lines/lines.h"

/* Lengths in pixels below which lines are noise. Sets of lines that meet count together; they stay
 * if the background begins at one of them. */
typedef struct burnish_line_limits {
    float tick;    /* of one line with a loose end, unless the background begins there */
    float least;   /* of a set */
    float set;     /* of a set with a loose end */
    float fold;    /* of a set without features and closed lines */
    float outline; /* the width of outlines; features have thinner lines */
} burnish_line_limits;

/* Drops lines that are noise. Errors: memory->status; the lines are then as before. */
void burnish_line_art_drop_loose(burnish_line_art *art, const burnish_line_limits *limits,
                                 burnish_memory *memory);

#endif
