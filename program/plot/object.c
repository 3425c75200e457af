/* The figure `object`: the teapot shaded with several lobes, and how each differs from the first.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "burnish/core.h"
#include "burnish/render.h"
#include "burnish/sheet.h"
#include "picture/difference.h"
#include "plot/figures.h"
#include "plot/object.h"

enum { LOBES_MAX = 6, NAME_SIZE = 40, LABEL_SIZE = 128 };

static const char object_name[] = ":teapot";

/* The sheet: lobes in the first row, differences in the second. */
typedef struct gallery {
    burnish_image images[2][LOBES_MAX];
    char names[LOBES_MAX][NAME_SIZE], labels[LOBES_MAX][LABEL_SIZE]; /* under the rows */
    int low[LOBES_MAX], high[LOBES_MAX]; /* extreme differences of a channel, 8-bit codes */
    double mean[LOBES_MAX];              /* mean difference over all channels and pixels */
    int scale_end; /* end of the colour scale: a multiple of 10, not below any difference */
    size_t count;
} gallery;

static burnish_status set_material(burnish_mesh *mesh, double exponent, burnish_error *error) {
    burnish_material material = burnish_material_default();
    static const float color[3] = {0.030F, 0.110F, 0.250F}; /* linear: a dark glaze */
    for (int k = 0; k < 3; ++k) {
        material.diffuse[k] = material.ambient[k] = color[k];
        material.specular[k] = 0.9F;
    }
    material.exponent = (float)exponent;
    return burnish_mesh_set_material(mesh, 0, &material, error);
}

static burnish_status load(double exponent, double aspect, burnish_mesh **mesh,
                           burnish_camera *camera, burnish_error *error) {
    burnish_load_options options = burnish_load_options_default();
    burnish_framing fit = burnish_framing_default();
    options.tessellation = 32;
    fit.aspect = aspect;
    burnish_status status = burnish_mesh_load(object_name, &options, mesh, error);
    if (status == BURNISH_STATUS_OK) {
        status = set_material(*mesh, exponent, error);
    }
    return status == BURNISH_STATUS_OK ? burnish_camera_frame(*mesh, &fit, camera, error) : status;
}

static void write_code(int difference, char *text, size_t size) {
    snprintf(text, size, difference ? "%+d" : "%d", difference);
}

/* Measures how a lobe's picture differs from the first one. */
static void measure(gallery *g, size_t i) {
    const burnish_image *reference = &g->images[0][0], *image = &g->images[0][i];
    const size_t bytes = (size_t)image->width * (size_t)image->height * 3;
    double sum = 0;
    for (size_t k = 0; k < bytes; ++k) {
        const int difference = image->pixels[k] - reference->pixels[k];
        g->low[i] = difference < g->low[i] ? difference : g->low[i];
        g->high[i] = difference > g->high[i] ? difference : g->high[i];
        sum += difference;
    }
    g->mean[i] = sum / (double)bytes;
    while (g->scale_end < g->high[i] || g->scale_end < -g->low[i]) {
        g->scale_end += 10;
    }
}

/* Draws a lobe's cell in the second row: its difference from the first, with numbers. */
static burnish_status subtract(gallery *g, size_t i, burnish_error *error) {
    char low[16], high[16];
    write_code(g->low[i], low, sizeof low);
    write_code(g->high[i], high, sizeof high);
    snprintf(g->labels[i], LABEL_SIZE, "%s minus %s: %s to %s", g->names[i], g->names[0], low,
             high);
    return picture_subtract(&g->images[0][0], &g->images[0][i], g->scale_end, &g->images[1][i],
                            error);
}

/* Draws the scale of the second row in the cell below the reference. */
static burnish_status draw_legend(gallery *g, double exponent, burnish_error *error) {
    burnish_image *card = &g->images[1][0];
    const burnish_image *like = &g->images[0][0];
    burnish_status status = burnish_image_create(NULL, card, like->width, like->height, 3, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    memset(card->pixels, 255, 3 * (size_t)card->width * (size_t)card->height);
    char line[LABEL_SIZE];
    int size = card->width < card->height ? card->width : card->height;
    float height = (float)size / 28, middle = (float)card->width / 2;
    float y = (float)card->height * 0.3F;
    height = height < 5 ? 5 : height;
    snprintf(line, sizeof line, "Difference from %s, exponent %.6g", g->names[0], exponent);
    picture_draw_centered(card, middle, y, height, line);
    picture_draw_centered(card, middle, y + 2.2F * height, height, "in 8-bit codes of the channel");
    picture_draw_centered(card, middle, y + 4.4F * height, height, "that differs most");
    const int box[4] = {card->width / 8, (int)(y + 6.6F * height), card->width * 3 / 4,
                        (int)(1.6F * height)};
    picture_draw_scale(card, box, height, -g->scale_end, g->scale_end);
    return BURNISH_STATUS_OK;
}

static void name_lobe(const char *word, char *name) {
    static const char *const names[][2] = {
        {"power", "cos^n"}, {"energy:2", "W_1"}, {"taylor:2", "W"}, {"schlick", "Schlick"}};
    snprintf(name, NAME_SIZE, "%s", word);
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        if (strcmp(word, names[i][0]) == 0) {
            snprintf(name, NAME_SIZE, "%s", names[i][1]);
        }
    }
}

