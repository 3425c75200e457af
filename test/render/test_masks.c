/* Masks that end inside a triangle: coverage with several samples against exact areas, near and
 * far, and what shows through. */
#include <math.h>

#include "pictures.h"

enum { SIZE = 96, TEXELS = 128, STEPS = 16 };

/* A white card from -1 to 1 whose alpha is the mask, and where wanted a red one behind it. */
typedef struct scene {
    uint8_t texels[4 * TEXELS * TEXELS];
    burnish_texture textures[2];
    burnish_material materials[2];
    burnish_render_options options;
    int has_red;
    float pixels[SIZE * SIZE * 4];
} scene;

static void open_scene(scene *s, int samples) {
    s->textures[0] = s->textures[1] = (burnish_texture){NULL, TEXELS, TEXELS, s->texels, 1};
    s->materials[0] = matt_material(1);
    s->materials[1] = s->materials[0];
    s->materials[1].ambient[1] = s->materials[1].ambient[2] = 0;
    s->materials[0].textures[BURNISH_TEXTURE_COLOR].texture = 1;
    s->materials[0].alpha_mode = BURNISH_ALPHA_MASK;
    s->materials[0].alpha_cutoff = 0.5f;
    s->has_red = 0;
    s->options = front_options(SIZE, SIZE, 2.5);
    s->options.samples = samples;
    light_evenly(&s->options);
}

static burnish_mesh *mesh_of(const scene *s) {
    static const float positions[] = {-1,  -1,    0,  1,  -1,    0,   1,     1,
                                      0,   -1,    1,  0,  -50,   -50, -0.1f, 50,
                                      -50, -0.1f, 50, 50, -0.1f, -50, 50,    -0.1f};
    static const float coordinates[] = {0, 0, 1, 0, 1, 1, 0, 1, 0, 0, 1, 0, 1, 1, 0, 1};
    static const uint16_t triangle_materials[] = {0, 0, 1, 1};
    const size_t quads = s->has_red ? 2 : 1;
    burnish_mesh_description arrays = describe_quads(positions, NULL, quads);
    arrays.triangle_materials = (burnish_array){triangle_materials, 2 * quads, 0};
    give_materials(&arrays, s->materials, 2);
    give_textures(&arrays, coordinates, s->textures, 2);
    return create_mesh(&arrays, NULL);
}

static void draw(scene *s) {
    burnish_mesh *mesh = mesh_of(s);
    draw_floats(mesh, &s->options, s->pixels, NULL);
    burnish_mesh_destroy(mesh);
}

/* ---- Shapes: alpha of a texel, and whether a point of the card, [0, 1], is in the shape ---- */

#define RADIUS 0.4

/* How far a point lies within the disc. */
static double depth_in_disc(double u, double v) {
    return RADIUS - sqrt((u - 0.5) * (u - 0.5) + (v - 0.5) * (v - 0.5));
}

/* Alpha grows from 0 to 1 over `ramp` texels across the disc's edge, where it is `cutoff`. */
static void paint_disc(scene *s, double ramp, double cutoff) {
    s->materials[0].alpha_cutoff = (float)cutoff;
    for (int i = 0; i < TEXELS * TEXELS; ++i) {
        const double u = (i % TEXELS + 0.5) / TEXELS, v = (i / TEXELS + 0.5) / TEXELS;
        const double alpha = cutoff + depth_in_disc(u, v) * TEXELS / ramp;
        memset(s->texels + 4 * i, 255, 3);
        s->texels[4 * i + 3] = (uint8_t)(255 * (alpha < 0 ? 0 : alpha > 1 ? 1 : alpha) + 0.5);
    }
}

