/* Memory for the caller's bytes, and the error of the last call that failed. */
#include "base/wasm/module.h"

#include <stdlib.h>

WASM_EXPORT(allocate) void *module_allocate(size_t size);
WASM_EXPORT(release) void module_release(void *memory);
WASM_EXPORT(failure_text) const char *module_failure_text(void);
WASM_EXPORT(failure_status) const char *module_failure_status(void);
WASM_EXPORT(version) const char *module_version(void);

static burnish_error failure; /* module state: exports can't return a struct */

burnish_error *module_error(void) {
    failure = (burnish_error){0};
    return &failure;
}

/* NULL without memory. */
void *module_allocate(size_t size) {
    return malloc(size > 0 ? size : 1);
}

void module_release(void *memory) {
    free(memory);
}

const char *module_failure_text(void) {
    return failure.text;
}

/* "FORMAT" */
const char *module_failure_status(void) {
    static const char *const names[] = {
#define STATUS_NAME(name, code, text) #name,
        BURNISH_STATUS_LIST(STATUS_NAME)
#undef STATUS_NAME
    };
    return names[failure.status];
}

const char *module_version(void) {
    return burnish_version();
}
