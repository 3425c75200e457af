#include "render/splats/splatting.h"

#include <stdatomic.h>
#include <string.h>

#include "burnish/lobe.h"
#include "core/srgb.h"

enum { BAND_ROWS = 16, PLANES = 6 /* of a band */, GRAIN = 1 << 12, LARGE_AREA = 256 };

/* Opacity that no 8 bits show. */
#define FAINTEST 0x1p-11f

/* Pixels from the image's corner, and of variance, beyond which floats would not place a splat. */
#define FARTHEST 0x1p17
#define WIDEST 1e30

#define DILATION 0.3

/* What is beyond so many half images is projected as what is there. */
#define SIDE 1.3

/* A pixel is covered if the splats change 8 bits. */
#define COVERED (0.5f / 255)

/* A splat's pixels take less time than a triangle's. */
#define OVERDRAW_SHARE 0.125

typedef struct painter {
    const burnish_splat_call *call;
    burnish_tasks *tasks;
    uint64_t *keys, *order; /* depths and numbers; sorted */
    size_t count;           /* of those that are not hidden */
    burnish_splat_item *items;
    float *bands; /* of the threads */
    size_t stride;
    _Atomic uint64_t area;
    atomic_size_t covered, edges[4]; /* edges: the least distances of covered pixels to them */
} painter;

static void transform(const painter *p, size_t number, double clip[4]) {
    const burnish_raster_view *view = p->call->view;
    for (int i = 0; i < 4; ++i) {
        clip[i] = (double)view->rows[i][3];
        for (size_t k = 0; k < 3; ++k) {
            const float at = p->call->mesh->positions[3 * number + k];
            clip[i] += (double)view->rows[i][k] * ((double)at - (double)view->origin[k]);
        }
    }
}

/* ---- Order ---- */

/* The distance of each splat from the near plane, above its number; hidden ones last. */
static void find_keys(void *user_data, size_t first, size_t end) {
    const painter *p = user_data;
    for (size_t i = first; i < end; ++i) {
        uint32_t bits = UINT32_MAX;
        double clip[4];
        transform(p, i, clip);
        const float depth = (float)(clip[3] - clip[2]);
        if (depth > 0 && p->call->mesh->splats[i].opacity >= FAINTEST) {
            memcpy(&bits, &depth, sizeof bits);
        }
        p->keys[i] = (uint64_t)bits << 32 | i;
    }
}

/* Sorts by depth, which keeps the order of equal ones; returns where the result is: in the first or
 * second `count` keys. */
static uint64_t *sort_keys(uint64_t *keys, size_t count) {
    enum { BITS = 11, BUCKETS = 1 << BITS };
    uint64_t *from = keys, *to = keys + count;
    for (unsigned shift = 32; shift < 64; shift += BITS) {
        uint32_t starts[BUCKETS + 1] = {0};
        for (size_t i = 0; i < count; ++i) {
            ++starts[(from[i] >> shift & (BUCKETS - 1)) + 1];
        }
        for (size_t b = 1; b < BUCKETS; ++b) {
            starts[b] += starts[b - 1];
        }
        for (size_t i = 0; i < count; ++i) {
            to[starts[from[i] >> shift & (BUCKETS - 1)]++] = from[i];
        }
        uint64_t *other = from;
        from = to;
        to = other;
    }
    return from;
}

/* ---- Projection ---- */

static double clamp(double x, double least, double most) {
    return x > least ? x < most ? x : most : least;
}

/* Adds to xx, xy and yy of a covariance what the axes of a splat are on the screen, where gradients
 * are those of x and y. */
static void add_axes(const burnish_splat *splat, double gradient[2][3], double covariance[3]) {
    for (int k = 0; k < 3; ++k) {
        double along[2];
        for (int i = 0; i < 2; ++i) {
            along[i] = gradient[i][0] * (double)splat->axes[k][0] +
                       gradient[i][1] * (double)splat->axes[k][1] +
                       gradient[i][2] * (double)splat->axes[k][2];
        }
        covariance[0] += along[0] * along[0];
        covariance[1] += along[0] * along[1];
        covariance[2] += along[1] * along[1];
    }
}

