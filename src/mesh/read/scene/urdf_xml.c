/* The XML of URDF, by expat, whose memory is bounded by the input: a document type, and with it
 * entities, is refused. */
#include "mesh/read/scene/urdf.h"

#if BURNISH_HAS_3MF

#include <expat.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/elementary.h"
#include "mesh/read/io/lexer.h"

enum { DEPTH = 64, NUMBER_MOST = 1000000, SIZE_MOST = 1 << 28 };

typedef enum urdf_element {
    FILE_LEVEL,
    OTHER,
    ROBOT,
    MATERIAL, /* of the robot */
    MATERIAL_COLOR,
    LINK,
    VISUAL,
    VISUAL_ORIGIN,
    GEOMETRY,
    MESH,
    BOX,
    CYLINDER,
    SPHERE,
    VISUAL_MATERIAL,
    VISUAL_COLOR,
    JOINT,
    JOINT_ORIGIN,
    JOINT_PARENT,
    JOINT_CHILD,
    JOINT_AXIS,
    JOINT_LIMIT,
    JOINT_MIMIC
} urdf_element;

static const struct element_row {
    urdf_element element, parent;
    const char *name;
} rows[] = {
    {ROBOT, FILE_LEVEL, "robot"},
    {MATERIAL, ROBOT, "material"},
    {MATERIAL_COLOR, MATERIAL, "color"},
    {LINK, ROBOT, "link"},
    {VISUAL, LINK, "visual"},
    {VISUAL, LINK, "collision"},
    {VISUAL_ORIGIN, VISUAL, "origin"},
    {GEOMETRY, VISUAL, "geometry"},
    {MESH, GEOMETRY, "mesh"},
    {BOX, GEOMETRY, "box"},
    {CYLINDER, GEOMETRY, "cylinder"},
    {SPHERE, GEOMETRY, "sphere"},
    {CYLINDER, GEOMETRY, "capsule"},
    {VISUAL_MATERIAL, VISUAL, "material"},
    {VISUAL_COLOR, VISUAL_MATERIAL, "color"},
    {JOINT, ROBOT, "joint"},
    {JOINT_ORIGIN, JOINT, "origin"},
    {JOINT_PARENT, JOINT, "parent"},
    {JOINT_CHILD, JOINT, "child"},
    {JOINT_AXIS, JOINT, "axis"},
    {JOINT_LIMIT, JOINT, "limit"},
    {JOINT_MIMIC, JOINT, "mimic"},
};

typedef struct urdf_xml {
    burnish_urdf *urdf;
    XML_Parser parser;
    uint8_t elements[DEPTH + 1];
    size_t depth;
    uint32_t skipped; /* lines before the first element */
} urdf_xml;

static uint32_t xml_line(const urdf_xml *xml) {
    return xml->skipped + (uint32_t)XML_GetCurrentLineNumber(xml->parser);
}

__attribute__((format(printf, 3, 4))) static void xml_fail(urdf_xml *xml, burnish_status status,
                                                           const char *format, ...) {
    char text[240];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    burnish_urdf_fail(xml->urdf, status, xml_line(xml), "%s", text);
    XML_StopParser(xml->parser, XML_FALSE);
}

/* ---- Values ---- */

static const char *find_attribute(const char *const *attributes, const char *name) {
    for (; *attributes; attributes += 2) {
        if (strcmp(*attributes, name) == 0) {
            return attributes[1];
        }
    }
    return NULL;
}

static void take_text(urdf_xml *xml, const char *const *attributes, const char *name, char *to,
                      size_t room) {
    const char *text = find_attribute(attributes, name);
    if (text && strlen(text) >= room) {
        xml_fail(xml, BURNISH_STATUS_LIMIT, "%s of more than %zu bytes; shorten it", name,
                 room - 1);
    } else if (text) {
        strcpy(to, text);
    }
}

