/* Inputs in which everything is wholly transparent: their picture would be empty, which no file is
 * made for. Exporters that write transparency for opacity, or leave alpha at 0, cause most of them.
 * One transparent part among visible ones is left as it is. */
#include "mesh/read/reader.h"

static int is_invisible(const burnish_material *material) {
    const int is_kept = material->alpha_mode == BURNISH_ALPHA_MASK && !(material->alpha_cutoff > 0);
    return material->transparency >= 1 && !is_kept;
}

/* Whether one of a triangle's vertices has an alpha above 0, or no colour at all. */
static int has_visible_corner(const burnish_mesh_data *mesh, size_t triangle) {
    const uint32_t *corners = burnish_stream_corners(mesh, BURNISH_COLOR) + 3 * triangle;
    const uint8_t *rgba = burnish_colors(mesh);
    int any = 0;
    for (int k = 0; k < 3; ++k) {
        any |= corners[k] == BURNISH_NONE || rgba[4 * (size_t)corners[k] + 3] > 0;
    }
    return any;
}

static int is_anything_visible(const burnish_mesh_data *mesh) {
    const int has_colors = mesh->streams[BURNISH_COLOR].count > 0;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        const size_t number = mesh->triangle_materials ? mesh->triangle_materials[i] : 0;
        const burnish_material *material =
            number < mesh->material_count ? &mesh->materials[number] : NULL;
        if (!(material && is_invisible(material)) && (!has_colors || has_visible_corner(mesh, i))) {
            return 1;
        }
    }
    return mesh->triangle_count == 0;
}

void burnish_reader_show_transparent(burnish_reader *reader) {
    burnish_mesh_data *mesh = reader->mesh;
    if (is_anything_visible(mesh)) {
        return;
    }
    for (size_t i = 0; i < mesh->material_count; ++i) {
        burnish_material *material = &mesh->materials[i];
        material->transparency = is_invisible(material) ? 0 : material->transparency;
    }
    for (size_t i = 0; i < mesh->streams[BURNISH_COLOR].count; ++i) {
        burnish_colors(mesh)[4 * i + 3] = 255;
    }
    burnish_reader_warn(reader, NULL,
                        "everything is wholly transparent (alpha 0) and drawn opaque");
}
