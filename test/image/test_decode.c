/* Pictures that textures come from: what the program encodes is decoded again, what is cut off is
 * refused; and how OBJ and PLY name them. */
#include "gltf_input.h"
#include "images.h"
#include "mesh_arrays.h"
#include "picture/formats.h"

enum { SIDE = 24 };

/* ---- Decoding ---- */

static burnish_image make_picture(int channels) {
    burnish_image image = make_image(SIDE, SIDE, channels);
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
        const burnish_pixels pixels = burnish_image_get_pixels(&image);
        const picture_options options = {.threads = 1};
        picture_file file = {0};
        burnish_error error = {BURNISH_STATUS_OK, ""};
        if (formats[i].encode(&pixels, &options, &file, &error) == BURNISH_STATUS_OK) {
            CHECK_OK(burnish_image_decode(NULL, file.bytes, file.size, NULL, &decoded, &error),
                     error);
            CHECK(largest_difference(&image, &decoded) <= formats[i].worst, "%zu: %d", i,
                  largest_difference(&image, &decoded));
            burnish_image_destroy(&decoded);
            picture_release(&file);
        } else {
            CHECK(strstr(error.text, "no lib"), "%s", error.text);
        }
        burnish_image_destroy(&image);
    }
    burnish_image image;
    burnish_error error;
    CHECK1(burnish_image_decode(NULL, "GIF89a", 6, "x", &image, &error) == BURNISH_STATUS_FORMAT);
    CHECK_TEXT(error.text,
               "x: neither PNG nor JPEG nor WebP nor BMP nor TGA; convert it to one of them");
    CHECK1(burnish_image_decode(NULL, NULL, 6, "x", &image, &error) == BURNISH_STATUS_ARGUMENT);
}

/* ---- TGA ---- */

enum { TGA_WIDTH = 3, TGA_HEIGHT = 2 };

/* What pixel x, y from the upper left shows, in codes that 5 bits hold exactly. */
static void tga_color(int x, int y, uint8_t rgba[4]) {
    const uint8_t color[4] = {(uint8_t)(x == 0 ? 255 : 0), (uint8_t)(x == 1 ? 255 : 66),
                              (uint8_t)(y == 0 ? 132 : 8), (uint8_t)(100 + x + y)};
    memcpy(rgba, color, 4);
}

/* Decodes to the colours of pixels, and is refused where it ends at one of some bytes. */
static void check_decoded(const char *name, size_t number, const uint8_t *bytes, size_t size,
                          const burnish_image *expected, const size_t ends[2]) {
    burnish_image image;
    burnish_error error;
    if (CHECK(burnish_image_decode(NULL, bytes, size, name, &image, &error) == BURNISH_STATUS_OK,
              "%zu: %s", number, error.text)) {
        CHECK(largest_difference(&image, expected) == 0, "%s %zu: %d", name, number,
              largest_difference(&image, expected));
        burnish_image_destroy(&image);
    }
    for (size_t n = ends[0]; n < ends[1]; ++n) {
        uint8_t *part = malloc(n); /* exactly as long as it says, for the sanitizer */
        memcpy(part, bytes, n);
        CHECK(burnish_image_decode(NULL, part, n, name, &image, &error) == BURNISH_STATUS_FORMAT,
              "%s %zu: %zu of %zu bytes", name, number, n, size);
        free(part);
    }
}

