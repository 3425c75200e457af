/* Stands in for Adafruit's library of this name: what the example calls, declared as there. */
#ifndef ADAFRUIT_GFX_H
#define ADAFRUIT_GFX_H

#include <Arduino.h>

class Adafruit_GFX {
  public:
    Adafruit_GFX(int16_t w, int16_t h) : wide(w), high(h) {}
    int16_t width() const { return wide; }
    int16_t height() const { return high; }
    void fillScreen(uint16_t) {}
    void drawRGBBitmap(int16_t x, int16_t y, uint16_t *bitmap, int16_t w, int16_t h);

  private:
    int16_t wide, high;
};

#endif
