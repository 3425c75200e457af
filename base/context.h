/* The inside of a burnish_context. */
#ifndef BURNISH_BASE_CONTEXT_H
#define BURNISH_BASE_CONTEXT_H

#include "burnish/core.h"

/* The most threads of a call. */
#define BURNISH_THREADS_MAX 1024

struct burnish_context {
    burnish_context_options options;
};

/* Sends a warning to the context's log; context may be NULL. */
static inline void burnish_context_warn(const burnish_context *context, const char *line) {
    if (context && context->options.log) {
        context->options.log(context->options.log_user_data, line);
    }
}

#endif
