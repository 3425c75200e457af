/* The shared part of importers: arguments, the sandbox, reading the input and writing the stream.
 */
#include "importer.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/srgb.h"
#include "mesh/read/io/zip.h"
#include "mesh/read/read.h"
#include "sandbox/lock.h"

enum { STREAM = 3, FIRST_READ = 1 << 20, BUFFER = 1 << 16 };

/* ---- Writing ---- */

static uint8_t buffer[BUFFER];
static size_t buffered;
static int stream_descriptor = STDOUT_FILENO;

static void flush_buffer(void) {
    for (size_t at = 0; at < buffered;) {
        const ssize_t count = write(stream_descriptor, buffer + at, buffered - at);
        if (count < 0 && errno != EINTR) {
            _exit(1); /* nobody listens */
        }
        at += count > 0 ? (size_t)count : 0;
    }
    buffered = 0;
}

void importer_put(const void *bytes, size_t size) {
    const uint8_t *next = bytes;
    while (size > 0) {
        const size_t room = BUFFER - buffered, part = size < room ? size : room;
        memcpy(buffer + buffered, next, part);
        buffered += part;
        next += part;
        size -= part;
        if (buffered == BUFFER) {
            flush_buffer();
        }
    }
}

void importer_put_word(uint32_t word) {
    const uint8_t bytes[4] = {(uint8_t)word, (uint8_t)(word >> 8), (uint8_t)(word >> 16),
                              (uint8_t)(word >> 24)};
    importer_put(bytes, sizeof bytes);
}

static void put_float(float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    importer_put_word(bits);
}

/* `count` values of 4 bytes. */
static void put_words(const void *values, uint64_t count) {
    const uint32_t one = 1;
    if (*(const uint8_t *)&one == 1) {
        importer_put(values, (size_t)count * 4);
        return;
    }
    for (uint64_t i = 0; i < count; ++i) {
        uint32_t word;
        memcpy(&word, (const uint8_t *)values + 4 * i, sizeof word);
        importer_put_word(word);
    }
}

static uint64_t padded_size(uint64_t size) {
    return (size + 3) & ~(uint64_t)3;
}

void importer_put_padded(const void *bytes, size_t size) {
    importer_put(bytes, size);
    importer_put("\0\0\0", (size_t)(padded_size(size) - size));
}

static uint64_t size_of(const importer_mesh *mesh, size_t text_size) {
    const unsigned vertex = 12 + (mesh->parts & BURNISH_BMS_NORMALS ? 12 : 0) +
                            (mesh->parts & BURNISH_BMS_COLORS ? 4 : 0) +
                            (mesh->parts & BURNISH_BMS_TEXCOORDS ? 8 : 0),
                   triangle = 12 + (mesh->parts & BURNISH_BMS_TRIANGLE_MATERIALS ? 4 : 0);
    uint64_t size = BURNISH_BMS_HEAD_SIZE + padded_size(text_size) +
                    (uint64_t)mesh->material_count * BURNISH_BMS_MATERIAL_SIZE +
                    mesh->vertex_count * vertex + mesh->triangle_count * triangle;
    for (uint32_t i = 0; i < mesh->texture_count; ++i) {
        size += BURNISH_BMS_TEXTURE_SIZE + padded_size(strlen(mesh->textures[i].name)) +
                padded_size(mesh->textures[i].size);
    }
    if (mesh->parts & BURNISH_BMS_NAMED_PARTS) {
        size += 4;
        for (uint32_t i = 0; i < mesh->named_part_count; ++i) {
            size += 8 + padded_size(strlen(mesh->named_parts[i].name));
        }
    }
    return size;
}

static void put_head(const importer_mesh *mesh, burnish_bms_kind kind, const char *text,
                     size_t text_size) {
    const uint64_t size = size_of(mesh, text_size);
    importer_put(BURNISH_BMS_MAGIC, 8);
    importer_put_word(BURNISH_BMS_VERSION);
    importer_put_word(kind);
    importer_put_word((uint32_t)size);
    importer_put_word((uint32_t)(size >> 32));
    importer_put_word((uint32_t)mesh->vertex_count);
    importer_put_word((uint32_t)mesh->triangle_count);
    importer_put_word(mesh->material_count);
    importer_put_word(mesh->texture_count);
    importer_put_word(mesh->parts);
    importer_put_word((uint32_t)text_size);
    put_words(mesh->up, 3);
    put_float(mesh->unit);
    importer_put_padded(text, text_size);
}

/* Clamps to [low, high]; low for NaN. */
static float clamped_between(float value, float low, float high) {
    return value > low ? value < high ? value : high : low;
}

