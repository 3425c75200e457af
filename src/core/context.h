/* The inside of a burnish_context. */
#ifndef BURNISH_CORE_CONTEXT_H
#define BURNISH_CORE_CONTEXT_H

#include "burnish/core.h"

struct burnish_context {
    burnish_context_options options;
};

/* Sends a warning to the context's log; context may be NULL. */
static inline void burnish_log(const burnish_context *context, const char *line) {
    if (context && context->options.log) {
        context->options.log(context->options.log_user_data, line);
    }
}

#endif
