/* A shaded copper ring that turns on a Raspberry Pi Pico: an ST7789 of 240 by 240 pixels on SPI 0,
 * its SCK at GPIO 18, SDA at 19, CS at 17, DC at 20, RST at 21. For another size of display change
 * WIDTH, HEIGHT and, in CMakeLists.txt, SCENE_SIZE. */
#include "hardware/gpio.h"
#include "hardware/spi.h"
#include "pico/stdlib.h"

#include "scene.h"

enum {
    WIDTH = 240,
    HEIGHT = 240,
    PIN_CS = 17,
    PIN_SCK = 18,
    PIN_SDA = 19,
    PIN_DC = 20,
    PIN_RST = 21
};

static scene ring;

static void command(uint8_t code, const uint8_t *data, size_t size) {
    gpio_put(PIN_DC, 0);
    spi_write_blocking(spi0, &code, 1);
    gpio_put(PIN_DC, 1);
    spi_write_blocking(spi0, data, size);
}

static void range(uint8_t code, uint16_t first, uint16_t last) {
    const uint8_t data[4] = {(uint8_t)(first >> 8), (uint8_t)first, (uint8_t)(last >> 8),
                             (uint8_t)last};
    command(code, data, sizeof data);
}

/* The data sheet's sequence (ST7789V, 9.1): out of sleep, 16 bits per pixel, inverted as IPS panels
 * are. */
static void display_begin(void) {
    static const uint8_t rgb565 = 0x55, upright = 0x00;
    static const uint8_t pins[3] = {PIN_CS, PIN_DC, PIN_RST};
    spi_init(spi0, 62500000);
    gpio_set_function(PIN_SCK, GPIO_FUNC_SPI);
    gpio_set_function(PIN_SDA, GPIO_FUNC_SPI);
    for (int i = 0; i < 3; ++i) {
        gpio_init(pins[i]);
        gpio_set_dir(pins[i], GPIO_OUT);
    }
    gpio_put(PIN_CS, 0);
    gpio_put(PIN_RST, 0);
    sleep_ms(10);
    gpio_put(PIN_RST, 1);
    sleep_ms(120);
    command(0x11, NULL, 0);
    sleep_ms(120);
    command(0x3A, &rgb565, 1);
    command(0x36, &upright, 1);
    command(0x21, NULL, 0);
    command(0x29, NULL, 0);
}

int main(void) {
    const uint16_t left = (WIDTH - SCENE_SIZE) / 2, top = (HEIGHT - SCENE_SIZE) / 2;
    stdio_init_all();
    display_begin();
    scene_create(&ring);
    for (uint8_t frame = 0;; ++frame) {
        scene_turn(&ring, frame);
        range(0x2A, left, left + SCENE_SIZE - 1);
        range(0x2B, top, top + SCENE_SIZE - 1);
        command(0x2C, NULL, 0);
        for (uint8_t strip = 0; strip < SCENE_STRIPS; ++strip) {
            scene_strip(&ring, strip);
            for (int i = 0; i < SCENE_SIZE * SCENE_ROWS; ++i) { /* the high byte first */
                ring.colors[i] = (uint16_t)(ring.colors[i] << 8 | ring.colors[i] >> 8);
            }
            spi_write_blocking(spi0, (const uint8_t *)ring.colors, sizeof ring.colors);
        }
    }
}