/* The first `count` numbers, unchanged if they are missing. */
static void take_numbers(urdf_xml *xml, const char *const *attributes, const char *name,
                         size_t count, double *to) {
    const char *text = find_attribute(attributes, name);
    if (!text) {
        return;
    }
    burnish_lexer lexer = burnish_lexer_open((const uint8_t *)text, strlen(text), 0);
    burnish_token token;
    burnish_number_status status;
    size_t got = 0;
    double value;
    while (got < count && burnish_lexer_word_double(&lexer, &token, &value, &status) &&
           status == BURNISH_NUMBER_OK && value >= -NUMBER_MOST && value <= NUMBER_MOST) {
        to[got++] = value;
    }
    if (got != count) {
        xml_fail(xml, BURNISH_STATUS_FORMAT, "%s \"%.40s\" is not %zu number%s within 1e6", name,
                 text, count, count > 1 ? "s" : "");
    }
}

static void take_origin(urdf_xml *xml, const char *const *attributes, double transform[12]) {
    double move[3] = {0, 0, 0}, turn[3] = {0, 0, 0}, sines[3], cosines[3];
    take_numbers(xml, attributes, "xyz", 3, move);
    take_numbers(xml, attributes, "rpy", 3, turn);
    for (int i = 0; i < 3; ++i) {
        burnish_sincos(turn[i], &sines[i], &cosines[i]);
    }
    burnish_scene_place(sines, cosines, move, transform);
}

static void take_color(urdf_xml *xml, const char *const *attributes,
                       burnish_urdf_material *material) {
    double rgba[4] = {1, 1, 1, 1};
    take_numbers(xml, attributes, "rgba", 4, rgba);
    for (int i = 0; i < 4; ++i) {
        const double value = rgba[i] > 1 ? 1 : rgba[i] > 0 ? rgba[i] : 0;
        material->srgb[i] = (uint8_t)(value * 255 + 0.5);
    }
    material->has_color = 1;
}

/* ---- Elements ---- */

/* Room for one more of `most`; NULL on failure. */
static void *add_row(urdf_xml *xml, void **rows_at, size_t *count, size_t *capacity, size_t size,
                     size_t most) {
    burnish_memory *memory = &xml->urdf->scene.reader->mesh->memory;
    if (*count == most) {
        xml_fail(xml, BURNISH_STATUS_LIMIT, "more than %zu elements of one kind", most);
        return NULL;
    }
    *rows_at = burnish_reserve(memory, *rows_at, capacity, *count + 1, size, "a robot");
    if (memory->status != BURNISH_STATUS_OK) {
        return NULL;
    }
    return memset((char *)*rows_at + (*count)++ * size, 0, size);
}

