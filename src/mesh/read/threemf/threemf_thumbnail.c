/* The picture that a package holds of itself, for packages without a mesh: sliced ones have only
 * G-code, and encrypted ones can't be read. */
#include "mesh/read/threemf/threemf.h"

#if BURNISH_HAS_3MF

#include <stdio.h>

#include "mesh/read/common/thumbnail.h"

static const burnish_zip_part *find_picture(burnish_threemf *threemf) {
    const int plate = threemf->reader->input->options->plate;
    char name[40];
    snprintf(name, sizeof name, "Metadata/plate_%d.png", plate > 0 ? plate : 1);
    const burnish_zip_part *of_plate = burnish_zip_find(&threemf->zip, name);
    const burnish_zip_part *part = plate > 0 || !threemf->thumbnail ? of_plate : threemf->thumbnail;
    return part ? part : burnish_zip_find(&threemf->zip, "Metadata/thumbnail.png");
}

burnish_status burnish_threemf_draw_thumbnail(burnish_threemf *threemf, const char *why) {
    burnish_reader *reader = threemf->reader;
    const burnish_zip_part *part = find_picture(threemf);
    uint8_t *bytes = NULL;
    size_t size = 0;
    if (!part) { /* the failure remains, if there is one */
        return threemf->status != BURNISH_STATUS_OK
                   ? threemf->status
                   : burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, NULL,
                                         "it holds no picture of itself; draw its model");
    }
    burnish_status status = reader->input->options->ignore_textures
                                ? BURNISH_STATUS_OK
                                : burnish_zip_read(&threemf->zip, part, &bytes, &size);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_draw_thumbnail(reader, bytes, size, why);
    }
    burnish_release(threemf->memory->context, bytes);
    return status;
}

#endif
