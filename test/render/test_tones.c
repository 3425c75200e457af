/* Tone mapping by every instruction set against the published formulas in double precision, and
 * what exposure and tone mapping leave alone in a picture. */
#include <math.h>

#include "burnish/look.h"
#include "core/srgb.h"
#include "pictures.h"
#include "render/render_ops.h"

enum { COUNT = 256, ROUNDS = 300, SIDE = 96, PIXELS = SIDE * SIDE };

/* KhronosGroup/ToneMapping, PBR_Neutral/pbrNeutral.glsl */
static void reference_neutral(int has_toe, double color[3]) {
    const double start = 0.8 - 0.04, desaturation = 0.15;
    const double x = fmin(color[0], fmin(color[1], color[2]));
    const double offset = !has_toe ? 0 : x < 0.08 ? x - 6.25 * x * x : 0.04;
    for (int k = 0; k < 3; ++k) {
        color[k] -= offset;
    }
    const double peak = fmax(color[0], fmax(color[1], color[2]));
    if (peak < start) {
        return;
    }
    const double d = 1 - start, new_peak = 1 - d * d / (peak + d - start);
    const double g = 1 - 1 / (desaturation * (peak - new_peak) + 1);
    for (int k = 0; k < 3; ++k) {
        color[k] = color[k] * new_peak / peak * (1 - g) + new_peak * g;
    }
}

/* knarkowicz.wordpress.com, ACES Filmic Tone Mapping Curve, without its clamp */
static void reference_filmic(double color[3]) {
    const double a = 2.51, b = 0.03, c = 2.43, d = 0.59, e = 0.14;
    for (int k = 0; k < 3; ++k) {
        const double x = color[k];
        color[k] = x * (a * x + b) / (x * (c * x + d) + e);
    }
}

static void reference(int curve, double color[3]) {
    if (curve == BURNISH_TONES_NEUTRAL || curve == BURNISH_TONES_SOFT) {
        reference_neutral(curve == BURNISH_TONES_NEUTRAL, color);
    } else if (curve == BURNISH_TONES_FILMIC) {
        reference_filmic(color);
    }
}

static void check_curve(burnish_isa isa, int curve, uint64_t *state) {
    const burnish_render_ops *ops = burnish_render_ops_for(isa);
    const burnish_tones tones = {0, curve, 0.75f};
    float light[3][COUNT];
    float *const rgb[3] = {light[0], light[1], light[2]};
    double worst = 0;
    for (int round = 0; round < ROUNDS; ++round) {
        double expected[COUNT][3];
        const float most = round % 3 == 0 ? 0.2f : round % 3 == 1 ? 2.0f : 1000.0f;
        for (int i = 0; i < COUNT; ++i) {
            for (int k = 0; k < 3; ++k) {
                light[k][i] = test_uniform_float(state, 0, most);
                light[k][i] = i % 4 ? light[k][i] : light[0][i]; /* grey */
                expected[i][k] = 0.75 * (double)light[k][i];
            }
            reference(curve, expected[i]);
        }
        ops->map_tones(&tones, COUNT, rgb);
        for (int i = 0; i < 3 * COUNT; ++i) {
            const double right = expected[i / 3][i % 3];
            worst = fmax(worst, fabs((double)light[i % 3][i / 3] - right) / fmax(1, right));
        }
    }
    CHECK(worst < 4e-7, "%s, curve %d: off by %g", burnish_isa_name(isa), curve, worst);
}

