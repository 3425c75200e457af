/* 3MF: the parts of the archive, and the order in which they are read. */

#include "mesh/read/threemf/threemf.h"

#include <stdio.h>
#include <stdlib.h>

#include "mesh/read/threemf/threemf_xml.h"

/* Any ZIP archive, by its first bytes. */
static int threemf_recognise(const uint8_t *bytes, size_t size) {
    return size >= 4 && memcmp(bytes, "PK\3\4", 4) == 0;
}

#if BURNISH_HAS_3MF

/* ---- Names ---- */

char *burnish_threemf_copy_name(burnish_threemf *threemf, const char *name) {
    char *copy = burnish_allocate(threemf->memory, strlen(name) + 1, 1, "a name"), *to = copy;
    while (copy && *name) {
        const size_t size = strcspn(name, "/\\\\");
        if (size == 2 && memcmp(name, "..", 2) == 0) {
            while (to > copy && *--to != '/') { /* back over the folder before it */
            }
        } else if (size > 0 && !(size == 1 && *name == '.')) {
            *to = '/';
            to += to > copy;
            memcpy(to, name, size);
            to += size;
        }
        name += size + (name[size] != 0);
    }
    if (copy) {
        *to = 0;
    }
    return copy;
}

static uint32_t list_part(burnish_threemf *threemf, burnish_zip_part *part) {
    if (part->user_data == 0) {
        burnish_threemf_part *added = BURNISH_THREEMF_APPEND(threemf, &threemf->parts);
        if (!added) {
            return BURNISH_THREEMF_NONE;
        }
        const size_t shown =
            part->name_size < sizeof added->name ? part->name_size : sizeof added->name - 1;
        memcpy(added->name, part->name + part->name_size - shown, shown);
        added->part = part;
        part->user_data = (uint32_t)threemf->parts.count;
    }
    return part->user_data - 1;
}

uint32_t burnish_threemf_add_part(burnish_threemf *threemf, const char *name) {
    char *copy = burnish_threemf_copy_name(threemf, name);
    burnish_zip_part *part = copy ? burnish_zip_find(&threemf->zip, copy) : NULL;
    if (copy && !part) {
        burnish_reader_note(threemf->reader, &threemf->missing, NULL,
                            "the part \"%.80s\" is not in the archive; its objects are missing",
                            copy);
    }
    burnish_release(threemf->memory->context, copy);
    return part ? list_part(threemf, part) : BURNISH_THREEMF_NONE;
}

burnish_threemf_place burnish_threemf_show(const burnish_threemf *threemf, uint32_t part,
                                           uint32_t line) {
    burnish_threemf_place place;
    snprintf(place.text, sizeof place.text, "%s:%u", threemf->parts.items[part].name, line);
    return place;
}

/* ---- The first part ---- */

/* Follows the package's relationship with its 3D model. */
static void begin_relationship(burnish_threemf_xml *xml, burnish_threemf_element element,
                               const char *const *attributes) {
    static const char wanted[] = "/3dmodel", picture[] = "/metadata/thumbnail";
    const char *type = burnish_threemf_attribute(attributes, "Type");
    const char *target = burnish_threemf_attribute(attributes, "Target");
    const size_t size = type ? strlen(type) : 0;
    if (element == BURNISH_THREEMF_RELATIONSHIP && target && size >= sizeof wanted - 1 &&
        strcmp(type + size - (sizeof wanted - 1), wanted) == 0 && xml->threemf->parts.count == 0) {
        burnish_threemf_add_part(xml->threemf, target);
    } else if (element == BURNISH_THREEMF_RELATIONSHIP && target && size >= sizeof picture - 1 &&
               strcmp(type + size - (sizeof picture - 1), picture) == 0) {
        char *name = burnish_threemf_copy_name(xml->threemf, target);
        xml->threemf->thumbnail = name ? burnish_zip_find(&xml->threemf->zip, name) : NULL;
        burnish_release(xml->threemf->memory->context, name);
    }
}

/* The start part is named by the relationship, or else by the name that all programs use. */
static void find_start(burnish_threemf *threemf) {
    static const char usual[] = "3D/3dmodel.model";
    const burnish_threemf_handler handler = {begin_relationship, NULL, NULL};
    const burnish_zip_part *relationships = burnish_zip_find(&threemf->zip, "_rels/.rels");
    burnish_zip_part *start = burnish_zip_find(&threemf->zip, usual);
    if (relationships && !burnish_threemf_parse(threemf, relationships, "_rels/.rels", &handler)) {
        return;
    }
    if (threemf->parts.count == 0 && start) {
        list_part(threemf, start);
    }
    if (threemf->parts.count == 0 && threemf->memory->status == BURNISH_STATUS_OK) {
        threemf->status = burnish_reader_fail(
            threemf->reader, BURNISH_STATUS_FORMAT, NULL,
            "a ZIP archive of other parts, such as a document, without a 3D model");
    }
}

