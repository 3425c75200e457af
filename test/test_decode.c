/* Pictures that textures come from: what the program encodes is decoded again, what is cut off is
 * refused; and how OBJ and PLY name them. */
#include "burnish/image.h"
#include "burnish/mesh.h"
#include "picture/picture.h"
#include "support.h"

enum { SIDE = 24 };

/* ---- Decoding ---- */

static burnish_image make_picture(int channels) {
    burnish_image image;
    burnish_image_create(&image, SIDE, SIDE, channels, NULL);
    for (int i = 0; i < SIDE * SIDE; ++i) {
        for (int k = 0; k < channels; ++k) {
            image.pixels[i * channels + k] =
                (uint8_t)(k == 3 ? 100 + i % 100 : 10 * (i % SIDE) + (k + 1) * (i / SIDE));
        }
    }
    return image;
}

static int largest_difference(const burnish_image *a, const burnish_image *b) {
    int worst =
        a->width == b->width && a->height == b->height && a->channels == b->channels ? 0 : 1000;
    for (int i = 0; i < a->width * a->height * a->channels && worst < 1000; ++i) {
        const int off = abs(a->pixels[i] - b->pixels[i]);
        worst = off > worst ? off : worst;
    }
    return worst;
}

/* Each part of a file is refused or decoded, and leaves nothing behind. */
static void cut_off(const uint8_t *bytes, size_t size) {
    for (size_t n = 0; n < size; n += 1 + size / 64) {
        uint8_t *part = malloc(n + 1); /* exactly as long as it says, for the sanitizer */
        uint8_t *exact = n ? realloc(part, n) : part;
        burnish_image image;
        burnish_error error;
        memcpy(exact, bytes, n);
        if (burnish_image_decode(exact, n, "part", &image, &error) != BURNISH_STATUS_OK) {
            CHECK(!image.pixels && image.width == 0 && error.text[0], "%zu of %zu bytes", n, size);
        }
        burnish_image_destroy(&image);
        free(exact);
    }
}

typedef burnish_status encoder(const burnish_pixels *pixels, const picture_options *options,
                               picture_file *file, burnish_error *error);

static void test_formats(void) {
    static const struct {
        encoder *encode;
        int channels, worst;
    } formats[] = {
        {picture_encode_jpeg, 3, 40}, {picture_encode_webp, 3, 0}, {picture_encode_webp, 4, 0}};
    for (size_t i = 0; i < sizeof formats / sizeof *formats; ++i) {
        burnish_image image = make_picture(formats[i].channels), decoded;
        const burnish_pixels pixels = burnish_image_pixels(&image);
        const picture_options options = {.threads = 1};
        picture_file file = {0};
        burnish_error error = {BURNISH_STATUS_OK, ""};
        if (formats[i].encode(&pixels, &options, &file, &error) == BURNISH_STATUS_OK) {
            CHECK(burnish_image_decode(file.bytes, file.size, NULL, &decoded, &error) ==
                      BURNISH_STATUS_OK,
                  "%s", error.text);
            CHECK(largest_difference(&image, &decoded) <= formats[i].worst, "%zu: %d", i,
                  largest_difference(&image, &decoded));
            burnish_image_destroy(&decoded);
            cut_off(file.bytes, file.size);
            picture_release(&file);
        } else {
            CHECK(strstr(error.text, "no lib"), "%s", error.text);
        }
        burnish_image_destroy(&image);
    }
    burnish_image image;
    burnish_error error;
    CHECK1(burnish_image_decode("GIF89a", 6, "x", &image, &error) == BURNISH_STATUS_FORMAT);
    CHECK_TEXT(error.text, "x: neither PNG nor JPEG nor WebP; convert it to one of them");
    CHECK1(burnish_image_decode(NULL, 6, "x", &image, &error) == BURNISH_STATUS_ARGUMENT);
}

/* ---- Files that name textures ---- */

typedef struct folder {
    const char *library;
    uint8_t *png;
    size_t png_size;
    char asked[400]; /* the names, each followed by a bar */
} folder;

static burnish_status load(void *user_data, const char *name, uint64_t max_bytes,
                           const void **bytes, size_t *size, burnish_error *error) {
    folder *f = user_data;
    const size_t length = strlen(name);
    const int is_library = strcmp(name, "a.mtl") == 0;
    const int is_png = length > 4 && strcmp(name + length - 4, ".png") == 0;
    (void)max_bytes;
    snprintf(f->asked + strlen(f->asked), sizeof f->asked - strlen(f->asked), "%s|", name);
    if (!is_library && (!is_png || strstr(name, "missing"))) {
        snprintf(error->text, sizeof error->text, "not there");
        return BURNISH_STATUS_READ;
    }
    *bytes = is_library ? (const void *)f->library : f->png;
    *size = is_library ? strlen(f->library) : f->png_size;
    return BURNISH_STATUS_OK;
}

