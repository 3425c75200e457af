/* The mesh stream of importers (bms.h). They are other programs and may read hostile files, so a
 * stream is not trusted. */
#include "mesh/read/bms.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

#include "base/bytes.h"
#include "base/numbers.h"
#include "core/vec3.h"
#include "mesh/data/material.h"
#include "mesh/read/common/local_origin.h"
#include "mesh/read/common/parts.h"
#include "mesh/read/common/points.h"
#include "mesh/read/common/textures.h"

enum {
    MATERIALS_MAX = 65536, /* numbered in 16 bits */
    TEXT_MAX = 1 << 16,
    NAME_MAX_SIZE = 4096,
    DAMAGED_MAX =
        8,         /* damaged pictures after which no more are tried: each may take long to fail */
    STEP = 1 << 16 /* vertices or triangles between checks for cancellation */
};

typedef struct bms_state {
    burnish_reader *reader;
    burnish_mesh_data *mesh;
    const uint8_t *next; /* the unread rest */
    size_t vertices, triangles, materials, textures, text_size;
    uint32_t parts;
    int *texture_numbers;    /* 1 + the number in the mesh; 0: skipped */
    burnish_part_list named; /* parts of the mesh */
} bms_state;

/* ---- Numbers ---- */

static burnish_status bms_fail(const bms_state *s, const uint8_t *at, const char *text) {
    return burnish_reader_fail(s->reader, BURNISH_STATUS_FORMAT, at, "%s", text);
}

static size_t bms_bytes_left(const bms_state *s) {
    return (size_t)(s->reader->input->bytes + s->reader->input->size - s->next);
}

/* Texts, names and pictures end at a multiple of 4. */
static uint64_t padded_size(uint64_t size) {
    return (size + 3) & ~(uint64_t)3;
}

/* ---- The head ---- */

/* Bytes after the textures. */
static uint64_t size_of_rest(const bms_state *s) {
    const unsigned vertex = 12 + (s->parts & BURNISH_BMS_NORMALS ? 12 : 0) +
                            (s->parts & BURNISH_BMS_COLORS ? 4 : 0) +
                            (s->parts & BURNISH_BMS_TEXCOORDS ? 8 : 0),
                   triangle = 12 + (s->parts & BURNISH_BMS_TRIANGLE_MATERIALS ? 4 : 0);
    return (uint64_t)s->materials * BURNISH_BMS_MATERIAL_SIZE + (uint64_t)s->vertices * vertex +
           (uint64_t)s->triangles * triangle;
}

/* Checks that a stream is complete, before anything is allocated. Sizes of textures are checked one
 * by one. */
