/* A shaded ball that bounces and turns on a small OLED: SSD1306, 128 by 64 dots, on an Uno, Nano,
 * Leonardo or anything larger.
 *
 * Modules with four pins (I2C): GND, VCC, SCL to SCL (Uno: A5), SDA to SDA (Uno: A4).
 * Modules with seven pins (SPI): make DISPLAY_SPI 1; D0 to SCK (Uno: 13), D1 to MOSI (Uno: 11),
 * RES to 8, DC to 9, CS to 10.
 *
 * No other library is needed. */
#ifndef DISPLAY_SPI
#define DISPLAY_SPI 0
#endif

#include "display.h"
#include "scene.h"

static scene ball;
static uint8_t frame;

void setup() {
    display_begin();
    scene_create(&ball);
}

void loop() {
    scene_turn(&ball, frame++);
    for (uint8_t page = 0; page < SCENE_PAGES; ++page) {
        scene_page(&ball, page);
        display_page(ball.dots);
    }
}
