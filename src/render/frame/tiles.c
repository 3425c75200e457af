#include "render/frame/steps.h"

#include "render/frame/target.h"

#include <stdatomic.h>
#include <string.h>

#include "base/memory.h"
#include "raster/raster_ops.h"
#include "render/texture/texture.h"

/* What one thread needs to draw tiles, and what it counted. */
struct burnish_tile_worker {
    burnish_tile tile;
    burnish_face_coder coder; /* where the tile has codes */
    burnish_fragments fragments;
    float light[3][BURNISH_SHADE_BATCH]; /* of fragments */
    burnish_row_light row;
    burnish_tile_sums sums;
    burnish_layer_light *layers; /* NULL where nothing is transparent */
    burnish_carver *carver;      /* NULL where nothing is carved */
    int is_carved_too_much;
    size_t covered_pixels;
    int bounds[4];
    burnish_fragment_scratch scratch;
};

/* A sample that passes less light than this needs no deeper layers. */
#define UNSEEN 0x1p-12f

/* ---- A tile ---- */

/* Visibility: which triangle every sample shows, and the layers in front of it. Returns 0 where
 * none comes near the tile. */
static int rasterize_tile(const burnish_frame *frame, const burnish_bins *bins,
                          burnish_tile_worker *worker, int column, int row) {
    const burnish_transparency *transparency = frame->surface.transparency;
    const burnish_carving *carving = frame->carving;
    burnish_tile *tile = &worker->tile;
    tile->transparent = transparency ? transparency->masks : NULL;
    if (carving) {
        tile->transparent = transparency ? carving->layered : carving->masks;
    }
    const int is_covered = burnish_tile_draw(tile, frame->ops, frame->surface.view, frame->geometry,
                                             bins, column, row);
    if (carving && tile->layers->has_some) {
        tile->transparent = carving->masks;
        const burnish_carve_scene scene = {carving, frame->ops, frame->surface.view,
                                           frame->geometry};
        worker->is_carved_too_much |= !burnish_carve_tile(worker->carver, tile, &scene, bins);
        tile->layers->has_some = 0;
        if (transparency) {
            tile->transparent = transparency->masks;
            frame->ops->draw_deeper_layers(tile, frame->geometry, bins, column, row);
        }
    }
    return is_covered;
}

/* The sums of pixels that several triangles share. */
static void shade_complex_pixels(const burnish_frame *frame, burnish_tile_worker *worker) {
    burnish_fragments *fragments = &worker->fragments;
    float *const light[3] = {worker->light[0], worker->light[1], worker->light[2]};
    const float *const shaded[3] = {light[0], light[1], light[2]};
    float *const *wanted = frame->output.target.pixels.pixels ? light : NULL;
    int next_block = 0;
    memset(worker->sums.light, 0, sizeof worker->sums.light);
    memset(worker->sums.covered, 0, sizeof worker->sums.covered);
    while (frame->ops->next_fragments(&worker->tile, frame->surface.view, &next_block, fragments)) {
        const burnish_fragment_batch batch = burnish_shade_fragments(
            &frame->surface, &worker->tile, fragments, &worker->scratch, wanted);
        burnish_output_add_fragments(&frame->output, &worker->tile, fragments, &batch, shaded,
                                     &worker->sums);
    }
}

/* The light of the layers that the tile holds. */
static void shade_pass(const burnish_frame *frame, const burnish_surface *surface,
                       burnish_tile_worker *worker) {
    const burnish_tile *tile = &worker->tile;
    burnish_fragments *fragments = &worker->fragments;
    float *const light[3] = {worker->light[0], worker->light[1], worker->light[2]};
    const float *const shaded[3] = {light[0], light[1], light[2]};
    const int wanted = frame->output.target.pixels.pixels != NULL;
    const burnish_texturing *texturing = surface->shading->texturing;
    burnish_texture_scratch *textures = worker->scratch.texture;
    const int has_alpha = wanted && texturing && texturing->has_alpha;
    const int has_covers = has_alpha && texturing->smooth_samples;
    const burnish_layer_values values = {wanted ? shaded : NULL,
                                         has_alpha ? textures->alpha : NULL,
                                         has_covers ? textures->covers : NULL,
                                         worker->layers->channel ? textures->through : NULL,
                                         frame->output.samples,
                                         frame->output.limit};
    burnish_layer_cursor cursor = {0};
    while (burnish_layers_next(tile, surface->view, frame->geometry, &cursor, fragments)) {
        if (values.passed) {
            memset(textures->through, 0, sizeof textures->through);
        }
        burnish_shade_fragments(surface, tile, fragments, &worker->scratch, wanted ? light : NULL);
        burnish_layer_light_add(worker->layers, surface, fragments, &values);
        for (int i = 0; i < fragments->count && frame->drawn; ++i) {
            __atomic_store_n(&frame->drawn[fragments->primitives[i].id_and_facing >> 1], 1,
                             __ATOMIC_RELAXED);
        }
    }
}

