/* Memory as it was for the old readers; free() releases it. */
#ifndef ORACLE_LEGACY_H
#define ORACLE_LEGACY_H

#include <stdlib.h>

#include "core/error.h"
#include "core/memory.h"

#define ORACLE_TRIANGLE_LIMIT ((UINT32_MAX - 1) / 3)

static inline burnish_status oracle_legacy_reserve(void **pointer, size_t *capacity, size_t needed,
                                                   size_t size, const char *what,
                                                   burnish_error *error) {
    const size_t next = needed < 64 ? 64 : 2 * needed;
    if (needed <= *capacity) {
        return BURNISH_STATUS_OK;
    }
    void *grown = realloc(*pointer, next * size);
    if (!grown) {
        return burnish_fail_memory(error, what, next * size);
    }
    *pointer = grown;
    *capacity = next;
    return BURNISH_STATUS_OK;
}

static inline burnish_status oracle_legacy_allocate(void **pointer, size_t count, size_t size,
                                                    const char *what, burnish_error *error) {
    *pointer = malloc(count * size + 1);
    return *pointer ? BURNISH_STATUS_OK : burnish_fail_memory(error, what, count * size);
}

#endif
