/* Textures against formulas: levels, filtering under perspective, wraps, normal maps, metal's
 * parameters, masks. */
#include <math.h>

#include "core/srgb.h"
#include "mesh/data/mesh.h"
#include "pictures.h"
#include "render/texture/texture_levels.h"

enum { SIZE = 64 };

/* A square from -1 to 1 whose image covers it once; (0, 0) is the lower left corner. */
typedef struct scene {
    burnish_mesh *mesh;
    burnish_render_options options;
    float pixels[SIZE * SIZE * 4];
} scene;

static const float square[] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
static const float coordinates[] = {0, 0, 1, 0, 1, 1, 0, 1};

/* Seen straight from the front, ambient light of 1 alone, one sample per pixel. */
static void open_scene(scene *s, const burnish_material *material, const burnish_texture *textures,
                       size_t count, const float *normals) {
    burnish_mesh_description arrays = describe_quads(square, NULL, 1);
    arrays.normals = (burnish_array){normals, normals ? 4 : 0, 0};
    give_materials(&arrays, material, 1);
    give_textures(&arrays, coordinates, textures, count);
    s->mesh = create_mesh(&arrays, NULL);
    s->options = front_options(SIZE, SIZE, 2);
    light_evenly(&s->options);
}

static void draw(scene *s) {
    draw_floats(s->mesh, &s->options, s->pixels, NULL);
}

static void close_scene(scene *s) {
    burnish_mesh_destroy(s->mesh);
}

static void fill_random(uint8_t *texels, size_t count, uint64_t seed) {
    uint64_t state = test_seed(seed);
    for (size_t i = 0; i < count; ++i) {
        texels[4 * i] = (uint8_t)test_random32(&state);
        texels[4 * i + 1] = (uint8_t)test_random32(&state);
        texels[4 * i + 2] = (uint8_t)test_random32(&state);
        texels[4 * i + 3] = 255;
    }
}

/* ---- Filtering ---- */

static int wrapped(int i, int size, int wrap) {
    if (wrap == BURNISH_WRAP_CLAMP) {
        return i < 0 ? 0 : i >= size ? size - 1 : i;
    }
    const int turned = ((i % (2 * size)) + 2 * size) % (2 * size);
    return wrap == BURNISH_WRAP_REPEAT ? turned % size
           : turned < size             ? turned
                                       : 2 * size - 1 - turned;
}

/* Linear light of a texture at (u, v), the plain way. */
static double sample_plainly(const burnish_texture *texture, const int wrap[2], double u, double v,
                             int channel) {
    const double x = u * texture->width - 0.5, y = (1 - v) * texture->height - 0.5;
    const int left = (int)floor(x), top = (int)floor(y);
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
        const int i = wrapped(left + k % 2, texture->width, wrap[0]);
        const int j = wrapped(top + k / 2, texture->height, wrap[1]);
        const double share =
            (k % 2 ? x - left : 1 - (x - left)) * (k / 2 ? y - top : 1 - (y - top));
        sum +=
            share *
            (double)burnish_srgb_to_linear[texture->pixels[4 * (j * texture->width + i) + channel]];
    }
    return sum;
}

