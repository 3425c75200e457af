/* burnish(1) in roff (man macros), from the same tables as the help screens. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/help.h"
#include "cli/values.h"
#include "lobe/metrics.h"
#include "render/settings.h"

/* When the words below were last changed; part of the page's header. */
#define PAGE_DATE "2026-11-21"

/* Where *bold* and _italics_ begin and end: a mark opens after and closes before what is no letter
 * or digit, so that one inside a word, as in burnish_boundary, stands for itself. */
static int is_mark(const char *text, size_t at, size_t length, char open) {
    char c = text[at];
    char before = at > 0 ? text[at - 1] : ' ', after = at + 1 < length ? text[at + 1] : ' ';
    if (c != '*' && c != '_') {
        return 0;
    }
    return open ? c == open && !isalnum((unsigned char)after)
                : !isalnum((unsigned char)before) && after != ' ';
}

/* Prints text for roff: marks, everything else literally, control lines defused. */
static void print_span(const char *text, size_t length) {
    char open = 0;
    for (size_t i = 0; i < length; ++i) {
        char c = text[i];
        if (is_mark(text, i, length, open)) {
            open = open ? 0 : c;
            fputs(!open ? "\\fR" : c == '*' ? "\\fB" : "\\fI", stdout);
            continue;
        }
        if (i == 0 && (c == '.' || c == '\'')) {
            fputs("\\&", stdout);
        }
        if (c == '\\') {
            fputs("\\e", stdout);
        } else if (c == '^') {
            fputs("\\(ha", stdout);
        } else if (c == '-') {
            fputs("\\-", stdout);
        } else {
            putchar(c);
        }
    }
    putchar('\n');
}

static void print_text(const char *text) {
    print_span(text, strlen(text));
}

/* Paragraphs that newlines separate; the first follows what stands before. */
static void print_paragraphs(const char *text) {
    const char *rest = text;
    while (rest) {
        const char *item;
        size_t length = cli_next_item(&rest, '\n', &item);
        if (item != text) {
            printf(".PP\n");
        }
        print_span(item, length);
    }
}

static void print_tagged(const char *tag, const char *text) {
    printf(".TP\n");
    print_text(tag);
    print_paragraphs(text);
}

static void print_flag(const cli_flag *flag) {
    char tag[160];
    char letter[48] = "";
    if (flag->letter) {
        snprintf(letter, sizeof letter, flag->value ? "*-%c* _%s_, " : "*-%c*%s, ", flag->letter,
                 flag->value ? flag->value : "");
    }
    if (flag->value) {
        snprintf(tag, sizeof tag, "%s*--%s*=_%s_", letter, flag->name, flag->value);
    } else {
        snprintf(tag, sizeof tag, "%s*--%s*", letter, flag->name);
    }
    printf(".TP\n");
    print_text(tag);
    print_text(flag->manual);
    char values[240] = "";
    const char *shown = cli_default_label(flag);
    if (flag->words) {
        strcpy(values, "Values: ");
        cli_word_list(flag->words, values + strlen(values), sizeof values - strlen(values));
    }
    if (flag->words || *shown) {
        char line[320];
        snprintf(line, sizeof line, "%s%s%s%s.", values, flag->words && *shown ? ". " : "",
                 *shown ? "Default: " : "", shown);
        printf(".br\n");
        print_text(line);
    }
}

/* The commands, with those that consist of others opened up, each with its heading. */
static void print_command(const cli_command *command) {
    printf(".SH \"");
    for (const char *c = command->name; *c; ++c) {
        putchar(*c >= 'a' && *c <= 'z' ? *c - 'a' + 'A' : *c);
    }
    printf("\"\n");
    print_paragraphs(command->manual);
    for (size_t i = 0; i < command->flag_count; ++i) {
        if (command->flags[i].group) {
            printf(".SS %s\n", command->flags[i].group);
        }
        print_flag(&command->flags[i]);
    }
    for (size_t i = 0; command->parts && command->parts[i]; ++i) {
        print_command(command->parts[i]);
    }
}

static void print_synopsis(const cli_command *command) {
    char line[160];
    if (command->parts) {
        for (size_t i = 0; command->parts[i]; ++i) {
            print_synopsis(command->parts[i]);
        }
        return;
    }
    if (*command->operand) {
        snprintf(line, sizeof line, "*burnish %s* _%s_ [_options_]", command->name,
                 command->operand);
    } else {
        snprintf(line, sizeof line, "*burnish %s* [_options_]", command->name);
    }
    print_text(line);
    printf(".br\n");
}

static void print_colors(void) {
    printf(".SH COLOURS\n");
    print_text(
        "_COLOR_ is *#rgb* or *#rrggbb* in hexadecimal, *r,g,b* with sRGB values from 0 to 1, or a "
        "name:");
    for (size_t i = 0; cli_color_name(i); ++i) {
        printf("%s%s", i > 0 ? ", " : "", cli_color_name(i));
    }
    printf(".\n");
}

