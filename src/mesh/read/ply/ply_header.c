/* The header of a PLY file (G. Turk, "The PLY Polygon File Format", 1994). */
#include "mesh/read/ply/ply_header.h"

#include <stdio.h>
#include <string.h>

#include "mesh/read/io/streaming.h"

typedef struct header_state {
    burnish_reader *reader;
    burnish_ply_header *header;
    burnish_lexer lexer;
    int has_format;
    burnish_warning_group unknown; /* lines */
} header_state;

/* A malformed line. */
#define FAIL(ply, ...)                                                                             \
    burnish_reader_fail((ply)->reader, BURNISH_STATUS_FORMAT, (ply)->lexer.next, __VA_ARGS__)

static burnish_ply_type type_of(burnish_token token) {
    static const struct {
        const char *name;
        burnish_ply_type type;
    } types[] = {{"char", BURNISH_PLY_INT8},      {"int8", BURNISH_PLY_INT8},
                 {"uchar", BURNISH_PLY_UINT8},    {"uint8", BURNISH_PLY_UINT8},
                 {"bool", BURNISH_PLY_UINT8}, /* of PyntCloud */
                 {"short", BURNISH_PLY_INT16},    {"int16", BURNISH_PLY_INT16},
                 {"ushort", BURNISH_PLY_UINT16},  {"uint16", BURNISH_PLY_UINT16},
                 {"int", BURNISH_PLY_INT32},      {"int32", BURNISH_PLY_INT32},
                 {"uint", BURNISH_PLY_UINT32},    {"uint32", BURNISH_PLY_UINT32},
                 {"int64", BURNISH_PLY_INT64},    {"uint64", BURNISH_PLY_UINT64},
                 {"float", BURNISH_PLY_FLOAT32},  {"float32", BURNISH_PLY_FLOAT32},
                 {"double", BURNISH_PLY_FLOAT64}, {"float64", BURNISH_PLY_FLOAT64}};
    for (size_t i = 0; i < sizeof types / sizeof *types; ++i) {
        if (burnish_token_is_caseless(token, types[i].name)) {
            return types[i].type;
        }
    }
    return BURNISH_PLY_NONE;
}

burnish_ply_role burnish_ply_role_of(burnish_token name) {
    static const char *const names[][3] = {[BURNISH_PLY_X] = {"x"},
                                           [BURNISH_PLY_Y] = {"y"},
                                           [BURNISH_PLY_Z] = {"z"},
                                           [BURNISH_PLY_NX] = {"nx"},
                                           [BURNISH_PLY_NY] = {"ny"},
                                           [BURNISH_PLY_NZ] = {"nz"},
                                           [BURNISH_PLY_RED] = {"red", "r", "diffuse_red"},
                                           [BURNISH_PLY_GREEN] = {"green", "g", "diffuse_green"},
                                           [BURNISH_PLY_BLUE] = {"blue", "b", "diffuse_blue"},
                                           [BURNISH_PLY_ALPHA] = {"alpha", "a", "diffuse_alpha"},
                                           [BURNISH_PLY_S] = {"s", "u", "texture_u"},
                                           [BURNISH_PLY_T] = {"t", "v", "texture_v"},
                                           [BURNISH_PLY_SCALE] = {"scale_0"},
                                           {"scale_1"},
                                           {"scale_2"},
                                           [BURNISH_PLY_ROTATION] = {"rot_0"},
                                           {"rot_1"},
                                           {"rot_2"},
                                           {"rot_3"},
                                           [BURNISH_PLY_HARMONIC] = {"f_dc_0"},
                                           {"f_dc_1"},
                                           {"f_dc_2"},
                                           [BURNISH_PLY_OPACITY] = {"opacity"}};
    for (size_t role = 0; role < sizeof names / sizeof *names; ++role) {
        for (int i = 0; i < 3 && names[role][i]; ++i) {
            if (*names[role][i] == (*name.bytes | 0x20) && /* most differ in the first letter */
                burnish_token_is_caseless(name, names[role][i])) {
                return (burnish_ply_role)role;
            }
        }
    }
    return BURNISH_PLY_OTHER;
}

