/* The command line of `burnish render`: both forms of a flag, hints, strict numbers, defaults that
 * agree with the library's, and the scene that settings make of a mesh. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/cli/help.h"
#include "cli/main.h"
#include "decimal_comma.h"
#include "render/scene/cameras.h"
#include "render/scene/library_options.h"
#include "render/scene/prepare.h"
#include "render/scene/up.h"
#include "render/settings/flag_values.h"

typedef struct parsed {
    burnish_status status;
    render_settings settings;
    cli_call call;
    burnish_error error;
} parsed;

/* Parses words between '|'. */
static parsed parse(const char *line) {
    parsed result = {.status = BURNISH_STATUS_OK};
    static char copy[1024]; /* the settings point into it */
    char *argv[32];
    int argc = 0;
    snprintf(copy, sizeof copy, "%s", line);
    for (char *word = strtok(copy, "|"); word && argc < 32; word = strtok(NULL, "|")) {
        argv[argc++] = word;
    }
    result.status = cli_defaults(&render_command, &result.settings, &result.error);
    CHECK(result.status == BURNISH_STATUS_OK, "%s", result.error.text);
    result.status =
        cli_parse(&render_command, argc, argv, &result.settings, &result.call, &result.error);
    return result;
}

static void test_defaults(void) {
    parsed p = parse("x.obj");
    burnish_render_options render = burnish_render_options_default();
    burnish_load_options load = burnish_load_options_default();
    burnish_framing fit = burnish_framing_default();
    const render_settings *s = &p.settings;
    CHECK1(s->picture.size[0] == render.width && s->picture.size[1] == render.height);
    CHECK1(s->picture.samples == render.samples && s->job.threads == render.threads);
    CHECK1(s->shading.lobes.count == 1 && s->shading.lobes.items[0].kind == render.lobe.kind &&
           s->shading.lobes.items[0].fit == render.lobe.fit &&
           s->shading.lobes.items[0].order == render.lobe.order);
    CHECK1(s->shading.equation == (int)render.specular_model &&
           s->shading.viewer == render.local_viewer);
    CHECK(render.background[0] == 255 && render.background[1] == 255 && render.background[2] == 255,
          "the help says that the background is white");
    CHECK1(s->input.load.format == (int)load.format &&
           s->input.load.tessellation == load.tessellation);
    CHECK1(!s->input.crease.given && load.crease_angle == BURNISH_CREASE_AUTO);
    CHECK1(s->input.load.max_triangles == load.max_triangles &&
           s->input.load.max_input_bytes == load.max_input_bytes);
    CHECK1(s->camera.view_angle.value == fit.view_angle && s->camera.margin.value == fit.margin);
    CHECK1(s->camera.azimuth.value == fit.azimuth && s->camera.elevation.value == fit.elevation);
    CHECK1(!s->output.json && !s->job.quiet && !s->output.fail_on_blank &&
           s->camera.projection == PROJECTION_AUTO && s->shading.material == 0);
}

static void test_forms(void) {
    CHECK1(parse("x|--samples=8").settings.picture.samples == 8);
    CHECK1(parse("--samples|8|x").settings.picture.samples == 8);
    CHECK(parse("x|--samples=8|--samples|16").settings.picture.samples == 16, "the last counts");
    parsed p = parse("-o|out.png|x.obj");
    CHECK_TEXT(p.settings.output.path, "out.png");
    CHECK_TEXT(p.call.operands[0], "x.obj");
    CHECK_TEXT(parse("-oout.png|x.obj").settings.output.path, "out.png");
    CHECK_TEXT(parse("--output|-|x.obj").settings.output.path, "-");
    CHECK_TEXT(parse("--output=--json|x").settings.output.path, "--json");
    CHECK_TEXT(parse("--output=a=b|x").settings.output.path, "a=b");
    p = parse("--json|--|--quiet");
    CHECK1(p.settings.output.json && !p.settings.job.quiet);
    CHECK_TEXT(p.call.operands[0], "--quiet");
    CHECK_TEXT(p.settings.output.json, "-");
    CHECK_TEXT(parse("-|--json").call.operands[0], "-");
    CHECK_TEXT(parse("x|--json=a.json").settings.output.json, "a.json");
    CHECK_TEXT(parse("--json|x").call.operands[0], "x");
    p = parse("x|--azimuth|-30|--camera-position|-1,-2,-3");
    CHECK(p.settings.camera.azimuth.value == -30 && p.settings.camera.position.values[2] == -3,
          "a negative number is a value, not a flag");
    p = parse("x|--size=64|--resolution=300,200");
    CHECK1(p.settings.picture.size[0] == 300 && p.settings.picture.size[1] == 200);
    p = parse("x|--resolution=300x200|--size=64");
    CHECK1(p.settings.picture.size[0] == 64 && p.settings.picture.size[1] == 64);
    p = parse("x|--camera-azimuth-angle=7|--verbose|--size=30x20");
    CHECK1(p.settings.camera.azimuth.value == 7 && p.settings.job.timing);
    CHECK1(p.settings.picture.size[0] == 30 && p.settings.picture.size[1] == 20);
    CHECK1(parse("x|--help|--nonsense").call.help == 1);
    CHECK1(parse("x|-h").call.help == 1 && !parse("x|-h").call.topic);
    CHECK_TEXT(parse("x|--help=camera").call.topic, "camera");
}

