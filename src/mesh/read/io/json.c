/* The strict reader of JSON: one loop over the text with a stack of open arrays and objects. */
#include "mesh/read/io/json.h"

#include <stdio.h>

enum { VALUE_LIMIT = (1 << 29) - 1 };

typedef struct json_parser {
    burnish_reader *reader;
    burnish_json *json;
    const uint8_t *next, *end;
    uint32_t open[BURNISH_JSON_DEPTH]; /* arrays and objects around */
    int depth;
    burnish_status status;
} json_parser;

/* ---- Text to nodes ---- */

static int json_fail(json_parser *parser, const uint8_t *at, const char *expected) {
    burnish_token rest = {at, 0};
    while (rest.size < 16 && at + rest.size < parser->end && at[rest.size] > ' ') {
        ++rest.size;
    }
    if (at >= parser->end) {
        parser->status = burnish_reader_fail(
            parser->reader, BURNISH_STATUS_FORMAT, at,
            "the JSON ends where %s should follow; the file is truncated", expected);
    } else {
        parser->status = burnish_reader_fail(parser->reader, BURNISH_STATUS_FORMAT, at,
                                             "expected %s, found \"%s\"; this is not JSON",
                                             expected, burnish_token_quote(rest).text);
    }
    return 0;
}

static void skip_blanks(json_parser *parser) {
    const uint8_t *p = parser->next;
    while (p < parser->end && (*p == ' ' || *p == '\n' || *p == '\r' || *p == '\t')) {
        ++p;
    }
    parser->next = p;
}

static int json_add_value(json_parser *parser, burnish_json_kind kind, const uint8_t *first,
                          size_t size) {
    burnish_json *json = parser->json;
    if (json->count == VALUE_LIMIT) {
        parser->status = burnish_reader_fail(parser->reader, BURNISH_STATUS_LIMIT, first,
                                             "more than %d values; split the file", VALUE_LIMIT);
        return 0;
    }
    if (json->count == json->capacity) {
        burnish_memory *memory = &parser->reader->mesh->memory;
        json->nodes = burnish_reserve(memory, json->nodes, &json->capacity, json->count + 1,
                                      sizeof *json->nodes, "JSON");
        parser->status = memory->status;
        if (memory->status != BURNISH_STATUS_OK) {
            return 0;
        }
    }
    json->nodes[json->count] = (burnish_json_node){.first = (uint32_t)(first - json->bytes),
                                                   .size = (uint32_t)size,
                                                   .kind = kind,
                                                   .next = (json->count + 1) & VALUE_LIMIT};
    ++json->count;
    return 1;
}

static int is_hex(uint8_t c) {
    return (c >= '0' && c <= '9') || ((c | 32) >= 'a' && (c | 32) <= 'f');
}

/* The length of an escape after a backslash; 0 if it is not valid. */
static size_t escape_size(const uint8_t *p, const uint8_t *end) {
    if (p < end && memchr("\"\\/bfnrt", *p, 8)) {
        return 1;
    }
    if (end - p < 5 || *p != 'u') {
        return 0;
    }
    return is_hex(p[1]) && is_hex(p[2]) && is_hex(p[3]) && is_hex(p[4]) ? 5 : 0;
}

/* Behind the quote. */
static int read_string(json_parser *parser) {
    const uint8_t *first = ++parser->next, *p = first;
    for (; p < parser->end && *p != '"'; ++p) {
        if (*p < 32) {
            return json_fail(parser, p, "a string without control characters");
        }
        if (*p == '\\') {
            const size_t size = escape_size(p + 1, parser->end);
            if (size == 0) {
                return json_fail(parser, p, "an escape such as \\n or \\u00e9");
            }
            p += size;
        }
    }
    if (p >= parser->end) {
        return json_fail(parser, parser->end, "the end of a string");
    }
    parser->next = p + 1;
    return json_add_value(parser, BURNISH_JSON_STRING, first, (size_t)(p - first));
}

static const uint8_t *skip_digits(const uint8_t *p, const uint8_t *end) {
    while (p < end && *p >= '0' && *p <= '9') {
        ++p;
    }
    return p;
}

/* -0.5e+3: no plus, no leading zeros, digits on both sides of the point. */
static int read_number(json_parser *parser) {
    const uint8_t *first = parser->next, *end = parser->end, *p = first + (*first == '-');
    const uint8_t *digits = p;
    p = skip_digits(p, end);
    int good = p > digits && (*digits != '0' || p == digits + 1);
    if (p < end && *p == '.') {
        digits = ++p;
        p = skip_digits(p, end);
        good &= p > digits;
    }
    if (p < end && (*p | 32) == 'e') {
        ++p;
        p += p < end && (*p == '+' || *p == '-');
        digits = p;
        p = skip_digits(p, end);
        good &= p > digits;
    }
    parser->next = p;
    return good ? json_add_value(parser, BURNISH_JSON_NUMBER, first, (size_t)(p - first))
                : json_fail(parser, first, "a number such as -1.5e3");
}

