/* The glyphs of the stroke font and their flattening into straight strokes. */
#include "image/text/stroke_font.h"

/* clang-format off */
static const burnish_glyph glyphs[BURNISH_GLYPH_DIAMETER + 1 - 32] = {
    [BURNISH_GLYPH_DIAMETER - 32] = {8, 76, 8, 0, {0, 0}, "M0 50B38 12A76 50B38 88A0 50M4 2L72 98"},
    [' ' - 32] = {0, 21, 0, 0, {0, 0}, ""},
    ['!' - 32] = {13, 0, 13, 0, {0, 0}, "M0 100V34D0 1"},
    ['"' - 32] = {10, 22, 10, 0, {0, 0}, "M0 100V72M22 100V72"},
    ['#' - 32] = {7, 64, 7, 0, {34, 66}, "M12 4L24 96M40 4L52 96M4 66H64M0 34H60"},
    ['$' - 32] = {8, 56, 8, 29, {0, 0}, "M54 72B28 92A3 71C3 44 56 57 56 28B28 8A0 29M28 110V-10"},
    ['%' - 32] = {7, 78, 7, 0, {0, 0}, "M0 79B15 58A30 79B15 100A0 79"
                "M48 21B63 0A78 21B63 42A48 21M62 100L16 0"},
    ['&' - 32] = {7, 64, 5, 0, {0, 0}, "M64 0L15 67C4 82 12 100 28 100C45 100 51 81 37 70"
                "L18 56C-8 36 1 0 28 0C48 0 61 16 62 42"},
    ['\'' - 32] = {10, 0, 10, 0, {0, 0}, "M0 100V72"},
    ['(' - 32] = {9, 18, 6, 0, {0, 0}, "M18 112C-6 80 -6 8 18 -24"},
    [')' - 32] = {6, 18, 9, 0, {0, 0}, "M0 112C24 80 24 8 0 -24"},
    ['*' - 32] = {8, 38, 8, 19, {0, 0}, "M19 100V56M0 89L38 67M38 89L0 67"},
    ['+' - 32] = {9, 52, 9, 26, {46, 0}, "M0 46H52M26 20V72"},
    [',' - 32] = {7, 7, 9, 0, {0, 0}, "M7 3L0 -18"},
    ['-' - 32] = {9, 32, 9, 0, {40, 0}, "M0 40H32"},
    ['.' - 32] = {11, 0, 11, 0, {0, 0}, "D0 1"},
    ['/' - 32] = {4, 42, 4, 0, {0, 0}, "M0 -10L42 108"},
    ['0' - 32] = {8, 54, 8, 0, {0, 0}, "M0 70V30B27 0A54 30V70B27 100A0 70M20 37L34 63"},
    ['1' - 32] = {13, 28, 21, 0, {0, 0}, "M0 79L28 100V0"},
    ['2' - 32] = {8, 54, 8, 0, {0, 0}, "M2 74B27 100A52 74C52 50 27 34 0 0H54"},
    ['3' - 32] = {8, 54, 8, 0, {54, 0}, "M3 77B27 100A51 77B28 54H20M28 54A54 27B27 0A0 25"},
    ['4' - 32] = {6, 58, 6, 42, {26, 0}, "M42 0V100L0 26H58"},
    ['5' - 32] = {8, 54, 8, 0, {62, 0}, "M49 100H7L4 53C10 59 18 62 27 62A54 31B27 0A0 23"},
    ['6' - 32] = {8, 54, 8, 0, {60, 0}, "M38 100C20 76 0 54 0 30B27 0A54 30B27 60A0 30"},
    ['7' - 32] = {9, 52, 9, 0, {0, 0}, "M0 100H52L17 0"},
    ['8' - 32] = {8, 54, 8, 0, {54, 0}, "M27 54A3 77B27 100A51 77B27 54A54 27B27 0A0 27B27 54"},
    ['9' - 32] = {8, 54, 8, 0, {40, 0}, "M16 0C34 24 54 46 54 70B27 100A0 70B27 40A54 70"},
    [':' - 32] = {12, 0, 12, 0, {60, 0}, "D0 1D0 60"},
    [';' - 32] = {7, 7, 11, 0, {60, 0}, "D6 60M7 3L0 -18"},
    ['<' - 32] = {9, 50, 9, 0, {46, 0}, "M50 72L0 46L50 20"},
    ['=' - 32] = {9, 52, 9, 0, {32, 60}, "M0 60H52M0 32H52"},
    ['>' - 32] = {9, 50, 9, 0, {46, 0}, "M0 72L50 46L0 20"},
    ['?' - 32] = {7, 48, 7, 23, {0, 0}, "M0 76B24 100A48 75C48 52 23 54 23 30D23 1"},
    ['@' - 32] = {8, 94, 8, 0, {0, 0}, "M68 42B47 66A26 42B47 18A68 42"
                "M68 66V35B81 18A94 36V42B47 100A0 42B47 -16C58 -16 67 -13 75 -7"},
    ['A' - 32] = {2, 66, 2, 0, {32, 0}, "M0 0L33 100L66 0M11 32H55"},
    ['B' - 32] = {13, 56, 9, 0, {54, 0}, "M0 54H31A56 27B29 0H0V100H29A52 77B29 54"},
    ['C' - 32] = {9, 60, 6, 0, {0, 0}, "M60 73B31 100A0 69V31B31 0A60 27"},
    ['D' - 32] = {13, 61, 9, 0, {0, 0}, "M0 0V100H28A61 67V33B28 0H0"},
    ['E' - 32] = {13, 51, 7, 0, {52, 0}, "M51 100H0V0H51M0 52H45"},
    ['F' - 32] = {13, 50, 4, 0, {50, 0}, "M50 100H0V0M0 50H43"},
    ['G' - 32] = {9, 62, 10, 0, {46, 0}, "M60 73B31 100A0 69V31B31 0A62 31V46H36"},
    ['H' - 32] = {13, 61, 13, 0, {52, 0}, "M0 0V100M61 0V100M0 52H61"},
    ['I' - 32] = {13, 0, 13, 0, {0, 0}, "M0 0V100"},
    ['J' - 32] = {4, 38, 11, 0, {0, 0}, "M38 100V27B12 0H0"},
    ['K' - 32] = {13, 59, 3, 0, {0, 0}, "M0 0V100M56 100L0 38M21 61L59 0"},
    ['L' - 32] = {13, 48, 4, 0, {0, 0}, "M0 100V0H48"},
    ['M' - 32] = {13, 72, 13, 0, {0, 0}, "M0 0V100L36 36L72 100V0"},
    ['N' - 32] = {13, 62, 13, 0, {0, 0}, "M0 0V100L62 0V100"},
    ['O' - 32] = {9, 64, 9, 0, {0, 0}, "M0 68V32B32 0A64 32V68B32 100A0 68"},
    ['P' - 32] = {13, 56, 5, 0, {44, 0}, "M0 0V100H29A56 72B29 44H0"},
    ['Q' - 32] = {9, 64, 9, 0, {0, 0}, "M0 68V32B32 0A64 32V68B32 100A0 68M40 24L66 -6"},
    ['R' - 32] = {13, 58, 5, 0, {46, 0}, "M0 0V100H29A55 73B29 46H0M31 46L58 0"},
    ['S' - 32] = {9, 56, 9, 0, {0, 0}, "M53 76B28 100A2 75C2 42 56 59 56 26B28 0A0 25"},
    ['T' - 32] = {4, 60, 4, 30, {0, 0}, "M0 100H60M30 0V100"},
    ['U' - 32] = {11, 60, 11, 0, {0, 0}, "M0 100V30B30 0A60 30V100"},
    ['V' - 32] = {2, 64, 2, 0, {0, 0}, "M0 100L32 0L64 100"},
    ['W' - 32] = {3, 92, 3, 0, {0, 0}, "M0 100L23 0L46 100L69 0L92 100"},
    ['X' - 32] = {3, 60, 3, 0, {0, 0}, "M0 0L60 100M0 100L60 0"},
    ['Y' - 32] = {2, 62, 2, 31, {0, 0}, "M0 100L31 46L62 100M31 46V0"},
    ['Z' - 32] = {7, 57, 7, 0, {0, 0}, "M1 100H56L0 0H57"},
    ['[' - 32] = {11, 18, 6, 0, {0, 0}, "M18 112H0V-24H18"},
    ['\\' - 32] = {4, 42, 4, 0, {0, 0}, "M0 108L42 -10"},
    [']' - 32] = {6, 18, 11, 0, {0, 0}, "M0 112H18V-24H0"},
    ['^' - 32] = {9, 44, 9, 0, {0, 0}, "M0 62L22 100L44 62"},
    ['_' - 32] = {0, 54, 0, 0, {0, 0}, "M0 -16H54"},
    ['`' - 32] = {8, 15, 8, 0, {0, 0}, "M0 104L15 84"},
    ['a' - 32] = {7, 44, 11, 0, {40, 68}, "M3 55C8 64 15 68 23 68A44 48V0"
                "M44 40H21A0 20B21 0C31 0 39 5 44 14"},
    ['b' - 32] = {11, 48, 8, 0, {68, 0}, "M0 100V0M0 42B24 68A48 42V26B24 0A0 26"},
    ['c' - 32] = {8, 45, 5, 0, {68, 0}, "M45 50B24 68A0 43V25B24 0A45 18"},
    ['d' - 32] = {8, 48, 11, 0, {68, 0}, "M48 100V0M48 42B24 68A0 42V26B24 0A48 26"},
    ['e' - 32] = {8, 48, 7, 0, {35, 68}, "M0 35H48V43B24 68A0 43V25B24 0C35 0 42 4 46 12"},
    ['f' - 32] = {4, 34, 2, 12, {68, 0}, "M12 0V78B34 100M0 68H32"},
    ['g' - 32] = {8, 48, 11, 0, {68, 0}, "M48 68V-2B24 -26H7M48 42B24 68A0 42V26B24 0A48 26"},
    ['h' - 32] = {11, 46, 11, 0, {68, 0}, "M0 100V0M0 42B24 68A46 44V0"},
    ['i' - 32] = {11, 0, 11, 0, {68, 0}, "M0 0V68D0 94"},
    ['j' - 32] = {0, 17, 11, 0, {68, 0}, "M17 68V-8B0 -26D17 94"},
    ['k' - 32] = {11, 46, 2, 0, {68, 0}, "M0 0V100M44 68L0 26M15 40L46 0"},
    ['l' - 32] = {11, 17, 5, 0, {68, 0}, "M0 100V18B17 0"},
    ['m' - 32] = {11, 78, 11, 39, {68, 0}, "M0 68V0M0 44B21 68A39 47V0M39 44B60 68A78 47V0"},
    ['n' - 32] = {11, 46, 11, 0, {68, 0}, "M0 68V0M0 42B24 68A46 44V0"},
    ['o' - 32] = {8, 50, 8, 0, {68, 0}, "M0 42V26B25 0A50 26V42B25 68A0 42"},
    ['p' - 32] = {11, 48, 8, 0, {68, 0}, "M0 68V-26M0 42B24 68A48 42V26B24 0A0 26"},
    ['q' - 32] = {8, 48, 11, 0, {68, 0}, "M48 68V-26M48 42B24 68A0 42V26B24 0A48 26"},
    ['r' - 32] = {11, 29, 2, 0, {68, 0}, "M0 68V0M0 40B26 68H29"},
    ['s' - 32] = {7, 43, 7, 0, {68, 0}, "M41 52B22 68A2 51C2 29 43 39 43 17B22 0A0 16"},
    ['t' - 32] = {4, 34, 4, 12, {68, 0}, "M12 92V20B30 0H33M0 68H31"},
    ['u' - 32] = {11, 46, 11, 0, {68, 0}, "M46 68V0M46 26B22 0A0 24V68"},
    ['v' - 32] = {3, 46, 3, 0, {68, 0}, "M0 68L23 0L46 68"},
    ['w' - 32] = {3, 72, 3, 0, {68, 0}, "M0 68L18 0L36 68L54 0L72 68"},
    ['x' - 32] = {4, 44, 4, 0, {68, 0}, "M0 0L44 68M0 68L44 0"},
    ['y' - 32] = {3, 46, 3, 0, {68, 0}, "M0 68L23 0M46 68L20 -10C16 -21 12 -26 4 -26"},
    ['z' - 32] = {7, 43, 7, 0, {68, 0}, "M1 68H42L0 0H43"},
    ['{' - 32] = {6, 26, 6, 0, {44, 0}, "M26 112A13 98V58B0 44A13 30V-10B26 -24"},
    ['|' - 32] = {13, 0, 13, 0, {0, 0}, "M0 112V-24"},
    ['}' - 32] = {6, 26, 6, 0, {44, 0}, "M0 112A13 98V58B26 44A13 30V-10B0 -24"},
    ['~' - 32] = {8, 54, 8, 0, {0, 0}, "M0 38C5 62 18 58 27 47C36 36 49 32 54 56"},
};
/* clang-format on */

