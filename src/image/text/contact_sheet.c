/* Contact sheets: images of equal size in rows, with a centred label under each. Pixels and
 * drawings have the same layout. */
#include <string.h>

#include "base/error.h"
#include "burnish/drawing.h"
#include "burnish/sheet.h"
#include "core/float_mode.h"
#include "image/text/drawing.h"
#include "image/text/glyph_outline.h"
#include "image/text/text.h"

enum {
    LEAST_GAP = 4,      /* pixels between cells and around them */
    GAP_DIVISOR = 24,   /* the gap is the cell's shorter side by this */
    LEAST_LABEL = 9,    /* height of a label's capitals, in pixels */
    LABEL_DIVISOR = 28, /* ... the cell's height by this */
    SMALLEST_LABEL = 7  /* long labels make all labels smaller down to this, then are cut */
};

static const char ellipsis[] = "...";

typedef struct layout {
    int columns;
    int width, height; /* of a cell's picture */
    int gap;
    int label;           /* height of a label's capitals; 0: no cell has a label */
    int baseline, below; /* from the picture's lower edge to the baseline, and to the band's end */
} layout;

static int has_label(const burnish_sheet_cell *cell) {
    return cell->label && *cell->label;
}

static burnish_status check_cells(const burnish_sheet_cell *cells, size_t count, int columns,
                                  burnish_error *error) {
    if (!cells || count == 0 || columns < 1 || (size_t)columns > count) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "sheet: %d columns for %zu pictures; use 1 to the number of pictures",
                            columns, count);
    }
    const burnish_image *first = cells[0].image;
    for (size_t i = 0; i < count; ++i) {
        const burnish_image *image = cells[i].image;
        if (!image || image->width < 1 || image->height < 1) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "sheet: picture %zu is empty; render it first", i + 1);
        }
        if (image->width != first->width || image->height != first->height ||
            image->channels != first->channels) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "sheet: picture %zu is %d x %d with %d channels, the first is %d x "
                                "%d with %d; make them equal",
                                i + 1, image->width, image->height, image->channels, first->width,
                                first->height, first->channels);
        }
    }
    return BURNISH_STATUS_OK;
}

static float measure_label(const burnish_font *font, const char *text, size_t length, int height) {
    static const uint8_t unused[3] = {0};
    return font ? (float)font->set_line(font->user_data, text, length, height, NULL, NULL) / 256
                : burnish_text_draw(NULL, 0, 0, (float)height, unused, text, length);
}

/* The label height at which every label fits its cell, or the smallest. */
static int fit_labels(const burnish_sheet_cell *cells, size_t count, int width, int height) {
    for (size_t i = 0; i < count && height > SMALLEST_LABEL; ++i) {
        if (!has_label(&cells[i])) {
            continue;
        }
        size_t length = strlen(cells[i].label);
        while (height > SMALLEST_LABEL &&
               measure_label(cells[i].font, cells[i].label, length, height) > (float)width) {
            --height;
        }
    }
    return height;
}

static layout make_layout(const burnish_sheet_cell *cells, size_t count, int columns) {
    const burnish_image *image = cells[0].image;
    int shorter = image->width < image->height ? image->width : image->height;
    layout made = {.columns = columns,
                   .width = image->width,
                   .height = image->height,
                   .gap = shorter > LEAST_GAP * GAP_DIVISOR ? shorter / GAP_DIVISOR : LEAST_GAP};
    int labels = 0;
    for (size_t i = 0; i < count; ++i) {
        labels |= has_label(&cells[i]);
    }
    if (labels) {
        int height = image->height / LABEL_DIVISOR;
        height = height > LEAST_LABEL ? height : LEAST_LABEL;
        made.label = fit_labels(cells, count, image->width, height);
        made.baseline = made.label * 9 / 5;
        made.below = made.baseline + made.label / 2;
    }
    return made;
}

void burnish_image_fill(burnish_image *image, const uint8_t color[3]) {
    size_t count = (size_t)image->width * (size_t)image->height;
    uint8_t *pixel = image->pixels;
    for (size_t i = 0; i < count; ++i) {
        memcpy(pixel, color, 3);
        if (image->channels == 4) {
            pixel[3] = 255;
        }
        pixel += image->channels;
    }
}

/* The bytes of text up to length without the first ones of a UTF-8 character that length cuts. */
static size_t whole_characters(const char *text, size_t length) {
    size_t end = length;
    while (end > 0 && ((unsigned char)text[end] & 0xC0) == 0x80) {
        --end;
    }
    return end;
}

