/* What a target gives the programs: a byte out, an end, and marks for the cycle counters. */
#ifndef BURNISH_FIRMWARE_TARGET_H
#define BURNISH_FIRMWARE_TARGET_H

#include <stdint.h>

/* Sends a byte over the serial line. */
void target_put(uint8_t byte);

/* A moment that the cycle counter of the simulator sees. */
void target_mark(void);

/* Ends the run: what the simulator waits for. */
void target_end(void);

#endif
