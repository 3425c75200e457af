/* Many inputs of `burnish render`: a batch that draws all and remembers nothing. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "batch/batch.h"
#include "cli/main.h"
#include "picture/formats.h"

#ifdef _WIN32

burnish_status batch_draw_inputs(const render_settings *settings, cli_call *call,
                                 burnish_error *error) {
    (void)settings, (void)call;
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "render: one INPUT at a time on this system, and its picture's whole name");
}

#else

static burnish_status check_many(const render_settings *settings, burnish_error *error) {
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
        const char *name = call->arguments[i].flag ? call->arguments[i].flag->name : "";
        is = strcmp(name, "no-sandbox") == 0 || (is && strcmp(name, "sandbox") != 0);
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

burnish_status batch_draw_inputs(const render_settings *settings, cli_call *call,
                                 burnish_error *error) {
    batch_settings many = {.render = *settings,
                           .output = settings->output.path,
                           .output_dir = settings->output.folder,
                           .files_from = settings->job.files_from,
                           .report = settings->output.json,
                           .jobs = settings->job.threads,
                           .force = 1,
                           .has_no_report = !settings->output.json,
                           .is_render = 1,
                           .no_sandbox = is_unlocked(call)};
    char standard[64], *folder = NULL;
    burnish_status status = check_many(settings, error);
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