static void put_colors(const float *values, size_t count, float high) {
    for (size_t i = 0; i < count; ++i) {
        put_float(clamped_between(values[i], 0, high));
    }
}

static void put_material(const importer_material *m) {
    put_colors(m->ambient, 3, 1);
    put_colors(m->diffuse, 3, 1);
    put_colors(m->specular, 3, 1);
    put_colors(m->emissive, 3, 1e6f);
    put_float(clamped_between(m->exponent, 1, 65536));
    put_float(clamped_between(m->opacity, 0, 1));
    put_float(clamped_between(m->metallic, 0, 1));
    put_float(clamped_between(m->roughness, 0, 1));
    put_float(clamped_between(m->alpha_cutoff, 0, 1));
    put_float(clamped_between(m->normal_scale, 0, 100));
    importer_put_word(m->flags);
    for (int i = 0; i < BURNISH_BMS_SLOTS; ++i) {
        importer_put_word(m->slots[i].texture);
        importer_put_word(m->slots[i].wrap[0] | (uint32_t)m->slots[i].wrap[1] << 8);
    }
    importer_put_word(0);
}

static void put_texture(const importer_texture *texture) {
    const size_t name_size = strlen(texture->name);
    importer_put_word(texture->kind);
    importer_put_word(texture->is_color ? 1 : 0);
    importer_put_word(texture->width);
    importer_put_word(texture->height);
    importer_put_word((uint32_t)name_size);
    importer_put_word(texture->size);
    importer_put_padded(texture->name, name_size);
    importer_put_padded(texture->bytes, texture->size);
}

static void put_parts(const importer_mesh *mesh) {
    importer_put_word(mesh->named_part_count);
    for (uint32_t i = 0; i < mesh->named_part_count; ++i) {
        const importer_part *part = &mesh->named_parts[i];
        const size_t size = strlen(part->name);
        importer_put_word(part->triangle_count);
        importer_put_word((uint32_t)size);
        importer_put_padded(part->name, size);
    }
}

static void put_mesh(const importer_mesh *mesh) {
    put_head(mesh, BURNISH_BMS_MESH, mesh->warnings, mesh->warnings_size);
    for (uint32_t i = 0; i < mesh->texture_count; ++i) {
        put_texture(&mesh->textures[i]);
    }
    if (mesh->parts & BURNISH_BMS_NAMED_PARTS) {
        put_parts(mesh);
    }
    for (uint32_t i = 0; i < mesh->material_count; ++i) {
        put_material(&mesh->materials[i]);
    }
    put_words(mesh->positions, 3 * mesh->vertex_count);
    if (mesh->parts & BURNISH_BMS_NORMALS) {
        put_words(mesh->normals, 3 * mesh->vertex_count);
    }
    if (mesh->parts & BURNISH_BMS_COLORS) {
        importer_put(mesh->colors, 4 * (size_t)mesh->vertex_count);
    }
    if (mesh->parts & BURNISH_BMS_TEXCOORDS) {
        put_words(mesh->texcoords, 2 * mesh->vertex_count);
    }
    put_words(mesh->indices, 3 * mesh->triangle_count);
    if (mesh->parts & BURNISH_BMS_TRIANGLE_MATERIALS) {
        put_words(mesh->triangle_materials, mesh->triangle_count);
    }
}

_Noreturn void importer_fail(burnish_bms_kind kind, const char *text) {
    const importer_mesh nothing = {0};
    const size_t first = strcspn(text, "\r\n"), size = first < 300 ? first : 300;
    buffered = 0;
    put_head(&nothing, kind, size > 0 ? text : "failed", size > 0 ? size : 6);
    importer_finish();
}

_Noreturn void importer_finish(void) {
    flush_buffer();
    _exit(0);
}

/* ---- Meshes ---- */

void importer_warn(importer_mesh *mesh, const char *text) {
    const size_t size = strlen(text);
    if (!strstr(mesh->warnings, text) && size + 2 < sizeof mesh->warnings - mesh->warnings_size) {
        memcpy(mesh->warnings + mesh->warnings_size, text, size);
        mesh->warnings[mesh->warnings_size + size] = '\n';
        mesh->warnings_size += size + 1;
    }
}

void *importer_zeroed(uint64_t count, size_t size) {
    void *items = count <= SIZE_MAX ? calloc(count > 0 ? (size_t)count : 1, size) : NULL;
    if (!items) {
        importer_fail(BURNISH_BMS_MEMORY_ERROR, "out of memory");
    }
    return items;
}

