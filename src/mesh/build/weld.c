/* Finding equal vertices: positions are dealt into buckets by a hash, in order, and each bucket is
 * looked through with a small hash table.
 *
 * Why not meshopt_generateVertexRemap: its hash has no seed and is easily inverted, so that a file
 * of 80,000 positions made for it takes 6.9 s, four times that for each doubling (measured,
 * version 0.18), and it ends the process when memory runs out. Here the hash only makes the usual
 * case fast: a bucket in which looking up takes too many steps is sorted instead, so that the worst
 * case is O(n log n), and every failed allocation is reported. */
#include "mesh/build/weld.h"

#include <string.h>

#include "core/memory.h"

enum {
    BUCKET_TARGET = 2048, /* positions a bucket: its table stays in the first-level cache */
    BUCKET_BITS_MAX = 12, /* more streams than that scatter badly */
    SHARE = 1 << 15,      /* positions that are worth a thread */
    BUCKET_MANY = 16,     /* a bucket so many times as large as on average is sorted at once */
    PROBES = 8            /* a position, on average, before a bucket counts as hostile */
};

/* Below this insertion sort is faster (vertices have about six corners). */
enum { INSERTION_MAX = 24 };

static int record_less(const burnish_weld_record *a, const burnish_weld_record *b) {
    for (int i = 0; i < 4; ++i) {
        if (a->key[i] != b->key[i]) {
            return a->key[i] < b->key[i];
        }
    }
    return a->value < b->value;
}

static void insertion_sort(burnish_weld_record *records, size_t count) {
    for (size_t i = 1; i < count; ++i) {
        burnish_weld_record record = records[i];
        size_t j = i;
        for (; j > 0 && record_less(&record, &records[j - 1]); --j) {
            records[j] = records[j - 1];
        }
        records[j] = record;
    }
}

static void sift_down(burnish_weld_record *heap, size_t root, size_t count) {
    burnish_weld_record record = heap[root];
    for (size_t child; (child = 2 * root + 1) < count; root = child) {
        if (child + 1 < count && record_less(&heap[child], &heap[child + 1])) {
            ++child;
        }
        if (!record_less(&record, &heap[child])) {
            break;
        }
        heap[root] = heap[child];
    }
    heap[root] = record;
}

static void heap_sort(burnish_weld_record *records, size_t count) {
    for (size_t i = count / 2; i > 0; --i) {
        sift_down(records, i - 1, count);
    }
    for (size_t i = count - 1; i > 0; --i) {
        burnish_weld_record last = records[i];
        records[i] = records[0];
        records[0] = last;
        sift_down(records, 0, i);
    }
}

void burnish_weld_sort(burnish_weld_record *records, size_t count) {
    if (count <= INSERTION_MAX) {
        insertion_sort(records, count);
        return;
    }
    for (size_t i = 1; i < count; ++i) {
        if (record_less(&records[i], &records[i - 1])) {
            heap_sort(records, count);
            return;
        }
    }
}

/* A position on its way through a bucket. */
typedef struct item {
    uint32_t key[3];
    uint32_t index;
} item;

typedef struct welder {
    const float *positions;
    size_t count;
    burnish_tasks *pool;
    int threads; /* that take part */
    int bucket_bits;
    item *items;       /* by bucket, in the order of their index */
    size_t *starts;    /* threads * buckets: where each thread's share of a bucket starts */
    uint32_t *remap;   /* of each position: the first one that is equal */
    uint32_t *tables;  /* threads * table_size: numbers of items + 1 in the bucket, 0: free */
    size_t table_size; /* a power of two, at least twice the largest bucket looked up */
    burnish_status *statuses; /* a thread */
    burnish_error *errors;
} welder;

/* Multiply-xorshift mixing; any function would be correct, a poor one only slower. */
static uint64_t hash_position(const uint32_t key[3]) {
    uint64_t h = (key[0] ^ ((uint64_t)key[1] << 32)) * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 29) ^ key[2]) * 0xbf58476d1ce4e5b9u;
    return h ^ (h >> 31);
}

/* The bucket is told by the upper bits of the hash, the place in its table by the lower ones. */
static size_t bucket_of(const welder *w, uint64_t hash) {
    return (size_t)(hash >> 40) >> (24 - w->bucket_bits);
}

static size_t share_start(const welder *w, int share) {
    return w->count / (size_t)w->threads * (size_t)share;
}
static size_t share_end(const welder *w, int share) {
    return share + 1 == w->threads ? w->count : share_start(w, share + 1);
}

static void count_share(welder *w, int share) {
    size_t *counts = w->starts + ((size_t)share << w->bucket_bits);
    memset(counts, 0, sizeof *counts << w->bucket_bits);
    for (size_t i = share_start(w, share); i < share_end(w, share); ++i) {
        uint32_t key[3];
        memcpy(key, w->positions + 3 * i, sizeof key);
        ++counts[bucket_of(w, hash_position(key))];
    }
}

static void deal_share(welder *w, int share) {
    size_t *next = w->starts + ((size_t)share << w->bucket_bits);
    for (size_t i = share_start(w, share); i < share_end(w, share); ++i) {
        item moved = {.index = (uint32_t)i};
        memcpy(moved.key, w->positions + 3 * i, sizeof moved.key);
        w->items[next[bucket_of(w, hash_position(moved.key))]++] = moved;
    }
}

