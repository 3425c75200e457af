/* Stands in for the cores of 32-bit boards, to compile the examples. */
#include <Arduino.h>

struct TwoWire {
    void begin();
    void setClock(uint32_t clock);
    void beginTransmission(uint8_t address);
    size_t write(uint8_t byte);
    size_t write(const uint8_t *bytes, size_t count);
    uint8_t endTransmission();
};
extern TwoWire Wire;
