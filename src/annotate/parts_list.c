/* The parts list: equal parts are one entry. Each visible entry has a pixel for its leader. */
#include <string.h>

#include "annotate/annotate.h"

enum { NO_ENTRY = UINT16_MAX };

/* Parts are equal if their areas differ by less, in parts of one. */
#define AREA_TOLERANCE 1e-5

/* Of the angle between normals across a soft edge, 30 degrees. */
#define LEAST_COSINE 0.866

/* The length of a name without digits and signs at its end, as in "wheel.001" and "Bolt (2)". */
static size_t stem_length(const char *name) {
    size_t length = strlen(name);
    while (length > 0 && strchr("0123456789 .,:;_-#()[]<>", name[length - 1])) {
        --length;
    }
    return length;
}

static size_t part_of(const burnish_mesh_view *view, size_t triangle) {
    return view->triangle_parts ? view->triangle_parts[triangle] : 0;
}

/* As long as twice the area. */
static burnish_vec3 normal_of(const burnish_mesh_view *view, size_t triangle) {
    burnish_vec3 p[3];
    for (int k = 0; k < 3; ++k) {
        p[k] = burnish_vec3_loadf(view->positions + 3 * (size_t)view->indices[3 * triangle + k]);
    }
    return burnish_vec3_cross(burnish_vec3_sub(p[1], p[0]), burnish_vec3_sub(p[2], p[0]));
}

int burnish_is_one_face(const burnish_annotation_view *view, uint32_t a, uint32_t b) {
    const burnish_mesh_view *mesh = view->mesh;
    if (a == b || a >= mesh->triangle_count || b >= mesh->triangle_count) {
        return a == b;
    }
    const burnish_vec3 n = normal_of(mesh, a), m = normal_of(mesh, b);
    return part_of(mesh, a) == part_of(mesh, b) &&
           burnish_vec3_dot(n, m) > LEAST_COSINE * burnish_vec3_length(n) * burnish_vec3_length(m);
}

/* entries receives the entry of each part. Parts without area are not drawn. */
static void group_parts(const burnish_annotation_view *view, size_t count, const double *areas,
                        uint16_t *entries) {
    burnish_callouts *list = view->callouts;
    for (size_t i = 0; i < count; ++i) {
        size_t at = areas[i] > 0 ? 0 : BURNISH_CALLOUTS_MAX;
        for (; at < list->count; ++at) {
            const size_t first = list->items[at].part;
            const burnish_part *a = &view->parts[i], *b = &view->parts[first];
            const double difference = areas[i] - areas[first], most = AREA_TOLERANCE * areas[i];
            if (difference < most && difference > -most && a->triangle_count == b->triangle_count &&
                stem_length(a->name) == stem_length(b->name) &&
                memcmp(a->name, b->name, stem_length(a->name)) == 0) {
                break;
            }
        }
        entries[i] = at < BURNISH_CALLOUTS_MAX ? (uint16_t)at : NO_ENTRY;
        list->left_out += areas[i] > 0 && at == BURNISH_CALLOUTS_MAX;
        if (at < BURNISH_CALLOUTS_MAX) {
            list->count += at == list->count;
            list->items[at].part = list->items[at].count++ ? list->items[at].part : i;
        }
    }
}

/* Leaders start where the distance to the border of a face is largest, in steps along rows and
 * columns: it is found in two passes, from the top left and from the bottom right. */
static void find_points(const burnish_annotation_view *on, size_t count, const uint16_t *entries,
                        uint16_t *distances) {
    const size_t width = (size_t)on->width;
    const uint32_t *ids = on->triangles;
    unsigned most[BURNISH_CALLOUTS_MAX] = {0};
    for (size_t i = 0; i < 2 * count; ++i) {
        const size_t is_second = i >= count, at = is_second ? 2 * count - 1 - i : i;
        unsigned least = is_second ? distances[at] - 1U : UINT16_MAX - 1;
        for (int k = 0; k < 2; ++k) {
            const size_t step = k ? width : 1;
            const int is_edge = (k ? i % count / width : i % width) == 0;
            const size_t next = is_second ? at + step : at - step;
            const unsigned d =
                !is_edge && burnish_is_one_face(on, ids[next], ids[at]) ? distances[next] : 0;
            least = d < least ? d : least;
        }
        distances[at] = (uint16_t)(least + 1);
        const size_t entry =
            ids[at] < on->mesh->triangle_count ? entries[part_of(on->mesh, ids[at])] : NO_ENTRY;
        if (is_second && entry != NO_ENTRY && distances[at] > most[entry]) {
            most[entry] = distances[at];
            on->callouts->items[entry].is_visible = 1;
            on->callouts->items[entry].x = (int)(at % width);
            on->callouts->items[entry].y = (int)(at / width);
        }
    }
}

void burnish_list_parts(const burnish_mesh *mesh, const burnish_annotation_view *view,
                        burnish_memory *memory) {
    const burnish_mesh_view *arrays = burnish_mesh_get_view(mesh);
    const size_t count = burnish_mesh_get_contents(mesh)->part_count;
    const size_t pixels = view->triangles ? (size_t)view->width * (size_t)view->height : 0;
    double *areas = burnish_allocate_zeroed(memory, count + 1, sizeof *areas, "the parts list");
    uint16_t *entries = burnish_allocate(memory, count + 1, sizeof *entries, "the parts list");
    uint16_t *distances = burnish_allocate(memory, pixels + 1, sizeof *distances, "pixels");
    *view->callouts = (burnish_callouts){.count = 0};
    if (memory->status == BURNISH_STATUS_OK && count > 0) {
        for (size_t i = 0; i < arrays->triangle_count; ++i) { /* twice the area of each part */
            areas[part_of(arrays, i)] += burnish_vec3_length(normal_of(arrays, i));
        }
        group_parts(view, count, areas, entries);
        find_points(view, pixels, entries, distances);
    }
    burnish_release(memory->context, areas);
    burnish_release(memory->context, entries);
    burnish_release(memory->context, distances);
}
