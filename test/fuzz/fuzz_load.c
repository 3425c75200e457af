/* Fuzzes the way from bytes to pixels: libFuzzer's bytes become a mesh file, loaded and drawn
 * through the public API. A mesh that loads must keep the promises of mesh.h and be drawn;
 * otherwise the error must be one line.
 *
 * byte 0:  format, by its letter: the first letter of its name that no earlier format has. A name
 * in the environment variable FUZZ_FORMAT takes precedence
 * byte 1:  options, see load_options() and draw()
 * byte 2:  samples, camera inside the mesh, threads compared; see draw() and compare_threads()
 * byte 3:  more options, see load_more() and light()
 * rest:    the file. After the first NUL of an OBJ comes its material library, "101", of a scene or
 * robot a mesh of that name; otherwise it is a TGA. A 3MF that does not begin as a ZIP archive is a model and, after the first NUL, the part
 * "b"; they are packed here, since random bytes would not pass the checksums
 *
 * Built by `make fuzz`; test/fuzz/run starts it, test/fuzz/seeds makes its seeds. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "burnish/mesh.h"
#include "burnish/render.h"
#include "mesh/read/io/budget.h"
#include "mesh_arrays.h"
#include "zip_input.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum {
    HEAD = 4,
    ROOM = 20, /* of pieces of G-code, in triangles */
    MESH_DESCRIPTOR = 100,
    TRIANGLE_LIMIT = 100000,
    INPUT_LIMIT = 1 << 20
};
#define MESH_PATH "/proc/self/fd/100"

/* Ends the run; libFuzzer keeps the input. */
static void require(int condition, const char *what, const burnish_error *error) {
    if (!condition) {
        fprintf(stderr, "fuzz_load: %s: %s\n", what, error ? error->text : "");
        abort();
    }
}

static int is_in(char letter, const char *letters, int count) {
    return memchr(letters, letter, (size_t)count) != NULL;
}

/* The letters of the formats, 0 for formats without files. */
static void find_letters(char letters[BURNISH_FORMAT_COUNT]) {
    for (int i = 0; i < BURNISH_FORMAT_COUNT; ++i) {
        const burnish_format_info *info = burnish_format_get_info((burnish_format)i);
        const char *name = info->is_file ? info->name : "";
        while (*name && is_in(*name, letters, i)) {
            ++name;
        }
        letters[i] = *name;
    }
}

/* AUTO for an unknown letter or no name. */
static burnish_format format_of(char letter, const char *name) {
    char letters[BURNISH_FORMAT_COUNT];
    find_letters(letters);
    for (int i = 0; i < BURNISH_FORMAT_COUNT; ++i) {
        const char *own = burnish_format_get_info((burnish_format)i)->name;
        if (letters[i] && (name ? strcmp(own, name) == 0 : letters[i] == letter)) {
            return (burnish_format)i;
        }
    }
    return BURNISH_FORMAT_AUTO;
}

/* A decoder that returns the first stream that it receives. */
static burnish_status echo(void *user_data, const char *form, const void *bytes, size_t size,
                           const uint8_t **decoded, size_t *decoded_size, burnish_error *error) {
    (void)user_data, (void)form, (void)error;
    uint8_t *copy = malloc(size - 4 > 0 ? size - 4 : 1);
    require(copy != NULL, "memory", NULL);
    memcpy(copy, (const uint8_t *)bytes + 4, size - 4);
    *decoded = copy;
    *decoded_size = size - 4;
    return BURNISH_STATUS_OK;
}

static void release_echo(void *user_data, const uint8_t *decoded, size_t size) {
    (void)user_data, (void)size;
    free((void *)(uintptr_t)decoded);
}

static void load_more(uint8_t choice, size_t size, burnish_load_options *options) {
    options->scalar_property = choice & 1 ? "_s" : NULL;
    options->keep_texture_coordinates = choice >> 1 & 1;
    options->max_memory = choice & 4 ? BURNISH_RUN_BYTES + ROOM * BURNISH_ELEMENT_BYTES + size : 0;
    options->normals = choice & 32 ? BURNISH_NORMALS_OWN : BURNISH_NORMALS_AUTO;
}

