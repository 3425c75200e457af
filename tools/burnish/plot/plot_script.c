/* Charts as CSV and as gnuplot scripts. Every margin and every text's place is explicit, so that
 * the same gnuplot gives the same bytes on every machine. */
#include <math.h>
#include <string.h>

#include "plot/plot.h"

enum {
    FONT_SIZE = 13,
    LABEL_GAP = 17,    /* px between the baselines of labels */
    LABEL_INDENT = 16, /* px from the end of a curve to its label */
    KEY_GAP = 26,      /* px between the baselines of a key's lines */
    KEY_INDENT = 14,   /* px from the plot to a key beside it */
    KEY_SAMPLE = 42,   /* px of a line in the key */
    MARGIN_LEFT = 66,
    MARGIN_RIGHT = 26,
    MARGIN_TOP = 48,
    MARGIN_BOTTOM = 66,
    BAND_HEIGHT = 26,
    LEAST_PLOT = 100 /* px between the margins */
};

/* The plot's rectangle in px from the lower left corner of the picture. */
typedef struct frame {
    double left, right, bottom, top, width, height;
} frame;

/* Letters that enhanced text shows: without braces, font changes and marks for sub- and
 * superscripts. */
static size_t visible_length(const char *text) {
    size_t length = 0;
    while (*text) {
        if (strncmp(text, "{/:Italic ", 10) == 0) {
            text += 10;
            continue;
        }
        length += !strchr("{}_^", *text) && ((unsigned char)*text & 0xC0) != 0x80;
        ++text;
    }
    return length;
}

/* What names beside the plot take, px. */
static double names_width(const plot_chart *chart) {
    size_t longest = 0;
    for (size_t i = 0; i < chart->series_count; ++i) {
        size_t length = visible_length(chart->series[i].text);
        longest = length > longest ? length : longest;
    }
    if (longest == 0 || (!chart->labels_at_end && chart->key_inside)) {
        return 0;
    }
    return (chart->labels_at_end ? LABEL_INDENT : KEY_INDENT + KEY_SAMPLE) +
           0.62 * FONT_SIZE * (double)longest;
}

int plot_least_width(const plot_chart *chart) {
    return MARGIN_LEFT + MARGIN_RIGHT + LEAST_PLOT + (int)names_width(chart);
}

int plot_least_height(const plot_chart *chart) {
    int entries = 0;
    for (size_t i = 0; i < chart->series_count; ++i) {
        entries += chart->series[i].text[0] != 0;
    }
    int names = entries * (chart->labels_at_end ? LABEL_GAP : KEY_GAP);
    return MARGIN_TOP + MARGIN_BOTTOM + (chart->band_count > 0 ? BAND_HEIGHT : 0) +
           (names > LEAST_PLOT ? names : LEAST_PLOT);
}

static frame frame_of(const plot_chart *chart) {
    frame f = {.width = chart->width, .height = chart->height};
    f.left = MARGIN_LEFT;
    f.right = f.width - MARGIN_RIGHT - names_width(chart);
    f.bottom = MARGIN_BOTTOM;
    f.top = f.height - MARGIN_TOP - (chart->band_count > 0 ? BAND_HEIGHT : 0);
    return f;
}

/* Where a value lies between the ends of an axis: [0, 1], clipped. */
static double place(const plot_axis *axis, double value) {
    double share = axis->logarithmic
                       ? (value > 0 ? log(value / axis->low) / log(axis->high / axis->low) : 0)
                       : (value - axis->low) / (axis->high - axis->low);
    return share < 0 ? 0 : share > 1 ? 1 : share;
}

static double pixel_x(const frame *f, const plot_chart *chart, double x) {
    return f->left + (f->right - f->left) * place(&chart->x, x);
}

static double pixel_y(const frame *f, const plot_chart *chart, double y) {
    return f->bottom + (f->top - f->bottom) * place(&chart->y, y);
}

/* Moves ascending places apart to at least `gap` with the least sum of squared moves (isotonic
 * regression: neighbours that would collide form blocks around their mean). */
