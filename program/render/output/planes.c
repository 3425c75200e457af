/* Planes: buffers of numbers for other programs. */
#include "picture/exr.h"
#include "picture/npy.h"
#include "render/output/result.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A plane in its file formats. */
typedef struct plane_row {
    picture_kind kind;
    int channels;
    const char *names[4]; /* of the EXR channels, as expected by compositing programs */
} plane_row;

static const plane_row rows[PLANE_KINDS] = {
    [PLANE_COLOR] = {PICTURE_FLOAT, 4, {"R", "G", "B", "A"}},
    [PLANE_DEPTH] = {PICTURE_FLOAT, 1, {"Z"}},
    [PLANE_NORMAL] = {PICTURE_FLOAT, 3, {"N.X", "N.Y", "N.Z"}},
    [PLANE_TRIANGLE] = {PICTURE_INT, 1, {"id"}},
    [PLANE_MATERIAL] = {PICTURE_INT, 1, {"material"}},
    [PLANE_COVERAGE] = {PICTURE_BYTE, 1, {"coverage"}},
};

static const void *values_of(const render_plane_data *data, render_plane_kind kind) {
    const void *const values[PLANE_KINDS] = {
        [PLANE_COLOR] = data->color,        [PLANE_DEPTH] = data->depth,
        [PLANE_NORMAL] = data->normals,     [PLANE_TRIANGLE] = data->triangles,
        [PLANE_MATERIAL] = data->materials, [PLANE_COVERAGE] = data->coverage,
    };
    return values[kind];
}

static size_t pixel_count(const render_plane_data *data) {
    return (size_t)data->width * (size_t)data->height; /* at most 2^28 */
}

static burnish_status fail_memory(burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_MEMORY,
                    "out of memory: the planes; free memory, or draw a smaller picture");
}

/* ---- Drawing ---- */

static void *allocate(const render_plane_data *data, size_t size, int *failed) {
    void *plane = size <= SIZE_MAX / pixel_count(data) ? malloc(pixel_count(data) * size) : NULL;
    *failed |= !plane;
    return plane;
}

static int allocate_planes(render_plane_data *data, unsigned kinds) {
    int failed = 0;
    if (kinds & 1U << PLANE_COLOR) {
        data->color = allocate(data, 4 * sizeof(float), &failed);
    }
    if (kinds & 1U << PLANE_DEPTH) {
        data->depth = allocate(data, sizeof(float), &failed);
    }
    if (kinds & 1U << PLANE_NORMAL) {
        data->normals = allocate(data, 3 * sizeof(float), &failed);
    }
    if (kinds & (1U << PLANE_TRIANGLE | 1U << PLANE_MATERIAL)) { /* materials come from triangles */
        data->triangles = allocate(data, sizeof(uint32_t), &failed);
    }
    if (kinds & 1U << PLANE_MATERIAL) {
        data->materials = allocate(data, sizeof(uint32_t), &failed);
    }
    if (kinds & 1U << PLANE_COVERAGE) {
        data->coverage = allocate(data, 1, &failed);
    }
    return !failed;
}

static void find_materials(const burnish_mesh *mesh, render_plane_data *data) {
    const uint16_t *materials = burnish_mesh_get_view(mesh)->triangle_materials;
    for (size_t i = 0; i < pixel_count(data); ++i) {
        const uint32_t triangle = data->triangles[i];
        data->materials[i] = triangle == BURNISH_TRIANGLE_NONE ? UINT32_MAX
                             : materials                       ? materials[triangle]
                                                               : 0;
    }
}

static void measure_depth(render_plane_data *data) {
    float low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < pixel_count(data); ++i) {
        const float depth = data->depth[i];
        low = depth < low ? depth : low;
        high = depth > high && depth < INFINITY ? depth : high;
    }
    data->low = low <= high ? low : 0;
    data->high = low <= high ? high : 0;
}

