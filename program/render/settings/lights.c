/* Values of the flags for light. */
#include "render/settings/flag_values.h"

#include <math.h>
#include <string.h>

static void linear_of(const float srgb[3], float scale, float linear[3]) {
    for (int k = 0; k < 3; ++k) {
        linear[k] = burnish_srgb_decode(srgb[k]) * scale;
    }
}

typedef enum light_shape { DIRECTIONAL, POINT, RECT, DISC, SPHERE, LINE } light_shape;

static const struct light_word {
    const char *name;
    light_shape shape;
    int follows_camera;
} light_words[] = {
    {"directional", DIRECTIONAL, 1},
    {"world-directional", DIRECTIONAL, 0},
    {"point", POINT, 1},
    {"world-point", POINT, 0},
    {"rect", RECT, 1},
    {"world-rect", RECT, 0},
    {"disc", DISC, 1},
    {"world-disc", DISC, 0},
    {"sphere", SPHERE, 1},
    {"world-sphere", SPHERE, 0},
    {"line", LINE, 1},
    {"world-line", LINE, 0},
};

static int is_word(const char *item, size_t length, const char *word) {
    return strlen(word) == length && !memcmp(word, item, length);
}

static const struct light_word *find_word(const char *item, size_t length) {
    for (size_t i = 0; i < sizeof light_words / sizeof *light_words; ++i) {
        if (is_word(item, length, light_words[i].name)) {
            return &light_words[i];
        }
    }
    return NULL;
}

/* Largest intensity of one light: beyond it every surface is white. */
#define INTENSITY_MAX 1000.0

/* The last items, [:INTENSITY[:COLOR]]; returns NULL, or what is wrong. */
static const char *read_brightness(const char *text, float color[3]) {
    const char *item;
    float srgb[3] = {1, 1, 1};
    double intensity = 1;
    if (text) {
        const size_t length = cli_next_item(&text, ':', &item);
        if (!cli_read_real(item, length, &intensity) ||
            !(intensity >= 0 && intensity <= INTENSITY_MAX)) {
            return "the intensity is a number from 0 to 1000";
        }
    }
    if (text && !cli_read_color(text, strlen(text), srgb)) {
        return "the colour is #rgb, #rrggbb, r,g,b from 0 to 1, or a name";
    }
    linear_of(srgb, (float)intensity, color);
    return NULL;
}

static int is_zero(const double v[3]) {
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

/* ---- Area lights ---- */

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        out[k] = a[i] * b[j] - a[j] * b[i];
    }
}

/* Scales v to a length; returns 0 if it is 0. */
static int set_length(double v[3], double length) {
    const double now = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3 && now > 0; ++k) {
        v[k] *= length / now;
    }
    return now > 0;
}

/* Half sides, the first across `upright`, of a light that faces `target`. Returns 0 if no such
 * sides exist. */
static int set_sides(burnish_area_light *light, const double target[3], const double upright[3],
                     const double size[2]) {
    double facing[3];
    for (int k = 0; k < 3; ++k) {
        facing[k] = target[k] - light->center[k];
    }
    cross(upright, facing, light->half_u);
    if (!set_length(facing, 1) || !set_length(light->half_u, size[0] / 2)) {
        return 0;
    }
    cross(facing, light->half_u, light->half_v);
    return set_length(light->half_v, size[1] / 2);
}

/* What the options of an area light set. */
typedef struct area_options {
    double target[3], upright[3];
    int has_target, has_upright;
} area_options;

/* distant, two-sided, target=X,Y,Z or upright=X,Y,Z. Returns 0 for other items. */
static int read_area_option(const char *item, size_t length, burnish_area_light *light,
                            area_options *options) {
    if (is_word(item, length, "distant")) {
        light->is_distant = 1;
        return 1;
    }
    if (is_word(item, length, "two-sided")) {
        light->is_two_sided = 1;
        return 1;
    }
    if (length > 7 && !memcmp(item, "target=", 7)) {
        options->has_target = cli_read_reals(item + 7, length - 7, options->target, 3);
        return options->has_target;
    }
    if (length > 8 && !memcmp(item, "upright=", 8)) {
        options->has_upright = cli_read_reals(item + 8, length - 8, options->upright, 3);
        return options->has_upright;
    }
    return 0;
}