/* The picture in a type, of a depth, in an order of rows and columns. Returns its size. */
static size_t make_tga(uint8_t *to, int type, int depth, int descriptor) {
    const uint8_t head[18] = {
        [2] = (uint8_t)type,          [1] = type % 8 == 1,       [5] = type % 8 == 1 ? 6 : 0,
        [7] = type % 8 == 1 ? 24 : 0, [12] = TGA_WIDTH,          [14] = TGA_HEIGHT,
        [16] = (uint8_t)depth,        [17] = (uint8_t)descriptor};
    size_t size = sizeof head;
    memcpy(to, head, size);
    for (int i = 0; i < 6 && type % 8 == 1; ++i) { /* entry i is the color of pixel i */
        uint8_t c[4];
        tga_color(i % TGA_WIDTH, i / TGA_WIDTH, c);
        to[size++] = c[2], to[size++] = c[1], to[size++] = c[0];
    }
    for (int i = 0; i < TGA_WIDTH * TGA_HEIGHT; ++i) {
        const int row = i / TGA_WIDTH, column = i % TGA_WIDTH;
        const int x = descriptor & 0x10 ? TGA_WIDTH - 1 - column : column;
        const int y = descriptor & 0x20 ? row : TGA_HEIGHT - 1 - row;
        uint8_t c[4];
        tga_color(x, y, c);
        if (type >= 8) { /* runs of 1, and pixels as they are, 1 at a time */
            to[size++] = i % 3 == 0 ? 0x80 : 0x00;
        }
        if (type % 8 == 1) {
            to[size++] = (uint8_t)(y * TGA_WIDTH + x);
        } else if (type % 8 == 3) {
            to[size++] = c[0];
        } else if (depth == 16) {
            const unsigned bits = (c[0] >> 3u) << 10 | (c[1] >> 3u) << 5 | c[2] >> 3u;
            to[size++] = (uint8_t)bits, to[size++] = (uint8_t)(bits >> 8);
        } else {
            to[size++] = c[2], to[size++] = c[1], to[size++] = c[0];
            if (depth == 32) {
                to[size++] = c[3];
            }
        }
    }
    return size;
}

static void test_tga(void) {
    static const struct {
        int type, depth, descriptor, channels;
    } cases[] = {{2, 24, 0, 3},     {2, 24, 0x20, 3}, {2, 32, 0x28, 4}, {2, 32, 0, 3},
                 {2, 16, 0x30, 3},  {3, 8, 0, 3},     {1, 8, 0x10, 3},  {10, 24, 0x20, 3},
                 {10, 32, 0x08, 4}, {11, 8, 0, 3},    {9, 8, 0x20, 3},  {10, 16, 0, 3}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        uint8_t bytes[200];
        const size_t size = make_tga(bytes, cases[i].type, cases[i].depth, cases[i].descriptor);
        burnish_image expected = make_image(TGA_WIDTH, TGA_HEIGHT, cases[i].channels);
        for (int k = 0; k < TGA_WIDTH * TGA_HEIGHT; ++k) {
            uint8_t c[4];
            tga_color(k % TGA_WIDTH, k / TGA_WIDTH, c);
            if (cases[i].type % 8 == 3) {
                c[1] = c[2] = c[0];
            }
            memcpy(expected.pixels + expected.channels * k, c, (size_t)expected.channels);
        }
        check_decoded("a.tga", i, bytes, size, &expected, (size_t[2]){18, size});
        burnish_image_destroy(&expected);
    }
}

/* 1000 pixels in 8 runs; a file that announces more than its bytes can hold is refused before any
 * memory is asked for. */
static void test_tga_runs(void) {
    uint8_t bytes[18 + 8 * 2] = {[2] = 11, [12] = 100, [14] = 10, [16] = 8};
    burnish_image image;
    burnish_error error;
    for (int i = 0; i < 8; ++i) {
        bytes[18 + 2 * i] = 0xFF; /* 128 pixels, the last ones beyond the picture */
        bytes[19 + 2 * i] = (uint8_t)(10 * i);
    }
    if (CHECK_OK(burnish_image_decode(NULL, bytes, sizeof bytes, NULL, &image, &error), error)) {
        for (int i = 0; i < 1000; ++i) { /* rows from the bottom */
            const int at = (9 - i / 100) * 100 + i % 100;
            CHECK(image.pixels[3 * at] == 10 * (i / 128), "pixel %d", i);
        }
        burnish_image_destroy(&image);
    }
    bytes[13] = 0x3F;
    bytes[15] = 0x3F;
    CHECK1(burnish_image_decode(NULL, bytes, sizeof bytes, "a.tga", &image, &error) ==
           BURNISH_STATUS_FORMAT);
    CHECK_TEXT(error.text, "a.tga: the file ends before its pixels; it is truncated");
}

/* ---- BMP ---- */

