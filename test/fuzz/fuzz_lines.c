/* Random command lines: commands, flags and words come from the program's completions, values from
 * these words and from a list of numbers, names and nonsense, some with a byte changed. Each line
 * runs in its own process. It must end with a documented exit code within 20 s of processor time,
 * report errors in a line that begins with "burnish: ", and leave no temporary file.
 *
 * Usage: fuzz_lines BURNISH SCRATCH COUNT [SEED]
 * Prints lines that fail in the shell's syntax; then exits with 1. */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { COMMANDS_MAX = 32, FLAGS_MAX = 160, WORDS_MAX = 64, ARGUMENTS_MAX = 24, TEXT = 200 };

typedef struct flag {
    char name[48];
    int has_value;
    char words[WORDS_MAX][32];
    int word_count;
} flag;

typedef struct command {
    char name[48]; /* "lobe table" */
    flag flags[FLAGS_MAX];
    int flag_count;
} command;

static command commands[COMMANDS_MAX];
static int command_count;
static int is_exit_code[256];
static uint64_t state;

extern char **environ;

static uint32_t random_below(uint32_t bound) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)((state >> 33) % bound);
}

/* ---- The program's completions ---- */

static void fail_setup(const char *what) {
    fprintf(stderr, "fuzz_lines: %s\n", what);
    exit(2);
}

static FILE *ask(const char *program, const char *arguments) {
    char line[4096];
    snprintf(line, sizeof line, "'%s' %s", program, arguments);
    FILE *pipe = popen(line, "r");
    if (!pipe) {
        fail_setup("the program can't be asked");
    }
    return pipe;
}

/* The text between the quotes behind `before`, in place; NULL if there is none. */
static char *quoted(char *line, const char *before) {
    char *start = strstr(line, before), *end;
    start = start ? strchr(start, '\'') : NULL;
    end = start ? strchr(start + 1, '\'') : NULL;
    if (!end) {
        return NULL;
    }
    *end = 0;
    return start + 1;
}

static void read_flags(command *c, char *text) {
    for (char *word = strtok(text, " "); word && c->flag_count < FLAGS_MAX;
         word = strtok(NULL, " ")) {
        flag *f = &c->flags[c->flag_count++];
        snprintf(f->name, sizeof f->name, "%s", word);
        char *equals = strchr(f->name, '=');
        f->has_value = equals != NULL;
        if (equals) {
            *equals = 0;
        }
    }
}

static void read_words(command *c, const char *name, char *text) {
    for (int i = 0; i < c->flag_count; ++i) {
        flag *f = &c->flags[i];
        if (strcmp(f->name, name) != 0) {
            continue;
        }
        for (char *word = strtok(text, " "); word && f->word_count < WORDS_MAX;
             word = strtok(NULL, " ")) {
            snprintf(f->words[f->word_count++], sizeof *f->words, "%s", word);
        }
        return;
    }
}

static void read_completions(const char *program) {
    FILE *pipe = ask(program, "help --completion=bash");
    static char line[16384];
    command *c = NULL;
    while (fgets(line, sizeof line, pipe)) {
        char *text, name[48];
        if (line[4] == '\'' && strstr(line, "')") && command_count < COMMANDS_MAX) {
            c = &commands[command_count++];
            snprintf(c->name, sizeof c->name, "%s", quoted(line, "'"));
        } else if (c && sscanf(line, " flags=%1s", name) == 1 && (text = quoted(line, "flags="))) {
            read_flags(c, text);
        } else if (c && sscanf(line, " %47[-a-z]) words=", name) == 1 &&
                   (text = quoted(line, "words="))) {
            read_words(c, name, text);
        }
    }
    pclose(pipe);
    int flags = 0;
    for (int i = 0; i < command_count; ++i) {
        flags += commands[i].flag_count;
    }
    if (command_count < 5 || flags < 50) {
        fail_setup("the completions list too few commands or flags");
    }
}

static void read_exit_codes(const char *program) {
    FILE *pipe = ask(program, "--help");
    char line[512];
    int found = 0, code, in_list = 0;
    while (fgets(line, sizeof line, pipe)) {
        in_list |= strncmp(line, "Exit codes", 10) == 0;
        if (in_list && sscanf(line, " %d ", &code) == 1 && code >= 0 && code < 256) {
            is_exit_code[code] = 1;
            ++found;
        }
    }
    pclose(pipe);
    if (found < 5) {
        fail_setup("--help lists too few exit codes");
    }
}