/* The light of the tile's layers, to which the sums then refer: the nearest ones, then those
 * behind. */
static void shade_layers(const burnish_frame *frame, const burnish_bins *bins,
                         burnish_tile_worker *worker, int column, int row) {
    burnish_surface surface = frame->surface;
    burnish_tile *tile = &worker->tile;
    worker->sums.layers = NULL;
    surface.is_layers = 1;
    surface.caps = NULL; /* one looks into a transparent solid anyway */
    if (!surface.transparency || !tile->layers->has_some) {
        return;
    }
    worker->sums.layers = worker->layers;
    const burnish_texturing *texturing = surface.shading->texturing;
    const int wanted = frame->output.target.pixels.pixels != NULL;
    burnish_layer_light_clear(worker->layers, frame->output.samples,
                              wanted && texturing && texturing->has_passing);
    if (worker->scratch.rays) {
        memset(worker->scratch.rays->refracted, 0, sizeof worker->scratch.rays->refracted);
    }
    shade_pass(frame, &surface, worker);
    while (burnish_layers_deeper(tile, worker->layers->through, worker->layers->channel, UNSEEN,
                                 frame->layer_passes)) {
        frame->ops->draw_deeper_layers(tile, frame->geometry, bins, column, row);
        shade_pass(frame, &surface, worker);
    }
}

/* The bits of a block row's pixel row y: its columns that show something. */
static uint64_t row_bits(const burnish_tile_worker *worker, int y) {
    const uint64_t all = ~0ull >> (BURNISH_TILE_SIZE - worker->tile.width);
    uint64_t bits = 0;
    for (int x = 0; x < BURNISH_TILE_BLOCKS; ++x) {
        bits |= (uint64_t)(worker->row.pixels.covered[x] >> 4 * y & 15) << 4 * x;
    }
    return bits & all;
}

/* Counts the pixels of a block row that show something, and their bounds. */
static void count_block_row(const burnish_output *output, burnish_tile_worker *worker, int number) {
    const burnish_tile *tile = &worker->tile;
    const burnish_row_range rows = burnish_output_rows(output, tile, number);
    int *bounds = worker->bounds;
    for (int y = rows.first; y < rows.end; ++y) {
        const uint64_t bits = row_bits(worker, y);
        const int row = tile->y + number * BURNISH_BLOCK_SIZE + y;
        if (!bits) {
            continue;
        }
        const int first = tile->x + __builtin_ctzll(bits);
        const int end = tile->x + BURNISH_TILE_SIZE - __builtin_clzll(bits);
        if (worker->covered_pixels == 0) {
            bounds[0] = first;
            bounds[1] = row;
        }
        worker->covered_pixels += (size_t)__builtin_popcountll(bits);
        bounds[0] = first < bounds[0] ? first : bounds[0];
        bounds[1] = row < bounds[1] ? row : bounds[1];
        bounds[2] = end > bounds[2] ? end : bounds[2];
        bounds[3] = row + 1 > bounds[3] ? row + 1 : bounds[3];
    }
}

/* A row of blocks whose codes come straight from normals. */
static void draw_coded_row(const burnish_frame *frame, burnish_tile_worker *worker, int number) {
    const burnish_tile *tile = &worker->tile;
    uint32_t codes[BURNISH_BLOCK_ROW_PIXELS];
    if (frame->counts_pixels || frame->surface.triangle_materials) {
        frame->ops->classify_block_row(tile, number, &worker->row.pixels);
    }
    burnish_codes_shade_row(&frame->surface, &frame->output, tile, number, &worker->scratch,
                            &worker->row, codes);
    burnish_output_store_codes(&frame->output, tile, number, codes);
    if (frame->counts_pixels) {
        count_block_row(&frame->output, worker, number);
    }
}

/* One row of blocks from visibility to the target, while its colours are in L1. */
static void draw_block_row(const burnish_frame *frame, burnish_tile_worker *worker, int number) {
    const burnish_tile *tile = &worker->tile;
    burnish_row_light *row = &worker->row;
    frame->ops->classify_block_row(tile, number, &row->pixels);
    if (frame->surface.caps) {
        burnish_cap_block_row(&frame->surface, tile, number, row);
    }
    if (frame->output.target.pixels.pixels) {
        burnish_shade_block_row(&frame->surface, tile, number, &worker->scratch, row);
    }
    burnish_output_store_row(&frame->output, tile, &worker->sums, number, row);
    for (int x = 0; worker->sums.layers && x < BURNISH_TILE_BLOCKS; ++x) {
        row->pixels.covered[x] |= worker->sums.layers->covered[number * BURNISH_TILE_BLOCKS + x];
    }
    if (frame->counts_pixels) {
        count_block_row(&frame->output, worker, number);
    }
}

