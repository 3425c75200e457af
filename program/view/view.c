/* `burnish view`: flags and the manual. */
#include "view/view.h"
#include "render/check.h"

#include <string.h>

#include "cli/commands.h"
#include "cli/run.h"
#include "view/actions.h"

static cli_work work;
static cli_handler read_actions;

#define TARGET(member) .offset = offsetof(view_settings, member)

static const cli_flag flags[] = {
    {.group = "Window",
     .topic = "window",
     CLI_FLAG("resolution", "W,H", "width and height of the window, in pixels", cli_flag_size,
              render.picture.size),
     CLI_RANGE(64, BURNISH_IMAGE_MAX_SIZE),
     .default_text = "1280,800",
     .common = 1,
     .aliases = "width,height,res",
     .manual = "Width and height of the window at the start, in pixels."},
    {CLI_FLAG("output", "FILE", "where P saves the picture", cli_flag_text, output),
     .default_label = "INPUT's name and a number", .letter = 'o', .common = 1, .takes_file = 1,
     .aliases = "out,screenshot",
     .manual = "Where the key P saves the picture, as PNG; the file is replaced each time. Without "
               "this flag it is _INPUT_'s name and the first free number, *part-1.png*, in the "
               "current folder."},
    {CLI_FLAG("do", "ACTIONS", "what keys do, by their words: split,errors", read_actions, actions),
     .common = 1,
     .manual =
         "Does what keys do, one after another, each when the picture before is complete: words "
         "between commas, see *KEYS*. *--do=front,screenshot,quit* needs nobody at the keys."},
    {CLI_FLAG("frames", "N", "turn once in N frames, print how long they took, end",
              cli_flag_integer, frames),
     CLI_RANGE(1, 100000),
     .manual = "Turns the object once in _N_ frames, as dragging does, prints how long they took, "
               "and ends."},
};

static const cli_example examples[] = {
    {"burnish view part.stl", "turn it with the mouse; ? shows the keys"},
    {"burnish view part.stl --lobe=power,energy:2", "two lobes side by side"},
    {NULL, NULL},
};

static const cli_section sections[] = {
    {.heading = "KEYS",
     .text = "The mouse: dragging walks around the object, dragging with the right or middle "
             "button or with Shift moves it, the wheel goes nearer and farther at the pointer, a "
             "file that is dropped is shown. Words of *--do*, and keys:",
     .each_term = view_each_action},
    {.heading = NULL},
};

const cli_command view_command = {
    .name = "view",
    .operand = "INPUT",
    .summary = "turn a mesh in a window",
    .operand_help = &BURNISH_FORMAT_LIST(CLI_INPUT_ENDING) "; :teapot :sphere :torus :knot"[1],
    .manual =
        "Shows _INPUT_, a file or a built-in object, in a window, by the renderer of *burnish "
        "render*, on the processor. While something moves, a picture is drawn as fast as the "
        "window needs it; once it rests, as *burnish render* draws it: the key P saves the same "
        "file that *burnish render* writes, and C prints the command that does. The file is read "
        "again when it changes.\n"
        "Besides the flags below, those of *burnish render* that say where the camera stands, how "
        "the surface and its light look and how _INPUT_ is read have the same meaning here. Of two "
        "lobes, *--lobe=*_A_*,*_B_, the second is shown on the right. Windows need SDL2.",
    .operands_max = 1,
    .flags = flags,
    .flag_count = sizeof flags / sizeof *flags,
    .base = &render_command,
    .base_topics = "camera,light",
    .base_flags = "samples,background-color,cull-back-faces,views,input-format,clip,crease-angle,"
                  "tessellation,animation-time,animation,point-size,strict,no-textures,"
                  "no-libraries,max-triangles,max-texture-pixels,max-input-bytes,max-overdraw,"
                  "threads,isa",
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
                        "view: standard input can't be read again, as cuts and changes need; name "
                        "a file");
    }
    if (settings->render.picture.views.count > 1 || settings->render.shading.lobes.count > 2) {
        return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                        settings->render.picture.views.count > 1
                            ? "--views: the window begins with one view; give one"
                            : "--lobe: the window shows one lobe or two; give at most two");
    }
    const burnish_status status = render_check(&settings->render, error);
    cli_prepare_memory();
    return status == BURNISH_STATUS_OK ? view_window(settings, error) : status;
}
