/* The worker's side of a sandbox. */
#ifndef TOOL_SANDBOX_WORKER_H
#define TOOL_SANDBOX_WORKER_H

/* Makes this process the worker. Affects the whole process, like the sandbox.
 *   channel  to the broker
 *   input    the open input, or -1 */
void sandbox_become_worker(int channel, int input);

#endif
