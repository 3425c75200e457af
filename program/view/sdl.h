/* SDL2, loaded when a window is wanted: linked, it and what it needs (X11, Wayland, sound) would be
 * a dependency of every run of the program. */
#ifndef TOOL_VIEW_SDL_H
#define TOOL_VIEW_SDL_H

#include <SDL.h>

#include "burnish/core.h"

/* What window.c calls. */
#define VIEW_SDL_CALLS(X)                                                                          \
    X(SDL_CreateSystemCursor)                                                                      \
    X(SDL_CreateWindow)                                                                            \
    X(SDL_GetCurrentVideoDriver)                                                                   \
    X(SDL_GetError)                                                                                \
    X(SDL_GetWindowSurface)                                                                        \
    X(SDL_Init)                                                                                    \
    X(SDL_PeepEvents)                                                                              \
    X(SDL_PollEvent)                                                                               \
    X(SDL_PumpEvents)                                                                              \
    X(SDL_SetCursor)                                                                               \
    X(SDL_SetHint)                                                                                 \
    X(SDL_SetWindowFullscreen)                                                                     \
    X(SDL_SetWindowMinimumSize)                                                                    \
    X(SDL_SetWindowTitle)                                                                          \
    X(SDL_UpdateWindowSurface)                                                                     \
    X(SDL_WaitEventTimeout)                                                                        \
    X(SDL_free)

typedef struct view_sdl_calls {
#define VIEW_SDL_POINTER(name) __typeof__(name) *name;
    VIEW_SDL_CALLS(VIEW_SDL_POINTER)
#undef VIEW_SDL_POINTER
} view_sdl_calls;

/* Errors: READ where SDL2 is not there, or lacks a function. */
burnish_status view_load_sdl(view_sdl_calls *calls, burnish_error *error);

#endif