/* A dot is a little wider than the pen, or it would look lighter than a stem. */
static const float dot_factor = 1.22F;

/* Control points of a quarter ellipse are this far along its sides: 0.5523 is the circle; a little
 * more gives the fuller curve of technical lettering. */
static const float quarter_factor = 0.575F;

typedef struct point {
    float x, y;
} point;

/* How one direction's units become pixels: knots on whole pixels, and lines between. */
typedef struct axis {
    float units[5], pixels[5];
    int count;
} axis;

typedef struct plotter {
    const burnish_glyph_scale *scale;
    burnish_stroke *strokes;
    size_t count;
    int steps; /* strokes a curve */
    point at;  /* in units */
    axis x_axis, y_axis;
} plotter;

const burnish_glyph *burnish_glyph_find(unsigned char character) {
    return &glyphs[(character >= 32 && character <= BURNISH_GLYPH_DIAMETER ? character : '?') - 32];
}

float burnish_glyph_pixels(const burnish_glyph_scale *scale, int units) {
    return (float)(int)((float)units * scale->unit + 0.5F);
}

/* Knots come in rising order. */
static void add_knot(axis *fit, int units, float pixels) {
    fit->units[fit->count] = (float)units;
    fit->pixels[fit->count++] = pixels;
}

/* Linear between knots, in plain units beyond them. */
static float fit_to_pixels(const axis *fit, float unit, float value) {
    int last = fit->count - 1;
    if (value <= fit->units[0]) {
        return fit->pixels[0] + (value - fit->units[0]) * unit;
    }
    for (int i = 1; i <= last; ++i) {
        if (value <= fit->units[i]) {
            float share = (value - fit->units[i - 1]) / (fit->units[i] - fit->units[i - 1]);
            return fit->pixels[i - 1] + share * (fit->pixels[i] - fit->pixels[i - 1]);
        }
    }
    return fit->pixels[last] + (value - fit->units[last]) * unit;
}

