#include "base/context.h"

#include "base/layout.h"
#include "base/memory.h"

#define COOKIE BURNISH_COOKIE(0x63747831, burnish_context_options)

void burnish_context_options_init(burnish_context_options *options, uint64_t layout) {
    const burnish_context_options defaults = {.cookie = COOKIE};
    burnish_layout_init(options, layout, BURNISH_LAYOUT(burnish_context_options), &defaults);
}

burnish_status burnish_context_create(const burnish_context_options *options,
                                      burnish_context **context, burnish_error *error) {
    if (!context) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "context: NULL; pass where to put it");
    }
    *context = NULL;
    const burnish_status status =
        burnish_layout_check(options, COOKIE, "context options", "context_options", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
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