void importer_allocate(importer_mesh *mesh) {
    if (mesh->vertex_count >= UINT32_MAX - 1 || mesh->triangle_count >= UINT32_MAX / 3) {
        importer_fail(BURNISH_BMS_LIMIT_ERROR, "more than 1431655764 triangles, or 4294967294 "
                                               "vertices; split or simplify the mesh");
    }
    if (mesh->vertex_count == 0) {
        importer_fail(BURNISH_BMS_FORMAT_ERROR,
                      "no triangles that the importer reads; export meshes, not hulls or "
                      "curves");
    }
    mesh->positions = importer_zeroed(3 * mesh->vertex_count, sizeof *mesh->positions);
    mesh->indices = importer_zeroed(3 * mesh->triangle_count, sizeof *mesh->indices);
    if (mesh->parts & BURNISH_BMS_NORMALS) {
        mesh->normals = importer_zeroed(3 * mesh->vertex_count, sizeof *mesh->normals);
    }
    if (mesh->parts & BURNISH_BMS_COLORS) {
        mesh->colors = importer_zeroed(4 * mesh->vertex_count, 1);
        memset(mesh->colors, 255, (size_t)(4 * mesh->vertex_count));
    }
    if (mesh->parts & BURNISH_BMS_TEXCOORDS) {
        mesh->texcoords = importer_zeroed(2 * mesh->vertex_count, sizeof *mesh->texcoords);
    }
    if (mesh->parts & BURNISH_BMS_TRIANGLE_MATERIALS) {
        mesh->triangle_materials =
            importer_zeroed(mesh->triangle_count, sizeof *mesh->triangle_materials);
    }
}

void importer_add_part(importer_mesh *mesh, const char *name, uint64_t triangles) {
    const uint32_t count = mesh->named_part_count;
    const size_t size = strlen(name), kept = size < BURNISH_NAME_SIZE ? size : BURNISH_NAME_SIZE;
    if (triangles == 0) {
        return;
    }
    if ((count & (count - 1)) == 0) { /* a power of two is full */
        mesh->named_parts =
            realloc(mesh->named_parts, (count ? 2 * (size_t)count : 1) * sizeof *mesh->named_parts);
    }
    if (!mesh->named_parts) {
        importer_fail(BURNISH_BMS_MEMORY_ERROR, "out of memory");
    }
    importer_part *part = &mesh->named_parts[mesh->named_part_count++];
    *part = (importer_part){(uint32_t)triangles, importer_zeroed(kept + 1, 1)};
    memcpy(part->name, name, kept);
    mesh->parts |= BURNISH_BMS_NAMED_PARTS;
}

void importer_linear(const float srgb[3], float linear[3]) {
    for (int i = 0; i < 3; ++i) {
        linear[i] = burnish_srgb_value_to_linear(clamped_between(srgb[i], 0, 1));
    }
}

importer_material importer_default_material(void) {
    return (importer_material){.ambient = {.34f, .34f, .34f},
                               .diffuse = {.34f, .34f, .34f},
                               .specular = {.5f, .5f, .5f},
                               .exponent = 64,
                               .opacity = 1,
                               .roughness = 1,
                               .alpha_cutoff = .5f,
                               .normal_scale = 1,
                               .flags = BURNISH_BMS_HAS_DIFFUSE};
}

/* ---- The process ---- */

/* Reads standard input to its end. The sandbox forbids asking for its size. */
static importer_input read_input(const char *extension) {
    const off_t end = lseek(STDIN_FILENO, 0, SEEK_END);
    size_t size = 0, capacity = end > 0 ? (size_t)end + 1 : FIRST_READ;
    uint8_t *bytes = malloc(capacity);
    if (end >= 0) {
        lseek(STDIN_FILENO, 0, SEEK_SET);
    }
    while (bytes) {
        const ssize_t count = read(STDIN_FILENO, bytes + size, capacity - size);
        if (count < 0 && errno != EINTR) {
            importer_fail(BURNISH_BMS_FORMAT_ERROR, "the file can't be read");
        }
        if (count == 0) {
            break;
        }
        size += count > 0 ? (size_t)count : 0;
        if (size == capacity) {
            capacity *= 2;
            bytes = realloc(bytes, capacity);
        }
    }
    if (!bytes) {
        importer_fail(BURNISH_BMS_MEMORY_ERROR, "out of memory for the file");
    }
    if (size == 0) {
        importer_fail(BURNISH_BMS_FORMAT_ERROR, "the file is empty");
    }
    return (importer_input){bytes, size, extension};
}

static int ends_with(const burnish_zip_part *part, const char *extension) {
    const size_t size = strlen(extension), name = part->name_size;
    if (name < size + 1 || part->name[name - size - 1] != '.') {
        return 0;
    }
    for (size_t i = 0; i < size; ++i) {
        const uint8_t c = part->name[name - size + i];
        if ((c >= 'A' && c <= 'Z' ? c + 'a' - 'A' : c) != extension[i]) {
            return 0;
        }
    }
    return 1;
}