/* The rows of blocks of a tile that hold some of the rows drawn. A tile that is partly in them is
 * rasterised completely, because it can affect which pixels share a look-up of the sky; only its
 * drawn rows are shaded. */
static burnish_row_range keep_drawn_rows(const burnish_output *output, burnish_tile *tile) {
    const int top = output->rows.first - tile->y, bottom = output->rows.end - tile->y;
    const int height = bottom < tile->height ? bottom : tile->height;
    const burnish_row_range drawn = {top > 0 ? top / BURNISH_BLOCK_SIZE : 0,
                                     (height + BURNISH_BLOCK_SIZE - 1) / BURNISH_BLOCK_SIZE};
    for (int number = 0; number < BURNISH_TILE_BLOCKS; ++number) {
        if (number < drawn.first || number >= drawn.end) {
            tile->buffer.dirty_blocks[number] = 0;
        }
    }
    return drawn;
}

/* Rows of blocks whose part of the target is fetched before they are drawn. The image is larger
 * than the second-level cache, and stores would wait for it. */
enum { ROWS_AHEAD = 4 };

static void prefetch_row(const burnish_frame *frame, int column, int row, int number) {
    burnish_output_prefetch(&frame->output, column * BURNISH_TILE_SIZE,
                            row * BURNISH_TILE_SIZE + number * BURNISH_BLOCK_SIZE);
}

static void draw_tile(const burnish_frame *frame, const burnish_bins *bins,
                      burnish_tile_worker *worker, int column, int row) {
    burnish_tile *tile = &worker->tile;
    for (int number = 0; number < ROWS_AHEAD; ++number) {
        prefetch_row(frame, column, row, number);
    }
    const int is_covered = rasterize_tile(frame, bins, worker, column, row);
    if (is_covered && frame->output.target.pixels.pixels) {
        burnish_surface_begin_tile(&frame->surface, tile, &worker->scratch);
        if (frame->surface.shading->ray_light) {
            burnish_surface_cast_rays(&frame->surface, frame->ops, tile, &worker->fragments,
                                      &worker->scratch, &worker->row);
        }
    }
    shade_layers(frame, bins, worker, column, row);
    const burnish_row_range drawn = keep_drawn_rows(&frame->output, tile);
    const int is_direct = burnish_codes_are_direct(&frame->surface, &frame->output);
    if (frame->output.has_planes) {
        burnish_planes_clear(&frame->output, tile, &worker->sums);
    }
    if (is_covered && frame->output.samples > 1) {
        shade_complex_pixels(frame, worker);
    }
    for (int number = drawn.first; number < drawn.end; ++number) {
        if (number + ROWS_AHEAD < drawn.end) {
            prefetch_row(frame, column, row, number + ROWS_AHEAD);
        }
        if (is_covered && tile->buffer.dirty_blocks[number]) {
            (is_direct ? draw_coded_row : draw_block_row)(frame, worker, number);
        } else {
            burnish_output_store_background(&frame->output, tile, number);
        }
    }
    if (is_covered && frame->drawn) {
        frame->ops->mark_drawn(tile, frame->drawn);
    }
}

/* Planes show the nearest triangle whether it is transparent or not, so where there is transparency,
 * or opaque triangles have planes of their own, they are drawn for themselves, as if there were none. */
static void draw_tile_twice(const burnish_frame *frame, const burnish_bins *bins,
                            burnish_tile_worker *worker, int column, int row) {
    burnish_frame part = *frame;
    if (frame->output.has_planes) {
        part.surface.transparency = NULL;
        part.output.target.pixels.pixels = NULL;
        part.output.outline = NULL;
        part.counts_pixels = 0;
        part.drawn = NULL;
        draw_tile(&part, bins, worker, column, row);
        part = *frame;
    }
    part.output.has_planes = frame->output.surface.depth != NULL;
    part.output.target = frame->output.surface;
    part.output.target.pixels = frame->output.target.pixels;
    draw_tile(&part, bins, worker, column, row);
}

/* ---- Tiles ---- */

