/* Stands in for the Pico SDK's header of this name: what the example calls, declared as there. */
#include <stddef.h>
#include <stdint.h>

typedef unsigned int uint;

_Bool stdio_init_all(void);
void sleep_ms(uint32_t ms);
