#include "mesh/arrange_parts.h"

#include <stdio.h>
#include <string.h>

#include "base/inputs.h"
#include "base/numbers.h"
#include "mesh/data/box.h"
#include "mesh/read/common/damage.h"

/* ---- Names ---- */

/* Whether a text matches a pattern: * is any text, ? any byte. It goes back only to the last *, so it
 * needs at most the product of both sizes. */
static int matches(const char *pattern, const char *end, const char *text) {
    const char *star = NULL, *from = text;
    while (*text) {
        if (pattern < end && *pattern == '*') {
            star = ++pattern;
            from = text;
        } else if (pattern < end && (*pattern == '?' || *pattern == *text)) {
            ++pattern;
            ++text;
        } else if (star) {
            pattern = star;
            text = ++from;
        } else {
            return 0;
        }
    }
    while (pattern < end && *pattern == '*') {
        ++pattern;
    }
    return pattern == end;
}

/* Whether a part can be drawn, and has one of the names or numbers. */
static int is_named(const burnish_mesh_data *mesh, size_t number, const char *names) {
    const burnish_part *part = &mesh->parts[number];
    const int is_drawn = part->role == BURNISH_PART_SOLID || part->role == BURNISH_PART_NEGATIVE;
    char shown[24] = "";
    for (const char *end; is_drawn && names; names = *end ? end + 1 : NULL) {
        end = names + strcspn(names, ",");
        if (*names == '#' && !*shown) {
            snprintf(shown, sizeof shown, "#%zu", number + 1);
        }
        if (matches(names, end, part->name) || (*names == '#' && matches(names, end, shown))) {
            return 1;
        }
    }
    return 0;
}

/* Letters at the start that are the same, whatever their case. */
static size_t count_common(const char *a, const char *b) {
    size_t i = 0;
    while (a[i] && b[i] && ((a[i] ^ b[i]) & ~0x20) == 0) {
        ++i;
    }
    return i;
}

/* Names of parts for a message: those that begin most like a name, in the order of the file. */
static void list_names(const burnish_mesh_data *mesh, const char *like, char text[300]) {
    enum { SHOWN = 6 };
    size_t most = 0, used = 0, shown = 0;
    for (size_t i = 0; i < mesh->part_count; ++i) {
        const size_t common = count_common(like, mesh->parts[i].name);
        most = common > most ? common : most;
    }
    for (size_t i = 0; i < mesh->part_count && shown < SHOWN; ++i) {
        if (count_common(like, mesh->parts[i].name) == most) {
            used += (size_t)snprintf(text + used, 300 - used, "%s\"%.40s\"", shown ? ", " : "",
                                     mesh->parts[i].name);
            ++shown;
        }
    }
    if (mesh->part_count > shown) {
        snprintf(text + used, 300 - used, " and %zu more", mesh->part_count - shown);
    }
}

/* Writes a message about the first name that no part has. Returns whether parts have another. */
static int check_names(const burnish_mesh_data *mesh, const char *file, const char *names,
                       burnish_error *error) {
    char name[BURNISH_NAME_SIZE], others[300];
    int any = 0;
    for (size_t size; names; names = names[size] ? names + size + 1 : NULL) {
        size_t i = 0;
        size = strcspn(names, ",");
        snprintf(name, sizeof name, "%.*s", (int)size, names);
        while (i < mesh->part_count && !is_named(mesh, i, name)) {
            ++i;
        }
        any |= i < mesh->part_count;
        if (i == mesh->part_count && !*error->text) {
            list_names(mesh, name, others);
            burnish_fail(error, BURNISH_STATUS_ARGUMENT, "%s: no part is named \"%s\"; there is %s",
                         burnish_show_name(file).text, name, others);
        }
    }
    return any;
}

/* ---- Leaving out ---- */

/* The end of the parts of one item. Parts are listed item by item. */
static size_t end_item(const burnish_mesh_data *mesh, size_t first) {
    size_t end = first + 1;
    while (end < mesh->part_count && mesh->parts[end].item == mesh->parts[first].item) {
        ++end;
    }
    return end;
}