static burnish_ply_role role_of(burnish_ply_kind kind, int is_list, burnish_token name) {
    if (kind == BURNISH_PLY_ELEMENT_VERTEX && !is_list) {
        return burnish_ply_role_of(name);
    }
    if (kind == BURNISH_PLY_ELEMENT_FACE && !is_list) {
        const burnish_ply_role role = burnish_ply_role_of(name);
        return role >= BURNISH_PLY_RED && role <= BURNISH_PLY_ALPHA ? role
               : burnish_token_is_caseless(name, "texnumber")       ? BURNISH_PLY_TEXNUMBER
                                                                    : BURNISH_PLY_OTHER;
    }
    if (kind == BURNISH_PLY_ELEMENT_FACE && burnish_token_is_caseless(name, "texcoord")) {
        return BURNISH_PLY_TEXCOORDS;
    }
    if ((kind == BURNISH_PLY_ELEMENT_FACE || kind == BURNISH_PLY_ELEMENT_STRIPS) && is_list &&
        (burnish_token_is_caseless(name, "vertex_indices") ||
         burnish_token_is_caseless(name, "vertex_index"))) {
        return BURNISH_PLY_CORNERS;
    }
    return BURNISH_PLY_OTHER;
}

static burnish_status read_format(header_state *ply) {
    burnish_token encoding = {0}, version = {0};
    int words = burnish_lexer_token(&ply->lexer, &encoding);
    words += burnish_lexer_token(&ply->lexer, &version);
    if (words < 2 || !burnish_token_is_caseless(version, "1.0")) {
        return FAIL(ply, "format version is \"%s\"; only 1.0 exists",
                    burnish_token_quote(version).text);
    }
    if (burnish_token_is_caseless(encoding, "ascii")) {
        ply->header->encoding = BURNISH_PLY_ASCII;
    } else if (burnish_token_is_caseless(encoding, "binary_little_endian")) {
        ply->header->encoding = BURNISH_PLY_LITTLE_ENDIAN;
    } else if (burnish_token_is_caseless(encoding, "binary_big_endian")) {
        ply->header->encoding = BURNISH_PLY_BIG_ENDIAN;
    } else {
        return FAIL(
            ply, "format \"%s\" is unknown; use ascii, binary_little_endian or binary_big_endian",
            burnish_token_quote(encoding).text);
    }
    ply->has_format = 1;
    return BURNISH_STATUS_OK;
}

burnish_status burnish_ply_add_element(burnish_reader *reader, burnish_ply_header *header,
                                       burnish_ply_element element) {
    burnish_memory *memory = &reader->mesh->memory;
    element.first_property = header->property_count;
    header->elements = burnish_reserve(memory, header->elements, &header->element_capacity,
                                       header->element_count + 1, sizeof element, "elements");
    if (memory->status == BURNISH_STATUS_OK) {
        header->elements[header->element_count++] = element;
    }
    return memory->status;
}

/* CloudCompare's scalar_Intensity is also Intensity. */
static int is_scalar(burnish_token name, const char *scalar) {
    enum { PREFIX = 7 };
    const burnish_token rest = {name.bytes + PREFIX, name.size - PREFIX};
    return burnish_token_is(name, scalar) ||
           (name.size > PREFIX && memcmp(name.bytes, "scalar_", PREFIX) == 0 &&
            burnish_token_is(rest, scalar));
}

burnish_status burnish_ply_add_property(burnish_reader *reader, burnish_ply_header *header,
                                        burnish_ply_property property) {
    burnish_ply_element *element = &header->elements[header->element_count - 1];
    const char *scalar = reader->input->options->scalar_property;
    if (scalar && element->kind == BURNISH_PLY_ELEMENT_VERTEX &&
        property.count_type == BURNISH_PLY_NONE &&
        ((property.role >= BURNISH_PLY_S && property.role != BURNISH_PLY_PACKED) ||
         is_scalar(property.name, scalar))) {
        property.role = is_scalar(property.name, scalar) ? BURNISH_PLY_S : BURNISH_PLY_OTHER;
    }
    burnish_memory *memory = &reader->mesh->memory;
    header->properties = burnish_reserve(memory, header->properties, &header->property_capacity,
                                         header->property_count + 1, sizeof property, "properties");
    if (memory->status == BURNISH_STATUS_OK) {
        header->properties[header->property_count++] = property;
        ++element->property_count;
    }
    return memory->status;
}