static void print_materials(void) {
    printf(".SH MATERIALS\n");
    print_text(
        "The names of *--material* and what they set. *--specular* and *--exponent* change the "
        "strength and the exponent further.");
    for (size_t i = 0; render_preset_words[i].name; ++i) {
        const render_preset *preset = &render_presets[i];
        char text[200], tag[40];
        snprintf(tag, sizeof tag, "*%s*", preset->name);
        snprintf(text, sizeof text, "%s (ks %g, n %g%s).", preset->what, (double)preset->specular,
                 (double)preset->exponent, preset->tint > 0 ? ", in the surface's colour" : "");
        print_tagged(tag, text);
    }
}

static void print_lobes(void) {
    printf(".SH LOBES\n");
    print_text("The family max(0, 1 + zeta (c - 1))^m needs no pow and no division: c is the "
               "cosine, m the "
               "order, and the fit chooses zeta from the exponent n. _FIT_:_ORDER_ names a member, "
               "_ORDER_ being 2, 4, 8, 16 or 32, and 2 when left out. Where an exponent is too low "
               "for the "
               "order, a lower order is drawn, with a warning.");
    print_tagged("*energy*",
                 "zeta = (n + 1) / (m + 1): the same integral over solid angle as the power.");
    print_tagged("*taylor*", "zeta = n / m: the same value and slope at the centre.");
    print_tagged("*level*_Q_",
                 "meets the power where it is _Q_, between 0 and 1, as in *level0.5:2*.");
    print_tagged("*projected*", "the same cosine-weighted integral as the power.");
    print_tagged("*minimax*", "the least maximum error against the power.");
    print_tagged("*leastsquares*", "the least integral of the squared error over the cosine.");
    print_tagged("*affine*", "like minimax with a peak a little below 1: an error lower by a "
                             "sixth for the same cost.");
    print_tagged("*zeta*_Z_", "that slope for every exponent, as in *zeta6.645:2*.");
    print_tagged("*shift7*, *shift3*", "zeta = 7n/16 and 3n/8, order 2, for integer hardware.");
    print_tagged(
        "*power*, *schlick*, *gaussian*, *gx*, *lyon*:_ORDER_",
        "for comparison: c^n, c / (n - n c + c), exp(-(n + 0.775) (1 - c)), "
        "c^2 / (n/2 + (1 - n/2) c^2), and the taylor fit taken from the chord of vectors that "
        "are nearly of unit length.");
}

static void print_metrics(void) {
    const lobe_metric *metric;
    printf(".SH METRICS\n");
    print_text("The columns of *burnish lobe table*. The groups *shape*, *widths*, *energies*, "
               "*errors* and *cost* are runs of them, *all* is everything. _BITS_ (8 when left "
               "out), _DEG_ (10) and _LENGTH_ (0.9) follow a colon, as in *angle:4*.");
    for (size_t i = 0; (metric = lobe_metric_at(i)) != NULL; ++i) {
        char tag[64];
        snprintf(tag, sizeof tag, "*%s*%s", metric->name,
                 metric->takes == 'q'   ? "[:_BITS_]"
                 : metric->takes == 'a' ? "[:_DEG_]"
                 : metric->takes == 'l' ? "[:_LENGTH_]"
                                        : "");
        print_tagged(tag, metric->what);
    }
}

static void print_lights(void) {
    printf(".SH LIGHTS\n");
    print_text(
        "_SPEC_ is _KIND_:_X_,_Y_,_Z_[:_INTENSITY_[:_COLOR_]] with an intensity from 0 to 1000, 1 "
        "when left out, and a colour, white when left out. Lights have no falloff and cast no "
        "shadows.");
    print_tagged("*directional*",
                 "from the direction _X_,_Y_,_Z_ as the camera sees it: x to the right, y "
                 "up, z toward the viewer.");
    print_tagged("*point*",
                 "at that position as the camera sees it; the unit is the distance from the camera "
                 "to the focal point.");
    print_tagged("*world-directional*, *world-point*", "the same in the scene's coordinates.");
    print_tagged("*none*", "takes away the default rig and every light given before.");
    printf(".PP\n");
    print_text("For example *--light=directional:-1,1,2:0.8:#fff2e0*.");
}