/* Magnified, in perspective, by every wrap: each pixel is what its ray meets. */
static void test_perspective(void) {
    uint8_t texels[4 * 5 * 3];
    const burnish_texture texture = {"random", 5, 3, texels, 1};
    fill_random(texels, 15, 1);
    for (int wrap = 0; wrap < 9; ++wrap) {
        burnish_material material = matt_material(1);
        const int wraps[2] = {wrap % 3, wrap / 3};
        material.textures[BURNISH_TEXTURE_COLOR] =
            (burnish_texture_use){.texture = 1,
                                  .wrap = {wraps[0], wraps[1]},
                                  .has_transform = 1,
                                  .transform = {2, 0, -0.7f, 0.25f, 2, -0.3f}};
        scene s;
        open_scene(&s, &material, &texture, 1, NULL);
        s.options.camera = (burnish_camera){{0.9, -2.1, 1.1}, {0, 0, 0}, {0, 0, 1}, 40, 0};
        draw(&s);
        double worst = 0;
        int seen = 0;
        const double length = sqrt(0.9 * 0.9 + 2.1 * 2.1 + 1.1 * 1.1);
        const double f[3] = {-0.9 / length, 2.1 / length, -1.1 / length};
        const double across = sqrt(f[0] * f[0] + f[1] * f[1]);
        const double r[3] = {f[1] / across, -f[0] / across, 0};
        const double up[3] = {-f[2] * r[1], f[2] * r[0], f[1] * r[0] * -1 + f[0] * r[1]};
        const double unit = tan(20 * 3.14159265358979 / 180) / (SIZE / 2);
        for (int i = 0; i < SIZE * SIZE; ++i) {
            const double x = (i % SIZE + 0.5 - SIZE / 2) * unit;
            const double y = (SIZE / 2 - (i / SIZE) - 0.5) * unit;
            double d[3];
            for (int k = 0; k < 3; ++k) {
                d[k] = f[k] + x * r[k] - y * up[k];
            }
            const double t = -1.1 / d[2];
            const double u = (0.9 + t * d[0] + 1) / 2, v = (-2.1 + t * d[1] + 1) / 2;
            if (!(t > 0 && u > 0.01 && u < 0.99 && v > 0.01 && v < 0.99)) {
                continue;
            }
            ++seen;
            for (int k = 0; k < 3; ++k) {
                const double wanted =
                    sample_plainly(&texture, wraps, 2 * u - 0.7f, 0.25 * u + 2 * v - 0.3f, k);
                worst = fmax(worst, fabs((double)s.pixels[4 * i + k] - wanted));
            }
        }
        CHECK(seen > 500 && worst < 3e-5, "wraps %d: %d pixels, %g", wrap, seen, worst);
        close_scene(&s);
    }
}

/* Texels of half a pixel are level 1; of 1 / sqrt(2) half of each level; columns of black and white
 * leave the mean of their light. */
static void test_levels_drawn(void) {
    static uint8_t texels[4 * 256 * 256];
    const burnish_texture texture = {"stripes", 256, 256, texels, 1};
    for (size_t i = 0; i < 256 * 256; ++i) {
        memset(texels + 4 * i, i % 2 ? 255 : 0, 3);
        texels[4 * i + 3] = 255;
    }
    burnish_material material = matt_material(1);
    material.textures[BURNISH_TEXTURE_COLOR].texture = 1;
    scene s;
    open_scene(&s, &material, &texture, 1, NULL);
    draw(&s); /* four texels a pixel */
    const float code = burnish_srgb_to_linear[burnish_linear_to_srgb(0.5f)];
    for (int i = 0; i < SIZE * SIZE; ++i) {
        CHECK(fabsf(s.pixels[4 * i] - code) < 1e-5f, "pixel %d: %g", i, (double)s.pixels[4 * i]);
    }
    close_scene(&s);
}

