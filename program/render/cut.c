/* `burnish render --clip`: cuts, and warnings about them. */
#include "render/cut.h"

#include "render/scene/origin.h"

/* Why a cut is not filled. */
static void warn_open(render_result *result, const burnish_mesh *mesh) {
    const burnish_mesh_facts *facts = burnish_mesh_get_facts(mesh);
    const char *input = result->settings->input.name;
    if (!facts) {
        render_warn(&result->warnings, 1, "%.300s: cut but not filled: %s have no volume", input,
                    burnish_mesh_get_info(mesh)->line_count > 0 ? "lines" : "points");
    } else if (!facts->is_closed) {
        render_warn(&result->warnings, 1,
                    "%.300s: cut but not filled: the mesh is not closed; %zu of its edges are open",
                    input, facts->open_edge_count);
    } else {
        render_warn(&result->warnings, 1,
                    "%.300s: cut but not filled: the mesh is not a solid; its winding is "
                    "inconsistent or it has no volume",
                    input);
    }
}

burnish_status render_cut(render_result *result, burnish_mesh *mesh, burnish_error *error) {
    const render_clip *clip = &result->settings->input.clip;
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    burnish_status status = BURNISH_STATUS_OK;
    for (int i = 0; i < clip->count && status == BURNISH_STATUS_OK; ++i) {
        const burnish_clip_plane *plane = &clip->items[i];
        const int before = view->cut_count;
        status = burnish_mesh_clip(mesh, plane, error);
        if (status == BURNISH_STATUS_ARGUMENT) { /* "clip: ..." is a flag in the program */
            const burnish_error reason = *error;
            cli_fail(error, status, "--%s", reason.text);
        }
        if (status == BURNISH_STATUS_OK && view->cut_count == before) {
            render_warn(&result->warnings, 1,
                        "%.300s: no part of the mesh is beyond the plane %g,%g,%g,%g",
                        result->settings->input.name, plane->normal[0], plane->normal[1],
                        plane->normal[2], render_file_offset(plane, view->origin));
        }
    }
    if (status == BURNISH_STATUS_OK && view->cut_count > 0 &&
        view->inside == BURNISH_INSIDE_UNKNOWN) {
        warn_open(result, mesh);
    }
    return status;
}
