/* Drawings as SVG: burnish_drawing_encode_svg of drawing.h. */
#ifndef BURNISH_IMAGE_TEXT_SVG_H
#define BURNISH_IMAGE_TEXT_SVG_H

#include "burnish/drawing.h"

#endif
