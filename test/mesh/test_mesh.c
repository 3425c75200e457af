/* Meshes from triangles: generated normals, orientation, order. */
#include <math.h>

#include "burnish/mesh.h"
#include "mesh/build/normals/fans.h"
#include "mesh_arrays.h"
#include "sheet.h"

/* A unit cube's corners (bit k of the number is coordinate k) and its faces, from outside. */
static const uint32_t cube_faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                          {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

/* The cube's 36 corner numbers; bit f of turned cuts face f along its other diagonal. */
static void cube_corners(uint32_t corners[36], int turned) {
    for (int f = 0; f < 6; ++f) {
        int s = turned >> f & 1;
        for (int k = 0; k < 6; ++k) {
            static const int order[6] = {0, 1, 2, 0, 2, 3};
            corners[6 * f + k] = cube_faces[f][(order[k] + s) % 4];
        }
    }
}

static void cube_point(uint32_t number, float p[3]) {
    for (int k = 0; k < 3; ++k) {
        p[k] = (number >> k & 1) ? 1.0f : -1.0f;
    }
}

/* Must succeed. */
static burnish_mesh *create(burnish_mesh_description arrays, double crease) {
    burnish_load_options options = burnish_load_options_default();
    options.crease_angle = crease;
    return create_mesh(&arrays, &options);
}

/* The cube as in an STL file: nothing shared. */
static burnish_mesh *soup(double crease, int turned) {
    burnish_mesh_description arrays = burnish_mesh_description_default();
    uint32_t corners[36];
    float positions[3 * 36];
    cube_corners(corners, turned);
    for (uint32_t i = 0; i < 36; ++i) {
        cube_point(corners[i], positions + 3 * i);
    }
    arrays.positions = (burnish_array){positions, 36, 0};
    return create(arrays, crease);
}

/* The mesh of plain positions and indices. */
static burnish_mesh *plain(const float *positions, size_t vertex_count, const uint32_t *indices,
                           size_t triangle_count, double crease) {
    return create(describe_arrays(positions, NULL, NULL, vertex_count, indices, triangle_count),
                  crease);
}

static int near(const float *v, double x, double y, double z, double bound) {
    return fabs((double)v[0] - x) <= bound && fabs((double)v[1] - y) <= bound &&
           fabs((double)v[2] - z) <= bound;
}

static void test_cube(void) {
    for (int turned = 0; turned < 64; ++turned) {
        burnish_mesh *flat = soup(40, turned), *smooth = soup(180, turned);
        const burnish_mesh_view *view = burnish_mesh_get_view(flat);
        CHECK(view->vertex_count == 24 && view->triangle_count == 12, "%zu", view->vertex_count);
        for (size_t i = 0; i < 36; ++i) {
            const float *n = view->normals + 3 * view->indices[i];
            const float *p = view->positions + 3 * view->indices[i];
            CHECK(fabsf(n[0]) + fabsf(n[1]) + fabsf(n[2]) == 1 &&
                      n[0] * p[0] + n[1] * p[1] + n[2] * p[2] == 1,
                  "not a face's normal");
        }
        /* Smooth: one vertex a corner, along the diagonal however the faces are cut. */
        view = burnish_mesh_get_view(smooth);
        CHECK(view->vertex_count == 8, "%zu", view->vertex_count);
        for (size_t i = 0; i < view->vertex_count; ++i) {
            const float *p = view->positions + 3 * i;
            double third = sqrt(1 / 3.0);
            CHECK(near(view->normals + 3 * i, third * (double)p[0], third * (double)p[1],
                       third * (double)p[2], 1e-7),
                  "cut %d", turned);
        }
        CHECK1(view->bounds_min[1] == -1 && view->bounds_max[2] == 1);
        CHECK1(view->colors == NULL && view->triangle_materials == NULL);
        CHECK1(burnish_mesh_get_info(smooth)->format == BURNISH_FORMAT_ARRAYS);
        burnish_mesh_destroy(flat);
        burnish_mesh_destroy(smooth);
    }
    /* The edge of a cube is exactly 90 degrees: not smooth at a crease angle of 90, at 91 it is. */
    const double crease[3] = {0, 90, 91};
    const size_t vertices[3] = {24, 24, 8};
    for (int i = 0; i < 3; ++i) {
        OWNED_MESH *mesh = soup(crease[i], 21);
        CHECK(burnish_mesh_get_view(mesh)->vertex_count == vertices[i], "%g: %zu", crease[i],
              burnish_mesh_get_view(mesh)->vertex_count);
    }
}

/* A cone of 200,000 sides: the hub's faces are joined in a ring. Then as many faces on one edge. */
static void test_large_fan(void) {
    const uint32_t count = 200000;
    float *positions = malloc(3 * (count + 2) * sizeof *positions);
    uint32_t *indices = malloc(3 * count * sizeof *indices);
    for (uint32_t i = 0; i < count; ++i) {
        double angle = 2 * acos(-1.0) * i / count;
        positions[3 * i] = (float)cos(angle);
        positions[3 * i + 1] = (float)sin(angle);
        positions[3 * i + 2] = 0;
        memcpy(indices + 3 * i, (uint32_t[]){count, i, (i + 1) % count}, 12);
    }
    memcpy(positions + 3 * count, (float[]){0, 0, 1, 0, 0, -1}, 6 * sizeof(float));
    burnish_mesh *mesh = plain(positions, count + 2, indices, count, 40);
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    CHECK(view->vertex_count == count + 1, "%zu", view->vertex_count);
    CHECK(view->vertex_count > 0 && near(view->positions, 0, 0, 1, 0) &&
              near(view->normals, 0, 0, 1, 1e-6),
          "%g %g %g", (double)view->normals[0], (double)view->normals[1], (double)view->normals[2]);
    CHECK1(burnish_mesh_get_warning_count(mesh) == 0);
    burnish_mesh_destroy(mesh);

    for (uint32_t i = 0; i < count; ++i) {
        memcpy(indices + 3 * i, (uint32_t[]){count, count + 1, i}, 12);
    }
    mesh = plain(positions, count + 2, indices, count, 40);
    view = burnish_mesh_get_view(mesh);
    CHECK1(view->triangle_count == count);
    /* Neighbours are joined into several groups, none of which is closed. At the outer end each
     * face has one vertex, and at the edge's ends each group has one. */
    CHECK(view->vertex_count > count + 2 && view->vertex_count < count + 200, "all around: %zu",
          view->vertex_count);
    burnish_mesh_destroy(mesh);
    free(positions);
    free(indices);
}

/* Sheets that are in the file twice, once per side, are smooth on both sides. */
static void test_double_sided(void) {
    const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0.1f, 1, 1, 0};
    const uint32_t indices[] = {0, 1, 2, 0, 2, 1, 1, 3, 2, 1, 2, 3};
    OWNED_MESH *mesh = plain(positions, 4, indices, 4, 40);
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    CHECK(view->vertex_count == 8, "%zu", view->vertex_count);
    for (int k = 0; k < 12; ++k) {
        float z = view->normals[3 * view->indices[k] + 2];
        CHECK((k / 3 % 2 == 0) == (z > 0), "corner %d: %g", k, (double)z);
    }
}