/* ---- Resources ---- */

static int compare_resources(const void *left, const void *right) {
    const burnish_threemf_resource *a = left, *b = right;
    return a->part != b->part   ? (a->part > b->part) - (a->part < b->part)
           : a->id != b->id     ? (a->id > b->id) - (a->id < b->id)
           : a->line != b->line ? (a->line > b->line) - (a->line < b->line)
                                : (a->kind > b->kind) - (a->kind < b->kind);
}

/* Ids must be unique, because triangles refer to them. */
static void sort_resources(burnish_threemf *threemf) {
    const size_t count = threemf->resources.count;
    burnish_threemf_resource *items = threemf->resources.items;
    if (count > 0) {
        qsort(items, count, sizeof *items, compare_resources);
    }
    for (size_t i = 1; i < count && threemf->status == BURNISH_STATUS_OK; ++i) {
        if (items[i].part == items[i - 1].part && items[i].id == items[i - 1].id) {
            threemf->status = burnish_reader_fail(
                threemf->reader, BURNISH_STATUS_FORMAT, NULL,
                "%s: the id %u is also used in line %u; give each resource its own",
                burnish_threemf_show(threemf, items[i].part, items[i].line).text, items[i].id,
                items[i - 1].line);
        }
    }
}

const burnish_threemf_resource *burnish_threemf_find(const burnish_threemf *threemf, uint32_t part,
                                                     uint32_t id, int kind) {
    const burnish_threemf_resource *items = threemf->resources.items;
    size_t first = 0, end = threemf->resources.count;
    while (first < end) {
        const size_t middle = first + (end - first) / 2;
        if (items[middle].part < part || (items[middle].part == part && items[middle].id < id)) {
            first = middle + 1;
        } else {
            end = middle;
        }
    }
    return first < threemf->resources.count && items[first].part == part && items[first].id == id &&
                   (int)items[first].kind == kind
               ? &items[first]
               : NULL;
}

/* ---- Reading ---- */

/* Marks the parts that only other plates than the wanted one use, once the first part is read. Does
 * nothing where they might matter: without colours for filaments, or with colours by height. */
static void skip_other_plates(burnish_threemf *threemf) {
    const int wanted = threemf->reader->input->options->plate;
    if (wanted == 0 || threemf->filaments.count == 0 || threemf->heights.count > 0) {
        return;
    }
    int need_all = threemf->items.count == 0;
    for (size_t i = 1; i < threemf->parts.count; ++i) {
        threemf->parts.items[i].is_skipped = 1;
    }
    sort_resources(threemf);
    for (size_t i = 0; i < threemf->items.count && threemf->status == BURNISH_STATUS_OK; ++i) {
        const burnish_threemf_placement *item = &threemf->items.items[i];
        const burnish_threemf_resource *resource =
            burnish_threemf_find(threemf, 0, item->id, BURNISH_THREEMF_OBJECT);
        burnish_threemf_object *object =
            resource && item->part == 0 ? &threemf->objects.items[resource->index] : NULL;
        const uint32_t plate = object ? burnish_threemf_plate_of(threemf, item->id, object->items++)
                                      : BURNISH_THREEMF_NONE;
        if (plate != BURNISH_THREEMF_NONE && threemf->plates.items[plate].number != wanted) {
            continue;
        }
        if (!object && item->part != BURNISH_THREEMF_NONE) {
            threemf->parts.items[item->part].is_skipped = 0;
        }
        for (uint32_t k = 0; object && object->state == 0 && k < object->component_count; ++k) {
            const uint32_t part = threemf->components.items[object->first_component + k].part;
            if (part == 0) { /* may hold others */
                need_all = 1;
            } else if (part != BURNISH_THREEMF_NONE) {
                threemf->parts.items[part].is_skipped = 0;
            }
        }
        if (object) {
            object->state = 1; /* its components are marked */
        }
    }
    for (size_t i = 0; i < threemf->objects.count; ++i) {
        threemf->objects.items[i].items = 0;
        threemf->objects.items[i].state = 0;
    }
    threemf->needs_all_parts = need_all;
}

