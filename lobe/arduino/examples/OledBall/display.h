/* An SSD1306 as a place where bytes go: a page is 128 bytes, eight pages fill it and begin again.
 */
#ifndef DISPLAY_H
#define DISPLAY_H

#include <Arduino.h>

#if DISPLAY_SPI
#include <SPI.h>
#else
#include <Wire.h>
#endif

enum { DISPLAY_ADDRESS = 0x3C, DISPLAY_RESET = 8, DISPLAY_DC = 9, DISPLAY_CS = 10 };

/* The data sheet's sequence (SSD1306 rev. 1.1, figure 2), with the charge pump and columns, then
 * pages. */
static const uint8_t display_setup[] PROGMEM = {
    0xAE, 0xD5, 0x80, 0xA8, 63,   0xD3, 0,    0x40, 0x8D, 0x14, 0x20, 0,    0xA1, 0xC8, 0xDA, 0x12,
    0x81, 0xCF, 0xD9, 0xF1, 0xDB, 0x40, 0xA4, 0xA6, 0x21, 0,    127,  0x22, 0,    7,    0xAF};

#if DISPLAY_SPI

static void display_begin() {
    pinMode(DISPLAY_RESET, OUTPUT);
    pinMode(DISPLAY_DC, OUTPUT);
    pinMode(DISPLAY_CS, OUTPUT);
    digitalWrite(DISPLAY_RESET, LOW);
    delay(1);
    digitalWrite(DISPLAY_RESET, HIGH);
    SPI.begin();
    SPI.beginTransaction(SPISettings(8000000, MSBFIRST, SPI_MODE0));
    digitalWrite(DISPLAY_CS, LOW);
    digitalWrite(DISPLAY_DC, LOW);
    for (uint8_t i = 0; i < sizeof display_setup; ++i) {
        SPI.transfer(pgm_read_byte(&display_setup[i]));
    }
    digitalWrite(DISPLAY_DC, HIGH);
}

static void display_page(const uint8_t dots[128]) {
    for (uint8_t i = 0; i < 128; ++i) {
        SPI.transfer(dots[i]);
    }
}

#else

static void display_begin() {
    Wire.begin();
    Wire.setClock(400000);
    for (uint8_t i = 0; i < sizeof display_setup; ++i) {
        Wire.beginTransmission(DISPLAY_ADDRESS);
        Wire.write((uint8_t)0x00); /* a command follows */
        Wire.write((uint8_t)pgm_read_byte(&display_setup[i]));
        Wire.endTransmission();
    }
}

/* Wire's buffer on AVR holds 32 bytes. */
static void display_page(const uint8_t dots[128]) {
    for (uint8_t i = 0; i < 128; i += 16) {
        Wire.beginTransmission(DISPLAY_ADDRESS);
        Wire.write((uint8_t)0x40); /* data follow */
        Wire.write(dots + i, 16);
        Wire.endTransmission();
    }
}

#endif

#endif