/* Marks the hidden parts of an item. A negative volume without its solids would cut nothing. */
static void hide_of_item(burnish_mesh_data *mesh, size_t first, size_t end,
                         const burnish_load_options *options) {
    int any = 0;
    for (size_t i = first; i < end; ++i) {
        const int is_other = mesh->parts[i].role == BURNISH_PART_SOLID && options->only_parts &&
                             !is_named(mesh, i, options->only_parts);
        if (is_other || is_named(mesh, i, options->hidden_parts)) {
            mesh->parts[i].role = BURNISH_PART_HIDDEN;
        }
        any |= mesh->parts[i].role == BURNISH_PART_SOLID;
    }
    for (size_t i = first; i < end && !any; ++i) {
        if (mesh->parts[i].role == BURNISH_PART_NEGATIVE) {
            mesh->parts[i].role = BURNISH_PART_HIDDEN;
        }
    }
}

static size_t part_of(const burnish_mesh_data *mesh, size_t triangle) {
    return mesh->triangle_parts ? mesh->triangle_parts[triangle] : 0;
}

/* Leaves out the triangles of hidden parts. parts: the mesh's, or of the mesh that it is subtracted
 * from */
static void drop_hidden(burnish_mesh_data *mesh, const burnish_part *parts) {
    const size_t faces = mesh->triangle_count - mesh->beside_count;
    size_t kept = 0, beside = 0;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        if (parts[part_of(mesh, i)].role != BURNISH_PART_HIDDEN) {
            burnish_keep_triangle(mesh, i, kept++);
            beside += i >= faces;
        }
    }
    mesh->triangle_count = kept;
    mesh->beside_count = beside;
}

static burnish_status hide_parts(burnish_mesh_data *mesh, const char *name,
                                 const burnish_load_options *options, burnish_error *error) {
    burnish_error unknown = {0};
    check_names(mesh, name, options->hidden_parts, &unknown);
    if (options->only_parts && !check_names(mesh, name, options->only_parts, &unknown)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "%s", unknown.text);
    }
    if (*unknown.text) {
        burnish_mesh_data_warn(mesh, "%s", unknown.text);
    }
    for (size_t i = 0, end; i < mesh->part_count; i = end) {
        end = end_item(mesh, i);
        hide_of_item(mesh, i, end, options);
    }
    drop_hidden(mesh, mesh->parts);
    if (mesh->negatives) {
        drop_hidden(mesh->negatives, mesh->parts);
        if (mesh->negatives->triangle_count == 0) {
            burnish_mesh_data_destroy(mesh->negatives);
            burnish_release(mesh->memory.context, mesh->negatives);
            mesh->negatives = NULL;
        }
    }
    return mesh->triangle_count > 0 ? mesh->memory.status
                                    : burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                                   "%s: all parts are left out; show one of them",
                                                   burnish_show_name(name).text);
}

/* ---- Moving apart ---- */

/* The parts that move together have one leader, the first of them: those of an item with a negative
 * volume. Others lead themselves. */
static void find_leaders(const burnish_mesh_data *mesh, uint32_t *leaders) {
    for (size_t i = 0, end; i < mesh->part_count; i = end) {
        int is_cut = 0;
        end = end_item(mesh, i);
        for (size_t k = i; k < end; ++k) {
            is_cut |= mesh->parts[k].role == BURNISH_PART_NEGATIVE;
        }
        for (size_t k = i; k < end; ++k) {
            leaders[k] = (uint32_t)(is_cut ? i : k);
        }
    }
}

/* Extends boxes by triangles: those of leaders, or for NULL the first one by all. */
static void bound_triangles(const burnish_mesh_data *mesh, const uint32_t *leaders,
                            burnish_box *boxes) {
    const float *p = burnish_positions(mesh);
    const uint32_t *corners = mesh->streams[BURNISH_POSITION].corners;
    for (size_t i = 0; i < 3 * mesh->triangle_count; ++i) {
        burnish_box_extend(&boxes[leaders ? leaders[part_of(mesh, i / 3)] : 0],
                           p + 3 * (size_t)corners[i]);
    }
}

static double middle_of(const burnish_box *box, size_t axis) {
    return ((double)box->low[axis] + (double)box->high[axis]) / 2;
}

