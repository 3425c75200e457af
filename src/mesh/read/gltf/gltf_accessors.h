/* Bytes to numbers. */
#ifndef BURNISH_MESH_READ_GLTF_GLTF_ACCESSORS_H
#define BURNISH_MESH_READ_GLTF_GLTF_ACCESSORS_H

#include "base/bytes.h"
#include "mesh/read/gltf/gltf.h"

/* An accessor with its bounds checked and its sparse values in place. NULL on failure. user what
 * requests it, for messages widths bits 1 << width: permitted widths */
const burnish_gltf_accessor *burnish_gltf_resolve(burnish_gltf *gltf, uint32_t accessor,
                                                  uint32_t user, unsigned widths);

/* Sets the bytes, count, component and width of an accessor that has no values yet; fails if they
 * do not match its description. Scalars may have another component. */
void burnish_gltf_give(burnish_gltf *gltf, uint32_t number, uint32_t user,
                       const burnish_gltf_accessor *values);

/* Bytes of a burnish_gltf_component; 0 if it is invalid. */
size_t burnish_gltf_component_size(int component);

/* The components of element i; normalised components are in [-1, 1] or [0, 1]. */
void burnish_gltf_element(const burnish_gltf_accessor *accessor, size_t i, double *components);

/* A component of element i of an accessor of integers, not normalised. */
static inline uint32_t burnish_gltf_integer(const burnish_gltf_accessor *accessor, size_t i,
                                            int component) {
    const uint8_t *p = accessor->bytes + i * accessor->stride;
    switch (accessor->component) {
    case BURNISH_GLTF_UNSIGNED_BYTE:
        return p[component];
    case BURNISH_GLTF_UNSIGNED_SHORT:
        return burnish_load16(p + (size_t)2 * (size_t)component);
    case BURNISH_GLTF_UNSIGNED_INT:
        return burnish_load32(p + (size_t)4 * (size_t)component);
    default:
        return UINT32_MAX;
    }
}

#endif