static void test_zero_area(void) {
    const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 0, 0, -0.0f, 9, 9, 9};
    /* good; on a line; index twice; position twice; -0 is 0; good */
    const uint32_t indices[] = {0, 1, 2, 0, 1, 3, 1, 1, 2, 0, 0, 0, 0, 4, 1, 4, 3, 2};
    burnish_mesh *mesh = plain(positions, 6, indices, 6, 40);
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    CHECK(view->triangle_count == 2 && view->vertex_count == 4, "%zu", view->vertex_count);
    CHECK1(near(view->positions + 3 * view->indices[4], 2, 0, 0, 0));
    CHECK1(view->bounds_max[0] == 2 && view->bounds_max[2] == 0);
    CHECK1(burnish_mesh_get_warning_count(mesh) == 1);
    CHECK_TEXT(burnish_mesh_get_warning(mesh, 0),
               "mesh: 4 of 6 triangles have no area and were left out");
    CHECK1(burnish_mesh_get_warning(mesh, 1) == NULL);
    burnish_mesh_destroy(mesh);

    burnish_error error;
    const burnish_load_options options = burnish_load_options_default();
    const burnish_mesh_description flat = describe_arrays(positions, NULL, NULL, 6, indices + 3, 4);
    mesh = (burnish_mesh *)&error;
    CHECK1(burnish_mesh_create(&flat, &options, &mesh, &error) == BURNISH_STATUS_FORMAT);
    CHECK1(mesh == NULL && error.status == BURNISH_STATUS_FORMAT);
    CHECK(strstr(error.text, "mesh: no triangle has any area; 4 triangles"), "%s", error.text);
}

