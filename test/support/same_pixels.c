/* Whether two PNG files hold the same pixels, however they are compressed.
 * Usage: same_pixels A B       exit 0: the same; 1: not; 2: a file can't be read */
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The pixels as RGBA; NULL where the file is no PNG. */
static png_bytep load(const char *path, png_image *image) {
    memset(image, 0, sizeof *image);
    image->version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(image, path)) {
        fprintf(stderr, "same_pixels: %s: %s\n", path, image->message);
        return NULL;
    }
    image->format = PNG_FORMAT_RGBA;
    png_bytep pixels = malloc(PNG_IMAGE_SIZE(*image));
    if (pixels && !png_image_finish_read(image, NULL, pixels, 0, NULL)) {
        free(pixels);
        return NULL;
    }
    return pixels;
}

int main(int argc, char **argv) {
    png_image a, b;
    png_bytep a_pixels = argc == 3 ? load(argv[1], &a) : NULL;
    png_bytep b_pixels = a_pixels ? load(argv[2], &b) : NULL;
    int result = 2;
    if (a_pixels && b_pixels) {
        result = a.width != b.width || a.height != b.height ||
                 memcmp(a_pixels, b_pixels, PNG_IMAGE_SIZE(a)) != 0;
    }
    free(a_pixels);
    free(b_pixels);
    return result;
}