/* Returns the area of its pixels' bounds; 0 where it is not seen. */
static size_t project_splat(const painter *p, size_t number, burnish_splat_item *item) {
    const burnish_mesh_view *mesh = p->call->mesh;
    const uint8_t *other = mesh->colors; /* of values that colours show */
    const float(*rows)[4] = p->call->view->rows;
    const double size[2] = {p->call->view->width, p->call->view->height};
    double clip[4], at[2], gradient[2][3], covariance[3] = {DILATION, 0, DILATION}, bounds[2][2];
    transform(p, number, clip);
    for (int i = 0; i < 2; ++i) {
        const double sign = i == 0 ? 1 : -1; /* y grows down */
        at[i] = clip[i] / clip[3];
        const double side = clamp(at[i], -SIDE * size[i] / 2, SIDE * size[i] / 2);
        for (int k = 0; k < 3; ++k) {
            gradient[i][k] = sign * ((double)rows[i][k] - side * (double)rows[3][k]) / clip[3];
        }
        at[i] = size[i] / 2 + sign * at[i];
    }
    add_axes(&mesh->splats[number], gradient, covariance);
    const double xx = covariance[0], xy = covariance[1], yy = covariance[2];
    const double determinant = xx * yy - xy * xy;
    for (int i = 0; i < 2; ++i) { /* whole pixels, with some room for rounding */
        const double reach =
            1 + __builtin_sqrt(2 * (double)BURNISH_EXP_FALLOFF_END5 * covariance[2 * i]);
        bounds[i][0] = clamp(at[i] - reach, 0, size[i]);
        bounds[i][1] = clamp(at[i] + reach, 0, size[i]);
    }
    *item = (burnish_splat_item){.x = (float)at[0],
                                 .y = (float)at[1],
                                 .slope = (float)(xy / yy),
                                 .a = (float)(0.5 * yy / determinant),
                                 .b = (float)(0.5 / yy),
                                 .opacity = mesh->splats[number].opacity,
                                 .depth = p->call->depth_scale[0] * (float)clip[3] +
                                          p->call->depth_scale[1] * (float)(clip[3] - clip[2])};
    if (!(xx < WIDEST && yy < WIDEST && determinant > 0) ||
        at[0] != clamp(at[0], -FARTHEST, FARTHEST) || at[1] != clamp(at[1], -FARTHEST, FARTHEST) ||
        bounds[0][0] >= bounds[0][1]) {
        return 0;
    }
    for (size_t k = 0; k < 3; ++k) {
        item->color[k] = other ? (float)other[4 * number + k] / 255 : mesh->splats[number].color[k];
    }
    item->first_row = (uint16_t)bounds[1][0];
    item->end_row = (uint16_t)bounds[1][1];
    return (size_t)((bounds[0][1] - bounds[0][0]) * (bounds[1][1] - bounds[1][0]));
}

static void project_splats(void *user_data, size_t first, size_t end) {
    painter *p = user_data;
    uint64_t large = 0;
    for (size_t i = first; i < end; ++i) {
        const size_t area = project_splat(p, (uint32_t)p->order[i], p->items + i);
        large += area > LARGE_AREA ? area : 0;
    }
    atomic_fetch_add(&p->area, large);
}

/* ---- Pixels ---- */

static uint8_t to_byte(float value) {
    return (uint8_t)(value < 1 ? 255 * value + 0.5f : 255);
}

/* sRGB values in front of a background, which is linear in floats and else 8 bits. Without a
 * background colour is not weighted by opacity. */