static burnish_status read_element(header_state *ply) {
    burnish_ply_header *header = ply->header;
    burnish_ply_element element = {.at = ply->lexer.next};
    burnish_token token = {0};
    int64_t count = -1;
    burnish_number_status number = BURNISH_NUMBER_GARBAGE;
    if (burnish_lexer_token(&ply->lexer, &element.name) &&
        burnish_lexer_token(&ply->lexer, &token)) {
        number = burnish_parse_integer(token, &count);
    }
    if (number == BURNISH_NUMBER_RANGE) {
        return FAIL(ply, "element count %s is more than any file holds; correct it",
                    burnish_token_quote(token).text);
    }
    if (number != BURNISH_NUMBER_OK || count < 0) {
        return FAIL(ply, "element count is \"%s\"; write element NAME COUNT",
                    burnish_token_quote(token).text);
    }
    element.count = (uint64_t)count;
    if (burnish_token_is_caseless(element.name, "vertex")) {
        element.kind = BURNISH_PLY_ELEMENT_VERTEX;
    } else if (burnish_token_is_caseless(element.name, "face")) {
        element.kind = BURNISH_PLY_ELEMENT_FACE;
    } else if (burnish_token_is_caseless(element.name, "tristrips")) {
        element.kind = BURNISH_PLY_ELEMENT_STRIPS;
    }
    return burnish_ply_add_element(ply->reader, header, element);
}

/* Something unusual, which is accepted. */
static void note_odd(header_state *ply, burnish_token word) {
    burnish_reader_note(ply->reader, &ply->reader->odd, word.bytes,
                        "\"%s\" has an unusual form; it was read", burnish_token_quote(word).text);
}

static void note_capitals(header_state *ply, burnish_token word) {
    if (word.bytes[0] >= 'A' && word.bytes[0] <= 'Z') {
        note_odd(ply, word);
    }
}

static burnish_status fail_property(header_state *ply, burnish_token type) {
    return FAIL(ply,
                "property type \"%s\" is unknown; use char, uchar, short, ushort, int, uint, float "
                "or double",
                burnish_token_quote(type).text);
}

/* property TYPE NAME, or property list COUNT_TYPE TYPE NAME. */
static burnish_status read_property(header_state *ply) {
    burnish_ply_header *header = ply->header;
    burnish_ply_property property = {.role = BURNISH_PLY_OTHER};
    burnish_token type = {0}, name = {0};
    if (header->element_count == 0) {
        return FAIL(ply, "property before the first element; declare its element first");
    }
    burnish_ply_element *element = &header->elements[header->element_count - 1];
    burnish_lexer_token(&ply->lexer, &type);
    int is_list = burnish_token_is_caseless(type, "list");
    if (is_list) {
        burnish_token count_type = {0};
        burnish_lexer_token(&ply->lexer, &count_type);
        property.count_type = type_of(count_type);
        if (property.count_type == BURNISH_PLY_NONE || property.count_type >= BURNISH_PLY_FLOAT32) {
            return FAIL(ply, "list count type \"%s\" is not an integer type; use uchar or int",
                        burnish_token_quote(count_type).text);
        }
        type = (burnish_token){0};
        burnish_lexer_token(&ply->lexer, &type);
    }
    property.type = type_of(type);
    if (property.type == BURNISH_PLY_NONE) {
        return fail_property(ply, type);
    }
    if (!burnish_lexer_token(&ply->lexer, &name)) {
        return FAIL(ply, "property has no name; write property TYPE NAME");
    }
    property.name = name;
    property.role = role_of(element->kind, is_list, name);
    if (property.role != BURNISH_PLY_OTHER) {
        note_capitals(ply, name);
    }
    if (property.type == BURNISH_PLY_INT64 || property.type == BURNISH_PLY_UINT64) {
        note_odd(ply, type);
    }
    if (element->kind == BURNISH_PLY_ELEMENT_FACE && element->count > 0) {
        header->has_face_coordinates |= property.role == BURNISH_PLY_TEXCOORDS;
    }
    return burnish_ply_add_property(ply->reader, header, property);
}

