/* --views=third-angle and first-angle: a page of aligned views. */
#ifndef TOOL_RENDER_OUTPUT_PROJECTION_H
#define TOOL_RENDER_OUTPUT_PROJECTION_H

#include "render/output/result.h"

/* 1: the views of the run are aligned. */
static inline int render_is_projection(const render_settings *settings) {
    return settings->picture.views.layout != VIEW_FREE;
}

/* Drops flags that aligned views leave no choice, and finds its size. Errors: ARGUMENT for several
 * lobes, or a perspective. */
burnish_status render_check_projection(render_settings *settings, burnish_error *error);

/* Lays out the page of a loaded mesh, and gives cells their sizes and cameras. */
burnish_status render_lay_out_projection(render_result *result, burnish_error *error);

/* Gives options the size of a cell, and its lines. */
void render_aim_projection(const render_result *result, const render_cell *cell,
                           burnish_render_options *options);

/* row * columns + column of a cell. */
size_t render_projection_place(const render_result *result, size_t cell);

/* What is annotated in a cell: each length once, and the section. */
void render_limit_annotations(const render_result *result, const render_cell *cell,
                              burnish_annotate_options *annotations);

/* The page of all views: of their images, and of their drawings. */
burnish_status render_compose_projection(const render_result *result, const uint8_t ink[3],
                                         burnish_image *image, burnish_error *error);

burnish_status render_join_projection(const render_result *result, const uint8_t ink[3],
                                      burnish_drawing **drawing, burnish_error *error);

#endif
