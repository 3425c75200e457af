/* What slicers add to 3MF: volumes and their roles, plates, and the colours of filaments, in files
 * of their own (Bambu Studio and OrcaSlicer: bbs_3mf.cpp; PrusaSlicer: 3mf.cpp). A file that can't
 * be read is left out with a warning: the model does not depend on it. */
#include "mesh/read/threemf/threemf.h"
#include "mesh/read/threemf/threemf_xml.h"

#if BURNISH_HAS_3MF

#include <stdlib.h>

#include "mesh/read/io/json.h"

enum { FILAMENTS_MOST = 255 };

static const char supports[] = "supports that the slicer will make are not drawn";

/* A whole number of a setting; 0 for anything else. */
static uint32_t number_of(const char *text) {
    int64_t number;
    const burnish_token token = {(const uint8_t *)(text ? text : ""), text ? strlen(text) : 0};
    return burnish_parse_integer(token, &number) == BURNISH_NUMBER_OK && number >= 0 &&
                   number < BURNISH_THREEMF_NONE
               ? (uint32_t)number
               : 0;
}

/* ---- Objects, volumes and plates ---- */

/* The item that was begun last. */
#define LAST_OF(list) ((list)->items[(list)->count - 1])

/* PrusaSlicer's word and Bambu Studio's. Anything else is a solid. */
static burnish_part_role role_of(const char *word) {
    static const char *const words[][2] = {
        [BURNISH_PART_NEGATIVE] = {"NegativeVolume", "negative_part"},
        [BURNISH_PART_MODIFIER] = {"ParameterModifier", "modifier_part"},
        [BURNISH_PART_BLOCKER] = {"SupportBlocker", "support_blocker"},
        [BURNISH_PART_ENFORCER] = {"SupportEnforcer", "support_enforcer"}};
    for (size_t i = 1; i < sizeof words / sizeof *words && word; ++i) {
        if (strcmp(word, words[i][0]) == 0 || strcmp(word, words[i][1]) == 0) {
            return (burnish_part_role)i;
        }
    }
    return word && strcmp(word, "1") == 0 ? BURNISH_PART_MODIFIER : BURNISH_PART_SOLID;
}

static void begin_volume(burnish_threemf *threemf, const char *const *attributes) {
    const uint32_t last = number_of(burnish_threemf_attribute(attributes, "lastid"));
    const char *first = burnish_threemf_attribute(attributes, "firstid");
    burnish_threemf_volume *volume = BURNISH_THREEMF_APPEND(threemf, &threemf->volumes);
    if (volume) {
        volume->id = number_of(burnish_threemf_attribute(attributes, "id"));
        volume->role = role_of(burnish_threemf_attribute(attributes, "subtype"));
        volume->first = number_of(first);
        volume->last = first && last >= volume->first ? last : BURNISH_THREEMF_NONE;
        ++LAST_OF(&threemf->settings).volume_count;
    }
}

static void set_volume(burnish_threemf_volume *volume, const char *key, const char *value) {
    if (strcmp(key, "name") == 0) {
        burnish_part_set_name(volume->name, value, strlen(value));
    } else if (strcmp(key, "extruder") == 0) {
        volume->filament = number_of(value);
    } else if (strcmp(key, "volume_type") == 0 || strcmp(key, "part_type") == 0) {
        volume->role = role_of(value);
        volume->has_type = 1;
    } else if (strcmp(key, "modifier") == 0 && !volume->has_type) { /* before volume_type */
        volume->role = role_of(value);
    }
}

/* A key and its value. */
static void set_value(burnish_threemf_xml *xml, const char *key, const char *value) {
    burnish_threemf *threemf = xml->threemf;
    switch (xml->elements[xml->depth - 1]) {
    case BURNISH_THREEMF_CONFIG_OBJECT:
        if (strcmp(key, "name") == 0) {
            burnish_part_set_name(LAST_OF(&threemf->settings).name, value, strlen(value));
        } else if (strcmp(key, "extruder") == 0) {
            LAST_OF(&threemf->settings).filament = number_of(value);
        }
        break;
    case BURNISH_THREEMF_CONFIG_VOLUME:
        set_volume(&LAST_OF(&threemf->volumes), key, value);
        break;
    case BURNISH_THREEMF_CONFIG_PLATE:
        if (strcmp(key, "plater_name") == 0) {
            burnish_part_set_name(LAST_OF(&threemf->plates).name, value, strlen(value));
        } else if (strcmp(key, "plater_id") == 0) {
            LAST_OF(&threemf->plates).number = (int)(number_of(value) & INT32_MAX);
        }
        break;
    default:
        if (strcmp(key, "object_id") == 0) {
            LAST_OF(&threemf->instances).object = number_of(value);
        } else if (strcmp(key, "instance_id") == 0) {
            LAST_OF(&threemf->instances).number = number_of(value);
        }
        break;
    }
}