static burnish_mesh *read_text(folder *f, const char *name, const char *text,
                               const burnish_load_options *given) {
    burnish_load_options options = *given;
    burnish_image image = make_picture(4);
    const burnish_pixels pixels = burnish_image_pixels(&image);
    burnish_error error = {BURNISH_STATUS_OK, ""};
    burnish_mesh *mesh;
    f->asked[0] = 0;
    CHECK1(burnish_png_encode(&pixels, NULL, &f->png, &f->png_size, &error) == BURNISH_STATUS_OK);
    options.companions = (burnish_file_loader){load, NULL, f};
    CHECK(burnish_mesh_load_memory(text, strlen(text), name, &options, &mesh, &error) ==
              BURNISH_STATUS_OK,
          "%s", error.text);
    burnish_release(NULL, f->png);
    burnish_image_destroy(&image);
    return mesh;
}

static const char obj[] = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                          "usemtl a\nf 1/1 2/2 3/3\n";

static void test_obj(void) {
    folder f = {.library =
                    "newmtl a\nKd 0 0 0\nNs 40\nmap_Kd -s 2 3 1 -o 0.5 0.25 -mm 0 1 "
                    "tex\\my skin.png\nMAP_KS -clamp on ../../x.png\nmap_d tex\\my skin.png\n"
                    "bump -bm 0.5 h.png\nmap_Ke C:\\missing\\missing.png\n"};
    const burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = read_text(&f, "m.obj", obj, &options);
    const burnish_material *material = burnish_mesh_material(mesh, 0);
    const burnish_texture_use *color = &material->textures[BURNISH_TEXTURE_COLOR];
    const burnish_texture_use *specular = &material->textures[BURNISH_TEXTURE_SPECULAR];
    CHECK_TEXT(f.asked, "a.mtl|tex/my skin.png|x.png|h.png|missing.png|tex/my skin.png|");
    CHECK1(material->diffuse[0] == 1 && material->ambient[1] == 1 && material->has_diffuse);
    CHECK1(color->transform[0] == 2 && color->transform[4] == 3 && color->transform[2] == 0.5f &&
           color->transform[5] == 0.25f && color->wrap[0] == BURNISH_WRAP_REPEAT);
    CHECK1(specular->texture && specular->wrap[1] == BURNISH_WRAP_CLAMP);
    CHECK1(material->alpha_mode == BURNISH_ALPHA_BLEND && !(material->transparency > 0));
    CHECK1(material->textures[BURNISH_TEXTURE_NORMAL].texture &&
           burnish_mesh_get_view(mesh)->tangents);
    CHECK1(!material->textures[BURNISH_TEXTURE_EMISSIVE].texture);
    CHECK(burnish_mesh_warning_count(mesh) == 2, "%zu", burnish_mesh_warning_count(mesh));
    CHECK_TEXT(burnish_mesh_warning(mesh, 0), "a.mtl:4: map_Kd: -mm is not drawn");
    CHECK_TEXT(burnish_mesh_warning(mesh, 1),
               "m.obj: texture \"C:\\missing\\missing.png\" is left out: not there");
    burnish_mesh_destroy(mesh);
}

static void test_limits(void) {
    folder f = {.library = "newmtl a\nmap_Kd x.png\nmap_Ks x.png\nmap_Ke y.png\n"};
    burnish_load_options options = burnish_load_options_default();
    options.max_texture_pixels = SIDE * SIDE;
    burnish_mesh *mesh = read_text(&f, "m.obj", obj, &options);
    const burnish_texture_use *uses = burnish_mesh_material(mesh, 0)->textures;
    CHECK_TEXT(f.asked, "a.mtl|x.png|y.png|"); /* equal names are one texture */
    CHECK1(uses[BURNISH_TEXTURE_COLOR].texture == 1 &&
           uses[BURNISH_TEXTURE_SPECULAR].texture == 1 && burnish_mesh_texture_count(mesh) == 1 &&
           uses[BURNISH_TEXTURE_EMISSIVE].texture == 0 && burnish_mesh_warning_count(mesh) == 1);
    burnish_mesh_destroy(mesh);
    options.ignore_textures = 1;
    mesh = read_text(&f, "m.obj", obj, &options);
    CHECK_TEXT(f.asked, "a.mtl|");
    CHECK1(burnish_mesh_texture_count(mesh) == 0 &&
           !burnish_mesh_get_view(mesh)->texture_coordinates);
    burnish_mesh_destroy(mesh);
}

static void test_ply(void) {
    folder f = {0};
    const burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = read_text(
        &f, "m.ply",
        "ply\nformat ascii 1.0\ncomment TextureFile skin.png\nelement vertex 3\n"
        "property float x\nproperty float y\nproperty float z\nproperty float s\n"
        "property float t\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n",
        &options);
    CHECK_TEXT(f.asked, "skin.png|");
    CHECK1(burnish_mesh_material(mesh, 0)->textures[BURNISH_TEXTURE_COLOR].texture == 1 &&
           burnish_mesh_get_view(mesh)->texture_coordinates &&
           burnish_mesh_warning_count(mesh) == 0);
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_formats());
    RUN(test_obj());
    RUN(test_limits());
    RUN(test_ply());
    return test_end("decode");
}
