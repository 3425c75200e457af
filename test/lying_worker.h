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

#include "sandbox/broker.h"
#include "sandbox/channel.h"

#define LYING_SECRET "bytes that no worker may see"

enum { LYING_MAX_BYTES = 1000, LYING_REPLIES_MAX = 1 << 20 };

/* box/secret.txt, box/in/: mesh.gltf, a.bin, Sub/b.bin, link -> ../secret.txt, big (sparse), fifo;
 * box/out/. */
typedef struct lying_box {
    char path[64];
    char input[96], picture[96], report[96];
    int folder; /* box/in */
    sandbox_plan plan;
    char *replies; /* of the last run: what the broker has sent, at most LYING_REPLIES_MAX */
    size_t reply_size;
    int channel; /* the worker's end */
} lying_box;

static inline int lying_write(const lying_box *box, const char *name, const char *bytes) {
    char path[160];
    snprintf(path, sizeof path, "%s/%s", box->path, name);
    FILE *file = fopen(path, "w");
    const int is_written = file && fputs(bytes, file) >= 0;
    return file && fclose(file) == 0 && is_written;
}

/* Returns 0 if the folder can't be made. */
static inline int lying_begin(lying_box *box) {
    static const char *const folders[] = {"in", "in/Sub", "out"};
    char path[160];
    *box = (lying_box){.path = "/tmp/burnish-broker-XXXXXX", .folder = -1};
    int is_made = mkdtemp(box->path) != NULL;
    for (size_t i = 0; i < sizeof folders / sizeof *folders; ++i) {
        snprintf(path, sizeof path, "%s/%s", box->path, folders[i]);
        is_made = is_made && mkdir(path, 0700) == 0;
    }
    is_made = is_made && lying_write(box, "secret.txt", LYING_SECRET) &&
              lying_write(box, "in/mesh.gltf", "{}") && lying_write(box, "in/a.bin", "aaaa") &&
              lying_write(box, "in/Sub/b.bin", "bb") && lying_write(box, "in/big", "");
    snprintf(path, sizeof path, "%s/in/big", box->path);
    is_made = is_made && truncate(path, (off_t)1 << 40) == 0;
    snprintf(path, sizeof path, "%s/in/link", box->path);
    is_made = is_made && symlink("../secret.txt", path) == 0;
    snprintf(path, sizeof path, "%s/in/fifo", box->path);
    is_made = is_made && mkfifo(path, 0600) == 0;
    snprintf(path, sizeof path, "%s/in", box->path);
    box->folder = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    snprintf(box->input, sizeof box->input, "%s/in/mesh.gltf", box->path);
    snprintf(box->picture, sizeof box->picture, "%s/out/a.png", box->path);
    snprintf(box->report, sizeof box->report, "%s/out/a.json", box->path);
    box->plan = (sandbox_plan){.input = box->input,
                               .outputs = {box->picture, NULL, box->report},
                               .output_count = 3,
                               .max_input_bytes = LYING_MAX_BYTES};
    box->replies = malloc(LYING_REPLIES_MAX);
    return is_made && box->folder >= 0 && box->replies;
}

static inline int lying_remove(const char *path, const struct stat *state, int kind,
                               struct FTW *at) {
    (void)state, (void)kind, (void)at;
    return remove(path);
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
