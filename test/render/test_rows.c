/* The same bits everywhere: for every look, what rows of a picture, instruction sets, threads and
 * missing pixels leave in its pixels and planes. */
#include "burnish/look.h"
#include "pictures.h"
#include "shapes.h"

enum { WIDTH = 70, HEIGHT = 203, TEXTURE = 32, PIXEL_MAX = 16 };

static burnish_error error;
static int split_count = 5; /* of the best instruction set */

/* ---- Scenes ---- */

static burnish_mesh *make_plain(int kind) {
    (void)kind;
    return load_tessellated(":knot", 8);
}

/* As light as the background that its outline is drawn on. */
static burnish_mesh *make_white(int kind) {
    burnish_mesh *mesh = make_plain(kind);
    CHECK_OK(burnish_look_set_materials(BURNISH_LOOK_DRAWING, mesh, &error), error);
    return mesh;
}

static burnish_mesh *make_glass(int kind) {
    burnish_mesh *mesh = load_tessellated(kind ? ":knot" : ":teapot", 8);
    burnish_material material = *burnish_mesh_get_material(mesh, 0);
    material.transparency = 0.4f;
    set_material(mesh, &material);
    return mesh;
}

/* kind 1: a coloured box, whose caps have a colour of their own. */
static burnish_mesh *make_cut(int kind) {
    const shape box = box_at(-1, -1, -1, 2, 2, 2);
    burnish_load_options load = burnish_load_options_default();
    uint8_t colors[32];
    for (int i = 0; i < 32; ++i) {
        colors[i] = (uint8_t)(i % 4 == 3 ? 255 : 8 * i);
    }
    const burnish_mesh_description arrays =
        describe_arrays(box.points, NULL, colors, 8, box.corners, 12);
    load.measure = 1;
    burnish_mesh *mesh = kind ? create_mesh(&arrays, &load) : load_measured(":knot", 8);
    cut_mesh(mesh, 0.2, 0.1, 1, 0.1);
    cut_mesh(mesh, 1, 0.3, 0, 0.4);
    return mesh;
}

/* Kinds of textures: the mode of alpha, and ... */
enum { EVERY_SLOT = 4, METALLIC = 8 };

