/* ZIP archives with a model and its files, as download pages have them. */
#ifndef BURNISH_MESH_READ_ARCHIVE_H
#define BURNISH_MESH_READ_ARCHIVE_H

#include "base/archive_models.h"
#include "mesh/read/io/zip.h"

/* An archive and its model. All zero: none. */
typedef struct burnish_archive {
    burnish_reader_input input;
    burnish_reader reader; /* counts what is unpacked */
    burnish_zip zip;
    uint8_t *bytes, *text; /* of the model, and its text in UTF-8 if it is UTF-16 */
    const uint8_t *stream; /* of an importer, the decoder's; NULL: none */
    size_t stream_size;
    char folder[BURNISH_ARCHIVE_NAME], name[2 * BURNISH_ARCHIVE_NAME];
} burnish_archive;

/* Does nothing for an input that is not an archive, or is 3MF. Otherwise *input becomes the model:
 * the one that the input's name asks for ("kit.zip:part.stl"), the only one, or the only scene or
 * robot. Files that it refers to come from the archive. Several files that differ only in their extensions are one model, of which
 * the first in BURNISH_FORMAT_LIST is taken. Errors: ARGUMENT (several models, or none of that name),
 * FORMAT, LIMIT, MEMORY. */
burnish_status burnish_archive_open(burnish_archive *archive, burnish_reader_input *input,
                                    burnish_mesh_data *data, burnish_error *error);

/* Releases all but the name. */
void burnish_archive_close(burnish_archive *archive);

#endif
