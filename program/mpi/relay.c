#include "relay.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum {
    BUFFER_BYTES = 1 << 18, /* per direction of a link */
    BEATS = 8,              /* heartbeats per time of silence */
    FAREWELL_SECONDS = 10   /* limit for the shutdown */
};

/* Tags: bytes; the link's end; a heartbeat. */
enum { TAG_BYTES = 1, TAG_END, TAG_BEAT };

int relay_create(relay *r) {
    const size_t count = (size_t)(r->count = r->rank == 0 ? r->size - 1 : 1);
    r->links = calloc(count + 1, sizeof *r->links);
    r->requests = calloc(2 * count + 1, sizeof *r->requests);
    r->done = calloc(2 * count + 1, sizeof *r->done);
    r->statuses = calloc(2 * count + 1, sizeof *r->statuses);
    r->ready = calloc(count + 1, sizeof *r->ready);
    int is_made = r->links && r->requests && r->done && r->statuses && r->ready;
    for (size_t i = 0; i < count && is_made; ++i) {
        r->links[i] = (link_state){.peer = r->rank == 0 ? (int)i + 1 : 0,
                                   .socket = -1,
                                   .in = malloc(BUFFER_BYTES),
                                   .out = malloc(BUFFER_BYTES),
                                   .beat = MPI_REQUEST_NULL};
        is_made = r->links[i].in && r->links[i].out;
        r->requests[2 * i] = r->requests[2 * i + 1] = MPI_REQUEST_NULL;
    }
    return is_made ? 1 : report_failure("out of memory");
}

static MPI_Request *receive_of(relay *r, const link_state *l) {
    return &r->requests[2 * (l - r->links)];
}

static MPI_Request *send_of(relay *r, const link_state *l) {
    return &r->requests[2 * (l - r->links) + 1];
}

static void close_socket(link_state *l) {
    if (l->socket >= 0) {
        close(l->socket);
    }
    l->socket = -1;
}

/* Does not touch the link's requests: a call that waits for them might never return. */
static void lose(relay *r, link_state *l, const char *why) {
    if (r->rank == 0 && !l->has_ended) {
        fprintf(stderr, "burnish-mpi: rank %d %s; its items go to other ranks\n", l->peer, why);
    }
    *receive_of(r, l) = MPI_REQUEST_NULL;
    *send_of(r, l) = MPI_REQUEST_NULL;
    l->is_lost = 1;
    r->has_losses = 1;
    close_socket(l);
}

static void expect(relay *r, link_state *l) {
    if (MPI_Irecv(l->in, BUFFER_BYTES, MPI_BYTE, l->peer, MPI_ANY_TAG, MPI_COMM_WORLD,
                  receive_of(r, l)) != MPI_SUCCESS) {
        lose(r, l, "failed to deliver a message");
    }
}

static void post(relay *r, link_state *l, size_t size, int tag) {
    if (MPI_Isend(l->out, (int)size, MPI_BYTE, l->peer, tag, MPI_COMM_WORLD, send_of(r, l)) !=
        MPI_SUCCESS) {
        lose(r, l, "can't be reached");
    }
}

static void end_link(relay *r, link_state *l) {
    close_socket(l);
    if (!l->is_ending && !l->is_lost && *send_of(r, l) == MPI_REQUEST_NULL) {
        l->is_ending = 1;
        post(r, l, 0, TAG_END);
    }
}

/* Passes received bytes to the child as far as it accepts them; then posts the next receive. */
static int write_socket(relay *r, link_state *l) {
    if (l->in_taken == l->in_size || l->is_lost) {
        return 0;
    }
    ssize_t count = l->socket >= 0 ? write(l->socket, l->in + l->in_taken, l->in_size - l->in_taken)
                                   : (ssize_t)(l->in_size - l->in_taken);
    if (count < 0 && errno != EAGAIN && errno != EINTR) {
        count = (ssize_t)(l->in_size - l->in_taken); /* it reads no more */
    }
    l->in_taken += count > 0 ? (size_t)count : 0;
    r->expects_child |= count > 0;
    if (l->in_taken == l->in_size) {
        expect(r, l);
    }
    return count > 0;
}

static int read_socket(relay *r, link_state *l) {
    if (l->socket < 0 || l->is_lost || *send_of(r, l) != MPI_REQUEST_NULL) {
        return 0;
    }
    const ssize_t count = read(l->socket, l->out, BUFFER_BYTES);
    if (count > 0) {
        r->expects_child = 0;
        post(r, l, (size_t)count, TAG_BYTES);
    } else if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
        /* rank 0's burnish still has to write its report, and the others wait for it */
        r->rank == 0 ? close_socket(l) : end_link(r, l);
    }
    return count > 0;
}

