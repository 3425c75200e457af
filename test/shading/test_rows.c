/* Rows of a picture: however it is split, put together they are the whole picture, bit for bit, in
 * its pixels and planes, for every look, instruction set and number of threads. */
#include "burnish/kernels.h"
#include "burnish/look.h"
#include "burnish/render.h"
#include "mesh_arrays.h"
#include "support.h"

enum { WIDTH = 70, HEIGHT = 203, TEXTURE = 32, PIXEL_MAX = 16 };

static burnish_error error;

/* ---- Scenes ---- */

static burnish_mesh *load(const char *name, int measure) {
    burnish_load_options load = burnish_load_options_default();
    load.tessellation = 8;
    load.measure = measure;
    return load_mesh(name, &load);
}

static burnish_mesh *make_plain(void) {
    return load(":knot", 0);
}

static burnish_mesh *make_glass(void) {
    burnish_mesh *mesh = load(":teapot", 0);
    burnish_material material = *burnish_mesh_get_material(mesh, 0);
    material.transparency = 0.4f;
    CHECK_OK(burnish_mesh_set_material(mesh, 0, &material, &error), error);
    return mesh;
}

static burnish_mesh *make_cut(void) {
    burnish_mesh *mesh = load(":knot", 1);
    const burnish_clip_plane planes[2] = {{{0.2, 0.1, 1}, 0.1}, {{1, 0.3, 0}, 0.4}};
    for (int i = 0; i < 2; ++i) {
        CHECK_OK(burnish_mesh_clip(mesh, &planes[i], &error), error);
    }
    return mesh;
}

/* A knot with an image of random texels on it, some of which let light through, and colours. */
static burnish_mesh *make_textured(void) {
    burnish_mesh *shape = load(":knot", 0), *mesh = NULL;
    const burnish_mesh_view *view = burnish_mesh_get_view(shape);
    const size_t count = view->vertex_count;
    uint64_t state = test_seed(7);
    uint8_t texels[4 * TEXTURE * TEXTURE], *colors = malloc(4 * count);
    float *coordinates = malloc(2 * count * sizeof *coordinates);
    for (size_t i = 0; i < sizeof texels; ++i) {
        texels[i] = (uint8_t)test_random32(&state);
    }
    for (size_t i = 0; i < count; ++i) {
        coordinates[2 * i] = 3 * view->positions[3 * i] + view->positions[3 * i + 2];
        coordinates[2 * i + 1] = 3 * view->positions[3 * i + 1];
        for (size_t k = 0; k < 4; ++k) {
            colors[4 * i + k] = (uint8_t)(k < 3 || i % 3 == 0 ? test_random32(&state) : 255);
        }
    }
    burnish_mesh_description arrays = describe_arrays(view->positions, view->normals, colors, count,
                                                      view->indices, view->triangle_count);
    burnish_material material = burnish_material_default();
    const burnish_texture texture = {NULL, TEXTURE, TEXTURE, texels, 1};
    material.textures[BURNISH_TEXTURE_COLOR].texture = 1;
    material.alpha_mode = BURNISH_ALPHA_BLEND;
    arrays.texture_coordinates = (burnish_array){coordinates, count, 0};
    arrays.materials = &material;
    arrays.material_count = 1;
    arrays.textures = &texture;
    arrays.texture_count = 1;
    mesh = create_mesh(&arrays, NULL);
    burnish_mesh_destroy(shape);
    free(coordinates);
    free(colors);
    return mesh;
}

typedef struct scene {
    const char *name;
    burnish_mesh *(*make)(void);
    burnish_look look;
    int samples;
    burnish_pixel_format format;
    int transparent, ground, shadow, edges, cull, parallel, is_near;
} scene;

/* Everything that looks beyond a pixel: occlusion, whose look-ups neighbours share, layers, lines,
 * shadows of the ground, caps, textures' levels; and triangles that the near plane cuts. */
