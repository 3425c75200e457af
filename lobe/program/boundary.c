/* `burnish-lobe boundary`: the memory of boundary cosines as C, Verilog memory or CSV. */
#include <ctype.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "program/lobe.h"

typedef enum boundary_form { FORM_C, FORM_PROGMEM, FORM_MEM, FORM_CSV } boundary_form;

typedef struct boundary_settings {
    const char *lobe, *exponents, *word, *name, *output;
    cli_real bits;
    int lambda, rounding, form;
} boundary_settings;

static cli_work work;

static const cli_word form_words[] = {
    {"c", FORM_C}, {"progmem", FORM_PROGMEM}, {"mem", FORM_MEM}, {"csv", FORM_CSV}, {NULL, 0}};
static const cli_word rounding_words[] = {{"nearest", 1 + BURNISH_THEORY_NEAREST},
                                          {"down", 1 + BURNISH_THEORY_DOWN},
                                          {"up", 1 + BURNISH_THEORY_UP},
                                          {NULL, 0}};

#define TARGET(member) .offset = offsetof(boundary_settings, member)

static const cli_flag boundary_flags[] = {
    {.group = "Contents",
     CLI_FLAG("lobe", "LOBE", "such as energy:2, minimax:4, power", cli_flag_text, lobe),
     .default_text = "energy:2",
     .manual = "The lobe, in the words of *LOBES* and *LOBE*. Exponents below its order get the "
               "highest order that they allow."},
    {CLI_FLAG("exponents", "LIST", "numbers and ranges: 10,100 1-1023 10-100:10 2-1024x2",
              cli_flag_text, exponents),
     .default_text = "1-1023",
     .manual = "Exponents, one word each, in this order; see *LOBE TABLE*."},
    {CLI_FLAG("bits", "Q", "threshold 2^-Q, Q >= 1; 0: where the lobe is zero", cli_flag_real,
              bits),
     .default_text = "8", CLI_RANGE(0, 1024),
     .manual = "Threshold: the boundary is the cosine at which the lobe falls to 2^-_Q_; _Q_ is "
               "from 1 to 1024. 0: where the lobe becomes zero."},
    {CLI_SWITCH("lambda", "store 1 - cosine, which keeps its digits for narrow lobes", lambda),
     .manual = "Words hold 1 - cosine instead of the cosine."},
    {.group = "Words",
     CLI_FLAG("format-word", "FORMAT", "UQ0.15: 15 fraction bits; Q0.15: and a sign bit",
              cli_flag_text, word),
     .default_text = "UQ0.15",
     .manual = "Fixed-point format, up to 32 bits: *UQ0.15* has no integer and 15 fraction bits, "
               "*Q0.15* adds a sign bit. Values out of range are clamped: 1 becomes the largest "
               "word of *UQ0.15*."},
    {CLI_FLAG("rounding", "NAME", "rounding of words", cli_flag_word, rounding),
     .default_label = "keeps all visible values", .words = rounding_words,
     .manual = "How words are rounded. The default, down for cosines and up for 1 - cosine, never "
               "cuts a value above the threshold."},
    {.group = "Output",
     CLI_FLAG("as", "NAME", "C array, AVR flash, $readmemh, or table", cli_flag_word, form),
     .default_text = "c",
     .words = form_words,
     .manual =
         "*c* is a C array that compiles alone. *progmem* is one that an AVR keeps in program "
         "memory, with a function _NAME_*_at* that reads an entry on any processor. *mem* is a "
         "file for Verilog's $readmemh, *csv* a table that also has the boundary before "
         "rounding."},
    {CLI_FLAG("name", "NAME", "name of the C array", cli_flag_text, name),
     .default_text = "burnish_boundary", .manual = "Name of the C array."},
    CLI_OUTPUT_FLAG(boundary_settings, NULL),
};

static const cli_example examples[] = {
    {"burnish-lobe boundary -o boundary.c", "a C array"},
    {"burnish-lobe boundary --exponents=1-255 --as=mem -o boundary.mem", "for $readmemh"},
    {"burnish-lobe boundary --exponents=1-255 --as=progmem -o boundary.h", "for an AVR"},
    {"burnish-lobe boundary --lobe=power --lambda --format-word=UQ0.16 --as=csv", "table"},
    {NULL, NULL},
};

