/* The window of `burnish view`. */
#ifndef TOOL_VIEW_WINDOW_H
#define TOOL_VIEW_WINDOW_H

#include "view/view.h"

/* Opens the window, and returns when it is closed. Errors: as for loading and drawing, before the
 * window opens; READ if no window can be opened; ARGUMENT if this build has no windows. */
burnish_status view_window(const view_settings *settings, burnish_error *error);

#endif
