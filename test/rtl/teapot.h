/* teapot.h: the scene of picture.cpp: interpolated normals of burnish's teapot,
 * two lights, a material.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#ifndef BURNISH_RTL_TEAPOT_H
#define BURNISH_RTL_TEAPOT_H

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "burnish/mesh.h"
#include "burnish/shade_q15.h"

struct pixel {
    float normal[3]; /* interpolated, facing the viewer; all 0: background */
    float depth;
};

struct light {
    float direction[3], color[3];
};

const light lights[2] = {{{-.55f, .6f, .58f}, {.95f, .92f, .85f}},
                         {{.75f, .25f, .61f}, {.25f, .32f, .45f}}};
const float ambient[3] = {.035f, .035f, .05f}, diffuse[3] = {.55f, .2f, .1f}, ks = .6f;

inline void normalize(float v[3]) {
    const float length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; ++i) {
        v[i] /= length;
    }
}

/* The camera's rotation: about the up axis (y of the picture), then down. */
inline void turn(const float in[3], float out[3]) {
    const float a = -.45f, e = .42f;
    const float x = std::cos(a) * in[0] + std::sin(a) * in[2];
    const float z = -std::sin(a) * in[0] + std::cos(a) * in[2];
    out[0] = x;
    out[1] = std::cos(e) * in[1] - std::sin(e) * z;
    out[2] = std::sin(e) * in[1] + std::cos(e) * z;
}

inline float side(const float *a, const float *b, float x, float y) {
    return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
}

inline void draw(const float p[3][3], const float n[3][3], int width, int height,
                 std::vector<pixel> &out) {
    const float area = side(p[0], p[1], p[2][0], p[2][1]);
    if (area == 0) {
        return;
    }
    int box[4] = {width, height, -1, -1};
    for (int k = 0; k < 3; ++k) {
        box[0] = std::min(box[0], (int)std::floor(p[k][0]));
        box[1] = std::min(box[1], (int)std::floor(p[k][1]));
        box[2] = std::max(box[2], (int)std::ceil(p[k][0]));
        box[3] = std::max(box[3], (int)std::ceil(p[k][1]));
    }
    for (int y = std::max(0, box[1]); y <= std::min(height - 1, box[3]); ++y) {
        for (int x = std::max(0, box[0]); x <= std::min(width - 1, box[2]); ++x) {
            const float fx = (float)x + .5f, fy = (float)y + .5f;
            const float w[3] = {side(p[1], p[2], fx, fy) / area, side(p[2], p[0], fx, fy) / area,
                                side(p[0], p[1], fx, fy) / area};
            if (w[0] < 0 || w[1] < 0 || w[2] < 0) {
                continue;
            }
            pixel &target = out[(size_t)y * width + x];
            const float depth = w[0] * p[0][2] + w[1] * p[1][2] + w[2] * p[2][2];
            if (depth <= target.depth) {
                continue;
            }
            target.depth = depth;
            for (int i = 0; i < 3; ++i) {
                target.normal[i] = w[0] * n[0][i] + w[1] * n[1][i] + w[2] * n[2][i];
            }
            if (target.normal[2] < 0) {
                for (float &value : target.normal) {
                    value = -value;
                }
            }
        }
    }
}

inline std::vector<pixel> normals_of_teapot(int width, int height) {
    burnish_error error;
    burnish_mesh *scene = nullptr;
    burnish_load_options options = burnish_load_options_default();
    options.threads = 1;
    if (burnish_mesh_load(":teapot", &options, &scene, &error) != BURNISH_STATUS_OK) {
        fprintf(stderr, "the teapot cannot be made\n");
        exit(2);
    }
    const burnish_mesh_view *mesh = burnish_mesh_get_view(scene);
    float center[3], size = 0;
    for (int i = 0; i < 3; ++i) {
        center[i] = (mesh->bounds_min[i] + mesh->bounds_max[i]) / 2;
        size = std::max(size, mesh->bounds_max[i] - mesh->bounds_min[i]);
    }
    const float scale = .88f * std::min((float)width, 1.33f * (float)height) / size;
    std::vector<pixel> pixels((size_t)width * height, pixel{{0, 0, 0}, -1e30f});
    for (size_t t = 0; t < mesh->triangle_count; ++t) {
        float p[3][3], n[3][3];
        for (int k = 0; k < 3; ++k) {
            const uint32_t vertex = mesh->indices[3 * t + k];
            float moved[3];
            for (int i = 0; i < 3; ++i) {
                moved[i] = mesh->positions[3 * vertex + i] - center[i];
            }
            turn(moved, p[k]);
            turn(mesh->normals + 3 * vertex, n[k]);
            p[k][0] = (float)width / 2 + scale * p[k][0];
            p[k][1] = (float)height / 2 - scale * p[k][1];
        }
        draw(p, n, width, height, pixels);
    }
    burnish_mesh_destroy(scene);
    return pixels;
}

inline int16_t q15(float x) {
    return (int16_t)std::lround(std::min(1.0f, std::max(-1.0f, x)) * 32767.0f);
}

inline uint16_t uq15(float x) {
    return (uint16_t)std::lround(x * 32768.0f);
}

inline uint64_t packed(const int16_t v[3]) {
    return (uint64_t)(uint16_t)v[2] << 32 | (uint64_t)(uint16_t)v[1] << 16 | (uint16_t)v[0];
}

/* The material and the lights for a viewer along z. */
inline void prepare(burnish_q15_material *material, burnish_q15_light prepared[2]) {
    for (int i = 0; i < 3; ++i) {
        material->ambient[i] = uq15(1);
        material->diffuse[i] = uq15(diffuse[i]);
        material->specular[i] = uq15(ks);
    }
    const int16_t viewer[3] = {0, 0, 0x7FFF};
    for (int k = 0; k < 2; ++k) {
        int16_t direction[3];
        uint16_t color[3];
        for (int i = 0; i < 3; ++i) {
            direction[i] = q15(lights[k].direction[i]);
            color[i] = uq15(lights[k].color[i]);
        }
        burnish_q15_light_create(&prepared[k], direction, viewer, color, material);
    }
}

#endif
