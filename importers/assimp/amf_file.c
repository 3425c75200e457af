#include "amf_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/numbers.h"

enum { PIECE = 1 << 20 /* bytes that expat gets at once */ };

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

/* An element and the one that it has a meaning in. NUMBER: its text is numbers[slot]. Slic3r and
 * PrusaSlicer write the scales. */
static const struct {
    const char *name;
    element parent, self;
    int slot;
} rows[] = {{"amf", FILE_ITSELF, AMF, 0},
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
            {"scalex", INSTANCE, NUMBER, 6},
            {"scaley", INSTANCE, NUMBER, 7},
            {"scalez", INSTANCE, NUMBER, 8},
            {"scale", INSTANCE, NUMBER, 9},
            {"mirrorx", INSTANCE, NUMBER, 10},
            {"mirrory", INSTANCE, NUMBER, 11},
            {"mirrorz", INSTANCE, NUMBER, 12}};
/* Appends a cleared item. */
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
    const unsigned long long number = text && *text ? strtoull(text, &end, 10) : AMF_NOTHING;
    return number < AMF_NOTHING ? (uint32_t)number : AMF_NOTHING;
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

/* Enters an element. */
static element enter(amf *a, const char *name) {
    element self = OTHER;
    if (a->depth == AMF_DEPTH_MAX) {
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
    if (self == COLOR) { /* nested in an element with numbers */
        memcpy(a->outer, a->numbers, sizeof a->outer);
        memcpy(a->has_outer, a->has_number, sizeof a->has_outer);
    }
    if (self == COORDINATES || self == TRIANGLE || self == COLOR || self == INSTANCE) {
        memset(a->has_number, 0, sizeof a->has_number);
    }
    return self;
}

static void XMLCALL begin(void *user_data, const char *name, const char **attributes) {
    amf *a = user_data;
    switch (enter(a, name)) {
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

/* Formulas of colours are not evaluated. */
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
        fail(a, "a value is not a number");
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
            fail(a, "a triangle names a missing vertex");
        }
        triangle->corners[i] = (uint32_t)(object->first_vertex + (size_t)a->numbers[i]);
    }
    ++object->triangle_count;
}

/* Rotated about X, then Y, then Z, in degrees, then moved. */
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
    fail(user_data, "a document type (DOCTYPE), which is not supported");
}

/* Text in UTF-16 has already been converted to UTF-8, whatever its first line says. */
static const char *encoding_of(const importer_input *input) {
    for (size_t i = 0; i + 6 <= input->size && i < 100 && input->bytes[i] != '>'; ++i) {
        if (memcmp(input->bytes + i, "UTF-16", 6) == 0 ||
            memcmp(input->bytes + i, "utf-16", 6) == 0) {
            return "UTF-8";
        }
    }
    return NULL;
}

void amf_parse(amf *a, const importer_input *input) {
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
