/* Files that are no mesh that burnish reads: what they are. */
#ifndef BURNISH_MESH_READ_FOREIGN_H
#define BURNISH_MESH_READ_FOREIGN_H

#include <stddef.h>
#include <stdint.h>

/* "a STEP file" or the like, told by the first bytes or, for some, by the name's ending; NULL where
 * nothing tells. */
const char *burnish_describe_foreign(const uint8_t *bytes, size_t size, const char *name);

/* Whether bytes are a pointer of Git LFS, which stands for a file that was not fetched. */
int burnish_is_lfs_pointer(const uint8_t *bytes, size_t size);

#endif
