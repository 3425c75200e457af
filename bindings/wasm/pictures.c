/* Images that the caller decodes: loading a mesh lists the images of its materials, the caller
 * decodes them, and the mesh is loaded again with them. */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/wasm/module.h"
#include "image/decode/decode.h"
#include "mesh/read/io/beside.h"

/* A file that a material refers to, and its decoded pixels. */
typedef struct wanted {
    uint8_t *bytes;
    size_t size;
    uint8_t *pixels; /* RGBA, rows from the top; NULL: not decoded */
    int width, height;
} wanted;

WASM_EXPORT(picture_bytes) const uint8_t *picture_bytes(size_t index);
WASM_EXPORT(picture_size) size_t picture_size(size_t index);
WASM_EXPORT(picture_pixels) uint8_t *picture_pixels(size_t index, int width, int height);
WASM_EXPORT(picture_forget) void picture_forget(void);

/* Lives from one load to the next, because the loader has no other way to reach the caller. */
static struct {
    wanted *items;
    size_t count;
} list;

/* The bytes of a requested file, NULL past the last. */
const uint8_t *picture_bytes(size_t index) {
    return index < list.count ? list.items[index].bytes : NULL;
}

size_t picture_size(size_t index) {
    return index < list.count ? list.items[index].size : 0;
}

/* Memory for the pixels of a file, to be filled; NULL without memory. */
uint8_t *picture_pixels(size_t index, int width, int height) {
    wanted *item = index < list.count ? &list.items[index] : NULL;
    if (!item || item->pixels || width < 1 || height < 1 || width > (1 << 14) ||
        height > (1 << 14)) {
        return NULL;
    }
    item->pixels = malloc((size_t)width * (size_t)height * 4);
    item->width = width;
    item->height = height;
    return item->pixels;
}

void picture_forget(void) {
    for (size_t i = 0; i < list.count; ++i) {
        free(list.items[i].bytes);
        free(list.items[i].pixels);
    }
    free(list.items);
    list.items = NULL;
    list.count = 0;
}

static const wanted *find(const burnish_encoded *from) {
    for (size_t i = 0; i < list.count; ++i) {
        const wanted *item = &list.items[i];
        if (item->size == from->size && memcmp(item->bytes, from->bytes, from->size) == 0) {
            return item;
        }
    }
    return NULL;
}

/* Requests an image. Without memory the request is lost, and the texture is missing. */
static void note(const burnish_encoded *from) {
    wanted *grown = realloc(list.items, (list.count + 1) * sizeof *grown);
    uint8_t *copy = malloc(from->size);
    list.items = grown ? grown : list.items;
    if (grown && copy) {
        memcpy(copy, from->bytes, from->size);
        list.items[list.count++] = (wanted){.bytes = copy, .size = from->size};
    } else {
        free(copy);
    }
}

static burnish_status decode(const burnish_encoded *from, burnish_memory *memory,
                             burnish_image *picture) {
    const wanted *found = find(from);
    if (!found) {
        note(from);
    }
    if (!found || !found->pixels) {
        return burnish_fail(
            memory->error, BURNISH_STATUS_ARGUMENT,
            "%.200s: images can't be decoded here; use read() in a browser, or the option decode",
            from->name);
    }
    const burnish_status status = burnish_decode_reserve(
        from, (uint64_t)found->width, (uint64_t)found->height, 4, memory, picture);
    if (status == BURNISH_STATUS_OK) {
        memcpy(picture->pixels, found->pixels, (size_t)found->width * (size_t)found->height * 4);
    }
    return status;
}

burnish_status burnish_decode_png(const burnish_encoded *from, burnish_memory *memory,
                                  burnish_image *picture) {
    return decode(from, memory, picture);
}

burnish_status burnish_decode_jpeg(const burnish_encoded *from, burnish_memory *memory,
                                   burnish_image *picture) {
    return decode(from, memory, picture);
}

burnish_status burnish_decode_webp(const burnish_encoded *from, burnish_memory *memory,
                                   burnish_image *picture) {
    return decode(from, memory, picture);
}

/* Other files are the caller's, too. */
int burnish_open_beside(const char *input, const char *name, burnish_memory *memory) {
    (void)input, (void)name, (void)memory;
    errno = ENOENT;
    return -1;
}
