/* Overlays of the window: panels of text, the divider between two pictures, and the map of their
 * differences. Windows have BGRA pixels. */
#ifndef TOOL_VIEW_PAINT_H
#define TOOL_VIEW_PAINT_H

#include "burnish/image.h"

/* The position of a panel: one of its corners or its middle is at a point. */
typedef enum view_anchor {
    VIEW_TOP_LEFT,
    VIEW_TOP_RIGHT,
    VIEW_BOTTOM_LEFT,
    VIEW_BOTTOM_RIGHT,
    VIEW_BOTTOM_MIDDLE
} view_anchor;

/* Lines of text on a light panel at (x, y). If is_title is 1, the first is dark and others are
 * grey. */
void view_paint_panel(const burnish_pixels *window, view_anchor anchor, int x, int y,
                      const char *text, int is_title);

/* The help, in the middle of the window. */
void view_paint_help(const burnish_pixels *window);

/* The line between two pictures, at column x, and its handle. */
void view_paint_divider(const burnish_pixels *window, int x);

/* The legend of differences up to `end` of 255, at the bottom, with a title. */
void view_paint_scale(const burnish_pixels *window, int end, const char *title);

/* The differences of two pictures. */
typedef struct view_difference {
    int largest;   /* codes */
    double rmse;   /* over all channels of all pixels */
    size_t pixels; /* that differ */
} view_difference;

/* Paints b - a of each pixel, in the channel with the largest difference, into `map`; equal pixels
 * show the object faintly. *end receives the ends of the scale. */
view_difference view_paint_differences(const burnish_pixels *a, const burnish_pixels *b,
                                       const burnish_pixels *map, int *end);

#endif