static void expect_error(const char *line, const char *text) {
    parsed p = parse(line);
    CHECK(p.status == BURNISH_STATUS_ARGUMENT, "%s: accepted", line);
    if (p.status != BURNISH_STATUS_OK) {
        CHECK_TEXT(p.error.text, text);
    }
}

static void test_errors(void) {
    expect_error("--sample=4", "--sample: unknown flag; did you mean --samples?");
    expect_error("--colour=red", "--colour: unknown flag; did you mean --color?");
    expect_error("--treads|2", "--treads: unknown flag; did you mean --threads?");
    expect_error("--zise=3", "--zise: unknown flag; did you mean --size?");
    expect_error("--fov", "--fov: unknown flag; did you mean --camera-view-angle?");
    expect_error("--up-axis=+Z", "--up-axis: unknown flag; did you mean --up?");
    expect_error("--transparent", "--transparent: unknown flag; did you mean --no-background?");
    expect_error("--res=3", "--res: unknown flag; did you mean --resolution?");
    expect_error("-z", "-z: unknown flag; \"burnish render --help\" lists the flags");
    expect_error("--samples=", "--samples: \"\" is not one of 1, 4, 8, 16");
    expect_error("-o", "--output: a value is missing: --output=FILE");
    expect_error("-o=x", "-o: write -o FILE or --output=FILE, not -o=FILE");
    expect_error("--size=0",
                 "--size: \"0\" is not a width and a height from 1 to 16384, such as 1024x768, "
                 "or one number for both");
    expect_error("--size=1e3",
                 "--size: \"1e3\" is not a width and a height from 1 to 16384, such as 1024x768, "
                 "or one number for both");
    expect_error("--margin=0.6", "--margin: \"0.6\" is not a number from 0 to 0.45");
    expect_error("--color=greige",
                 "--color: \"greige\" is not a colour: #rgb, #rrggbb, r,g,b from 0 to "
                 "1, or a name");
    expect_error("--lobe=energy:2,", "--lobe: \"\" is not a lobe; use FIT:ORDER with FIT taylor, "
                                     "energy, levelQ (0 < Q < 1), shift7, shift3, projected, "
                                     "minimax, leastsquares, affine or zetaZ and ORDER 2, 4, 8, 16 "
                                     "or 32, or composite:2 to composite:6, display:5, display:6, "
                                     "lyon:ORDER, power, schlick, gaussian, gx, exact, auto");
    expect_error("--views=front,,top",
                 "--views: \"\" is not one of front, right, top, iso, back, left, bottom, all, "
                 "third-angle, first-angle");
    expect_error("--size=\x1b[2J",
                 "--size: \"?[2J\" is not a width and a height from 1 to 16384, such as 1024x768, "
                 "or one number for both");
}

