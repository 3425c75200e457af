/* System fonts: FriBidi finds directions, fontconfig the font of a character, HarfBuzz the glyphs,
 * their positions and outlines. Outlines are not hinted. */
#include "font/font.h"

#if BURNISH_HAS_FONTS

#include <stdlib.h>
#include <string.h>

#include "font/libraries.h"

const int font_is_available = 1;

enum { CODES_MAX = 512, FACES_MAX = 16, PER_PIXEL = 256 };

typedef struct face {
    hb_font_t *shaper; /* in font units */
    int capital;       /* height of a capital in font units */
    int entry;         /* of the list of fonts */
} face;

struct font {
    burnish_font setter;
    FcConfig *config;
    FcFontSet *list; /* NULL with a file */
    face faces[FACES_MAX];
    int face_count;
    uint32_t missing;
};

/* Characters that are shaped together. */
typedef struct run {
    int start, count, face;
    FriBidiLevel level;
    hb_script_t script;
} run;

/* A line before it is shaped. */
typedef struct line {
    uint32_t codes[CODES_MAX];
    FriBidiLevel levels[CODES_MAX];
    run runs[CODES_MAX];
    int count, run_count;
} line;

/* ---- Faces ---- */

static int capital_height(hb_font_t *shaper, int units) {
    hb_position_t position = 0;
    hb_codepoint_t glyph;
    hb_glyph_extents_t extents;
    if (font_calls.hb_ot_metrics_get_position(shaper, HB_OT_METRICS_TAG_CAP_HEIGHT, &position) &&
        position > units / 4 && position < units) {
        return position;
    }
    if (font_calls.hb_font_get_nominal_glyph(shaper, 'H', &glyph) &&
        font_calls.hb_font_get_glyph_extents(shaper, glyph, &extents) &&
        extents.y_bearing > units / 4) {
        return extents.y_bearing;
    }
    return units * 7 / 10;
}

/* Adds the font of a file. Returns its index, or -1 if it can't be used. */
static int add_face(font *to, const char *path, unsigned index, int entry) {
    hb_blob_t *blob = font_calls.hb_blob_create_from_file_or_fail(path);
    if (!blob || to->face_count == FACES_MAX) {
        font_calls.hb_blob_destroy(blob);
        return -1;
    }
    hb_face_t *opened = font_calls.hb_face_create(blob, index);
    font_calls.hb_blob_destroy(blob);
    const int units = (int)font_calls.hb_face_get_upem(opened);
    if (font_calls.hb_face_get_glyph_count(opened) == 0 || units < 16) {
        font_calls.hb_face_destroy(opened);
        return -1;
    }
    hb_font_t *shaper = font_calls.hb_font_create(opened);
    font_calls.hb_face_destroy(opened);
    font_calls.hb_font_set_scale(shaper, units, units);
    to->faces[to->face_count] = (face){shaper, capital_height(shaper, units), entry};
    return to->face_count++;
}

static int has_glyph(const face *in, uint32_t code) {
    hb_codepoint_t glyph;
    return font_calls.hb_font_get_nominal_glyph(in->shaper, code, &glyph);
}

/* The face of an entry of the list, opened on first use; -1 if it can't be used. */
static int face_of_entry(font *from, int entry) {
    FcChar8 *path;
    int index = 0;
    for (int i = 0; i < from->face_count; ++i) {
        if (from->faces[i].entry == entry) {
            return i;
        }
    }
    FcPattern *pattern = from->list->fonts[entry];
    if (font_calls.FcPatternGetString(pattern, FC_FILE, 0, &path) != FcResultMatch) {
        return -1;
    }
    font_calls.FcPatternGetInteger(pattern, FC_INDEX, 0, &index);
    return add_face(from, (const char *)path, (unsigned)index & 0xFFFF, entry);
}