static void fit_axes(plotter *plot, const burnish_glyph *glyph) {
    const burnish_glyph_scale *scale = plot->scale;
    axis *x = &plot->x_axis;
    axis *y = &plot->y_axis;
    add_knot(x, 0, 0);
    if (glyph->stem) {
        add_knot(x, glyph->stem, burnish_glyph_pixels(scale, glyph->stem));
    }
    if (glyph->width) {
        add_knot(x, glyph->width, burnish_glyph_pixels(scale, glyph->width));
    }
    add_knot(y, BURNISH_GLYPH_DESCENDER, -burnish_glyph_pixels(scale, -BURNISH_GLYPH_DESCENDER));
    add_knot(y, 0, 0);
    for (int i = 0; i < 2 && glyph->bars[i]; ++i) {
        add_knot(y, glyph->bars[i], burnish_glyph_pixels(scale, glyph->bars[i]));
    }
    add_knot(y, BURNISH_GLYPH_CAP, burnish_glyph_pixels(scale, BURNISH_GLYPH_CAP));
}

static point to_pixels(const plotter *plot, point p) {
    const burnish_glyph_scale *scale = plot->scale;
    return (point){scale->x + fit_to_pixels(&plot->x_axis, scale->unit, p.x),
                   scale->y - fit_to_pixels(&plot->y_axis, scale->unit, p.y)};
}

