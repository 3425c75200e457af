/* XML of 3MF by expat: a part is unpacked and parsed piece by piece.
 *
 * expat's memory functions take no context, so its memory comes from malloc. It is limited here by
 * the depth of elements, by the size of one tag, and by the unpacked size of parts. A document type
 * is rejected at its start, so only XML's five entities exist. */
#include "mesh/read/threemf/threemf_xml.h"

#if BURNISH_HAS_3MF

#include <expat.h>
#include <stdarg.h>
#include <stdio.h>

#include "mesh/read/threemf/threemf.h"

enum {
    PIECE = 1 << 16,
    TOKEN_MOST = 1 << 20 /* bytes of a tag, comment ...: expat scans it again for each piece */
};

/* Each element: its name and its parent. Prefixes are ignored, because even files of the format's
 * authors use some without declaring them, or omit them. */
static const struct element_row {
    burnish_threemf_element element, parent;
    const char *name;
} rows[] = {
    {BURNISH_THREEMF_RELATIONSHIPS, BURNISH_THREEMF_FILE, "Relationships"},
    {BURNISH_THREEMF_RELATIONSHIP, BURNISH_THREEMF_RELATIONSHIPS, "Relationship"},
    {BURNISH_THREEMF_MODEL, BURNISH_THREEMF_FILE, "model"},
    {BURNISH_THREEMF_RESOURCES, BURNISH_THREEMF_MODEL, "resources"},
    {BURNISH_THREEMF_BASE_MATERIALS, BURNISH_THREEMF_RESOURCES, "basematerials"},
    {BURNISH_THREEMF_BASE, BURNISH_THREEMF_BASE_MATERIALS, "base"},
    {BURNISH_THREEMF_COLOR_GROUP, BURNISH_THREEMF_RESOURCES, "colorgroup"},
    {BURNISH_THREEMF_COLOR, BURNISH_THREEMF_COLOR_GROUP, "color"},
    {BURNISH_THREEMF_TEXTURE_2D, BURNISH_THREEMF_RESOURCES, "texture2d"},
    {BURNISH_THREEMF_TEXTURE_GROUP, BURNISH_THREEMF_RESOURCES, "texture2dgroup"},
    {BURNISH_THREEMF_COORDINATE, BURNISH_THREEMF_TEXTURE_GROUP, "tex2coord"},
    {BURNISH_THREEMF_COMPOSITE_MATERIALS, BURNISH_THREEMF_RESOURCES, "compositematerials"},
    {BURNISH_THREEMF_COMPOSITE, BURNISH_THREEMF_COMPOSITE_MATERIALS, "composite"},
    {BURNISH_THREEMF_MULTI_PROPERTIES, BURNISH_THREEMF_RESOURCES, "multiproperties"},
    {BURNISH_THREEMF_MULTI, BURNISH_THREEMF_MULTI_PROPERTIES, "multi"},
    {BURNISH_THREEMF_THE_OBJECT, BURNISH_THREEMF_RESOURCES, "object"},
    {BURNISH_THREEMF_MESH, BURNISH_THREEMF_THE_OBJECT, "mesh"},
    {BURNISH_THREEMF_VERTICES, BURNISH_THREEMF_MESH, "vertices"},
    {BURNISH_THREEMF_VERTEX, BURNISH_THREEMF_VERTICES, "vertex"},
    {BURNISH_THREEMF_TRIANGLES, BURNISH_THREEMF_MESH, "triangles"},
    {BURNISH_THREEMF_TRIANGLE, BURNISH_THREEMF_TRIANGLES, "triangle"},
    {BURNISH_THREEMF_LATTICE, BURNISH_THREEMF_MESH, "beamlattice"},
    {BURNISH_THREEMF_BEAMS, BURNISH_THREEMF_LATTICE, "beams"},
    {BURNISH_THREEMF_BEAM, BURNISH_THREEMF_BEAMS, "beam"},
    {BURNISH_THREEMF_BALLS, BURNISH_THREEMF_LATTICE, "balls"},
    {BURNISH_THREEMF_BALL, BURNISH_THREEMF_BALLS, "ball"},
    {BURNISH_THREEMF_COMPONENTS, BURNISH_THREEMF_THE_OBJECT, "components"},
    {BURNISH_THREEMF_COMPONENT, BURNISH_THREEMF_COMPONENTS, "component"},
    {BURNISH_THREEMF_BUILD, BURNISH_THREEMF_MODEL, "build"},
    {BURNISH_THREEMF_ITEM, BURNISH_THREEMF_BUILD, "item"},
    {BURNISH_THREEMF_CONFIG, BURNISH_THREEMF_FILE, "config"},
    {BURNISH_THREEMF_CONFIG_OBJECT, BURNISH_THREEMF_CONFIG, "object"},
    {BURNISH_THREEMF_CONFIG_VOLUME, BURNISH_THREEMF_CONFIG_OBJECT, "part"},
    {BURNISH_THREEMF_CONFIG_VOLUME, BURNISH_THREEMF_CONFIG_OBJECT, "volume"},
    {BURNISH_THREEMF_CONFIG_PLATE, BURNISH_THREEMF_CONFIG, "plate"},
    {BURNISH_THREEMF_CONFIG_INSTANCE, BURNISH_THREEMF_CONFIG_PLATE, "model_instance"},
    {BURNISH_THREEMF_CONFIG_VALUE, BURNISH_THREEMF_CONFIG_OBJECT, "metadata"},
    {BURNISH_THREEMF_CONFIG_VALUE, BURNISH_THREEMF_CONFIG_VOLUME, "metadata"},
    {BURNISH_THREEMF_CONFIG_VALUE, BURNISH_THREEMF_CONFIG_PLATE, "metadata"},
    {BURNISH_THREEMF_CONFIG_VALUE, BURNISH_THREEMF_CONFIG_INSTANCE, "metadata"},
};

