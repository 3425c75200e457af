/* Stands in for the library of this name (3.10): what the example calls, declared as there. */
#ifndef FASTLED_H
#define FASTLED_H

#include <Arduino.h>

enum EOrder { RGB = 0012, GRB = 0102 };

struct CRGB {
    uint8_t r, g, b;
    CRGB() : r(0), g(0), b(0) {}
    CRGB(uint8_t ir, uint8_t ig, uint8_t ib) : r(ir), g(ig), b(ib) {}
};

class CLEDController;
template <uint8_t DATA_PIN, EOrder RGB_ORDER> class WS2812B {};

class CFastLED {
  public:
    template <template <uint8_t DATA_PIN, EOrder RGB_ORDER> class CHIPSET, uint8_t DATA_PIN,
              EOrder RGB_ORDER>
    static CLEDController &addLeds(CRGB *data, int nLedsOrOffset, int nLedsIfOffset = 0);
    void setMaxPowerInVoltsAndMilliamps(uint8_t volts, uint32_t milliamps);
    void show();
};
extern CFastLED FastLED;

#endif
