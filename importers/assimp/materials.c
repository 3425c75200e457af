#include "materials.h"

#include <assimp/cimport.h>
#include <assimp/material.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { MATERIALS_MAX = 65536, TEXTURES_MAX = 4096, RAW_SIDE_MAX = 16384 };

/* burnish_texture_slot */
enum { SLOT_COLOR, SLOT_SPECULAR, SLOT_NORMAL = 4, SLOT_EMISSIVE, SLOT_OCCLUSION, SLOT_OPACITY };

typedef struct reading {
    const struct aiScene *scene;
    const struct aiMaterial *material;
    importer_mesh *mesh;
    int has_textures;
    unsigned set; /* the set of texture coordinates, from the first texture */
} reading;

/* ---- Textures ---- */

/* The embedded texture of a name: "*3", or a file name. */
static const struct aiTexture *find_embedded(const struct aiScene *scene, const char *name) {
    if (name[0] == '*') {
        const unsigned long number = strtoul(name + 1, NULL, 10);
        return number < scene->mNumTextures ? scene->mTextures[number] : NULL;
    }
    const char *slash = strrchr(name, '/'), *back = strrchr(name, '\\');
    const char *last = slash > back || !back ? slash : back;
    last = last ? last + 1 : name;
    for (unsigned i = 0; i < scene->mNumTextures; ++i) {
        const char *own = scene->mTextures[i]->mFilename.data;
        const char *s = strrchr(own, '/'), *b = strrchr(own, '\\');
        const char *part = s > b || !b ? s : b;
        if (*own && strcmp(part ? part + 1 : own, last) == 0) {
            return scene->mTextures[i];
        }
    }
    return NULL;
}

/* Texels in memory order: blue, green, red, alpha. */
static const uint8_t *turn_pixels(const struct aiTexture *texture, uint64_t count) {
    uint8_t *pixels = importer_zeroed(count, 4);
    for (uint64_t i = 0; i < count; ++i) {
        const struct aiTexel *t = &texture->pcData[i];
        const uint8_t rgba[4] = {t->r, t->g, t->b, t->a};
        memcpy(pixels + 4 * i, rgba, sizeof rgba);
    }
    return pixels;
}

static void set_embedded(importer_texture *to, const struct aiTexture *texture) {
    if (texture->mHeight == 0) {
        to->kind = BURNISH_BMS_ENCODED;
        to->bytes = (const uint8_t *)texture->pcData;
        to->size = texture->mWidth;
    } else if (texture->mWidth > 0 && texture->mWidth <= RAW_SIDE_MAX &&
               texture->mHeight <= RAW_SIDE_MAX) {
        const uint64_t count = (uint64_t)texture->mWidth * texture->mHeight;
        to->kind = BURNISH_BMS_PIXELS;
        to->width = texture->mWidth;
        to->height = texture->mHeight;
        to->bytes = turn_pixels(texture, count);
        to->size = (uint32_t)(4 * count);
    }
}

/* 1 + the number of a texture in the stream; 0: there are too many. */
static uint32_t number_of(reading *r, const char *name, int is_color) {
    importer_mesh *mesh = r->mesh;
    for (uint32_t i = 0; i < mesh->texture_count; ++i) {
        if (mesh->textures[i].is_color == is_color && strcmp(mesh->textures[i].name, name) == 0) {
            return i + 1;
        }
    }
    if (mesh->texture_count == TEXTURES_MAX) {
        importer_warn(mesh, "only the first 4096 textures are used");
        return 0;
    }
    if (!mesh->textures) {
        mesh->textures = importer_zeroed(TEXTURES_MAX, sizeof *mesh->textures);
    }
    importer_texture *texture = &mesh->textures[mesh->texture_count];
    texture->is_color = is_color;
    texture->name = importer_zeroed(strlen(name) + 1, 1);
    strcpy(texture->name, name);
    const struct aiTexture *embedded = find_embedded(r->scene, name);
    if (embedded && embedded->pcData) {
        set_embedded(texture, embedded);
    } else if (name[0] == '*') {
        return 0;
    }
    return ++mesh->texture_count;
}

