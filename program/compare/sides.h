/* The two sides of a comparison, and its report. */
#ifndef TOOL_COMPARE_SIDES_H
#define TOOL_COMPARE_SIDES_H

#include "picture/verdict.h"
#include "render/output/result.h"

typedef struct compare_settings {
    render_settings render; /* first: its flags are shared */
    int size[2];            /* 0: not given */
    picture_rule rule;
    int map;   /* compare_map */
    int align; /* 1: the middle of B's box is moved to that of A's */
    const char *output;
    int format; /* picture_format of the output */
    const char *json;
    cli_given given; /* flags of the command line that render does not have */
} compare_settings;

typedef enum compare_map { COMPARE_CODES, COMPARE_FLIP } compare_map;

/* One side of a comparison: a picture, or a mesh that is drawn. */
typedef struct compare_side {
    const char *input;
    char label[160];          /* below its panel */
    burnish_image picture;    /* empty for a mesh */
    render_settings settings; /* of a mesh: the flags, its input and one lobe */
    burnish_render_options options;
    render_result result;
    render_cell cell;
    uint8_t *coverage;   /* of the mesh's picture */
    burnish_mesh *owned; /* NULL if the other side has the mesh */
} compare_side;

typedef struct comparison {
    const compare_settings *settings;
    compare_side sides[2];
    int lobes;                      /* 1: one mesh with two lobes */
    double moved[3];                /* what --align added to B's coordinates */
    render_environment environment; /* of both */
    picture_verdict verdict;
    float *flip_map; /* NULL: not wanted */
} comparison;

/* The picture of a side. */
static inline const burnish_image *compare_image(const compare_side *side) {
    return side->picture.pixels ? &side->picture : &side->cell.image;
}
static inline int compare_is_mesh(const compare_side *side) {
    return side->result.mesh != NULL;
}

/* Reads both inputs and draws meshes, with one camera that frames all of them. */
burnish_status compare_draw_sides(comparison *c, burnish_error *error);
void compare_release_sides(comparison *c);

/* Writes text, or JSON to the file of --json. */
burnish_status compare_write_report(const comparison *c, burnish_error *error);

#endif
