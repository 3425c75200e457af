/* The state of the window, shared by drawing, actions and events. */
#ifndef TOOL_VIEW_SHOW_H
#define TOOL_VIEW_SHOW_H

#include "view/actions.h"
#include "view/paint.h"
#include "view/scene.h"
#include "view/sdl.h"
#include "view/view.h"

/* Milliseconds. */
enum {
    REST = 150,  /* from the last movement to the still picture */
    POLL = 300,  /* between checks of the file */
    TOAST = 3500 /* duration of a message */
};
typedef enum drag { DRAG_NONE, DRAG_ORBIT, DRAG_PAN, DRAG_DIVIDER } drag;

/* Identifies a version of a file. */
typedef struct stamp {
    long long size, seconds, nanoseconds, number;
} stamp;

typedef struct viewer {
    const view_settings *settings;
    view_sdl_calls sdl;
    SDL_Window *window;
    SDL_Cursor *cursors[2]; /* arrow; left and right */
    view_scene scene;
    char *dropped;           /* name of the last dropped file; NULL: none */
    stamp shown[2], seen[2]; /* of the input and of the environment */

    burnish_lobe_spec lobes[2];
    int split, errors;
    double divider; /* share of the width */

    uint32_t *pixels[3]; /* of both lobes, and of their difference */
    int is_in_window;    /* 1: the last picture is only in the window, as moving pictures are */
    int width, height;
    view_difference difference;
    int scale; /* of the map */

    view_quality moving; /* of moving pictures */
    int slow_frames;     /* in a row */
    int is_dirty;        /* 1: the picture must be drawn */
    int is_still;        /* 1: the window shows a still picture */
    int repaint;         /* 1: overlays have changed */
    double moved;        /* when, ms */
    double frame_ms, still_ms;
    drag drag;
    int hide_text, help, fullscreen, quit;
    char toast[640];
    double toast_end;
    const char *actions; /* that are left to do */
} viewer;

double viewer_now(void); /* milliseconds */

/* Shows a message for a while, wrapped to the window. */
void viewer_show_message(viewer *v, const char *text);

/* The picture changes. at_once: not by a continuing movement. */
void viewer_touch(viewer *v, int at_once);

/* Draws one or both lobes, and their difference if it is shown. Errors: as for drawing. */
burnish_status viewer_draw(viewer *v, view_quality quality, burnish_error *error);

/* The picture without overlays. */
void viewer_compose(const viewer *v, const burnish_pixels *to);

/* Shows the picture and the overlays in the window. */
void viewer_present(viewer *v);

void viewer_set_title(viewer *v);

/* ---- Actions (act.c) ---- */

/* Performs an action. */
void viewer_act(viewer *v, const view_action_row *row);

/* Reloads a changed file when it stops changing. */
void viewer_look_at_file(viewer *v);
void viewer_mark_file(viewer *v);

/* Shows another file; takes ownership of the name, which SDL_free releases. */
void viewer_open(viewer *v, char *name);

#endif
