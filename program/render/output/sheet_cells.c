#include "render/output/result.h"

#include <stdio.h>
#include <string.h>

#include "font/font.h"
#include "render/output/projection.h"
#include "render/scene/cameras.h"

static size_t empty_cells(size_t count, size_t columns) {
    return (columns - count % columns) % columns;
}

/* --columns; else a row per view if there are several views and lobes; one row for up to three
 * cells; else almost a square, with one more column if that leaves fewer empty cells. */
int render_sheet_columns(const render_settings *settings, size_t count) {
    size_t columns = 1;
    if (render_is_projection(settings)) {
        return settings->input.section.axis > 0 ? 3 : 2;
    }
    if (settings->picture.columns > 0) {
        return settings->picture.columns < (int)count ? settings->picture.columns : (int)count;
    }
    if (settings->picture.views.count > 1 && settings->shading.lobes.count > 1) {
        return (int)settings->shading.lobes.count;
    }
    if (count <= 3) {
        return (int)count;
    }
    while (columns * columns < count) {
        ++columns;
    }
    return (int)(columns + (empty_cells(count, columns + 1) < empty_cells(count, columns)));
}

/* Copies item `index` of a list with commas, which has more than `index` items. */
static void copy_item(const char *list, size_t index, char *text, size_t size) {
    for (; index > 0; --index) {
        list = strchr(list, ',') + 1;
    }
    const size_t length = strcspn(list, ",");
    const size_t kept = length < size ? length : utf8_cut(list, size - 1);
    memcpy(text, list, kept);
    text[kept] = 0;
}

static void label_cell(const render_settings *settings, size_t index, render_cell *cell) {
    char lobe[32];
    if (settings->picture.labels) {
        copy_item(settings->picture.labels, index, cell->label, sizeof cell->label);
        return;
    }
    burnish_lobe_spec_name(&cell->lobe, lobe, sizeof lobe);
    const char *view = render_view_name(cell->view);
    if (settings->picture.views.count > 0 && settings->shading.lobes.count > 1) {
        snprintf(cell->label, sizeof cell->label, "%s, %s", view, lobe);
    } else {
        snprintf(cell->label, sizeof cell->label, "%s",
                 settings->shading.lobes.count > 1 ? lobe : view);
    }
}

void render_describe_cells(render_result *result) {
    const render_settings *settings = result->settings;
    for (size_t i = 0; i < result->cell_count; ++i) {
        render_cell *cell = &result->cells[i];
        size_t view = i / settings->shading.lobes.count;
        cell->view =
            settings->picture.views.count > 0 ? settings->picture.views.items[view] : VIEW_FREE;
        cell->lobe = settings->shading.lobes.items[i % settings->shading.lobes.count];
        cell->image.width = result->options->width;
        cell->image.height = settings->picture.rows.count > 0 ? settings->picture.rows.count
                                                              : result->options->height;
        cell->image.channels = result->options->transparent ? 4 : 3;
        label_cell(settings, i, cell);
    }
}

/* Black or white, whichever stands out more from the background. */
static void choose_ink(const burnish_render_options *options, uint8_t ink[3]) {
    const uint8_t *b = options->background;
    int luma = (54 * b[0] + 183 * b[1] + 19 * b[2]) >> 8; /* BT.709 weights in 256ths */
    memset(ink, luma < 128 && !options->transparent ? 230 : 40, 3);
}

void render_list_cells(const render_result *result, render_sheet *sheet) {
    for (size_t i = 0; i < result->cell_count; ++i) {
        sheet->cells[i].image = &result->cells[i].image;
        sheet->cells[i].label = result->settings->picture.no_labels ? NULL : result->cells[i].label;
        sheet->cells[i].font = font_setter(result->font);
    }
    choose_ink(result->options, sheet->ink);
}

/* If a label has letters beyond ASCII, one font draws all labels. */
burnish_status render_open_font(render_result *result, burnish_error *error) {
    const char *foreign = NULL, *file = result->settings->picture.font;
    for (size_t i = 0; i < result->cell_count && !foreign; ++i) {
        for (const char *c = result->cells[i].label; *c && !foreign; ++c) {
            foreign = (unsigned char)*c >= 0x80 ? c : NULL;
        }
    }
    if (result->cell_count < 2 || result->settings->picture.no_labels || (!foreign && !file)) {
        return BURNISH_STATUS_OK;
    }
    if (!file && (!font_is_available || result->settings->picture.opens_no_font)) {
        render_warn(&result->warnings, 1, "--labels: %s; letters beyond ASCII are drawn as ?",
                    font_is_available
                        ? "no font may be opened here"
                        : "this program was built without HarfBuzz, FriBidi and fontconfig");
        return BURNISH_STATUS_OK;
    }
    const burnish_status status = font_open(file, &result->font, error);
    if (status != BURNISH_STATUS_OK && !file) {
        render_warn(&result->warnings, 1, "--labels: %.300s; letters beyond ASCII are drawn as ?",
                    error->text);
        return BURNISH_STATUS_OK;
    }
    return status;
}

static void warn_about_font(render_result *result) {
    const unsigned missing = (unsigned)font_missing(result->font);
    if (missing > 0) {
        render_warn(
            &result->warnings, 1,
            "--labels: no font has U+%04X; it and other missing characters are drawn as boxes",
            missing);
    }
}

burnish_status render_check_sheet(render_result *result, burnish_error *error) {
    render_sheet sheet;
    int width, height;
    if (result->cell_count < 2 || render_is_projection(result->settings)) {
        return BURNISH_STATUS_OK;
    }
    render_list_cells(result, &sheet);
    const burnish_status status = burnish_image_sheet_size(sheet.cells, result->cell_count,
                                                           result->columns, &width, &height, error);
    warn_about_font(result); /* whose missing letters are known now */
    return status;
}

burnish_status render_compose(const render_result *result, burnish_image *image,
                              burnish_error *error) {
    render_sheet sheet;
    render_list_cells(result, &sheet);
    if (render_is_projection(result->settings)) {
        return render_compose_projection(result, sheet.ink, image, error);
    }
    return burnish_image_sheet(image, sheet.cells, result->cell_count, result->columns,
                               result->options->background, sheet.ink, error);
}
