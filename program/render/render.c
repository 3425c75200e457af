/* `burnish render`: loads a mesh, draws one picture or a sheet, writes it and reports. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/cli/file.h"
#include "base/clock.h"
#include "batch/batch.h"
#include "burnish/core.h"
#include "burnish/drawing.h"
#include "burnish/render.h"
#include "burnish/sheet.h"
#include "cli/limits.h"
#include "cli/main.h"
#include "picture/formats.h"
#include "render/output/result.h"
#include "render/render.h"
#include "render/scene/join_inputs.h"
#include "render/scene/library_options.h"
#include "render/scene/prepare.h"
#include "render/useless.h"
#include "sandbox/process.h"
#include "sandbox/worker.h"

/* Processor time so far: of the dynamic loader and of start-up, for which there is no wall time. */
static double processor_seconds(void) {
    struct timespec used;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
    return (double)used.tv_sec + 1e-9 * (double)used.tv_nsec;
}

int render_judge_result(const render_result *result, burnish_error *line) {
    const char *input = result->settings->input.name;
    size_t unseen = 0; /* cells whose camera is right */
    if (result->blank_cells == 0 || !result->settings->output.fail_on_blank) {
        return render_is_different(result, line) ? CLI_EXIT_DIFFERENT : 0;
    }
    for (size_t i = 0; i < result->cell_count; ++i) {
        unseen += result->cells[i].report.covered_pixels > 0 && result->cells[i].has_one_color;
    }
    const char *cure = unseen == result->blank_cells ? "colours, lights and background"
                       : unseen > 0                  ? "camera, colours, lights and background"
                                                     : "the camera";
    if (result->cell_count > 1) {
        cli_fail(line, BURNISH_STATUS_OK,
                 "%.300s: %zu of %zu cells are blank; check %s; no file was written", input,
                 result->blank_cells, result->cell_count, cure);
    } else {
        cli_fail(line, BURNISH_STATUS_OK, "%.300s: the picture %s; check %s; no file was written",
                 input, unseen > 0 ? "has one colour" : "is blank", cure);
    }
    return CLI_EXIT_BLANK;
}

/* Called when the output's bytes are on disk under a temporary name: if printing the report fails,
 * an older picture stays. */
static burnish_status report_result(void *context, burnish_error *error) {
    render_result *result = context;
    double now = burnish_seconds_now();
    result->seconds.write = now - result->encoded;
    result->seconds.total = now - result->start;
    if (result->settings->job.on_result) {
        result->settings->job.on_result(result->settings->job.user_data, result);
    }
    return result->settings->output.json ? render_write_json(result, error) : BURNISH_STATUS_OK;
}

static burnish_status write_planes(const render_result *result, burnish_error *error) {
    const render_settings *settings = result->settings;
    burnish_status status = BURNISH_STATUS_OK;
    for (size_t i = 0; i < settings->output.planes.count && status == BURNISH_STATUS_OK; ++i) {
        const render_plane *plane = &settings->output.planes.items[i];
        picture_file file;
        status = render_encode_plane(&result->planes, plane, settings->job.threads, &file, error);
        if (status == BURNISH_STATUS_OK) {
            status = cli_file_write(plane->path, file.bytes, file.size, error);
        }
        picture_release(&file);
    }
    return status;
}

static burnish_status encode_picture(render_result *result, picture_file *file,
                                     burnish_error *error) {
    const render_settings *settings = result->settings;
    const picture_format format = (picture_format)settings->output.format;
    if (format == PICTURE_EXR || format == PICTURE_NPY) {
        return render_encode_planes(&result->planes, format, file, error);
    }
    if (picture_is_drawing(format)) {
        render_sheet sheet;
        if (burnish_mesh_get_splats(result->mesh)) {
            render_warn(&result->warnings, 1,
                        "%.300s: splats are not in drawings; use another format",
                        settings->input.name);
        }
        render_list_cells(result, &sheet);
        return render_encode_drawing(result, sheet.cells, sheet.ink, file, error);
    }
    const burnish_pixels pixels = burnish_image_get_pixels(result->picture);
    const picture_options options = {.threads = settings->job.threads,
                                     .quality = settings->output.quality,
                                     .dots_per_inch = settings->output.dots_per_inch.value};
    return picture_encode(format, &pixels, &options, file, error);
}

