/* Annotations within the library: a view of the mesh's box, and the list of lines and labels that
 * are laid out before anything is drawn. */
#ifndef BURNISH_ANNOTATE_ANNOTATE_H
#define BURNISH_ANNOTATE_ANNOTATE_H

#include "base/memory.h"
#include "burnish/annotate.h"
#include "core/vec3.h"
#include "image/text/strokes.h"

/* Pixels from the top left corner of the picture. */
typedef struct burnish_point {
    double x, y;
} burnish_point;

typedef struct burnish_area {
    double left, top, right, bottom;
} burnish_area;

/* What burnish_area_widen() starts from. */
#define BURNISH_AREA_NONE                                                                          \
    { 1e300, 1e300, -1e300, -1e300 }

/* ---- The view ---- */

typedef struct burnish_annotation_view {
    burnish_vec3 eye, right, up, forward;
    int parallel;
    double pixels; /* per unit; in perspective per unit at distance 1 */
    double width, height;
    burnish_vec3 low, high; /* of the bounding box */
    double origin[3];       /* of the mesh's coordinates, in the file's */
    double diagonal;
    int up_axis;              /* 0, 1, 2 */
    int up_negative;          /* 1: the ground's normal points down that axis */
    double text;              /* height of a capital, whole pixels */
    double line;              /* width of a line, whole pixels */
    burnish_point corners[8]; /* of the box on the screen; bit a of the index: high in axis a */
    uint32_t lengths;         /* of the axes that are measured: bit a for axis a */
    int corners_seen;         /* 1: all are in front of the camera */
    burnish_area box;         /* that they span */
    burnish_point hull[8];    /* convex hull of the corners */
    int hull_count;
    burnish_clip_plane section;
    const burnish_mesh_view *mesh;
    const float *depth; /* distances that hide; NULL: nothing does */
    size_t depth_stride;
    const uint32_t *triangles; /* ids; NULL: no balloons */
    const burnish_part *parts;
    burnish_callouts *callouts; /* NULL: there are none */
} burnish_annotation_view;

/* Errors: ARGUMENT (a camera that looks nowhere). */
burnish_status burnish_annotation_view_make(const burnish_mesh *mesh,
                                            const burnish_annotate_options *annotations,
                                            const burnish_camera *camera, int width, int height,
                                            burnish_annotation_view *view, burnish_error *error);

/* Fills view->callouts. Errors: the memory's. */
void burnish_list_parts(const burnish_mesh *mesh, const burnish_annotation_view *view,
                        burnish_memory *memory);

/* 1: two triangles belong to one part, and an edge between them would be soft, or both are none. */
int burnish_is_one_face(const burnish_annotation_view *view, uint32_t a, uint32_t b);

/* The position of a point on the screen, and its distance along the camera's axis, which in
 * perspective must be above 0. */
burnish_point burnish_annotation_project(const burnish_annotation_view *view, burnish_vec3 p,
                                         double *distance);

/* The axes by decreasing keys. */
void burnish_order_axes(const double keys[3], int order[3]);

/* The corner of the bounding box whose bits say where it is high. */
burnish_vec3 burnish_annotation_corner(const burnish_annotation_view *view, int bits);

/* 1: the area touches the convex hull of the box on the screen. */
int burnish_annotation_hits_hull(const burnish_annotation_view *view, const burnish_area *area);

/* 1: the segment touches the area. */
int burnish_segment_hits(burnish_point a, burnish_point b, const burnish_area *area);