/* ---- Names and messages ---- */

/* A name without its prefix. */
static const char *local_name(const char *name) {
    const char *colon = strchr(name, ':');
    return colon ? colon + 1 : name;
}

static burnish_threemf_element element_of(const char *name, burnish_threemf_element parent) {
    const char *local = local_name(name);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        if (rows[i].parent == parent && strcmp(rows[i].name, local) == 0) {
            return rows[i].element;
        }
    }
    return BURNISH_THREEMF_OTHER;
}

const char *burnish_threemf_attribute(const char *const *attributes, const char *name) {
    for (; *attributes; attributes += 2) {
        if (strcmp(*attributes, name) == 0) {
            return attributes[1];
        }
    }
    return NULL;
}

const char *burnish_threemf_prefixed(const char *const *attributes, const char *name) {
    for (; *attributes; attributes += 2) {
        const char *local = local_name(*attributes);
        if (local != *attributes && strcmp(local, name) == 0) {
            return attributes[1];
        }
    }
    return NULL;
}

uint32_t burnish_threemf_line(const burnish_threemf_xml *xml) {
    return (uint32_t)XML_GetCurrentLineNumber(xml->parser);
}

int burnish_threemf_fail(burnish_threemf_xml *xml, burnish_status status, const char *format, ...) {
    burnish_threemf *threemf = xml->threemf;
    if (threemf->status == BURNISH_STATUS_OK) {
        char message[240];
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(message, sizeof message, format, arguments);
        va_end(arguments);
        threemf->status = burnish_reader_fail(threemf->reader, status, NULL, "%.80s:%u: %s",
                                              xml->part, burnish_threemf_line(xml), message);
    }
    XML_StopParser(xml->parser, XML_FALSE);
    return 0;
}

/* ---- Numbers ---- */

/* Text without blanks around it. */
static burnish_token token_of(const char *text) {
    static const char blanks[] = " \t\r\n";
    text += strspn(text, blanks);
    burnish_token token = {(const uint8_t *)text, strlen(text)};
    while (token.size > 0 && strchr(blanks, token.bytes[token.size - 1])) {
        --token.size;
    }
    return token;
}

static void note_odd(burnish_threemf_xml *xml, burnish_token token) {
    burnish_reader_note(xml->threemf->reader, &xml->threemf->reader->odd, NULL,
                        "%.80s:%u: \"%s\" has an unusual form; it was read", xml->part,
                        burnish_threemf_line(xml), burnish_token_quote(token).text);
}