#define ADD_ROW(xml, list, most)                                                                   \
    add_row(xml, (void **)&(xml)->urdf->list##s, &(xml)->urdf->list##_count,                       \
            &(xml)->urdf->list##_capacity, sizeof *(xml)->urdf->list##s, most)

static const double identity[12] = BURNISH_MATRIX_IDENTITY;

static void begin_visual(urdf_xml *xml, int is_collision) {
    burnish_urdf_visual *visual = ADD_ROW(xml, visual, BURNISH_SCENE_ITEMS);
    if (visual) {
        visual->link = (int)xml->urdf->link_count - 1;
        visual->line = xml_line(xml);
        visual->is_collision = is_collision;
        memcpy(visual->origin, identity, sizeof identity);
    }
}

static void begin_joint(urdf_xml *xml, const char *const *attributes) {
    static const char *const turning[] = {"revolute", "continuous"};
    const char *type = find_attribute(attributes, "type");
    burnish_urdf_joint *joint = ADD_ROW(xml, joint, BURNISH_URDF_MOST);
    if (!joint) {
        return;
    }
    *joint = (burnish_urdf_joint){.line = xml_line(xml), .multiplier = 1, .axis = {1, 0, 0}};
    memcpy(joint->origin, identity, sizeof identity);
    take_text(xml, attributes, "name", joint->name, sizeof joint->name);
    if (type && strcmp(type, "prismatic") == 0) {
        joint->kind = BURNISH_URDF_SLIDES;
    } else if (type && (strcmp(type, turning[0]) == 0 || strcmp(type, turning[1]) == 0)) {
        joint->kind = BURNISH_URDF_TURNS;
        joint->is_endless = strcmp(type, turning[1]) == 0;
    }
}

static void take_shape(urdf_xml *xml, urdf_element element, const char *const *attributes,
                       burnish_urdf_visual *visual) {
    double *size = visual->size;
    size[0] = size[1] = size[2] = 1;
    if (element == MESH) {
        const char *scale = find_attribute(attributes, "scale");
        visual->shape = BURNISH_URDF_MESH;
        take_text(xml, attributes, "filename", visual->file, sizeof visual->file);
        if (scale && !strpbrk(scale + strspn(scale, " \t\r\n"), " \t\r\n")) {
            take_numbers(xml, attributes, "scale", 1, size);
            size[1] = size[2] = size[0];
        } else {
            take_numbers(xml, attributes, "scale", 3, size);
        }
    } else if (element == BOX) {
        visual->shape = BURNISH_URDF_BOX;
        take_numbers(xml, attributes, "size", 3, size);
    } else {
        visual->shape = element == SPHERE ? BURNISH_URDF_SPHERE : BURNISH_URDF_CYLINDER;
        take_numbers(xml, attributes, "radius", 1, &size[0]);
        take_numbers(xml, attributes, "length", 1, &size[1]);
    }
}

static void take_of_visual(urdf_xml *xml, urdf_element element, const char *const *attributes) {
    burnish_urdf_visual *visual = &xml->urdf->visuals[xml->urdf->visual_count - 1];
    if (element == VISUAL_ORIGIN) {
        take_origin(xml, attributes, visual->origin);
    } else if (element == VISUAL_MATERIAL) {
        take_text(xml, attributes, "name", visual->material.name, sizeof visual->material.name);
    } else if (element == VISUAL_COLOR) { /* later links may refer to it */
        take_color(xml, attributes, &visual->material);
        burnish_urdf_material *named =
            *visual->material.name ? ADD_ROW(xml, material, BURNISH_SCENE_ITEMS) : NULL;
        if (named) {
            *named = visual->material;
        }
    } else if (element != GEOMETRY) {
        take_shape(xml, element, attributes, visual);
    }
}

static void take_of_joint(urdf_xml *xml, urdf_element element, const char *const *attributes) {
    burnish_urdf_joint *joint = &xml->urdf->joints[xml->urdf->joint_count - 1];
    if (element == JOINT_ORIGIN) {
        take_origin(xml, attributes, joint->origin);
    } else if (element == JOINT_PARENT) {
        take_text(xml, attributes, "link", joint->parent, sizeof joint->parent);
    } else if (element == JOINT_CHILD) {
        take_text(xml, attributes, "link", joint->child, sizeof joint->child);
    } else if (element == JOINT_AXIS) {
        take_numbers(xml, attributes, "xyz", 3, joint->axis);
    } else if (element == JOINT_LIMIT) {
        if (!joint->is_endless) {
            take_numbers(xml, attributes, "lower", 1, &joint->low);
            take_numbers(xml, attributes, "upper", 1, &joint->high);
        }
    } else {
        take_text(xml, attributes, "joint", joint->mimic, sizeof joint->mimic);
        take_numbers(xml, attributes, "multiplier", 1, &joint->multiplier);
        take_numbers(xml, attributes, "offset", 1, &joint->offset);
    }
}

/* Macros: text in braces after a dollar, or elements of xacro. */
static int is_xacro(const char *name, const char *const *attributes) {
    int any = strncmp(name, "xacro:", 6) == 0;
    for (; *attributes && !any; attributes += 2) {
        any = strstr(attributes[1], "${") || strstr(attributes[1], "$(");
    }
    return any;
}

static void take_element(urdf_xml *xml, urdf_element element, const char *name,
                         const char *const *attributes) {
    burnish_urdf *urdf = xml->urdf;
    if (element == LINK) {
        burnish_urdf_link *link = ADD_ROW(xml, link, BURNISH_URDF_MOST);
        if (link) {
            link->parent = BURNISH_URDF_NONE;
            take_text(xml, attributes, "name", link->name, sizeof link->name);
        }
    } else if (element == MATERIAL) {
        burnish_urdf_material *material = ADD_ROW(xml, material, BURNISH_URDF_MOST);
        if (material) {
            take_text(xml, attributes, "name", material->name, sizeof material->name);
        }
    } else if (element == MATERIAL_COLOR) {
        take_color(xml, attributes, &urdf->materials[urdf->material_count - 1]);
    } else if (element == VISUAL) {
        begin_visual(xml, strcmp(name, "collision") == 0);
    } else if (element == JOINT) {
        begin_joint(xml, attributes);
    } else if (element > VISUAL && element < JOINT) {
        take_of_visual(xml, element, attributes);
    } else if (element > JOINT) {
        take_of_joint(xml, element, attributes);
    }
}

static void XMLCALL begin_element(void *user_data, const char *name, const char **attributes) {
    urdf_xml *xml = user_data;
    urdf_element element = OTHER;
    if (xml->urdf->status != BURNISH_STATUS_OK) {
        return;
    }
    if (xml->depth == DEPTH) {
        xml_fail(xml, BURNISH_STATUS_LIMIT, "elements more than %d deep", DEPTH);
        return;
    }
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        if (rows[i].parent == xml->elements[xml->depth] && strcmp(rows[i].name, name) == 0) {
            element = rows[i].element;
        }
    }
    xml->elements[++xml->depth] = (uint8_t)element;
    if (is_xacro(name, attributes)) {
        xml_fail(
            xml, BURNISH_STATUS_FORMAT,
            "a macro of xacro, which burnish does not expand; run \"xacro FILE > robot.urdf\"");
        return;
    }
    take_element(xml, element, name, attributes);
    if (xml->urdf->scene.reader->mesh->memory.status != BURNISH_STATUS_OK) {
        xml->urdf->status = xml->urdf->scene.reader->mesh->memory.status;
        XML_StopParser(xml->parser, XML_FALSE);
    }
}

