/* SDL2 is loaded when a window is opened. If it were linked, every run of the program would depend
 * on it and on its libraries (X11, Wayland, sound). */
#ifndef TOOL_VIEW_SDL_H
#define TOOL_VIEW_SDL_H

#include <SDL.h>

#include "burnish/core.h"

/* The functions that are used. */
/* clang-format off */
#define VIEW_SDL_CALLS(X) \
    X(SDL_CreateSystemCursor) X(SDL_CreateWindow) X(SDL_GetCurrentVideoDriver) X(SDL_GetError) \
    X(SDL_GetWindowSurface) X(SDL_Init) X(SDL_PeepEvents) X(SDL_PollEvent) X(SDL_PumpEvents) \
    X(SDL_SetCursor) X(SDL_SetHint) X(SDL_SetWindowFullscreen) X(SDL_SetWindowMinimumSize) \
    X(SDL_SetWindowTitle) X(SDL_UpdateWindowSurface) X(SDL_WaitEventTimeout) X(SDL_free)
/* clang-format on */

typedef struct view_sdl_calls {
#define VIEW_SDL_POINTER(name) __typeof__(name) *name;
    VIEW_SDL_CALLS(VIEW_SDL_POINTER)
#undef VIEW_SDL_POINTER
} view_sdl_calls;

/* Errors: READ if SDL2 or one of its functions is missing. */
burnish_status view_load_sdl(view_sdl_calls *calls, burnish_error *error);

#endif
