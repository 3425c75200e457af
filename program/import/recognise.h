/* Recognises files by their first bytes. */
#ifndef TOOL_IMPORT_RECOGNISE_H
#define TOOL_IMPORT_RECOGNISE_H

#include <stddef.h>

/* Whether a file in a folder may be a mesh for an importer. Extensions with other uses (.ac, .mdl,
 * .x ...) need the signature of the mesh format, .dxf needs faces. */
int import_may_hold_mesh(const char *path);

/* Describes a file that is not a mesh, by its first bytes: it is empty, a Git LFS pointer or a web
 * page. NULL: it is none of these. */
const char *import_describe_other(const unsigned char *bytes, size_t size);

#endif
