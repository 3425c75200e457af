/* Outputs are complete or do not appear. */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "burnish/core.h"
#include "support.h"

#define CHECK_STATUS(call, expected) CHECK((call) == (expected), "not the expected status")

static char folder[] = TEST_BINARY_DIR "/output_test_XXXXXX";

/* The linker replaces the library's calls by these (CMakeLists.txt). */
static int rename_fails, renames, has_no_proc;
int __real_rename(const char *from, const char *to);
int __wrap_rename(const char *from, const char *to);
int __real_access(const char *path, int mode);
int __wrap_access(const char *path, int mode);

int __wrap_rename(const char *from, const char *to) {
    ++renames;
    errno = rename_fails;
    return rename_fails ? -1 : __real_rename(from, to);
}

int __wrap_access(const char *path, int mode) {
    errno = ENOENT;
    return has_no_proc && strncmp(path, "/proc/", 6) == 0 ? -1 : __real_access(path, mode);
}

static const char *path_of(const char *name) {
    static char path[sizeof folder + 64];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static int entry_count(void) {
    int count = 0;
    DIR *entries = opendir(folder);
    while (entries && readdir(entries)) {
        ++count;
    }
    if (entries) {
        closedir(entries);
    }
    return count - 2;
}

/* Whether the content of the file is exactly text. */
static int holds(const char *path, const char *text) {
    char bytes[64] = {0};
    FILE *file = fopen(path, "rb");
    size_t size = file ? fread(bytes, 1, sizeof bytes - 1, file) : 0;
    if (file) {
        fclose(file);
    }
    return file && size == strlen(text) && memcmp(bytes, text, size) == 0;
}

static mode_t mode_of(const char *path) {
    struct stat state = {0};
    return stat(path, &state) == 0 ? state.st_mode & 07777 : 0;
}

static void test_new_and_existing_file(void) {
    mode_t old_mask = umask(027);
    CHECK_STATUS(burnish_file_write(path_of("a"), "one", 3, NULL), BURNISH_STATUS_OK);
    CHECK(holds(path_of("a"), "one") && mode_of(path_of("a")) == 0640, "a new file, mode %o",
          mode_of(path_of("a")));
    CHECK(chmod(path_of("a"), 0604) == 0, "chmod");
    CHECK_STATUS(burnish_file_write(path_of("a"), "second", 6, NULL), BURNISH_STATUS_OK);
    CHECK(holds(path_of("a"), "second") && mode_of(path_of("a")) == 0604, "replaced, mode %o",
          mode_of(path_of("a")));
    umask(old_mask);
    CHECK_STATUS(burnish_file_write(path_of("a"), NULL, 0, NULL), BURNISH_STATUS_OK);
    CHECK(holds(path_of("a"), ""), "an empty file");
    CHECK(entry_count() == 1, "%d entries", entry_count());
    unlink(path_of("a"));
}

static void test_link(void) {
    CHECK(symlink("target", path_of("link")) == 0, "symlink");
    burnish_error error;
    CHECK_STATUS(burnish_file_write(path_of("link"), "new", 3, &error), BURNISH_STATUS_WRITE);
    CHECK(strstr(error.text, "/link: can't be written: it is a link to nothing; create what it "
                             "names, or remove it"),
          "%s", error.text);
    CHECK(entry_count() == 1, "%d entries", entry_count());
    CHECK_STATUS(burnish_file_write(path_of("target"), "old", 3, NULL), BURNISH_STATUS_OK);
    CHECK_STATUS(burnish_file_write(path_of("link"), "new", 3, NULL), BURNISH_STATUS_OK);
    struct stat state = {0};
    CHECK(lstat(path_of("link"), &state) == 0 && S_ISLNK(state.st_mode), "the link must stay");
    CHECK(holds(path_of("target"), "new"), "the link's target");
    unlink(path_of("link"));
    unlink(path_of("target"));
}

static void test_bare_name(void) {
    int here = open(".", O_RDONLY | O_DIRECTORY);
    CHECK(here >= 0 && chdir(folder) == 0, "chdir");
    CHECK_STATUS(burnish_file_write("bare", "x", 1, NULL), BURNISH_STATUS_OK);
    CHECK(holds(path_of("bare"), "x") && entry_count() == 1, "a name without a folder");
    unlink("bare");
    CHECK(fchdir(here) == 0, "fchdir");
    close(here);
}

static void test_bad_paths(void) {
    burnish_error error;
    char expected[sizeof folder + 200];
    CHECK_STATUS(burnish_file_write(NULL, "x", 1, &error), BURNISH_STATUS_ARGUMENT);
    CHECK_STATUS(burnish_file_write("", "x", 1, &error), BURNISH_STATUS_ARGUMENT);
    CHECK_TEXT(error.text, "output: no file name; give one, or - for standard output");
    CHECK_STATUS(burnish_file_write(folder, "x", 1, &error), BURNISH_STATUS_WRITE);
    snprintf(expected, sizeof expected, "%s: can't be written: it is a folder; name a file in it",
             folder);
    CHECK_TEXT(error.text, expected);
    CHECK_STATUS(burnish_file_write(path_of("no/x.png"), "x", 1, &error), BURNISH_STATUS_WRITE);
    snprintf(expected, sizeof expected,
             "%s/no/x.png: can't be written: No such file or directory; create the folder first",
             folder);
    CHECK_TEXT(error.text, expected);
    CHECK_STATUS(burnish_file_write(path_of("f"), "x", 1, NULL), BURNISH_STATUS_OK);
    CHECK_STATUS(burnish_file_write(path_of("f/x.png"), "x", 1, &error), BURNISH_STATUS_WRITE);
    CHECK(entry_count() == 1 && holds(path_of("f"), "x"), "nothing new");
    unlink(path_of("f"));
}

/* A full disk, imitated by a limit on file sizes: the write stops in the middle. */
static void test_failing_write(void) {
    struct rlimit old, low;
    getrlimit(RLIMIT_FSIZE, &old);
    low = old;
    low.rlim_cur = 1000;
    static char bytes[5000];
    CHECK_STATUS(burnish_file_write(path_of("kept"), "kept", 4, NULL), BURNISH_STATUS_OK);
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &low);
    burnish_error error = {0};
    burnish_status over = burnish_file_write(path_of("kept"), bytes, sizeof bytes, &error);
    burnish_status fresh = burnish_file_write(path_of("fresh"), bytes, sizeof bytes, NULL);
    setrlimit(RLIMIT_FSIZE, &old);
    CHECK(over == BURNISH_STATUS_WRITE && fresh == BURNISH_STATUS_WRITE, "%d %d", over, fresh);
    CHECK(strstr(error.text, "/kept: can't be written: File too large; raise the limit of file "
                             "sizes (ulimit -f)"),
          "%s", error.text);
    CHECK(holds(path_of("kept"), "kept"), "the old file must be as it was");
    CHECK(entry_count() == 1, "%d entries", entry_count());
    unlink(path_of("kept"));
}

