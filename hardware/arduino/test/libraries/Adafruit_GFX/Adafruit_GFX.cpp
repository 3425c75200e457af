/* Pixels go out over the serial line, the high byte first; a strip of another place or size than TftRing's says
 * so. A form feed would be a pixel's byte: simulations of this count strips. */
#include "Adafruit_GFX.h"

static int16_t next_row = 40;

void Adafruit_GFX::drawRGBBitmap(int16_t x, int16_t y, uint16_t *bitmap, int16_t w, int16_t h) {
    if (x != 24 || y != next_row || w != 80) {
        Serial.println(F("stand-in: a strip in the wrong place"));
    }
    next_row = y + h < 120 ? y + h : 40;
    for (int16_t i = 0; i < w * h; ++i) {
        Serial.write(bitmap[i] >> 8);
        Serial.write(bitmap[i] & 255);
    }
}
