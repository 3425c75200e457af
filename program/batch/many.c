/* The work of `burnish render`: one input, or many as a batch without a report. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "batch/batch.h"
#include "cli/main.h"
#include "picture/formats.h"
#include "render/flags.h"
#include "render/render.h"

#ifdef _WIN32

static burnish_status draw_many(const render_settings *settings, cli_call *call,
                                burnish_error *error) {
    (void)settings, (void)call;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "render: one INPUT at a time on this system, and its picture's whole name");
}

#else

static burnish_status check(const render_settings *settings, burnish_error *error) {
    const char *alone = settings->output.planes.count > 0  ? "plane"
                        : settings->output.turntable       ? "turntable"
                        : settings->output.reference       ? "reference"
                        : settings->job.timing             ? "timing"
                        : settings->picture.rows.count > 0 ? "rows"
                                                           : NULL;
    return alone ? cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--%s: is of one picture; draw one INPUT, without --output-dir", alone)
                 : BURNISH_STATUS_OK;
}

/* Whether --no-sandbox is the last of the sandbox flags. */
static int is_unlocked(const cli_call *call) {
    int is = 0;
    for (size_t i = 0; i < call->argument_count; ++i) {
        const cli_flag *flag = call->arguments[i].flag;
        if (flag && strcmp(flag->name, "no-sandbox") == 0) {
            is = 1;
        } else if (flag && strcmp(flag->name, "sandbox") == 0) {
            is = 0;
        }
    }
    return is;
}

/* The folders before the first placeholder of a template, with their slash. */
static size_t folder_size(const char *text) {
    size_t size = strcspn(text, "{");
    while (size > 0 && text[size - 1] != '/') {
        --size;
    }
    return size;
}