/* Coordinates at both ends of float: nothing overflows or vanishes. */
static void test_extreme_sizes(void) {
    const float sizes[] = {3e38f, 1e-45f, 1e-38f, 1};
    const uint32_t indices[] = {0, 1, 2};
    for (int i = 0; i < 4; ++i) {
        float s = sizes[i];
        const float positions[] = {-s, 0, 0, s, 0, 0, 0, s, 0};
        OWNED_MESH *mesh = plain(positions, 3, indices, 1, 40);
        CHECK(near(burnish_mesh_get_view(mesh)->normals, 0, 0, 1, 0), "%g", (double)s);
    }
}

static void test_given_normals(void) {
    const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    /* Any length; opposite to the first triangle's winding; one 0 and one NaN. */
    const float normals[] = {0, -1e-30f, -1e-30f, 0, 0, -3e38f, 0, 0, 0, NAN, 0, 1};
    const uint32_t indices[] = {0, 1, 2, 1, 3, 2};
    OWNED_MESH *mesh = create(describe_arrays(positions, normals, NULL, 4, indices, 2), 40);
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    const float *n = view->normals;
    /* Both triangles are turned, and the made normals follow. */
    CHECK(view->vertex_count == 4, "%zu", view->vertex_count);
    CHECK1(near(view->positions + 3 * view->indices[1], 0, 1, 0, 0));
    CHECK1(near(view->positions + 3 * view->indices[4], 0, 1, 0, 0));
    CHECK1(near(n + 3 * view->indices[0], 0, -sqrt(0.5), -sqrt(0.5), 1e-7));
    CHECK1(near(n + 3 * view->indices[1], 0, 0, -1, 0));
    CHECK1(near(n + 3 * view->indices[2], 0, 0, -1, 0));
    CHECK1(near(n + 3 * view->indices[5], 0, 0, -1, 0));
}

/* A flat cone: its tip has as many normals in the file as the cone has sides. */
static void test_many_normals(void) {
    enum { MOST = 100 };
    for (uint32_t sides = 3; sides <= MOST; ++sides) {
        float positions[9 * MOST], normals[9 * MOST];
        uint32_t indices[3 * MOST];
        for (uint32_t i = 0; i < sides; ++i) {
            const double step = 6.283185307179586 / sides, middle = (i + 0.5) * step;
            for (uint32_t k = 0; k < 3; ++k) {
                const double angle = k == 1 ? i * step : (i + 1) % sides * step;
                float *p = positions + 9 * i + 3 * k, *n = normals + 9 * i + 3 * k;
                p[0] = 10 + (k == 0 ? 0 : (float)cos(angle));
                p[1] = 10 + (k == 0 ? 0 : (float)sin(angle));
                p[2] = k == 0 ? 11 : 10;
                n[0] = (float)cos(middle);
                n[1] = (float)sin(middle);
                n[2] = 1;
                indices[3 * i + k] = 3 * i + k;
            }
        }
        OWNED_MESH *mesh =
            create(describe_arrays(positions, normals, NULL, 3 * sides, indices, sides), 40);
        const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
        CHECK(view->vertex_count == 3 * sides, "%u sides: %zu vertices", sides, view->vertex_count);
        CHECK(near(view->bounds_min, 9.5, 9.5, 10, 0.501) && view->bounds_max[2] == 11,
              "%u sides: bounds from %g, %g, %g to z = %g", sides, (double)view->bounds_min[0],
              (double)view->bounds_min[1], (double)view->bounds_min[2],
              (double)view->bounds_max[2]);
    }
}

/* An OBJ whose corners name positions, normals and texture coordinates at random, several of them
 * equal; tail: what follows each position. */
