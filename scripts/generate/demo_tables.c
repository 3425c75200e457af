/* Writes the memories of the demonstration on a board, hardware/rtl/demo/tables, after make build:
 *
 *     cc -O1 -Iinclude scripts/generate/demo_tables.c build/release/libburnish.a \
 *        $(pkg-config --libs libisal expat libpng libjpeg libwebp OpenEXR) -lpthread -lm -o /tmp/demo_tables &&
 *     /tmp/demo_tables hardware/rtl/demo/tables
 *
 * spans.mem and normals.mem are the teapot's normals as burnish draws them.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "burnish/image.h"
#include "burnish/mesh.h"
#include "burnish/render.h"
#include "burnish/shade_q15.h"
#include "burnish/sheet.h"

enum { MAP_WIDTH = 256, MAP_HEIGHT = 128, NAME_WIDTH = 128, NUMBER_WIDTH = 64, LABEL_HEIGHT = 16 };
enum { SPAN_WORDS = 18432 }; /* of demo_span_map */

static void fail(const char *what, const char *why) {
    fprintf(stderr, "demo_tables: %s: %s\n", what, why);
    exit(1);
}

static FILE *create(const char *folder, const char *name) {
    char path[4096];
    if ((size_t)snprintf(path, sizeof path, "%s/%s", folder, name) >= sizeof path) {
        fail(folder, "the folder's name is too long");
    }
    FILE *file = fopen(path, "wb");
    if (!file) {
        fail(path, "the file cannot be written");
    }
    return file;
}

static void finish(FILE *file, const char *name) {
    if (ferror(file) | fclose(file)) {
        fail(name, "the file was not written completely");
    }
}

/* floor(sqrt(x)), for x below 2^32. */
static uint32_t root_of(uint64_t x) {
    uint32_t root = 0;
    for (uint32_t bit = 0x8000; bit; bit >>= 1) {
        if ((uint64_t)(root + bit) * (root + bit) <= x) {
            root += bit;
        }
    }
    return root;
}

/* sqrt(i/256) in UQ1.15 and the step to the next: {12 bits, 16 bits}. */
static void write_roots(const char *folder) {
    FILE *file = create(folder, "sqrt.mem");
    for (uint32_t i = 0; i < 256; ++i) {
        const uint32_t root = root_of((uint64_t)i << 22);
        const uint32_t next = root_of((uint64_t)(i + 1) << 22);
        fprintf(file, "%07x\n", (next - root) << 16 | root);
    }
    finish(file, "sqrt.mem");
}

/* The sRGB code nearest to the middle of each of 1024 intervals of linear light. */
static void write_codes(const char *folder) {
    FILE *file = create(folder, "srgb.mem");
    unsigned code = 0;
    for (unsigned i = 0; i < 1024; ++i) {
        const float linear = ((float)i + .5f) / 1024;
        while (code < 255 && burnish_srgb_decode(((float)code + .5f) / 255) <= linear) {
            ++code;
        }
        fprintf(file, "%02x\n", code);
    }
    finish(file, "srgb.mem");
}

/* Half vectors of a light that goes round once in 256 steps. */
static void write_light(const char *folder) {
    const double cosine = 0.99969881869620425, sine = 0.024541228522912288; /* of 2 pi / 256 */
    const int16_t viewer[3] = {0, 0, 0x7FFF};
    double x = 1, y = 0;
    FILE *file = create(folder, "light.mem");
    for (int i = 0; i < 256; ++i) {
        const double to_light[3] = {.95 * x, .35 + .6 * y, .62};
        int32_t wide[3];
        int16_t direction[3], half[3];
        for (int k = 0; k < 3; ++k) {
            wide[k] = (int32_t)(to_light[k] * 16384);
        }
        burnish_q15_normalize(wide, direction);
        burnish_q15_half(direction, viewer, half);
        fprintf(file, "%04x%04x%04x\n", (uint16_t)half[2], (uint16_t)half[1], (uint16_t)half[0]);
        const double turned = cosine * x - sine * y;
        y = sine * x + cosine * y;
        x = turned;
    }
    finish(file, "light.mem");
}

