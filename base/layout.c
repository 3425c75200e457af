#include "base/layout.h"

#include <string.h>

#define OTHER_LAYOUT 0x6f6c6421U

void burnish_layout_init(void *value, uint64_t layout, uint64_t own, const void *defaults) {
    const uint32_t other = OTHER_LAYOUT;
    const size_t size = (size_t)(uint32_t)layout;
    if (layout == own) {
        memcpy(value, defaults, size);
    } else if (size >= sizeof other) {
        memset(value, 0, size);
        memcpy(value, &other, sizeof other);
    }
}

burnish_status burnish_layout_check(const void *value, uint32_t cookie, const char *what,
                                    const char *type, burnish_error *error) {
    uint32_t found = 0;
    if (value) {
        memcpy(&found, value, sizeof found);
    }
    if (found == cookie) {
        return BURNISH_STATUS_OK;
    }
    if (found == OTHER_LAYOUT) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "%s: the program was compiled with the headers of another version; "
                            "compile it with those of burnish %s",
                            what, burnish_version());
    }
    return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                        "%s: not initialised; start from burnish_%s_default()", what, type);
}