static void test_level_texels(void) {
    static const struct {
        int width, height;
    } sizes[] = {{1, 1}, {2, 2}, {3, 5}, {7, 1}, {16, 4}, {13, 11}};
    uint8_t texels[4 * 16 * 16];
    for (size_t n = 0; n < sizeof sizes / sizeof *sizes; ++n) {
        const int w = sizes[n].width, h = sizes[n].height;
        const burnish_texture texture = {NULL, w, h, texels, 0};
        burnish_texture_levels levels = {0};
        burnish_error error;
        burnish_memory memory = burnish_memory_of(NULL, &error);
        fill_random(texels, (size_t)(w * h), n);
        CHECK1(burnish_texture_levels_create(&levels, &texture, BURNISH_TEXTURE_NUMBERS, NULL,
                                             &memory) == BURNISH_STATUS_OK);
        burnish_texture_levels_need_all(&levels, NULL);
        const int lw = w > 1 ? w / 2 : 1, lh = h > 1 ? h / 2 : 1;
        const uint8_t *next = levels.codes + 4 * levels.offset[1];
        CHECK1(levels.count == 1 || (levels.width[1] == lw && levels.height[1] == lh));
        for (int i = 0; i < lw * lh && levels.count > 1; ++i) { /* area by 60 x 60 points */
            double sum = 0;
            for (int k = 0; k < 3600; ++k) {
                const double x = (i % lw + (k % 60 + 0.5) / 60) * w / lw;
                const double y = (i / lw + (k / 60 + 0.5) / 60) * h / lh;
                sum += texels[4 * ((int)y * w + (int)x)];
            }
            const double code = next[4 * (i / lw * (lw + 1) + i % lw)];
            CHECK(fabs(sum / 3600 - code) < 2.5, "%d x %d: %g, %g", w, h, sum / 3600, code);
        }
        for (int y = 0; y < h; ++y) { /* a row's last texel is followed by the first one */
            const uint8_t *row = levels.codes + 4 * y * (w + 1);
            CHECK1(row[0] == texels[4 * y * w] && memcmp(row, row + 4 * w, 4) == 0);
        }
        CHECK1(memcmp(levels.codes + 4 * h * (w + 1), levels.codes, 4 * (size_t)(w + 1)) == 0);
        CHECK1(levels.width[levels.count - 1] == 1 && levels.height[levels.count - 1] == 1);
        burnish_texture_levels_destroy(&levels, NULL);
    }
}

/* Black that can't be seen leaves no halo; normals at right angles have a mean of 1 / sqrt(2). */
static void test_level_kinds(void) {
    uint8_t leaf[] = {200, 100, 50, 255, 0, 0, 0, 0};
    const burnish_texture texture = {NULL, 2, 1, leaf, 1};
    burnish_texture_levels levels = {0};
    burnish_memory memory = burnish_memory_of(NULL, NULL);
    CHECK1(burnish_texture_levels_create(&levels, &texture, BURNISH_TEXTURE_WEIGHTED, NULL,
                                         &memory) == BURNISH_STATUS_OK);
    const uint16_t *mean = levels.texels + 4 * levels.offset[1];
    CHECK(levels.is_weighted && mean[3] == 128 * 257, "%d", mean[3]);
    for (int k = 0; k < 3; ++k) { /* colours are multiplied by alpha */
        const float light = (float)mean[k] / (float)mean[3];
        CHECK(fabsf(light - burnish_srgb_to_linear[leaf[k]]) < 2e-5f, "%d: %g", k, (double)light);
    }
    burnish_texture_levels_destroy(&levels, NULL);
    uint8_t normals[] = {218, 128, 218, 0, 37, 128, 218, 7};
    const burnish_texture bumps = {NULL, 2, 1, normals, 0};
    CHECK1(burnish_texture_levels_create(&levels, &bumps, BURNISH_TEXTURE_NORMALS, NULL, &memory) ==
           BURNISH_STATUS_OK);
    const uint8_t *normal = levels.codes + 4 * levels.offset[1];
    const double missing = 1 - normal[3] / 255.0, length = 1 - missing * missing;
    CHECK(abs(normal[0] - 128) <= 1 && normal[2] == 255 && fabs(length - sqrt(0.5)) < 0.005,
          "%d %d %d: %g", normal[0], normal[1], normal[2], length);
    burnish_texture_levels_destroy(&levels, NULL);
}

/* Texels of level 0 that a thread asks for, as a kernel does, and what they should be. */
enum { BLOCKS_WIDTH = 138, BLOCKS_HEIGHT = 150 };

typedef struct block_check {
    const burnish_texture_levels *levels, *whole;
    atomic_int wrong;
} block_check;

static size_t texel_size(const burnish_texture_levels *levels) {
    return levels->texels ? 8 : 4;
}

