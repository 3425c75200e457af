/* The two sides of a comparison: reading pictures, drawing meshes. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/cli/platform.h"
#include "cli/main.h"
#include "compare/sides.h"
#include "import/load_input.h"
#include "picture/read_png.h"
#include "render/output/result.h"
#include "render/scene/cameras.h"
#include "render/scene/library_options.h"
#include "render/scene/prepare.h"
#include "render/scene/up.h"
#include "render/useless.h"

/* ---- Reading ---- */

static int ends_in_png(const char *path) {
    const char *dot = strrchr(path, '.');
    return dot && (strcmp(dot, ".png") == 0 || strcmp(dot, ".PNG") == 0);
}

/* A file that begins like a PNG, or has the extension .png. */
static int is_picture(const char *path) {
    uint8_t head[8];
    FILE *file = path[0] == ':' ? NULL : fopen(path, "rb");
    const size_t size = file ? fread(head, 1, sizeof head, file) : 0;
    if (file) {
        fclose(file);
    }
    return picture_is_png(head, size) || (path[0] != ':' && ends_in_png(path));
}

/* origin: that of the other side's mesh; NULL: its own */
static burnish_load_options load_options(const compare_side *side, const double *origin) {
    burnish_load_options options =
        render_load_options(&side->settings.input, side->settings.job.threads);
    options.measure = 1;
    options.origin = origin;
    return options;
}

static burnish_status take_mesh(compare_side *side, burnish_status loaded) {
    side->result.mesh = side->owned;
    render_warn_of_mesh(&side->result.warnings, side->owned);
    return loaded;
}

/* Standard input is a PNG or a mesh, depending on its first bytes. */
static burnish_status read_standard(compare_side *side, const burnish_load_options *options,
                                    burnish_error *error) {
    uint8_t *bytes;
    size_t size;
    burnish_status status =
        cli_read_bytes("-", options->max_input_bytes, NULL, &bytes, &size, error);
    if (status == BURNISH_STATUS_OK && picture_is_png(bytes, size)) {
        status = picture_decode_png("standard input", bytes, size, &side->picture, error);
    } else if (status == BURNISH_STATUS_OK) {
        status =
            burnish_mesh_load_memory(bytes, size, "standard input", options, &side->owned, error);
        status = take_mesh(side, status);
    }
    free(bytes);
    return status;
}

static burnish_status read_side(compare_side *side, const double *origin, burnish_error *error) {
    const burnish_load_options options = load_options(side, origin);
    if (strcmp(side->input, "-") == 0 && !cli_foreign_extension((int)options.format)) {
        return read_standard(side, &options, error);
    }
    if (is_picture(side->input)) {
        return picture_read_png(side->input, options.max_input_bytes, &side->picture, error);
    }
    return take_mesh(side, import_load(side->input, &options, &side->owned, error));
}

/* Reads B again with an origin that puts the middle of its box where that of A's is. */
static burnish_status align(comparison *c, burnish_error *error) {
    const burnish_mesh *first = c->sides[0].owned;
    compare_side *side = &c->sides[1];
    float low[2][3], high[2][3];
    double origin[3];
    if (!first || !side->owned || strcmp(side->input, "-") == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--align: needs two meshes, B in a file; omit the flag");
    }
    burnish_mesh_get_bounds(first, low[0], high[0]);
    burnish_mesh_get_bounds(side->owned, low[1], high[1]);
    for (int k = 0; k < 3; ++k) {
        c->moved[k] =
            ((double)low[0][k] + (double)high[0][k] - (double)low[1][k] - (double)high[1][k]) / 2;
        origin[k] = burnish_mesh_get_view(first)->origin[k] - c->moved[k];
    }
    burnish_mesh_destroy(side->owned);
    side->owned = NULL;
    render_drop_warnings(&side->result.warnings, 0);
    side->result.warnings.print = NULL; /* they have been printed */
    const burnish_status status = read_side(side, origin, error);
    side->result.warnings.print = side->settings.job.quiet ? NULL : cli_warn;
    return status;
}

/* ---- Drawing ---- */

