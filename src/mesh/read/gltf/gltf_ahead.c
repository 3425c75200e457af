/* Pictures of glTF's materials, decoded side by side before the materials are read one by one. */
#include "mesh/read/common/textures.h"
#include "mesh/read/gltf/gltf.h"

enum { AHEAD_MAX = 64 };

/* Pictures that materials ask for, each once. */
struct burnish_gltf_ahead {
    burnish_texture_source sources[AHEAD_MAX];
    burnish_gltf_name names[AHEAD_MAX];
    char *files[AHEAD_MAX];
    uint32_t images[AHEAD_MAX];
    size_t count;
};

/* Values that say nothing of what they miss: whoever reads them afterwards does. */
static uint32_t look_up(const burnish_gltf *gltf, uint32_t object, const char *key,
                        burnish_gltf_list list) {
    double number = -1;
    const uint32_t value = burnish_json_member(&gltf->json, object, key);
    return value != BURNISH_JSON_NONE && burnish_json_number(&gltf->json, value, &number) &&
                   number >= 0 && number < (double)gltf->counts[list]
               ? gltf->lists[list][(size_t)number]
               : BURNISH_JSON_NONE;
}

static size_t look_up_size(const burnish_gltf *gltf, uint32_t object, const char *key) {
    double number = 0;
    const uint32_t value = burnish_json_member(&gltf->json, object, key);
    return value != BURNISH_JSON_NONE && burnish_json_number(&gltf->json, value, &number) &&
                   number >= 0 && number < 0x1p53
               ? (size_t)number
               : 0;
}

/* The image of a texture, NONE for none. */
static uint32_t image_at(const burnish_gltf *gltf, uint32_t object, const char *key) {
    const burnish_json *json = &gltf->json;
    const uint32_t info = burnish_json_member(json, object, key);
    const uint32_t texture = look_up(gltf, info, "index", BURNISH_GLTF_TEXTURES);
    const uint32_t webp = burnish_json_member(
        json, burnish_json_member(json, texture, "extensions"), "EXT_texture_webp");
    const uint32_t image = look_up(gltf, webp, "source", BURNISH_GLTF_IMAGES);
    if (look_up_size(gltf, info, "texCoord") != 0) {
        return BURNISH_JSON_NONE; /* left out */
    }
    return image != BURNISH_JSON_NONE ? image
                                      : look_up(gltf, texture, "source", BURNISH_GLTF_IMAGES);
}

/* The bytes of an image in the binary chunk; NULL: it is elsewhere. */
static burnish_gltf_bytes binary_image(const burnish_gltf *gltf, uint32_t image) {
    const uint32_t view = look_up(gltf, image, "bufferView", BURNISH_GLTF_VIEWS);
    const uint32_t buffer = look_up(gltf, view, "buffer", BURNISH_GLTF_BUFFERS);
    const size_t offset = look_up_size(gltf, view, "byteOffset");
    const size_t size = look_up_size(gltf, view, "byteLength");
    const burnish_gltf_bytes none = {0};
    if (buffer == BURNISH_JSON_NONE || buffer != gltf->lists[BURNISH_GLTF_BUFFERS][0] ||
        !gltf->binary.bytes ||
        burnish_json_member(&gltf->json, buffer, "uri") != BURNISH_JSON_NONE ||
        burnish_json_member(&gltf->json, image, "uri") != BURNISH_JSON_NONE ||
        offset > gltf->binary.size || size > gltf->binary.size - offset) {
        return none;
    }
    return (burnish_gltf_bytes){gltf->binary.bytes + offset, size};
}

/* Whether a URI is a file's name; one with escapes waits until it is asked for. */
static int is_plain_name(const burnish_gltf *gltf, uint32_t uri) {
    if (!burnish_json_is_kind(&gltf->json, uri, BURNISH_JSON_STRING)) {
        return 0;
    }
    const size_t size = gltf->json.nodes[uri].size;
    const uint8_t *text = burnish_json_at(&gltf->json, uri);
    return !memchr(text, '\\', size) && (size < 5 || memcmp(text, "data:", 5) != 0);
}

static void add_ahead(burnish_gltf *gltf, uint32_t object, const char *key,
                      struct burnish_gltf_ahead *list) {
    const uint32_t image = image_at(gltf, object, key);
    const size_t i = list->count;
    for (size_t k = 0; k < list->count; ++k) {
        if (list->images[k] == image) {
            return;
        }
    }
    if (image == BURNISH_JSON_NONE || i == AHEAD_MAX) {
        return;
    }
    const burnish_gltf_bytes bytes = binary_image(gltf, image);
    const uint32_t uri = burnish_json_member(&gltf->json, image, "uri");
    list->images[i] = image;
    if (bytes.bytes) {
        list->names[i] = burnish_gltf_image_name(gltf, image);
        list->sources[list->count++] =
            (burnish_texture_source){bytes.bytes, bytes.size, list->names[i].text};
    } else if (is_plain_name(gltf, uri)) {
        burnish_gltf_buffer none = {0};
        if (burnish_gltf_open_uri(gltf, uri, &none, &list->files[i]) && list->files[i]) {
            list->sources[list->count++] = (burnish_texture_source){.name = list->files[i]};
        }
        burnish_gltf_release_buffer(gltf, &none);
    }
}

void burnish_gltf_decode_ahead(burnish_gltf *gltf) {
    static const char *const plain[] = {"normalTexture", "emissiveTexture", "occlusionTexture"};
    static const char *const glossy[] = {"diffuseTexture", "specularGlossinessTexture"};
    static const char *const metallic[] = {"baseColorTexture", "metallicRoughnessTexture"};
    struct burnish_gltf_ahead *list =
        burnish_allocate_zeroed(gltf->memory, 1, sizeof *list, "pictures");
    if (!list || gltf->reader->input->options->ignore_textures) {
        burnish_release(gltf->memory->context, list);
        return;
    }
    gltf->ahead = list;
    for (size_t i = 0; i < gltf->counts[BURNISH_GLTF_MATERIALS] && list->count < AHEAD_MAX; ++i) {
        const uint32_t value = gltf->lists[BURNISH_GLTF_MATERIALS][i];
        const uint32_t extensions = burnish_json_member(&gltf->json, value, "extensions");
        const uint32_t gloss =
            burnish_json_member(&gltf->json, extensions, "KHR_materials_pbrSpecularGlossiness");
        const uint32_t metal = burnish_json_member(&gltf->json, value, "pbrMetallicRoughness");
        const int is_glossy = gloss != BURNISH_JSON_NONE;
        for (size_t k = 0; k < 3; ++k) {
            add_ahead(gltf, value, plain[k], list);
        }
        for (size_t k = 0; k < 2; ++k) {
            add_ahead(gltf, is_glossy ? gloss : metal, is_glossy ? glossy[k] : metallic[k], list);
        }
    }
    burnish_reader_decode_ahead(gltf->reader, list->sources, list->count);
}

void burnish_gltf_drop_ahead(burnish_gltf *gltf) {
    burnish_reader_drop_ahead(gltf->reader);
    for (size_t i = 0; gltf->ahead && i < gltf->ahead->count; ++i) {
        burnish_release(gltf->memory->context, gltf->ahead->files[i]);
    }
    burnish_release(gltf->memory->context, gltf->ahead);
    gltf->ahead = NULL;
}
