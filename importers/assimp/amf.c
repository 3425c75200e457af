#include "amf.h"
#include "core/numbers.h"

#include <expat.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    DEPTH_MAX = 64,
    TEXT_SIZE = 64,  /* of a number */
    INSTANCES = 32,  /* of constellations in constellations */
    PIECE = 1 << 20, /* bytes that expat gets at once */
    GREY = 158,      /* importer_default_material's, as a code of sRGB */
    NOTHING = UINT32_MAX
};
#define TRIANGLES_MAX 33554432 /* of objects that are placed again and again */

typedef enum element {
    FILE_ITSELF,
    OTHER,
    AMF,
    OBJECT,
    MESH,
    VERTICES,
    VERTEX,
    COORDINATES,
    VOLUME,
    TRIANGLE,
    MATERIAL,
    COLOR,
    CONSTELLATION,
    INSTANCE,
    TEXTURE_MAP,
    NUMBER
} element;

/* A row for each element where it means something; NUMBER: its text is numbers[slot]. */
static const struct {
    const char *name;
    element parent, self;
    int slot;
} rows[] = {
    {"amf", FILE_ITSELF, AMF, 0},
    {"object", AMF, OBJECT, 0},
    {"material", AMF, MATERIAL, 0},
    {"constellation", AMF, CONSTELLATION, 0},
    {"mesh", OBJECT, MESH, 0},
    {"vertices", MESH, VERTICES, 0},
    {"vertex", VERTICES, VERTEX, 0},
    {"coordinates", VERTEX, COORDINATES, 0},
    {"volume", MESH, VOLUME, 0},
    {"triangle", VOLUME, TRIANGLE, 0},
    {"instance", CONSTELLATION, INSTANCE, 0},
    {"color", OBJECT, COLOR, 0},
    {"color", VERTEX, COLOR, 0},
    {"color", VOLUME, COLOR, 0},
    {"color", TRIANGLE, COLOR, 0},
    {"color", MATERIAL, COLOR, 0},
    {"texmap", TRIANGLE, TEXTURE_MAP, 0},
    {"map", TRIANGLE, TEXTURE_MAP, 0},
    {"x", COORDINATES, NUMBER, 0},
    {"y", COORDINATES, NUMBER, 1},
    {"z", COORDINATES, NUMBER, 2},
    {"v1", TRIANGLE, NUMBER, 0},
    {"v2", TRIANGLE, NUMBER, 1},
    {"v3", TRIANGLE, NUMBER, 2},
    {"r", COLOR, NUMBER, 0},
    {"g", COLOR, NUMBER, 1},
    {"b", COLOR, NUMBER, 2},
    {"a", COLOR, NUMBER, 3},
    {"deltax", INSTANCE, NUMBER, 0},
    {"deltay", INSTANCE, NUMBER, 1},
    {"deltaz", INSTANCE, NUMBER, 2},
    {"rx", INSTANCE, NUMBER, 3},
    {"ry", INSTANCE, NUMBER, 4},
    {"rz", INSTANCE, NUMBER, 5},
    {"scalex", INSTANCE, NUMBER, 6}, /* as Slic3r and PrusaSlicer write */
    {"scaley", INSTANCE, NUMBER, 7},
    {"scalez", INSTANCE, NUMBER, 8},
    {"scale", INSTANCE, NUMBER, 9},
    {"mirrorx", INSTANCE, NUMBER, 10},
    {"mirrory", INSTANCE, NUMBER, 11},
    {"mirrorz", INSTANCE, NUMBER, 12},
};
enum { NUMBERS = 13 };

/* ---- What the file holds ---- */

typedef struct tint {
    uint8_t rgba[4];
    uint8_t is_there;
} tint;

typedef struct amf_vertex {
    double xyz[3];
    tint color;
} amf_vertex;

typedef struct amf_triangle {
    uint32_t corners[3]; /* of all vertices */
    uint32_t volume;
    tint color;
} amf_triangle;