/* As an ordinary user in a folder without permission; root can write everywhere. */
static void test_no_permission(void) {
    burnish_error error;
    CHECK_STATUS(burnish_file_write(path_of("mine"), "mine", 4, NULL), BURNISH_STATUS_OK);
    chmod(path_of("mine"), 0444);
    chmod(folder, 0555);
    int root = geteuid() == 0;
    if (root && seteuid(65534) != 0) {
        printf("no permission tests: can't become an ordinary user\n");
    } else if (stat(folder, &(struct stat){0}) != 0) { /* as in root's home */
        printf("no permission tests: %s is closed to ordinary users\n", folder);
        CHECK(!root || seteuid(0) == 0, "seteuid");
    } else {
        CHECK_STATUS(burnish_file_write(path_of("x"), "x", 1, &error), BURNISH_STATUS_WRITE);
        CHECK(strstr(error.text, "/x: can't be written: no file can be made in its folder "
                                 "(Permission denied); name one elsewhere, or write to standard "
                                 "output"),
              "%s", error.text);
        CHECK(!root || seteuid(0) == 0, "seteuid");
        /* The folder allows a rename now, but the file does not. */
        chmod(folder, 0777);
        CHECK(!root || seteuid(65534) == 0, "seteuid");
        CHECK_STATUS(burnish_file_write(path_of("mine"), "x", 1, NULL), BURNISH_STATUS_WRITE);
        CHECK(!root || seteuid(0) == 0, "seteuid");
    }
    chmod(folder, 0755);
    CHECK(entry_count() == 1 && holds(path_of("mine"), "mine"), "nothing changed");
    unlink(path_of("mine"));
}

