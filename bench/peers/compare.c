/* Histograms of differences. */
#include "compare.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "worker.h"

static void *read_file(const char *path, size_t size) {
    FILE *file = fopen(path, "rb");
    void *bytes = malloc(size);
    if (file && bytes && fread(bytes, 1, size, file) != size) {
        free(bytes);
        bytes = NULL;
    }
    if (file) {
        fclose(file);
    } else {
        free(bytes);
        bytes = NULL;
    }
    return bytes;
}

static void count_bytes(const uint8_t *a, const uint8_t *b, size_t histogram[256], int *largest) {
    for (int k = 0; k < 3; ++k) {
        int difference = abs(a[k] - b[k]);
        ++histogram[difference];
        *largest = difference > *largest ? difference : *largest;
    }
}

static void compare(uint8_t *const rgb[2], uint32_t *const numbers[2],
                    burnish_peers_comparison *c) {
    for (size_t i = 0; i < BURNISH_PEERS_PIXELS; ++i) {
        const uint8_t *a = rgb[0] + 3 * i, *b = rgb[1] + 3 * i;
        uint32_t t = numbers[0][i], u = numbers[1][i];
        if (t != u && (t == BURNISH_PEERS_NOTHING || u == BURNISH_PEERS_NOTHING)) {
            ++c->coverage;
        } else if (t != u) {
            ++c->other_triangle;
            count_bytes(a, b, c->other_histogram, &c->largest_other);
        } else if (t != BURNISH_PEERS_NOTHING) {
            ++c->same;
            count_bytes(a, b, c->histogram, &c->largest);
        }
    }
}

int burnish_peers_compare(const char *const pictures[2], const char *const triangles[2],
                          burnish_peers_comparison *comparison) {
    uint8_t *rgb[2];
    uint32_t *numbers[2];
    int done = 1;
    memset(comparison, 0, sizeof *comparison);
    for (int i = 0; i < 2; ++i) {
        rgb[i] = read_file(pictures[i], (size_t)BURNISH_PEERS_PIXELS * 3);
        numbers[i] = read_file(triangles[i], (size_t)BURNISH_PEERS_PIXELS * sizeof(uint32_t));
        done = done && rgb[i] && numbers[i];
    }
    if (done) {
        compare(rgb, numbers, comparison);
    }
    for (int i = 0; i < 2; ++i) {
        free(rgb[i]);
        free(numbers[i]);
    }
    return done;
}