static void test_numbers(void) {
    static const char *const good[] = {"0",   "-0",   "+1.5", ".5",     "5.",
                                       "1e3", "1E-3", "1e+2", "123456", "-12.25"};
    static const char *const bad[] = {"",    ".",   "-",     "+",     "e5",  "1e",  "1e+",
                                      "nan", "inf", "0x1",   " 1",    "1 ",  "1,5", "1..2",
                                      "--1", "1f",  "1e999", "1_000", "\t1", "1\n"};
    double value;
    for (size_t i = 0; i < sizeof good / sizeof *good; ++i) {
        CHECK(cli_read_real(good[i], strlen(good[i]), &value) && value == strtod(good[i], NULL),
              "%s", good[i]);
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        CHECK(!cli_read_real(bad[i], strlen(bad[i]), &value), "\"%s\" accepted", bad[i]);
    }
    CHECK1(parse("x|--max-input-bytes=3K").settings.input.load.max_input_bytes == 3072);
    CHECK1(parse("x|--max-input-bytes=2G").settings.input.load.max_input_bytes == (uint64_t)2
                                                                                      << 30);
    CHECK1(parse("x|--max-input-bytes=99999999999G").status == BURNISH_STATUS_ARGUMENT);
    CHECK1(parse("x|--max-input-bytes=G").status == BURNISH_STATUS_ARGUMENT);
    CHECK1(parse("x|--max-input-bytes=").status == BURNISH_STATUS_ARGUMENT);
    CHECK1(parse("x|--max-triangles=2147483648").status == BURNISH_STATUS_ARGUMENT);
    CHECK1(parse("x|--threads=1025").status == BURNISH_STATUS_ARGUMENT);
    CHECK1(parse("x|--camera-view-angle=180").status == BURNISH_STATUS_ARGUMENT);
    CHECK1(parse("x|--camera-direction=0,0,0").status == BURNISH_STATUS_ARGUMENT);
    CHECK1(parse("x|--camera-position=1,2,3,4").status == BURNISH_STATUS_ARGUMENT);
}

static void test_colors(void) {
    float c[3];
    CHECK1(cli_read_color("#fa0", 4, c) && c[0] == 1 && c[1] == 170 / 255.0F && c[2] == 0);
    CHECK1(cli_read_color("#FF8000", 7, c) && c[0] == 1 && c[1] == 128 / 255.0F && c[2] == 0);
    CHECK1(cli_read_color("0.25,.5,1", 9, c) && c[0] == 0.25F && c[1] == 0.5F && c[2] == 1);
    CHECK1(cli_read_color("white", 5, c) && c[0] == 1 && c[1] == 1 && c[2] == 1);
    static const char *const bad[] = {"",        "#",     "#12",    "#12345", "#ggg",   "1,1",
                                      "1,1,1,1", "2,0,0", "-1,0,0", "whit",   "whites", "#1234567"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        CHECK(!cli_read_color(bad[i], strlen(bad[i]), c), "\"%s\" accepted", bad[i]);
    }
    for (int k = 0; k < 256; ++k) {
        CHECK(cli_color_code((float)k / 255.0F) == k, "code %d", k);
    }
    parsed p = parse("x|--no-background|--background-color=#123456");
    CHECK(!p.settings.picture.background.transparent && p.settings.picture.background.given,
          "the later counts");
    p = parse("x|--background-color=#123456|--no-background");
    CHECK(p.settings.picture.background.transparent && !p.settings.picture.background.given,
          "the later counts");
    CHECK1(parse("x|--background-color=none").settings.picture.background.transparent);
}