static burnish_load_options load_options(const uint8_t *head, size_t size) {
    static const double creases[4] = {BURNISH_CREASE_AUTO, 0, 89.5, 180};
    const char *fixed = getenv("FUZZ_FORMAT");
    burnish_load_options options = burnish_load_options_default();
    options.format = format_of((char)head[0], fixed && *fixed ? fixed : NULL);
    options.crease_angle = creases[head[1] & 3];
    options.max_triangles = head[1] & 4 ? 5 : TRIANGLE_LIMIT;
    options.max_input_bytes = INPUT_LIMIT;
    options.measure = 1;
    options.animation_time = head[2] & 32 ? 0.5 : BURNISH_AT_REST;
    options.threads = 1;
    options.decoder = (burnish_stream_decoder){echo, release_echo, NULL};
    load_more(head[3], size, &options);
    return options;
}

/* A file in memory behind a descriptor of our choice. */
static void place_file(int descriptor, const uint8_t *bytes, size_t size) {
    int file = memfd_create("fuzz", 0);
    require(file >= 0 && write(file, bytes, size) == (ssize_t)size &&
                dup2(file, descriptor) == descriptor,
            "memfd", NULL);
    close(file);
}

/* The bytes of the file "101", a pixel if the input has none. */
static struct library {
    const uint8_t *bytes;
    size_t size;
} library;

static burnish_status load_library(void *user_data, const char *name, uint64_t max_bytes,
                                   const void **bytes, size_t *size, burnish_error *error) {
    (void)user_data;
    if (strcmp(name, "101") != 0 || library.size > max_bytes) {
        snprintf(error->text, sizeof error->text, "it is not there");
        return error->status = BURNISH_STATUS_READ;
    }
    *bytes = library.bytes;
    *size = library.size;
    return BURNISH_STATUS_OK;
}

static burnish_status load(const uint8_t *bytes, size_t size, int from_file,
                           const burnish_load_options *given, burnish_mesh **scene,
                           burnish_error *error) {
    static const uint8_t pixel[] = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0, 24, 0, 1, 2, 3};
    const uint8_t *end = memchr(bytes, 0, size);
    burnish_load_options all = *given;
    const burnish_load_options *options = &all;
    all.referenced_files.load = load_library;
    if (options->format == BURNISH_FORMAT_3MF && size > 0 &&
        (size < 2 || memcmp(bytes, "PK", 2) != 0)) {
        const zip_list *zip = pack_parts((const char *)bytes, size);
        return burnish_mesh_load_memory(zip->bytes, zip->size, "fuzz", options, scene, error);
    }
    const int has_library = options->format == BURNISH_FORMAT_OBJ ||
                            options->format == BURNISH_FORMAT_SCENE ||
                            options->format == BURNISH_FORMAT_URDF;
    if (!has_library || !end) {
        end = bytes + size;
    }
    size_t mesh_size = (size_t)(end - bytes);
    library = mesh_size < size ? (struct library){end + 1, size - mesh_size - 1}
                               : (struct library){pixel, sizeof pixel};
    if (!from_file) {
        return burnish_mesh_load_memory(bytes, mesh_size, "fuzz", options, scene, error);
    }
    place_file(MESH_DESCRIPTOR, bytes, mesh_size);
    burnish_status status = burnish_mesh_load(MESH_PATH, options, scene, error);
    close(MESH_DESCRIPTOR);
    return status;
}

static void check_line(const char *line) {
    require(line && *line && !strchr(line, '\n'), "not one line", NULL);
}

static void check_material(const burnish_material *material) {
    require(material && material->exponent >= 1 && material->exponent <= 65536, "exponent", NULL);
    for (int i = 0; i < 3; ++i) {
        require(material->ambient[i] >= 0 && material->ambient[i] <= 1, "ambient", NULL);
        require(material->diffuse[i] >= 0 && material->diffuse[i] <= 1, "diffuse", NULL);
        require(material->specular[i] >= 0 && material->specular[i] <= 1, "specular", NULL);
    }
}

static void check_mesh(const burnish_mesh *loaded) {
    const burnish_mesh_view *mesh = burnish_mesh_get_view(loaded);
    float low[3], high[3];
    burnish_mesh_get_bounds(loaded, low, high);
    for (int k = 0; k < 3; ++k) { /* without strays, or with the rods of lines */
        low[k] = fminf(low[k], mesh->bounds_min[k]);
        high[k] = fmaxf(high[k], mesh->bounds_max[k]);
    }
    require(mesh->triangle_count >= 1 ? mesh->vertex_count >= 3
                                      : mesh->vertex_count >= 1 && mesh->point_radius > 0,
            "counts", NULL);
    const int is_cloud = mesh->triangle_count == 0;
    for (size_t i = 0; i < 3 * mesh->vertex_count; ++i) {
        require(mesh->positions[i] >= -FLT_MAX && mesh->positions[i] <= FLT_MAX, "position", NULL);
        require(mesh->positions[i] >= low[i % 3] && mesh->positions[i] <= high[i % 3], "bounds",
                NULL);
    }
    for (size_t i = 0; i < mesh->vertex_count; ++i) {
        const float *n = mesh->normals + 3 * i;
        double square = (double)n[0] * n[0] + (double)n[1] * n[1] + (double)n[2] * n[2];
        require((square > 1 - 1e-6 && square < 1 + 1e-6) || (is_cloud && square == 0), "normal",
                NULL);
    }
    for (size_t i = 0; i < 3 * mesh->triangle_count; ++i) {
        require(mesh->indices[i] < mesh->vertex_count, "index", NULL);
    }
}

