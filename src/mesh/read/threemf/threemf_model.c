/* A model part of 3MF: its elements become arrays. References are resolved later, when all parts
 * have been read. */
#include "base/numbers.h"
#include "mesh/read/common/matrix.h"
#include "mesh/read/threemf/threemf.h"
#include "mesh/read/threemf/threemf_xml.h"

#if BURNISH_HAS_3MF

/* The context of an element: numbers of the items begun last. */
typedef struct model_state {
    burnish_threemf *threemf;
    uint32_t part;
    uint32_t object, group;
    uint32_t vertex_count, triangle_count; /* of the object in the file */
} model_state;

static burnish_threemf_object *object_of(const model_state *model) {
    return &model->threemf->objects.items[model->object];
}

static void add_resource(model_state *model, burnish_threemf_xml *xml, int kind, size_t index,
                         const char *const *attributes) {
    uint32_t id;
    if (!burnish_threemf_whole(xml, attributes, "id", BURNISH_THREEMF_NONE, &id)) {
        return;
    }
    burnish_threemf_resource *resource =
        BURNISH_THREEMF_APPEND(model->threemf, &model->threemf->resources);
    if (resource) {
        *resource = (burnish_threemf_resource){model->part, id, kind, (uint32_t)index,
                                               burnish_threemf_line(xml)};
    }
}

/* ---- The model ---- */

/* Whether a namespace belongs to an extension that is drawn, or that does not affect drawing:
 * ".../3dmanufacturing/material/2015/02". */
static int is_known_space(const char *uri) {
    static const char *const known[] = {"/core/",  "/material/",    "/production/",
                                        "/slice/", "/beamlattice/", "/trianglesets/"};
    for (size_t i = 0; i < sizeof known / sizeof *known; ++i) {
        if (strstr(uri, known[i])) {
            return 1;
        }
    }
    return 0;
}

/* A model lists its required extensions by their prefixes. */
static void check_required(burnish_threemf_xml *xml, const char *const *attributes,
                           const char *prefixes) {
    burnish_lexer lexer = burnish_lexer_open((const uint8_t *)prefixes, strlen(prefixes), 0);
    burnish_token word;
    while (burnish_lexer_word(&lexer, &word)) {
        for (const char *const *a = attributes; *a; a += 2) {
            if (strncmp(a[0], "xmlns:", 6) != 0 || !burnish_token_is(word, a[0] + 6)) {
                continue;
            }
            if (!is_known_space(a[1])) {
                burnish_threemf_fail(xml, BURNISH_STATUS_FORMAT,
                                     "the model can't be drawn without the extension %.100s, which "
                                     "is not supported; export it without",
                                     a[1]);
                return;
            }
        }
    }
}

static void begin_model(model_state *model, burnish_threemf_xml *xml,
                        const char *const *attributes) {
    static const char *const units[] = {"micron", "millimeter", "centimeter",
                                        "inch",   "foot",       "meter"};
    const char *unit = burnish_threemf_attribute(attributes, "unit");
    const char *required = burnish_threemf_attribute(attributes, "requiredextensions");
    burnish_mesh_data *mesh = model->threemf->reader->mesh;
    if (!unit) {
        unit = "millimeter";
    }
    const burnish_token word = {(const uint8_t *)unit, strlen(unit)};
    for (size_t i = 0; i < sizeof units / sizeof *units && !mesh->unit; ++i) {
        mesh->unit = burnish_token_is_caseless(word, units[i]) ? units[i] : NULL;
    }
    if (!mesh->unit) {
        burnish_threemf_fail(
            xml, BURNISH_STATUS_FORMAT,
            "unit \"%.40s\" is not one of micron, millimeter, centimeter, inch, foot, meter", unit);
    }
    if (required) {
        check_required(xml, attributes, required);
    }
}

/* ---- Properties ---- */

int burnish_threemf_digit(char c) {
    return c >= '0' && c <= '9' ? c - '0' : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 87 : -1;
}

void burnish_threemf_read_color(const char *text, uint8_t color[4]) {
    uint8_t read[4] = {255, 255, 255, 255};
    size_t digits = 0;
    memset(color, 255, 4);
    if (!text || *text != '#') {
        return;
    }
    for (const char *c = text + 1; *c && *c != ' '; ++c, ++digits) {
        const int digit = burnish_threemf_digit(*c);
        if (digit < 0 || digits == 8) {
            return;
        }
        read[digits / 2] = (uint8_t)(digits % 2 == 0 ? digit << 4 : read[digits / 2] | digit);
    }
    if (digits == 6 || digits == 8) {
        memcpy(color, read, 4);
    }
}

