/* The bit streams of KHR_meshopt_compression (Khronos, glTF 2.0 extensions; appendices A and B of
 * its text), whose version 0 is EXT_meshopt_compression. For any input, decoders stay within their
 * bytes and within `out`. Decoded indices may have any value. */
#ifndef BURNISH_MESH_READ_GLTF_MESHOPT_H
#define BURNISH_MESH_READ_GLTF_MESHOPT_H

#include <stddef.h>
#include <stdint.h>

typedef enum burnish_meshopt_mode {
    BURNISH_MESHOPT_ATTRIBUTES,
    BURNISH_MESHOPT_TRIANGLES,
    BURNISH_MESHOPT_INDICES
} burnish_meshopt_mode;

typedef enum burnish_meshopt_filter {
    BURNISH_MESHOPT_NONE,
    BURNISH_MESHOPT_OCTAHEDRAL,
    BURNISH_MESHOPT_QUATERNION,
    BURNISH_MESHOPT_EXPONENTIAL,
    BURNISH_MESHOPT_COLOR
} burnish_meshopt_filter;

/* A message if these numbers are invalid; otherwise NULL. */
const char *burnish_meshopt_check(burnish_meshopt_mode mode, burnish_meshopt_filter filter,
                                  size_t count, size_t stride);

/* Decodes count elements of stride bytes, which burnish_meshopt_check has accepted, to `out`, which
 * may be read before it is written. Returns 0 if the bytes are damaged. */
int burnish_meshopt_decode(burnish_meshopt_mode mode, const uint8_t *bytes, size_t size,
                           size_t count, size_t stride, uint8_t *out);

/* Undoes a filter in place. */
void burnish_meshopt_unfilter(burnish_meshopt_filter filter, size_t count, size_t stride,
                              uint8_t *data);

#endif
