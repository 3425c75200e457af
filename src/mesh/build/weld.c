/* Finding equal positions: within slices, whose tables stay in the first-level cache, then among
 * what the slices keep, by a table per thread for its part of the hashes. Neighbours in a file are
 * usually neighbours in space, so the slices of a triangle soup keep few positions.
 *
 * Why not meshopt_generateVertexRemap: its hash has no seed and is easily inverted. A file of
 *     80,000 positions made to collide takes 6.9 s, and four times as long for each doubling
 *     (measured, version 0.18). It also ends the process when memory runs out. Here the hash only
 *     makes the usual case fast. A slice whose look-ups take too many steps keeps all its
 *     positions, and a part whose look-ups do is sorted, which makes the worst case O(n log n).
 *     Every failed allocation is reported. */
#include "mesh/build/weld.h"
#include "mesh/build/builder.h"

enum {
    SLICE_BITS = 12, /* of a position's number in its slice */
    SLICE = 1 << SLICE_BITS,
    RANGES_MAX = 64,  /* of slices, whose positions move together */
    TRIAL = 256,      /* positions: if the first ones all differ, a slice keeps all */
    SLICE_PROBES = 2, /* per position, on average, before it also does */
    PART_PROBES = 8,  /* the same, before a part is sorted */
    AHEAD = 16,       /* items whose slots are fetched before they are looked up */
    PART_SLICES = 2,  /* that are worth a thread */
    CHECK_SLICES = 64 /* after so many, whether the call should end */
};

static int record_less(const burnish_weld_record *a, const burnish_weld_record *b) {
    for (int i = 0; i < BURNISH_WELD_KEY_WORDS; ++i) {
        if (a->key[i] != b->key[i]) {
            return a->key[i] < b->key[i];
        }
    }
    return a->value < b->value;
}

#define SORT_TYPE burnish_weld_record
#define SORT_NAME(name) sort_record_##name
#define SORT_LESS record_less
#define SORT_INSERTION_MAX 24 /* vertices have about six corners */
#include "mesh/build/sort.h"

void burnish_weld_sort(burnish_weld_record *records, size_t count) {
    sort_record_array(records, count);
}

/* The memory of one thread, with its errors. */
typedef struct weld_thread {
    burnish_memory memory;
    burnish_error error;
} weld_thread;

/* Items are what slices keep: positions that differ in their slice, moved to its head. Those of
 * slice s are numbered from s * SLICE on, as positions are. */
typedef struct welder {
    const float *from;
    float *positions; /* of each item, then of each number; may be `from` */
    size_t count;
    burnish_tasks *tasks;
    size_t slices;
    size_t parts;        /* of the hashes, one per thread */
    uint32_t *remap;     /* of each position: which of its slice's items it is */
    uint32_t *hashes;    /* of each item; then the number in its range */
    uint32_t *numbers;   /* of each item: the first one equal to it */
    uint16_t *kept;      /* items of each slice */
    weld_thread *memory; /* one per part */
    int range_bits;      /* of a slice's number in its range */
    size_t ranges;
    size_t unique[RANGES_MAX];      /* of each range: different items that come first there, ... */
    uint32_t bases[RANGES_MAX + 1]; /* ... and how many there are before it */
} welder;

/* Multiply-xorshift mixing; any function would be correct, a poor one only slower. */
static uint32_t hash_position(const float position[3]) {
    uint32_t key[3];
    memcpy(key, position, sizeof key);
    uint64_t h = (key[0] ^ ((uint64_t)key[1] << 32)) * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 29) ^ key[2]) * 0xbf58476d1ce4e5b9u;
    return (uint32_t)(h >> 32);
}

