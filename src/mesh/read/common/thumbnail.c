#include "mesh/read/common/thumbnail.h"

#include "mesh/read/common/textures.h"

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

burnish_status burnish_draw_thumbnail(burnish_reader *reader, const uint8_t *bytes, size_t size,
                                      const char *why) {
    burnish_mesh_data *mesh = reader->mesh;
    const int number =
        reader->input->options->ignore_textures
            ? 0
            : burnish_reader_decode_texture(reader, NULL, "thumbnail", bytes, size, 1);
    mesh->material_count = mesh->part_count = 0;
    mesh->materials = burnish_reserve(&mesh->memory, mesh->materials, &mesh->material_capacity, 1,
                                      sizeof *mesh->materials, "materials");
    if (mesh->memory.status == BURNISH_STATUS_OK) {
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
    return mesh->memory.status;
}