burnish_status render_draw_planes(burnish_renderer *renderer, const burnish_mesh *mesh,
                                  const burnish_render_options *options, unsigned kinds,
                                  render_plane_data *data, burnish_error *error) {
    const size_t row = (size_t)options->width * sizeof(float);
    const int height = options->row_count > 0 ? options->row_count : options->height;
    *data = (render_plane_data){.width = options->width, .height = height};
    if (!allocate_planes(data, kinds)) {
        return fail_memory(error);
    }
    burnish_target target = burnish_target_default();
    target.pixels = (burnish_pixels){options->width, height, BURNISH_PIXELS_RGBA_FLOAT, 4 * row,
                                     (uint8_t *)data->color};
    target.depth = data->depth;
    target.depth_stride = row;
    target.normals = data->normals;
    target.normal_stride = 3 * row;
    target.triangles = data->triangles;
    target.triangle_stride = row;
    target.coverage = data->coverage;
    target.coverage_stride = (size_t)options->width;
    burnish_status status =
        burnish_renderer_draw_into(renderer, mesh, options, &target, NULL, error);
    if (status == BURNISH_STATUS_OK && data->materials) {
        find_materials(mesh, data);
    }
    if (status == BURNISH_STATUS_OK && data->depth) {
        measure_depth(data);
    }
    return status;
}

void render_release_planes(render_plane_data *data) {
    free(data->color);
    free(data->depth);
    free(data->normals);
    free(data->triangles);
    free(data->materials);
    free(data->coverage);
    *data = (render_plane_data){0};
}

/* ---- PNG: numbers of 16 bits ---- */

/* 0 for empty pixels, else 1 for the least depth to 65535 for the largest. */
static void map_depth(const render_plane_data *data, uint16_t *codes) {
    const double range = (double)data->high - data->low;
    const double scale = range > 0 ? 65534 / range : 0;
    for (size_t i = 0; i < pixel_count(data); ++i) {
        const double depth = data->depth[i];
        codes[i] = depth < INFINITY ? (uint16_t)(1.5 + (depth - data->low) * scale) : 0;
    }
}

/* 0, 0, 0 for empty pixels, else 1 for -1 to 65535 for 1. */
static void map_normals(const render_plane_data *data, uint16_t *codes) {
    for (size_t i = 0; i < pixel_count(data); ++i) {
        const float *normal = data->normals + 3 * i;
        const int none = normal[0] == 0 && normal[1] == 0 && normal[2] == 0;
        for (int k = 0; k < 3; ++k) {
            const double value = normal[k] < -1 ? -1 : normal[k] > 1 ? 1 : (double)normal[k];
            codes[3 * i + (size_t)k] = none ? 0 : (uint16_t)((value + 1) * 32767.5 + 0.5);
        }
    }
}

static void map_coverage(const render_plane_data *data, uint16_t *codes) {
    for (size_t i = 0; i < pixel_count(data); ++i) {
        codes[i] = (uint16_t)(257 * data->coverage[i]);
    }
}

/* Ids plus 1 (0 is none) in three bytes, the highest in red. The channels have 8 bits, because many
 * readers drop the lower half of 16. Returns 0 for an id that does not fit. */
static int map_ids(const uint32_t *ids, size_t count, uint8_t *bytes) {
    for (size_t i = 0; i < count; ++i) {
        const uint32_t code = ids[i] + 1; /* UINT32_MAX becomes 0 */
        if (code >> 24) {
            return 0;
        }
        bytes[3 * i] = (uint8_t)(code >> 16);
        bytes[3 * i + 1] = (uint8_t)(code >> 8);
        bytes[3 * i + 2] = (uint8_t)code;
    }
    return 1;
}

