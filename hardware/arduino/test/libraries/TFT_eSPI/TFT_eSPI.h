/* Stands in for the library of this name (2.5): what the example calls, declared as there. */
#ifndef TFT_ESPI_H
#define TFT_ESPI_H

#include <Arduino.h>

#define TFT_BLACK 0x0000

class TFT_eSPI {
  public:
    TFT_eSPI(int16_t w = 240, int16_t h = 320) : wide(w), high(h) {}
    void init(uint8_t tc = 0);
    virtual int16_t height(void);
    virtual int16_t width(void);
    void setSwapBytes(bool swap);
    void fillScreen(uint32_t color);
    void pushImage(int32_t x, int32_t y, int32_t w, int32_t h, uint16_t *data);
    void pushImage(int32_t x, int32_t y, int32_t w, int32_t h, const uint16_t *data);

  private:
    int16_t wide, high;
};

#endif