char *burnish_text_fit(const burnish_font *font, const char *text, int height, float width,
                       burnish_memory *memory) {
    const size_t length = strlen(text);
    const float room = width - measure_label(font, ellipsis, sizeof ellipsis - 1, height);
    const int is_cut = measure_label(font, text, length, height) > width;
    size_t fits = is_cut ? 0 : length;
    size_t fails = length + 1;
    while (fails - fits > 1) {
        size_t middle = fits + (fails - fits) / 2;
        if (measure_label(font, text, whole_characters(text, middle), height) <= room) {
            fits = middle;
        } else {
            fails = middle;
        }
    }
    fits = whole_characters(text, fits);
    char *made = fits > 0 ? burnish_allocate(memory, fits + sizeof ellipsis, 1, "a label") : NULL;
    if (made) {
        memcpy(made, text, fits);
        memcpy(made + fits, is_cut ? ellipsis : "", is_cut ? sizeof ellipsis : 1);
    }
    return made;
}

/* The target of labels, and their colour. */
typedef struct page {
    burnish_image *image;     /* NULL: into the drawing */
    burnish_drawing *drawing; /* NULL: into the image */
    const uint8_t *ink;
    const layout *made;
    burnish_memory *memory;
} page;

/* A label of the font's, in the middle of the cell. */
static burnish_status fill_label(const page *to, int x, int baseline,
                                 const burnish_sheet_cell *cell, const char *text, size_t length) {
    const burnish_font *font = cell->font;
    const int height = to->made->label;
    const int32_t advance = font->set_line(font->user_data, text, length, height, NULL, NULL);
    burnish_outline outline = {.x = x * 256 + (to->made->width * 256 - advance) / 2,
                               .y = baseline * 256,
                               .memory = to->memory};
    outline.at[0] = outline.start[0] = outline.x;
    outline.at[1] = outline.start[1] = outline.y;
    font->set_line(font->user_data, text, length, height, burnish_outline_add, &outline);
    if (!to->image) {
        burnish_drawing_outline(to->drawing, &outline, to->ink, cell->label);
        burnish_release(to->memory->context, outline.edges);
        return to->memory->status;
    }
    const burnish_ink ink = burnish_ink_of(to->ink, 1);
    const burnish_pixels pixels = burnish_image_get_pixels(to->image);
    return burnish_outline_fill(&outline, &pixels, &ink);
}

/* A label in burnish's stroke font. */
static burnish_status draw_own_label(const page *to, float left, float baseline, const char *name,
                                     const char *text) {
    const float height = (float)to->made->label;
    if (to->image) {
        burnish_text_draw(to->image, left, baseline, height, to->ink, text, strlen(text));
        return BURNISH_STATUS_OK;
    }
    burnish_stroke_list line = {.memory = to->memory};
    burnish_text_strokes(left, baseline, height, text, strlen(text), burnish_stroke_list_append,
                         &line);
    burnish_drawing_open(to->drawing, to->ink, 1);
    burnish_drawing_strokes(to->drawing, line.items, line.count, name);
    burnish_drawing_close(to->drawing);
    burnish_release(to->memory->context, line.items);
    return to->memory->status;
}

/* x: the cell's left edge; cells too narrow for an ellipsis keep no label. A cut label begins there,
 * and with a font runs to the left where its script does. */
static burnish_status draw_label(const page *to, int x, int baseline,
                                 const burnish_sheet_cell *cell) {
    const int height = to->made->label, width = to->made->width;
    char *text = burnish_text_fit(cell->font, cell->label, height, (float)width, to->memory);
    if (!text) {
        return to->memory->status;
    }
    const size_t length = strlen(text);
    const float rest = (float)width - measure_label(cell->font, text, length, height);
    const float left = strcmp(text, cell->label) == 0 ? (float)x + rest * 0.5F : (float)x;
    const burnish_status status =
        cell->font ? fill_label(to, x, baseline, cell, text, length)
                   : draw_own_label(to, left, (float)baseline, cell->label, text);
    burnish_release(to->memory->context, text);
    return status;
}

/* The layout and the size of the sheet. */
static burnish_status lay_out(const burnish_sheet_cell *cells, size_t count, int columns,
                              layout *made, int size[2], burnish_error *error) {
    burnish_status status = check_cells(cells, count, columns, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    *made = make_layout(cells, count, columns);
    size_t rows = (count - 1) / (size_t)columns + 1;
    int64_t step_x = (int64_t)made->width + made->gap;
    int64_t step_y = (int64_t)made->height + made->below + made->gap;
    /* No product overflows: each factor that passes the first two tests is below 2^15. */
    if (columns > BURNISH_IMAGE_MAX_SIZE || rows > BURNISH_IMAGE_MAX_SIZE ||
        step_x * columns + made->gap > BURNISH_IMAGE_MAX_SIZE ||
        step_y * (int64_t)rows + made->gap > BURNISH_IMAGE_MAX_SIZE) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "sheet: %zu pictures of %d x %d in %d columns exceed %d pixels; use "
                            "smaller pictures or another number of columns",
                            count, made->width, made->height, columns, BURNISH_IMAGE_MAX_SIZE);
    }
    size[0] = (int)(step_x * columns + made->gap);
    size[1] = (int)(step_y * (int64_t)rows + made->gap);
    return BURNISH_STATUS_OK;
}

