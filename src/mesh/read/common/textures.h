/* Textures that an input names or holds, decoded and appended to the mesh.
 *
 * Missing textures are skipped, with one warning per input. */
#ifndef BURNISH_MESH_READ_COMMON_TEXTURES_H
#define BURNISH_MESH_READ_COMMON_TEXTURES_H

#include "mesh/read/io/reader.h"

/* The texture in the file `name`, decoded as RGBA. The name comes from the input and is not
 * trusted. Backslashes count as slashes. If the name leads out of the root, or no file has it, its
 * last part is searched for next to the input and in the usual folders there, and next to the
 * input's folder if the root contains it. Equal names give one texture.
 *   at        the byte of the input for the location of a warning; NULL: no location
 *   is_color  1: sRGB; 0: numbers
 * Returns 1 + its number in the mesh; 0 after a warning if it can't be loaded, or if memory is out
 * (reader->mesh->memory). */
int burnish_reader_load_texture(burnish_reader *reader, const uint8_t *at, const char *name,
                                int is_color);

/* The same from a picture's bytes. name: for messages only; equal names give separate textures. */
int burnish_reader_decode_texture(burnish_reader *reader, const uint8_t *at, const char *name,
                                  const uint8_t *bytes, size_t size, int is_color);

/* The same from pixels of 4 bytes a texel, rows from the top, which are copied.
 *   width, height  in [1, BURNISH_TEXTURE_SIZE_MAX] */
int burnish_reader_copy_texture(burnish_reader *reader, const uint8_t *at, const char *name,
                                int width, int height, const uint8_t *pixels, int is_color);

/* A picture that will be requested: bytes of the input, with the name for decoding them; or, if
 * bytes is NULL, the file of that name. */
typedef struct burnish_texture_source {
    const uint8_t *bytes;
    size_t size;
    const char *name;
} burnish_texture_source;

/* Decodes pictures in parallel, if the reader has several threads. This affects only the time that
 * the functions above take, not their results, the order of warnings, or the limit on texels. Bytes
 * and names must remain valid until burnish_reader_drop_ahead, which releases pictures that were
 * not requested. */
void burnish_reader_decode_ahead(burnish_reader *reader, const burnish_texture_source *sources,
                                 size_t count);
void burnish_reader_drop_ahead(burnish_reader *reader);

/* Whether corners need their texture coordinates, for an input that may use textures. */
static inline int burnish_reader_keeps_coordinates(const burnish_reader *reader,
                                                   int may_use_textures) {
    const burnish_load_options *options = reader->input->options;
    return options->keep_texture_coordinates || (may_use_textures && !options->ignore_textures);
}

/* Releases the memory of a reading, and warns of textures that could not be loaded. */
void burnish_reader_close(burnish_reader *reader);

#endif