static burnish_status write_picture(render_result *result, burnish_error *error) {
    picture_file file = {0};
    burnish_status status = render_judge(result, error);
    double start = burnish_seconds_now();
    if (status == BURNISH_STATUS_OK) {
        status = encode_picture(result, &file, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = write_planes(result, error);
    }
    if (status == BURNISH_STATUS_OK) {
        result->encoded = burnish_seconds_now();
        result->seconds.encode = result->encoded - start;
        result->written = 1;
        status = cli_file_write_checked(render_output_path(&result->settings->output), file.bytes,
                                        file.size, report_result, result, error);
    }
    picture_release(&file);
    return status;
}

static burnish_status write_output(render_result *result, burnish_error *error) {
    const render_output_settings *output = &result->settings->output;
    return result->blank_cells > 0 && output->fail_on_blank ? report_result(result, error)
           : output->turntable ? render_write_turntable(result, report_result, error)
                               : write_picture(result, error);
}

/* ---- The scene ---- */

/* Loads the mesh and prepares the scene. */
static burnish_status load_scene(render_result *result, burnish_error *error) {
    render_settings *settings = result->settings;
    settings->input.load.max_memory = settings->job.max_memory;
    settings->input.load.project = settings->input.load.plate < 0 ? &result->project : NULL;
    burnish_status status =
        render_load(&settings->input, settings->job.threads, &result->mesh, error);
    result->seconds.load = burnish_seconds_now() - result->start;
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    result->seconds.read = burnish_mesh_get_info(result->mesh)->read_seconds;
    result->seconds.build = burnish_mesh_get_info(result->mesh)->build_seconds;
    render_warn_of_mesh(&result->warnings, result->mesh);
    status = render_warn_useless(result, result->mesh, error);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (settings->input.load.plate < 0 || settings->output.plays) {
        result->given = *settings;
    }
    render_scene scene = {settings,          result->mesh,
                          result->options,   &result->environment,
                          &result->warnings, result->color_range};
    return render_prepare(&scene, error);
}

/* ---- All ---- */

static burnish_status plan_cells(render_result *result, burnish_error *error) {
    const render_settings *settings = result->settings;
    const size_t views = settings->picture.views.count > 0 ? settings->picture.views.count : 1;
    result->cell_count = views * settings->shading.lobes.count;
    result->columns = render_sheet_columns(settings, result->cell_count);
    result->cells = calloc(result->cell_count, sizeof *result->cells);
    if (!result->cells) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for %zu pictures",
                        result->cell_count);
    }
    render_describe_cells(result);
    return BURNISH_STATUS_OK;
}

static burnish_status warn_of_flags(render_result *result, burnish_error *error) {
    return render_warn_useless(result, NULL, error);
}

static burnish_status read_environment(render_result *result, burnish_error *error) {
    return render_read_environment(result->settings, &result->environment, error);
}

static burnish_status close_sandbox(render_result *result, burnish_error *error) {
    (void)result;
    return sandbox_close(error);
}

static burnish_status create_renderer(render_result *result, burnish_error *error) {
    return burnish_renderer_create(NULL, &result->renderer, error);
}

static void release_result(render_result *result) {
    for (size_t i = 0; result->cells && i < result->cell_count; ++i) {
        burnish_drawing_destroy(result->cells[i].drawing);
        free(result->cells[i].callouts);
        burnish_image_destroy(&result->cells[i].image);
    }
    free(result->cells);
    burnish_image_destroy(&result->sheet);
    burnish_renderer_destroy(result->renderer);
    burnish_image_destroy(&result->reference.image);
    render_release_environment(&result->environment);
    font_close(result->font);
    render_release_planes(&result->planes);
    render_drop_warnings(&result->warnings, 0);
    burnish_mesh_destroy(result->mesh);
    burnish_project_destroy(result->project);
}

/* Sets the system's limits and enters the sandbox. *code is the exit code if the worker has done
 * everything, else -1. */
static burnish_status enter_sandbox(const render_settings *settings, int *code,
                                    burnish_error *error) {
    sandbox_plan plan = {.input = settings->input.name,
                         .root = settings->input.load.root,
                         .format = settings->input.load.format,
                         .outputs = {render_output_path(&settings->output)},
                         .container = picture_container((picture_format)settings->output.format),
                         .max_input_bytes = settings->input.load.max_input_bytes,
                         .max_memory = settings->job.max_memory,
                         .is_streamed = settings->output.turntable != NULL};
    _Static_assert(2 + RENDER_PLANES_MAX <= SANDBOX_OUTPUTS_MAX, "picture, report and planes");
    *code = -1;
    burnish_status status = cli_limit_memory(settings->job.max_memory, error);
    if (status == BURNISH_STATUS_OK) {
        status = cli_limit_seconds(settings->job.max_seconds.value, error);
    }
    if (status != BURNISH_STATUS_OK || !settings->job.sandbox) {
        return status;
    }
    if (settings->output.reference) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--sandbox: the reference can not be read in it; omit --reference");
    }
    if (plan.container) {
        plan.frames = picture_expect_frames(settings->picture.size[0], settings->picture.size[1],
                                            settings->output.fps, settings->output.frames);
    }
    plan.output_count = 1;
    if (settings->output.json) {
        plan.outputs[plan.output_count++] = settings->output.json;
    }
    for (size_t i = 0; i < settings->output.planes.count; ++i) {
        plan.outputs[plan.output_count++] = settings->output.planes.items[i].path;
    }
    return sandbox_begin(&plan, code, error);
}

