/* The cells of a sheet: which there are, what their labels say, and their common image. */
#ifndef TOOL_RENDER_SHEET_H
#define TOOL_RENDER_SHEET_H

#include "render/output/report.h"

/* The cells as the library takes them. */
typedef struct render_sheet {
    burnish_sheet_cell cells[RENDER_LIST_MAX * RENDER_LIST_MAX];
    uint8_t ink[3]; /* of labels: black or white, whichever stands out from the background */
} render_sheet;

/* How many columns a sheet of `count` cells has. */
int render_sheet_columns(const render_settings *settings, size_t count);

/* Sets views, lobes, sizes and labels of the cells. The lobes of a view are side by side. */
void render_describe_cells(render_result *result);

/* Opens the font that labels need, if any. Errors: those of font_open with --font. */
burnish_status render_open_font(render_result *result, burnish_error *error);

/* Checks the sheet's size, and warns about letters that no font has. */
burnish_status render_check_sheet(render_result *result, burnish_error *error);

void render_list_cells(const render_result *result, render_sheet *sheet);

/* Draws the image of the whole sheet. */
burnish_status render_compose(const render_result *result, burnish_image *image,
                              burnish_error *error);

#endif
