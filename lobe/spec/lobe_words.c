/* The words for lobes: "energy:2", "level0.5:4", "zeta6.645:2", "table256:linear" ... */
#include "burnish/lobe_spec.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"

#define DRAWN_WORDS                                                                                \
    "use FIT:ORDER with FIT taylor, energy, levelQ (0 < Q < 1), shift7, shift3, projected, "       \
    "minimax, leastsquares, affine or zetaZ and ORDER 2, 4, 8, 16 or 32, or composite:2 to "       \
    "composite:6, display:5, display:6, lyon:ORDER, power, schlick, gaussian, gx, "                \
    "exact, auto"

/* Whether kernels have the lobe. */
static int is_drawn(burnish_lobe_kind kind) {
    return (unsigned)kind < BURNISH_LOBE_NV2X;
}

/* What follows a word. */
typedef enum { PLAIN, AUTO, ORDER, NUMBER_ORDER, MULTIPLICATIONS, ENTRIES } word_tail;

static const struct word {
    const char *text;
    burnish_lobe_kind kind;
    int which; /* burnish_lobe_fit or burnish_composite_aim */
    word_tail tail;
} WORDS[] = {
    {"taylor", BURNISH_LOBE_FAMILY, BURNISH_FIT_TAYLOR, ORDER},
    {"energy", BURNISH_LOBE_FAMILY, BURNISH_FIT_ENERGY, ORDER},
    {"level", BURNISH_LOBE_FAMILY, BURNISH_FIT_LEVEL, NUMBER_ORDER},
    {"shift7", BURNISH_LOBE_FAMILY, BURNISH_FIT_SHIFT7, ORDER},
    {"shift3", BURNISH_LOBE_FAMILY, BURNISH_FIT_SHIFT3, ORDER},
    {"projected", BURNISH_LOBE_FAMILY, BURNISH_FIT_PROJECTED, ORDER},
    {"minimax", BURNISH_LOBE_FAMILY, BURNISH_FIT_MINIMAX, ORDER},
    {"leastsquares", BURNISH_LOBE_FAMILY, BURNISH_FIT_LEAST_SQUARES, ORDER},
    {"affine", BURNISH_LOBE_FAMILY, BURNISH_FIT_AFFINE, ORDER},
    {"zeta", BURNISH_LOBE_FAMILY, BURNISH_FIT_GIVEN, NUMBER_ORDER},
    {"power", BURNISH_LOBE_POWER, BURNISH_FIT_TAYLOR, PLAIN},
    {"schlick", BURNISH_LOBE_SCHLICK, BURNISH_FIT_TAYLOR, PLAIN},
    {"lyon", BURNISH_LOBE_LYON, BURNISH_FIT_TAYLOR, ORDER},
    {"gaussian", BURNISH_LOBE_GAUSSIAN, BURNISH_FIT_TAYLOR, PLAIN},
    {"gx", BURNISH_LOBE_GX, BURNISH_FIT_TAYLOR, PLAIN},
    {"composite", BURNISH_LOBE_COMPOSITE, BURNISH_COMPOSITE_MINIMAX, MULTIPLICATIONS},
    {"display", BURNISH_LOBE_COMPOSITE, BURNISH_COMPOSITE_DISPLAY, MULTIPLICATIONS},
    {"exact", BURNISH_LOBE_EXACT, BURNISH_FIT_TAYLOR, PLAIN},
    {"auto", BURNISH_LOBE_FAMILY, BURNISH_FIT_ENERGY, AUTO},
    {"nv2x", BURNISH_LOBE_NV2X, BURNISH_FIT_TAYLOR, PLAIN},
    {"kuijk-blake", BURNISH_LOBE_KUIJK_BLAKE, BURNISH_FIT_TAYLOR, PLAIN},
    {"table", BURNISH_LOBE_TABLE, BURNISH_FIT_TAYLOR, ENTRIES},
};

static const char *const EXAMPLES[] = {
    "taylor:2",   "energy:2",    "level0.5:2",     "shift7:2",        "shift3:2",    "projected:2",
    "minimax:2",  "affine:2",    "leastsquares:2", "zeta6.645:2",     "minimax:4",   "minimax:8",
    "minimax:16", "minimax:32",  "power",          "schlick",         "lyon:2",      "gaussian",
    "gx",         "composite:3", "composite:4",    "composite:5",     "composite:6", "display:5",
    "nv2x",       "kuijk-blake", "table256",       "table256:linear",
};

