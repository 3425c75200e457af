/* Finding equal positions: they are scattered into buckets by a hash, in order, and each bucket is
 * searched with a small hash table.
 *
 * Why not meshopt_generateVertexRemap: its hash has no seed and is easily inverted, so that a file
 * of 80,000 positions made for it takes 6.9 s, four times that for each doubling (measured,
 * version 0.18), and it ends the process when memory runs out. Here the hash only makes the usual
 * case fast: a bucket in which looking up takes too many steps is sorted instead, so that the worst
 * case is O(n log n), and every failed allocation is reported. */
#include "mesh/build/builder.h"

enum {
    BUCKET_TARGET = 2048, /* positions per bucket: its table stays in the first-level cache */
    BUCKET_BITS_MAX = 12, /* more streams than that scatter badly */
    GRAIN = 1 << 15,      /* positions that are worth a thread, or a slice */
    SLICES_MAX = 64,      /* between two of them the call can end */
    BUCKET_MANY = 16,     /* a bucket so many times as large as on average is sorted at once */
    PROBES = 8            /* per position, on average, before a bucket counts as hostile */
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

/* A position on its way through a bucket. */
typedef struct item {
    uint32_t key[3];
    uint32_t index;
} item;

/* What a thread takes memory with. */
typedef struct weld_thread {
    burnish_memory memory;
    burnish_error error;
} weld_thread;

typedef struct welder {
    const float *positions;
    size_t count;
    burnish_tasks *tasks;
    int threads;   /* that take part */
    size_t slices; /* of the positions, each counted and scattered by one thread */
    int bucket_bits;
    item *items;         /* by bucket, in the order of their index */
    size_t *starts;      /* slices * buckets: where each slice's share of a bucket starts */
    uint32_t *remap;     /* of each position: the first one that is equal */
    uint32_t *tables;    /* threads * table_size: numbers of items + 1 in the bucket, 0: free */
    size_t table_size;   /* a power of two, at least twice the largest bucket looked up */
    weld_thread *memory; /* one per thread */
} welder;

/* Multiply-xorshift mixing; any function would be correct, a poor one only slower. */
static uint64_t hash_position(const uint32_t key[3]) {
    uint64_t h = (key[0] ^ ((uint64_t)key[1] << 32)) * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 29) ^ key[2]) * 0xbf58476d1ce4e5b9u;
    return h ^ (h >> 31);
}

/* The bucket is told by the upper bits of the hash, the slot in its table by the lower ones. */
static size_t bucket_of(const welder *w, uint64_t hash) {
    return (size_t)(hash >> 40) >> (24 - w->bucket_bits);
}

static size_t slice_start(const welder *w, size_t slice) {
    return slice == w->slices ? w->count : w->count / w->slices * slice;
}

static void count_slice(void *context, size_t slice, int thread) {
    const welder *w = context;
    size_t *counts = w->starts + (slice << w->bucket_bits);
    (void)thread;
    memset(counts, 0, sizeof *counts << w->bucket_bits);
    for (size_t i = slice_start(w, slice), end = slice_start(w, slice + 1); i < end; ++i) {
        uint32_t key[3];
        memcpy(key, w->positions + 3 * i, sizeof key);
        ++counts[bucket_of(w, hash_position(key))];
    }
}

static void scatter_slice(void *context, size_t slice, int thread) {
    const welder *w = context;
    size_t *next = w->starts + (slice << w->bucket_bits);
    (void)thread;
    for (size_t i = slice_start(w, slice), end = slice_start(w, slice + 1); i < end; ++i) {
        item moved = {.index = (uint32_t)i};
        memcpy(moved.key, w->positions + 3 * i, sizeof moved.key);
        w->items[next[bucket_of(w, hash_position(moved.key))]++] = moved;
    }
}

/* Counts become starts, bucket by bucket and within them slice by slice; returns the size of the
 * largest bucket. */
static size_t sum_counts(welder *w) {
    size_t sum = 0, largest = 0;
    for (size_t bucket = 0; bucket < (size_t)1 << w->bucket_bits; ++bucket) {
        size_t before = sum;
        for (size_t slice = 0; slice < w->slices; ++slice) {
            size_t *start = &w->starts[(slice << w->bucket_bits) + bucket];
            size_t size = *start;
            *start = sum;
            sum += size;
        }
        largest = sum - before > largest ? sum - before : largest;
    }
    return largest;
}

/* Where a bucket ends, once its items have been scattered. */
static size_t bucket_end(const welder *w, size_t bucket) {
    return w->starts[((w->slices - 1) << w->bucket_bits) + bucket];
}