static burnish_status draw_many(const render_settings *settings, cli_call *call,
                                burnish_error *error) {
    batch_settings many = {.render = *settings,
                           .output = settings->output.path,
                           .output_dir = settings->output.folder,
                           .files_from = settings->job.files_from,
                           .report = settings->output.json,
                           .jobs = settings->job.threads,
                           .force = 1,
                           .has_no_report = !settings->output.json,
                           .no_sandbox = is_unlocked(call)};
    char standard[64], *folder = NULL;
    burnish_status status = check(settings, error);
    if (status == BURNISH_STATUS_OK && settings->job.recursive) {
        status = cli_set(&batch_command, "recursive", NULL, &many, error); /* as given */
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (!many.output) {
        snprintf(standard, sizeof standard, "{folder}{model}.%s",
                 picture_extension(settings->output.format == PICTURE_AUTO
                                       ? PICTURE_PNG
                                       : (picture_format)settings->output.format));
        many.output = standard;
    } else if (!many.output_dir) { /* a template names its folder itself */
        const size_t size = folder_size(many.output);
        folder = strndup(many.output, size);
        many.output_dir = size > 0 ? folder : NULL;
        many.output += size;
    }
    many.output_dir = many.output_dir ? many.output_dir : ".";
    many.render.output.overwrite |= settings->output.path != NULL;
    many.render.output.path = NULL;
    many.render.output.json = NULL;
    status = batch_draw(&many, call, error);
    free(folder);
    return status;
}

#endif

/* Whether pictures are named after inputs. */
static int is_template(const char *output) {
    static const char *const words[] = {"{model}", "{folder}", "{extension}", "{view}"};
    for (size_t i = 0; output && i < sizeof words / sizeof *words; ++i) {
        if (strstr(output, words[i])) {
            return 1;
        }
    }
    return 0;
}

static int is_folder(const char *name) {
    struct stat state;
    return stat(name, &state) == 0 && S_ISDIR(state.st_mode);
}

static int ends_in_slash(const char *name) {
    return *name && name[strlen(name) - 1] == '/';
}

/* Draws into a folder that is there, as cp copies into one. The picture of a single input still has
 * all flags of one picture. */
static burnish_status take_folder(render_settings *settings, const cli_call *call,
                                  const char *folder, burnish_error *error) {
    if (!is_folder(folder)) {
        return cli_fail(error, BURNISH_STATUS_WRITE,
                        "%.200s: there is no such folder; create it, or use --output-dir=%.200s, "
                        "which creates it",
                        folder, folder);
    }
    settings->output.path = NULL;
    if (call->operand_count == 1 && !settings->job.files_from && !settings->job.recursive &&
        !is_folder(call->operands[0])) {
        settings->output.place = folder;
    } else {
        settings->output.folder = folder;
    }
    return BURNISH_STATUS_OK;
}

/* "render part.stl part.png": a last operand that can only be an output is the output. Other images
 * are mistakes; with -o and -d they are allowed, since a shell's * can list textures among meshes. */
static burnish_status take_output_operand(render_settings *settings, cli_call *call,
                                          burnish_error *error) {
    const int is_many = call->operand_count > 2 || settings->job.files_from;
    const char *last = NULL, *image = NULL;
    size_t images = 0;
    for (size_t i = 0; i < call->argument_count; ++i) {
        if (!call->arguments[i].flag) {
            last = call->arguments[i].text;
            const int is_image = picture_is_name(last) && !is_folder(last);
            image = is_image && !image ? last : image;
            images += (size_t)is_image;
        }
    }
    const int is_standard = strcmp(last, "-") == 0,
              is_place = ends_in_slash(last) || is_folder(last);
    if (images > 0 && (images > 1 || image != last || is_many)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "render: \"%.200s\" is an image, not a mesh; for several pictures, name "
                        "a folder with -d",
                        image);
    }
    if (is_standard && is_many) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "render: standard output takes one picture; for several, name a folder "
                        "with -d");
    }
    if (!is_place && !is_standard && images == 0) {
        return BURNISH_STATUS_OK;
    }
    call->operand_count -= 1;
    size_t at = call->argument_count - 1;
    while (call->arguments[at].flag) {
        --at;
    }
    memmove(&call->arguments[at], &call->arguments[at + 1],
            (--call->argument_count - at) * sizeof *call->arguments);
    if (is_place) {
        return take_folder(settings, call, last, error);
    }
    if (picture_is_animation(last)) {
        settings->output.turntable = last;
    } else {
        settings->output.path = last;
        settings->output.is_derived = !is_standard; /* replaces only pictures of burnish */
    }
    return BURNISH_STATUS_OK;
}

/* Finds the folder or file of the output: the value of -o, or the last operand. */
static burnish_status choose_output(render_settings *settings, cli_call *call,
                                    burnish_error *error) {
    const render_output_settings *output = &settings->output;
    if (output->folder || output->turntable) {
        return BURNISH_STATUS_OK;
    }
    if (output->path) {
        return !is_template(output->path) &&
                       (ends_in_slash(output->path) || is_folder(output->path))
                   ? take_folder(settings, call, output->path, error)
                   : BURNISH_STATUS_OK;
    }
    return call->operand_count > 1 ? take_output_operand(settings, call, error) : BURNISH_STATUS_OK;
}

burnish_status render_work(void *from, cli_call *call, burnish_error *error) {
    render_settings *settings = from;
    const int has_list = settings->job.files_from != NULL;
    burnish_status status;
    if (call->operand_count == 0 && !has_list) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "render: no INPUT; try \"burnish render :teapot\" or \"burnish render --help\"");
    }
    status = choose_output(settings, call, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (call->operand_count > 1 || settings->output.folder || settings->job.recursive || has_list ||
        is_template(settings->output.path)) {
        return draw_many(settings, call, error);
    }
    if (is_folder(call->operands[0])) {
        return cli_fail(error, BURNISH_STATUS_READ,
                        "%.300s: is a folder; use --output-dir=FOLDER to draw all its meshes",
                        call->operands[0]);
    }
    return render_one(settings, call, error);
}
