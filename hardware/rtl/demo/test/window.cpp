/* window.cpp: the simulated demonstration on the screen.
 *
 * Usage: window [PICTURES]    after so many it ends; without, with its window or with Escape
 *
 * Keys 1, 2 and 3 are the board's buttons, space holds the light.
 *
 * SPDX-License-Identifier: MIT
 * Copyright (c) the burnish authors
 */
#include <SDL.h>
#include <cstdlib>
#include <vector>

#include "Vdemo_simulated.h"
#include "verilated.h"

namespace {

const int width = 640, height = 480;

/* From one vertical synchronisation to the next. */
void draw(Vdemo_simulated &top, unsigned buttons, std::vector<uint32_t> &pixels) {
    size_t count = 0;
    bool before = true;
    top.buttons = (uint8_t)buttons;
    for (;;) {
        top.clk = 0;
        top.eval();
        top.clk = 1;
        top.eval();
        if (top.visible && count < pixels.size()) {
            pixels[count++] = (uint32_t)top.red << 16 | (uint32_t)top.green << 8 | top.blue;
        }
        if (before && !top.vsync) {
            return;
        }
        before = top.vsync;
    }
}

} // namespace

int main(int argc, char **argv) {
    int pictures = argc > 1 ? atoi(argv[1]) : -1;
    SDL_Window *window = nullptr;
    SDL_Renderer *renderer = nullptr;
    if (SDL_Init(SDL_INIT_VIDEO) != 0 ||
        SDL_CreateWindowAndRenderer(width, height, SDL_WINDOW_RESIZABLE, &window, &renderer) != 0) {
        fprintf(stderr, "window: %s\n", SDL_GetError());
        return 2;
    }
    SDL_SetWindowTitle(window, "burnish on a board: 1, 2 lobes, 3 exponent, space holds the light");
    SDL_RenderSetLogicalSize(renderer, width, height);
    SDL_Texture *texture = SDL_CreateTexture(renderer, SDL_PIXELFORMAT_XRGB8888,
                                             SDL_TEXTUREACCESS_STREAMING, width, height);
    std::vector<uint32_t> pixels(width * height);
    Vdemo_simulated top;
    for (bool open = true; open && pictures != 0; --pictures) {
        const Uint8 *keys = SDL_GetKeyboardState(nullptr);
        const unsigned buttons = keys[SDL_SCANCODE_1] | keys[SDL_SCANCODE_2] << 1 |
                                 keys[SDL_SCANCODE_3] << 2 | keys[SDL_SCANCODE_SPACE] << 3;
        draw(top, buttons, pixels);
        SDL_UpdateTexture(texture, nullptr, pixels.data(), width * 4);
        SDL_RenderClear(renderer);
        SDL_RenderCopy(renderer, texture, nullptr, nullptr);
        SDL_RenderPresent(renderer);
        for (SDL_Event event; SDL_PollEvent(&event);) {
            open = open && event.type != SDL_QUIT &&
                   !(event.type == SDL_KEYDOWN && event.key.keysym.sym == SDLK_ESCAPE);
        }
    }
    SDL_Quit();
    return 0;
}