/* The size of drawn meshes: the size of the picture, if there is one, or of the flags. */
static burnish_status choose_size(comparison *c, burnish_error *error) {
    const int *given = c->settings->size;
    int size[2];
    memcpy(size, given[0] ? given : c->settings->render.picture.size, sizeof size);
    for (int i = 0; i < 2; ++i) {
        const burnish_image *picture = &c->sides[i].picture;
        if (!picture->pixels) {
            continue;
        }
        if (given[0] && (given[0] != picture->width || given[1] != picture->height)) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--resolution: %.200s has %d x %d pixels; leave the flag out",
                            c->sides[i].input, picture->width, picture->height);
        }
        size[0] = picture->width;
        size[1] = picture->height;
    }
    for (int i = 0; i < 2; ++i) {
        memcpy(c->sides[i].settings.picture.size, size, sizeof size); /* for framing */
        c->sides[i].options.width = size[0];
        c->sides[i].options.height = size[1];
    }
    return BURNISH_STATUS_OK;
}

/* All triangles of both meshes as one mesh, for framing; points become triangles with their
 * successors. Only positions matter; normals are copied because generating them takes time. */
static burnish_status join_meshes(const burnish_mesh *const meshes[2], burnish_mesh **joined,
                                  burnish_error *error) {
    const burnish_mesh_view *views[2] = {burnish_mesh_get_view(meshes[0]),
                                         burnish_mesh_get_view(meshes[1])};
    const size_t first = views[0]->vertex_count, vertices = first + views[1]->vertex_count;
    size_t corners = 0;
    for (int side = 0; side < 2; ++side) {
        const burnish_mesh_view *view = views[side];
        corners += 3 * (view->triangle_count > 0 ? view->triangle_count : view->vertex_count);
    }
    burnish_mesh_description all = burnish_mesh_description_default();
    burnish_load_options options = burnish_load_options_default();
    float *positions = calloc(vertices, 2 * 3 * sizeof *positions); /* and normals */
    uint32_t *indices = calloc(corners, sizeof *indices);
    burnish_status status = BURNISH_STATUS_OK;
    if (!positions || !indices) {
        status = cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for framing both meshes");
    }
    for (size_t side = 0, v = 0, k = 0; side < 2 && status == BURNISH_STATUS_OK; ++side) {
        const burnish_mesh_view *view = views[side];
        const uint32_t before = side == 0 ? 0 : (uint32_t)first;
        for (size_t i = 0; i < view->vertex_count; ++i, ++v) {
            memcpy(positions + 6 * v, view->positions + 3 * i, 3 * sizeof *positions);
            memcpy(positions + 6 * v + 3, view->normals + 3 * i, 3 * sizeof *positions);
        }
        for (size_t i = 0; i < 3 * view->triangle_count; ++i, ++k) {
            indices[k] = before + view->indices[i];
        }
        for (size_t i = 0; i < 3 * view->vertex_count && view->triangle_count == 0; ++i, ++k) {
            indices[k] = (uint32_t)((before + i / 3 + i % 3) % vertices);
        }
    }
    if (status == BURNISH_STATUS_OK) {
        const size_t stride = 6 * sizeof *positions;
        all.name = "both meshes";
        all.positions = (burnish_array){positions, vertices, stride};
        all.normals = (burnish_array){positions + 3, vertices, stride};
        all.indices = (burnish_array){indices, corners, 0};
        memcpy(all.up_axis, views[0]->up_axis, sizeof all.up_axis);
        status = burnish_mesh_create(&all, &options, joined, error);
    }
    free(positions);
    free(indices);
    return status;
}

static burnish_status aim_sides(comparison *c, burnish_error *error) {
    const burnish_mesh *meshes[2] = {c->sides[0].result.mesh, c->sides[1].result.mesh};
    const render_view view = c->settings->render.picture.views.count > 0
                                 ? c->settings->render.picture.views.items[0]
                                 : VIEW_FREE;
    burnish_camera camera;
    render_room room = {0};
    burnish_mesh *joined = NULL;
    burnish_status status = BURNISH_STATUS_OK;
    if (meshes[0] && meshes[1] && meshes[0] != meshes[1]) {
        status = join_meshes(meshes, &joined, error);
    }
    if (status == BURNISH_STATUS_OK) {
        const int drawn = meshes[0] ? 0 : 1;
        const burnish_mesh *framed = joined ? joined : meshes[drawn];
        render_settings settings = c->sides[drawn].settings;
        render_set_stance(framed, &settings.camera);
        status = render_camera(framed, &settings, view, &room, &camera, error);
    }
    for (int i = 0; i < 2 && status == BURNISH_STATUS_OK; ++i) {
        c->sides[i].cell.camera = camera;
    }
    burnish_mesh_destroy(joined);
    return status;
}