static void store_pixel(const burnish_splat_call *call, const float light[3], float through,
                        uint8_t *pixel) {
    const burnish_pixel_format format = call->target->pixels.format;
    const int is_linear = format == BURNISH_PIXELS_RGBA_FLOAT;
    float linear[4] = {0}, held = 0; /* the pixel's alpha */
    memcpy(linear, pixel, is_linear ? sizeof linear : 0);
    if (call->transparent) {
        held = is_linear ? linear[3] : (float)pixel[3] / 255;
    }
    linear[3] = call->transparent ? 1 - through * (1 - held) : 1;
    for (int k = 0; k < 3; ++k) {
        uint8_t *to = pixel + (format == BURNISH_PIXELS_BGRA8 ? 2 - k : k);
        const float behind = (float)(is_linear ? burnish_linear_to_srgb(linear[k]) : *to) / 255;
        const float share = call->transparent ? through * held : through;
        const float value = (light[k] + share * behind) / linear[3];
        linear[k] = burnish_srgb_value_to_linear(value);
        *to = is_linear ? *to : to_byte(value);
    }
    if (is_linear) {
        memcpy(pixel, linear, sizeof linear);
    } else if (format != BURNISH_PIXELS_RGB8) {
        pixel[3] = to_byte(linear[3]);
    }
}

static void store_row(painter *p, const burnish_splat_band *band, int y) {
    const burnish_target *target = p->call->target;
    const burnish_pixel_format format = target->pixels.format;
    const burnish_target *surface = p->call->surface;
    const size_t row = (size_t)(y - band->first_row) * band->stride,
                 own = (size_t)(y - p->call->first_row);
    const size_t size = format == BURNISH_PIXELS_RGB8         ? 3
                        : format == BURNISH_PIXELS_RGBA_FLOAT ? 16
                                                              : 4;
    size_t count = 0, first = 0, last = 0;
    for (size_t x = 0; x < (size_t)band->width; ++x) {
        const size_t i = row + x;
        const float through = band->through[i];
        const float light[3] = {band->rgb[0][i], band->rgb[1][i], band->rgb[2][i]};
        if (through < 1 && target->pixels.pixels) {
            store_pixel(p->call, light, through,
                        target->pixels.pixels + own * target->pixels.stride + x * size);
        }
        if (through < 1 && target->coverage) {
            uint8_t *coverage = &target->coverage[own * target->coverage_stride + x];
            *coverage = to_byte(1 - through * (1 - (float)*coverage / 255));
        }
        if (1 - through >= COVERED ||
            (surface->depth && surface->coverage[own * surface->coverage_stride + x] > 0)) {
            first = count++ == 0 ? x : first;
            last = x;
        }
    }
    if (count > 0) {
        atomic_fetch_add(&p->covered, count);
        burnish_lower_to(&p->edges[0], first);
        burnish_lower_to(&p->edges[1], (size_t)y);
        burnish_lower_to(&p->edges[2], (size_t)band->width - 1 - last);
        burnish_lower_to(&p->edges[3], (size_t)(p->call->view->height - 1 - y));
    }
}

static void draw_band(void *user_data, size_t index, int thread) {
    painter *p = user_data;
    const int first = p->call->first_row + (int)index * BAND_ROWS, last = first + BAND_ROWS;
    const size_t plane = p->stride * BAND_ROWS;
    float *floats = p->bands + (size_t)thread * PLANES * plane;
    const burnish_target *surface = p->call->surface;
    const burnish_splat_band band = {p->call->view->width,
                                     first,
                                     last < p->call->end_row ? last : p->call->end_row,
                                     p->stride,
                                     floats,
                                     {floats + plane, floats + 2 * plane, floats + 3 * plane},
                                     surface->depth ? floats + 4 * plane : NULL,
                                     floats + 5 * plane};
    for (size_t i = 0; i < plane; ++i) {
        band.through[i] = 1;
    }
    memset(band.rgb[0], 0, (PLANES - 1) * plane * sizeof *floats);
    for (int y = first; y < band.end_row && band.surface; ++y) {
        const size_t to = (size_t)(y - first) * p->stride, own = (size_t)(y - p->call->first_row);
        for (size_t x = 0; x < (size_t)band.width; ++x) {
            band.surface[to + x] = surface->depth[own * (size_t)band.width + x];
            band.open[to + x] =
                (float)(255 - surface->coverage[own * surface->coverage_stride + x]) / 255;
        }
    }
    for (size_t i = 0; i < p->count && !burnish_tasks_should_end(p->tasks, thread); i += GRAIN) {
        p->call->ops->blend_splats(p->items + i, p->count - i < GRAIN ? p->count - i : GRAIN,
                                   &band);
    }
    for (int y = first; y < band.end_row; ++y) {
        store_row(p, &band, y);
    }
}

