/* Drawings as PDF: burnish_drawing_encode_pdf of drawing.h. */
#ifndef BURNISH_IMAGE_TEXT_PDF_H
#define BURNISH_IMAGE_TEXT_PDF_H

#include "burnish/drawing.h"

#endif
