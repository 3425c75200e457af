/* A shaded copper ring that turns on a colour TFT: any display that an Adafruit_GFX library draws on,
 * here an ST7735 of 128 by 160 pixels with its CS, DC and RST at pins 10, 9 and 8. For another one change
 * the three lines marked "display". Works from 2 KB of memory on: a strip of four rows at a time.
 *
 * Needs the libraries Adafruit GFX and Adafruit ST7735 (Tools, Manage Libraries). */
#include <Adafruit_GFX.h>
#include <Adafruit_ST7735.h> /* display */
#include <SPI.h>

#include "scene.h"

static Adafruit_ST7735 tft(10, 9, 8); /* display */
static scene ring;
static uint8_t frame;

void setup() {
    tft.initR(INITR_BLACKTAB); /* display */
    tft.fillScreen(0);
    scene_create(&ring);
}

void loop() {
    const int16_t left = (tft.width() - SCENE_SIZE) / 2, top = (tft.height() - SCENE_SIZE) / 2;
    scene_turn(&ring, frame++);
    for (uint8_t i = 0; i < SCENE_STRIPS; ++i) {
        scene_strip(&ring, i);
        tft.drawRGBBitmap(left, top + i * SCENE_ROWS, ring.colors, SCENE_SIZE, SCENE_ROWS);
    }
}
