#include "view/actions.h"

#include <stdio.h>
#include <string.h>

#include "base/cli/values.h"
#include "render/settings/settings.h"

const view_action_row view_actions[] = {
    {"front", VIEW_ACTION_VIEW, VIEW_FRONT, 'f', 0, NULL, NULL},
    {"back", VIEW_ACTION_VIEW, VIEW_BACK, 'b', 0, "F B", "front, back"},
    {"left", VIEW_ACTION_VIEW, VIEW_LEFT, 'l', 0, NULL, NULL},
    {"right", VIEW_ACTION_VIEW, VIEW_RIGHT, 'r', 0, "L R", "left, right"},
    {"top", VIEW_ACTION_VIEW, VIEW_TOP, 't', 0, NULL, NULL},
    {"bottom", VIEW_ACTION_VIEW, VIEW_BOTTOM, 'u', 0, "T U", "top, bottom (from under)"},
    {"iso", VIEW_ACTION_VIEW, VIEW_ISO, 'i', 0, NULL, NULL},
    {"view", VIEW_ACTION_VIEW, VIEW_FREE, VIEW_KEY_HOME, 0, NULL, NULL},
    {"view", VIEW_ACTION_VIEW, VIEW_FREE, '0', 0, "I, Home", "iso, the view at the start"},
    {"turn-left", VIEW_ACTION_TURN, -1, VIEW_KEY_LEFT, 0, NULL, NULL},
    {"turn-right", VIEW_ACTION_TURN, 1, VIEW_KEY_RIGHT, 0, NULL, NULL},
    {"turn-up", VIEW_ACTION_TILT, 1, VIEW_KEY_UP, 0, NULL, NULL},
    {"turn-down", VIEW_ACTION_TILT, -1, VIEW_KEY_DOWN, 0, "arrows", "walk around by 15 degrees"},
    {"zoom-in", VIEW_ACTION_ZOOM, 1, '+', 0, NULL, NULL},
    {"zoom-out", VIEW_ACTION_ZOOM, -1, '-', 0, "+ -", "nearer, farther"},
    {"projection", VIEW_ACTION_PROJECTION, 0, 'o', 0, "O", "perspective or parallel"},
    {"lobe", VIEW_ACTION_LOBE, 1, 'n', 0, NULL, NULL},
    {"lobe-back", VIEW_ACTION_LOBE, -1, 'n', 1, "N", "next lobe (Shift: previous)"},
    {"other-lobe", VIEW_ACTION_OTHER_LOBE, 1, 'm', 0, NULL, NULL},
    {"other-lobe-back", VIEW_ACTION_OTHER_LOBE, -1, 'm', 1, "M", "next lobe on the right"},
    {"exponent-down", VIEW_ACTION_EXPONENT, -1, '[', 0, NULL, NULL},
    {"exponent-down", VIEW_ACTION_EXPONENT, -1, VIEW_KEY_PAGE_DOWN, 0, NULL, NULL},
    {"exponent-up", VIEW_ACTION_EXPONENT, 1, ']', 0, NULL, NULL},
    {"exponent-up", VIEW_ACTION_EXPONENT, 1, VIEW_KEY_PAGE_UP, 0, "[ ]", "exponent down, up"},
    {"split", VIEW_ACTION_SPLIT, 0, 's', 0, "S", "two lobes; drag what divides them"},
    {"errors", VIEW_ACTION_ERRORS, 0, 'e', 0, "E", "how much they differ"},
    {"section-x", VIEW_ACTION_SECTION, 0, 'x', 0, NULL, NULL},
    {"section-y", VIEW_ACTION_SECTION, 1, 'y', 0, NULL, NULL},
    {"section-z", VIEW_ACTION_SECTION, 2, 'z', 0, "X Y Z", "cut; again: other side; again: whole"},
    {"section-back", VIEW_ACTION_MOVE_SECTION, -1, ',', 0, NULL, NULL},
    {"section-on", VIEW_ACTION_MOVE_SECTION, 1, '.', 0, ", .", "move the cut"},
    {"look", VIEW_ACTION_LOOK, 1, 'k', 0, NULL, NULL},
    {"look-back", VIEW_ACTION_LOOK, -1, 'k', 1, "K", "next look"},
    {"wireframe", VIEW_ACTION_WIREFRAME, 0, 'w', 0, "W", "edges of all triangles"},
    {"screenshot", VIEW_ACTION_SCREENSHOT, 0, 'p', 0, "P", "save the picture"},
    {"command", VIEW_ACTION_COMMAND, 0, 'c', 0, "C", "print the command that draws it"},
    {"reload", VIEW_ACTION_RELOAD, 0, VIEW_KEY_F5, 0, "F5", "read the file again"},
    {"fullscreen", VIEW_ACTION_FULLSCREEN, 0, VIEW_KEY_F11, 0, "F11", "full screen"},
    {"text", VIEW_ACTION_TEXT, 0, ' ', 0, "Space", "hide or show the texts"},
    {"help", VIEW_ACTION_HELP, 0, VIEW_KEY_F1, 0, NULL, NULL},
    {"help", VIEW_ACTION_HELP, 0, 'h', 0, NULL, NULL},
    {"help", VIEW_ACTION_HELP, 0, '?', 0, "?", "these keys"},
    {"quit", VIEW_ACTION_QUIT, 0, VIEW_KEY_ESCAPE, 0, NULL, NULL},
    {"quit", VIEW_ACTION_QUIT, 0, 'q', 0, "Q", "end"},
};
const size_t view_action_count = sizeof view_actions / sizeof *view_actions;

const view_action_row *view_find_key(int key, int shift) {
    for (size_t i = 0; i < view_action_count; ++i) {
        if (view_actions[i].key == key && view_actions[i].shift == shift) {
            return &view_actions[i];
        }
    }
    return NULL;
}

const view_action_row *view_next_word(const char **list) {
    const char *word;
    const size_t length = cli_next_item(list, ',', &word);
    for (size_t i = 0; i < view_action_count; ++i) {
        if (strlen(view_actions[i].word) == length &&
            memcmp(view_actions[i].word, word, length) == 0) {
            return &view_actions[i];
        }
    }
    return NULL;
}

void view_each_action(cli_take_term *print) {
    char tag[160] = "";
    for (size_t i = 0; i < view_action_count; ++i) {
        const view_action_row *row = &view_actions[i];
        const char *before = i > 0 ? view_actions[i - 1].word : "";
        if (strcmp(row->word, before) != 0) { /* two keys for one */
            const size_t used = strlen(tag);
            snprintf(tag + used, sizeof tag - used, "%s%s", used > 0 ? ", " : "", row->word);
        }
        if (row->keys) {
            char text[160], marked[170];
            snprintf(text, sizeof text, "%s: %s", row->keys, row->what);
            snprintf(marked, sizeof marked, "*%s*", tag);
            print(marked, text);
            tag[0] = 0;
        }
    }
}
