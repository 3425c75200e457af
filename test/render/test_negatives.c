/* Negative volumes: depths of boxes minus boxes against intervals along rays, limits, and the same
 * bits everywhere. */
#include <math.h>

#include "burnish/kernels.h"
#include "core/vec3.h"
#include "pictures.h"
#include "threemf_input.h"

enum { BOXES_MAX = 40, SIDE = 48 };

typedef struct box {
    double low[3], high[3];
} box;

/* Two items of the same object, the second one moved by 5 along x; solids come first, and every
 * other box is inside out. */
typedef struct scene {
    box boxes[BOXES_MAX];
    int solids, count, items;
    double cut[4]; /* what is beyond a plane is cut away; all 0: nothing */
} scene;

static burnish_mesh *load_scene(const scene *s) {
    static const int corners[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5},
                                       {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                       {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    static char model[1 << 17], settings[1 << 14];
    char *m = model, *c = settings;
    m += sprintf(m, "<model unit='millimeter' xmlns='http://schemas.microsoft.com/3dmanufacturing/"
                    "core/2015/02'><resources><object id='1'><mesh><vertices>");
    c += sprintf(c, "<config><object id='1'>");
    for (int i = 0; i < 8 * s->count; ++i) {
        const box *b = &s->boxes[i / 8];
        m += sprintf(m, "<vertex x='%.9g' y='%.9g' z='%.9g'/>", (i & 1 ? b->high : b->low)[0],
                     (i & 2 ? b->high : b->low)[1], (i & 4 ? b->high : b->low)[2]);
    }
    m += sprintf(m, "</vertices><triangles>");
    for (int i = 0; i < 12 * s->count; ++i) {
        const int *at = corners[i % 12], first = 8 * (i / 12);
        const int is_turned = i / 12 % 2;
        m += sprintf(m, "<triangle v1='%d' v2='%d' v3='%d'/>", first + at[0],
                     first + at[1 + is_turned], first + at[2 - is_turned]);
    }
    for (int i = 0; i < s->count; ++i) {
        c += sprintf(c,
                     "<volume firstid='%d' lastid='%d'><metadata type='volume' "
                     "key='volume_type' value='%s'/></volume>",
                     12 * i, 12 * i + 11, i < s->solids ? "ModelPart" : "NegativeVolume");
    }
    sprintf(c, "</object></config>");
    sprintf(m,
            "</triangles></mesh></object></resources><build><item objectid='1'/>%s</build>"
            "</model>",
            s->items > 1 ? "<item objectid='1' transform='1 0 0 0 1 0 0 0 1 5 0 0'/>" : "");
    zip_list *zip = begin_3mf(model);
    put_part_text(zip, "Metadata/Slic3r_PE_model.config", quoted_text(settings));
    end_zip(zip, 0);
    burnish_load_options load = burnish_load_options_default();
    load.measure = 1;
    burnish_mesh *mesh = load_bytes(zip->bytes, zip->size, NULL, &load);
    if (s->cut[0] != 0 || s->cut[1] != 0 || s->cut[2] != 0) {
        cut_mesh(mesh, s->cut[0], s->cut[1], s->cut[2], s->cut[3]);
    }
    return mesh;
}

/* ---- Rays ---- */

static int is_filled(const scene *s, const double p[3]) {
    if (s->cut[0] * p[0] + s->cut[1] * p[1] + s->cut[2] * p[2] > s->cut[3]) {
        return 0;
    }
    for (int item = 0; item < s->items; ++item) {
        int in[2] = {0, 0};
        for (int i = 0; i < s->count; ++i) {
            int is_in = 1;
            for (int k = 0; k < 3; ++k) {
                const double at = p[k] - (k == 0 ? 5 * item : 0);
                is_in &= at > s->boxes[i].low[k] && at < s->boxes[i].high[k];
            }
            in[i >= s->solids] |= is_in;
        }
        if (in[0] && !in[1]) {
            return 1;
        }
    }
    return 0;
}

/* How far the first filled point of a ray is; infinity if there is none. */
static double first_filled(const scene *s, const double from[3], const double toward[3]) {
    double nearest = INFINITY;
    for (int i = 0; i <= 6 * s->count * s->items; ++i) {
        double at;
        if (i == 6 * s->count * s->items) {
            const double *n = s->cut;
            at = (n[3] - (n[0] * from[0] + n[1] * from[1] + n[2] * from[2])) /
                 (n[0] * toward[0] + n[1] * toward[1] + n[2] * toward[2]);
        } else {
            const box *b = &s->boxes[i / 6 % s->count];
            const int k = i % 3;
            const double move = k == 0 ? 5 * (i / 6 / s->count) : 0;
            at = ((i % 6 < 3 ? b->low : b->high)[k] + move - from[k]) / toward[k];
        }
        const double after = at + 1e-9;
        const double p[3] = {from[0] + after * toward[0], from[1] + after * toward[1],
                             from[2] + after * toward[2]};
        nearest = at > 0 && at < nearest && is_filled(s, p) ? at : nearest;
    }
    return nearest;
}

/* ---- Pictures ---- */

static burnish_render_options view_from(double x, double y, double z) {
    burnish_render_options options = front_options(SIDE, SIDE, 14);
    options.camera.position[0] = x;
    options.camera.position[1] = y;
    options.camera.position[2] = z;
    options.camera.focal_point[0] = 2;
    return options;
}

/* Whether the depth of a pixel is among those of rays within 1/16 pixel of its middle. */
static int is_depth_of(const scene *s, const burnish_camera *camera, int pixel, float depth) {
    static const double offsets[5][2] = {{0, 0}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    const burnish_vec3 eye = burnish_vec3_load(camera->position);
    const burnish_vec3 forward =
        burnish_vec3_normalize(burnish_vec3_sub(burnish_vec3_load(camera->focal_point), eye));
    const burnish_vec3 right =
        burnish_vec3_normalize(burnish_vec3_cross(forward, burnish_vec3_load(camera->view_up)));
    const burnish_vec3 up = burnish_vec3_cross(right, forward);
    double least = INFINITY, most = 0;
    int is_empty = 0;
    for (int i = 0; i < 5; ++i) {
        const double step = camera->orthographic_height / SIDE;
        const double x = (pixel % SIDE + 0.5 + offsets[i][0] / 16 - SIDE * 0.5) * step;
        const double y = (SIDE * 0.5 - pixel / SIDE - 0.5 - offsets[i][1] / 64) * step;
        double from[3], toward[3];
        burnish_vec3_store(burnish_vec3_add(eye, burnish_vec3_add(burnish_vec3_scale(right, x),
                                                                  burnish_vec3_scale(up, y))),
                           from);
        burnish_vec3_store(forward, toward);
        const double expected = first_filled(s, from, toward);
        least = expected < least ? expected : least;
        most = expected > most ? expected : most;
        is_empty |= isinf(expected);
    }
    return isinf(depth) ? is_empty : (double)depth > least - 0.004 && (double)depth < most + 0.004;
}

static void check_depths(int number, const scene *s, double x, double y, double z) {
    OWNED_MESH *mesh = load_scene(s);
    const burnish_render_options options = view_from(x, y, z);
    float depth[SIDE * SIDE];
    const burnish_target target = make_target(
        (burnish_pixels){SIDE, SIDE, BURNISH_PIXELS_RGB8, 0, NULL}, depth, NULL, NULL, NULL);
    int wrong = 0;
    draw_into(mesh, &options, &target, NULL);
    for (int i = 0; i < SIDE * SIDE; ++i) {
        wrong += !is_depth_of(s, &options.camera, i, depth[i]);
    }
    CHECK(wrong <= 1, "scene %d: %d pixels have another depth", number, wrong);
}

/* Boxes with some faces in common; no skins thinner than vertices snap. */
static void test_random(int scenes) {
    uint64_t state = test_seed(45);
    for (int n = 0; n < scenes; ++n) {
        scene s = {.solids = 1 + n % 2, .count = 3 + n % 5, .items = 1 + n / 2 % 2};
        for (int i = 0; i < s.count; ++i) {
            for (int k = 0; k < 3; ++k) {
                const double size = i < s.solids ? 2 : 1.5;
                s.boxes[i].low[k] = -round(test_uniform(&state, 1, 8 * (size + 0.6))) / 8;
                s.boxes[i].high[k] = round(test_uniform(&state, 1, 8 * (size + 0.6))) / 8;
            }
        }
        if (n % 3 == 2) {
            for (int k = 0; k < 3; ++k) {
                s.cut[k] = test_uniform(&state, 0.2, 1) * (test_random32(&state) % 2 ? 1 : -1);
            }
            s.cut[3] = test_uniform(&state, 0, 1);
        }
        check_depths(n, &s, test_uniform(&state, -20, 20), test_uniform(&state, -20, 20),
                     test_uniform(&state, 5, 20));
    }
}

/* Faces in faces of the solid leave no skin. */
static void test_flush(void) {
    const scene s = {
        {{{-2, -2, -2}, {2, 2, 2}}, {{-1, -1, -2}, {1, 1, 2}}, {{0, -2, 0}, {2, 2, 2}}},
        1,
        3,
        1,
        {0}};
    check_depths(-1, &s, 2.013, 0.017, 20);
    check_depths(-1, &s, 9, -7, 12);
}

/* Walls of negative volumes have the colours of their own heights. */
static void test_heights(void) {
    const scene s = {{{{-2, -2, -2}, {2, 2, 2}}, {{-1, -1, -1}, {1, 3, 1}}}, 1, 2, 1, {0}};
    OWNED_MESH *mesh = load_scene(&s);
    const burnish_coloring coloring = burnish_coloring_default();
    burnish_error error = {0};
    CHECK_OK(burnish_mesh_color_by(mesh, &coloring, NULL, &error), error);
    const burnish_mesh_view *view = burnish_mesh_get_view(burnish_mesh_get_negatives(mesh));
    for (size_t i = 0; i < view->vertex_count && CHECK1(view->texture_coordinates); ++i) {
        const float height = (view->positions[3 * i + 2] + 2) / 4;
        CHECK1(fabsf(view->texture_coordinates[2 * i] - (255 * height + 0.5F) / 256) < 1e-6F);
    }
}

/* ---- Limits ---- */

/* Boxes in boxes: `count` negative volumes are open before the last one is left. */
static scene make_nested(int count) {
    scene s = {{{{-2, -2, -2}, {2, 2, 2}}}, 1, 1 + count, 1, {0}};
    for (int i = 0; i < count; ++i) {
        const double half = 0.5 + 0.03 * i;
        s.boxes[1 + i] = (box){{-half, -half, -half}, {half, half, 3 + half}};
    }
    return s;
}

static void test_limits(void) {
    scene s = make_nested(16);
    check_depths(-1, &s, 4, 3, 20);
    s = make_nested(17);
    OWNED_MESH *mesh = load_scene(&s);
    const burnish_render_options options = view_from(4, 3, 20);
    burnish_image image = {0};
    burnish_error error = {0};
    CHECK1(burnish_render(mesh, &options, &image, NULL, &error) == BURNISH_STATUS_LIMIT);
    CHECK_TEXT(error.text,
               "negative volumes: more than 16 of an object, or more than 256 surfaces, "
               "lie over a sample; join some in the slicer");
}

/* ---- Bits ---- */

/* By every instruction set, in a new renderer and in one that has drawn other meshes. */
static void test_bits(int samples, float transmission) {
    const scene s = {
        {{{-2, -2, -2}, {2, 2, 2}}, {{-1, -1, -3}, {1, 0.5, 3}}, {{0, -3, 0}, {3, 3, 3}}},
        1,
        3,
        2,
        {-0.2, 1, 0.1, 1}};
    scene whole = s;
    whole.count = 1;
    OWNED_MESH *mesh = load_scene(&s);
    OWNED_MESH *other = load_scene(&whole);
    burnish_render_options options = framed_options(mesh, 150, 130);
    burnish_material material = *burnish_mesh_get_material(mesh, 0);
    material.is_metallic = transmission > 0;
    material.transmission = material.thickness = transmission;
    set_material(mesh, &material);
    set_material(other, &material);
    burnish_renderer *renderer = make_renderer(NULL);
    burnish_error error = {0};
    options.samples = samples;
    options.occlusion = BURNISH_OCCLUSION_AUTO;
    options.has_dome = transmission > 0;
    set_three(options.dome.zenith, 1);
    set_three(options.dome.horizon, 1);
    set_three(options.dome.nadir, 1);
    const uint64_t hash = hash_drawn(mesh, &options), before = hash_drawn(other, &options);
    CHECK1(hash != before);
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        options.kernels = burnish_kernels_for((burnish_isa)isa);
        options.threads = 1 + isa % 2;
        for (int i = 0; options.kernels && i < 3; ++i) {
            burnish_image image = {0};
            CHECK_OK(burnish_renderer_draw(renderer, i == 1 ? other : mesh, &options, &image, NULL,
                                           &error),
                     error);
            CHECK(burnish_image_hash(&image) == (i == 1 ? before : hash), "%s, picture %d",
                  burnish_isa_name((burnish_isa)isa), i);
            burnish_image_destroy(&image);
        }
    }
    burnish_renderer_destroy(renderer);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_random(24));
    RUN(test_flush());
    RUN(test_heights());
    RUN(test_limits());
    RUN(test_bits(1, 0));
    RUN(test_bits(4, 0));
    RUN(test_bits(4, 0.5F));
    return test_end("negatives");
}
