/* A shaded copper ring, 240 by 240 pixels, that turns on the display of an ESP32 board by the library TFT_eSPI (Tools,
 * Manage Libraries), whose User_Setup.h names your display and its pins. A strip of four rows at a time: 2 KB for its
 * colours and 1 KB for its depth, no framebuffer. */
#include <TFT_eSPI.h>

#define SCENE_SIZE 240
#include "scene.h"

static TFT_eSPI tft;
static scene ring;
static uint8_t frame;

void setup() {
    tft.init();
    tft.setSwapBytes(true); /* colours are words, the display takes their high byte first */
    tft.fillScreen(TFT_BLACK);
    scene_create(&ring);
}

void loop() {
    const int32_t left = (tft.width() - SCENE_SIZE) / 2, top = (tft.height() - SCENE_SIZE) / 2;
    scene_turn(&ring, frame++);
    for (uint8_t i = 0; i < SCENE_STRIPS; ++i) {
        scene_strip(&ring, i);
        tft.pushImage(left, top + i * SCENE_ROWS, SCENE_SIZE, SCENE_ROWS, ring.colors);
    }
}
