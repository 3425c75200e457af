/* The library's options for settings. */
#ifndef TOOL_RENDER_OPTIONS_H
#define TOOL_RENDER_OPTIONS_H

#include "render/settings/settings.h"

/* The options of loading, and a mesh loaded by them. */
burnish_load_options render_load_options(const render_input_settings *input, int threads);
burnish_status render_load(const render_input_settings *input, int threads, burnish_mesh **mesh,
                           burnish_error *error);

/* Whether a lobe or an equation other than the default was chosen. */
int render_has_own_lobe(const render_shading_settings *shading);

/* Materials that no light would show. */
typedef struct render_blacks {
    size_t lifted; /* reflect almost nothing: the studio makes them visible */
    int are_all;   /* 1: the file's materials reflect nothing at all; they become the look's grey */
} render_blacks;

/* Applies --color, --material, --specular, --exponent and --opacity to every material. */
burnish_status render_adjust_materials(const render_shading_settings *shading, burnish_mesh *mesh,
                                       render_blacks *blacks, burnish_error *error);

/* Whether --camera-intrinsics has an effect: in one perspective from an exact position. */
int render_is_calibrated(const render_settings *settings);

/* The options of drawing, without camera and lobe, which each cell sets. */
burnish_render_options render_make_options(const render_settings *settings);

#endif
