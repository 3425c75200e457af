/* Heights at which slicers change the filament: ranges of objects (layer_config_ranges.xml), and
 * changes of colour or tool on plates (custom_gcode_per_layer.xml, ..._per_print_z.xml). Triangles are
 * split there; painted ones keep their filament. PrusaSlicer writes a document per plate into one
 * file, which no parser of XML takes, so tags are searched for. */
#include "mesh/read/threemf/threemf.h"

#if BURNISH_HAS_3MF

#include <float.h>
#include <stdlib.h>

#include "mesh/read/io/budget.h"

enum {
    HEIGHTS_MOST = 512,
    LOOKUPS_MOST = 1 << 23, /* items times heights: a second's work */
    SIDES = 8               /* more than a slice of a triangle has */
};

/* ---- The files ---- */

/* The number behind `key` in a tag. */
static double number_after(const char *tag, const char *key, double otherwise) {
    const char *at = strstr(tag, key);
    at = at ? at + strlen(key) : "";
    double number;
    const burnish_token token = {(const uint8_t *)at, strcspn(at, "\"")};
    return burnish_parse_double(token, &number) == BURNISH_NUMBER_OK ? number : otherwise;
}

static uint32_t whole(double number) {
    return number >= 0 && number < BURNISH_THREEMF_NONE ? (uint32_t)number : 0;
}

/* From now on until `high`, filament h->to is used where h->from would be; 0: the part's. */
static void add_height(burnish_threemf *threemf, const burnish_threemf_height *h) {
    burnish_threemf_height *to =
        h->to > 0 && h->low < h->high ? BURNISH_THREEMF_APPEND(threemf, &threemf->heights) : NULL;
    if (to) {
        *to = *h;
    }
    if (threemf->heights.count > HEIGHTS_MOST) {
        threemf->heights.count = 0;
        threemf->status = BURNISH_STATUS_FORMAT; /* its warning is that of the file */
    }
}

/* A change at the layer that ends at h.low: of a colour (type 0) or a tool (2). */
static void add_change(burnish_threemf *threemf, const char *tag, burnish_threemf_height h) {
    const int type = (int)whole(number_after(tag, " type=\"", 1));
    const uint32_t extruder = whole(number_after(tag, " extruder=\"", 0));
    const char *color = strstr(tag, " color=\"#");
    h.low -= threemf->layer_height;
    h.high = DBL_MAX;
    if (type == 0 && color && extruder > 0) {
        char text[8];
        snprintf(text, sizeof text, "%.7s", color + strlen(" color=\""));
        h.from = extruder;
        h.to = burnish_threemf_add_filament(threemf, extruder, text);
    } else if (type == 2) {
        h.to = extruder;
    }
    add_height(threemf, &h);
}

void burnish_threemf_read_heights(burnish_threemf *threemf, const char *text, size_t size) {
    burnish_threemf_height h = {.object = 0};
    (void)size;
    for (const char *at = strchr(text, '<'), *next; at && threemf->status == BURNISH_STATUS_OK;
         at = next) {
        char tag[256]; /* and the text behind it */
        next = strchr(at + 1, '<');
        snprintf(tag, sizeof tag, "%.*s", (int)(next ? next - at : 1), at);
        if (strncmp(tag, "<object ", 8) == 0) {
            h.object = whole(number_after(tag, " id=\"", 0));
        } else if (strncmp(tag, "<plate_info ", 12) == 0) {
            h.plate = whole(number_after(tag, " id=\"", 0));
        } else if (strncmp(tag, "<custom_gcodes_per_print_z ", 27) == 0) {
            h.plate = whole(number_after(tag, " bed_idx=\"", -1) + 1);
        } else if (strncmp(tag, "<range ", 7) == 0) {
            h.low = number_after(tag, " min_z=\"", 0);
            h.high = number_after(tag, " max_z=\"", 0);
        } else if (strncmp(tag, "<option ", 8) == 0 && h.object > 0) {
            h.to = whole(number_after(tag, " opt_key=\"extruder\">", 0));
            add_height(threemf, &h);
        } else if (strncmp(tag, "<code ", 6) == 0 || strncmp(tag, "<layer ", 7) == 0) {
            h.low = number_after(tag, tag[1] == 'c' ? " print_z=\"" : " top_z=\"", 0);
            add_change(threemf, tag, h);
        }
    }
}

