/* The steps that lines.c calls. */
#ifndef BURNISH_RENDER_LINES_LINES_STEPS_H
#define BURNISH_RENDER_LINES_LINES_STEPS_H

#include "core/vec3.h"
#include "render/lines/lines.h"

static inline double burnish_line_length(const burnish_line_segment *s) {
    const double dx = (double)s->x[1] - (double)s->x[0], dy = (double)s->y[1] - (double)s->y[0];
    return burnish_sqrt(dx * dx + dy * dy);
}

/* ---- lines_projection.c: from the mesh's space to the screen, in double precision ---- */

typedef struct burnish_line_projection {
    double rows[4][4];
    burnish_vec3 origin;
    double middle[2], size[2]; /* pixels */
    burnish_view_distance distance;
    int is_parallel;
    burnish_vec3 viewer; /* position, or in parallel projection the direction toward it */
} burnish_line_projection;

typedef struct burnish_clip_point {
    double x, y, z, w;
} burnish_clip_point;

burnish_line_projection burnish_line_project_view(const burnish_line_view *view,
                                                  const burnish_render_options *options);

burnish_clip_point burnish_line_project(const burnish_line_projection *p, burnish_vec3 position);

/* What is linear along a line on the screen at a point; see burnish_line_segment.key. */
double burnish_line_key(const burnish_line_projection *p, burnish_clip_point c);

/* ---- lines_seen.c: what is seen of a chain of segments ---- */

/* Of the width of outlines: hidden lines, axes and tangent edges (ISO 128-2). */
#define BURNISH_LINE_NARROW 0.5

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

/* ---- lines_loose.c ---- */

/* Lengths in pixels below which lines are noise. Sets of lines that meet count together; they stay
 * if the background begins at one of them. */
typedef struct burnish_line_limits {
    float tick;    /* of one line with a loose end, unless the background begins there */
    float least;   /* of a set */
    float set;     /* of a set with a loose end */
    float fold;    /* of a set without features and closed lines */
    float outline; /* the width of outlines; features have thinner lines */
} burnish_line_limits;

/* Drops lines that are noise. Errors: memory->status; the lines are then as before. */
void burnish_line_art_drop_loose(burnish_line_art *art, const burnish_line_limits *limits,
                                 burnish_memory *memory);

/* ---- lines_centers.c ---- */

/* Appends the axes of the mesh's circles: chain lines along them, crosses where they are seen along
 * the view. Those of hidden circles only together with hidden lines. Errors: memory->status. */
void burnish_line_art_add_centers(burnish_line_art *art, const burnish_mesh_view *mesh,
                                  const burnish_line_scene *scene,
                                  const burnish_line_projection *projection,
                                  const burnish_render_options *options, burnish_memory *memory);

#endif
