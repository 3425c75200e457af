/* Decompresses gzip files. Memory grows with the output, up to the caller's limit. */
#include "image/decode/gunzip.h"

#include "base/error.h"

static burnish_status fail_limit(burnish_memory *memory, const burnish_gzip_file *file) {
    const burnish_shown_name shown = burnish_show_name(file->name);
    return file->max_bytes > file->budget
               ? burnish_fail(
                     memory->error, BURNISH_STATUS_LIMIT,
                     "%s: its %zu bytes unpack to more than %llu; unpack it first if that is right",
                     shown.text, file->size, (unsigned long long)file->budget)
               : burnish_fail(memory->error, BURNISH_STATUS_LIMIT,
                              "%s: unpacks to more than the limit of %llu bytes; raise the limit "
                              "or simplify the mesh",
                              shown.text, (unsigned long long)file->max_bytes);
}

/* Decompresses all members into *items, *count bytes. Bytes after the last member that do not begin
 * another one are padding. */
static burnish_status unpack_members(burnish_inflate *inflate, const burnish_gzip_file *file,
                                     burnish_memory *memory, uint8_t **items, size_t *count) {
    const uint64_t bound = file->max_bytes < file->budget ? file->max_bytes : file->budget;
    const uint8_t *bytes = file->bytes;
    size_t capacity = 0, left = file->size;
    burnish_inflate_result result = BURNISH_INFLATE_MORE;
    while (result != BURNISH_INFLATE_END || burnish_is_gzip(bytes, left)) {
        size_t written = 0;
        const size_t before = left;
        *items = burnish_reserve(memory, *items, &capacity, *count + 1, 1, file->name);
        if (memory->status != BURNISH_STATUS_OK) {
            return memory->status;
        }
        result = burnish_inflate_step(inflate, &bytes, &left, *items + *count, capacity - *count,
                                      &written);
        *count += written;
        if (result == BURNISH_INFLATE_MEMORY) {
            return memory->status = BURNISH_STATUS_MEMORY;
        }
        if (*count > bound) {
            return fail_limit(memory, file);
        }
        if (result == BURNISH_INFLATE_DAMAGED ||
            (result == BURNISH_INFLATE_MORE && written == 0 && (left == 0 || left == before))) {
            return burnish_fail(
                memory->error, BURNISH_STATUS_FORMAT, "%s: byte %zu: the gzip file is %s",
                burnish_show_name(file->name).text, file->size - left,
                result == BURNISH_INFLATE_DAMAGED ? "damaged; fetch it again" : "truncated");
        }
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_gunzip(const burnish_gzip_file *file, burnish_memory *memory,
                              uint8_t **unpacked, size_t *unpacked_size) {
    burnish_inflate *inflate = burnish_inflate_create(memory, 0);
    *unpacked = NULL;
    *unpacked_size = 0;
    if (!inflate) {
        return memory->status;
    }
    burnish_status status = unpack_members(inflate, file, memory, unpacked, unpacked_size);
    burnish_inflate_destroy(memory->context, inflate);
    if (status != BURNISH_STATUS_OK) {
        burnish_release(memory->context, *unpacked);
        *unpacked = NULL;
    }
    return status;
}