/* Moves triangles with the boxes of their leaders. Each corner gets a position of its own, since parts
 * can share one; what is equal is welded later. */
static burnish_status move_corners(burnish_mesh_data *mesh, double factor, const uint32_t *leaders,
                                   const burnish_box *boxes, const burnish_box *all) {
    burnish_stream *positions = &mesh->streams[BURNISH_POSITION];
    const size_t corners = 3 * mesh->triangle_count;
    const float *from = positions->items;
    float *to = burnish_allocate(&mesh->memory, corners, 3 * sizeof *to, "moved parts");
    for (int k = 0; k < BURNISH_ATTRIBUTE_COUNT; ++k) {
        burnish_stream *stream = &mesh->streams[k];
        if (stream->count > 0 && !stream->corners &&
            burnish_mesh_data_reserve_corners(mesh, (burnish_attribute)k, mesh->triangle_count) ==
                BURNISH_STATUS_OK) {
            memcpy(stream->corners, positions->corners, corners * sizeof *stream->corners);
        }
    }
    burnish_status status = mesh->memory.status;
    for (size_t i = 0; i < 3 * corners && status == BURNISH_STATUS_OK; ++i) {
        const size_t axis = i % 3;
        const burnish_box *box = &boxes[leaders[part_of(mesh, i / 9)]];
        const double offset = factor * (middle_of(box, axis) - middle_of(all, axis));
        const double at = (double)from[3 * (size_t)positions->corners[i / 3] + axis];
        if (!burnish_double_to_float(at + offset, &to[i])) {
            status = burnish_fail(mesh->memory.error, BURNISH_STATUS_LIMIT,
                                  "a part would be moved beyond 3.4e38; move it less");
        }
    }
    burnish_release(mesh->memory.context, status == BURNISH_STATUS_OK ? positions->items : to);
    for (size_t i = 0; i < corners && status == BURNISH_STATUS_OK; ++i) {
        positions->corners[i] = (uint32_t)i;
    }
    if (status == BURNISH_STATUS_OK) {
        positions->items = to;
        positions->count = positions->capacity = corners;
    }
    return status;
}

static burnish_status explode_parts(burnish_mesh_data *mesh, double factor) {
    burnish_memory *memory = &mesh->memory;
    uint32_t *leaders = burnish_allocate(memory, mesh->part_count, sizeof *leaders, "parts");
    burnish_box *boxes = burnish_allocate(memory, mesh->part_count, sizeof *boxes, "parts");
    burnish_box all = burnish_box_none();
    burnish_status status = memory->status;
    if (status == BURNISH_STATUS_OK) {
        find_leaders(mesh, leaders);
        for (size_t i = 0; i < mesh->part_count; ++i) {
            boxes[i] = all;
        }
        bound_triangles(mesh, leaders, boxes);
        bound_triangles(mesh, NULL, &all);
        status = move_corners(mesh, factor, leaders, boxes, &all);
    }
    if (status == BURNISH_STATUS_OK && mesh->negatives) {
        status = move_corners(mesh->negatives, factor, leaders, boxes, &all);
    }
    burnish_release(memory->context, leaders);
    burnish_release(memory->context, boxes);
    return status;
}

burnish_status burnish_arrange_parts(burnish_mesh_data *mesh, const char *name,
                                     const burnish_load_options *options, burnish_error *error) {
    const int hides = options->hidden_parts || options->only_parts;
    burnish_box all = burnish_box_none();
    burnish_status status = BURNISH_STATUS_OK;
    if (mesh->part_count == 0 || mesh->triangle_count == 0 || mesh->is_thumbnail ||
        !(hides || options->explode > 0)) {
        return status;
    }
    if (hides) {
        status = hide_parts(mesh, name, options, error);
    }
    if (status == BURNISH_STATUS_OK && options->explode > 0) {
        status = explode_parts(mesh, options->explode);
    }
    if (status == BURNISH_STATUS_OK && mesh->beside_count > 0) { /* with lines and points */
        bound_triangles(mesh, NULL, &all);
        memcpy(mesh->points_min, all.low, sizeof all.low);
        memcpy(mesh->points_max, all.high, sizeof all.high);
    }
    return status;
}