static burnish_status draw_lobes(const plot_request *request, gallery *g, burnish_error *error) {
    burnish_mesh *mesh = NULL;
    burnish_render_options options = burnish_render_options_default();
    burnish_status status =
        load(request->exponents.items[0], (double)request->width / request->height, &mesh,
             &options.camera, error);
    options.width = request->width;
    options.height = request->height;
    options.samples = 16;
    memset(options.background, 255, sizeof options.background);
    g->scale_end = 10;
    for (size_t i = 0; i < request->lobes.count && status == BURNISH_STATUS_OK; ++i) {
        burnish_error inner;
        if (burnish_lobe_spec_parse(request->lobes.items[i], &options.lobe, &inner) !=
            BURNISH_STATUS_OK) {
            status = cli_fail(error, BURNISH_STATUS_ARGUMENT, "--lobes: %s", inner.text);
            break;
        }
        name_lobe(request->lobes.items[i], g->names[i]);
        status = burnish_render(mesh, &options, &g->images[0][i], NULL, error);
        if (status == BURNISH_STATUS_OK && i > 0) {
            measure(g, i);
        }
    }
    for (size_t i = 1; i < request->lobes.count && status == BURNISH_STATUS_OK; ++i) {
        status = subtract(g, i, error);
    }
    burnish_mesh_destroy(mesh);
    return status;
}

static burnish_status write_sheet(const gallery *g, const char *path, burnish_error *error) {
    static const uint8_t background[3] = {255, 255, 255}, ink[3] = {47, 54, 63};
    burnish_sheet_cell cells[2 * LOBES_MAX];
    burnish_image sheet;
    for (size_t row = 0; row < 2; ++row) {
        for (size_t i = 0; i < g->count; ++i) {
            cells[row * g->count + i] = (burnish_sheet_cell){
                .image = &g->images[row][i], .label = row == 0 ? g->names[i] : g->labels[i]};
        }
    }
    burnish_status status =
        burnish_image_sheet(&sheet, cells, 2 * g->count, (int)g->count, background, ink, error);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_image_write_png(&sheet, path, error);
        burnish_image_destroy(&sheet);
    }
    return status;
}

static burnish_status write_differences(const plot_request *request, const gallery *g,
                                        const char *path, burnish_error *error) {
    char text[64 + LOBES_MAX * 96];
    size_t used = (size_t)snprintf(
        text, sizeof text, "lobe,reference,lowest_difference,highest_difference,mean_difference\n");
    for (size_t i = 1; i < g->count; ++i) {
        used += (size_t)snprintf(text + used, sizeof text - used, "%s,%s,%d,%d,%.6g\n",
                                 request->lobes.items[i], request->lobes.items[0], g->low[i],
                                 g->high[i], g->mean[i]);
    }
    return burnish_file_write(path, text, used, error);
}

burnish_status plot_object(const plot_request *request, int data, const char *path,
                           burnish_error *error) {
    if (request->lobes.count < 2 || request->lobes.count > LOBES_MAX) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--lobes: the figure object takes 2 to %d lobes, the one to compare "
                        "with first",
                        LOBES_MAX);
    }
    gallery *g = calloc(1, sizeof *g);
    if (!g) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the figure");
    }
    g->count = request->lobes.count;
    burnish_status status = draw_lobes(request, g, error);
    if (status == BURNISH_STATUS_OK) {
        status = draw_legend(g, request->exponents.items[0], error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = data ? write_differences(request, g, path, error) : write_sheet(g, path, error);
    }
    for (size_t row = 0; row < 2; ++row) {
        for (size_t i = 0; i < g->count; ++i) {
            burnish_image_destroy(&g->images[row][i]);
        }
    }
    free(g);
    return status;
}