static void test_lights(void) {
    parsed p = parse("x|--light=directional:-1,2.5,3:0.5:#f00|--light|world-point:1,2,3");
    const burnish_light *lights = p.settings.shading.lights.items;
    CHECK1(p.status == BURNISH_STATUS_OK && p.settings.shading.lights.count == 2);
    CHECK1(lights[0].kind == BURNISH_LIGHT_DIRECTIONAL && lights[0].follows_camera == 1);
    CHECK1(lights[0].vector[0] == -1 && lights[0].vector[1] == 2.5 && lights[0].vector[2] == 3);
    CHECK1(lights[0].color[0] == 0.5F && lights[0].color[1] == 0 && lights[0].color[2] == 0);
    CHECK1(lights[1].kind == BURNISH_LIGHT_POINT && lights[1].follows_camera == 0);
    CHECK1(lights[1].color[0] == 1 && lights[1].color[2] == 1);
    p = parse("x|--light=sphere:1,2,3:0.5:2:#f00|--light=world-line:0,1,2:4,1,2:0.25:distant");
    const burnish_area_light *areas = p.settings.shading.lights.areas;
    CHECK1(p.status == BURNISH_STATUS_OK && p.settings.shading.lights.area_count == 2);
    CHECK1(areas[0].shape == BURNISH_AREA_SPHERE && areas[0].follows_camera == 1);
    CHECK1(areas[0].center[1] == 2 && areas[0].half_u[0] == 0.5 && areas[0].color[0] == 2);
    CHECK1(areas[1].shape == BURNISH_AREA_LINE && !areas[1].follows_camera && areas[1].is_distant);
    CHECK1(areas[1].center[0] == 2 && areas[1].half_u[0] == 2 && areas[1].half_v[0] == 0.25);
    p = parse("x|--light=point:1,2,3|--light=none");
    CHECK1(p.settings.shading.lights.given && p.settings.shading.lights.count == 0);
    static const char *const bad[] = {"x|--light=sun:1,2,3",
                                      "x|--light=point",
                                      "x|--light=point:",
                                      "x|--light=point:1,2",
                                      "x|--light=point:1,2,3:",
                                      "x|--light=point:1,2,3:-1",
                                      "x|--light=point:1,2,3:1:",
                                      "x|--light=point:1,2,3:1:red:",
                                      "x|--light=directional:0,0,0",
                                      "x|--light=sphere:1,2,3",
                                      "x|--light=sphere:1,2,3:0",
                                      "x|--light=sphere:1,2:1",
                                      "x|--light=sphere:1,2,3:1:two-sided",
                                      "x|--light=line:1,2,3:1",
                                      "x|--light=line:1,2,3:1,2,3:1",
                                      "x|--light=line:1,2,3:1,2,4:1:upright=0,0,1",
                                      "x|--light=sphere:1,0,0:1:distant"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; ++i) {
        CHECK(parse(bad[i]).status == BURNISH_STATUS_ARGUMENT, "%s accepted", bad[i]);
    }
    p = parse("x|--ambient=0.5");
    CHECK1(p.settings.shading.ambient.linear[0] == 0.5F &&
           p.settings.shading.ambient.linear[2] == 0.5F);
    CHECK1(parse("x|--ambient=white").settings.shading.ambient.linear[1] == 1);
}

/* The fields of every row that the help screen and the man page need. */
static void test_table(void) {
    const cli_command *command = &render_command;
    CHECK1(command->flags[0].group && command->flags[0].help);
    for (size_t i = 0; i < command->flag_count; ++i) {
        const cli_flag *flag = &command->flags[i];
        CHECK(flag->handler && flag->manual && strlen(flag->manual) > 10, "--%s", flag->name);
        CHECK(strlen(flag->name) < CLI_NAME_MAX, "--%s", flag->name);
        CHECK(flag->help && *flag->help, "--%s has no row on the help screen", flag->name);
        CHECK(!flag->group == !flag->topic, "--%s: a group has a topic", flag->name);
        CHECK(flag->phases != 0, "--%s acts in no phase, so no command would inherit it",
              flag->name);
        const int names_file =
            flag->value && (strstr(flag->value, "FILE") || strstr(flag->value, "FOLDER"));
        CHECK(names_file == (flag->file != CLI_NO_FILE), "--%s: what it names", flag->name);
        for (size_t k = 0; k < i; ++k) {
            CHECK(strcmp(flag->name, command->flags[k].name) != 0, "--%s twice", flag->name);
            CHECK(!flag->letter || flag->letter != command->flags[k].letter, "-%c twice",
                  flag->letter);
        }
    }
    for (size_t i = 0; render_preset_words[i].name; ++i) {
        CHECK1(render_preset_words[i].value == (int)i + 1);
        CHECK_TEXT(render_preset_words[i].name, render_presets[i].name);
    }
}

/* A locale with a decimal comma changes nothing. */
static void test_decimal_comma(void) {
    double value;
    if (test_decimal_comma_begin()) {
        CHECK1(cli_read_real("1.5", 3, &value) && value == 1.5);
        CHECK1(!cli_read_real("1,5", 3, &value));
        test_decimal_comma_end();
    }
}