static const uint8_t *texel_of(const burnish_texture_levels *levels, int32_t i) {
    return levels->texels ? (const uint8_t *)(levels->texels + 4 * (size_t)i)
                          : levels->codes + 4 * (size_t)i;
}

static void ask_for_texels(void *context, size_t index, int thread) {
    block_check *check = context;
    uint64_t state = test_seed(index);
    const int32_t x = (int32_t)(test_random32(&state) % BLOCKS_WIDTH), y = (int32_t)(index % 150);
    const burnish_texture_box box = {{x, y}, {x + 1, y + 1}};
    const int32_t indices[] = {check->whole->offset[1] + x, y * (BLOCKS_WIDTH + 1) + x};
    (void)thread;
    burnish_texture_levels_need(check->levels, &box, indices, 2);
    for (int32_t i = indices[1], row = 0; row < 2; ++row, i += BLOCKS_WIDTH + 1) {
        const size_t size = 2 * texel_size(check->whole);
        atomic_fetch_add(&check->wrong,
                         memcmp(texel_of(check->levels, i), texel_of(check->whole, i), size) != 0);
    }
}

/* Level 0 is built on demand by any number of threads, and nowhere else. */
static void test_blocks(void) {
    static uint8_t texels[4 * BLOCKS_WIDTH * BLOCKS_HEIGHT];
    const burnish_texture texture = {NULL, BLOCKS_WIDTH, BLOCKS_HEIGHT, texels, 1};
    const burnish_texture_kind kinds[] = {BURNISH_TEXTURE_NUMBERS, BURNISH_TEXTURE_COLORS,
                                          BURNISH_TEXTURE_NORMALS};
    const burnish_texture_box none = {{INT32_MAX, INT32_MAX}, {-1, -1}},
                              all = {{0, 0}, {BLOCKS_WIDTH, BLOCKS_HEIGHT}};
    const int32_t asked = 15 * (BLOCKS_WIDTH + 1) + 3;
    burnish_memory memory = burnish_memory_of(NULL, NULL);
    burnish_tasks tasks;
    fill_random(texels, (size_t)BLOCKS_WIDTH * BLOCKS_HEIGHT, 3);
    for (size_t n = 0; n < sizeof kinds / sizeof *kinds; ++n) {
        burnish_texture_levels whole = {0}, levels = {0};
        CHECK1(burnish_texture_levels_create(&whole, &texture, kinds[n], NULL, &memory) ==
                   BURNISH_STATUS_OK &&
               burnish_texture_levels_create(&levels, &texture, kinds[n], NULL, &memory) ==
                   BURNISH_STATUS_OK);
        burnish_texture_levels_need_all(&whole, NULL);
        CHECK1(levels.blocks && !burnish_texture_levels_has_some(&levels));
        const int blocks = levels.blocks ? atomic_load(&levels.blocks->missing) : 0;
        burnish_texture_levels_need(&levels, &none, &asked, 1);
        CHECK1(!burnish_texture_levels_has_some(&levels));
        burnish_texture_levels_need(&levels, &all, &whole.offset[1], 1);
        CHECK1(!burnish_texture_levels_has_some(&levels));
        burnish_texture_levels_need(&levels, &all, &asked, 1);
        CHECK1(atomic_load(&levels.blocks->missing) == blocks - 2);
        for (int threads = 1; threads <= 5; threads += 4) {
            block_check check = {.levels = &levels, .whole = &whole};
            burnish_tasks_begin(&tasks, NULL, threads);
            burnish_tasks_run(&tasks, threads == 1 ? 5 : 6000, 1, 0, ask_for_texels, &check);
            CHECK(atomic_load(&check.wrong) == 0, "kind %zu: %d texels", n,
                  atomic_load(&check.wrong));
        }
        CHECK1(atomic_load(&levels.blocks->missing) == 0);
        CHECK1(memcmp(texel_of(&levels, 0), texel_of(&whole, 0),
                      texel_size(&whole) * (size_t)whole.offset[1]) == 0);
        burnish_texture_levels_destroy(&levels, NULL);
        burnish_texture_levels_destroy(&whole, NULL);
    }
}

