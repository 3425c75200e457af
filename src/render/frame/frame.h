/* A frame: what it is drawn from (view.c), where its pixels go (target.c) and the tiles between
 * them (frame.c). renderer.c leads from one to the next. */
#ifndef BURNISH_RENDER_FRAME_FRAME_H
#define BURNISH_RENDER_FRAME_FRAME_H

#include "burnish/render.h"
#include "core/memory.h"
#include "core/srgb.h"
#include "render/frame/surface.h"
#include "render/frame/transparency.h"
#include "render/light/ground.h"
#include "render/light/occlusion.h"
#include "render/light/shadow.h"

/* ---- Options ---- */

/* ARGUMENT unless burnish_render_options_default() made them. */
burnish_status burnish_render_options_check_cookie(const burnish_render_options *options,
                                                   burnish_error *error);

/* ARGUMENT, with what is wrong, for options that can't be drawn. */
burnish_status burnish_render_options_check(const burnish_render_options *options,
                                            burnish_error *error);

/* The rows of the picture that are drawn: [first, end). */
typedef struct burnish_row_range {
    int first, end;
} burnish_row_range;

static inline burnish_row_range burnish_drawn_rows(const burnish_render_options *options) {
    const int count = options->row_count ? options->row_count : options->height;
    return (burnish_row_range){options->first_row, options->first_row + count};
}

/* What the look, one of the list, says of options. */
void burnish_look_apply(burnish_look look, burnish_render_options *options);

/* ---- View: camera, lights and materials, as raster and shading work with them ---- */

/* From a depth of the raster to the distance along the view axis, in the mesh's units:
 * (constant + (1 - depth) slope) / q, q as burnish_rays has it. */
typedef struct burnish_view_distance {
    float constant, slope;
} burnish_view_distance;

typedef struct burnish_view {
    burnish_raster_view raster;
    burnish_shading shading; /* kernels and ops are the caller's to set */
    burnish_view_distance distance;
    double eye[3]; /* in the raster's space */
    double pixel;  /* what one is wide there, about, in the middle of the mesh */
    burnish_occlusion_lookup occlusion;
    burnish_ground_view ground;
    burnish_vec3 key; /* toward the first light, a unit vector; 0, 0, 0: it is not directional */
    burnish_shadow_lookup shadow;
    size_t lobe_fallbacks; /* materials with a lower order than the lobe's: their exponent allows no
                              more */
} burnish_view;

/* A frame's materials, each folded with the lights. Owned; all zero before the first frame, a later
 * frame uses the arrays again. */
typedef struct burnish_shaders {
    burnish_kernels_shader *items;   /* one per material */
    burnish_light_constants *lights; /* light_count per shader */
    size_t item_capacity, light_capacity;
} burnish_shaders;

/* The view reads the shaders and, where a material is special, texturing, which learns what the
 * view says; NULL: none is. Errors: ARGUMENT (a camera without a direction, or further away than
 * float arithmetic reaches; a material that can't be shaded), LIMIT, MEMORY. */
burnish_status burnish_view_create(const burnish_mesh *mesh, const burnish_render_options *options,
                                   burnish_shaders *shaders, burnish_texturing *texturing,
                                   burnish_view *view, burnish_memory *memory);

/* ---- Output: from a tile's linear light to the caller's pixels and planes ---- */

/* Where a frame's pixels go, and what background and alpha look like there. */
typedef struct burnish_output {
    burnish_target target;
    burnish_row_range rows; /* of the picture, that the target holds */
    const burnish_render_ops *ops;
    const burnish_srgb_encoder *encoder;
    const burnish_view *view;
    int has_planes; /* 1: the target has some */
    int samples;
    int transparent;           /* 1: alpha is coverage, and there is no background */
    float limit;               /* a fragment's light is clamped to it before samples are mixed */
    uint32_t alpha;            /* the bits of an opaque pixel's alpha; 0 where there is none */
    uint32_t background_code;  /* red lowest */
    float background_light[4]; /* linear; alpha last */
    const burnish_ground_view *ground; /* NULL: none is seen */
    const uint8_t *background;         /* a row of the target where nothing is */
    size_t pixel_size;                 /* bytes */
} burnish_output;