/* ---- Scenes ---- */

/* A closed box from (0, 100, 0) to (100, 110, 100) with a spot light at (50, 150, 50). */
#define BOX(lights)                                                                                \
    "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":132,\"uri\":\"data:;base64,"    \
    "AAAAAAAAyEIAAAAAAAAAAAAAyEIAAMhCAAAAAAAA3EIAAAAAAAAAAAAA3EIAAMhCAADIQgAAyEIAAAAAAADIQgAAyEIA" \
    "AMhCAADIQgAA3EIAAAAAAADIQgAA3EIAAMhCAAEDAAMCBAYHBAcFAAQFAAUBAgMHAgcGAAIGAAYEAQUHAQcD\"}],"    \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":96},"                                           \
    "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":36}],"                                         \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\"},"      \
    "{\"bufferView\":1,\"componentType\":5121,\"count\":36,\"type\":\"SCALAR\"}],"                 \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}]," lights "}"
#define SPOT                                                                                       \
    "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\",\"intensity\":1}]}}," \
    "\"nodes\":[{\"mesh\":0},{\"translation\":[50,150,50],"                                        \
    "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}]"
#define DARK "\"nodes\":[{\"mesh\":0}]"

typedef struct prepared {
    parsed line;
    burnish_mesh *mesh;
    burnish_render_options options;
    render_environment environment;
    render_warnings warnings;
    double range[2];
    burnish_status status;
} prepared;

/* The scene of a command line; coordinates of the mesh begin at y = 100. */
static prepared prepare(const char *line, const char *text) {
    static const double origin[3] = {0, 100, 0};
    prepared p = {.line = parse(line)};
    burnish_error error = {BURNISH_STATUS_OK, ""};
    render_settings *settings = &p.line.settings;
    settings->input.name = "box";
    burnish_load_options load = render_load_options(&settings->input, 1);
    load.origin = origin;
    CHECK_OK(p.line.status, p.line.error);
    CHECK_OK(burnish_mesh_load_memory(text, strlen(text), "box.gltf", &load, &p.mesh, &error),
             error);
    render_scene scene = {settings, p.mesh, &p.options, &p.environment, &p.warnings, p.range};
    p.status = p.mesh ? render_prepare(&scene, &error) : BURNISH_STATUS_READ;
    return p;
}

static void release(prepared *p) {
    render_drop_warnings(&p->warnings, 0);
    render_release_environment(&p->environment);
    burnish_mesh_destroy(p->mesh);
}

static int warns(const prepared *p, const char *part) {
    int count = 0;
    for (size_t i = 0; i < p->warnings.count; ++i) {
        count += strstr(p->warnings.lines[i], part) != NULL;
    }
    return count;
}

/* Cutting and colouring: planes are the file's, the whole box is not flat, colours are those of
 * what is left. */
static void test_cut_scene(void) {
    prepared p = prepare("x|--clip=0,1,0,100.25|--clip=1,0,0,500|--color-by=height", BOX(SPOT));
    CHECK_OK(p.status, p.line.error);
    CHECK(burnish_mesh_get_view(p.mesh)->cut_count == 1 && warns(&p, "1,0,0,500") == 1 &&
              p.warnings.count == 1,
          "%d cuts, %zu warnings", burnish_mesh_get_view(p.mesh)->cut_count, p.warnings.count);
    CHECK(p.line.settings.camera.flat_axis == 0, "flat along %d", p.line.settings.camera.flat_axis);
    CHECK(p.range[1] - p.range[0] == 0.25, "colours from %g to %g", p.range[0], p.range[1]);
    release(&p);
}

