/* Describing files that burnish does not read. */
#ifndef BURNISH_MESH_READ_FOREIGN_H
#define BURNISH_MESH_READ_FOREIGN_H

#include <stddef.h>
#include <stdint.h>

/* Returns "a STEP file" or the like, from the first bytes or, for some, the file extension; NULL if
 * unknown. */
const char *burnish_describe_foreign(const uint8_t *bytes, size_t size, const char *name);

/* Whether bytes are a Git LFS pointer, the placeholder of a file that was not fetched. */
int burnish_is_lfs_pointer(const uint8_t *bytes, size_t size);

#endif