/* A line of text as words of 16 pixels, one bit each. */
static void write_text(FILE *file, int width, const char *text) {
    burnish_image image = {0};
    burnish_error error;
    const uint8_t white[3] = {255, 255, 255};
    if (burnish_image_create(NULL, &image, width, LABEL_HEIGHT, 3, &error) != BURNISH_STATUS_OK) {
        fail("labels", error.text);
    }
    burnish_image_draw_text(&image, 2, LABEL_HEIGHT - 4, 10, white, text);
    for (int i = 0; i < width / 16 * LABEL_HEIGHT; ++i) {
        unsigned word = 0;
        for (int bit = 0; bit < 16; ++bit) {
            word = word << 1 | (image.pixels[(16 * (size_t)i + (size_t)bit) * 3] > 120);
        }
        fprintf(file, "%04x\n", word);
    }
    burnish_image_destroy(&image);
}

static void write_labels(const char *folder) {
    static const char *const names[4] = {"W_0.5", "Schlick", "W", "order 4"};
    static const int exponents[16] = {4,  6,  8,   12,  16,  24,  32,  48,
                                      64, 96, 128, 192, 256, 384, 512, 1023};
    FILE *file = create(folder, "names.mem");
    for (int i = 0; i < 4; ++i) {
        write_text(file, NAME_WIDTH, names[i]);
    }
    finish(file, "names.mem");
    file = create(folder, "exponents.mem");
    for (int i = 0; i < 16; ++i) {
        char text[16];
        snprintf(text, sizeof text, "n=%d", exponents[i]);
        write_text(file, NUMBER_WIDTH, text);
    }
    finish(file, "exponents.mem");
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; ++i) {
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    }
}

/* Newton's iteration: no libm needed. */
static void normalize(double v[3]) {
    const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    double root = square > 1 ? square : 1;
    for (int i = 0; i < 64; ++i) {
        root = .5 * (root + square / root);
    }
    for (int i = 0; i < 3; ++i) {
        v[i] /= root;
    }
}

/* A unit normal in 1024ths, 11, 11 and 10 bits. Of the eight triples around it the one whose length
 * is nearest to 1: a wrong length dims a highlight more than a wrong direction moves it. */
static uint32_t packed(const double normal[3]) {
    int low[3], best[3] = {0, 0, 1};
    double best_error = 1e30;
    for (int i = 0; i < 3; ++i) {
        low[i] = (int)(normal[i] * 1024 + 2048) - 2048; /* floor */
    }
    for (int k = 0; k < 8; ++k) {
        int v[3];
        double square = 0, along = 0;
        for (int i = 0; i < 3; ++i) {
            v[i] = low[i] + (k >> i & 1);
            v[i] = v[i] > 1023 ? 1023 : v[i] < -1023 ? -1023 : v[i];
            square += (double)v[i] * v[i];
            along += v[i] * normal[i];
        }
        v[2] = v[2] < 1 ? 1 : v[2];
        const double length_error = square / (1024. * 1024) - 1;
        const double aside = (square - along * along) / (1024. * 1024);
        const double error = 16 * length_error * length_error + aside;
        if (error < best_error) {
            best_error = error;
            memcpy(best, v, sizeof best);
        }
    }
    return (uint32_t)best[2] << 22 | ((uint32_t)best[1] & 0x7FF) << 11 |
           ((uint32_t)best[0] & 0x7FF);
}