/* The first texture of a type; name: 1024 bytes, "" without one. */
static int read_texture(reading *r, enum aiTextureType type, int slot, int is_color,
                        importer_material *to, char *name) {
    struct aiString path = {0};
    enum aiTextureMapping mapping = aiTextureMapping_UV;
    enum aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap,
                                      aiTextureMapMode_Wrap};
    unsigned set = 0, flags = 0;
    if (aiGetMaterialTexture(r->material, type, 0, &path, &mapping, &set, NULL, NULL, modes,
                             &flags) != aiReturn_SUCCESS ||
        path.length == 0) {
        return 0;
    }
    path.data[sizeof path.data - 1] = 0;
    path.data[strcspn(path.data, "\"")] = 0; /* the first name of X3D's lists */
    if (mapping != aiTextureMapping_UV || (r->has_textures && set != r->set)) {
        importer_warn(r->mesh, "a texture with other coordinates than the material's first is "
                               "left out");
        return 0;
    }
    const uint32_t number = number_of(r, path.data, is_color);
    if (number == 0) {
        return 0;
    }
    to->slots[slot].texture = number;
    r->has_textures = 1;
    r->set = set;
    for (int i = 0; i < 2; ++i) { /* "decal" counts as clamped */
        to->slots[slot].wrap[i] = (uint8_t)(modes[i] == aiTextureMapMode_Wrap     ? 0
                                            : modes[i] == aiTextureMapMode_Mirror ? 2
                                                                                  : 1);
    }
    strcpy(name, path.data);
    return 1;
}

/* ---- Materials ---- */

static int get_number(const reading *r, const char *key, float *value) {
    ai_real number = 0;
    unsigned count = 1;
    if (aiGetMaterialFloatArray(r->material, key, 0, 0, &number, &count) != aiReturn_SUCCESS ||
        count < 1) {
        return 0;
    }
    *value = number;
    return 1;
}

/* As written: sRGB. */
static int get_color(const reading *r, const char *key, float color[3]) {
    struct aiColor4D c = {0, 0, 0, 0};
    if (aiGetMaterialColor(r->material, key, 0, 0, &c) != aiReturn_SUCCESS) {
        return 0;
    }
    color[0] = c.r;
    color[1] = c.g;
    color[2] = c.b;
    return 1;
}

#define KEY(name) KEY_OF(name)
#define KEY_OF(key, type, index) key

static int is_black(const float color[3]) {
    return !(color[0] > 0 || color[1] > 0 || color[2] > 0);
}

/* Exponent and colour of the highlight. An exponent below 1 is a share of OpenGL's largest one, as
 * exporters of 3ds Max and Cinema 4D write it, with the default colour white: a small one is also
 * faint. 0 is no highlight. */
static void read_highlight(const reading *r, importer_material *to) {
    float color[3] = {0, 0, 0}, exponent = 0, strength = 1;
    int model = 0;
    unsigned count = 1;
    get_color(r, KEY(AI_MATKEY_COLOR_SPECULAR), color);
    get_number(r, KEY(AI_MATKEY_SHININESS), &exponent);
    get_number(r, KEY(AI_MATKEY_SHININESS_STRENGTH), &strength);
    const int has_model = aiGetMaterialIntegerArray(r->material, KEY(AI_MATKEY_SHADING_MODEL), 0, 0,
                                                    &model, &count) == aiReturn_SUCCESS;
    memset(to->specular, 0, sizeof to->specular);
    if (exponent > 0 && exponent < 1) {
        strength = exponent * (strength > 0 && strength < 1 ? strength : 1);
        exponent *= 128;
    }
    to->exponent = exponent;
    if (!(exponent >= 1) ||
        (has_model && (model == aiShadingMode_Flat || model == aiShadingMode_Gouraud))) {
        return;
    }
    to->flags |= BURNISH_BMS_HAS_EXPONENT;
    for (int i = 0; i < 3; ++i) {
        color[i] *= strength > 0 && strength < 1 ? strength : 1;
    }
    importer_linear(color, to->specular);
}

/* Some exporters write an opacity of 0 to mean opaque. */
static void read_opacity(reading *r, importer_material *to, const char *color_name) {
    char name[1024] = "";
    float opacity = 1;
    get_number(r, KEY(AI_MATKEY_OPACITY), &opacity);
    to->opacity = opacity > 0 ? opacity : 1;
    if (read_texture(r, aiTextureType_OPACITY, SLOT_OPACITY, 0, to, name) &&
        strcmp(name, color_name) == 0) {
        memset(&to->slots[SLOT_OPACITY], 0, sizeof to->slots[0]);
        to->flags |= BURNISH_BMS_MASK; /* the colours' own alpha */
    }
}

static void read_metal(const reading *r, importer_material *to) {
    float metallic = 0, roughness = 1;
    const int has_metallic = get_number(r, KEY(AI_MATKEY_METALLIC_FACTOR), &metallic);
    if (get_number(r, KEY(AI_MATKEY_ROUGHNESS_FACTOR), &roughness) && has_metallic) {
        to->flags |= BURNISH_BMS_METALLIC;
        to->metallic = metallic;
        to->roughness = roughness;
    }
}

