/* The hairline along outlines that hardly differ from the background. */
#include "burnish/look.h"
#include "pictures.h"

enum { WIDTH = 150, HEIGHT = 101, PIXELS = WIDTH * HEIGHT, CONTRAST = 32 };

typedef struct picture {
    uint8_t pixels[PIXELS][4], coverage[PIXELS];
} picture;

/* White surfaces: what they show does not depend on lights. */
static burnish_render_options make_options(burnish_mesh *mesh, int background) {
    burnish_render_options options = framed_options(mesh, WIDTH, HEIGHT);
    burnish_error error;
    CHECK_OK(burnish_render_options_set_look(&options, BURNISH_LOOK_DRAWING, &error), error);
    CHECK_OK(burnish_look_set_materials(BURNISH_LOOK_DRAWING, mesh, &error), error);
    options.edges = 0;
    options.outline_contrast = CONTRAST + 4; /* as in the studio */
    memset(options.background, background, sizeof options.background);
    return options;
}

static void draw(const burnish_mesh *mesh, const burnish_render_options *options, picture *out) {
    const burnish_target target =
        make_target((burnish_pixels){WIDTH, HEIGHT, BURNISH_PIXELS_BGRA8,
                                     sizeof out->pixels[0] * WIDTH, out->pixels[0]},
                    NULL, NULL, NULL, out->coverage);
    draw_into(mesh, options, &target, NULL);
}

/* The least coverage around a pixel, and the largest difference from the background there. */
static int look_around(const picture *p, const burnish_render_options *options, int i, int *most) {
    int least = 255;
    *most = 0;
    for (int k = 0; k < 9; ++k) {
        const int at = i + (k / 3 - 1) * WIDTH + k % 3 - 1;
        const int difference = abs(p->pixels[at][0] - options->background[0]);
        least = p->coverage[at] < least ? p->coverage[at] : least;
        *most = p->coverage[at] > 0 && difference > *most ? difference : *most;
    }
    return least;
}

/* On `background` the sphere's outline has contrast all around, and nothing else changes. */
static void test_line(burnish_mesh *mesh, int samples, int background, float ambient) {
    static picture with, without;
    burnish_render_options options = make_options(mesh, background);
    int outline = 0, weakest = 255;
    options.samples = samples;
    for (int k = 0; k < 3; ++k) {
        options.ambient_light[k] = ambient;
    }
    draw(mesh, &options, &with);
    options.outline_contrast = 0;
    draw(mesh, &options, &without);
    for (int y = 1; y + 1 < HEIGHT; ++y) {
        for (int x = 1; x + 1 < WIDTH; ++x) {
            const int i = y * WIDTH + x, covered = with.coverage[i];
            int most;
            const int least = look_around(&with, &options, i, &most);
            if (covered >= 128 && least == 0) {
                ++outline;
                weakest = most < weakest ? most : weakest;
            }
            CHECK((covered > 0 && least < 255) ||
                      memcmp(with.pixels[i], without.pixels[i], sizeof with.pixels[i]) == 0,
                  "pixel %d, %d changes", x, y);
        }
    }
    CHECK(outline > 200 && weakest >= CONTRAST,
          "%d samples on %d: %d pixels of outline, the weakest has %d", samples, background,
          outline, weakest);
}

/* An outline that stands out keeps its bits. */
static void test_contrast(burnish_mesh *mesh) {
    static picture with, without;
    burnish_render_options options = make_options(mesh, 20);
    draw(mesh, &options, &with);
    options.outline_contrast = 0;
    draw(mesh, &options, &without);
    CHECK(memcmp(&with, &without, sizeof with) == 0, "a white sphere changes on black");
}

int main(void) {
    burnish_mesh *mesh = load_mesh(":sphere", NULL);
    const int samples[] = {1, 4, 8, 16};
    for (int i = 0; i < 4; ++i) {
        RUN(test_line(mesh, samples[i], 238, 1));
        RUN(test_line(mesh, samples[i], 255, 0.95f));
        RUN(test_line(mesh, samples[i], 238, 0.7f));
        RUN(test_line(mesh, samples[i], 20, 0.01f));
    }
    RUN(test_contrast(mesh));
    burnish_mesh_destroy(mesh);
    return test_end("outline_contrast");
}