static void begin_setting(burnish_threemf_xml *xml, burnish_threemf_element element,
                          const char *const *attributes) {
    burnish_threemf *threemf = xml->threemf;
    const char *key = burnish_threemf_attribute(attributes, "key");
    const char *value = burnish_threemf_attribute(attributes, "value");
    if (element == BURNISH_THREEMF_CONFIG_OBJECT) {
        burnish_threemf_settings *settings = BURNISH_THREEMF_APPEND(threemf, &threemf->settings);
        if (settings) {
            settings->id = number_of(burnish_threemf_attribute(attributes, "id"));
            settings->first_volume = (uint32_t)threemf->volumes.count;
        }
    } else if (element == BURNISH_THREEMF_CONFIG_VOLUME) {
        begin_volume(threemf, attributes);
    } else if (element == BURNISH_THREEMF_CONFIG_PLATE) {
        burnish_plate *plate = BURNISH_THREEMF_APPEND(threemf, &threemf->plates);
        if (plate) {
            plate->number = (int)threemf->plates.count;
        }
        if (threemf->plates.count > BURNISH_THREEMF_PLATES) {
            burnish_threemf_fail(xml, BURNISH_STATUS_FORMAT, "more than %d plates",
                                 BURNISH_THREEMF_PLATES);
        }
    } else if (element == BURNISH_THREEMF_CONFIG_INSTANCE) {
        burnish_threemf_instance *instance = BURNISH_THREEMF_APPEND(threemf, &threemf->instances);
        if (instance) {
            instance->plate = (uint32_t)threemf->plates.count - 1;
        }
    } else if (element == BURNISH_THREEMF_CONFIG_VALUE && key && value) {
        set_value(xml, key, value);
    }
}

/* ---- Filaments ---- */

/* The colour of filament `number` from 0, unless the text is none. */
static void set_filament(burnish_threemf *threemf, size_t number, const char *text) {
    while (number < FILAMENTS_MOST && threemf->filaments.count <= number) {
        burnish_filament *added = BURNISH_THREEMF_APPEND(threemf, &threemf->filaments);
        if (!added) {
            return;
        }
        burnish_part_color(threemf->filaments.count - 1, added->srgb);
        added->srgb[3] = 255;
    }
    if (number < FILAMENTS_MOST && text && *text == '#') {
        uint8_t *srgb = threemf->filaments.items[number].srgb;
        burnish_threemf_read_color(text, srgb);
        srgb[3] = srgb[3] == 0 ? 255 : srgb[3]; /* as make_opaque */
    }
}

uint32_t burnish_threemf_add_filament(burnish_threemf *threemf, uint32_t least, const char *color) {
    uint8_t srgb[4];
    size_t i = 0;
    set_filament(threemf, least < FILAMENTS_MOST ? least - 1 : 0, NULL);
    burnish_threemf_read_color(color, srgb);
    while (i < threemf->filaments.count && memcmp(threemf->filaments.items[i].srgb, srgb, 3) != 0) {
        ++i;
    }
    if (i == threemf->filaments.count) {
        set_filament(threemf, i, color);
    }
    return (uint32_t)i + 1;
}

/* Without colours in the file, filaments that are told apart get some. */
static void invent_filaments(burnish_threemf *threemf) {
    uint32_t most = threemf->paint_most;
    for (size_t i = 0; i < threemf->settings.count; ++i) {
        const uint32_t filament = threemf->settings.items[i].filament;
        most = filament > most ? filament : most;
    }
    for (size_t i = 0; i < threemf->volumes.count; ++i) {
        const burnish_threemf_volume *volume = &threemf->volumes.items[i];
        most =
            volume->role == BURNISH_PART_SOLID && volume->filament > most ? volume->filament : most;
    }
    for (size_t i = 0; i < threemf->heights.count; ++i) {
        most = threemf->heights.items[i].to > most ? threemf->heights.items[i].to : most;
    }
    if (threemf->filaments.count == 0 && (most > 1 || threemf->paint_most > 0)) {
        set_filament(threemf, most < FILAMENTS_MOST ? most - 1 : FILAMENTS_MOST - 1, NULL);
        burnish_reader_warn(threemf->reader, NULL,
                            "the file has no colours for its filaments; any are drawn");
    }
}

