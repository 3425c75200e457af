/* A renderer that is kept draws what a new one does, whatever changes from frame to frame: meshes,
 * materials, cuts, looks, cameras, sizes, lights, samples, edges, ground, shadow, rows, threads,
 * instruction sets; and whatever failed in between. */
#include "burnish/look.h"
#include "counting_context.h"
#include "pictures.h"

enum {
    MESHES = 3,
    MATERIALS = 3,
    TEXTURES = 3,
    QUADS = 12,
    SIDE = 72, /* largest picture */
    PIXEL_MAX = 16,
    SEQUENCES = 12,
    FRAMES = 40,
    THREADS_MAX = 3
};

static burnish_error error;
static uint64_t state;

static int chance(int percent) {
    return (int)(test_random32(&state) % 100) < percent;
}

static int below(int count) {
    return (int)(test_random32(&state) % (uint32_t)count);
}

static float one_of(const float *values, int count) {
    return values[below(count)];
}

static double uniform(double low, double high) {
    return test_uniform(&state, low, high);
}

/* ---- Scenes ---- */

static burnish_texture_use random_use(void) {
    burnish_texture_use use = {.texture = 1 + below(TEXTURES), .strength = 1};
    use.wrap[0] = below(3);
    use.wrap[1] = below(3);
    use.is_nearest = chance(30);
    use.has_transform = chance(40);
    for (int i = 0; i < 6; ++i) {
        use.transform[i] = (float)uniform(-2, 2);
    }
    return use;
}

/* textures: how many the mesh has. */
static burnish_material random_material(int textures) {
    static const float transparencies[] = {0, 0, 0, 0.25f, 0.5f, 0.9f};
    static const float cutoffs[] = {0, 0.3f, 0.5f, 0.7f, 1};
    burnish_material material = burnish_material_default();
    for (int k = 0; k < 3; ++k) {
        material.ambient[k] = material.diffuse[k] = (float)uniform(0, 1);
        material.emissive[k] = chance(10) ? (float)uniform(0, 1) : 0;
    }
    material.exponent = (float)uniform(1, 200);
    material.has_diffuse = chance(50);
    material.is_metallic = chance(20);
    material.roughness = (float)uniform(0, 1);
    material.metallic = (float)uniform(0, 1);
    material.coat = chance(20) ? (float)uniform(0, 1) : 0;
    material.coat_roughness = material.sheen_roughness = (float)uniform(0, 1);
    material.sheen[1] = chance(10) ? (float)uniform(0, 1) : 0;
    material.iridescence = chance(10) ? (float)uniform(0, 1) : 0;
    material.film_index = 1.4f;
    material.film_thickness[1] = (float)uniform(0, 900);
    material.anisotropy[0] = chance(10) ? (float)uniform(-1, 1) : 0;
    material.is_unlit = chance(10);
    material.transmission = chance(30) ? (float)uniform(0, 1) : 0;
    material.thickness = chance(50) ? (float)uniform(0, 1) : 0;
    material.attenuation_distance = chance(50) ? (float)uniform(0, 2) : 0;
    material.transparency = one_of(transparencies, 6);
    material.alpha_mode = (burnish_alpha_mode)below(3);
    material.alpha_cutoff = one_of(cutoffs, 5);
    for (int slot = 0; slot < BURNISH_TEXTURE_SLOT_COUNT && textures > 0; ++slot) {
        if (chance(slot == BURNISH_TEXTURE_COLOR ? 70 : 15)) {
            material.textures[slot] = random_use();
        }
    }
    return material;
}

/* Alpha in spots as large as an eighth of the image, so masks leave holes that affect shadows. */
static void fill_texels(uint8_t *texels, int width, int height) {
    uint8_t spots[8][8];
    for (int i = 0; i < 64; ++i) {
        spots[i / 8][i % 8] = (uint8_t)(chance(30) ? 255 : test_random32(&state));
    }
    for (int i = 0; i < width * height; ++i) {
        const int x = i % width, y = i / width;
        for (int k = 0; k < 3; ++k) {
            texels[4 * i + k] = (uint8_t)test_random32(&state);
        }
        texels[4 * i + 3] = spots[8 * y / height][8 * x / width];
    }
}

