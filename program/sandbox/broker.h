/* The broker's side of the channel. It does not trust what the worker sends. */
#ifndef TOOL_SANDBOX_BROKER_H
#define TOOL_SANDBOX_BROKER_H

#include "sandbox/process.h"

typedef enum broker_state {
    BROKER_SERVES,
    BROKER_GONE, /* the worker has closed the channel */
    BROKER_VIOLATION /* the worker has broken the protocol, or requested what a sound worker never does */
} broker_state;

/* Replies to a worker's messages (channel.h) until it is gone or violates the protocol; returns which.
 * The broker needs 256 KiB whatever the worker sends, and memory for streams to decode within the
 * plan's limits.
 *   channel  a stream socket
 *   input    the open input, for importers; -1: none
 *   folder   the input's folder; -1: none */
broker_state broker_serve(const sandbox_plan *plan, int channel, int input, int folder);

#endif