/* The first part with that extension; NULL: the format is an archive itself. */
static const burnish_zip_part *find_part(const burnish_zip *zip, const char *extension) {
    for (size_t i = 0; i < zip->count; ++i) {
        if (ends_with(&zip->parts[i], extension)) {
            return &zip->parts[i];
        }
    }
    return NULL;
}

/* If the file is an archive with a file of the same extension, the input becomes that
 * file. Formats that are archives themselves (.zae, .ifczip) are not unpacked. It may
 * unpack to BURNISH_UNPACKED_PER_BYTE bytes per byte. Errors: FORMAT, LIMIT, MEMORY. */
static burnish_status unpack_archive(importer_input *input, burnish_error *error) {
    const burnish_load_options options = {.max_input_bytes = (uint64_t)1 << 34};
    const burnish_reader_input wrapped = {
        .bytes = input->bytes, .size = input->size, .name = "zip", .options = &options};
    burnish_mesh_data data = {.memory = burnish_memory_of(NULL, error)};
    burnish_reader reader = {.input = &wrapped, .mesh = &data, .error = error};
    burnish_zip zip;
    uint8_t *bytes;
    size_t size;
    if (input->size < 4 || memcmp(input->bytes, "PK\3\4", 4) != 0) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status = burnish_zip_open(&zip, &reader);
    const burnish_zip_part *part =
        status == BURNISH_STATUS_OK ? find_part(&zip, input->extension) : NULL;
    if (part) {
        status = burnish_zip_read(&zip, part, &bytes, &size);
    }
    if (part && status == BURNISH_STATUS_OK) {
        input->bytes = bytes;
        input->size = size;
    }
    burnish_zip_close(&zip);
    return status;
}

void importer_unpack(importer_input *input) {
    const burnish_load_options options = {.max_input_bytes = UINT64_MAX};
    burnish_reader_input wrapped = {
        .bytes = input->bytes, .size = input->size, .name = "gzip", .options = &options};
    burnish_error error = {0};
    burnish_memory memory = burnish_memory_of(NULL, &error);
    uint8_t *unpacked;
    burnish_status status = burnish_unpack_input(&wrapped, &memory, &unpacked);
    input->bytes = wrapped.bytes;
    input->size = wrapped.size;
    if (status == BURNISH_STATUS_OK) {
        status = unpack_archive(input, &error);
    }
    if (status != BURNISH_STATUS_OK) {
        importer_fail(status == BURNISH_STATUS_LIMIT    ? BURNISH_BMS_LIMIT_ERROR
                      : status == BURNISH_STATUS_MEMORY ? BURNISH_BMS_MEMORY_ERROR
                                                        : BURNISH_BMS_FORMAT_ERROR,
                      error.text);
    }
}

/* Discards standard output and error from here on, because libraries print to them. */
static void discard_output(void) {
    const int opened = open("/dev/null", O_RDWR);
    const int nothing = opened >= 0 ? fcntl(opened, F_DUPFD, STREAM + 1) : -1; /* not STREAM */
    if (nothing < 0 || dup2(STDOUT_FILENO, STREAM) < 0 || dup2(nothing, STDOUT_FILENO) < 0 ||
        dup2(nothing, STDERR_FILENO) < 0) {
        _exit(1);
    }
    stream_descriptor = STREAM;
}

int main(int count, char **arguments) {
    static importer_mesh mesh;
    char extension[32] = "";
    if (count != 2 || arguments[1][0] == '-' || strlen(arguments[1]) >= sizeof extension) {
        fprintf(stderr,
                "usage: %s EXTENSION <FILE >STREAM   (fbx, dae, ...: the file extension)\n"
                "burnish runs it itself: burnish render part.EXTENSION\n",
                importer_name);
        return 2;
    }
    for (size_t i = 0; arguments[1][i]; ++i) {
        const char c = arguments[1][i];
        extension[i] = (char)(c >= 'A' && c <= 'Z' ? c + 'a' - 'A' : c);
    }
    discard_output();
    importer_prepare();
    const char *wall;
    const int code = sandbox_lock(STREAM + 1, 1, &wall);
    if (code != 0) {
        char text[160];
        snprintf(text, sizeof text, "can't enter its sandbox (%s: %s)", wall, strerror(code));
        importer_fail(BURNISH_BMS_FORMAT_ERROR, text);
    }
    importer_input input = read_input(extension);
    importer_import(&input, &mesh);
    put_mesh(&mesh);
    importer_finish();
}
