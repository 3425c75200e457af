/* Textures of glTF's materials: the image, how it repeats, and the texture coordinates. */
#include "mesh/read/gltf/gltf.h"

#include <stdio.h>

#include "base/elementary.h"
#include "mesh/read/common/textures.h"

enum {
    NEAREST = 9728,
    CLAMP_TO_EDGE = 33071,
    MIRRORED_REPEAT = 33648,
    DAMAGED_MAX = 8 /* damaged images after which no more are tried: each may take long to fail */
};

/* ---- Images ---- */

burnish_gltf_name burnish_gltf_image_name(const burnish_gltf *gltf, uint32_t image) {
    burnish_gltf_name name;
    const uint32_t given = burnish_json_member(&gltf->json, image, "name");
    if (burnish_json_text(&gltf->json, given, name.text, sizeof name.text) == 0) {
        snprintf(name.text, sizeof name.text, "%s", burnish_json_path_of(&gltf->json, image).text);
    }
    return name;
}

static int decode_bytes(burnish_gltf *gltf, uint32_t image, const uint8_t *bytes, size_t size,
                        int is_color) {
    if (gltf->damaged_images >= DAMAGED_MAX) {
        return 0;
    }
    const int number = burnish_reader_decode_texture(
        gltf->reader, burnish_json_at(&gltf->json, image),
        burnish_gltf_image_name(gltf, image).text, bytes, size, is_color);
    const int is_ktx = size >= 4 && memcmp(bytes, "\xabKTX", 4) == 0; /* which fails at once */
    gltf->damaged_images += number == 0 && !is_ktx;
    return number;
}

static int load_image(burnish_gltf *gltf, uint32_t image, int is_color) {
    const uint32_t uri = burnish_json_member(&gltf->json, image, "uri");
    const uint32_t view = burnish_gltf_reference(gltf, image, "bufferView", BURNISH_GLTF_VIEWS);
    burnish_gltf_buffer data = {.is_loaded = 0};
    burnish_gltf_bytes bytes;
    size_t stride;
    char *name;
    int number = 0;
    if (uri != BURNISH_JSON_NONE && burnish_gltf_open_uri(gltf, uri, &data, &name)) {
        number = name ? burnish_reader_load_texture(
                            gltf->reader, burnish_json_at(&gltf->json, image), name, is_color)
                      : decode_bytes(gltf, image, data.bytes.bytes, data.bytes.size, is_color);
        burnish_release(gltf->memory->context, name);
    } else if (view != BURNISH_GLTF_NONE && burnish_gltf_view(gltf, view, &bytes, &stride)) {
        number = decode_bytes(gltf, image, bytes.bytes, bytes.size, is_color);
    }
    burnish_gltf_release_buffer(gltf, &data);
    burnish_gltf_is_fine(gltf);
    return number;
}

/* A texture of numbers whose every channel is a texture's alpha. */
static int copy_alpha(burnish_gltf *gltf, uint32_t image, int number) {
    const burnish_texture from = gltf->reader->mesh->textures[number - 1];
    const size_t count = (size_t)from.width * (size_t)from.height;
    uint8_t *pixels = burnish_allocate(gltf->memory, count, 4, "textures");
    int copy = 0;
    for (size_t i = 0; pixels && i < count; ++i) {
        memset(pixels + 4 * i, from.pixels[4 * i + 3], 4);
    }
    if (pixels) {
        copy = burnish_reader_copy_texture(gltf->reader, burnish_json_at(&gltf->json, image),
                                           from.name, from.width, from.height, pixels, 0);
    }
    burnish_release(gltf->memory->context, pixels);
    burnish_gltf_is_fine(gltf);
    return copy;
}

/* Each image is decoded once as numbers, and once as colours. */
static int texture_of_image(burnish_gltf *gltf, uint32_t image, burnish_gltf_image_kind kind) {
    int *number = &gltf->image_textures[BURNISH_GLTF_IMAGE_KINDS * (size_t)image + kind];
    const uint32_t value = gltf->lists[BURNISH_GLTF_IMAGES][image];
    if (*number < 0 && kind == BURNISH_GLTF_ALPHA) {
        const int numbers = texture_of_image(gltf, image, BURNISH_GLTF_NUMBERS);
        *number = numbers > 0 ? copy_alpha(gltf, value, numbers) : 0;
    } else if (*number < 0) {
        *number = load_image(gltf, value, kind == BURNISH_GLTF_COLORS);
    }
    return *number;
}

/* ---- Sets of texture coordinates ---- */

