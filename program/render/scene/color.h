/* `burnish render --color-by`: colours by values. */
#ifndef TOOL_RENDER_SCENE_COLOR_H
#define TOOL_RENDER_SCENE_COLOR_H

#include "render/settings/settings.h"

/* Width of the legend, in parts of the smaller side of the image. */
#define RENDER_LEGEND_INSET 0.17

/* 1: by a property of the input, which the reader must keep. */
int render_colors_by_property(const render_coloring *coloring);

/* 1: by part or filament, whose legend has names. */
/* "part" or "feature", and these, "filament" or "tool". */
int render_names_parts(const render_coloring *coloring);
int render_colors_by_part(const render_coloring *coloring);

/* Colours the mesh, if asked for; range receives its values. Errors: ARGUMENT, MEMORY. */
burnish_status render_color(const render_settings *settings, burnish_mesh *mesh, double range[2],
                            burnish_error *error);

/* 1: colours have a legend; normals have none. */
int render_has_legend(const render_coloring *coloring);

/* The room that the legend takes on the right, as in burnish_framing.inset. */
double render_legend_inset(const render_settings *settings);

#endif
