/* The mesh stream: valid streams, and messages for damaged ones. */
#include "base/bytes.h"
#include "burnish/mesh.h"
#include "mesh/read/bms.h"
#include "mesh_arrays.h"
#include "reader_input.h"

/* The contents of the streams of these tests, with the counts of the head. */
typedef struct stream {
    byte_list list;
    size_t vertices_at, indices_at, numbers_at, materials_at, textures_at;
} stream;

enum { VERTICES = 4, TRIANGLES = 2, TEXELS = 4, FLAGS = BURNISH_BMS_HAS_DIFFUSE };

static void put_words(byte_list *list, const uint32_t *words, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        put_bits(list, words[i], 4, 0);
    }
}

static void put_floats(byte_list *list, const float *values, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        put_float(list, values[i], 0);
    }
}

/* Writes the size into the stream. */
static void close_stream(byte_list *list) {
    const uint64_t size = list->size;
    for (int i = 0; i < 8; ++i) {
        list->bytes[BURNISH_BMS_AT_SIZE + i] = (uint8_t)(size >> 8 * i);
    }
}

static void put_head(byte_list *list, uint32_t kind, const uint32_t numbers_of[6],
                     const float *up) {
    put(list, BURNISH_BMS_MAGIC, 8);
    put_bits(list, 1, 4, 0);
    put_bits(list, kind, 4, 0);
    put_bits(list, 0, 8, 0);
    put_words(list, numbers_of, 6);
    put_floats(list, up, 3);
    put_float(list, 0.001f, 0);
}

static void put_material(byte_list *list) {
    const float numbers[18] = {.1f, .2f, .3f,  .4f, .5f,  .6f, .7f, .8f,  .9f,
                               2,   3,   0.5f, 30,  .75f, 0,   .5f, .25f, 1};
    const uint32_t slots[16] = {1, 1 | 2 << 8};
    put_floats(list, numbers, 18);
    put_bits(list, FLAGS | BURNISH_BMS_MASK, 4, 0);
    put_words(list, slots, 16);
    put_bits(list, 0, 4, 0);
}

/* A square of two triangles, the second red by its material. All vertices have all attributes. */
static stream make(const char *text) {
    static const float up[3] = {0, 0, 2};
    static const float places[VERTICES * 3] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3}, numbers[2] = {0, 1};
    static const uint8_t texels[4 * TEXELS] = {255, 0, 0, 255, 0, 255, 0, 255,
                                               0,   0, 9, 255, 0, 0,   0, 128};
    const uint32_t text_size = (uint32_t)strlen(text);
    const uint32_t numbers_of[6] = {
        VERTICES, TRIANGLES, 2, 1, BURNISH_BMS_PARTS_ALL - BURNISH_BMS_NAMED_PARTS, text_size};
    const uint32_t texture[6] = {BURNISH_BMS_PIXELS, 1, 2, 2, 3, sizeof texels};
    stream s = {.list.size = 0};
    put_head(&s.list, BURNISH_BMS_MESH, numbers_of, up);
    put_text(&s.list, text);
    put(&s.list, "\0\0\0", (4 - text_size % 4) % 4);
    s.textures_at = s.list.size;
    put_words(&s.list, texture, 6);
    put(&s.list, "abc", 4);
    put(&s.list, texels, sizeof texels);
    s.materials_at = s.list.size;
    put_material(&s.list);
    put_material(&s.list);
    s.vertices_at = s.list.size;
    put_floats(&s.list, places, VERTICES * 3);
    for (int i = 0; i < VERTICES; ++i) {
        put_floats(&s.list, (const float[3]){0, 0, 3}, 3);
    }
    for (int i = 0; i < VERTICES; ++i) {
        put(&s.list, (const uint8_t[4]){(uint8_t)(10 * i), 20, 30, 255}, 4);
    }
    put_floats(&s.list, (const float[8]){0, 0, 1, 0, 1, 1, 0, .5f}, 8);
    s.indices_at = s.list.size;
    put_words(&s.list, indices, 6);
    s.numbers_at = s.list.size;
    put_words(&s.list, numbers, 2);
    close_stream(&s.list);
    return s;
}

