#include "mesh/read/gcode/gcode.h"

#include <stdio.h>

#include "base/elementary.h"

enum { POINTS_MOST = 2 * BURNISH_GCODE_POINTS /* kept while reading */ };

/* A line's words: letters with numbers. */
typedef struct words {
    uint32_t given; /* bits of letters */
    double values[26];
} words;

#define BIT(letter) (UINT32_C(1) << ((letter) - 'A'))

size_t burnish_gcode_number(const uint8_t *text, const uint8_t *end, double *value) {
    static const double powers[] = {1,   1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                    1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
    const uint8_t *p = text;
    const int is_negative = p < end && *p == '-';
    uint64_t mantissa = 0;
    int digits = 0, decimals = -1;
    p += p < end && (*p == '-' || *p == '+');
    for (; p < end && ((*p >= '0' && *p <= '9') || (*p == '.' && decimals < 0)); ++p) {
        if (*p == '.') {
            decimals = 0;
        } else if (mantissa < UINT64_C(100000000000000) && decimals < 15) { /* others count as 0 */
            mantissa = 10 * mantissa + (*p - '0');
            decimals += decimals >= 0;
            ++digits;
        } else if (decimals < 0) {
            return 0;
        }
    }
    const double size = (double)mantissa / powers[decimals > 0 ? decimals : 0];
    if (digits == 0 || size >= 1e7) {
        return 0;
    }
    *value = is_negative ? -size : size;
    return (size_t)(p - text);
}

/* ---- Comments ---- */

/* Whether a comment begins with a word; it is moved past it. */
static int skip_word(burnish_token *text, const char *word) {
    const size_t size = strlen(word);
    if (text->size < size || memcmp(text->bytes, word, size) != 0) {
        return 0;
    }
    text->bytes += size;
    text->size -= size;
    return 1;
}

static int read_value(burnish_token text, double *value) {
    while (text.size > 0 && (burnish_is_blank(*text.bytes) || *text.bytes == '=' ||
                             *text.bytes == ':' || *text.bytes == ',')) {
        ++text.bytes;
        --text.size;
    }
    return burnish_gcode_number(text.bytes, text.bytes + text.size, value) > 0;
}

/* A feature by the name that the slicer gives it. The last one stands for further ones. */
static void set_feature(burnish_gcode *g, burnish_token name) {
    char text[BURNISH_NAME_SIZE] = "";
    size_t size = 0;
    while (name.size > 0 && burnish_is_blank(*name.bytes)) {
        ++name.bytes;
        --name.size;
    }
    for (; size < name.size && size < sizeof text - 1; ++size) {
        const uint8_t c = name.bytes[size];
        text[size] = (char)(c >= ' ' && c < 127 ? c : '?');
    }
    uint8_t number = 0;
    while (number < g->feature_count && strcmp(g->features[number], text) != 0) {
        ++number;
    }
    if (number == g->feature_count && number < BURNISH_GCODE_FEATURES) {
        memcpy(g->features[g->feature_count++], text, sizeof text);
    }
    g->feature = number < BURNISH_GCODE_FEATURES ? number : BURNISH_GCODE_FEATURES - 1;
}

/* "#RRGGBB;#RRGGBB": tools keep a colour of a higher rank. */
static void set_colors(burnish_gcode *g, burnish_token text, uint8_t rank) {
    size_t tool = 0;
    uint32_t color = 0;
    for (size_t i = 0, digits = 6; i < text.size && tool < BURNISH_GCODE_TOOLS; ++i) {
        const uint8_t c = text.bytes[i], small = c | 0x20;
        const int is_letter = small >= 'a' && small <= 'f';
        if (c == '#') {
            digits = 0;
        } else if (c == ';' || c == ',') {
            ++tool;
        } else if (digits < 6 && (is_letter || (c >= '0' && c <= '9'))) {
            color = color << 4 | (uint32_t)(is_letter ? small - 'a' + 10 : c - '0');
            if (++digits == 6 && g->colors[tool][3] <= rank) {
                const uint8_t srgb[4] = {(uint8_t)(color >> 16), (uint8_t)(color >> 8),
                                         (uint8_t)color, rank};
                memcpy(g->colors[tool], srgb, sizeof srgb);
            }
        }
    }
}

/* "begin 300x300 12345" and "end", after the name of the format. */
static void read_picture(burnish_gcode *g, burnish_token text, size_t first, size_t end) {
    double width = 0, height = 0;
    const int is_png = *text.bytes == ' ', is_known = is_png || skip_word(&text, "_JPG");
    if (!is_known && text.size > 4 && *text.bytes == '_') {
        g->has_odd_picture = 1;
    } else if (is_known && skip_word(&text, " begin ")) {
        const uint8_t *last = text.bytes + text.size;
        const size_t size = burnish_gcode_number(text.bytes, last, &width);
        if (size > 0 && size < text.size) { /* "x", or a blank */
            burnish_gcode_number(text.bytes + size + 1, last, &height);
        }
        g->in_picture = (burnish_gcode_picture){end, 0, 1};
        if (width > 0 && height > 0) {
            g->in_picture.area = (uint64_t)width * (uint64_t)height;
        }
    } else if (is_known && skip_word(&text, " end") && g->in_picture.first > 0) {
        g->in_picture.end = first;
        if (g->in_picture.area > g->picture.area) {
            g->picture = g->in_picture;
        }
        g->in_picture.first = 0;
    }
}

/* A mark of a layer: what was printed before the first one only prepares the printer. */
static void begin_layer(burnish_gcode *g, size_t is_counted) {
    g->layer_marks += is_counted;
    if (!g->has_begun) {
        g->has_begun = 1;
        g->count = g->line_count = 0;
        g->has_pending = g->feature_count = 0;
        g->is_apart = 1;
        g->layer = 0;
        g->layer_z = 0;
    }
}

static int is_digit_after(burnish_token text, const char *word) {
    return skip_word(&text, word) && text.size > 0 &&
           ((*text.bytes >= '0' && *text.bytes <= '9') || *text.bytes == '-');
}

/* A comment on a line of its own, without the semicolon; from `first` to `end` in the file. */
static void read_comment(burnish_gcode *g, burnish_token text, size_t first, size_t end) {
    double value = 0;
    while (text.size > 0 && burnish_is_blank(*text.bytes)) {
        ++text.bytes;
        --text.size;
    }
    while (text.size > 0 && text.bytes[text.size - 1] <= ' ') {
        --text.size;
    }
    if (skip_word(&text, "TYPE:") || skip_word(&text, "FEATURE:") || skip_word(&text, "feature ")) {
        set_feature(g, text);
    } else if (text.size > 2 && *text.bytes == '\'' &&
               memchr(text.bytes + 1, '\'', text.size - 1)) {
        const uint8_t *quote = memchr(text.bytes + 1, '\'', text.size - 1); /* KISSlicer */
        set_feature(g, (burnish_token){text.bytes + 1, (size_t)(quote - text.bytes) - 1});
    } else if (skip_word(&text, "WIDTH:") || skip_word(&text, "LINE_WIDTH:")) {
        g->width = read_value(text, &value) && value > 0 ? (float)value : 0;
    } else if (skip_word(&text, "HEIGHT:") || skip_word(&text, "LAYER_HEIGHT:") ||
               skip_word(&text, "Layer height:") || skip_word(&text, "layer_height =") ||
               skip_word(&text, "tool H")) {
        g->has_height = read_value(text, &value) && value >= 0.001 && value <= 10;
        g->height = g->has_height ? (float)value : g->height;
    } else if (skip_word(&text, "LAYER_CHANGE") || skip_word(&text, "CHANGE_LAYER") ||
               skip_word(&text, "BEGIN_LAYER") || is_digit_after(text, "LAYER:") ||
               is_digit_after(text, "layer ") || skip_word(&text, "<layer")) {
        begin_layer(g, 1);
    } else if (skip_word(&text, "AFTER_LAYER_CHANGE") || is_digit_after(text, "layer:")) {
        begin_layer(g, 0);
    } else if (skip_word(&text, "filament_diameter =") || skip_word(&text, "filamentDiameters") ||
               skip_word(&text, "filament_diameter:")) {
        g->diameter =
            read_value(text, &value) && value >= 0.5 && value <= 10 ? (float)value : g->diameter;
    } else if (skip_word(&text, "filament_colour =")) {
        set_colors(g, text, 255);
    } else if (skip_word(&text, "extruder_colour =")) { /* if the filament's is not stated */
        set_colors(g, text, 1);
    } else if (skip_word(&text, "thumbnail") && text.size > 0) {
        read_picture(g, text, first, end);
    }
}

/* ---- Moves ---- */

/* The nozzle goes to a point, and filament comes out: of the length `filament`. */
static void extrude(burnish_gcode *g, const double to[3], double filament) {
    if (g->memory->status != BURNISH_STATUS_OK || g->is_over) { /* the rest of an arc */
        return;
    }
    if (g->reader->input->options->thumbnail == BURNISH_THUMBNAIL_ONLY) {
        g->is_over = g->picture.area > 0;
        return;
    }
    const double d[3] = {to[0] - g->at[0], to[1] - g->at[1], to[2] - g->at[2]};
    const float length = (float)burnish_sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const float z = (float)to[2];
    const float rise = z - g->layer_z;
    if (d[2] == 0 && (rise > 0.005F || rise < -0.005F)) { /* a layer, or another object's first */
        if (rise > 0.02F && rise <= 2 && !g->has_height) {
            g->height = rise;
        }
        g->layer += g->layer_z > 0;
        g->layer_z = z;
    }
    burnish_gcode_point point = {{(float)g->at[0], (float)g->at[1], (float)g->at[2]},
                                 g->width,
                                 g->height,
                                 (float)filament,
                                 length,
                                 g->layer,
                                 g->feature,
                                 g->tool,
                                 1};
    if (g->count >= POINTS_MOST) {
        g->status = burnish_gcode_reduce(g, POINTS_MOST / 2);
        g->is_over = g->status != BURNISH_STATUS_OK;
        g->is_apart = 1;
    }
    if (g->feature_count == 0) {
        set_feature(g, (burnish_token){(const uint8_t *)BURNISH_GCODE_OTHER,
                                       sizeof BURNISH_GCODE_OTHER - 1});
        point.feature = g->feature;
    }
    if (g->layer % g->layer_step != 0) {
        g->is_apart = 1;
        return;
    }
    if (g->is_apart) {
        burnish_gcode_add(g, &point);
    }
    for (int k = 0; k < 3; ++k) {
        point.position[k] = (float)to[k];
    }
    point.is_start = 0;
    burnish_gcode_add(g, &point);
    g->is_apart = 0;
}

/* The centre of an arc by its radius: the shorter way around if that is positive. */
static void find_center(const double d[2], double radius, int is_left, double offset[2]) {
    const double squared = d[0] * d[0] + d[1] * d[1];
    const double rest = radius * radius - squared / 4;
    const double height = rest > 0 && squared > 0 ? burnish_sqrt(rest / squared) : 0;
    const double side = is_left == (radius > 0) ? height : -height;
    offset[0] = d[0] / 2 - d[1] * side;
    offset[1] = d[1] / 2 + d[0] * side;
}

/* An arc in the plane of x and y, in steps of 1/96 of a circle and a rest. */
static void move_arc(burnish_gcode *g, const double to[3], double filament, const words *w,
                     int is_left) {
    enum { STEPS = 96 };
    const double cosine = 0.99785892323860345,
                 sine = is_left ? 0.065403129230143062 : -0.065403129230143062;
    const double start[3] = {g->at[0], g->at[1], g->at[2]};
    double offset[2] = {g->unit * w->values['I' - 'A'], g->unit * w->values['J' - 'A']};
    if (w->given & BIT('R')) {
        const double chord[2] = {to[0] - start[0], to[1] - start[1]};
        find_center(chord, g->unit * w->values['R' - 'A'], is_left, offset);
    }
    const double center[2] = {start[0] + offset[0], start[1] + offset[1]};
    const double end[2] = {to[0] - center[0], to[1] - center[1]};
    const int is_circle = end[0] == -offset[0] && end[1] == -offset[1];
    size_t count = 0;
    for (size_t pass = 0, steps = STEPS; pass < 2; ++pass) { /* the first counts */
        double v[2] = {-offset[0], -offset[1]};
        for (count = 0; count < steps; ++count) {
            const double turn = v[0] * end[1] - v[1] * end[0];
            const double along = v[0] * end[0] + v[1] * end[1];
            if (!(is_circle && count == 0) && turn * sine >= 0 &&
                turn * turn <= 0.0043 * along * along && along > 0) { /* within a step */
                break;
            }
            const double next[2] = {v[0] * cosine - v[1] * sine, v[0] * sine + v[1] * cosine};
            const double part = (double)(count + 1) / (double)(steps + 1);
            const double at[3] = {center[0] + next[0], center[1] + next[1],
                                  start[2] + (to[2] - start[2]) * part};
            if (pass == 1) {
                extrude(g, at, filament / (double)(steps + 1));
                memcpy(g->at, at, sizeof at);
            }
            memcpy(v, next, sizeof v);
        }
        steps = count;
    }
    extrude(g, to, filament / (double)(count + 1));
}

static void move(burnish_gcode *g, const words *w, int code) {
    double to[3], filament = 0;
    int is_moving = 0;
    for (int k = 0; k < 3; ++k) {
        const double value = g->unit * w->values['X' - 'A' + k];
        to[k] = !(w->given & BIT('X' + k)) ? g->at[k]
                : g->is_relative           ? g->at[k] + value
                                           : value + g->shift[k];
        is_moving |= to[k] != g->at[k];
    }
    if (w->given & BIT('E')) {
        const double value = g->unit * w->values['E' - 'A'];
        const int is_relative = g->is_relative || g->is_filament_relative;
        filament = is_relative ? value : value - g->filament;
        g->filament = is_relative ? g->filament + value : value;
    }
    g->lengths[g->tool] += filament;
    is_moving |= code >= 20 && (w->given & (BIT('I') | BIT('J'))); /* a circle */
    if (is_moving && filament > 0) {
        ++g->line_count;
        if (code < 20) {
            extrude(g, to, filament);
        } else {
            move_arc(g, to, filament, w, code == 30);
        }
    } else if (is_moving) {
        g->is_apart = 1;
    }
    memcpy(g->at, to, sizeof to);
}

/* G92: other coordinates without a move. */
static void set_position(burnish_gcode *g, const words *w) {
    for (int k = 0; k < 3; ++k) {
        if (w->given & BIT('X' + k)) {
            g->shift[k] = g->at[k] - g->unit * w->values['X' - 'A' + k];
        }
    }
    if (w->given & BIT('E')) {
        g->filament = g->unit * w->values['E' - 'A'];
    }
}

static void run(burnish_gcode *g, uint8_t letter, int code, const words *w) {
    if (letter == 'T') {
        g->tool = (uint8_t)(code / 10 < BURNISH_GCODE_TOOLS ? code / 10 : g->tool);
        return;
    }
    if (letter == 'M') {
        g->is_filament_relative = code == 820 ? 0 : code == 830 ? 1 : g->is_filament_relative;
        return;
    }
    switch (code) {
    case 0:
    case 10:
    case 20:
    case 30:
        move(g, w, code);
        break;
    case 200:
        g->unit = 25.4;
        break;
    case 210:
        g->unit = 1;
        break;
    case 280:
        g->is_apart = 1;
        break;
    case 920:
        set_position(g, w);
        break;
    case 900:
        g->is_relative = 0;
        break;
    case 910:
        g->is_relative = 1;
        break;
    default:
        break;
    }
}

/* ---- Lines ---- */

static void read_words(burnish_gcode *g, const uint8_t *p, const uint8_t *end) {
    words w = {0};
    uint8_t command = 0;
    int code = 0;
    while (p < end) {
        const uint8_t letter = *p & 0xDF;
        double value = 0;
        if (*p == '(') { /* a comment of other machines */
            const uint8_t *close = memchr(p, ')', (size_t)(end - p));
            p = close ? close + 1 : end;
            continue;
        }
        if (*p <= ' ') {
            ++p;
            continue;
        }
        if (letter < 'A' || letter > 'Z') {
            if (command == 'G' && code <= 30 && strchr(".,+-0123456789", *p)) {
                burnish_reader_note(g->reader, &g->odd, p,
                                    "\"%c\" is out of place; the rest of the line was left out",
                                    *p);
            }
            break;
        }
        const size_t size = burnish_gcode_number(p + 1, end, &value);
        p += 1 + size;
        if (!command && letter == 'N' && size > 0) { /* the number of the line */
            continue;
        }
        if (!command) {
            if ((letter != 'G' && letter != 'M' && letter != 'T') || size == 0 || value < 0) {
                return;
            }
            command = letter;
            code = value < 10000 ? (int)(10 * value + 0.5) : 99999;
            continue;
        }
        if (size == 0 && command == 'G' && code <= 30 && strchr("XYZEIJR", letter)) {
            burnish_reader_note(g->reader, &g->odd, p - 1,
                                "%c has no number below 1e7; it was left out", letter);
            while (p<end && * p> ' ') {
                ++p;
            }
        }
        w.given |= size > 0 ? BIT(letter) : 0;
        w.values[letter - 'A'] = value;
    }
    if (command) {
        run(g, command, code, &w);
    }
}

void burnish_gcode_read_lines(burnish_gcode *g, const uint8_t *text, size_t size, size_t offset) {
    const uint8_t *at = text, *last = text + size;
    while (at < last && !g->is_over && g->memory->status == BURNISH_STATUS_OK) {
        const uint8_t *line_end = memchr(at, '\n', (size_t)(last - at));
        const uint8_t *end = line_end ? line_end : last, *first = at;
        const uint8_t *cut = end - at > BURNISH_GCODE_LINE ? at + BURNISH_GCODE_LINE : end;
        while (at < cut && *at <= ' ') {
            ++at;
        }
        if (at < cut && *at == ';') {
            read_comment(g, (burnish_token){at + 1, (size_t)(cut - at) - 1},
                         offset + (size_t)(first - text), offset + (size_t)(end - text));
        } else if (at < cut) {
            read_words(g, at, cut);
        }
        at = end + 1;
    }
}