static void begin_group(model_state *model, burnish_threemf_xml *xml, burnish_threemf_kind kind,
                        const char *const *attributes) {
    burnish_threemf *threemf = model->threemf;
    const char *numbers = NULL;
    burnish_threemf_group group = {.kind = kind, .part = model->part};
    add_resource(model, xml, BURNISH_THREEMF_GROUP, threemf->groups.count, attributes);
    if (kind == BURNISH_THREEMF_COORDINATES) {
        burnish_threemf_whole(xml, attributes, "texid", 0, &group.target);
    } else if (kind == BURNISH_THREEMF_COMPOSITES) {
        burnish_threemf_whole(xml, attributes, "matid", 0, &group.target);
        numbers = burnish_threemf_attribute(attributes, "matindices");
    } else if (kind == BURNISH_THREEMF_MULTIPLES) {
        numbers = burnish_threemf_attribute(attributes, "pids");
    }
    const burnish_threemf_range range = burnish_threemf_numbers(xml, numbers ? numbers : "");
    group.first_number = range.first;
    group.number_count = range.count;
    group.first = (uint32_t)(kind == BURNISH_THREEMF_COORDINATES  ? threemf->coordinates.count
                             : kind >= BURNISH_THREEMF_COMPOSITES ? threemf->ranges.count
                                                                  : threemf->colors.count);
    burnish_threemf_group *added = BURNISH_THREEMF_APPEND(threemf, &threemf->groups);
    if (added) {
        *added = group;
        model->group = (uint32_t)threemf->groups.count - 1;
    }
}

static void add_color(model_state *model, const char *text) {
    burnish_threemf *threemf = model->threemf;
    burnish_threemf_color *color = BURNISH_THREEMF_APPEND(threemf, &threemf->colors);
    if (color) {
        burnish_threemf_read_color(text, color->rgba);
        ++threemf->groups.items[model->group].count;
    }
}

static void add_coordinate(model_state *model, burnish_threemf_xml *xml,
                           const char *const *attributes) {
    burnish_threemf *threemf = model->threemf;
    burnish_threemf_coordinate read;
    if (burnish_threemf_float(xml, attributes, "u", &read.uv[0]) &&
        burnish_threemf_float(xml, attributes, "v", &read.uv[1])) {
        burnish_threemf_coordinate *to = BURNISH_THREEMF_APPEND(threemf, &threemf->coordinates);
        if (to) {
            *to = read;
            for (int i = 0; i < 2; ++i) {
                to->uv[i] = burnish_is_finitef(read.uv[i]) ? read.uv[i] : 0;
            }
            ++threemf->groups.items[model->group].count;
        }
    }
}

/* Adds the numbers of a composite or a multi. */
static void add_range(model_state *model, burnish_threemf_xml *xml, const char *text) {
    burnish_threemf *threemf = model->threemf;
    const burnish_threemf_range range = burnish_threemf_numbers(xml, text ? text : "");
    burnish_threemf_range *added = BURNISH_THREEMF_APPEND(threemf, &threemf->ranges);
    if (added) {
        *added = range;
        ++threemf->groups.items[model->group].count;
    }
}

static int wrap_of(const char *style) {
    return !style || strcmp(style, "wrap") == 0 ? BURNISH_WRAP_REPEAT
           : strcmp(style, "mirror") == 0       ? BURNISH_WRAP_MIRROR
                                                : BURNISH_WRAP_CLAMP;
}

static void begin_texture(model_state *model, burnish_threemf_xml *xml,
                          const char *const *attributes) {
    burnish_threemf *threemf = model->threemf;
    const char *path = burnish_threemf_attribute(attributes, "path");
    const char *filter = burnish_threemf_attribute(attributes, "filter");
    add_resource(model, xml, BURNISH_THREEMF_TEXTURE, threemf->textures.count, attributes);
    burnish_threemf_texture *texture = BURNISH_THREEMF_APPEND(threemf, &threemf->textures);
    if (texture) {
        *texture = (burnish_threemf_texture){
            .part = model->part,
            .path = burnish_threemf_copy_name(threemf, path ? path : ""),
            .wrap = {wrap_of(burnish_threemf_attribute(attributes, "tilestyleu")),
                     wrap_of(burnish_threemf_attribute(attributes, "tilestylev"))},
            .is_nearest = filter && strcmp(filter, "nearest") == 0,
            .number = -1};
    }
}

/* ---- Objects ---- */