typedef struct bmp_case {
    int header, depth, compression, from_top;
} bmp_case;

static void put_number(uint8_t *to, uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) {
        to[i] = (uint8_t)(value >> 8 * i);
    }
}

/* The pixel whose colour pixel i has: palettes of 1 bit hold but two. */
static int bmp_source(const bmp_case *c, int i) {
    return c->depth == 1 ? i % 2 : i;
}

/* Masks of compression 3: red lowest, with alpha where the header has room for it. */
static size_t make_bmp(uint8_t *to, const bmp_case *c) {
    const int is_core = c->header == 12, colors = c->depth > 8 ? 0 : c->depth == 1 ? 2 : 6;
    const size_t stride = (size_t)(TGA_WIDTH * c->depth + 31) / 32 * 4;
    size_t size = 14 + (size_t)c->header;
    memset(to, 0, 400);
    memcpy(to, "BM", 2);
    put_number(to + 14, (uint32_t)c->header, 4);
    put_number(to + 18, TGA_WIDTH, is_core ? 2 : 4);
    put_number(to + (is_core ? 20 : 22), c->from_top ? (uint32_t)-TGA_HEIGHT : TGA_HEIGHT,
               is_core ? 2 : 4);
    put_number(to + (is_core ? 24 : 28), (uint32_t)c->depth, 2);
    if (!is_core) {
        put_number(to + 30, (uint32_t)c->compression, 4);
        put_number(to + 46, (uint32_t)colors, 4);
    }
    if (c->compression == 3) {
        for (int i = 0; i < (c->header >= 56 ? 4 : 3); ++i) {
            put_number(to + 54 + 4 * i, 0xFFu << 8 * i, 4);
        }
        size = size < 66 ? 66 : size;
    }
    for (int i = 0; i < colors; ++i, size += is_core ? 3 : 4) {
        uint8_t rgba[4];
        tga_color(i % TGA_WIDTH, i / TGA_WIDTH, rgba);
        to[size] = rgba[2], to[size + 1] = rgba[1], to[size + 2] = rgba[0];
    }
    put_number(to + 10, (uint32_t)size, 4);
    for (int i = 0; i < TGA_WIDTH * TGA_HEIGHT; ++i) {
        const int x = i % TGA_WIDTH, y = i / TGA_WIDTH;
        uint8_t *row = to + size + stride * (size_t)(c->from_top ? y : TGA_HEIGHT - 1 - y), rgba[4];
        tga_color(x, y, rgba);
        const uint32_t bgr = (uint32_t)rgba[0] << 16 | (uint32_t)rgba[1] << 8 | rgba[2],
                       rgb = (uint32_t)rgba[2] << 16 | (uint32_t)rgba[1] << 8 | rgba[0];
        if (c->depth <= 8) {
            const int bit = x * c->depth;
            row[bit / 8] |= (uint8_t)(bmp_source(c, i) << (8 - c->depth - bit % 8));
        } else if (c->depth == 16) {
            put_number(row + 2 * x,
                       (rgba[0] >> 3u) << 10 | (rgba[1] >> 3u) << 5 | (uint32_t)rgba[2] >> 3, 2);
        } else {
            put_number(row + c->depth / 8 * x,
                       c->compression == 3 ? rgb | (uint32_t)rgba[3] << 24 : bgr, c->depth / 8);
        }
    }
    return size + stride * TGA_HEIGHT;
}

