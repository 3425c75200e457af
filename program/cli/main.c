/* burnish: the program, and the table of its commands. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#ifdef _WIN32
#include <process.h>
#endif

#include "base/cli/program.h"
#include "base/cli/values.h"
#include "cli/colors.h"
#include "cli/input.h"
#include "cli/main.h"

static const cli_command lobe_command = {
    .name = "lobe",
    .program = "burnish-lobe",
    .operand = "COMMAND",
    .summary = "numbers, claims and figures of the lobes: lobe/docs/lobes.md",
    .manual = "Runs *burnish-lobe* with the same arguments: see burnish-lobe(1). If it is not "
              "installed next to *burnish*, the exit code is 12.",
};

#define ROW(table) &table,
static const cli_command *const commands[] = {CLI_COMMAND_LIST(ROW) & lobe_command,
                                              &cli_help_command, NULL};
#undef ROW

static const cli_example examples[] = {
    {"burnish part.stl", "writes part.png"},
    {"burnish part.stl part.png --size=256", "a thumbnail"},
    {"burnish render part.stl --views=front,right,top,iso -o sheet.png", "a sheet of views"},
    {"burnish render :teapot --lobe=power,schlick,energy:2,taylor:2", "lobes side by side"},
    {"burnish render part.obj --json --fail-on-blank", "a report for programs"},
    {"burnish batch parts --recursive -d thumbs --index", "many files, and an index page"},
    {"burnish compare before.stl after.stl -o changes.png", "the differences"},
    {"burnish render - --input-format=ply -o - <in.ply >out.png", "in a pipe"},
    {NULL, NULL},
};

static const cli_section environment = {
    .heading = "ENVIRONMENT",
    .terms =
        (const cli_term[]){
            {"*BURNISH_IMPORTERS*",
             "the folder of the programs *burnish-import-assimp* and *burnish-import-occt*, which "
             "read other formats (FBX, COLLADA, STEP ...), instead of the folder in which they are "
             "installed."},
            {"*BURNISH_ISA*", "the instruction set if *--isa* is *auto*; the same values."},
            {"*PATH*", "the folders of ffmpeg, for videos."},
            {NULL, NULL},
        },
    .closing = "The locale is ignored: the decimal separator is always a point.",
};

/* ---- Programs of other commands ---- */

/* Whether the program is in that folder, or in the one of importers; *path receives its name. */
static int find_beside(char *folder, const char *name, char *path, size_t size) {
    static const char *const below[] = {"", "/" BURNISH_IMPORTERS_FOLDER};
#ifdef _WIN32
    char *slash = strrchr(folder, '\\');
    const char *const extension = ".exe";
#else
    char *slash = strrchr(folder, '/');
    const char *const extension = "";
#endif
    *(slash ? slash : folder) = 0;
    for (size_t i = 0; i < sizeof below / sizeof *below; ++i) {
        const int length = snprintf(path, size, "%s%s/%s%s", folder, below[i], name, extension);
        if (length > 0 && (size_t)length < size && access(path, R_OK) == 0) {
            return 1;
        }
    }
    return 0;
}

#ifdef _WIN32
/* In quotes, for the C library that splits the command line again. Never released: the program ends. */
static char *quote(const char *text) {
    char *const quoted = malloc(2 * strlen(text) + 3), *at = quoted;
    size_t slashes = 0;
    if (!quoted) {
        return NULL;
    }
    for (*at++ = '"'; *text; *at++ = *text++) {
        for (slashes += *text == '"'; *text == '"' && slashes > 0; --slashes) {
            *at++ = '\\';
        }
        slashes = *text == '\\' ? slashes + 1 : 0;
    }
    for (; slashes > 0; --slashes) {
        *at++ = '\\';
    }
    memcpy(at, "\"", 2);
    return quoted;
}

static int run(const char *path, char **words) {
    for (char **word = words; *word; ++word) {
        *word = quote(*word);
        if (!*word) {
            return -1;
        }
    }
    return (int)_spawnv(_P_WAIT, path, (const char *const *)words);
}

static size_t own_path(char *path, size_t size) {
    char *name = NULL;
    return _get_pgmptr(&name) == 0 ? (size_t)snprintf(path, size, "%s", name) : 0;
}
#else
static int run(const char *path, char **words) {
    execv(path, words); /* returns only if it fails */
    return -1;
}

static size_t own_path(char *path, size_t size) {
    const ssize_t length = readlink("/proc/self/exe", path, size - 1);
    return length > 0 ? (size_t)length : 0;
}
#endif

/* As git does with its commands: `burnish lobe table` is `burnish-lobe table`. */
static int start_beside(const cli_command *command, int argc, char **argv) {
    char own[4000] = "", path[4200], name[CLI_NAME_MAX];
    const size_t length = own_path(own, sizeof own - 1);
    snprintf(name, sizeof name, "%s", command->program);
    own[length < sizeof own ? length : 0] = 0;
    if (!find_beside(own, name, path, sizeof path)) {
        fprintf(stderr,
                "burnish: %s: %s is not installed next to this program; install it, or build it by "
                "cmake -S lobe\n",
                command->name, name);
        return CLI_EXIT_NO_PROGRAM;
    }
    char **words = calloc((size_t)argc + 2, sizeof *words);
    int code = -1;
    if (words) {
        words[0] = name;
        memcpy(words + 1, argv, (size_t)argc * sizeof *words);
        fflush(stdout);
        code = run(path, words);
    }
    if (code < 0) {
        fprintf(stderr, "burnish: %s: %s can't be started: %s; install it again\n", command->name,
                path, strerror(errno));
        code = CLI_EXIT_NO_PROGRAM;
    }
    free(words);
    return code;
}

/* Whether the first argument is a mesh or a flag instead of a command: `render` is implied. */
static int implies_render(const char *argument) {
    const char *dot = strrchr(argument, '.');
    return argument[0] == ':' || argument[0] == '-' || strchr(argument, '/') ||
           (dot && strlen(dot) <= 5) || access(argument, F_OK) == 0;
}

static const cli_program burnish = {
    .name = "burnish",
    .summary = "renders 3-D models without a GPU, with the same pixels everywhere",
    .man_date = "2026-11-28",
    .description =
        "*burnish* renders 3-D models (meshes) to images without a GPU, display or toolkit. Its "
        "highlights use a family of specular lobes without pow and division.\nThe same input and "
        "flags give the same pixels on every processor, with every compiler and any number of "
        "threads, and the hash in *--json* can be compared between machines.\nEvery command has "
        "*-h* and *--help*, which list its flags on one screen. Commands with many flags list the "
        "common ones; *--help=*_TOPIC_ lists others, and *--help=all* all of them.",
    .commands = commands,
    .usage = "burnish INPUT [OUTPUT] [options], or burnish COMMAND [options]",
    .advice = "\"burnish render :teapot\" or \"burnish --help\"",
    .implied = &render_command,
    .options = &render_options_command,
    .implied_work = render_work,
    .implies = implies_render,
    .start = start_beside,
    .examples = examples,
    .values = &cli_color_section,
    .environment = &environment,
    .see_also = ".BR burnish\\-lobe (1),\n.BR man (1),\n.BR xxhsum (1)",
};

int main(int argc, char **argv) {
    cli_is_input_name = cli_is_mesh_name;
    return cli_run_program(&burnish, argc, argv);
}
