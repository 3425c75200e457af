/* Runs an AVR program in simavr: its serial output goes to standard output. When the program writes
 * GPIOR0, a line "mark CYCLE" with the exact cycle goes to standard error.
 * Usage: simulate PROGRAM.elf [trace]
 * trace: the address of each instruction goes to standard error too, as qemu writes it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>

enum { GPIOR0 = 0x3E };

static void sent(struct avr_irq_t *irq, uint32_t value, void *unused) {
    (void)irq;
    (void)unused;
    putchar((int)(value & 255u));
}

static void marked(struct avr_t *avr, avr_io_addr_t address, uint8_t value, void *unused) {
    (void)unused;
    avr->data[address] = value;
    fprintf(stderr, "mark %llu\n", (unsigned long long)avr->cycle);
}

static void quiet(avr_t *avr, const int level, const char *format, va_list arguments) {
    (void)avr;
    if (level <= LOG_ERROR) {
        vfprintf(stderr, format, arguments);
    }
}

int main(int argc, char **argv) {
    elf_firmware_t program = {0};
    avr_t *avr = avr_make_mcu_by_name("atmega1284p");
    uint32_t flags = 0;
    int state = cpu_Running;
    const int traced = argc == 3 && strcmp(argv[2], "trace") == 0;
    if ((argc != 2 && !traced) || !avr) {
        fprintf(stderr, "usage: simulate PROGRAM.elf [trace]\n");
        return 2;
    }
    avr_global_logger_set(quiet);
    if (elf_read_firmware(argv[1], &program) != 0) {
        fprintf(stderr, "simulate: %s: not an AVR program in ELF format\n", argv[1]);
        return 1;
    }
    program.frequency = 16000000;
    avr_init(avr);
    avr_load_firmware(avr, &program);
    avr_ioctl(avr, AVR_IOCTL_UART_GET_FLAGS('0'), &flags);
    flags &= ~(uint32_t)(AVR_UART_FLAG_STDIO | AVR_UART_FLAG_POOL_SLEEP);
    avr_ioctl(avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
    avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT), sent,
                            NULL);
    avr_register_io_write(avr, GPIOR0, marked, NULL);
    while (state != cpu_Done && state != cpu_Crashed) {
        if (traced) {
            fprintf(stderr, "Trace 0: [0/%08x/0]\n", avr->pc);
        }
        state = avr_run(avr);
    }
    return state == cpu_Crashed || fflush(stdout) != 0;
}