/* X,Y,Z:WIDTH,HEIGHT[:OPTION]...[:INTENSITY[:COLOR]]; returns NULL, or what is wrong. */
static const char *read_area(const char *text, burnish_area_light *light) {
    area_options options = {.upright = {0, 1, 0}};
    const char *item;
    double size[2];
    size_t length = text ? cli_next_item(&text, ':', &item) : 0;
    if (length == 0 || !cli_read_reals(item, length, light->center, 3)) {
        return "the kind is followed by three numbers, such as rect:-1,1,1:0.5,0.5";
    }
    length = text ? cli_next_item(&text, ':', &item) : 0;
    if (length == 0 || !cli_read_reals(item, length, size, 2) ||
        !(size[0] > 0 && size[0] <= 1e30 && size[1] > 0 && size[1] <= 1e30)) {
        return "width and height above 0 and at most 1e30 follow the position, as in "
               "rect:-1,1,1:0.5,0.5";
    }
    while (text) {
        const char *rest = text;
        length = cli_next_item(&rest, ':', &item);
        if (!read_area_option(item, length, light, &options)) {
            break;
        }
        text = rest;
    }
    if (light->follows_camera && !light->is_distant && !options.has_target) {
        options.target[2] = -1; /* the focal point */
    }
    if (light->is_distant && options.has_target) {
        return "a distant light faces the object; omit target";
    }
    if (light->is_distant && is_zero(light->center)) {
        return "0,0,0 has no direction";
    }
    if (!set_sides(light, options.target, options.upright, size)) {
        return "the light is at its target, or faces it along upright; give another target=X,Y,Z "
               "or upright=X,Y,Z";
    }
    return read_brightness(text, light->color);
}

/* Moves three numbers from the text; returns 0 if they are missing. */
static int read_position(const char **text, double position[3]) {
    const char *item;
    const size_t length = *text ? cli_next_item(text, ':', &item) : 0;
    return length > 0 && cli_read_reals(item, length, position, 3);
}

/* X,Y,Z:RADIUS[:distant][:INTENSITY[:COLOR]] of a sphere; a line has both ends; returns NULL, or
 * what is wrong. */
static const char *read_round(const char *text, burnish_area_light *light) {
    const int is_line = light->shape == BURNISH_AREA_LINE;
    area_options unused = {.has_target = 0};
    double end[3], radius, squared = 0;
    const char *item, *rest;
    if (!read_position(&text, light->center) || (is_line && !read_position(&text, end))) {
        return is_line ? "the kind is followed by two positions, as in line:-1,1,0:1,1,0:0.05"
                       : "the kind is followed by three numbers, such as sphere:-1,1,1:0.2";
    }
    size_t length = text ? cli_next_item(&text, ':', &item) : 0;
    if (length == 0 || !cli_read_real(item, length, &radius) || !(radius > 0 && radius <= 1e30)) {
        return is_line ? "a radius above 0 and at most 1e30 follows, as in line:-1,1,0:1,1,0:0.05"
                       : "a radius above 0 and at most 1e30 follows, as in sphere:-1,1,1:0.2";
    }
    for (int k = 0; k < 3; ++k) {
        light->half_u[k] = is_line ? (end[k] - light->center[k]) / 2 : k == 0 ? radius : 0;
        light->half_v[k] = is_line && k == 0 ? radius : 0;
        light->center[k] += is_line ? light->half_u[k] : 0;
        squared += light->center[k] * light->center[k];
    }
    for (rest = text; rest; text = rest) {
        length = cli_next_item(&rest, ':', &item);
        if (!read_area_option(item, length, light, &unused)) {
            break;
        }
        if (light->is_two_sided || unused.has_target || unused.has_upright) {
            return "it shines in all directions; omit two-sided, target and upright";
        }
    }
    if (is_line && is_zero(light->half_u)) {
        return "both ends are in one place; use sphere, or move one";
    }
    if (light->is_distant && !(radius * radius < squared)) {
        return "a distant light is farther from 0,0,0 than its radius; reduce the radius";
    }
    return read_brightness(text, light->color);
}

/* ---- Flags ---- */

