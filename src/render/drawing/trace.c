/* A frame as a drawing: areas of one colour, hatched where they are cuts, then lines.
 *
 * What is seen of an area is found as lines are: by drawing. The scene is drawn again, several
 * pixels for each pixel of the picture, as depths and triangles alone; each pixel gets the area
 * that it shows, and the borders of areas are traced. So what is in front of a cut hides it, as in
 * the picture, and borders are right to a fraction of a pixel, below the lines along them. */
#include <string.h>

#include "base/error.h"
#include "base/numbers.h"
#include "burnish/drawing.h"
#include "burnish/render.h"
#include "core/float_mode.h"
#include "core/srgb.h"
#include "core/vec3.h"
#include "image/text/drawing.h"
#include "render/drawing/regions.h"
#include "render/frame/caps.h"
#include "render/frame/frame_view.h"
#include "render/frame/render_options.h"

enum {
    SCALE = 4,         /* pixels for a pixel, along each side */
    MAP_MAX = 1 << 26, /* pixels of the map: of larger pictures fewer for a pixel */
    BAND = 256,        /* rows that are drawn at a time */
    AREAS_MAX = 127
};

/* Of a distance: what a cap may be off the depth that is drawn of it. */
#define CAP_MARGIN 1e-4

/* What is of one colour. */
typedef struct area {
    float light[3]; /* linear, in [0, 1] */
    int style;      /* of a cut's hatching; -1: a surface */
} area;

typedef struct tracing {
    const burnish_mesh *mesh;
    const burnish_mesh_view *view;
    const burnish_render_options *options;
    burnish_memory *memory;
    area areas[AREAS_MAX];
    int count;
    burnish_region_map map; /* 1 + index into areas; 0: nothing to fill */
    int scale;
    float *depth; /* BAND rows of the map */
    uint32_t *triangles;

    /* rays: position + x right + y up, x and y in pixels of the map, and direction */
    burnish_vec3 eye, right, up, forward;
    int is_parallel;

    /* the triangle looked at last */
    uint32_t last;
    int is_inside, material, surface;
} tracing;

/* ---- Colours ---- */

static float clamped_value(float value) {
    return value > 0 ? value < 1 ? value : 1 : 0;
}

/* What ambient light makes of a material; surfaces of a drawing have no other. */
static void flat_light(const tracing *t, int material, float light[3]) {
    const burnish_material *m = burnish_mesh_get_material(t->mesh, (size_t)material);
    for (int k = 0; k < 3; ++k) {
        light[k] = clamped_value(m->is_unlit ? m->diffuse[k] + m->emissive[k]
                                             : m->ambient[k] * t->options->ambient_light[k] +
                                                   m->emissive[k]);
    }
}

static void store_color(const float light[3], float hatch, uint8_t color[3]) {
    for (int k = 0; k < 3; ++k) {
        color[k] = burnish_linear_to_srgb(light[k] * burnish_cap_light(hatch, k));
    }
}

/* 1 + the index of such an area, found or made; 0 where it needs no filling, or there are too
 * many: a surface of the background's colour, or a transparent one. */
static int find_area(tracing *t, int material, int style) {
    area wanted = {.style = style};
    uint8_t color[3];
    if (burnish_mesh_get_material(t->mesh, (size_t)material)->transparency > 0) {
        return 0;
    }
    flat_light(t, material, wanted.light);
    store_color(wanted.light, BURNISH_NO_CAP, color);
    if (style < 0 && memcmp(color, t->options->background, sizeof color) == 0) {
        return 0;
    }
    for (int i = 0; i < t->count; ++i) {
        if (t->areas[i].style == style &&
            memcmp(t->areas[i].light, wanted.light, sizeof wanted.light) == 0) {
            return i + 1;
        }
    }
    if (t->count == AREAS_MAX) {
        return 0;
    }
    t->areas[t->count] = wanted;
    return ++t->count;
}

/* Whether any pixel could need filling. */
static int has_areas(tracing *t) {
    const size_t materials = burnish_mesh_get_material_count(t->mesh);
    int found = t->view->cut_count > 0 && t->view->inside != BURNISH_INSIDE_UNKNOWN;
    for (size_t i = 0; i < materials && !found; ++i) {
        found = find_area(t, (int)i, -1) > 0;
    }
    return found;
}

/* ---- The map ---- */

static void aim_camera(tracing *t) {
    const burnish_camera *camera = &t->options->camera;
    const double height = t->map.height;
    t->eye = burnish_vec3_load(camera->position);
    t->forward =
        burnish_vec3_normalize(burnish_vec3_sub(burnish_vec3_load(camera->focal_point), t->eye));
    t->is_parallel = camera->orthographic_height > 0;
    double pixel = camera->orthographic_height / height;
    if (!t->is_parallel) {
        double sine, cosine;
        burnish_sincos(camera->view_angle * (BURNISH_DEGREE / 2), &sine, &cosine);
        pixel = 2 * sine / (cosine * height);
    }
    const burnish_vec3 right =
        burnish_vec3_normalize(burnish_vec3_cross(t->forward, burnish_vec3_load(camera->view_up)));
    t->up = burnish_vec3_scale(burnish_vec3_cross(right, t->forward), pixel);
    t->right = burnish_vec3_scale(right, pixel * t->options->pixel_aspect);
}

