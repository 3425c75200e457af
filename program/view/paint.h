/* What lies over the picture in the window: panels of text, what divides two pictures, the map of
 * their differences. Windows have pixels of BGRA. */
#ifndef TOOL_VIEW_PAINT_H
#define TOOL_VIEW_PAINT_H

#include "burnish/image.h"

/* Where a panel hangs: at a corner or the middle of a point. */
typedef enum view_anchor {
    VIEW_TOP_LEFT,
    VIEW_TOP_RIGHT,
    VIEW_BOTTOM_LEFT,
    VIEW_BOTTOM_RIGHT,
    VIEW_BOTTOM_MIDDLE
} view_anchor;

/* Lines of text on a light panel at (x, y); the first in dark, others in grey where is_title is 1.
 */
void view_paint_panel(const burnish_pixels *window, view_anchor anchor, int x, int y,
                      const char *text, int is_title);

/* All keys, in the middle of the window. */
void view_paint_help(const burnish_pixels *window);

/* The line between two pictures, at column x, and its handle. */
void view_paint_divider(const burnish_pixels *window, int x);

/* The colours of differences up to `end` codes, at the bottom; `title` above them. */
void view_paint_scale(const burnish_pixels *window, int end, const char *title);

/* How two pictures differ. */
typedef struct view_difference {
    int largest;       /* codes */
    double mean, rmse; /* over all channels of all pixels; of those that either */
    size_t pixels;     /* that differ */
} view_difference;

/* Of each pixel b - a, in the channel where it is largest, into `map`; what is equal shows the
 * object faintly. Returns what stands for the ends of the scale in *end. */
view_difference view_paint_differences(const burnish_pixels *a, const burnish_pixels *b,
                                       const burnish_pixels *map, int *end);

#endif
