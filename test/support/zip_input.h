/* For tests: ZIP archives put together by hand, and 3MF in them. */
#ifndef BURNISH_TEST_ZIP_INPUT_H
#define BURNISH_TEST_ZIP_INPUT_H

#include "image/deflate.h"
#include "reader_input.h"

enum { ZIP_ROOM = 1 << 22 };

/* An archive that is being written: parts first, their directory at the end. */
typedef struct zip_list {
    uint8_t bytes[ZIP_ROOM], directory[ZIP_ROOM / 16];
    size_t size, directory_size;
    unsigned count;
} zip_list;

static inline void zip_bits(uint8_t **to, uint64_t bits, size_t size) {
    for (size_t i = 0; i < size; ++i) {
        *(*to)++ = (uint8_t)bits;
        bits >>= 8;
    }
}

/* The fields that both headers of a part share. */
static inline void zip_head(uint8_t **to, unsigned method, uint32_t crc, size_t packed, size_t size,
                            size_t name) {
    zip_bits(to, 20, 2); /* version */
    zip_bits(to, 0, 2);  /* flags */
    zip_bits(to, method, 2);
    zip_bits(to, 0, 4); /* time, date */
    zip_bits(to, crc, 4);
    zip_bits(to, packed, 4);
    zip_bits(to, size, 4);
    zip_bits(to, name, 2);
    zip_bits(to, 0, 2); /* extra field */
}

/* Appends a part, deflated or stored. */
static inline void put_part(zip_list *zip, const char *name, const void *bytes, size_t size,
                            int is_deflated) {
    const size_t name_size = strlen(name), header = zip->size;
    const uint32_t crc = burnish_deflate_crc32(bytes, size);
    size_t packed_size = size;
    uint8_t *to = zip->bytes + header + 30 + name_size, *p = zip->bytes + header;
    if (header + 30 + name_size + burnish_deflate_bound(size) > sizeof zip->bytes ||
        zip->directory_size + 46 + name_size > sizeof zip->directory) {
        abort();
    }
    if (is_deflated) {
        burnish_memory memory = burnish_memory_of(NULL, NULL);
        burnish_deflate *deflate = burnish_deflate_create(&memory);
        packed_size =
            burnish_deflate_band(deflate, bytes, size, 1, to, burnish_deflate_bound(size));
        burnish_deflate_destroy(NULL, deflate);
    } else {
        memcpy(to, bytes, size);
    }
    memcpy(p, "PK\3\4", 4);
    p += 4;
    zip_head(&p, is_deflated ? 8 : 0, crc, packed_size, size, name_size);
    memcpy(p, name, name_size);
    zip->size = (size_t)(to - zip->bytes) + packed_size;
    p = zip->directory + zip->directory_size;
    memcpy(p, "PK\1\2\24\0", 6);
    p += 6;
    zip_head(&p, is_deflated ? 8 : 0, crc, packed_size, size, name_size);
    zip_bits(&p, 0, 10); /* comment, disk, attributes */
    zip_bits(&p, header, 4);
    memcpy(p, name, name_size);
    zip->directory_size = (size_t)(p - zip->directory) + name_size;
    ++zip->count;
}

static inline void put_part_text(zip_list *zip, const char *name, const char *text) {
    put_part(zip, name, text, strlen(text), strlen(text) % 2 == 0);
}

/* Appends the directory and its end; is_64: with the numbers in records of 64 bits. */
static inline void end_zip(zip_list *zip, int is_64) {
    const size_t offset = zip->size;
    uint8_t *p = zip->bytes + offset;
    memcpy(p, zip->directory, zip->directory_size);
    p += zip->directory_size;
    if (is_64) {
        const size_t record = (size_t)(p - zip->bytes);
        memcpy(p, "PK\6\6", 4);
        p += 4;
        zip_bits(&p, 44, 8);
        zip_bits(&p, 45 | 45 << 16, 4);
        zip_bits(&p, 0, 8);
        zip_bits(&p, zip->count, 8);
        zip_bits(&p, zip->count, 8);
        zip_bits(&p, zip->directory_size, 8);
        zip_bits(&p, offset, 8);
        memcpy(p, "PK\6\7\0\0\0\0", 8);
        p += 8;
        zip_bits(&p, record, 8);
        zip_bits(&p, 1, 4);
    }
    memcpy(p, "PK\5\6\0\0\0\0", 8);
    p += 8;
    zip_bits(&p, is_64 ? 0xFFFF : zip->count, 2);
    zip_bits(&p, is_64 ? 0xFFFF : zip->count, 2);
    zip_bits(&p, is_64 ? 0xFFFFFFFF : zip->directory_size, 4);
    zip_bits(&p, is_64 ? 0xFFFFFFFF : offset, 4);
    zip_bits(&p, 0, 2);
    zip->size = (size_t)(p - zip->bytes);
}

/* Text with ' for ", which makes XML readable in C. */
static inline const char *quoted_text(const char *text) {
    static char quoted[ZIP_ROOM / 8];
    size_t size = 0;
    for (; text[size]; ++size) {
        quoted[size] = text[size] == '\'' ? '"' : text[size];
    }
    quoted[size] = 0;
    return quoted;
}

/* An archive with a model and the relationship that names it, not ended yet. */
static inline zip_list *begin_3mf(const char *model) {
    static zip_list zip;
    zip.size = zip.directory_size = zip.count = 0;
    put_part_text(
        &zip, "_rels/.rels",
        "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
        "<Relationship Id=\"a\" Target=\"/3D/a.model\" "
        "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>");
    put_part_text(&zip, "3D/a.model", quoted_text(model));
    return &zip;
}

/* The name of a second part, by what it is: settings of slicers, or anything else. */
static inline const char *second_part_name(const void *bytes, size_t size) {
    const char first = size > 0 ? *(const char *)bytes : 0;
    return first == '{'                                   ? "Metadata/project_settings.config"
           : first == ';'                                 ? "Metadata/Slic3r_PE.config"
           : size > 7 && memcmp(bytes, "<object", 7) == 0 ? "Metadata/layer_config_ranges.xml"
           : size > 7 && memcmp(bytes, "<config", 7) == 0 ? "Metadata/model_settings.config"
                                                          : "b";
}

/* An archive of the bytes before the first 0 and of those behind it: of 3MF or, if they are not XML,
 * of an OBJ file and its library. */
static inline zip_list *pack_parts(const char *bytes, size_t size) {
    static zip_list zip;
    const size_t first = strnlen(bytes, size), second = first < size ? size - first - 1 : 0;
    const char *rest = bytes + size - second;
    const int is_xml = *bytes == '<';
    zip.size = zip.directory_size = zip.count = 0;
    put_part(&zip, is_xml ? "3D/3dmodel.model" : "k/m/a.obj", bytes, first, 0);
    put_part(&zip, is_xml ? second_part_name(rest, second) : "k/l/b.mtl", rest, second, 0);
    end_zip(&zip, 0);
    return &zip;
}

static inline burnish_status run_3mf(zip_list *zip) {
    end_zip(zip, 0);
    return read_bytes(BURNISH_FORMAT_3MF, zip->bytes, zip->size);
}

static inline burnish_status read_3mf(const char *model) {
    return run_3mf(begin_3mf(model));
}

#endif
