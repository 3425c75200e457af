/* The words for lobes: "energy:2", "level0.5:4", "zeta6.645:2", "table256:linear" ... */
#include <stdio.h>
#include <string.h>

#include "core/error.h"
#include "theory/internal.h"

/* What follows a word. */
typedef enum { PLAIN, ORDER, NUMBER_ORDER, ENTRIES } word_tail;

static const struct word {
    const char *text;
    burnish_theory_kind kind;
    burnish_theory_fit fit;
    word_tail tail;
} WORDS[] = {
    {"taylor", BURNISH_THEORY_FAMILY, BURNISH_THEORY_TAYLOR, ORDER},
    {"energy", BURNISH_THEORY_FAMILY, BURNISH_THEORY_ENERGY, ORDER},
    {"level", BURNISH_THEORY_FAMILY, BURNISH_THEORY_LEVEL, NUMBER_ORDER},
    {"shift7", BURNISH_THEORY_FAMILY, BURNISH_THEORY_SHIFT7, ORDER},
    {"shift3", BURNISH_THEORY_FAMILY, BURNISH_THEORY_SHIFT3, ORDER},
    {"projected", BURNISH_THEORY_FAMILY, BURNISH_THEORY_PROJECTED, ORDER},
    {"minimax", BURNISH_THEORY_FAMILY, BURNISH_THEORY_MINIMAX, ORDER},
    {"leastsquares", BURNISH_THEORY_FAMILY, BURNISH_THEORY_LEAST_SQUARES, ORDER},
    {"affine", BURNISH_THEORY_FAMILY, BURNISH_THEORY_AFFINE, ORDER},
    {"zeta", BURNISH_THEORY_FAMILY, BURNISH_THEORY_GIVEN, NUMBER_ORDER},
    {"power", BURNISH_THEORY_POWER, BURNISH_THEORY_TAYLOR, PLAIN},
    {"schlick", BURNISH_THEORY_SCHLICK, BURNISH_THEORY_TAYLOR, PLAIN},
    {"lyon", BURNISH_THEORY_LYON, BURNISH_THEORY_TAYLOR, ORDER},
    {"gaussian", BURNISH_THEORY_GAUSSIAN, BURNISH_THEORY_TAYLOR, PLAIN},
    {"gx", BURNISH_THEORY_GX, BURNISH_THEORY_TAYLOR, PLAIN},
    {"nv2x", BURNISH_THEORY_NV2X, BURNISH_THEORY_TAYLOR, PLAIN},
    {"kuijk-blake", BURNISH_THEORY_KUIJK_BLAKE, BURNISH_THEORY_TAYLOR, PLAIN},
    {"table", BURNISH_THEORY_TABLE, BURNISH_THEORY_TAYLOR, ENTRIES},
};

static const char *const EXAMPLES[] = {
    "taylor:2",   "energy:2",   "level0.5:2",     "shift7:2",    "shift3:2",        "projected:2",
    "minimax:2",  "affine:2",   "leastsquares:2", "zeta6.645:2", "minimax:4",       "minimax:8",
    "minimax:16", "minimax:32", "power",          "schlick",     "lyon:2",          "gaussian",
    "gx",         "nv2x",       "kuijk-blake",    "table256",    "table256:linear",
};

enum {
    WORD_COUNT = sizeof WORDS / sizeof WORDS[0],
    EXAMPLE_COUNT = sizeof EXAMPLES / sizeof EXAMPLES[0],
    MAX_DIGITS = 15 /* a double holds them exactly */
};

const char *burnish_theory_model_word(size_t index) {
    return index < EXAMPLE_COUNT ? EXAMPLES[index] : NULL;
}

static burnish_status fail_words(const char *text, burnish_error *error) {
    return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                        "\"%.40s\" is not a lobe; use FIT:ORDER with FIT taylor, energy, levelQ, "
                        "shift7, shift3, projected, minimax, leastsquares, affine or zetaZ and "
                        "ORDER 2, 4, 8, 16 or 32, or lyon:ORDER, power, schlick, gaussian, gx, "
                        "nv2x, kuijk-blake, tableN, tableN:linear",
                        text);
}

/* Reads "0.5", ".5" or "256" and moves *text behind it; -1 when malformed. */
static double read_number(const char **text) {
    double digits = 0, scale = 1;
    int count = 0, seen_point = 0;
    for (; (**text >= '0' && **text <= '9') || (**text == '.' && !seen_point); ++*text) {
        if (**text == '.') {
            seen_point = 1;
            continue;
        }
        digits = digits * 10 + (**text - '0');
        scale *= seen_point ? 10 : 1;
        ++count;
    }
    return count > 0 && count <= MAX_DIGITS ? digits / scale : -1;
}

