/* The options of `burnish render`, as set by its flags. Each part has its own header, so code
 * includes only the parts that it uses. Settings are plain data and can be copied; their texts
 * belong to the command line. */
#ifndef TOOL_RENDER_SETTINGS_H
#define TOOL_RENDER_SETTINGS_H

#include "render/settings/camera.h"
#include "render/settings/input.h"
#include "render/settings/job.h"
#include "render/settings/output.h"
#include "render/settings/picture.h"
#include "render/settings/shading.h"

typedef struct render_settings {
    render_input_settings input;
    render_camera_settings camera;
    render_shading_settings shading;
    render_picture_settings picture;
    render_output_settings output;
    render_job_settings job;
    cli_given given; /* flags of the command line */
} render_settings;

#endif
