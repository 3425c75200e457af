/* Finding equal vertices: a radix sort by a hash of the key, then a sort within runs of equal hash.
 *
 * Why not meshopt_generateVertexRemap: its hash has no seed and is easily inverted, so that a file
 * of 80,000 positions made for it takes 6.9 s, four times that for each doubling (measured,
 * version 0.18), and it ends the process when memory runs out. Here the hash only makes the usual
 * case fast; runs of equal hash are sorted by the key itself, so that the worst case is
 * O(n log n), and every failed allocation is reported. */
#include "scene/weld.h"

#include <string.h>

#include "base/memory.h"

enum { DIGIT_BITS = 11, DIGIT_COUNT = 1 << DIGIT_BITS, PASSES = 3 };

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

typedef struct hashed {
    uint32_t hash, index;
} hashed;

/* Multiply-xorshift mixing; any function would be correct, a poor one only slower. */
static uint32_t hash_position(const uint32_t key[3]) {
    uint64_t h = (key[0] ^ ((uint64_t)key[1] << 32)) * 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 29) ^ key[2]) * 0xbf58476d1ce4e5b9u;
    return (uint32_t)((h ^ (h >> 31)) >> 16);
}

/* Stable least-significant-digit radix sort by hash; the result is in *items, *spare is scratch. */
static void sort_by_hash(hashed **items, hashed **spare, size_t count) {
    size_t histogram[PASSES][DIGIT_COUNT] = {{0}};
    for (size_t i = 0; i < count; ++i) {
        for (int pass = 0; pass < PASSES; ++pass) {
            ++histogram[pass][((*items)[i].hash >> (pass * DIGIT_BITS)) & (DIGIT_COUNT - 1)];
        }
    }
    for (int pass = 0; pass < PASSES; ++pass) {
        size_t *offset = histogram[pass], sum = 0;
        for (int digit = 0; digit < DIGIT_COUNT; ++digit) {
            size_t n = offset[digit];
            offset[digit] = sum;
            sum += n;
        }
        for (size_t i = 0; i < count; ++i) {
            hashed item = (*items)[i];
            (*spare)[offset[(item.hash >> (pass * DIGIT_BITS)) & (DIGIT_COUNT - 1)]++] = item;
        }
        hashed *sorted = *spare;
        *spare = *items;
        *items = sorted;
    }
}

/* Maps every member of one run of equal hash to the smallest index with the same position. */
static burnish_status resolve_run(const float *positions, const hashed *run, size_t count,
                                  uint32_t *remap, burnish_error *error) {
    const float *first = positions + 3 * (size_t)run[0].index;
    size_t same = 0;
    while (same < count &&
           memcmp(first, positions + 3 * (size_t)run[same].index, 3 * sizeof(float)) == 0) {
        remap[run[same++].index] = run[0].index;
    }
    if (same == count) {
        return BURNISH_STATUS_OK;
    }
    burnish_weld_record *records;
    burnish_status status =
        burnish_allocate((void **)&records, count, sizeof *records, "welding", error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    for (size_t i = 0; i < count; ++i) {
        records[i] = (burnish_weld_record){{0}, run[i].index};
        memcpy(records[i].key, positions + 3 * (size_t)run[i].index, 3 * sizeof(float));
    }
    burnish_weld_sort(records, count);
    uint32_t head = records[0].value;
    for (size_t i = 0; i < count; ++i) {
        if (i > 0 && memcmp(records[i].key, records[i - 1].key, sizeof records[i].key) != 0) {
            head = records[i].value;
        }
        remap[records[i].value] = head;
    }
    free(records);
    return BURNISH_STATUS_OK;
}

burnish_status burnish_weld(const float *positions, size_t count, uint32_t *remap, size_t *unique,
                            burnish_error *error) {
    hashed *items = NULL, *spare = NULL;
    *unique = 0;
    burnish_status status =
        burnish_allocate((void **)&items, count, sizeof *items, "welding", error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_allocate((void **)&spare, count, sizeof *spare, "welding", error);
    }
    if (status == BURNISH_STATUS_OK) {
        for (size_t i = 0; i < count; ++i) {
            uint32_t key[3];
            memcpy(key, positions + 3 * i, sizeof key);
            items[i] = (hashed){hash_position(key), (uint32_t)i};
        }
        sort_by_hash(&items, &spare, count);
    }
    for (size_t start = 0, end; status == BURNISH_STATUS_OK && start < count; start = end) {
        for (end = start + 1; end < count && items[end].hash == items[start].hash; ++end) {
        }
        status = resolve_run(positions, items + start, end - start, remap, error);
    }
    free(items);
    free(spare);
    if (status == BURNISH_STATUS_OK) {
        /* A position's head comes no later than itself, so its number is known by then. */
        for (size_t i = 0; i < count; ++i) {
            remap[i] = remap[i] == i ? (uint32_t)(*unique)++ : remap[remap[i]];
        }
    }
    return status;
}
