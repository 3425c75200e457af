/* ZIP archives in memory (PKWARE, APPNOTE.TXT 6.3.9), as far as Open Packaging uses them: parts
 * stored or deflated, also of more than 4 GiB: for 3MF, and for importers. An archive is not
 * trusted: the unpacked size of all parts together is limited, and the size and checksum of each
 * part are compared.
 *
 * libzip was measured: the libraries that it loads (OpenSSL, bzip2) double the time that the
 * program takes to start and end, by a millisecond. It can only allocate with malloc. */
#ifndef BURNISH_MESH_READ_IO_ZIP_H
#define BURNISH_MESH_READ_IO_ZIP_H

#include "image/decode/gunzip.h"
#include "mesh/read/io/reader.h"

typedef struct burnish_zip_part {
    const uint8_t *name; /* name_size bytes of the archive */
    uint32_t name_size;
    uint32_t crc;
    uint16_t method, flags;
    uint64_t packed_size, size, header; /* header: offset of its local header */
    uint32_t user_data;                 /* the caller's; 0 at first */
} burnish_zip_part;

typedef struct burnish_zip {
    burnish_reader *reader;
    burnish_zip_part *parts; /* sorted by their names */
    size_t count;
    uint64_t left; /* bytes that parts may still unpack to */
} burnish_zip;

/* Lists the parts of the reader's input. Errors: FORMAT, MEMORY. */
burnish_status burnish_zip_open(burnish_zip *zip, burnish_reader *reader);
void burnish_zip_close(burnish_zip *zip);

/* The first part of a name, in whatever case (Open Packaging's rule); NULL: there is none. */
burnish_zip_part *burnish_zip_find(const burnish_zip *zip, const char *name);

/* A part that is unpacked step by step. */
typedef struct burnish_zip_stream {
    burnish_zip *zip;
    const burnish_zip_part *part;
    char name[84]; /* for messages */
    const uint8_t *from;
    size_t from_left;
    burnish_inflate *inflate; /* NULL: the part is stored */
    uint64_t written;
    uint32_t crc;
    int has_ended;
} burnish_zip_stream;

/* Errors: FORMAT (damaged, a way of packing that is not read), MEMORY. The stream is closed by
 * burnish_zip_end in any case. */
burnish_status burnish_zip_begin(burnish_zip *zip, const burnish_zip_part *part,
                                 burnish_zip_stream *stream);

/* Fills `to`; fewer bytes than `room` at the end of the part. Errors: FORMAT (damaged), LIMIT. */
burnish_status burnish_zip_next(burnish_zip_stream *stream, uint8_t *to, size_t room,
                                size_t *written);
void burnish_zip_end(burnish_zip_stream *stream);

/* Reads a whole part, to be released by the caller, with a 0 after it; *bytes is NULL on error.
 * Errors: FORMAT, LIMIT, MEMORY. */
burnish_status burnish_zip_read(burnish_zip *zip, const burnish_zip_part *part, uint8_t **bytes,
                                size_t *size);

#endif
