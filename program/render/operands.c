/* What the operands of `burnish render` are: inputs, and perhaps the output. */
#include <string.h>
#include <sys/stat.h>

#include "picture/formats.h"
#include "render/render.h"

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
    const int is_scene = settings->input.load.scene;
    const int is_many = (call->operand_count > 2 && !is_scene) || settings->job.files_from;
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
                        "render: \"%.200s\" is an image, not a mesh; for several pictures, name a "
                        "folder with -d",
                        image);
    }
    if (is_standard && is_many) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "render: standard output takes one picture; for several, name a folder with -d");
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

burnish_status render_read_operands(render_settings *settings, cli_call *call, int *is_many,
                                    burnish_error *error) {
    const int has_list = settings->job.files_from != NULL;
    if (call->operand_count == 0 && !has_list) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "render: no INPUT; try \"burnish render :teapot\" or \"burnish render --help\"");
    }
    const burnish_status status = choose_output(settings, call, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    *is_many = (call->operand_count > 1 && !settings->input.load.scene) ||
               settings->output.folder || settings->job.recursive || has_list ||
               is_template(settings->output.path);
    if (*is_many && settings->input.load.scene) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--scene: makes one picture; not with --recursive, --files-from or names "
                        "of pictures after those of inputs; omit it or them");
    }
    if (!*is_many && is_folder(call->operands[0])) {
        return cli_fail(error, BURNISH_STATUS_READ,
                        "%.300s: is a folder; use --output-dir=FOLDER to draw all its meshes",
                        call->operands[0]);
    }
    return BURNISH_STATUS_OK;
}