static inline double burnish_cross_of_points(burnish_point o, burnish_point a, burnish_point b) {
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

int burnish_areas_touch(const burnish_area *a, const burnish_area *b);

static inline double burnish_axis(burnish_vec3 v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/* ---- The list ---- */

/* What is drawn in one colour and way. */
typedef enum burnish_annotation_layer {
    BURNISH_LAYER_GRID,
    BURNISH_LAYER_HIDDEN, /* edges behind the object */
    BURNISH_LAYER_BOX,
    BURNISH_LAYER_LINES, /* what a rim keeps clear of the layers before: dimensions, scale */
    BURNISH_LAYER_AXIS,  /* X; Y and Z follow */
    BURNISH_LAYER_COUNT = BURNISH_LAYER_AXIS + 3
} burnish_annotation_layer;

typedef struct burnish_annotation_line {
    burnish_stroke stroke;
    burnish_annotation_layer layer;
} burnish_annotation_line;

enum { BURNISH_LABEL_SIZE = BURNISH_NAME_SIZE };

typedef struct burnish_annotation_label {
    char text[BURNISH_LABEL_SIZE];
    double x, baseline; /* whole pixels */
    double height;      /* of a capital */
    burnish_area area;  /* of the ink */
    burnish_annotation_layer layer;
    int is_turned; /* 1: it reads upward, turned about the middle of its area */
} burnish_annotation_label;

typedef struct burnish_annotation_list {
    burnish_annotation_line *lines;
    size_t line_count, line_capacity;
    burnish_annotation_label *labels;
    size_t label_count, label_capacity;
    burnish_area marks[4]; /* what corners hold, and the parts list */
    size_t mark_count;
    int bounded;     /* 1: nothing may exceed the image; 0: framing measures the room needed */
    size_t left_out; /* labels without room */
    size_t crowded;  /* marks that found no corner free of the object */
    burnish_memory *memory;
} burnish_annotation_list;

void burnish_annotation_add_line(burnish_annotation_list *list, burnish_point a, burnish_point b,
                                 double width, burnish_annotation_layer layer);

void burnish_annotation_add_label(burnish_annotation_list *list,
                                  const burnish_annotation_label *label);

void burnish_annotation_release(burnish_annotation_list *list);

/* A slim filled triangle: a fan of lines from its tip, which direction d leads away from. */
#define BURNISH_ARROW_LENGTH 0.9 /* of the height of a capital */
void burnish_annotation_add_arrow(const burnish_annotation_view *view, burnish_point tip,
                                  burnish_point d, burnish_annotation_list *list);

/* Adds the lines and labels of another list, moved. */
void burnish_annotation_take(burnish_annotation_list *list, const burnish_annotation_list *made,
                             burnish_point by);

void burnish_area_widen(burnish_area *all, burnish_area area);

/* An area widened by lines, with or without their width, and labels. */
burnish_area burnish_annotation_bounds(const burnish_annotation_list *list, burnish_area area,
                                       int with_width);

static inline burnish_point burnish_moved_along(burnish_point p, burnish_point d, double by) {
    return (burnish_point){p.x + d.x * by, p.y + d.y * by};
}

/* A label with its middle at a point, before it is taken into the list. */
burnish_annotation_label burnish_annotation_label_at(const burnish_annotation_view *view,
                                                     const char *text, burnish_point middle,
                                                     burnish_annotation_layer layer);

/* An area with `pixels` more on each side. */
static inline burnish_area burnish_area_grown(burnish_area area, double pixels) {
    return (burnish_area){area.left - pixels, area.top - pixels, area.right + pixels,
                          area.bottom + pixels};
}

/* 1: the segment is closer to a label than that. */
int burnish_annotation_hits_label(const burnish_annotation_list *list, burnish_point a,
                                  burnish_point b, double clear);

/* 1: the area is in the picture, with a pixel of room. */
int burnish_annotation_is_within(const burnish_annotation_view *view, const burnish_area *area);

static inline burnish_area burnish_area_moved(burnish_area area, burnish_point by) {
    return (burnish_area){area.left + by.x, area.top + by.y, area.right + by.x, area.bottom + by.y};
}

/* The nearest whole number. From 2^52 on all are whole; a camera within the object sees as far. */
double burnish_whole_pixel(double value);

/* 1: no label, mark or line of the list touches the area. */
int burnish_annotation_is_free(const burnish_annotation_list *list, const burnish_area *area);

/* ---- What is laid out; each appends to the list ---- */

void burnish_annotate_dimensions(const burnish_annotation_view *view,
                                 burnish_annotation_list *list);

/* Of the circle through the outermost vertices about a coordinate axis, if each sixteenth of it has
 * one; else 0. */
double burnish_annotation_diameter(const burnish_annotation_view *view, int axis);

/* Axes, scale bar and the grid's spacing, in corners that nothing else holds. */
void burnish_annotate_marks(const burnish_annotation_view *view, burnish_annotation_flags kinds,
                            burnish_annotation_list *list);

/* The parts list along the right edge, or, if nothing is bounded, the room of it and balloons. */
void burnish_annotate_parts_list(const burnish_annotation_view *view,
                                 burnish_annotation_list *list);

/* Balloons around the object, with leaders to their parts that do not cross. */
void burnish_annotate_balloons(const burnish_annotation_view *view, burnish_annotation_list *list);

/* The arrows and letters of the section's plane, or its name. Later attempts, from 0, have longer
 * arrows, so the letters leave room for dimensions. */
void burnish_annotate_section(const burnish_annotation_view *view, int attempt,
                              burnish_annotation_list *list);

void burnish_annotate_holes(const burnish_annotation_view *view, burnish_annotation_list *list);

/* 1: one of the pixels around a point shows nothing in front of it. Lines on the outline of the
 * object stay whole. */
int burnish_annotation_is_seen(const burnish_annotation_view *view, burnish_point p,
                               double distance);

void burnish_annotate_box(const burnish_annotation_view *view, burnish_annotation_list *list);
void burnish_annotate_grid(const burnish_annotation_view *view, burnish_annotation_list *list);

/* ---- Numbers ---- */

/* 1, 2 or 5 times a power of 10. */
typedef struct burnish_round_number {
    int digit, exponent;
    double value; /* the nearest double to digit * 10^exponent */
} burnish_round_number;

/* The largest that is at most limit, or the smallest that is at least limit; limit in
 * [1e-300, 1e300]. */
burnish_round_number burnish_round_number_below(double limit);
burnish_round_number burnish_round_number_above(double limit);

/* A length >= 0 with four significant digits, more for larger integers, without trailing zeros:
 * "0.125", "12.5", "123456", "1.235e+09". The locale has no influence. */
void burnish_number_text(double value, char text[BURNISH_LABEL_SIZE]);

/* Lines of the ground's grid: spacing, and the first and last of each of its two axes in spacings
 * from 0. */
typedef struct burnish_annotation_grid {
    burnish_round_number spacing;
    int axis[2];
    double first[2], last[2]; /* whole numbers */
    double offset[2];         /* of line 0, below a spacing: lines are round in the file's
                                 coordinates */
    int is_there;             /* 0: too far from the origin for lines that can be told apart */
} burnish_annotation_grid;

burnish_annotation_grid burnish_annotation_grid_of(const burnish_annotation_view *view);

/* Lays out all requested kinds in one list; release it. */
burnish_status burnish_annotation_lay_out(const burnish_annotation_view *view,
                                          burnish_annotation_flags kinds, int bounded,
                                          burnish_memory *memory, burnish_annotation_list *list);

#endif