/* On a terminal, confirms the file that was written. */
static void confirm(const render_result *result) {
    const render_settings *settings = result->settings;
    const char *path = render_output_path(&settings->output);
    if (result->written && !settings->job.quiet && strcmp(path, "-") != 0 &&
        isatty(STDERR_FILENO)) {
        burnish_error line;
        cli_fail(&line, BURNISH_STATUS_OK, "wrote %.300s, %d x %d", path, result->picture->width,
                 result->picture->height);
        fprintf(stderr, "burnish: %s\n", line.text);
    }
}

/* From settings to files. */
static burnish_status (*const steps[])(render_result *result, burnish_error *error) = {
    plan_cells,
    warn_of_flags,
    render_open_font,
    render_check_sheet,
    read_environment,
    close_sandbox, /* fonts are open; environment and mesh are parsed in it */
    render_read_reference,
    load_scene,
    create_renderer,
    render_draw_picture,
    write_output,
};

burnish_status render_run(render_settings *settings, int *exit_code, burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    cli_prepare_memory();
    struct run {
        render_result result;
        burnish_render_options options;
    } *const run = calloc(1, sizeof *run);
    if (!run) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "out of memory for the settings");
    }
    run->options = render_make_options(settings);
    render_result *const result = &run->result;
    result->settings = settings;
    result->options = &run->options;
    result->warnings.print = settings->job.quiet ? NULL : cli_warn;
    result->seconds.start = processor_seconds();
    result->start = burnish_seconds_now();
    for (size_t i = 0; i < sizeof steps / sizeof *steps && status == BURNISH_STATUS_OK; ++i) {
        status = steps[i](result, error);
    }
    if (status == BURNISH_STATUS_OK) {
        if (settings->job.timing) {
            render_print_timing(&result->seconds);
        }
        burnish_error line;
        *exit_code = render_judge_result(result, &line);
        if (*exit_code != 0) {
            fprintf(stderr, "burnish: %s\n", line.text);
        }
        confirm(result);
    }
    release_result(result);
    free(run);
    return status;
}

/* Writes the object of a run that ends without a picture. Its error is the one to print. */
static void write_failure(const render_settings *settings, double seconds,
                          const burnish_error *error) {
    cli_output output;
    burnish_error unwritten;
    int failed = 0;
    if (settings->output.json && cli_output_begin(&output, &unwritten) == BURNISH_STATUS_OK) {
        cJSON *root =
            render_describe_failure(settings->input.name, burnish_status_exit_code(error->status),
                                    error->text, seconds, &failed);
        const burnish_status status = cli_json_print(output.stream, root, failed, &unwritten);
        cli_output_end(&output, settings->output.json, status, &unwritten);
    }
}

/* Draws call->operands[0], in the sandbox if the settings ask for it. */
static burnish_status draw_input(render_settings *settings, cli_call *call, burnish_error *error) {
    settings->input.name = call->operands[0];
    int code = -1;
    const double start = burnish_seconds_now();
    burnish_status status = render_finish(settings, error);
    if (status != BURNISH_STATUS_OK) {
        return status; /* the file of --json could be another output */
    }
    if (settings->input.load.scene) {
        status = render_join_inputs(call, &settings->input.load, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = enter_sandbox(settings, &code, error);
    }
    if (code >= 0) {
        call->exit_code = code;
    } else if (status == BURNISH_STATUS_OK) {
        status = render_run(settings, &call->exit_code, error);
    }
    if (status != BURNISH_STATUS_OK) {
        write_failure(settings, burnish_seconds_now() - start, error);
    }
    render_release_inputs(&settings->input.load);
    return status;
}

burnish_status render_work(void *from, cli_call *call, burnish_error *error) {
    render_settings *settings = from;
    int is_many = 0;
    const burnish_status status = render_read_operands(settings, call, &is_many, error);
    burnish_error other;
    settings->input.name = call->operands[0];
    if (status == BURNISH_STATUS_READ && render_finish(settings, &other) == BURNISH_STATUS_OK) {
        write_failure(settings, 0, error); /* the input is a folder */
    }
    return status != BURNISH_STATUS_OK ? status
           : is_many                   ? batch_draw_inputs(settings, call, error)
                                       : draw_input(settings, call, error);
}