static void test_bmp(void) {
    static const bmp_case cases[] = {
        {40, 24, 0, 0}, {40, 24, 0, 1}, {40, 32, 0, 0},  {40, 32, 3, 0},
        {44, 32, 3, 0}, {56, 32, 3, 1}, {124, 32, 3, 0}, {40, 16, 0, 0},
        {40, 8, 0, 0},  {40, 4, 0, 1},  {40, 1, 0, 0},   {12, 24, 0, 0},
        {12, 8, 0, 0},  {12, 1, 0, 0},  {108, 24, 0, 0}, {124, 8, 0, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        const bmp_case *c = &cases[i];
        uint8_t bytes[400];
        const size_t size = make_bmp(bytes, c);
        const int channels = c->compression == 3 && c->header >= 56 ? 4 : 3;
        burnish_image expected = make_image(TGA_WIDTH, TGA_HEIGHT, channels);
        for (int k = 0; k < TGA_WIDTH * TGA_HEIGHT; ++k) {
            uint8_t rgba[4];
            tga_color(bmp_source(c, k) % TGA_WIDTH, bmp_source(c, k) / TGA_WIDTH, rgba);
            memcpy(expected.pixels + channels * k, rgba, (size_t)channels);
        }
        const size_t last = (size_t)(TGA_WIDTH * c->depth + 7) / 8, /* padding may be missing */
            least = size - (size_t)(TGA_WIDTH * c->depth + 31) / 32 * 4 + last;
        check_decoded("a.bmp", i, bytes, size, &expected, (size_t[2]){2, least});
        burnish_image_destroy(&expected);
    }
}

/* What is refused before any memory is asked for, and indices beyond the palette. */
static void test_odd_bmp(void) {
    static const struct {
        size_t at;
        uint32_t value;
        const char *text;
    } cases[] = {
        {30, 1, "a.bmp: a BMP with runs, or of an unknown kind; convert it to PNG"},
        {28, 7, "a.bmp: a BMP with runs, or of an unknown kind; convert it to PNG"},
        {18, 1u << 30, "a.bmp: its header is damaged"},
        {22, 1u << 31, "a.bmp: its header is damaged"},
        {18, 0, "a.bmp: 0 x 2 pixels; it is damaged"},
        {22, 0, "a.bmp: the file ends before its pixels; it is truncated"},
        {22, 70000, "a.bmp: the file ends before its pixels; it is truncated"},
        {10, 1u << 31, "a.bmp: the file ends before its pixels; it is truncated"},
        {14, 1u << 31, "a.bmp: the file ends before its pixels; it is truncated"},
    };
    const bmp_case plain = {40, 8, 0, 0};
    uint8_t bytes[400];
    burnish_image image;
    burnish_error error;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        const size_t size = make_bmp(bytes, &plain);
        put_number(bytes + cases[i].at, cases[i].value, 4);
        CHECK(burnish_image_decode(NULL, bytes, size, "a.bmp", &image, &error) ==
                  BURNISH_STATUS_FORMAT,
              "case %zu", i);
        CHECK_TEXT(error.text, cases[i].text);
    }
    /* masks that the header has no room for, beyond the end of the file */
    static const bmp_case masked = {44, 32, 3, 0};
    make_bmp(bytes, &masked);
    put_number(bytes + 10, 58, 4);
    put_number(bytes + 18, 1, 4);
    put_number(bytes + 22, 1, 4);
    CHECK1(burnish_image_decode(NULL, bytes, 62, "a.bmp", &image, &error) == BURNISH_STATUS_FORMAT);
    CHECK_TEXT(error.text, "a.bmp: the file ends before its pixels; it is truncated");
    const size_t size = make_bmp(bytes, &plain);
    bytes[size - 4] = 200; /* the first pixel of the upper row */
    if (CHECK_OK(burnish_image_decode(NULL, bytes, size, "a.bmp", &image, &error), error)) {
        CHECK1(memcmp(image.pixels, (const uint8_t[3]){0, 0, 0}, 3) == 0);
        burnish_image_destroy(&image);
    }
}

#if BURNISH_HAS_JPEG
#include <jpeglib.h>

