/* Textures that an input names or holds, decoded and appended to the mesh.
 *
 * A texture that can't be had is a warning, of which there is one for all of an input. */
#ifndef BURNISH_MESH_READ_TEXTURES_H
#define BURNISH_MESH_READ_TEXTURES_H

#include "mesh/read/reader.h"

/* The texture in the file `name`, decoded as RGBA. Its name is the input's, not to be trusted:
 * backslashes count as slashes; where it leads out of the input's folder, or to nothing, its last
 * part is looked for beside the input. Equal names give one texture.
 *   at        the byte of the input to tell of in a warning; NULL: none
 *   is_color  1: sRGB; 0: numbers
 * Returns 1 + its number in the mesh; 0 where it can't be had, after a warning, and when memory is
 * out (reader->mesh->memory). */
int burnish_reader_load_texture(burnish_reader *reader, const uint8_t *at, const char *name,
                                int is_color);

/* The same from a picture's bytes. name: for messages; equal ones are not taken for one texture. */
int burnish_reader_decode_texture(burnish_reader *reader, const uint8_t *at, const char *name,
                                  const uint8_t *bytes, size_t size, int is_color);

/* Whether corners need their texture coordinates where an input may use textures. */
static inline int burnish_reader_keeps_coordinates(const burnish_reader *reader,
                                                   int may_use_textures) {
    const burnish_load_options *options = reader->input->options;
    return options->keep_texture_coordinates || (may_use_textures && !options->ignore_textures);
}

/* Warns of what could not be had, and releases what was remembered; burnish_read calls it. */
void burnish_reader_close_textures(burnish_reader *reader);

#endif
