/* picture.cpp: a teapot from the simulated burnish_pixel.
 *
 * Usage: picture WIDTH HEIGHT [FILE.png]
 *
 * Interpolated normals from an orthographic projection of burnish's teapot; everything from there
 * on by burnish_pixel with two lights. Every pixel is compared with shade_q15.h bit for bit, the
 * finished picture with the same equation in float by lobe.h. Exits with 1 on a difference, or
 * below 45 dB.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "Vburnish_pixel.h"
#include "burnish/image.h"
#include "burnish/lobe.h"
#include "burnish/mesh.h"
#include "burnish/shade_q15.h"
#include "verilated.h"

namespace {

const unsigned exponent = 60;

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

void normalize(float v[3]) {
    const float length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int i = 0; i < 3; ++i) {
        v[i] /= length;
    }
}

/* The camera's rotation: about the up axis (y of the picture), then down. */
void turn(const float in[3], float out[3]) {
    const float a = -.45f, e = .42f;
    const float x = std::cos(a) * in[0] + std::sin(a) * in[2];
    const float z = -std::sin(a) * in[0] + std::cos(a) * in[2];
    out[0] = x;
    out[1] = std::cos(e) * in[1] - std::sin(e) * z;
    out[2] = std::sin(e) * in[1] + std::cos(e) * z;
}

float side(const float *a, const float *b, float x, float y) {
    return (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]);
}