/* X,Y,Z[:INTENSITY[:COLOR]]; returns NULL, or what is wrong. */
static const char *read_light(const char *text, burnish_light *light) {
    const char *item;
    const size_t length = text ? cli_next_item(&text, ':', &item) : 0;
    if (length == 0 || !cli_read_reals(item, length, light->vector, 3)) {
        return "the kind is followed by three numbers, such as directional:-1,1,2";
    }
    if (light->kind == BURNISH_LIGHT_DIRECTIONAL && is_zero(light->vector)) {
        return "0,0,0 has no direction";
    }
    return read_brightness(text, light->color);
}

static burnish_status add_area(const cli_flag *flag, const struct light_word *word,
                               const char *text, render_lights *lights, burnish_error *error) {
    burnish_area_light *light = &lights->areas[lights->area_count];
    if (lights->area_count == BURNISH_AREA_LIGHT_MAX) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: more than %d area lights; omit some",
                        flag->name, BURNISH_AREA_LIGHT_MAX);
    }
    static const burnish_area_shape shapes[] = {[RECT] = BURNISH_AREA_RECT,
                                                [DISC] = BURNISH_AREA_DISC,
                                                [SPHERE] = BURNISH_AREA_SPHERE,
                                                [LINE] = BURNISH_AREA_LINE};
    *light =
        (burnish_area_light){.shape = shapes[word->shape], .follows_camera = word->follows_camera};
    const char *rest = strchr(text, ':') ? strchr(text, ':') + 1 : NULL;
    const char *wrong = word->shape < SPHERE ? read_area(rest, light) : read_round(rest, light);
    if (wrong) {
        const char *sizes = word->shape < SPHERE  ? "WIDTH,HEIGHT"
                            : word->shape == LINE ? "X,Y,Z:RADIUS"
                                                  : "RADIUS";
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.60s\" is not %s:X,Y,Z:%s[:OPTION][:INTENSITY[:COLOR]]: %s",
                        flag->name, text, word->name, sizes, wrong);
    }
    ++lights->area_count;
    return BURNISH_STATUS_OK;
}

burnish_status render_flag_light(const cli_flag *flag, const char *text, void *target,
                                 burnish_error *error) {
    render_lights *lights = target;
    lights->given = 1;
    if (strcmp(text, "none") == 0) {
        lights->count = lights->area_count = lights->of_file = 0;
        return BURNISH_STATUS_OK;
    }
    if (strcmp(text, "file") == 0) {
        lights->of_file = 1;
        return BURNISH_STATUS_OK;
    }
    const struct light_word *word = find_word(text, strcspn(text, ":"));
    const char *wrong =
        "the kind is directional, point, rect, disc, sphere or line, or one of these "
        "after world-; or the whole is none or file";
    if (word && word->shape >= RECT) {
        return add_area(flag, word, text, lights, error);
    }
    if (lights->count == BURNISH_LIGHT_MAX) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: more than %d lights; omit some",
                        flag->name, BURNISH_LIGHT_MAX);
    }
    if (word) {
        const char *rest = strchr(text, ':');
        burnish_light *light = &lights->items[lights->count];
        *light = (burnish_light){.kind = word->shape == POINT ? BURNISH_LIGHT_POINT
                                                              : BURNISH_LIGHT_DIRECTIONAL,
                                 .follows_camera = word->follows_camera};
        wrong = read_light(rest ? rest + 1 : NULL, light);
    }
    if (wrong) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.60s\" is not KIND:X,Y,Z[:INTENSITY[:COLOR]]: %s", flag->name,
                        text, wrong);
    }
    ++lights->count;
    return BURNISH_STATUS_OK;
}

burnish_status render_flag_ambient(const cli_flag *flag, const char *text, void *target,
                                   burnish_error *error) {
    render_ambient *ambient = target;
    double value;
    float srgb[3];
    size_t length = strlen(text);
    if (cli_read_real(text, length, &value) && value >= flag->low && value <= flag->high) {
        *ambient = (render_ambient){1, {(float)value, (float)value, (float)value}};
        return BURNISH_STATUS_OK;
    }
    if (cli_read_color(text, length, srgb)) {
        ambient->given = 1;
        linear_of(srgb, 1, ambient->linear);
        return BURNISH_STATUS_OK;
    }
    return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                    "--%s: \"%.60s\" is not a number from %g to %g, nor %s", flag->name, text,
                    flag->low, flag->high, cli_color_forms);
}
