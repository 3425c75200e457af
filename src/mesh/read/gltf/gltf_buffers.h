/* Bytes: the binary chunk, data URIs, files next to the input. */
#ifndef BURNISH_MESH_READ_GLTF_GLTF_BUFFERS_H
#define BURNISH_MESH_READ_GLTF_GLTF_BUFFERS_H

#include "mesh/read/gltf/gltf.h"

/* The bytes of a buffer view, and the stride that it states, 0 for none. Returns 0 on failure. */
int burnish_gltf_view(burnish_gltf *gltf, uint32_t view, burnish_gltf_bytes *bytes, size_t *stride);

/* Counts bytes that the file unpacks to. Fails and returns 0 if they are too many.
 *   what  what they are, for messages */
int burnish_gltf_fill(burnish_gltf *gltf, uint32_t value, uint64_t bytes, const char *what);

/* Resolves a URI: the bytes of a data URI go to *data, otherwise *name is the name of a file, to be
 * released by the caller, or "" if no file can have this name. Returns 0 on failure. */
int burnish_gltf_open_uri(burnish_gltf *gltf, uint32_t uri, burnish_gltf_buffer *data, char **name);
void burnish_gltf_release_buffer(burnish_gltf *gltf, burnish_gltf_buffer *buffer);

#endif