/* The first face that has the character; else the first face, and the character is missing. */
static int choose_face(font *from, uint32_t code) {
    for (int i = 0; from->list && i < from->list->nfont; ++i) {
        FcCharSet *characters;
        if (font_calls.FcPatternGetCharSet(from->list->fonts[i], FC_CHARSET, 0, &characters) ==
                FcResultMatch &&
            font_calls.FcCharSetHasChar(characters, code)) {
            const int index = face_of_entry(from, i);
            if (index >= 0 && has_glyph(&from->faces[index], code)) {
                return index;
            }
        }
    }
    if (!(from->face_count > 0 && has_glyph(&from->faces[0], code)) && from->missing == 0) {
        from->missing = code;
    }
    return 0;
}

/* ---- Runs ---- */

/* Marks, joiners and blanks belong to the run of the preceding character. */
static int is_follower(uint32_t code) {
    switch (
        font_calls.hb_unicode_general_category(font_calls.hb_unicode_funcs_get_default(), code)) {
    case HB_UNICODE_GENERAL_CATEGORY_FORMAT:
    case HB_UNICODE_GENERAL_CATEGORY_SPACING_MARK:
    case HB_UNICODE_GENERAL_CATEGORY_ENCLOSING_MARK:
    case HB_UNICODE_GENERAL_CATEGORY_NON_SPACING_MARK:
        return 1;
    default:
        return 0;
    }
}

static void read_codes(const char *text, size_t length, line *made) {
    made->count = 0;
    for (size_t at = 0; at < length && made->count < CODES_MAX;) {
        const size_t step = utf8_decode(text + at, length - at, &made->codes[made->count]);
        if (step == 0) {
            made->codes[made->count] = 0xFFFD;
        }
        at += step > 0 ? step : 1;
        ++made->count;
    }
}

/* Unicode's bidirectional algorithm; the first strong character decides the direction of the line.
 */
static void find_levels(line *made) {
    FriBidiCharType types[CODES_MAX];
    FriBidiBracketType brackets[CODES_MAX];
    FriBidiParType direction = FRIBIDI_PAR_ON;
    font_calls.fribidi_get_bidi_types(made->codes, made->count, types);
    font_calls.fribidi_get_bracket_types(made->codes, made->count, types, brackets);
    if (font_calls.fribidi_get_par_embedding_levels_ex(types, brackets, made->count, &direction,
                                                       made->levels) == 0) {
        memset(made->levels, 0, sizeof made->levels);
    }
}

static void find_runs(font *from, line *made) {
    hb_script_t script = HB_SCRIPT_COMMON;
    made->run_count = 0;
    for (int i = 0; i < made->count; ++i) {
        run *last = made->run_count > 0 ? &made->runs[made->run_count - 1] : NULL;
        const uint32_t code = made->codes[i];
        const hb_script_t own =
            font_calls.hb_unicode_script(font_calls.hb_unicode_funcs_get_default(), code);
        const int is_shared =
            own == HB_SCRIPT_COMMON || own == HB_SCRIPT_INHERITED || own == HB_SCRIPT_UNKNOWN;
        const int follows =
            last && (is_follower(code) || (is_shared && has_glyph(&from->faces[last->face], code)));
        const int face_index = follows ? last->face : choose_face(from, code);
        script = is_shared ? script : own;
        if (last && last->face == face_index && last->level == made->levels[i] &&
            (last->script == script || last->script == HB_SCRIPT_COMMON)) {
            last->script = script;
            ++last->count;
        } else {
            made->runs[made->run_count++] = (run){i, 1, face_index, made->levels[i], script};
        }
    }
}

/* Rule L2: from the highest level to the lowest odd one, reverses runs at that level or above. */
static void reorder_runs(line *made) {
    for (int level = FRIBIDI_BIDI_MAX_EXPLICIT_LEVEL + 1; level > 0; --level) {
        for (int i = 0; i < made->run_count; ++i) {
            int end = i;
            while (end < made->run_count && made->runs[end].level >= level) {
                ++end;
            }
            for (int a = i, b = end - 1; a < b; ++a, --b) {
                const run swapped = made->runs[a];
                made->runs[a] = made->runs[b];
                made->runs[b] = swapped;
            }
            i = end > i ? end - 1 : i;
        }
    }
}