static burnish_mesh *load(const byte_list *list, const burnish_load_options *options) {
    return load_bytes(list->bytes, list->size, "a", options);
}

static void test_all_parts(void) {
    const stream s = make("first\nsecond\n\n");
    OWNED_MESH *mesh = load(&s.list, NULL);
    if (!mesh) {
        return;
    }
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    CHECK1(burnish_mesh_get_info(mesh)->format == BURNISH_FORMAT_BMS);
    /* two vertices are duplicated, because materials meet in them */
    CHECK1(view->triangle_count == 2 && view->vertex_count >= 4 && view->colors &&
           view->texture_coordinates && view->triangle_materials);
    CHECK1(view->up_axis[0] == 0 && view->up_axis[1] == 0 && view->up_axis[2] == 1);
    for (size_t i = 0; i < view->vertex_count; ++i) {
        const float *p = view->positions + 3 * i, *n = view->normals + 3 * i;
        const int corner = p[1] == 0 ? (int)p[0] : 3 - (int)p[0];
        CHECK1(n[0] == 0 && n[1] == 0 && n[2] == 1);
        CHECK1(view->colors[4 * i] == 10 * corner && view->colors[4 * i + 1] == 20);
        CHECK1(view->texture_coordinates[2 * i] == p[0] &&
               view->texture_coordinates[2 * i + 1] == (corner == 3 ? .5f : p[1]));
    }
    CHECK1(burnish_mesh_get_warning_count(mesh) == 2);
    CHECK_TEXT(burnish_mesh_get_warning(mesh, 1), "a: second");
    const burnish_material *m = burnish_mesh_get_material(mesh, 1);
    CHECK1(burnish_mesh_get_material_count(mesh) == 2 && m->ambient[0] == .1f &&
           m->diffuse[1] == .5f);
    CHECK1(m->specular[2] == .9f && m->emissive[1] == 3 && m->exponent == 30);
    CHECK1(m->transparency == .25f && m->alpha_cutoff == .25f);
    CHECK1(m->roughness == 0); /* which only metallic materials have */
    CHECK1(m->has_diffuse && !m->is_metallic && m->alpha_mode == BURNISH_ALPHA_MASK);
    const burnish_texture_use *use = &m->textures[BURNISH_TEXTURE_COLOR];
    CHECK1(use->texture == 1 && use->wrap[0] == BURNISH_WRAP_CLAMP &&
           use->wrap[1] == BURNISH_WRAP_MIRROR);
    const burnish_texture *texture = burnish_mesh_get_texture(mesh, 0);
    CHECK1(texture && texture->width == 2 && texture->height == 2 && texture->is_color &&
           texture->pixels[4] == 0 && texture->pixels[5] == 255);
    CHECK_TEXT(texture ? texture->name : "", "abc");
}