/* ---- Splitting ---- */

/* What only holds another object is a copy of it (PrusaSlicer). */
void burnish_threemf_number_objects(burnish_threemf *threemf) {
    uint32_t count = 0;
    for (size_t i = 0; i < threemf->items.count && threemf->heights.count > 0; ++i) {
        const uint32_t number = threemf->items.items[i].object;
        burnish_threemf_object *object =
            number == BURNISH_THREEMF_NONE ? NULL : &threemf->objects.items[number];
        if (object && object->component_count == 1 && object->triangle_count == 0) {
            const uint32_t held = threemf->components.items[object->first_component].object;
            object->order = held == BURNISH_THREEMF_NONE ? 0 : threemf->objects.items[held].order;
        }
        if (object && object->order == 0) {
            object->order = ++count;
        }
    }
}

/* The heights of an item, in coordinates of the mesh. */
typedef struct height_splitter {
    burnish_threemf *threemf;
    burnish_mesh_data *mesh;
    const burnish_threemf_placement *item;
    double base; /* of the item */
    size_t bound_count;
    float bounds[2 * HEIGHTS_MOST]; /* ascending */
    size_t triangle;                /* that is split */
    uint32_t filament;              /* of it */
    int has_place;                  /* 1: no piece has taken its place yet */
} height_splitter;

/* Where a height begins and ends for the item. Returns 0 if it is no concern of it. */
static int find_span(const height_splitter *splitter, const burnish_threemf_height *h,
                     float span[2]) {
    const burnish_threemf *threemf = splitter->threemf;
    const double base = h->object ? splitter->base : -splitter->mesh->origin[2];
    const uint32_t plate = splitter->item->plate;
    for (int k = 0; k < 2; ++k) {
        const double at = base + (k ? h->high : h->low);
        span[k] = (float)(at < -FLT_MAX ? -FLT_MAX : at > FLT_MAX ? FLT_MAX : at);
    }
    return h->object ? h->object == threemf->objects.items[splitter->item->object].order
                     : h->plate == 0 || plate == BURNISH_THREEMF_NONE ||
                           threemf->plates.items[plate].number == (int)h->plate;
}

/* The height of a corner of a triangle or polygon. */
static float height_at(const height_splitter *splitter, const uint32_t *corners, int k) {
    return burnish_positions(splitter->mesh)[3 * (size_t)corners[k] + 2];
}

static void find_extent(const height_splitter *splitter, const uint32_t *corners, int count,
                        float extent[2]) {
    extent[0] = extent[1] = height_at(splitter, corners, 0);
    for (int k = 1; k < count; ++k) {
        const float z = height_at(splitter, corners, k);
        extent[0] = z < extent[0] ? z : extent[0];
        extent[1] = z > extent[1] ? z : extent[1];
    }
}

static int compare_floats(const void *left, const void *right) {
    const float a = *(const float *)left, b = *(const float *)right;
    return (a > b) - (a < b);
}

/* The bounds of the item that begins with a triangle. */
static void find_bounds(height_splitter *splitter, size_t triangle) {
    const burnish_threemf *threemf = splitter->threemf;
    const burnish_threemf_owner *owners = threemf->owners.items;
    const uint32_t *corners = splitter->mesh->streams[BURNISH_POSITION].corners;
    splitter->item = &threemf->items.items[owners[triangle].item];
    splitter->base = DBL_MAX;
    splitter->bound_count = 0;
    for (size_t i = triangle; i < threemf->owners.count && owners[i].item == owners[triangle].item;
         ++i) {
        float extent[2];
        find_extent(splitter, corners + 3 * i, 3, extent);
        splitter->base = (double)extent[0] < splitter->base ? (double)extent[0] : splitter->base;
    }
    for (size_t i = 0; i < threemf->heights.count; ++i) {
        if (find_span(splitter, &threemf->heights.items[i],
                      splitter->bounds + splitter->bound_count)) {
            splitter->bound_count += 2;
        }
    }
    qsort(splitter->bounds, splitter->bound_count, sizeof *splitter->bounds, compare_floats);
}

