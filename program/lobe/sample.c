/* `burnish lobe sample`: directions that are distributed like a lobe, as CSV. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "burnish/core.h"
#include "lobe/lobe.h"

typedef enum sample_pattern { PATTERN_RANDOM, PATTERN_STRATIFIED } sample_pattern;

typedef struct sample_settings {
    const char *lobe, *output;
    cli_real exponent;
    uint64_t count, seed;
    int measure, pattern;
} sample_settings;

static cli_work work;

static const cli_word measure_words[] = {{"solid-angle", BURNISH_THEORY_SOLID_ANGLE},
                                         {"cosine", BURNISH_THEORY_COSINE_WEIGHTED},
                                         {NULL, 0}};
static const cli_word pattern_words[] = {
    {"random", PATTERN_RANDOM}, {"stratified", PATTERN_STRATIFIED}, {NULL, 0}};

#define TARGET(member) .offset = offsetof(sample_settings, member)

static const cli_flag sample_flags[] = {
    {.group = "Distribution",
     CLI_FLAG("lobe", "LOBE", "such as energy:2, minimax:4, power", cli_flag_text, lobe),
     .default_text = "energy:2",
     .manual = "The lobe, in the words of *LOBES* and *LOBE*."},
    {CLI_FLAG("exponent", "N", "from 1 to 65536", cli_flag_real, exponent), .default_text = "100",
     CLI_RANGE(1, 65536), .manual = "Exponent of the lobe."},
    {CLI_FLAG("measure", "NAME", "the lobe, or lobe times cosine", cli_flag_word, measure),
     .default_text = "solid-angle", .words = measure_words,
     .manual =
         "*solid-angle* draws directions in proportion to the lobe, *cosine* in proportion to "
         "the lobe times the cosine."},
    {.group = "Samples",
     CLI_FLAG("count", "N", "at most 1e9", cli_flag_count, count),
     .default_text = "1000",
     CLI_RANGE(1, 1e9),
     .manual = "Number of directions, at most 1e9. They are written as they are computed, in "
               "constant memory."},
    {CLI_FLAG("pattern", "NAME", "sampling pattern", cli_flag_word, pattern),
     .default_text = "random", .words = pattern_words,
     .manual = "*random* directions are independent; a longer run begins with the directions of a "
               "shorter one. *stratified* has one direction in each of _N_ equal parts of the "
               "lobe, from the centre outward, turned by the golden angle: less noise for the same "
               "number."},
    {CLI_FLAG("seed", "N", "seed of the random numbers", cli_flag_count, seed), .default_text = "1",
     CLI_RANGE(0, 1e18),
     .manual = "Seed of the SplitMix64 generator: the k-th number, from k = 1, is the mix of seed "
               "+ k 0x9e3779b97f4a7c15, of which the upper 53 bits are used. Direction i, from 0, "
               "uses the numbers 2i+1 and 2i+2. The same seed gives the same directions."},
    CLI_OUTPUT_FLAG(sample_settings, "Output"),
};

static const cli_example examples[] = {
    {"burnish lobe sample --lobe=energy:2 --exponent=50 -o rays.csv", "1000 directions"},
    {"burnish lobe sample --lobe=power --measure=cosine --pattern=stratified --count=64", "evenly"},
    {NULL, NULL},
};

const cli_command lobe_sample_command = {
    .name = "lobe sample",
    .operand = "",
    .summary = "directions distributed like a lobe, with their density",
    .operand_help = "CSV: x,y,z,pdf; the lobe's axis is 0,0,1, the density is per steradian",
    .manual = "Writes unit vectors around 0,0,1 as CSV, one per line: x,y,z and their density per "
              "steradian.",
    .operands_max = 0,
    .flags = sample_flags,
    .flag_count = sizeof sample_flags / sizeof *sample_flags,
    .examples = examples,
    .settings_size = sizeof(sample_settings),
    .work = work,
};

/* Number k of the sequence, in [0, 1). Source: Steele, Lea, Flood 2014, SplitMix64. */
static double uniform(uint64_t seed, uint64_t k) {
    uint64_t z = seed + k * UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    z ^= z >> 31;
    return (double)(z >> 11) * 0x1p-53;
}

#define GOLDEN_TURN 0.38196601125010515 /* (3 - sqrt 5) / 2 */

/* State of the output. */
typedef struct sampler {
    const sample_settings *settings;
    burnish_theory_model model;
    uint64_t next; /* direction */
    int started;
} sampler;

static void draw(const sampler *s, uint64_t i, double direction[3]) {
    double xi[2] = {uniform(s->settings->seed, 2 * i + 1), uniform(s->settings->seed, 2 * i + 2)};
    if (s->settings->pattern == PATTERN_STRATIFIED) {
        /* large xi are near the centre */
        double turn = (double)i * GOLDEN_TURN + uniform(s->settings->seed, 0);
        xi[0] = 1 - ((double)i + xi[0]) / (double)s->settings->count;
        xi[1] = turn - floor(turn);
    }
    burnish_theory_sample_direction(&s->model, (burnish_theory_measure)s->settings->measure, xi,
                                    direction);
}

enum { LINE_MAX_BYTES = 4 * CLI_REAL_SIZE };

/* A burnish_file_source: writes as many whole lines as fit. */
static size_t produce(void *context, char *buffer, size_t size) {
    sampler *s = context;
    size_t used = 0;
    if (!s->started) {
        s->started = 1;
        used = (size_t)snprintf(buffer, size, "x,y,z,pdf\n");
    }
    while (s->next < s->settings->count && size - used >= LINE_MAX_BYTES) {
        char number[4][CLI_REAL_SIZE];
        double direction[3];
        draw(s, s->next++, direction);
        double pdf = burnish_theory_pdf(&s->model, (burnish_theory_measure)s->settings->measure,
                                        direction[2]);
        for (int k = 0; k < 3; ++k) {
            cli_shortest(direction[k], number[k]);
        }
        used += (size_t)snprintf(buffer + used, size - used, "%s,%s,%s,%s\n", number[0], number[1],
                                 number[2], cli_shortest(pdf, number[3]));
    }
    return used;
}

static burnish_status work(void *target, cli_call *call, burnish_error *error) {
    sampler s = {.settings = target};
    burnish_error reason;
    (void)call;
    if (burnish_theory_model_parse(s.settings->lobe, s.settings->exponent.value, &s.model,
                                   &reason) != BURNISH_STATUS_OK) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--lobe: %s", reason.text);
    }
    return burnish_file_write_stream(s.settings->output, produce, &s, error);
}
