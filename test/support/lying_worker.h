/* What a worker that was taken over may send to the broker (test_broker.c, fuzz/fuzz_broker.c): the
 * broker runs in this process, over a folder with a secret beside it. */
#ifndef LYING_WORKER_H
#define LYING_WORKER_H

#include <fcntl.h>
#include <ftw.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "sandbox/channel.h"
#include "sandbox/process.h"

#define LYING_SECRET "bytes that no worker may see"

enum { LYING_MAX_BYTES = 1000, LYING_REPLIES_MAX = 1 << 20 };

#define LYING_PICTURE "out/a.png"
#define LYING_REPORT "out/a.json"

/* A folder with secret.txt, an empty one, out, and the input's, in: mesh.gltf, a.bin, Sub/b.bin,
 * big (sparse), link, which leads to the secret, and fifo. The process works in it. */
typedef struct lying_box {
    char path[64];
    int folder; /* in */
    sandbox_plan plan;
    char *replies; /* of the last run: what the broker has sent, at most LYING_REPLIES_MAX */
    size_t reply_size;
    int channel; /* the worker's end */
} lying_box;

static inline int lying_write(const char *name, const char *bytes) {
    FILE *file = fopen(name, "w");
    const int is_written = file && fputs(bytes, file) >= 0;
    return file && fclose(file) == 0 && is_written;
}

/* Returns 0 if the folder can't be made. */
static inline int lying_begin(lying_box *box) {
    *box = (lying_box){.path = "/tmp/burnish-broker-XXXXXX",
                       .plan = {.input = "in/mesh.gltf",
                                .outputs = {LYING_PICTURE, NULL, LYING_REPORT},
                                .output_count = 3,
                                .max_input_bytes = LYING_MAX_BYTES},
                       .replies = malloc(LYING_REPLIES_MAX)};
    const int is_made = box->replies && mkdtemp(box->path) && chdir(box->path) == 0 &&
                        mkdir("in", 0700) == 0 && mkdir("in/Sub", 0700) == 0 &&
                        mkdir("out", 0700) == 0 && lying_write("secret.txt", LYING_SECRET) &&
                        lying_write("in/mesh.gltf", "{}") && lying_write("in/a.bin", "aaaa") &&
                        lying_write("in/Sub/b.bin", "bb") && lying_write("in/big", "") &&
                        truncate("in/big", (off_t)1 << 40) == 0 &&
                        symlink("../secret.txt", "in/link") == 0 && mkfifo("in/fifo", 0600) == 0;
    box->folder = open("in", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    return is_made && box->folder >= 0;
}

static inline int lying_remove(const char *path, const struct stat *state, int kind,
                               struct FTW *at) {
    (void)state, (void)kind, (void)at;
    return remove(path);
}

/* Outputs of the last run. */
static inline void lying_remove_outputs(void) {
    unlink(LYING_PICTURE);
    unlink(LYING_REPORT);
}

static inline void lying_end(lying_box *box) {
    close(box->folder);
    free(box->replies);
    nftw(box->path, lying_remove, 8, FTW_DEPTH | FTW_PHYS);
}

/* Reads what the broker sends until it closes the channel, so that it never waits. */
static inline void *lying_take_replies(void *context) {
    lying_box *box = context;
    char unread[4096];
    for (;;) {
        const size_t left = LYING_REPLIES_MAX - box->reply_size;
        const ssize_t count = left > 0 ? read(box->channel, box->replies + box->reply_size, left)
                                       : read(box->channel, unread, sizeof unread);
        if (count <= 0) {
            return NULL;
        }
        box->reply_size += left > 0 ? (size_t)count : 0;
    }
}

/* Serves a worker that sends these bytes, and a descriptor with them unless it is -1, and is gone.
 * They are at most 100,000, which a socket holds. */
static inline broker_state lying_run(lying_box *box, void *bytes, size_t size, int descriptor) {
    int ends[2];
    pthread_t reader;
    char rights[CMSG_SPACE(sizeof descriptor)] = {0};
    struct iovec part = {bytes, size};
    struct msghdr sent = {.msg_iov = &part, .msg_iovlen = 1};
    if (descriptor >= 0) {
        sent.msg_control = rights;
        sent.msg_controllen = sizeof rights;
        struct cmsghdr *head = CMSG_FIRSTHDR(&sent);
        *head = (struct cmsghdr){.cmsg_len = CMSG_LEN(sizeof descriptor),
                                 .cmsg_level = SOL_SOCKET,
                                 .cmsg_type = SCM_RIGHTS};
        memcpy(CMSG_DATA(head), &descriptor, sizeof descriptor);
    }
    box->reply_size = 0;
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0 ||
        sendmsg(ends[1], &sent, 0) != (ssize_t)size || shutdown(ends[1], SHUT_WR) != 0) {
        abort();
    }
    box->channel = ends[1];
    if (pthread_create(&reader, NULL, lying_take_replies, box) != 0) {
        abort();
    }
    const broker_state state = broker_serve(&box->plan, ends[0], -1, box->folder);
    close(ends[0]);
    pthread_join(reader, NULL);
    close(ends[1]);
    return state;
}

static inline int lying_has_secret(const lying_box *box) {
    return memmem(box->replies, box->reply_size, LYING_SECRET, strlen(LYING_SECRET)) != NULL;
}

static int lying_files;

static inline int lying_count_file(const char *path, const struct stat *state, int kind,
                                   struct FTW *at) {
    (void)state;
    lying_files += kind != FTW_D && strcmp(path + at->base, "a.png") != 0 &&
                   strcmp(path + at->base, "a.json") != 0;
    return 0;
}

/* How many files there are in the box, except the outputs that the plan names: LYING_FILES unless
 * something else was written. */
static inline int lying_count_files(const lying_box *box) {
    lying_files = 0;
    nftw(box->path, lying_count_file, 8, FTW_PHYS);
    return lying_files;
}

enum { LYING_FILES = 7 };

#endif
