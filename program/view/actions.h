/* The table of actions, for keys, the help, --do and the manual. */
#ifndef TOOL_VIEW_ACTIONS_H
#define TOOL_VIEW_ACTIONS_H

#include "base/cli/options.h"

typedef enum view_action {
    VIEW_ACTION_NONE,
    VIEW_ACTION_VIEW, /* and the standard views: value is a render_view */
    VIEW_ACTION_TURN,
    VIEW_ACTION_TILT,
    VIEW_ACTION_ZOOM,
    VIEW_ACTION_PROJECTION,
    VIEW_ACTION_LOBE,
    VIEW_ACTION_OTHER_LOBE,
    VIEW_ACTION_EXPONENT,
    VIEW_ACTION_SPLIT,
    VIEW_ACTION_ERRORS,
    VIEW_ACTION_SECTION,
    VIEW_ACTION_MOVE_SECTION,
    VIEW_ACTION_LOOK,
    VIEW_ACTION_WIREFRAME,
    VIEW_ACTION_SCREENSHOT,
    VIEW_ACTION_COMMAND,
    VIEW_ACTION_RELOAD,
    VIEW_ACTION_FULLSCREEN,
    VIEW_ACTION_TEXT,
    VIEW_ACTION_HELP,
    VIEW_ACTION_QUIT
} view_action;

/* Keys without a character. */
enum {
    VIEW_KEY_LEFT = 256,
    VIEW_KEY_RIGHT,
    VIEW_KEY_UP,
    VIEW_KEY_DOWN,
    VIEW_KEY_HOME,
    VIEW_KEY_PAGE_UP,
    VIEW_KEY_PAGE_DOWN,
    VIEW_KEY_ESCAPE,
    VIEW_KEY_F1,
    VIEW_KEY_F5 = VIEW_KEY_F1 + 4,
    VIEW_KEY_F11 = VIEW_KEY_F1 + 10
};

/* Rows with NULL `keys` share a line of help with the next row. */
typedef struct view_action_row {
    const char *word; /* of --do */
    view_action action;
    int value;        /* a render_view, a direction (1, -1), an axis */
    int key, shift;   /* a lower-case character or VIEW_KEY_; shift: 1 with, 0 without */
    const char *keys; /* for the help; NULL: in the next row's */
    const char *what;
} view_action_row;

extern const view_action_row view_actions[];
extern const size_t view_action_count;

/* The action of a key, or NULL. */
const view_action_row *view_find_key(int key, int shift);

/* The action of the first word of a list with commas; moves *list past it. NULL for an unknown
 * word. */
const view_action_row *view_next_word(const char **list);

/* For the manual. */
void view_each_action(cli_take_term *print);

#endif
