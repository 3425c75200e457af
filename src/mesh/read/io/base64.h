/* Base64 (RFC 4648), of either alphabet. */
#ifndef BURNISH_MESH_READ_IO_BASE64_H
#define BURNISH_MESH_READ_IO_BASE64_H

#include <stddef.h>
#include <stdint.h>

/* Decodes text without blanks; it may be done in place. Returns the number of bytes written, at most
 * size / 4 * 3 + 2; SIZE_MAX if a character is invalid. */
size_t burnish_decode_base64(const uint8_t *text, size_t size, uint8_t *out);

#endif