static burnish_status encode_png(const render_plane_data *data, render_plane_kind kind, int threads,
                                 picture_file *file, burnish_error *error) {
    const int is_id = kind == PLANE_TRIANGLE || kind == PLANE_MATERIAL;
    const size_t pixel = is_id ? 3 : kind == PLANE_NORMAL ? 6 : 2;
    burnish_pixels pixels = {.width = data->width,
                             .height = data->height,
                             .format = is_id                  ? BURNISH_PIXELS_RGB8
                                       : kind == PLANE_NORMAL ? BURNISH_PIXELS_RGB16
                                                              : BURNISH_PIXELS_GRAY16,
                             .stride = pixel * (size_t)data->width};
    void *codes = malloc(pixel * pixel_count(data));
    burnish_status status = codes ? BURNISH_STATUS_OK : fail_memory(error);
    pixels.pixels = codes;
    if (codes && kind == PLANE_DEPTH) {
        map_depth(data, codes);
    } else if (codes && kind == PLANE_NORMAL) {
        map_normals(data, codes);
    } else if (codes && kind == PLANE_COVERAGE) {
        map_coverage(data, codes);
    } else if (codes && !map_ids(values_of(data, kind), pixel_count(data), codes)) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--plane: a PNG holds ids up to 16777214; write NPY or EXR");
    }
    if (status == BURNISH_STATUS_OK) {
        const picture_options options = {.threads = threads, .is_data = 1};
        status = picture_encode(PICTURE_PNG, &pixels, &options, file, error);
    }
    free(codes);
    return status;
}

/* ---- NPY and EXR ---- */

static burnish_status encode_npy(const render_plane_data *data, render_plane_kind kind,
                                 picture_file *file, burnish_error *error) {
    const picture_array array = {rows[kind].kind, data->width, data->height, rows[kind].channels,
                                 values_of(data, kind)};
    return picture_encode_npy(&array, file, error);
}

/* Values for EXR: coverage as floats from 0 to 1, colour with premultiplied alpha. NULL without
 * memory. */
static float *convert(const render_plane_data *data, render_plane_kind kind) {
    const size_t count = pixel_count(data);
    int failed = 0;
    float *values = allocate(data, sizeof(float) * (size_t)(kind == PLANE_COLOR ? 4 : 1), &failed);
    for (size_t i = 0; i < count && values && kind == PLANE_COVERAGE; ++i) {
        values[i] = (float)data->coverage[i] / 255.0F;
    }
    for (size_t i = 0; i < 4 * count && values && kind == PLANE_COLOR; ++i) {
        values[i] = data->color[i] * (i % 4 == 3 ? 1 : data->color[i | 3]);
    }
    return values;
}

/* The planes of a set of kinds in one file. */
static burnish_status encode_exr(const render_plane_data *data, unsigned kinds, picture_file *file,
                                 burnish_error *error) {
    picture_channels channels = {.width = data->width, .height = data->height};
    float *converted[PLANE_KINDS] = {NULL};
    burnish_status status = BURNISH_STATUS_OK;
    *file = (picture_file){0};
    for (int kind = 0; kind < PLANE_KINDS && status == BURNISH_STATUS_OK; ++kind) {
        const uint8_t *values = values_of(data, (render_plane_kind)kind);
        if (!(kinds & 1U << kind)) {
            continue;
        }
        if (kind == PLANE_COLOR || kind == PLANE_COVERAGE) {
            converted[kind] = convert(data, (render_plane_kind)kind);
            values = (const uint8_t *)converted[kind];
            status = values ? status : fail_memory(error);
        }
        for (int i = 0; i < rows[kind].channels; ++i) {
            channels.items[channels.count++] = (picture_channel){
                rows[kind].names[i], rows[kind].kind == PICTURE_INT ? PICTURE_INT : PICTURE_FLOAT,
                values + 4 * i, 4 * (size_t)rows[kind].channels};
        }
    }
    if (status == BURNISH_STATUS_OK) {
        status = picture_encode_exr(&channels, file, error);
    }
    for (int kind = 0; kind < PLANE_KINDS; ++kind) {
        free(converted[kind]);
    }
    return status;
}

burnish_status render_encode_plane(const render_plane_data *data, const render_plane *plane,
                                   int threads, picture_file *file, burnish_error *error) {
    *file = (picture_file){0};
    return plane->format == PICTURE_NPY   ? encode_npy(data, plane->kind, file, error)
           : plane->format == PICTURE_EXR ? encode_exr(data, 1U << plane->kind, file, error)
                                          : encode_png(data, plane->kind, threads, file, error);
}

burnish_status render_encode_planes(const render_plane_data *data, picture_format format,
                                    picture_file *file, burnish_error *error) {
    return format == PICTURE_NPY ? encode_npy(data, PLANE_COLOR, file, error)
                                 : encode_exr(data, (1U << PLANE_KINDS) - 1, file, error);
}