static void stroke_to(plotter *plot, point to, float radius) {
    if (plot->count < BURNISH_GLYPH_MAX_STROKES) {
        point a = to_pixels(plot, plot->at);
        point b = to_pixels(plot, to);
        plot->strokes[plot->count++] = (burnish_stroke){a.x, a.y, b.x, b.y, radius};
    }
    plot->at = to;
}

static void curve_to(plotter *plot, point b, point c, point d) {
    point a = plot->at;
    for (int i = 1; i <= plot->steps; ++i) {
        float t = (float)i / (float)plot->steps;
        float s = 1 - t;
        float wa = s * s * s;
        float wb = 3 * s * s * t;
        float wc = 3 * s * t * t;
        float wd = t * t * t;
        point to = {wa * a.x + wb * b.x + wc * c.x + wd * d.x,
                    wa * a.y + wb * b.y + wc * c.y + wd * d.y};
        stroke_to(plot, to, plot->scale->radius);
    }
}

static void quarter_to(plotter *plot, point to, int horizontal) {
    point from = plot->at;
    float dx = (to.x - from.x) * quarter_factor;
    float dy = (to.y - from.y) * quarter_factor;
    if (horizontal) {
        curve_to(plot, (point){from.x + dx, from.y}, (point){to.x, to.y - dy}, to);
    } else {
        curve_to(plot, (point){from.x, from.y + dy}, (point){to.x - dx, to.y}, to);
    }
}