static const scene scenes[] = {
    {"plain", make_plain, BURNISH_LOOK_PLAIN, 4, BURNISH_PIXELS_RGB8, 0, 0, 0, 0, 0, 0, 0},
    {"one sample", make_plain, BURNISH_LOOK_STUDIO, 1, BURNISH_PIXELS_BGRA8, 0, 1, 0, 0, 1, 0, 0},
    {"three-point", make_plain, BURNISH_LOOK_THREE_POINT, 4, BURNISH_PIXELS_RGB8, 0, 1, 1, 0, 0, 0,
     0},
    {"clay", make_plain, BURNISH_LOOK_CLAY, 8, BURNISH_PIXELS_RGBA_FLOAT, 1, 1, 0, 0, 0, 1, 0},
    {"technical", make_plain, BURNISH_LOOK_TECHNICAL, 4, BURNISH_PIXELS_RGB8, 0, 0, 0, 0, 0, 0, 0},
    {"drawing", make_cut, BURNISH_LOOK_DRAWING, 4, BURNISH_PIXELS_RGBA8, 1, 0, 0, 0, 0, 1, 0},
    {"wireframe", make_plain, BURNISH_LOOK_STUDIO, 4, BURNISH_PIXELS_RGB8, 0, 0, 0,
     BURNISH_EDGES_ALL, 0, 0, 0},
    {"glass", make_glass, BURNISH_LOOK_STUDIO, 4, BURNISH_PIXELS_RGB8, 0, 1, 0, 0, 0, 0, 0},
    {"glass, 16 samples", make_glass, BURNISH_LOOK_THREE_POINT, 16, BURNISH_PIXELS_RGBA8, 1, 1, 1,
     0, 0, 0, 0},
    {"glass, one sample", make_glass, BURNISH_LOOK_TECHNICAL, 1, BURNISH_PIXELS_RGBA_FLOAT, 0, 0, 0,
     0, 0, 0, 0},
    {"cut", make_cut, BURNISH_LOOK_THREE_POINT, 4, BURNISH_PIXELS_RGB8, 0, 0, 1, 0, 0, 0, 0},
    {"texture", make_textured, BURNISH_LOOK_STUDIO, 4, BURNISH_PIXELS_RGBA8, 0, 1, 0, 0, 0, 0, 0},
    {"near", make_textured, BURNISH_LOOK_TECHNICAL, 4, BURNISH_PIXELS_RGB8, 0, 0, 0, 0, 0, 0, 1},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static burnish_render_options make_options(const scene *s, const burnish_mesh *mesh) {
    burnish_render_options options = burnish_render_options_default();
    burnish_framing framing = burnish_framing_default();
    CHECK_OK(burnish_render_options_set_look(&options, s->look, &error), error);
    options.width = WIDTH;
    options.height = HEIGHT;
    options.samples = s->samples;
    options.transparent = s->transparent;
    options.ground = s->ground;
    options.shadow = s->shadow;
    options.edges |= s->edges;
    options.cull_back_faces = s->cull;
    framing.aspect = (double)WIDTH / HEIGHT;
    framing.orthographic = s->parallel;
    CHECK_OK(burnish_camera_frame(mesh, &framing, &options.camera, &error), error);
    for (int k = 0; s->is_near && k < 3; ++k) { /* into the object */
        options.camera.position[k] =
            0.8 * options.camera.focal_point[k] + 0.2 * options.camera.position[k];
    }
    return options;
}

/* ---- Pictures ---- */

/* All that a target holds. */
typedef struct planes {
    uint8_t pixels[HEIGHT][WIDTH * PIXEL_MAX];
    float depth[HEIGHT][WIDTH], normals[HEIGHT][3 * WIDTH];
    uint32_t triangles[HEIGHT][WIDTH];
    uint8_t coverage[HEIGHT][WIDTH];
} planes;

static burnish_target target_of(planes *p, burnish_pixel_format format, int first, int count) {
    burnish_target target = burnish_target_default();
    target.pixels = (burnish_pixels){WIDTH, count, format, sizeof p->pixels[0], p->pixels[first]};
    target.depth = p->depth[first];
    target.depth_stride = sizeof p->depth[0];
    target.normals = p->normals[first];
    target.normal_stride = sizeof p->normals[0];
    target.triangles = p->triangles[first];
    target.triangle_stride = sizeof p->triangles[0];
    target.coverage = p->coverage[first];
    target.coverage_stride = sizeof p->coverage[0];
    return target;
}

static burnish_render_report draw_rows(burnish_renderer *renderer, const burnish_mesh *mesh,
                                       const burnish_render_options *options,
                                       burnish_pixel_format format, int first, int count,
                                       planes *to) {
    burnish_render_options part = *options;
    burnish_render_report report = {0};
    const burnish_target target = target_of(to, format, first, count);
    part.first_row = first;
    part.row_count = count;
    CHECK_OK(burnish_renderer_draw_into(renderer, mesh, &part, &target, &report, &error), error);
    return report;
}

static void merge(burnish_render_report *sum, const burnish_render_report *part) {
    for (int k = 0; k < 4 && part->covered_pixels > 0; ++k) {
        const int is_further =
            k < 2 ? part->bounds[k] < sum->bounds[k] : part->bounds[k] > sum->bounds[k];
        sum->bounds[k] = sum->covered_pixels == 0 || is_further ? part->bounds[k] : sum->bounds[k];
    }
    sum->covered_pixels += part->covered_pixels;
}

/* step 0: pieces of any sizes. */
static int piece(int step, int first, uint64_t *state) {
    const int count = step > 0 ? step : 1 + (int)(test_random32(state) % 90);
    return count < HEIGHT - first ? count : HEIGHT - first;
}

static void check_split(const scene *s, burnish_renderer *renderer, const burnish_mesh *mesh,
                        const burnish_render_options *options, int step, const planes *whole,
                        const burnish_render_report *report) {
    planes *joined = malloc(sizeof *joined);
    burnish_render_report sum = {0};
    uint64_t state = test_seed(11);
    memset(joined, 0x5a, sizeof *joined);
    for (int first = 0, count; first < HEIGHT; first += count) {
        count = piece(step, first, &state);
        const burnish_render_report part =
            draw_rows(renderer, mesh, options, s->format, first, count, joined);
        merge(&sum, &part);
    }
    CHECK(memcmp(joined, whole, sizeof *joined) == 0,
          "%s, %s, %d threads: pieces of %d rows differ", s->name, burnish_isa_name(report->isa),
          report->threads, step);
    CHECK(sum.covered_pixels == report->covered_pixels &&
              memcmp(sum.bounds, report->bounds, sizeof sum.bounds) == 0,
          "%s: pieces of %d rows cover %zu pixels in %d, %d to %d, %d; all together %zu in %d, %d "
          "to %d, %d",
          s->name, step, sum.covered_pixels, sum.bounds[0], sum.bounds[1], sum.bounds[2],
          sum.bounds[3], report->covered_pixels, report->bounds[0], report->bounds[1],
          report->bounds[2], report->bounds[3]);
    free(joined);
}

static void test_scene(const scene *s) {
    static const int steps[] = {7, 64, 100, 0, 1};
    burnish_mesh *mesh = s->make();
    burnish_render_options options = make_options(s, mesh);
    burnish_renderer *renderer = NULL;
    planes *whole = malloc(sizeof *whole);
    burnish_target target = target_of(whole, s->format, 0, HEIGHT);
    CHECK_OK(burnish_renderer_create(NULL, &renderer, &error), error);
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        options.kernels = burnish_kernels_for((burnish_isa)isa);
        for (int threads = 1; options.kernels && threads <= 3; threads += 2) {
            burnish_render_report report;
            const int is_best = options.kernels == burnish_kernels_best() && threads == 1;
            memset(whole, 0x5a, sizeof *whole);
            options.threads = threads;
            CHECK_OK(burnish_renderer_draw_into(renderer, mesh, &options, &target, &report, &error),
                     error);
            CHECK(report.covered_pixels > 1000, "%s: it is blank", s->name);
            for (int i = 0; i < 5; ++i) { /* rows one by one take their time */
                if (is_best || (i < 4 && (i + isa + threads / 2) % 2 == 0)) {
                    check_split(s, renderer, mesh, &options, steps[i], whole, &report);
                }
            }
        }
    }
    free(whole);
    burnish_renderer_destroy(renderer);
    burnish_mesh_destroy(mesh);
}