static burnish_mesh *load_named(const char *tail, size_t triangles) {
    enum { POSITIONS = 60, NORMALS = 12, TEXCOORDS = 9 };
    static const int names[3] = {POSITIONS, TEXCOORDS, NORMALS};
    uint64_t state = test_seed(5);
    file_bytes text = {0};
    for (int i = 0; i < POSITIONS; ++i) {
        say(&text, "v %d %d %d%s\n", i % 5, i / 5 % 4, i / 20, tail);
    }
    for (int i = 0; i < NORMALS; ++i) {
        say(&text, "vn %d %d 1\n", i % 3, i % 2);
    }
    for (int i = 0; i < TEXCOORDS; ++i) {
        say(&text, "vt 0.%d 0.5\n", i % 4);
    }
    for (size_t i = 0; i < triangles; ++i) {
        say(&text, "f");
        for (int k = 0; k < 9; ++k) {
            say(&text, "%c%u", k % 3 ? '/' : ' ',
                1 + test_random32(&state) % (uint32_t)names[k % 3]);
        }
        say(&text, "\n");
    }
    burnish_load_options options = burnish_load_options_default();
    options.keep_texture_coordinates = 1;
    burnish_mesh *mesh = load_bytes(text.bytes, text.size, "named.obj", &options);
    free(text.bytes);
    return mesh;
}

/* Vertices found by numbers equal those found by values, the method for meshes with colours. */
static void test_named_vertices(void) {
    for (size_t triangles = 20; triangles <= 20000; triangles *= 10) {
        OWNED_MESH *by_numbers = load_named("", triangles);
        OWNED_MESH *by_values = load_named(" 1 1 1", triangles);
        const burnish_mesh_view *a = burnish_mesh_get_view(by_numbers);
        const burnish_mesh_view *b = burnish_mesh_get_view(by_values);
        const size_t count = a->vertex_count;
        CHECK(count == b->vertex_count && a->triangle_count == b->triangle_count && !a->colors &&
                  b->colors,
              "%zu and %zu vertices", count, b->vertex_count);
        CHECK1(memcmp(a->indices, b->indices, a->triangle_count * 12) == 0);
        CHECK1(memcmp(a->positions, b->positions, count * 12) == 0);
        CHECK1(memcmp(a->normals, b->normals, count * 12) == 0);
        CHECK1(memcmp(a->texture_coordinates, b->texture_coordinates, count * 8) == 0);
    }
}

/* Sets of a few faces and of any number are the same. */
static int joins_the_same(burnish_rings *rings, size_t faces, int *crowded) {
    uint32_t sets[BURNISH_SETS_MAX], seen = 0;
    const size_t count = burnish_join_few(rings, 0, faces, sets);
    const int one = burnish_join_many(rings, 0, faces);
    *crowded += count == 0;
    for (size_t k = 0; k < count; ++k) {
        for (uint32_t i = 0; i < faces; ++i) {
            const int is_in = (int)(sets[k] >> i & 1);
            const uint32_t first = (uint32_t)__builtin_ctz(sets[k]);
            if (is_in != (burnish_find_root(rings->parents, i) == first)) {
                return 0;
            }
        }
        seen += (uint32_t)__builtin_popcount(sets[k]);
    }
    return count == 0 || (seen == faces && one == (count == 1));
}

/* The error of a triangle's angle at a corner, against the C library. */
static double angle_error(const float *positions, const uint32_t *triangle, size_t corner,
                          double angle) {
    long double a[3], b[3], dot = 0, cross = 0;
    for (size_t k = 0; k < 3; ++k) {
        const long double here = positions[3 * triangle[corner] + k];
        a[k] = positions[3 * triangle[(corner + 1) % 3] + k] - here;
        b[k] = positions[3 * triangle[(corner + 2) % 3] + k] - here;
        dot += a[k] * b[k];
    }
    for (size_t k = 0; k < 3; ++k) {
        const long double side = a[k] * b[(k + 1) % 3] - a[(k + 1) % 3] * b[k];
        cross += side * side;
    }
    return (double)fabsl(angle - atan2l(sqrtl(cross), dot));
}

/* Whether a vertex has the normal that it gets together with others. */
static int fans_agree(const burnish_rings *rings, size_t faces, int common, const float *normal) {
    burnish_fans fans;
    if (faces > BURNISH_PAIRWISE_MAX) {
        return 1;
    }
    burnish_fans_normals(&fans, rings, (const uint32_t[]){0, 0, 0}, 3, faces);
    for (int v = 0; v < 3; ++v) {
        const float made[] = {fans.normals[0][v], fans.normals[1][v], fans.normals[2][v]};
        if ((int)fans.is_one[v] != common || (common && memcmp(made, normal, sizeof made) != 0)) {
            return 0;
        }
    }
    return 1;
}