/* The set of a texture's use; SETS without a texture, or if the set is not read. */
static unsigned set_of_use(const burnish_json *json, uint32_t info) {
    const uint32_t extensions = burnish_json_member(json, info, "extensions");
    const uint32_t transform = burnish_json_member(json, extensions, "KHR_texture_transform");
    uint32_t value = burnish_json_member(json, transform, "texCoord");
    double number = 0;
    if (value == BURNISH_JSON_NONE) {
        value = burnish_json_member(json, info, "texCoord");
    }
    burnish_json_number(json, value, &number);
    return info != BURNISH_JSON_NONE && number >= 0 && number < BURNISH_GLTF_TEXCOORDS
               ? (unsigned)number
               : BURNISH_GLTF_TEXCOORDS;
}

static unsigned most_votes(const unsigned votes[BURNISH_GLTF_TEXCOORDS]) {
    unsigned best = 0;
    for (unsigned set = 1; set < BURNISH_GLTF_TEXCOORDS; ++set) {
        best = votes[set] > votes[best] ? set : best;
    }
    return best;
}

void burnish_gltf_texture_sets(const burnish_gltf *gltf, uint32_t material, unsigned sets[2]) {
    static const struct {
        const char *object, *key; /* object NULL: the material itself */
        unsigned votes;
    } uses[] = {{"pbrMetallicRoughness", "baseColorTexture", 3},
                {"pbrMetallicRoughness", "metallicRoughnessTexture", 2},
                {"KHR_materials_pbrSpecularGlossiness", "diffuseTexture", 3},
                {"KHR_materials_pbrSpecularGlossiness", "specularGlossinessTexture", 2},
                {"KHR_materials_specular", "specularColorTexture", 2},
                {"KHR_materials_specular", "specularTexture", 2},
                {"KHR_materials_anisotropy", "anisotropyTexture", 1},
                {"KHR_materials_iridescence", "iridescenceTexture", 1},
                {"KHR_materials_iridescence", "iridescenceThicknessTexture", 1},
                {"KHR_materials_sheen", "sheenColorTexture", 1},
                {"KHR_materials_sheen", "sheenRoughnessTexture", 1},
                {"KHR_materials_clearcoat", "clearcoatTexture", 1},
                {"KHR_materials_clearcoat", "clearcoatRoughnessTexture", 1},
                {"KHR_materials_transmission", "transmissionTexture", 1},
                {"KHR_materials_volume", "thicknessTexture", 1},
                {NULL, "normalTexture", 2},
                {NULL, "occlusionTexture", 2},
                {NULL, "emissiveTexture", 2}};
    const burnish_json *json = &gltf->json;
    const uint32_t extensions = burnish_json_member(json, material, "extensions");
    unsigned votes[BURNISH_GLTF_TEXCOORDS + 1] = {0};
    for (size_t i = 0; i < sizeof uses / sizeof *uses; ++i) {
        const char *name = uses[i].object;
        const uint32_t object =
            !name ? material
                  : burnish_json_member(json, strncmp(name, "KHR", 3) == 0 ? extensions : material,
                                        name);
        votes[set_of_use(json, burnish_json_member(json, object, uses[i].key))] += uses[i].votes;
    }
    sets[0] = set_of_use(json, burnish_json_member(json, material, "normalTexture"));
    if (sets[0] == BURNISH_GLTF_TEXCOORDS) {
        const uint32_t coat = burnish_json_member(json, extensions, "KHR_materials_clearcoat");
        sets[0] = set_of_use(json, burnish_json_member(json, coat, "clearcoatNormalTexture"));
    }
    sets[0] = sets[0] < BURNISH_GLTF_TEXCOORDS ? sets[0] : most_votes(votes);
    votes[sets[0]] = 0;
    sets[1] = most_votes(votes);
    sets[1] = votes[sets[1]] > 0 ? sets[1] : BURNISH_GLTF_TEXCOORDS;
}

/* ---- Textures ---- */

static int read_wrap(burnish_gltf *gltf, uint32_t sampler, const char *key) {
    const uint64_t mode = burnish_gltf_whole(gltf, sampler, key, 0, 65535);
    return mode == CLAMP_TO_EDGE     ? BURNISH_WRAP_CLAMP
           : mode == MIRRORED_REPEAT ? BURNISH_WRAP_MIRROR
                                     : BURNISH_WRAP_REPEAT;
}

/* KHR_texture_transform, whose v grows downwards: u' = a u + b v + c, v' = d u + e v + f. With
 * 1 - v for v on both sides it is the mesh's. */
