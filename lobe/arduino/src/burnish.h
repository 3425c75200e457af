/* Highlights without pow, division and floating point: the lobes, the lighting equation, and strips
 * of shaded triangles for boards with little memory. The example TextRing shows its use.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_H
#define BURNISH_H

#include "burnish/lobe_q15.h"
#include "burnish/ring.h"
#include "burnish/shade_q15.h"
#include "burnish/strip.h"

#endif