/* The material of a polygon. What lies in a bound belongs to the layer that it is the surface of. */
static uint16_t material_at(const height_splitter *splitter, const uint32_t *polygon, int sides) {
    const burnish_threemf *threemf = splitter->threemf;
    const float *p = burnish_positions(splitter->mesh), *a = p + 3 * (size_t)polygon[0];
    const float *b = p + 3 * (size_t)polygon[1], *c = p + 3 * (size_t)polygon[2];
    const int faces_down = (b[0] - a[0]) * (c[1] - a[1]) < (b[1] - a[1]) * (c[0] - a[0]);
    uint32_t tool = splitter->filament, found = tool;
    float extent[2], span[2];
    find_extent(splitter, polygon, sides, extent);
    const float z = extent[0] / 2 + extent[1] / 2;
    for (size_t i = 0; i < threemf->heights.count; ++i) {
        const burnish_threemf_height *h = &threemf->heights.items[i];
        if (find_span(splitter, h, span) && (h->from == 0 || h->from == tool) &&
            (faces_down ? z >= span[0] && z < span[1] : z > span[0] && z <= span[1])) {
            found = burnish_threemf_filament(threemf, h->to);
            tool = h->from == 0 ? found : tool;
        }
    }
    return (uint16_t)(found - 1);
}

/* Writes a polygon as triangles, the first in the place of the one that is split. */
static void put_polygon(height_splitter *splitter, const uint32_t *polygon, int sides) {
    burnish_mesh_data *mesh = splitter->mesh;
    const uint16_t material = material_at(splitter, polygon, sides);
    for (int k = 2; k < sides; ++k) {
        const size_t to = splitter->has_place ? splitter->triangle : mesh->triangle_count++;
        for (int s = 0; s < BURNISH_ATTRIBUTE_COUNT; ++s) {
            uint32_t *corners = mesh->streams[s].corners;
            if (corners && to != splitter->triangle) {
                memcpy(corners + 3 * to, corners + 3 * splitter->triangle, 3 * sizeof *corners);
            }
        }
        const uint32_t corners[3] = {polygon[0], polygon[k - 1], polygon[k]};
        memcpy(mesh->streams[BURNISH_POSITION].corners + 3 * to, corners, sizeof corners);
        mesh->triangle_materials[to] = material;
        if (mesh->triangle_parts) {
            mesh->triangle_parts[to] = mesh->triangle_parts[splitter->triangle];
        }
        splitter->has_place = 0;
    }
}

/* The vertex of an edge at a height: with the same bits for both triangles there. */
static uint32_t cross_edge(const height_splitter *splitter, uint32_t a, uint32_t b, float bound) {
    burnish_stream *positions = &splitter->mesh->streams[BURNISH_POSITION];
    float *p = positions->items, *to = p + 3 * positions->count;
    const int is_up = p[3 * (size_t)a + 2] < p[3 * (size_t)b + 2];
    const float *low = p + 3 * (size_t)(is_up ? a : b), *high = p + 3 * (size_t)(is_up ? b : a);
    const double t = ((double)bound - (double)low[2]) / ((double)high[2] - (double)low[2]);
    for (int k = 0; k < 2; ++k) {
        to[k] = (float)((double)low[k] + t * ((double)high[k] - (double)low[k]));
    }
    to[2] = bound;
    return (uint32_t)positions->count++;
}

/* Writes what is below a height, and leaves the rest in polygon. Returns its sides. */
static int cut_polygon(height_splitter *splitter, uint32_t polygon[SIDES], int sides, float bound) {
    uint32_t below[SIDES], above[SIDES] = {0};
    int below_count = 0, above_count = 0;
    for (int k = 0; k < sides; ++k) {
        const float from = height_at(splitter, polygon, k);
        const float to = height_at(splitter, polygon, (k + 1) % sides);
        if (from <= bound) {
            below[below_count++] = polygon[k];
        }
        if (from >= bound) {
            above[above_count++] = polygon[k];
        }
        if ((from < bound && to > bound) || (from > bound && to < bound)) {
            below[below_count++] = above[above_count++] =
                cross_edge(splitter, polygon[k], polygon[(k + 1) % sides], bound);
        }
    }
    put_polygon(splitter, below, below_count);
    memcpy(polygon, above, sizeof above);
    return above_count;
}