static void read_transform(burnish_gltf *gltf, uint32_t transform, burnish_texture_use *use) {
    double offset[2] = {0, 0}, scale[2] = {1, 1}, sine, cosine;
    burnish_gltf_numbers(gltf, transform, "offset", 2, offset);
    burnish_gltf_numbers(gltf, transform, "scale", 2, scale);
    burnish_sincos(burnish_gltf_number(gltf, transform, "rotation", 0), &sine, &cosine);
    const double a = cosine * scale[0], b = sine * scale[1], d = -sine * scale[0],
                 e = cosine * scale[1];
    const double mesh[6] = {a, -b, b + offset[0], -d, e, 1 - e - offset[1]};
    use->has_transform = 1;
    for (int i = 0; i < 6; ++i) {
        use->has_transform &= burnish_double_to_float(mesh[i], &use->transform[i]);
    }
    if (!use->has_transform) {
        memset(use->transform, 0, sizeof use->transform);
    }
}

/* The image of a texture. One that has only images of formats that are not decoded gets one of them,
 * for the message. */
static uint32_t image_of_texture(burnish_gltf *gltf, uint32_t texture) {
    static const char *const names[] = {"EXT_texture_webp", NULL, "KHR_texture_basisu",
                                        "EXT_texture_avif", "MSFT_texture_dds"};
    uint32_t image = BURNISH_GLTF_NONE;
    for (size_t i = 0; i < sizeof names / sizeof *names && image == BURNISH_GLTF_NONE; ++i) {
        const uint32_t owner = names[i] ? burnish_gltf_extension(gltf, texture, names[i]) : texture;
        image = burnish_gltf_reference(gltf, owner, "source", BURNISH_GLTF_IMAGES);
    }
    return image;
}

burnish_texture_use burnish_gltf_read_texture(burnish_gltf *gltf, uint32_t object, const char *key,
                                              burnish_gltf_image_kind kind, const char *strength) {
    burnish_texture_use use = {.strength = 1};
    const burnish_texture_use none = {0};
    const uint32_t info = burnish_gltf_object(gltf, object, key);
    const uint32_t number = burnish_gltf_reference(gltf, info, "index", BURNISH_GLTF_TEXTURES);
    if (number == BURNISH_GLTF_NONE || gltf->reader->input->options->ignore_textures) {
        return none;
    }
    const uint32_t transform = burnish_gltf_extension(gltf, info, "KHR_texture_transform");
    uint64_t set = burnish_gltf_whole(gltf, info, "texCoord", 0, 1000);
    set = burnish_gltf_whole(gltf, transform, "texCoord", set, 1000);
    use.coordinates = set != gltf->texture_sets[0];
    if (use.coordinates && (set >= BURNISH_GLTF_TEXCOORDS || set != gltf->texture_sets[1])) {
        burnish_gltf_note(gltf, &gltf->other_sets, info,
                          "ignored, as it uses a third set of texture coordinates (set %u)",
                          (unsigned)set);
        return none;
    }
    const uint32_t texture = gltf->lists[BURNISH_GLTF_TEXTURES][number];
    const uint32_t image = image_of_texture(gltf, texture);
    const uint32_t sampler =
        burnish_gltf_reference(gltf, texture, "sampler", BURNISH_GLTF_SAMPLERS);
    if (sampler != BURNISH_GLTF_NONE) {
        const uint32_t value = gltf->lists[BURNISH_GLTF_SAMPLERS][sampler];
        use.wrap[0] = read_wrap(gltf, value, "wrapS");
        use.wrap[1] = read_wrap(gltf, value, "wrapT");
        use.is_nearest = burnish_gltf_whole(gltf, value, "magFilter", 0, 65535) == NEAREST;
    }
    if (transform != BURNISH_JSON_NONE) {
        read_transform(gltf, transform, &use);
    }
    if (strength) {
        const double value = burnish_gltf_number(gltf, info, strength, 1);
        burnish_double_to_float(value, &use.strength);
    }
    use.texture = image == BURNISH_GLTF_NONE ? 0 : texture_of_image(gltf, image, kind);
    return use.texture > 0 ? use : none;
}

/* ---- Decoding ahead ---- */

enum { AHEAD_MAX = 64 };

/* The pictures that materials use, each once. */
struct burnish_gltf_ahead {
    burnish_texture_source sources[AHEAD_MAX];
    burnish_gltf_name names[AHEAD_MAX];
    char *files[AHEAD_MAX];
    uint32_t images[AHEAD_MAX];
    size_t count;
};

/* Look-ups without messages. The later regular reading reports what is missing. */
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

/* Whether a URI is a plain file name. A name with escapes is not decoded ahead. */
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
