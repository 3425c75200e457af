/* Textures of a material library: map_Kd, map_Ks, map_Ns, map_Ke, map_d, bump and norm with their
 * options. The files are loaded once a material is used. */
#include "mesh/read/obj/mtl.h"

#include <stdio.h>
#include <string.h>

#include "base/elementary.h"
#include "mesh/data/material.h"
#include "mesh/read/common/textures.h"

/* Statements by name, lower case. */
static const struct {
    const char *word;
    burnish_texture_slot slot;
    int is_height;
} statements[] = {
    {"map_kd", BURNISH_TEXTURE_COLOR, 0},    {"map_ks", BURNISH_TEXTURE_SPECULAR, 0},
    {"map_ns", BURNISH_TEXTURE_EXPONENT, 0}, {"map_ke", BURNISH_TEXTURE_EMISSIVE, 0},
    {"map_d", BURNISH_TEXTURE_OPACITY, 0},   {"map_opacity", BURNISH_TEXTURE_OPACITY, 0},
    {"map_bump", BURNISH_TEXTURE_NORMAL, 1}, {"bump", BURNISH_TEXTURE_NORMAL, 1},
    {"norm", BURNISH_TEXTURE_NORMAL, 0},     {"map_kn", BURNISH_TEXTURE_NORMAL, 0},
    {"map_ka", BURNISH_TEXTURE_COLOR, 0}, /* mostly map_Kd once more, which replaces it */
};

/* Options, and how many numbers follow at most: these are read, ... */
static const struct {
    const char *word;
    int least, most;
} options[] = {
    {"-s", 1, 3},      {"-o", 1, 3},       {"-bm", 1, 1},   {"-clamp", 1, 1},      {"-t", 1, 3},
    {"-blendu", 1, 1}, {"-blendv", 1, 1},  {"-mm", 2, 2},   {"-boost", 1, 1},      {"-cc", 1, 1},
    {"-texres", 1, 1}, {"-imfchan", 0, 0}, {"-type", 0, 0}, {"-colorspace", 0, 0},
};
enum { SCALE, OFFSET, BUMP, CLAMP, READ /* ... and the others ignored */ };

static int is_word(burnish_token token, const char *word) {
    return token.size == strlen(word) &&
           burnish_bytes_are_caseless(token.bytes, (const uint8_t *)word, token.size);
}

/* Reads an option's numbers, of which `most` fit; returns how many there were. *next is the first
 * token after them. */
static int read_values(burnish_lexer *lexer, int most, float values[3], burnish_token *next,
                       int *has_next) {
    int count = 0;
    while ((*has_next = burnish_lexer_token(lexer, next)) != 0 && count < most) {
        float value = 0;
        const int is_on = is_word(*next, "on"), is_word_only = is_on || is_word(*next, "off");
        if (!is_word_only && burnish_parse_float(*next, &value) != BURNISH_NUMBER_OK) {
            break;
        }
        values[count++] = is_word_only ? (float)is_on : value;
    }
    return count;
}

static void set_option(int which, const float values[3], int count, burnish_mtl_map *map) {
    for (int k = 0; k < 2 && k < count; ++k) {
        if (which == SCALE) {
            map->scale[k] = values[k];
        } else if (which == OFFSET) {
            map->offset[k] = values[k];
        }
    }
    if (which == BUMP) {
        map->bump = values[0];
    } else if (which == CLAMP) {
        map->is_clamped = values[0] > 0;
    }
}

int burnish_mtl_is_map(burnish_token keyword) {
    return (keyword.size > 4 &&
            burnish_bytes_are_caseless(keyword.bytes, (const uint8_t *)"map_", 4)) ||
           is_word(keyword, "bump") || is_word(keyword, "disp") || is_word(keyword, "decal") ||
           is_word(keyword, "refl") || is_word(keyword, "norm");
}

/* The name of the file, relative to the folder of the library. */
static char *copy_name(burnish_memory *memory, const char *library, burnish_token file) {
    const char *slash = strrchr(library, '/');
    const size_t folder = slash && *library != '/' ? (size_t)(slash - library) + 1 : 0;
    char *copy = burnish_allocate(memory, folder + file.size + 1, 1, "a name");
    if (copy) {
        memcpy(copy, library, folder);
        memcpy(copy + folder, file.bytes, file.size);
        copy[folder + file.size] = 0;
    }
    return copy;
}

