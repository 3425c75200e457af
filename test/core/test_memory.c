/* Memory runs short at every allocation of loading, drawing and encoding, one after another: the
 * call says so, or the picture is right; nothing is lost, and a renderer goes on afterwards. */
#include <unistd.h>

#include "burnish/image.h"
#include "burnish/light.h"
#include "counting_context.h"
#include "failing_malloc.h"
#include "pictures.h"
#include "shapes.h"

/* ---- The linker leads the library's calls of malloc and its kin here ---- */

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *old, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
char *__real_strdup(const char *text);
void __real_free(void *memory);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
char *__wrap_strdup(const char *text);
void __wrap_free(void *memory);

void *__wrap_malloc(size_t size) {
    return fails() ? NULL : count_one(__real_malloc(size));
}
void *__wrap_calloc(size_t count, size_t size) {
    return fails() ? NULL : count_one(__real_calloc(count, size));
}
void *__wrap_realloc(void *old, size_t size) {
    void *memory = fails() ? NULL : __real_realloc(old, size);
    return old ? memory : count_one(memory);
}
void *__wrap_aligned_alloc(size_t alignment, size_t size) {
    return fails() ? NULL : count_one(__real_aligned_alloc(alignment, size));
}
char *__wrap_strdup(const char *text) {
    return fails() ? NULL : count_one(__real_strdup(text));
}
void __wrap_free(void *memory) {
    atomic_fetch_sub(&live, memory != NULL);
    __real_free(memory);
}

/* ---- File to PNG ---- */

enum { SIZE = 66 }; /* four tiles */

typedef struct picture_job {
    const char *path; /* of the file, or a built-in object */
    int samples, threads;
} picture_job;

