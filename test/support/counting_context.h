/* For tests: a context that counts calls, and fails allocations or cancels on demand; and
 * floating-point environments. */
#ifndef BURNISH_TEST_COUNTING_CONTEXT_H
#define BURNISH_TEST_COUNTING_CONTEXT_H

#include <fenv.h>
#include <stdatomic.h>

#include "burnish/core.h"
#include "burnish/mesh.h"
#include "support.h"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

/* The counts of a test's context. */
typedef struct counts {
    atomic_long left;    /* allocations before one fails; negative: none does */
    atomic_long live;    /* allocated and not released */
    long asked;          /* whether to cancel */
    long questions;      /* before the one answered with yes; negative: never */
    burnish_stage stage; /* of the last progress, and its ... */
    double fraction;
    int wrong_order;
    int lines; /* of the log, and ... */
    char last_line[480];
} counts;

static inline void *count_allocate(void *user_data, size_t size, size_t alignment) {
    counts *c = user_data;
    if (atomic_load(&c->left) >= 0 && atomic_fetch_sub(&c->left, 1) == 0) {
        return NULL;
    }
    atomic_fetch_add(&c->live, 1);
    return aligned_alloc(alignment, size);
}

static inline void count_release(void *user_data, void *memory) {
    atomic_fetch_sub(&((counts *)user_data)->live, 1);
    free(memory);
}

static inline int count_cancelled(void *user_data) {
    counts *c = user_data;
    ++c->asked;
    return c->questions >= 0 && c->questions-- == 0;
}

static inline void count_progress(void *user_data, burnish_stage stage, double fraction) {
    counts *c = user_data;
    c->wrong_order |= stage < c->stage || fraction < 0 || fraction > 1 ||
                      (stage == c->stage && fraction < c->fraction);
    c->stage = stage;
    c->fraction = fraction;
}

static inline void count_line(void *user_data, const char *line) {
    counts *c = user_data;
    snprintf(c->last_line, sizeof c->last_line, "%s", line);
    ++c->lines;
}

static inline burnish_context *make_context(counts *c) {
    burnish_context_options options = burnish_context_options_default();
    burnish_context *context = NULL;
    *c = (counts){.left = -1, .questions = -1};
    options.allocator = (burnish_allocator){count_allocate, count_release, c};
    options.cancelled = count_cancelled;
    options.progress = count_progress;
    options.log = count_line;
    options.cancelled_user_data = options.progress_user_data = options.log_user_data = c;
    CHECK1(burnish_context_create(&options, &context, NULL) == BURNISH_STATUS_OK);
    return context;
}

/* A call that works by the context. *hash: of what was made. */
typedef burnish_status stopped_call(const burnish_context *context, const void *data,
                                    uint64_t *hash, burnish_error *error);

/* Calls again and again until nothing stops it: each time a later allocation fails, then a later
 * question is answered with yes. It says so, or makes the same, and no memory is lost. Returns the
 * failures of allocations; *cancelled: how often it was cancelled. */
static inline int check_stops(stopped_call *call, const void *data, int *cancelled) {
    counts c;
    burnish_context *context = make_context(&c);
    burnish_error error = {0};
    int stops[2] = {0, 0};
    uint64_t expected = 0, hash;
    CHECK_OK(call(context, data, &expected, &error), error);
    const long before = atomic_load(&c.live);
    for (int cancels = 0; cancels < 2; ++cancels) {
        burnish_status status = BURNISH_STATUS_MEMORY;
        for (long k = 0; status != BURNISH_STATUS_OK && k < 2000; ++k) {
            error = (burnish_error){0};
            atomic_store(&c.left, cancels ? -1 : k);
            c.questions = cancels ? k : -1;
            status = call(context, data, &hash, &error);
            atomic_store(&c.left, -1);
            stops[cancels] += status != BURNISH_STATUS_OK;
            CHECK(status == BURNISH_STATUS_OK
                      ? hash == expected
                      : status == (cancels ? BURNISH_STATUS_CANCELLED : BURNISH_STATUS_MEMORY) &&
                            error.status == status && *error.text,
                  "stop %ld: status %d, \"%s\"", k, (int)status, error.text);
            CHECK(atomic_load(&c.live) == before, "stop %ld: %ld blocks are lost", k,
                  atomic_load(&c.live) - before);
        }
        CHECK1(status == BURNISH_STATUS_OK);
    }
    burnish_context_destroy(context);
    CHECK1(atomic_load(&c.live) == 0);
    *cancelled = stops[1];
    return stops[0];
}

/* Makes a mesh with options->context; *mesh is NULL on failure. */
typedef burnish_status mesh_maker(const void *data, const burnish_load_options *options,
                                  burnish_mesh **mesh, burnish_error *error);

/* Makes a mesh again and again until nothing stops it: each time a later allocation fails or, with
 * `cancels`, a later question is answered with yes. Every failure has its status and a message, and
 * no memory is lost. */
static inline void check_failures(mesh_maker *make, const void *data, int threads, int cancels) {
    const burnish_status expected = cancels ? BURNISH_STATUS_CANCELLED : BURNISH_STATUS_MEMORY;
    burnish_load_options options = burnish_load_options_default();
    counts c;
    burnish_context *context = make_context(&c);
    const long before = atomic_load(&c.live);
    long k = 0, failures = 0;
    options.context = context;
    options.threads = threads;
    for (int is_stopped = 1; is_stopped && k < 1000; ++k) {
        burnish_mesh *mesh = NULL;
        burnish_error error = {0};
        c.questions = cancels ? k : -1;
        c.stage = BURNISH_STAGE_READ;
        c.fraction = 0;
        atomic_store(&c.left, cancels ? -1 : k);
        const burnish_status status = make(data, &options, &mesh, &error);
        is_stopped = cancels ? status != BURNISH_STATUS_OK : atomic_load(&c.left) < 0;
        atomic_store(&c.left, -1);
        failures += status != BURNISH_STATUS_OK;
        CHECK(status == BURNISH_STATUS_OK /* a chunk of text is tried again */
                  ? mesh && (!cancels || (c.stage == BURNISH_STAGE_BUILD && c.fraction == 1))
                  : status == expected && error.status == status && *error.text && !mesh,
              "failure %ld: status %d, \"%s\"", k, (int)status, error.text);
        burnish_mesh_destroy(mesh);
        CHECK(atomic_load(&c.live) == before, "failure %ld: %ld blocks are lost", k,
              atomic_load(&c.live) - before);
    }
    CHECK(failures > 5 && k < 1000 && !c.wrong_order, "%ld failures", failures);
    burnish_context_destroy(context);
}

/* The caller's mode, without the flags of exceptions. */
static inline unsigned control_bits(void) {
#if defined(__SSE2__)
    return _mm_getcsr() & 0xffc0u;
#else
    return (unsigned)fegetround();
#endif
}

/* Mode 0: as it should be; [1, 8): other roundings, and with 4 no subnormal numbers. */
static inline void set_mode(int mode) {
    static const int roundings[] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    fesetround(roundings[mode & 3]);
#if defined(__SSE2__)
    _mm_setcsr((_mm_getcsr() & ~0x8040u) | (mode & 4 ? 0x8040u : 0)); /* FTZ and DAZ */
#endif
}

#endif