static int same_key(const uint32_t a[3], const uint32_t b[3]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static int same_position(const float a[3], const float b[3]) {
    uint32_t x[3], y[3];
    memcpy(x, a, sizeof x);
    memcpy(y, b, sizeof y);
    return same_key(x, y);
}

/* -0 becomes 0: equal positions then have equal bits. */
static inline void load_position(const welder *w, size_t i, float position[3]) {
    for (size_t k = 0; k < 3; ++k) {
        position[k] = w->from[3 * i + k] + 0.0f;
    }
}

/* ---- Slices ---- */

static size_t slice_size(const welder *w, size_t slice) {
    const size_t rest = w->count - slice * SLICE;
    return rest < SLICE ? rest : SLICE;
}

/* Keeps every position from `first` on, which is the slice's `kept`-th item: two that are equal
 * become one among the items. */
static void keep_rest(const welder *w, size_t slice, size_t i, size_t kept) {
    const size_t first = slice * SLICE, end = first + slice_size(w, slice);
    for (; i < end; ++i, ++kept) {
        float *position = w->positions + 3 * (first + kept);
        load_position(w, i, position);
        w->remap[i] = (uint32_t)kept;
        w->hashes[first + kept] = hash_position(position);
    }
    w->kept[slice] = (uint16_t)kept;
}

/* A slice keeps all remaining positions if it seems to have no equal ones, like the vertices of an
 * indexed mesh, or if look-ups take too many steps. */
static void weld_slice(const welder *w, size_t slice) {
    enum { SLOTS = 2 * SLICE };
    const size_t first = slice * SLICE, count = slice_size(w, slice);
    uint32_t *hashes = w->hashes + first;
    float *positions = w->positions + 3 * first;
    uint16_t slots[SLOTS] = {0}; /* items + 1; 0: free */
    size_t kept = 0, steps = SLICE_PROBES * count + 64;
    for (size_t i = first; i < first + count; ++i) {
        float position[3];
        load_position(w, i, position);
        const uint32_t hash = hash_position(position);
        size_t slot = hash % SLOTS;
        while (slots[slot] != 0 && !same_position(positions + 3 * (slots[slot] - 1), position)) {
            slot = (slot + 1) % SLOTS;
            if (--steps == 0) {
                keep_rest(w, slice, i, kept);
                return;
            }
        }
        if (slots[slot] == 0) {
            memcpy(positions + 3 * kept, position, sizeof position);
            hashes[kept] = hash;
            slots[slot] = (uint16_t)++kept;
        }
        w->remap[i] = slots[slot] - 1U;
        if (kept == TRIAL && i - first == TRIAL - 1) {
            keep_rest(w, slice, i + 1, kept);
            return;
        }
    }
    w->kept[slice] = (uint16_t)kept;
}

static void slice_task(void *context, size_t slice, int thread) {
    (void)thread;
    weld_slice(context, slice);
}

/* ---- Parts ---- */

/* A part of the hashes while one thread welds its items. */
typedef struct part {
    const welder *w;
    size_t number;
    int thread;
    uint32_t *slots;    /* an item and, in the bits above it, part of its hash, which rules out most
                           others without reading them; BURNISH_NONE: free */
    uint32_t item_bits; /* a mask: no item is all of them */
    size_t mask;        /* slots - 1: a power of two */
    size_t steps;       /* that looking up may still take; 0: too many */
} part;

/* Lists the items of a slice that belong to a part; returns how many. */
static size_t list_items(const part *p, size_t slice, uint32_t items[SLICE]) {
    const welder *w = p->w;
    const size_t first = slice * SLICE, end = first + w->kept[slice];
    size_t count = 0;
    for (size_t i = first; i < end; ++i) {
        items[count] = (uint32_t)i;
        count += (w->hashes[i] * (uint64_t)w->parts) >> 32 == p->number;
    }
    return count;
}

static void look_up(part *p, uint32_t item) {
    const welder *w = p->w;
    const uint32_t hash = w->hashes[item], bits = p->item_bits;
    const float *position = w->positions + 3 * (size_t)item;
    size_t at = hash & p->mask;
    uint32_t slot;
    while ((slot = p->slots[at]) != BURNISH_NONE &&
           (((slot ^ hash) & ~bits) != 0 ||
            !same_position(w->positions + 3 * (size_t)(slot & bits), position))) {
        at = (at + 1) & p->mask;
        if (p->steps == 0) {
            return;
        }
        --p->steps;
    }
    if (slot == BURNISH_NONE) {
        p->slots[at] = slot = item | (hash & ~bits);
    }
    w->numbers[item] = slot & bits;
}

/* Whether the call should end; checked from time to time. */
static int is_cancelled(const part *p, size_t slice) {
    return slice % CHECK_SLICES == 0 && burnish_tasks_should_end(p->w->tasks, p->thread);
}

/* Returns 0 when it took too many steps. */
static int look_up_part(part *p) {
    uint32_t items[SLICE + AHEAD];
    for (size_t slice = 0; slice < p->w->slices && !is_cancelled(p, slice); ++slice) {
        const size_t count = list_items(p, slice, items);
        memset(items + count, 0, AHEAD * sizeof *items);
        for (size_t i = 0; i < count; ++i) {
            __builtin_prefetch(p->slots + (p->w->hashes[items[i + AHEAD]] & p->mask));
            look_up(p, items[i]);
        }
        if (p->steps == 0) {
            return 0;
        }
    }
    return 1;
}

static void sort_part(const part *p, size_t count, burnish_memory *memory) {
    const welder *w = p->w;
    uint32_t items[SLICE];
    burnish_weld_record *records = burnish_allocate(memory, count, sizeof *records, "welding");
    if (!records) {
        return;
    }
    for (size_t slice = 0, next = 0; slice < w->slices; ++slice) {
        const size_t listed = list_items(p, slice, items);
        for (size_t i = 0; i < listed; ++i, ++next) {
            records[next] = (burnish_weld_record){{0}, items[i]};
            memcpy(records[next].key, w->positions + 3 * (size_t)items[i], 3 * sizeof(float));
        }
    }
    burnish_weld_sort(records, count);
    uint32_t head = records[0].value;
    for (size_t i = 0; i < count; ++i) {
        if (i > 0 && !same_key(records[i].key, records[i - 1].key)) {
            head = records[i].value;
        }
        w->numbers[records[i].value] = head;
    }
    burnish_release(memory->context, records);
}

static void part_task(void *context, size_t number, int thread) {
    const welder *w = context;
    burnish_memory *memory = &w->memory[number].memory;
    part p = {.w = w, .number = number, .thread = thread, .item_bits = 1};
    uint32_t items[SLICE];
    size_t count = 0, size = 64;
    for (size_t slice = 0; slice < w->slices; ++slice) {
        count += w->parts == 1 ? w->kept[slice] : list_items(&p, slice, items);
    }
    while (2 * size < 3 * count) {
        size *= 2;
    }
    while (p.item_bits < w->count) {
        p.item_bits = 2 * p.item_bits + 1;
    }
    p.mask = size - 1;
    p.steps = PART_PROBES * count + 64;
    p.slots = burnish_allocate(memory, size, sizeof *p.slots, "welding");
    if (!p.slots) {
        return;
    }
    memset(p.slots, 0xff, size * sizeof *p.slots);
    const int done = look_up_part(&p);
    burnish_release(memory->context, p.slots);
    if (!done) {
        sort_part(&p, count, memory);
    }
}

/* ---- Numbers ---- */

/* Items that come first get the next number of their range, and their positions move to its head.
 */
static void number_range(void *context, size_t range, int thread) {
    welder *w = context;
    const size_t first = range << w->range_bits, past = (range + 1) << w->range_bits,
                 end = w->slices < past ? w->slices : past;
    float *to = w->positions + 3 * first * SLICE;
    uint32_t next = 0;
    for (size_t slice = first; slice < end; ++slice) {
        for (size_t i = slice * SLICE, last = i + w->kept[slice]; i < last; ++i) {
            if (w->numbers[i] == i) {
                float position[3];
                memcpy(position, w->positions + 3 * i, sizeof position);
                memcpy(to + 3 * (size_t)next, position, sizeof position);
                w->hashes[i] = next++;
            }
        }
        if (thread == 0 && slice % CHECK_SLICES == CHECK_SLICES - 1 &&
            burnish_tasks_cancelled(w->tasks)) {
            return;
        }
    }
    w->unique[range] = next;
}

/* Brings the ranges' positions together. */
static void join_ranges(welder *w) {
    for (size_t range = 0; range < w->ranges; ++range) {
        const size_t first = (range << w->range_bits) * SLICE;
        w->bases[range + 1] = w->bases[range] + (uint32_t)w->unique[range];
        if (w->bases[range] != first) {
            memmove(w->positions + 3 * (size_t)w->bases[range], w->positions + 3 * first,
                    3 * sizeof(float) * w->unique[range]);
        }
    }
}

static void remap_slice(void *context, size_t slice, int thread) {
    const welder *w = context;
    const size_t first = slice * SLICE;
    const int bits = SLICE_BITS + w->range_bits;
    uint32_t numbers[SLICE];
    (void)thread;
    for (size_t i = 0; i < w->kept[slice]; ++i) {
        const size_t head = w->numbers[first + i];
        numbers[i] = w->bases[head >> bits] + w->hashes[head];
    }
    for (size_t i = first, end = first + slice_size(w, slice); i < end; ++i) {
        w->remap[i] = numbers[w->remap[i]];
    }
}

/* After cancellation, some of these might not have been written. */
static burnish_status weld_positions(welder *w, burnish_memory *memory) {
    burnish_tasks_run(w->tasks, w->slices, 1, 0, slice_task, w);
    burnish_status status = burnish_tasks_check(w->tasks, memory->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_tasks_run(w->tasks, w->parts, 1, (int)w->parts, part_task, w);
    for (size_t i = 0; i < w->parts; ++i) {
        burnish_memory_join(memory, &w->memory[i].memory);
    }
    status = memory->status == BURNISH_STATUS_OK ? burnish_tasks_check(w->tasks, memory->error)
                                                 : memory->status;
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_tasks_run(w->tasks, w->ranges, 1, 0, number_range, w);
    status = burnish_tasks_check(w->tasks, memory->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    join_ranges(w);
    burnish_tasks_run(w->tasks, w->slices, 1, 0, remap_slice, w);
    return burnish_tasks_check(w->tasks, memory->error);
}

burnish_status burnish_weld(const float *from, size_t count, burnish_tasks *tasks,
                            burnish_memory *memory, uint32_t *remap, float *to, size_t *unique) {
    const char *what = "welding";
    welder w = {.from = from,
                .positions = to,
                .count = count,
                .tasks = tasks,
                .slices = (count + SLICE - 1) / SLICE,
                .remap = remap};
    *unique = 0;
    if (count == 0) {
        return BURNISH_STATUS_OK;
    }
    const size_t worth = w.slices / PART_SLICES, all = (size_t)burnish_tasks_threads(tasks);
    w.parts = worth <= 1 ? 1 : worth < all ? worth : all;
    const size_t ranges = w.parts == 1 ? 1 : RANGES_MAX;
    while (w.slices > ranges << w.range_bits) {
        ++w.range_bits;
    }
    w.ranges = ((w.slices - 1) >> w.range_bits) + 1;
    w.hashes = burnish_allocate(memory, count, sizeof *w.hashes, what);
    w.numbers = burnish_allocate(memory, count, sizeof *w.numbers, what);
    w.kept = burnish_allocate(memory, w.slices, sizeof *w.kept, what);
    w.memory = burnish_allocate(memory, w.parts, sizeof *w.memory, what);
    for (size_t i = 0; i < w.parts && w.memory; ++i) {
        w.memory[i].memory = burnish_memory_of(memory->context, &w.memory[i].error);
    }
    burnish_status status =
        memory->status == BURNISH_STATUS_OK ? weld_positions(&w, memory) : memory->status;
    *unique = w.bases[w.ranges];
    burnish_release(memory->context, w.hashes);
    burnish_release(memory->context, w.numbers);
    burnish_release(memory->context, w.kept);
    burnish_release(memory->context, w.memory);
    return status;
}
