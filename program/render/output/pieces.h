/* Pieces of an output, drawn by several processes: frames of a turntable or bands of a picture. The
 * processes have the same command line and are connected by sockets (docs/scale.md). */
#ifndef TOOL_RENDER_PIECES_H
#define TOOL_RENDER_PIECES_H

#include "base/cli/options.h"
#include "burnish/image.h"

enum { RENDER_PIECE_NOTES = 3 };

/* Draws a piece into the image, and writes its notes. */
typedef burnish_status render_piece_drawer(void *context, int piece, burnish_error *error);

typedef struct render_pieces_plan {
    int runners;                /* sockets, from descriptor 3 on */
    int count;                  /* pieces */
    size_t triangles, vertices; /* of the mesh, the same in all processes */
    const burnish_image *image; /* the drawer's target, whose size is already known */
    uint64_t *notes; /* RENDER_PIECE_NOTES numbers that accompany the pixels; NULL: none */
    render_piece_drawer *draw;
    void *context;
} render_pieces_plan;

typedef struct render_pieces render_pieces;

/* *pieces is NULL on error. Errors: ARGUMENT, MEMORY. */
burnish_status render_pieces_create(const render_pieces_plan *plan, render_pieces **pieces,
                                    burnish_error *error);
void render_pieces_destroy(render_pieces *pieces); /* NULL is allowed */

/* Leaves the piece in the image and its notes. Call it once for each piece, in order; other
 * processes draw the following pieces in the meantime. Pieces that no other process has are drawn
 * here. Errors: as for the drawer. */
burnish_status render_pieces_take(render_pieces *pieces, int piece, burnish_error *error);

/* The loop of a runner, with 0 runners in the plan. Errors: ARGUMENT (no socket, another mesh or
 * version), and as for the drawer. */
burnish_status render_pieces_serve(const render_pieces_plan *plan, burnish_error *error);

#endif
