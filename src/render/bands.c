#include "render/bands.h"

typedef struct band_context {
    const burnish_bins *bins;
    burnish_tile_function *draw;
    void *context;
} band_context;

static void draw_task(void *context, size_t index, int thread) {
    const band_context *band = context;
    const burnish_bins *bins = band->bins;
    band->draw(band->context, (int)index % bins->columns,
               bins->first_row + (int)index / bins->columns, thread);
}

/* Neighbouring tiles share cache lines of the target, so a thread takes some of them at once; but
 * so few that the last ones are not waited for. */
static size_t tile_grain(int count, int threads) {
    enum { MAX_GRAIN = 8, TURNS = 32 };
    const int grain = count / (threads * TURNS);
    return (size_t)(grain < 1 ? 1 : grain > MAX_GRAIN ? MAX_GRAIN : grain);
}

burnish_status burnish_bands_draw(const burnish_bands *bands, burnish_tile_function *draw,
                                  void *context, burnish_error *error) {
    return burnish_bands_draw_rows(bands, 0, BURNISH_MAX_TILES, draw, context, error);
}

burnish_status burnish_bands_draw_rows(const burnish_bands *bands, int first_row, int end_row,
                                       burnish_tile_function *draw, void *context,
                                       burnish_error *error) {
    burnish_bins *bins = bands->bins;
    burnish_status status = BURNISH_STATUS_OK;
    band_context band = {bins, draw, context};
    burnish_bins_begin(bins, bands->context);
    bins->end_row = first_row;
    bins->row_limit = end_row;
    do {
        status =
            burnish_bin_tiles(bins, bands->ops, bands->geometry, bands->view, bands->tasks, error);
        if (status == BURNISH_STATUS_OK) {
            const int count = bins->columns * (bins->end_row - bins->first_row);
            burnish_tasks_run(bands->tasks, (size_t)count, tile_grain(count, bands->threads),
                              bands->threads, draw_task, &band);
            status = burnish_tasks_check(bands->tasks, error);
        }
    } while (status == BURNISH_STATUS_OK && bins->end_row < bins->rows);
    return status;
}
