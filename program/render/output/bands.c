#include "render/output/bands.h"

#include "base/clock.h"
#include "render/output/cells.h"
#include "render/output/pieces.h"
#include "render/output/stream.h"

enum { BAND_ROWS = 64 }; /* a row of the library's tiles, so no tile is drawn twice */

/* Facts of a band in addition to its pixels. */
enum { NOTE_COVERED, NOTE_LAYERS, NOTE_LOBES, NOTES };
_Static_assert((int)NOTES == (int)RENDER_PIECE_NOTES, "all notes come with the pixels");

/* A picture that is being written. */
typedef struct stream {
    const render_bands *bands;
    burnish_png_stream *png;
    render_pieces *pieces;
    uint64_t notes[NOTES], sums[NOTES];
    int count;      /* of bands */
    uint8_t *bytes; /* of the last band, in the file */
} stream;

static int band_rows(const stream *s, int band) {
    const int left = s->bands->options->height - band * BAND_ROWS;
    return left < BAND_ROWS ? left : BAND_ROWS;
}

/* The rows of a band in the cell's image. Rows below the end of the picture are undefined. */
static burnish_pixels band_pixels(const stream *s, int band) {
    burnish_pixels pixels = burnish_image_get_pixels(&s->bands->result->cells[0].image);
    pixels.height = band_rows(s, band);
    return pixels;
}

/* render_piece_drawer */
static burnish_status draw_band(void *context, int band, burnish_error *error) {
    stream *s = context;
    const render_bands *b = s->bands;
    render_cell *cell = &b->result->cells[0];
    burnish_target target = burnish_target_default();
    target.pixels = band_pixels(s, band);
    b->options->first_row = band * BAND_ROWS;
    b->options->row_count = target.pixels.height;
    const burnish_status status = burnish_renderer_draw_into(
        b->renderer, b->result->mesh, b->options, &target, &cell->report, error);
    s->notes[NOTE_COVERED] = cell->report.covered_pixels;
    s->notes[NOTE_LAYERS] = cell->report.layers_dropped;
    s->notes[NOTE_LOBES] = cell->report.lobe_fallbacks;
    b->result->seconds.transform += cell->report.seconds_transform;
    b->result->seconds.draw += cell->report.seconds_draw;
    return status;
}

/* Prepares drawing bands of the cell. */
static burnish_status begin(stream *s, burnish_error *error) {
    const render_bands *b = s->bands;
    render_cell *cell = &b->result->cells[0];
    const burnish_render_options *options = b->options;
    render_aim_options(b->result, b->options, cell);
    b->options->counts = BURNISH_COUNTS_PIXELS;
    s->count = (options->height + BAND_ROWS - 1) / BAND_ROWS;
    return burnish_image_create(NULL, &cell->image, options->width, band_rows(s, 0),
                                options->transparent ? 4 : 3, error);
}

static render_pieces_plan plan_pieces(stream *s) {
    const render_result *result = s->bands->result;
    const burnish_mesh_view *view = burnish_mesh_get_view(result->mesh);
    return (render_pieces_plan){.runners = result->settings->job.runners,
                                .count = s->count,
                                .triangles = view->triangle_count,
                                .vertices = view->vertex_count,
                                .image = &result->cells[0].image,
                                .notes = s->notes,
                                .draw = draw_band,
                                .context = s};
}

burnish_status render_serve_bands(const render_bands *bands, burnish_error *error) {
    stream s = {.bands = bands};
    const burnish_status status = begin(&s, error);
    const render_pieces_plan plan = plan_pieces(&s);
    return status == BURNISH_STATUS_OK ? render_pieces_serve(&plan, error) : status;
}

/* ---- The file ---- */

static void end_report(const stream *s) {
    render_result *result = s->bands->result;
    render_cell *cell = &result->cells[0];
    cell->report.covered_pixels = s->sums[NOTE_COVERED];
    cell->report.layers_dropped = s->sums[NOTE_LAYERS];
    cell->report.lobe_fallbacks = s->sums[NOTE_LOBES];
    render_warn_about_cell(result, cell);
}

/* render_stream_next */
static burnish_status next_band(void *context, int band, const uint8_t **bytes, size_t *size,
                                burnish_error *error) {
    stream *s = context;
    if (band == s->count) { /* the file ends with its last band */
        end_report(s);
        return BURNISH_STATUS_OK;
    }
    burnish_release(NULL, s->bytes);
    s->bytes = NULL;
    burnish_status status = render_pieces_take(s->pieces, band, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    for (int i = 0; i < NOTES; ++i) {
        const uint64_t note = s->notes[i], sum = s->sums[i];
        s->sums[i] = i != NOTE_LOBES ? sum + note : note > sum ? note : sum;
    }
    const double start = burnish_seconds_now();
    const burnish_pixels pixels = band_pixels(s, band);
    status = burnish_png_stream_add(s->png, &pixels, &s->bytes, size, error);
    s->bands->result->seconds.encode += burnish_seconds_now() - start;
    *bytes = s->bytes;
    return status;
}

burnish_status render_write_bands(const render_bands *bands, burnish_error *error) {
    const render_settings *settings = bands->result->settings;
    stream s = {.bands = bands};
    burnish_png_options png = burnish_png_options_default();
    png.threads = settings->job.threads;
    png.dots_per_inch = settings->output.dots_per_inch.value;
    burnish_status status = begin(&s, error);
    if (status == BURNISH_STATUS_OK) {
        const burnish_pixels pixels = band_pixels(&s, 0);
        status = burnish_png_stream_create(pixels.width, bands->options->height, pixels.format,
                                           &png, &s.png, error);
    }
    if (status == BURNISH_STATUS_OK) {
        const render_pieces_plan plan = plan_pieces(&s);
        status = render_pieces_create(&plan, &s.pieces, error);
    }
    if (status == BURNISH_STATUS_OK) {
        const render_stream file = {.result = bands->result,
                                    .noun = "band",
                                    .count = s.count,
                                    .next = next_band,
                                    .context = &s,
                                    .ready = bands->ready};
        status = render_stream_write(&file, error);
    }
    render_pieces_destroy(s.pieces);
    burnish_png_stream_destroy(s.png);
    burnish_release(NULL, s.bytes);
    return status;
}