/* Whether the triangle is seen from inside the solid. */
static int shows_inside(const tracing *t, uint32_t triangle) {
    burnish_vec3 p[3];
    if (t->view->inside == BURNISH_INSIDE_UNKNOWN) {
        return 0;
    }
    const uint32_t *corners = t->view->indices + 3 * (size_t)triangle;
    for (int i = 0; i < 3; ++i) {
        p[i] = burnish_vec3_loadf(t->view->positions + 3 * (size_t)corners[i]);
    }
    const burnish_vec3 normal =
        burnish_vec3_cross(burnish_vec3_sub(p[1], p[0]), burnish_vec3_sub(p[2], p[0]));
    const burnish_vec3 toward =
        t->is_parallel ? burnish_vec3_scale(t->forward, -1) : burnish_vec3_sub(t->eye, p[0]);
    const double facing = burnish_vec3_dot(normal, toward);
    return t->view->inside == BURNISH_INSIDE_BACK ? facing < 0 : facing > 0;
}

/* The cut that is entered last along a pixel's ray, where what is seen is that cut; else -1. */
static int find_cut(const tracing *t, int x, int y, double depth) {
    const double *middle = t->options->principal_point;
    const burnish_vec3 aside =
        burnish_vec3_add(burnish_vec3_scale(t->right, x + 0.5 - 0.5 * t->map.width - middle[0]),
                         burnish_vec3_scale(t->up, 0.5 * t->map.height - (y + 0.5) - middle[1]));
    const burnish_vec3 from = t->is_parallel ? burnish_vec3_add(t->eye, aside) : t->eye;
    const burnish_vec3 ray = t->is_parallel ? t->forward : burnish_vec3_add(t->forward, aside);
    double last = 0;
    int found = -1;
    for (int i = 0; i < t->view->cut_count; ++i) {
        const burnish_vec3 normal = burnish_vec3_load(t->view->cuts[i].normal);
        const double speed = burnish_vec3_dot(normal, ray);
        const double at = (t->view->cuts[i].offset - burnish_vec3_dot(normal, from)) / speed;
        if (speed < 0 && (found < 0 || at > last)) {
            last = at;
            found = i;
        }
    }
    const double off = last > depth ? last - depth : depth - last;
    return off <= CAP_MARGIN * depth ? found : -1;
}

static int classify_pixel(tracing *t, int x, int y, uint32_t triangle, double depth) {
    if (triangle == BURNISH_TRIANGLE_NONE) {
        return 0;
    }
    if (triangle != t->last) {
        t->last = triangle;
        t->material = t->view->triangle_materials ? t->view->triangle_materials[triangle] : 0;
        t->is_inside = shows_inside(t, triangle);
        t->surface = find_area(t, t->material, -1);
    }
    const int cut = t->is_inside ? find_cut(t, x, y, depth) : -1;
    return cut < 0 ? t->surface
                   : find_area(t, t->material,
                               burnish_hatch_style(cut, burnish_hatch_regions(t->view), triangle));
}

static burnish_status draw_band(tracing *t, burnish_renderer *renderer, int first) {
    const size_t width = (size_t)t->map.width;
    burnish_render_options options = *t->options;
    burnish_target target = burnish_target_default();
    options.context = NULL;
    options.width = t->map.width;
    options.height = t->map.height;
    options.first_row = first;
    options.row_count = t->map.height - first < BAND ? t->map.height - first : BAND;
    options.samples = 1;
    options.edges = options.occlusion = options.ground = options.shadow = 0;
    options.counts = BURNISH_COUNTS_NONE;
    target.depth = t->depth;
    target.depth_stride = width * sizeof *t->depth;
    target.triangles = t->triangles;
    target.triangle_stride = width * sizeof *t->triangles;
    const burnish_status status =
        burnish_renderer_draw_into(renderer, t->mesh, &options, &target, NULL, t->memory->error);
    for (int row = 0; row < options.row_count && status == BURNISH_STATUS_OK; ++row) {
        const size_t start = (size_t)row * width;
        uint8_t *values = t->map.values + (size_t)(first + row) * width;
        for (size_t x = 0; x < width; ++x) {
            values[x] = (uint8_t)classify_pixel(t, (int)x, first + row, t->triangles[start + x],
                                                (double)t->depth[start + x]);
        }
    }
    return status;
}

