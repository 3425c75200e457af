/* Counts the objects that 3MF's build places, each only once, before any is written: this bounds the
 * memory and time of the rest. */
#include "mesh/read/threemf/threemf.h"

#if BURNISH_HAS_3MF

#include "mesh/read/io/budget.h"

enum {
    VISITS_MOST = 1 << 22 /* objects that are placed, including those that only contain others */
};

static int count_fail(burnish_threemf *threemf, burnish_status status,
                      const burnish_threemf_placement *placement, uint32_t part, const char *what) {
    threemf->status =
        burnish_reader_fail(threemf->reader, status, NULL, "%s: %s",
                            burnish_threemf_show(threemf, part, placement->line).text, what);
    return 0;
}

static uint64_t add_saturated(uint64_t a, uint64_t b) {
    return a > UINT64_MAX - b ? UINT64_MAX : a + b;
}

/* Adds up triangles and visits of an object after its components. */
static void sum_object(burnish_threemf *threemf, burnish_threemf_object *object) {
    object->triangles = object->triangle_count;
    object->vertices = object->triangle_count > 0 ? object->vertex_count : 0;
    object->visits = 1;
    for (uint32_t k = 0; k < object->component_count; ++k) {
        const uint32_t number = threemf->components.items[object->first_component + k].object;
        const burnish_threemf_object *part =
            number == BURNISH_THREEMF_NONE ? NULL : &threemf->objects.items[number];
        if (part && part->triangles > 0) {
            object->triangles = add_saturated(object->triangles, part->triangles);
            object->vertices = add_saturated(object->vertices, part->vertices);
            object->visits = add_saturated(object->visits, part->visits);
        }
    }
    object->state = 2;
}

/* Counts an object and its components, which come first, each once. */
static int count_object(burnish_threemf *threemf, const burnish_threemf_placement *item) {
    struct {
        uint32_t object, next;
    } stack[BURNISH_THREEMF_NESTING];
    size_t depth = 0;
    if (threemf->objects.items[item->object].state == 2) {
        return 1;
    }
    stack[depth].object = item->object;
    stack[depth++].next = 0;
    while (depth > 0) {
        burnish_threemf_object *object = &threemf->objects.items[stack[depth - 1].object];
        const uint32_t next = stack[depth - 1].next++;
        if (object->state == 0 && object->has_slices) {
            burnish_reader_note(threemf->reader, &threemf->slices, NULL,
                                "%s: slices are not drawn, the object's mesh is",
                                burnish_threemf_show(threemf, object->part, object->line).text);
        }
        object->state = 1;
        if (next == object->component_count) {
            sum_object(threemf, object);
            --depth;
            continue;
        }
        const burnish_threemf_placement *component =
            &threemf->components.items[object->first_component + next];
        const int state = component->object == BURNISH_THREEMF_NONE
                              ? 2
                              : threemf->objects.items[component->object].state;
        if (state == 1) {
            return count_fail(threemf, BURNISH_STATUS_FORMAT, component, object->part,
                              "an object holds itself; repair the file");
        }
        if (state == 0 && depth == BURNISH_THREEMF_NESTING) {
            return count_fail(threemf, BURNISH_STATUS_LIMIT, component, object->part,
                              "objects are nested more than 64 deep; export them flat");
        }
        if (state == 0) {
            stack[depth].object = component->object;
            stack[depth++].next = 0;
        }
    }
    return 1;
}

int burnish_threemf_count(burnish_threemf *threemf) {
    uint64_t visits = 0, vertices = 0, triangles = 0;
    for (size_t i = 0; i < threemf->items.count; ++i) {
        burnish_threemf_placement *item = &threemf->items.items[i];
        if (item->object == BURNISH_THREEMF_NONE) {
            continue;
        }
        const burnish_threemf_object *object = &threemf->objects.items[item->object];
        if (!count_object(threemf, item)) {
            return 0;
        }
        triangles = add_saturated(triangles, object->triangles);
        vertices = add_saturated(vertices, object->vertices);
        visits = add_saturated(visits, object->visits);
    }
    const burnish_load_options *options = threemf->reader->input->options;
    threemf->status = burnish_budget_check(threemf->reader, vertices, triangles);
    if (threemf->status != BURNISH_STATUS_OK) {
        return 0;
    }
    if (triangles > options->max_triangles) {
        threemf->status = burnish_fail_triangles(threemf->reader, NULL);
    } else if (visits > VISITS_MOST) {
        threemf->status = burnish_reader_fail(
            threemf->reader, BURNISH_STATUS_LIMIT, NULL,
            "its build places more than %d objects; export it flat", VISITS_MOST);
    }
    return threemf->status == BURNISH_STATUS_OK;
}

#endif