void burnish_mtl_read_map(burnish_reader *reader, burnish_mtl_entry *entry, burnish_token keyword,
                          burnish_lexer *lexer, burnish_warning_group *unsupported) {
    burnish_lexer words = *lexer;
    burnish_token file = burnish_lexer_rest(lexer), token = {0};
    burnish_mtl_map map = {.scale = {1, 1}, .bump = 1};
    size_t which = 0;
    while (which < sizeof statements / sizeof *statements &&
           !is_word(keyword, statements[which].word)) {
        ++which;
    }
    if (which == sizeof statements / sizeof *statements) {
        burnish_reader_note(reader, unsupported, keyword.bytes, "%s is not drawn",
                            burnish_token_quote(keyword).text);
        return;
    }
    const uint8_t *end = file.bytes + file.size;
    words.end = end;
    words.obj_rules = 0; /* file names may hold '#' */
    int has_token = burnish_lexer_token(&words, &token);
    while (has_token && token.size > 1 && *token.bytes == '-') {
        size_t i = 0;
        float values[3] = {0};
        while (i < sizeof options / sizeof *options && !is_word(token, options[i].word)) {
            ++i;
        }
        if (i == sizeof options / sizeof *options) {
            break; /* a name may begin so */
        }
        if (i >= READ && strcmp(options[i].word, "-colorspace") != 0) {
            burnish_reader_note(reader, unsupported, token.bytes, "%s: %s is not drawn",
                                burnish_token_quote(keyword).text, options[i].word);
        }
        if (options[i].most == 0) { /* a word follows */
            has_token = burnish_lexer_token(&words, &token) && burnish_lexer_token(&words, &token);
            continue;
        }
        const int count = read_values(&words, options[i].most, values, &token, &has_token);
        set_option((int)i, values, count, &map);
    }
    if (!has_token) {
        return;
    }
    burnish_mtl_map *to = &entry->maps[statements[which].slot];
    file = (burnish_token){token.bytes, (size_t)(end - token.bytes)};
    if (file.size > 1 && *file.bytes == '"' && file.bytes[file.size - 1] == '"') {
        file.bytes += 1;
        file.size -= 2;
    }
    map.is_ambient = is_word(keyword, "map_ka");
    if ((to->file && to->is_ambient <= map.is_ambient) || memchr(file.bytes, 0, file.size)) {
        return; /* the first counts */
    }
    burnish_release(reader->mesh->memory.context, to->file);
    map.is_height = statements[which].is_height;
    map.file = copy_name(&reader->mesh->memory, reader->input->name, file);
    *to = map;
}

/* ---- Loading ---- */

/* A height map is grey. A bluish picture is a normal map, whatever the statement says. */
static int is_normal_map(const burnish_texture *texture) {
    const size_t count = (size_t)texture->width * (size_t)texture->height;
    uint64_t red = 0, blue = 0;
    for (size_t i = 0; i < count; ++i) {
        red += texture->pixels[4 * i];
        blue += texture->pixels[4 * i + 2];
    }
    return blue > red + 48 * (uint64_t)count;
}

/* Heights at texel (x, y), which repeats. */
static float height_at(const burnish_texture *texture, int x, int y) {
    const int w = texture->width, h = texture->height;
    const size_t at = (size_t)((y + h) % h) * (size_t)w + (size_t)((x + w) % w);
    return (float)texture->pixels[4 * at] * (1.0f / 255);
}

/* Heights become normals: a step from black to white over a texel is a slope of `bump` * 2. */
static int make_normals(burnish_reader *reader, const char *name, int number, float bump) {
    const burnish_texture from = reader->mesh->textures[number - 1];
    const size_t count = (size_t)from.width * (size_t)from.height;
    uint8_t *pixels = burnish_allocate(&reader->mesh->memory, count, 4, "normals");
    uint8_t *to = pixels;
    for (int y = 0; pixels && y < from.height; ++y) {
        for (int x = 0; x < from.width; ++x, to += 4) {
            const float right = bump * (height_at(&from, x + 1, y) - height_at(&from, x - 1, y));
            const float up = bump * (height_at(&from, x, y - 1) - height_at(&from, x, y + 1));
            const float scale = 1 / burnish_sqrtf(right * right + up * up + 1);
            to[0] = (uint8_t)((0.5f - 0.5f * right * scale) * 255 + 0.5f);
            to[1] = (uint8_t)((0.5f - 0.5f * up * scale) * 255 + 0.5f);
            to[2] = (uint8_t)((0.5f + 0.5f * scale) * 255 + 0.5f);
            to[3] = 255;
        }
    }
    return pixels ? burnish_mesh_data_add_texture(reader->mesh, name, from.width, from.height,
                                                  pixels, 0)
                  : 0;
}