enum {
    WORD_COUNT = sizeof WORDS / sizeof WORDS[0],
    EXAMPLE_COUNT = sizeof EXAMPLES / sizeof EXAMPLES[0],
    DEFAULT_ORDER = 2,
    DEFAULT_MULTIPLICATIONS = 5,
    MAX_DIGITS = 15,  /* a double holds them exactly */
    MAX_DECIMALS = 20 /* and so it does their power of ten */
};

const char *burnish_lobe_spec_example(size_t index) {
    return index < EXAMPLE_COUNT ? EXAMPLES[index] : NULL;
}

/* The row of a lobe, NULL for one without words. */
static const struct word *word_of(const burnish_lobe_spec *lobe) {
    for (int i = 0; i < WORD_COUNT; ++i) {
        const int which = lobe->kind == BURNISH_LOBE_FAMILY      ? (int)lobe->fit
                          : lobe->kind == BURNISH_LOBE_COMPOSITE ? (int)lobe->aim
                                                                 : WORDS[i].which;
        if (WORDS[i].kind == lobe->kind && WORDS[i].which == which) {
            return &WORDS[i];
        }
    }
    return NULL;
}

/* The row whose word the text begins with. */
static const struct word *find_word(const char *text) {
    for (int i = 0; i < WORD_COUNT; ++i) {
        if (strncmp(text, WORDS[i].text, strlen(WORDS[i].text)) == 0) {
            return &WORDS[i];
        }
    }
    return NULL;
}

/* Reads "0.5", ".5" or "256" and moves *text past it; -1 if malformed or too long. */
static double read_number(const char **text) {
    double digits = 0, scale = 1;
    int count = 0, decimals = 0, seen_point = 0, seen_digit = 0;
    for (; (**text >= '0' && **text <= '9') || (**text == '.' && !seen_point); ++*text) {
        if (**text == '.') {
            seen_point = 1;
            continue;
        }
        digits = digits * 10 + (**text - '0');
        scale *= seen_point ? 10 : 1;
        decimals += seen_point;
        count += digits > 0; /* leading zeros are free */
        seen_digit = 1;
    }
    return seen_digit && count <= MAX_DIGITS && decimals <= MAX_DECIMALS ? digits / scale : -1;
}

/* Reads "" (2), ":2", ... ":32" as the end of the text; 0 when malformed. */
static int read_order(const char *text) {
    static const char *const ORDERS[] = {":2", ":4", ":8", ":16", ":32"};
    for (int i = 0; i < 5; ++i) {
        if (strcmp(text, ORDERS[i]) == 0) {
            return 2 << i;
        }
    }
    return *text == 0 ? DEFAULT_ORDER : 0;
}

/* Reads "" (5), ":2", ... ":6" as the end of the text; 0 when malformed. */
static int read_multiplications(const char *text) {
    if (*text == 0) {
        return DEFAULT_MULTIPLICATIONS;
    }
    return text[0] == ':' && text[1] >= '2' && text[1] <= '6' && text[2] == 0 ? text[1] - '0' : 0;
}

/* Reads "" and ":nearest" (0) or ":linear" (1) as the end of the text; -1 when malformed. */
static int read_interpolation(const char *text) {
    if (strcmp(text, ":linear") == 0) {
        return 1;
    }
    return *text == 0 || strcmp(text, ":nearest") == 0 ? 0 : -1;
}

static int read_table(const char *rest, double entries, burnish_lobe_spec *lobe) {
    lobe->linear = read_interpolation(rest);
    if (lobe->linear < 0 || entries < 2 || entries > BURNISH_LOBE_ENTRIES_MAX ||
        entries != (int)entries) {
        return 0;
    }
    lobe->entries = (int)entries;
    return 1;
}

