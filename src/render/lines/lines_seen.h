/* What is seen of a chain of segments. */
#ifndef BURNISH_RENDER_LINES_LINES_SEEN_H
#define BURNISH_RENDER_LINES_LINES_SEEN_H

#include "render/lines/lines.h"

/* The frame that samples are compared with. */
typedef struct burnish_line_scene {
    const burnish_target *target; /* its depth and triangles */
    const int8_t *facing;         /* of triangles */
    int cap_facing; /* of triangles that are seen from inside, where a cap is drawn; 0: no caps */
    int width, height;
    int is_parallel;
    double footprint;      /* a pixel's width in the mesh's units: at distance 1, or everywhere */
    double outline, inner; /* widths of lines */
    int keeps_all;         /* 1: short pieces, too */
    double hidden_fold;    /* pixels: shorter hidden silhouettes are not drawn */
    uint32_t *taken; /* of each pixel: whether a line is drawn there; NULL: trace visible lines */
    uint32_t taken_count; /* hidden samples so far */
} burnish_line_scene;

/* Marks lines in the map of taken pixels, which is zeroed and then hides other lines. */
void burnish_line_scene_take(burnish_line_scene *scene, const burnish_lines *lines);

/* Appends what is seen of a chain to the lines; with scene->taken dashes of what is not seen.
 *   chain  2 * segment + 1 where it is walked backward
 * Errors: memory->status. */
void burnish_line_art_trace(burnish_line_art *art, burnish_line_scene *scene, const uint32_t *chain,
                            size_t count, burnish_memory *memory);

/* Appends a straight line from x, y to x, y. Errors: memory->status. */
void burnish_line_art_add(burnish_line_art *art, const double from[2], const double to[2],
                          double width, burnish_memory *memory);

/* 1: the surface is seen within a few pixels of depth of a distance at a position on the screen. */
int burnish_line_scene_shows(const burnish_line_scene *scene, double x, double y, double distance);

#endif