typedef struct amf_volume {
    uint32_t object, material; /* material: its id; NOTHING: none */
    tint color;
} amf_volume;

typedef struct amf_object {
    uint32_t id;
    size_t first_vertex, first_triangle, triangle_count;
    int is_placed;
    tint color;
} amf_object;

typedef struct amf_material {
    uint32_t id;
    tint color;
} amf_material;

typedef struct amf_instance {
    uint32_t id; /* of an object or a constellation */
    double matrix[12];
} amf_instance;

typedef struct amf_constellation {
    uint32_t id;
    size_t first, count; /* instances */
    int is_placed;
} amf_constellation;

#define LIST(type)                                                                                 \
    struct {                                                                                       \
        type *items;                                                                               \
        size_t count, capacity;                                                                    \
    }

typedef struct amf {
    importer_mesh *mesh;
    XML_Parser parser;
    uint8_t elements[DEPTH_MAX + 1];
    int depth;
    char text[TEXT_SIZE]; /* of a number's element */
    size_t text_size;
    int slot;
    double numbers[NUMBERS];
    int has_number[NUMBERS];
    double outer[NUMBERS]; /* of the triangle around a colour */
    int has_outer[NUMBERS];
    LIST(amf_vertex) vertices;
    LIST(amf_triangle) triangles;
    LIST(amf_volume) volumes;
    LIST(amf_object) objects;
    LIST(amf_material) materials;
    LIST(amf_instance) instances;
    LIST(amf_constellation) constellations;
    int has_colors;
    uint64_t placed; /* triangles */
    int is_counting;
} amf;

/* Room for one more item, cleared. */
static void *append(void **items, size_t *count, size_t *capacity, size_t size) {
    if (*count == *capacity) {
        const size_t wanted = *capacity > 0 ? 2 * *capacity : 64;
        void *grown = wanted <= UINT32_MAX / 2 ? realloc(*items, wanted * size) : NULL;
        if (!grown) {
            importer_fail(BURNISH_BMS_MEMORY_ERROR, "out of memory for the AMF file");
        }
        *items = grown;
        *capacity = wanted;
    }
    return memset((char *)*items + size * (*count)++, 0, size);
}
#define APPEND(list)                                                                               \
    append((void **)&(list)->items, &(list)->count, &(list)->capacity, sizeof *(list)->items)

static _Noreturn void fail(const amf *a, const char *what) {
    char line[300];
    snprintf(line, sizeof line, "line %lu: %s; repair the file",
             (unsigned long)XML_GetCurrentLineNumber(a->parser), what);
    importer_fail(BURNISH_BMS_FORMAT_ERROR, line);
}

/* ---- Elements ---- */

static uint32_t whole_of(const char *text) {
    char *end;
    const unsigned long long number = text && *text ? strtoull(text, &end, 10) : NOTHING;
    return number < NOTHING ? (uint32_t)number : NOTHING;
}

static const char *attribute(const char **attributes, const char *name) {
    for (; *attributes; attributes += 2) {
        if (strcmp(*attributes, name) == 0) {
            return attributes[1];
        }
    }
    return NULL;
}

static void begin_object(amf *a, const char **attributes) {
    amf_object *object = APPEND(&a->objects);
    *object = (amf_object){.id = whole_of(attribute(attributes, "id")),
                           .first_vertex = a->vertices.count,
                           .first_triangle = a->triangles.count};
}

static void begin_volume(amf *a, const char **attributes) {
    amf_volume *volume = APPEND(&a->volumes);
    volume->object = (uint32_t)a->objects.count - 1;
    volume->material = whole_of(attribute(attributes, "materialid"));
}

static void read_unit(amf *a, const char *name) {
    static const struct {
        const char *name;
        float metres;
    } units[] = {{"inch", .0254f}, {"meter", 1}, {"feet", .3048f}, {"micron", 1e-6f}};
    a->mesh->unit = .001f;
    for (size_t i = 0; name && i < sizeof units / sizeof *units; ++i) {
        if (strcmp(units[i].name, name) == 0) {
            a->mesh->unit = units[i].metres;
        }
    }
}