static burnish_status check_size(const bms_state *s) {
    const uint8_t *bytes = s->reader->input->bytes;
    const uint64_t stated = (uint64_t)burnish_load32(bytes + BURNISH_BMS_AT_SIZE + 4) << 32 |
                            burnish_load32(bytes + BURNISH_BMS_AT_SIZE);
    const uint64_t least = BURNISH_BMS_HEAD_SIZE + padded_size(s->text_size) +
                           (uint64_t)s->textures * BURNISH_BMS_TEXTURE_SIZE + size_of_rest(s);
    if (stated != s->reader->input->size || least > stated) {
        return burnish_reader_fail(s->reader, BURNISH_STATUS_FORMAT, bytes + BURNISH_BMS_AT_SIZE,
                                   "the stream states %llu bytes and needs at least %llu for its "
                                   "counts, but has %zu; it is truncated or damaged",
                                   (unsigned long long)stated, (unsigned long long)least,
                                   s->reader->input->size);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status check_counts(const bms_state *s) {
    const burnish_load_options *options = s->reader->input->options;
    const uint8_t *bytes = s->reader->input->bytes;
    if (s->text_size > TEXT_MAX) {
        return bms_fail(s, bytes + BURNISH_BMS_AT_TEXT_SIZE, "more than 65536 bytes of text");
    }
    if (s->materials > MATERIALS_MAX) {
        return bms_fail(s, bytes + BURNISH_BMS_AT_MATERIALS, "more than 65536 materials");
    }
    if (s->textures > BURNISH_TEXTURES_MAX) {
        return bms_fail(s, bytes + BURNISH_BMS_AT_TEXTURES, "more than 65536 textures");
    }
    if (s->vertices > BURNISH_VALUE_LIMIT) {
        return bms_fail(s, bytes + BURNISH_BMS_AT_VERTICES, "more than 4294967294 vertices");
    }
    return s->triangles > options->max_triangles
               ? burnish_fail_triangles(s->reader, bytes + BURNISH_BMS_AT_TRIANGLES)
               : BURNISH_STATUS_OK;
}

/* The importer's message instead of a mesh. */
static burnish_status read_error(const bms_state *s, uint32_t kind) {
    static const burnish_status statuses[BURNISH_BMS_KIND_COUNT] = {
        [BURNISH_BMS_FORMAT_ERROR] = BURNISH_STATUS_FORMAT,
        [BURNISH_BMS_LIMIT_ERROR] = BURNISH_STATUS_LIMIT,
        [BURNISH_BMS_MEMORY_ERROR] = BURNISH_STATUS_MEMORY};
    if (s->text_size == 0) {
        return bms_fail(s, NULL, "an error without a message");
    }
    return burnish_reader_fail(s->reader, statuses[kind], NULL, "%.*s", (int)s->text_size,
                               (const char *)s->next);
}

/* The unit of a length in metres, by the bits of the float. */
static const char *unit_of(uint32_t metres) {
    return metres == 0x3A83126F ? "millimeter" : metres == 0x3F800000 ? "meter" : NULL;
}

/* The up axis; all 0 means the format's. */
static burnish_status read_up(const bms_state *s) {
    const uint8_t *at = s->reader->input->bytes + BURNISH_BMS_AT_UP;
    const float up[3] = {burnish_load_float(at), burnish_load_float(at + 4),
                         burnish_load_float(at + 8)};
    if (!burnish_is_finitef(up[0]) || !burnish_is_finitef(up[1]) || !burnish_is_finitef(up[2])) {
        return bms_fail(s, at, "the up axis is not finite");
    }
    const burnish_vec3 unit = burnish_vec3_normalize(burnish_vec3_loadf(up));
    s->mesh->up_axis[0] = (float)unit.x;
    s->mesh->up_axis[1] = (float)unit.y;
    s->mesh->up_axis[2] = (float)unit.z;
    s->mesh->unit = unit_of(burnish_load32(s->reader->input->bytes + BURNISH_BMS_AT_UNIT));
    return BURNISH_STATUS_OK;
}

static burnish_status read_head(bms_state *s) {
    const burnish_reader_input *input = s->reader->input;
    const uint8_t *bytes = input->bytes;
    if (input->size < BURNISH_BMS_HEAD_SIZE ||
        memcmp(bytes, BURNISH_BMS_MAGIC, sizeof BURNISH_BMS_MAGIC - 1) != 0) {
        return bms_fail(
            s, bytes,
            "not a mesh stream: its first 8 bytes are wrong, or it is shorter than 64 bytes");
    }
    const uint32_t version = burnish_load32(bytes + BURNISH_BMS_AT_VERSION);
    const uint32_t kind = burnish_load32(bytes + BURNISH_BMS_AT_KIND);
    if (version != BURNISH_BMS_VERSION) {
        return burnish_reader_fail(
            s->reader, BURNISH_STATUS_FORMAT, bytes + BURNISH_BMS_AT_VERSION,
            "version %u of the mesh stream, not %d; use the importers of this version of burnish",
            (unsigned)version, BURNISH_BMS_VERSION);
    }
    s->vertices = burnish_load32(bytes + BURNISH_BMS_AT_VERTICES);
    s->triangles = burnish_load32(bytes + BURNISH_BMS_AT_TRIANGLES);
    s->materials = burnish_load32(bytes + BURNISH_BMS_AT_MATERIALS);
    s->textures = burnish_load32(bytes + BURNISH_BMS_AT_TEXTURES);
    s->parts = burnish_load32(bytes + BURNISH_BMS_AT_PARTS);
    s->text_size = burnish_load32(bytes + BURNISH_BMS_AT_TEXT_SIZE);
    s->next = bytes + BURNISH_BMS_HEAD_SIZE;
    if (kind >= BURNISH_BMS_KIND_COUNT) {
        return bms_fail(s, bytes + BURNISH_BMS_AT_KIND, "an unknown kind of mesh stream");
    }
    if (s->parts & ~(uint32_t)BURNISH_BMS_PARTS_ALL) {
        return bms_fail(s, bytes + BURNISH_BMS_AT_PARTS, "an unknown part of a mesh");
    }
    burnish_status status = check_counts(s);
    if (status == BURNISH_STATUS_OK) {
        status = check_size(s);
    }
    if (status == BURNISH_STATUS_OK && kind != BURNISH_BMS_MESH) {
        status = read_error(s, kind);
    }
    return status == BURNISH_STATUS_OK ? read_up(s) : status;
}

/* Each line is a warning. */
static void read_text(bms_state *s) {
    const char *line = (const char *)s->next, *end = line + s->text_size;
    while (line < end) {
        const char *newline = memchr(line, '\n', (size_t)(end - line));
        const char *last = newline ? newline : end;
        if (last > line) {
            burnish_reader_warn(s->reader, NULL, "%.*s", (int)(last - line), line);
        }
        line = last + 1;
    }
    s->next += padded_size(s->text_size);
}

/* ---- Textures ---- */

typedef struct bms_texture {
    uint32_t kind, is_color, width, height;
    size_t size;
    char name[NAME_MAX_SIZE];
} bms_texture;

/* Returns its number in the mesh. */
static int take_texture(bms_state *s, const bms_texture *texture, const uint8_t *bytes) {
    burnish_reader *reader = s->reader;
    if (reader->input->options->ignore_textures) {
        return 0;
    }
    switch (texture->kind) {
    case BURNISH_BMS_FILE:
        return burnish_reader_load_texture(reader, NULL, texture->name, (int)texture->is_color);
    case BURNISH_BMS_ENCODED:
        return burnish_reader_decode_texture(reader, NULL, texture->name, bytes, texture->size,
                                             (int)texture->is_color);
    default:
        return burnish_reader_copy_texture(reader, NULL, texture->name, (int)texture->width,
                                           (int)texture->height, bytes, (int)texture->is_color);
    }
}

/* Reads the record at s->next, and its name and picture. */
static burnish_status read_texture(bms_state *s, size_t number, size_t *damaged) {
    bms_texture texture;
    const uint8_t *head = s->next;
    if (bms_bytes_left(s) < BURNISH_BMS_TEXTURE_SIZE) {
        return bms_fail(s, head, "the stream ends within a texture");
    }
    texture.kind = burnish_load32(head);
    texture.is_color = burnish_load32(head + 4);
    texture.width = burnish_load32(head + 8);
    texture.height = burnish_load32(head + 12);
    const uint32_t name_size = burnish_load32(head + 16);
    texture.size = burnish_load32(head + 20);
    s->next += BURNISH_BMS_TEXTURE_SIZE;
    if (texture.kind > BURNISH_BMS_PIXELS || texture.is_color > 1 || name_size >= NAME_MAX_SIZE) {
        return bms_fail(s, head,
                        "a texture of an unknown kind, or with a name of 4096 bytes or more");
    }
    if (padded_size(name_size) + padded_size(texture.size) > bms_bytes_left(s)) {
        return bms_fail(s, head, "a texture extends beyond the end of the stream");
    }
    if (texture.kind == BURNISH_BMS_PIXELS &&
        (texture.width < 1 || texture.width > BURNISH_TEXTURE_SIZE_MAX || texture.height < 1 ||
         texture.height > BURNISH_TEXTURE_SIZE_MAX ||
         (uint64_t)texture.width * texture.height * 4 != texture.size)) {
        return bms_fail(s, head, "a texture whose size does not match its pixels");
    }
    memcpy(texture.name, s->next, name_size);
    texture.name[name_size] = 0;
    s->next += padded_size(name_size);
    s->texture_numbers[number] = 0;
    if (*damaged < DAMAGED_MAX || texture.kind == BURNISH_BMS_FILE) {
        s->texture_numbers[number] = take_texture(s, &texture, s->next);
        *damaged += texture.kind != BURNISH_BMS_FILE && s->texture_numbers[number] == 0;
    }
    s->next += padded_size(texture.size);
    return s->mesh->memory.status;
}

static burnish_status read_textures(bms_state *s) {
    size_t damaged = 0;
    burnish_status status = BURNISH_STATUS_OK;
    s->texture_numbers =
        burnish_allocate(&s->mesh->memory, s->textures, sizeof *s->texture_numbers, "textures");
    status = s->mesh->memory.status;
    for (size_t i = 0; i < s->textures && status == BURNISH_STATUS_OK; ++i) {
        status = read_texture(s, i, &damaged);
        if (status == BURNISH_STATUS_OK) {
            status = burnish_tasks_check(s->mesh->tasks, s->reader->error);
        }
    }
    return status;
}

/* ---- Parts ---- */

/* Their number, then for each its triangles, which follow those of the part before, and its name. */
static burnish_status read_parts(bms_state *s) {
    size_t first = 0;
    uint32_t left = 0;
    if (bms_bytes_left(s) >= 4) {
        left = burnish_load32(s->next);
        s->next += 4;
    }
    for (; left > 0 && bms_bytes_left(s) >= 8; --left) {
        const uint8_t *head = s->next;
        const uint32_t triangles = burnish_load32(head), size = burnish_load32(head + 4);
        s->next += 8;
        if (padded_size(size) > bms_bytes_left(s) || triangles > s->triangles - first) {
            return bms_fail(s, head,
                            "a part extends beyond the stream, or has more triangles than it");
        }
        const burnish_part part = burnish_part_of((const char *)s->next, size);
        burnish_parts_begin(&s->named, &part, first);
        first += triangles;
        s->next += padded_size(size);
    }
    return left == 0 && first == s->triangles
               ? s->mesh->memory.status
               : bms_fail(s, s->next, "the parts do not have all triangles of the stream");
}

/* ---- Materials ---- */

static void read_color(const uint8_t *at, float color[3]) {
    for (int i = 0; i < 3; ++i) {
        color[i] = burnish_load_float(at + 4 * i);
    }
}

/* One slot: 1 + number of a texture of the stream, then how it repeats. */
static int read_use(const bms_state *s, const uint8_t *at, float strength,
                    burnish_texture_use *use) {
    const uint32_t texture = burnish_load32(at), wrap = burnish_load32(at + 4);
    if (texture > s->textures || (wrap & 0xff) > BURNISH_WRAP_MIRROR ||
        wrap >> 8 > BURNISH_WRAP_MIRROR) {
        return 0;
    }
    const int number = texture > 0 ? s->texture_numbers[texture - 1] : 0;
    if (number > 0) {
        use->texture = number;
        use->wrap[0] = (int)(wrap & 0xff);
        use->wrap[1] = (int)(wrap >> 8);
        use->strength = strength;
    }
    return 1;
}

static burnish_status read_material(bms_state *s, size_t number) {
    const uint8_t *at = s->next, *numbers = at + BURNISH_BMS_AT_EXPONENT;
    const uint32_t flags = burnish_load32(at + BURNISH_BMS_AT_FLAGS);
    burnish_material *material = &s->mesh->materials[number];
    burnish_error why = {0};
    char name[40];
    *material =
        (burnish_material){.exponent = burnish_load_float(numbers),
                           .transparency = 1 - burnish_load_float(numbers + 4),
                           .metallic = burnish_load_float(numbers + 8),
                           .roughness = burnish_load_float(numbers + 12),
                           .alpha_cutoff = burnish_load_float(numbers + 16),
                           .has_diffuse = (flags & BURNISH_BMS_HAS_DIFFUSE) != 0,
                           .has_exponent = (flags & BURNISH_BMS_HAS_EXPONENT) != 0,
                           .is_metallic = (flags & BURNISH_BMS_METALLIC) != 0,
                           .is_unlit = (flags & BURNISH_BMS_UNLIT) != 0,
                           .reflectance = {0.04f, 0.04f, 0.04f},
                           .alpha_mode = flags & BURNISH_BMS_MASK    ? BURNISH_ALPHA_MASK
                                         : flags & BURNISH_BMS_BLEND ? BURNISH_ALPHA_BLEND
                                                                     : BURNISH_ALPHA_IGNORE};
    if (!material->is_metallic) {
        material->metallic = material->roughness = 0;
        memset(material->reflectance, 0, sizeof material->reflectance);
    }
    read_color(at, material->ambient);
    read_color(at + 12, material->diffuse);
    read_color(at + 24, material->specular);
    read_color(at + 36, material->emissive);
    for (int slot = 0; slot < BURNISH_BMS_SLOTS; ++slot) {
        const float strength =
            slot == BURNISH_TEXTURE_NORMAL ? burnish_load_float(numbers + 20) : 1;
        if (!read_use(s, at + BURNISH_BMS_AT_SLOTS + 8 * slot, strength,
                      &material->textures[slot])) {
            return bms_fail(s, at + BURNISH_BMS_AT_SLOTS + 8 * slot,
                            "a material uses a missing texture, or in an unknown way");
        }
    }
    snprintf(name, sizeof name, "material %zu", number);
    if (burnish_check_material(material, s->mesh->texture_count, name, &why) != BURNISH_STATUS_OK) {
        return bms_fail(s, at, why.text);
    }
    s->next += BURNISH_BMS_MATERIAL_SIZE;
    return BURNISH_STATUS_OK;
}

static burnish_status read_materials(bms_state *s) {
    burnish_mesh_data *mesh = s->mesh;
    burnish_status status;
    mesh->materials =
        burnish_allocate(&mesh->memory, s->materials, sizeof *mesh->materials, "materials");
    status = mesh->memory.status;
    mesh->material_capacity = s->materials;
    for (size_t i = 0; i < s->materials && status == BURNISH_STATUS_OK; ++i) {
        status = read_material(s, i);
        mesh->material_count = i + 1;
    }
    return status;
}

/* ---- Vertices and triangles ---- */

static burnish_status go_on(const bms_state *s, size_t i) {
    return i % STEP == STEP - 1 ? burnish_tasks_check(s->mesh->tasks, s->reader->error)
                                : BURNISH_STATUS_OK;
}

/* `width` floats per vertex. A position that is not finite is an error. Other values become 0; a
 * normal of 0 is generated. */
static burnish_status read_floats(bms_state *s, burnish_attribute attribute, size_t width,
                                  int keep) {
    burnish_status status = BURNISH_STATUS_OK;
    if (keep) {
        status = burnish_mesh_data_reserve(s->mesh, attribute, s->vertices);
    }
    float *to = s->mesh->streams[attribute].items;
    for (size_t i = 0; keep && i < s->vertices && status == BURNISH_STATUS_OK; ++i) {
        for (size_t k = 0; k < width; ++k, ++to) {
            const uint8_t *at = s->next + 4 * (i * width + k);
            *to = burnish_load_float(at);
            if (!burnish_is_finitef(*to)) {
                if (attribute == BURNISH_POSITION) {
                    return burnish_reader_fail(s->reader, BURNISH_STATUS_FORMAT, at,
                                               "position %zu is not finite; the stream is damaged",
                                               i);
                }
                *to = 0;
            }
        }
        status = go_on(s, i);
    }
    s->mesh->streams[attribute].count = keep ? s->vertices : 0;
    s->next += 4 * width * s->vertices;
    return status;
}

static burnish_status read_colors(bms_state *s) {
    burnish_status status = burnish_mesh_data_reserve(s->mesh, BURNISH_COLOR, s->vertices);
    if (status == BURNISH_STATUS_OK && s->vertices > 0) {
        memcpy(s->mesh->streams[BURNISH_COLOR].items, s->next, 4 * s->vertices);
        s->mesh->streams[BURNISH_COLOR].count = s->vertices;
        s->next += 4 * s->vertices;
    }
    return status;
}

static burnish_status read_vertices(bms_state *s) {
    const int keeps = burnish_reader_keeps_coordinates(s->reader, s->mesh->texture_count > 0);
    burnish_status status = read_floats(s, BURNISH_POSITION, 3, 1);
    if (status == BURNISH_STATUS_OK) {
        burnish_move_positions(s->mesh);
    }
    if (status == BURNISH_STATUS_OK && s->parts & BURNISH_BMS_NORMALS) {
        status = read_floats(s, BURNISH_NORMAL, 3, 1);
    }
    if (status == BURNISH_STATUS_OK && s->parts & BURNISH_BMS_COLORS) {
        status = read_colors(s);
    }
    return status == BURNISH_STATUS_OK && s->parts & BURNISH_BMS_TEXCOORDS
               ? read_floats(s, BURNISH_TEXCOORD, 2, keeps)
               : status;
}

static burnish_status read_indices(bms_state *s) {
    burnish_status status =
        burnish_mesh_data_reserve_corners(s->mesh, BURNISH_POSITION, s->triangles);
    uint32_t *to = s->mesh->streams[BURNISH_POSITION].corners;
    for (size_t i = 0; i < 3 * s->triangles && status == BURNISH_STATUS_OK; ++i) {
        to[i] = burnish_load32(s->next + 4 * i);
        if (to[i] >= s->vertices) {
            return burnish_reader_fail(
                s->reader, BURNISH_STATUS_FORMAT, s->next + 4 * i,
                "vertex %u is out of range; there are %zu vertices, counted from 0",
                (unsigned)to[i], s->vertices);
        }
        status = go_on(s, i);
    }
    s->mesh->triangle_count = s->triangles;
    s->next += 12 * s->triangles;
    return status;
}

static burnish_status read_triangle_materials(bms_state *s) {
    burnish_mesh_data *mesh = s->mesh;
    mesh->triangle_materials = burnish_allocate(&mesh->memory, s->triangles,
                                                sizeof *mesh->triangle_materials, "materials");
    mesh->triangle_material_capacity = s->triangles;
    burnish_status status = mesh->memory.status;
    const size_t materials = s->materials > 0 ? s->materials : 1;
    for (size_t i = 0; i < s->triangles && status == BURNISH_STATUS_OK; ++i) {
        const uint32_t material = burnish_load32(s->next + 4 * i);
        if (material >= materials) {
            return burnish_reader_fail(
                s->reader, BURNISH_STATUS_FORMAT, s->next + 4 * i,
                "material %u is out of range; there are %zu materials, counted from 0",
                (unsigned)material, materials);
        }
        mesh->triangle_materials[i] = (uint16_t)material;
        status = go_on(s, i);
    }
    s->next += 4 * s->triangles;
    return status;
}

/* The size of the rest after the textures must match the counts exactly. */
static burnish_status check_rest(const bms_state *s) {
    const uint64_t rest = size_of_rest(s);
    return rest == bms_bytes_left(s)
               ? BURNISH_STATUS_OK
               : burnish_reader_fail(s->reader, BURNISH_STATUS_FORMAT, s->next,
                                     "%zu bytes are left for materials, vertices and triangles, "
                                     "which need %llu; the stream is damaged",
                                     bms_bytes_left(s), (unsigned long long)rest);
}

static burnish_status read_all(bms_state *s) {
    burnish_status status = read_head(s);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    read_text(s);
    burnish_status (*const steps[])(bms_state *) = {read_materials, read_vertices, read_indices};
    status = read_textures(s);
    if (status == BURNISH_STATUS_OK && s->parts & BURNISH_BMS_NAMED_PARTS) {
        status = read_parts(s);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_rest(s);
    }
    for (size_t i = 0; i < sizeof steps / sizeof *steps && status == BURNISH_STATUS_OK; ++i) {
        status = steps[i](s);
    }
    if (status == BURNISH_STATUS_OK && s->parts & BURNISH_BMS_TRIANGLE_MATERIALS) {
        status = read_triangle_materials(s);
    }
    return status;
}

static burnish_status bms_read(burnish_reader *reader) {
    bms_state state = {
        .reader = reader, .mesh = reader->mesh, .named = {.memory = &reader->mesh->memory}};
    reader->is_binary = 1;
    burnish_status status = read_all(&state);
    if (status == BURNISH_STATUS_OK && state.triangles > 0) {
        status = burnish_parts_finish(&state.named, state.mesh, 1);
    }
    burnish_parts_release(&state.named);
    burnish_release(reader->mesh->memory.context, state.texture_numbers);
    if (status == BURNISH_STATUS_OK && state.triangles == 0) {
        status = state.vertices > 0
                     ? burnish_make_points(reader, NULL, 0)
                     : bms_fail(&state, NULL, "no triangles; export the scene's meshes");
    }
    return status;
}

static int bms_recognise(const uint8_t *bytes, size_t size) {
    const size_t magic = sizeof BURNISH_BMS_MAGIC - 1;
    return size >= magic && memcmp(bytes, BURNISH_BMS_MAGIC, magic) == 0 ? 2 : 0;
}

const burnish_format_reader burnish_reader_bms = {.recognise = bms_recognise, .read = bms_read};
