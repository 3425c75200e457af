/* What needs a library that the modules do not have. */
#include <cjson/cJSON.h>
#include <stddef.h>

#include "core/error.h"
#include "image/gunzip.h"

burnish_inflate *burnish_inflate_create(burnish_memory *memory, int is_raw) {
    (void)is_raw;
    memory->status = burnish_fail(memory->error, BURNISH_STATUS_ARGUMENT,
                                  "gzip: this build unpacks none; unpack the file first");
    return NULL;
}

void burnish_inflate_destroy(const burnish_context *context, burnish_inflate *inflate) {
    (void)context, (void)inflate;
}

burnish_inflate_result burnish_inflate_step(burnish_inflate *inflate, const uint8_t **from,
                                            size_t *left, uint8_t *to, size_t room,
                                            size_t *written) {
    (void)inflate, (void)from, (void)left, (void)to, (void)room;
    *written = 0;
    return BURNISH_INFLATE_DAMAGED;
}

uint32_t burnish_inflate_crc32(uint32_t crc, const uint8_t *bytes, size_t size) {
    (void)crc, (void)bytes, (void)size;
    return 0;
}

/* ---- JSON: there is none, and what prints it says so ---- */

#define NO_ITEM(name, ...)                                                                         \
    cJSON *name(__VA_ARGS__) {                                                                     \
        return NULL;                                                                               \
    }
#pragma clang diagnostic ignored "-Wunused-parameter"
NO_ITEM(cJSON_CreateNull, void)
NO_ITEM(cJSON_CreateArray, void)
NO_ITEM(cJSON_CreateObject, void)
NO_ITEM(cJSON_CreateBool, cJSON_bool boolean)
NO_ITEM(cJSON_CreateNumber, double number)
NO_ITEM(cJSON_CreateString, const char *string)
NO_ITEM(cJSON_CreateRaw, const char *raw)

cJSON_bool cJSON_AddItemToObject(cJSON *object, const char *string, cJSON *item) {
    return 0;
}

cJSON_bool cJSON_AddItemToArray(cJSON *array, cJSON *item) {
    return 0;
}

void cJSON_Delete(cJSON *item) {}

char *cJSON_Print(const cJSON *item) {
    return NULL;
}

void cJSON_free(void *object) {}