/* Draws the picture, and then the coverage of each pixel. */
static burnish_status draw_side(compare_side *side, burnish_renderer *renderer,
                                burnish_error *error) {
    burnish_render_options *options = &side->options;
    burnish_target target = burnish_target_default();
    const size_t pixels = (size_t)options->width * (size_t)options->height;
    side->result.renderer = renderer;
    burnish_status status = render_draw_cell(&side->result, &side->cell, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    side->coverage = malloc(pixels);
    if (!side->coverage) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for silhouettes");
    }
    target.coverage = side->coverage;
    target.coverage_stride = (size_t)options->width;
    options->counts = BURNISH_COUNTS_NONE;
    options->occlusion = 0;
    options->edges = 0; /* lines extend beyond the silhouette */
    return burnish_renderer_draw_into(renderer, side->result.mesh, options, &target, NULL, error);
}

static burnish_status draw_meshes(comparison *c, burnish_error *error) {
    burnish_renderer *renderer = NULL;
    burnish_status status = choose_size(c, error);
    if (status == BURNISH_STATUS_OK) {
        status = aim_sides(c, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_renderer_create(NULL, &renderer, error);
    }
    for (int i = 0; i < 2 && status == BURNISH_STATUS_OK; ++i) {
        compare_side *side = &c->sides[i];
        if (compare_is_mesh(side)) {
            status = draw_side(side, renderer, error);
        }
        if (!compare_is_mesh(&c->sides[1 - i]) && side->options.ground) {
            free(side->coverage); /* the picture's silhouette has its shadow, too */
            side->coverage = NULL;
        }
    }
    burnish_renderer_destroy(renderer);
    return status;
}

/* ---- Both ---- */

static void describe_side(comparison *c, int i) {
    compare_side *side = &c->sides[i];
    char lobe[32];
    side->settings = c->settings->render;
    side->settings.input.name = side->input;
    side->settings.shading.lobes.count = 1;
    side->settings.shading.lobes.items[0] =
        c->settings->render.shading.lobes.items[c->lobes ? i : 0];
    side->options = render_make_options(&side->settings);
    side->cell.lobe = side->settings.shading.lobes.items[0];
    side->result.settings = &side->settings;
    side->result.warnings.print = side->settings.job.quiet ? NULL : cli_warn;
    side->result.options = &side->options;
    side->result.cells = &side->cell;
    side->result.cell_count = 1;
    burnish_lobe_spec_name(&side->cell.lobe, lobe, sizeof lobe);
    snprintf(side->label, sizeof side->label, "%.120s%s%s", cli_base_name(side->input),
             c->lobes ? ", " : "", c->lobes ? lobe : "");
    cli_clean(side->label);
    snprintf(side->cell.label, sizeof side->cell.label, "%s", "the picture");
}

/* Both sides have the up axis of the first mesh, for the camera and ambient occlusion. */
static void choose_up(comparison *c) {
    const int first = compare_is_mesh(&c->sides[0]) ? 0 : 1;
    const burnish_mesh *mesh = c->sides[first].result.mesh;
    render_settings settings = c->sides[first].settings;
    double direction[3];
    if (!mesh) {
        return;
    }
    render_set_stance(mesh, &settings.camera);
    const render_up up = render_up_in_use(mesh, &settings.camera, direction);
    for (int i = 0; i < 2; ++i) {
        c->sides[i].settings.camera.up = (int)up;
    }
}

/* Flags of drawing, if both sides are pictures. */
static burnish_status warn_undrawn(const render_settings *settings, burnish_error *error) {
    static const char *const others[] = {"max-input-bytes", "quiet", "strict", "threads", "isa"};
    burnish_status status = BURNISH_STATUS_OK;
    const cli_flag *flag;
    for (size_t i = compare_command.flag_count;
         status == BURNISH_STATUS_OK && (flag = cli_flag_at(&compare_command, i)) != NULL; ++i) {
        cli_need need = {flag->name, 0, "pictures are not drawn; name a mesh, or omit the flag"};
        for (size_t k = 0; k < sizeof others / sizeof *others; ++k) {
            need.is_met |= strcmp(flag->name, others[k]) == 0;
        }
        status = cli_check_needs(&render_command, settings, &need, 1, settings->input.load.strict,
                                 settings->job.quiet, error);
    }
    return status;
}

/* Flags in vain. Of two meshes, one is enough for an effect. */
static burnish_status warn_useless(comparison *c, burnish_error *error) {
    const render_settings *settings = &c->settings->render;
    compare_side *first = &c->sides[compare_is_mesh(&c->sides[0]) ? 0 : 1];
    cli_need needs[RENDER_NEEDS_MAX], others[RENDER_NEEDS_MAX];
    if (!compare_is_mesh(first)) {
        return warn_undrawn(settings, error);
    }
    burnish_status status = render_warn_useless(&first->result, NULL, error);
    const size_t count = render_list_input_needs(settings, first->result.mesh, needs);
    if (compare_is_mesh(&c->sides[1])) {
        render_list_input_needs(settings, c->sides[1].result.mesh, others);
        for (size_t i = 0; i < count; ++i) {
            needs[i].is_met |= others[i].is_met;
        }
    }
    return status == BURNISH_STATUS_OK ? render_warn_needs(&first->result, needs, count, error)
                                       : status;
}

/* Prepares meshes, with one environment. Two lobes share a mesh, which is prepared once. Two meshes
 * have no ground unless it is requested; one has what its picture has. */
static burnish_status prepare_meshes(comparison *c, burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    const int are_meshes = compare_is_mesh(&c->sides[0]) && compare_is_mesh(&c->sides[1]);
    for (int i = 0; i < (c->lobes ? 1 : 2) && status == BURNISH_STATUS_OK; ++i) {
        compare_side *side = &c->sides[i];
        render_scene scene = {&side->settings, side->result.mesh,      &side->options,
                              &c->environment, &side->result.warnings, side->result.color_range};
        side->settings.shading.ground -= are_meshes && side->settings.shading.ground == 0;
        status = compare_is_mesh(side) ? render_prepare(&scene, error) : BURNISH_STATUS_OK;
    }
    if (c->lobes) {
        c->sides[1].settings.camera = c->sides[0].settings.camera;
        c->sides[1].options = c->sides[0].options;
    }
    return status;
}

burnish_status compare_draw_sides(comparison *c, burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    for (int i = 0; i < 2; ++i) {
        describe_side(c, i);
    }
    for (int i = 0; i < (c->lobes ? 1 : 2) && status == BURNISH_STATUS_OK; ++i) {
        const burnish_mesh *first = i > 0 ? c->sides[0].owned : NULL;
        status =
            read_side(&c->sides[i], first ? burnish_mesh_get_view(first)->origin : NULL, error);
    }
    if (status == BURNISH_STATUS_OK && c->settings->align) {
        status = align(c, error);
    }
    if (status == BURNISH_STATUS_OK && c->lobes) {
        if (!c->sides[0].result.mesh) {
            return cli_fail(
                error, BURNISH_STATUS_ARGUMENT,
                "compare: %.200s is a picture, which has no lobes; name another picture or a mesh",
                c->sides[0].input);
        }
        c->sides[1].result.mesh = c->sides[0].result.mesh;
    }
    if (status == BURNISH_STATUS_OK) {
        status = warn_useless(c, error);
    }
    choose_up(c);
    if (status == BURNISH_STATUS_OK) {
        status = prepare_meshes(c, error);
    }
    if (status == BURNISH_STATUS_OK &&
        (compare_is_mesh(&c->sides[0]) || compare_is_mesh(&c->sides[1]))) {
        status = draw_meshes(c, error);
    }
    return status;
}

void compare_release_sides(comparison *c) {
    render_release_environment(&c->environment);
    for (int i = 0; i < 2; ++i) {
        compare_side *side = &c->sides[i];
        burnish_image_destroy(&side->picture);
        burnish_image_destroy(&side->cell.image);
        free(side->coverage);
        render_drop_warnings(&side->result.warnings, 0);
        burnish_mesh_destroy(side->owned);
    }
}
