/* One object in all formats: the same picture, and what is said of files with wrong names. */
#include "draw_floats.h"
#include "same_mesh.h"

enum { SIZE = 32, KINDS = SAME_COUNT - !BURNISH_HAS_3MF };

static burnish_mesh *load_kind(same_kind kind, const char *name, int strict) {
    static byte_list list;
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh;
    burnish_error error = {0};
    options.strict = strict;
    options.crease_angle = 30; /* glTF's is 0 */
    same_mesh(&list, kind);
    CHECK(burnish_mesh_load_memory(list.bytes, list.size, name, &options, &mesh, &error) ==
              BURNISH_STATUS_OK,
          "%s", error.text);
    return mesh;
}

/* A file without colours has the grey of the look, whatever its format. */
static void test_same_grey(burnish_look look) {
    static float pixels[SAME_COUNT][SIZE * SIZE * 4];
    burnish_render_options options = burnish_render_options_default();
    burnish_render_options_set_look(&options, look, NULL);
    options.width = options.height = SIZE;
    options.occlusion = 0; /* its sky depends on which way is up */
    for (int i = 0; i < KINDS; ++i) {
        burnish_mesh *mesh = load_kind((same_kind)i, same_kinds[i].name, 1);
        burnish_framing framing = burnish_framing_default();
        if (!mesh) {
            continue;
        }
        framing.up[2] = 1;
        framing.direction[0] = -1;
        framing.direction[1] = -1;
        framing.direction[2] = -1;
        CHECK1(burnish_camera_frame(mesh, &framing, &options.camera, NULL) == BURNISH_STATUS_OK);
        CHECK1(burnish_look_set_materials(look, mesh, NULL) == BURNISH_STATUS_OK);
        draw_floats(mesh, &options, pixels[i], NULL);
        CHECK(memcmp(pixels[i], pixels[0], sizeof *pixels) == 0, "%s, look %d: %g instead of %g",
              same_kinds[i].name, (int)look, (double)pixels[i][4 * (SIZE / 2 * SIZE + SIZE / 2)],
              (double)pixels[0][4 * (SIZE / 2 * SIZE + SIZE / 2)]);
        burnish_mesh_destroy(mesh);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_same_grey(BURNISH_LOOK_STUDIO));
    RUN(test_same_grey(BURNISH_LOOK_TECHNICAL));
    RUN(test_same_grey(BURNISH_LOOK_PLAIN));
    return test_end("formats");
}
