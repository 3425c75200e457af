/* --play: frames at moments of the input's animation. The input is loaded and prepared for each, as
 * positions and normals change; the camera, the ground and the up axis are those of the first. */
#include "render/output/result.h"
#include "render/scene/library_options.h"
#include "render/scene/prepare.h"

/* The settings of a frame, as they were before those of the first were prepared. */
static render_settings settings_of(const render_result *result, int frame) {
    const burnish_mesh_info *info = burnish_mesh_get_info(result->mesh);
    render_settings settings = result->given;
    double axis[3];
    settings.input.load.animation_time.value =
        info->animation_seconds * frame / settings.output.frames;
    settings.camera.up = render_up_in_use(result->mesh, &result->settings->camera, axis);
    settings.shading.ground = result->options->ground ? 1 : -1;
    settings.picture.cull_back_faces = result->options->cull_back_faces ? 1 : -1;
    return settings;
}

/* Adds a mesh to a box in coordinates of another origin. */
static void add_bounds(float box[2][3], const burnish_mesh *mesh, const double origin[3]) {
    const burnish_mesh_view *view = burnish_mesh_get_view(mesh);
    float bounds[2][3];
    burnish_mesh_get_bounds(mesh, bounds[0], bounds[1]);
    for (int k = 0; k < 3; ++k) {
        const float low = (float)((double)bounds[0][k] + (view->origin[k] - origin[k]));
        const float high = (float)((double)bounds[1][k] + (view->origin[k] - origin[k]));
        box[0][k] = low < box[0][k] ? low : box[0][k];
        box[1][k] = high > box[1][k] ? high : box[1][k];
    }
}

static burnish_status make_box(const float box[2][3], burnish_mesh **mesh, burnish_error *error) {
    static const uint32_t sides[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                          {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                          {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    float corners[8][3];
    burnish_mesh_description description = burnish_mesh_description_default();
    burnish_load_options options = burnish_load_options_default();
    for (int i = 0; i < 24; ++i) {
        corners[i / 3][i % 3] = box[i / 3 >> i % 3 & 1][i % 3];
    }
    description.name = "animation";
    description.positions = (burnish_array){corners, 8, 0};
    description.indices = (burnish_array){sides, 36, 0};
    options.threads = 1;
    return burnish_mesh_create(&description, &options, mesh, error);
}

burnish_status render_play_camera(const render_result *result, render_view view, render_room *room,
                                  burnish_camera *camera, burnish_error *error) {
    const double *origin = burnish_mesh_get_view(result->mesh)->origin;
    render_settings same = *result->settings;
    burnish_mesh *all = NULL;
    float box[2][3];
    burnish_status status = BURNISH_STATUS_OK;
    if (!(burnish_mesh_get_info(result->mesh)->animation_seconds > 0)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--play: %.300s has no animation; omit the flag for a turn of the camera",
                        same.input.name);
    }
    burnish_mesh_get_bounds(result->mesh, box[0], box[1]);
    for (int frame = 1; frame < same.output.frames && status == BURNISH_STATUS_OK; ++frame) {
        render_settings settings = settings_of(result, frame);
        burnish_mesh *mesh = NULL;
        settings.input.load.no_textures = 1;
        status = render_load(&settings.input, settings.job.threads, &mesh, error);
        if (status == BURNISH_STATUS_OK) {
            add_bounds(box, mesh, origin);
        }
        burnish_mesh_destroy(mesh);
    }
    same.camera.up = settings_of(result, 0).camera.up;
    status = status == BURNISH_STATUS_OK ? make_box((const float(*)[3])box, &all, error) : status;
    if (status == BURNISH_STATUS_OK) {
        status = render_camera(all, &same, view, room, camera, error);
    }
    burnish_mesh_destroy(all);
    return status;
}

burnish_status render_draw_moment(render_result *result, render_cell *cell, int frame,
                                  burnish_error *error) {
    render_settings settings = settings_of(result, frame);
    burnish_render_options options;
    render_warnings unused = {.print = NULL}; /* those of the first frame are reported */
    render_result moment = *result;
    const double *origin = burnish_mesh_get_view(result->mesh)->origin;
    moment.mesh = NULL;
    moment.settings = &settings;
    moment.options = &options;
    burnish_status status = render_load(&settings.input, settings.job.threads, &moment.mesh, error);
    if (status == BURNISH_STATUS_OK) {
        render_scene scene = {&settings, moment.mesh,       &options, &result->environment,
                              &unused,   moment.color_range};
        status = render_prepare(&scene, error);
    }
    if (status == BURNISH_STATUS_OK) {
        const double *own = burnish_mesh_get_view(moment.mesh)->origin;
        for (int k = 0; k < 3; ++k) {
            cell->camera.position[k] += origin[k] - own[k];
            cell->camera.focal_point[k] += origin[k] - own[k];
        }
        status = render_draw_frame(&moment, cell, error);
        result->seconds = moment.seconds;
    }
    burnish_mesh_destroy(moment.mesh);
    render_drop_warnings(&unused, 0);
    return status;
}
