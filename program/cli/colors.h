/* Colours and instruction sets as values of flags. */
#ifndef TOOL_CLI_COLORS_H
#define TOOL_CLI_COLORS_H

#include "base/cli/values.h"

typedef struct cli_color {
    int given;
    float srgb[3]; /* [0, 1] */
} cli_color;

cli_handler cli_flag_color; /* of a cli_color */

/* #rgb, #rrggbb, r,g,b in [0, 1] or a name: burnish's own or CSS. Returns 0 for other texts. */
int cli_read_color(const char *text, size_t length, float srgb[3]);

/* The valid forms of a colour, for messages. */
extern const char cli_color_forms[];

/* 8-bit value of an sRGB value in [0, 1]. */
uint8_t cli_color_code(float srgb);

/* The instruction set of --isa=name; "auto" follows BURNISH_ISA. It is not a handler: the default
 * "auto" must not fail if a later flag overrides the variable. */
burnish_status cli_choose_isa(const char *name, burnish_isa *isa, burnish_error *error);

/* The section of the man page about colours. */
extern const cli_section cli_color_section;

#endif
