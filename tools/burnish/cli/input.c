/* What every command that loads a mesh takes. */
#include "cli/input.h"

#include <string.h>

#define WORD(name, word, ...)                                                                      \
    , {                                                                                            \
#word, BURNISH_FORMAT_##name                                                               \
    }
const cli_word cli_input_formats[] = {{"auto", BURNISH_FORMAT_AUTO} BURNISH_FORMAT_LIST(WORD),
                                      {NULL, 0}};
#define MANUAL(name, word, ...) "*" #word "*, "
const char cli_input_format_manual[] = "Format of _INPUT_: " BURNISH_FORMAT_LIST(
    MANUAL) "or *auto*, which looks at the name's ending and the first bytes.";

burnish_load_options cli_load_options(const cli_input *input) {
    burnish_load_options options = burnish_load_options_default();
    options.format = (burnish_format)input->format;
    options.tessellation = input->tessellation;
    options.strict = input->strict;
    if (input->animation_time.given) {
        options.animation_time = input->animation_time.value;
    }
    options.animation = input->animation;
    options.no_companions = input->no_libraries;
    options.point_size = input->point_size.given ? input->point_size.value : 0;
    options.max_triangles = input->max_triangles;
    options.max_input_bytes = input->max_input_bytes;
    options.ignore_textures = input->no_textures;
    options.max_texture_pixels = input->max_texture_pixels;
    return options;
}

static burnish_status load_companion(void *user_data, const char *name, uint64_t max_bytes,
                                     const void **bytes, size_t *size, burnish_error *error) {
    const cli_companions *companions = user_data;
    for (size_t i = 0; i < companions->count; ++i) {
        const cli_companion *found = &companions->items[i];
        if (strcmp(found->name, name) == 0 && found->size <= max_bytes) {
            *bytes = found->bytes;
            *size = found->size;
            return BURNISH_STATUS_OK;
        }
    }
    return cli_fail(error, BURNISH_STATUS_READ,
                    "%.300s: is not among the files that came with it; hand it over too", name);
}

burnish_file_loader cli_companion_loader(cli_companions *companions) {
    return (burnish_file_loader){.load = load_companion, .user_data = companions};
}
