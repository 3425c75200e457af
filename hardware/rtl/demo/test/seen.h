/* seen.h: what leaves a board in a pixel's time.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_DEMO_SEEN_H
#define BURNISH_DEMO_SEEN_H

#include <cstdint>

struct seen {
    bool visible, hsync, vsync;
    uint32_t color;
};

#endif
