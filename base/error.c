#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

const char *burnish_status_text(burnish_status status) {
    switch (status) {
#define BURNISH_STATUS_TEXT(name, code, text)                                                      \
    case BURNISH_STATUS_##name:                                                                    \
        return text;
        BURNISH_STATUS_LIST(BURNISH_STATUS_TEXT)
#undef BURNISH_STATUS_TEXT
    case BURNISH_STATUS_COUNT:
        break;
    }
    return "unknown status";
}

int burnish_status_exit_code(burnish_status status) {
    switch (status) {
#define BURNISH_STATUS_CODE(name, code, text)                                                      \
    case BURNISH_STATUS_##name:                                                                    \
        return code;
        BURNISH_STATUS_LIST(BURNISH_STATUS_CODE)
#undef BURNISH_STATUS_CODE
    case BURNISH_STATUS_COUNT:
        break;
    }
    return 1;
}

#define TEXT_OF(number) #number
#define VERSION_TEXT(major, minor, patch) TEXT_OF(major) "." TEXT_OF(minor) "." TEXT_OF(patch)

const char *burnish_version(void) {
    return VERSION_TEXT(BURNISH_VERSION_MAJOR, BURNISH_VERSION_MINOR, BURNISH_VERSION_PATCH);
}

int burnish_version_number(void) {
    return BURNISH_VERSION_NUMBER;
}

burnish_status burnish_fail(burnish_error *error, burnish_status status, const char *format, ...) {
    if (error) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(error->text, sizeof error->text, format, arguments);
        va_end(arguments);
        burnish_clean_text(error->text);
        error->status = status;
    }
    return status;
}

#ifdef _WIN32
static void describe(int code, burnish_reason *reason) {
    strerror_s(reason->text, sizeof reason->text, code);
}
#else
/* GNU strerror_r returns a string, which can be in another buffer; POSIX strerror_r returns a
 * number. */
static inline void take_text(const char *text, burnish_reason *reason) {
    if (text != reason->text) {
        snprintf(reason->text, sizeof reason->text, "%s", text);
    }
}

static inline void take_number(int failed, burnish_reason *reason) {
    (void)failed, (void)reason;
}

static void describe(int code, burnish_reason *reason) {
    _Generic(strerror_r(code, reason->text, sizeof reason->text), char * : take_text, int
             : take_number)(strerror_r(code, reason->text, sizeof reason->text), reason);
}
#endif

burnish_reason burnish_errno_reason(int code) {
    burnish_reason reason = {""};
    describe(code, &reason);
    if (!reason.text[0]) {
        snprintf(reason.text, sizeof reason.text, "error %d", code);
    }
    return reason;
}

burnish_status burnish_fail_memory(burnish_error *error, const char *what, size_t bytes) {
    return burnish_fail(error, BURNISH_STATUS_MEMORY,
                        "out of memory: no %zu bytes for %s; raise --max-memory, free memory, or "
                        "use a smaller input",
                        bytes, burnish_show_name(what).text);
}