burnish_status burnish_image_sheet_size(const burnish_sheet_cell *cells, size_t count, int columns,
                                        int *width, int *height, burnish_error *error) {
    layout made;
    int size[2] = {0, 0};
    const burnish_float_mode before = burnish_float_mode_enter();
    const burnish_status status = lay_out(cells, count, columns, &made, size, error);
    burnish_float_mode_leave(before);
    *width = size[0];
    *height = size[1];
    return status;
}

/* The position of a cell's image. */
static void cell_corner(const layout *made, size_t cell, int *x, int *y) {
    *x = made->gap + (made->width + made->gap) * (int)(cell % (size_t)made->columns);
    *y = made->gap + (made->height + made->below + made->gap) * (int)(cell / (size_t)made->columns);
}

static burnish_status make_sheet(burnish_image *sheet, const burnish_sheet_cell *cells,
                                 size_t count, int columns, const uint8_t background[3],
                                 const uint8_t ink[3], burnish_error *error) {
    layout made;
    int size[2];
    *sheet = (burnish_image){0};
    burnish_status status = lay_out(cells, count, columns, &made, size, error);
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        if (!cells[i].image->pixels) {
            status = burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                  "sheet: picture %zu is empty; render it first", i + 1);
        }
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_image_create(cells[0].image->context, sheet, size[0], size[1],
                                      cells[0].image->channels, error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_memory memory = burnish_memory_of(sheet->context, error);
    const page to = {.image = sheet, .ink = ink, .made = &made, .memory = &memory};
    burnish_image_fill(sheet, background);
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        int x, y;
        cell_corner(&made, i, &x, &y);
        burnish_image_copy(sheet, x, y, cells[i].image);
        if (has_label(&cells[i])) {
            status = draw_label(&to, x, y + made.height + made.baseline, &cells[i]);
        }
    }
    if (status != BURNISH_STATUS_OK) {
        burnish_image_destroy(sheet);
    }
    return status;
}

burnish_status burnish_image_sheet(burnish_image *sheet, const burnish_sheet_cell *cells,
                                   size_t count, int columns, const uint8_t background[3],
                                   const uint8_t ink[3], burnish_error *error) {
    const burnish_float_mode before = burnish_float_mode_enter();
    const burnish_status status = make_sheet(sheet, cells, count, columns, background, ink, error);
    burnish_float_mode_leave(before);
    return status;
}

/* ---- Of drawings ---- */

/* Cells of the drawings' sizes, which the layout is made of. */
static burnish_status place_drawings(const burnish_sheet_cell *cells,
                                     burnish_drawing *const *drawings, size_t count, int columns,
                                     const uint8_t ink[3], burnish_drawing **sheet,
                                     burnish_error *error) {
    layout made;
    int size[2];
    burnish_status status = lay_out(cells, count, columns, &made, size, error);
    for (size_t i = 0; i < count && status == BURNISH_STATUS_OK; ++i) {
        if (!drawings[i] || drawings[i]->width != made.width ||
            drawings[i]->height != made.height) {
            status = burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                  "sheet: drawing %zu is not of the cells' size, %d x %d", i + 1,
                                  made.width, made.height);
        }
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_drawing_create(drawings[0]->context, size[0], size[1], sheet, error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_drawing_use(*sheet, error);
    const page to = {.drawing = *sheet, .ink = ink, .made = &made, .memory = &(*sheet)->memory};
    for (size_t i = 0; i < count; ++i) {
        int x, y;
        cell_corner(&made, i, &x, &y);
        burnish_drawing_place(*sheet, drawings[i], x, y);
        if (has_label(&cells[i])) {
            draw_label(&to, x, y + made.height + made.baseline, &cells[i]);
        }
    }
    return (*sheet)->memory.status;
}

burnish_status burnish_drawing_sheet(const burnish_sheet_cell *cells,
                                     burnish_drawing *const *drawings, size_t count, int columns,
                                     const uint8_t ink[3], burnish_drawing **sheet,
                                     burnish_error *error) {
    const burnish_float_mode before = burnish_float_mode_enter();
    *sheet = NULL;
    const burnish_status status =
        place_drawings(cells, drawings, count, columns, ink, sheet, error);
    if (status != BURNISH_STATUS_OK) {
        burnish_drawing_destroy(*sheet);
        *sheet = NULL;
    }
    burnish_float_mode_leave(before);
    return status;
}