/* What the tasks of a frame share. */
typedef struct frame_context {
    const burnish_frame *frame;
    const burnish_bins *bins;
    burnish_tile_worker *workers;
    size_t tile_count;
    atomic_size_t tiles_done;
} frame_context;

/* The rows of tiles that are drawn. */
static burnish_row_range tile_rows(const burnish_frame *frame) {
    const burnish_row_range rows = frame->output.rows;
    return (burnish_row_range){rows.first / BURNISH_TILE_SIZE,
                               (rows.end + BURNISH_TILE_SIZE - 1) / BURNISH_TILE_SIZE};
}

static size_t tile_count(const burnish_frame *frame) {
    const int columns = (frame->surface.view->width + BURNISH_TILE_SIZE - 1) / BURNISH_TILE_SIZE;
    const burnish_row_range rows = tile_rows(frame);
    return (size_t)columns * (size_t)(rows.end - rows.first);
}

/* Only the calling thread reports progress. */
static void report_progress(frame_context *context, int thread) {
    const size_t done =
        1 + atomic_fetch_add_explicit(&context->tiles_done, 1, memory_order_relaxed);
    if (thread == 0) {
        burnish_tasks_progress(context->frame->tasks, BURNISH_STAGE_DRAW,
                               (double)done / (double)context->tile_count);
    }
}

static void draw_tile_task(void *from, int column, int row, int thread) {
    frame_context *context = from;
    const burnish_frame *frame = context->frame;
    (frame->surface.transparency || frame->output.surface.depth ? draw_tile_twice : draw_tile)(
        frame, context->bins, &context->workers[thread], column, row);
    report_progress(context, thread);
}

static burnish_status draw_tiles(const burnish_frame *frame, burnish_tiles *tiles,
                                 burnish_error *error) {
    const burnish_row_range rows = tile_rows(frame);
    frame_context context = {frame, &tiles->bins, tiles->workers, tile_count(frame), 0};
    const burnish_bands bands = {&tiles->bins,        frame->ops,   frame->geometry,
                                 frame->surface.view, frame->tasks, tiles->worker_count,
                                 frame->context};
    return burnish_bands_draw_rows(&bands, rows.first, rows.end, draw_tile_task, &context, error);
}

/* Counts are sums and bounds extremes: their order does not matter. */
static void merge_counts(const burnish_tiles *tiles, burnish_render_report *report) {
    for (int i = 0; i < tiles->worker_count; ++i) {
        const burnish_tile_layers *layers = tiles->workers[i].tile.layers;
        const int *from = tiles->workers[i].bounds;
        int *to = report->bounds;
        report->layers_dropped += layers ? layers->dropped : 0;
        if (tiles->workers[i].covered_pixels == 0) {
            continue;
        }
        if (report->covered_pixels == 0) {
            memcpy(to, from, sizeof report->bounds);
        }
        to[0] = from[0] < to[0] ? from[0] : to[0];
        to[1] = from[1] < to[1] ? from[1] : to[1];
        to[2] = from[2] > to[2] ? from[2] : to[2];
        to[3] = from[3] > to[3] ? from[3] : to[3];
        report->covered_pixels += tiles->workers[i].covered_pixels;
    }
}

/* ---- Workers ---- */

static void destroy_workers(burnish_tiles *tiles, const burnish_context *context) {
    for (int i = 0; i < tiles->worker_count; ++i) {
        burnish_tile_destroy(&tiles->workers[i].tile);
        burnish_release(context, tiles->workers[i].layers);
        burnish_release(context, tiles->workers[i].carver);
        burnish_release(context, tiles->workers[i].scratch.rays);
        burnish_release(context, tiles->workers[i].scratch.texture);
    }
    burnish_release(context, tiles->workers);
    tiles->workers = NULL;
    tiles->worker_count = 0;
}

static burnish_status create_workers(burnish_tiles *tiles, int count,
                                     const burnish_tile_options *options,
                                     const burnish_context *context, burnish_error *error) {
    burnish_memory memory = burnish_memory_of(context, error);
    tiles->workers =
        burnish_allocate_zeroed(&memory, (size_t)count, sizeof *tiles->workers, "tiles");
    if (!tiles->workers) {
        return memory.status;
    }
    burnish_status status = BURNISH_STATUS_OK;
    tiles->worker_count = count;
    for (int i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        burnish_tile_worker *worker = &tiles->workers[i];
        status = burnish_tile_create(&worker->tile, options, context, error);
        if (status == BURNISH_STATUS_OK && options->has_layers) {
            worker->layers = burnish_layer_light_create(options->samples, &memory);
            worker->carver =
                options->has_layers > 1 ? burnish_carver_create(options->samples, &memory) : NULL;
            status = memory.status;
        }
    }
    if (status != BURNISH_STATUS_OK) {
        destroy_workers(tiles, context); /* no later frame takes a half-made one for its own */
    }
    return status;
}

