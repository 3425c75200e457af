/* The header of a PLY file (G. Turk, "The PLY Polygon File Format", 1994). */
#include <string.h>

#include "oracle/ply.h"

typedef struct header_state {
    const oracle_reader_input *input;
    oracle_ply_header *header;
    burnish_error *error;
    oracle_text text;
    int has_format;
} header_state;

static oracle_place here(const header_state *ply) {
    return oracle_place_line(ply->input->name, ply->text.line);
}

static oracle_ply_type type_of(oracle_token token) {
    static const struct {
        const char *name;
        oracle_ply_type type;
    } types[] = {{"char", ORACLE_PLY_INT8},      {"int8", ORACLE_PLY_INT8},
                 {"uchar", ORACLE_PLY_UINT8},    {"uint8", ORACLE_PLY_UINT8},
                 {"short", ORACLE_PLY_INT16},    {"int16", ORACLE_PLY_INT16},
                 {"ushort", ORACLE_PLY_UINT16},  {"uint16", ORACLE_PLY_UINT16},
                 {"int", ORACLE_PLY_INT32},      {"int32", ORACLE_PLY_INT32},
                 {"uint", ORACLE_PLY_UINT32},    {"uint32", ORACLE_PLY_UINT32},
                 {"float", ORACLE_PLY_FLOAT32},  {"float32", ORACLE_PLY_FLOAT32},
                 {"double", ORACLE_PLY_FLOAT64}, {"float64", ORACLE_PLY_FLOAT64}};
    for (size_t i = 0; i < sizeof types / sizeof *types; ++i) {
        if (oracle_token_is(token, types[i].name)) {
            return types[i].type;
        }
    }
    return ORACLE_PLY_NONE;
}

static oracle_ply_role vertex_role(oracle_token name) {
    static const struct {
        const char *name;
        oracle_ply_role role;
    } roles[] = {{"x", ORACLE_PLY_X},
                 {"y", ORACLE_PLY_Y},
                 {"z", ORACLE_PLY_Z},
                 {"nx", ORACLE_PLY_NX},
                 {"ny", ORACLE_PLY_NY},
                 {"nz", ORACLE_PLY_NZ},
                 {"red", ORACLE_PLY_RED},
                 {"green", ORACLE_PLY_GREEN},
                 {"blue", ORACLE_PLY_BLUE},
                 {"alpha", ORACLE_PLY_ALPHA},
                 {"diffuse_red", ORACLE_PLY_RED},
                 {"diffuse_green", ORACLE_PLY_GREEN},
                 {"diffuse_blue", ORACLE_PLY_BLUE},
                 {"diffuse_alpha", ORACLE_PLY_ALPHA}};
    for (size_t i = 0; i < sizeof roles / sizeof *roles; ++i) {
        if (oracle_token_is(name, roles[i].name)) {
            return roles[i].role;
        }
    }
    return ORACLE_PLY_OTHER;
}

static oracle_ply_role role_of(oracle_ply_kind kind, int is_list, oracle_token name) {
    if (kind == ORACLE_PLY_ELEMENT_VERTEX && !is_list) {
        return vertex_role(name);
    }
    if ((kind == ORACLE_PLY_ELEMENT_FACE || kind == ORACLE_PLY_ELEMENT_STRIPS) && is_list &&
        (oracle_token_is(name, "vertex_indices") || oracle_token_is(name, "vertex_index"))) {
        return ORACLE_PLY_CORNERS;
    }
    return ORACLE_PLY_OTHER;
}

static burnish_status read_format(header_state *ply) {
    oracle_token encoding = {0}, version = {0};
    int words = oracle_text_token(&ply->text, &encoding);
    words += oracle_text_token(&ply->text, &version);
    if (words < 2 || !oracle_token_is(version, "1.0")) {
        return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, here(ply),
                              "format version is \"%s\"; only 1.0 exists",
                              oracle_token_quote(version).text);
    }
    if (oracle_token_is(encoding, "ascii")) {
        ply->header->encoding = ORACLE_PLY_ASCII;
    } else if (oracle_token_is(encoding, "binary_little_endian")) {
        ply->header->encoding = ORACLE_PLY_LITTLE_ENDIAN;
    } else if (oracle_token_is(encoding, "binary_big_endian")) {
        ply->header->encoding = ORACLE_PLY_BIG_ENDIAN;
    } else {
        return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, here(ply),
                              "format \"%s\" is unknown; use ascii, binary_little_endian or "
                              "binary_big_endian",
                              oracle_token_quote(encoding).text);
    }
    ply->has_format = 1;
    return BURNISH_STATUS_OK;
}

