/* Memory runs short at every allocation of the libraries that decode pictures, one after another:
 * the call says so and loses nothing, or the pixels are right. This program's malloc stands in for
 * that of all libraries. */
#include "burnish/image.h"
#include "burnish/mesh.h"
#include "cli/input.h"
#include "environment/environment.h"
#include "failing_malloc.h"
#include "picture/exr.h"
#include "picture/formats.h"
#include "support.h"

#ifdef __GLIBC__

#include <errno.h>

/* ---- glibc's own, and how many calls are left ---- */

#define FOR_ALL __attribute__((visibility("default"))) /* libraries too */

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *memory);

static int runs_short(void) {
    const int is_last = fails();
    errno = is_last ? ENOMEM : errno;
    return is_last;
}

FOR_ALL void *malloc(size_t size) {
    return runs_short() ? NULL : count_one(__libc_malloc(size));
}
FOR_ALL void *calloc(size_t count, size_t size) {
    return runs_short() ? NULL : count_one(__libc_calloc(count, size));
}
FOR_ALL void *realloc(void *old, size_t size) {
    void *memory = runs_short() ? NULL : __libc_realloc(old, size);
    return old ? memory : count_one(memory);
}
FOR_ALL void *aligned_alloc(size_t alignment, size_t size) {
    return runs_short() ? NULL : count_one(__libc_memalign(alignment, size));
}
FOR_ALL int posix_memalign(void **memory, size_t alignment, size_t size) {
    *memory = aligned_alloc(alignment, size);
    return *memory ? 0 : ENOMEM;
}
FOR_ALL void free(void *memory) {
    atomic_fetch_sub(&live, memory != NULL);
    __libc_free(memory);
}

/* ---- Each allocation fails once ---- */

enum { SIDE = 40, FEWEST = 3 };

static burnish_status decode(const void *data, uint64_t *hash, burnish_error *error) {
    const picture_file *file = data;
    burnish_image image = {0};
    const burnish_status status =
        burnish_image_decode(NULL, file->bytes, file->size, "picture", &image, error);
    *hash = status == BURNISH_STATUS_OK ? burnish_image_hash(&image) : 0;
    burnish_image_destroy(&image);
    return status;
}

static burnish_status decode_environment(const void *data, uint64_t *hash, burnish_error *error) {
    const picture_file *file = data;
    burnish_environment *environment;
    const burnish_status status = burnish_environment_decode(NULL, file->bytes, file->size,
                                                             "environment", &environment, error);
    *hash = status == BURNISH_STATUS_OK ? environment->hash : 0;
    burnish_environment_destroy(environment);
    return status;
}

static burnish_status give_picture(void *user_data, const char *name, uint64_t max_bytes,
                                   const void **bytes, size_t *size, burnish_error *error) {
    static const char library[] = "newmtl a\nmap_Kd t.png\n";
    const picture_file *picture = user_data;
    const int is_library = strcmp(name, "a.mtl") == 0;
    (void)max_bytes, (void)error;
    *bytes = is_library ? (const void *)library : picture->bytes;
    *size = is_library ? strlen(library) : picture->size;
    return BURNISH_STATUS_OK;
}

/* The picture as the texture of a mesh, which is left out only where it is damaged. */
static burnish_status load(const void *data, uint64_t *hash, burnish_error *error) {
    static const char obj[] = "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\n"
                              "vt 0 1\nf 1/1 2/2 3/3\n";
    picture_file picture = *(const picture_file *)data;
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh;
    options.threads = 1;
    options.referenced_files = (burnish_file_loader){give_picture, NULL, &picture};
    const burnish_status status =
        burnish_mesh_load_memory(obj, strlen(obj), "m.obj", &options, &mesh, error);
    *hash = status == BURNISH_STATUS_OK ? 1 + burnish_mesh_get_texture_count(mesh) : 0;
    burnish_mesh_destroy(mesh);
    return status;
}

typedef burnish_status encoder(const burnish_pixels *pixels, const picture_options *options,
                               picture_file *file, burnish_error *error);

static burnish_status encode_png(const burnish_pixels *pixels, const picture_options *options,
                                 picture_file *file, burnish_error *error) {
    (void)options;
    return burnish_png_encode(pixels, NULL, &file->bytes, &file->size, error);
}

static void test_decoders(void) {
    static const struct {
        const char *name;
        encoder *encode;
    } formats[] = {
        {"PNG", encode_png}, {"JPEG", picture_encode_jpeg}, {"WebP", picture_encode_webp}};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i) {
        burnish_image image;
        burnish_error error;
        picture_file file = {0};
        const picture_options options = {.quality = 90};
        CHECK1(burnish_image_create(NULL, &image, SIDE, SIDE, 3, NULL) == BURNISH_STATUS_OK);
        for (int k = 0; k < SIDE * SIDE * 3; ++k) {
            image.pixels[k] = (uint8_t)(k * k / 7);
        }
        const burnish_pixels pixels = burnish_image_get_pixels(&image);
        if (formats[i].encode(&pixels, &options, &file, &error) == BURNISH_STATUS_OK) {
            fail_each(formats[i].name, decode, &file, FEWEST);
            fail_each(formats[i].name, load, &file, FEWEST);
        } else {
            CHECK(strstr(error.text, "no lib"), "%s", error.text);
        }
        picture_release(&file);
        burnish_image_destroy(&image);
    }
}

static void test_environments(void) {
    static const char hdr[] = "#?RADIANCE\n\n-Y 1 +X 2\nabc\201xyz\200";
    static float values[SIDE * SIDE];
    picture_file file = {.bytes = (uint8_t *)(uintptr_t)hdr, .size = sizeof hdr - 1};
    picture_channels channels = {SIDE, SIDE, 4, {{"R", PICTURE_FLOAT, values, sizeof *values}}};
    burnish_error error;
    fail_each("HDR", decode_environment, &file, FEWEST);
    for (int i = 0; i < SIDE * SIDE; ++i) {
        values[i] = (float)i;
    }
    for (int k = 1; k < 4; ++k) {
        channels.items[k] = channels.items[0];
        channels.items[k].name = k == 1 ? "G" : k == 2 ? "B" : "A";
    }
    if (picture_encode_exr(&channels, &file, &error) == BURNISH_STATUS_OK) {
        fail_each("EXR", decode_environment, &file, FEWEST);
        picture_release(&file);
    } else {
        CHECK(strstr(error.text, "no lib") || strstr(error.text, "OpenEXR"), "%s", error.text);
    }
}

/* The stream of a file, and its bytes. */
static void test_file(void) {
    burnish_error error;
    uint8_t *bytes;
    size_t size;
    for (int k = 0; k < 2; ++k) {
        atomic_store(&allocations_left, k);
        const burnish_status status =
            cli_read_bytes(TEST_DATA_DIR "/cube.obj", 1 << 20, NULL, &bytes, &size, &error);
        CHECK(atomic_exchange(&allocations_left, -1) < 0 && status == BURNISH_STATUS_MEMORY,
              "%d: %s", k, error.text);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_decoders());
    RUN(test_file());
    RUN(test_environments());
    return test_end("decode_memory");
}

#else

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    return test_end("decode_memory");
}

#endif
