/* Sheets of aligned views: their layout, frame and symbol. */
#ifndef BURNISH_IMAGE_TEXT_PROJECTION_H
#define BURNISH_IMAGE_TEXT_PROJECTION_H

#include "burnish/sheet.h"

#endif
