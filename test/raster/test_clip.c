/* Cuts: volumes against closed forms and against each other, edges that stay closed, attributes;
 * caps: where they are drawn, their depth and normal, their area. */
#include <math.h>

#include "counting_context.h"
#include "mesh/edges.h"
#include "pictures.h"
#include "shapes.h"

static burnish_mesh *load(const char *name) {
    return load_measured(name, 12);
}

static burnish_clip_plane plane_of(double x, double y, double z, double offset) {
    return (burnish_clip_plane){{x, y, z}, offset};
}

/* ---- Volumes ---- */

/* The volume of what a cut left: seen from a point of the planes a cap adds nothing. */
static double volume_from(const burnish_mesh *mesh, const double from[3]) {
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    double sum = 0;
    for (size_t i = 0; i < view->triangle_count; ++i) {
        double p[3][3];
        for (size_t k = 0; k < 9; ++k) {
            p[k / 3][k % 3] =
                (double)view->positions[3 * (size_t)view->indices[3 * i + k / 3] + k % 3] -
                from[k % 3];
        }
        sum += p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) +
               p[0][1] * (p[1][2] * p[2][0] - p[1][0] * p[2][2]) +
               p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
    }
    return sum / 6;
}

static burnish_mesh *make_box(int is_inside_out, const uint8_t *colors,
                              const burnish_context *context) {
    shape s = box_at(-1, -2, -3, 2, 4, 6);
    burnish_load_options options = burnish_load_options_default();
    for (size_t i = 0; i < s.triangle_count && is_inside_out; ++i) {
        turn(&s, i);
    }
    const burnish_mesh_description arrays =
        describe_arrays(s.points, NULL, colors, 8, s.corners, 12);
    options.measure = 1;
    options.context = context;
    return create_mesh(&arrays, &options);
}

/* Half-spaces on both sides of any plane share a solid: their parts add up. A ball's is known. */
static void test_halves(void) {
    static const char *const names[] = {":sphere", ":torus", ":knot"};
    uint64_t state = test_seed(1);
    for (int i = 0; i < 30; ++i) {
        burnish_mesh *whole = load(names[i % 3]), *other = load(names[i % 3]);
        const double volume = burnish_mesh_get_facts(whole)->volume;
        double n[3], offset = test_uniform(&state, -0.2, 0.2), length = 0, from[3];
        for (int k = 0; k < 3; ++k) {
            n[k] = i < 9 ? k == i / 3 : test_uniform(&state, -1, 1);
            length += n[k] * n[k];
        }
        for (int k = 0; k < 3; ++k) {
            from[k] = n[k] * offset / length;
        }
        cut_mesh(whole, n[0], n[1], n[2], offset);
        cut_mesh(other, -n[0], -n[1], -n[2], -offset);
        const double first = volume_from(whole, from), second = volume_from(other, from);
        CHECK(fabs(first + second - volume) < 1e-5 * volume && first > 0.05 * volume &&
                  second > 0.05 * volume,
              "%s: %g + %g, not %g", names[i % 3], first, second, volume);
        burnish_mesh_destroy(whole);
        burnish_mesh_destroy(other);
    }
    burnish_mesh *ball = load_measured(":sphere", 64);
    cut_mesh(ball, 0, 0, 3, 1.5); /* without the cap of height 1/2: pi h^2 (3 - h) / 3 */
    const double expected = 4 * TEST_PI / 3 - TEST_PI * 0.25 * 2.5 / 3;
    CHECK(fabs(volume_from(ball, (double[3]){0, 0, 0.5}) - expected) < 2e-3 * expected,
          "%g, not %g", volume_from(ball, (double[3]){0, 0, 0.5}), expected);
    burnish_mesh_destroy(ball);
}

/* ---- Edges ---- */

static double beyond(const burnish_clip_plane *plane, const float p[3]) {
    const double *n = plane->normal;
    return n[0] * (double)p[0] + n[1] * (double)p[1] + n[2] * (double)p[2] - plane->offset;
}

