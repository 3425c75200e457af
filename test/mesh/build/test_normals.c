/* Generated normals of a mesh large enough that several threads make its vertices: the arrays do
 * not depend on the threads, and their bits are pinned. */
#include "burnish/mesh.h"
#include "mesh_arrays.h"
#include "support.h"

enum { SIDE = 200, CELLS = (SIDE - 1) * (SIDE - 1), CORNERS = 6 * CELLS };

static float heights[SIDE * SIDE], soup[3 * CORNERS];
static uint32_t corners[CORNERS];

/* 40,000 positions of a landscape with cliffs: some of its edges are sharp, some smooth. The seed
 * is fixed, the hashes below depend on it. */
static void make_soup(void) {
    uint64_t state = 1;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        heights[i] = (float)(test_random32(&state) % 1024) * (i / 7 % 5 ? 0x1p-10f : 0x1p-7f);
    }
    for (uint32_t i = 0; i < CORNERS; ++i) {
        static const uint32_t steps[6][2] = {{0, 0}, {1, 0}, {0, 1}, {1, 0}, {1, 1}, {0, 1}};
        const uint32_t x = i / 6 % (SIDE - 1) + steps[i % 6][0];
        const uint32_t y = i / 6 / (SIDE - 1) + steps[i % 6][1];
        soup[3 * i] = (float)x;
        soup[3 * i + 1] = (float)y;
        soup[3 * i + 2] = heights[SIDE * y + x];
        corners[i] = i;
    }
}

/* FNV-1a over 32-bit words by value: the same in any byte order. */
static uint64_t hash_words(uint64_t hash, const void *words, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        uint32_t word;
        memcpy(&word, (const char *)words + 4 * i, sizeof word);
        for (int k = 0; k < 32; k += 8) {
            hash = (hash ^ (word >> k & 255)) * UINT64_C(0x100000001B3);
        }
    }
    return hash;
}

static void check_angle(double crease, size_t vertices, uint64_t expected) {
    static const int threads[] = {1, 2, 7};
    for (int t = 0; t < 3; ++t) {
        burnish_load_options options = burnish_load_options_default();
        const burnish_mesh_description arrays =
            describe_arrays(soup, NULL, NULL, CORNERS, corners, CORNERS / 3);
        options.crease_angle = crease;
        options.threads = threads[t];
        OWNED_MESH *mesh = create_mesh(&arrays, &options);
        if (!mesh) {
            return;
        }
        const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
        uint64_t hash =
            hash_words(UINT64_C(0xCBF29CE484222325), view->positions, 3 * view->vertex_count);
        hash = hash_words(hash, view->normals, 3 * view->vertex_count);
        hash = hash_words(hash, view->indices, 3 * view->triangle_count);
        CHECK(view->vertex_count == vertices && view->triangle_count == CORNERS / 3,
              "crease %g, %d threads: %zu vertices", crease, threads[t], view->vertex_count);
        CHECK(hash == expected, "crease %g, %d threads: hash %#llx", crease, threads[t],
              (unsigned long long)hash);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    make_soup();
    RUN(check_angle(180, SIDE * SIDE, 0x1c3fcfdb206b0a10));
    RUN(check_angle(60, 68655, 0xb851ec01caef9274));
    RUN(check_angle(20, 164818, 0xe4dad2cab897062d));
    return test_end("normals");
}
