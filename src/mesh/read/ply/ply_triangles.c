/* PLY: colours, texture coordinates and textures of faces, as MeshLab writes them. */
#include "mesh/read/ply/ply_rows.h"

#include "mesh/read/common/textures.h"
#include "mesh/read/ply/ply_header.h"

/* ---- Values ---- */

/* The corners of an attribute of which each triangle appended `each` values. The attribute is
 * dropped if some triangles lack it. Returns 0 then. */
static int settle_corners(burnish_mesh_data *mesh, burnish_attribute attribute, size_t each) {
    burnish_stream *stream = &mesh->streams[attribute];
    if (stream->count == 0 || stream->count != each * mesh->triangle_count) {
        burnish_mesh_data_drop(mesh, attribute);
        return 0;
    }
    if (burnish_mesh_data_reserve_corners(mesh, attribute, mesh->triangle_count) ==
        BURNISH_STATUS_OK) {
        for (size_t i = 0; i < 3 * mesh->triangle_count; ++i) {
            stream->corners[i] = (uint32_t)(each == 3 ? i : i / 3);
        }
    }
    return 1;
}

burnish_status burnish_ply_settle_triangles(burnish_ply_state *ply) {
    burnish_mesh_data *mesh = ply->reader->mesh;
    ply->takes_face_colors = (ply->per_triangle >> BURNISH_COLOR & 1) &&
                             mesh->streams[BURNISH_COLOR].count > 0 &&
                             settle_corners(mesh, BURNISH_COLOR, 1);
    if (ply->takes_face_coordinates) {
        settle_corners(mesh, BURNISH_TEXCOORD, 3);
    }
    return mesh->memory.status;
}

/* ---- Textures ---- */

static void fill_run(burnish_ply_state *ply, size_t end) {
    uint16_t *materials = ply->reader->mesh->triangle_materials;
    for (size_t i = ply->run_start; i < end; ++i) {
        materials[i] = (uint16_t)ply->run_texture;
    }
    ply->run_start = end;
}

static burnish_status reserve_materials(burnish_mesh_data *mesh, size_t triangles) {
    mesh->triangle_materials =
        burnish_reserve(&mesh->memory, mesh->triangle_materials, &mesh->triangle_material_capacity,
                        triangles, sizeof *mesh->triangle_materials, "materials");
    return mesh->memory.status;
}

burnish_status burnish_ply_use_texture(burnish_ply_state *ply, size_t triangle, int texture) {
    burnish_status status = reserve_materials(ply->reader->mesh, triangle);
    if (status == BURNISH_STATUS_OK) {
        fill_run(ply, triangle);
        ply->run_texture = texture;
    }
    return status;
}

/* Numbers from `count` on become `count`; returns whether there are any. */
static int limit_numbers(burnish_mesh_data *mesh, size_t count) {
    int any = 0;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        uint16_t *number = &mesh->triangle_materials[i];
        any |= *number >= count;
        *number = *number < count ? *number : (uint16_t)count;
    }
    return any;
}

/* A texture's name, in which <this> is the input's name without folder and extension; 0 if it is
 * too long. */
static int write_name(const burnish_ply_state *ply, burnish_token file, char *name, size_t size) {
    static const char this[] = "<this>";
    const size_t length = sizeof this - 1;
    const char *input = ply->reader->input->name;
    const char *slash = strrchr(input, '/'), *base = slash ? slash + 1 : input;
    const char *dot = strrchr(base, '.');
    const size_t base_size = dot ? (size_t)(dot - base) : strlen(base);
    size_t used = 0;
    for (size_t i = 0; i < file.size;) {
        const int is_this = file.size - i >= length && memcmp(file.bytes + i, this, length) == 0;
        const size_t more = is_this ? base_size : 1;
        if (used + more >= size) {
            return 0;
        }
        memcpy(name + used, is_this ? (const void *)base : file.bytes + i, more);
        used += more;
        i += is_this ? length : 1;
    }
    name[used] = 0;
    return 1;
}

/* White, in the colours of a texture; without one, burnish's grey. */
static burnish_material make_material(int texture) {
    burnish_material material = burnish_material_default();
    if (texture > 0) {
        material.has_diffuse = 1;
        for (int k = 0; k < 3; ++k) {
            material.ambient[k] = material.diffuse[k] = 1;
        }
        material.textures[BURNISH_TEXTURE_COLOR].texture = texture;
    }
    return material;
}

static burnish_status add_material(burnish_mesh_data *mesh, int texture) {
    mesh->materials =
        burnish_reserve(&mesh->memory, mesh->materials, &mesh->material_capacity,
                        mesh->material_count + 1, sizeof *mesh->materials, "materials");
    if (mesh->memory.status == BURNISH_STATUS_OK) {
        mesh->materials[mesh->material_count++] = make_material(texture);
    }
    return mesh->memory.status;
}

/* Drops colours that are the same for all vertices and opaque: a placeholder of some programs,
 * which would darken textures. */
static void drop_one_color(burnish_mesh_data *mesh) {
    const uint8_t *rgba = burnish_colors(mesh);
    const size_t count = mesh->streams[BURNISH_COLOR].count;
    size_t same = 0;
    while (same < count && rgba[3] == 255 && memcmp(rgba + 4 * same, rgba, 4) == 0) {
        ++same;
    }
    if (same == count) {
        burnish_mesh_data_drop(mesh, BURNISH_COLOR);
    }
}

burnish_status burnish_ply_load_textures(burnish_ply_state *ply) {
    const burnish_ply_header *header = &ply->header;
    burnish_mesh_data *mesh = ply->reader->mesh;
    if (header->texture_count == 0 || ply->reader->input->options->ignore_textures) {
        return BURNISH_STATUS_OK;
    }
    if (mesh->streams[BURNISH_TEXCOORD].count == 0) {
        burnish_reader_warn(
            ply->reader, header->textures[0].bytes,
            "texture \"%s\" was skipped: vertices have no s and t, faces no texcoord",
            burnish_token_quote(header->textures[0]).text);
        return BURNISH_STATUS_OK;
    }
    const size_t count = ply->takes_textures ? header->texture_count : 1;
    int is_beyond = 0;
    if (ply->takes_textures && reserve_materials(mesh, mesh->triangle_count) == BURNISH_STATUS_OK) {
        fill_run(ply, mesh->triangle_count);
        is_beyond = limit_numbers(mesh, count);
    }
    for (size_t i = 0; i < count && mesh->memory.status == BURNISH_STATUS_OK; ++i) {
        const burnish_token file = header->textures[i];
        char name[1024];
        add_material(mesh, write_name(ply, file, name, sizeof name)
                               ? burnish_reader_load_texture(ply->reader, file.bytes, name, 1)
                               : 0);
    }
    if (mesh->texture_count > 0) {
        drop_one_color(mesh);
    }
    return is_beyond ? add_material(mesh, 0) : mesh->memory.status;
}
