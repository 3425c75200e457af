/* Files that an input names: in its folder, or below. */
#ifndef BURNISH_MESH_READ_IO_BESIDE_H
#define BURNISH_MESH_READ_IO_BESIDE_H

/* Whether a name stays in the folder: relative, without "..". Slashes separate its parts. */
int burnish_stays_beside(const char *name);

#endif