static void XMLCALL begin(void *user_data, const char *name, const char **attributes) {
    amf *a = user_data;
    element self = OTHER;
    if (a->depth == DEPTH_MAX) {
        fail(a, "elements more than 64 deep");
    }
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        if (rows[i].parent == a->elements[a->depth] && strcmp(rows[i].name, name) == 0) {
            self = rows[i].self;
            a->slot = rows[i].slot;
        }
    }
    a->elements[++a->depth] = (uint8_t)self;
    a->text_size = 0;
    if (self == COLOR) { /* inside what has numbers of its own */
        memcpy(a->outer, a->numbers, sizeof a->outer);
        memcpy(a->has_outer, a->has_number, sizeof a->has_outer);
    }
    if (self == COORDINATES || self == TRIANGLE || self == COLOR || self == INSTANCE) {
        memset(a->has_number, 0, sizeof a->has_number);
    }
    switch (self) {
    case AMF:
        read_unit(a, attribute(attributes, "unit"));
        break;
    case OBJECT:
        begin_object(a, attributes);
        break;
    case VERTEX:
        APPEND(&a->vertices);
        break;
    case VOLUME:
        begin_volume(a, attributes);
        break;
    case TRIANGLE: {
        amf_triangle *triangle = APPEND(&a->triangles);
        triangle->volume = (uint32_t)a->volumes.count - 1;
        break;
    }
    case MATERIAL: {
        amf_material *material = APPEND(&a->materials);
        material->id = whole_of(attribute(attributes, "id"));
        break;
    }
    case CONSTELLATION: {
        amf_constellation *constellation = APPEND(&a->constellations);
        constellation->id = whole_of(attribute(attributes, "id"));
        constellation->first = a->instances.count;
        break;
    }
    case INSTANCE: {
        amf_instance *instance = APPEND(&a->instances);
        instance->id = whole_of(attribute(attributes, "objectid"));
        ++a->constellations.items[a->constellations.count - 1].count;
        break;
    }
    case TEXTURE_MAP:
        importer_warn(a->mesh, "textures of AMF are not drawn");
        break;
    default:
        break;
    }
}

static void XMLCALL keep_text(void *user_data, const char *text, int size) {
    amf *a = user_data;
    for (int i = 0; i < size && a->elements[a->depth] == NUMBER; ++i) {
        if (a->text_size + 1 < sizeof a->text) {
            a->text[a->text_size] = text[i];
        }
        ++a->text_size;
    }
}

/* Formulas of colours are no numbers: what they say is not drawn. */
static void end_number(amf *a) {
    char *end = a->text;
    const int fits = a->text_size < sizeof a->text;
    a->text[fits ? a->text_size : 0] = 0;
    const double value = strtod(a->text, &end);
    const int is_number = end > a->text && end[strspn(end, " \t\r\n")] == 0 && isfinite(value);
    if (is_number) {
        a->numbers[a->slot] = value;
        a->has_number[a->slot] = 1;
    } else if (a->elements[a->depth] != COLOR) {
        fail(a, "what should be a number is none");
    }
}

static void end_color(amf *a) {
    tint color = {.rgba = {0, 0, 0, 255},
                  .is_there = (uint8_t)(a->has_number[0] && a->has_number[1] && a->has_number[2])};
    for (int i = 0; i < 4; ++i) {
        const double value = a->numbers[i];
        if (a->has_number[i]) {
            color.rgba[i] = (uint8_t)(value > 0 ? value < 1 ? value * 255 + .5 : 255 : 0);
        }
    }
    memcpy(a->numbers, a->outer, sizeof a->outer);
    memcpy(a->has_number, a->has_outer, sizeof a->has_outer);
    if (!color.is_there) {
        importer_warn(a->mesh, "colours that are formulas are not drawn");
        return;
    }
    switch (a->elements[a->depth]) {
    case OBJECT:
        a->objects.items[a->objects.count - 1].color = color;
        break;
    case VOLUME:
        a->volumes.items[a->volumes.count - 1].color = color;
        break;
    case VERTEX:
        a->vertices.items[a->vertices.count - 1].color = color;
        break;
    case TRIANGLE:
        a->triangles.items[a->triangles.count - 1].color = color;
        break;
    default:
        a->materials.items[a->materials.count - 1].color = color;
        break;
    }
}

