/* Finds transparent triangles. layer_light.h has the light of their layers. */
#ifndef BURNISH_RENDER_TEXTURE_TRANSPARENCY_H
#define BURNISH_RENDER_TEXTURE_TRANSPARENCY_H

#include "burnish/mesh.h"
#include "raster/geometry.h"
#include "render/texture/texture.h"

/* Owned; all zero before the first frame, a later frame uses the arrays again. */
typedef struct burnish_transparency {
    float *opacities;                   /* one per material */
    const burnish_texturing *texturing; /* NULL: no material is special */
    uint16_t *masks; /* burnish_tile.transparent: per batch of the mesh, then of clipped ones */
    int has_some;    /* 0: every triangle is opaque, and masks mean nothing */
    int has_alpha;   /* 1: alpha of vertices counts */
    size_t opacity_capacity, mask_capacity;

    /* Counts frames in which another part of space was opaque than in the one before: another mesh,
     * other transparent triangles, another mask. Whatever was made of opaque triangles is kept as
     * long as this stays. */
    uint64_t version;
    uint64_t serial;                    /* the mesh whose version it is; 0: none */
    struct burnish_opacity_rule *rules; /* and one per material; none where all of it is opaque */
    size_t rule_count, rule_capacity;
} burnish_transparency;

/* Finds the mesh's transparent triangles. Errors: MEMORY. */
burnish_status burnish_transparency_update(burnish_transparency *transparency,
                                           const burnish_drawn_mesh *mesh,
                                           const burnish_texturing *texturing, burnish_tasks *tasks,
                                           burnish_memory *memory);

/* Adds triangles made by clipping. Errors: MEMORY. */
burnish_status burnish_transparency_add_clipped(burnish_transparency *transparency,
                                                const burnish_geometry *geometry,
                                                burnish_memory *memory);
void burnish_transparency_destroy(burnish_transparency *transparency,
                                  const burnish_context *context);

#endif