/* A knot with images of random texels on it, some of which let light through, and colours. */
static burnish_mesh *make_textured(int kind) {
    burnish_mesh *knot = load_tessellated(":knot", 8);
    const burnish_mesh_view *view = burnish_mesh_get_view(knot);
    const size_t count = view->vertex_count;
    const int slots = kind & EVERY_SLOT ? BURNISH_TEXTURE_SLOT_COUNT : 1;
    uint64_t state = test_seed(7);
    static uint8_t texels[BURNISH_TEXTURE_SLOT_COUNT][4 * TEXTURE * TEXTURE];
    uint8_t *colors = malloc(4 * count);
    float *coordinates = malloc(2 * count * sizeof *coordinates);
    for (size_t i = 0; i < sizeof texels; ++i) {
        texels[i / sizeof *texels][i % sizeof *texels] = (uint8_t)test_random32(&state);
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
    burnish_texture textures[BURNISH_TEXTURE_SLOT_COUNT];
    for (int slot = 0; slot < slots; ++slot) {
        textures[slot] =
            (burnish_texture){NULL, TEXTURE, TEXTURE, texels[slot],
                              slot == BURNISH_TEXTURE_COLOR || slot == BURNISH_TEXTURE_SPECULAR ||
                                  slot == BURNISH_TEXTURE_EMISSIVE};
        material.textures[slot] = (burnish_texture_use){
            .texture = slot + 1, .wrap = {slot % 3, slot / 3 % 3}, .strength = 0.8f};
    }
    material.alpha_mode = (burnish_alpha_mode)(kind & 3);
    material.emissive[1] = kind & EVERY_SLOT ? 0.5f : 0;
    material.is_metallic = (kind & METALLIC) != 0;
    material.metallic = material.roughness = 1;
    material.coat = material.sheen[0] = kind & EVERY_SLOT ? 0.5f : 0;
    material.anisotropy[1] = material.edge_loss = kind & EVERY_SLOT ? 0.5f : 0;
    material.transmission = material.thickness = material.attenuation_distance =
        kind & EVERY_SLOT ? 0.8f : 0;
    give_textures(&arrays, coordinates, textures, (size_t)slots);
    give_materials(&arrays, &material, 1);
    burnish_mesh *mesh = create_mesh(&arrays, NULL);
    burnish_mesh_destroy(knot);
    free(coordinates);
    free(colors);
    return mesh;
}

typedef struct scene {
    const char *name;
    burnish_mesh *(*make)(int kind);
    burnish_look look;
    int samples;
    burnish_pixel_format format;
    int kind, contrast, transparent, ground, shadow, edges, cull, parallel, is_near, rays;
} scene;

/* Everything that looks beyond a pixel: occlusion, whose look-ups neighbours share, layers, lines,
 * shadows of the ground, caps, textures' levels, masks; and triangles that the near plane cuts. */
static const scene scenes[] = {
    {"plain", make_plain, BURNISH_LOOK_PLAIN, 4, BURNISH_PIXELS_RGB8, .kind = 0},
    {"one sample", make_plain, BURNISH_LOOK_STUDIO, 1, BURNISH_PIXELS_BGRA8, .ground = 1,
     .cull = 1},
    {"three-point", make_plain, BURNISH_LOOK_THREE_POINT, 4, BURNISH_PIXELS_RGB8, .ground = 1,
     .shadow = 1},
    {"clay", make_plain, BURNISH_LOOK_CLAY, 8, BURNISH_PIXELS_RGBA_FLOAT, .transparent = 1,
     .ground = 1, .parallel = 1},
    {"technical", make_plain, BURNISH_LOOK_TECHNICAL, 4, BURNISH_PIXELS_RGB8,
     .edges = BURNISH_EDGES_ALL},
    {"drawing", make_cut, BURNISH_LOOK_DRAWING, 4, BURNISH_PIXELS_RGBA8, .transparent = 1,
     .parallel = 1},
    {"rays", make_plain, BURNISH_LOOK_STUDIO, 4, BURNISH_PIXELS_RGB8, .ground = 1, .rays = 1},
    {"rays, glass", make_glass, BURNISH_LOOK_THREE_POINT, 1, BURNISH_PIXELS_RGB8, .shadow = 1,
     .rays = 1},
    {"wireframe", make_plain, BURNISH_LOOK_STUDIO, 4, BURNISH_PIXELS_RGB8,
     .edges = BURNISH_EDGES_ALL},
    {"outline", make_white, BURNISH_LOOK_DRAWING, 4, BURNISH_PIXELS_RGBA_FLOAT, .contrast = 36},
    {"outline, one sample", make_white, BURNISH_LOOK_DRAWING, 1, BURNISH_PIXELS_RGB8,
     .contrast = 36},
    {"outline, 8 samples", make_white, BURNISH_LOOK_DRAWING, 8, BURNISH_PIXELS_BGRA8,
     .contrast = 36},
    {"glass", make_glass, BURNISH_LOOK_STUDIO, 4, BURNISH_PIXELS_RGB8, .ground = 1},
    {"glass, 8 samples", make_glass, BURNISH_LOOK_STUDIO, 8, BURNISH_PIXELS_RGB8, .kind = 1},
    {"glass, 16 samples", make_glass, BURNISH_LOOK_THREE_POINT, 16, BURNISH_PIXELS_RGBA8,
     .transparent = 1, .ground = 1, .shadow = 1},
    {"glass, one sample", make_glass, BURNISH_LOOK_TECHNICAL, 1, BURNISH_PIXELS_RGBA_FLOAT,
     .kind = 0},
    {"cut", make_cut, BURNISH_LOOK_THREE_POINT, 4, BURNISH_PIXELS_RGB8, .shadow = 1},
    {"coloured cut", make_cut, BURNISH_LOOK_STUDIO, 4, BURNISH_PIXELS_RGB8, .kind = 1},
    {"cut, one sample", make_cut, BURNISH_LOOK_STUDIO, 1, BURNISH_PIXELS_RGB8, .kind = 0},
    {"texture", make_textured, BURNISH_LOOK_STUDIO, 4, BURNISH_PIXELS_RGBA8,
     .kind = BURNISH_ALPHA_BLEND, .ground = 1},
    {"near", make_textured, BURNISH_LOOK_TECHNICAL, 4, BURNISH_PIXELS_RGB8,
     .kind = BURNISH_ALPHA_BLEND, .is_near = 1},
    {"every texture", make_textured, BURNISH_LOOK_PLAIN, 4, BURNISH_PIXELS_RGBA_FLOAT,
     .kind = BURNISH_ALPHA_BLEND | EVERY_SLOT},
    {"metal", make_textured, BURNISH_LOOK_STUDIO, 4, BURNISH_PIXELS_RGBA_FLOAT,
     .kind = BURNISH_ALPHA_BLEND | EVERY_SLOT | METALLIC},
    {"mask", make_textured, BURNISH_LOOK_PLAIN, 4, BURNISH_PIXELS_RGB8, .kind = BURNISH_ALPHA_MASK},
    {"mask, 8 samples", make_textured, BURNISH_LOOK_STUDIO, 8, BURNISH_PIXELS_RGB8,
     .kind = BURNISH_ALPHA_MASK, .shadow = 1},
    {"mask, 16 samples", make_textured, BURNISH_LOOK_PLAIN, 16, BURNISH_PIXELS_RGBA_FLOAT,
     .kind = BURNISH_ALPHA_MASK},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static burnish_render_options make_options(const scene *s, const burnish_mesh *mesh) {
    burnish_render_options options = framed_options(mesh, WIDTH, HEIGHT);
    burnish_framing framing = burnish_framing_default();
    CHECK_OK(burnish_render_options_set_look(&options, s->look, &error), error);
    options.samples = s->samples;
    options.transparent = s->transparent;
    options.ground = s->ground;
    options.shadow = s->shadow;
    options.raytracing = s->rays;
    options.edges |= s->edges;
    options.cull_back_faces = s->cull;
    if (s->contrast) {
        options.edges = 0;
        options.outline_contrast = s->contrast;
        memset(options.background, 240, sizeof options.background);
    }
    options.counts = BURNISH_COUNTS_AREA;
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
    return make_target(
        (burnish_pixels){WIDTH, count, format, sizeof p->pixels[0], p->pixels[first]},
        p->depth[first], p->normals[first], p->triangles[first], p->coverage[first]);
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

/* What a report counts, of the same picture. */
static int same_counts(const burnish_render_report *a, const burnish_render_report *b) {
    return a->covered_pixels == b->covered_pixels && a->triangles_drawn == b->triangles_drawn &&
           a->hidden_share == b->hidden_share &&
           memcmp(a->bounds, b->bounds, sizeof a->bounds) == 0;
}

static void test_scene(const scene *s) {
    static const int steps[] = {7, 64, 100, 0, 1};
    burnish_mesh *mesh = s->make(s->kind);
    burnish_render_options options = make_options(s, mesh);
    burnish_renderer *renderer = make_renderer(NULL);
    planes *whole = malloc(sizeof *whole), *first = malloc(sizeof *first);
    burnish_render_report report, first_report = {0};
    burnish_target target = target_of(first, s->format, 0, HEIGHT);
    memset(first, 0x5a, sizeof *first);
    draw_into(mesh, &options, &target, &first_report);
    CHECK(first_report.covered_pixels > 1000, "%s: it is blank", s->name);
    target = target_of(whole, s->format, 0, HEIGHT);
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        options.kernels = burnish_kernels_for((burnish_isa)isa);
        for (int several = 0; options.kernels && several < 2; ++several) {
            const int is_best = options.kernels == burnish_kernels_best() && !several;
            memset(whole, 0x5a, sizeof *whole);
            options.threads = several ? 3 + 4 * (isa % 2) : 1;
            CHECK_OK(burnish_renderer_draw_into(renderer, mesh, &options, &target, &report, &error),
                     error);
            CHECK(memcmp(whole, first, sizeof *whole) == 0 && same_counts(&report, &first_report),
                  "%s: other bits by %s, %d threads", s->name, burnish_isa_name(report.isa),
                  report.threads);
            for (int i = 0; i < 5; ++i) { /* rows one by one take their time */
                if ((is_best && i < split_count) || (i < 4 && (i + isa + several) % 4 == 0)) {
                    check_split(s, renderer, mesh, &options, steps[i], whole, &report);
                }
            }
        }
    }
    target.pixels.pixels = NULL;
    memset(whole, 0x5a, sizeof *whole);
    memcpy(whole->pixels, first->pixels, sizeof whole->pixels);
    draw_into(mesh, &options, &target, NULL);
    CHECK(memcmp(whole, first, sizeof *whole) == 0, "%s: other planes without pixels", s->name);
    burnish_image image = draw_image(mesh, &options, NULL);
    target.pixels.pixels = first->pixels[0];
    CHECK(burnish_image_get_pixels(&image).format != s->format ||
              burnish_pixels_hash(&target.pixels) == burnish_image_hash(&image),
          "%s: other pixels without planes", s->name);
    burnish_image_destroy(&image);
    free(whole);
    free(first);
    burnish_renderer_destroy(renderer);
    burnish_mesh_destroy(mesh);
}

static void test_scenes(void) {
    for (int i = 0; i < SCENES; ++i) {
        test_scene(&scenes[i]);
    }
}

/* ---- Refusals ---- */

static void test_refusals(void) {
    static const int rows[][2] = {{-1, 5},     {0, -1}, {0, HEIGHT + 1},
                                  {HEIGHT, 1}, {1, 0},  {2147483647, 2147483647}};
    burnish_mesh *mesh = make_plain(0);
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

    burnish_renderer *renderer = make_renderer(NULL);
    planes *p = malloc(sizeof *p);
    burnish_target target = target_of(p, BURNISH_PIXELS_RGB8, 0, HEIGHT);
    CHECK1(burnish_renderer_draw_into(renderer, mesh, &options, &target, NULL, &error) ==
           BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "target: 70 x 203 pixels, but the options ask for 70 x 3");
    burnish_renderer_destroy(renderer);
    free(p);
    burnish_mesh_destroy(mesh);
}

/* --splits 4: without rows one by one. */
int main(int count, char **arguments) {
    test_begin(count, arguments, "--splits");
    split_count = test_option() ? atoi(test_option()) : split_count;
    RUN(test_scenes());
    RUN(test_refusals());
    return test_end("rows");
}
