/* A file to the picture that `burnish render FILE` draws: load, choose the look, frame, draw, write.
 *
 *     cc picture.c $(pkg-config --cflags --libs burnish) -o picture && ./picture part.stl part.png
 */
#include <stdio.h>

#include "burnish/look.h"
#include "burnish/image.h"
#include "burnish/mesh.h"
#include "burnish/render.h"

static burnish_status draw(const char *input, const char *output, burnish_error *error) {
    burnish_mesh *mesh = NULL;
    burnish_image image = {0};
    burnish_load_options load = burnish_load_options_default();
    burnish_framing framing = burnish_framing_default();
    burnish_render_options render = burnish_render_options_default();
    framing.aspect = (double)render.width / render.height;

    burnish_status status = burnish_mesh_load(input, &load, &mesh, error);
    if (status == BURNISH_STATUS_OK) { /* without these two calls: --look=plain */
        status = burnish_render_options_set_look(&render, BURNISH_LOOK_STUDIO, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_look_set_materials(BURNISH_LOOK_STUDIO, mesh, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_camera_frame(mesh, &framing, &render.camera, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_render(mesh, &render, &image, NULL, error);
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_image_write_png(&image, output, error);
    }
    burnish_image_destroy(&image);
    burnish_mesh_destroy(mesh);
    return status;
}

int main(int count, char **arguments) {
    burnish_error error;
    const char *output = count > 2 ? arguments[2] : "picture.png";
    if (draw(count > 1 ? arguments[1] : ":teapot", output, &error) != BURNISH_STATUS_OK) {
        fprintf(stderr, "picture: %s\n", error.text);
        return burnish_status_exit_code(error.status);
    }
    return 0;
}