static void check_scene(const burnish_mesh *scene) {
    const burnish_mesh_view *mesh = burnish_mesh_get_view(scene);
    size_t materials = burnish_mesh_get_material_count(scene);
    check_mesh(scene);
    require(materials >= 1, "no material", NULL);
    require(mesh->triangle_count > 0 || burnish_mesh_get_texture_count(scene) == 0,
            "textures of points", NULL);
    for (size_t i = 0; i < materials; ++i) {
        check_material(burnish_mesh_get_material(scene, i));
    }
    for (size_t i = 0; mesh->triangle_materials && i < mesh->triangle_count; ++i) {
        require(mesh->triangle_materials[i] < materials, "material index", NULL);
    }
    for (size_t i = 0; i < burnish_mesh_get_warning_count(scene); ++i) {
        check_line(burnish_mesh_get_warning(scene, i));
    }
}

/* So small that render may refuse it. */
static int is_tiny(const burnish_mesh_view *mesh) {
    for (int i = 0; i < 3; ++i) {
        if ((double)mesh->bounds_max[i] - mesh->bounds_min[i] > 1e-30) {
            return 0;
        }
    }
    return 1;
}

/* From the middle of the mesh toward a corner of its box, with a wide angle. Returns 0 if single
 * precision can't represent it. */
static int move_inside(const burnish_mesh_view *mesh, burnish_camera *camera) {
    int apart = 0;
    for (int i = 0; i < 3; ++i) {
        const double low = (double)mesh->bounds_min[i], high = (double)mesh->bounds_max[i];
        camera->position[i] = low + (high - low) * (0.5 + 0.03 * i);
        camera->focal_point[i] = high;
        apart |= high - low > 1e-6 * (1 + fabs(low) + fabs(high));
    }
    camera->orthographic_height = 0;
    camera->view_angle = 120;
    return apart;
}

/* A picture of few colours. */
static const burnish_environment *surroundings(void) {
    static burnish_environment *made;
    static const float rgb[3 * 8] = {1, 2, 3, 0, 0, 9, 1, 1, 1, 0, 5, 0, 1, 0, 0, 0.5f, 2};
    require(made || burnish_environment_create(NULL, 4, 2, rgb, &made, NULL) == BURNISH_STATUS_OK,
            "environment", NULL);
    return made;
}

static void light(uint8_t choice, burnish_render_options *options) {
    if (choice & 8) {
        options->area_light_count = 2;
        options->has_dome = 1;
        options->dome = (burnish_dome){{1, 1, 2}, {0.5f, 0.5f, 0.5f}, {0.1f, 0, 0}, 0};
        for (int i = 0; i < 2; ++i) {
            options->area_lights[i] =
                (burnish_area_light){.shape = (burnish_area_shape)((choice + i) & 3),
                                     .is_distant = i,
                                     .follows_camera = !i,
                                     .center = {1, 2, 3},
                                     .half_u = {1, 0, 0},
                                     .half_v = {0, 1, 0},
                                     .color = {3, 2, 1}};
        }
    }
    if ((choice & 144) == 144) { /* a quarter of the inputs, as its maps take most time */
        options->environment = surroundings();
        options->background_environment = choice >> 3 & 1;
    }
}

/* A cloud or a mesh by its values, if it has some, or by height. */
static void color(burnish_mesh *scene, uint8_t choice) {
    const burnish_mesh_view *view = burnish_mesh_get_view(scene);
    burnish_coloring coloring = burnish_coloring_default();
    burnish_error error = {0};
    coloring.source = choice & 1 && view->texture_coordinates ? BURNISH_COLOR_BY_PROPERTY
                      : choice & 8                            ? BURNISH_COLOR_BY_NORMAL
                                                              : BURNISH_COLOR_BY_HEIGHT;
    require(!(choice & 64) ||
                burnish_mesh_color_by(scene, &coloring, NULL, &error) == BURNISH_STATUS_OK,
            "colours", &error);
}

