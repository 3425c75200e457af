/* JPEG by libjpeg-turbo: baseline sequential, colour at full resolution, since the edges of a drawn
 * object would otherwise get coloured fringes. */
#include "picture/formats.h"

#if BURNISH_HAS_JPEG
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>

#include <jpeglib.h>

/* The library exits the process on an error, unless this handler jumps out. */
typedef struct jpeg_failure {
    struct jpeg_error_mgr manager;
    jmp_buf place;
} jpeg_failure;

static void jpeg_write_fail(j_common_ptr codec) {
    longjmp(((jpeg_failure *)codec->err)->place, 1);
}

static void set_up(j_compress_ptr codec, const burnish_pixels *pixels,
                   const picture_options *options) {
    codec->image_width = (JDIMENSION)pixels->width;
    codec->image_height = (JDIMENSION)pixels->height;
    codec->input_components = 3;
    codec->in_color_space = JCS_RGB;
    jpeg_set_defaults(codec);
    jpeg_set_quality(codec, options->quality > 0 ? options->quality : PICTURE_JPEG_QUALITY, TRUE);
    codec->dct_method = JDCT_ISLOW; /* the exact one */
    codec->optimize_coding = TRUE;
    for (int i = 0; i < 3; ++i) {
        codec->comp_info[i].h_samp_factor = 1;
        codec->comp_info[i].v_samp_factor = 1;
    }
    if (options->dots_per_inch > 0) {
        codec->density_unit = 1; /* dots per inch, whole ones */
        codec->X_density = (UINT16)(options->dots_per_inch + 0.5);
        codec->Y_density = codec->X_density;
    }
}

burnish_status picture_encode_jpeg(const burnish_pixels *pixels, const picture_options *options,
                                   picture_file *file, burnish_error *error) {
    struct jpeg_compress_struct codec;
    jpeg_failure failure;
    unsigned char *bytes = NULL;
    unsigned long size = 0;
    if (pixels->format != BURNISH_PIXELS_RGB8) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "JPEG has no alpha; write PNG or WebP");
    }
    if (options->dots_per_inch > 65535) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "JPEG holds at most 65535 dots per inch; write PNG");
    }
    codec.err = jpeg_std_error(&failure.manager);
    failure.manager.error_exit = jpeg_write_fail;
    jpeg_create_compress(&codec);
    jpeg_mem_dest(&codec, &bytes, &size);
    if (setjmp(failure.place)) {
        char reason[JMSG_LENGTH_MAX];
        codec.err->format_message((j_common_ptr)&codec, reason);
        jpeg_destroy_compress(&codec);
        return cli_fail(error, BURNISH_STATUS_MEMORY, "JPEG: %.200s", reason);
    }
    set_up(&codec, pixels, options);
    jpeg_start_compress(&codec, TRUE);
    jpeg_write_marker(&codec, JPEG_COM, (const JOCTET *)"burnish", 7); /* as PNG's Software */
    while (codec.next_scanline < codec.image_height) {
        JSAMPROW row = pixels->pixels + pixels->stride * codec.next_scanline;
        jpeg_write_scanlines(&codec, &row, 1);
    }
    jpeg_finish_compress(&codec);
    jpeg_destroy_compress(&codec);
    file->bytes = bytes;
    file->size = size;
    return BURNISH_STATUS_OK;
}

#else

burnish_status picture_encode_jpeg(const burnish_pixels *pixels, const picture_options *options,
                                   picture_file *file, burnish_error *error) {
    (void)pixels, (void)options, (void)file;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "JPEG: this build has no libjpeg");
}

#endif
