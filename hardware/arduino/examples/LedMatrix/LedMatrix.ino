/* A shaded ring that turns on a matrix of 16 by 16 LEDs of kind WS2812B at pin 5, by the library FastLED (Tools, Manage
 * Libraries). LEDs are linear in their codes, as burnish's colours are. */
#include <FastLED.h>

#define SCENE_SIZE 16
#define SCENE_BACKGROUND 0
#include "scene.h"

enum { DATA_PIN = 5, COUNT = SCENE_SIZE * SCENE_SIZE };

static CRGB leds[COUNT];
static scene ring;
static uint8_t frame;

/* The LED of a pixel: most matrices run to and fro. For one whose rows all begin at the left: return y * SCENE_SIZE + x. */
static uint16_t led_at(uint8_t x, uint8_t y) {
    return (uint16_t)(y * SCENE_SIZE + (y & 1 ? SCENE_SIZE - 1 - x : x));
}

void setup() {
    FastLED.addLeds<WS2812B, DATA_PIN, GRB>(leds, COUNT);
    FastLED.setMaxPowerInVoltsAndMilliamps(5, 500); /* what a USB port gives */
    scene_create(&ring);
}

void loop() {
    scene_turn(&ring, frame++);
    for (uint8_t i = 0; i < SCENE_STRIPS; ++i) {
        scene_strip(&ring, i);
        for (uint8_t k = 0; k < SCENE_SIZE * SCENE_ROWS; ++k) {
            const uint16_t color = ring.colors[k]; /* RGB565 */
            leds[led_at(k % SCENE_SIZE, i * SCENE_ROWS + k / SCENE_SIZE)] =
                CRGB(color >> 11 << 3, (color >> 5 & 63) << 2, (color & 31) << 3);
        }
    }
    FastLED.show();
}
