/* Options of a frame, and whether they can be drawn. */
#ifndef BURNISH_RENDER_FRAME_RENDER_OPTIONS_H
#define BURNISH_RENDER_FRAME_RENDER_OPTIONS_H

#include "base/error.h"
#include "burnish/look.h"
#include "burnish/render.h"

/* ARGUMENT unless burnish_render_options_default() made them. */
burnish_status burnish_render_options_check_cookie(const burnish_render_options *options,
                                                   burnish_error *error);

/* ARGUMENT, with what is wrong, for options that can't be drawn. */
burnish_status burnish_render_options_check(const burnish_render_options *options,
                                            burnish_error *error);

/* Checked options whose BURNISH_EDGES_AXIS_VIEWS has become what it means for their camera. */
burnish_render_options burnish_render_options_resolve(const burnish_render_options *options);

/* The rows of the picture that are drawn: [first, end). */
typedef struct burnish_row_range {
    int first, end;
} burnish_row_range;

static inline burnish_row_range burnish_drawn_rows(const burnish_render_options *options) {
    const int count = options->row_count ? options->row_count : options->height;
    return (burnish_row_range){options->first_row, options->first_row + count};
}

/* ---- look.c ---- */

/* What the look, one of the list, says of options. */
void burnish_look_apply(burnish_look look, burnish_render_options *options);

#endif
