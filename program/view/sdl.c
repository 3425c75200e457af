#include "view/sdl.h"

#include <dlfcn.h>
#include <string.h>

#include "base/cli/options.h"

/* The name of the binary interface that the headers describe. */
#define SDL_LIBRARY "libSDL2-2.0.so.0"

burnish_status view_load_sdl(view_sdl_calls *calls, burnish_error *error) {
    void *const handle = dlopen(SDL_LIBRARY, RTLD_NOW | RTLD_LOCAL);
    if (!handle) {
        return cli_fail(
            error, BURNISH_STATUS_READ,
            "view: %s, which windows need, can't be loaded; install it (Debian's libsdl2-2.0-0)",
            SDL_LIBRARY);
    }
    /* C can not convert a pointer to an object into one to a function; POSIX guarantees that their
     * bytes are the same. */
    void *address;
#define FIND(name)                                                                                 \
    address = dlsym(handle, #name);                                                                \
    if (!address) {                                                                                \
        return cli_fail(error, BURNISH_STATUS_READ, "view: %s has no %s; install a newer version", \
                        SDL_LIBRARY, #name);                                                       \
    }                                                                                              \
    memcpy(&calls->name, &address, sizeof address);
    VIEW_SDL_CALLS(FIND)
#undef FIND
    return BURNISH_STATUS_OK;
}
