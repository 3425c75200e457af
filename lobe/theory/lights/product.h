/* Products of polynomials in the cosines to one or two axes, over regions. */
#ifndef BURNISH_THEORY_PRODUCT_H
#define BURNISH_THEORY_PRODUCT_H

#include "burnish/theory.h"
#include "theory/lights/region.h"

typedef struct burnish_product {
    int count;
    const burnish_theory_polynomial *lobe[2];
    double axis[2][3];
} burnish_product;

/* The integral over a region of the product; u is not clamped. context: burnish_product. */
double burnish_product_within(const burnish_region *region, const void *context);

#endif
