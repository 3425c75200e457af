#include "mesh/read/io/budget.h"

#include <string.h>

burnish_status burnish_budget_check(burnish_reader *reader, uint64_t vertices, uint64_t triangles) {
    const uint64_t bytes = burnish_budget_bytes(reader);
    const uint64_t most = burnish_budget_of(bytes, BURNISH_ELEMENTS_PER_BYTE);
    if (reader->input->options->max_triangles < BURNISH_TRIANGLES_MAX ||
        (vertices <= most && triangles <= most - vertices)) {
        return BURNISH_STATUS_OK;
    }
    return burnish_reader_fail(reader, BURNISH_STATUS_LIMIT, NULL,
                               "its %llu bytes become more than %llu vertices and triangles; set "
                               "--max-triangles to draw them%s",
                               (unsigned long long)bytes, (unsigned long long)most,
                               bytes < reader->input->size ? ", or unpack the file first" : "");
}

uint64_t burnish_budget_room(const burnish_reader_input *input) {
    const uint64_t limit = input->options->max_memory,
                   used = BURNISH_RUN_BYTES + (input->streamed ? 0 : (uint64_t)input->size);
    return limit == 0 ? UINT64_MAX : limit < used ? 0 : (limit - used) / BURNISH_ELEMENT_BYTES;
}

uint64_t burnish_companion_key(const char *name) {
    uint64_t key = UINT64_C(0xCBF29CE484222325); /* FNV-1a */
    while (*name) {
        const size_t size = strcspn(name, "/\\");
        const int is_skipped = size == 0 || (size == 1 && *name == '.');
        for (size_t i = 0; i <= size && !is_skipped; ++i) { /* with one separator */
            const uint8_t c = i < size ? (uint8_t)name[i] : '/';
            key = (key ^ (c >= 'A' && c <= 'Z' ? c | 32u : c)) * UINT64_C(0x100000001B3);
        }
        name += size + (name[size] != 0);
    }
    return key;
}

int burnish_budget_companion(burnish_reader *reader, uint64_t key, uint64_t size) {
    if (reader->input->is_archived) {
        return 1;
    }
    for (size_t i = 0; i < reader->companion_count; ++i) {
        if (reader->companions[i] == key) {
            const int is_left = size <= burnish_budget_unpacked_left(reader);
            reader->unpacked_bytes += is_left ? size : 0;
            return is_left;
        }
    }
    reader->companions =
        burnish_reserve(&reader->mesh->memory, reader->companions, &reader->companion_capacity,
                        reader->companion_count + 1, sizeof *reader->companions, "names of files");
    if (reader->mesh->memory.status != BURNISH_STATUS_OK) {
        return 0;
    }
    reader->companions[reader->companion_count++] = key;
    reader->companion_bytes += size;
    return 1;
}