/* Reads the parts that are skipped, or those that are not. */
static void read_models(burnish_threemf *threemf, int are_skipped) {
    for (uint32_t i = 0; i < threemf->parts.count && threemf->status == BURNISH_STATUS_OK &&
                         threemf->memory->status == BURNISH_STATUS_OK;
         ++i) {
        if (threemf->parts.items[i].is_skipped == are_skipped) {
            threemf->parts.items[i].is_skipped = 0;
            burnish_threemf_read_model(threemf, i);
        }
        if (i == 0 && !are_skipped && threemf->status == BURNISH_STATUS_OK) {
            skip_other_plates(threemf);
        }
    }
}

static void read_parts(burnish_threemf *threemf) {
    burnish_threemf_color *white = BURNISH_THREEMF_APPEND(threemf, &threemf->colors);
    if (white) {
        memset(white->rgba, 255, sizeof white->rgba);
        find_start(threemf);
    }
    burnish_threemf_read_project(threemf);
    read_models(threemf, 0);
    if (threemf->needs_all_parts) {
        read_models(threemf, 1);
    }
    if (threemf->status == BURNISH_STATUS_OK) {
        threemf->status = threemf->memory->status;
    }
}

/* clang-format off */
#define LISTS(DO) \
    DO(parts) DO(resources) DO(objects) DO(components) DO(items) DO(vertices) DO(triangles) DO(groups) \
    DO(colors) DO(coordinates) DO(ranges) DO(numbers) DO(textures) DO(rods) DO(settings) DO(volumes) \
    DO(instances) DO(plates) DO(filaments) DO(heights) DO(owners)
/* clang-format on */

static void release_lists(burnish_threemf *threemf, const burnish_context *context) {
    for (size_t i = 0; i < threemf->textures.count && !threemf->shares_paths; ++i) {
        burnish_release(context, threemf->textures.items[i].path);
    }
#define RELEASE(list) burnish_release(context, threemf->list.items);
    LISTS(RELEASE)
    burnish_release(context, threemf->middles);
}

/* ---- Between loads ---- */

struct burnish_project {
    burnish_threemf parsed; /* all parts are read, and no plate is chosen */
    const burnish_context *context;
    const char *unit;
    size_t size; /* of the file */
    uint32_t crc;
};

void burnish_project_destroy(burnish_project *project) {
    if (project) {
        release_lists(&project->parsed, project->context);
        burnish_release(project->context, project);
    }
}

/* The caller's project keeps what was parsed. */
static burnish_project *keep_project(const burnish_threemf *threemf, uint32_t crc) {
    burnish_project *project =
        burnish_allocate_zeroed(threemf->memory, 1, sizeof *project, "a project");
    if (project) {
        *project =
            (burnish_project){*threemf, threemf->memory->context, threemf->reader->mesh->unit,
                              threemf->reader->input->size, crc};
        project->parsed.middles = NULL;
    }
    return project;
}

/* Takes a copy of what was parsed, in place of parsing. */
static void take_project(burnish_threemf *threemf, const burnish_project *project) {
    const burnish_threemf *from = &project->parsed, own = *threemf;
    *threemf = *from;
    threemf->reader = own.reader;
    threemf->memory = own.memory;
    threemf->zip = own.zip;
    threemf->thumbnail = own.thumbnail;
    threemf->middles = own.middles;
    threemf->middle_count = threemf->middle_room = 0;
    threemf->shares_paths = 1;
#define COPY(list)                                                                                 \
    threemf->list.capacity = from->list.count + 1;                                                 \
    threemf->list.items = burnish_allocate(own.memory, threemf->list.capacity,                     \
                                           sizeof *threemf->list.items, "a project");              \
    threemf->list.count = threemf->list.items ? from->list.count : 0;                              \
    if (threemf->list.count > 0) {                                                                 \
        memcpy(threemf->list.items, from->list.items,                                              \
               threemf->list.count * sizeof *threemf->list.items);                                 \
    }
    LISTS(COPY)
    threemf->reader->mesh->unit = project->unit;
    threemf->status = own.memory->status;
}

/* The mesh takes the plates and filaments. */
static void take_contents(burnish_threemf *threemf) {
    burnish_mesh_data *mesh = threemf->reader->mesh;
    mesh->plates = threemf->plates.items;
    mesh->plate_count = threemf->plates.count;
    mesh->filaments = threemf->filaments.items;
    mesh->filament_count = threemf->filaments.count;
    threemf->plates.items = NULL;
    threemf->filaments.items = NULL;
}