static void test_scenes(void) {
    for (int i = 0; i < SCENES; ++i) {
        test_scene(&scenes[i]);
    }
}

/* ---- What a renderer keeps between rows ---- */

static uint64_t hash_of(burnish_renderer *renderer, const burnish_mesh *mesh,
                        const burnish_render_options *options) {
    burnish_image image = {0};
    CHECK_OK(burnish_renderer_draw(renderer, mesh, options, &image, NULL, &error), error);
    const uint64_t hash = burnish_image_hash(&image);
    burnish_image_destroy(&image);
    return hash;
}

/* Rows of pictures that differ in one thing, in any order, by one renderer as by a fresh one. */
static void test_changes(void) {
    enum { PICTURES = 8, DRAWN = 60 };
    burnish_mesh *meshes[2] = {make_plain(), make_glass()};
    burnish_render_options options[PICTURES];
    burnish_renderer *kept = NULL;
    uint64_t state = test_seed(5);
    for (int i = 0; i < PICTURES; ++i) {
        options[i] = make_options(&scenes[4], meshes[i == 1]);
        options[i].first_row = 50;
        options[i].row_count = 90;
    }
    options[2].camera.position[0] += 0.1;
    options[3].edge_width = 5;
    options[4].edge_color[0] = 200;
    options[5].edges = 0;
    options[6].samples = 1;
    options[7].first_row = options[7].row_count = 0;
    CHECK_OK(burnish_renderer_create(NULL, &kept, &error), error);
    for (int i = 0; i < DRAWN; ++i) {
        const int at = (int)(test_random32(&state) % PICTURES);
        burnish_renderer *fresh = NULL;
        CHECK_OK(burnish_renderer_create(NULL, &fresh, &error), error);
        if (i == DRAWN / 2) { /* opaque from now on */
            burnish_material material = *burnish_mesh_get_material(meshes[1], 0);
            material.transparency = 0;
            CHECK_OK(burnish_mesh_set_material(meshes[1], 0, &material, &error), error);
        }
        CHECK(hash_of(kept, meshes[at == 1], &options[at]) ==
                  hash_of(fresh, meshes[at == 1], &options[at]),
              "picture %d differs after others", at);
        const burnish_lines *lines = burnish_renderer_get_lines(kept);
        CHECK(lines->line_count == burnish_renderer_get_lines(fresh)->line_count &&
                  (lines->line_count > 0) == (at != 5),
              "picture %d: %zu lines", at, lines->line_count);
        burnish_renderer_destroy(fresh);
    }
    burnish_renderer_destroy(kept);
    burnish_mesh_destroy(meshes[0]);
    burnish_mesh_destroy(meshes[1]);
}

