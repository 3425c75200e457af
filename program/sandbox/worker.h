/* The side of a sandbox that draws. */
#ifndef TOOL_SANDBOX_WORKER_H
#define TOOL_SANDBOX_WORKER_H

/* Makes this process the worker: process-wide, as the lock will be.
 *   channel  to the broker
 *   input    the open input, or -1 */
void sandbox_become_worker(int channel, int input);

#endif