static burnish_status read_element(header_state *ply) {
    oracle_ply_header *header = ply->header;
    oracle_ply_element element = {.first_property = header->property_count, .line = ply->text.line};
    oracle_token token = {0};
    int64_t count = -1;
    oracle_number_status number = ORACLE_NUMBER_GARBAGE;
    if (oracle_text_token(&ply->text, &element.name) && oracle_text_token(&ply->text, &token)) {
        number = oracle_parse_integer(token.bytes, token.size, &count);
    }
    if (number == ORACLE_NUMBER_RANGE) {
        return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, here(ply),
                              "element count %s is more than any file holds; correct it",
                              oracle_token_quote(token).text);
    }
    if (number != ORACLE_NUMBER_OK || count < 0) {
        return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, here(ply),
                              "element count is \"%s\"; write element NAME COUNT",
                              oracle_token_quote(token).text);
    }
    element.count = (uint64_t)count;
    if (oracle_token_is(element.name, "vertex")) {
        element.kind = ORACLE_PLY_ELEMENT_VERTEX;
    } else if (oracle_token_is(element.name, "face")) {
        element.kind = ORACLE_PLY_ELEMENT_FACE;
    } else if (oracle_token_is(element.name, "tristrips")) {
        element.kind = ORACLE_PLY_ELEMENT_STRIPS;
    }
    burnish_status status = oracle_legacy_reserve(
        (void **)&header->elements, &header->element_capacity, header->element_count + 1,
        sizeof *header->elements, "elements", ply->error);
    if (status == BURNISH_STATUS_OK) {
        header->elements[header->element_count++] = element;
    }
    return status;
}

static burnish_status fail_property(header_state *ply, oracle_token type) {
    return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, here(ply),
                          "property type \"%s\" is unknown; use char, uchar, short, ushort, int, "
                          "uint, float or double",
                          oracle_token_quote(type).text);
}

/* property TYPE NAME, or property list COUNT_TYPE TYPE NAME. */
static burnish_status read_property(header_state *ply) {
    oracle_ply_header *header = ply->header;
    oracle_ply_property property = {ORACLE_PLY_NONE, ORACLE_PLY_NONE, ORACLE_PLY_OTHER};
    oracle_token type = {0}, name = {0};
    if (header->element_count == 0) {
        return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, here(ply),
                              "property before the first element; declare its element first");
    }
    oracle_ply_element *element = &header->elements[header->element_count - 1];
    oracle_text_token(&ply->text, &type);
    int is_list = oracle_token_is(type, "list");
    if (is_list) {
        oracle_token count_type = {0};
        oracle_text_token(&ply->text, &count_type);
        property.count_type = type_of(count_type);
        if (property.count_type == ORACLE_PLY_NONE || property.count_type >= ORACLE_PLY_FLOAT32) {
            return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, here(ply),
                                  "list count type \"%s\" is no integer type; use uchar or int",
                                  oracle_token_quote(count_type).text);
        }
        type = (oracle_token){0};
        oracle_text_token(&ply->text, &type);
    }
    property.type = type_of(type);
    if (property.type == ORACLE_PLY_NONE) {
        return fail_property(ply, type);
    }
    if (!oracle_text_token(&ply->text, &name)) {
        return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, here(ply),
                              "property has no name; write property TYPE NAME");
    }
    property.role = role_of(element->kind, is_list, name);
    burnish_status status = oracle_legacy_reserve(
        (void **)&header->properties, &header->property_capacity, header->property_count + 1,
        sizeof *header->properties, "properties", ply->error);
    if (status == BURNISH_STATUS_OK) {
        header->properties[header->property_count++] = property;
        ++element->property_count;
    }
    return status;
}

/* Behind end_header stands one line end, of the kind that ends the first line: after "\r" alone the
 * next byte, even a "\n", is the body's. Returns 0 when there is none. */
static int find_body(header_state *ply) {
    const uint8_t *p = ply->text.next, *end = ply->text.end, *first = ply->input->bytes;
    while (p < end && *p != '\n' && *p != '\r') {
        ++p;
    }
    if (p == end) {
        return 0;
    }
    while (*first != '\n' && *first != '\r') {
        ++first;
    }
    int pairs = *first == '\r' && first[1] == '\n'; /* more header follows it */
    size_t size = pairs && *p == '\r' && end - p > 1 && p[1] == '\n' ? 2 : 1;
    ply->header->body_offset = (size_t)(p - ply->input->bytes) + size;
    ply->header->body_line = ply->text.line + 1;
    return 1;
}

