/* Whether options and targets can be drawn. */
#ifndef BURNISH_RENDER_OPTIONS_H
#define BURNISH_RENDER_OPTIONS_H

#include "burnish/render.h"

/* Errors: ARGUMENT. */
burnish_status burnish_render_options_check(const burnish_render_options *options,
                                            burnish_error *error);

/* Whether a target fits checked options. Errors: ARGUMENT. */
burnish_status burnish_target_check(const burnish_target *target,
                                    const burnish_render_options *options, burnish_error *error);

#endif
