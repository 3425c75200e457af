/* Masks of materials: decided once a point, or for each sample of a pixel. */
#ifndef BURNISH_RENDER_TEXTURE_MASKS_H
#define BURNISH_RENDER_TEXTURE_MASKS_H

#include "render/texture/texture.h"

/* What masks need of a batch: where fragments of layers lie in their pixels; all samples are whole
 * until their material is shaded.
 *   samples  of fragments of layers, bits of those that show it; NULL: of other points */
void burnish_masks_begin(const burnish_texturing *texturing, const uint16_t *samples, int count,
                         burnish_texture_scratch *scratch);

/* Where nearest texels count and that of a point is not there, others next to it may be, and show
 * in some samples: gives the point their mean colour. */
void burnish_masks_color(const burnish_texture_batch *batch);

/* The mask of points whose opacity and taps of the colour have been found: opacity becomes 0 or 1,
 * or 1 and cover what the mask leaves of each sample. */
void burnish_masks_apply(const burnish_texturing *texturing, const burnish_texture_batch *batch);

#endif