/* Without parts, materials, text or an axis. A stream without triangles becomes points. */
static void test_least(void) {
    static const float places[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, no_axis[3] = {0, 0, 0};
    for (uint32_t triangles = 0; triangles < 2; ++triangles) {
        const uint32_t numbers_of[6] = {3, triangles}, indices[3] = {0, 1, 2};
        byte_list list = {.size = 0};
        put_head(&list, BURNISH_BMS_MESH, numbers_of, no_axis);
        put_floats(&list, places, 9);
        put_words(&list, indices, 3 * triangles);
        close_stream(&list);
        OWNED_MESH *mesh = load(&list, NULL);
        const burnish_mesh_view *view = mesh ? burnish_mesh_get_view(mesh) : NULL;
        CHECK1(view && view->up_axis[1] == 1 && !view->colors);
        CHECK1(view && view->triangle_count == triangles);
        CHECK1(mesh && burnish_mesh_get_info(mesh)->point_count == (triangles ? 0 : 3));
    }
}

/* A changed word, and the expected message. */
typedef struct damage {
    size_t at;
    uint32_t word;
    const char *message;
} damage;

static void check_damage(stream s, const damage *d) {
    burnish_load_options options = burnish_load_options_default();
    options.format = BURNISH_FORMAT_BMS;
    options.max_triangles = 10;
    burnish_store32(s.list.bytes + d->at, d->word);
    check_refused(s.list.bytes, s.list.size, "a", &options,
                  strstr(d->message, "raise the limit") ? BURNISH_STATUS_LIMIT
                                                        : BURNISH_STATUS_FORMAT,
                  d->message);
}

static void test_messages(void) {
    const stream s = make("");
    const damage cases[] = {
        {0, 0,
         "a: byte 0: not a mesh stream: its first 8 bytes are wrong, or it is shorter than 64 "
         "bytes"},
        {BURNISH_BMS_AT_VERSION, 2,
         "a: byte 8: version 2 of the mesh stream, not 1; use the importers of this version of "
         "burnish"},
        {BURNISH_BMS_AT_KIND, 4, "a: byte 12: an unknown kind of mesh stream"},
        {BURNISH_BMS_AT_KIND, BURNISH_BMS_FORMAT_ERROR, "a: an error without a message"},
        {BURNISH_BMS_AT_SIZE + 4, 1,
         "a: byte 16: the stream states 4294967868 bytes and needs at least 552 for its counts, "
         "but has 572; it is truncated or damaged"},
        {BURNISH_BMS_AT_VERTICES, UINT32_MAX, "a: byte 24: more than 4294967294 vertices"},
        {BURNISH_BMS_AT_VERTICES, UINT32_MAX - 1,
         "a: byte 16: the stream states 572 bytes and needs at least 154618822992 for its counts, "
         "but has 572; it is truncated or damaged"},
        {BURNISH_BMS_AT_VERTICES, 3,
         "a: byte 108: 464 bytes are left for materials, vertices and triangles, which need 428; "
         "the stream is damaged"},
        {BURNISH_BMS_AT_TRIANGLES, 11,
         "a: byte 28: more than 10 triangles; raise the limit or simplify the mesh"},
        {BURNISH_BMS_AT_MATERIALS, 65537, "a: byte 32: more than 65536 materials"},
        {BURNISH_BMS_AT_TEXTURES, 65537, "a: byte 36: more than 65536 textures"},
        {BURNISH_BMS_AT_PARTS, 32, "a: byte 40: an unknown part of a mesh"},
        {BURNISH_BMS_AT_TEXT_SIZE, 65537, "a: byte 44: more than 65536 bytes of text"},
        {BURNISH_BMS_AT_UP, 0x7f800000, "a: byte 48: the up axis is not finite"},
        {s.textures_at, 3,
         "a: byte 64: a texture of an unknown kind, or with a name of 4096 bytes or more"},
        {s.textures_at + 16, 4096,
         "a: byte 64: a texture of an unknown kind, or with a name of 4096 bytes or more"},
        {s.textures_at + 20, 0xffffffff,
         "a: byte 64: a texture extends beyond the end of the stream"},
        {s.textures_at + 8, 0x40000002,
         "a: byte 64: a texture whose size does not match its pixels"},
        {s.materials_at + 4, 0xbf800000,
         "a: byte 108: material 0: ambient[1] is -1, not in [0, 1]"},
        {s.materials_at + BURNISH_BMS_AT_EXPONENT, 0x7fc00000,
         "a: byte 108: material 0: exponent is nan, not in [1, 65536]"},
        {s.materials_at + BURNISH_BMS_AT_SLOTS, 2,
         "a: byte 184: a material uses a missing texture, or in an unknown way"},
        {s.materials_at + BURNISH_BMS_AT_SLOTS + 4, 3,
         "a: byte 184: a material uses a missing texture, or in an unknown way"},
        {s.vertices_at + 16, 0x7f800000,
         "a: byte 412: position 1 is not finite; the stream is damaged"},
        {s.indices_at + 8, 4,
         "a: byte 548: vertex 4 is out of range; there are 4 vertices, counted from 0"},
        {s.numbers_at, 2,
         "a: byte 564: material 2 is out of range; there are 2 materials, counted from 0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        check_damage(s, &cases[i]);
    }
}

/* The stream with words as its named parts. */
static byte_list with_parts(const uint32_t *words, size_t count) {
    const stream s = make("");
    byte_list list = {.size = 0};
    put(&list, s.list.bytes, s.materials_at);
    put_words(&list, words, count);
    put(&list, s.list.bytes + s.materials_at, s.list.size - s.materials_at);
    list.bytes[BURNISH_BMS_AT_PARTS] |= BURNISH_BMS_NAMED_PARTS;
    close_stream(&list);
    return list;
}

static void test_named_parts(void) {
    const uint32_t good[] = {3, 1, 1, 'a', 0, 0, 1, 2, 'b' + 256 * 'c'};
    const byte_list list = with_parts(good, 9);
    OWNED_MESH *mesh = load(&list, NULL);
    const burnish_contents *c = burnish_mesh_get_contents(mesh);
    CHECK1(c && c->part_count == 2 && strcmp(c->parts[1].name, "bc") == 0 &&
           c->parts[1].triangle_count == 1 && burnish_mesh_get_view(mesh)->triangle_parts);
    const struct {
        uint32_t words[6];
        size_t count;
        const char *message;
    } bad[] = {
        {{1, 3, 0},
         3,
         "a: byte 112: a part extends beyond the stream, or has more triangles than it"},
        {{1, 2, 999},
         3,
         "a: byte 112: a part extends beyond the stream, or has more triangles than it"},
        {{1, 1, 0}, 3, "a: byte 120: the parts do not have all triangles of the stream"},
        {{1, 2, 0, 0},
         4,
         "a: byte 120: 468 bytes are left for materials, vertices and triangles, which need 464; "
         "the stream is damaged"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        const byte_list damaged = with_parts(bad[i].words, bad[i].count);
        check_refused(damaged.bytes, damaged.size, "a", NULL, BURNISH_STATUS_FORMAT,
                      bad[i].message);
    }
}

/* An importer's message instead of a mesh. */
static void test_errors(void) {
    static const burnish_status statuses[BURNISH_BMS_KIND_COUNT] = {
        BURNISH_STATUS_OK, BURNISH_STATUS_FORMAT, BURNISH_STATUS_LIMIT, BURNISH_STATUS_MEMORY};
    for (uint32_t kind = 1; kind < BURNISH_BMS_KIND_COUNT; ++kind) {
        const uint32_t numbers_of[6] = {0, 0, 0, 0, 0, 9};
        byte_list list = {.size = 0};
        put_head(&list, kind, numbers_of, (const float[3]){0, 0, 0});
        put(&list, "no\033 luck!\0\0", 12);
        close_stream(&list);
        check_refused(list.bytes, list.size, "a", NULL, statuses[kind], "a: no? luck!");
    }
}

/* Its textures count towards the limit, and are absent if textures are ignored. */
static void test_textures(void) {
    const stream s = make("");
    burnish_load_options few = burnish_load_options_default(), none = few;
    few.max_texture_pixels = TEXELS - 1;
    OWNED_MESH *limited = load(&s.list, &few);
    CHECK1(burnish_mesh_get_texture_count(limited) == 0 &&
           burnish_mesh_get_warning_count(limited) == 1);
    CHECK_TEXT(burnish_mesh_get_warning(limited, 0),
               "a: texture \"abc\" was skipped: too many texels; raise the limit or make textures "
               "smaller");
    none.ignore_textures = 1;
    OWNED_MESH *plain = load(&s.list, &none);
    CHECK1(burnish_mesh_get_texture_count(plain) == 0 &&
           burnish_mesh_get_warning_count(plain) == 0);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_all_parts());
    RUN(test_least());
    RUN(test_messages());
    RUN(test_named_parts());
    RUN(test_errors());
    RUN(test_textures());
    return test_end("bms");
}
