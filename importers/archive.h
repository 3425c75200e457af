/* Files packed by zip. */
#ifndef BURNISH_IMPORTER_ARCHIVE_H
#define BURNISH_IMPORTER_ARCHIVE_H

#include "importer.h"
#include "mesh/read/io/zip.h"

/* Where the file is an archive that holds a file of its own ending, or is AMF and holds one file,
 * the input becomes that; formats that are archives themselves (.zae, .ifczip) stay. It may unpack
 * to BURNISH_UNPACKED_PER_BYTE bytes per byte. Errors: FORMAT, LIMIT, MEMORY. */
burnish_status importer_unpack_archive(importer_input *input, burnish_error *error);

#endif