/* Edges without a second triangle that runs along them the other way, but for those in the planes. */
static size_t open_edges(const burnish_mesh *mesh) {
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    burnish_memory memory = burnish_memory_of(NULL, NULL);
    burnish_edges edges;
    size_t open = 0;
    CHECK1(burnish_edges_find(view, NULL, &memory, &edges) == BURNISH_STATUS_OK);
    for (size_t i = 0; i < edges.count; ++i) {
        const burnish_edge *edge = &edges.items[i];
        int in_plane = 0;
        for (int k = 0; k < view->cut_count; ++k) {
            in_plane |= fabs(beyond(&view->cuts[k], view->positions + 3 * edge->ends[0])) < 1e-6 &&
                        fabs(beyond(&view->cuts[k], view->positions + 3 * edge->ends[1])) < 1e-6;
        }
        open += !in_plane && (edge->triangles[1] == BURNISH_EDGE_OPEN ||
                              (edge->flags & BURNISH_EDGE_ALIKE) != 0);
    }
    burnish_release(NULL, edges.items);
    return open;
}

static void test_edges(void) {
    static const char *const names[] = {":sphere", ":torus", ":knot"};
    uint64_t state = test_seed(2);
    for (int i = 0; i < 12; ++i) {
        burnish_mesh *mesh = load(names[i % 3]);
        CHECK1(open_edges(mesh) == 0);
        for (int k = 0; k <= i % 3; ++k) {
            cut_mesh(mesh, test_uniform(&state, -1, 1), test_uniform(&state, -1, 1),
                     test_uniform(&state, -1, 1), i < 3 ? 0 : test_uniform(&state, 0, 0.2));
        }
        CHECK(open_edges(mesh) == 0, "%s: %zu edges opened", names[i % 3], open_edges(mesh));
        burnish_mesh_destroy(mesh);
    }
}

/* ---- Attributes ---- */