/* The normal map of a height map; made once per picture and strength. */
static int normals_for(burnish_reader *reader, const char *file, int number, float bump) {
    char name[200];
    if (number == 0 || is_normal_map(&reader->mesh->textures[number - 1])) {
        return number;
    }
    snprintf(name, sizeof name, "normals %.9g of %d: %.100s", (double)bump, number, file);
    for (size_t i = 0; i < reader->mesh->texture_count; ++i) {
        const char *made = reader->mesh->textures[i].name;
        if (made && strcmp(made, name) == 0) {
            return (int)i + 1;
        }
    }
    return make_normals(reader, name, number, bump < -64 ? -64 : bump > 64 ? 64 : bump);
}

/* If a picture has alpha, that is its opacity. */
static void take_alpha(burnish_texture *texture) {
    const size_t count = (size_t)texture->width * (size_t)texture->height;
    uint8_t *pixels = (uint8_t *)(uintptr_t)texture->pixels, least = 255;
    for (size_t i = 0; i < count; ++i) {
        least = pixels[4 * i + 3] < least ? pixels[4 * i + 3] : least;
    }
    for (size_t i = 0; i < count && least < 255; ++i) {
        pixels[4 * i] = pixels[4 * i + 3];
        pixels[4 * i + 3] = 255;
    }
}

static int is_black(const float color[3]) {
    return color[0] == 0 && color[1] == 0 && color[2] == 0;
}

static void make_white(float color[3]) {
    color[0] = color[1] = color[2] = 1;
}

/* Exporters write a colour of 0 next to a map to mean "see the map". Others are factors of its
 * light, not colours: Blender's 0.64 must not halve it twice. */
static void set_factors(const burnish_mtl_entry *entry, int slot, burnish_material *material) {
    if (slot == BURNISH_TEXTURE_COLOR) {
        if (is_black(entry->diffuse)) {
            make_white(material->diffuse);
        } else {
            memcpy(material->diffuse, entry->diffuse, sizeof material->diffuse);
        }
        memcpy(material->ambient, material->diffuse, sizeof material->ambient);
        material->has_diffuse = 1;
    }
    if (slot == BURNISH_TEXTURE_SPECULAR && is_black(material->specular)) {
        make_white(material->specular);
    }
    if (slot == BURNISH_TEXTURE_EMISSIVE && is_black(material->emissive)) {
        make_white(material->emissive);
    }
    if (slot == BURNISH_TEXTURE_OPACITY) {
        material->alpha_mode = BURNISH_ALPHA_BLEND;
        material->transparency = 0;
    }
}

burnish_material burnish_mtl_load_maps(burnish_reader *reader, const burnish_mtl_entry *entry) {
    burnish_material material = entry->material;
    for (int slot = 0; slot < BURNISH_TEXTURE_SLOT_COUNT; ++slot) {
        const burnish_mtl_map *map = &entry->maps[slot];
        const int is_color = slot == BURNISH_TEXTURE_COLOR || slot == BURNISH_TEXTURE_SPECULAR ||
                             slot == BURNISH_TEXTURE_EMISSIVE;
        int number = map->file ? burnish_reader_load_texture(reader, NULL, map->file, is_color) : 0;
        if (map->is_height) {
            number = normals_for(reader, map->file, number, map->bump);
        }
        if (number == 0) {
            continue;
        }
        if (slot == BURNISH_TEXTURE_OPACITY) {
            take_alpha(&reader->mesh->textures[number - 1]);
        }
        const int wrap = map->is_clamped ? BURNISH_WRAP_CLAMP : BURNISH_WRAP_REPEAT;
        material.textures[slot] = (burnish_texture_use){
            .texture = number,
            .wrap = {wrap, wrap},
            .has_transform = 1,
            .transform = {map->scale[0], 0, map->offset[0], 0, map->scale[1], map->offset[1]},
            .strength = map->is_height                   ? 1
                        : slot == BURNISH_TEXTURE_NORMAL ? map->bump
                                                         : 1};
        set_factors(entry, slot, &material);
    }
    return material;
}

void burnish_mtl_release_maps(const burnish_context *context, burnish_mtl_entry *entry) {
    for (int slot = 0; slot < BURNISH_TEXTURE_SLOT_COUNT; ++slot) {
        burnish_release(context, entry->maps[slot].file);
    }
}
