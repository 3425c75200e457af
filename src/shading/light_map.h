/* Light from far away as a table over directions. */
#ifndef BURNISH_SHADING_LIGHT_MAP_H
#define BURNISH_SHADING_LIGHT_MAP_H

/* A square that the sphere is unfolded onto (octahedral map). For a direction w with
 * s = abs(w.x) + abs(w.y) + abs(w.z):
 *   (p, q) = (w.x / s, w.y / s)                                            if w.z >= 0
 *   (p, q) = ((1 - abs(w.y) / s) sign(w.x), (1 - abs(w.x) / s) sign(w.y))  otherwise
 * with sign(0) = 1. Texel (i, j) holds the value at p = 2 (i + 1/2) / size - 1, q the same in j. A
 * border of one texel on each side repeats texels across the folds, so the four texels of a
 * bilinear look-up are neighbours: (p, q) is at column (p + 1) size / 2 + 1/2 and row
 * (q + 1) size / 2 + 1/2 of the square with its border, whole numbers being texels. */
typedef struct burnish_light_map {
    int size;            /* texels per side without the border */
    const float *texels; /* red, green, blue and 0 of each; rows of size + 2 from the border's first
                            texel */
} burnish_light_map;

/* Maps of specular light at roughness k / (BURNISH_LIGHT_LEVELS - 1), alpha being its square.
 * Interpolate linearly in roughness. */
enum { BURNISH_LIGHT_LEVELS = 9 };

#endif
