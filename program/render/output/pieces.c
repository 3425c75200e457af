#include "render/output/pieces.h"

#ifdef _WIN32

burnish_status render_pieces_create(const render_pieces_plan *plan, render_pieces **pieces,
                                    burnish_error *error) {
    (void)plan;
    *pieces = NULL;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "--runners: not supported on this system; omit it");
}

void render_pieces_destroy(render_pieces *pieces) {
    (void)pieces;
}

burnish_status render_pieces_take(render_pieces *pieces, int piece, burnish_error *error) {
    (void)pieces, (void)piece;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "--runners: not supported on this system; omit it");
}

burnish_status render_pieces_serve(const render_pieces_plan *plan, burnish_error *error) {
    (void)plan;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "--runner: not supported on this system; omit it");
}

#else

#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/cli/write.h"
#include "base/clock.h"
#include "sandbox/channel.h"

enum {
    CHANNEL = 3, /* the first socket */
    NOTHING = -1,
    AHEAD = 2,             /* pieces per runner at a time */
    SLOW_SECONDS = 3,      /* until a piece of another process is drawn here, too */
    WINDOW_BYTES = 1 << 30 /* of pieces that wait for their turn */
};

/* A request to a runner; only the piece differs between requests. */
typedef struct order {
    char version[24];
    uint64_t triangles, vertices;
    int32_t width, height, channels, count, piece, unused;
} order;

typedef struct reply {
    int32_t piece, unused;
    uint64_t size;
    uint64_t notes[RENDER_PIECE_NOTES];
} reply;

typedef struct runner {
    int channel; /* NOTHING: gone */
    int pieces[AHEAD];
    double start; /* of the oldest */
} runner;

enum { STATE_FREE, STATE_LENT, STATE_HERE, STATE_TAKEN };

typedef struct slot {
    int state;
    uint8_t *pixels; /* HERE: to be freed */
    uint64_t notes[RENDER_PIECE_NOTES];
} slot;

struct render_pieces {
    render_pieces_plan plan;
    order order;
    size_t size; /* bytes of a piece */
    runner *runners;
    slot *slots; /* of each piece */
    struct pollfd *ready;
    int window; /* pieces that can be in progress or waiting */
};

static order make_order(const render_pieces_plan *plan) {
    order o = {.triangles = plan->triangles,
               .vertices = plan->vertices,
               .width = plan->image->width,
               .height = plan->image->height,
               .channels = plan->image->channels,
               .count = plan->count};
    snprintf(o.version, sizeof o.version, "%s", burnish_version());
    return o;
}

static size_t piece_size(const render_pieces_plan *plan) {
    return (size_t)plan->image->width * (size_t)plan->image->height * (size_t)plan->image->channels;
}

static burnish_status check_socket(const char *flag, int channel, burnish_error *error) {
    struct stat state;
    return fstat(channel, &state) == 0 && S_ISSOCK(state.st_mode)
               ? BURNISH_STATUS_OK
               : cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--%s: descriptor %d is not a socket; burnish-mpi opens it", flag,
                          channel);
}

/* ---- The main process ---- */

burnish_status render_pieces_create(const render_pieces_plan *plan, render_pieces **pieces,
                                    burnish_error *error) {
    render_pieces *f = *pieces = calloc(1, sizeof *f);
    const size_t count = (size_t)plan->runners;
    if (f) {
        f->plan = *plan;
        f->order = make_order(plan);
        f->size = piece_size(plan);
        f->runners = calloc(count + 1, sizeof *f->runners);
        f->ready = calloc(count + 1, sizeof *f->ready);
        f->slots = calloc((size_t)plan->count, sizeof *f->slots);
    }
    burnish_status status =
        f && f->runners && f->ready && f->slots
            ? BURNISH_STATUS_OK
            : cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory: --runners");
    for (int i = 0; i < plan->runners && status == BURNISH_STATUS_OK; ++i) {
        f->runners[i] = (runner){CHANNEL + i, {NOTHING, NOTHING}, 0};
        status = check_socket("runners", CHANNEL + i, error);
    }
    if (status != BURNISH_STATUS_OK) {
        render_pieces_destroy(f);
        *pieces = NULL;
        return status;
    }
    const size_t fit = f->size > 0 ? WINDOW_BYTES / f->size : 1, wanted = 2 * AHEAD * (count + 1);
    f->window = (int)(fit < 2 ? 2 : fit < wanted ? fit : wanted);
    return status;
}