/* ---- Shading ---- */

static void add_light(scene *s) {
    s->options.light_count = 1;
    s->options.lights[0] = (burnish_light){.vector = {0.3, 0.4, 0.9}, .color = {1, 0.9f, 0.8f}};
    set_three(s->options.ambient_light, 0.1f);
}

/* Largest difference of two pictures' light. */
static double difference(const scene *a, const scene *b) {
    double worst = 0;
    for (int i = 0; i < SIZE * SIZE * 4; ++i) {
        worst = fmax(worst, fabs((double)a->pixels[i] - (double)b->pixels[i]));
    }
    return worst;
}

/* A normal map of one colour turns a plane as normals of that direction do, from both sides. */
static void test_normal_map(void) {
    const uint8_t texel[] = {170, 90, 220, 255};
    const burnish_texture texture = {NULL, 1, 1, texel, 0};
    const double x = 170 / 127.5 - 1, y = 90 / 127.5 - 1, z = 220 / 127.5 - 1;
    const double length = sqrt(x * x + y * y + z * z);
    float tilted[12];
    for (int i = 0; i < 4; ++i) {
        tilted[3 * i] = (float)(x / length);
        tilted[3 * i + 1] = (float)(y / length);
        tilted[3 * i + 2] = (float)(z / length);
    }
    for (int back = 0; back < 2; ++back) {
        static scene plain, mapped;
        burnish_material material = matt_material(1);
        material.specular[0] = 0.5f;
        open_scene(&plain, &material, NULL, 0, tilted);
        material.textures[BURNISH_TEXTURE_NORMAL] =
            (burnish_texture_use){.texture = 1, .strength = 1};
        open_scene(&mapped, &material, &texture, 1, NULL);
        add_light(&plain);
        add_light(&mapped);
        if (back) {
            plain.options.camera.position[2] = mapped.options.camera.position[2] = -10;
            plain.options.lights[0].vector[2] = mapped.options.lights[0].vector[2] = -0.9;
        }
        draw(&plain);
        draw(&mapped);
        CHECK(difference(&plain, &mapped) < 0.01, "back %d: %g", back, difference(&plain, &mapped));
        close_scene(&plain);
        close_scene(&mapped);
    }
}

/* White textures change no pixel; textures of one value are factors. */
static void test_factors(void) {
    const uint8_t texels[] = {255, 255, 255, 255, 255, 128, 51, 255};
    const burnish_texture textures[] = {{NULL, 1, 1, texels, 1}, {NULL, 1, 1, texels + 4, 0}};
    for (int which = 0; which < 5; ++which) {
        static scene plain, textured;
        burnish_material material = matt_material(1);
        material.specular[1] = 0.5f;
        material.exponent = 50;
        material.emissive[2] = 0.125f;
        burnish_material other = material;
        if (which == 0) {
            other.textures[BURNISH_TEXTURE_SPECULAR].texture = 1;
            other.textures[BURNISH_TEXTURE_COLOR].texture = 1;
        } else if (which == 1) {
            other.exponent = material.exponent * 2;
            other.textures[BURNISH_TEXTURE_EXPONENT].texture = 2;
            material.exponent = 100;
        } else if (which == 2) {
            other.is_metallic = material.is_metallic = 1;
            other.metallic = 1;
            other.roughness = 0.9f;
            material.metallic = 51 / 255.0f;
            material.roughness = 0.9f * 128 / 255.0f;
            other.textures[BURNISH_TEXTURE_METALLIC_ROUGHNESS].texture = 2;
        } else if (which == 3) {
            static const float factors[] = {1, 128 / 255.0f, 51 / 255.0f};
            other.is_metallic = material.is_metallic = 1;
            other.roughness = material.roughness = 0.6f;
            for (int k = 0; k < 3; ++k) {
                other.reflectance[k] = 0.25f;
                material.reflectance[k] = 0.25f * factors[k];
            }
            other.textures[BURNISH_TEXTURE_SPECULAR].texture = 2;
        } else {
            other.textures[BURNISH_TEXTURE_OCCLUSION] =
                (burnish_texture_use){.texture = 2, .strength = 0.5f};
            other.textures[BURNISH_TEXTURE_EMISSIVE].texture = 1;
        }
        open_scene(&plain, &material, NULL, 0, NULL);
        open_scene(&textured, &other, textures, 2, NULL);
        add_light(&plain);
        add_light(&textured);
        draw(&plain);
        draw(&textured);
        CHECK(difference(&plain, &textured) < 1e-3, "%d: %g", which, difference(&plain, &textured));
        close_scene(&plain);
        close_scene(&textured);
    }
}

