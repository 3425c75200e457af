/* Values of the flags that only `burnish render` has. */
#include <stdio.h>
#include <string.h>

#include "render/settings/flag_values.h"

/* Chosen by eye on the teapot, in the looks three-point and studio. */
const render_preset render_presets[] = {
    {"matte", "chalk, plaster: almost no highlight", 0.02F, 6.0F, 1.0F, 0.0F, 0.0F, 0.9F, 0.03F},
    {"satin", "painted wood, rubber: a broad soft sheen", 0.18F, 16.0F, 1.0F, 0.0F, 0.0F, 0.5F,
     0.04F},
    {"plastic", "moulded plastic: a clear highlight", 0.40F, 48.0F, 1.0F, 0.0F, 0.0F, 0.3F, 0.05F},
    {"polished", "glazed ceramic, lacquer: small and bright", 0.70F, 220.0F, 1.0F, 0.0F, 0.0F, 0.1F,
     0.06F},
    {"metal", "the highlight has the surface's colour", 0.95F, 36.0F, 0.45F, 1.0F, 1.0F, 0.25F,
     0.04F},
    {"glass", "clear glass, or with *--color* coloured glass", 1.0F, 65536.0F, 1.0F, 0.0F, 0.0F,
     0.05F, 0.04F},
};

const cli_word render_preset_words[] = {
    {"matte", 1},    {"satin", 2}, {"plastic", 3},
    {"polished", 4}, {"metal", 5}, {"glass", RENDER_GLASS},
    {NULL, 0},
};

const cli_word render_plane_words[] = {
    {"depth", PLANE_DEPTH},
    {"normal", PLANE_NORMAL},
    {"triangle", PLANE_TRIANGLE},
    {"material", PLANE_MATERIAL},
    {"coverage", PLANE_COVERAGE},
    {"color", PLANE_COLOR},
    {NULL, 0},
};

const cli_word render_tone_words[] = {{"none", 1 + BURNISH_TONES_NONE},
                                      {"neutral", 1 + BURNISH_TONES_NEUTRAL},
                                      {"soft", 1 + BURNISH_TONES_SOFT},
                                      {"filmic", 1 + BURNISH_TONES_FILMIC},
                                      {NULL, 0}};

const cli_word render_look_words[] = {
    {"studio", BURNISH_LOOK_STUDIO},       {"three-point", BURNISH_LOOK_THREE_POINT},
    {"plain", BURNISH_LOOK_PLAIN},         {"clay", BURNISH_LOOK_CLAY},
    {"technical", BURNISH_LOOK_TECHNICAL}, {"drawing", BURNISH_LOOK_DRAWING},
    {"lobes", BURNISH_LOOK_LOBES},         {NULL, 0}};

burnish_status render_flag_background(const cli_flag *flag, const char *text, void *target,
                                      burnish_error *error) {
    render_background *background = target;
    cli_color color;
    if (strcmp(text, "none") == 0) {
        return render_flag_no_background(flag, text, target, error);
    }
    if (strcmp(text, "environment") == 0) {
        *background = (render_background){.environment = 1};
        return BURNISH_STATUS_OK;
    }
    burnish_status status = cli_flag_color(flag, text, &color, error);
    if (status == BURNISH_STATUS_OK) {
        *background = (render_background){.given = 1};
        memcpy(background->srgb, color.srgb, sizeof color.srgb);
    }
    return status;
}

burnish_status render_flag_no_background(const cli_flag *flag, const char *text, void *target,
                                         burnish_error *error) {
    render_background *background = target;
    (void)flag, (void)text, (void)error;
    *background = (render_background){.transparent = 1};
    return BURNISH_STATUS_OK;
}

burnish_status render_flag_never(const cli_flag *flag, const char *text, void *target,
                                 burnish_error *error) {
    (void)flag, (void)text, (void)error;
    *(int *)target = -1;
    return BURNISH_STATUS_OK;
}

/* Copies the next item of a list. An item that is too long is cut, and no parser accepts it. */
static void copy_item(const char **text, char *copy, size_t size) {
    const char *item;
    size_t length = cli_next_item(text, ',', &item);
    snprintf(copy, size, "%.*s", (int)(length < size ? length : size - 1), item);
}

static burnish_status fail_list(const cli_flag *flag, burnish_error *error) {
    return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: more than %d items; omit some",
                    flag->name, RENDER_LIST_MAX);
}