/* ---- Glyphs ---- */

/* From font units to 1/256 pixels. */
typedef struct pen {
    burnish_outline_sink *take;
    void *context;
    double x, y; /* of the glyph's origin, in font units */
    double scale;
} pen;

static int32_t to_subpixels(const pen *with, double units) {
    const double value = units * with->scale;
    return (int32_t)(value < 0 ? -(int64_t)(0.5 - value) : (int64_t)(value + 0.5));
}

static void hand_over(const pen *with, burnish_outline_verb verb, const float *points, int count) {
    int32_t scaled[6];
    for (int i = 0; i < count; ++i) {
        scaled[2 * i] = to_subpixels(with, with->x + (double)points[2 * i]);
        scaled[2 * i + 1] = to_subpixels(with, with->y + (double)points[2 * i + 1]);
    }
    with->take(with->context, verb, scaled);
}

static void move_to(hb_draw_funcs_t *functions, void *with, hb_draw_state_t *state, float x,
                    float y, void *unused) {
    (void)functions, (void)state, (void)unused;
    hand_over(with, BURNISH_OUTLINE_MOVE, (const float[2]){x, y}, 1);
}

static void line_to(hb_draw_funcs_t *functions, void *with, hb_draw_state_t *state, float x,
                    float y, void *unused) {
    (void)functions, (void)state, (void)unused;
    hand_over(with, BURNISH_OUTLINE_LINE, (const float[2]){x, y}, 1);
}

static void conic_to(hb_draw_funcs_t *functions, void *with, hb_draw_state_t *state, float ax,
                     float ay, float x, float y, void *unused) {
    (void)functions, (void)state, (void)unused;
    hand_over(with, BURNISH_OUTLINE_CONIC, (const float[4]){ax, ay, x, y}, 2);
}

static void cubic_to(hb_draw_funcs_t *functions, void *with, hb_draw_state_t *state, float ax,
                     float ay, float bx, float by, float x, float y, void *unused) {
    (void)functions, (void)state, (void)unused;
    hand_over(with, BURNISH_OUTLINE_CUBIC, (const float[6]){ax, ay, bx, by, x, y}, 3);
}

static hb_draw_funcs_t *make_draw_functions(void) {
    hb_draw_funcs_t *made = font_calls.hb_draw_funcs_create();
    font_calls.hb_draw_funcs_set_move_to_func(made, move_to, NULL, NULL);
    font_calls.hb_draw_funcs_set_line_to_func(made, line_to, NULL, NULL);
    font_calls.hb_draw_funcs_set_quadratic_to_func(made, conic_to, NULL, NULL);
    font_calls.hb_draw_funcs_set_cubic_to_func(made, cubic_to, NULL, NULL);
    return made;
}