const cli_command lobe_boundary_command = {
    .name = "boundary",
    .operand = "",
    .summary = "tables of the cosines below which a lobe is dark",
    .operand_help = "a word per exponent: the cosine below which the lobe need not be computed",
    .manual = "Writes a table with a word for every exponent: the cosine below which the lobe need "
              "not be computed.",
    .operands_max = 0,
    .flags = boundary_flags,
    .flag_count = sizeof boundary_flags / sizeof *boundary_flags,
    .examples = examples,
    .settings_size = sizeof(boundary_settings),
    .work = work,
};

/* The table and its settings. */
typedef struct contents {
    const boundary_settings *settings;
    burnish_theory_memory memory;
    lobe_exponents exponents;
    int64_t *words;
    int consecutive; /* 1: exponents are consecutive integers */
    int width;       /* of a word, in bits */
    const char *stored, *rounding;
    char lobe[LOBE_NAME], format[16], level[CLI_REAL_SIZE + 4];
} contents;

static uint64_t word_bits(const contents *c, size_t i) {
    return (uint64_t)c->words[i] & ((UINT64_C(1) << c->width) - 1);
}

static int word_digits(const contents *c) {
    return (c->width + 3) / 4;
}

/* ---- C ---- */

/* The largest array that GCC for AVR accepts. */
enum { PROGMEM_BYTES_MAX = 32767 };

static int word_storage(const contents *c) {
    return c->width <= 8 ? 8 : c->width <= 16 ? 16 : 32;
}

/* Begins an array of c->exponents.count numbers; `suffix` is appended to its name. */
static void print_array_start(FILE *stream, const contents *c, const char *type,
                              const char *suffix) {
    const int flash = c->settings->form == FORM_PROGMEM;
    fprintf(stream, "static const %s %s%s[%zu]%s = {\n", type, c->settings->name, suffix,
            c->exponents.count, flash ? "\n#ifdef __AVR__\n    PROGMEM\n#endif\n   " : "");
}

/* A function that reads an entry, from program memory on AVR. */
static void print_reader(FILE *stream, const contents *c, const char *type, const char *suffix,
                         const char *read) {
    const char *name = c->settings->name;
    if (c->settings->form == FORM_PROGMEM) {
        fprintf(stream,
                "\nstatic inline %s %s%s_at(uint16_t i) {\n#ifdef __AVR__\n"
                "    return (%s)pgm_read_%s(&%s%s[i]);\n#else\n    return %s%s[i];\n#endif\n}\n",
                type, name, suffix, type, read, name, suffix, name, suffix);
    }
}

static void print_exponent_array(FILE *stream, const contents *c) {
    fprintf(stream, "\n/* The exponents, in the same order. */\n");
    print_array_start(stream, c, "float", "_exponents");
    for (size_t i = 0; i < c->exponents.count; ++i) {
        char text[48];
        snprintf(text, sizeof text, "%.9g", c->exponents.items[i]);
        fprintf(stream, "%s%s%sF,%s", i % 8 == 0 ? "    " : "", text,
                strpbrk(text, ".e") ? "" : ".0",
                i % 8 == 7 || i + 1 == c->exponents.count ? "\n" : " ");
    }
    fprintf(stream, "};\n");
    print_reader(stream, c, "float", "_exponents", "float");
}

