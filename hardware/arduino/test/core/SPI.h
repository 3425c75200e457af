/* Stands in for the cores of 32-bit boards, to compile the examples. */
#include <Arduino.h>

enum { MSBFIRST = 1, SPI_MODE0 = 0 };
struct SPISettings {
    SPISettings(uint32_t clock, int order, int mode);
};
struct SPIClass {
    void begin();
    void beginTransaction(SPISettings settings);
    uint8_t transfer(uint8_t byte);
};
extern SPIClass SPI;