void render_pieces_destroy(render_pieces *pieces) {
    if (pieces) {
        for (int i = 0; pieces->slots && i < pieces->plan.count; ++i) {
            free(pieces->slots[i].pixels);
        }
        for (int i = 0; pieces->runners && i < pieces->plan.runners; ++i) {
            if (pieces->runners[i].channel != NOTHING) {
                close(pieces->runners[i].channel);
            }
        }
        free(pieces->slots);
        free(pieces->runners);
        free(pieces->ready);
        free(pieces);
    }
}

static void lose(render_pieces *f, runner *r) {
    close(r->channel);
    r->channel = NOTHING;
    for (int i = 0; i < AHEAD; ++i) {
        slot *s = r->pieces[i] != NOTHING ? &f->slots[r->pieces[i]] : NULL;
        if (s && s->state == STATE_LENT) {
            s->state = STATE_FREE;
        }
        r->pieces[i] = NOTHING;
    }
}

/* The first piece from `piece` on that no process has; NOTHING if there is none in the window. */
static int find_free(const render_pieces *f, int piece) {
    const int end = f->plan.count - piece < f->window ? f->plan.count : piece + f->window;
    for (int i = piece; i < end; ++i) {
        if (f->slots[i].state == STATE_FREE) {
            return i;
        }
    }
    return NOTHING;
}

/* Each runner gets a first piece before any gets a second. */
static void hand_out(render_pieces *f, int piece) {
    for (int depth = 0; depth < AHEAD; ++depth) {
        for (int i = 0; i < f->plan.runners; ++i) {
            runner *r = &f->runners[i];
            const int next = r->channel != NOTHING && r->pieces[depth] == NOTHING
                                 ? find_free(f, piece)
                                 : NOTHING;
            if (next == NOTHING) {
                continue;
            }
            r->start = depth == 0 ? burnish_seconds_now() : r->start;
            r->pieces[depth] = next;
            f->slots[next].state = STATE_LENT;
            f->order.piece = next;
            if (!cli_write_all(r->channel, &f->order, sizeof f->order)) {
                lose(f, r);
            }
        }
    }
}

/* Receives the runner's oldest piece. A late piece is dropped. */
static void take_reply(render_pieces *f, runner *r) {
    reply a;
    uint8_t *pixels = NULL;
    int is_whole = channel_read(r->channel, &a, sizeof a) && r->pieces[0] != NOTHING &&
                   a.piece == r->pieces[0] && a.size == f->size;
    if (is_whole) {
        pixels = malloc(f->size);
        is_whole = pixels && channel_read(r->channel, pixels, f->size);
    }
    slot *s = is_whole ? &f->slots[a.piece] : NULL;
    if (s && s->state == STATE_LENT) {
        *s = (slot){.state = STATE_HERE, .pixels = pixels};
        memcpy(s->notes, a.notes, sizeof s->notes);
    } else {
        free(pixels);
    }
    if (!is_whole) {
        lose(f, r);
        return;
    }
    memmove(r->pieces, r->pieces + 1, (AHEAD - 1) * sizeof *r->pieces);
    r->pieces[AHEAD - 1] = NOTHING;
    r->start = burnish_seconds_now();
}

static void collect(render_pieces *f, int milliseconds) {
    for (int i = 0; i < f->plan.runners; ++i) {
        f->ready[i] = (struct pollfd){f->runners[i].channel, POLLIN, 0};
    }
    if (poll(f->ready, (nfds_t)f->plan.runners, milliseconds) > 0) {
        for (int i = 0; i < f->plan.runners; ++i) {
            if (f->ready[i].fd >= 0 && f->ready[i].revents) {
                take_reply(f, &f->runners[i]);
            }
        }
    }
}

static int is_slow(const render_pieces *f, int piece) {
    for (int i = 0; i < f->plan.runners; ++i) {
        const runner *r = &f->runners[i];
        for (int k = 0; k < AHEAD; ++k) {
            if (r->pieces[k] == piece) {
                return burnish_seconds_now() - r->start > SLOW_SECONDS;
            }
        }
    }
    return 1;
}