static void test_devices(void) {
    burnish_error error;
    struct stat state = {0};
    CHECK_STATUS(burnish_file_write("/dev/null", "x", 1, NULL), BURNISH_STATUS_OK);
    CHECK(stat("/dev/null", &state) == 0 && S_ISCHR(state.st_mode), "/dev/null must stay");
    CHECK_STATUS(burnish_file_write("/dev/full", "x", 1, &error), BURNISH_STATUS_WRITE);
    CHECK_TEXT(error.text, "/dev/full: can't be written: No space left on device; free some space");
    CHECK(stat("/dev/full", &state) == 0 && S_ISCHR(state.st_mode), "/dev/full must stay");
}

/* Reads everything from file in a child process, which checks for `size` bytes of the pattern 0, 1,
 * 2, ... 250, 0, ... and exits with the result. */
static pid_t start_reader(int file, int unused, size_t size) {
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        if (unused >= 0) {
            close(unused);
        }
        size_t total = 0;
        int good = 1;
        uint8_t bytes[5000];
        ssize_t got;
        while ((got = read(file, bytes, sizeof bytes)) > 0) {
            for (ssize_t i = 0; i < got; ++i) {
                good &= bytes[i] == (total + (size_t)i) % 251;
            }
            total += (size_t)got;
        }
        _exit(good && total == size ? 0 : 1);
    }
    return child;
}

