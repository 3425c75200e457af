/* Bytes between the sockets of the child here and those of other ranks, by MPI. */
#ifndef MPI_RELAY_H
#define MPI_RELAY_H

#include <mpi.h>
#include <poll.h>
#include <stddef.h>

#include "child.h"

/* A socket of the child here, and the rank that its bytes come from and go to. */
typedef struct link {
    int peer, socket; /* -1: closed */
    char *in, *out;
    size_t in_size, in_taken; /* received, written to the socket */
    int has_ended;            /* 1: TAG_END was received */
    int is_ending;            /* 1: TAG_END was sent */
    int is_lost;
    double heard; /* when, the last time */
    MPI_Request beat;
} link_state;

typedef struct relay {
    int rank, size;
    child child;
    link_state *links;
    int count;
    MPI_Request *requests; /* of each link: receive, send */
    int *done;
    MPI_Status *statuses;
    struct pollfd *ready;
    double silence, next_beat;
    int expects_child; /* 1: what comes next comes from the child, most likely */
    int has_losses;
} relay;

/* Links to all other ranks, on those to rank 0; rank, size and silence are set. Returns 0, and
 * tells why, where that fails. */
int relay_create(relay *r);

/* Once MPI has begun: from now on ranks are listened to. */
void relay_begin(relay *r);

/* Until this rank has nothing more to do. */
void relay_carry(relay *r);

/* Tells all ranks that it is over; 1: all know. */
int relay_end(relay *r);

/* Takes back what nobody will send any more. */
void relay_cancel(relay *r);

#endif
