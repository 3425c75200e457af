/* Stands in for the Pico SDK on the firmware's targets: an ST7789 whose pixels go out over the
 * serial line. The run ends with the first frame. */
#include "hardware/gpio.h"
#include "hardware/spi.h"
#include "target.h"

enum { PIN_DC = 20, CASET = 0x2A, RASET = 0x2B, RAMWR = 0x2C };

spi_inst_t *const stand_in_spi = 0;
static uint8_t is_data, command;
static uint32_t sent, wanted;

_Bool stdio_init_all(void) {
    return 1;
}
void sleep_ms(uint32_t ms) {
    (void)ms;
}
void gpio_init(uint gpio) {
    (void)gpio;
}
void gpio_set_dir(uint gpio, _Bool out) {
    (void)gpio;
    (void)out;
}
void gpio_set_function(uint gpio, enum gpio_function function) {
    (void)gpio;
    (void)function;
}
void gpio_put(uint gpio, _Bool value) {
    is_data = gpio == PIN_DC ? value : is_data;
}
uint spi_init(spi_inst_t *spi, uint baudrate) {
    (void)spi;
    return baudrate;
}

int spi_write_blocking(spi_inst_t *spi, const uint8_t *src, size_t len) {
    size_t i;
    (void)spi;
    if (!is_data) {
        command = src[0];
    } else if (command == CASET || command == RASET) {
        const uint32_t count = (uint32_t)((src[2] << 8 | src[3]) - (src[0] << 8 | src[1]) + 1);
        wanted = command == CASET ? 2 * count : wanted * count;
    } else if (command == RAMWR) {
        for (i = 0; i < len; ++i) {
            target_put(src[i]);
        }
        sent += (uint32_t)len;
        if (sent >= wanted) {
            target_end();
        }
    }
    return (int)len;
}
