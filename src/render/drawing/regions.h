/* Regions: pixels of one value as an area between closed lines, and lines that hatch it. */
#ifndef BURNISH_RENDER_DRAWING_REGIONS_H
#define BURNISH_RENDER_DRAWING_REGIONS_H

#include <stddef.h>
#include <stdint.h>

#include "base/memory.h"

/* A value per pixel, below 128; the top bit is used and cleared by burnish_borders_find. */
typedef struct burnish_region_map {
    uint8_t *values;
    int width, height;
} burnish_region_map;

/* Closed lines: each has its first point once more as its last. All zero before the first use. */
typedef struct burnish_borders {
    float *points; /* x, y */
    size_t point_count, point_capacity;
    uint32_t *starts; /* of each line, its first point; and the end */
    size_t count, start_capacity;
    float *hatch; /* x0, y0, x1, y1 */
    size_t hatch_count, hatch_capacity;
} burnish_borders;

/* The borders of the pixels with one value, of holes too: an area for the even-odd rule. They pass
 * within about a pixel of the sides where the value ends. Areas below half a square of
 * `scale` pixels are left out. Time and memory are linear in the pixels.
 *   scale  pixels of the map per unit of the points
 * Errors: memory->status. */
void burnish_borders_find(burnish_borders *borders, const burnish_region_map *map, uint8_t value,
                          int scale, burnish_memory *memory);

/* Lines x + y = period i + offset (way 0) or x - y = period i + offset (way 1), cut to the area.
 * Errors: memory->status. */
void burnish_borders_hatch(burnish_borders *borders, int way, double period, double offset,
                           burnish_memory *memory);

void burnish_borders_release(burnish_borders *borders, const burnish_context *context);

#endif