/* A corner of the plates' area: "256x256". */
static void extend_bed(burnish_threemf *threemf, size_t number, const char *text) {
    const size_t size = strcspn(text, "x");
    const burnish_token words[2] = {{(const uint8_t *)text, size},
                                    {(const uint8_t *)text + size + 1, strlen(text + size) - 1}};
    (void)number;
    for (int k = 0; k < 2 && text[size]; ++k) {
        float value;
        if (burnish_parse_float(words[k], &value) == BURNISH_NUMBER_OK) {
            threemf->bed[0][k] = value < threemf->bed[0][k] ? value : threemf->bed[0][k];
            threemf->bed[1][k] = value > threemf->bed[1][k] ? value : threemf->bed[1][k];
        }
    }
}

static void set_layer_height(burnish_threemf *threemf, size_t number, const char *text) {
    const burnish_token token = {(const uint8_t *)text, strlen(text)};
    double height;
    if (number == 0 && burnish_parse_double(token, &height) == BURNISH_NUMBER_OK) {
        threemf->layer_height = height;
    }
}

/* Bambu Studio and OrcaSlicer: values of JSON. */
static void read_json_settings(burnish_threemf *threemf, const char *bytes, size_t size) {
    burnish_json json = {0};
    threemf->status = burnish_json_parse(threemf->reader, (const uint8_t *)bytes, size, &json);
    if (threemf->status == BURNISH_STATUS_OK) {
        const uint32_t colors = burnish_json_member(&json, 0, "filament_colour");
        const uint32_t area = burnish_json_member(&json, 0, "printable_area");
        const size_t count = burnish_json_length(&json, colors);
        char text[32];
        for (size_t i = 0, at = colors + 1; i < count && i < FILAMENTS_MOST; ++i) {
            burnish_json_text(&json, (uint32_t)at, text, sizeof text);
            set_filament(threemf, i, text);
            at = json.nodes[at].next;
        }
        for (size_t i = 0, at = area + 1; i < burnish_json_length(&json, area); ++i) {
            burnish_json_text(&json, (uint32_t)at, text, sizeof text);
            extend_bed(threemf, i, text);
            at = json.nodes[at].next;
        }
        burnish_json_text(&json, burnish_json_member(&json, 0, "layer_height"), text, sizeof text);
        set_layer_height(threemf, 0, text);
        burnish_json_text(&json, burnish_json_member(&json, 0, "enable_support"), text,
                          sizeof text);
        if (strcmp(text, "1") == 0) {
            burnish_reader_warn(threemf->reader, NULL, supports);
        }
    }
    burnish_json_destroy(threemf->memory->context, &json);
}

/* PrusaSlicer: a line "; KEY = VALUE;VALUE..." of text; values may be quoted. */
static void read_line(burnish_threemf *threemf, const char *text, const char *key,
                      const char *separators,
                      void (*use)(burnish_threemf *threemf, size_t number, const char *value)) {
    const char *line = strstr(text, key), *at = line ? line + strlen(key) : "";
    for (size_t i = 0; *at && *at != '\r' && *at != '\n' && i < FILAMENTS_MOST; ++i) {
        char value[48] = "";
        const size_t size = strcspn(at, separators);
        const size_t quote = *at == '"';
        if (size < sizeof value + quote) {
            memcpy(value, at + quote, size - quote);
            value[strcspn(value, "\"")] = 0;
        }
        use(threemf, i, value);
        at += size + (at[size] == *separators);
    }
}

static void read_text_settings(burnish_threemf *threemf, const char *text, size_t size) {
    (void)size;
    read_line(threemf, text, "\n; filament_colour = ", ";\r\n", set_filament);
    read_line(threemf, text, "\n; extruder_colour = ", ";\r\n", set_filament); /* goes first */
    read_line(threemf, text, "\n; bed_shape = ", ",\r\n", extend_bed);
    read_line(threemf, text, "\n; layer_height = ", "\r\n", set_layer_height);
    threemf->has_beds = threemf->plates.count == 0;
    if (strstr(text, "\n; support_material = 1")) {
        burnish_reader_warn(threemf->reader, NULL, supports);
    }
}

