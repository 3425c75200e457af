/* A part's XML, by expat. */
#ifndef BURNISH_MESH_READ_THREEMF_THREEMF_XML_H
#define BURNISH_MESH_READ_THREEMF_THREEMF_XML_H

#include "mesh/read/threemf/threemf.h"

/* Known elements. Each has one parent: see threemf_xml.c. */
typedef enum burnish_threemf_element {
    BURNISH_THREEMF_FILE, /* the parent of the outermost element */
    BURNISH_THREEMF_OTHER,
    BURNISH_THREEMF_RELATIONSHIPS,
    BURNISH_THREEMF_RELATIONSHIP,
    BURNISH_THREEMF_MODEL,
    BURNISH_THREEMF_RESOURCES,
    BURNISH_THREEMF_BASE_MATERIALS,
    BURNISH_THREEMF_BASE,
    BURNISH_THREEMF_COLOR_GROUP,
    BURNISH_THREEMF_COLOR,
    BURNISH_THREEMF_TEXTURE_2D,
    BURNISH_THREEMF_TEXTURE_GROUP,
    BURNISH_THREEMF_COORDINATE,
    BURNISH_THREEMF_COMPOSITE_MATERIALS,
    BURNISH_THREEMF_COMPOSITE,
    BURNISH_THREEMF_MULTI_PROPERTIES,
    BURNISH_THREEMF_MULTI,
    BURNISH_THREEMF_THE_OBJECT,
    BURNISH_THREEMF_MESH,
    BURNISH_THREEMF_VERTICES,
    BURNISH_THREEMF_VERTEX,
    BURNISH_THREEMF_TRIANGLES,
    BURNISH_THREEMF_TRIANGLE,
    BURNISH_THREEMF_LATTICE,
    BURNISH_THREEMF_BEAMS,
    BURNISH_THREEMF_BEAM,
    BURNISH_THREEMF_BALLS,
    BURNISH_THREEMF_BALL,
    BURNISH_THREEMF_COMPONENTS,
    BURNISH_THREEMF_COMPONENT,
    BURNISH_THREEMF_BUILD,
    BURNISH_THREEMF_ITEM,
    BURNISH_THREEMF_CONFIG, /* and below: of threemf_project.c */
    BURNISH_THREEMF_CONFIG_OBJECT,
    BURNISH_THREEMF_CONFIG_VOLUME,
    BURNISH_THREEMF_CONFIG_PLATE,
    BURNISH_THREEMF_CONFIG_INSTANCE,
    BURNISH_THREEMF_CONFIG_VALUE
} burnish_threemf_element;

typedef struct burnish_threemf_xml burnish_threemf_xml;

/* Called for each element that is known in its parent. Attributes are as in expat: names and values
 * alternate, ended by NULL. `end` follows when the element is complete. */
typedef struct burnish_threemf_handler {
    void (*begin)(burnish_threemf_xml *xml, burnish_threemf_element element,
                  const char *const *attributes);
    void (*end)(burnish_threemf_xml *xml, burnish_threemf_element element);
    void *user_data;
} burnish_threemf_handler;

enum { BURNISH_THREEMF_DEPTH = 64 /* of elements in elements */ };

struct burnish_threemf_xml {
    burnish_threemf *threemf;
    burnish_threemf_handler handler;
    const char *part; /* for messages */
    void *parser;     /* expat's */
    uint8_t elements[BURNISH_THREEMF_DEPTH + 1];
    size_t depth;
    uint8_t decimal[192]; /* a number, padded for the lexer */
};

/* Parses a part. Returns 0 on failure. */
int burnish_threemf_parse(burnish_threemf *threemf, const burnish_zip_part *part, const char *name,
                          const burnish_threemf_handler *handler);

/* Sets threemf->status with "NAME: PART:LINE: ...", unless something failed before. Returns 0. */
__attribute__((format(printf, 3, 4))) int
burnish_threemf_fail(burnish_threemf_xml *xml, burnish_status status, const char *format, ...);

/* The line of the current element. */
uint32_t burnish_threemf_line(const burnish_threemf_xml *xml);

/* The value of an attribute without a prefix; NULL if absent. */
const char *burnish_threemf_attribute(const char *const *attributes, const char *name);

/* The same for an attribute with any prefix. */
const char *burnish_threemf_prefixed(const char *const *attributes, const char *name);

/* A coordinate, which is required; NaN for one that is not a finite number, which is noted as damage.
 * Returns 1. */
int burnish_threemf_float(burnish_threemf_xml *xml, const char *const *attributes, const char *name,
                          float *value);

/* A corner's vertex, also as "2.0"; NONE if it is not a whole number below that. */
uint32_t burnish_threemf_corner(burnish_threemf_xml *xml, const char *text);

/* A whole number below NONE. If it is missing, `fallback` is used, or the function fails if that is
 * NONE. Returns 0 on failure. */
int burnish_threemf_whole(burnish_threemf_xml *xml, const char *const *attributes, const char *name,
                          uint32_t fallback, uint32_t *value);

/* Appends numbers, separated by blanks, to threemf->numbers, up to the first that is invalid.
 * Returns their range. */
burnish_threemf_range burnish_threemf_numbers(burnish_threemf_xml *xml, const char *text);

#endif