static void print_c(FILE *stream, const contents *c) {
    const int storage = word_storage(c);
    char type[16];
    snprintf(type, sizeof type, "%sint%d_t", c->memory.format.is_signed ? "" : "u", storage);
    fprintf(stream,
            "/* Boundary memory of the lobe %s: the %s at which it has fallen to %s.\n"
            " * Words are %s, %d bits, rounded %s: 1 is %" PRIu64 ".%s\n"
            " * Written by burnish %s: burnish-lobe boundary. */\n#include <stdint.h>\n%s\n",
            c->lobe, c->stored, c->level, c->format, c->width, c->rounding,
            UINT64_C(1) << c->memory.format.fraction_bits,
            c->memory.format.integer_bits == 0 ? " It does not fit and is one less." : "",
            burnish_version(),
            c->settings->form == FORM_PROGMEM
                ? "#ifdef __AVR__\n#include <avr/pgmspace.h>\n#endif\n"
                : "");
    if (c->consecutive) {
        fprintf(stream, "/* Entry i belongs to the exponent i + %.0f. */\n", c->exponents.items[0]);
    }
    print_array_start(stream, c, type, "");
    for (size_t i = 0; i < c->exponents.count; ++i) {
        fprintf(stream, "%s%*" PRId64 ",%s", i % 10 == 0 ? "    " : "",
                storage == 8    ? 3
                : storage == 16 ? 5
                                : 10,
                c->words[i], i % 10 == 9 || i + 1 == c->exponents.count ? "\n" : " ");
    }
    fprintf(stream, "};\n");
    print_reader(stream, c, type, "", storage == 8 ? "byte" : storage == 16 ? "word" : "dword");
    if (!c->consecutive) {
        print_exponent_array(stream, c);
    }
}

/* ---- Verilog, CSV ---- */

static void print_mem(FILE *stream, const contents *c) {
    fprintf(stream,
            "// Boundary memory of the lobe %s: the %s at which it has fallen to %s.\n"
            "// %zu words of %d bits, %s, rounded %s. For $readmemh.\n"
            "// Written by burnish %s: burnish-lobe boundary.\n@0\n",
            c->lobe, c->stored, c->level, c->exponents.count, c->width, c->format, c->rounding,
            burnish_version());
    for (size_t i = 0; i < c->exponents.count; ++i) {
        char number[CLI_REAL_SIZE];
        fprintf(stream, "%0*" PRIx64 " // n = %s\n", word_digits(c), word_bits(c, i),
                cli_shortest(c->exponents.items[i], number));
    }
}

/* The boundary before rounding; NaN where the exponent has no such lobe, which then has a lower
 * order in the memory. */
static double exact_boundary(const contents *c, double exponent) {
    burnish_theory_model model;
    burnish_lobe_spec lower = c->memory.lobe;
    burnish_lobe_status status = burnish_theory_model_create(&model, &lower, exponent);
    while (status == BURNISH_LOBE_ERROR_ORDER_FOR_EXPONENT && lower.order > 2) {
        lower.order /= 2;
        status = burnish_theory_model_create(&model, &lower, exponent);
    }
    if (status != BURNISH_LOBE_OK) {
        return NAN;
    }
    return c->memory.lambda ? burnish_theory_boundary_lambda(&model, c->memory.bits)
                            : burnish_theory_boundary_cosine(&model, c->memory.bits);
}

static void print_csv(FILE *stream, const contents *c) {
    fprintf(stream, "exponent,word,hex,value,%s\n", c->memory.lambda ? "lambda" : "cosine");
    for (size_t i = 0; i < c->exponents.count; ++i) {
        char number[3][CLI_REAL_SIZE];
        double n = c->exponents.items[i];
        fprintf(
            stream, "%s,%" PRId64 ",%0*" PRIx64 ",%s,%s\n", cli_shortest(n, number[0]), c->words[i],
            word_digits(c), word_bits(c, i),
            cli_shortest(burnish_theory_format_decode(&c->memory.format, c->words[i]), number[1]),
            cli_shortest(exact_boundary(c, n), number[2]));
    }
}

static burnish_status print(const contents *c, burnish_error *error) {
    cli_output output;
    burnish_status status = cli_output_begin(&output, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    switch ((boundary_form)c->settings->form) {
    case FORM_C:
    case FORM_PROGMEM:
        print_c(output.stream, c);
        break;
    case FORM_MEM:
        print_mem(output.stream, c);
        break;
    case FORM_CSV:
        print_csv(output.stream, c);
        break;
    }
    return cli_output_end(&output, c->settings->output, BURNISH_STATUS_OK, error);
}

/* ---- Settings ---- */

static burnish_status check_name(const char *name, burnish_error *error) {
    int good = isalpha((unsigned char)*name) || *name == '_';
    for (const char *c = name; *c; ++c) {
        good = good && (isalnum((unsigned char)*c) || *c == '_');
    }
    return good && strlen(name) < 128
               ? BURNISH_STATUS_OK
               : cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--name: \"%.60s\" is not a name in C: letters, digits and _", name);
}