static int reader_is_content(pid_t child) {
    int status;
    return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/* Standard output as a pipe that doesn't block: many short writes and waits. Then a closed one. */
static void test_standard_output(void) {
    enum { SIZE = 1000003 };
    uint8_t *bytes = malloc(SIZE);
    for (size_t i = 0; bytes && i < SIZE; ++i) {
        bytes[i] = (uint8_t)(i % 251);
    }
    int ends[2];
    if (!CHECK(bytes && pipe(ends) == 0, "pipe")) {
        free(bytes);
        return;
    }
    pid_t reader = start_reader(ends[0], ends[1], SIZE);
    close(ends[0]);
    fflush(stdout);
    int saved = dup(STDOUT_FILENO);
    dup2(ends[1], STDOUT_FILENO);
    fcntl(STDOUT_FILENO, F_SETFL, O_NONBLOCK);
    burnish_status whole = burnish_file_write("-", bytes, SIZE, NULL);
    close(ends[1]);
    dup2(saved, STDOUT_FILENO);
    CHECK_STATUS(whole, BURNISH_STATUS_OK);
    CHECK(reader_is_content(reader), "the reader got other bytes");

    signal(SIGPIPE, SIG_IGN);
    burnish_error error = {0};
    CHECK(pipe(ends) == 0 && close(ends[0]) == 0, "pipe");
    fflush(stdout);
    dup2(ends[1], STDOUT_FILENO);
    close(ends[1]);
    burnish_status closed = burnish_file_write("-", bytes, SIZE, &error);
    dup2(saved, STDOUT_FILENO);
    close(saved);
    CHECK_STATUS(closed, BURNISH_STATUS_WRITE);
    CHECK_TEXT(error.text,
               "standard output: can't be written: Broken pipe; the reader closed the pipe");
    free(bytes);
}

static void test_fifo(void) {
    uint8_t bytes[251];
    for (size_t i = 0; i < sizeof bytes; ++i) {
        bytes[i] = (uint8_t)i;
    }
    CHECK(mkfifo(path_of("fifo"), 0600) == 0, "mkfifo");
    /* Opened for reading and writing, so neither open blocks. */
    int held = open(path_of("fifo"), O_RDWR);
    int file = open(path_of("fifo"), O_RDONLY);
    CHECK_STATUS(burnish_file_write(path_of("fifo"), bytes, sizeof bytes, NULL), BURNISH_STATUS_OK);
    close(held);
    pid_t reader = start_reader(file, -1, sizeof bytes);
    close(file);
    CHECK(reader_is_content(reader), "the reader got other bytes");
    struct stat state = {0};
    CHECK(stat(path_of("fifo"), &state) == 0 && S_ISFIFO(state.st_mode), "the pipe must stay");
    unlink(path_of("fifo"));
}

/* Ends the process when half of the output is written. */
static size_t deadly_source(void *context, char *buffer, size_t size) {
    int *calls = context;
    if (++*calls == 3) {
        kill(getpid(), SIGKILL);
    }
    memset(buffer, 'x', size);
    return size;
}

/* A process that is killed while it writes leaves only the old file, if the file system supports
 * unnamed files. */
static void test_killed_writer(void) {
    int nameless = open(folder, O_TMPFILE | O_WRONLY, 0600);
    CHECK_STATUS(burnish_file_write(path_of("a"), "old", 3, NULL), BURNISH_STATUS_OK);
    if (nameless >= 0) {
        close(nameless);
        pid_t child = fork();
        if (child == 0) {
            int calls = 0;
            burnish_file_write_stream(path_of("a"), deadly_source, &calls, NULL, NULL);
            _exit(0);
        }
        int result = 0;
        CHECK(child > 0 && waitpid(child, &result, 0) == child && WIFSIGNALED(result),
              "the writer was not killed: %d", result);
        CHECK(entry_count() == 1, "%d files", entry_count());
    }
    CHECK(holds(path_of("a"), "old"), "the old file is gone");
    unlink(path_of("a"));
}

/* The message has the reason for names of any length. */
static void test_long_file_name(void) {
    static char path[3000];
    burnish_error error;
    memset(path, 'x', sizeof path - 1);
    CHECK_STATUS(burnish_file_write(path, "a", 1, &error), BURNISH_STATUS_WRITE);
    CHECK(strncmp(error.text, "...xxx", 6) == 0 &&
              strstr(error.text, "x: can't be written: File name too long"),
          "%s", error.text);
}

/* A new file gets its name directly, with and without unnamed files. */
static void test_renames(void) {
    burnish_error error;
    for (has_no_proc = 0; has_no_proc <= 1; ++has_no_proc) {
        int nameless = open(folder, O_TMPFILE | O_WRONLY, 0600);
        renames = 0;
        CHECK_STATUS(burnish_file_write(path_of("r"), "1", 1, NULL), BURNISH_STATUS_OK);
        CHECK(renames == (has_no_proc || nameless < 0), "%d renames of a new file", renames);
        CHECK_STATUS(burnish_file_write(path_of("r"), "2", 1, NULL), BURNISH_STATUS_OK);
        CHECK(holds(path_of("r"), "2"), "replaced");
        rename_fails = EBUSY; /* as for a file mounted into a container */
        CHECK_STATUS(burnish_file_write(path_of("r"), "3", 1, &error), BURNISH_STATUS_WRITE);
        rename_fails = 0;
        CHECK(strstr(error.text, "/r: can't be written: Device or resource busy; something is "
                                 "mounted on it, so it can't be replaced: name another file, or "
                                 "write to standard output"),
              "%s", error.text);
        CHECK(holds(path_of("r"), "2") && entry_count() == 1, "%d entries", entry_count());
        unlink(path_of("r"));
        if (nameless >= 0) {
            close(nameless);
        }
    }
    has_no_proc = 0;
}

/* The effect of a SIGTERM handler during a write. */
static size_t interrupted_source(void *context, char *buffer, size_t size) {
    int *entries = context;
    if (entries[0] == 0) {
        entries[0] = entry_count();
        burnish_file_remove_temporaries();
        entries[1] = entry_count();
        memset(buffer, 'x', size);
        return size;
    }
    return 0;
}

static void test_remove_temporaries(void) {
    int entries[2] = {0, 0};
    has_no_proc = 1;
    CHECK_STATUS(burnish_file_write_stream(path_of("t"), interrupted_source, entries, NULL, NULL),
                 BURNISH_STATUS_WRITE);
    has_no_proc = 0;
    CHECK(entries[0] == 1 && entries[1] == 0, "%d entries, then %d", entries[0], entries[1]);
    CHECK(entry_count() == 0, "%d entries", entry_count());
    burnish_file_remove_temporaries();
}

static burnish_status refuse(void *context, burnish_error *error) {
    int *entries = context;
    *entries = entry_count();
    error->status = BURNISH_STATUS_MEMORY;
    snprintf(error->text, sizeof error->text, "no report");
    return BURNISH_STATUS_MEMORY;
}

/* A last step that fails leaves the old file, or none. */
static void test_last_step(void) {
    burnish_error error;
    for (has_no_proc = 0; has_no_proc <= 1; ++has_no_proc) {
        int entries = -1;
        CHECK_STATUS(burnish_file_write_checked(path_of("l"), "new", 3, refuse, &entries, &error),
                     BURNISH_STATUS_MEMORY);
        CHECK_TEXT(error.text, "no report");
        CHECK(entries >= 0 && entry_count() == 0, "%d entries", entry_count());
        CHECK_STATUS(burnish_file_write(path_of("l"), "old", 3, NULL), BURNISH_STATUS_OK);
        CHECK_STATUS(burnish_file_write_checked(path_of("l"), "new", 3, refuse, &entries, &error),
                     BURNISH_STATUS_MEMORY);
        CHECK(holds(path_of("l"), "old") && entry_count() == 1, "%d entries", entry_count());
        unlink(path_of("l"));
    }
    has_no_proc = 0;
}

typedef struct broken_stream {
    int calls;
    burnish_status status; /* of the last step */
} broken_stream;

static size_t three_bytes(void *context, char *buffer, size_t size) {
    broken_stream *stream = context;
    memcpy(buffer, "new", size < 3 ? size : 3);
    return stream->calls++ == 0 ? 3 : 0;
}

static burnish_status last_status(void *context, burnish_error *error) {
    broken_stream *stream = context;
    error->status = stream->status;
    return stream->status;
}

/* If a source fails, which the last step reports, the old file stays. */
static void test_last_step_of_stream(void) {
    burnish_error error;
    for (has_no_proc = 0; has_no_proc <= 1; ++has_no_proc) {
        broken_stream stream = {0, BURNISH_STATUS_LIMIT};
        CHECK_STATUS(burnish_file_write(path_of("s"), "old", 3, NULL), BURNISH_STATUS_OK);
        CHECK_STATUS(
            burnish_file_write_stream(path_of("s"), three_bytes, &stream, last_status, &error),
            BURNISH_STATUS_LIMIT);
        CHECK(stream.calls == 2 && holds(path_of("s"), "old") && entry_count() == 1, "%d entries",
              entry_count());
        stream = (broken_stream){0, BURNISH_STATUS_OK};
        CHECK_STATUS(
            burnish_file_write_stream(path_of("s"), three_bytes, &stream, last_status, &error),
            BURNISH_STATUS_OK);
        CHECK(holds(path_of("s"), "new") && entry_count() == 1, "%d entries", entry_count());
        unlink(path_of("s"));
    }
    has_no_proc = 0;
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    if (!mkdtemp(folder)) {
        printf("can't make %s\n", folder);
        return EXIT_FAILURE;
    }
    RUN(test_new_and_existing_file());
    RUN(test_link());
    RUN(test_bare_name());
    RUN(test_bad_paths());
    RUN(test_failing_write());
    RUN(test_no_permission());
    RUN(test_devices());
    RUN(test_standard_output());
    RUN(test_fifo());
    RUN(test_killed_writer());
    RUN(test_long_file_name());
    RUN(test_renames());
    RUN(test_remove_temporaries());
    RUN(test_last_step());
    RUN(test_last_step_of_stream());
    CHECK(rmdir(folder) == 0, "something was left in %s", folder);
    return test_end("output");
}
