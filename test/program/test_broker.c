/* A compromised worker sends messages to the broker: it can only read files of the folder and write
 * the outputs, and its limits and sizes are not trusted. */
#include <errno.h>
#include <signal.h>

#include "lying_worker.h"
#include "sandbox/lock.h"
#include "sandbox/process.h"
#include "support.h"

/* Messages that are sent together. */
typedef struct script {
    char bytes[100000];
    size_t size;
} script;

static lying_box box;

static void add(script *s, uint32_t kind, uint64_t value, const char *bytes, uint64_t size) {
    const message head = {.value = value, .size = size, .kind = kind};
    const size_t count = bytes ? (size_t)size : 0;
    if (s->size + sizeof head + count > sizeof s->bytes) {
        abort();
    }
    memcpy(s->bytes + s->size, &head, sizeof head);
    if (count > 0) {
        memcpy(s->bytes + s->size + sizeof head, bytes, count);
    }
    s->size += sizeof head + count;
}

static void add_text(script *s, uint32_t kind, uint64_t value, const char *text) {
    add(s, kind, value, text, strlen(text));
}

static broker_state run(script *s) {
    const broker_state state = lying_run(&box, s->bytes, s->size, -1);
    CHECK1(!lying_has_secret(&box));
    CHECK(lying_count_files(&box) == LYING_FILES, "%d files", lying_count_files(&box));
    s->size = 0;
    return state;
}

/* The next reply, from *at on; its bytes, at most 479, as a string. */
static message take_reply(size_t *at, char text[480]) {
    message head = {0};
    *text = 0;
    if (box.reply_size - *at >= sizeof head) {
        memcpy(&head, box.replies + *at, sizeof head);
        *at += sizeof head;
        if (head.size < 480 && head.size <= box.reply_size - *at) {
            memcpy(text, box.replies + *at, head.size);
            text[head.size] = 0;
            *at += head.size;
        }
    }
    return head;
}

static int is_there(const char *path) {
    return access(path, F_OK) == 0;
}

/* ---- Files ---- */

static void test_files(void) {
    static const struct {
        const char *name;
        uint64_t limit;
        burnish_status status;
        const char *text; /* of the file, or the error */
    } files[] = {
        {"a.bin", 100, BURNISH_STATUS_OK, "aaaa"},
        {"A.bin", UINT64_MAX, BURNISH_STATUS_OK, "aaaa"},
        {"./sub//./B.BIN", 2, BURNISH_STATUS_OK, "bb"},
        {"a.bin", 3, BURNISH_STATUS_LIMIT,
         "a.bin: larger than the limit of 3 bytes; raise the limit or simplify the mesh"},
        {"big", UINT64_MAX, BURNISH_STATUS_LIMIT,
         "big: larger than the limit of 1000 bytes; raise the limit or simplify the mesh"},
        {"link", 100, BURNISH_STATUS_READ, "link: leads out of the folder of the file"},
        {"fifo", 100, BURNISH_STATUS_READ, "fifo: is not a regular file"},
        {"Sub", 100, BURNISH_STATUS_READ, "Sub: can't be read: Is a directory"},
        {"Sub/", 100, BURNISH_STATUS_READ, "Sub/: can't be opened: Is a directory"},
        {"", 100, BURNISH_STATUS_READ, ": can't be opened: No such file or directory"},
        {"none", 100, BURNISH_STATUS_READ, "none: can't be opened: No such file or directory"},
        {"..bin", 100, BURNISH_STATUS_READ, "..bin: can't be opened: No such file or directory"},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        script s = {.size = 0};
        char text[480];
        size_t at = 0;
        add_text(&s, MESSAGE_FILE, files[i].limit, files[i].name);
        CHECK(run(&s) == BROKER_GONE, "%s", files[i].name);
        message head = take_reply(&at, text);
        if (files[i].status == BURNISH_STATUS_OK) {
            CHECK(head.kind == MESSAGE_READY && head.value == strlen(files[i].text), "%s",
                  files[i].name);
            head = take_reply(&at, text);
            CHECK1(head.kind == MESSAGE_BYTES);
            CHECK_TEXT(text, files[i].text);
            head = take_reply(&at, text);
            CHECK_TEXT(text, "");
        } else {
            CHECK_TEXT(text, files[i].text);
        }
        CHECK(head.kind == MESSAGE_DONE && head.value == (uint64_t)files[i].status, "%s",
              files[i].name);
        CHECK1(at == box.reply_size);
    }
}