static void spread(double *places, size_t count, double gap, double low, double high) {
    double means[PLOT_NOTES_MAX];
    size_t sizes[PLOT_NOTES_MAX], blocks = 0;
    for (size_t i = 0; i < count; ++i) {
        means[blocks] = places[i] - gap * (double)i;
        sizes[blocks++] = 1;
        while (blocks > 1 && means[blocks - 2] >= means[blocks - 1]) {
            size_t total = sizes[blocks - 2] + sizes[blocks - 1];
            means[blocks - 2] = (means[blocks - 2] * (double)sizes[blocks - 2] +
                                 means[blocks - 1] * (double)sizes[blocks - 1]) /
                                (double)total;
            sizes[blocks - 2] = total;
            --blocks;
        }
    }
    double top = high - gap * (double)(count > 0 ? count - 1 : 0);
    size_t i = 0;
    for (size_t b = 0; b < blocks; ++b) {
        double mean = means[b] > top ? top : means[b];
        mean = mean < low ? low : mean;
        for (size_t k = 0; k < sizes[b]; ++k, ++i) {
            places[i] = mean + gap * (double)i;
        }
    }
}

/* A text beside a point, or a group of them that must not touch. Places in px. */
typedef struct label {
    const char *text;
    double from_x, from_y, x, y;
    int ink, leader;
} label;

static void sort_labels(label *labels, size_t count) {
    for (size_t i = 1; i < count; ++i) {
        label moving = labels[i];
        size_t k = i;
        for (; k > 0 && labels[k - 1].y > moving.y; --k) {
            labels[k] = labels[k - 1];
        }
        labels[k] = moving;
    }
}

/* above: labels move upwards only, so that none covers a curve that leaves below it. */
static void write_labels(const frame *f, label *labels, size_t count, int above, FILE *file) {
    double places[PLOT_NOTES_MAX];
    sort_labels(labels, count);
    for (size_t i = 0; i < count; ++i) {
        places[i] = labels[i].y;
    }
    spread(places, count, LABEL_GAP, above && count > 0 ? places[0] : f->bottom, f->top);
    for (size_t i = 0; i < count; ++i) {
        const label *l = &labels[i];
        const char *color = plot_inks[l->ink].light;
        fprintf(file, "set label \"%s\" at screen %.5f,%.5f left textcolor rgb \"%s\" front\n",
                l->text, l->x / f->width, places[i] / f->height, color);
        if (l->leader) {
            fprintf(file,
                    "set arrow from screen %.5f,%.5f to screen %.5f,%.5f nohead linewidth 0.7 "
                    "linecolor rgb \"%s\"\n",
                    l->from_x / f->width, l->from_y / f->height, (l->x - 3) / f->width,
                    places[i] / f->height, color);
        }
    }
}

/* At the right margin; the name of a curve that ends before it stands at its end. */
static void write_end_labels(const plot_chart *chart, const frame *f, FILE *file) {
    label labels[PLOT_SERIES_MAX];
    size_t count = 0;
    for (size_t i = 0; i < chart->series_count; ++i) {
        const plot_series *series = &chart->series[i];
        size_t last = series->count;
        while (last > 0 && !isfinite(series->y[last - 1])) {
            --last;
        }
        if (last == 0 || !series->text[0]) {
            continue;
        }
        double y = pixel_y(f, chart, series->y[last - 1]);
        double x = pixel_x(f, chart, series->x[last - 1]);
        if (x < f->right - LABEL_INDENT) {
            label at_end = {series->text, x, y, x + LABEL_INDENT / 2, y, series->ink, 0};
            write_labels(f, &at_end, 1, 0, file);
        } else {
            labels[count++] =
                (label){series->text, x + 2, y, f->right + LABEL_INDENT, y, series->ink, 1};
        }
    }
    write_labels(f, labels, count, 0, file);
}

