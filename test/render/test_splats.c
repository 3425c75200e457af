/* Splats against the formulas of splatting.h in double precision with libm's exp, by every
 * instruction set, with and without a background. */
#include <math.h>

#include "gltf_input.h"
#include "pictures.h"

enum { SIDE = 64, ROW = 32 };

/* Pixels are units; the eye looks along -z at the origin, which is in the middle of the picture. */
static burnish_render_options make_options(void) {
    burnish_render_options options = burnish_render_options_default();
    options.width = options.height = SIDE;
    options.camera = (burnish_camera){
        .position = {0, 0, 100}, .view_up = {0, 1, 0}, .orthographic_height = SIDE};
    options.transparent = 1;
    return options;
}

typedef struct splat {
    float position[3], scale[3];
    uint8_t color[4], rotation[4];
} splat;

static burnish_mesh *load_splats(const splat *splats, size_t count) {
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = NULL;
    burnish_error error = {0};
    _Static_assert(sizeof *splats == ROW, "the rows of a .splat file");
    CHECK_OK(burnish_mesh_load_memory(splats, count * ROW, "a.splat", &options, &mesh, &error),
             error);
    return mesh;
}

/* The opacity of a splat without tilt, turned by `angle`, in a pixel. */
static double alpha_at(const splat *s, double angle, int x, int y) {
    const double dx = x + 0.5 - SIDE / 2.0 - (double)s->position[0],
                 dy = SIDE / 2.0 - y - 0.5 - (double)s->position[1];
    const double c = cos(angle), n = sin(angle), a = (double)(s->scale[0] * s->scale[0]),
                 b = (double)(s->scale[1] * s->scale[1]);
    const double xx = a * c * c + b * n * n + 0.3, yy = a * n * n + b * c * c + 0.3;
    const double xy = (a - b) * c * n, determinant = xx * yy - xy * xy;
    const double d = (yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy) / (2 * determinant);
    return s->color[3] / 255.0 * exp(-d);
}

static void check_splats(const splat *splats, size_t count, double angle, int transparent) {
    burnish_mesh *mesh = load_splats(splats, count);
    burnish_render_options options = make_options();
    double worst = 0;
    uint64_t hash = 0;
    options.transparent = transparent;
    for (burnish_isa isa = BURNISH_ISA_SCALAR; isa < BURNISH_ISA_COUNT; ++isa) {
        options.kernels = burnish_kernels_for(isa);
        if (!options.kernels) {
            continue;
        }
        burnish_render_report report;
        burnish_image image = draw_image(mesh, &options, &report);
        hash = isa == BURNISH_ISA_SCALAR ? burnish_image_hash(&image) : hash;
        CHECK1(burnish_image_hash(&image) == hash && report.covered_pixels > 0);
        for (int i = 0; i < SIDE * SIDE; ++i) {
            const uint8_t *pixel = image.pixels + i * image.channels;
            double light[3] = {0, 0, 0}, through = 1;
            for (size_t s = 0; s < count; ++s) { /* from near to far */
                const double alpha = alpha_at(splats + s, angle, i % SIDE, i / SIDE);
                for (int k = 0; k < 3; ++k) {
                    light[k] += through * alpha * splats[s].color[k];
                }
                through *= 1 - alpha;
            }
            for (int k = 0; k < 3; ++k) { /* of the background, which is white, or of none */
                const double right = light[k] + (transparent ? 0 : 255 * through);
                const double shown = transparent ? pixel[k] * pixel[3] / 255.0 : pixel[k];
                worst = fmax(worst, fabs(shown - right));
            }
            worst = fmax(worst, transparent ? fabs(pixel[3] - 255 * (1 - through)) : 0);
        }
        burnish_image_destroy(&image);
    }
    CHECK(worst < 1, "%zu splats: off by %g", count, worst); /* rounding, and e^-x's 0.035 */
    burnish_mesh_destroy(mesh);
}

/* The quaternion's bytes are exact for 0 and 90 degrees; 45 is a little off. */
static void test_formulas(void) {
    const splat round[1] = {{{0, 0, 0}, {5, 5, 5}, {255, 128, 0, 200}, {255, 128, 128, 128}}};
    const splat thin[1] = {{{3, -2, 9}, {6, 0.5F, 1}, {0, 255, 90, 255}, {219, 128, 128, 219}}};
    const splat two[2] = {{{2, 1, 5}, {4, 3, 1}, {255, 0, 0, 128}, {255, 128, 128, 128}},
                          {{-2, 0, 0}, {3, 4, 1}, {0, 64, 255, 230}, {255, 128, 128, 128}}};
    for (int transparent = 0; transparent < 2; ++transparent) {
        check_splats(round, 1, 0, transparent);
        check_splats(thin, 1, acos(-1) / 2, transparent);
        check_splats(two, 2, 0, transparent);
    }
}

