/* Hands items to runners and collects their lines. */
#ifndef TOOL_BATCH_POOL_H
#define TOOL_BATCH_POOL_H

#include "batch/types.h"

/* Draws all pictures except unchanged ones. Errors: MEMORY, WRITE (the report). */
burnish_status batch_run(batch *b, burnish_error *error);

#endif