/* Results that the specifications' formulas have as fractions, and light that is not a number. */
static void check_values(const burnish_render_ops *ops) {
    static const struct {
        burnish_tone_mapping curve;
        float from[3];
        double to[3];
    } values[] = {
        {BURNISH_TONES_NEUTRAL, {0.5f, 0.3f, 0.2f}, {0.46, 0.26, 0.16}},
        {BURNISH_TONES_NEUTRAL, {0.04f, 0.04f, 0.04f}, {0.01, 0.01, 0.01}},
        {BURNISH_TONES_NEUTRAL, {0.7f, 0.35f, 0}, {0.7, 0.35, 0}}, /* orange stays */
        {BURNISH_TONES_NEUTRAL,
         {1, 1, 1},
         {1 - 0.0576 / 0.44, 1 - 0.0576 / 0.44, 1 - 0.0576 / 0.44}},
        {BURNISH_TONES_NEUTRAL, {INFINITY, INFINITY, NAN}, {1, 1, 1}},
        {BURNISH_TONES_SOFT, {0.76f, 0.01f, 0.3f}, {0.76, 0.01, 0.3}},
        {BURNISH_TONES_SOFT, {1, 1, 1}, {0.88, 0.88, 0.88}},
        {BURNISH_TONES_FILMIC, {0, 1, 2}, {0, 2.54 / 3.16, 10.1 / 11.04}},
        {BURNISH_TONES_FILMIC, {INFINITY, 1e30f, NAN}, {2.51 / 2.43, 2.51 / 2.43, 0}},
        {BURNISH_TONES_NONE, {0.25f, 3, NAN}, {0.25, 3, 0}},
    };
    for (size_t v = 0; v < sizeof values / sizeof *values; ++v) {
        const burnish_tones tones = {0, values[v].curve, 1};
        float light[3][16];
        float *const rgb[3] = {light[0], light[1], light[2]};
        for (int i = 0; i < 48; ++i) {
            light[i % 3][i / 3] = values[v].from[i % 3];
        }
        ops->map_tones(&tones, 16, rgb);
        for (int k = 0; k < 3; ++k) {
            CHECK(fabs((double)light[k][15] - values[v].to[k]) < 1e-5,
                  "values %d, channel %d: %.9g", (int)v, k, (double)light[k][15]);
        }
    }
}

static void test_formulas(void) {
    uint64_t state = test_seed(0x746f6e65);
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        if (burnish_kernels_for((burnish_isa)isa)) {
            for (int curve = 0; curve < BURNISH_TONES_COUNT; ++curve) {
                check_curve((burnish_isa)isa, curve, &state);
            }
            check_values(burnish_render_ops_for((burnish_isa)isa));
        }
    }
}

static void draw_bytes(const burnish_mesh *mesh, const burnish_render_options *options,
                       uint8_t (*pixels)[4]) {
    const burnish_target target = make_target(
        (burnish_pixels){SIDE, SIDE, BURNISH_PIXELS_RGBA8, SIDE * sizeof *pixels, pixels[0]}, NULL,
        NULL, NULL, NULL);
    draw_into(mesh, options, &target, NULL);
}

/* One sample a pixel: its bytes are the code of the mapped linear light of the same frame. */
static void test_picture(burnish_tone_mapping curve, float exposure) {
    static float before[PIXELS][4], light[PIXELS][4];
    static uint8_t pixels[PIXELS][4];
    burnish_mesh *mesh = load_tessellated(":sphere", 32);
    burnish_render_options options = framed_options(mesh, SIDE, SIDE);
    int wrong = 0, shown = 0;
    options.samples = 1;
    options.background[0] = 200;
    options.lights[0].color[0] = 3; /* red highlights above 1 */
    draw_floats(mesh, &options, before[0], NULL);
    options.tone_mapping = curve;
    options.exposure = exposure;
    draw_floats(mesh, &options, light[0], NULL);
    CHECK(memcmp(before, light, sizeof before) == 0, "linear light was mapped");
    draw_bytes(mesh, &options, pixels);
    CHECK(pixels[0][0] == 200 && pixels[0][1] == 255, "the background changed");
    for (int i = 0; i < PIXELS; ++i) {
        double color[3];
        for (int k = 0; k < 3; ++k) {
            color[k] = (double)light[i][k] * pow(2, (double)exposure);
        }
        reference(curve, color);
        const int is_background = memcmp(light[i], light[0], sizeof light[0]) == 0;
        for (int k = 0; k < 3 && !is_background; ++k) {
            wrong += abs(pixels[i][k] - burnish_linear_to_srgb((float)color[k])) > 1;
            shown += pixels[i][k] != burnish_linear_to_srgb(light[i][k]);
        }
    }
    CHECK(wrong == 0, "curve %d, exposure %g: %d pixels differ", (int)curve, (double)exposure,
          wrong);
    CHECK(shown > PIXELS / 4, "only %d values were mapped", shown);
    burnish_mesh_destroy(mesh);
}

static int compare_bytes(const void *a, const void *b) {
    return *(const uint8_t *)a - *(const uint8_t *)b;
}

/* The green channel of a sphere in the studio at three percentiles; returns red over blue, linear, of
 * the sum of the pixels that are brighter than the highest of them. */
