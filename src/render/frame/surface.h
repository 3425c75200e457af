/* From attributes of vertices to the light of visible points. Fragments come from a tile in two
 * ways: as block rows, whose simple pixels are already in the tile's planes, and as fragments of
 * complex pixels, which are gathered. The kernels shade both as batches.
 *
 * Everything here happens in the raster's space: model space moved and scaled so that the scene is
 * about 1 in size; positions count from the eye. */
#ifndef BURNISH_RENDER_FRAME_SURFACE_H
#define BURNISH_RENDER_FRAME_SURFACE_H

#include <stdint.h>

#include "base/memory.h"
#include "burnish/mesh.h"
#include "raster/fragments.h"
#include "raster/tile.h"
#include "render/frame/caps.h"
#include "render/light/maps/occlusion_share.h"
#include "render/light/near_cells.h"
#include "render/light/ray_light.h"
#include "render/render_ops.h"
#include "render/space.h"
#include "render/texture/texture.h"
#include "render/texture/transparency.h"

/* ---- Attributes of vertices (attributes.c) ---- */

/* What a vertex carries to its points: normals and colours times 1/w, which are linear on the
 * screen. One item per screen vertex, including vertices made by clipping. Owned; all zero before
 * the first frame, a later frame uses the arrays again. */
typedef struct burnish_attributes {
    burnish_float4 *normals; /* (x, y, z, 1) / w */
    burnish_float4 *colors;  /* linear (r, g, b, alpha) / w */
    int has_colors;
    size_t normal_capacity, color_capacity;
} burnish_attributes;

/* The mesh's normals and, unless they are to be ignored, colours. Errors: MEMORY; destroy them all
 * the same. */
burnish_status burnish_attributes_update(burnish_attributes *attributes,
                                         const burnish_geometry *geometry,
                                         const burnish_mesh_view *mesh, int ignore_colors,
                                         burnish_tasks *tasks, burnish_memory *memory);
void burnish_attributes_destroy(burnish_attributes *attributes, const burnish_context *context);

/* ---- surface.c ---- */

/* Fragments that are shaded at once: their arrays stay in L1. */
enum {
    BURNISH_SHADE_BATCH = 256,
    BURNISH_SHADE_PAD = 16 /* lanes of the longest vector */
};

/* Fragments to be shaded: arrays of `count` <= BURNISH_SHADE_BATCH, readable up to the next
 * multiple of 16. This is the one form that is shaded, whether the arrays are rows of a tile or
 * were gathered. */
typedef struct burnish_fragment_batch {
    int count;
    const float *normal[3];       /* turned toward the viewer's side, times 1/w */
    const float *color[3];        /* linear vertex colours times 1/w; all NULL: none */
    const float *inverse_w;       /* 1/w; read with colours and where burnish_shading.is_lyon */
    burnish_screen_points points; /* read where burnish_shading.needs_position */
    const int32_t *material;      /* NULL: all are 0 */
    int has_one_material;         /* 1: all have the first one's; 0: unknown */
    const uint16_t *pixels;       /* index in the tile; NULL: first_pixel + i */
    const uint16_t *samples;      /* of fragments of layers: bits of their samples; else NULL */
    int first_pixel;
    const int32_t *shown; /* items below 0 need no light; NULL: all do */
} burnish_fragment_batch;

/* What is over a material: sheen and a coat. */
typedef struct burnish_layers {
    const burnish_material *material;
    int coat; /* its number as a material; -1: none */
    int has_sheen;
} burnish_layers;

/* A frame's shaders, lights and kernels. */
typedef struct burnish_shading {
    const burnish_kernels *kernels;
    const burnish_render_ops *ops;
    const burnish_kernels_shader *shaders;            /* one per material */
    const burnish_kernels_shader *white;              /* all light is diffusely reflected */
    const burnish_layers *layers;                     /* per material; NULL: none has any */
    burnish_rays rays;                                /* from the eye */
    int needs_position;                               /* 1: a point light or a local viewer */
    const struct burnish_occlusion_lookup *occlusion; /* NULL: none */
    const burnish_ray_light *ray_light;               /* instead of depth maps; NULL: none */
    const struct burnish_shadow_lookup *shadow;       /* of the first light; NULL: none */
    const burnish_texturing *texturing;               /* NULL: no material is special */
    size_t hollow_from; /* triangles from this one on bound hollows of negative volumes; 0: none */
    const burnish_area *area; /* NULL: no light from many directions */
    /* the body by which `kernels->shade_mixed` shades all materials at once; NONE: it can't */
    burnish_lobe_body mixed_body;
    int is_alike;        /* 1: all materials have one lobe and specular colour */
    burnish_tones tones; /* applied to all light of surfaces */
    int is_lyon;         /* 1: Lyon's lobe reads the length that interpolation leaves a normal */
} burnish_shading;