static void take_message(relay *r, link_state *l, const MPI_Status *status) {
    int size = 0;
    l->last_received = seconds_now();
    if (status->MPI_TAG == TAG_BYTES) {
        MPI_Get_count(status, MPI_BYTE, &size);
        l->in_size = (size_t)size;
        l->in_taken = 0;
        write_socket(r, l);
        return;
    }
    if (status->MPI_TAG == TAG_END) {
        l->has_ended = 1;
        close_socket(l);
    }
    expect(r, l);
}

/* Handles completed messages. Returns their number. */
static int move_messages(relay *r) {
    int count = 0;
    const int code = MPI_Testsome(2 * r->count, r->requests, &count, r->done, r->statuses);
    if (count == MPI_UNDEFINED || (code != MPI_SUCCESS && code != MPI_ERR_IN_STATUS)) {
        return 0;
    }
    for (int i = 0; i < count; ++i) {
        link_state *l = &r->links[r->done[i] / 2];
        if (code == MPI_ERR_IN_STATUS && r->statuses[i].MPI_ERROR != MPI_SUCCESS &&
            r->statuses[i].MPI_ERROR != MPI_ERR_PENDING) {
            lose(r, l, "is gone");
        } else if (r->done[i] % 2 == 0) {
            take_message(r, l, &r->statuses[i]);
        }
    }
    return count;
}

/* Sends heartbeats and drops silent ranks. */
static void beat(relay *r) {
    const double time = seconds_now();
    if (time < r->next_beat) {
        return;
    }
    r->next_beat = time + r->silence / BEATS;
    for (int i = 0; i < r->count; ++i) {
        link_state *l = &r->links[i];
        int is_sent = 1;
        if (l->is_lost || l->is_ending) {
            continue;
        }
        if (l->in_taken < l->in_size) {
            l->last_received =
                time; /* nothing is received until the child has read what is pending */
        }
        if (l->beat != MPI_REQUEST_NULL) {
            MPI_Test(&l->beat, &is_sent, MPI_STATUS_IGNORE);
        }
        if (is_sent) {
            MPI_Isend(NULL, 0, MPI_BYTE, l->peer, TAG_BEAT, MPI_COMM_WORLD, &l->beat);
        }
        if (time - l->last_received > r->silence) {
            lose(r, l, "is silent");
        }
    }
}

/* Waits for the child. MPI can't be polled, so this sleeps for a time that grows while nothing
 * happens. */
static void rest(relay *r, int idle) {
    const long longest = r->rank > 0 && r->expects_child ? 10000000 : 1000000;
    const long least = 20000, nanoseconds = least << (idle < 10 ? idle : 10);
    const struct timespec time = {0, nanoseconds < longest ? nanoseconds : longest};
    int count = 0;
    for (int i = 0; i < r->count; ++i) {
        const link_state *l = &r->links[i];
        short events = *send_of(r, l) == MPI_REQUEST_NULL ? POLLIN : 0;
        events |= l->in_taken < l->in_size ? POLLOUT : 0;
        if (l->socket >= 0 && events) {
            r->ready[count++] = (struct pollfd){l->socket, events, 0};
        }
    }
    ppoll(r->ready, (nfds_t)count, &time, NULL);
}

/* 1: this rank has nothing more to do. */
static int is_over(relay *r) {
    return r->rank == 0 ? child_is_gone(&r->child) : r->links[0].has_ended || r->links[0].is_lost;
}

void relay_carry(relay *r) {
    for (int idle = 0; !is_over(r); ++idle) {
        int moved = move_messages(r);
        for (int i = 0; i < r->count; ++i) {
            moved += write_socket(r, &r->links[i]);
            moved += read_socket(r, &r->links[i]);
        }
        beat(r);
        if (moved > 0) {
            idle = -1;
        } else {
            rest(r, idle);
        }
    }
}

void relay_begin(relay *r) {
    for (int i = 0; i < r->count; ++i) {
        r->links[i].last_received = seconds_now();
        expect(r, &r->links[i]);
    }
}

int relay_end(relay *r) {
    const double start = seconds_now();
    for (int left = 1; left > 0 && seconds_now() - start < FAREWELL_SECONDS;) {
        left = 0;
        move_messages(r);
        for (int i = 0; i < r->count; ++i) {
            link_state *l = &r->links[i];
            end_link(r, l);
            left += !l->is_lost && (!l->is_ending || *send_of(r, l) != MPI_REQUEST_NULL ||
                                    (r->rank == 0 && !l->has_ended));
        }
        usleep(1000);
    }
    for (int i = 0; i < r->count; ++i) {
        r->has_losses |= !r->links[i].is_ending;
    }
    return !r->has_losses;
}

void relay_cancel(relay *r) {
    for (int i = 0; i < r->count; ++i) {
        if (*receive_of(r, &r->links[i]) != MPI_REQUEST_NULL) {
            MPI_Cancel(receive_of(r, &r->links[i]));
            MPI_Request_free(receive_of(r, &r->links[i]));
        }
    }
}
