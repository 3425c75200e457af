/* What every command that loads a mesh takes. */
#include "cli/input.h"

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