/* Returns 1 in *done after end_header. */
static burnish_status read_line(header_state *ply, int *done) {
    oracle_token keyword;
    if (!oracle_text_token(&ply->text, &keyword) || oracle_token_is(keyword, "comment") ||
        oracle_token_is(keyword, "obj_info")) {
        return BURNISH_STATUS_OK;
    }
    if (oracle_token_is(keyword, "format")) {
        return read_format(ply);
    }
    if (oracle_token_is(keyword, "element")) {
        return read_element(ply);
    }
    if (oracle_token_is(keyword, "property")) {
        return read_property(ply);
    }
    if (oracle_token_is(keyword, "end_header")) {
        *done = find_body(ply);
        return BURNISH_STATUS_OK;
    }
    return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, here(ply),
                          "\"%s\" stands in the header where element, property or end_header "
                          "should; repair the header",
                          oracle_token_quote(keyword).text);
}

/* Which roles an element's properties fill, one bit each. */
static unsigned roles_of(const oracle_ply_header *header, const oracle_ply_element *element) {
    unsigned roles = 0;
    for (size_t i = 0; i < element->property_count; ++i) {
        roles |= 1u << header->properties[element->first_property + i].role;
    }
    return roles;
}

static burnish_status check_elements(header_state *ply) {
    const unsigned xyz = 1u << ORACLE_PLY_X | 1u << ORACLE_PLY_Y | 1u << ORACLE_PLY_Z;
    oracle_ply_header *header = ply->header;
    int vertex_elements = 0;
    for (size_t i = 0; i < header->element_count; ++i) {
        const oracle_ply_element *element = &header->elements[i];
        oracle_place place = oracle_place_line(ply->input->name, element->line);
        unsigned roles = roles_of(header, element);
        if (element->kind == ORACLE_PLY_ELEMENT_VERTEX && ++vertex_elements > 1) {
            return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, place,
                                  "a second vertex element; merge the two");
        }
        if (element->kind == ORACLE_PLY_ELEMENT_VERTEX && (roles & xyz) != xyz) {
            return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, place,
                                  "element vertex has no scalar properties x, y and z; add them");
        }
        if ((element->kind == ORACLE_PLY_ELEMENT_FACE ||
             element->kind == ORACLE_PLY_ELEMENT_STRIPS) &&
            element->count > 0 && !(roles & 1u << ORACLE_PLY_CORNERS)) {
            return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, place,
                                  "element %s has no list property vertex_indices; add it",
                                  oracle_token_quote(element->name).text);
        }
    }
    if (vertex_elements == 0) {
        return oracle_fail_at(ply->error, BURNISH_STATUS_FORMAT, here(ply),
                              "the header declares no element vertex; export the mesh again");
    }
    return BURNISH_STATUS_OK;
}

burnish_status oracle_ply_read_header(const oracle_reader_input *input, oracle_ply_header *header,
                                      burnish_error *error) {
    header_state ply = {.input = input,
                        .header = header,
                        .error = error,
                        .text = {input->bytes, input->bytes + input->size, 1, 0}};
    oracle_token magic;
    int done = 0;
    *header = (oracle_ply_header){0};
    if (!oracle_text_token(&ply.text, &magic) || !oracle_token_is(magic, "ply")) {
        return oracle_fail_at(error, BURNISH_STATUS_FORMAT, oracle_place_line(input->name, 1),
                              "a PLY file starts with the line \"ply\", this one does not; check "
                              "the format");
    }
    while (!done) {
        if (!oracle_text_next_line(&ply.text)) {
            return oracle_fail_at(error, BURNISH_STATUS_FORMAT, here(&ply),
                                  "the file ends within the header; it is truncated, fetch it "
                                  "again");
        }
        burnish_status status = read_line(&ply, &done);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    if (!ply.has_format) {
        return oracle_fail_at(error, BURNISH_STATUS_FORMAT, here(&ply),
                              "the header has no format line; add \"format ascii 1.0\" or what "
                              "the file is");
    }
    return check_elements(&ply);
}

void oracle_ply_destroy_header(oracle_ply_header *header) {
    free(header->properties);
    free(header->elements);
    *header = (oracle_ply_header){0};
}
