/* What other files read of the table of flags. */
#ifndef TOOL_RENDER_FLAGS_H
#define TOOL_RENDER_FLAGS_H

#include "cli/options.h"

extern const cli_word render_look_words[]; /* burnish_look */

/* Names of flags of a picture, for commands that draw as this one does: flags of its topics
 * picture, files and report that belong neither to a file nor to a limit. */
#define RENDER_PICTURE_FLAGS                                                                       \
    "cull-back-faces,samples,background-color,no-background,views,annotate,columns,labels,"        \
    "no-labels,quality,dpi,input-format,clip,crease-angle,tessellation,animation-time,animation,"  \
    "point-size,strict,no-textures,no-libraries,fail-on-blank"

#endif