static void XMLCALL end_element(void *user_data, const char *name) {
    urdf_xml *xml = user_data;
    (void)name;
    xml->depth -= xml->depth > 0;
}

static void XMLCALL refuse_document_type(void *user_data, const char *name, const char *system,
                                         const char *public, int has_internal) {
    (void)name, (void)system, (void)public, (void)has_internal;
    xml_fail(user_data, BURNISH_STATUS_FORMAT, "a document type (DOCTYPE); remove it");
}

int burnish_urdf_parse(burnish_urdf *urdf) {
    const burnish_reader_input *input = urdf->scene.reader->input;
    urdf_xml xml = {.urdf = urdf, .parser = XML_ParserCreate(NULL)};
    if (!xml.parser) {
        urdf->status = burnish_fail_memory(urdf->scene.reader->error, "XML", sizeof xml);
        return 0;
    }
    XML_SetUserData(xml.parser, &xml);
    XML_SetElementHandler(xml.parser, begin_element, end_element);
    XML_SetStartDoctypeDeclHandler(xml.parser, refuse_document_type);
    size_t blank = 0; /* which XML does not allow before its declaration */
    while (blank < input->size && input->bytes[blank] <= ' ') {
        xml.skipped += input->bytes[blank++] == '\n';
    }
    if (input->size > SIZE_MOST) {
        burnish_urdf_fail(urdf, BURNISH_STATUS_LIMIT, 0, "a robot of more than 256 MiB");
    } else if (XML_Parse(xml.parser, (const char *)input->bytes + blank, (int)(input->size - blank),
                         1) != XML_STATUS_OK) {
        xml_fail(&xml, BURNISH_STATUS_FORMAT, "the XML is not well formed (%s); repair the file",
                 XML_ErrorString(XML_GetErrorCode(xml.parser)));
    }
    XML_ParserFree(xml.parser);
    return urdf->status == BURNISH_STATUS_OK;
}

#else

int burnish_urdf_parse(burnish_urdf *urdf) {
    return burnish_urdf_fail(
        urdf, BURNISH_STATUS_FORMAT, 0,
        "a robot in URDF; this build of burnish lacks expat and can't read it");
}

#endif