/* Squares in a heap, each of them of one of the materials, above a floor. */
static burnish_mesh *make_quads(void) {
    enum { WIDTHS = 4 };
    static const int sides[WIDTHS] = {1, 16, 33, 50};
    static uint8_t texels[TEXTURES][4 * 50 * 50];
    float positions[QUADS][4][3], coordinates[QUADS][4][2];
    uint8_t colors[QUADS][4][4];
    uint16_t triangle_materials[QUADS][2];
    burnish_texture textures[TEXTURES];
    burnish_material materials[MATERIALS];
    for (int i = 0; i < TEXTURES; ++i) {
        const int width = sides[below(WIDTHS)], height = sides[below(WIDTHS)];
        fill_texels(texels[i], width, height);
        textures[i] = (burnish_texture){NULL, width, height, texels[i], i != 1};
    }
    for (int i = 0; i < MATERIALS; ++i) {
        materials[i] = random_material(TEXTURES);
    }
    for (int i = 0; i < QUADS; ++i) {
        const float size = i == 0 ? 2.0f : 0.7f;
        float middle[3], sides_of[2][3];
        for (int k = 0; k < 3; ++k) {
            middle[k] = i == 0 ? (k == 1 ? -1.0f : 0) : (float)uniform(-1, 1);
            sides_of[0][k] = i == 0 ? (float)(k == 0) : (float)uniform(-1, 1);
            sides_of[1][k] = i == 0 ? (float)(k == 2) : (float)uniform(-1, 1);
        }
        for (int c = 0; c < 4; ++c) {
            const float u = c == 1 || c == 2, v = c >= 2;
            for (int k = 0; k < 3; ++k) {
                positions[i][c][k] = middle[k] + size * ((2 * u - 1) * sides_of[0][k] +
                                                         (2 * v - 1) * sides_of[1][k]);
            }
            coordinates[i][c][0] = 2 * u;
            coordinates[i][c][1] = v;
            for (int k = 0; k < 4; ++k) {
                colors[i][c][k] = (uint8_t)(k < 3 || i % 5 == 1 ? test_random32(&state) : 255);
            }
        }
        triangle_materials[i][0] = triangle_materials[i][1] = (uint16_t)below(MATERIALS);
    }
    burnish_mesh_description arrays =
        describe_quads(positions[0][0], chance(50) ? colors[0][0] : NULL, QUADS);
    arrays.triangle_materials = (burnish_array){triangle_materials, 2 * QUADS, 0};
    give_materials(&arrays, materials, MATERIALS);
    give_textures(&arrays, coordinates[0][0], textures, TEXTURES);
    return create_mesh(&arrays, NULL);
}

/* Points, with alpha or without colours, up to more than the other meshes have vertices. */
static burnish_mesh *make_cloud(void) {
    enum { MOST = 600 };
    struct {
        float position[3];
        uint32_t color;
    } points[MOST];
    char file[512 + sizeof points];
    const int count = 20 + below(MOST - 20);
    const int size = snprintf(file, sizeof file,
                              "ply\nformat binary_little_endian 1.0\nelement vertex %d\n"
                              "property float x\nproperty float y\nproperty float z\n%s"
                              "end_header\n",
                              count,
                              chance(50) ? "property uchar red\nproperty uchar green\n"
                                           "property uchar blue\nproperty uchar alpha\n"
                                         : "property int id\n");
    for (int i = 0; i < count; ++i) {
        points[i].color = test_random32(&state);
        for (int k = 0; k < 3; ++k) {
            points[i].position[k] = (float)uniform(-1, 1);
        }
    }
    memcpy(file + size, points, (size_t)count * sizeof *points);
    return load_bytes(file, (size_t)size + (size_t)count * sizeof *points, NULL, NULL);
}