burnish_status render_flag_rows(const cli_flag *flag, const char *text, void *target,
                                burnish_error *error) {
    render_rows *rows = target;
    const char *first, *rest = text;
    const size_t length = cli_next_item(&rest, ':', &first);
    cli_flag from = *flag, count = *flag;
    render_rows read;
    char number[16];
    burnish_error ignored;
    from.low = 0;
    from.high = BURNISH_IMAGE_MAX_SIZE - 1;
    count.low = 1;
    count.high = BURNISH_IMAGE_MAX_SIZE;
    snprintf(number, sizeof number, "%.*s", (int)(length < 15 ? length : 15), first);
    if (!rest || cli_flag_integer(&from, number, &read.first, &ignored) != BURNISH_STATUS_OK ||
        cli_flag_integer(&count, rest, &read.count, &ignored) != BURNISH_STATUS_OK) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.60s\" is not a first row, counted from 0, and a number of rows, "
                        "such as 0:64",
                        flag->name, text);
    }
    *rows = read;
    return BURNISH_STATUS_OK;
}

burnish_status render_flag_views(const cli_flag *flag, const char *text, void *target,
                                 burnish_error *error) {
    static const render_views third_angle = {
        {VIEW_FRONT, VIEW_TOP, VIEW_RIGHT, VIEW_ISO}, 4, VIEW_THIRD_ANGLE};
    static const render_views first_angle = {
        {VIEW_FRONT, VIEW_TOP, VIEW_LEFT, VIEW_ISO}, 4, VIEW_FIRST_ANGLE};
    static const render_views all = {
        {VIEW_FRONT, VIEW_RIGHT, VIEW_TOP, VIEW_ISO, VIEW_BACK, VIEW_LEFT, VIEW_BOTTOM},
        7,
        VIEW_FREE};
    render_views *views = target;
    render_views read = {.count = 0};
    while (text) {
        char item[CLI_NAME_MAX];
        int view = VIEW_FREE;
        copy_item(&text, item, sizeof item);
        burnish_status status = cli_flag_word(flag, item, &view, error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
        if (view >= VIEW_ALL) {
            if (read.count > 0 || text) {
                return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                                "--%s: %s is a whole sheet; omit the other views", flag->name,
                                item);
            }
            read = view == VIEW_ALL ? all : view == VIEW_FIRST_ANGLE ? first_angle : third_angle;
            break;
        }
        if (read.count == RENDER_LIST_MAX) {
            return fail_list(flag, error);
        }
        read.items[read.count++] = (render_view)view;
    }
    *views = read;
    return BURNISH_STATUS_OK;
}

burnish_status render_flag_lobes(const cli_flag *flag, const char *text, void *target,
                                 burnish_error *error) {
    render_lobes *lobes = target;
    render_lobes read = {.count = 0};
    while (text) {
        char item[CLI_NAME_MAX];
        burnish_error reason;
        copy_item(&text, item, sizeof item);
        if (read.count == RENDER_LIST_MAX) {
            return fail_list(flag, error);
        }
        burnish_status status = burnish_lobe_spec_parse(item, &read.items[read.count++], &reason);
        if (status != BURNISH_STATUS_OK) {
            return cli_fail(error, status, "--%s: %.400s", flag->name, reason.text);
        }
    }
    *lobes = read;
    return BURNISH_STATUS_OK;
}

burnish_status render_flag_plane(const cli_flag *flag, const char *text, void *target,
                                 burnish_error *error) {
    render_planes *planes = target;
    const char *colon = strchr(text, ':');
    char name[CLI_NAME_MAX];
    int kind = 0;
    cli_flag named = *flag;
    named.words = render_plane_words; /* not in the table, because the help row would be too long */
    snprintf(name, sizeof name, "%.*s", (int)strcspn(text, ":"), text);
    burnish_status status = cli_flag_word(&named, name, &kind, error);
    if (status == BURNISH_STATUS_OK && (!colon || !colon[1])) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.60s\" has no file name; write %s:FILE", flag->name, text, name);
    }
    if (status == BURNISH_STATUS_OK && planes->count == RENDER_PLANES_MAX) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: more than %d of them; omit some",
                        flag->name, RENDER_PLANES_MAX);
    }
    if (status == BURNISH_STATUS_OK) {
        planes->items[planes->count++] =
            (render_plane){(render_plane_kind)kind, colon + 1, PICTURE_AUTO};
    }
    return status;
}

burnish_status render_flag_clip(const cli_flag *flag, const char *text, void *target,
                                burnish_error *error) {
    render_clip *clip = target;
    double values[4];
    if (!cli_read_reals(text, strlen(text), values, 4)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.60s\" is not four numbers X,Y,Z,D, such as 0,0,1,5", flag->name,
                        text);
    }
    if (values[0] == 0 && values[1] == 0 && values[2] == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.60s\": 0,0,0 has no direction; expected for example 0,0,1,5",
                        flag->name, text);
    }
    if (clip->count == BURNISH_CUTS_MAX) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT, "--%s: more than %d planes; omit some",
                        flag->name, BURNISH_CUTS_MAX);
    }
    burnish_clip_plane *plane = &clip->items[clip->count++];
    memcpy(plane->normal, values, sizeof plane->normal);
    plane->offset = values[3];
    return BURNISH_STATUS_OK;
}

