/* Equal positions find each other, whatever their hashes; records are sorted. */
#include "mesh/build/weld.h"
#include "support.h"

static int compare_positions(const void *a, const void *b) {
    return memcmp(a, b, 12);
}

/* Enough random positions for different ones with an equal 32-bit hash (about ten pairs). */
static void test_weld(void) {
    enum { COUNT = 300000 };
    float *positions = malloc(COUNT * 12), *sorted = malloc(COUNT * 12);
    uint32_t *remap = malloc(COUNT * sizeof *remap), *in_place = malloc(COUNT * sizeof *in_place);
    float *welded = malloc(COUNT * 12);
    size_t unique = 0, expected = 1;
    burnish_error error = {BURNISH_STATUS_OK, ""};
    uint64_t state = test_seed(1);
    for (size_t i = 0; i < COUNT; ++i) {
        for (int k = 0; k < 3; ++k) {
            positions[3 * i + k] = (float)test_random32(&state);
        }
        if (i % 3 == 2) {
            memcpy(positions + 3 * i, positions + 3 * (test_random32(&state) % i), 12);
        }
    }
    memcpy(sorted, positions, COUNT * 12);
    qsort(sorted, COUNT, 12, compare_positions);
    for (size_t i = 1; i < COUNT; ++i) {
        expected += memcmp(sorted + 3 * i, sorted + 3 * i - 3, 12) != 0;
    }
    for (int threads = 1; threads <= 7; threads += 2) {
        int ordered = 1, equal = 1;
        size_t next = 0;
        burnish_tasks tasks;
        burnish_memory memory = burnish_memory_of(NULL, &error);
        burnish_tasks_begin(&tasks, NULL, threads);
        CHECK_OK(burnish_weld(positions, COUNT, &tasks, &memory, remap, welded, &unique), error);
        CHECK(unique == expected, "%d threads: %zu of %zu", threads, unique, expected);
        for (size_t i = 0; i < COUNT; ++i) {
            next += remap[i] == next;
            ordered &= remap[i] < next;
            equal &= memcmp(welded + 3 * (size_t)remap[i], positions + 3 * i, 12) == 0;
        }
        CHECK(ordered && next == unique, "%d threads: not in order of appearance", threads);
        CHECK(equal, "%d threads: different positions share a number", threads);
        memcpy(sorted, positions, COUNT * 12);
        CHECK1(burnish_weld(sorted, COUNT, &tasks, &memory, in_place, sorted, &unique) ==
                   BURNISH_STATUS_OK &&
               unique == expected);
        CHECK(memcmp(in_place, remap, COUNT * sizeof *remap) == 0 &&
                  memcmp(sorted, welded, unique * 12) == 0,
              "%d threads: in place it is another result", threads);
        CHECK1(burnish_weld(NULL, 0, &tasks, &memory, NULL, NULL, &unique) == BURNISH_STATUS_OK &&
               unique == 0);
    }
    free(positions);
    free(sorted);
    free(welded);
    free(remap);
    free(in_place);
}

/* 0 and -0 are one position. */
static void test_weld_zeros(void) {
    float positions[9] = {0.0f, 1, -0.0f, -0.0f, 1, 0.0f, 0.0f, 2, 0.0f};
    const float zero[3] = {0.0f, 1, 0.0f};
    uint32_t remap[3];
    size_t unique = 0;
    burnish_memory memory = burnish_memory_of(NULL, NULL);
    CHECK1(burnish_weld(positions, 3, NULL, &memory, remap, positions, &unique) ==
           BURNISH_STATUS_OK);
    CHECK1(unique == 2 && remap[0] == 0 && remap[1] == 0 && remap[2] == 1);
    CHECK(memcmp(positions, zero, sizeof zero) == 0, "a sign of 0 is left");
}

/* Positions that weld.c's hash_position gives one hash: its steps backwards, from different lower
 * halves. One in seven is repeated. */
static void craft_position(uint32_t number, uint32_t key[3]) {
    const uint64_t last = ((uint64_t)0x12345678 << 32 | number) * 0x96de1b173f119089u;
    const uint64_t mixed = last ^ (number & 0xff), unmixed = mixed ^ mixed >> 29 ^ mixed >> 58;
    const uint64_t first = unmixed * 0xf1de83e19937733du;
    key[0] = (uint32_t)first;
    key[1] = (uint32_t)(first >> 32);
    key[2] = number & 0xff;
}

static void test_weld_hostile(void) {
    enum { COUNT = 200000 };
    float *positions = malloc(COUNT * 12);
    uint32_t *remap = malloc(COUNT * sizeof *remap);
    float *welded = malloc(COUNT * 12);
    uint32_t *expected = malloc(COUNT * sizeof *expected);
    burnish_error error = {BURNISH_STATUS_OK, ""};
    size_t different = 0;
    for (uint32_t i = 0; i < COUNT; ++i) {
        const uint32_t same = i - i / 2;
        uint32_t key[3];
        expected[i] = i % 7 == 6 ? expected[same] : (uint32_t)different++;
        craft_position(expected[i], key);
        memcpy(positions + 3 * (size_t)i, key, sizeof key);
    }
    for (int threads = 1; threads <= 3; threads += 2) {
        size_t unique = 0;
        burnish_tasks tasks;
        burnish_memory memory = burnish_memory_of(NULL, &error);
        burnish_tasks_begin(&tasks, NULL, threads);
        CHECK_OK(burnish_weld(positions, COUNT, &tasks, &memory, remap, welded, &unique), error);
        CHECK(unique == different, "%zu of %zu", unique, different);
        CHECK1(memcmp(remap, expected, COUNT * sizeof *remap) == 0);
    }
    free(positions);
    free(remap);
    free(welded);
    free(expected);
}

static void test_weld_sort(void) {
    enum { MOST = 300 };
    burnish_weld_record records[MOST];
    uint64_t state = test_seed(2);
    for (size_t count = 0; count < MOST; count += count < 40 ? 1 : 37) {
        uint64_t sum = 0;
        for (size_t i = 0; i < count; ++i) {
            records[i] =
                (burnish_weld_record){{test_random32(&state) % 3, test_random32(&state) % 3,
                                       test_random32(&state) % 3, test_random32(&state) % 3},
                                      (uint32_t)i};
        }
        burnish_weld_sort(records, count);
        int ordered = 1;
        for (size_t i = 0; i < count; ++i) {
            sum += records[i].value;
            for (int k = 0; i > 0 && k < 5; ++k) {
                uint32_t a = k < 4 ? records[i - 1].key[k] : records[i - 1].value;
                uint32_t b = k < 4 ? records[i].key[k] : records[i].value;
                if (a != b) {
                    ordered &= a < b;
                    break;
                }
            }
        }
        CHECK(ordered, "%zu records", count);
        CHECK(sum == count * (count - (count > 0)) / 2, "%zu records: lost some", count);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_weld());
    RUN(test_weld_zeros());
    RUN(test_weld_hostile());
    RUN(test_weld_sort());
    return test_end("weld");
}