/* A frame's surfaces: attributes, materials and caps. */
typedef struct burnish_surface {
    const burnish_raster_view *view;
    const burnish_shading *shading;
    const burnish_attributes *attributes;
    const uint16_t *triangle_materials; /* NULL: all have material 0 */
    size_t triangle_count;
    const burnish_transparency *transparency; /* NULL: every triangle is opaque */
    const burnish_caps *caps;                 /* NULL: none */
    const burnish_point_view *points;         /* NULL: triangles */
    int is_layers;                            /* 1: fragments are of layers of transparency */
} burnish_surface;

/* The vectors of a batch in which a material is shown, and their light. */
typedef struct burnish_material_group {
    float normal[3][BURNISH_SHADE_BATCH], diffuse[3][BURNISH_SHADE_BATCH];
    float position[3][BURNISH_SHADE_BATCH], w[BURNISH_SHADE_BATCH];
    float lit[BURNISH_SHADE_BATCH], open[BURNISH_SEEN_VALUES][BURNISH_SHADE_BATCH];
    float x[BURNISH_SHADE_BATCH], y[BURNISH_SHADE_BATCH], facing[BURNISH_SHADE_BATCH];
    float light[3][BURNISH_SHADE_BATCH];
    int32_t left[BURNISH_SHADE_BATCH];   /* materials not shaded yet, -1 for the others */
    uint8_t starts[BURNISH_SHADE_BATCH]; /* of each vector: its first item in the batch */
} burnish_material_group;

/* A thread's arrays. All zero before the first use. */
typedef struct burnish_fragment_scratch {
    float normal[3][BURNISH_SHADE_BATCH], color[3][BURNISH_SHADE_BATCH]; /* times 1/w */
    float inverse_w[BURNISH_SHADE_BATCH];
    int32_t material[BURNISH_SHADE_BATCH];
    float divided_normal[3][BURNISH_SHADE_BATCH], divided_color[3][BURNISH_SHADE_BATCH];
    float position[3][BURNISH_SHADE_BATCH], w[BURNISH_SHADE_BATCH];
    float lit[BURNISH_SHADE_BATCH];       /* what of the first light reaches a point */
    float albedo[3][BURNISH_SHADE_BATCH]; /* of points of several materials */
    float coat[3][BURNISH_SHADE_BATCH];   /* light of the coat */
    float below[BURNISH_SHADE_BATCH];     /* what it leaves of the light below it */
    float leaned[3][BURNISH_SHADE_BATCH], wide[3][BURNISH_SHADE_BATCH]; /* of sheen */
    burnish_material_group group;
    burnish_share_scratch share;
    burnish_ray_tile *rays; /* of the tile; NULL where there is no ray_light */
    burnish_near_scratch near;
    burnish_near_cells cells;          /* of the tile */
    float hatch[BURNISH_SHADE_BATCH];  /* of fragments: burnish_cap_hatch */
    float facing[BURNISH_SHADE_BATCH]; /* of fragments: 1: the front is seen; 2: and refracts; -1 */
    burnish_code_direction known;      /* of the tile */
    uint32_t ids[BURNISH_SHADE_BATCH]; /* id and facing of each point's triangle */
    burnish_texture_scratch *texture;  /* NULL until a frame has textures */
} burnish_fragment_scratch;

/* A row of blocks: what its pixels show, and the colours of the simple ones. Those of others are
 * some numbers. All zero before the first use. */
typedef struct burnish_row_light {
    burnish_block_row pixels;
    float hatch[BURNISH_BLOCK_ROW_PIXELS];  /* where there are caps: burnish_cap_hatch */
    float rgb[3][BURNISH_BLOCK_ROW_PIXELS]; /* linear light, >= 0 */
} burnish_row_light;

/* ---- Sheen and clear coats (finishes.c) ---- */

/* A frame's layers. Owned; all zero before the first frame. */
typedef struct burnish_layering {
    burnish_coat *coats;
    burnish_layers *layers;
    size_t coat_capacity, layer_capacity;
} burnish_layering;

/* Finds the layers of the mesh's materials. Errors: MEMORY. */
burnish_status burnish_layering_update(burnish_layering *layering, burnish_drawn_mesh *mesh,
                                       burnish_shading *shading, burnish_memory *memory);
void burnish_layering_destroy(burnish_layering *layering, const burnish_context *context);

/* Shades fragments of one material, with the layers over it. If it is special, their opacity is in
 * scratch afterwards. */
void burnish_shade_layers(const burnish_shading *shading, const burnish_fragment_batch *batch,
                          const burnish_kernels_points *points,
                          float (*streams)[BURNISH_SHADE_BATCH], int material,
                          burnish_fragment_scratch *scratch, float *const rgb[3]);