/* What follows a row's word; 0 when malformed. */
static int read_tail(const struct word *word, const char *rest, burnish_lobe_spec *lobe) {
    double number = 0;
    if (word->tail == AUTO) {
        lobe->order = DEFAULT_ORDER;
        lobe->by_material = 1;
    }
    if (word->tail == PLAIN || word->tail == AUTO) {
        return *rest == 0;
    }
    if (word->tail == MULTIPLICATIONS) {
        lobe->order = read_multiplications(rest);
        return lobe->order != 0;
    }
    if (word->tail != ORDER) {
        number = read_number(&rest);
    }
    if (word->tail == ENTRIES) {
        return read_table(rest, number, lobe);
    }
    lobe->parameter = number;
    lobe->order = read_order(rest);
    return number >= 0 && lobe->order != 0;
}

burnish_lobe_spec burnish_lobe_exact(float exponent) {
    enum { MULTIPLICATIONS_MAX = 5, COMPOSITE_LEAST = 8 };
    burnish_lobe_spec lobe = {.kind = BURNISH_LOBE_POWER};
    if (exponent >= COMPOSITE_LEAST) {
        lobe.kind = BURNISH_LOBE_COMPOSITE;
        lobe.aim = BURNISH_COMPOSITE_DISPLAY;
        lobe.order = MULTIPLICATIONS_MAX;
    }
    if (exponent >= 1 && exponent <= BURNISH_LOBE_EXPONENT_MAX &&
        exponent == (float)(unsigned)exponent) {
        int multiplications = -2; /* a squaring per bit, a product per bit that is 1, but one */
        for (unsigned n = (unsigned)exponent; n > 0; n /= 2) {
            multiplications += n % 2 ? 2 : 1;
        }
        if (multiplications <= MULTIPLICATIONS_MAX) {
            lobe =
                (burnish_lobe_spec){.kind = BURNISH_LOBE_INTEGER_POWER, .order = multiplications};
        }
    }
    return lobe;
}

burnish_status burnish_lobe_spec_check(const burnish_lobe_spec *lobe, burnish_error *error) {
    char name[BURNISH_LOBE_NAME_SIZE];
    if (!is_drawn(lobe->kind)) {
        burnish_lobe_spec_name(lobe, name, sizeof name);
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "lobe: \"%s\" can't be drawn; %s", name,
                            DRAWN_WORDS);
    }
    if (lobe->kind == BURNISH_LOBE_COMPOSITE &&
        burnish_composite_check(lobe->aim, lobe->order, 1) != BURNISH_LOBE_OK) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lobe: %d multiplications; composite has 2 to 6, display has 5 or 6",
                            lobe->order);
    }
    if (lobe->kind != BURNISH_LOBE_FAMILY && lobe->kind != BURNISH_LOBE_LYON) {
        return BURNISH_STATUS_OK;
    }
    if (!burnish_lobe_order_is_valid(lobe->order)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lobe: order %d is not 2, 4, 8, 16 or 32", lobe->order);
    }
    if (lobe->kind == BURNISH_LOBE_LYON) {
        return BURNISH_STATUS_OK;
    }
    if ((unsigned)lobe->fit >= BURNISH_FIT_COUNT) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "lobe: unknown fit %d", (int)lobe->fit);
    }
    if (lobe->fit == BURNISH_FIT_LEVEL && !(lobe->parameter > 0 && lobe->parameter < 1)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lobe: level %g is not between 0 and 1, as in level0.5:2",
                            lobe->parameter);
    }
    if (lobe->fit == BURNISH_FIT_GIVEN &&
        !(lobe->parameter > 0 && lobe->parameter <= (double)BURNISH_LOBE_ZETA_MAX)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lobe: zeta %g is not above 0 and at most 65536, as in zeta6.645:2",
                            lobe->parameter);
    }
    if (lobe->order != 2 && (lobe->fit == BURNISH_FIT_SHIFT7 || lobe->fit == BURNISH_FIT_SHIFT3)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lobe: shift7 and shift3 exist for order 2 only");
    }
    return BURNISH_STATUS_OK;
}