static void end_coordinates(amf *a) {
    amf_vertex *vertex = &a->vertices.items[a->vertices.count - 1];
    for (int i = 0; i < 3; ++i) {
        if (!a->has_number[i]) {
            fail(a, "a vertex has fewer than 3 coordinates");
        }
        vertex->xyz[i] = a->numbers[i];
    }
}

static void end_triangle(amf *a) {
    amf_triangle *triangle = &a->triangles.items[a->triangles.count - 1];
    amf_object *object = &a->objects.items[a->objects.count - 1];
    const size_t count = a->vertices.count - object->first_vertex;
    for (int i = 0; i < 3; ++i) {
        if (!a->has_number[i] || !(a->numbers[i] >= 0 && a->numbers[i] < (double)count)) {
            fail(a, "a triangle names a vertex that is not there");
        }
        triangle->corners[i] = (uint32_t)(object->first_vertex + (size_t)a->numbers[i]);
    }
    ++object->triangle_count;
}

/* Turned about X, then Y, then Z, in degrees, and moved. */
static void end_instance(amf *a) {
    const double *n = a->numbers;
    double turn[3][2], size[3];
    for (int i = 0; i < 3; ++i) {
        const double angle = a->has_number[3 + i] ? n[3 + i] * BURNISH_DEGREE : 0;
        turn[i][0] = cos(angle);
        turn[i][1] = sin(angle);
        size[i] = (a->has_number[9] ? n[9] : 1) * (a->has_number[6 + i] ? n[6 + i] : 1) *
                  (a->has_number[10 + i] && n[10 + i] != 0 ? -1 : 1);
    }
    const double cx = turn[0][0], sx = turn[0][1], cy = turn[1][0], sy = turn[1][1],
                 cz = turn[2][0], sz = turn[2][1];
    const double matrix[12] = {cz * cy * size[0],
                               (cz * sy * sx - sz * cx) * size[1],
                               (cz * sy * cx + sz * sx) * size[2],
                               a->has_number[0] ? n[0] : 0,
                               sz * cy * size[0],
                               (sz * sy * sx + cz * cx) * size[1],
                               (sz * sy * cx - cz * sx) * size[2],
                               a->has_number[1] ? n[1] : 0,
                               -sy * size[0],
                               cy * sx * size[1],
                               cy * cx * size[2],
                               a->has_number[2] ? n[2] : 0};
    memcpy(a->instances.items[a->instances.count - 1].matrix, matrix, sizeof matrix);
}

static void XMLCALL end(void *user_data, const char *name) {
    amf *a = user_data;
    const element self = (element)a->elements[a->depth--];
    (void)name;
    switch (self) {
    case NUMBER:
        end_number(a);
        break;
    case COLOR:
        end_color(a);
        break;
    case COORDINATES:
        end_coordinates(a);
        break;
    case TRIANGLE:
        end_triangle(a);
        break;
    case INSTANCE:
        end_instance(a);
        break;
    default:
        break;
    }
}

static void XMLCALL refuse_document_type(void *user_data, const char *name, const char *system,
                                         const char *public, int has_internal) {
    (void)name, (void)system, (void)public, (void)has_internal;
    fail(user_data, "a document type (DOCTYPE), which is not read");
}

