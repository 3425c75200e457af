/* RV32IM on qemu's virt board: start, a 16550's transmit register, the board's test device. */
#include "target.h"

#define UART_TRANSMIT (*(volatile uint8_t *)0x10000000u)
#define TEST_DEVICE (*(volatile uint32_t *)0x00100000u)

extern uint32_t bss_begin[], bss_end[];
int main(void);
void start_in_c(void);

/* The stack first, then C. */
__asm__(".section .text.start\n"
        ".global start\n"
        "start:\n"
        "    la sp, stack_top\n"
        "    j start_in_c\n"
        ".previous");

void target_put(uint8_t byte) {
    UART_TRANSMIT = byte;
}

__attribute__((noinline)) void target_mark(void) {
    __asm__ volatile("" ::: "memory");
}

void target_end(void) {
    TEST_DEVICE = 0x5555; /* pass */
    for (;;) {
    }
}

void start_in_c(void) {
    uint32_t *to;
    for (to = bss_begin; to < bss_end;) {
        *to++ = 0;
    }
    main();
    target_end();
}