/* ---- The files ---- */

/* text ends with a 0 at `size` */
typedef void read_settings(burnish_threemf *threemf, const char *text, size_t size);

static void read_file(burnish_threemf *threemf, const char *name, read_settings *read) {
    static const burnish_threemf_handler handler = {begin_setting, NULL, NULL};
    const burnish_zip_part *part = burnish_zip_find(&threemf->zip, name);
    uint8_t *bytes = NULL;
    size_t size;
    if (!part || threemf->status != BURNISH_STATUS_OK) {
        return;
    }
    if (!read) {
        burnish_threemf_parse(threemf, part, name, &handler);
    } else {
        threemf->status = burnish_zip_read(&threemf->zip, part, &bytes, &size);
        if (threemf->status == BURNISH_STATUS_OK && size > 0) {
            read(threemf, (const char *)bytes, size);
        }
        burnish_release(threemf->memory->context, bytes);
    }
    if (threemf->status == BURNISH_STATUS_FORMAT) {
        threemf->status = BURNISH_STATUS_OK;
        burnish_reader_warn(threemf->reader, NULL, "%s can't be read; its settings are not used",
                            name);
    }
}

static int compare_volumes(const void *left, const void *right) {
    const burnish_threemf_volume *a = left, *b = right;
    return a->first != b->first ? (a->first > b->first) - (a->first < b->first)
                                : (a->last > b->last) - (a->last < b->last);
}

/* Gives the objects their settings. */
static void place_settings(burnish_threemf *threemf) {
    for (uint32_t i = 0; i < threemf->settings.count; ++i) {
        burnish_threemf_settings *settings = &threemf->settings.items[i];
        const burnish_threemf_resource *resource =
            burnish_threemf_find(threemf, 0, settings->id, BURNISH_THREEMF_OBJECT);
        if (resource) {
            threemf->objects.items[resource->index].settings = i + 1;
        }
        if (settings->volume_count == 0) {
            continue;
        }
        burnish_threemf_volume *volumes = threemf->volumes.items + settings->first_volume;
        if (volumes->last != BURNISH_THREEMF_NONE) {
            settings->has_ranges = 1;
            qsort(volumes, settings->volume_count, sizeof *volumes, compare_volumes);
        }
    }
}

static int compare_instances(const void *left, const void *right) {
    const burnish_threemf_instance *a = left, *b = right;
    return a->object != b->object ? (a->object > b->object) - (a->object < b->object)
                                  : (a->number > b->number) - (a->number < b->number);
}

uint32_t burnish_threemf_plate_of(const burnish_threemf *threemf, uint32_t object,
                                  uint32_t number) {
    const burnish_threemf_instance key = {object, number, 0};
    const burnish_threemf_instance *found =
        threemf->instances.count > 0
            ? bsearch(&key, threemf->instances.items, threemf->instances.count, sizeof key,
                      compare_instances)
            : NULL;
    return found ? found->plate : BURNISH_THREEMF_NONE;
}

void burnish_threemf_read_project(burnish_threemf *threemf) {
    read_file(threemf, "Metadata/model_settings.config", NULL);
    read_file(threemf, "Metadata/Slic3r_PE_model.config", NULL);
    read_file(threemf, "Metadata/project_settings.config", read_json_settings);
    read_file(threemf, "Metadata/Slic3r_PE.config", read_text_settings);
    read_file(threemf, "Metadata/layer_config_ranges.xml", burnish_threemf_read_heights);
    read_file(threemf, "Metadata/custom_gcode_per_layer.xml", burnish_threemf_read_heights);
    read_file(threemf, "Metadata/Prusa_Slicer_layer_config_ranges.xml",
              burnish_threemf_read_heights);
    read_file(threemf, "Metadata/Prusa_Slicer_custom_gcode_per_print_z.xml",
              burnish_threemf_read_heights);
    if (threemf->instances.count > 0) {
        qsort(threemf->instances.items, threemf->instances.count, sizeof *threemf->instances.items,
              compare_instances);
    }
}

void burnish_threemf_place_project(burnish_threemf *threemf) {
    place_settings(threemf);
    invent_filaments(threemf);
}

#endif