static double draw_studio(const float color[3], float metallic, const int percentiles[3],
                          int values[3]) {
    static uint8_t pixels[PIXELS][4], green[PIXELS];
    OWNED_MESH *mesh = load_tessellated(":sphere", 64);
    burnish_render_options options = framed_options(mesh, SIDE, SIDE);
    burnish_material material = *burnish_mesh_get_material(mesh, 0);
    size_t count = 0;
    double red = 0, blue = 0;
    CHECK1(burnish_render_options_set_look(&options, BURNISH_LOOK_STUDIO, NULL) ==
           BURNISH_STATUS_OK);
    options.transparent = 1;
    material.is_metallic = material.has_diffuse = 1;
    material.metallic = metallic;
    material.roughness = 0.3f;
    set_three(material.reflectance, 0.04f);
    memcpy(material.diffuse, color, sizeof material.diffuse);
    set_material(mesh, &material);
    draw_bytes(mesh, &options, pixels);
    for (int i = 0; i < PIXELS; ++i) {
        green[count] = pixels[i][1];
        count += pixels[i][3] == 255;
    }
    qsort(green, count, 1, compare_bytes);
    for (int i = 0; i < 3; ++i) {
        values[i] = green[count * (size_t)percentiles[i] / 100];
    }
    for (int i = 0; i < PIXELS; ++i) {
        const int is_bright = pixels[i][3] == 255 && pixels[i][1] >= values[2];
        red += is_bright ? (double)burnish_srgb_to_linear[pixels[i][0]] : 0;
        blue += is_bright ? (double)burnish_srgb_to_linear[pixels[i][2]] : 0;
    }
    return red / blue;
}

/* The studio's default: white is white but has form, nothing is cut off, gold stays yellow, and
 * dark plastic keeps a highlight. */
static void test_studio(void) {
    static const int percentiles[3] = {5, 50, 99};
    int v[3];
    draw_studio((const float[3]){1, 1, 1}, 0, percentiles, v);
    CHECK(v[0] < 200 && v[1] > 225 && v[1] < 246 && v[2] < 255, "white: %d, %d, %d", v[0], v[1],
          v[2]);
    const double gold = draw_studio((const float[3]){1, 0.57f, 0.08f}, 1, percentiles, v);
    CHECK(gold > 1.5 && v[2] < 250, "gold: red is %g of blue in highlights, green %d", gold, v[2]);
    draw_studio((const float[3]){0.035f, 0.035f, 0.035f}, 0, percentiles, v);
    CHECK(v[0] > 25 && v[1] > 40 && v[2] > 90, "black: %d, %d, %d", v[0], v[1], v[2]);
}

/* Percentiles 5 and 95 of the green channel on the faces of a cube of metal, two of them vertical. */
static void test_flat_metal(void) {
    static const float corners[12][3] = {{-1, -1, 1}, {1, -1, 1},  {1, 1, 1},  {-1, 1, 1},
                                         {1, -1, 1},  {1, -1, -1}, {1, 1, -1}, {1, 1, 1},
                                         {-1, 1, 1},  {1, 1, 1},   {1, 1, -1}, {-1, 1, -1}};
    static uint8_t pixels[PIXELS][4], green[PIXELS];
    static uint32_t triangles[PIXELS];
    OWNED_MESH *mesh = create_quads(corners[0], NULL, 3);
    burnish_render_options options = framed_options(mesh, SIDE, SIDE);
    CHECK1(burnish_render_options_set_look(&options, BURNISH_LOOK_STUDIO, NULL) ==
           BURNISH_STATUS_OK);
    options.occlusion = 0;
    options.samples = 1;
    options.camera.orthographic_height =
        3.5; /* one direction of view: one colour per face without it */
    set_metal(mesh, 1, 0.3f);
    const burnish_target target = make_target(
        (burnish_pixels){SIDE, SIDE, BURNISH_PIXELS_RGBA8, SIDE * sizeof *pixels, pixels[0]}, NULL,
        NULL, triangles, NULL);
    draw_into(mesh, &options, &target, NULL);
    for (uint32_t face = 0; face < 3; ++face) {
        size_t count = 0;
        for (int i = 0; i < PIXELS; ++i) {
            green[count] = pixels[i][1];
            count += triangles[i] / 2 == face;
        }
        qsort(green, count, 1, compare_bytes);
        const int low = green[count / 20], high = green[count - 1 - count / 20];
        CHECK(count > 500 && low > 50 && high - low > 12, "face %d: %d to %d of %d pixels",
              (int)face, low, high, (int)count);
    }
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_formulas());
    RUN(test_picture(BURNISH_TONES_NONE, 0.7f));
    RUN(test_picture(BURNISH_TONES_NEUTRAL, 0));
    RUN(test_picture(BURNISH_TONES_SOFT, 1));
    RUN(test_picture(BURNISH_TONES_FILMIC, -1));
    RUN(test_studio());
    RUN(test_flat_metal());
    return test_end("tones");
}
