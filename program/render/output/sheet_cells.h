/* The cells of a sheet, their labels, and the image of the sheet. */
#ifndef TOOL_RENDER_SHEET_H
#define TOOL_RENDER_SHEET_H

#include "render/output/result.h"

/* The cells as arguments of the library. */
typedef struct render_sheet {
    burnish_sheet_cell cells[RENDER_LIST_MAX * RENDER_LIST_MAX];
    uint8_t ink[3]; /* of labels: black or white, whichever stands out from the background */
} render_sheet;

/* The number of columns of a sheet of `count` cells. */
int render_sheet_columns(const render_settings *settings, size_t count);

/* Sets views, lobes, sizes and labels of the cells. The lobes of a view are side by side. */
void render_describe_cells(render_result *result);

/* Opens the font that labels need, if any. Errors: see font_open; only with --font. */
burnish_status render_open_font(render_result *result, burnish_error *error);

/* Checks the sheet's size, and warns about letters that no font has. */
burnish_status render_check_sheet(render_result *result, burnish_error *error);

void render_list_cells(const render_result *result, render_sheet *sheet);

/* Draws the image of the whole sheet. */
burnish_status render_compose(const render_result *result, burnish_image *image,
                              burnish_error *error);

#endif