/* Reads "" (2), ":2", ... ":32" as the end of the text; 0 when malformed. */
static int read_order(const char *text) {
    static const char *const ORDERS[] = {":2", ":4", ":8", ":16", ":32"};
    for (int i = 0; i < 5; ++i) {
        if (strcmp(text, ORDERS[i]) == 0) {
            return 2 << i;
        }
    }
    return *text == 0 ? 2 : 0;
}

static const struct word *find_word(const char *text) {
    for (int i = 0; i < WORD_COUNT; ++i) {
        if (strncmp(text, WORDS[i].text, strlen(WORDS[i].text)) == 0) {
            return &WORDS[i];
        }
    }
    return NULL;
}

/* The end of "tableN": 0 nearest, 1 linear, -1 malformed. */
static int read_interpolation(const char *text) {
    if (strcmp(text, ":linear") == 0) {
        return 1;
    }
    return *text == 0 || strcmp(text, ":nearest") == 0 ? 0 : -1;
}

static burnish_lobe_status make(const struct word *word, double number, int order, int linear,
                                double exponent, burnish_theory_model *model) {
    if (word->kind == BURNISH_THEORY_FAMILY) {
        return burnish_theory_model_family(model, word->fit, order, exponent, number);
    }
    if (word->kind == BURNISH_THEORY_TABLE) {
        return burnish_theory_model_table(model, (int)number, linear, exponent);
    }
    return burnish_theory_model_other(model, word->kind, order, exponent);
}

burnish_status burnish_theory_model_parse(const char *text, double exponent,
                                          burnish_theory_model *model, burnish_error *error) {
    double number = 0;
    int order = 2, linear = 0;
    burnish_theory_model made;
    if (!text || !model) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "lobe: NULL; pass a text and a model");
    }
    const struct word *word = find_word(text);
    if (!word) {
        return fail_words(text, error);
    }
    const char *rest = text + strlen(word->text);
    if (word->tail == NUMBER_ORDER || word->tail == ENTRIES) {
        number = read_number(&rest);
    }
    if (word->tail == ENTRIES) {
        linear = read_interpolation(rest);
        if (linear < 0 || number < 2 || number > BURNISH_THEORY_ENTRIES_MAX ||
            number != (int)number) {
            return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                                "\"%.40s\" is not a table; use tableN or tableN:linear with N from "
                                "2 to %d",
                                text, BURNISH_THEORY_ENTRIES_MAX);
        }
    } else if (word->tail == PLAIN ? *rest != 0 : (order = read_order(rest)) == 0 || number < 0) {
        return fail_words(text, error);
    }
    burnish_lobe_status status = make(word, number, order, linear, exponent, &made);
    if (status != BURNISH_LOBE_OK) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "lobe \"%.40s\" at exponent %g: %s",
                            text, exponent, burnish_lobe_status_text(status));
    }
    *model = made;
    return BURNISH_STATUS_OK;
}

/* A number in [0, 65536] with up to nine decimals and without the locale's decimal point. */
static void write_number(double x, char *text, size_t size) {
    unsigned long long billionths = (unsigned long long)(x * 1e9 + 0.5);
    int length =
        snprintf(text, size, "%llu.%09llu", billionths / 1000000000ull, billionths % 1000000000ull);
    while (length > 0 && length < (int)size && text[length - 1] == '0') {
        text[--length] = 0;
    }
    if (length > 0 && length < (int)size && text[length - 1] == '.') {
        text[length - 1] = 0;
    }
}

void burnish_theory_model_name(const burnish_theory_model *model, char *text, size_t size) {
    const struct word *word = NULL;
    char number[24] = "";
    for (int i = 0; i < WORD_COUNT; ++i) {
        if (WORDS[i].kind == model->kind &&
            (model->kind != BURNISH_THEORY_FAMILY || WORDS[i].fit == model->fit)) {
            word = &WORDS[i];
        }
    }
    if (!word) {
        snprintf(text, size, "unknown");
    } else if (word->tail == ENTRIES) {
        snprintf(text, size, "%s%d%s", word->text, model->entries, model->linear ? ":linear" : "");
    } else if (word->tail == PLAIN) {
        snprintf(text, size, "%s", word->text);
    } else {
        if (word->tail == NUMBER_ORDER) {
            write_number(word->fit == BURNISH_THEORY_GIVEN ? model->zeta : model->level, number,
                         sizeof number);
        }
        snprintf(text, size, "%s%s:%d", word->text, number, model->order);
    }
}
