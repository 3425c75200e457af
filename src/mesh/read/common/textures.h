/* Textures that an input names or holds, decoded and appended to the mesh.
 *
 * A texture that can't be had is a warning, of which there is one for all of an input. */
#ifndef BURNISH_MESH_READ_COMMON_TEXTURES_H
#define BURNISH_MESH_READ_COMMON_TEXTURES_H

#include "mesh/read/io/reader.h"

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

/* The same from pixels of 4 bytes a texel, rows from the top, which are copied.
 *   width, height  in [1, BURNISH_TEXTURE_SIZE_MAX] */
int burnish_reader_copy_texture(burnish_reader *reader, const uint8_t *at, const char *name,
                                int width, int height, const uint8_t *pixels, int is_color);

/* A picture that is going to be asked for: bytes of the input, with the name that it will be
 * decoded by; or, where bytes is NULL, the file of that name. */
typedef struct burnish_texture_source {
    const uint8_t *bytes;
    size_t size;
    const char *name;
} burnish_texture_source;

/* Decodes pictures side by side, where the reader has several threads. Changes nothing but the time
 * that the functions above take: what they return, in which order warnings come, and how many
 * texels there are at most. Bytes and names must stay until burnish_reader_drop_ahead, which
 * releases what nobody asked for. */
void burnish_reader_decode_ahead(burnish_reader *reader, const burnish_texture_source *sources,
                                 size_t count);
void burnish_reader_drop_ahead(burnish_reader *reader);

/* Whether corners need their texture coordinates where an input may use textures. */
static inline int burnish_reader_keeps_coordinates(const burnish_reader *reader,
                                                   int may_use_textures) {
    const burnish_load_options *options = reader->input->options;
    return options->keep_texture_coordinates || (may_use_textures && !options->ignore_textures);
}

/* Releases what a reading needed, and warns of textures that could not be had. */
void burnish_reader_close(burnish_reader *reader);

#endif