/* The teapot's normals, with x to the right, y up and z to the viewer, who is far away. */
static void draw_normals(float *normals, double axes[3][3]) {
    burnish_error error;
    burnish_mesh *mesh = NULL;
    const burnish_load_options load = burnish_load_options_default();
    burnish_framing framing = burnish_framing_default();
    burnish_render_options options = burnish_render_options_default();
    burnish_target target = burnish_target_default();
    burnish_renderer *renderer = NULL;
    framing.aspect = (double)MAP_WIDTH / MAP_HEIGHT;
    framing.margin = .01;
    framing.orthographic = 1;
    framing.direction[0] = -.15;
    framing.direction[2] = -1;
    framing.elevation = 12;
    options.width = MAP_WIDTH;
    options.height = MAP_HEIGHT;
    options.samples = 1;
    options.threads = 1;
    target.normals = normals;
    target.normal_stride = sizeof(float) * 3 * MAP_WIDTH;
    if (burnish_mesh_load(":teapot", &load, &mesh, &error) != BURNISH_STATUS_OK ||
        burnish_camera_frame(mesh, &framing, &options.camera, &error) != BURNISH_STATUS_OK ||
        burnish_renderer_create(NULL, &renderer, &error) != BURNISH_STATUS_OK ||
        burnish_renderer_draw_into(renderer, mesh, &options, &target, NULL, &error) !=
            BURNISH_STATUS_OK) {
        fail("teapot", error.text);
    }
    for (int i = 0; i < 3; ++i) {
        axes[2][i] = options.camera.position[i] - options.camera.focal_point[i];
    }
    normalize(axes[2]);
    cross(options.camera.view_up, axes[2], axes[0]);
    normalize(axes[0]);
    cross(axes[2], axes[0], axes[1]);
    burnish_renderer_destroy(renderer);
    burnish_mesh_destroy(mesh);
}

/* Per row the words from the first to the last that is not 0, and where they lie; see
 * demo_span_map. */
static void write_spans(const char *folder, const uint32_t *map) {
    FILE *spans = create(folder, "spans.mem"), *words = create(folder, "normals.mem");
    int place = 0;
    for (int y = 0; y < MAP_HEIGHT; ++y) {
        const uint32_t *row = map + y * MAP_WIDTH;
        int first = 0, end = MAP_WIDTH;
        while (first < end && !row[end - 1]) {
            --end;
        }
        while (first < end && !row[first]) {
            ++first;
        }
        fprintf(spans, "%08x\n",
                (uint32_t)(end - first) << 23 | (uint32_t)first << 15 |
                    ((uint32_t)(place - first) & 0x7FFF));
        for (int x = first; x < end; ++x, ++place) {
            fprintf(words, "%08x\n", row[x]);
        }
    }
    if (place > SPAN_WORDS) {
        fail("normals.mem", "the teapot needs more words than demo_span_map has");
    }
    for (; place < SPAN_WORDS; ++place) {
        fprintf(words, "%08x\n", 0);
    }
    finish(spans, "spans.mem");
    finish(words, "normals.mem");
}

static void write_map(const char *folder) {
    static float normals[MAP_WIDTH * MAP_HEIGHT * 3];
    static uint32_t map[MAP_WIDTH * MAP_HEIGHT];
    double axes[3][3];
    draw_normals(normals, axes);
    for (size_t i = 0; i < (size_t)MAP_WIDTH * MAP_HEIGHT; ++i) {
        const float *n = normals + 3 * i;
        double seen[3];
        uint32_t word = 0;
        for (int k = 0; k < 3; ++k) {
            seen[k] = axes[k][0] * n[0] + axes[k][1] * n[1] + axes[k][2] * n[2];
        }
        if (n[0] != 0 || n[1] != 0 || n[2] != 0) {
            normalize(seen);
            word = packed(seen);
        }
        map[i] = word;
    }
    write_spans(folder, map);
}

int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: demo_tables FOLDER\n");
        return 2;
    }
    write_roots(argv[1]);
    write_codes(argv[1]);
    write_light(argv[1]);
    write_labels(argv[1]);
    write_map(argv[1]);
    return 0;
}