static void copy_rows(const burnish_image *image, uint8_t *packed, const uint8_t *given) {
    const burnish_pixels pixels = burnish_image_get_pixels(image);
    const size_t row = (size_t)image->width * (size_t)image->channels;
    for (int y = 0; y < image->height; ++y) {
        uint8_t *at = (uint8_t *)pixels.pixels + (size_t)y * pixels.stride;
        if (given) {
            memcpy(at, given + (size_t)y * row, row);
        } else {
            memcpy(packed + (size_t)y * row, at, row);
        }
    }
}

static void copy_notes(const render_pieces_plan *plan, uint64_t *to, const uint64_t *given) {
    for (int i = 0; i < RENDER_PIECE_NOTES && plan->notes; ++i) {
        if (given) {
            plan->notes[i] = given[i];
        } else {
            to[i] = plan->notes[i];
        }
    }
}

/* Stores a piece for later. Without memory it is dropped and drawn again later. */
static burnish_status draw_ahead(render_pieces *f, int piece, burnish_error *error) {
    f->slots[piece].state = STATE_LENT;
    const burnish_status status = f->plan.draw(f->plan.context, piece, error);
    uint8_t *pixels = status == BURNISH_STATUS_OK ? malloc(f->size) : NULL;
    if (pixels) {
        copy_rows(f->plan.image, pixels, NULL);
    }
    slot *s = &f->slots[piece];
    *s = (slot){.state = pixels ? STATE_HERE : STATE_FREE, .pixels = pixels};
    copy_notes(&f->plan, s->notes, NULL);
    return status;
}

/* Draws the requested piece here. The copy of another process is dropped when it arrives. */
static burnish_status draw_now(render_pieces *f, int piece, burnish_error *error) {
    f->slots[piece].state = STATE_TAKEN;
    return f->plan.draw(f->plan.context, piece, error);
}

burnish_status render_pieces_take(render_pieces *f, int piece, burnish_error *error) {
    slot *s = &f->slots[piece];
    burnish_status status = BURNISH_STATUS_OK;
    while (s->state != STATE_HERE && status == BURNISH_STATUS_OK) {
        collect(f, 0);
        if (s->state == STATE_FREE) {
            s->state = STATE_LENT; /* to this process */
            hand_out(f, piece);
            return draw_now(f, piece, error);
        }
        hand_out(f, piece);
        const int next = find_free(f, piece);
        if (s->state == STATE_LENT && is_slow(f, piece)) {
            return draw_now(f, piece, error);
        }
        if (s->state == STATE_LENT && next != NOTHING) {
            status = draw_ahead(f, next, error);
        } else if (s->state == STATE_LENT) {
            collect(f, 500);
        }
    }
    if (status == BURNISH_STATUS_OK) {
        copy_rows(f->plan.image, NULL, s->pixels);
        copy_notes(&f->plan, NULL, s->notes);
        free(s->pixels);
        *s = (slot){.state = STATE_TAKEN};
        hand_out(f, piece);
    }
    return status;
}

/* ---- Runners ---- */

burnish_status render_pieces_serve(const render_pieces_plan *plan, burnish_error *error) {
    const size_t size = piece_size(plan);
    uint8_t *pixels = malloc(size);
    burnish_status status = check_socket("runner", CHANNEL, error);
    if (status == BURNISH_STATUS_OK && !pixels) {
        status = cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory: --runner");
    }
    for (order o; status == BURNISH_STATUS_OK && channel_read(CHANNEL, &o, sizeof o);) {
        order own = make_order(plan);
        own.piece = o.piece;
        if (memcmp(&own, &o, sizeof o) != 0 || o.piece < 0 || o.piece >= plan->count) {
            status = cli_fail(error, BURNISH_STATUS_ARGUMENT,
                              "--runner: burnish %s here has another version, mesh or flags than "
                              "the main process; make all the same",
                              burnish_version());
            break;
        }
        status = plan->draw(plan->context, o.piece, error);
        reply a = {.piece = o.piece, .size = size};
        if (status == BURNISH_STATUS_OK) {
            copy_notes(plan, a.notes, NULL);
            copy_rows(plan->image, pixels, NULL);
            if (!cli_write_all(CHANNEL, &a, sizeof a) || !cli_write_all(CHANNEL, pixels, size)) {
                break;
            }
        }
    }
    free(pixels);
    return status;
}

#endif