static int read_word(json_parser *parser) {
    static const struct {
        const char *text;
        burnish_json_kind kind;
    } words[] = {
        {"null", BURNISH_JSON_NULL}, {"false", BURNISH_JSON_FALSE}, {"true", BURNISH_JSON_TRUE}};
    for (int i = 0; i < 3; ++i) {
        const size_t size = strlen(words[i].text);
        if ((size_t)(parser->end - parser->next) >= size &&
            memcmp(parser->next, words[i].text, size) == 0) {
            parser->next += size;
            return json_add_value(parser, words[i].kind, parser->next - size, size);
        }
    }
    return json_fail(parser, parser->next, "a value");
}

/* Reads a value, or the start of an array or object. */
static int read_value(json_parser *parser) {
    const uint8_t c = *parser->next;
    if (c == '"') {
        return read_string(parser);
    }
    if (c == '{' || c == '[') {
        if (parser->depth == BURNISH_JSON_DEPTH) {
            parser->status = burnish_reader_fail(
                parser->reader, BURNISH_STATUS_LIMIT, parser->next,
                "arrays and objects are nested more than %d deep; write it flatter",
                BURNISH_JSON_DEPTH);
            return 0;
        }
        parser->open[parser->depth++] = (uint32_t)parser->json->count;
        ++parser->next;
        return json_add_value(parser, c == '{' ? BURNISH_JSON_OBJECT : BURNISH_JSON_ARRAY,
                              parser->next - 1, 0);
    }
    return c == '-' || (c >= '0' && c <= '9') ? read_number(parser) : read_word(parser);
}

static int read_key(json_parser *parser) {
    if (parser->next >= parser->end || *parser->next != '"') {
        return json_fail(parser, parser->next, "a key in quotes");
    }
    if (!read_string(parser)) {
        return 0;
    }
    skip_blanks(parser);
    if (parser->next >= parser->end || *parser->next != ':') {
        return json_fail(parser, parser->next, "a colon");
    }
    ++parser->next;
    skip_blanks(parser);
    return 1;
}

/* Closes the arrays and objects that end here, and moves to the first byte of the next value.
 * Returns 0 at the end of the document and on errors. */
static int move_on(json_parser *parser) {
    while (parser->depth > 0) {
        burnish_json_node *open = &parser->json->nodes[parser->open[parser->depth - 1]];
        const int is_object = open->kind == BURNISH_JSON_OBJECT;
        skip_blanks(parser);
        if (parser->next < parser->end && *parser->next == (is_object ? '}' : ']')) {
            open->next = parser->json->count & VALUE_LIMIT;
            ++parser->next;
            --parser->depth;
            continue;
        }
        if (open->size > 0) {
            if (parser->next >= parser->end || *parser->next != ',') {
                return json_fail(parser, parser->next, is_object ? "a comma or }" : "a comma or ]");
            }
            ++parser->next;
            skip_blanks(parser);
        }
        ++open->size;
        if (is_object && !read_key(parser)) {
            return 0;
        }
        return parser->next < parser->end || json_fail(parser, parser->next, "a value");
    }
    return 0;
}

burnish_status burnish_json_parse(burnish_reader *reader, const uint8_t *bytes, size_t size,
                                  burnish_json *json) {
    json_parser parser = {.reader = reader, .json = json, .next = bytes, .end = bytes + size};
    *json = (burnish_json){.bytes = bytes};
    if (size >= UINT32_MAX) {
        return burnish_reader_fail(reader, BURNISH_STATUS_LIMIT, bytes,
                                   "more than 4 GiB of JSON; use the binary form");
    }
    if (size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0) { /* a byte order mark */
        parser.next += 3;
    }
    skip_blanks(&parser);
    if (parser.next == parser.end) {
        json_fail(&parser, parser.next, "a value");
        return parser.status;
    }
    while (read_value(&parser) && move_on(&parser)) {
    }
    skip_blanks(&parser);
    for (; parser.next < parser.end && *parser.next == 0; ++parser.next) { /* some pad GLB so */
    }
    if (parser.status == BURNISH_STATUS_OK && parser.next < parser.end) {
        json_fail(&parser, parser.next, "the end of the JSON");
    }
    return parser.status;
}

void burnish_json_destroy(const burnish_context *context, burnish_json *json) {
    burnish_release(context, json->nodes);
    *json = (burnish_json){0};
}

/* ---- Nodes to values ---- */

static unsigned hex_value(uint8_t c) {
    return c <= '9' ? c - '0' + 0u : (c | 32) - 'a' + 10u;
}

static unsigned read_unit(const uint8_t *p) {
    return hex_value(p[0]) << 12 | hex_value(p[1]) << 8 | hex_value(p[2]) << 4 | hex_value(p[3]);
}

