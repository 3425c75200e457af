/* Looks: sets of options by name. */
#ifndef BURNISH_RENDER_FRAME_LOOK_H
#define BURNISH_RENDER_FRAME_LOOK_H

#include "burnish/look.h"

/* What the look, one of the list, says of options. */
void burnish_look_apply(burnish_look look, burnish_render_options *options);

#endif
