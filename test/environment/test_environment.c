/* Environments: their images, readers, and maps of light made from them. */
#include <math.h>

#include "core/tasks.h"
#include "environment/area_lights.h"
#include "environment/environment.h"
#include "environment/light_maps.h"
#include "support.h"

enum { WIDTH = 64, HEIGHT = 32 };

static float rgb[3 * WIDTH * HEIGHT]; /* of the environment of a test */

static double identity[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

static burnish_environment *make_environment(void) {
    burnish_environment *environment;
    burnish_error error;
    CHECK_OK(burnish_environment_create(NULL, WIDTH, HEIGHT, rgb, &environment, &error), error);
    return environment;
}

static burnish_light_maps *maps_of(const burnish_environment *environment, double axes[3][3],
                                   burnish_isa isa) {
    burnish_light_sources sources = {.environment = environment, .strength = 1};
    burnish_light_maps *maps;
    memcpy(sources.environment_axes, axes, sizeof sources.environment_axes);
    CHECK1(burnish_light_maps_create(NULL, &maps, NULL) == BURNISH_STATUS_OK);
    CHECK1(burnish_light_maps_set(maps, &sources, burnish_kernels_for(isa), NULL) ==
           BURNISH_STATUS_OK);
    return maps;
}

/* The direction of a texel. */
static void direction(const burnish_light_map *map, int column, int row, double w[3]) {
    const int stride = map->size + 2;
    const double p = (column - (map->size + 1) / 2.0) / (map->size / 2.0);
    const double q = (row % stride - (map->size + 1) / 2.0) / (map->size / 2.0);
    const double s = 1 / (1 + p * p + q * q);
    w[0] = 2 * p * s;
    w[1] = 2 * q * s;
    w[2] = (row < stride ? 1 : -1) * (2 * s - 1);
}

/* The largest difference of channel 0 to a function of the direction, over the inner texels. */
static double compare(const burnish_light_map *map,
                      double (*expected)(const double w[3], const void *context),
                      const void *context) {
    double worst = 0;
    for (int row = 0; row < 2 * (map->size + 2); ++row) {
        for (int column = 0; column < map->size + 2; ++column) {
            double w[3];
            direction(map, column, row, w);
            if ((w[2] < 0) == (row >= map->size + 2)) { /* in the row's half of the sphere */
                const float *texel = map->texels + 4 * (row * (map->size + 2) + column);
                burnish_light_map_need(map, row, column);
                worst = fmax(worst, fabs((double)texel[0] - expected(w, context)));
            }
        }
    }
    return worst;
}

/* ---- Maps ---- */

static double one(const double w[3], const void *context) {
    (void)w, (void)context;
    return 1;
}

static void test_constant(void) {
    memset(rgb, 0, sizeof rgb);
    burnish_light_map levels[BURNISH_LIGHT_LEVELS];
    for (int i = 0; i < 3 * WIDTH * HEIGHT; ++i) {
        rgb[i] = 1;
    }
    burnish_environment *environment = make_environment();
    burnish_light_maps *maps = maps_of(environment, identity, BURNISH_ISA_SCALAR);
    CHECK1(compare(burnish_light_maps_diffuse(maps), one, NULL) < 1e-5);
    CHECK1(burnish_light_maps_levels(maps, 0, levels, NULL) == BURNISH_STATUS_OK);
    for (int i = 0; i < BURNISH_LIGHT_LEVELS; ++i) {
        CHECK1(compare(&levels[i], one, NULL) < 1e-5);
    }
    burnish_light_maps_destroy(maps);
    burnish_environment_destroy(environment);
}

/* Light from above: Lambert's law of a hemisphere. */
static double half_sky(const double w[3], const void *context) {
    const double *up = context;
    return (1 + w[0] * up[0] + w[1] * up[1] + w[2] * up[2]) / 2;
}

static void test_turned_hemisphere(void) {
    memset(rgb, 0, sizeof rgb);
    const double up[3] = {0.48, -0.6, 0.64};
    double axes[3][3];
    for (int i = 0; i < 3 * WIDTH * HEIGHT / 2; ++i) {
        rgb[i] = 1;
    }
    burnish_environment *environment = make_environment();
    burnish_light_axes(up, 70, axes);
    burnish_light_maps *maps = maps_of(environment, axes, BURNISH_ISA_SCALAR);
    CHECK1(compare(burnish_light_maps_diffuse(maps), half_sky, up) < 4e-3);
    burnish_light_maps_destroy(maps);
    burnish_environment_destroy(environment);
}

/* One bright pixel: the lobes around its direction. */
typedef struct spot {
    double toward[3], solid_angle, radiance;
    burnish_light_lobes lobes;
} spot;

static double lobe_sum(const double w[3], const void *context) {
    const spot *s = context;
    const double c = w[0] * s->toward[0] + w[1] * s->toward[1] + w[2] * s->toward[2];
    double sum = 0;
    for (int j = 0; j < s->lobes.count; ++j) {
        const burnish_light_lobe *l = &s->lobes.lobe[j];
        const double zeta = (double)l->zeta, u = fmax(0, 1 + zeta * (c - 1));
        sum += (double)l->weight * pow(u, l->order) * zeta * (l->order + 1) / (2 * M_PI);
    }
    return sum * s->solid_angle * s->radiance;
}

static void test_spot(void) {
    enum { COLUMN = 3 * WIDTH / 4, ROW = HEIGHT / 4 };
    memset(rgb, 0, sizeof rgb);
    burnish_light_map map;
    rgb[3 * (ROW * WIDTH + COLUMN)] = 1000;
    burnish_environment *environment = make_environment();
    burnish_light_maps *maps = maps_of(environment, identity, BURNISH_ISA_SCALAR);
    const double polar = M_PI * (ROW + 0.5) / HEIGHT;
    const double azimuth = 2 * M_PI * (COLUMN + 0.5) / WIDTH - M_PI; /* about z */
    const spot expected = {{sin(polar) * cos(azimuth), cos(polar), sin(polar) * sin(azimuth)},
                           (cos(M_PI * ROW / HEIGHT) - cos(M_PI * (ROW + 1) / HEIGHT)) * 2 * M_PI /
                               WIDTH,
                           1000,
                           burnish_light_lobes_for(0.25f)};
    CHECK1(expected.toward[2] > 0.6);
    CHECK1(burnish_light_maps_need(maps, 0.25f, &map, NULL) == BURNISH_STATUS_OK);
    const double peak = lobe_sum(expected.toward, &expected);
    const double worst = compare(&map, lobe_sum, &expected) / peak;
    CHECK(worst < 0.02, "%.3g of the peak", worst);
    burnish_light_maps_destroy(maps);
    burnish_environment_destroy(environment);
}

/* Every instruction set and number of threads gives the same bits. */
static void test_bits(void) {
    memset(rgb, 0, sizeof rgb);
    burnish_light_map first[2] = {{0}}, map;
    burnish_light_maps *all[BURNISH_ISA_COUNT] = {NULL};
    for (int i = 0; i < 3 * WIDTH * HEIGHT; ++i) {
        rgb[i] = (float)(rand() % 1000) / 100;
    }
    burnish_environment *environment = make_environment();
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        burnish_tasks tasks;
        if (!(burnish_isa_available() >> isa & 1)) {
            continue;
        }
        burnish_tasks_begin(&tasks, NULL, 1 + isa % 3);
        all[isa] = maps_of(environment, identity, (burnish_isa)isa);
        for (int i = 0; i < 2; ++i) {
            CHECK1(burnish_light_maps_need(all[isa], i ? 0.5f : 0.1f, &map, NULL) ==
                   BURNISH_STATUS_OK);
            first[i] = first[i].texels ? first[i] : map;
            const size_t rows = (size_t)map.size + 2;
            burnish_light_map_complete(&map, &tasks);
            CHECK(memcmp(first[i].texels, map.texels, 2 * rows * rows * 4 * sizeof(float)) == 0,
                  "%s", burnish_isa_name((burnish_isa)isa));
        }
    }
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        burnish_light_maps_destroy(all[isa]);
    }
    burnish_environment_destroy(environment);
}