/* comment TextureFile NAME */
static burnish_status add_texture(header_state *ply) {
    burnish_ply_header *header = ply->header;
    burnish_memory *memory = &ply->reader->mesh->memory;
    const burnish_token name = burnish_lexer_rest(&ply->lexer);
    if (name.size == 0 || header->texture_count == BURNISH_PLY_TEXTURES_MAX) {
        return BURNISH_STATUS_OK;
    }
    header->textures = burnish_reserve(memory, header->textures, &header->texture_capacity,
                                       header->texture_count + 1, sizeof name, "textures");
    if (memory->status == BURNISH_STATUS_OK) {
        header->textures[header->texture_count++] = name;
    }
    return memory->status;
}

/* One line end follows end_header. If "\r" alone ends the first line, the next byte belongs to the
 * body, even if it is "\n". Returns 0 when there is none. */
static int find_body(header_state *ply) {
    const uint8_t *p = ply->lexer.next, *end = ply->lexer.end, *first = ply->reader->input->bytes;
    while (p < end && *p != '\n' && *p != '\r') {
        ++p;
    }
    if (p == end) {
        return 0;
    }
    while (*first != '\n' && *first != '\r') {
        ++first;
    }
    const int pairs = *first == '\n' || first[1] == '\n'; /* more header follows it */
    const int is_pair = pairs && *p == '\r' && end - p > 1 && p[1] == '\n';
    if (is_pair && *first == '\n') {
        burnish_reader_warn(ply->reader, p, "\"end_header\" ends with CR LF, other lines with LF");
    }
    ply->header->body = p + (is_pair ? 2 : 1);
    return 1;
}

/* Returns 1 in *done after end_header. */
static burnish_status read_line(header_state *ply, int *done) {
    burnish_token keyword;
    if (!burnish_lexer_token(&ply->lexer, &keyword) ||
        burnish_token_is_caseless(keyword, "obj_info")) {
        return BURNISH_STATUS_OK;
    }
    if (burnish_token_is_caseless(keyword, "comment")) {
        if (burnish_lexer_token(&ply->lexer, &keyword) &&
            burnish_token_is_caseless(keyword, "texturefile")) {
            return add_texture(ply);
        }
        return BURNISH_STATUS_OK;
    }
    if (burnish_token_is_caseless(keyword, "format")) {
        note_capitals(ply, keyword);
        return read_format(ply);
    }
    if (burnish_token_is_caseless(keyword, "element")) {
        return read_element(ply);
    }
    if (burnish_token_is_caseless(keyword, "property")) {
        return read_property(ply);
    }
    if (burnish_token_is_caseless(keyword, "end_header")) {
        *done = find_body(ply);
        return BURNISH_STATUS_OK;
    }
    burnish_reader_note(ply->reader, &ply->unknown, keyword.bytes,
                        "\"%s\" does not start a line of a PLY header; ignored",
                        burnish_token_quote(keyword).text);
    return BURNISH_STATUS_OK;
}

/* Which roles an element's properties fill, one bit each. */
static unsigned roles_of(const burnish_ply_header *header, const burnish_ply_element *element) {
    unsigned roles = 0;
    for (size_t i = 0; i < element->property_count; ++i) {
        roles |= 1u << header->properties[element->first_property + i].role;
    }
    return roles;
}

/* The vertices lack the scalar property that is requested. */
static burnish_status fail_scalar(burnish_reader *reader, const burnish_ply_header *header,
                                  const burnish_ply_element *element) {
    char names[200] = "";
    size_t length = 0;
    for (size_t i = 0; i < element->property_count && length + 40 < sizeof names; ++i) {
        const burnish_ply_property *property = &header->properties[element->first_property + i];
        if (property->name.size > 0) {
            length += (size_t)snprintf(names + length, sizeof names - length, "%s%.30s",
                                       i > 0 ? ", " : "", burnish_token_quote(property->name).text);
        }
    }
    return burnish_reader_fail(
        reader, BURNISH_STATUS_FORMAT, element->at,
        "no other vertex property \"%.60s\" to colour by; the vertices have %s",
        reader->input->options->scalar_property, names);
}

