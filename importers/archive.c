/* Files packed by zip. */
#include "archive.h"

#include <string.h>

static int is_archive(const importer_input *input) {
    return input->size >= 4 && memcmp(input->bytes, "PK\3\4", 4) == 0;
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

burnish_status importer_unpack_archive(importer_input *input, burnish_error *error) {
    const burnish_load_options options = {.max_input_bytes = (uint64_t)1 << 34};
    const burnish_reader_input wrapped = {
        .bytes = input->bytes, .size = input->size, .name = "zip", .options = &options};
    burnish_mesh_data data = {.memory = burnish_memory_of(NULL, error)};
    burnish_reader reader = {.input = &wrapped, .mesh = &data, .error = error};
    burnish_zip zip;
    uint8_t *bytes;
    size_t size;
    if (!is_archive(input)) {
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
