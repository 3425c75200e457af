/* Files packed by zip. */
#ifndef BURNISH_IMPORTER_ARCHIVE_H
#define BURNISH_IMPORTER_ARCHIVE_H

#include "importer.h"
#include "mesh/read/io/zip.h"

/* If the file is an archive with a file of the same extension, the input becomes that
 * file. Formats that are archives themselves (.zae, .ifczip) are not unpacked. It may
 * unpack to BURNISH_UNPACKED_PER_BYTE bytes per byte. Errors: FORMAT, LIMIT, MEMORY. */
burnish_status importer_unpack_archive(importer_input *input, burnish_error *error);

#endif