static burnish_status parse_lobe(const char *text, int only_drawn, burnish_lobe_spec *lobe,
                                 burnish_error *error) {
    if (!text || !lobe) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "lobe: NULL; pass a text and a lobe");
    }
    const struct word *word = find_word(text);
    burnish_lobe_spec read = {0};
    if (word) {
        read.kind = word->kind;
        read.fit = word->kind == BURNISH_LOBE_FAMILY ? (burnish_lobe_fit)word->which : 0;
        read.aim = word->kind == BURNISH_LOBE_COMPOSITE ? (burnish_composite_aim)word->which : 0;
    }
    if (word && word->tail == ENTRIES && !only_drawn &&
        !read_tail(word, text + strlen(word->text), &read)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "\"%.40s\" is not a table; use tableN or tableN:linear with N from 2 "
                            "to %d",
                            text, BURNISH_LOBE_ENTRIES_MAX);
    }
    const char *rest = word ? text + strlen(word->text) : "";
    if (word && word->tail == MULTIPLICATIONS && *rest == ':' && read_multiplications(rest) == 0) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "\"%.40s\": the multiplications, \"%.20s\", are not 2 to 6, or 5 or 6 "
                            "for display",
                            text, rest + 1);
    }
    if (word && word->tail == ORDER && *rest == ':' && read_order(rest) == 0) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "\"%.40s\": the order, \"%.20s\", is not 2, 4, 8, 16 or 32", text,
                            rest + 1);
    }
    if (!word || !read_tail(word, rest, &read)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "\"%.40s\" is not a lobe; %s%s", text,
                            DRAWN_WORDS, only_drawn ? "" : ", nv2x, kuijk-blake, tableN[:linear]");
    }
    burnish_status status = BURNISH_STATUS_OK;
    if (only_drawn || is_drawn(read.kind)) {
        status = burnish_lobe_spec_check(&read, error);
    }
    if (status == BURNISH_STATUS_OK) {
        *lobe = read;
    }
    return status;
}

burnish_status burnish_lobe_spec_parse(const char *text, burnish_lobe_spec *lobe,
                                       burnish_error *error) {
    return parse_lobe(text, 1, lobe, error);
}

burnish_status burnish_lobe_spec_parse_any(const char *text, burnish_lobe_spec *lobe,
                                           burnish_error *error) {
    return parse_lobe(text, 0, lobe, error);
}

/* A number in [0, 65536] without the locale's decimal point: the shortest that read_number reads
 * back, or truncated to 15 digits, which keeps a level below 1 below 1. */
static void write_number(double x, char *text, size_t size) {
    const double limit = 1e15; /* 10^MAX_DIGITS */
    double scale = 1;
    uint64_t digits = (uint64_t)(x + 0.5);
    int decimals = 0;
    while ((double)digits / scale != x && decimals < MAX_DECIMALS &&
           x * (10 * scale) + 0.5 < limit) {
        scale *= 10;
        digits = (uint64_t)(x * scale + 0.5);
        ++decimals;
    }
    if ((double)digits / scale != x) {
        for (digits = (uint64_t)(x * scale); decimals > 0 && digits % 10 == 0; digits /= 10) {
            --decimals;
        }
    }
    char fraction[MAX_DECIMALS + 2] = ".";
    for (int i = decimals; i > 0; --i, digits /= 10) {
        fraction[i] = (char)('0' + digits % 10);
    }
    snprintf(text, size, "%lu%s", (unsigned long)digits, decimals > 0 ? fraction : "");
}

void burnish_lobe_spec_name(const burnish_lobe_spec *lobe, char *text, size_t size) {
    const struct word *word = word_of(lobe);
    char number[MAX_DECIMALS + 8] = "";
    if (!word) {
        snprintf(text, size, "unknown");
    } else if (lobe->by_material && word->which == BURNISH_FIT_ENERGY &&
               lobe->order == DEFAULT_ORDER) {
        snprintf(text, size, "auto");
    } else if (word->tail == ENTRIES) {
        snprintf(text, size, "%s%d%s", word->text, lobe->entries, lobe->linear ? ":linear" : "");
    } else if (word->tail == PLAIN) {
        snprintf(text, size, "%s", word->text);
    } else {
        if (word->tail == NUMBER_ORDER) {
            write_number(lobe->parameter, number, sizeof number);
        }
        snprintf(text, size, "%s%s:%d", word->text, number, lobe->order);
    }
}