static burnish_mesh *make_mesh(void) {
    static const char *const names[] = {":knot", ":torus", ":sphere"};
    if (chance(75)) {
        return chance(75) ? make_quads() : make_cloud();
    }
    return load_measured(names[below(3)], 3); /* cuts are filled */
}

/* ---- Changes ---- */

typedef struct frame {
    burnish_mesh *meshes[MESHES];
    int mesh; /* that is drawn */
    burnish_render_options options;
    burnish_framing framing;
    double nearer; /* share of the way to the focal point */
    burnish_pixel_format format;
    unsigned planes; /* bits: pixels are left out; depth, triangles, normals, coverage */
    const char *changes[8];
} frame;

static void change_mesh(frame *f) {
    f->mesh = below(MESHES);
    if (chance(30)) {
        burnish_mesh_destroy(f->meshes[f->mesh]);
        f->meshes[f->mesh] = make_mesh();
    }
}

static void change_material(frame *f) {
    burnish_mesh *mesh = f->meshes[f->mesh];
    const size_t i = (size_t)below((int)burnish_mesh_get_material_count(mesh));
    const int textures = (int)burnish_mesh_get_texture_count(mesh);
    burnish_material material = *burnish_mesh_get_material(mesh, i),
                     other = random_material(textures);
    switch (below(5)) {
    case 0:
        material = other;
        break;
    case 1:
        material.alpha_cutoff = other.alpha_cutoff;
        break;
    case 2:
        material.transparency = other.transparency;
        break;
    case 3:
        material.alpha_mode = other.alpha_mode;
        break;
    default:
        memcpy(material.textures, other.textures, sizeof other.textures);
        material.alpha_mode = chance(50) ? BURNISH_ALPHA_MASK : material.alpha_mode;
    }
    if (!burnish_mesh_get_view(mesh)->tangents) {
        material.textures[BURNISH_TEXTURE_NORMAL].texture = 0;
        material.textures[BURNISH_TEXTURE_COAT_NORMAL].texture = 0;
        memset(material.anisotropy, 0, sizeof material.anisotropy);
    }
    if (!burnish_mesh_get_view(mesh)->texture_coordinates) {
        memset(material.textures, 0, sizeof material.textures);
    }
    CHECK_OK(burnish_mesh_set_material(mesh, i, &material, &error), error);
}

static void change_cut(frame *f) {
    const burnish_clip_plane plane = {{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)},
                                      uniform(0, 0.8)};
    burnish_mesh_clip(f->meshes[f->mesh], &plane, &error); /* fails where nothing is left */
}

static void change_camera(frame *f) {
    f->framing.azimuth = uniform(-180, 180);
    f->framing.elevation = uniform(-40, 80);
    f->framing.orthographic = chance(30);
    f->nearer = chance(20) ? uniform(0, 0.9) : 0;
    const int is_shifted = !f->framing.orthographic && chance(30);
    f->options.principal_point[0] = is_shifted ? uniform(-9, 9) : 0;
    f->options.pixel_aspect = is_shifted ? uniform(0.5, 2) : 1;
}

static void change_size(frame *f) {
    f->options.width = 1 + below(SIDE);
    f->options.height = 1 + below(SIDE);
}

static void change_look(frame *f) {
    const burnish_look look = (burnish_look)below(BURNISH_LOOK_COUNT);
    CHECK_OK(burnish_render_options_set_look(&f->options, look, &error), error);
    f->options.occlusion = f->options.occlusion ? 6 : 0;
    if (chance(10)) {
        CHECK_OK(burnish_look_set_materials(look, f->meshes[f->mesh], &error), error);
    }
}