/* The share of a pixel that the disc covers. */
static double covered_by_disc(const scene *s, int x, int y) {
    const double height = s->options.camera.orthographic_height;
    int count = 0;
    for (int i = 0; i < STEPS * STEPS; ++i) {
        const double px = (x + (i % STEPS + 0.5) / STEPS) / SIZE - 0.5;
        const double py = (y + (i / STEPS + 0.5) / STEPS) / SIZE - 0.5;
        count += depth_in_disc(0.5 + px * height / 2, 0.5 + py * height / 2) >= 0;
    }
    return (double)count / (STEPS * STEPS);
}

/* The disc's area in pixels as drawn. */
static double drawn_area(const scene *s) {
    double sum = 0;
    for (int i = 0; i < SIZE * SIZE; ++i) {
        sum += (double)s->pixels[4 * i];
    }
    return sum;
}

/* ---- Coverage ---- */

/* The root mean square of what pixels differ by from the disc's shares, in those at its edge. */
static double edge_error(const scene *s) {
    double sum = 0;
    int count = 0;
    for (int y = 0; y < SIZE; ++y) {
        for (int x = 0; x < SIZE; ++x) {
            const double share = covered_by_disc(s, x, y);
            const double error = (double)s->pixels[4 * (y * SIZE + x)] - share;
            if (share > 0 && share < 1) {
                sum += error * error;
                count += 1;
            }
        }
    }
    return sqrt(sum / count);
}

/* A disc enlarged, at its own size and smaller: pixels at its edge show their shares of it. A mask
 * that is decided once a pixel is off by 0.29. */
static void test_edges(void) {
    static const struct {
        int samples;
        double height, most;
    } cases[] = {{4, 2.5, 0.14},  {4, 1.7, 0.14},  {4, 2, 0.14},    {8, 1.7, 0.09},
                 {16, 2.5, 0.09}, {16, 1.7, 0.07}, {16, 2, 0.07},   {4, 4.5, 0.13},
                 {4, 6.5, 0.07},  {4, 16, 0.07},   {16, 4.5, 0.07}, {16, 6.5, 0.07}};
    static scene s;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        open_scene(&s, cases[i].samples);
        paint_disc(&s, 2, 0.5);
        s.options.camera.orthographic_height = cases[i].height;
        draw(&s);
        const double error = edge_error(&s);
        CHECK(error < cases[i].most, "%d samples, height %g: %g", cases[i].samples, cases[i].height,
              error);
    }
}

/* The disc's area at all distances from enlarged to a card of two pixels, whatever the ramp of its
 * alpha and the cutoff. */
static void test_area(void) {
    static const struct {
        double ramp, cutoff;
    } shapes[] = {{1, 0.5}, {1, 0.1}, {8, 0.5}, {16, 0.25}, {16, 0.75}};
    static scene s;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; ++i) {
        open_scene(&s, 4);
        paint_disc(&s, shapes[i].ramp, shapes[i].cutoff);
        for (double height = 2; height < 100; height *= 1.21) {
            const double pixels = 2 / height * SIZE; /* along the card's side */
            const double area = 3.14159265358979 * RADIUS * RADIUS * pixels * pixels;
            s.options.camera.orthographic_height = height;
            draw(&s);
            const double ratio = drawn_area(&s) / area;
            CHECK(fabs(ratio - 1) < 0.03 + 0.4 / pixels,
                  "ramp %g, cutoff %g, card of %.1f pixels: %g of the area", shapes[i].ramp,
                  shapes[i].cutoff, pixels, ratio);
        }
    }
}

/* White over red: what the mask leaves of a pixel is red, near and far. */
static void test_behind(void) {
    static scene s;
    for (double height = 1.3; height < 20; height *= 2) {
        int mixed = 0, off = 0;
        open_scene(&s, 4);
        s.has_red = 1;
        paint_disc(&s, 2, 0.5);
        s.options.camera.orthographic_height = height;
        draw(&s);
        for (int i = 0; i < SIZE * SIZE; ++i) {
            const float *p = s.pixels + 4 * i;
            mixed += p[1] > 0.1f && p[1] < 0.9f;
            off += fabsf(p[0] - 1) > 1e-5f || fabsf(p[1] - p[2]) > 1e-5f;
        }
        CHECK(mixed > 12 && !off, "height %g: %d mixed, %d of another colour", height, mixed, off);
    }
}

