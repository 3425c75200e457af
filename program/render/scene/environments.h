/* The environment of --environment. */
#ifndef TOOL_RENDER_SCENE_ENVIRONMENT_H
#define TOOL_RENDER_SCENE_ENVIRONMENT_H

#include "burnish/light.h"
#include "render/settings/settings.h"

typedef struct render_environment {
    uint8_t *bytes; /* of the file; NULL: none */
    size_t size;
    burnish_environment *environment;
} render_environment;

/* Reads the file, if there is one, but does not parse it: for use before the sandbox is closed.
 * Errors: READ, LIMIT, MEMORY; ARGUMENT if no file may be opened. */
burnish_status render_read_environment(const render_settings *settings,
                                       render_environment *environment, burnish_error *error);

/* Makes the environment unless it is made, and reads its file unless that is read. `context`
 * receives warnings. Errors: also as for burnish_environment_decode(). */
burnish_status render_make_environment(const render_settings *settings,
                                       const burnish_context *context,
                                       render_environment *environment, burnish_error *error);

void render_release_environment(render_environment *environment);

#endif