static burnish_status read_model(const char *text, contents *c, burnish_error *error) {
    lobe_names names;
    burnish_theory_model model;
    burnish_status status = lobe_read_lobes("lobe", text, &names, error);
    if (status == BURNISH_STATUS_OK && names.count != 1) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--lobe: \"%.60s\" is %zu lobes; a memory holds one", text, names.count);
    }
    if (status == BURNISH_STATUS_OK) {
        strcpy(c->lobe, names.items[0]);
        status = burnish_theory_model_parse(c->lobe, 65536, &model, error);
        c->memory.lobe = model.lobe;
    }
    return status;
}

/* Whether the arrays of progmem are small enough. */
static burnish_status check_size(const contents *c, burnish_error *error) {
    const size_t bytes = c->consecutive ? (size_t)word_storage(c) / 8 : sizeof(float);
    if (c->settings->form == FORM_PROGMEM && c->exponents.count > PROGMEM_BYTES_MAX / bytes) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--as=progmem: %zu numbers of %zu bytes; an array on AVR has at most %d "
                        "bytes: give fewer --exponents",
                        c->exponents.count, bytes, PROGMEM_BYTES_MAX);
    }
    return BURNISH_STATUS_OK;
}

static burnish_status fill(contents *c, burnish_error *error) {
    const boundary_settings *s = c->settings;
    burnish_error reason;
    char bits[CLI_REAL_SIZE];
    burnish_status status = check_name(s->name, error);
    if (status == BURNISH_STATUS_OK) {
        status = read_model(s->lobe, c, error);
    }
    if (status == BURNISH_STATUS_OK &&
        burnish_theory_format_parse(s->word, &c->memory.format, &reason) != BURNISH_STATUS_OK) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT, "--format-word: %s", reason.text);
    }
    if (status == BURNISH_STATUS_OK) {
        status = lobe_read_exponents("exponents", s->exponents, &c->exponents, error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    c->memory.bits = s->bits.value;
    c->memory.lambda = s->lambda;
    c->memory.rounding = s->rounding > 0 ? (burnish_theory_rounding)(s->rounding - 1)
                         : s->lambda     ? BURNISH_THEORY_UP
                                         : BURNISH_THEORY_DOWN;
    burnish_theory_format_name(&c->memory.format, c->format, sizeof c->format);
    snprintf(c->level, sizeof c->level, "%s%s", s->bits.value == 0 ? "zero" : "2^-",
             s->bits.value == 0 ? "" : cli_shortest(s->bits.value, bits));
    c->width = burnish_theory_format_width(&c->memory.format);
    c->stored = s->lambda ? "value of 1 - cosine" : "cosine";
    c->rounding = rounding_words[c->memory.rounding].name;
    c->consecutive = c->exponents.items[0] == floor(c->exponents.items[0]);
    for (size_t i = 1; i < c->exponents.count; ++i) {
        c->consecutive = c->consecutive && c->exponents.items[i] == c->exponents.items[i - 1] + 1;
    }
    status = check_size(c, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    c->words = calloc(c->exponents.count, sizeof *c->words);
    if (!c->words) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for %zu words",
                        c->exponents.count);
    }
    return burnish_theory_memory_fill(&c->memory, c->exponents.items, c->exponents.count, c->words,
                                      error);
}

static burnish_status work(void *target, cli_call *call, burnish_error *error) {
    contents c = {.settings = target};
    (void)call;
    burnish_status status = fill(&c, error);
    if (status == BURNISH_STATUS_OK) {
        status = print(&c, error);
    }
    free(c.words);
    free(c.exponents.items);
    return status;
}
