/* What readers share: their input, their row in the table of formats, and their messages. */
#ifndef BURNISH_MESH_READ_READER_H
#define BURNISH_MESH_READ_READER_H

#include "mesh/mesh.h"
#include "mesh/read/io/lexer.h"

typedef struct burnish_reader_input {
    const uint8_t *bytes; /* size > 0 bytes; nothing is assumed to follow them */
    size_t size;
    size_t packed_size; /* bytes that these were before they were unpacked; 0: just so many */
    const char *name;   /* for messages */
    const burnish_load_options *options;
    burnish_file_loader companions;      /* load NULL: there are none */
    const struct burnish_pieces *pieces; /* pieces.h: only the head is at `bytes`; NULL: all */
    double *told;                        /* the progress that the context knows of; NULL: none */
} burnish_reader_input;

/* A face of 4 corners or more: a fan until all positions are there, then cut by them. */
typedef struct burnish_polygon {
    uint32_t first_triangle, corner_count;
} burnish_polygon;

/* One reading of one input. */
typedef struct burnish_reader {
    const burnish_reader_input *input;
    burnish_mesh_data *mesh; /* what is filled; its memory and tasks are the reader's */
    burnish_error *error;
    int is_binary;          /* messages tell bytes, not lines */
    int is_wide;            /* 1: the file's coordinates may be more than floats hold */
    int has_warned;         /* 1: of an input in pieces, which is read whole then to say it */
    const uint8_t *counted; /* lines are counted up to here: NULL before the first */
    size_t line;
    burnish_polygon *polygons;
    size_t polygon_count, polygon_capacity;
    struct burnish_texture_names *textures; /* textures.h: those asked for; NULL before the first */
    uint64_t companion_bytes; /* of buffers and textures that the input names, read so far */
    uint64_t *companions;     /* budget.h: which files these were */
    size_t companion_count, companion_capacity;
    uint64_t unpacked_bytes; /* of parts, views and the like, so far: budget.h */
} burnish_reader;

/* burnish_fail() and burnish_mesh_data_warn() with a location in front: "NAME:LINE: ..." of the
 * byte at, or "NAME: byte N: ..." in a binary file; "NAME: ..." for at NULL. */
__attribute__((format(printf, 4, 5))) burnish_status burnish_reader_fail(burnish_reader *reader,
                                                                         burnish_status status,
                                                                         const uint8_t *at,
                                                                         const char *format, ...);
__attribute__((format(printf, 3, 4))) void
burnish_reader_warn(burnish_reader *reader, const uint8_t *at, const char *format, ...);

/* Warnings of one kind, which make one line: the first, and how many more there were. All zero
 * before the first. */
typedef struct burnish_warning_group {
    size_t count;
    burnish_error first; /* its line */
} burnish_warning_group;

/* Adds a warning to a group; format and location as for burnish_reader_warn. */
__attribute__((format(printf, 4, 5))) void burnish_reader_note(burnish_reader *reader,
                                                               burnish_warning_group *group,
                                                               const uint8_t *at,
                                                               const char *format, ...);
/* Warns of a group, once it is complete; of an empty one not. */
void burnish_reader_warn_group(burnish_reader *reader, const burnish_warning_group *group);

/* What to say of a number that can't be taken, and of `what` ("coordinate", "Kd" ...) it is. */
typedef struct burnish_number_text {
    char text[160];
} burnish_number_text;
burnish_number_text burnish_describe_number(const char *what, burnish_token token,
                                            burnish_number_status status);

/* LIMIT: more triangles than the options allow. */
burnish_status burnish_fail_triangles(burnish_reader *reader, const uint8_t *at);

/* Makes everything opaque, with a warning, if all triangles of what has been read are wholly
 * transparent. */
void burnish_reader_show_transparent(burnish_reader *reader);

/* Releases what a reading needed, and warns of textures that could not be had. */
void burnish_reader_close(burnish_reader *reader);

/* ---- Formats ---- */

/* Reads an input of a format, or of the one that its bytes and name tell where that is AUTO:
 * *format says which it was. Errors: FORMAT, LIMIT, MEMORY, CANCELLED. */
burnish_status burnish_read(burnish_reader *reader, burnish_format *format);

/* The format that bytes and name tell of; AUTO when neither does. */
burnish_format burnish_guess_format(const uint8_t *bytes, size_t size, const char *name);

/* Whether a stream that begins with some bytes, and is longer, may be of a format, or of any where
 * that is AUTO; keeps an endless stream of something else from filling the memory. Says yes where
 * it can't know.
 *   format  BURNISH_FORMAT_COUNT: any bytes will do */
int burnish_may_be(burnish_format format, const uint8_t *bytes, size_t size, const char *name);

/* Of each format: whether bytes are of it (2: surely, whatever the name says; 1: where the name
 * says nothing; 0: no), and its reader, which fills reader->mesh, its positions
 * less reader->mesh->origin. Errors: as burnish_read. */
#define BURNISH_READER_DECLARE(name, word, ...)                                                    \
    int burnish_recognise_##word(const uint8_t *bytes, size_t size);                               \
    burnish_status burnish_read_##word(burnish_reader *reader);
BURNISH_FORMAT_LIST(BURNISH_READER_DECLARE)
#undef BURNISH_READER_DECLARE

#endif
