#include "font/libraries.h"

#include <dlfcn.h>
#include <string.h>

#include "base/cli/options.h"

font_library_calls font_calls;

/* The names of the binary interfaces that the headers describe. */
#define HARFBUZZ_FILE "libharfbuzz.so.0"
#define FRIBIDI_FILE "libfribidi.so.0"
#define FONTCONFIG_FILE "libfontconfig.so.1"

static burnish_status load_library(const char *library, void **handle, burnish_error *error) {
    *handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    return *handle ? BURNISH_STATUS_OK
                   : cli_fail(error, BURNISH_STATUS_READ,
                              "%s, which fonts need, can't be loaded; install it", library);
}

/* C can not convert a pointer to an object into one to a function; POSIX guarantees that their
 * bytes are the same. */
static burnish_status find_symbol(void *handle, const char *library, const char *name, void *call,
                                  burnish_error *error) {
    void *const address = dlsym(handle, name);
    memcpy(call, &address, sizeof address);
    return address ? BURNISH_STATUS_OK
                   : cli_fail(error, BURNISH_STATUS_READ, "%s has no %s; install a newer version",
                              library, name);
}

burnish_status font_load_libraries(burnish_error *error) {
    font_library_calls found;
    void *handle;
    burnish_status status = load_library(HARFBUZZ_FILE, &handle, error);
#define FIND(library, name)                                                                        \
    status = status == BURNISH_STATUS_OK ? find_symbol(handle, library, #name, &found.name, error) \
                                         : status;
#define FIND_HARFBUZZ(name) FIND(HARFBUZZ_FILE, name)
#define FIND_FRIBIDI(name) FIND(FRIBIDI_FILE, name)
#define FIND_FONTCONFIG(name) FIND(FONTCONFIG_FILE, name)
    FONT_HARFBUZZ_CALLS(FIND_HARFBUZZ)
    status = status == BURNISH_STATUS_OK ? load_library(FRIBIDI_FILE, &handle, error) : status;
    FONT_FRIBIDI_CALLS(FIND_FRIBIDI)
    status = status == BURNISH_STATUS_OK ? load_library(FONTCONFIG_FILE, &handle, error) : status;
    FONT_FONTCONFIG_CALLS(FIND_FONTCONFIG)
    if (status == BURNISH_STATUS_OK) {
        font_calls = found;
    }
    return status;
}