/* Notes with the same x stand in one column beside it. */
static void write_notes(const plot_chart *chart, const frame *f, FILE *file) {
    for (size_t first = 0; first < chart->note_count; ++first) {
        label labels[PLOT_NOTES_MAX];
        size_t count = 0, before = 0;
        while (before < first && chart->notes[before].x != chart->notes[first].x) {
            ++before;
        }
        if (before < first) {
            continue;
        }
        for (size_t i = first; i < chart->note_count; ++i) {
            const plot_note *note = &chart->notes[i];
            if (note->x == chart->notes[first].x) {
                double x = pixel_x(f, chart, note->x), y = pixel_y(f, chart, note->y);
                labels[count++] = (label){note->text, x, y, x + 8, y + 11, note->ink, 0};
            }
        }
        write_labels(f, labels, count, 1, file);
    }
}

static void write_ticks(const plot_axis *axis, const char *name, FILE *file) {
    fprintf(file, "set %stics (", name);
    for (size_t i = 0; i < axis->tick_count; ++i) {
        const plot_tick *tick = &axis->ticks[i];
        fprintf(file, "%s\"%s\" %.9g%s", i > 0 ? ", " : "", tick->text, tick->at,
                tick->minor ? " 1" : "");
    }
    fprintf(file, ")\nset %srange [%.9g:%.9g]\n", name, axis->low, axis->high);
    if (axis->logarithmic) {
        fprintf(file, "set logscale %s\n", name);
    }
}

static void write_bands(const plot_chart *chart, const frame *f, FILE *file) {
    for (size_t i = 0; i < chart->band_count; ++i) {
        const plot_band *band = &chart->bands[i];
        double low = pixel_x(f, chart, band->low);
        fprintf(file, "set label \"%s\" at screen %.5f,%.5f left textcolor rgb \"%s\"\n",
                band->text, (low + 8) / f->width, (f->top + BAND_HEIGHT / 2) / f->height,
                plot_inks[PLOT_INK_TEXT].light);
        if (i > 0) {
            fprintf(file,
                    "set arrow from screen %.5f,%.5f to screen %.5f,%.5f nohead linewidth 1 "
                    "linecolor rgb \"%s\" back\n",
                    low / f->width, f->bottom / f->height, low / f->width,
                    (f->top + BAND_HEIGHT) / f->height, plot_inks[PLOT_INK_AXIS].light);
        }
    }
}

static void write_frame(const plot_chart *chart, const frame *f, FILE *file) {
    const char *text = plot_inks[PLOT_INK_TEXT].light;
    const char *axis = plot_inks[PLOT_INK_AXIS].light;
    const char *grid = plot_inks[PLOT_INK_GRID].light;
    fprintf(file, "set lmargin at screen %.5f\nset rmargin at screen %.5f\n", f->left / f->width,
            f->right / f->width);
    fprintf(file, "set bmargin at screen %.5f\nset tmargin at screen %.5f\n", f->bottom / f->height,
            f->top / f->height);
    fprintf(file, "set border 1 linecolor rgb \"%s\" linewidth 1\n", axis);
    fprintf(file, "set tics nomirror out scale 0.6,0.3 textcolor rgb \"%s\"\n", text);
    fprintf(file, "set grid ytics linecolor rgb \"%s\" linewidth 1 linetype 1\nset ytics scale 0\n",
            grid);
    write_ticks(&chart->x, "x", file);
    write_ticks(&chart->y, "y", file);
    fprintf(file, "set label \"%s\" at screen %.5f,%.5f center textcolor rgb \"%s\"\n",
            chart->x.title, (f->left + f->right) / 2 / f->width, 18 / f->height, text);
    fprintf(file, "set label \"%s%s\" at screen %.5f,%.5f left textcolor rgb \"%s\"\n",
            chart->y.title, chart->condition, 22 / f->width, 1 - 24 / f->height, text);
    if (chart->rule.text) {
        fprintf(file,
                "set arrow from graph 0, first %.9g to graph 1, first %.9g nohead linewidth 1 "
                "dashtype (4,4) linecolor rgb \"%s\" back\n",
                chart->rule.y, chart->rule.y, axis);
        fprintf(file, "set label \"%s\" at screen %.5f,%.5f right textcolor rgb \"%s\"\n",
                chart->rule.text, (f->right - 4) / f->width,
                (pixel_y(f, chart, chart->rule.y) + 9) / f->height, text);
    }
}