static burnish_status paint(painter *p, burnish_render_report *report, burnish_error *error) {
    const burnish_raster_view *view = p->call->view;
    const double limit = p->call->max_overdraw;
    const int ends[4] = {0, 0, view->width, view->height};
    report->overdraw +=
        OVERDRAW_SHARE * (double)atomic_load(&p->area) / ((double)view->width * view->height);
    if (report->overdraw > limit) {
        return burnish_fail(
            error, BURNISH_STATUS_LIMIT,
            "with splats it takes as long as triangles that cover the picture %.0f times; "
            "the limit is %.0f: raise --max-overdraw, or move the camera away",
            report->overdraw, limit);
    }
    for (int i = 0; i < 4; ++i) {
        atomic_init(&p->edges[i], SIZE_MAX);
    }
    burnish_tasks_run(p->tasks,
                      (size_t)(p->call->end_row - p->call->first_row + BAND_ROWS - 1) / BAND_ROWS,
                      1, 0, draw_band, p);
    const size_t covered = atomic_load(&p->covered);
    for (int i = 0; i < 4 && covered > 0; ++i) {
        const int distance = (int)atomic_load(&p->edges[i]), bound = report->bounds[i];
        const int at = i < 2 ? distance : ends[i] - distance;
        const int is_beyond = report->covered_pixels == 0 || (i < 2 ? at < bound : at > bound);
        report->bounds[i] = is_beyond ? at : bound;
    }
    if (covered > report->covered_pixels) { /* else transparent triangles cover more */
        report->covered_pixels = covered;
    }
    return burnish_tasks_check(p->tasks, error);
}

burnish_status burnish_splats_draw(const burnish_splat_call *call, burnish_render_report *report,
                                   burnish_tasks *tasks, burnish_memory *memory) {
    const size_t all = call->mesh->vertex_count, threads = (size_t)burnish_tasks_threads(tasks);
    painter p = {.call = call,
                 .tasks = tasks,
                 .count = all,
                 .stride = ((size_t)call->view->width + 15) / 16 * 16};
    burnish_status status = BURNISH_STATUS_OK;
    p.keys = burnish_allocate(memory, all, 2 * sizeof *p.keys, "splats");
    p.items = burnish_allocate(memory, all, sizeof *p.items, "splats");
    p.bands = burnish_allocate(memory, PLANES * BAND_ROWS * threads, p.stride * sizeof *p.bands,
                               "rows of splats");
    if (memory->status == BURNISH_STATUS_OK) {
        burnish_tasks_ranges(tasks, all, GRAIN, find_keys, &p);
        status = burnish_tasks_check(tasks, memory->error);
    }
    if (memory->status == BURNISH_STATUS_OK && status == BURNISH_STATUS_OK) {
        p.order = sort_keys(p.keys, all);
        while (p.count > 0 && p.order[p.count - 1] >> 32 == UINT32_MAX) {
            --p.count;
        }
        burnish_tasks_ranges(tasks, p.count, GRAIN, project_splats, &p);
        status = burnish_tasks_check(tasks, memory->error);
    }
    if (memory->status == BURNISH_STATUS_OK && status == BURNISH_STATUS_OK) {
        status = paint(&p, report, memory->error);
    }
    burnish_release(memory->context, p.keys);
    burnish_release(memory->context, p.items);
    burnish_release(memory->context, p.bands);
    return memory->status == BURNISH_STATUS_OK ? status : memory->status;
}
