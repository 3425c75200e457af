/* Input of the contenders: cosines, a sphere, two large arrays. */
#include "bench/kernels/input.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { SPHERE_PIXELS = 256 };

static burnish_status fail_memory(burnish_error *error) {
    if (error) {
        static const char text[] = "bench: out of memory";
        error->status = BURNISH_STATUS_MEMORY;
        memcpy(error->text, text, sizeof text);
    }
    return BURNISH_STATUS_MEMORY;
}

/* Uniform in [0, 1], the same numbers every time. */
static void fill_cosines(burnish_bench_input *input) {
    uint32_t state = 2463534242u;
    for (int i = 0; i < BURNISH_BENCH_POINTS; ++i) {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        input->cosines[i] = (float)(state >> 8) * 0x1p-24f;
    }
    input->cosines[0] = 0.0f;
    input->cosines[BURNISH_BENCH_POINTS - 1] = 1.0f;
    for (int i = 0; i < BURNISH_BENCH_POINTS; ++i) {
        input->bright[i] = 1.0f - 0.09f * input->cosines[i]; /* zeta = 11 at n = 32 */
    }
    for (int i = 0; i < BURNISH_BENCH_TABLE_SIZE; ++i) {
        double c = (double)i / (BURNISH_BENCH_TABLE_SIZE - 1);
        input->table[i] = (float)pow(c, BURNISH_BENCH_EXPONENT);
    }
}

/* The unit sphere's points toward +z, in scan order; a partial last block is dropped. */
static burnish_status make_sphere(burnish_bench_input *input, burnish_error *error) {
    const size_t most = (size_t)SPHERE_PIXELS * SPHERE_PIXELS;
    float *xyz = malloc(3 * most * sizeof *xyz);
    size_t count = 0;
    for (int row = 0; xyz && row < SPHERE_PIXELS; ++row) {
        for (int column = 0; column < SPHERE_PIXELS; ++column) {
            double x = (column + 0.5) * 2 / SPHERE_PIXELS - 1;
            double y = 1 - (row + 0.5) * 2 / SPHERE_PIXELS;
            double squared = 1 - x * x - y * y;
            if (squared > 0) {
                xyz[3 * count] = (float)x;
                xyz[3 * count + 1] = (float)y;
                xyz[3 * count + 2] = (float)sqrt(squared);
                ++count;
            }
        }
    }
    input->blocks = count / BURNISH_BENCH_POINTS;
    count = input->blocks * BURNISH_BENCH_POINTS;
    input->normals = aligned_alloc(64, 3 * count * sizeof(float));
    input->positions = aligned_alloc(64, 3 * count * sizeof(float));
    if (!xyz || !input->normals || !input->positions) {
        free(xyz);
        return fail_memory(error);
    }
    for (size_t i = 0; i < count; ++i) {
        for (size_t k = 0; k < 3; ++k) {
            input->positions[k * count + i] = xyz[3 * i + k];
            input->normals[k * count + i] = 0.97f * xyz[3 * i + k]; /* as if interpolated */
        }
    }
    free(xyz);
    return BURNISH_STATUS_OK;
}

static burnish_status prepare(burnish_bench_input *input, int scene, int of, burnish_error *error) {
    static const float viewer[3] = {0.0f, 0.0f, 4.0f};
    static const double light[3] = {-2.0, 2.5, 3.0};
    burnish_kernels_lighting lighting = burnish_kernels_lighting_default();
    burnish_bench_shader *shader = &input->shaders[scene][of];
    if (scene == BURNISH_BENCH_POINT) {
        lighting.local_viewer = 1;
        lighting.lights[0].kind = BURNISH_LIGHT_POINT;
        memcpy(lighting.viewer, viewer, sizeof viewer);
        memcpy(lighting.lights[0].vector, light, sizeof light);
    }
    lighting.material.exponent = BURNISH_BENCH_EXPONENT;
    if (of == BURNISH_BENCH_OF_NONE) {
        memset(lighting.material.specular, 0, sizeof lighting.material.specular);
    } else if (of <= BURNISH_BENCH_OF_FAMILY_4) {
        lighting.lobe.order = of == BURNISH_BENCH_OF_FAMILY ? 2 : 4;
    } else {
        lighting.lobe.kind = BURNISH_LOBE_SCHLICK;
    }
    shader->table = input->table;
    burnish_kernels_shader *made;
    burnish_status status = burnish_kernels_shader_create(&lighting, NULL, &made, error);
    if (status == BURNISH_STATUS_OK) {
        shader->shader = *made;
        shader->light = made->lights[0];
        shader->shader.lights = &shader->light;
        burnish_kernels_shader_destroy(made);
    }
    return status;
}

