/* Pieces of an output, drawn by others too: frames of a turntable or bands of a picture. Sockets
 * lead to processes with the same command line, which draw the pieces that they are asked for
 * (docs/scale.md). */
#ifndef TOOL_RENDER_PIECES_H
#define TOOL_RENDER_PIECES_H

#include "burnish/image.h"
#include "cli/options.h"

enum { RENDER_PIECE_NOTES = 3 };

/* Draws a piece into the image, and writes its notes. */
typedef burnish_status render_piece_drawer(void *context, int piece, burnish_error *error);

typedef struct render_pieces_plan {
    int runners;                /* sockets, from descriptor 3 on */
    int count;                  /* pieces */
    size_t triangles, vertices; /* of the mesh, which all runners must have */
    const burnish_image *image; /* what the drawer draws into; its size counts from the start */
    uint64_t *notes; /* RENDER_PIECE_NOTES numbers that come with a piece's pixels; NULL: none */
    render_piece_drawer *draw;
    void *context;
} render_pieces_plan;

typedef struct render_pieces render_pieces;

/* *pieces is NULL on error. Errors: ARGUMENT, MEMORY. */
burnish_status render_pieces_create(const render_pieces_plan *plan, render_pieces **pieces,
                                    burnish_error *error);
void render_pieces_destroy(render_pieces *pieces); /* NULL is allowed */

/* Leaves the piece in the image and its notes, pieces being asked for in their order, each once;
 * those after it are in work then. What nobody else draws is drawn here, so that others can only
 * help. Errors: those of the drawer. */
burnish_status render_pieces_take(render_pieces *pieces, int piece, burnish_error *error);

/* A runner's whole life; runners is 0. Errors: ARGUMENT (no socket, another mesh or version), those
 * of the drawer. */
burnish_status render_pieces_serve(const render_pieces_plan *plan, burnish_error *error);

#endif