/* Text in UTF-16 is UTF-8 by now, whatever its first line says. */
static const char *encoding_of(const importer_input *input) {
    for (size_t i = 0; i + 6 <= input->size && i < 100 && input->bytes[i] != '>'; ++i) {
        if (memcmp(input->bytes + i, "UTF-16", 6) == 0 ||
            memcmp(input->bytes + i, "utf-16", 6) == 0) {
            return "UTF-8";
        }
    }
    return NULL;
}

static void parse(amf *a, const importer_input *input) {
    a->parser = XML_ParserCreate(encoding_of(input));
    if (!a->parser) {
        importer_fail(BURNISH_BMS_MEMORY_ERROR, "out of memory for XML");
    }
    XML_SetUserData(a->parser, a);
    XML_SetElementHandler(a->parser, begin, end);
    XML_SetCharacterDataHandler(a->parser, keep_text);
    XML_SetStartDoctypeDeclHandler(a->parser, refuse_document_type);
    for (size_t at = 0; at < input->size;) {
        const size_t left = input->size - at, size = left < PIECE ? left : PIECE;
        if (XML_Parse(a->parser, (const char *)input->bytes + at, (int)size, size == left) !=
            XML_STATUS_OK) {
            const enum XML_Error code = XML_GetErrorCode(a->parser);
            char what[120];
            if (code == XML_ERROR_NO_MEMORY) {
                importer_fail(BURNISH_BMS_MEMORY_ERROR, "out of memory for XML");
            }
            snprintf(what, sizeof what, "the XML is not well formed (%s)", XML_ErrorString(code));
            fail(a, what);
        }
        at += size;
    }
}

/* ---- The mesh ---- */

static const tint *color_of_material(const amf *a, uint32_t id) {
    static const tint none = {.is_there = 0};
    for (size_t i = 0; i < a->materials.count && id != NOTHING; ++i) {
        if (a->materials.items[i].id == id) {
            return &a->materials.items[i].color;
        }
    }
    return &none;
}

/* Of a triangle that has none, nor have its vertices: the nearest around it. */
static tint color_of_volume(const amf *a, const amf_volume *volume) {
    const tint *object = &a->objects.items[volume->object].color;
    tint grey = {.rgba = {GREY, GREY, GREY, 255}};
    return volume->color.is_there ? volume->color
           : object->is_there     ? *object
           : color_of_material(a, volume->material)->is_there
               ? *color_of_material(a, volume->material)
               : grey;
}

/* Every triangle has vertices of its own: burnish welds them. */
static void put_object(amf *a, amf_object *object, const double matrix[12]) {
    importer_mesh *mesh = a->mesh;
    tint around = {.is_there = 0};
    uint32_t volume = NOTHING;
    const double determinant = matrix[0] * (matrix[5] * matrix[10] - matrix[6] * matrix[9]) -
                               matrix[1] * (matrix[4] * matrix[10] - matrix[6] * matrix[8]) +
                               matrix[2] * (matrix[4] * matrix[9] - matrix[5] * matrix[8]);
    if (a->is_counting) {
        object->is_placed = 1;
        a->placed += object->triangle_count;
        return;
    }
    for (size_t i = 0; i < object->triangle_count; ++i) {
        const amf_triangle *triangle = &a->triangles.items[object->first_triangle + i];
        if (triangle->volume != volume) {
            volume = triangle->volume;
            around = color_of_volume(a, &a->volumes.items[volume]);
        }
        for (int k = 0; k < 3; ++k) {
            const uint64_t at = 3 * a->placed + (uint64_t)k;
            const amf_vertex *vertex =
                &a->vertices.items[triangle->corners[determinant < 0 && k > 0 ? 3 - k : k]];
            for (int axis = 0; axis < 3; ++axis) {
                const double *row = matrix + 4 * axis;
                const float moved = (float)(row[0] * vertex->xyz[0] + row[1] * vertex->xyz[1] +
                                            row[2] * vertex->xyz[2] + row[3]);
                mesh->positions[3 * at + (uint64_t)axis] = isfinite(moved) ? moved : 0;
            }
            mesh->indices[at] = (uint32_t)at;
            if (mesh->colors) {
                const tint *color = triangle->color.is_there ? &triangle->color
                                    : vertex->color.is_there ? &vertex->color
                                                             : &around;
                memcpy(mesh->colors + 4 * at, color->rgba, 4);
            }
        }
        ++a->placed;
    }
}