/* Where the point light is, turned to the points. */
static void prepare_squares(burnish_kernels_polygon squares[BURNISH_BENCH_SQUARES]) {
    static const float corners[4][3] = {
        {-1.6f, 1.9f, 3.4f}, {-2.7f, 2.1f, 2.5f}, {-2.4f, 3.1f, 2.6f}, {-1.3f, 2.9f, 3.5f}};
    static const burnish_kernels_lobe wide = {4, 3, 1}, narrow = {4, 100, 1};
    static const burnish_kernels_lobe ggx[3] = {
        {4, 4.51f, 0.29f}, {2, 2.33f, 0.45f}, {1, 1.25f, 0.26f}};
    for (int i = 0; i < BURNISH_BENCH_SQUARES; ++i) {
        squares[i] = burnish_kernels_polygon_default();
        memcpy(squares[i].vertices, corners, sizeof corners);
        squares[i].is_two_sided = 1;
        squares[i].lobe_count = i == BURNISH_BENCH_SQUARE_GGX ? 3 : i > 0;
        memcpy(squares[i].lobes, ggx, sizeof ggx);
    }
    squares[BURNISH_BENCH_SQUARE_WIDE].lobes[0] = wide;
    squares[BURNISH_BENCH_SQUARE_NARROW].lobes[0] = narrow;
}

burnish_status burnish_bench_input_create(burnish_bench_input **made, burnish_error *error) {
    burnish_bench_input *input =
        aligned_alloc(64, (sizeof *input + 63) / 64 * 64); /* cosines and values are aligned */
    *made = input;
    if (!input) {
        return fail_memory(error);
    }
    memset(input, 0, sizeof *input);
    fill_cosines(input);
    burnish_status status = make_sphere(input, error);
    prepare_squares(input->squares);
    for (int i = 0; i < BURNISH_BENCH_SCENES * BURNISH_BENCH_OF_COUNT; ++i) {
        if (status == BURNISH_STATUS_OK) {
            status = prepare(input, i / BURNISH_BENCH_OF_COUNT, i % BURNISH_BENCH_OF_COUNT, error);
        }
    }
    if (status != BURNISH_STATUS_OK) {
        burnish_bench_input_destroy(input);
        *made = NULL;
    }
    return status;
}

static float *map(size_t bytes) {
    void *place = mmap(NULL, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (place == MAP_FAILED) {
        return NULL;
    }
#if defined(MADV_HUGEPAGE)
    (void)madvise(place, bytes,
                  MADV_HUGEPAGE); /* fewer translations, if the kernel supports them */
#endif
    return place;
}

void burnish_bench_input_map(burnish_bench_input *input, size_t bytes) {
    input->source = map(bytes);
    input->destination = map(bytes);
    if (!input->source || !input->destination) {
        if (input->source) {
            munmap(input->source, bytes);
        }
        if (input->destination) {
            munmap(input->destination, bytes);
        }
        return;
    }
    input->array_bytes = bytes;
    for (size_t i = 0; i < bytes / sizeof(float); i += BURNISH_BENCH_POINTS) {
        memcpy(input->source + i, input->cosines, sizeof input->cosines);
        memcpy(input->destination + i, input->cosines, sizeof input->cosines);
    }
}

void burnish_bench_input_destroy(burnish_bench_input *input) {
    if (!input) {
        return;
    }
    if (input->array_bytes > 0) {
        munmap(input->source, input->array_bytes);
        munmap(input->destination, input->array_bytes);
    }
    free(input->normals);
    free(input->positions);
    free(input);
}

burnish_kernels_points burnish_bench_block(const burnish_bench_input *input, size_t block) {
    const size_t all = input->blocks * BURNISH_BENCH_POINTS, first = block * BURNISH_BENCH_POINTS;
    burnish_kernels_points points;
    memset(&points, 0, sizeof points);
    for (size_t k = 0; k < 3; ++k) {
        points.normal[k] = input->normals + k * all + first;
        points.position[k] = input->positions + k * all + first;
    }
    return points;
}