burnish_status render_flag_section(const cli_flag *flag, const char *text, void *target,
                                   burnish_error *error) {
    static const char axes[] = "xyzXYZ";
    const char *axis = text + (*text == '-' || *text == '+');
    const char *found = *axis ? strchr(axes, *axis) : NULL;
    render_section section = {.sign = *text == '-' ? -1 : *text == '+'};
    section.offset.given = found && axis[1] == ':';
    if (!found ||
        (section.offset.given ? !cli_read_real(axis + 2, strlen(axis + 2), &section.offset.value)
                              : axis[1] != 0)) {
        return cli_fail(
            error, BURNISH_STATUS_ARGUMENT,
            "--%s: \"%.60s\" is not an axis, such as x or -y, or an axis and an offset, "
            "such as z:5",
            flag->name, text);
    }
    section.axis = 1 + (int)(found - axes) % 3;
    *(render_section *)target = section;
    return BURNISH_STATUS_OK;
}

burnish_status render_flag_occlusion(const cli_flag *flag, const char *text, void *target,
                                     burnish_error *error) {
    render_occlusion *occlusion = target;
    int directions = 0;
    if (strcmp(text, "none") != 0) {
        burnish_status status = cli_flag_integer(flag, text, &directions, error);
        if (status != BURNISH_STATUS_OK) {
            return status;
        }
    }
    *occlusion = (render_occlusion){1, directions};
    return BURNISH_STATUS_OK;
}

/* The sum of the values of some of the flag's words. */
static burnish_status read_sum(const cli_flag *flag, const char *text, int *sum,
                               burnish_error *error) {
    burnish_status status = BURNISH_STATUS_OK;
    for (*sum = 0; text && status == BURNISH_STATUS_OK;) {
        char item[CLI_NAME_MAX];
        int value = 0;
        copy_item(&text, item, sizeof item);
        status = cli_flag_word(flag, item, &value, error);
        *sum |= value;
    }
    return status;
}

burnish_status render_flag_edges(const cli_flag *flag, const char *text, void *target,
                                 burnish_error *error) {
    render_edges *edges = target;
    int kinds = BURNISH_EDGES_FEATURES;
    const burnish_status status = text ? read_sum(flag, text, &kinds, error) : BURNISH_STATUS_OK;
    if (status == BURNISH_STATUS_OK) {
        *edges = (render_edges){1, kinds};
    }
    return status;
}

burnish_status render_flag_projection(const cli_flag *flag, const char *text, void *target,
                                      burnish_error *error) {
    static const cli_word words[] = {{"yes", PROJECTION_PARALLEL},
                                     {"no", PROJECTION_PERSPECTIVE},
                                     {"1", PROJECTION_PARALLEL},
                                     {"0", PROJECTION_PERSPECTIVE},
                                     {NULL, 0}};
    cli_flag named = *flag;
    named.words = words;
    return cli_flag_word(&named, text ? text : "yes", target, error);
}

burnish_status render_flag_tones(const cli_flag *flag, const char *text, void *target,
                                 burnish_error *error) {
    return cli_flag_word(flag, text ? text : "neutral", target, error);
}

burnish_status render_flag_range(const cli_flag *flag, const char *text, void *target,
                                 burnish_error *error) {
    const char *colon = strpbrk(text, ":,");
    double range[2] = {0, 0};
    if (!colon || !cli_read_reals(text, (size_t)(colon - text), range, 1) ||
        !cli_read_reals(colon + 1, strlen(colon + 1), range + 1, 1) || range[0] == range[1] ||
        !(range[0] >= -1e30 && range[0] <= 1e30 && range[1] >= -1e30 && range[1] <= 1e30)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.60s\" is not two different numbers, such as 0:25", flag->name,
                        text);
    }
    memcpy(target, range, sizeof range);
    return BURNISH_STATUS_OK;
}

burnish_status render_flag_intrinsics(const cli_flag *flag, const char *text, void *target,
                                      burnish_error *error) {
    render_intrinsics *intrinsics = target;
    double *k = intrinsics->values;
    if (!cli_read_reals(text, strlen(text), k, 4) || !(k[0] > 0 && k[1] > 0)) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "--%s: \"%.60s\" is not four numbers of which the first two are above 0, "
                        "such as 900,900,319.5,239.5",
                        flag->name, text);
    }
    intrinsics->given = 1;
    return BURNISH_STATUS_OK;
}

burnish_status render_flag_annotate(const cli_flag *flag, const char *text, void *target,
                                    burnish_error *error) {
    int kinds;
    const burnish_status status = read_sum(flag, text, &kinds, error);
    if (status == BURNISH_STATUS_OK) {
        *(unsigned *)target = (unsigned)kinds;
    }
    return status;
}

burnish_status render_flag_no_sandbox(const cli_flag *flag, const char *text, void *target,
                                      burnish_error *error) {
    (void)flag, (void)text, (void)error;
    *(int *)target = 0;
    return BURNISH_STATUS_OK;
}