static void test_escapes(void) {
    static const char *const names[] = {
        "sUB/../../secret.txt", "Sub/../../secret.txt", "../secret.txt", "..", "Sub/..",
        "Sub/../a.bin",         "./../secret.txt",      "/etc/passwd",   "//", "link/../secret.txt",
        "sUB/../../in/a.bin"};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        script s = {.size = 0};
        add_text(&s, MESSAGE_FILE, UINT64_MAX, names[i]);
        CHECK(run(&s) == BROKER_VIOLATION, "%s", names[i]);
        CHECK(box.reply_size == 0, "%s", names[i]);
    }
}

static void test_long_names(void) {
    static char name[MESSAGE_NAME_MAX + 2];
    script s = {.size = 0};
    char text[480];
    size_t at = 0;
    memset(name, 'x', sizeof name);
    add(&s, MESSAGE_FILE, 100, name, MESSAGE_NAME_MAX);
    CHECK1(run(&s) == BROKER_GONE);
    take_reply(&at, text);
    CHECK(strstr(text, "x: can't be opened: File name too long"), "%s", text);
    add(&s, MESSAGE_FILE, 100, name, MESSAGE_NAME_MAX + 1);
    CHECK1(run(&s) == BROKER_VIOLATION);
    add(&s, MESSAGE_FILE, 100, NULL, UINT64_MAX);
    CHECK1(run(&s) == BROKER_VIOLATION);
    add(&s, MESSAGE_FILE, 100, "a.bin\0x", 7);
    CHECK1(run(&s) == BROKER_VIOLATION);
}

/* ---- Outputs ---- */

static void test_outputs(void) {
    script s = {.size = 0};
    add_text(&s, MESSAGE_WRITE, 0, LYING_PICTURE);
    add_text(&s, MESSAGE_DATA, 0, "pixels");
    add(&s, MESSAGE_END, 0, NULL, 0);
    add_text(&s, MESSAGE_WRITE, 0, LYING_REPORT);
    add_text(&s, MESSAGE_DATA, 0, "{}");
    add(&s, MESSAGE_END, 0, NULL, 0);
    add(&s, MESSAGE_STATUS, BURNISH_STATUS_OK, NULL, 0);
    add(&s, MESSAGE_STATUS, BURNISH_STATUS_OK, NULL, 0);
    script whole = s;
    CHECK1(run(&s) == BROKER_GONE);
    CHECK1(is_there(LYING_PICTURE) && is_there(LYING_REPORT));
    /* All prefixes: a worker can end anywhere. */
    for (size_t size = 0; size < whole.size; ++size) {
        lying_remove_outputs();
        s = whole;
        s.size = size;
        CHECK(run(&s) == BROKER_GONE, "%zu bytes", size);
        CHECK(!is_there(LYING_PICTURE), "%zu bytes", size);
    }
    lying_remove_outputs();
}

static void test_other_outputs(void) {
    const char *const names[] = {"", "-", "/dev/null", "./out/a.png", "a.png", "secret.txt"};
    script s = {.size = 0};
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        add_text(&s, MESSAGE_WRITE, 0, names[i]);
        add_text(&s, MESSAGE_DATA, 0, "bytes of a liar");
        add(&s, MESSAGE_END, 0, NULL, 0);
        add(&s, MESSAGE_STATUS, BURNISH_STATUS_OK, NULL, 0);
        CHECK(run(&s) == BROKER_VIOLATION, "%s", names[i]);
        CHECK1(box.reply_size == 0);
    }
    for (int i = 0; i < 3; ++i) { /* while an output is being reported, nothing else is written */
        add_text(&s, MESSAGE_WRITE, 0, LYING_PICTURE);
        add(&s, MESSAGE_END, 0, NULL, 0);
    }
    CHECK1(run(&s) == BROKER_VIOLATION);
    CHECK1(!is_there(LYING_PICTURE));
}

static void test_failed_output(void) {
    script s = {.size = 0};
    char text[480];
    size_t at = 0;
    add_text(&s, MESSAGE_WRITE, 0, LYING_PICTURE);
    add(&s, MESSAGE_END, 0, NULL, 0);
    add_text(&s, MESSAGE_STATUS, BURNISH_STATUS_LIMIT, "too\n\33[31mred");
    CHECK1(run(&s) == BROKER_GONE);
    CHECK1(!is_there(LYING_PICTURE));
    CHECK1(take_reply(&at, text).kind == MESSAGE_READY);
    CHECK1(take_reply(&at, text).value == BURNISH_STATUS_LIMIT);
    CHECK_TEXT(text, "too??[31mred");
}

