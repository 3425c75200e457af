#include "mesh/read/common/parts.h"

#include <string.h>

void burnish_part_set_name(char to[BURNISH_NAME_SIZE], const char *name, size_t size) {
    if (size >= BURNISH_NAME_SIZE) {
        size = BURNISH_NAME_SIZE - 1;
        while (size > 0 && ((uint8_t)name[size] & 0xC0) == 0x80) {
            --size;
        }
    }
    memcpy(to, name, size);
    memset(to + size, 0, BURNISH_NAME_SIZE - size);
}

burnish_part burnish_part_of(const char *name, size_t size) {
    burnish_part part = {.transform = {[0] = 1, [5] = 1, [10] = 1}};
    const uint8_t *zero = memchr(name, 0, size);
    burnish_part_set_name(part.name, name, zero ? (size_t)((const char *)zero - name) : size);
    return part;
}

static uint64_t hash_part(burnish_part_join join, const burnish_part *part) {
    uint64_t hash = 14695981039346656037u; /* FNV-1a */
    if (join == BURNISH_JOIN_IDS) {
        return part->id * 0x9E3779B97F4A7C15u;
    }
    for (const char *c = part->name; *c; ++c) {
        hash = (hash ^ (uint8_t)*c) * 1099511628211u;
    }
    return hash;
}

/* The slot of a part, or an empty one. NULL if neither is near: only chosen names make so long a
 * search, and their parts stay apart. */
static uint32_t *find_slot(const burnish_part_list *list, const burnish_part *part) {
    enum { STEPS = 64 };
    const size_t first = (size_t)(hash_part(list->join, part) >> 32);
    for (size_t i = 0; i < STEPS; ++i) {
        uint32_t *slot = &list->slots[(first + i) & (list->slot_count - 1)];
        const burnish_part *other = *slot ? &list->parts[*slot - 1] : NULL;
        if (!other || (list->join == BURNISH_JOIN_IDS ? part->id == other->id
                                                      : strcmp(part->name, other->name) == 0)) {
            return slot;
        }
    }
    return NULL;
}

/* Keeps more than half of the slots empty. */
static void grow_slots(burnish_part_list *list) {
    const size_t wanted = list->slot_count ? 2 * list->slot_count : 64;
    if (2 * (list->part_count + 1) < list->slot_count) {
        return;
    }
    burnish_release(list->memory->context, list->slots);
    list->slots = burnish_allocate_zeroed(list->memory, wanted, sizeof *list->slots, "parts");
    list->slot_count = list->slots ? wanted : 0;
    for (size_t i = 0; i < list->part_count && list->slots; ++i) {
        uint32_t *slot = find_slot(list, &list->parts[i]);
        if (slot) {
            *slot = (uint32_t)i + 1;
        }
    }
}

/* The number of the next part, which is listed if it is new; SIZE_MAX: memory is out. */
static size_t list_next(burnish_part_list *list) {
    uint32_t *slot = NULL;
    if (list->join != BURNISH_JOIN_NONE) {
        grow_slots(list);
        slot = list->slots ? find_slot(list, &list->next) : NULL;
        if (slot && *slot) {
            return *slot - 1;
        }
    }
    if (list->part_count == BURNISH_PARTS_MAX) {
        return BURNISH_PARTS_MAX - 1;
    }
    list->parts = burnish_reserve(list->memory, list->parts, &list->part_capacity,
                                  list->part_count + 1, sizeof *list->parts, "parts");
    if (list->memory->status != BURNISH_STATUS_OK) {
        return SIZE_MAX;
    }
    if (list->join != BURNISH_JOIN_IDS) {
        list->next.id = (uint32_t)list->part_count;
    }
    list->parts[list->part_count++] = list->next;
    if (slot) {
        *slot = (uint32_t)list->part_count;
    }
    return list->part_count - 1;
}

/* Ends the present part before a triangle. */
static void end_part(burnish_part_list *list, size_t triangle) {
    if (triangle == list->next_triangle || list->memory->status != BURNISH_STATUS_OK) {
        return;
    }
    const size_t part = list_next(list);
    if (list->run_count == 0 || list->runs[list->run_count - 1].part != part) {
        list->runs = burnish_reserve(list->memory, list->runs, &list->run_capacity,
                                     list->run_count + 1, sizeof *list->runs, "parts");
        if (list->memory->status != BURNISH_STATUS_OK) {
            return;
        }
        list->runs[list->run_count++] = (burnish_part_run){list->next_triangle, part};
    }
    list->parts[part].triangle_count += triangle - list->next_triangle;
    list->next_triangle = triangle;
}

void burnish_parts_begin(burnish_part_list *list, const burnish_part *part, size_t triangle) {
    end_part(list, triangle);
    list->next = *part;
}

size_t burnish_parts_count(burnish_part_list *list, size_t triangles) {
    end_part(list, triangles);
    return list->part_count;
}

burnish_status burnish_parts_finish(burnish_part_list *list, burnish_mesh_data *mesh,
                                    size_t least) {
    const size_t triangles = mesh->triangle_count, count = burnish_parts_count(list, triangles);
    if (count > 1 && list->memory->status == BURNISH_STATUS_OK) {
        mesh->triangle_parts = burnish_reserve_discard(
            list->memory, mesh->triangle_parts, &mesh->triangle_part_capacity, triangles,
            sizeof *mesh->triangle_parts, "triangle parts");
        for (size_t i = 0; i < list->run_count && mesh->triangle_parts; ++i) {
            const size_t end =
                i + 1 < list->run_count ? list->runs[i + 1].first_triangle : triangles;
            for (size_t t = list->runs[i].first_triangle; t < end; ++t) {
                mesh->triangle_parts[t] = (uint16_t)list->runs[i].part;
            }
        }
    }
    if (list->memory->status == BURNISH_STATUS_OK && count >= least &&
        (count > 1 || *list->parts[0].name)) {
        mesh->parts = list->parts;
        mesh->part_count = count;
        mesh->part_capacity = list->part_capacity;
        list->parts = NULL;
    }
    burnish_parts_release(list);
    return list->memory->status;
}

void burnish_parts_release(burnish_part_list *list) {
    burnish_release(list->memory->context, list->parts);
    burnish_release(list->memory->context, list->runs);
    burnish_release(list->memory->context, list->slots);
    *list = (burnish_part_list){.memory = list->memory, .join = list->join};
}