/* Progressive, grey, of one colour, with its last scan `more` times more. To be freed. */
static uint8_t *make_scans(int side, int more, size_t *size) {
    struct jpeg_compress_struct codec;
    struct jpeg_error_mgr manager; /* ends the program on an error, which is a failure too */
    uint8_t *bytes = NULL, *row = calloc((size_t)side, 1);
    unsigned long length = 0;
    codec.err = jpeg_std_error(&manager);
    jpeg_create_compress(&codec);
    jpeg_mem_dest(&codec, &bytes, &length);
    codec.image_width = codec.image_height = (JDIMENSION)side;
    codec.input_components = 1;
    codec.in_color_space = JCS_GRAYSCALE;
    jpeg_set_defaults(&codec);
    jpeg_simple_progression(&codec);
    jpeg_start_compress(&codec, TRUE);
    while (codec.next_scanline < codec.image_height) {
        jpeg_write_scanlines(&codec, &row, 1);
    }
    jpeg_finish_compress(&codec);
    jpeg_destroy_compress(&codec);
    size_t last = length; /* where the last scan begins: ff da; ff d9 ends the file */
    while (--last > 0 && !(bytes[last] == 0xff && bytes[last + 1] == 0xda)) {
    }
    const size_t scan = length - 2 - last;
    uint8_t *longer = malloc(length + (size_t)more * scan);
    memcpy(longer, bytes, length - 2);
    *size = length - 2;
    for (int i = 0; i < more; ++i, *size += scan) {
        memcpy(longer + *size, bytes + last, scan);
    }
    memcpy(longer + *size, bytes + length - 2, 2);
    *size += 2;
    free(bytes);
    free(row);
    return longer;
}

