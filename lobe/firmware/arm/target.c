/* Cortex-M0 of the nRF51822 (the first micro:bit): start, serial line, exit through semihosting. */
#include "target.h"

#define REGISTER(address) (*(volatile uint32_t *)(address))

extern uint32_t data_begin[], data_end[], data_image[], bss_begin[], bss_end[], stack_top[];
int main(void);
void start(void);

#define UART_STARTTX REGISTER(0x40002008u)
#define UART_TXDRDY REGISTER(0x4000211Cu)
#define UART_ENABLE REGISTER(0x40002500u)
#define UART_TXD REGISTER(0x4000251Cu)

void target_put(uint8_t byte) {
    UART_ENABLE = 4;
    UART_STARTTX = 1;
    UART_TXDRDY = 0;
    UART_TXD = byte;
    while (UART_TXDRDY == 0) {
    }
}

__attribute__((noinline)) void target_mark(void) {
    __asm__ volatile("" ::: "memory");
}

void target_end(void) {
    register uint32_t call __asm__("r0") = 0x18;      /* SYS_EXIT */
    register uint32_t reason __asm__("r1") = 0x20026; /* ADP_Stopped_ApplicationExit */
    __asm__ volatile("bkpt 0xAB" ::"r"(call), "r"(reason) : "memory");
    for (;;) {
    }
}

void start(void) {
    uint32_t *to, *from = data_image;
    for (to = data_begin; to < data_end;) {
        *to++ = *from++;
    }
    for (to = bss_begin; to < bss_end;) {
        *to++ = 0;
    }
    main();
    target_end();
}

/* Stack and reset; no other exception occurs. */
__attribute__((section(".vectors"), used)) static const void *const vectors[16] = {
    stack_top, (const void *)start};