/* Left half alpha 0, right half 200 of 255, over black. */
static void test_alpha(void) {
    const uint8_t texels[] = {255, 255, 255, 0, 255, 255, 255, 200};
    const burnish_texture texture = {NULL, 2, 1, texels, 1};
    for (int mode = 0; mode < 3; ++mode) {
        scene s;
        burnish_material material = matt_material(1);
        material.alpha_mode = (burnish_alpha_mode)mode;
        material.alpha_cutoff = 0.5f;
        material.textures[BURNISH_TEXTURE_COLOR] = (burnish_texture_use){
            .texture = 1, .wrap = {BURNISH_WRAP_CLAMP, BURNISH_WRAP_CLAMP}, .is_nearest = 1};
        open_scene(&s, &material, &texture, 1, NULL);
        draw(&s);
        const float *row = s.pixels + 4 * SIZE * (SIZE / 2);
        const float left[] = {1, 0, 0}, right[] = {1, 1, 200 / 255.0f};
        CHECK(fabsf(row[4 * 8] - left[mode]) < 1e-5f && fabsf(row[4 * 56] - right[mode]) < 1e-5f,
              "mode %d: %g %g", mode, (double)row[4 * 8], (double)row[4 * 56]);
        close_scene(&s);
    }
}

/* Two squares of two materials. With coordinates 1, where v is u and u is v, the left one's colour,
 * which also masks, is what it is with the first coordinates and a transform that swaps them. Its
 * emission stays where it is. */
static void test_second_coordinates(void) {
    static const float places[] = {-1, -1, 0, 0, -1, 0, 0, 1, 0, -1, 1, 0,
                                   0,  -1, 0, 1, -1, 0, 1, 1, 0, 0,  1, 0};
    static const float first[] = {0, 0, 1, 0, 1, 1, 0, 1, 0, 0, 1, 0, 1, 1, 0, 1};
    static const float second[] = {0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1, 0};
    static const uint16_t numbers[] = {0, 0, 1, 1};
    static float pixels[2][SIZE * SIZE * 4];
    uint8_t texels[4 * 6 * 5];
    const burnish_texture texture = {"random", 6, 5, texels, 1};
    fill_random(texels, 30, 4);
    for (int i = 0; i < 30; i += 4) {
        texels[4 * i + 3] = 0;
    }
    for (int mode = 0; mode < 4; ++mode) {
        for (int way = 0; way < 2; ++way) {
            scene s;
            burnish_mesh_description arrays = describe_quads(places, NULL, 2);
            burnish_material materials[2] = {matt_material(1), matt_material(1)};
            const burnish_texture_use swapped = {.texture = 1,
                                                 .is_nearest = mode / 2,
                                                 .coordinates = way,
                                                 .has_transform = !way,
                                                 .transform = {0, !way, 0, !way, 0, 0}};
            materials[0].alpha_mode = mode % 2 ? BURNISH_ALPHA_MASK : BURNISH_ALPHA_BLEND;
            materials[0].alpha_cutoff = 0.5f;
            materials[0].emissive[0] = 0.5f;
            materials[0].textures[BURNISH_TEXTURE_COLOR] = swapped;
            materials[0].textures[BURNISH_TEXTURE_EMISSIVE].texture = 1;
            materials[1].textures[BURNISH_TEXTURE_COLOR].texture = 1;
            give_materials(&arrays, materials, 2);
            give_textures(&arrays, first, &texture, 1);
            arrays.triangle_materials = (burnish_array){numbers, 4, 0};
            arrays.second_coordinates = (burnish_array){second, 8, 0};
            s.mesh = create_mesh(&arrays, NULL);
            s.options = front_options(SIZE, SIZE, 2);
            s.options.samples = 4;
            light_evenly(&s.options);
            CHECK1(!burnish_mesh_get_view(s.mesh)->second_coordinates == !way);
            draw_floats(s.mesh, &s.options, pixels[way], NULL);
            close_scene(&s);
        }
        CHECK(memcmp(pixels[0], pixels[1], sizeof pixels[0]) == 0, "mode %d", mode);
    }
}