/* A scan of a few bytes goes over all pixels: large pictures may have fewer of them. */
static void test_scans(void) {
    static const struct {
        int side, more;
        const char *text; /* NULL: it is decoded */
    } cases[] = {{64, 40, NULL},
                 {64, 600, "a.jpg: no sound JPEG: more than 500 scans"},
                 {2048, 8, NULL},
                 {2048, 40, "a.jpg: no sound JPEG: more than 16 scans"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        size_t size;
        uint8_t *bytes = make_scans(cases[i].side, cases[i].more, &size);
        burnish_image image;
        burnish_error error = {BURNISH_STATUS_OK, ""};
        const burnish_status status =
            burnish_image_decode(NULL, bytes, size, "a.jpg", &image, &error);
        CHECK(status == (cases[i].text ? BURNISH_STATUS_FORMAT : BURNISH_STATUS_OK), "case %zu", i);
        CHECK_TEXT(error.text, cases[i].text ? cases[i].text : "");
        burnish_image_destroy(&image);
        free(bytes);
    }
}
#endif

/* ---- Files that name textures ---- */

typedef struct folder {
    const char *library;
    uint8_t *png, *tga; /* tga: the caller's, in its place; NULL: none */
    size_t png_size, tga_size;
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
    *bytes = is_library ? (const void *)f->library : f->tga ? f->tga : f->png;
    *size = is_library             ? strlen(f->library)
            : f->tga               ? f->tga_size
            : strstr(name, "half") ? f->png_size / 2
                                   : f->png_size;
    return BURNISH_STATUS_OK;
}

static burnish_mesh *load_text(folder *f, const char *name, const char *text,
                               const burnish_load_options *given) {
    burnish_load_options options = *given;
    burnish_image image = make_picture(4);
    const burnish_pixels pixels = burnish_image_get_pixels(&image);
    burnish_error error = {BURNISH_STATUS_OK, ""};
    f->asked[0] = 0;
    CHECK_OK(burnish_png_encode(&pixels, NULL, &f->png, &f->png_size, &error), error);
    options.referenced_files = (burnish_file_loader){load, NULL, f};
    burnish_mesh *mesh = load_bytes(text, strlen(text), name, &options);
    burnish_release(NULL, f->png);
    burnish_image_destroy(&image);
    return mesh;
}

static const char obj[] = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                          "usemtl a\nf 1/1 2/2 3/3\n";

static void test_obj(void) {
    folder f = {
        .library =
            "newmtl a\nKd 0 0 0\nmap_Ka a.png\nmap_Kd -s 2 3 1 -o 0.5 0.25 -mm 0 1 "
            "tex\\my skin.png\nmap_Ka a.png\nMAP_KS -clamp on ../../x.png\nmap_d tex\\my skin.png\n"
            "bump -bm 0.5 h.png\nmap_Ke C:\\missing\\missing.png\n"};
    const burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = load_text(&f, "m.obj", obj, &options);
    const burnish_material *material = burnish_mesh_get_material(mesh, 0);
    const burnish_texture_use *color = &material->textures[BURNISH_TEXTURE_COLOR];
    const burnish_texture_use *specular = &material->textures[BURNISH_TEXTURE_SPECULAR];
    CHECK_TEXT(
        f.asked,
        "a.mtl|tex/my skin.png|x.png|h.png|missing.png|textures/missing.png|texture/missing.png|"
        "materials/textures/missing.png|materials/missing.png|tex/my skin.png|");
    CHECK1(material->diffuse[0] == 1 && material->ambient[1] == 1 && material->has_diffuse);
    CHECK1(color->transform[0] == 2 && color->transform[4] == 3 && color->transform[2] == 0.5f &&
           color->transform[5] == 0.25f && color->wrap[0] == BURNISH_WRAP_REPEAT);
    CHECK1(specular->texture && specular->wrap[1] == BURNISH_WRAP_CLAMP);
    CHECK1(material->alpha_mode == BURNISH_ALPHA_BLEND && !(material->transparency > 0));
    CHECK1(material->textures[BURNISH_TEXTURE_NORMAL].texture &&
           burnish_mesh_get_view(mesh)->tangents);
    CHECK1(!material->textures[BURNISH_TEXTURE_EMISSIVE].texture);
    CHECK(burnish_mesh_get_warning_count(mesh) == 2, "%zu", burnish_mesh_get_warning_count(mesh));
    CHECK_TEXT(burnish_mesh_get_warning(mesh, 0), "a.mtl:4: map_Kd: -mm is not drawn");
    CHECK_TEXT(burnish_mesh_get_warning(mesh, 1),
               "m.obj: texture \"C:\\missing\\missing.png\" was skipped: it is a path of another "
               "machine; put the texture next to the file, or into textures/ there");
    burnish_mesh_destroy(mesh);
}

static void test_limits(void) {
    folder f = {.library = "newmtl a\nmap_Ka x.png\nmap_Ks x.png\nmap_Ke y.png\n"};
    burnish_load_options options = burnish_load_options_default();
    options.max_texture_pixels = SIDE * SIDE;
    options.threads = 1; /* several load what is beyond the limit twice */
    burnish_mesh *mesh = load_text(&f, "m.obj", obj, &options);
    const burnish_texture_use *uses = burnish_mesh_get_material(mesh, 0)->textures;
    CHECK_TEXT(f.asked, "a.mtl|x.png|y.png|"); /* equal names are one texture */
    CHECK1(
        uses[BURNISH_TEXTURE_COLOR].texture == 1 && uses[BURNISH_TEXTURE_SPECULAR].texture == 1 &&
        burnish_mesh_get_texture_count(mesh) == 1 && uses[BURNISH_TEXTURE_EMISSIVE].texture == 0 &&
        burnish_mesh_get_warning_count(mesh) == 1);
    burnish_mesh_destroy(mesh);
    options.ignore_textures = 1;
    mesh = load_text(&f, "m.obj", obj, &options);
    CHECK_TEXT(f.asked, "a.mtl|");
    CHECK1(burnish_mesh_get_texture_count(mesh) == 0 &&
           !burnish_mesh_get_view(mesh)->texture_coordinates);
    burnish_mesh_destroy(mesh);
}

/* ---- Pictures decoded side by side ---- */

/* Everything that textures leave in a mesh is the same in both. */
static void check_same(const burnish_mesh *a, const burnish_mesh *b, int limit) {
    const size_t textures = burnish_mesh_get_texture_count(a),
                 notes = burnish_mesh_get_warning_count(a);
    CHECK(textures == burnish_mesh_get_texture_count(b) &&
              notes == burnish_mesh_get_warning_count(b),
          "limit %d: %zu and %zu textures, %zu and %zu warnings", limit, textures,
          burnish_mesh_get_texture_count(b), notes, burnish_mesh_get_warning_count(b));
    for (size_t i = 0; i < textures && i < burnish_mesh_get_texture_count(b); ++i) {
        const burnish_texture *x = burnish_mesh_get_texture(a, i),
                              *y = burnish_mesh_get_texture(b, i);
        CHECK_TEXT(x->name, y->name);
        CHECK1(x->width == y->width && x->height == y->height && x->is_color == y->is_color &&
               memcmp(x->pixels, y->pixels, 4 * (size_t)(x->width * x->height)) == 0);
    }
    for (size_t i = 0; i < notes && i < burnish_mesh_get_warning_count(b); ++i) {
        CHECK_TEXT(burnish_mesh_get_warning(a, i), burnish_mesh_get_warning(b, i));
    }
    for (int slot = 0; slot < BURNISH_TEXTURE_SLOT_COUNT; ++slot) {
        CHECK(burnish_mesh_get_material(a, 0)->textures[slot].texture ==
                  burnish_mesh_get_material(b, 0)->textures[slot].texture,
              "limit %d: slot %d", limit, slot);
    }
}

/* With several threads pictures are decoded before they are asked for: the same textures, texels
 * and warnings, also where there are too many texels, or some pictures are damaged. */
static void test_side_by_side(void) {
    static byte_list glb;
    folder f = {.library = "newmtl a\nmap_Kd a.png\nmap_Ks half.png\nmap_Ns missing.png\n"
                           "map_d b.png\nmap_Ke a.png\nbump half2.png\n"};
    for (int limit = 0; limit < 6; ++limit) {
        burnish_load_options options = burnish_load_options_default();
        burnish_mesh *meshes[2][2];
        burnish_image image = make_picture(4);
        const burnish_pixels pixels = burnish_image_get_pixels(&image);
        burnish_error error = {BURNISH_STATUS_OK, ""};
        char json[1600];
        static byte_list binary;
        uint8_t *png;
        size_t size;
        CHECK_OK(burnish_png_encode(&pixels, NULL, &png, &size, &error), error);
        binary.size = 0;
        put_floats(&binary, 9, (const float[]){0, 0, 0, 1, 0, 0, 0, 1, 0});
        put(&binary, png, size);
        snprintf(json, sizeof json,
                 "$head'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0}],'meshes':[{'primitives':[{"
                 "'attributes':{'POSITION':0,'TEXCOORD_0':1},'material':0}]}],'accessors':[{"
                 "'bufferView':0,'componentType':5126,'count':3,'type':'VEC3','min':[0,0,0],'max':"
                 "[1,1,0]},{'bufferView':0,'componentType':5126,'count':3,'type':'VEC2'}],"
                 "'buffers':[{'byteLength':%zu}],'bufferViews':[{'buffer':0,'byteLength':36},"
                 "{'buffer':0,'byteOffset':36,'byteLength':%zu},"
                 "{'buffer':0,'byteOffset':36,'byteLength':%zu}],'images':[{'bufferView':1,"
                 "'name':'a'},{'bufferView':2},{'bufferView':1}],'textures':[{'source':0},"
                 "{'source':1},{'source':2}],'materials':[{'normalTexture':{'index':1},"
                 "'emissiveTexture':{'index':0},'occlusionTexture':{'index':2},"
                 "'pbrMetallicRoughness':{'baseColorTexture':{'index':2},"
                 "'metallicRoughnessTexture':{'index':2}}}]}",
                 36 + size, size, size / 2);
        glb.size = 0;
        put_glb(&glb, json, &binary);
        options.max_texture_pixels = limit == 0 ? 1 << 28 : (uint64_t)(limit * SIDE * SIDE - 1);
        for (int i = 0; i < 2; ++i) {
            options.threads = i == 0 ? 1 : 4;
            meshes[0][i] = load_text(&f, "m.obj", obj, &options);
            meshes[1][i] = load_bytes(glb.bytes, glb.size, "m.glb", &options);
        }
        for (int i = 0; i < 2; ++i) {
            check_same(meshes[i][0], meshes[i][1], limit);
            CHECK1(burnish_mesh_get_texture_count(meshes[i][0]) > 0 || limit == 1);
            burnish_mesh_destroy(meshes[i][0]);
            burnish_mesh_destroy(meshes[i][1]);
        }
        burnish_release(NULL, png);
        burnish_image_destroy(&image);
    }
}

static void test_ply(void) {
    folder f = {0};
    const burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = load_text(
        &f, "m.ply",
        "ply\nformat ascii 1.0\ncomment TextureFile skin.png\nelement vertex 3\n"
        "property float x\nproperty float y\nproperty float z\nproperty float s\n"
        "property float t\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n",
        &options);
    CHECK_TEXT(f.asked, "skin.png|");
    CHECK1(burnish_mesh_get_material(mesh, 0)->textures[BURNISH_TEXTURE_COLOR].texture == 1 &&
           burnish_mesh_get_view(mesh)->texture_coordinates &&
           burnish_mesh_get_warning_count(mesh) == 0);
    burnish_mesh_destroy(mesh);
}

/* The limit grows with the bytes that were read: a small file can't ask for much. */
static void test_limit_of_bytes(void) {
    static const size_t sizes[] = {1100000, 1200000};
    const char mtl[] = "newmtl a\nmap_Kd x.png\n";
    for (int i = 0; i < 3; ++i) { /* a picture that could be there, by its runs */
        const uint8_t head[18] = {[2] = 10, [13] = 64, [14] = 255, [15] = 22, [16] = 24};
        const size_t size = sizes[i & 1];
        uint8_t *tga = calloc(size, 1);
        folder f = {.library = mtl, .tga = tga, .tga_size = size};
        burnish_load_options options = burnish_load_options_default();
        char text[200];
        memcpy(tga, head, sizeof head);
        options.max_texture_pixels = i == 2 ? 1000 : options.max_texture_pixels;
        burnish_mesh *mesh = load_text(&f, "m.obj", obj, &options);
        const size_t left = i == 2 ? 1000 : 32 * (strlen(obj) + size);
        snprintf(
            text, sizeof text,
            "m.obj: texture \"x.png\" was skipped: x.png: 16384 x 5887 pixels, and %zu are left "
            "of the limit of all textures; raise it, or make them smaller",
            left);
        CHECK_TEXT(burnish_mesh_get_warning(mesh, 0), text);
        burnish_mesh_destroy(mesh);
        free(tga);
    }
}

/* Textures of faces, by their numbers; <this> is the file's own name. One colour of all vertices
 * says nothing beside a texture. */
static void test_ply_faces(void) {
    folder f = {0};
    const burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh = load_text(
        &f, "m.ply",
        "ply\nformat ascii 1.0\ncomment TextureFile <this>_A.png\ncomment TextureFile missing.png\n"
        "comment TextureFile C.png\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element face 2\nproperty list uchar int vertex_indices\n"
        "property list uchar float texcoord\nproperty int texnumber\nend_header\n"
        "0 0 0 192 192 192\n1 0 0 192 192 192\n0 1 0 192 192 192\n"
        "3 0 1 2 6 0 0 1 0 0 1 2\n3 2 1 0 6 0 0 1 0 0 1 0\n",
        &options);
    CHECK_TEXT(f.asked, "m_A.png|missing.png|textures/missing.png|texture/missing.png|"
                        "materials/textures/missing.png|materials/missing.png|C.png|");
    CHECK1(burnish_mesh_get_texture_count(mesh) == 2 && burnish_mesh_get_material_count(mesh) == 3);
    CHECK1(burnish_mesh_get_material(mesh, 0)->textures[BURNISH_TEXTURE_COLOR].texture == 1 &&
           burnish_mesh_get_material(mesh, 1)->textures[BURNISH_TEXTURE_COLOR].texture == 0 &&
           burnish_mesh_get_material(mesh, 2)->textures[BURNISH_TEXTURE_COLOR].texture == 2);
    CHECK1(burnish_mesh_get_view(mesh)->texture_coordinates &&
           !burnish_mesh_get_view(mesh)->colors && burnish_mesh_get_warning_count(mesh) == 1);
    burnish_mesh_destroy(mesh);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_formats());
    RUN(test_tga());
    RUN(test_tga_runs());
    RUN(test_bmp());
    RUN(test_odd_bmp());
#if BURNISH_HAS_JPEG
    RUN(test_scans());
#endif
    RUN(test_obj());
    RUN(test_limits());
    RUN(test_limit_of_bytes());
    RUN(test_side_by_side());
    RUN(test_ply());
    RUN(test_ply_faces());
    return test_end("decode");
}
