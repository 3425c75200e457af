/* Light from far away as a table over directions. */
#ifndef BURNISH_SHADING_LIGHT_MAP_H
#define BURNISH_SHADING_LIGHT_MAP_H

/* Two squares, one for each half of the sphere (dual paraboloid map). For a unit vector w:
 *   d = 1 / (1 + abs(w.z))
 *   column = w.x d size / 2 + (size + 1) / 2
 *   row    = w.y d size / 2 + (size + 1) / 2, and size + 2 more if w.z < 0
 * Whole numbers are texels. Each square has size + 2 rows and columns and goes beyond its half by a
 * border, so the four texels of a bilinear look-up are in one square. The mapping is smooth: the
 * error of the look-up is of second order in 1 / size. An octahedral map, which has edges, has an
 * error of first order there. */
typedef struct burnish_light_map {
    int size;            /* texels per side without the border */
    const float *texels; /* red, green, blue and 0 of each; 2 (size + 2) rows of size + 2 */
} burnish_light_map;

/* Maps of specular light at roughness k / (BURNISH_LIGHT_LEVELS - 1), alpha being its square.
 * Interpolate linearly in roughness. */
enum { BURNISH_LIGHT_LEVELS = 9 };

#endif