/* The same without layers; the number may be a coat's (surface.c). */
void burnish_shade_material(const burnish_shading *shading, const burnish_fragment_batch *batch,
                            const burnish_kernels_points *points,
                            float (*streams)[BURNISH_SHADE_BATCH], int material,
                            burnish_fragment_scratch *scratch, float *const rgb[3]);

/* ---- Occlusion and what bounces (bounces.c) ---- */

/* Writes to scratch->share.open what points see of the light and the sky, by rays also to lit what they
 * see of the light that casts a shadow. Occlusion must not darken the first light
 * as well where its shadow is drawn: it is divided by what it will be multiplied by. */
void burnish_occlude_batch(const burnish_shading *shading, const burnish_fragment_batch *batch,
                           const burnish_kernels_points *points, burnish_fragment_scratch *scratch);

/* Multiplies the light of shaded points of one material by what they see of it, open[0], and adds what
 * surfaces around them, which hide the sky of open[1], send there. */
void burnish_add_bounces(const burnish_shading *shading, const burnish_kernels_points *points,
                         int count, int material, float (*open)[BURNISH_SHADE_BATCH],
                         const burnish_texture_scratch *textures, float *const rgb[3]);

/* The same of a batch of several materials without textures or vertex colours. */
void burnish_add_bounces_mixed(const burnish_shading *shading, const burnish_fragment_batch *batch,
                               burnish_fragment_scratch *scratch, float *const rgb[3]);

/* ---- Light that passes (transmission.c) ---- */

/* Sets scratch->facing to 2 where samples show their first front of a volume that refracts: paths from
 * there meet those behind, however many there are. */
void burnish_find_first_volumes(const burnish_surface *surface, const burnish_fragments *fragments,
                                burnish_fragment_scratch *scratch);

/* Writes to scratch->texture->passed what of the light from straight behind passes through points of
 * a material that `passes`, just shaded, and adds to their colours what is refracted. */
void burnish_pass_light(const burnish_shading *shading, const burnish_kernels_points *points,
                        int material, int count, burnish_fragment_scratch *scratch,
                        float *const rgb[3]);

/* Copies it to scratch->texture->through, if light passes through the material.
 *   materials  of the batch, of which scratch->group has `material`; NULL: it is the only one */
void burnish_keep_passed(const burnish_shading *shading, const int32_t *materials, int material,
                         int size, burnish_fragment_scratch *scratch);

/* ---- Tiles and their fragments (surface.c) ---- */

/* The planes that shading needs of a tile. */
int burnish_surface_planes(const burnish_surface *surface);

/* Prepares a tile that has been rasterised, before anything of it is shaded: near lights. */
void burnish_surface_begin_tile(const burnish_surface *surface, const burnish_tile *tile,
                                burnish_fragment_scratch *scratch);

/* Casts the rays of a tile's pixels (bounces.c). fragments, row: scratch of the caller's. */
void burnish_surface_cast_rays(const burnish_surface *surface, const burnish_raster_ops *ops,
                               const burnish_tile *tile, burnish_fragments *fragments,
                               burnish_fragment_scratch *scratch, burnish_row_light *row);

/* Replaces the simple pixels of row `number` that are seen from inside by caps: in the
 * tile's planes, before they are shaded. */
void burnish_cap_block_row(const burnish_surface *surface, const burnish_tile *tile, int number,
                           burnish_row_light *row);

/* Neighbouring blocks of a row that show a triangle: its pixels [first, end). */
typedef struct burnish_block_run {
    int row, first, end;
} burnish_block_run;

/* The materials of a run's pixels; complex ones get another's, which keeps runs of one material
 * long: their result is discarded. Returns whether all are the same. pixels: of the row. */
int burnish_find_materials(const burnish_surface *surface, const burnish_tile *tile,
                           burnish_block_run run, const burnish_block_row *pixels,
                           int32_t *material);

/* The pixels of row `number`, in the order of its blocks, without depths. */
burnish_screen_points burnish_row_points(const burnish_raster_view *view, const burnish_tile *tile,
                                         int number);

/* Shades the simple pixels of row `number`, whose attributes are read where they lie. row->pixels
 * must hold what the row's pixels show. */
void burnish_shade_block_row(const burnish_surface *surface, const burnish_tile *tile, int number,
                             burnish_fragment_scratch *scratch, burnish_row_light *row);

/* Gathers what the fragments of complex pixels are shaded from, in scratch, and shades them: rgb
 * receives their light; NULL: they are only gathered. Fragments of caps get the cap's depth. */
burnish_fragment_batch burnish_shade_fragments(const burnish_surface *surface,
                                               const burnish_tile *tile,
                                               burnish_fragments *fragments,
                                               burnish_fragment_scratch *scratch,
                                               float *const *rgb);

/* Alpha of the colours of fragment i. */
float burnish_fragment_alpha(const burnish_attributes *attributes,
                             const burnish_fragments *fragments, int i);

#endif
