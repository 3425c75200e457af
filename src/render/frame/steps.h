/* One call of a renderer: the steps of a frame, from a mesh to the target's pixels. */
#ifndef BURNISH_RENDER_FRAME_STEPS_H
#define BURNISH_RENDER_FRAME_STEPS_H

#include "base/memory.h"
#include "core/tasks.h"
#include "raster/raster_ops.h"
#include "render/frame/carving.h"
#include "render/frame/target.h"
#include "render/light/maps/casters.h"
#include "render/lines/lines.h"
#include "render/lines/outline.h"
#include "render/splats/splatting.h"

/* ---- Bands of tiles, each from visibility to pixels while it is in cache (tiles.c) ---- */

typedef struct burnish_frame {
    const burnish_raster_ops *ops;
    const burnish_geometry *geometry;
    burnish_surface surface;
    burnish_output output;
    const burnish_carving *carving; /* NULL: nothing is carved */
    int counts_pixels;              /* 1: covered pixels and their bounds are counted */
    int layer_passes;               /* of transparent layers, [1, BURNISH_LAYER_PASSES] */
    uint8_t *drawn; /* a byte per triangle of the mesh, set when it shows in a sample; or NULL */
    burnish_tasks *tasks;
    const burnish_context *context; /* whose memory is used */
} burnish_frame;

/* What threads draw tiles with; kept from frame to frame. All zero before the first. */
typedef struct burnish_tile_worker burnish_tile_worker;
typedef struct burnish_tiles {
    burnish_bins bins;
    burnish_tile_worker *workers;
    int worker_count;
} burnish_tiles;

/* Draws every tile of the output's rows. report gets covered_pixels and bounds where they are
 * counted. Errors: MEMORY, CANCELLED. */
burnish_status burnish_frame_draw(const burnish_frame *frame, burnish_tiles *tiles,
                                  burnish_render_report *report, burnish_error *error);
void burnish_tiles_destroy(burnish_tiles *tiles, const burnish_context *context);

/* ---- steps.c ---- */

/* A picture whose rows are drawn in several calls: what their geometry and lines depend on. No
 * padding counts: it is all 0 before it is filled. */
typedef struct burnish_picture_key {
    uint64_t version; /* burnish_transparency.version; 0: no picture */
    burnish_camera camera;
    burnish_raster_view view; /* with size and samples */
    int ignore_colors, cull_back_faces;
    burnish_edge_flags edges;
    float edge_width, edge_opacity;
    uint8_t edge_color[3];
} burnish_picture_key;

/* What is kept from frame to frame. */
struct burnish_renderer {
    const burnish_context *context;
    burnish_tasks tasks;
    burnish_shaders shaders;
    burnish_layering layering;
    burnish_geometry geometry;
    burnish_attributes attributes;
    burnish_transparency transparency;
    burnish_carving carving;
    burnish_casters casters;
    burnish_texturing texturing;
    burnish_area area;
    burnish_tiles tiles;
    burnish_occlusion occlusion;
    burnish_ray_tree rays, volumes; /* of what is opaque, and what refracts */
    burnish_line_art line_art;
    burnish_outline outline;
    burnish_ground ground;
    burnish_shadow shadow;
    burnish_output_row background;
    burnish_srgb_encoder encoder;
    const burnish_kernels *best; /* asking the processor takes as long as drawing a tile */
    uint8_t *drawn;              /* a byte per triangle */
    size_t drawn_capacity;
    burnish_picture_key picture; /* whose geometry is there */
    int has_picture_lines;       /* 1: its lines are, too */
    int has_outline;             /* 1: its outline is, for the last rows */
};

/* Inputs and results of one call. */
typedef struct burnish_call {
    burnish_renderer *renderer;
    burnish_drawn_mesh mesh;
    const burnish_mesh_view *solid;  /* its view, without negative volumes */
    const burnish_mesh_view *splats; /* drawn over the rest; NULL: none */
    burnish_target surface; /* depth and coverage of opaque triangles for splats, or NULL */
    const burnish_render_options *options;
    burnish_target target;
    burnish_counts counts;
    burnish_render_report report;
    burnish_memory memory;
    burnish_view view;
    const burnish_raster_ops *raster;
    const burnish_outline *outline; /* receives covered samples, or NULL */
} burnish_call;

/* The direction in which the object stands. */
burnish_vec3 burnish_call_up(const burnish_call *d);

/* Prepares the view's light. Errors: MEMORY, CANCELLED, LIMIT. */
burnish_status burnish_call_find_light(burnish_call *d, burnish_texturing *texturing);

/* Draws into the target and fills the report. Everything has been checked. */
burnish_status burnish_call_run(burnish_call *d);

#endif
