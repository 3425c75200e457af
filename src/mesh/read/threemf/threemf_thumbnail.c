/* The picture that a package holds of itself, for packages without a mesh: sliced ones have only
 * G-code, and encrypted ones can't be read. It is drawn on a sheet that faces the viewer. */
#include "mesh/read/threemf/threemf.h"

#if BURNISH_HAS_3MF

#include <stdio.h>

#include "mesh/read/common/textures.h"

static const burnish_zip_part *find_picture(burnish_threemf *threemf) {
    const int plate = threemf->reader->input->options->plate;
    char name[40];
    snprintf(name, sizeof name, "Metadata/plate_%d.png", plate > 0 ? plate : 1);
    const burnish_zip_part *of_plate = burnish_zip_find(&threemf->zip, name);
    const burnish_zip_part *part = plate > 0 || !threemf->thumbnail ? of_plate : threemf->thumbnail;
    return part ? part : burnish_zip_find(&threemf->zip, "Metadata/thumbnail.png");
}

/* The sheet: in the plane of x and z, a unit per pixel. */
static void make_sheet(burnish_mesh_data *mesh, float width, float height) {
    static const float unit[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    static const uint32_t corners[6] = {0, 1, 2, 0, 2, 3};
    if (burnish_mesh_data_reserve(mesh, BURNISH_POSITION, 4) != BURNISH_STATUS_OK ||
        burnish_mesh_data_reserve(mesh, BURNISH_TEXCOORD, 4) != BURNISH_STATUS_OK ||
        burnish_mesh_data_reserve_corners(mesh, BURNISH_POSITION, 2) != BURNISH_STATUS_OK) {
        return;
    }
    for (int i = 0; i < 4; ++i) {
        float *to = burnish_positions(mesh) + 3 * i;
        to[0] = unit[i][0] * width;
        to[1] = 0;
        to[2] = unit[i][1] * height;
    }
    memcpy(mesh->streams[BURNISH_TEXCOORD].items, unit, sizeof unit);
    memcpy(mesh->streams[BURNISH_POSITION].corners, corners, sizeof corners);
    mesh->streams[BURNISH_POSITION].count = mesh->streams[BURNISH_TEXCOORD].count = 4;
    mesh->triangle_count = 2;
    mesh->is_thumbnail = 1;
}

static burnish_status load_picture(burnish_threemf *threemf, const burnish_zip_part *part,
                                   int *number) {
    burnish_reader *reader = threemf->reader;
    uint8_t *bytes = NULL;
    size_t size;
    burnish_status status = burnish_zip_read(&threemf->zip, part, &bytes, &size);
    if (status == BURNISH_STATUS_OK) {
        *number = burnish_reader_decode_texture(reader, NULL, "thumbnail", bytes, size, 1);
        status = threemf->memory->status;
    }
    burnish_release(threemf->memory->context, bytes);
    return status;
}

burnish_status burnish_threemf_draw_thumbnail(burnish_threemf *threemf, const char *why) {
    burnish_reader *reader = threemf->reader;
    burnish_mesh_data *mesh = reader->mesh;
    const burnish_zip_part *part = find_picture(threemf);
    int number = 0;
    if (!part) { /* the failure remains, if there is one */
        return threemf->status != BURNISH_STATUS_OK
                   ? threemf->status
                   : burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, NULL,
                                         "it holds no picture of itself; draw its model");
    }
    burnish_status status = reader->input->options->ignore_textures
                                ? BURNISH_STATUS_OK
                                : load_picture(threemf, part, &number);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    mesh->material_count = mesh->part_count = 0;
    mesh->materials = burnish_reserve(threemf->memory, mesh->materials, &mesh->material_capacity, 1,
                                      sizeof *mesh->materials, "materials");
    if (threemf->memory->status == BURNISH_STATUS_OK) {
        burnish_material material = burnish_material_default();
        material.is_unlit = material.has_diffuse = 1;
        material.diffuse[0] = material.diffuse[1] = material.diffuse[2] = 1;
        material.alpha_mode = BURNISH_ALPHA_BLEND;
        material.textures[BURNISH_TEXTURE_COLOR] = (burnish_texture_use){
            .texture = number, .wrap = {BURNISH_WRAP_CLAMP, BURNISH_WRAP_CLAMP}};
        mesh->materials[mesh->material_count++] = material;
        make_sheet(mesh, number ? (float)mesh->textures[number - 1].width : 1,
                   number ? (float)mesh->textures[number - 1].height : 1);
        burnish_reader_warn(reader, NULL, "%s; the picture that it holds is drawn, no geometry",
                            why);
    }
    return threemf->memory->status;
}

#endif