/* Counts become starts, bucket by bucket and within them share by share; returns the size of the
 * largest bucket. */
static size_t place_buckets(welder *w) {
    size_t sum = 0, largest = 0;
    for (size_t bucket = 0; bucket < (size_t)1 << w->bucket_bits; ++bucket) {
        size_t before = sum;
        for (int share = 0; share < w->threads; ++share) {
            size_t *start = &w->starts[((size_t)share << w->bucket_bits) + bucket];
            size_t size = *start;
            *start = sum;
            sum += size;
        }
        largest = sum - before > largest ? sum - before : largest;
    }
    return largest;
}

/* Where a bucket ends, once its items have been dealt. */
static size_t bucket_end(const welder *w, size_t bucket) {
    return w->starts[((size_t)(w->threads - 1) << w->bucket_bits) + bucket];
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

static burnish_status sort_bucket(const welder *w, const item *items, size_t count,
                                  burnish_error *error) {
    burnish_weld_record *records;
    burnish_status status =
        burnish_legacy_allocate((void **)&records, count, sizeof *records, "welding", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    for (size_t i = 0; i < count; ++i) {
        records[i] = (burnish_weld_record){{items[i].key[0], items[i].key[1], items[i].key[2], 0},
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
    free(records);
    return BURNISH_STATUS_OK;
}

static void resolve_bucket(void *of, size_t bucket, int thread) {
    welder *w = of;
    size_t start = bucket > 0 ? bucket_end(w, bucket - 1) : 0;
    size_t count = bucket_end(w, bucket) - start;
    if (w->statuses[thread] == BURNISH_STATUS_OK &&
        !look_up(w, w->items + start, count, w->tables + w->table_size * (size_t)thread)) {
        w->statuses[thread] = sort_bucket(w, w->items + start, count, &w->errors[thread]);
    }
}

/* A table a thread: their size is bounded, or a hostile bucket would cost memory a thread. */
static burnish_status allocate_tables(welder *w, size_t largest, burnish_error *error) {
    size_t most = BUCKET_MANY * ((w->count >> w->bucket_bits) + BUCKET_TARGET);
    w->table_size = 16;
    while (w->table_size < 2 * largest && w->table_size < 2 * most) {
        w->table_size *= 2;
    }
    return burnish_legacy_allocate((void **)&w->tables, (size_t)w->threads * w->table_size,
                                   sizeof *w->tables, "welding", error);
}

static void count_task(void *of, size_t share, int thread) {
    (void)thread;
    count_share(of, (int)share);
}

static void deal_task(void *of, size_t share, int thread) {
    (void)thread;
    deal_share(of, (int)share);
}

static burnish_status resolve(welder *w, burnish_error *error) {
    const size_t shares = (size_t)w->threads;
    burnish_tasks_run(w->pool, shares, 1, w->threads, count_task, w);
    burnish_status status = allocate_tables(w, place_buckets(w), error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_tasks_run(w->pool, shares, 1, w->threads, deal_task, w);
    const size_t buckets = (size_t)1 << w->bucket_bits;
    burnish_tasks_run(w->pool, buckets, 1, w->threads, resolve_bucket, w);
    for (int thread = 0; thread < w->threads; ++thread) {
        if (w->statuses[thread] != BURNISH_STATUS_OK) {
            if (error) {
                *error = w->errors[thread];
            }
            return w->statuses[thread];
        }
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_weld(const float *positions, size_t count, burnish_tasks *pool,
                            uint32_t *remap, size_t *unique, burnish_error *error) {
    welder w = {.positions = positions, .count = count, .remap = remap, .pool = pool};
    const char *what = "welding";
    *unique = 0;
    if (count == 0) {
        return BURNISH_STATUS_OK;
    }
    const size_t worth = count / SHARE, all = (size_t)burnish_tasks_threads(pool);
    w.threads = worth <= 1 ? 1 : (int)(worth < all ? worth : all);
    while (w.bucket_bits < BUCKET_BITS_MAX && count >> w.bucket_bits > BUCKET_TARGET) {
        ++w.bucket_bits;
    }
    size_t teams = (size_t)w.threads;
    burnish_status status =
        burnish_legacy_allocate((void **)&w.items, count, sizeof *w.items, what, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_legacy_allocate((void **)&w.starts, teams << w.bucket_bits,
                                         sizeof *w.starts, what, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status =
            burnish_legacy_allocate((void **)&w.statuses, teams, sizeof *w.statuses, what, error);
    }
    if (status == BURNISH_STATUS_OK) {
        memset(w.statuses, 0, teams * sizeof *w.statuses);
        status = burnish_legacy_allocate((void **)&w.errors, teams, sizeof *w.errors, what, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = resolve(&w, error);
    }
    free(w.items);
    free(w.starts);
    free(w.statuses);
    free(w.errors);
    free(w.tables);
    if (status == BURNISH_STATUS_OK) {
        /* A position's head comes no later than itself, so its number is known by then. */
        for (size_t i = 0; i < count; ++i) {
            remap[i] = remap[i] == i ? (uint32_t)(*unique)++ : remap[remap[i]];
        }
    }
    return status;
}
