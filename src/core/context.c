#include "core/context.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/tasks.h"

#define COOKIE 0x63747831u /* "ctx1" */

burnish_context_options burnish_context_options_default(void) {
    return (burnish_context_options){.cookie = COOKIE};
}

burnish_status burnish_context_create(const burnish_context_options *options,
                                      burnish_context **context, burnish_error *error) {
    if (!context) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "context: NULL; pass where to put it");
    }
    *context = NULL;
    if (!options || options->cookie != COOKIE) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "context options: not initialised; start from "
                            "burnish_context_options_default()");
    }
    if (!options->allocator.allocate != !options->allocator.release) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "context options: allocator has one function of two; set both, or "
                            "neither");
    }
    if (options->tasks.run &&
        (options->tasks.thread_count < 1 || options->tasks.thread_count > BURNISH_THREADS_MAX)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "context options: tasks.thread_count is %d; expected 1 to %d",
                            options->tasks.thread_count, BURNISH_THREADS_MAX);
    }
    burnish_context made = {.options = *options};
    burnish_memory memory = burnish_memory_of(&made, error);
    *context = burnish_allocate(&memory, 1, sizeof **context, "the context");
    if (!*context) {
        return memory.status;
    }
    **context = made;
    return BURNISH_STATUS_OK;
}

void burnish_context_destroy(burnish_context *context) {
    if (context) {
        burnish_context copy = *context;
        burnish_release(&copy, context);
    }
}