static void test_attributes(void) {
    static const float positions[9] = {0, 0, 0, 4, 0, 0, 0, 4, 0};
    static const float normals[9] = {0, 0, 1, 1, 0, 0, 0, 0, 1};
    static const float coordinates[6] = {0, 0, 1, 0, 0, 1};
    static const uint8_t colors[12] = {0, 0, 0, 255, 255, 255, 255, 55, 0, 0, 0, 255};
    static const uint16_t triangle_materials[1] = {1};
    static const uint32_t faces[3] = {0, 1, 2};
    static const float coordinates2[6] = {1, 0, 0, 0, 1, 1};
    static const uint8_t texel[4] = {255, 255, 255, 255};
    const burnish_texture texture = {NULL, 1, 1, texel, 1};
    burnish_material materials[2] = {{.exponent = 1}, {.exponent = 2}};
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh_description arrays = describe_arrays(positions, normals, colors, 3, faces, 1);
    arrays.texture_coordinates = (burnish_array){coordinates, 3, 0};
    arrays.second_coordinates = (burnish_array){coordinates2, 3, 0};
    arrays.triangle_materials = (burnish_array){triangle_materials, 1, 0};
    arrays.materials = materials;
    arrays.material_count = 2;
    arrays.textures = &texture;
    arrays.texture_count = 1;
    materials[0].textures[BURNISH_TEXTURE_COLOR].texture = 1;
    materials[0].textures[BURNISH_TEXTURE_COLOR].coordinates = 1;
    options.keep_texture_coordinates = 1;
    burnish_mesh *mesh = create_mesh(&arrays, &options);
    cut_mesh(mesh, 1, 0, 0, 1);
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    CHECK(view->triangle_count == 2 && view->vertex_count == 4, "%zu, %zu", view->triangle_count,
          view->vertex_count);
    for (size_t i = 0; i < view->triangle_count; ++i) {
        CHECK1(!view->triangle_materials || view->triangle_materials[i] == 1);
    }
    for (size_t i = 0; i < view->vertex_count; ++i) {
        const float *n = view->normals + 3 * i, *p = view->positions + 3 * i;
        const double length = sqrt((double)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
        CHECK(fabs(length - 1) < 1e-6, "normal %g", length);
        CHECK1(fabsf(view->texture_coordinates[2 * i] - p[0] / 4) < 1e-6f);
        CHECK1(fabsf(view->texture_coordinates[2 * i + 1] - p[1] / 4) < 1e-6f);
        CHECK1(fabsf(view->second_coordinates[2 * i] - (1 - p[0] / 4)) < 1e-6f);
        CHECK1(fabsf(view->second_coordinates[2 * i + 1] - p[1] / 4) < 1e-6f);
        if (p[0] == 1 && p[1] == 0) { /* a quarter of white in linear light, and of alpha */
            CHECK(view->colors[4 * i] == 137 && view->colors[4 * i + 3] == 205, "%d, %d",
                  view->colors[4 * i], view->colors[4 * i + 3]);
            CHECK1(fabsf(n[0] / n[2] - 1.0f / 3) < 1e-6f);
        }
    }
    CHECK1(view->inside == BURNISH_INSIDE_UNKNOWN); /* no solid */
    burnish_mesh_destroy(mesh);
}

/* ---- Caps ---- */

enum { SIZE = 160 };

typedef struct capped_picture {
    uint8_t pixels[SIZE][SIZE * 4];
    float depth[SIZE][SIZE], normals[SIZE][SIZE][3];
} capped_picture;

/* The camera looks along `direction` in parallel projection, `height` high. */
static burnish_render_options options_for(const double direction[3], double height, int samples) {
    burnish_render_options options = burnish_render_options_default();
    options.width = options.height = SIZE;
    options.samples = samples;
    options.camera.orthographic_height = height;
    options.camera.view_up[1] = direction[0] == 0 && direction[2] == 0 ? 0 : 1;
    options.camera.view_up[2] = options.camera.view_up[1] == 0;
    for (int k = 0; k < 3; ++k) {
        options.camera.position[k] = -10 * direction[k];
    }
    return options;
}

static void draw(const burnish_mesh *mesh, const burnish_render_options *options,
                 capped_picture *to) {
    const burnish_target target = make_target(
        (burnish_pixels){SIZE, SIZE, BURNISH_PIXELS_RGBA8, sizeof to->pixels[0], to->pixels[0]},
        to->depth[0], to->normals[0][0], NULL, NULL);
    draw_into(mesh, options, &target, NULL);
}

static int has_normal(const float n[3], const double wanted[3]) {
    return fabs(n[0] - wanted[0]) < 1e-5 && fabs(n[1] - wanted[1]) < 1e-5 &&
           fabs(n[2] - wanted[2]) < 1e-5;
}

/* Three caps meet in a corner of a box. Each pixel of a cap is in the plane of the cap, also in
 * perspective. Culling leaves caps, and an inside-out box looks the same. */
static void test_corner(int samples, int is_parallel) {
    static capped_picture picture, other;
    static const double normals[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const double offsets[3] = {0.5, 1, 1.5};
    burnish_mesh *mesh = make_box(0, NULL, NULL), *turned = make_box(1, NULL, NULL);
    burnish_render_options options = options_for((double[3]){-0.5, -0.6, -0.7}, 10, samples);
    int shown[3] = {0, 0, 0};
    double forward[3], length = 0;
    options.camera.orthographic_height = is_parallel ? 10 : 0;
    options.camera.view_angle = 45;
    for (int i = 0; i < 3; ++i) {
        cut_mesh(mesh, normals[i][0], normals[i][1], normals[i][2], offsets[i]);
        cut_mesh(turned, normals[i][0], normals[i][1], normals[i][2], offsets[i]);
        length += options.camera.position[i] * options.camera.position[i];
    }
    CHECK1(burnish_mesh_get_view(turned)->inside == BURNISH_INSIDE_FRONT);
    draw(mesh, &options, &picture);
    options.cull_back_faces = 1;
    draw(mesh, &options, &other);
    CHECK(memcmp(&picture, &other, sizeof picture) == 0, "without back faces");
    options.cull_back_faces = 0;
    draw(turned, &options, &other);
    int different = 0; /* but for ties along edges, which front faces win */
    for (int i = 0; i < SIZE * SIZE * 4; ++i) {
        different += abs(picture.pixels[i / (4 * SIZE)][i % (4 * SIZE)] -
                         other.pixels[i / (4 * SIZE)][i % (4 * SIZE)]) > 1;
    }
    CHECK(different < 40, "%d bytes", different);
    for (int k = 0; k < 3; ++k) {
        forward[k] = -options.camera.position[k] / sqrt(length);
    }
    /* right = forward x (0, 1, 0), up = right x forward */
    const double across = sqrt(forward[0] * forward[0] + forward[2] * forward[2]);
    const double right[3] = {-forward[2] / across, 0, forward[0] / across};
    const double up[3] = {right[1] * forward[2] - right[2] * forward[1],
                          right[2] * forward[0] - right[0] * forward[2],
                          right[0] * forward[1] - right[1] * forward[0]};
    for (int i = 0; i < SIZE * SIZE; ++i) {
        const double depth = (double)picture.depth[i / SIZE][i % SIZE];
        const double reach = is_parallel ? 10 : 2 * depth * tan(TEST_PI / 8);
        const double x = ((i % SIZE) + 0.5 - SIZE / 2) / SIZE * reach;
        const double y = (SIZE / 2 - (i / SIZE) - 0.5) / SIZE * reach;
        for (int n = 0; n < 3 && depth < 1e6; ++n) {
            if (!has_normal(picture.normals[i / SIZE][i % SIZE], normals[n])) {
                continue;
            }
            const double p =
                options.camera.position[n] + forward[n] * depth + right[n] * x + up[n] * y;
            shown[n] += 1;
            /* at borders the point is up to half a pixel from the centre */
            CHECK(fabs(p - offsets[n]) < 0.06, "pixel %d,%d: %g, not %g", i % SIZE, i / SIZE, p,
                  offsets[n]);
        }
    }
    CHECK(shown[0] > 500 && shown[1] > 500 && shown[2] > 500, "%d %d %d", shown[0], shown[1],
          shown[2]);
    burnish_mesh_destroy(mesh);
    burnish_mesh_destroy(turned);
}

/* ---- Errors ---- */

static void test_errors(void) {
    burnish_mesh *mesh = load(":sphere");
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    const uint64_t serial = view->serial;
    const burnish_clip_plane wrong[] = {plane_of(0, 0, 0, 1),        plane_of(NAN, 0, 0, 1),
                                        plane_of(0, INFINITY, 0, 1), plane_of(0, 0, 1, NAN),
                                        plane_of(0, 0, 1, INFINITY), plane_of(1e200, 0, 0, 1),
                                        plane_of(0, 0, 1, -2)};
    burnish_error error;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        CHECK(burnish_mesh_clip(mesh, &wrong[i], &error) == BURNISH_STATUS_ARGUMENT, "%zu", i);
        CHECK(strncmp(error.text, "clip: ", 6) == 0 && !strchr(error.text, '\n'), "%s", error.text);
    }
    CHECK1(burnish_mesh_clip(NULL, &wrong[0], &error) == BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_mesh_clip(mesh, NULL, &error) == BURNISH_STATUS_ARGUMENT);
    cut_mesh(mesh, 0, 0, 1, 2); /* nothing is there */
    CHECK1(view->serial == serial && view->cut_count == 0);
    for (int i = 0; i < BURNISH_CUTS_MAX; ++i) {
        cut_mesh(mesh, 0, 0, 1, 0.9 - 0.1 * i);
    }
    CHECK1(view->serial != serial && view->cut_count == BURNISH_CUTS_MAX);
    const burnish_clip_plane more = plane_of(0, 0, 1, 0);
    CHECK1(burnish_mesh_clip(mesh, &more, &error) == BURNISH_STATUS_ARGUMENT);
    burnish_mesh_destroy(mesh);
    mesh = load_tessellated(":sphere", 4);
    cut_mesh(mesh, 0, 0, 1, 0);
    CHECK1(burnish_mesh_get_view(mesh)->inside == BURNISH_INSIDE_UNKNOWN); /* not measured */
    burnish_mesh_destroy(mesh);
}

/* Every allocation fails once: the mesh stays as it was. */
static void test_memory(void) {
    counts own;
    burnish_context *context = make_context(&own);
    uint8_t colors[32] = {0};
    burnish_mesh *mesh = make_box(0, colors, context);
    const burnish_mesh_view before = *burnish_mesh_get_view(mesh);
    const burnish_clip_plane plane = plane_of(1, 1, 1, 1);
    const long live = atomic_load(&own.live);
    burnish_status status = BURNISH_STATUS_MEMORY;
    int failed = 0;
    for (long k = 0; status == BURNISH_STATUS_MEMORY; ++k) {
        atomic_store(&own.left, k);
        status = burnish_mesh_clip(mesh, &plane, NULL);
        atomic_store(&own.left, -1);
        failed += status == BURNISH_STATUS_MEMORY;
        CHECK1(atomic_load(&own.live) == live);
        CHECK1(status == BURNISH_STATUS_OK ||
               memcmp(&before, burnish_mesh_get_view(mesh), sizeof before) == 0);
    }
    CHECK(status == BURNISH_STATUS_OK && failed >= 5, "%d failures, then %d", failed, (int)status);
    burnish_mesh_destroy(mesh);
    burnish_context_destroy(context);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_halves());
    RUN(test_edges());
    RUN(test_attributes());
    RUN(test_corner(1, 0));
    RUN(test_corner(4, 1));
    RUN(test_corner(16, 0));
    RUN(test_errors());
    RUN(test_memory());
    return test_end("clip");
}
