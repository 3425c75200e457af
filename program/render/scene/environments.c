#include "render/scene/environments.h"

#include <stdlib.h>
#include <string.h>

#include "cli/input.h"

static int is_file(const char *name) {
    return name && strcmp(name, "sky") != 0 && strcmp(name, "room") != 0;
}

/* Radiance HDR or EXR. */
static int is_image(const uint8_t *bytes, size_t size) {
    return size >= 4 && (memcmp(bytes, "#?", 2) == 0 || memcmp(bytes, "\x76\x2f\x31\x01", 4) == 0);
}

burnish_status render_read_environment(const render_settings *settings,
                                       render_environment *environment, burnish_error *error) {
    const char *name = settings->shading.environment.name;
    *environment = (render_environment){0};
    if (!is_file(name)) {
        return BURNISH_STATUS_OK;
    }
    if (settings->picture.opens_no_font) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "--environment: no file may be opened here, such as \"%.200s\"; use sky or room", name);
    }
    return cli_read_bytes(name, settings->input.load.max_input_bytes, is_image, &environment->bytes,
                          &environment->size, error);
}

burnish_status render_make_environment(const render_settings *settings,
                                       const burnish_context *context,
                                       render_environment *environment, burnish_error *error) {
    const char *name = settings->shading.environment.name;
    if (!name || environment->environment) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status = environment->bytes
                                ? BURNISH_STATUS_OK
                                : render_read_environment(settings, environment, error);
    if (status == BURNISH_STATUS_OK) {
        status =
            is_file(name)
                ? burnish_environment_decode(context, environment->bytes, environment->size, name,
                                             &environment->environment, error)
                : burnish_environment_create_named(context, name, &environment->environment, error);
    }
    free(environment->bytes);
    environment->bytes = NULL;
    return status;
}

void render_release_environment(render_environment *environment) {
    free(environment->bytes);
    burnish_environment_destroy(environment->environment);
    *environment = (render_environment){0};
}
