/* What casts shadows: the mesh's opaque triangles, and of masked ones the pieces that their mask
 * leaves. A piece is a part of a triangle, so depth maps need no textures. */
#ifndef BURNISH_RENDER_LIGHT_CASTERS_H
#define BURNISH_RENDER_LIGHT_CASTERS_H

#include "base/memory.h"
#include "burnish/mesh.h"
#include "render/texture/transparency.h"

/* Owned; all zero before the first frame, a later frame of the same version uses the same pieces.
 */
typedef struct burnish_casters {
    /* The mesh, followed by the pieces' positions, indices and triangles. Its serial is the version,
     * by which depth maps recognise it. */
    burnish_mesh_view mesh;
    const uint16_t *transparent; /* per batch of these: triangles that cast none; NULL: all cast */
    float *positions;
    uint32_t *indices;
    uint16_t *masks;
    size_t position_capacity, index_capacity, mask_capacity;
    size_t position_count, index_count; /* of pieces: numbers, not triples */
    uint64_t version;                   /* burnish_transparency.version; 0: none */
} burnish_casters;

/* transparency: of the mesh. Errors: MEMORY. */
burnish_status burnish_casters_update(burnish_casters *casters, const burnish_mesh_view *mesh,
                                      const burnish_transparency *transparency,
                                      burnish_memory *memory);
void burnish_casters_destroy(burnish_casters *casters, const burnish_context *context);

#endif