/* The first bound above z. */
static size_t find_bound(const height_splitter *splitter, float z) {
    size_t first = 0;
    for (size_t step = 2 * HEIGHTS_MOST; step > 0; step /= 2) {
        const size_t next = first + step;
        first = next <= splitter->bound_count && splitter->bounds[next - 1] <= z ? next : first;
    }
    return first;
}

/* Splits a triangle from below. Returns how many triangles and vertices that adds at most; only
 * that if it is dry. */
static size_t split_triangle(height_splitter *splitter, size_t triangle, int is_dry) {
    const burnish_mesh_data *mesh = splitter->mesh;
    uint32_t polygon[SIDES];
    float extent[2];
    int sides = 3;
    size_t added = 0;
    memcpy(polygon, mesh->streams[BURNISH_POSITION].corners + 3 * triangle, 3 * sizeof *polygon);
    find_extent(splitter, polygon, sides, extent);
    splitter->triangle = triangle;
    splitter->filament = mesh->triangle_materials[triangle] + 1u;
    splitter->has_place = 1;
    for (size_t i = find_bound(splitter, extent[0]);
         i < splitter->bound_count && splitter->bounds[i] < extent[1]; ++i) {
        const float bound = splitter->bounds[i];
        if (bound > extent[0]) {
            sides = is_dry ? 3 : cut_polygon(splitter, polygon, sides, bound);
            extent[0] = bound; /* equal ones count once */
            added += 2;
        }
    }
    if (!is_dry) {
        put_polygon(splitter, polygon, sides);
    }
    return added;
}

static size_t split_all(height_splitter *splitter, int is_dry) {
    const burnish_threemf *threemf = splitter->threemf;
    size_t added = 0;
    for (size_t i = 0; i < threemf->owners.count; ++i) {
        if (i == 0 || threemf->owners.items[i].item != threemf->owners.items[i - 1].item) {
            find_bounds(splitter, i);
        }
        if (splitter->bound_count > 0 && !threemf->owners.items[i].is_fixed) {
            added += split_triangle(splitter, i, is_dry);
        }
    }
    return added;
}

/* Makes room for more triangles and vertices. */
static void reserve_pieces(burnish_threemf *threemf, burnish_mesh_data *mesh, size_t added) {
    burnish_memory *memory = threemf->memory;
    const size_t count = mesh->triangle_count + added;
    burnish_stream *positions = &mesh->streams[BURNISH_POSITION];
    if (count > burnish_budget_triangles(threemf->reader) ||
        positions->count + added > BURNISH_VALUE_LIMIT) {
        threemf->status = burnish_fail_triangles(threemf->reader, NULL);
        return;
    }
    positions->items = burnish_reserve(memory, positions->items, &positions->capacity,
                                       positions->count + added, 3 * sizeof(float), "pieces");
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        burnish_stream *stream = &mesh->streams[i];
        if (stream->corners) {
            stream->corners = burnish_reserve(memory, stream->corners, &stream->corner_capacity,
                                              count, 3 * sizeof *stream->corners, "pieces");
        }
    }
    mesh->triangle_materials =
        burnish_reserve(memory, mesh->triangle_materials, &mesh->triangle_material_capacity, count,
                        sizeof *mesh->triangle_materials, "pieces");
    if (mesh->triangle_parts) {
        mesh->triangle_parts =
            burnish_reserve(memory, mesh->triangle_parts, &mesh->triangle_part_capacity, count,
                            sizeof *mesh->triangle_parts, "pieces");
    }
    threemf->status = memory->status;
}

int burnish_threemf_split_heights(burnish_threemf *threemf) {
    height_splitter splitter = {.threemf = threemf, .mesh = threemf->reader->mesh};
    if (threemf->heights.count > LOOKUPS_MOST / (threemf->items.count + 1)) {
        burnish_reader_warn(threemf->reader, NULL,
                            "%zu changes of the filament are too many for %zu items; they are "
                            "not drawn",
                            threemf->heights.count, threemf->items.count);
    } else if (threemf->owners.count > 0 && splitter.mesh->triangle_materials) {
        reserve_pieces(threemf, splitter.mesh, split_all(&splitter, 1));
        if (threemf->status == BURNISH_STATUS_OK) {
            split_all(&splitter, 0);
        }
    }
    return threemf->status == BURNISH_STATUS_OK;
}

#endif
