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
#include "Vburnish_pixel.h"
#include "burnish/image.h"
#include "burnish/lobe.h"
#include "teapot.h"
#include "verilated.h"

namespace {

const unsigned exponent = 60;

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
    const uint16_t ambient_light[3] = {uq15(ambient[0]), uq15(ambient[1]), uq15(ambient[2])};
    prepare(&material, prepared);
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
    if (burnish_image_create(NULL, &image, width, height, 3, &error) != BURNISH_STATUS_OK) {
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
