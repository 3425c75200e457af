/* What a target provides: byte output, an end, and marks for the cycle counters. */
#ifndef BURNISH_FIRMWARE_TARGET_H
#define BURNISH_FIRMWARE_TARGET_H

#include <stdint.h>

/* Sends a byte over the serial line. */
void target_put(uint8_t byte);

/* Marks a moment for the simulator's cycle counter. */
void target_mark(void);

/* Ends the run; the simulator waits for it. */
void target_end(void);

#endif