/* Fills the map. A renderer of its own: the frame's keeps its lines. */
static burnish_status draw_map(tracing *t) {
    const burnish_render_options *options = t->options;
    const burnish_context *context = t->memory->context;
    const int side = options->width > options->height ? options->width : options->height;
    const size_t pixels = (size_t)options->width * (size_t)options->height;
    t->scale = SCALE;
    while (t->scale > 1 && (side * t->scale > BURNISH_IMAGE_MAX_SIZE ||
                            pixels * (size_t)(t->scale * t->scale) > MAP_MAX)) {
        --t->scale;
    }
    t->map.width = options->width * t->scale;
    t->map.height = options->height * t->scale;
    t->last = BURNISH_TRIANGLE_NONE;
    aim_camera(t);
    const size_t width = (size_t)t->map.width;
    t->map.values = burnish_allocate(t->memory, width, (size_t)t->map.height, "a map of areas");
    t->depth = burnish_allocate(t->memory, width * BAND, sizeof *t->depth, "depths of areas");
    t->triangles =
        burnish_allocate(t->memory, width * BAND, sizeof *t->triangles, "triangles of areas");
    burnish_renderer *renderer = NULL;
    burnish_status status = t->memory->status;
    if (status == BURNISH_STATUS_OK) {
        status = burnish_renderer_create(context, &renderer, t->memory->error);
    }
    for (int first = 0; first < t->map.height && status == BURNISH_STATUS_OK; first += BAND) {
        status = draw_band(t, renderer, first);
    }
    burnish_renderer_destroy(renderer);
    return status;
}

/* ---- The drawing ---- */

static void add_areas(const tracing *t, burnish_drawing *drawing, burnish_memory *memory) {
    burnish_borders borders = {.count = 0};
    uint8_t color[3];
    for (int i = 0; i < t->count && memory->status == BURNISH_STATUS_OK; ++i) {
        const area *a = &t->areas[i];
        burnish_borders_find(&borders, &t->map, (uint8_t)(i + 1), t->scale, memory);
        if (borders.count == 0 || memory->status != BURNISH_STATUS_OK) {
            continue;
        }
        store_color(a->light, a->style < 0 ? BURNISH_NO_CAP : 0, color);
        burnish_drawing_begin_area(drawing, color, 1);
        for (size_t k = 0; k < borders.count; ++k) {
            const size_t start = borders.starts[k];
            burnish_drawing_add_border(drawing, borders.points + 2 * start,
                                       borders.starts[k + 1] - start);
        }
        if (a->style >= 0) { /* through the middles of pixels, as the picture has them */
            const int way = a->style & 1;
            burnish_borders_hatch(&borders, way, burnish_hatch_period(a->style), way ? 0 : 1,
                                  memory);
            store_color(a->light, 1, color);
            burnish_drawing_hatch(drawing, color, BURNISH_HATCH_WIDTH, borders.hatch,
                                  borders.hatch_count);
        }
    }
    burnish_borders_release(&borders, memory->context);
}

static burnish_status trace_areas(const burnish_mesh *mesh, const burnish_render_options *options,
                                  burnish_drawing *drawing) {
    tracing t = {.mesh = mesh,
                 .view = burnish_mesh_get_view(mesh),
                 .options = options,
                 .memory = &drawing->memory};
    if (!has_areas(&t)) {
        return BURNISH_STATUS_OK;
    }
    const burnish_status status = draw_map(&t);
    if (status == BURNISH_STATUS_OK) {
        add_areas(&t, drawing, t.memory);
    }
    burnish_release(drawing->context, t.map.values);
    burnish_release(drawing->context, t.depth);
    burnish_release(drawing->context, t.triangles);
    return status == BURNISH_STATUS_OK ? drawing->memory.status : status;
}

static burnish_status check_trace(const burnish_renderer *renderer, const burnish_mesh *mesh,
                                  const burnish_render_options *options,
                                  const burnish_drawing *drawing, burnish_error *error) {
    if (!renderer || !mesh || !options || !drawing) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "drawing: the %s is NULL; create one first",
                            !renderer  ? "renderer"
                            : !mesh    ? "mesh"
                            : !options ? "options"
                                       : "drawing");
    }
    const burnish_lines *lines = burnish_renderer_get_lines(renderer);
    const int is_other = drawing->width != options->width || drawing->height != options->height ||
                         (lines->line_count > 0 &&
                          (lines->width != options->width || lines->height != options->height));
    if (is_other || options->row_count > 0) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "drawing: of all rows of the frame that was drawn last, %d x %d, one "
                            "of that size is expected",
                            options->width, options->height);
    }
    return burnish_render_options_check(options, error);
}

burnish_status burnish_renderer_trace(burnish_renderer *renderer, const burnish_mesh *mesh,
                                      const burnish_render_options *options,
                                      burnish_drawing *drawing, burnish_error *error) {
    burnish_status status = check_trace(renderer, mesh, options, drawing, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    const burnish_float_mode float_mode = burnish_float_mode_enter();
    const burnish_lines *lines = burnish_renderer_get_lines(renderer);
    burnish_drawing_use(drawing, error);
    status = trace_areas(mesh, options, drawing);
    if (status == BURNISH_STATUS_OK) {
        const float opacity = lines->line_count > 0 ? lines->opacity : options->edge_opacity;
        burnish_drawing_open(drawing, options->edge_color, opacity);
        burnish_drawing_lines(drawing, lines->starts, lines->points, lines->widths,
                              lines->line_count);
        burnish_drawing_close(drawing);
        status = drawing->memory.status;
    }
    burnish_float_mode_leave(float_mode);
    return status;
}