/* Another environment at the same address is another source. */
static void test_key(void) {
    memset(rgb, 0, sizeof rgb);
    burnish_environment *environment = make_environment();
    burnish_light_sources sources = {.environment = environment, .strength = 1};
    burnish_light_maps *maps = maps_of(environment, identity, BURNISH_ISA_SCALAR);
    memcpy(sources.environment_axes, identity, sizeof identity);
    burnish_environment_destroy(environment);
    rgb[0] = 1000;
    sources.environment = environment = make_environment();
    CHECK1(burnish_light_maps_set(maps, &sources, NULL, NULL) == BURNISH_STATUS_OK);
    const burnish_light_map *diffuse = burnish_light_maps_diffuse(maps);
    burnish_light_map_need(diffuse, diffuse->size, diffuse->size / 2);
    CHECK1(diffuse->texels[4 * (diffuse->size * (diffuse->size + 2) + diffuse->size / 2)] > 0);
    burnish_light_maps_destroy(maps);
    burnish_environment_destroy(environment);
}

/* ---- Images ---- */

static char logged[480];

static void take_log(void *user_data, const char *line) {
    (void)user_data;
    CHECK1(!logged[0]);
    snprintf(logged, sizeof logged, "%s", line);
}

static void test_values(void) {
    burnish_context_options options = burnish_context_options_default();
    burnish_context *context;
    burnish_environment *environment;
    options.log = take_log;
    CHECK1(burnish_context_create(&options, &context, NULL) == BURNISH_STATUS_OK);
    float odd[3 * 8] = {NAN, -1, INFINITY};
    CHECK1(burnish_environment_create(context, 4, 2, odd, &environment, NULL) == BURNISH_STATUS_OK);
    CHECK_TEXT(logged, "environment: 3 values are negative, above 1000000 or not numbers; they are "
                       "clamped");
    burnish_environment_destroy(environment);
    burnish_context_destroy(context);
}