/* An output was complete in the worker's memory, so it can't be larger; a stream can. */
static void test_large_output(void) {
    static char bytes[100];
    script s = {.size = 0};
    for (int i = 0; i < 3; ++i) {
        box.plan.max_memory = i == 0 ? sizeof bytes - 1 : sizeof bytes - (size_t)(i == 2);
        box.plan.is_streamed = i == 2;
        add_text(&s, MESSAGE_WRITE, 0, LYING_PICTURE);
        add(&s, MESSAGE_DATA, 0, bytes, sizeof bytes - 1);
        add(&s, MESSAGE_DATA, 0, bytes, 1);
        add(&s, MESSAGE_END, 0, NULL, 0);
        add(&s, MESSAGE_STATUS, BURNISH_STATUS_OK, NULL, 0);
        CHECK(run(&s) == (i == 0 ? BROKER_VIOLATION : BROKER_GONE), "%d", i);
        CHECK(is_there(LYING_PICTURE) == (i != 0), "%d", i);
        lying_remove_outputs();
    }
    box.plan.max_memory = 0;
    box.plan.is_streamed = 0;
}

/* ffmpeg gets nothing but the frames that the command line asks for. */
static void test_video(void) {
    enum { OTHER = 300 };
    static const char head[] = "YUV4MPEG2 W3 H2 F20:1 Ip A1:1 C420jpeg "
                               "XYSCSS=420JPEG XCOLORRANGE=LIMITED\n";
    static const struct {
        const char *head, *frames[4];
        broker_state state;
        int passed; /* pieces that ffmpeg gets */
    } streams[] = {
        {head, {"FRAME\nyyyyyyuuvv", "FRAME\nYYYYYYUUVV"}, BROKER_GONE, 3},
        {head, {"FRAME\nyyy", "yyyuuvvFRA", "ME\nYYYYYYUUVV"}, BROKER_GONE, 4},
        {"YUV4MPEG2 W4 H2 F20:1 Ip A1:1 C420jpeg XYSCSS=420JPEG XCOLORRANGE=LIMITED\n",
         {"FRAME\n"},
         BROKER_VIOLATION,
         0},
        {"RIFF", {NULL}, BROKER_VIOLATION, 0},
        {head, {"FRAME\nyyyyyyyyuuvv"}, BROKER_VIOLATION, 1}, /* of another size */
        {head, {"FRAME Ip\n"}, BROKER_VIOLATION, 1},          /* parameters */
        {head, {"FRAME\nyyyyyyuuvv", "FRAME\nYYYYYYUUVV", "F"}, BROKER_VIOLATION, 3},
        {head,
         {"FRAME\nyyyyyyuuvv", "FRAME\nYYYYYY"},
         BROKER_VIOLATION,
         3}, /* its end is missing */
        {head, {NULL}, BROKER_VIOLATION, 1},
    };
    char folder[] = "/tmp/burnish-video-XXXXXX", program[64], got[64], *path = getenv("PATH"),
         old[4096];
    script s = {.size = 0};
    snprintf(old, sizeof old, "%s", path ? path : "");
    CHECK1(mkdtemp(folder) != NULL);
    snprintf(program, sizeof program, "%s/ffmpeg", folder);
    snprintf(got, sizeof got, "%s/got", folder);
    CHECK1(lying_write(program, "#!/bin/sh\nPATH=/usr/bin:/bin\n[ ! -e /proc/$$/fd/300 ] || exit "
                                "1\nexec tee \"${0%/*}/got\"\n") &&
           chmod(program, 0700) == 0);
    setenv("PATH", folder, 1);
    CHECK1(dup2(STDERR_FILENO, OTHER) == OTHER); /* which ffmpeg must not have */
    box.plan.container = "mp4";
    box.plan.frames = picture_expect_frames(3, 2, 20, 2);
    for (size_t i = 0; i < sizeof streams / sizeof *streams; ++i) {
        char wanted[400] = "", found[400] = "";
        add_text(&s, MESSAGE_WRITE, 0, LYING_PICTURE);
        for (int k = 0; k < 5; ++k) {
            const char *piece = k == 0 ? streams[i].head : streams[i].frames[k - 1];
            if (piece) {
                add_text(&s, MESSAGE_DATA, 0, piece);
                strcat(wanted, k < streams[i].passed ? piece : "");
            }
        }
        add(&s, MESSAGE_END, 0, NULL, 0);
        add(&s, MESSAGE_STATUS, BURNISH_STATUS_OK, NULL, 0);
        CHECK(run(&s) == streams[i].state, "stream %zu", i);
        CHECK(is_there(LYING_PICTURE) == (streams[i].state == BROKER_GONE), "stream %zu", i);
        FILE *file = fopen(got, "rb");
        CHECK1(file && fread(found, 1, sizeof found - 1, file) <= sizeof found &&
               fclose(file) == 0);
        CHECK_TEXT(found, wanted);
        lying_remove_outputs();
        unlink(got);
    }
    box.plan.container = NULL;
    close(OTHER);
    setenv("PATH", old, 1);
    unlink(program);
    rmdir(folder);
}