/* A splat twice as far away looks half as large; equal depths keep the file's order. */
static void test_views(void) {
    const splat same[2] = {{{0, 0, 0}, {4, 4, 4}, {255, 0, 0, 255}, {255, 128, 128, 128}},
                           {{0, 0, 0}, {4, 4, 4}, {0, 0, 255, 255}, {255, 128, 128, 128}}};
    burnish_mesh *mesh = load_splats(same, 2);
    burnish_render_options options = make_options();
    burnish_render_report near, far;
    options.camera.orthographic_height = 0;
    options.camera.view_angle = 30;
    burnish_image image = draw_image(mesh, &options, &near);
    const uint8_t *middle = image.pixels + (SIDE / 2 * SIDE + SIDE / 2) * image.channels;
    CHECK(middle[0] > 240 && middle[2] < 20, "%d, %d", middle[0], middle[2]);
    burnish_image_destroy(&image);
    options.camera.position[2] *= 2;
    image = draw_image(mesh, &options, &far);
    const double ratio =
        (double)(near.bounds[2] - near.bounds[0]) / (far.bounds[2] - far.bounds[0]);
    CHECK(ratio > 1.8 && ratio < 2.2, "%g", ratio);
    burnish_image_destroy(&image);
    burnish_mesh_destroy(mesh);
}

/* Splats packed into a PLY file are those of a .splat file: 256 by the bounds of the first chunk,
 * one by the second's; in both byte orders, with and without bounds of colours. */
static void check_packed(int is_big, int has_colors) {
    enum { COUNT = 257, BOUNDS = 18 };
    static const char *const names = "xyz";
    /* each largest one of w, x, y and z; in another order each would be another turn */
    static const uint8_t turns[4][4] = {
        {218, 128, 128, 218}, {128, 218, 128, 218}, {218, 128, 218, 128}, {218, 128, 128, 218}};
    uint32_t words[4] = {2047u << 21 | 2047, 0, 1023u << 11 | 2047, 255u << 24 | 128u << 16 | 200};
    const double bounds[BOUNDS] = {-1, -2,     -3,     3, 5, 9, log(0.5), log(2), log(0.5),
                                   0,  log(6), log(3), 0, 0, 0, 1,        1,      1};
    splat rows[COUNT];
    byte_list file = {.size = 0};
    char line[100];
    snprintf(line, sizeof line, "ply\nformat binary_%s_endian 1.0\nelement chunk 2\n",
             is_big ? "big" : "little");
    put_text(&file, line);
    for (int i = 0; i < (has_colors ? BOUNDS : 12); ++i) {
        const char axis = i < 12 ? names[i % 3] : "rgb"[i % 3];
        snprintf(line, sizeof line, "property float %s_%s%c\n", i / 3 % 2 ? "max" : "min",
                 i >= 6 && i < 12 ? "scale_" : "", axis);
        put_text(&file, line);
    }
    snprintf(line, sizeof line, "element vertex %d\n", COUNT);
    put_text(&file, line);
    put_text(&file, "property uint packed_position\nproperty uint packed_rotation\n"
                    "property uint packed_scale\nproperty uint packed_color\nend_header\n");
    for (int chunk = 0; chunk < 2; ++chunk) {
        for (int i = 0; i < (has_colors ? BOUNDS : 12); ++i) {
            put_float(&file, (float)(bounds[i] + (i == 3 ? chunk : 0)), is_big);
        }
    }
    for (int i = 0; i < COUNT; ++i) {
        const uint32_t most = (uint32_t)i % 4;
        rows[i] = (splat){{i < 256 ? 3 : 4, -2, 9},
                          {0.5F, 6, 3},
                          {255, 128, 0, 200},
                          {turns[most][0], turns[most][1], turns[most][2], turns[most][3]}};
        words[1] = most << 30 | 512u << 10 | (most < 2 ? 512u << 20 | 1023 : 1023u << 20 | 512);
        for (int k = 0; k < 4; ++k) {
            put_bits(&file, words[k], 4, is_big);
        }
    }
    OWNED_MESH *packed = load_bytes(file.bytes, file.size, "a.ply", NULL);
    burnish_mesh *plain = load_splats(rows, COUNT);
    const burnish_mesh_view *a = burnish_mesh_get_view(packed), *b = burnish_mesh_get_view(plain);
    CHECK1(a && a->splats && a->vertex_count == COUNT && b->vertex_count == COUNT);
    double worst = 0;
    for (int i = 0; a && i < COUNT; ++i) {
        const float *x = (const float *)&a->splats[i], *y = (const float *)&b->splats[i];
        for (size_t k = 0; k < sizeof a->splats[i] / sizeof *x; ++k) {
            worst = fmax(worst, fabs((double)x[k] - (double)y[k]));
        }
        for (int k = 0; k < 3; ++k) {
            worst = fmax(worst,
                         fabs((double)a->positions[3 * i + k] - (double)b->positions[3 * i + k]));
        }
    }
    CHECK(worst < 0.02, "packed splats: off by %g", worst); /* 10 bits of a quaternion, times 6 */
    burnish_mesh_destroy(plain);
}

