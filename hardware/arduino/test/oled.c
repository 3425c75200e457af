/* Runs an Arduino sketch for the Uno in simavr with an SSD1306 attached, on SPI or on I2C,
 * whichever the sketch uses.
 *
 * Usage: oled SKETCH.elf frames|pages|bytes COUNT
 *
 *     frames  each frame that the display received goes to standard output as a PBM
 *     pages   serial output up to so many form feeds goes there
 *     bytes   serial output of so many bytes goes there
 *
 * Then to standard error: for each frame but the first, "frame CYCLES drawing CYCLES", and "stack
 * BYTES", the most that the sketch took. Drawing is from the last byte of a page that was sent to
 * the first of the next, all eight added.
 *
 * simavr 1.6 takes 100 microseconds for a byte of SPI and 9 for one of I2C, whatever the clock;
 * frame has instead what the buses take at 8 MHz and at 400 kHz. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <simavr/avr_ioport.h>
#include <simavr/avr_spi.h>
#include <simavr/avr_twi.h>
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_time.h>

enum { COLUMNS = 128, PAGES = 8, ADDRESS = 0x3C, PIN_DC = 1 /* of port B: the Uno's pin 9 */ };

/* The display, as far as sketches use it: horizontal addressing over the whole of it. */
typedef struct display {
    avr_t *avr;
    avr_irq_t *twi;
    uint8_t dots[PAGES][COLUMNS];
    uint8_t command[3], command_size, is_data, selected, control_known;
    int position, mode, on;
    long frames, form_feeds, bytes;
    int is_spi;
    long wire_bytes;                 /* of this frame: of SPI, or of I2C with its addresses */
    avr_cycle_count_t last, drawing; /* the last byte's cycle; what a frame's pages took */
    avr_cycle_count_t frame_end;     /* of the frame before */
} display;

/* Cycles that simavr takes for a byte on the bus. */
static long simulated_byte(const display *d) {
    return (long)avr_usec_to_cycles(d->avr, d->is_spi ? 100 : 9);
}

static void write_frame(display *d) {
    printf("P4\n%d %d\n", COLUMNS, PAGES * 8);
    for (int row = 0; row < PAGES * 8; ++row) {
        for (int column = 0; column < COLUMNS; column += 8) {
            int byte = 0;
            for (int i = 0; i < 8; ++i) { /* a dot that is lit is white, a 0 */
                byte = byte << 1 | !(d->dots[row / 8][column + i] >> row % 8 & 1);
            }
            putchar(byte);
        }
    }
    if (d->frame_end) {
        fprintf(stderr, "frame %ld drawing %ld\n",
                (long)(d->avr->cycle - d->frame_end) - d->wire_bytes * simulated_byte(d) +
                    d->wire_bytes * (d->is_spi ? 16 : 9 * 40),
                (long)d->drawing);
    }
    d->frame_end = d->avr->cycle;
    d->wire_bytes = 0;
}

/* How many bytes follow a command (SSD1306 rev. 1.1, table 9). */
static int arguments_of(uint8_t command) {
    switch (command) {
    case 0x20:
    case 0x81:
    case 0x8D:
    case 0xA8:
    case 0xD3:
    case 0xD5:
    case 0xD9:
    case 0xDA:
    case 0xDB:
        return 1;
    case 0x21:
    case 0x22:
        return 2;
    default:
        return 0;
    }
}

static void take_command(display *d, uint8_t byte) {
    d->command[d->command_size++] = byte;
    if (d->command_size <= arguments_of(d->command[0])) {
        return;
    }
    d->command_size = 0;
    if (d->command[0] == 0x20) {
        d->mode = d->command[1];
    } else if (d->command[0] == 0xAF) {
        d->on = 1;
    } else if (d->command[0] == 0x21 || d->command[0] == 0x22) {
        const int last = d->command[0] == 0x21 ? COLUMNS - 1 : PAGES - 1;
        if (d->command[1] != 0 || d->command[2] != last) {
            fprintf(stderr, "oled: a window, %d to %d; only whole pictures are understood\n",
                    d->command[1], d->command[2]);
            exit(1);
        }
        d->position = 0;
    }
}

static void take_data(display *d, uint8_t byte) {
    if (!d->on || d->mode != 0) {
        fprintf(stderr,
                "oled: dots for a display that is not on, or not in horizontal addressing\n");
        exit(1);
    }
    if (d->position % COLUMNS == 0) { /* a byte is seen when it has been sent */
        d->drawing = (d->position ? d->drawing : 0) + d->avr->cycle - d->last -
                     (d->is_spi ? (avr_cycle_count_t)simulated_byte(d) : 0);
    }
    d->last = d->avr->cycle;
    d->dots[d->position / COLUMNS][d->position % COLUMNS] = byte;
    if (++d->position == COLUMNS * PAGES) {
        d->position = 0;
        write_frame(d);
        ++d->frames;
    }
}

