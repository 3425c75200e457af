/* Performs actions, and follows the file. */
#ifndef TOOL_VIEW_ACT_H
#define TOOL_VIEW_ACT_H

#include "view/show.h"

/* Performs an action. */
void viewer_act(viewer *v, const view_action_row *row);

/* Reloads a changed file when it stops changing. */
void viewer_look_at_file(viewer *v);
void viewer_mark_file(viewer *v);

/* Shows another file; takes ownership of the name, which SDL_free releases. */
void viewer_open(viewer *v, char *name);

#endif
