/* Parts of the table of flags that other files use. */
#ifndef TOOL_RENDER_FLAGS_H
#define TOOL_RENDER_FLAGS_H

#include "burnish/look.h"
#include "cli/options.h"

extern const cli_word render_look_words[]; /* burnish_look */

/* Picture flags for other commands that draw: the flags of the topics picture, files and report
 * that do not name a file or set a limit. */
#define RENDER_PICTURE_FLAGS                                                                       \
    "width,height,cull-back-faces,samples,background-color,no-background,views,annotate,columns,"  \
    "labels,"                                                                                      \
    "no-labels,quality,dpi,input-format,clip,crease-angle,tessellation,animation-time,animation,"  \
    "point-size,strict,no-textures,no-libraries,fail-on-blank"

#endif