static void begin_object(model_state *model, burnish_threemf_xml *xml,
                         const char *const *attributes) {
    burnish_threemf *threemf = model->threemf;
    const char *type = burnish_threemf_attribute(attributes, "type");
    burnish_threemf_object object = {.part = model->part,
                                     .line = burnish_threemf_line(xml),
                                     .first_vertex = (uint32_t)threemf->vertices.count,
                                     .first_triangle = (uint32_t)threemf->triangles.count,
                                     .first_component = (uint32_t)threemf->components.count};
    object.is_model = !type || strcmp(type, "model") == 0 || strcmp(type, "surface") == 0;
    const char *name = burnish_threemf_attribute(attributes, "name");
    burnish_part_set_name(object.name, name ? name : "", name ? strlen(name) : 0);
    object.has_slices = burnish_threemf_prefixed(attributes, "slicestackid") != NULL;
    add_resource(model, xml, BURNISH_THREEMF_OBJECT, threemf->objects.count, attributes);
    burnish_threemf_whole(xml, attributes, "pid", 0, &object.group);
    burnish_threemf_whole(xml, attributes, "pindex", 0, &object.property);
    burnish_threemf_object *added = BURNISH_THREEMF_APPEND(threemf, &threemf->objects);
    if (added) {
        *added = object;
        model->object = (uint32_t)threemf->objects.count - 1;
        model->vertex_count = model->triangle_count = 0;
    }
}

static void add_vertex(model_state *model, burnish_threemf_xml *xml,
                       const char *const *attributes) {
    static const char *const names[3] = {"x", "y", "z"};
    burnish_threemf *threemf = model->threemf;
    burnish_threemf_position position;
    for (int i = 0; i < 3; ++i) {
        if (!burnish_threemf_float(xml, attributes, names[i], &position.xyz[i])) {
            return;
        }
    }
    burnish_threemf_position *to = BURNISH_THREEMF_APPEND(threemf, &threemf->vertices);
    if (threemf->vertices.count > BURNISH_VALUE_LIMIT) {
        burnish_threemf_fail(xml, BURNISH_STATUS_LIMIT, "more than %zu vertices",
                             BURNISH_VALUE_LIMIT);
    } else if (to) {
        *to = position;
        model->vertex_count = ++object_of(model)->vertex_count;
    }
}

/* Whether a triangle can be drawn; otherwise it is left out. */
static int has_vertices(const model_state *model, burnish_threemf_xml *xml,
                        const char *const texts[3], const uint32_t corners[3]) {
    burnish_threemf *threemf = model->threemf;
    int good = 1;
    for (int i = 0; i < 3 && good; ++i) {
        if (corners[i] >= model->vertex_count) {
            burnish_reader_note(threemf->reader, &threemf->reader->damage, NULL,
                                "%.80s:%u: v%d \"%.20s\" is out of range; there are %u vertices, "
                                "counted from 0",
                                xml->part, burnish_threemf_line(xml), i + 1,
                                texts[i] ? texts[i] : "", model->vertex_count);
            return 0;
        }
        const float *p = threemf->vertices.items[object_of(model)->first_vertex + corners[i]].xyz;
        good = burnish_is_finitef(p[0]) && burnish_is_finitef(p[1]) && burnish_is_finitef(p[2]);
    }
    return good;
}

/* Missing properties of a triangle come from its object; p2 and p3 default to p1. */
static int read_properties(const burnish_threemf_object *object, burnish_threemf_xml *xml,
                           const char *const *attributes, burnish_threemf_triangle *triangle) {
    uint32_t *p = triangle->properties;
    const int has_own = burnish_threemf_attribute(attributes, "pid") != NULL;
    return burnish_threemf_whole(xml, attributes, "pid", object->group, &triangle->group) &&
           burnish_threemf_whole(xml, attributes, "p1", has_own ? 0 : object->property, &p[0]) &&
           burnish_threemf_whole(xml, attributes, "p2", p[0], &p[1]) &&
           burnish_threemf_whole(xml, attributes, "p3", p[0], &p[2]);
}