void draw(const float p[3][3], const float n[3][3], int width, int height,
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

std::vector<pixel> normals_of_teapot(int width, int height) {
    burnish_error error;
    burnish_mesh *scene = nullptr;
    burnish_load_options options = burnish_load_options_default();
    options.threads = 1;
    if (burnish_mesh_load(":teapot", &options, &scene, &error) != BURNISH_STATUS_OK) {
        fprintf(stderr, "picture: the teapot cannot be made\n");
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

int16_t q15(float x) {
    return (int16_t)std::lround(std::min(1.0f, std::max(-1.0f, x)) * 32767.0f);
}

uint16_t uq15(float x) {
    return (uint16_t)std::lround(x * 32768.0f);
}

uint64_t packed(const int16_t v[3]) {
    return (uint64_t)(uint16_t)v[2] << 32 | (uint64_t)(uint16_t)v[1] << 16 | (uint16_t)v[0];
}

/* Puts a light's 48 bits into a port of 96. */
void put(VlWide<3> &port, int light, uint64_t word) {
    for (int i = 0; i < 3; ++i) {
        const int half = 3 * light + i, shift = half % 2 * 16;
        port[half / 2] = (port[half / 2] & ~(0xFFFFu << shift)) |
                         (uint32_t)(word >> (16 * i) & 0xFFFFu) << shift;
    }
}

struct point {
    int16_t normal[3];
    uint64_t color; /* blue, green, red */
};

/* All pixels through the hardware; every colour checked. Returns how many differ. */
size_t shade(Vburnish_pixel *top, const burnish_q15_shader &shader,
             const burnish_q15_light lamps[2], std::vector<point> &points) {
    size_t wrong = 0, done = 0;
    for (int k = 0; k < 2; ++k) {
        put(top->light, k, packed(lamps[k].direction));
        put(top->half, k, packed(lamps[k].half));
        put(top->diffuse, k, packed((const int16_t *)lamps[k].diffuse));
        put(top->specular, k, packed((const int16_t *)lamps[k].specular));
    }
    top->enable = 1;
    top->exponent = exponent;
    top->ambient = packed((const int16_t *)shader.ambient);
    for (size_t tick = 0; done < points.size() && tick < points.size() + 1000; ++tick) {
        const bool more = tick < points.size();
        top->user_in = more ? (uint32_t)tick + 1 : 0;
        top->normal = more ? packed(points[tick].normal) : 0;
        top->clk = 0;
        top->eval();
        top->clk = 1;
        top->eval();
        if (top->user_out == done + 1) {
            point &p = points[done++];
            int16_t unit[3];
            uint16_t color[3];
            burnish_q15_normalize_near(p.normal, unit);
            burnish_q15_shade(&shader, lamps, 2, unit, color);
            p.color = top->color;
            wrong += packed((const int16_t *)color) != p.color;
        }
    }
    return wrong + points.size() - done;
}

/* The same equation in float, as a code of 0 .. 255. */
double in_float(const pixel &p, int channel) {
    burnish_lobe lobe;
    burnish_lobe_create(&lobe, BURNISH_FIT_SHIFT7, 2, (float)exponent);
    double sum = ambient[channel];
    float normal[3] = {p.normal[0], p.normal[1], p.normal[2]};
    normalize(normal);
    for (const light &l : lights) {
        float d[3] = {l.direction[0], l.direction[1], l.direction[2]}, h[3];
        normalize(d);
        for (int i = 0; i < 3; ++i) {
            h[i] = d[i] + (i == 2);
        }
        normalize(h);
        float n_dot_l = 0, n_dot_h = 0;
        for (int i = 0; i < 3; ++i) {
            n_dot_l += normal[i] * d[i];
            n_dot_h += normal[i] * h[i];
        }
        if (n_dot_l > 0) {
            sum += l.color[channel] *
                   (diffuse[channel] * n_dot_l + ks * burnish_lobe_at_cosine(lobe, n_dot_h));
        }
    }
    return std::min(255.0, std::floor(sum * 255 + .5));
}

} // namespace

int main(int argc, char **argv) {
    const int width = argc > 1 ? atoi(argv[1]) : 160, height = argc > 2 ? atoi(argv[2]) : 120;
    const std::vector<pixel> pixels = normals_of_teapot(width, height);
    burnish_q15_material material;
    burnish_q15_light prepared[2];
    burnish_q15_shader shader;
    uint16_t ambient_light[3];
    for (int i = 0; i < 3; ++i) {
        material.diffuse[i] = uq15(diffuse[i]);
        material.specular[i] = uq15(ks);
        material.ambient[i] = uq15(1);
        ambient_light[i] = uq15(ambient[i]);
    }
    const int16_t viewer[3] = {0, 0, 0x7FFF};
    for (int k = 0; k < 2; ++k) {
        int16_t direction[3];
        uint16_t color[3];
        for (int i = 0; i < 3; ++i) {
            direction[i] = q15(lights[k].direction[i]);
            color[i] = uq15(lights[k].color[i]);
        }
        burnish_q15_light_create(&prepared[k], direction, viewer, color, &material);
    }
    burnish_q15_shader_create(&shader, BURNISH_Q15_SHIFT7, 2, exponent, &material, ambient_light);
    std::vector<point> points;
    std::vector<size_t> places;
    for (size_t i = 0; i < pixels.size(); ++i) {
        if (pixels[i].depth > -1e29f) {
            point p;
            for (int k = 0; k < 3; ++k) {
                p.normal[k] = q15(pixels[i].normal[k]);
            }
            points.push_back(p);
            places.push_back(i);
        }
    }
    Vburnish_pixel top;
    const size_t wrong = shade(&top, shader, prepared, points);
    burnish_image image;
    burnish_error error;
    if (burnish_image_create(&image, width, height, 3, &error) != BURNISH_STATUS_OK) {
        fprintf(stderr, "picture: no image of %d by %d\n", width, height);
        return 2;
    }
    for (size_t i = 0; i < pixels.size() * 3; ++i) {
        image.pixels[i] = 248;
    }
    double squares = 0;
    for (size_t k = 0; k < points.size(); ++k) {
        for (int c = 0; c < 3; ++c) {
            const uint8_t code = burnish_q15_code((uint16_t)(points[k].color >> (16 * c)), 255);
            const double rest = code - in_float(pixels[places[k]], c);
            squares += rest * rest;
            /* Codes are linear; the file is sRGB. */
            const double linear = code / 255.0;
            image.pixels[places[k] * 3 + c] = (uint8_t)std::lround(
                255 *
                (linear <= .0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - .055));
        }
    }
    const double psnr =
        10 * std::log10(255.0 * 255 * 3 * (double)points.size() / std::max(squares, 1e-9));
    printf("picture: %zu pixels from normals, 2 lights, %zu differ from the C core; against float "
           "%.1f dB\n",
           points.size(), wrong, psnr);
    if (argc > 3 && burnish_image_write_png(&image, argv[3], &error) != BURNISH_STATUS_OK) {
        return 2;
    }
    burnish_image_destroy(&image);
    return wrong == 0 && points.size() > pixels.size() / 10 && psnr > 45 ? 0 : 1;
}