static int has_property(const reading *r, const char *key) {
    const struct aiMaterialProperty *found;
    return aiGetMaterialProperty(r->material, key, UINT_MAX, UINT_MAX, &found) == aiReturn_SUCCESS;
}

/* Whether the library invented a material that the file lacks. Most of its readers use the default
 * name or an empty one, and NFF uses the default name for all materials. 3DS has its own name, and
 * MDL5 turns a missing skin black. */
static int is_made_up(const reading *r, const char *extension) {
    float color[3] = {-1, -1, -1}, specular[3] = {0, 0, 0};
    struct aiString title = {0};
    aiGetMaterialString(r->material, KEY(AI_MATKEY_NAME), 0, 0, &title);
    get_color(r, KEY(AI_MATKEY_COLOR_DIFFUSE), color);
    get_color(r, KEY(AI_MATKEY_COLOR_SPECULAR), specular);
    if (strcmp(title.data, AI_DEFAULT_MATERIAL_NAME) == 0) {
        return strcmp(extension, "nff") != 0 && strcmp(extension, "enff") != 0;
    }
    return r->material->mNumProperties == 0 || strcmp(title.data, "%%%DEFAULT") == 0 ||
           (strcmp(extension, "mdl") == 0 && color[0] == 0 && is_black(color) &&
            is_black(specular) && !has_property(r, KEY(AI_MATKEY_TEXTURE_DIFFUSE(0))));
}

/* For formats of classic OpenGL, whose textures multiply all light, including the material's own.
 */
static int glows_through_texture(const char *extension) {
    return strcmp(extension, "ms3d") == 0 || strcmp(extension, "x") == 0 ||
           strncmp(extension, "ac", 2) == 0;
}

static void read_material(reading *r, const char *extension, importer_material *to) {
    char name[1024] = "", unused[1024];
    float color[3] = {0.6f, 0.6f, 0.6f};
    *to = importer_default_material();
    if (is_made_up(r, extension)) {
        to->flags &= ~(uint32_t)BURNISH_BMS_HAS_DIFFUSE; /* colours of vertices take its place */
        return;
    }
    if (!get_color(r, KEY(AI_MATKEY_BASE_COLOR), color)) {
        get_color(r, KEY(AI_MATKEY_COLOR_DIFFUSE), color);
    }
    read_highlight(r, to);
    read_metal(r, to);
    if (read_texture(r, aiTextureType_BASE_COLOR, SLOT_COLOR, 1, to, name) ||
        read_texture(r, aiTextureType_DIFFUSE, SLOT_COLOR, 1, to, name)) {
        color[0] = color[1] = color[2] = 1; /* exporters intend the unmodified image */
    }
    importer_linear(color, to->diffuse);
    memcpy(to->ambient, to->diffuse, sizeof to->ambient);
    if (get_color(r, KEY(AI_MATKEY_COLOR_EMISSIVE), color) && !is_black(color)) {
        importer_linear(color, to->emissive);
    }
    read_texture(r, aiTextureType_NORMALS, SLOT_NORMAL, 0, to, unused);
    if (read_texture(r, aiTextureType_EMISSIVE, SLOT_EMISSIVE, 1, to, unused) &&
        is_black(to->emissive)) {
        to->emissive[0] = to->emissive[1] = to->emissive[2] = 1;
    }
    if (glows_through_texture(extension) && to->slots[SLOT_EMISSIVE].texture == 0) {
        to->slots[SLOT_EMISSIVE] = to->slots[SLOT_COLOR];
    }
    read_texture(r, aiTextureType_SPECULAR, SLOT_SPECULAR, 1, to, unused);
    read_opacity(r, to, name);
}

const unsigned *assimp_read_materials(const struct aiScene *scene, const char *extension,
                                      importer_mesh *mesh) {
    mesh->material_count =
        scene->mNumMaterials < MATERIALS_MAX ? scene->mNumMaterials : MATERIALS_MAX;
    mesh->materials = importer_zeroed(mesh->material_count, sizeof *mesh->materials);
    unsigned *sets = importer_zeroed(scene->mNumMaterials, sizeof *sets);
    for (uint32_t i = 0; i < mesh->material_count; ++i) {
        reading r = {.scene = scene, .material = scene->mMaterials[i], .mesh = mesh};
        read_material(&r, extension, &mesh->materials[i]);
        sets[i] = r.set;
    }
    return sets;
}
