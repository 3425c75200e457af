/* Stands in for Adafruit's library of this name: what the example calls, declared as there. */
#ifndef ADAFRUIT_ST7735_H
#define ADAFRUIT_ST7735_H

#include <Adafruit_GFX.h>

#define INITR_BLACKTAB 0x02

class Adafruit_ST7735 : public Adafruit_GFX {
  public:
    Adafruit_ST7735(int8_t, int8_t, int8_t) : Adafruit_GFX(128, 160) {}
    void initR(uint8_t) { Serial.begin(1000000); }
};

#endif