int burnish_threemf_float(burnish_threemf_xml *xml, const char *const *attributes, const char *name,
                          float *value) {
    const char *text = burnish_threemf_attribute(attributes, name);
    const size_t size = text ? strlen(text) : 0;
    double number;
    if (size > 0 && size < sizeof xml->decimal - BURNISH_DECIMAL_ROOM) {
        memcpy(xml->decimal, text, size + 1);
        if (burnish_scan_decimal(xml->decimal, &number) == size &&
            burnish_double_to_float(number, value)) {
            return 1;
        }
    }
    burnish_lexer lexer = burnish_lexer_open((const uint8_t *)(text ? text : ""), size, 0);
    burnish_token token = token_of(text ? text : "");
    burnish_number_status status = BURNISH_NUMBER_GARBAGE;
    const size_t length = token.size;
    burnish_lexer_skip_blank_lines(&lexer);
    if (!burnish_lexer_float(&lexer, &token, value, &status) || token.size < length) {
        status = BURNISH_NUMBER_GARBAGE; /* no word, or several */
    }
    if (status == BURNISH_NUMBER_ODD) {
        note_odd(xml, token);
    } else if (status != BURNISH_NUMBER_OK) {
        *value = __builtin_nanf("");
        burnish_reader_note(xml->threemf->reader, &xml->threemf->reader->damage, NULL,
                            "%.80s:%u: %s", xml->part, burnish_threemf_line(xml),
                            burnish_describe_number(name, token, status).text);
    }
    return 1;
}

uint32_t burnish_threemf_corner(burnish_threemf_xml *xml, const char *text) {
    const burnish_token token = token_of(text ? text : "");
    int64_t number;
    double value;
    if (burnish_parse_integer(token, &number) == BURNISH_NUMBER_OK) {
        return number >= 0 && number < BURNISH_THREEMF_NONE ? (uint32_t)number
                                                            : BURNISH_THREEMF_NONE;
    }
    if (burnish_parse_double(token, &value) != BURNISH_NUMBER_OK || !(value >= 0) ||
        value >= BURNISH_THREEMF_NONE || value > (double)(uint32_t)value) {
        return BURNISH_THREEMF_NONE;
    }
    note_odd(xml, token);
    return (uint32_t)value;
}

int burnish_threemf_whole(burnish_threemf_xml *xml, const char *const *attributes, const char *name,
                          uint32_t fallback, uint32_t *value) {
    const char *text = burnish_threemf_attribute(attributes, name);
    int64_t number;
    if (!text && fallback != BURNISH_THREEMF_NONE) {
        *value = fallback;
        return 1;
    }
    const burnish_token token = token_of(text ? text : "");
    if (burnish_parse_integer(token, &number) != BURNISH_NUMBER_OK || number < 0 ||
        number >= BURNISH_THREEMF_NONE) {
        return burnish_threemf_fail(
            xml, BURNISH_STATUS_FORMAT,
            "%s \"%s\" is not a number from 0 to 4294967294; repair the file", name,
            burnish_token_quote(token).text);
    }
    *value = (uint32_t)number;
    return 1;
}

burnish_threemf_range burnish_threemf_numbers(burnish_threemf_xml *xml, const char *text) {
    burnish_threemf *threemf = xml->threemf;
    burnish_lexer lexer = burnish_lexer_open((const uint8_t *)text, strlen(text), 0);
    burnish_threemf_range range = {(uint32_t)threemf->numbers.count, 0};
    burnish_token token;
    burnish_number_status status;
    double value, *number;
    while (burnish_lexer_word_double(&lexer, &token, &value, &status) &&
           (status == BURNISH_NUMBER_OK || status == BURNISH_NUMBER_ODD) &&
           (number = BURNISH_THREEMF_APPEND(threemf, &threemf->numbers)) != NULL) {
        *number = value;
        ++range.count;
        if (status == BURNISH_NUMBER_ODD) {
            note_odd(xml, token);
        }
    }
    return range;
}

/* ---- Events ---- */

/* A stopped parser might still report the end of an element. */
static int is_fine(const burnish_threemf_xml *xml) {
    return xml->threemf->memory->status == BURNISH_STATUS_OK &&
           xml->threemf->status == BURNISH_STATUS_OK;
}

static void XMLCALL begin_element(void *user_data, const char *name, const char **attributes) {
    burnish_threemf_xml *xml = user_data;
    if (xml->depth == BURNISH_THREEMF_DEPTH) {
        burnish_threemf_fail(xml, BURNISH_STATUS_LIMIT, "elements more than %d deep",
                             BURNISH_THREEMF_DEPTH);
        return;
    }
    const burnish_threemf_element element =
        element_of(name, (burnish_threemf_element)xml->elements[xml->depth]);
    xml->elements[++xml->depth] = (uint8_t)element;
    if (element != BURNISH_THREEMF_OTHER && is_fine(xml)) {
        xml->handler.begin(xml, element, attributes);
        if (!is_fine(xml)) {
            XML_StopParser(xml->parser, XML_FALSE);
        }
    }
}