static void add_triangle(model_state *model, burnish_threemf_xml *xml,
                         const char *const *attributes) {
    static const char *const names[3] = {"v1", "v2", "v3"};
    const char *texts[3];
    burnish_threemf *threemf = model->threemf;
    burnish_threemf_object *object = object_of(model);
    burnish_threemf_triangle triangle = {.paint = 0};
    for (int i = 0; i < 3; ++i) {
        texts[i] = burnish_threemf_attribute(attributes, names[i]);
        triangle.corners[i] = burnish_threemf_corner(xml, texts[i]);
    }
    if (!read_properties(object, xml, attributes, &triangle)) {
        return;
    }
    const int has_more = attributes[6] != NULL; /* than corners */
    const char *code = has_more ? burnish_threemf_attribute(attributes, "paint_color") : NULL;
    if (has_more && !code) {
        code = burnish_threemf_prefixed(attributes, "mmu_segmentation");
    }
    triangle.source = model->triangle_count++;
    if (!has_vertices(model, xml, texts, triangle.corners)) {
        return;
    }
    if (code && *code && burnish_threemf_is_paint(code)) {
        burnish_threemf_paint(threemf, object, &triangle, code);
        return;
    }
    if (code && *code) {
        burnish_reader_note(threemf->reader, &threemf->bad_paint, NULL,
                            "%.80s:%u: the painting of a triangle ends early or is more than 24 "
                            "splits deep; it is not drawn",
                            xml->part, burnish_threemf_line(xml));
    }
    burnish_threemf_add_triangle(threemf, object, &triangle);
}

/* ---- What stands somewhere ---- */

/* Twelve numbers in the order of columns: x' = x m[0] + y m[3] + z m[6] + m[9]. */
static int read_matrix(burnish_threemf_xml *xml, const char *text, double matrix[12]) {
    burnish_threemf *threemf = xml->threemf;
    static const double identity[12] = BURNISH_MATRIX_IDENTITY;
    memcpy(matrix, identity, sizeof identity);
    if (!text) {
        return 1;
    }
    const burnish_threemf_range range = burnish_threemf_numbers(xml, text);
    threemf->numbers.count = range.first;
    if (range.count != 12) {
        return burnish_threemf_fail(xml, BURNISH_STATUS_FORMAT,
                                    "transform is not 12 finite numbers; repair the file");
    }
    for (int i = 0; i < 12; ++i) {
        matrix[4 * (i % 3) + i / 3] = threemf->numbers.items[range.first + (uint32_t)i];
    }
    return 1;
}

/* The object that a placement names, in another part if it names a part. */
static int read_placement(model_state *model, burnish_threemf_xml *xml,
                          const char *const *attributes, burnish_threemf_placement *placement) {
    const char *path = burnish_threemf_prefixed(attributes, "path");
    const char *printable = burnish_threemf_attribute(attributes, "printable");
    *placement =
        (burnish_threemf_placement){.part = model->part,
                                    .line = burnish_threemf_line(xml),
                                    .plate = BURNISH_THREEMF_NONE,
                                    .is_unprinted = printable && strcmp(printable, "0") == 0};
    if (path) {
        placement->part = burnish_threemf_add_part(model->threemf, path);
        model->threemf->needs_all_parts |= model->part != 0;
    }
    return burnish_threemf_whole(xml, attributes, "objectid", BURNISH_THREEMF_NONE,
                                 &placement->id) &&
           read_matrix(xml, burnish_threemf_attribute(attributes, "transform"), placement->matrix);
}

static void add_component(model_state *model, burnish_threemf_xml *xml,
                          const char *const *attributes) {
    burnish_threemf *threemf = model->threemf;
    burnish_threemf_placement placement;
    if (read_placement(model, xml, attributes, &placement)) {
        burnish_threemf_placement *to = BURNISH_THREEMF_APPEND(threemf, &threemf->components);
        if (to) {
            *to = placement;
            ++object_of(model)->component_count;
        }
    }
}

/* Only the first part's build counts (Production Extension, 3.1). */
static void add_item(model_state *model, burnish_threemf_xml *xml, const char *const *attributes) {
    burnish_threemf *threemf = model->threemf;
    burnish_threemf_placement placement;
    if (model->part == 0 && read_placement(model, xml, attributes, &placement)) {
        burnish_threemf_placement *to = BURNISH_THREEMF_APPEND(threemf, &threemf->items);
        if (to) {
            *to = placement;
        }
    }
}

/* ---- Elements ---- */

typedef void element_handler(model_state *model, burnish_threemf_xml *xml,
                             const char *const *attributes);

/* The handlers of elements, but for those of begin_property. */
static element_handler *const handlers[] = {
    [BURNISH_THREEMF_MODEL] = begin_model,         [BURNISH_THREEMF_TEXTURE_2D] = begin_texture,
    [BURNISH_THREEMF_COORDINATE] = add_coordinate, [BURNISH_THREEMF_THE_OBJECT] = begin_object,
    [BURNISH_THREEMF_VERTEX] = add_vertex,         [BURNISH_THREEMF_TRIANGLE] = add_triangle,
    [BURNISH_THREEMF_COMPONENT] = add_component,   [BURNISH_THREEMF_ITEM] = add_item};

