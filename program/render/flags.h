/* The command `burnish render`: what other files use of it. */
#ifndef TOOL_RENDER_FLAGS_H
#define TOOL_RENDER_FLAGS_H

#include "base/cli/options.h"

/* Picture flags for other commands that draw: the flags of the topics picture, files and report
 * that do not name a file or set a limit. */
#define RENDER_PICTURE_FLAGS                                                                       \
    "width,height,cull-back-faces,samples,background-color,no-background,views,annotate,columns,"  \
    "labels,no-labels,quality,dpi,input-format,clip,color-by,color-map,color-range,no-legend,"     \
    "normals,crease-angle,tessellation,animation-time,animation,point-size,strict,no-textures,"    \
    "no-libraries,fail-on-blank"

/* Sections of the man page. */
extern const cli_section render_sections[];

#endif
