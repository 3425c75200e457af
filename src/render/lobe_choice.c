/* The words for lobes: "energy:2", "level0.5:4", "power" ... */
#include <stdio.h>
#include <string.h>

#include "burnish/render.h"
#include "core/error.h"
#include "render/materials.h"

static const struct fit_word {
    const char *word;
    burnish_lobe_fit fit;
} FIT_WORDS[] = {
    {"taylor", BURNISH_FIT_TAYLOR}, {"energy", BURNISH_FIT_ENERGY},
    {"level", BURNISH_FIT_LEVEL},   {"shift7", BURNISH_FIT_SHIFT7},
    {"shift3", BURNISH_FIT_SHIFT3}, {"projected", BURNISH_FIT_PROJECTED},
};

static const struct kind_word {
    const char *word;
    burnish_lobe_kind kind;
} KIND_WORDS[] = {
    {"power", BURNISH_LOBE_POWER}, {"schlick", BURNISH_LOBE_SCHLICK},
    {"lyon", BURNISH_LOBE_LYON},   {"gaussian", BURNISH_LOBE_GAUSSIAN},
    {"gx", BURNISH_LOBE_GX},
};

enum {
    FIT_COUNT = sizeof FIT_WORDS / sizeof FIT_WORDS[0],
    KIND_COUNT = sizeof KIND_WORDS / sizeof KIND_WORDS[0],
    DEFAULT_ORDER = 2,
    MAX_DIGITS = 15 /* a double holds them exactly */
};

static burnish_status fail(const char *text, burnish_error *error) {
    return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                        "\"%.40s\" is not a lobe; use FIT:ORDER with FIT taylor, energy, levelQ "
                        "(0 < Q < 1), shift7, shift3 or projected and ORDER 2, 4, 8, 16 or 32, or "
                        "power, schlick, lyon:ORDER, gaussian, gx",
                        text);
}

static int has_order(const burnish_lobe_choice *choice) {
    return choice->kind == BURNISH_LOBE_FAMILY || choice->kind == BURNISH_LOBE_LYON;
}

/* Reads "0.5" or ".5": at most MAX_DIGITS digits; moves *text behind them. Returns -1 when
 * malformed. */
static double read_fraction(const char **text) {
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

/* Reads "", ":2", ... ":32" as the end of the text. Returns 0 when malformed. */
static int read_order(const char *text, int *order) {
    static const char *const ORDERS[] = {":2", ":4", ":8", ":16", ":32"};
    *order = DEFAULT_ORDER;
    for (int i = 0; i < 5; ++i) {
        if (strcmp(text, ORDERS[i]) == 0) {
            *order = 2 << i;
            return 1;
        }
    }
    return *text == 0;
}

static int read_kind(const char *text, burnish_lobe_choice *choice, const char **rest) {
    for (int i = 0; i < KIND_COUNT; ++i) {
        size_t length = strlen(KIND_WORDS[i].word);
        if (strncmp(text, KIND_WORDS[i].word, length) == 0) {
            choice->kind = KIND_WORDS[i].kind;
            *rest = text + length;
            return 1;
        }
    }
    for (int i = 0; i < FIT_COUNT; ++i) {
        size_t length = strlen(FIT_WORDS[i].word);
        if (strncmp(text, FIT_WORDS[i].word, length) == 0) {
            choice->kind = BURNISH_LOBE_FAMILY;
            choice->fit = FIT_WORDS[i].fit;
            *rest = text + length;
            return 1;
        }
    }
    return 0;
}

burnish_status burnish_lobe_choice_check(const burnish_lobe_choice *choice, burnish_error *error) {
    int order = choice->order;
    if ((unsigned)choice->kind >= BURNISH_LOBE_KIND_COUNT) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "lobe: unknown kind %d",
                            (int)choice->kind);
    }
    if (!has_order(choice)) {
        return BURNISH_STATUS_OK;
    }
    if (order != 2 && order != 4 && order != 8 && order != 16 && order != 32) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lobe: order %d is not 2, 4, 8, 16 or 32", order);
    }
    if (choice->kind == BURNISH_LOBE_LYON) {
        return BURNISH_STATUS_OK;
    }
    if ((unsigned)choice->fit >= BURNISH_FIT_COUNT) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "lobe: unknown fit %d",
                            (int)choice->fit);
    }
    if (choice->fit == BURNISH_FIT_LEVEL && !(choice->level > 0 && choice->level < 1)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lobe: level %g is not between 0 and 1, as in level0.5:2",
                            choice->level);
    }
    if (order != 2 && (choice->fit == BURNISH_FIT_SHIFT7 || choice->fit == BURNISH_FIT_SHIFT3)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "lobe: shift7 and shift3 exist for order 2 only");
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_lobe_choice_parse(const char *text, burnish_lobe_choice *choice,
                                         burnish_error *error) {
    burnish_lobe_choice read = {BURNISH_LOBE_FAMILY, BURNISH_FIT_ENERGY, 0, DEFAULT_ORDER};
    const char *rest;
    if (!text || !choice) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "lobe: NULL; pass a text and a choice");
    }
    if (!read_kind(text, &read, &rest)) {
        return fail(text, error);
    }
    if (read.kind == BURNISH_LOBE_FAMILY && read.fit == BURNISH_FIT_LEVEL) {
        read.level = read_fraction(&rest);
        if (read.level < 0) {
            return fail(text, error);
        }
    }
    if (has_order(&read) ? !read_order(rest, &read.order) : *rest != 0) {
        return fail(text, error);
    }
    burnish_status status = burnish_lobe_choice_check(&read, error);
    if (status == BURNISH_STATUS_OK) {
        *choice = read;
    }
    return status;
}

void burnish_lobe_choice_name(const burnish_lobe_choice *choice, char *text, size_t size) {
    char word[24] = "unknown";
    for (int i = 0; i < KIND_COUNT; ++i) {
        if (choice->kind == KIND_WORDS[i].kind) {
            snprintf(word, sizeof word, "%s", KIND_WORDS[i].word);
        }
    }
    for (int i = 0; choice->kind == BURNISH_LOBE_FAMILY && i < FIT_COUNT; ++i) {
        if (choice->fit == FIT_WORDS[i].fit) {
            snprintf(word, sizeof word, "%s", FIT_WORDS[i].word);
        }
    }
    if (choice->kind == BURNISH_LOBE_FAMILY && choice->fit == BURNISH_FIT_LEVEL) {
        /* 1e-9 steps name every level worth telling apart, without the locale's decimal point */
        unsigned long billionths = (unsigned long)(choice->level * 1e9 + 0.5);
        char digits[16];
        int length = snprintf(digits, sizeof digits, "%09lu", billionths);
        while (length > 1 && digits[length - 1] == '0') {
            digits[--length] = 0;
        }
        snprintf(word, sizeof word, "level0.%s", digits);
    }
    if (has_order(choice)) {
        snprintf(text, size, "%s:%d", word, choice->order);
    } else {
        snprintf(text, size, "%s", word);
    }
}
