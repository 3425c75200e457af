/* What the functions share that the module exports. A module has one caller at a time, and strings
 * and arrays of its memory live until the next call of the same object. */
#ifndef WASM_MODULE_H
#define WASM_MODULE_H

#include "burnish/core.h"

#define WASM_EXPORT(name) __attribute__((export_name(#name))) extern

/* Where a call writes its error: failure_text and failure_status tell it until the next one. */
burnish_error *module_error(void);

#endif
