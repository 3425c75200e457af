/* Shared by readers: the input, messages, and the functions of a format. */
#ifndef BURNISH_MESH_READ_IO_READER_H
#define BURNISH_MESH_READ_IO_READER_H

#include "mesh/data/data.h"
#include "mesh/read/io/lexer.h"

typedef struct burnish_reader_input {
    const uint8_t *bytes; /* size > 0 bytes, not necessarily followed by a 0 */
    size_t size;
    size_t packed_size; /* bytes before unpacking; 0: was not packed */
    const char *name;   /* for messages */
    const burnish_load_options *options;
    burnish_file_loader companions; /* load NULL: not available */
    const char *folder; /* of the input, below the one that companions are loaded from; NULL: the
                           same one, and nothing may be outside it */
    int is_archived;    /* 1: companions are parts of the input, and counted when unpacked */
    const struct burnish_streaming
        *streamed;        /* streaming.h: only the head is at `bytes`; NULL: all */
    size_t chunk_size;    /* bytes of a chunk of text; 0: BURNISH_CHUNK_SIZE. Only tests set it. */
    uint8_t *joint_found; /* receives 1 for each joint of the options that the robot has; NULL: it
                             must have all */
    double *told;         /* the progress last reported to the context; NULL: not reported */
} burnish_reader_input;

/* A face of 4 corners or more: a fan until all positions are there, then cut by them. */
typedef struct burnish_polygon {
    uint32_t first_triangle, corner_count;
} burnish_polygon;

/* Corners up to which a concave polygon is cut properly; beyond, it becomes a fan. */
#define BURNISH_POLYGON_CORNERS 256

/* Warnings of one kind, reported in one line: the first, and how many more there were. All zero
 * before the first. */
typedef struct burnish_warning_group {
    size_t count;
    burnish_error first; /* its line */
} burnish_warning_group;

/* One reading of one input. */
typedef struct burnish_reader {
    const burnish_reader_input *input;
    burnish_mesh_data *mesh; /* what is filled; its memory and tasks are the reader's */
    burnish_error *error;
    int is_binary;  /* messages give bytes, not lines */
    int is_wide;    /* 1: the file's coordinates may exceed float precision */
    int has_warned; /* 1: a streamed input has a warning, and must be read whole to report it */
    burnish_warning_group damage; /* values and faces that are left out: common/damage.h */
    burnish_warning_group odd;    /* numbers that are accepted in an unusual form */
    int may_lack;                 /* 1: points that are not finite are missing, no damage */
    int has_bad_faces;            /* some of the damage is in faces */
    const uint8_t *counted;       /* lines are counted up to here: NULL before the first */
    size_t line;
    burnish_polygon *polygons;
    size_t polygon_count, polygon_capacity;
    struct burnish_texture_names
        *textures;            /* textures.h: requested textures; NULL before the first */
    uint64_t companion_bytes; /* bytes of buffers and textures that the input names, read so far */
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

/* Adds a warning to a group; format and location as for burnish_reader_warn. */
__attribute__((format(printf, 4, 5))) void burnish_reader_note(burnish_reader *reader,
                                                               burnish_warning_group *group,
                                                               const uint8_t *at,
                                                               const char *format, ...);
/* Reports a complete group; does nothing if it is empty. */
void burnish_reader_warn_group(burnish_reader *reader, const burnish_warning_group *group);

/* A message for a number that can't be used; `what` names it ("coordinate", "Kd" ...). */
typedef struct burnish_number_text {
    char text[160];
} burnish_number_text;
burnish_number_text burnish_describe_number(const char *what, burnish_token token,
                                            burnish_number_status status);

/* LIMIT: more triangles than the options allow. */
burnish_status burnish_fail_triangles(burnish_reader *reader, const uint8_t *at);

/* A format's functions. */
typedef struct burnish_format_reader {
    /* 2: the bytes are certainly of this format, whatever the name says; 1: if the name does not
     * say otherwise; 0: they are not. */
    int (*recognise)(const uint8_t *bytes, size_t size);
    /* Fills reader->mesh, with positions less reader->mesh->origin. Errors: as burnish_read. */
    burnish_status (*read)(burnish_reader *reader);
    int averages_normals; /* 1: tools that write the format average normals across edges */
    int can_stream;       /* 1: the reader also takes inputs of which only the head is in memory */
} burnish_format_reader;

#define BURNISH_READER_DECLARE(name, word, ...)                                                    \
    extern const burnish_format_reader burnish_reader_##word;
BURNISH_FORMAT_LIST(BURNISH_READER_DECLARE)
#undef BURNISH_READER_DECLARE

#endif
