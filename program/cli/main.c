/* burnish: the program, and the table of its commands. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/cli/process.h"
#include "base/cli/program.h"
#include "base/cli/run.h"
#include "base/cli/values.h"
#include "cli/colors.h"
#include "cli/input.h"
#include "cli/main.h"

static const cli_command lobe_command = {
    .name = "lobe",
    .program = "burnish-lobe",
    .operand = "COMMAND",
    .summary = "numbers and claims of the lobes: lobe/docs/lobes.md",
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

#define EXIT_CODE(name, code, text) {text, code},
static const cli_word exits[] = {CLI_EXIT_LIST(EXIT_CODE){NULL, 0}};
#undef EXIT_CODE

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

/* Whether the program is in this program's folder, or in the one of importers. */
static int find_beside(const char *name, char path[CLI_PATH_SIZE]) {
    static const char *const below[] = {"", "/" BURNISH_IMPORTERS_FOLDER};
    char folder[CLI_PATH_SIZE];
    const int is_known = cli_program_folder(folder, sizeof folder);
    for (size_t i = 0; is_known && i < sizeof below / sizeof *below; ++i) {
        if (snprintf(path, CLI_PATH_SIZE, "%s%s/%s" CLI_PROGRAM_EXTENSION, folder, below[i], name) <
                CLI_PATH_SIZE &&
            access(path, R_OK) == 0) {
            return 1;
        }
    }
    return 0;
}

/* The other program does not know names of meshes: its outputs are text. */
static burnish_status check_outputs(int argc, char **argv, burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    for (int i = 0; i < argc && status == BURNISH_STATUS_OK; ++i) {
        const char *word = argv[i];
        const int is_flag = strcmp(word, "-o") == 0 || strcmp(word, "--output") == 0;
        const char *path = is_flag                              ? argv[i + 1]
                           : strncmp(word, "--output=", 9) == 0 ? word + 9
                           : strncmp(word, "-o", 2) == 0        ? word + 2
                                                                : NULL;
        if (path) {
            status = cli_check_output("output", path, 1, error);
        }
    }
    return status;
}

/* As git does with its commands: `burnish lobe table` is `burnish-lobe table`. */
static int start_beside(const cli_command *command, int argc, char **argv) {
    char path[CLI_PATH_SIZE], name[CLI_NAME_MAX];
    burnish_error error;
    const burnish_status status = check_outputs(argc, argv, &error);
    if (status != BURNISH_STATUS_OK) {
        return cli_exit_code(status, &error);
    }
    snprintf(name, sizeof name, "%s", command->program);
    if (!find_beside(name, path)) {
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
        code = cli_run_instead(path, words);
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
    .exits = exits,
    .examples = examples,
    .values = &cli_color_section,
    .environment = &environment,
    .see_also = ".BR burnish\\-lobe (1),\n.BR man (1),\n.BR xxhsum (1)",
};

/* The number of the first word for render; 0: the line is for another command, or for none. */
static int find_render_words(int argc, char **argv) {
    for (size_t i = 0; argc > 1 && commands[i]; ++i) {
        if (strcmp(argv[1], commands[i]->name) == 0) {
            return commands[i] == &render_command ? 2 : 0;
        }
    }
    return argc > 1 && implies_render(argv[1]);
}

int main(int argc, char **argv) {
    cli_is_input_name = cli_is_mesh_name;
    const int is_f3d = argc > 0 && f3d_is_name(argv[0]);
    if (!is_f3d && argc > 1 && strcmp(argv[1], "view") == 0 && !implies_render("view")) {
        return f3d_refuse_window("view");
    }
    const int first = is_f3d ? 1 : find_render_words(argc, argv);
    char **words = first > 0 ? f3d_translate(&argc, argv, first) : argv;
    const int code = words ? cli_run_program(&burnish, argc, words) : argc;
    return is_f3d && code != 0 ? EXIT_FAILURE : code;
}