static void change_lights(frame *f) {
    f->options.light_count = below(3);
    for (int i = 0; i < f->options.light_count; ++i) {
        burnish_light *light = &f->options.lights[i];
        light->kind = chance(80) ? BURNISH_LIGHT_DIRECTIONAL : BURNISH_LIGHT_POINT;
        light->follows_camera = chance(30);
        light->distance = chance(30) ? uniform(0, 2) : 0;
        light->range = chance(30) ? uniform(0, 2) : 0;
        light->cone[0] = uniform(0.5, 1);
        light->cone[1] = light->cone[0] - uniform(0, 1);
        const int has_cone = chance(30);
        for (int k = 0; k < 3; ++k) {
            light->axis[k] = has_cone ? uniform(-1, 1) : 0;
            light->vector[k] = uniform(-1, 2);
            light->color[k] = (float)uniform(0, 1);
        }
    }
}

static void change_area_lights(frame *f) {
    burnish_render_options *o = &f->options;
    o->area_light_count = chance(60) ? below(4) : 0;
    for (int i = 0; i < o->area_light_count; ++i) {
        burnish_area_light *light = &o->area_lights[i];
        light->shape = (burnish_area_shape)below(4);
        light->is_distant = chance(70);
        light->is_two_sided = chance(50);
        light->follows_camera = chance(50);
        for (int k = 0; k < 3; ++k) {
            light->center[k] = uniform(-1, 2);
            light->half_u[k] = uniform(-1, 1);
            light->half_v[k] = uniform(-1, 1);
            light->color[k] = (float)uniform(0, 4);
        }
        light->center[2] += light->shape > BURNISH_AREA_DISC ? 3 : 0; /* farther than a radius */
    }
    o->has_dome = chance(40);
    o->reflection_distance = chance(50) ? (float)uniform(1.25, 4) : 0;
    o->dome.follows_camera = chance(50);
    for (int k = 0; k < 3; ++k) {
        o->dome.zenith[k] = (float)uniform(0, 2);
        o->dome.horizon[k] = (float)uniform(0.5, 1);
    }
}

static void change_occlusion(frame *f) {
    f->options.occlusion = 2 * below(5);
    f->options.occlusion_strength = (float)uniform(0, 1);
    f->options.ground = chance(60);
    f->options.shadow = chance(60);
    f->options.raytracing = chance(50);
    for (int k = 0; k < 3; ++k) {
        f->options.up[k] = chance(30) ? uniform(-1, 1) : 0;
    }
}

static void change_edges(frame *f) {
    static const int edges[] = {0,
                                BURNISH_EDGES_FEATURES,
                                BURNISH_EDGES_MATERIALS,
                                BURNISH_EDGES_ALL,
                                BURNISH_EDGES_SILHOUETTES,
                                BURNISH_EDGES_AXIS_VIEWS};
    f->options.edges = edges[below(6)];
    f->options.edge_width = (float)uniform(0.5, 3);
    f->options.edge_opacity = (float)uniform(0, 1);
    f->options.edge_color[0] = (uint8_t)below(256);
    f->options.outline_contrast = chance(50) ? below(256) : 0;
}

static void change_samples(frame *f) {
    static const int samples[] = {1, 4, 8, 16};
    f->options.samples = samples[below(4)];
    f->options.threads = 1 + below(THREADS_MAX);
    f->options.kernels = chance(50) ? burnish_kernels_for(BURNISH_ISA_SCALAR) : NULL;
}

static void change_shading(frame *f) {
    static const char *const lobes[] = {"taylor:2", "minimax:4", "power", "lyon:4", "zeta20"};
    CHECK_OK(burnish_lobe_spec_parse(lobes[below(5)], &f->options.lobe, &error), error);
    f->options.specular_model = (burnish_specular_model)below(2);
    f->options.local_viewer = chance(50);
    f->options.ignore_colors = chance(30);
    f->options.cull_back_faces = chance(30);
    f->options.background[1] = (uint8_t)below(256);
    f->options.exposure = chance(30) ? (float)uniform(-2, 2) : 0;
    f->options.tone_mapping = (burnish_tone_mapping)below(BURNISH_TONES_COUNT);
}