/* ---- Wraps, nearest texels, other materials ---- */

/* One column of 2 x 2 texels is there, the first or the second; the card shows the image from
 * coordinate `from` on. */
static double column_area(int first, int wrap, int is_nearest, float from, int samples) {
    static const uint8_t columns[2][8] = {{255, 255, 255, 255, 255, 255, 255, 0},
                                          {255, 255, 255, 0, 255, 255, 255, 255}};
    static scene s;
    open_scene(&s, samples);
    burnish_texture_use *use = &s.materials[0].textures[BURNISH_TEXTURE_COLOR];
    s.textures[0] = (burnish_texture){NULL, 2, 1, columns[first ? 0 : 1], 1};
    use->wrap[0] = use->wrap[1] = wrap;
    use->is_nearest = is_nearest;
    use->has_transform = 1;
    memcpy(use->transform, (float[6]){1, 0, from, 0, 1, 0}, sizeof use->transform);
    s.options.height = 8; /* rows are alike */
    s.options.camera.orthographic_height = 2.0 * 8 / SIZE;
    draw(&s);
    return drawn_area(&s) / 8; /* columns of pixels */
}

/* Edges at a quarter or three quarters of a pixel, which half of the samples or all of them show;
 * one decision per pixel would give whole columns. */
static void test_wraps(void) {
    for (int wrap = BURNISH_WRAP_REPEAT; wrap <= BURNISH_WRAP_CLAMP; ++wrap) {
        for (int nearest = 0; nearest < 2; ++nearest) {
            for (int first = 0; first < 2; ++first) {
                for (int k = 0; k < 16; ++k) {
                    const float from = (float)k / 4 + 0.5f / SIZE - 2; /* edges within pixels */
                    const double exact = column_area(first, wrap, nearest, from, 16);
                    double sum = 0;
                    for (int i = 0; i < 4096; ++i) {
                        double u = (double)from + (i + 0.5) / 4096;
                        if (wrap == BURNISH_WRAP_CLAMP) {
                            u = u < 0 ? 0 : u > 1 ? 0.999 : u;
                        } else {
                            const double turned = u - 2 * floor(u / 2);
                            u = wrap == BURNISH_WRAP_REPEAT ? u - floor(u)
                                : turned < 1                ? turned
                                                            : 2 - turned;
                        }
                        sum += (u < 0.5) == first;
                    }
                    const double expected = sum / 4096 * SIZE;
                    CHECK(fabs(exact - expected) < 0.3,
                          "wrap %d, nearest %d, first %d, from %g: %g columns, not %g", wrap,
                          nearest, first, (double)from, exact, expected);
                }
            }
        }
    }
}

/* Materials that use one image with different cutoffs. */
static void test_cutoffs(void) {
    static scene s;
    open_scene(&s, 4);
    s.has_red = 1;
    paint_disc(&s, 16, 0.25);
    s.materials[1].textures[BURNISH_TEXTURE_COLOR].texture = 1;
    s.materials[1].alpha_mode = BURNISH_ALPHA_MASK;
    s.materials[1].alpha_cutoff = 0.75f;
    draw(&s);
    double white = 0;
    for (int i = 0; i < SIZE * SIZE; ++i) {
        white += (double)s.pixels[4 * i + 1];
    }
    const double pixels = 2 / 2.5 * SIZE;
    const double area = 3.14159265358979 * RADIUS * RADIUS * pixels * pixels;
    CHECK(fabs(white / area - 1) < 0.03, "%g of the area", white / area);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_edges());
    RUN(test_area());
    RUN(test_behind());
    RUN(test_wraps());
    RUN(test_cutoffs());
    return test_end("masks");
}