/* ---- A line ---- */

static const char *const inputs[] = {":sphere",   ":torus",     ":teapot",  ":knot",    "cube.obj",
                                     "wedge.stl", "colors.ply", "none.obj", "-",        ".",
                                     "",          ":",          ":x",       "/dev/null"};
static const char *const outputs[] = {"out.png", "out.jpg", "out.svg", "out.webp",  "out.exr",
                                      "out.gif", "out.npy", "-",       "/dev/full", "none/x.png",
                                      ".",       "",        "out"};
static const char *const values[] = {"0",
                                     "1",
                                     "2",
                                     "3",
                                     "-1",
                                     "0.5",
                                     "1e9",
                                     "1e308",
                                     "-1e308",
                                     "nan",
                                     "inf",
                                     "1e-320",
                                     "",
                                     " ",
                                     ",",
                                     ",,",
                                     "1,2",
                                     "1,2,3",
                                     "0,0,0",
                                     "1,1,1,1",
                                     "-1,0,0,0.2",
                                     "1,2,3,4,5",
                                     "#fff",
                                     "#abcdef",
                                     "red",
                                     "none",
                                     "auto",
                                     "all",
                                     "+Z",
                                     "-X",
                                     "taylor:2",
                                     "minimax:8",
                                     "power",
                                     "level.5",
                                     "zeta3",
                                     "taylor:3",
                                     "camera-point:1,2,3",
                                     "directional:0,0,1:0.5:#fff",
                                     "front,top,iso",
                                     "front",
                                     "iso,iso",
                                     "depth:d.png",
                                     "normal:n.exr",
                                     "color:-",
                                     "axes,scale",
                                     "12,34",
                                     "100,10",
                                     "65536",
                                     "4294967296",
                                     "18446744073709551616",
                                     "5K",
                                     "%s%n",
                                     "a\tb",
                                     "\xff\xfe",
                                     "\xe2\x82\xac",
                                     "--",
                                     "-o",
                                     "=",
                                     "true"};
/* Flags whose larger values are valid but slow. */
static const char *const slow[] = {"--resolution", "--size",      "--frames",  "--tessellation",
                                   "--columns",    "--occlusion", "--samples", "--count",
                                   "--threads",    "--edge-width"};
static const char *const small[] = {"1",  "2", "16", "24", "24,16", "0",
                                    "-1", "x", "",   "3,", "1e1",   "none"};

#define PICK(list) list[random_below(sizeof(list) / sizeof *(list))]

static int is_slow(const char *name) {
    for (size_t i = 0; i < sizeof slow / sizeof *slow; ++i) {
        if (strcmp(slow[i], name) == 0) {
            return 1;
        }
    }
    return 0;
}

static void write_value(const flag *f, char *text) {
    const char *value = is_slow(f->name) ? PICK(small)
                        : f->word_count > 0 && random_below(4) > 0
                            ? f->words[random_below((uint32_t)f->word_count)]
                        : strcmp(f->name, "--output") == 0    ? PICK(outputs)
                        : strcmp(f->name, "--turntable") == 0 ? PICK(outputs)
                        : random_below(6) == 0                ? PICK(outputs)
                                                              : PICK(values);
    snprintf(text, 64, "%s", value);
    const size_t length = strlen(text);
    if (length > 0 && !is_slow(f->name) && !strchr(text, '/') && random_below(8) == 0) {
        const char changed = (char)(1 + random_below(255));
        text[random_below((uint32_t)length)] = changed == '/' ? '.' : changed;
    }
}

