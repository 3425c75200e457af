/* NPY 1.0 (numpy.lib.format): one array, little endian, C order. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "picture/formats.h"
#include "picture/npy.h"

static const struct {
    const char *word; /* NumPy's */
    size_t size;
} kinds[] = {[PICTURE_FLOAT] = {"<f4", 4}, [PICTURE_INT] = {"<i4", 4}, [PICTURE_BYTE] = {"|u1", 1}};

/* Bytes up to the data: a multiple of 64, as NumPy aligns it; the longest header has 100. */
enum { HEAD_SIZE = 128, MAGIC_SIZE = 10 };

static void put_head(uint8_t *to, const picture_array *array) {
    char shape[48];
    snprintf(shape, sizeof shape, array->channels > 1 ? "(%d, %d, %d)" : "(%d, %d)", array->height,
             array->width, array->channels);
    memset(to, ' ', HEAD_SIZE);
    memcpy(to, "\x93NUMPY\1\0", 8);
    to[8] = HEAD_SIZE - MAGIC_SIZE;
    to[9] = 0;
    const int size = snprintf((char *)to + MAGIC_SIZE, HEAD_SIZE - MAGIC_SIZE,
                              "{'shape': %s, 'fortran_order': False, 'descr': '%s', }", shape,
                              kinds[array->kind].word);
    to[MAGIC_SIZE + size] = ' ';
    to[HEAD_SIZE - 1] = '\n';
}

burnish_status picture_encode_npy(const picture_array *array, picture_file *file,
                                  burnish_error *error) {
    const size_t count =
        (size_t)array->width * (size_t)array->height * (size_t)array->channels; /* below 2^31 */
    const size_t item = kinds[array->kind].size;
    *file = (picture_file){0};
    file->bytes = count <= (SIZE_MAX - HEAD_SIZE) / item ? malloc(HEAD_SIZE + count * item) : NULL;
    if (!file->bytes) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory: the NPY file; free memory");
    }
    file->size = HEAD_SIZE + count * item;
    put_head(file->bytes, array);
    memcpy(file->bytes + HEAD_SIZE, array->values, count * item);
#if __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
    for (size_t i = HEAD_SIZE; item == 4 && i < file->size; i += 4) {
        uint32_t value;
        memcpy(&value, file->bytes + i, 4);
        value = __builtin_bswap32(value);
        memcpy(file->bytes + i, &value, 4);
    }
#endif
    return BURNISH_STATUS_OK;
}