/* The number of faces compared at once does not change the bits of normals,
 * and sets do not depend on how they are found: fans with and without gaps, flat and jagged, of few
 * and of many faces. */
static void test_wide_fans(void) {
    enum { MOST = 40, ROUNDS = 20000 };
    burnish_rings rings;
    burnish_memory memory = burnish_memory_of(NULL, NULL);
    int different = 0, apart = 0, wrong = 0, crowded = 0, differing_fans = 0;
    double off = 0;
    uint64_t state = test_seed(4);
    const uint32_t isas = burnish_isa_available();
    const int wide = (int)(isas >> BURNISH_ISA_AVX2 & 1) + (int)(isas >> BURNISH_ISA_AVX512 & 1);
    burnish_rings_create(&rings, MOST, 60, NULL, wide, &memory);
    if (!CHECK1(memory.status == BURNISH_STATUS_OK)) {
        return;
    }
    for (int round = 0; round < ROUNDS; ++round) {
        size_t faces = 1 + test_random32(&state) % (round % 2 ? MOST : 10);
        const uint32_t often = round % 8 < 4 ? 8 : 2; /* faces at one edge */
        float positions[3 * (MOST + 2)], normals[3][3 * MOST];
        uint32_t triangles[3 * MOST], corners[MOST];
        int common[3];
        for (size_t i = 0; i < 3 * (MOST + 2); ++i) {
            positions[i] = (float)(test_random32(&state) % 2001) / 1000 - 1;
            positions[i] *= i % 3 == 2 && round % 2 ? 0.1f : 1;
        }
        for (size_t i = 0; i < faces; ++i) {
            uint32_t at = test_random32(&state) % 3, first = 1 + (uint32_t)i,
                     second = 2 + (uint32_t)i;
            second = i + 1 == faces && round % 3 ? 1 : second; /* closed, or an edge is free */
            triangles[3 * i + at] = 0;
            triangles[3 * i + (at + 1) % 3] = test_random32(&state) % often ? first : 1;
            second = second == triangles[3 * i + (at + 1) % 3] ? MOST + 1 : second;
            triangles[3 * i + (at + 2) % 3] = second;
            corners[i] = (uint32_t)(3 * i) + at;
        }
        const burnish_surface surface = {
            .positions = positions, .corner_positions = triangles, .corners = corners};
        rings.asks = round / 8 % 2; /* never, as no edge is in between */
        memset(normals, 0, sizeof normals);
        for (int k = 0; k < 3; ++k) {
            rings.surface = &surface;
            rings.wide = k < wide ? k : wide;
            burnish_rings_measure(&rings, corners, faces);
            for (size_t i = 0; i < faces; ++i) {
                off = fmax(off, angle_error(positions, triangles + 3 * i, corners[i] % 3,
                                            rings.angles[i]));
            }
            common[k] = burnish_rings_normals(&rings, 0, faces, normals[k]);
            differing_fans += !fans_agree(&rings, faces, common[k], normals[k]);
            if (faces <= BURNISH_SETS_MAX) {
                wrong += !joins_the_same(&rings, faces, &crowded);
            }
        }
        for (int k = 1; k < 3; ++k) {
            different +=
                common[0] != common[k] || memcmp(normals[0], normals[k], sizeof *normals) != 0;
        }
        apart += !common[0];
    }
    CHECK(off < 8e-16, "angles are off by %g", off);
    CHECK(different == 0, "%d of %d fans have other normals", different, ROUNDS);
    CHECK(differing_fans == 0, "%d of %d fans have other normals alone", differing_fans,
          3 * ROUNDS);
    CHECK(wrong == 0, "%d of %d fans have other sets", wrong, 3 * ROUNDS);
    CHECK(crowded > ROUNDS / 20 && crowded < ROUNDS, "%d fans have an edge of many faces", crowded);
    CHECK(apart > ROUNDS / 20 && apart < ROUNDS - ROUNDS / 20, "%d of %d fans are apart", apart,
          ROUNDS);
    burnish_rings_destroy(&rings, NULL);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_cube());
    RUN(test_large_fan());
    RUN(test_wide_fans());
    RUN(test_double_sided());
    RUN(test_zero_area());
    RUN(test_extreme_sizes());
    RUN(test_given_normals());
    RUN(test_many_normals());
    RUN(test_named_vertices());
    return test_end("mesh");
}