static float read_number(const char **path) {
    const char *c = *path;
    while (*c == ' ') {
        ++c;
    }
    int negative = *c == '-';
    c += negative;
    int value = 0;
    while (*c >= '0' && *c <= '9') {
        value = value * 10 + (*c++ - '0');
    }
    *path = c;
    return (float)(negative ? -value : value);
}

static point read_point(const char **path) {
    float x = read_number(path);
    float y = read_number(path);
    return (point){x, y};
}

static void run_command(plotter *plot, char command, const char **path) {
    const float radius = plot->scale->radius;
    switch (command) {
    case 'M':
        plot->at = read_point(path);
        break;
    case 'L':
        stroke_to(plot, read_point(path), radius);
        break;
    case 'H':
        stroke_to(plot, (point){read_number(path), plot->at.y}, radius);
        break;
    case 'V':
        stroke_to(plot, (point){plot->at.x, read_number(path)}, radius);
        break;
    case 'C': {
        point b = read_point(path);
        point c = read_point(path);
        curve_to(plot, b, c, read_point(path));
        break;
    }
    case 'D':
        plot->at = read_point(path);
        stroke_to(plot, plot->at, radius * dot_factor);
        break;
    default: /* A and B */
        quarter_to(plot, read_point(path), command == 'A');
        break;
    }
}

/* Enough strokes a curve to keep it within about a twentieth of a pixel (capitals up to 270). */
static int curve_steps(float unit) {
    const int least = 6;
    const int most = 48;
    float steps = 5 + unit * 16;
    return steps < (float)most ? (steps > (float)least ? (int)steps : least) : most;
}

size_t burnish_glyph_strokes(const burnish_glyph *glyph, const burnish_glyph_scale *scale,
                             burnish_stroke strokes[BURNISH_GLYPH_MAX_STROKES]) {
    plotter plot = {.scale = scale, .strokes = strokes, .steps = curve_steps(scale->unit)};
    fit_axes(&plot, glyph);
    const char *path = glyph->path;
    while (*path) {
        char command = *path++;
        run_command(&plot, command, &path);
    }
    return plot.count;
}
