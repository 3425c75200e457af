/* Exported functions. A module has one caller at a time, and strings and arrays in its memory are
 * valid until the next call for the same object. */
#ifndef WASM_MODULE_H
#define WASM_MODULE_H

#include "burnish/core.h"

#define WASM_EXPORT(name) __attribute__((export_name(#name))) extern

/* The error of a call, which failure_text and failure_status return until the next one. */
burnish_error *module_error(void);

#endif