static void test_arguments(void) {
    burnish_environment *environment;
    burnish_error error;
    CHECK1(burnish_environment_create(NULL, 0, 1, rgb, &environment, &error) ==
           BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_environment_create(NULL, 1, 1, NULL, &environment, &error) ==
           BURNISH_STATUS_ARGUMENT);
    CHECK1(burnish_environment_create(NULL, 1, BURNISH_ENVIRONMENT_MAX_SIDE + 1, rgb, &environment,
                                      &error) == BURNISH_STATUS_LIMIT);
    CHECK1(!environment);
    CHECK1(burnish_environment_decode(NULL, NULL, 1, NULL, &environment, &error) ==
           BURNISH_STATUS_ARGUMENT);
    static const struct {
        const char *file;
        burnish_status status;
        const char *part;
    } files[] = {{"#?RGBE\n\n-Y 16384 +X 16384\n", BURNISH_STATUS_LIMIT, "up to 134217728 pixels"},
                 {"#?RGBE\n\n-Y 8192 +X 8193\n", BURNISH_STATUS_LIMIT,
                  "8193 x 8192 pixels of 4 bytes in a file of 24"},
                 {"#?RGBE\n\n-Y 8192 +X 8192\n", BURNISH_STATUS_FORMAT, "scan line 1 of 8192"}};
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        CHECK1(burnish_environment_decode(NULL, files[i].file, strlen(files[i].file), NULL,
                                          &environment, &error) == files[i].status);
        CHECK(strstr(error.text, files[i].part), "%s", error.text);
    }
    CHECK1(burnish_environment_create_named(NULL, "moon", &environment, &error) ==
           BURNISH_STATUS_ARGUMENT);
    burnish_environment_destroy(NULL);
}

/* Sky and sun light a white horizontal surface to 1; the room is brightest above. */
static void test_names(void) {
    static const char *const names[] = {"sky", "room"};
    for (int i = 0; i < 2; ++i) {
        burnish_environment *environment;
        CHECK1(burnish_environment_create_named(NULL, names[i], &environment, NULL) ==
               BURNISH_STATUS_OK);
        burnish_light_maps *maps = maps_of(environment, identity, BURNISH_ISA_SCALAR);
        const burnish_light_map *map = burnish_light_maps_diffuse(maps);
        const int stride = map->size + 2, middle = map->size / 2;
        const float *up = map->texels + 4 * (map->size * stride + middle); /* y nearly 1 */
        const float *down = map->texels + 4 * (stride + middle);
        burnish_light_map_need(map, map->size, middle);
        burnish_light_map_need(map, 1, middle);
        const double luminance =
            0.2126 * (double)up[0] + 0.7152 * (double)up[1] + 0.0722 * (double)up[2];
        CHECK(luminance > (i ? 1.5 : 0.93) && luminance < (i ? 2 : 1.07), "%g", luminance);
        CHECK1(down[1] > 0.1f && down[1] < up[1]);
        burnish_light_maps_destroy(maps);
        burnish_environment_destroy(environment);
    }
}

/* Radiance of three.js' RoomEnvironment (r187) from its origin: ceiling, wall, floor and a box. */
static void test_room(void) {
    static const struct {
        int x, y;
        double radiance;
    } pixels[] = {{250, 5, 2.0732}, {100, 60, 0.9390}, {250, 250, 0.6998}, {100, 180, 0.2187}};
    burnish_environment *environment;
    burnish_error error;
    CHECK_OK(burnish_environment_create_named(NULL, "room", &environment, &error), error);
    const burnish_environment_level *image = &environment->levels[0];
    CHECK1(image->width == 512);
    for (size_t i = 0; i < sizeof pixels / sizeof *pixels; ++i) {
        const double is = (double)image->texels[1][pixels[i].y * image->width + pixels[i].x];
        CHECK(fabs(is - pixels[i].radiance) < 0.003, "%d, %d: %g", pixels[i].x, pixels[i].y, is);
    }
    burnish_environment_destroy(environment);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_constant());
    RUN(test_turned_hemisphere());
    RUN(test_spot());
    RUN(test_bits());
    RUN(test_key());
    RUN(test_values());
    RUN(test_arguments());
    RUN(test_names());
    RUN(test_room());
    return test_end("environment");
}
