/* The window's state, which drawing, actions and events share. */
#ifndef TOOL_VIEW_VIEWER_H
#define TOOL_VIEW_VIEWER_H

#include "view/actions.h"
#include "view/paint.h"
#include "view/scene.h"
#include "view/sdl.h"
#include "view/view.h"

/* Milliseconds. */
enum {
    REST = 150,  /* without a movement, until the picture is drawn as it is kept */
    POLL = 300,  /* between looks at the file */
    TOAST = 3500 /* that a message stays */
};
typedef enum drag { DRAG_NONE, DRAG_ORBIT, DRAG_PAN, DRAG_DIVIDER } drag;

/* What tells whether a file has changed. */
typedef struct stamp {
    long long size, seconds, nanoseconds, number;
} stamp;

typedef struct viewer {
    const view_settings *settings;
    view_sdl_calls sdl;
    SDL_Window *window;
    SDL_Cursor *cursors[2]; /* arrow; left and right */
    view_scene scene;
    char *dropped; /* name of the file that was dropped last; NULL: none */
    stamp shown, seen;

    burnish_lobe_spec lobes[2];
    int split, errors;
    double divider; /* share of the width */

    uint32_t *pixels[3]; /* of both lobes, and of their difference */
    int is_in_window;    /* 1: what was drawn last is in the window alone, as moving pictures are */
    int width, height;
    view_difference difference;
    int scale; /* of the map */

    view_quality moving; /* how pictures are drawn while things move */
    int slow_frames;     /* in a row */
    int is_dirty;        /* 1: the picture has to be drawn */
    int is_still;        /* 1: what is shown is as it is kept */
    int repaint;         /* 1: what lies over it has changed */
    double moved;        /* when, ms */
    double frame_ms, still_ms;
    drag drag;
    int hide_text, help, fullscreen, quit;
    char toast[640];
    double toast_end;
    const char *actions; /* that are left to do */
} viewer;

double viewer_now(void); /* milliseconds */

/* Shows a message for a while, in lines that the window has room for. */
void viewer_say(viewer *v, const char *text);

/* The picture changes. at_once: not by a movement that goes on. */
void viewer_touch(viewer *v, int at_once);

/* ---- show.c ---- */

/* Draws one lobe or both, and their difference where it is shown. Errors: those of drawing. */
burnish_status viewer_draw(viewer *v, view_quality quality, burnish_error *error);

/* What is to be shown, without what lies over it. */
void viewer_compose(const viewer *v, const burnish_pixels *to);

/* Puts it and what lies over it into the window. */
void viewer_present(viewer *v);

void viewer_set_title(viewer *v);

/* The name without its folders. */
const char *viewer_base_name(const char *path);

/* ---- act.c ---- */

/* Does what a key does. */
void viewer_act(viewer *v, const view_action_row *row);

/* Reads a file that has changed, and changes no more. */
void viewer_look_at_file(viewer *v);
void viewer_mark_file(viewer *v);

/* Shows another file; takes the name over, which SDL_free releases. */
void viewer_open(viewer *v, char *name);

#endif