/* One character of a string that was checked, as UTF-8: bytes written, and *from moves past it. A
 * half of a surrogate pair becomes U+FFFD. */
static size_t unescape_character(const uint8_t **from, const uint8_t *end, uint8_t out[4]) {
    static const char names[] = "bfnrt", codes[] = "\b\f\n\r\t";
    const uint8_t *p = *from;
    if (*p != '\\') {
        out[0] = *p;
        *from = p + 1;
        return 1;
    }
    if (p[1] != 'u') {
        const char *name = memchr(names, p[1], sizeof names - 1);
        out[0] = name ? (uint8_t)codes[name - names] : p[1];
        *from = p + 2;
        return 1;
    }
    uint32_t code = read_unit(p + 2);
    p += 6;
    if (code >= 0xD800 && code < 0xE000) {
        uint32_t low = 0;
        if (code < 0xDC00 && end - p >= 6 && p[0] == '\\' && p[1] == 'u') {
            low = read_unit(p + 2);
        }
        if (low >= 0xDC00 && low < 0xE000) {
            code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
            p += 6;
        } else {
            code = 0xFFFD;
        }
    }
    *from = p;
    if (code < 0x80) {
        out[0] = (uint8_t)code;
        return 1;
    }
    const size_t size = code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    for (size_t i = size; i-- > 1; code >>= 6) {
        out[i] = (uint8_t)(0x80 | (code & 0x3F));
    }
    out[0] = (uint8_t)((0xF00u >> size) | code);
    return size;
}

int burnish_json_is_text(const burnish_json *json, uint32_t value, const char *text) {
    if (!burnish_json_is_kind(json, value, BURNISH_JSON_STRING)) {
        return 0;
    }
    const uint8_t *p = burnish_json_at(json, value), *end = p + json->nodes[value].size;
    while (p < end) {
        uint8_t out[4];
        const size_t size = unescape_character(&p, end, out);
        if (strncmp(text, (const char *)out, size) != 0 || memchr(out, 0, size)) {
            return 0;
        }
        text += size;
    }
    return *text == 0;
}

size_t burnish_json_text(const burnish_json *json, uint32_t value, char *text, size_t room) {
    size_t used = 0;
    if (burnish_json_is_kind(json, value, BURNISH_JSON_STRING)) {
        const uint8_t *p = burnish_json_at(json, value), *end = p + json->nodes[value].size;
        while (p < end) {
            uint8_t out[4];
            const size_t size = unescape_character(&p, end, out);
            if (used + size >= room) {
                break;
            }
            memcpy(text + used, out, size);
            used += size;
        }
    }
    text[used] = 0;
    return used;
}

uint32_t burnish_json_member(const burnish_json *json, uint32_t object, const char *key) {
    if (!burnish_json_is_kind(json, object, BURNISH_JSON_OBJECT)) {
        return BURNISH_JSON_NONE;
    }
    const uint32_t size = json->nodes[object].size;
    uint32_t name = object + 1;
    for (uint32_t i = size < BURNISH_JSON_MEMBERS ? size : BURNISH_JSON_MEMBERS; i > 0; --i) {
        if (burnish_json_is_text(json, name, key)) {
            return name + 1;
        }
        name = json->nodes[name + 1].next;
    }
    return BURNISH_JSON_NONE;
}

size_t burnish_json_length(const burnish_json *json, uint32_t array) {
    return burnish_json_is_kind(json, array, BURNISH_JSON_ARRAY) ? json->nodes[array].size : 0;
}

int burnish_json_number(const burnish_json *json, uint32_t value, double *number) {
    if (!burnish_json_is_kind(json, value, BURNISH_JSON_NUMBER)) {
        return 0;
    }
    const burnish_token token = {burnish_json_at(json, value), json->nodes[value].size};
    return burnish_parse_double(token, number) == BURNISH_NUMBER_OK;
}

burnish_json_path burnish_json_path_of(const burnish_json *json, uint32_t value) {
    burnish_json_path path = {""};
    size_t used = 0;
    uint32_t at = 0;
    while (value != BURNISH_JSON_NONE && value > at && used + 40 < sizeof path.text) {
        const int is_object = json->nodes[at].kind == BURNISH_JSON_OBJECT;
        uint32_t child = at + 1, index = 0;
        while (json->nodes[child + (is_object ? 1 : 0)].next <= value) {
            child = json->nodes[child + (is_object ? 1 : 0)].next;
            ++index;
        }
        if (is_object) {
            used += used > 0 ? (size_t)snprintf(path.text + used, 2, ".") : 0;
            used += burnish_json_text(json, child, path.text + used, 32);
            if (value == child) {
                break;
            }
            ++child;
        } else {
            used += (size_t)snprintf(path.text + used, 16, "[%u]", index);
        }
        at = child;
    }
    return path;
}