/* Shapes one run and passes its glyphs on. Returns its advance in font units. */
static double set_run(const face *in, const line *of, const run *which, pen *with,
                      hb_draw_funcs_t *functions, hb_buffer_t *buffer) {
    unsigned count = 0;
    double x = 0, y = 0;
    const double start = with->x;
    font_calls.hb_buffer_clear_contents(buffer);
    font_calls.hb_buffer_add_utf32(buffer, of->codes, of->count, (unsigned)which->start,
                                   which->count);
    font_calls.hb_buffer_set_direction(buffer,
                                       which->level % 2 ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
    font_calls.hb_buffer_set_script(buffer, which->script);
    font_calls.hb_shape(in->shaper, buffer, NULL, 0);
    const hb_glyph_info_t *glyphs = font_calls.hb_buffer_get_glyph_infos(buffer, &count);
    const hb_glyph_position_t *positions = font_calls.hb_buffer_get_glyph_positions(buffer, &count);
    for (unsigned i = 0; i < count; ++i) {
        with->x = start + x + positions[i].x_offset;
        with->y = y + positions[i].y_offset;
        if (with->take) {
            font_calls.hb_font_get_glyph_shape(in->shaper, glyphs[i].codepoint, functions, with);
        }
        x += positions[i].x_advance;
        y += positions[i].y_advance;
    }
    return x;
}

static int32_t set_line(void *user_data, const char *text, size_t length, int height,
                        burnish_outline_sink *take, void *context) {
    font *from = user_data;
    line *made = malloc(sizeof *made);
    hb_buffer_t *buffer = font_calls.hb_buffer_create();
    hb_draw_funcs_t *functions = make_draw_functions();
    double pixels = 0; /* in 1/256 */
    if (made) {
        read_codes(text, length, made);
        find_levels(made);
        find_runs(from, made);
        reorder_runs(made);
    }
    for (int i = 0; made && i < made->run_count; ++i) {
        const face *in = &from->faces[made->runs[i].face];
        pen with = {.take = take, .context = context};
        with.scale = (double)height * PER_PIXEL / in->capital;
        with.x = pixels / with.scale;
        pixels += set_run(in, made, &made->runs[i], &with, functions, buffer) * with.scale;
    }
    font_calls.hb_draw_funcs_destroy(functions);
    font_calls.hb_buffer_destroy(buffer);
    free(made);
    return (int32_t)(pixels + 0.5);
}

/* ---- Opening ---- */

/* The system's fonts with outlines, sans-serif first, each that adds characters. */
static void list_fonts(font *to) {
    FcResult result;
    FcPattern *wanted =
        font_calls.FcNameParse((const FcChar8 *)"sans-serif:outline=true:scalable=true");
    to->config = font_calls.FcInitLoadConfigAndFonts();
    if (to->config && wanted) {
        font_calls.FcConfigSubstitute(to->config, wanted, FcMatchPattern);
        font_calls.FcDefaultSubstitute(wanted);
        to->list = font_calls.FcFontSort(to->config, wanted, FcTrue, NULL, &result);
    }
    if (wanted) {
        font_calls.FcPatternDestroy(wanted);
    }
    for (int i = 0; to->list && i < to->list->nfont && to->face_count == 0; ++i) {
        face_of_entry(to, i);
    }
}

burnish_status font_open(const char *file, font **opened, burnish_error *error) {
    *opened = NULL;
    const burnish_status status = font_load_libraries(error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    font *made = calloc(1, sizeof *made);
    if (!made) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for a font");
    }
    if (file) {
        add_face(made, file, 0, 0);
    } else {
        list_fonts(made);
    }
    if (made->face_count == 0) {
        font_close(made);
        return file ? cli_fail(error, BURNISH_STATUS_READ,
                               "--font: \"%.200s\" can't be read as a TrueType or OpenType font; "
                               "name another file",
                               file)
                    : cli_fail(error, BURNISH_STATUS_READ,
                               "no font is installed; name one with --font=FILE");
    }
    made->setter = (burnish_font){set_line, made};
    *opened = made;
    return BURNISH_STATUS_OK;
}

void font_close(font *opened) {
    if (!opened) {
        return;
    }
    for (int i = 0; i < opened->face_count; ++i) {
        font_calls.hb_font_destroy(opened->faces[i].shaper);
    }
    if (opened->list) {
        font_calls.FcFontSetDestroy(opened->list);
    }
    if (opened->config) {
        font_calls.FcConfigDestroy(opened->config);
    }
    free(opened);
}

const burnish_font *font_setter(const font *opened) {
    return opened ? &opened->setter : NULL;
}

uint32_t font_missing(const font *opened) {
    return opened ? opened->missing : 0;
}

#else

const int font_is_available = 0;

burnish_status font_open(const char *file, font **opened, burnish_error *error) {
    (void)file;
    *opened = NULL;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "--font: this program was built without HarfBuzz, FriBidi and fontconfig, "
                    "which fonts need; omit the flag");
}

const burnish_font *font_setter(const font *opened) {
    (void)opened;
    return NULL;
}

uint32_t font_missing(const font *opened) {
    (void)opened;
    return 0;
}

void font_close(font *opened) {
    (void)opened;
}

#endif
