/* `burnish view`: flags and the manual. */
#include "view/view.h"
#include "render/flags.h"
#include "render/render.h"

#include <string.h>

#include "cli/limits.h"
#include "cli/main.h"
#include "picture/formats.h"
#include "view/actions.h"

static cli_work work;
static cli_handler read_actions;

#define TARGET(member) .offset = offsetof(view_settings, member)

static const cli_flag flags[] = {
    {.group = "Window",
     .topic = "window",
     CLI_FLAG("size", "WxH", "width and height of the window in pixels", cli_flag_size,
              render.picture.size),
     CLI_RANGE(64, BURNISH_IMAGE_MAX_SIZE),
     .default_text = "1280,800",
     .common = 1,
     .letter = 's',
     .also = "resolution",
     .aliases = "width,height,res",
     .manual = "Width and height of the window at the start, in pixels."},
    {CLI_FLAG("output", "FILE", "file of the key P (screenshot)", cli_flag_text, output),
     .default_label = "INPUT's name and a number", .letter = 'o', .common = 1, .file = CLI_WRITES,
     .aliases = "out,screenshot",
     .manual =
         "File in which the key P saves the picture, as PNG; it is replaced each time. The default "
         "is _INPUT_'s name with the first unused number, *part-1.png*, in the current folder."},
    {CLI_FLAG("do", "ACTIONS", "actions to perform, such as split,errors", read_actions, actions),
     .common = 1,
     .manual = "Performs actions, a list with commas, one after another, each when the previous "
               "picture is complete; see *KEYS*. For example *--do=front,screenshot,quit*."},
    {CLI_FLAG("frames", "N", "benchmark: one turn in N frames", cli_flag_integer, frames),
     CLI_RANGE(1, 100000),
     .manual =
         "Turns the object once in _N_ frames, as dragging does, prints the times, and ends."},
};

static const cli_example examples[] = {
    {"burnish view part.stl", "turn it with the mouse; ? shows the keys"},
    {"burnish view part.stl --lobe=power,energy:2", "two lobes side by side"},
    {NULL, NULL},
};

static const cli_section sections[] = {
    {.heading = "KEYS",
     .text = "Mouse: drag to rotate the camera around the object; drag with the right or middle "
             "button or with Shift to move it; use the wheel to zoom at the pointer; drop a file "
             "to show it. Actions of *--do*, and keys:",
     .each_term = view_each_action},
    {.heading = NULL},
};

const cli_command view_command = {
    .name = "view",
    .operand = "INPUT",
    .summary = "show a mesh in a window",
    .operand_help = &BURNISH_FORMAT_LIST(CLI_INPUT_EXTENSION) "; :teapot :sphere :torus :knot"[1],
    .manual = "Shows _INPUT_, a file or a built-in object, in a window, with the renderer of "
              "*burnish render* on the CPU. While something moves, the quality depends on the "
              "available time; then the picture is the same as that of *burnish render*: the key P "
              "saves the same file, and C prints the command for it. The file is reloaded when it "
              "changes.\nIn addition to the flags below, the flags of *burnish render* for the "
              "camera, the surface, lights and the input have the same meaning here. With two "
              "lobes, *--lobe=*_A_*,*_B_, the second one is on the right. Windows need SDL2.",
    .operands_max = 1,
    .flags = flags,
    .flag_count = sizeof flags / sizeof *flags,
    .base = &render_command,
    .base_phases = CLI_PHASE_LOAD | CLI_PHASE_DRAW,
    .heir = HEIR_VIEW,
    .examples = examples,
    .sections = sections,
    .settings_size = sizeof(view_settings),
    .work = work,
};

static const char *word_at(const void *list, size_t index) {
    (void)list;
    return index < view_action_count ? view_actions[index].word : NULL;
}

static burnish_status read_actions(const cli_flag *flag, const char *text, void *target,
                                   burnish_error *error) {
    for (const char *rest = text; rest;) {
        const char *at = rest;
        char word[CLI_NAME_MAX];
        if (!view_next_word(&rest)) {
            const size_t length = strcspn(at, ",");
            const size_t kept = length < sizeof word ? length : sizeof word - 1;
            memcpy(word, at, kept);
            word[kept] = 0;
            (void)flag;
            return cli_fail_unknown(error, "--do", "action", word, word_at, NULL,
                                    "burnish help --man");
        }
    }
    *(const char **)target = text;
    return BURNISH_STATUS_OK;
}

static burnish_status work(void *from, cli_call *call, burnish_error *error) {
    view_settings *settings = from;
    if (call->operand_count == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "view: no INPUT; try \"burnish view :teapot\" or \"burnish view --help\"");
    }
    settings->render.input.name = call->operands[0];
    if (strcmp(call->operands[0], "-") == 0) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        "view: standard input can't be reloaded for cuts and changes; name a file");
    }
    if (settings->render.picture.views.count > 1 || settings->render.shading.lobes.count > 2) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        settings->render.picture.views.count > 1
                            ? "--views: the window starts with one view; use only one"
                            : "--lobe: the window shows at most two lobes; omit some");
    }
    picture_format format = PICTURE_PNG;
    burnish_status status = render_check(&settings->render, error);
    if (status == BURNISH_STATUS_OK && settings->output) {
        status =
            picture_choose("output", settings->output, PICTURE_8_BIT, PICTURE_AUTO, &format, error);
    }
    if (status == BURNISH_STATUS_OK && format != PICTURE_PNG) {
        status = cli_fail(error, BURNISH_STATUS_ARGUMENT,
                          "--output: \"%.200s\": screenshots are PNG; end the name in .png",
                          settings->output);
    }
    cli_prepare_memory();
    return status == BURNISH_STATUS_OK ? view_window(settings, error) : status;
}