static void change_target(frame *f) {
    f->options.transparent = chance(40);
    f->format = (burnish_pixel_format)below(BURNISH_PIXELS_RGBA_FLOAT + 1);
    if (f->options.transparent && f->format == BURNISH_PIXELS_RGB8) {
        f->format = BURNISH_PIXELS_RGBA8;
    }
    f->planes = chance(30) ? test_random32(&state) % 32 : 0;
    f->options.counts = (burnish_counts)below(4);
}

static void change_limit(frame *f) {
    static const float limits[] = {BURNISH_OVERDRAW_DEFAULT, BURNISH_OVERDRAW_DEFAULT, 1, 4};
    f->options.max_overdraw = (double)one_of(limits, 4);
}

static void change_rows(frame *f) {
    f->options.first_row = f->options.row_count = 0;
    if (chance(60)) {
        f->options.row_count = 1 + below(f->options.height);
        f->options.first_row = below(f->options.height - f->options.row_count + 1);
    }
}

static const struct {
    const char *name;
    void (*make)(frame *f);
} changes[] = {{"material", change_material},   {"material", change_material},
               {"mesh", change_mesh},           {"cut", change_cut},
               {"camera", change_camera},       {"size", change_size},
               {"look", change_look},           {"lights", change_lights},
               {"occlusion", change_occlusion}, {"area lights", change_area_lights},
               {"edges", change_edges},         {"samples", change_samples},
               {"shading", change_shading},     {"target", change_target},
               {"limit", change_limit},         {"rows", change_rows}};
enum { CHANGES = sizeof changes / sizeof *changes };

/* State that earlier changes may have left and that no longer applies. */
static void settle(frame *f) {
    burnish_render_options *o = &f->options;
    o->shadow &= o->light_count > 0 ? o->lights[0].kind == BURNISH_LIGHT_DIRECTIONAL
                                    : o->area_light_count > 0;
    if (o->first_row + o->row_count > o->height) {
        o->first_row = o->row_count = 0;
    }
    f->framing.aspect = (double)o->width / o->height;
    CHECK_OK(burnish_camera_frame(f->meshes[f->mesh], &f->framing, &o->camera, &error), error);
    for (int k = 0; k < 3; ++k) {
        o->camera.position[k] += f->nearer * (o->camera.focal_point[k] - o->camera.position[k]);
    }
}

/* ---- Frames ---- */

/* All that a call hands over. */
typedef struct result {
    burnish_status status;
    burnish_error error;
    burnish_render_report report;
    uint8_t pixels[SIDE * SIDE * PIXEL_MAX];
    float depth[SIDE * SIDE], normals[3 * SIDE * SIDE];
    uint32_t triangles[SIDE * SIDE];
    uint8_t coverage[SIDE * SIDE];
} result;

static void draw(burnish_renderer *renderer, const frame *f, result *to) {
    const int width = f->options.width;
    const int rows = f->options.row_count ? f->options.row_count : f->options.height;
    const burnish_target target =
        make_target((burnish_pixels){width, rows, f->format, (size_t)width * PIXEL_MAX,
                                     f->planes & 1 ? NULL : to->pixels},
                    f->planes & 2 ? to->depth : NULL, f->planes & 8 ? to->normals : NULL,
                    f->planes & 4 ? to->triangles : NULL, f->planes & 16 ? to->coverage : NULL);
    memset(to, 0x5a, sizeof *to);
    memset(&to->report, 0, sizeof to->report);
    to->error.text[0] = 0;
    to->status = burnish_renderer_draw_into(renderer, f->meshes[f->mesh], &f->options, &target,
                                            &to->report, &to->error);
    to->report.seconds_transform = to->report.seconds_draw = 0;
}

static int same_lines(const burnish_lines *a, const burnish_lines *b) {
    return a->line_count == b->line_count &&
           (a->line_count == 0 ||
            (a->point_count == b->point_count &&
             memcmp(a->starts, b->starts, (a->line_count + 1) * sizeof *a->starts) == 0 &&
             memcmp(a->widths, b->widths, a->line_count * sizeof *a->widths) == 0 &&
             memcmp(a->points, b->points, 2 * a->point_count * sizeof *a->points) == 0));
}

