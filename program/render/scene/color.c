/* Colours by values. */
#include "render/scene/color.h"

#include <string.h>

#include "render/scene/cameras.h"

static int is_word(const render_coloring *coloring, const char *word) {
    return coloring->by && strcmp(coloring->by, word) == 0;
}

int render_colors_by_property(const render_coloring *coloring) {
    return coloring->by && !is_word(coloring, "height") && !is_word(coloring, "normal") &&
           !render_colors_by_part(coloring);
}

int render_names_parts(const render_coloring *coloring) {
    return is_word(coloring, "part") || is_word(coloring, "feature");
}

int render_colors_by_part(const render_coloring *coloring) {
    return render_names_parts(coloring) || is_word(coloring, "filament") ||
           is_word(coloring, "tool");
}

burnish_status render_color(const render_settings *settings, burnish_mesh *mesh, double range[2],
                            burnish_error *error) {
    const render_coloring *wanted = &settings->input.coloring;
    burnish_coloring coloring = burnish_coloring_default();
    if (!wanted->by) {
        return BURNISH_STATUS_OK;
    }
    const burnish_format format = burnish_mesh_get_info(mesh)->format;
    if (render_colors_by_property(wanted) && format != BURNISH_FORMAT_PLY &&
        format != BURNISH_FORMAT_GLTF && format < BURNISH_FORMAT_PCD) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--color-by: \"%.60s\" is none of height, normal, part, feature, "
                        "filament and tool, and "
                        "only PLY, PCD, LAS, XYZ and glTF files have other properties",
                        wanted->by);
    }
    const burnish_annotate_options stance = render_make_annotations(mesh, settings);
    memcpy(coloring.up, stance.up, sizeof coloring.up);
    memcpy(coloring.range, wanted->range, sizeof coloring.range);
    coloring.map = (burnish_color_map)wanted->map;
    coloring.source = is_word(wanted, "height")       ? BURNISH_COLOR_BY_HEIGHT
                      : is_word(wanted, "normal")     ? BURNISH_COLOR_BY_NORMAL
                      : render_names_parts(wanted)    ? BURNISH_COLOR_BY_PART
                      : render_colors_by_part(wanted) ? BURNISH_COLOR_BY_FILAMENT
                                                      : BURNISH_COLOR_BY_PROPERTY;
    return burnish_mesh_color_by(mesh, &coloring, range, error);
}

int render_has_legend(const render_coloring *coloring) {
    return coloring->by && !coloring->no_legend && !is_word(coloring, "normal");
}

double render_legend_inset(const render_settings *settings) {
    return render_has_legend(&settings->input.coloring) ? RENDER_LEGEND_INSET : 0;
}
