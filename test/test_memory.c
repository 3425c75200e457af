/* Memory runs short at every allocation of loading, drawing and encoding, one after another: the
 * call says so, or the picture is right; nothing is lost. */
#include <unistd.h>

#include "burnish/image.h"
#include "burnish/mesh.h"
#include "burnish/render.h"
#include "short_memory.h"
#include "support.h"

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
        const burnish_pixels pixels = burnish_image_pixels(&image);
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

static void write_file(const char *name, const char *text) {
    FILE *file = fopen(name, "wb");
    if (CHECK(file, "can't make %s", name)) {
        CHECK1(fputs(text, file) >= 0);
        CHECK1(fclose(file) == 0);
    }
}

/* A file of each format in the current folder, with as much in it as the format holds. */
static void write_inputs(void) {
    write_file("memory.mtl", "newmtl red\nKd .8 .1 .1\nNs 20\nnewmtl blue\nKd .1 .1 .8\n");
    write_file("memory.obj", "mtllib memory.mtl none.mtl\nusemtl red\n"
                             "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 0\n"
                             "v .5 .5 1 1 1 1\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\nusemtl blue\n"
                             "f 1 2 5\nf 2 3 5\nusemtl none\nf 3 4 5\nf 4 1 5\nf 1 1 2\n");
    write_file("memory.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                             "property float y\nproperty float z\nproperty uchar red\n"
                             "property uchar green\nproperty uchar blue\nelement face 4\n"
                             "property list uchar int vertex_indices\nend_header\n"
                             "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n0 0 1 9 9 9\n"
                             "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
    write_file("memory.stl", "solid memory\n"
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

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    char folder[] = TEST_BINARY_DIR "/memory-XXXXXX";
    if (!CHECK1(mkdtemp(folder) && chdir(folder) == 0)) {
        return EXIT_FAILURE;
    }
    write_inputs();
    RUN(check_formats(1));
    RUN(check_formats(3));
    CHECK1(unlink("memory.mtl") == 0 && unlink("memory.obj") == 0 && unlink("memory.ply") == 0 &&
           unlink("memory.stl") == 0 && chdir("..") == 0 && rmdir(folder) == 0);
    return test_end("memory");
}
