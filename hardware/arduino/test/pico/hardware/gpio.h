/* Stands in for the Pico SDK's header of this name: what the example calls, declared as there. */
#include "pico/stdlib.h"

enum gpio_function { GPIO_FUNC_SPI = 1 };
enum gpio_dir { GPIO_IN = 0, GPIO_OUT = 1 };

void gpio_init(uint gpio);
void gpio_set_dir(uint gpio, _Bool out);
void gpio_set_function(uint gpio, enum gpio_function function);
void gpio_put(uint gpio, _Bool value);