/* A worker per thread, but no more than there are tiles. */
static int worker_count(const burnish_frame *frame) {
    const int threads = burnish_tasks_threads(frame->tasks);
    const size_t tiles = tile_count(frame);
    return (size_t)threads < tiles ? threads : (int)tiles;
}

/* Prepares workers for the frame; reuses the last frame's if they fit. */
static burnish_status prepare_workers(const burnish_frame *frame, burnish_tiles *tiles,
                                      burnish_error *error) {
    const burnish_surface *surface = &frame->surface;
    const burnish_target *target = &frame->output.target;
    burnish_tile_options needed = {
        .samples = frame->output.samples,
        .planes = burnish_surface_planes(surface),
        .keep_ids = surface->triangle_materials || frame->drawn || target->triangles ||
                    surface->caps || surface->shading->texturing || surface->shading->ray_light ||
                    frame->carving,
        .needs_position = surface->shading->needs_position || target->depth || surface->caps ||
                          surface->shading->texturing,
        .has_layers = frame->carving ? 2 : surface->transparency != NULL,
        .primitives = burnish_tile_primitives_of(frame->geometry)};
    needed.has_codes = burnish_codes_are_direct(surface, &frame->output) && !needed.keep_ids;
    burnish_status status = BURNISH_STATUS_OK;
    const int threads = worker_count(frame);
    if (tiles->worker_count != threads ||
        memcmp(&tiles->workers[0].tile.options, &needed, sizeof needed) != 0) {
        destroy_workers(tiles, frame->context);
        status = create_workers(tiles, threads, &needed, frame->context, error);
    }
    burnish_memory memory = burnish_memory_of(frame->context, error);
    for (int i = 0; i < tiles->worker_count && status == BURNISH_STATUS_OK; ++i) {
        burnish_tile_worker *worker = &tiles->workers[i];
        if (surface->shading->ray_light && !worker->scratch.rays) {
            worker->scratch.rays =
                burnish_allocate_zeroed(&memory, 1, sizeof *worker->scratch.rays, "rays of a tile");
            status = memory.status;
        }
        worker->coder = (burnish_face_coder){.shader = surface->shading->shaders,
                                             .encoder = frame->output.encoder,
                                             .ops = frame->output.ops};
        worker->tile.find_code = burnish_codes_of_face;
        worker->tile.coder = &worker->coder;
        worker->covered_pixels = 0;
        worker->is_carved_too_much = 0;
        burnish_texture_scratch *texture = worker->scratch.texture;
        if (surface->shading->texturing && !texture && status == BURNISH_STATUS_OK) {
            texture = burnish_allocate_zeroed(&memory, 1, sizeof *texture, "textures of a tile");
            worker->scratch.texture = texture;
            status = memory.status;
        }
        if (texture) {
            texture->ids = worker->scratch.ids;
            burnish_texture_begin(texture);
        }
        if (worker->tile.layers) {
            worker->tile.layers->dropped = 0;
        }
        memset(worker->bounds, 0, sizeof worker->bounds);
        worker->tile.attributes[0] = surface->attributes->normals;
        worker->tile.attributes[1] =
            surface->attributes->has_colors ? surface->attributes->colors : NULL;
    }
    return status;
}

burnish_status burnish_frame_draw(const burnish_frame *frame, burnish_tiles *tiles,
                                  burnish_render_report *report, burnish_error *error) {
    burnish_status status = prepare_workers(frame, tiles, error);
    if (status == BURNISH_STATUS_OK) {
        status = draw_tiles(frame, tiles, error);
    }
    for (int i = 0; status == BURNISH_STATUS_OK && i < tiles->worker_count; ++i) {
        if (tiles->workers[i].is_carved_too_much) {
            status = burnish_fail(error, BURNISH_STATUS_LIMIT,
                                  "negative volumes: more than %d of an object, or more than %d "
                                  "surfaces, lie over a sample; join some in the slicer",
                                  BURNISH_NEGATIVES_MAX, BURNISH_TRANSPARENT_LAYERS_MAX);
        }
    }
    if (status == BURNISH_STATUS_OK) {
        merge_counts(tiles, report);
        burnish_tasks_progress(frame->tasks, BURNISH_STAGE_DRAW, 1);
    }
    return status;
}

void burnish_tiles_destroy(burnish_tiles *tiles, const burnish_context *context) {
    destroy_workers(tiles, context);
    burnish_bins_destroy(&tiles->bins);
}