/* File to mesh to picture to PNG. *hash: of the picture and of the PNG's bytes; 0 on error. */
static burnish_status work(const void *data, uint64_t *hash, burnish_error *error) {
    const picture_job *job = data;
    burnish_load_options load = burnish_load_options_default();
    burnish_framing framing = burnish_framing_default();
    burnish_render_options render = burnish_render_options_default();
    burnish_mesh *mesh = NULL;
    burnish_image image = {0};
    uint8_t *png = NULL;
    size_t png_size = 0;
    load.threads = render.threads = job->threads;
    load.tessellation = 4;
    render.width = render.height = SIZE;
    render.samples = job->samples;
    *hash = 0;
    burnish_status status = burnish_mesh_load(job->path, &load, &mesh, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_camera_frame(mesh, &framing, &render.camera, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_render(mesh, &render, &image, NULL, error);
    }
    if (status == BURNISH_STATUS_OK) {
        const burnish_pixels pixels = burnish_image_get_pixels(&image);
        burnish_png_options options = burnish_png_options_default();
        options.threads = job->threads;
        status = burnish_png_encode(&pixels, &options, &png, &png_size, error);
    }
    if (status == BURNISH_STATUS_OK) {
        *hash = test_add_hash(burnish_image_hash(&image), png, png_size);
    }
    burnish_release(NULL, png);
    burnish_image_destroy(&image);
    burnish_mesh_destroy(mesh);
    return status;
}

/* Colours of 16 vertices, as ZBrush has them. */
#define PAINT_4 "ff000000ff112233ff445566ff778899"
#define PAINT_16 PAINT_4 PAINT_4 PAINT_4 PAINT_4

/* A file of each format in the current folder, with as much in it as the format holds. */
static void write_inputs(void) {
    burnish_image image;
    CHECK1(burnish_image_create(NULL, &image, 5, 4, 4, NULL) == BURNISH_STATUS_OK &&
           burnish_image_write_png(&image, "memory.png", NULL) == BURNISH_STATUS_OK);
    burnish_image_destroy(&image);
    test_write_file("memory.mtl", "newmtl red\nKd .8 .1 .1\nNs 20\nmap_Kd memory.png\n"
                                  "bump memory.png\nmap_Ns memory.png\nmap_d memory.png\n"
                                  "newmtl blue\nKd .1 .1 .8\n");
    test_write_file("memory.obj", "mtllib memory.mtl none.mtl\nusemtl red\n"
                                  "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 0\n"
                                  "v .5 .5 1 1 1 1\nvn 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
                                  "f 1/1/1 2/2/1 3/3/1 4/1/1\nusemtl blue\n"
                                  "f 1 2 5\nf 2 3 5\nusemtl none\nf 3 4 5\nf 4 1 5\nf 1 1 2\n"
                                  "#MRGB " PAINT_16 PAINT_16 PAINT_16 PAINT_16 PAINT_16 "\n");
    test_write_file("memory.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                                  "property float y\nproperty float z\nproperty uchar red\n"
                                  "property uchar green\nproperty uchar blue\nelement face 4\n"
                                  "property list uchar int vertex_indices\nend_header\n"
                                  "1e6 0 0 255 0 0\n1000001 0 0 0 255 0\n" /* read twice */
                                  "1e6 1 0 0 0 255\n1e6 0 1 9 9 9\n"
                                  "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
    test_write_file("memory.stl", "solid memory\n"
                                  "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 0 1 0 "
                                  "vertex 1 0 0 endloop endfacet\n"
                                  "facet normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 "
                                  "vertex 0 0 1 endloop endfacet\n"
                                  "endsolid\n");
}

static void check_formats(int threads) {
    static const char *const paths[] = {"memory.obj", "memory.ply", "memory.stl", ":teapot"};
    for (int i = 0; i < 4; ++i) {
        for (int samples = 1; samples <= 4; samples += 3) {
            const picture_job job = {paths[i], samples, threads};
            fail_each(paths[i], work, &job, 11);
        }
    }
}

static void test_files(void) {
    char folder[] = TEST_BINARY_DIR "/memory-XXXXXX";
    if (!CHECK1(mkdtemp(folder) && chdir(folder) == 0)) {
        return;
    }
    write_inputs();
    check_formats(1);
    check_formats(3);
    CHECK1(unlink("memory.mtl") == 0 && unlink("memory.obj") == 0 && unlink("memory.ply") == 0 &&
           unlink("memory.stl") == 0 && unlink("memory.png") == 0 && chdir("..") == 0 &&
           rmdir(folder) == 0);
}

/* ---- A renderer, used again ---- */

/* Kinds of boxes: the mode of their textures' alpha, without textures, with edges, or with all kinds
 * of lights. */
enum { PLAIN = BURNISH_ALPHA_BLEND + 1, EDGES, LIGHTS };

/* Every kind of array is needed from inside a coloured box, those of clipped triangles too. */
static burnish_mesh *make_box(int kind) {
    static const float coordinates[24] = {-1, -1, 1, -1, -1, 1, 1, 1, -1, -1, 1, -1, -1, 1, 1, 1};
    const shape s = box_at(-1, -1, -1, 2, 2, 2);
    uint8_t colors[32];
    for (int i = 0; i < 32; ++i) {
        colors[i] = (uint8_t)(40 + 6 * i);
    }
    burnish_mesh_description arrays = describe_arrays(s.points, NULL, colors, 8, s.corners, 12);
    const burnish_texture texture = {"colours", 4, 2, colors, 1};
    burnish_material material = burnish_material_default();
    for (int slot = 0; slot < BURNISH_TEXTURE_SLOT_COUNT; ++slot) {
        material.textures[slot].texture = 1;
    }
    material.alpha_mode = (burnish_alpha_mode)kind;
    material.alpha_cutoff = 0.15f; /* of the product of two */
    if (kind < PLAIN) {
        give_textures(&arrays, coordinates, &texture, 1);
        give_materials(&arrays, &material, 1);
    }
    return create_mesh(&arrays, NULL);
}

static burnish_render_options box_options(int kind, int samples, int threads,
                                          const burnish_environment *environment) {
    burnish_render_options options = burnish_render_options_default();
    options.width = kind < LIGHTS ? 66 : 24;
    options.height = kind < LIGHTS ? 66 : 24;
    options.samples = samples;
    options.threads = threads;
    options.camera = (burnish_camera){{0.9, 0.8, 0.7}, {0, 0, 0}, {0, 1, 0}, 90, 0};
    options.occlusion = 3;
    options.ground = options.shadow = 1;
    options.edges = kind == EDGES ? BURNISH_EDGES_FEATURES : 0;
    options.environment = kind == LIGHTS ? environment : NULL;
    options.area_light_count = kind == LIGHTS ? 2 : 0;
    for (int i = 0; i < options.area_light_count; ++i) {
        options.area_lights[i] = (burnish_area_light){.is_distant = i,
                                                      .is_two_sided = 1,
                                                      .center = {1, 2, 3},
                                                      .half_u = {1, 0, 0},
                                                      .half_v = {0, 1, 0},
                                                      .color = {1, 2, 3}};
    }
    return options;
}

/* A new renderer's first frame is stopped at an allocation or a question, or not at all, then drawn
 * again. All memory is the context's. Returns 0 where nothing stopped it. */
static int stop_one(const burnish_mesh *mesh, const burnish_render_options *options, counts *own,
                    const burnish_context *context, uint64_t expected) {
    const long before = atomic_load(&own->live), others = atomic_load(&live) - before;
    const long questions = own->questions;
    const burnish_status stop = questions < 0 ? BURNISH_STATUS_MEMORY : BURNISH_STATUS_CANCELLED;
    burnish_renderer *renderer;
    burnish_image image = {0};
    burnish_error error = {BURNISH_STATUS_OK, ""};
    own->asked = own->wrong_order = 0;
    own->stage = BURNISH_STAGE_TRANSFORM;
    own->fraction = 0;
    burnish_status status = burnish_renderer_create(context, &renderer, &error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_renderer_draw(renderer, mesh, options, &image, NULL, &error);
    }
    const int is_stopped = atomic_exchange(&own->left, -1) < 0 && own->questions < 0;
    own->questions = -1;
    CHECK(status == (is_stopped ? stop : BURNISH_STATUS_OK) && error.status == status &&
              (status == BURNISH_STATUS_OK) == (image.pixels != NULL),
          "status %d, \"%s\"", (int)status, error.text);
    /* after an answer of yes, the question is asked at most once more */
    CHECK((!is_stopped || questions < 0 || own->asked <= questions + 2) && !own->wrong_order,
          "asked %ld times for %ld", own->asked, questions);
    CHECK(is_stopped || (own->stage == BURNISH_STAGE_DRAW && own->fraction == 1),
          "progress ends at %g of stage %d", own->fraction, (int)own->stage);
    CHECK1(is_stopped || image.context == context);
    CHECK(atomic_load(&live) - atomic_load(&own->live) == others,
          "%ld blocks are not the context's",
          atomic_load(&live) - atomic_load(&own->live) - others);
    if (renderer) {
        CHECK_OK(burnish_renderer_draw(renderer, mesh, options, &image, NULL, &error), error);
        CHECK(burnish_image_hash(&image) == expected, "other pixels afterwards");
    }
    burnish_image_destroy(&image);
    burnish_renderer_destroy(renderer);
    CHECK(atomic_load(&own->live) == before, "%ld blocks lost", atomic_load(&own->live) - before);
    return is_stopped;
}

static void test_renderer(int kind, int samples, int threads) {
    static const float light[3 * 8] = {1, 2, 3, [12] = 4, 5, 6};
    burnish_environment *environment;
    burnish_error error;
    counts own;
    CHECK_OK(burnish_environment_create(NULL, 4, 2, light, &environment, &error), error);
    burnish_mesh *mesh = make_box(kind);
    const burnish_render_options options = box_options(kind, samples, threads, environment);
    const uint64_t expected = hash_drawn(mesh, &options);
    burnish_context *context = make_context(&own);
    for (int cancels = 0; cancels < 2; ++cancels) {
        int stops = -1, is_stopped = 1;
        for (long k = 0; is_stopped && k < 5000; k += cancels && k >= 20 ? 7 : 1, ++stops) {
            own.left = cancels ? -1 : k;
            own.questions = cancels ? k : -1;
            is_stopped = stop_one(mesh, &options, &own, context, expected);
        }
        CHECK(!is_stopped && stops >= (!cancels ? 20 : threads == 1 ? 10 : 2), "%d stops", stops);
    }
    burnish_context_destroy(context);
    CHECK1(atomic_load(&own.live) == 0);
    burnish_environment_destroy(environment);
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_files());
    RUN(test_renderer(PLAIN, 1, 1));
    RUN(test_renderer(PLAIN, 8, 3));
    RUN(test_renderer(BURNISH_ALPHA_BLEND, 4, 1));
    RUN(test_renderer(BURNISH_ALPHA_BLEND, 4, 3));
    RUN(test_renderer(BURNISH_ALPHA_MASK, 1, 1));
    RUN(test_renderer(EDGES, 4, 1));
    RUN(test_renderer(LIGHTS, 1, 1));
    return test_end("memory");
}