static void begin_property(burnish_threemf_xml *xml, burnish_threemf_element element,
                           const char *const *attributes) {
    model_state *model = xml->handler.user_data;
    switch (element) {
    case BURNISH_THREEMF_BASE_MATERIALS:
        begin_group(model, xml, BURNISH_THREEMF_BASES, attributes);
        break;
    case BURNISH_THREEMF_COLOR_GROUP:
        begin_group(model, xml, BURNISH_THREEMF_COLORS, attributes);
        break;
    case BURNISH_THREEMF_TEXTURE_GROUP:
        begin_group(model, xml, BURNISH_THREEMF_COORDINATES, attributes);
        break;
    case BURNISH_THREEMF_COMPOSITE_MATERIALS:
        begin_group(model, xml, BURNISH_THREEMF_COMPOSITES, attributes);
        break;
    case BURNISH_THREEMF_MULTI_PROPERTIES:
        begin_group(model, xml, BURNISH_THREEMF_MULTIPLES, attributes);
        break;
    case BURNISH_THREEMF_BASE:
        add_color(model, burnish_threemf_attribute(attributes, "displaycolor"));
        break;
    case BURNISH_THREEMF_COLOR:
        add_color(model, burnish_threemf_attribute(attributes, "color"));
        break;
    case BURNISH_THREEMF_COMPOSITE:
        add_range(model, xml, burnish_threemf_attribute(attributes, "values"));
        break;
    case BURNISH_THREEMF_MULTI:
        add_range(model, xml, burnish_threemf_attribute(attributes, "pindices"));
        break;
    case BURNISH_THREEMF_LATTICE:
        burnish_threemf_begin_lattice(xml, object_of(model), attributes);
        break;
    case BURNISH_THREEMF_BEAM:
    case BURNISH_THREEMF_BALL:
        burnish_threemf_add_rod(xml, object_of(model), attributes, element == BURNISH_THREEMF_BALL);
        break;
    default:
        break;
    }
}

static void begin_element(burnish_threemf_xml *xml, burnish_threemf_element element,
                          const char *const *attributes) {
    if (element < sizeof handlers / sizeof *handlers && handlers[element]) {
        handlers[element](xml->handler.user_data, xml, attributes);
    } else {
        begin_property(xml, element, attributes);
    }
}

/* Drops vertices that no triangle uses, because repeated objects are counted by their triangles. */
static void drop_unused(model_state *model) {
    burnish_threemf *threemf = model->threemf;
    burnish_threemf_object *object = object_of(model);
    const size_t count = object->vertex_count;
    if (object->triangle_count == 0) {
        object->vertex_count = 0;
        threemf->vertices.count = object->first_vertex;
        return;
    }
    burnish_threemf_triangle *triangles = threemf->triangles.items + object->first_triangle;
    burnish_threemf_position *vertices = threemf->vertices.items + object->first_vertex;
    uint32_t *numbers =
        burnish_allocate_zeroed(threemf->memory, count, sizeof *numbers, "vertices");
    if (!numbers) {
        return;
    }
    for (size_t i = 0; i < 3 * (size_t)object->triangle_count; ++i) {
        numbers[triangles[i / 3].corners[i % 3]] = 1;
    }
    uint32_t kept = 0;
    for (size_t i = 0; i < count; ++i) {
        if (numbers[i]) {
            vertices[kept] = vertices[i];
            numbers[i] = kept++;
        }
    }
    for (size_t i = 0; kept < count && i < 3 * (size_t)object->triangle_count; ++i) {
        uint32_t *corner = &triangles[i / 3].corners[i % 3];
        *corner = numbers[*corner];
    }
    object->vertex_count = kept;
    threemf->vertices.count = object->first_vertex + (size_t)kept;
    burnish_release(threemf->memory->context, numbers);
}

static void end_element(burnish_threemf_xml *xml, burnish_threemf_element element) {
    model_state *model = xml->handler.user_data;
    if (element == BURNISH_THREEMF_THE_OBJECT && object_of(model)->vertex_count > 0 &&
        burnish_threemf_put_lattice(model->threemf, object_of(model)) &&
        burnish_threemf_join_paint(model->threemf, object_of(model))) {
        drop_unused(model);
    }
}

int burnish_threemf_read_model(burnish_threemf *threemf, uint32_t number) {
    const burnish_threemf_part part = threemf->parts.items[number];
    model_state model = {.threemf = threemf, .part = number};
    const burnish_threemf_handler handler = {begin_element, end_element, &model};
    return burnish_threemf_parse(threemf, part.part, part.name, &handler);
}

#endif