static int same_key(const uint32_t a[3], const uint32_t b[3]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Returns 0 for a bucket too large, or when it took too many steps. */
static int look_up(const welder *w, const item *items, size_t count, uint32_t *table) {
    size_t size = 16, steps = PROBES * count + 64;
    if (2 * count > w->table_size) {
        return 0;
    }
    while (size < 2 * count) {
        size *= 2;
    }
    memset(table, 0, size * sizeof *table);
    for (size_t i = 0; i < count; ++i) {
        size_t slot = (size_t)hash_position(items[i].key) & (size - 1);
        while (table[slot] != 0 && !same_key(items[table[slot] - 1].key, items[i].key)) {
            slot = (slot + 1) & (size - 1);
            if (--steps == 0) {
                return 0;
            }
        }
        if (table[slot] == 0) {
            table[slot] = (uint32_t)i + 1;
        }
        w->remap[items[i].index] = items[table[slot] - 1].index;
    }
    return 1;
}

static void sort_bucket(const welder *w, const item *items, size_t count, burnish_memory *memory) {
    burnish_weld_record *records = burnish_allocate(memory, count, sizeof *records, "welding");
    if (!records) {
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        records[i] = (burnish_weld_record){{items[i].key[0], items[i].key[1], items[i].key[2]},
                                           items[i].index};
    }
    burnish_weld_sort(records, count);
    uint32_t head = records[0].value;
    for (size_t i = 0; i < count; ++i) {
        if (i > 0 && !same_key(records[i].key, records[i - 1].key)) {
            head = records[i].value;
        }
        w->remap[records[i].value] = head;
    }
    burnish_release(memory->context, records);
}

static void bucket_task(void *context, size_t bucket, int thread) {
    welder *w = context;
    const size_t start = bucket > 0 ? bucket_end(w, bucket - 1) : 0;
    const size_t count = bucket_end(w, bucket) - start;
    if (w->memory[thread].memory.status == BURNISH_STATUS_OK &&
        !look_up(w, w->items + start, count, w->tables + w->table_size * (size_t)thread)) {
        sort_bucket(w, w->items + start, count, &w->memory[thread].memory);
    }
}

/* One table per thread: their size is bounded, or a hostile bucket would cost memory per thread. */
static void allocate_tables(welder *w, size_t largest, burnish_memory *memory) {
    const size_t max = BUCKET_MANY * ((w->count >> w->bucket_bits) + BUCKET_TARGET);
    w->table_size = 16;
    while (w->table_size < 2 * largest && w->table_size < 2 * max) {
        w->table_size *= 2;
    }
    w->tables =
        burnish_allocate(memory, (size_t)w->threads * w->table_size, sizeof *w->tables, "welding");
}

/* Fills remap with first ones. Nothing is read that a cancelled task may have left out. */
static burnish_status find_equal(welder *w, burnish_memory *memory) {
    burnish_tasks_run(w->tasks, w->slices, 1, w->threads, count_slice, w);
    burnish_status status = burnish_tasks_check(w->tasks, memory->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    allocate_tables(w, sum_counts(w), memory);
    if (memory->status != BURNISH_STATUS_OK) {
        return memory->status;
    }
    burnish_tasks_run(w->tasks, w->slices, 1, w->threads, scatter_slice, w);
    status = burnish_tasks_check(w->tasks, memory->error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_tasks_run(w->tasks, (size_t)1 << w->bucket_bits, 1, w->threads, bucket_task, w);
    for (int thread = 0; thread < w->threads; ++thread) {
        burnish_memory_join(memory, &w->memory[thread].memory);
    }
    return memory->status == BURNISH_STATUS_OK ? burnish_tasks_check(w->tasks, memory->error)
                                               : memory->status;
}

static void allocate_welder(welder *w, burnish_memory *memory) {
    const char *what = "welding";
    const size_t threads = (size_t)w->threads;
    w->items = burnish_allocate(memory, w->count, sizeof *w->items, what);
    w->starts = burnish_allocate(memory, w->slices << w->bucket_bits, sizeof *w->starts, what);
    w->memory = burnish_allocate(memory, threads, sizeof *w->memory, what);
    for (int thread = 0; thread < w->threads && w->memory; ++thread) {
        w->memory[thread].memory = burnish_memory_of(memory->context, &w->memory[thread].error);
    }
}

typedef struct numbering {
    uint32_t *heads;
    size_t next;
} numbering;

static void number_range(void *context, size_t first, size_t end) {
    numbering *numbers = context;
    uint32_t *heads = numbers->heads;
    for (size_t i = first; i < end; ++i) {
        heads[i] = heads[i] == i ? (uint32_t)numbers->next++ : heads[heads[i]];
    }
}

size_t burnish_number_heads(burnish_tasks *tasks, uint32_t *heads, size_t count) {
    numbering numbers = {heads, 0};
    burnish_tasks_in_order(tasks, count, BURNISH_BUILD_STEP, number_range, &numbers);
    return numbers.next;
}

burnish_status burnish_weld(const float *positions, size_t count, burnish_tasks *tasks,
                            burnish_memory *memory, uint32_t *remap, size_t *unique) {
    welder w = {.positions = positions, .count = count, .remap = remap, .tasks = tasks};
    *unique = 0;
    if (count == 0) {
        return BURNISH_STATUS_OK;
    }
    const size_t worth = count / GRAIN, all = (size_t)burnish_tasks_threads(tasks);
    w.slices = worth <= 1 ? 1 : worth < SLICES_MAX ? worth : SLICES_MAX;
    w.threads = (int)(w.slices < all ? w.slices : all);
    while (w.bucket_bits < BUCKET_BITS_MAX && count >> w.bucket_bits > BUCKET_TARGET) {
        ++w.bucket_bits;
    }
    allocate_welder(&w, memory);
    burnish_status status =
        memory->status == BURNISH_STATUS_OK ? find_equal(&w, memory) : memory->status;
    burnish_release(memory->context, w.items);
    burnish_release(memory->context, w.starts);
    burnish_release(memory->context, w.memory);
    burnish_release(memory->context, w.tables);
    if (status == BURNISH_STATUS_OK) {
        *unique = burnish_number_heads(tasks, remap, count);
        status = burnish_tasks_check(tasks, memory->error);
    }
    return status;
}