/* ---- Refusals ---- */

static void test_refusals(void) {
    static const int rows[][2] = {{-1, 5},     {0, -1}, {0, HEIGHT + 1},
                                  {HEIGHT, 1}, {1, 0},  {2147483647, 2147483647}};
    burnish_mesh *mesh = make_plain();
    burnish_render_options options = make_options(&scenes[0], mesh);
    burnish_image image = {0};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        options.first_row = rows[i][0];
        options.row_count = rows[i][1];
        CHECK1(burnish_render(mesh, &options, &image, NULL, &error) == BURNISH_STATUS_ARGUMENT);
    }
    CHECK_TEXT(error.text, "rows: 2147483647 from 2147483647 on are not among the picture's 203; 0 "
                           "from 0 on means all");
    options.first_row = 200;
    options.row_count = 3;
    CHECK_OK(burnish_render(mesh, &options, &image, NULL, &error), error);
    CHECK1(image.width == WIDTH && image.height == 3);
    burnish_image_destroy(&image);

    burnish_renderer *renderer = NULL;
    planes *p = malloc(sizeof *p);
    burnish_target target = target_of(p, BURNISH_PIXELS_RGB8, 0, HEIGHT);
    CHECK_OK(burnish_renderer_create(NULL, &renderer, &error), error);
    CHECK1(burnish_renderer_draw_into(renderer, mesh, &options, &target, NULL, &error) ==
           BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "target: 70 x 203 pixels, but the options ask for 70 x 3");
    burnish_renderer_destroy(renderer);
    free(p);
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_scenes());
    RUN(test_changes());
    RUN(test_refusals());
    return test_end("rows");
}