/* A plate on its edge lies down before its height is coloured. */
static void test_lying_scene(void) {
    prepared p =
        prepare("x|--color-by=height",
                "v 0 0 0\nv 90 0 0\nv 0 90 0\nv 90 90 0\nv 0 0 5\nv 90 0 5\nv 0 90 5\nv 90 90 5\n"
                "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
    CHECK_OK(p.status, p.line.error);
    CHECK1(p.line.settings.camera.stands_otherwise);
    CHECK(p.range[1] - p.range[0] == 5, "colours from %g to %g", p.range[0], p.range[1]);
    release(&p);
}

/* Clouds of terrain and of geographic coordinates take +Z, those of a depth camera -Y. */
static void test_cloud_stance(void) {
    static const struct {
        const char *scale, *reason; /* of x, y, z; after a distance */
    } cases[] = {{"0 100 80 15", "terrain"},    {"0 100 80 40", NULL},
                 {"0 0.5 0.5 0.4", "camera"},   {"0 100 15 80", NULL},
                 {"0 100 80 0.1", NULL},        {"500000 100 80 90", "geographic"},
                 {"11000 9000 8000 9000", NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        const burnish_load_options load = burnish_load_options_default();
        char text[1024] = "FIELDS x y z\nPOINTS 27\nDATA ascii\n", *end = text + strlen(text);
        double away, size[3];
        burnish_mesh *mesh = NULL;
        burnish_error error;
        sscanf(cases[i].scale, "%lf %lf %lf %lf", &away, &size[0], &size[1], &size[2]);
        for (int k = 0; k < 27; ++k) {
            end += sprintf(end, "%g %g %g\n", away + k % 3 * size[0] / 2,
                           away + k / 3 % 3 * size[1] / 2, 1 + k / 9 * size[2] / 2.0);
        }
        CHECK_OK(burnish_mesh_load_memory(text, strlen(text), "a.pcd", &load, &mesh, &error),
                 error);
        const char *reason = render_find_stance(mesh).reason;
        CHECK(reason == cases[i].reason ||
                  (reason && cases[i].reason && strcmp(reason, cases[i].reason) == 0),
              "%s: %s", cases[i].scale, reason ? reason : "none");
        burnish_mesh_destroy(mesh);
    }
}

/* A sheet in a slanted plane is shown from its front, unless a flag states the view. */
static void test_slanted_view(void) {
    static const char sheet[] = "v 0 0 0\nv 9 0 9\nv 0 9 9\nv 9 9 18\nf 1 2 3\nf 2 4 3\n";
    for (int is_given = 0; is_given < 2; ++is_given) {
        prepared p = prepare(is_given ? "x|--elevation=20" : "x", sheet);
        burnish_camera camera;
        render_room room = {.is_given = 0};
        CHECK_OK(render_camera(p.mesh, &p.line.settings, VIEW_FREE, &room, &camera, &p.line.error),
                 p.line.error);
        double along = 0, length = 0;
        for (int k = 0; k < 3; ++k) {
            const double away = camera.position[k] - camera.focal_point[k];
            along += k < 2 ? -away : away;
            length += away * away;
        }
        CHECK((along / sqrt(3 * length) > 0.9999) == !is_given, "%g", along / sqrt(3 * length));
        release(&p);
    }
}

/* The three-quarter view rises over flat objects, unless a flag states the elevation. */
static void test_flat_view(void) {
    static const struct {
        const char *line;
        double height, elevation;
    } cases[] = {{"x|--up=+Y", 3, 20},
                 {"x|--up=+Y", 2.5, 20},
                 {"x|--up=+Y", 1.5, 35},
                 {"x|--up=+Y", 0.5, 50},
                 {"x|--up=+Y|--azimuth=40", 0.1, 50},
                 {"x|--up=+Y|--camera-orthographic", 1.5, 35},
                 {"x|--up=+Z", 1.5, 20},
                 {"x|--up=+Y|--elevation=0", 0.5, 20},
                 {"x|--up=+Y|--elevation=-30", 0.5, -10},
                 {"x|--up=+Y|--camera-direction=0,0,-1", 0.5, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        parsed line = parse(cases[i].line);
        char text[128];
        burnish_mesh *mesh = NULL;
        burnish_camera camera = {.view_angle = 0};
        render_room room = {.is_given = 0};
        const burnish_load_options load = burnish_load_options_default();
        snprintf(text, sizeof text, "v 0 0 0\nv 10 0 0\nv 0 %g 0\nv 0 0 10\nf 1 2 3\nf 1 3 4\n",
                 cases[i].height);
        CHECK_OK(burnish_mesh_load_memory(text, strlen(text), "a.obj", &load, &mesh, &line.error),
                 line.error);
        render_set_stance(mesh, &line.settings.camera);
        CHECK_OK(render_camera(mesh, &line.settings, VIEW_FREE, &room, &camera, &line.error),
                 line.error);
        const int up = strstr(cases[i].line, "+Z") ? 2 : 1;
        double away[3], length = 0;
        for (int k = 0; k < 3; ++k) {
            away[k] = camera.position[k] - camera.focal_point[k];
            length += away[k] * away[k];
        }
        const double rise = asin(away[up] / sqrt(length)) * 180 / 3.14159265358979;
        CHECK(fabs(rise - cases[i].elevation) < 0.5, "case %zu: %g degrees", i, rise);
        burnish_mesh_destroy(mesh);
    }
}

/* The studio makes black materials visible, unless a flag or their emission does. */
static void test_black_material(void) {
    static const struct {
        const char *line;
        float diffuse, specular, reflectance, emissive;
        int is_lifted; /* 2: grey, as all of the mesh is black */
    } cases[] = {{"x", 0, 0, 0, 0, 2},
                 {"x|--look=plain", 0, 0, 0.001f, 0, 2},
                 {"x|--look=clay", 0.001f, 0, 0, 0, 0},
                 {"x|--look=technical", 0.001f, 0, 0, 0, 2},
                 {"x|--material=plastic", 0, 0, 0, 0, 2},
                 {"x|--no-colors", 0, 0, 0, 0, 0},
                 {"x|--color=black", 0, 0, 0, 0, 1},
                 {"x", 0.02f, 0.01f, 0, 0, 1},
                 {"x|--color=black", 0.5f, 0, 0, 0, 1},
                 {"x|--color=white", 0, 0, 0, 0, 0},
                 {"x|--material=metal|--color=silver", 0, 0, 0, 0, 0},
                 {"x|--specular=0", 0, 0, 0, 0, 2},
                 {"x|--specular=0", 0.01f, 0, 0, 0, 0},
                 {"x|--look=plain", 0.02f, 0, 0, 0, 0},
                 {"x", 0.04f, 0, 0, 0, 0},
                 {"x", 0, 0.3f, 0, 0, 0},
                 {"x", 0, 0, 0.04f, 0, 0},
                 {"x", 0, 0, 0, 1, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        parsed line = parse(cases[i].line);
        burnish_mesh *mesh = NULL;
        render_blacks blacks;
        const burnish_load_options load = burnish_load_options_default();
        CHECK_OK(burnish_mesh_load(":sphere", &load, &mesh, &line.error), line.error);
        burnish_material material = burnish_material_default();
        material.has_diffuse = 1;
        for (int k = 0; k < 3; ++k) {
            material.diffuse[k] = material.ambient[k] = cases[i].diffuse;
            material.specular[k] = cases[i].specular;
            material.reflectance[k] = cases[i].reflectance;
            material.emissive[k] = cases[i].emissive;
        }
        CHECK_OK(burnish_mesh_set_material(mesh, 0, &material, &line.error), line.error);
        CHECK_OK(render_adjust_materials(&line.settings.shading, mesh, &blacks, &line.error),
                 line.error);
        const burnish_material *seen = burnish_mesh_get_material(mesh, 0);
        CHECK(blacks.lifted == (cases[i].is_lifted == 1) &&
                  blacks.are_all == (cases[i].is_lifted == 2),
              "case %zu: %zu are lifted, all %d", i, blacks.lifted, blacks.are_all);
        CHECK(blacks.are_all
                  ? seen->diffuse[1] > 0.3f
                  : !blacks.lifted || (seen->diffuse[1] == 0.035f && seen->reflectance[1] > 0),
              "case %zu: %g", i, (double)seen->diffuse[1]);
        burnish_mesh_destroy(mesh);
    }
}

/* Lights and camera: those of flags are moved, those of the file are added to them. */
static void test_lit_scene(void) {
    prepared p = prepare("x|--light=world-point:1,102,3|--light=file|--shadow|--environment=sky|"
                         "--camera-position=5,107,9|--opacity=0.5",
                         BOX(SPOT));
    CHECK_OK(p.status, p.line.error);
    CHECK(p.options.light_count == 2, "%d lights", p.options.light_count);
    CHECK(p.options.lights[0].vector[1] == 2, "from %g", p.options.lights[0].vector[1]);
    CHECK(p.options.lights[1].vector[1] == 50, "from %g", p.options.lights[1].vector[1]);
    CHECK1(p.line.settings.camera.position.values[1] == 7);
    CHECK1(!p.options.shadow && p.options.environment &&
           p.options.environment == p.environment.environment);
    CHECK(burnish_mesh_get_material(p.mesh, 0)->transparency == 0.5F, "opacity");
    CHECK1(p.options.lights[1].cone[0] == 1 && warns(&p, "--shadow") == 1 && p.warnings.count == 1);
    release(&p);
    p = prepare("x|--light=file|--shadow|--strict", BOX(SPOT));
    CHECK1(p.status == BURNISH_STATUS_ARGUMENT);
    release(&p);
}

/* Without lights in the file the look's shine, in whose wide light a preset is metallic. */
static void test_dark_scene(void) {
    prepared p = prepare("x|--light=file|--material=metal", BOX(DARK)), q;
    CHECK_OK(p.status, p.line.error);
    CHECK1(!p.line.settings.shading.lights.given && p.options.area_light_count > 0);
    CHECK1(burnish_mesh_get_material(p.mesh, 0)->metallic == 1);
    q = prepare("x|--light=file|--material=metal", BOX(SPOT));
    CHECK_OK(q.status, q.line.error);
    CHECK1(burnish_mesh_get_material(q.mesh, 0)->metallic == 0);
    release(&p);
    release(&q);
}

/* A screen of a command whose rows are longer than a line: as many words as were given, in lines of at
 * most 100 columns. */
static void test_long_rows(void) {
    static const cli_flag flag = {.group = "Options",
                                  .name = "long",
                                  .help =
                                      "a word a word a word a word a word a word a word a word a "
                                      "word a word a word a word a word a word a word a word a "
                                      "word a word a word a word a word a word a word a word"};
    static const cli_command command = {.name = "long",
                                        .operand = "INPUT",
                                        .summary = "s",
                                        .operand_help =
                                            ".aa .bb .cc .dd .ee .ff .gg .hh .ii .jj .kk .ll .mm "
                                            ".nn .oo .pp .qq .rr .ss .tt .uu .vv .ww .xx .yy .zz",
                                        .flags = &flag,
                                        .flag_count = 1};
    char line[256];
    int words = 0, extensions = 0;
    burnish_error error;
    FILE *screen = tmpfile();
    fflush(stdout);
    const int saved = dup(STDOUT_FILENO);
    if (!CHECK1(screen && saved >= 0 && dup2(fileno(screen), STDOUT_FILENO) == STDOUT_FILENO)) {
        return;
    }
    const burnish_status status = cli_print_help(&command, NULL, &error);
    fflush(stdout);
    dup2(saved, STDOUT_FILENO);
    close(saved);
    CHECK1(status == BURNISH_STATUS_OK);
    rewind(screen);
    while (fgets(line, sizeof line, screen)) {
        CHECK(strlen(line) <= 101, "%zu columns: %s", strlen(line) - 1, line);
        for (const char *at = line; (at = strstr(at, " word")) != NULL; ++at) {
            ++words;
        }
        for (const char *at = line; (at = strstr(at, " .")) != NULL; ++at) {
            ++extensions;
        }
    }
    CHECK(words == 24 && extensions == 26, "%d words, %d extensions", words, extensions);
    fclose(screen);
}

int main(int count, char **arguments) {
    test_begin(count, arguments, NULL);
    RUN(test_defaults());
    RUN(test_forms());
    RUN(test_errors());
    RUN(test_numbers());
    RUN(test_decimal_comma());
    RUN(test_colors());
    RUN(test_lights());
    RUN(test_table());
    RUN(test_long_rows());
    RUN(test_cut_scene());
    RUN(test_lying_scene());
    RUN(test_cloud_stance());
    RUN(test_flat_view());
    RUN(test_slanted_view());
    RUN(test_black_material());
    RUN(test_lit_scene());
    RUN(test_dark_scene());
    return test_end("options");
}
