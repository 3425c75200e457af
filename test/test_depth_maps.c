/* Many depth maps at once, whose small triangles skip lists and tiles, against maps one by one. */
#include "render/depth_map.h"

#include "burnish/kernels.h"
#include "render/occlusion.h"
#include "simd/isa_ops.h"
#include "support.h"

enum { MAPS_LARGE = 3, SIZE_LARGE = 256, TRIANGLES = 300 };

typedef struct soup {
    float positions[9 * TRIANGLES];
    uint32_t indices[3 * TRIANGLES];
    uint16_t transparent[TRIANGLES / BURNISH_BATCH_SIZE + 1];
    burnish_mesh_view mesh;
} soup;

/* Triangles of several sizes around random places of a box; some share edges, some are flat, some
 * have a vertex twice. */
static void make_soup(soup *made, size_t count, uint64_t *state) {
    static const float sizes[] = {0.003f, 0.02f, 0.06f, 0.2f, 0.5f, 1};
    float size = sizes[test_random32(state) % 6];
    memset(made, 0, sizeof *made);
    for (size_t t = 0; t < count; ++t) {
        float *p = made->positions + 9 * t, center[3];
        size = test_random32(state) % 8 ? size : sizes[test_random32(state) % 6];
        for (int k = 0; k < 3; ++k) {
            center[k] = test_uniform_float(state, size - 1, 1 - size);
        }
        for (int i = 0; i < 9; ++i) {
            p[i] = center[i % 3] + test_uniform_float(state, -size, size);
        }
        if (t > 0 && test_random32(state) % 3 == 0) {
            memcpy(p, p - 3, 3 * sizeof *p);
            memcpy(p + 3, p - 6, 3 * sizeof *p);
        }
        for (uint32_t i = 0; i < 3; ++i) {
            made->indices[3 * t + i] = (uint32_t)(3 * t) + i;
        }
        if (test_random32(state) % 30 == 0) {
            made->indices[3 * t + 1] = made->indices[3 * t];
        }
        if (test_random32(state) % 5 == 0) {
            made->transparent[t / BURNISH_BATCH_SIZE] |= (uint16_t)(1 << t % BURNISH_BATCH_SIZE);
        }
    }
    made->mesh = (burnish_mesh_view){.vertex_count = 3 * count,
                                     .triangle_count = count,
                                     .positions = made->positions,
                                     .indices = made->indices,
                                     .bounds_min = {-1, -1, -1},
                                     .bounds_max = {1, 1, 1}};
}

/* One that this processor has. */
static burnish_isa pick_isa(uint64_t *state) {
    uint32_t isa;
    do {
        isa = test_random32(state) % 32;
    } while (!(burnish_isa_available() >> isa & 1));
    return (burnish_isa)isa;
}

typedef struct map_run {
    burnish_status status;
    burnish_error error;
    uint16_t depths[MAPS_LARGE * SIZE_LARGE * SIZE_LARGE];
} map_run;

/* One by one by scalar code, or all at once. */
static void draw(const soup *from, burnish_map_drawer *drawer, const burnish_map_view *views,
                 int count, int at_once, burnish_isa isa, int threads, map_run *run) {
    const size_t texels = (size_t)views->size * (size_t)views->size;
    const burnish_isa_ops *ops = burnish_isa_ops_for(isa);
    burnish_tasks tasks;
    burnish_memory memory = burnish_memory_of(NULL, &run->error);
    burnish_tasks_begin(&tasks, NULL, threads);
    memset(run, 0, sizeof *run);
    if (at_once) {
        memset(run->depths, 0x55, sizeof run->depths);
        run->status = burnish_maps_draw(drawer, ops, &from->mesh, views, count, run->depths, texels,
                                        &tasks, &memory);
        memset(run->depths + (size_t)count * texels, 0,
               sizeof run->depths - (size_t)count * texels * sizeof *run->depths);
        return;
    }
    for (int i = 0; i < count && run->status == BURNISH_STATUS_OK; ++i) {
        run->status = burnish_map_draw(drawer, ops, &from->mesh, &views[i],
                                       run->depths + (size_t)i * texels, &tasks, &memory);
    }
}

static void check_soup(const soup *from, const burnish_map_view *views, int count,
                       burnish_map_drawer *drawer, uint64_t *state, const char *what) {
    static map_run plain, run;
    draw(from, drawer, views, count, 0, BURNISH_ISA_SCALAR, 1, &plain);
    const burnish_isa isa = pick_isa(state);
    draw(from, drawer, views, count, 1, isa, 1 + (int)(test_random32(state) % 2), &run);
    CHECK(run.status == plain.status && strcmp(run.error.text, plain.error.text) == 0,
          "%s: %s: \"%s\" instead of \"%s\"", what, burnish_isa_name(isa), run.error.text,
          plain.error.text);
    if (plain.status == BURNISH_STATUS_OK) {
        CHECK(memcmp(run.depths, plain.depths, sizeof plain.depths) == 0, "%s: %s: depths differ",
              what, burnish_isa_name(isa));
    }
}

static void test_soups(void) {
    static soup made;
    burnish_map_drawer drawer = {.max_overdraw = 1e9};
    uint64_t state = test_seed(74);
    for (int i = 0; i < 400; ++i) {
        const int count = 1 + (int)(test_random32(&state) % MAPS_LARGE);
        const int first = (int)(test_random32(&state) % 60), size = i % 3 ? 128 : SIZE_LARGE;
        burnish_map_view views[MAPS_LARGE];
        make_soup(&made, 1 + test_random32(&state) % TRIANGLES, &state);
        for (int k = 0; k < count; ++k) {
            views[k] = burnish_occlusion_view(first + k, 64, size);
        }
        drawer.transparent = i % 4 == 0 ? made.transparent : NULL;
        drawer.max_overdraw = 1e9;
        check_soup(&made, views, count, &drawer, &state, "inside");
        if (i % 5 == 0) { /* as positions that no triangle uses may be */
            for (int k = 0; k < 3; ++k) {
                made.mesh.bounds_min[k] = -0.4f;
                made.mesh.bounds_max[k] = 0.4f;
            }
            check_soup(&made, views, count, &drawer, &state, "outside");
        }
    }
    burnish_map_drawer_destroy(&drawer, NULL);
}

/* What is counted of small and large triangles is the same: the same limit, the same line. */
static void test_overdraw(void) {
    static soup made;
    burnish_map_drawer drawer = {0};
    uint64_t state = test_seed(75);
    int refused = 0;
    for (int i = 0; i < 100; ++i) {
        static map_run run;
        const burnish_map_view views[2] = {burnish_occlusion_view(i % 64, 64, 128),
                                           burnish_occlusion_view((i + 1) % 64, 64, 128)};
        make_soup(&made, TRIANGLES, &state);
        drawer.transparent = i % 4 == 0 ? made.transparent : NULL;
        drawer.max_overdraw = 1 << test_random32(&state) % 10;
        check_soup(&made, views, 2, &drawer, &state, "limit");
        draw(&made, &drawer, views, 2, 1, BURNISH_ISA_SCALAR, 1, &run);
        refused += run.status == BURNISH_STATUS_LIMIT;
    }
    CHECK(refused > 20 && refused < 80, "%d of 100 were refused", refused);
    burnish_map_drawer_destroy(&drawer, NULL);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_soups());
    RUN(test_overdraw());
    return test_end("depth_maps");
}
