/* HarfBuzz, FriBidi and fontconfig are loaded when a label needs them. Linking them would double
 * the start-up time of the program. */
#ifndef TOOL_FONT_LIBRARIES_H
#define TOOL_FONT_LIBRARIES_H

#include <fontconfig/fontconfig.h>
#include <fribidi.h>
#include <hb-ot.h>
#include <hb.h>

#include "burnish/core.h"

/* The functions that are used. */
/* clang-format off */
#define FONT_HARFBUZZ_CALLS(X) \
    X(hb_blob_create_from_file_or_fail) X(hb_blob_destroy) X(hb_buffer_add_utf32) \
    X(hb_buffer_clear_contents) X(hb_buffer_create) X(hb_buffer_destroy) \
    X(hb_buffer_get_glyph_infos) X(hb_buffer_get_glyph_positions) X(hb_buffer_set_direction) \
    X(hb_buffer_set_script) X(hb_draw_funcs_create) X(hb_draw_funcs_destroy) \
    X(hb_draw_funcs_set_cubic_to_func) X(hb_draw_funcs_set_line_to_func) \
    X(hb_draw_funcs_set_move_to_func) X(hb_draw_funcs_set_quadratic_to_func) X(hb_face_create) \
    X(hb_face_destroy) X(hb_face_get_glyph_count) X(hb_face_get_upem) X(hb_font_create) \
    X(hb_font_destroy) X(hb_font_get_glyph_extents) X(hb_font_get_glyph_shape) \
    X(hb_font_get_nominal_glyph) X(hb_font_set_scale) X(hb_ot_metrics_get_position) X(hb_shape) \
    X(hb_unicode_funcs_get_default) X(hb_unicode_general_category) X(hb_unicode_script)
#define FONT_FRIBIDI_CALLS(X) \
    X(fribidi_get_bidi_types) X(fribidi_get_bracket_types) \
    X(fribidi_get_par_embedding_levels_ex)
#define FONT_FONTCONFIG_CALLS(X) \
    X(FcCharSetHasChar) X(FcConfigDestroy) X(FcConfigSubstitute) X(FcDefaultSubstitute) \
    X(FcFontSetDestroy) X(FcFontSort) X(FcInitLoadConfigAndFonts) X(FcNameParse) \
    X(FcPatternDestroy) X(FcPatternGetCharSet) X(FcPatternGetInteger) X(FcPatternGetString)
/* clang-format on */

typedef struct font_library_calls {
#define FONT_POINTER(name) __typeof__(name) *name;
    FONT_HARFBUZZ_CALLS(FONT_POINTER)
    FONT_FRIBIDI_CALLS(FONT_POINTER)
    FONT_FONTCONFIG_CALLS(FONT_POINTER)
#undef FONT_POINTER
} font_library_calls;

/* Set once font_load_libraries has succeeded. */
extern font_library_calls font_calls;

/* Errors: READ if a library or one of its functions is missing. */
burnish_status font_load_libraries(burnish_error *error);

#endif
