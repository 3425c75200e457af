/* Stands in for the cores of 32-bit boards, which Debian does not have: what the examples call, to
 * compile them. */
#ifndef ARDUINO_H
#define ARDUINO_H

#include <stddef.h>
#include <stdint.h>

#define PROGMEM
#define F(text) (text)
#define pgm_read_byte(address) (*(const uint8_t *)(address))

enum { LOW, HIGH };
enum { INPUT, OUTPUT };

void pinMode(int pin, int mode);
void digitalWrite(int pin, int value);
void delay(unsigned long ms);
unsigned long micros();
extern "C" double pow(double base, double exponent);
extern "C" void *memset(void *to, int byte, size_t count);

struct Print {
    void begin(unsigned long baud);
    size_t write(uint8_t byte);
    size_t print(const char *text);
    size_t print(double number, int digits = 2);
    size_t println(double number, int digits = 2);
    size_t println(const char *text = "");
};
extern Print Serial;

void setup();
void loop();

#endif
