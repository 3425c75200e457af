/* A knot that turns, in a plain framebuffer of 64 by 64 pixels in RGB565 with a byte of depth each: 12 KB, for
 * boards with 16 KB of memory and more (SAMD21, RP2040, ESP32, ATmega1284P). picture.c draws it; nothing in it
 * knows Arduino. Give `knot.pixels` to your display where it says so; until then each frame goes out as a
 * picture (PPM) over the serial line:
 *
 *     stty -F /dev/ttyACM0 115200 raw; head -c 12301 /dev/ttyACM0 > knot.ppm
 */
#include <burnish.h>

extern "C" {
#include "picture.h"
}

#include <Arduino.h>

static picture knot;
static uint8_t frame;

static void put(uint8_t byte) {
    Serial.write(byte);
}

void setup() {
    Serial.begin(115200);
}

void loop() {
    picture_draw(&knot, frame++);
    /* Here, for example: tft.drawRGBBitmap(0, 0, knot.pixels, PICTURE_SIZE, PICTURE_SIZE); */
    picture_write(&knot, put);
}
