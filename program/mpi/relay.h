/* Relays bytes between the child's sockets and those of other ranks over MPI. */
#ifndef MPI_RELAY_H
#define MPI_RELAY_H

#include <mpi.h>
#include <poll.h>
#include <stddef.h>

#include "child.h"

/* A socket of the local child and the rank that it is connected to. */
typedef struct link {
    int peer, socket; /* -1: closed */
    char *in, *out;
    size_t in_size, in_taken; /* received, written to the socket */
    int has_ended;            /* 1: TAG_END was received */
    int is_ending;            /* 1: TAG_END was sent */
    int is_lost;
    double last_received; /* seconds_now */
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
    int expects_child; /* 1: the child will most likely send next */
    int has_losses;
} relay;

/* Creates the links: on rank 0 to all other ranks, else to rank 0. Set rank, size and silence first.
 * Returns 0 on failure, after printing the reason. */
int relay_create(relay *r);

/* Starts to receive from the ranks; call it after MPI_Init. */
void relay_begin(relay *r);

/* Relays bytes until this rank has nothing more to do. */
void relay_carry(relay *r);

/* Notifies all ranks of the end. 1: all have confirmed. */
int relay_end(relay *r);

/* Cancels the receives that nobody will match. */
void relay_cancel(relay *r);

#endif