/* ---- Order and sizes ---- */

static void test_order(void) {
    static const uint32_t first[] = {0,
                                     MESSAGE_DATA,
                                     MESSAGE_END,
                                     MESSAGE_STATUS,
                                     MESSAGE_IMPORT, /* no importer reads such a file */
                                     MESSAGE_READY,
                                     MESSAGE_DONE,
                                     MESSAGE_BYTES,
                                     MESSAGE_BYTES + 1,
                                     UINT32_MAX};
    script s = {.size = 0};
    for (size_t i = 0; i < sizeof first / sizeof *first; ++i) {
        add(&s, first[i], 0, NULL, 0);
        CHECK(run(&s) == BROKER_VIOLATION, "kind %u", first[i]);
    }
    for (uint32_t kind = 0; kind <= MESSAGE_BYTES; ++kind) { /* where an output's bytes should be */
        if (kind != MESSAGE_END) {
            add_text(&s, MESSAGE_WRITE, 0, LYING_PICTURE);
            add(&s, kind, 0, NULL, 0);
            CHECK(run(&s) == BROKER_VIOLATION, "kind %u", kind);
        }
    }
    add_text(&s, MESSAGE_WRITE, 0, LYING_PICTURE);
    add(&s, MESSAGE_END, 0, NULL, 0);
    add(&s, MESSAGE_STATUS, BURNISH_STATUS_COUNT, NULL, 0);
    CHECK1(run(&s) == BROKER_VIOLATION);
    CHECK1(!is_there(LYING_PICTURE));
}

static void test_sizes(void) {
    static char large[MESSAGE_DATA_MAX + 1];
    static const uint64_t sizes[] = {0, MESSAGE_DATA_MAX + 1, (uint64_t)1 << 32, UINT64_MAX};
    script s = {.size = 0};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        const char *bytes = sizes[i] <= sizeof large ? large : NULL;
        add_text(&s, MESSAGE_WRITE, 0, LYING_PICTURE);
        add(&s, MESSAGE_DATA, 0, bytes, sizes[i]);
        CHECK(run(&s) == BROKER_VIOLATION, "size %llu", (unsigned long long)sizes[i]);
        add(&s, MESSAGE_DECODE, LYING_MAX_BYTES, "draco", 5);
        add(&s, MESSAGE_DATA, 0, bytes, sizes[i]);
        CHECK(run(&s) == BROKER_VIOLATION, "size %llu", (unsigned long long)sizes[i]);
    }
    add_text(&s, MESSAGE_WRITE, 0, LYING_PICTURE);
    add_text(&s, MESSAGE_END, 0, "x");
    CHECK1(run(&s) == BROKER_VIOLATION);
    CHECK1(!is_there(LYING_PICTURE));
}

/* ---- Importers ---- */

static void test_import(void) {
    const sandbox_plan plan = box.plan;
    char text[480];
    size_t at = 0;
    script s = {.size = 0};
    box.plan.input = "mesh.fbx";
    setenv("BURNISH_IMPORTERS", box.path, 1); /* none is there */
    add(&s, MESSAGE_IMPORT, UINT64_MAX, NULL, 0);
    add(&s, MESSAGE_IMPORT, UINT64_MAX, NULL, 0);
    CHECK1(run(&s) == BROKER_VIOLATION); /* the second */
    CHECK1(take_reply(&at, text).kind == MESSAGE_DONE);
    CHECK1(at == box.reply_size);
    box.plan = plan;
}