/* SPZ of version 4 has the arrays of version 3, here in blocks of zstd that are not packed. */
static void test_spz_versions(void) {
    enum { COUNT = 2, HEAD = 16, ARRAYS = 5 };
    static const uint8_t each[ARRAYS] = {9, 1, 3, 3, 4};
    byte_list old = {.size = 0}, new = {.size = 0};
    put_text(&old, "NGSP");
    put_bits(&old, 3, 4, 0);
    put_bits(&old, COUNT, 4, 0);
    put_bits(&old, 12 << 8, 4, 0); /* bits of fractions */
    put(&new, old.bytes, HEAD);
    new.bytes[4] = 4;
    new.bytes[15] = ARRAYS;
    put_bits(&new, 2 * HEAD, 4, 0);
    put_bits(&new, 0, 8, 0);
    put_bits(&new, 0, 4, 0);
    for (int i = 0; i < ARRAYS; ++i) {
        put_bits(&new, each[i] * COUNT + 9, 8, 0);
        put_bits(&new, each[i] * COUNT, 8, 0);
    }
    for (int i = 0; i < ARRAYS; ++i) {
        const unsigned size = each[i] * COUNT;
        put_bits(&new, 0xFD2FB528, 4, 0);
        put_bits(&new, 0x20, 1, 0);
        put_bits(&new, size, 1, 0);
        put_bits(&new, 1 | size << 3, 3, 0);
        for (unsigned k = 0; k < size; ++k) {
            const unsigned value = (37 * k + 101 * i) % 251;
            put_bits(&old, value, 1, 0);
            put_bits(&new, value, 1, 0);
        }
    }
    OWNED_MESH *expected = load_bytes(old.bytes, old.size, "a.spz", NULL);
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = NULL;
    burnish_error error = {0};
    if (burnish_mesh_load_memory(new.bytes, new.size, "a.spz", &options, &mesh, &error) !=
            BURNISH_STATUS_OK &&
        strstr(error.text, "without zstd")) {
        return; /* what the build lacks */
    }
    CHECK(mesh != NULL, "%s", error.text);
    const burnish_mesh_view *a = burnish_mesh_get_view(expected), *b = burnish_mesh_get_view(mesh);
    CHECK1(a && b && b->vertex_count == COUNT &&
           !memcmp(a->splats, b->splats, COUNT * sizeof *a->splats) &&
           !memcmp(a->positions, b->positions, COUNT * 3 * sizeof *a->positions));
    burnish_mesh_destroy(mesh);
    for (size_t size = HEAD; size < new.size; size += 7) {
        CHECK1(burnish_mesh_load_memory(new.bytes, size, "a.spz", &options, &mesh, &error) ==
               BURNISH_STATUS_FORMAT);
    }
}

/* A square to the left of x = 0 hides what is behind it unless it is glass; in front of it, and to the
 * right of it, splats are what they are alone. */
