/* Functions that the modules do not have. */
#include <cjson/cJSON.h>

/* Without cJSON, printing JSON is an error. */

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

char *cJSON_PrintUnformatted(const cJSON *item) {
    return NULL;
}