static void test_decode(void) {
    static char bytes[2 * LYING_MAX_BYTES];
    char text[480];
    size_t at = 0;
    script s = {.size = 0};
    add(&s, MESSAGE_DECODE, sizeof bytes, "draco", 5);
    add(&s, MESSAGE_DATA, 0, bytes, sizeof bytes);
    CHECK1(run(&s) == BROKER_GONE);
    CHECK1(take_reply(&at, text).value == BURNISH_STATUS_MEMORY);
    CHECK(strstr(text, "in/mesh.gltf: out of memory for the stream to decode"), "%s", text);
    box.plan.max_memory = 9; /* of the worker, which can not have had more */
    add(&s, MESSAGE_DECODE, 10, "draco", 5);
    add(&s, MESSAGE_DATA, 0, bytes, 10);
    CHECK1(run(&s) == BROKER_GONE);
    at = 0;
    CHECK1(take_reply(&at, text).value == BURNISH_STATUS_MEMORY);
    box.plan.max_memory = 0;
    add(&s, MESSAGE_DECODE, UINT64_MAX, "draco", 5);
    add(&s, MESSAGE_DATA, 0, bytes, sizeof bytes);
    CHECK1(run(&s) == BROKER_GONE);
    CHECK1(box.reply_size == 0);
    add(&s, MESSAGE_DECODE, 10, "draco", 5);
    add(&s, MESSAGE_DATA, 0, bytes, 11);
    CHECK1(run(&s) == BROKER_VIOLATION);
}

/* A descriptor that is sent with the bytes is ignored. */
static void test_descriptors(void) {
    const int before = dup(STDERR_FILENO);
    close(before);
    script s = {.size = 0};
    add_text(&s, MESSAGE_FILE, 100, "a.bin");
    CHECK1(lying_run(&box, s.bytes, s.size, STDERR_FILENO) == BROKER_GONE);
    const int after = dup(STDERR_FILENO);
    close(after);
    CHECK(after == before, "%d, before %d", after, before);
}

/* ---- Processes ---- */

enum { CHANNEL = 3, WATCHDOG_SECONDS = 100, NOT_ENDED = 42 };

static void end_unended(int number) {
    (void)number;
    _exit(NOT_ENDED);
}

/* A worker that continues after a wrong message, or after closing the channel, is ended. */
static void test_process(int closes) {
    burnish_error ended = {BURNISH_STATUS_OK, ""}, error = {BURNISH_STATUS_OK, ""};
    sandbox_plan plan = box.plan;
    int code = 0;
    plan.ended = &ended;
    const burnish_status status = sandbox_begin(&plan, &code, &error);
    if (status == BURNISH_STATUS_OK && code < 0) {
        script s = {.size = 0};
        add_text(&s, MESSAGE_FILE, 100, "sUB/../../secret.txt");
        if (closes) {
            close(CHANNEL);
        } else if (write(CHANNEL, s.bytes, s.size) != (ssize_t)s.size) {
            _exit(1);
        }
        signal(SIGALRM, end_unended);
        alarm(WATCHDOG_SECONDS); /* where the broker waits for it */
        for (;;) {
            pause();
        }
    }
    CHECK_OK(status, error);
    CHECK(code == (closes ? burnish_status_exit_code(BURNISH_STATUS_MEMORY) : 1), "%d", code);
    CHECK_TEXT(ended.text, closes ? "out of memory: the system ended the program"
                                  : "the sandbox ended the program: it requested what drawing "
                                    "does not need; report the input");
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    signal(SIGPIPE, SIG_IGN);
    if (!CHECK(lying_begin(&box), "%s: %s", box.path, strerror(errno))) {
        return test_end("broker");
    }
    RUN(test_files());
    RUN(test_escapes());
    RUN(test_long_names());
    RUN(test_outputs());
    RUN(test_other_outputs());
    RUN(test_failed_output());
    RUN(test_large_output());
    RUN(test_video());
    RUN(test_order());
    RUN(test_sizes());
    RUN(test_import());
    RUN(test_decode());
    RUN(test_descriptors());
    if (sandbox_is_built()) {
        RUN(test_process(0));
        RUN(test_process(1));
    }
    lying_end(&box);
    return test_end("broker");
}