/* What is kept from frame to frame: the row of background. All zero before the first. */
typedef struct burnish_output_row {
    uint8_t *bytes;
    size_t capacity;
} burnish_output_row;

/* Whether a target fits checked options. Errors: ARGUMENT. */
burnish_status burnish_target_check(const burnish_target *target,
                                    const burnish_render_options *options, burnish_error *error);

/* The pixel rows of row `number` of a tile's blocks, from its own first one on, that are drawn. */
static inline burnish_row_range burnish_output_rows(const burnish_output *output,
                                                    const burnish_tile *tile, int number) {
    const int top = tile->y + number * BURNISH_BLOCK_SIZE;
    const int first = output->rows.first - top, end = output->rows.end - top;
    return (burnish_row_range){first > 0 ? first : 0,
                               end < BURNISH_BLOCK_SIZE ? end : BURNISH_BLOCK_SIZE};
}

/* ops, encoder, view and ground are the caller's to set. Errors: MEMORY. */
burnish_status burnish_output_begin(burnish_output *output, const burnish_target *target,
                                    const burnish_render_options *options, burnish_output_row *row,
                                    burnish_memory *memory);

/* What fragments leave at a tile's complex pixels. */
typedef struct burnish_tile_sums {
    float light[3][BURNISH_TILE_PIXELS];  /* times samples */
    uint8_t covered[BURNISH_TILE_PIXELS]; /* samples */
    uint8_t weights[BURNISH_TILE_PIXELS]; /* samples of the fragment that planes show so far */
    burnish_layer_light *layers;          /* in front of all that; NULL: none in this tile */
} burnish_tile_sums;

/* Adds the light of fragments to their pixels' sums, and writes what planes show of them: of a
 * pixel's fragments the one with most samples, of equals the first. batch: of the fragments. */
void burnish_output_add_fragments(const burnish_output *output, const burnish_tile *tile,
                                  const burnish_fragments *fragments,
                                  const burnish_fragment_batch *batch, const float *const rgb[3],
                                  burnish_tile_sums *sums);

/* Writes row `number` of a tile to the target: pixels that show nothing become background; complex
 * ones the mean of their sums with it or, where it is transparent, of the covered samples alone.
 * The row's light may change. */
void burnish_output_store_row(const burnish_output *output, const burnish_tile *tile,
                              const burnish_tile_sums *sums, int number, burnish_row_light *row);

/* Writes background to row `number`, which shows nothing. */
void burnish_output_store_background(const burnish_output *output, const burnish_tile *tile,
                                     int number);

/* ---- Planes: depth, triangles, normals and coverage ---- */

/* Whether a target has some. */
int burnish_planes_are_wanted(const burnish_target *target);

/* Writes what planes hold where nothing is to all of the tile; weights become 0. */
void burnish_planes_clear(const burnish_output *output, const burnish_tile *tile,
                          burnish_tile_sums *sums);

/* What fragments show: of a pixel's the one with most samples, of equals the first.
 *   weights  per pixel of the tile, samples of the fragment that planes show so far */
void burnish_planes_store_fragments(const burnish_output *output, const burnish_tile *tile,
                                    const burnish_fragments *fragments,
                                    const burnish_fragment_batch *batch, uint8_t *weights);

/* What the simple pixels of row `number` show, and the coverage of all. */
void burnish_planes_store_row(const burnish_output *output, const burnish_tile *tile,
                              const burnish_tile_sums *sums, int number,
                              const burnish_block_row *pixels);

/* ---- Frame: bands of tiles, each from visibility to pixels while it is in cache ---- */

typedef struct burnish_frame {
    const burnish_raster_ops *ops;
    const burnish_geometry *geometry;
    burnish_surface surface;
    burnish_output output;
    int counts_pixels; /* 1: covered pixels and their bounds are counted */
    int layer_passes;  /* of transparent layers, [1, BURNISH_LAYER_PASSES] */
    uint8_t *drawn;    /* a byte per triangle of the mesh, set when it shows in a sample; or NULL */
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

#endif
