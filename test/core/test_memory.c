/* Memory runs short at every allocation of loading, drawing and encoding, one after another: the
 * call says so, or the picture is right; nothing is lost, and a renderer goes on afterwards. */
#include <stdatomic.h>
#include <unistd.h>

#include "burnish/image.h"
#include "burnish/mesh.h"
#include "burnish/render.h"
#include "counting_context.h"
#include "mesh_arrays.h"
#include "support.h"

/* ---- The linker leads the library's calls of malloc and its kin here ---- */

static atomic_long allocations_left = -1; /* before one fails; negative: none fails */
static atomic_long live;                  /* taken and not given back */

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

static int fails(void) {
    return atomic_load(&allocations_left) >= 0 && atomic_fetch_sub(&allocations_left, 1) == 0;
}

static void *count_one(void *memory) {
    atomic_fetch_add(&live, memory != NULL);
    return memory;
}

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

enum { SIZE = 96, MOST_FAILURES = 4000 };

typedef struct picture_job {
    const char *path; /* of the file, or a built-in object */
    int samples, threads;
} picture_job;

/* File to mesh to picture to PNG. *hash: of the picture and of the PNG's bytes; 0 on error. */
static burnish_status work(const picture_job *job, uint64_t *hash, burnish_error *error) {
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
        *hash = burnish_image_hash(&image) * 31;
        for (size_t i = 0; i < png_size; ++i) {
            *hash = (*hash ^ png[i]) * UINT64_C(0x100000001B3);
        }
    }
    burnish_release(NULL, png);
    burnish_image_destroy(&image);
    burnish_mesh_destroy(mesh);
    return status;
}

/* Lets the k-th allocation fail, for every k until all are there. */
static void check_job(const picture_job *job) {
    burnish_error error = {0};
    uint64_t expected = 0, hash;
    int failed = 0, k = 0;
    for (int warm = 0; warm < 2; ++warm) { /* the pool of threads keeps its memory */
        CHECK(work(job, &expected, &error) == BURNISH_STATUS_OK, "%s: %s", job->path, error.text);
    }
    const long before = atomic_load(&live);
    for (; k < MOST_FAILURES; ++k) {
        error = (burnish_error){0};
        atomic_store(&allocations_left, k);
        burnish_status status = work(job, &hash, &error);
        const int ran_short = atomic_exchange(&allocations_left, -1) < 0;
        failed += status != BURNISH_STATUS_OK;
        CHECK(status == BURNISH_STATUS_OK
                  ? hash == expected
                  : status == BURNISH_STATUS_MEMORY && strstr(error.text, "memory"),
              "%s, %d samples, allocation %d: status %d, hash %#llx, \"%s\"", job->path,
              job->samples, k, (int)status, (unsigned long long)hash, error.text);
        CHECK(atomic_load(&live) == before, "%s, %d samples, allocation %d: %ld blocks lost",
              job->path, job->samples, k, atomic_load(&live) - before);
        if (!ran_short) {
            break;
        }
    }
    printf("%s, %d samples, %d threads: %d failures\n", job->path, job->samples, job->threads,
           failed);
    CHECK(k < MOST_FAILURES && failed > 10, "%d of %d failed", failed, k);
}

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
                                  "f 1 2 5\nf 2 3 5\nusemtl none\nf 3 4 5\nf 4 1 5\nf 1 1 2\n");
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
            check_job(&(picture_job){.path = paths[i], .samples = samples, .threads = threads});
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

/* Inside a coloured box: every kind of array is needed, those of clipped triangles too. mode: of
 * its textures' alpha; -1: it has none. */