burnish_status burnish_ply_check_header(burnish_reader *reader, burnish_ply_header *header) {
    const unsigned rgb = 1u << BURNISH_PLY_RED | 1u << BURNISH_PLY_GREEN | 1u << BURNISH_PLY_BLUE;
    const unsigned xyz = 1u << BURNISH_PLY_X | 1u << BURNISH_PLY_Y | 1u << BURNISH_PLY_Z;
    int vertex_elements = 0;
    for (size_t i = 0; i < header->element_count; ++i) {
        const burnish_ply_element *element = &header->elements[i];
        unsigned roles = roles_of(header, element);
        header->has_vertex_colors |=
            element->kind == BURNISH_PLY_ELEMENT_VERTEX && (roles & rgb) == rgb;
        header->has_face_colors |=
            element->kind == BURNISH_PLY_ELEMENT_FACE && element->count > 0 && (roles & rgb) == rgb;
        if (element->kind == BURNISH_PLY_ELEMENT_VERTEX && ++vertex_elements > 1) {
            return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, element->at,
                                       "a second vertex element; merge the two");
        }
        if (element->kind == BURNISH_PLY_ELEMENT_VERTEX && (roles & xyz) == xyz &&
            reader->input->options->scalar_property && !(roles & 1u << BURNISH_PLY_S)) {
            return fail_scalar(reader, header, element);
        }
        if (element->kind == BURNISH_PLY_ELEMENT_VERTEX && (roles & xyz) != xyz) {
            return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, element->at,
                                       "element %s has no scalar properties x, y and z; add them",
                                       burnish_token_quote(element->name).text);
        }
        if ((element->kind == BURNISH_PLY_ELEMENT_FACE ||
             element->kind == BURNISH_PLY_ELEMENT_STRIPS) &&
            element->count > 0 && !(roles & 1u << BURNISH_PLY_CORNERS)) {
            return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, element->at,
                                       "element %s has no list property vertex_indices; add it",
                                       burnish_token_quote(element->name).text);
        }
    }
    if (vertex_elements == 0) {
        return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, header->body,
                                   "the header declares no element vertex; export the mesh again");
    }
    return BURNISH_STATUS_OK;
}

/* Skips blank lines and comments before "ply". */
static void skip_before(burnish_lexer *lexer) {
    burnish_lexer line = *lexer;
    burnish_token word;
    while (!burnish_lexer_token(&line, &word) || *word.bytes == '#' ||
           burnish_token_is_caseless(word, "comment")) {
        if (!burnish_lexer_next_line(&line)) {
            return;
        }
        *lexer = line;
    }
}

burnish_status burnish_ply_read_header(burnish_reader *reader, burnish_ply_header *header) {
    const burnish_reader_input *input = reader->input;
    header_state ply = {.reader = reader,
                        .header = header,
                        .lexer = burnish_lexer_open(input->bytes, burnish_reader_head(reader), 0)};
    burnish_token magic = {0};
    int done = 0;
    *header = (burnish_ply_header){0};
    skip_before(&ply.lexer);
    if (!burnish_lexer_token(&ply.lexer, &magic) || !burnish_token_is_caseless(magic, "ply")) {
        return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, input->bytes,
                                   "expected the line \"ply\", found \"%s\"; check the format",
                                   burnish_token_quote(magic).text);
    }
    note_capitals(&ply, magic);
    if (magic.bytes > input->bytes) {
        burnish_reader_note(reader, &reader->odd, NULL, "%s",
                            *input->bytes == 0xEF
                                ? "the file begins with a byte order mark"
                                : "blanks or comments before \"ply\" were ignored");
    }
    while (!done) {
        if (!burnish_lexer_next_line(&ply.lexer)) {
            return FAIL(&ply, "the file ends within the header; the file is truncated");
        }
        burnish_status status = read_line(&ply, &done);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    burnish_reader_warn_group(reader, &ply.unknown);
    if (!ply.has_format) {
        return FAIL(&ply,
                    "the header has no format line; add \"format ascii 1.0\" or what the file is");
    }
    return BURNISH_STATUS_OK;
}

void burnish_ply_destroy_header(const burnish_context *context, burnish_ply_header *header) {
    burnish_release(context, header->textures);
    burnish_release(context, header->properties);
    burnish_release(context, header->elements);
    *header = (burnish_ply_header){0};
}