static void write_curves(const plot_chart *chart, FILE *file) {
    static const char *const styles[] = {
        [PLOT_LINE] = "lines linewidth 2",
        [PLOT_DASHED] = "lines linewidth 2 dashtype (9,6)",
        [PLOT_STAIRS] = "lines linewidth 1",
        [PLOT_DOTTED] = "lines linewidth 2 dashtype (1,5)",
        [PLOT_DASH_DOT] = "lines linewidth 2 dashtype (9,5,1,5)",
        [PLOT_DISCS] = "points pointtype 7 pointsize 0.7",
        [PLOT_RINGS] = "points pointtype 6 pointsize 0.7 linewidth 1.4",
    };
    fprintf(file, "plot");
    for (size_t i = 0; i < chart->series_count; ++i) {
        const plot_series *series = &chart->series[i];
        fprintf(file, "%s $data%zu using 1:2 with %s linecolor rgb \"%s\" ",
                i > 0 ? ", \\\n    " : "", i, styles[series->style], plot_inks[series->ink].light);
        if (!chart->labels_at_end && series->text[0]) {
            fprintf(file, "title \"%s\"", series->text);
        } else {
            fprintf(file, "notitle");
        }
    }
    fprintf(file, "\n");
}

/* gnuplot takes letters, digits and _ as the name that it puts before the ids in an SVG. */
static void write_terminal(const plot_chart *chart, FILE *file) {
    char name[32];
    snprintf(name, sizeof name, "%s", chart->name);
    for (char *c = name; *c; ++c) {
        *c = *c == '-' ? '_' : *c;
    }
    fprintf(file,
            "set terminal svg size %d,%d enhanced font \"DejaVu Sans,%d\" name \"%s\" rounded "
            "dashlength 1\n",
            chart->width, chart->height, FONT_SIZE, name);
}

static void write_key(const plot_chart *chart, const frame *f, FILE *file) {
    if (chart->key_inside) {
        fprintf(file, "set key at graph 1,0.03 right bottom ");
    } else {
        fprintf(file, "set key at screen %.5f,%.5f left top ", (f->right + KEY_INDENT) / f->width,
                f->top / f->height);
    }
    fprintf(file, "Left reverse samplen 2.2 spacing 1.3 textcolor rgb \"%s\"\n",
            plot_inks[PLOT_INK_TEXT].light);
}

void plot_write_script(const plot_chart *chart, FILE *file) {
    frame f = frame_of(chart);
    fprintf(file,
            "# %s. Made by burnish lobe plot %s; gnuplot 5.4 writes the SVG to standard output.\n",
            chart->title, chart->name);
    write_terminal(chart, file);
    fprintf(file, "set encoding utf8\nset datafile missing \"NaN\"\nset samples 2\n");
    write_frame(chart, &f, file);
    write_bands(chart, &f, file);
    write_notes(chart, &f, file);
    if (chart->labels_at_end) {
        write_end_labels(chart, &f, file);
    } else {
        write_key(chart, &f, file);
    }
    for (size_t i = 0; i < chart->series_count; ++i) {
        const plot_series *series = &chart->series[i];
        fprintf(file, "$data%zu << EOD\n", i);
        for (size_t k = 0; k < series->count; ++k) {
            if (isfinite(series->y[k])) {
                fprintf(file, "%.7g %.7g\n", series->x[k], series->y[k]);
            } else {
                fprintf(file, "%.7g NaN\n", series->x[k]);
            }
        }
        fprintf(file, "EOD\n");
    }
    write_curves(chart, file);
}

void plot_write_data(const plot_chart *chart, FILE *file) {
    fprintf(file, "series,%s,%s\n", chart->x.column, chart->y.column);
    for (size_t i = 0; i < chart->series_count; ++i) {
        const plot_series *series = &chart->series[i];
        for (size_t k = 0; k < series->count; ++k) {
            if (isfinite(series->y[k])) {
                fprintf(file, "%s,%.10g,%.10g\n", series->name, series->x[k], series->y[k]);
            }
        }
    }
}