static burnish_mesh *make_box(int mode) {
    static const float POSITIONS[24] = {-1, -1, -1, 1, -1, -1, -1, 1, -1, 1, 1, -1,
                                        -1, -1, 1,  1, -1, 1,  -1, 1, 1,  1, 1, 1};
    static const uint32_t FACES[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                       2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    uint8_t colors[32];
    for (int i = 0; i < 32; ++i) {
        colors[i] = (uint8_t)(40 + 6 * i);
    }
    burnish_mesh_description arrays = describe_arrays(POSITIONS, NULL, colors, 8, FACES, 12);
    const burnish_texture texture = {"colours", 4, 2, colors, 1};
    burnish_material material = burnish_material_default();
    for (int slot = 0; slot < BURNISH_TEXTURE_SLOT_COUNT; ++slot) {
        material.textures[slot].texture = 1;
    }
    material.alpha_mode = mode < 0 ? BURNISH_ALPHA_IGNORE : (burnish_alpha_mode)mode;
    material.alpha_cutoff = 0.15f; /* of the product of two */
    if (mode >= 0) {
        arrays.texture_coordinates = (burnish_array){POSITIONS, 8, 12};
        arrays.materials = &material;
        arrays.textures = &texture;
        arrays.material_count = arrays.texture_count = 1;
    }
    return create_mesh(&arrays, NULL);
}

static burnish_render_options box_options(int samples, int threads) {
    burnish_render_options options = burnish_render_options_default();
    options.width = 200;
    options.height = 150;
    options.samples = samples;
    options.threads = threads;
    options.camera.position[0] = 0.9;
    options.camera.position[1] = 0.8;
    options.camera.position[2] = 0.7;
    options.camera.view_angle = 90;
    options.occlusion = 3;
    options.ground = 1;
    options.shadow = 1;
    return options;
}

/* Allocation k of a fresh renderer's first frame fails, then the frame is drawn again. Returns 0
 * once there is no allocation k. */
static int fail_one(const burnish_mesh *mesh, const burnish_render_options *options, long k,
                    uint64_t expected) {
    burnish_renderer *renderer;
    burnish_image image = {0};
    burnish_render_report report;
    burnish_error error = {BURNISH_STATUS_OK, ""};
    if (!CHECK1(burnish_renderer_create(NULL, &renderer, NULL) == BURNISH_STATUS_OK)) {
        return 0;
    }
    allocations_left = k;
    burnish_status status = burnish_renderer_draw(renderer, mesh, options, &image, &report, &error);
    const int has_failed = allocations_left < 0;
    allocations_left = -1;
    CHECK(status == (has_failed ? BURNISH_STATUS_MEMORY : BURNISH_STATUS_OK) &&
              error.status == status && (image.pixels == NULL) == has_failed,
          "allocation %ld: status %d, \"%s\"", k, (int)status, error.text);
    status = burnish_renderer_draw(renderer, mesh, options, &image, &report, &error);
    CHECK(status == BURNISH_STATUS_OK && burnish_image_hash(&image) == expected,
          "after allocation %ld: status %d or other pixels", k, (int)status);
    burnish_image_destroy(&image);
    burnish_renderer_destroy(renderer);
    return has_failed;
}

static void test_renderer(int samples, int threads, int mode) {
    burnish_mesh *mesh = make_box(mode);
    const burnish_render_options options = box_options(samples, threads);
    burnish_image image;
    CHECK1(burnish_render(mesh, &options, &image, NULL, NULL) == BURNISH_STATUS_OK);
    const uint64_t expected = burnish_image_hash(&image);
    burnish_image_destroy(&image);
    long k = 0;
    while (fail_one(mesh, &options, k, expected)) {
        ++k;
    }
    CHECK(k >= 20, "only %ld allocations", k);
    burnish_mesh_destroy(mesh);
}

/* All that a renderer takes comes from its context, and goes back there; it runs short there too.
 */
static void test_context(int samples, int threads) {
    burnish_mesh *mesh = make_box(BURNISH_ALPHA_BLEND);
    burnish_render_options options = box_options(samples, threads);
    counts own;
    burnish_context *context = make_context(&own);
    burnish_target target = burnish_target_default();
    static uint8_t pixels[150][200 * 4];
    static float depth[150][200];
    burnish_status status = BURNISH_STATUS_MEMORY;
    int failed = 0;
    target.pixels = (burnish_pixels){options.width, options.height, BURNISH_PIXELS_BGRA8,
                                     sizeof pixels[0], pixels[0]};
    target.depth = depth[0];
    target.depth_stride = sizeof depth[0];
    for (long k = 0; status == BURNISH_STATUS_MEMORY; ++k) {
        const long others = atomic_load(&live) - atomic_load(&own.live);
        const long before = atomic_load(&own.live);
        burnish_renderer *renderer;
        burnish_error error = {BURNISH_STATUS_OK, ""};
        atomic_store(&own.left, k);
        status = burnish_renderer_create(context, &renderer, &error);
        if (status == BURNISH_STATUS_OK) {
            status = burnish_renderer_draw_into(renderer, mesh, &options, &target, NULL, &error);
        }
        CHECK(error.status == status &&
                  (status == BURNISH_STATUS_OK) == (atomic_load(&own.left) >= 0),
              "allocation %ld: status %d, \"%s\"", k, (int)status, error.text);
        CHECK(atomic_load(&live) - atomic_load(&own.live) == others,
              "allocation %ld: %ld blocks are not the context's", k,
              atomic_load(&live) - atomic_load(&own.live) - others);
        burnish_renderer_destroy(renderer);
        CHECK(atomic_load(&own.live) == before, "allocation %ld: %ld blocks lost", k,
              atomic_load(&own.live) - before);
        atomic_store(&own.left, -1);
        failed += status == BURNISH_STATUS_MEMORY;
    }
    CHECK(status == BURNISH_STATUS_OK && failed >= 20, "%d allocations, then status %d", failed,
          (int)status);
    burnish_context_destroy(context);
    CHECK1(atomic_load(&own.live) == 0);
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_files());
    RUN(test_renderer(1, 1, -1));
    RUN(test_renderer(4, 1, BURNISH_ALPHA_BLEND));
    RUN(test_renderer(1, 1, BURNISH_ALPHA_MASK));
    RUN(test_renderer(8, 3, -1));
    RUN(test_context(1, 1));
    RUN(test_context(4, 3));
    return test_end("memory");
}
