/* The table of formats: a row is all that is known of one, but for its reader's file. */
#include <stdio.h>

#include "mesh/read/reader.h"

typedef struct format_row {
    burnish_format_info info;
    int (*recognise)(const uint8_t *bytes, size_t size); /* 2: sure; 1: where the name is silent */
    burnish_status (*read)(burnish_reader *reader);
} format_row;

static const format_row formats[BURNISH_FORMAT_COUNT] = {
    [BURNISH_FORMAT_AUTO] = {.info = {"auto", "", 60, {0, 1, 0}, 0}},
    [BURNISH_FORMAT_BUILTIN] = {.info = {"builtin", "", 60, {0, 1, 0}, 0}},
    [BURNISH_FORMAT_ARRAYS] = {.info = {"arrays", "", 60, {0, 1, 0}, 0}},
    [BURNISH_FORMAT_OBJ] = {{"obj", ".obj", 60, {0, 1, 0}, 1},
                            burnish_recognise_obj,
                            burnish_read_obj},
    [BURNISH_FORMAT_PLY] = {{"ply", ".ply", 60, {0, 1, 0}, 1},
                            burnish_recognise_ply,
                            burnish_read_ply},
    [BURNISH_FORMAT_STL] = {{"stl", ".stl", 40, {0, 0, 1}, 1},
                            burnish_recognise_stl,
                            burnish_read_stl},
};

int burnish_format_count(void) {
    return BURNISH_FORMAT_COUNT;
}

const burnish_format_info *burnish_format_get_info(burnish_format format) {
    return (unsigned)format < BURNISH_FORMAT_COUNT ? &formats[format].info : NULL;
}

/* One of the endings, which blanks separate, in any case. */
static int has_ending(const char *name, const char *endings) {
    const size_t length = strlen(name);
    while (*endings) {
        const size_t size = strcspn(endings, " ");
        if (length >= size && burnish_bytes_are_caseless((const uint8_t *)name + length - size,
                                                         (const uint8_t *)endings, size)) {
            return 1;
        }
        endings += size + strspn(endings + size, " ");
    }
    return 0;
}

burnish_format burnish_guess_format(const uint8_t *bytes, size_t size, const char *name) {
    burnish_format guess = BURNISH_FORMAT_AUTO;
    int most = 0;
    for (int i = BURNISH_FORMAT_COUNT - 1; i > 0; --i) { /* OBJ, which is least sure, last */
        if (formats[i].recognise) {
            /* Sure bytes, then the name's ending, then bytes that are not sure. */
            const int sure = formats[i].recognise(bytes, size);
            const int votes = sure == 2                                           ? 3
                              : name && has_ending(name, formats[i].info.endings) ? 2
                                                                                  : sure;
            guess = votes > most ? (burnish_format)i : guess;
            most = votes > most ? votes : most;
        }
    }
    return guess;
}

burnish_status burnish_read(burnish_reader *reader, burnish_format *format) {
    const burnish_reader_input *input = reader->input;
    if (input->size == 0) {
        reader->is_binary = 1;
        return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, input->bytes,
                                   "the file is empty");
    }
    if (*format == BURNISH_FORMAT_AUTO) {
        *format = burnish_guess_format(input->bytes, input->size, input->name);
    }
    burnish_status status;
    if (formats[*format].read) {
        status = formats[*format].read(reader);
    } else {
        char names[64] = "";
        for (int i = 0; i < BURNISH_FORMAT_COUNT; ++i) {
            const size_t used = strlen(names);
            if (formats[i].read) {
                snprintf(names + used, sizeof names - used, "%s%s", used > 0 ? ", " : "",
                         formats[i].info.name);
            }
        }
        status = burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, NULL,
                                     "neither its name nor its first bytes tell the format; name "
                                     "it, one of %s",
                                     names);
    }
    burnish_release(reader->mesh->memory.context, reader->polygons);
    reader->polygons = NULL;
    return status;
}