static void warn_not_drawn(const burnish_threemf *threemf) {
    if (threemf->not_drawn_count > 0) {
        burnish_reader_warn(threemf->reader, NULL, "%zu part%s not drawn: %s%s",
                            threemf->not_drawn_count,
                            threemf->not_drawn_count == 1 ? " is" : "s are", threemf->not_drawn,
                            threemf->has_more ? " and others" : "");
    }
}

/* Draws the thumbnail of a file that has nothing else to draw, if the caller permits. */
static void replace_model(burnish_threemf *threemf) {
    const burnish_thumbnail wanted = threemf->reader->input->options->thumbnail;
    const int is_secret = burnish_zip_find(&threemf->zip, "Secure/keystore.xml") != NULL;
    if (wanted == BURNISH_THUMBNAIL_ONLY) {
        threemf->status = burnish_threemf_draw_thumbnail(threemf, "its model is not wanted");
    } else if (wanted == BURNISH_THUMBNAIL_AUTO && threemf->status == BURNISH_STATUS_FORMAT &&
               (threemf->is_empty || is_secret)) {
        threemf->status = burnish_threemf_draw_thumbnail(
            threemf, is_secret ? "it is encrypted" : "no triangles are built");
    }
}

/* Everything up to the choice of a plate. */
static void parse_model(burnish_threemf *threemf) {
    read_parts(threemf);
    if (threemf->status == BURNISH_STATUS_OK) {
        sort_resources(threemf);
    }
    if (threemf->status == BURNISH_STATUS_OK) {
        burnish_threemf_place_project(threemf);
        threemf->status = threemf->memory->status;
    }
    if (threemf->status == BURNISH_STATUS_OK) {
        burnish_threemf_mix(threemf);
        threemf->status = threemf->memory->status;
    }
}

static void read_model(burnish_threemf *threemf) {
    const burnish_reader_input *input = threemf->reader->input;
    burnish_project **slot = input->options->project;
    const uint32_t crc = slot ? burnish_inflate_crc32(0, input->bytes, input->size) : 0;
    if (!slot || !*slot || (*slot)->size != input->size || (*slot)->crc != crc) {
        parse_model(threemf);
        slot = slot && !*slot && input->options->plate == 0 &&
                       input->options->thumbnail != BURNISH_THUMBNAIL_ONLY
                   ? slot
                   : NULL;
        if (slot && threemf->status == BURNISH_STATUS_OK) {
            *slot = keep_project(threemf, crc);
            threemf->status = threemf->memory->status;
        }
    }
    if (slot && *slot) {
        take_project(threemf, *slot);
    }
    if (threemf->status == BURNISH_STATUS_OK) {
        burnish_threemf_write_scene(threemf);
        burnish_threemf_settle_values(threemf);
        take_contents(threemf);
    }
    if (threemf->status == BURNISH_STATUS_OK) {
        threemf->status = threemf->memory->status;
    }
}

static burnish_status threemf_read(burnish_reader *reader) {
    burnish_threemf threemf = {.reader = reader, .memory = &reader->mesh->memory};
    threemf.status = burnish_zip_open(&threemf.zip, reader);
    if (threemf.status == BURNISH_STATUS_OK) {
        read_model(&threemf);
        replace_model(&threemf);
    }
    if (threemf.status == BURNISH_STATUS_OK) {
        if (reader->error) { /* of something that became a warning */
            *reader->error = (burnish_error){BURNISH_STATUS_OK, ""};
        }
        burnish_reader_warn_group(reader, &threemf.missing);
        warn_not_drawn(&threemf);
        burnish_reader_warn_group(reader, &threemf.bad_paint);
        burnish_reader_warn_group(reader, &threemf.bad_properties);
        burnish_reader_warn_group(reader, &threemf.mixed);
        burnish_reader_warn_group(reader, &threemf.slices);
    }
    release_lists(&threemf, threemf.memory->context);
    burnish_zip_close(&threemf.zip);
    return threemf.status;
}

#else

void burnish_project_destroy(burnish_project *project) {
    (void)project;
}

static burnish_status threemf_read(burnish_reader *reader) {
    return burnish_reader_fail(
        reader, BURNISH_STATUS_FORMAT, NULL,
        "a ZIP archive; this build of burnish lacks expat and can't read 3MF");
}

#endif

const burnish_format_reader burnish_reader_3mf = {.recognise = threemf_recognise,
                                                  .read = threemf_read};