/* Fills `texts` with arguments, ended by NULL in `arguments`; the program comes first. */
static void make_line(char *program, char texts[][TEXT], char **arguments) {
    const command *c = &commands[random_below((uint32_t)command_count)];
    char name[48];
    int count = 0;
    snprintf(name, sizeof name, "%s", c->name);
    for (char *word = strtok(name, " "); word; word = strtok(NULL, " ")) {
        snprintf(texts[count++], TEXT, "%s", word);
    }
    const int draws = strcmp(c->name, "render") == 0 || strcmp(c->name, "compare") == 0;
    if (draws) { /* cheap unless a flag says otherwise */
        snprintf(texts[count++], TEXT, "--size=24");
        snprintf(texts[count++], TEXT, "--output=out.png");
    }
    const uint32_t operands = draws ? (strcmp(c->name, "render") == 0 ? 1 : 2) : random_below(2);
    for (uint32_t i = 0; i < operands + (random_below(10) == 0); ++i) {
        snprintf(texts[count++], TEXT, "%s",
                 random_below(3) > 0 ? inputs[random_below(7)] : PICK(inputs));
    }
    for (uint32_t left = random_below(7);
         left > 0 && c->flag_count > 0 && count < ARGUMENTS_MAX - 2; --left) {
        const flag *f = &c->flags[random_below((uint32_t)c->flag_count)];
        char value[64] = "";
        write_value(f, value);
        const int joined = f->has_value ? random_below(4) > 0 : random_below(30) == 0;
        snprintf(texts[count++], TEXT, joined ? "%s=%s" : "%s", f->name, value);
        if (f->has_value && !joined) {
            snprintf(texts[count++], TEXT, "%s", value);
        }
    }
    arguments[0] = program;
    for (int i = 0; i < count; ++i) {
        arguments[i + 1] = texts[i];
    }
    arguments[count + 1] = NULL;
}

/* ---- Running it ---- */

static double seconds_now(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void print_line(char *const *arguments) {
    for (; *arguments; ++arguments) {
        printf(" '");
        for (const char *c = *arguments; *c; ++c) {
            if (*c == '\'') {
                printf("'\\''");
            } else {
                putchar(*c);
            }
        }
        printf("'");
    }
    printf("\n");
}

/* Files that the program names itself while it writes. */
static int has_temporary(void) {
    DIR *folder = opendir(".");
    int found = 0;
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        found |= strncmp(entry->d_name, ".burnish", 8) == 0;
    }
    if (folder) {
        closedir(folder);
    }
    return found;
}

/* Whether a line of standard error begins with "burnish: ". */
static int says_why(void) {
    char line[4096];
    int found = 0;
    FILE *file = fopen("stderr.txt", "r");
    while (file && fgets(line, sizeof line, file)) {
        found |= strncmp(line, "burnish: ", 9) == 0 && strncmp(line, "burnish: warning", 16) != 0;
    }
    if (file) {
        fclose(file);
    }
    return found;
}

/* NULL, or what was wrong. *code is set if the process exited by itself. */
static const char *run(char **arguments, int *code) {
    posix_spawn_file_actions_t actions;
    pid_t child;
    int status = 0;
    const double start = seconds_now();
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 2, "stderr.txt", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int spawned = posix_spawn(&child, arguments[0], &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (spawned != 0) {
        fail_setup("the program can't be started");
    }
    prlimit(child, RLIMIT_CPU, &(struct rlimit){20, 20}, NULL);
    for (pid_t ended = 0; ended == 0;) {
        ended = waitpid(child, &status, WNOHANG);
        if (ended == 0 && seconds_now() - start > 120) { /* it waits instead of working */
            kill(child, SIGKILL);
            waitpid(child, &status, 0);
            return "did not end within two minutes";
        }
        if (ended == 0) {
            nanosleep(&(struct timespec){.tv_nsec = 500000}, NULL);
        }
    }
    if (!WIFEXITED(status)) {
        return "ended by a signal";
    }
    *code = WEXITSTATUS(status);
    return !is_exit_code[*code]                     ? "has an exit code that is not documented"
           : has_temporary()                        ? "left a temporary"
           : *code >= 2 && *code < 8 && !says_why() ? "did not say why"
                                                    : NULL;
}

int main(int count, char **options) {
    static char texts[ARGUMENTS_MAX][TEXT];
    char *arguments[ARGUMENTS_MAX + 2], program[4096];
    if (count < 4 || !realpath(options[1], program)) {
        fail_setup("usage: fuzz_lines BURNISH SCRATCH COUNT [SEED]");
    }
    const long lines = strtol(options[3], NULL, 10);
    state = count > 4 ? strtoull(options[4], NULL, 10) : 1;
    read_completions(program);
    read_exit_codes(program);
    if (chdir(options[2]) != 0) {
        fail_setup("the scratch folder is not there");
    }
    long failed = 0, done = 0;
    for (long i = 0; i < lines; ++i) {
        make_line(program, texts, arguments);
        int code = -1;
        const char *wrong = run(arguments, &code);
        done += code == 0;
        if (wrong) {
            printf("FAIL: %s:", wrong);
            print_line(arguments);
            ++failed;
        }
    }
    printf("fuzz_lines: %ld command lines, %ld of them did something, %ld failed\n", lines, done,
           failed);
    return failed > 0 || done < lines / 10;
}