static void print_json(void) {
    printf(".SH \"JSON OUTPUT\"\n");
    print_text("One object. Numbers read back as exactly the values that were used. It is printed "
               "before the picture replaces an older one, so that a report that can't be printed "
               "leaves the older picture.");
    static const char *const keys[][2] = {
        {"burnish", "the version"},
        {"input, format, output", "*output* is null when nothing is written"},
        {"width, height", "of the picture, in pixels"},
        {"triangles, vertices, materials, exponents", "of the mesh after loading"},
        {"bounding_box", "*min* and *max* of the object in the units of the input"},
        {"up, view", "the up axis; the standard view where one was asked for"},
        {"triangles_drawn", "triangles that own at least one sample"},
        {"covered_pixels, pixel_bounds",
         "pixels that show the object; x0, y0, x1, y1, ends excluded"},
        {"camera", "*position*, *focal_point*, *view_up*, *view_angle*, *orthographic_height* (0: "
                   "perspective)"},
        {"lobe, equation, viewer, lights, samples, threads, isa", "as used"},
        {"seconds", "*start* (processor time before loading), *load* (of which *read* and "
                    "*build*), *transform*, *draw*, *encode*, *write*, *total* (from *load* on)"},
        {"hash, hash_algorithm",
         "XXH64 of the pixel bytes, 16 hexadecimal digits: the same on every machine"},
        {"blank", "true when the picture, or a cell, shows nothing"},
        {"warnings", "lines, also with *--quiet*"},
        {"cells", "of a sheet: *row*, *column*, *view*, *width*, *height*, *blank*, *hash*, and "
                  "what depends on view or lobe"},
    };
    for (size_t i = 0; i < sizeof keys / sizeof *keys; ++i) {
        printf(".TP\n.B %s\n", keys[i][0]);
        print_text(keys[i][1]);
    }
}

static void print_exit_status(void) {
    printf(".SH \"EXIT STATUS\"\n");
#define PRINT_CODE(code, text)                                                                     \
    printf(".TP\n.B %d\n", code);                                                                  \
    print_text(text);
#define PRINT_STATUS(name, code, text) PRINT_CODE(code, text)
    BURNISH_STATUS_LIST(PRINT_STATUS)
    CLI_EXIT_LIST(PRINT_CODE)
#undef PRINT_STATUS
#undef PRINT_CODE
    printf(".PP\n");
    print_text(
        "Every failure is one line on standard error, \"burnish: ...\", that says which file or "
        "flag, where in it, what was wrong and what to do. A failed run leaves no part of "
        "a file and no temporary, and an older file as it was.");
}

static void print_example_list(const cli_example *examples) {
    for (const cli_example *example = examples; example && example->command; ++example) {
        printf(".TP\n.B ");
        print_text(example->command);
        print_text(example->what);
    }
}

static void print_examples(void) {
    printf(".SH EXAMPLES\n");
    print_example_list(cli_examples);
    for (size_t i = 0; cli_commands[i]; ++i) {
        const cli_command *command = cli_commands[i];
        for (size_t k = 0; command->parts && command->parts[k]; ++k) {
            print_example_list(command->parts[k]->examples);
        }
    }
}

static void print_environment(void) {
    printf(".SH ENVIRONMENT\n");
    print_tagged("*BURNISH_ISA*",
                 "the instruction set where *--isa* is *auto*: its values, or *auto*.");
    print_tagged("*PATH*", "where *burnish lobe plot* looks for gnuplot.");
    printf(".PP\n");
    print_text("The locale has no influence: numbers are always written with a point.");
}

void cli_print_man(void) {
    printf(
        ".\\\" Made by burnish help --man; do not edit.\n"
        ".TH BURNISH 1 \"%s\" \"burnish %s\" \"User Commands\"\n"
        ".SH NAME\nburnish \\- pictures of meshes without a GPU, the same bits on every machine\n"
        ".SH SYNOPSIS\n",
        PAGE_DATE, burnish_version());
    for (size_t i = 0; cli_commands[i]; ++i) {
        print_synopsis(cli_commands[i]);
    }
    print_text("*burnish* *--help* | *--version*");
    printf(".br\n");
    print_text("*burnish* _COMMAND_ *--help*[*=*_TOPIC_]");
    printf(".SH DESCRIPTION\n");
    print_paragraphs("*burnish* draws a mesh into a PNG: no GPU, no display, no toolkit. Its "
                     "highlights come from a "
                     "family of specular lobes that need neither pow nor division.\n"
                     "The same input and flags give the same pixels on every processor, with every "
                     "compiler and any "
                     "number of threads, so that the hash that *--json* prints can be compared "
                     "between machines.\n"
                     "Every command has *-h* and *--help*: its flags on one screen. Where it has "
                     "many, these are the common ones; *--help=*_TOPIC_ shows the others, "
                     "*--help=all* all of them.");
    for (size_t i = 0; cli_commands[i]; ++i) {
        print_command(cli_commands[i]);
    }
    print_colors();
    print_materials();
    print_lobes();
    print_metrics();
    print_lights();
    print_json();
    print_exit_status();
    print_environment();
    print_examples();
    printf(".SH \"SEE ALSO\"\n.BR man (1),\n.BR xxhsum (1)\n");
}
