/* The colours of figures. Hues after Okabe and Ito 2008, which people with any colour vision tell
 * apart, darkened for white and lightened for dark pages to a contrast of at least 3 to 1; the ramp
 * runs in lightness, so that its order survives in grey. */
#include "plot/plot.h"

const plot_color plot_panel = {"#ffffff", "#161b22"};

const plot_color plot_inks[PLOT_INK_COUNT] = {
    [PLOT_INK_TEXT] = {"#2f363f", "#c9d1d9"},
    [PLOT_INK_AXIS] = {"#6a737d", "#7d8791"},
    [PLOT_INK_GRID] = {"#e7eaee", "#2a313a"},
    [PLOT_INK_REFERENCE] = {"#1b1f24", "#f0f3f6"},
    [PLOT_INK_LOBE] = {"#0072b2", "#58a6e8"},
    {"#d55e00", "#f5874a"},
    {"#008561", "#33c39a"},
    {"#aa4f8d", "#de8fc0"},
    {"#a87400", "#e3ad3e"},
    {"#2b8fc4", "#8fd0f5"},
    {"#767676", "#a0a7ae"},
    [PLOT_INK_RAMP] = {"#440154", "#c886e0"},
    {"#463480", "#a394f2"},
    {"#365c8d", "#79a8f0"},
    {"#277f8e", "#55bcd0"},
    {"#1a8f78", "#45cfa8"},
    {"#2f9a50", "#7ad97f"},
    {"#6b951c", "#b5d64e"},
    {"#a58500", "#f2d445"},
};

int plot_ramp_ink(size_t i, size_t count) {
    size_t last = PLOT_RAMP_INKS - 1;
    size_t place = count > 1 ? (i * last + (count - 1) / 2) / (count - 1) : 2;
    return PLOT_INK_RAMP + (int)(place > last ? last : place);
}