/* ---- Tangents ---- */

/* Two squares side by side, the right one's image mirrored: the seam's vertices part. */
static void test_tangents(void) {
    static const float positions[] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0};
    static const float mirrored[] = {0, 0, 1, 0, 0, 0, 0, 1, 1, 1, 0, 1};
    static const uint32_t indices[] = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
    const uint8_t texel[] = {128, 128, 255, 255};
    const burnish_texture texture = {NULL, 1, 1, texel, 0};
    burnish_mesh_description arrays = describe_arrays(positions, NULL, NULL, 6, indices, 4);
    burnish_material material = matt_material(1);
    material.textures[BURNISH_TEXTURE_NORMAL] = (burnish_texture_use){.texture = 1, .strength = 1};
    give_materials(&arrays, &material, 1);
    give_textures(&arrays, mirrored, &texture, 1);
    burnish_mesh *mesh = create_mesh(&arrays, NULL);
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    CHECK(view->vertex_count == 8 && view->tangents, "%zu vertices", view->vertex_count);
    for (size_t i = 0; i < 3 * view->triangle_count && view->tangents; ++i) {
        const float *t = view->tangents + 4 * view->indices[i];
        int is_right = 0;
        for (size_t k = i / 3 * 3; k < i / 3 * 3 + 3; ++k) {
            is_right |= view->positions[3 * view->indices[k]] > 1.5f;
        }
        const float side = is_right ? -1 : 1;
        CHECK(fabsf(t[0] - side) < 1e-6f && fabsf(t[1]) < 1e-6f && t[3] == side, "%g %g %g %g",
              (double)t[0], (double)t[1], (double)t[2], (double)t[3]);
    }
    burnish_mesh_destroy(mesh);
    arrays.texture_coordinates.items = NULL;
    arrays.texture_coordinates.count = 0;
    mesh = create_mesh(&arrays, NULL);
    CHECK1(!burnish_mesh_get_view(mesh)->tangents && burnish_mesh_get_warning_count(mesh) == 1 &&
           burnish_mesh_get_material(mesh, 0)->textures[BURNISH_TEXTURE_NORMAL].texture == 0);
    burnish_mesh_destroy(mesh);
}

/* An emissive texture alone, small pictures by several threads: the first that needs a part of the
 * texture makes it while others read. The thread sanitizer finds parts that are read unasked. */