static void check_among_triangles(int is_glass, burnish_isa isa) {
    const splat two[2] = {{{0, 9, 5}, {4, 4, 4}, {255, 0, 0, 128}, {255, 128, 128, 128}},
                          {{0, -9, -5}, {4, 4, 4}, {0, 0, 255, 204}, {255, 128, 128, 128}}};
    const float square[18] = {-50, -50, 0, 0, -50, 0, 0, 50, 0, -50, -50, 0, 0, 50, 0, -50, 50, 0};
    byte_list binary = {.size = 0}, file = {.size = 0};
    char json[1000];
    put_floats(&binary, 18, square);
    put_floats(&binary, 3, two[0].position);
    put_floats(&binary, 3, two[1].position);
    put_floats(&binary, 3, two[0].scale);
    put_floats(&binary, 3, two[1].scale);
    for (int i = 0; i < 8; ++i) {
        put_float(&binary, (float)two[i / 4].color[i % 4] / 255, 0);
    }
    snprintf(json, sizeof json,
             "$head'buffers':[{'byteLength':152}],'bufferViews':[{'buffer':0,'byteLength':152}],"
             "'accessors':[$part(0,5126,6,VEC3),$part(72,5126,2,VEC3),$part(96,5126,2,VEC3),"
             "$part(120,5126,2,VEC4)],'materials':[{'alphaMode':'%s','pbrMetallicRoughness':"
             "{'baseColorFactor':[0,1,0,0.5]},'extensions':{'KHR_materials_unlit':{}}}],'meshes':"
             "[{'primitives':[{'attributes':{'POSITION':0},'material':0},{'attributes':{'POSITION'"
             ":1,'SCALE':2,'COLOR_0':3},'mode':0,'extensions':{'KHR_gaussian_splatting':{}}}]}],"
             "$node}",
             is_glass ? "BLEND" : "OPAQUE");
    put_glb(&file, json, &binary);
    OWNED_MESH *mesh = load_bytes(file.bytes, file.size, "a.glb", NULL);
    burnish_render_options options = make_options();
    burnish_render_report report;
    options.transparent = 0;
    options.kernels = burnish_kernels_for(isa);
    burnish_image image = draw_image(mesh, &options, &report);
    double worst = 0;
    for (int i = 0; i < SIDE * SIDE; ++i) {
        const int is_left = i % SIDE < SIDE / 2;
        const double hidden = is_left && !is_glass ? 0 : 1;
        const double red = alpha_at(&two[0], 0, i % SIDE, i / SIDE),
                     blue = hidden * alpha_at(&two[1], 0, i % SIDE, i / SIDE);
        const double through = (1 - red) * (1 - blue); /* glass: half of white in linear light */
        const double back = !is_left ? 255 : is_glass ? 188 : 0;
        worst = fmax(worst, fabs(image.pixels[3 * i] - (255 * red + through * back)));
        worst =
            fmax(worst, fabs(image.pixels[3 * i + 2] - (255 * blue * (1 - red) + through * back)));
    }
    CHECK(worst < 1.2, "among triangles: off by %g", worst);
    float depths[SIDE * SIDE]; /* with a plane, a tile is drawn twice */
    uint8_t again[3 * SIDE * SIDE];
    burnish_target target = burnish_target_default();
    target.pixels = (burnish_pixels){SIDE, SIDE, BURNISH_PIXELS_RGB8, 3 * SIDE, again};
    target.depth = depths;
    target.depth_stride = SIDE * sizeof *depths;
    draw_into(mesh, &options, &target, NULL);
    CHECK1(memcmp(again, image.pixels, sizeof again) == 0);
    CHECK1(report.covered_pixels > SIDE * SIDE / 2 && report.covered_pixels < SIDE * SIDE &&
           report.bounds[0] == 0 && report.bounds[2] < SIDE && report.bounds[2] > SIDE / 2 + 5);
    burnish_image_destroy(&image);
    float low[3], high[3];
    burnish_mesh_get_bounds(mesh, low, high);
    CHECK1(low[0] == -50 && low[2] == -5 && high[0] == 0 && high[2] == 5);
    const burnish_clip_plane plane = {{0, 0, 1}, 1};
    burnish_error error = {0};
    CHECK_OK(burnish_mesh_clip(mesh, &plane, &error), error);
    const burnish_mesh_view *left = burnish_mesh_get_view(burnish_mesh_get_splats(mesh));
    CHECK1(left && left->vertex_count == 1 && left->positions[2] == -5);
    burnish_mesh_get_bounds(mesh, low, high);
    CHECK1(high[2] == 0);
    const burnish_clip_plane below = {{0, 0, 1}, -1};
    CHECK_OK(burnish_mesh_clip(mesh, &below, &error), error);
    left = burnish_mesh_get_view(mesh);
    CHECK1(left->splats && left->vertex_count == 1 && left->cut_count == 1 && !left->indices);
    memset(file.bytes + file.size - 152, 0, sizeof square); /* no area */
    OWNED_MESH *flat = load_bytes(file.bytes, file.size, "a.glb", NULL);
    CHECK1(flat && burnish_mesh_get_view(flat)->splats);
    check_only_warning(flat, "a.glb: none of 2 triangles has any area; they were left out");
}

int main(void) {
    for (burnish_isa isa = BURNISH_ISA_SCALAR; isa < BURNISH_ISA_COUNT; ++isa) {
        for (int is_glass = 0; is_glass < 2 && burnish_kernels_for(isa); ++is_glass) {
            check_among_triangles(is_glass, isa);
        }
    }
    test_spz_versions();
    check_packed(0, 1);
    check_packed(0, 0);
    check_packed(1, 1);
    RUN(test_formulas());
    RUN(test_views());
    return test_end("splats");
}