static const char *difference(const result *a, const result *b) {
    return a->status != b->status                                         ? "status"
           : strcmp(a->error.text, b->error.text) != 0                    ? "message"
           : a->status != BURNISH_STATUS_OK                               ? NULL
           : memcmp(a->pixels, b->pixels, sizeof a->pixels) != 0          ? "pixels"
           : memcmp(a->depth, b->depth, sizeof a->depth) != 0             ? "depths"
           : memcmp(a->normals, b->normals, sizeof a->normals) != 0       ? "normals"
           : memcmp(a->triangles, b->triangles, sizeof a->triangles) != 0 ? "triangles"
           : memcmp(a->coverage, b->coverage, sizeof a->coverage) != 0    ? "coverage"
           : memcmp(&a->report, &b->report, sizeof a->report) != 0        ? "report"
                                                                          : NULL;
}

/* Returns 0 where the pictures differ. */
static int check_frame(burnish_renderer *kept, counts *c, const frame *f, int sequence,
                       int number) {
    static result ours, fresh;
    burnish_renderer *renderer;
    const int is_disturbed = chance(8);
    atomic_store(&c->left, is_disturbed && chance(50) ? below(40) : -1);
    c->questions = is_disturbed && atomic_load(&c->left) < 0 ? below(60) : -1;
    draw(kept, f, &ours);
    atomic_store(&c->left, -1);
    c->questions = -1;
    if (is_disturbed &&
        (ours.status == BURNISH_STATUS_MEMORY || ours.status == BURNISH_STATUS_CANCELLED)) {
        return 1; /* the frames after it count */
    }
    CHECK_OK(burnish_renderer_create(NULL, &renderer, &error), error);
    draw(renderer, f, &fresh);
    const char *what = difference(&ours, &fresh);
    if (!what && ours.status == BURNISH_STATUS_OK &&
        !same_lines(burnish_renderer_get_lines(kept), burnish_renderer_get_lines(renderer))) {
        what = "lines";
    }
    burnish_renderer_destroy(renderer);
    return CHECK(!what, "sequence %d, frame %d: other %s (%s; %s) after changes of %s %s %s",
                 sequence, number, what, ours.error.text, fresh.error.text, f->changes[0],
                 f->changes[1], f->changes[2]);
}

static frame first_frame(void) {
    frame f = {.options = burnish_render_options_default(), .framing = burnish_framing_default()};
    f.format = BURNISH_PIXELS_RGB8;
    f.options.width = f.options.height = SIDE;
    for (int i = 0; i < MESHES; ++i) {
        f.meshes[i] = make_mesh();
    }
    change_occlusion(&f);
    return f;
}

static void test_sequence(int number) {
    counts c;
    burnish_context *context = make_context(&c);
    burnish_renderer *kept = NULL;
    state = test_seed(1000 + (uint64_t)number);
    frame f = first_frame();
    int is_same = CHECK_OK(burnish_renderer_create(context, &kept, &error), error);
    for (int i = 0; i < FRAMES && is_same; ++i) {
        for (int k = 0, count = below(4); k < 3; ++k) {
            const int change = below(CHANGES);
            f.changes[k] = k < count ? changes[change].name : "";
            if (k < count) {
                changes[change].make(&f);
            }
        }
        settle(&f);
        is_same = check_frame(kept, &c, &f, number, i);
    }
    burnish_renderer_destroy(kept);
    burnish_context_destroy(context);
    CHECK(c.live == 0, "%ld allocations are left", (long)c.live);
    for (int i = 0; i < MESHES; ++i) {
        burnish_mesh_destroy(f.meshes[i]);
    }
}

static void test_sequences(void) {
    const int count = test_option() ? atoi(test_option()) : SEQUENCES;
    for (int i = 0; i < count; ++i) {
        test_sequence(i);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, "--sequences");
    RUN(test_sequences());
    return test_end("kept");
}
