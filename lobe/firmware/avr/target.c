/* ATmega1284P: 8-bit AVR with 16 KiB of memory, USART0 at its default pins. */
#include "target.h"

#include <avr/interrupt.h>
#include <avr/io.h>
#include <avr/sleep.h>

void target_put(uint8_t byte) {
    UCSR0B = (uint8_t)(1 << TXEN0);
    while (!(UCSR0A & (1 << UDRE0))) {
    }
    UDR0 = byte;
}

void target_mark(void) {
    GPIOR0 = 1;
}

void target_end(void) {
    cli();
    sleep_enable();
    for (;;) {
        sleep_cpu(); /* sleeping without interrupts ends the simulation */
    }
}