static void multiply(const double m[12], const double n[12], double product[12]) {
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            product[4 * row + column] = m[4 * row] * n[column] + m[4 * row + 1] * n[4 + column] +
                                        m[4 * row + 2] * n[8 + column] +
                                        (column == 3 ? m[4 * row + 3] : 0);
        }
    }
}

/* Counts the steps too: constellations of nothing may be many. */
static void put_constellation(amf *a, const amf_constellation *constellation,
                              const double matrix[12], int depth, uint64_t *steps) {
    if (depth == INSTANCES || (*steps += constellation->count) > TRIANGLES_MAX ||
        a->placed > TRIANGLES_MAX) {
        importer_fail(BURNISH_BMS_LIMIT_ERROR,
                      "constellations hold each other more than 32 deep, or more than 33554432 "
                      "triangles; simplify the file");
    }
    for (size_t i = 0; i < constellation->count; ++i) {
        const amf_instance *instance = &a->instances.items[constellation->first + i];
        double product[12];
        multiply(matrix, instance->matrix, product);
        for (size_t k = 0; k < a->objects.count; ++k) {
            if (a->objects.items[k].id == instance->id) {
                put_object(a, &a->objects.items[k], product);
                break;
            }
        }
        for (size_t k = 0; k < a->constellations.count; ++k) {
            if (a->constellations.items[k].id == instance->id) {
                put_constellation(a, &a->constellations.items[k], product, depth + 1, steps);
                break;
            }
        }
    }
}

/* Constellations that no other holds, and objects that none does. */
static void put_all(amf *a) {
    static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    uint64_t steps = 0;
    a->placed = 0;
    for (size_t i = 0; i < a->constellations.count; ++i) {
        if (!a->constellations.items[i].is_placed) {
            put_constellation(a, &a->constellations.items[i], identity, 0, &steps);
        }
    }
    for (size_t i = 0; i < a->objects.count; ++i) {
        if (a->constellations.count == 0 || !a->objects.items[i].is_placed) {
            put_object(a, &a->objects.items[i], identity);
        }
    }
}

static void find_inner(amf *a) {
    for (size_t i = 0; i < a->instances.count; ++i) {
        for (size_t k = 0; k < a->constellations.count; ++k) {
            a->constellations.items[k].is_placed |=
                a->constellations.items[k].id == a->instances.items[i].id;
        }
    }
}

static int has_colors(const amf *a) {
    int any = 0;
    for (size_t i = 0; i < a->vertices.count; ++i) {
        any |= a->vertices.items[i].color.is_there;
    }
    for (size_t i = 0; i < a->triangles.count; ++i) {
        any |= a->triangles.items[i].color.is_there;
    }
    for (size_t i = 0; i < a->volumes.count; ++i) {
        const amf_volume *volume = &a->volumes.items[i];
        any |= volume->color.is_there | a->objects.items[volume->object].color.is_there |
               color_of_material(a, volume->material)->is_there;
    }
    return any;
}

void assimp_read_amf(const importer_input *input, importer_mesh *mesh) {
    static amf a;
    a.mesh = mesh;
    parse(&a, input);
    find_inner(&a);
    a.is_counting = 1;
    put_all(&a);
    mesh->vertex_count = 3 * a.placed;
    mesh->triangle_count = a.placed;
    mesh->parts = has_colors(&a) ? BURNISH_BMS_COLORS : 0;
    mesh->up[2] = 1;
    importer_allocate(mesh);
    a.is_counting = 0;
    put_all(&a);
}