/* Every loaded mesh can be framed and drawn, whatever its size and position. Whatever the camera's
 * position, the result is a picture or a one-line error. */
static void draw(const burnish_mesh *scene, uint8_t choice, uint8_t more, uint8_t lights) {
    static const int samples[4] = {1, 4, 8, 16};
    const burnish_mesh_view *mesh = burnish_mesh_get_view(scene);
    burnish_error error = {0};
    burnish_image image = {0};
    burnish_render_report report = {0};
    burnish_framing fit = burnish_framing_default();
    burnish_render_options options = burnish_render_options_default();
    fit.orthographic = choice >> 4 & 1;
    options.width = 40;
    options.height = 24;
    fit.aspect = 40.0 / 24;
    options.threads = more & 16 ? 2 : 1;
    options.samples = samples[(choice >> 5 & 1) ^ (more & 3)];
    options.lobe.kind = choice & 64 ? BURNISH_LOBE_LYON : BURNISH_LOBE_FAMILY;
    light(lights, &options);
    burnish_status status = burnish_camera_frame(scene, &fit, &options.camera, &error);
    require(status == BURNISH_STATUS_OK, "camera", &error);
    const int inside = more & 4 && move_inside(mesh, &options.camera);
    status = burnish_render(scene, &options, &image, &report, &error);
    if (status != BURNISH_STATUS_OK) {
        require(inside || (status == BURNISH_STATUS_LIMIT && is_tiny(mesh)), "render", &error);
        check_line(error.text);
        return;
    }
    require(report.triangles_drawn <= report.triangles && report.covered_pixels <= 40 * 24,
            "report", NULL);
    burnish_image_destroy(&image);
}

/* Three threads read what one reads: the same arrays, warnings and error. */
static void compare_threads(const uint8_t *bytes, size_t size, int from_file,
                            burnish_load_options options, const burnish_mesh *scene,
                            const burnish_error *expected) {
    burnish_mesh *other = NULL;
    burnish_error error = {0};
    options.threads = 3;
    burnish_status status = load(bytes, size, from_file, &options, &other, &error);
    require(status == expected->status && strcmp(error.text, expected->text) == 0,
            "another error by threads", &error);
    require(burnish_mesh_get_warning_count(other) == burnish_mesh_get_warning_count(scene),
            "warnings", NULL);
    for (size_t i = 0; i < burnish_mesh_get_warning_count(scene); ++i) {
        require(strcmp(burnish_mesh_get_warning(other, i), burnish_mesh_get_warning(scene, i)) == 0,
                "another warning by threads", NULL);
    }
    require(same_meshes(scene, other), "another mesh by threads", NULL);
    burnish_mesh_destroy(other);
}

/* A file, streamed if its format allows, gives the same mesh as its bytes in memory, unless
 * it may reference other files. */
static void compare_sources(const uint8_t *bytes, size_t size, const burnish_load_options *options,
                            const burnish_mesh *scene, burnish_status expected) {
    static const char *const words[] = {"mtllib", "TextureFile", "buffers", "images"};
    burnish_mesh *other = NULL;
    burnish_error error = {0};
    for (size_t i = 0; i < sizeof words / sizeof *words; ++i) {
        if (memmem(bytes, size, words[i], strlen(words[i]))) {
            return;
        }
    }
    require(load(bytes, size, 0, options, &other, &error) == expected, "another status from memory",
            &error);
    require(burnish_mesh_get_warning_count(other) == burnish_mesh_get_warning_count(scene),
            "other warnings from memory", NULL);
    require(same_meshes(scene, other), "another mesh from memory", NULL);
    burnish_mesh_destroy(other);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size < HEAD) {
        return 0;
    }
    burnish_load_options options = load_options(data, size);
    burnish_mesh *scene = NULL;
    burnish_error error = {0};
    burnish_status status = load(data + HEAD, size - HEAD, data[1] & 8, &options, &scene, &error);
    if (status == BURNISH_STATUS_OK) {
        check_scene(scene);
    } else {
        require(!scene && error.status == status, "status", &error);
        check_line(error.text);
    }
    if (data[2] & 8) {
        compare_threads(data + HEAD, size - HEAD, data[1] & 8, options, scene, &error);
    }
    if (data[1] & 8 && options.max_memory == 0) { /* which counts bytes in memory twice */
        compare_sources(data + HEAD, size - HEAD, &options, scene, status);
    }
    if (scene) {
        color(scene, data[3]);
        draw(scene, data[1], data[2], data[3]);
    }
    burnish_mesh_destroy(scene);
    return 0;
}