static void take(display *d, uint8_t byte) {
    if (d->is_data) {
        take_data(d, byte);
    } else {
        take_command(d, byte);
    }
}

static void spi_sent(struct avr_irq_t *irq, uint32_t value, void *user_data) {
    (void)irq;
    ((display *)user_data)->is_spi = 1;
    ++((display *)user_data)->wire_bytes;
    take(user_data, (uint8_t)value);
}

static void pin_changed(struct avr_irq_t *irq, uint32_t value, void *user_data) {
    (void)irq;
    ((display *)user_data)->is_data = value != 0;
}

/* I2C: an address, a control byte that says what follows, bytes. */
static void twi_sent(struct avr_irq_t *irq, uint32_t value, void *user_data) {
    display *d = user_data;
    const avr_twi_msg_irq_t message = {.u.v = value};
    (void)irq;
    if (message.u.twi.msg & TWI_COND_STOP) {
        d->selected = 0;
    }
    if (message.u.twi.msg & TWI_COND_START) {
        d->selected = message.u.twi.addr >> 1 == ADDRESS;
        d->control_known = 0;
        ++d->wire_bytes;
        if (d->selected) {
            avr_raise_irq(d->twi + TWI_IRQ_INPUT,
                          avr_twi_irq_msg(TWI_COND_ACK, message.u.twi.addr, 1));
        }
    }
    if (d->selected && message.u.twi.msg & TWI_COND_WRITE) {
        avr_raise_irq(d->twi + TWI_IRQ_INPUT, avr_twi_irq_msg(TWI_COND_ACK, message.u.twi.addr, 1));
        ++d->wire_bytes;
        if (!d->control_known) {
            d->is_data = message.u.twi.data == 0x40;
            d->control_known = 1;
        } else {
            take(d, message.u.twi.data);
        }
    }
}

static void serial_sent(struct avr_irq_t *irq, uint32_t value, void *user_data) {
    display *d = user_data;
    (void)irq;
    putchar((int)(value & 255u));
    ++d->bytes;
    d->form_feeds += value == '\f';
}

static void quiet(avr_t *avr, const int level, const char *format, va_list arguments) {
    (void)avr;
    if (level <= LOG_ERROR) {
        vfprintf(stderr, format, arguments);
    }
}

static void connect(display *d) {
    uint32_t flags = 0;
    avr_ioctl(d->avr, AVR_IOCTL_UART_GET_FLAGS('0'), &flags);
    flags &= ~(uint32_t)(AVR_UART_FLAG_STDIO | AVR_UART_FLAG_POOL_SLEEP);
    avr_ioctl(d->avr, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
    d->twi = avr_io_getirq(d->avr, AVR_IOCTL_TWI_GETIRQ(0), 0);
    avr_irq_register_notify(d->twi + TWI_IRQ_OUTPUT, twi_sent, d);
    avr_irq_register_notify(avr_io_getirq(d->avr, AVR_IOCTL_SPI_GETIRQ(0), SPI_IRQ_OUTPUT),
                            spi_sent, d);
    avr_irq_register_notify(avr_io_getirq(d->avr, AVR_IOCTL_IOPORT_GETIRQ('B'), PIN_DC),
                            pin_changed, d);
    avr_irq_register_notify(avr_io_getirq(d->avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT),
                            serial_sent, d);
}

int main(int argc, char **argv) {
    elf_firmware_t program = {0};
    display d = {.avr = avr_make_mcu_by_name("atmega328p"), .mode = 2};
    int state = cpu_Running;
    const long wanted = argc == 4 ? atol(argv[3]) : 0;
    const long *count = argc != 4                        ? NULL
                        : strcmp(argv[2], "frames") == 0 ? &d.frames
                        : strcmp(argv[2], "pages") == 0  ? &d.form_feeds
                        : strcmp(argv[2], "bytes") == 0  ? &d.bytes
                                                         : NULL;
    if (!count || !d.avr || wanted < 1) {
        fprintf(stderr, "usage: oled SKETCH.elf frames|pages|bytes COUNT\n");
        return 2;
    }
    avr_global_logger_set(quiet);
    if (elf_read_firmware(argv[1], &program) != 0) {
        fprintf(stderr, "oled: %s: not an AVR program in ELF format\n", argv[1]);
        return 1;
    }
    program.frequency = 16000000;
    avr_init(d.avr);
    avr_load_firmware(d.avr, &program);
    connect(&d);
    unsigned lowest = d.avr->ramend;
    while (*count < wanted && state != cpu_Done && state != cpu_Crashed) {
        state = avr_run(d.avr);
        const unsigned stack = (unsigned)(d.avr->data[R_SPL] | d.avr->data[R_SPH] << 8);
        lowest = stack > 0x100 && stack < lowest ? stack : lowest;
    }
    fprintf(stderr, "stack %u\n", d.avr->ramend - lowest);
    return *count < wanted || fflush(stdout) != 0;
}