static void XMLCALL end_element(void *user_data, const char *name) {
    burnish_threemf_xml *xml = user_data;
    const burnish_threemf_element element = (burnish_threemf_element)xml->elements[xml->depth--];
    (void)name;
    if (element != BURNISH_THREEMF_OTHER && xml->handler.end && is_fine(xml)) {
        xml->handler.end(xml, element);
    }
}

static void XMLCALL refuse_document_type(void *user_data, const char *name, const char *system,
                                         const char *public, int has_internal) {
    burnish_threemf_xml *xml = user_data;
    (void)name, (void)system, (void)public, (void)has_internal;
    burnish_threemf_fail(xml, BURNISH_STATUS_FORMAT,
                         "a document type (DOCTYPE), which 3MF forbids; remove it");
}

/* ---- Parts ---- */

static void fail_syntax(burnish_threemf_xml *xml) {
    const enum XML_Error code = XML_GetErrorCode(xml->parser);
    burnish_threemf *threemf = xml->threemf;
    if (threemf->memory->status != BURNISH_STATUS_OK) {
        threemf->status = threemf->memory->status;
    } else if (threemf->status == BURNISH_STATUS_OK && code == XML_ERROR_NO_MEMORY) {
        threemf->status = burnish_fail_memory(threemf->reader->error, xml->part, TOKEN_MOST);
    } else {
        burnish_threemf_fail(xml, BURNISH_STATUS_FORMAT,
                             "the XML is not well formed (%s); repair the file",
                             XML_ErrorString(code));
    }
}

/* One piece of a part; *is_last: it was the last one. Returns 0 on failure. */
static int parse_piece(burnish_threemf_xml *xml, burnish_zip_stream *stream, int *is_last) {
    burnish_threemf *threemf = xml->threemf;
    size_t size;
    void *piece = XML_GetBuffer(xml->parser, PIECE);
    if (!piece) {
        fail_syntax(xml);
        return 0;
    }
    threemf->status = burnish_zip_next(stream, piece, PIECE, &size);
    *is_last = stream->has_ended;
    if (threemf->status != BURNISH_STATUS_OK) {
        return 0;
    }
    const uint8_t *bytes = piece;
    size_t blanks = 0; /* before the declaration; their line ends do not count as lines */
    while (stream->written == size && blanks < size && bytes[blanks] - 1U < ' ') {
        ++blanks;
    }
    memmove(piece, bytes + blanks, size -= blanks);
    if (XML_ParseBuffer(xml->parser, (int)size, *is_last) != XML_STATUS_OK) {
        fail_syntax(xml);
        return 0;
    }
    if (stream->written - (uint64_t)XML_GetCurrentByteIndex(xml->parser) > TOKEN_MOST) {
        return burnish_threemf_fail(xml, BURNISH_STATUS_LIMIT,
                                    "a tag or comment of more than 1 MiB");
    }
    threemf->status = burnish_tasks_check(threemf->reader->mesh->tasks, threemf->reader->error);
    return threemf->status == BURNISH_STATUS_OK;
}

int burnish_threemf_parse(burnish_threemf *threemf, const burnish_zip_part *part, const char *name,
                          const burnish_threemf_handler *handler) {
    burnish_threemf_xml xml = {.threemf = threemf, .handler = *handler, .part = name};
    burnish_zip_stream stream;
    int is_last = 0;
    threemf->status = burnish_zip_begin(&threemf->zip, part, &stream);
    if (threemf->status == BURNISH_STATUS_OK) {
        xml.parser = XML_ParserCreate(NULL);
        if (!xml.parser) {
            threemf->status = burnish_fail_memory(threemf->reader->error, "XML", PIECE);
        }
    }
    if (xml.parser) {
        XML_SetUserData(xml.parser, &xml);
        XML_SetElementHandler(xml.parser, begin_element, end_element);
        XML_SetStartDoctypeDeclHandler(xml.parser, refuse_document_type);
        while (!is_last && parse_piece(&xml, &stream, &is_last)) {
        }
        XML_ParserFree(xml.parser);
    }
    burnish_zip_end(&stream);
    return threemf->status == BURNISH_STATUS_OK;
}

#endif