static void test_emissive_threads(void) {
    enum { TEXELS = 64, PICTURES = 40 };
    static uint8_t texels[4 * TEXELS * TEXELS];
    const burnish_texture texture = {NULL, TEXELS, TEXELS, texels, 1};
    scene s;
    burnish_material material = matt_material(1);
    fill_random(texels, TEXELS * TEXELS, 77);
    material.textures[BURNISH_TEXTURE_EMISSIVE] =
        (burnish_texture_use){.texture = 1, .strength = 1};
    set_three(material.emissive, 1);
    open_scene(&s, &material, &texture, 1, NULL);
    s.options.camera = (burnish_camera){{0.9, -2.1, 1.1}, {0, 0, 0}, {0, 0, 1}, 50, 0};
    s.options.samples = 4;
    for (int i = 0; i < PICTURES; ++i) {
        uint64_t hashes[2] = {0, 1};
        s.options.width = s.options.height = 16 + 3 * i;
        for (int several = 0; several < 2; ++several) {
            s.options.threads = several ? 3 : 1;
            hashes[several] = hash_drawn(s.mesh, &s.options);
        }
        CHECK(hashes[0] == hashes[1], "%d pixels a side: other pixels by several threads",
              s.options.width);
    }
    close_scene(&s);
}

static void test_refused(void) {
    const uint8_t texel[4] = {0};
    burnish_texture texture = {NULL, 1, 1, texel, 0};
    burnish_mesh_description arrays = describe_quads(square, NULL, 1);
    burnish_load_options load = burnish_load_options_default();
    burnish_material material = matt_material(1);
    burnish_error error;
    burnish_mesh *mesh;
    give_materials(&arrays, &material, 1);
    give_textures(&arrays, coordinates, &texture, 1);
    material.textures[BURNISH_TEXTURE_COLOR].texture = 2;
    CHECK1(burnish_mesh_create(&arrays, &load, &mesh, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text,
               "materials[0]: textures[color].texture is 2; expected 1 to 1, or 0 for none");
    material.textures[BURNISH_TEXTURE_COLOR].texture = 1;
    material.textures[BURNISH_TEXTURE_COLOR].wrap[1] = 3;
    CHECK1(burnish_mesh_create(&arrays, &load, &mesh, &error) == BURNISH_STATUS_ARGUMENT);
    material.textures[BURNISH_TEXTURE_COLOR].wrap[1] = 0;
    material.textures[BURNISH_TEXTURE_COLOR].coordinates = 2;
    CHECK1(burnish_mesh_create(&arrays, &load, &mesh, &error) == BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "materials[0]: textures[color].coordinates is 2; expected 0 or 1");
    material.textures[BURNISH_TEXTURE_COLOR].coordinates = 1;
    mesh = create_mesh(&arrays, &load);
    CHECK1(burnish_mesh_get_warning_count(mesh) == 1 &&
           burnish_mesh_get_material(mesh, 0)->textures[BURNISH_TEXTURE_COLOR].texture == 0);
    CHECK1(burnish_mesh_set_material(mesh, 0, &material, &error) == BURNISH_STATUS_ARGUMENT);
    burnish_mesh_destroy(mesh);
    material.textures[BURNISH_TEXTURE_COLOR].coordinates = 0;
    texture.height = BURNISH_TEXTURE_SIZE_MAX + 1;
    CHECK1(burnish_mesh_create(&arrays, &load, &mesh, &error) == BURNISH_STATUS_ARGUMENT);
    texture.height = 1;
    load.max_texture_pixels = 0;
    CHECK1(burnish_mesh_create(&arrays, &load, &mesh, &error) == BURNISH_STATUS_LIMIT);
    load.max_texture_pixels = 1;
    load.ignore_textures = 1;
    mesh = create_mesh(&arrays, &load);
    CHECK1(burnish_mesh_get_texture_count(mesh) == 0 && !burnish_mesh_get_texture(mesh, 0));
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_perspective());
    RUN(test_levels_drawn());
    RUN(test_level_texels());
    RUN(test_level_kinds());
    RUN(test_blocks());
    RUN(test_normal_map());
    RUN(test_factors());
    RUN(test_alpha());
    RUN(test_second_coordinates());
    RUN(test_tangents());
    RUN(test_emissive_threads());
    RUN(test_refused());
    return test_end("texture");
}
