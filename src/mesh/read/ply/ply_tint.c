/* Colours of points that have none, from a quantity: intensities, and classes of LiDAR. */
#include <stdlib.h>

#include "mesh/read/common/cloud.h"
#include "mesh/read/ply/ply_rows.h"

/* The colours of classes 0 to 31 of LAS (ASPRS, "LAS Specification", table 17), in hexadecimal. */
static uint32_t color_of_class(double value) {
    static const uint32_t colors[32] = {0xB0B0B0, 0xC8C8C8, 0xA9784F, 0x9CCB6B, 0x5FAE45, 0x2F7D32,
                                        0xD0503C, 0xE040FB, 0x6B7280, 0x3C8DDC, 0x8D6E63, 0x5A5A66,
                                        0xC8C8C8, 0xE0C341, 0xE8A33D, 0x7A5CA8, 0xE8A33D, 0xB5838D,
                                        0xE040FB, 0xB5838D, 0x8D6E63, 0xF0F4F8, 0x4FB3BF};
    const uint32_t color = colors[(uint32_t)(value > 0 ? value < 256 ? value : 0 : 0) & 31];
    return color ? color : 0xC8C8C8;
}

/* The values of S between which nearly all are. */
static void find_range(const burnish_mesh_data *mesh, float range[2]) {
    enum { SAMPLES = 1024, FEW = 100 };
    const burnish_stream *stream = &mesh->streams[BURNISH_TEXCOORD];
    const size_t step = stream->count / SAMPLES + 1;
    float sample[SAMPLES];
    size_t count = 0;
    for (size_t i = 0; i < stream->count; i += step) {
        sample[count++] = ((const float *)stream->items)[2 * i];
    }
    qsort(sample, count, sizeof *sample, burnish_compare_floats);
    range[0] = sample[count / FEW];
    range[1] = sample[count - 1 - count / FEW];
}

burnish_status burnish_ply_tint_points(const burnish_ply_state *ply) {
    enum { DARKEST = 40 };
    burnish_mesh_data *mesh = ply->reader->mesh;
    const burnish_stream *stream = &mesh->streams[BURNISH_TEXCOORD];
    const size_t count = stream->count;
    float range[2];
    if (!ply->header.tint || ply->reader->input->options->scalar_property || count == 0 ||
        count != mesh->streams[BURNISH_POSITION].count) {
        return BURNISH_STATUS_OK;
    }
    find_range(mesh, range);
    if (ply->header.tint == BURNISH_PLY_GREY && !(range[1] > range[0])) {
        return BURNISH_STATUS_OK;
    }
    if (burnish_mesh_data_reserve(mesh, BURNISH_COLOR, count) != BURNISH_STATUS_OK) {
        return mesh->memory.status;
    }
    mesh->streams[BURNISH_COLOR].count = count;
    const int is_grey = ply->header.tint == BURNISH_PLY_GREY;
    const double scale = (255 - DARKEST) / ((double)range[1] - (double)range[0]);
    for (size_t i = 0; i < count; ++i) {
        const double value = (double)((const float *)stream->items)[2 * i];
        const double at = is_grey ? (value - (double)range[0]) * scale : 0;
        const uint32_t grey =
            DARKEST + (uint32_t)(at > 0 ? at < 255 - DARKEST ? at : 255 - DARKEST : 0);
        const uint32_t color = is_grey ? grey * 0x10101 : color_of_class(value);
        uint8_t *rgba = burnish_colors(mesh) + 4 * i;
        rgba[0] = (uint8_t)(color >> 16);
        rgba[1] = (uint8_t)(color >> 8);
        rgba[2] = (uint8_t)color;
        rgba[3] = 255;
    }
    return BURNISH_STATUS_OK;
}
