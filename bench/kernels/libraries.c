/* Other libraries' vector powf by dlopen. */
#include "bench/kernels/libraries.h"

#include <dlfcn.h>
#include <string.h>

static burnish_bench_symbol open_symbol(const char *library, const char *name,
                                        const char *no_library, const char *no_name) {
    burnish_bench_symbol symbol = {NULL, NULL, NULL};
    if (!name) {
        symbol.missing = no_name;
        return symbol;
    }
    symbol.handle = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    void *address = symbol.handle ? dlsym(symbol.handle, name) : NULL;
    if (!address) {
        symbol.missing = symbol.handle ? no_name : no_library;
        burnish_bench_close(&symbol);
        return symbol;
    }
    memcpy(&symbol.function, &address, sizeof address);
    return symbol;
}

burnish_bench_symbol burnish_bench_open_libmvec(const burnish_bench_contenders *contenders) {
    return open_symbol("libmvec.so.1", contenders->libmvec,
                       "libmvec.so.1 is missing; it is part of the GNU C library (Debian: libc6)",
                       "libmvec has no powf for this instruction set");
}

burnish_bench_symbol burnish_bench_open_sleef(const burnish_bench_contenders *contenders) {
    return open_symbol("libsleef.so.3", contenders->sleef,
                       "libsleef.so.3 is missing; install Debian's libsleef3: scripts/install-deps "
                       "bench",
                       "SLEEF has no powf for this instruction set");
}

void burnish_bench_close(burnish_bench_symbol *symbol) {
    if (symbol->handle) {
        dlclose(symbol->handle);
    }
    symbol->handle = NULL;
    symbol->function = NULL;
}
