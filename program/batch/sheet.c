/* The contact sheet. The pictures come from untrusted workers, so a sandboxed process decodes them,
 * lays them out and encodes the sheet. This process only reads and writes files. */
#include <stdlib.h>
#include <string.h>

#include "batch/batch.h"
#include "batch/types.h"
#include "burnish/sheet.h"

#ifndef _WIN32

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <unistd.h>

#include "base/cli/file.h"
#include "base/cli/platform.h"
#include "base/cli/process.h"
#include "cli/input.h"
#include "cli/limits.h"
#include "picture/formats.h"
#include "sandbox/channel.h"
#include "sandbox/lock.h"

enum { DECODER_CHANNEL = 3 }; /* the descriptor of the process that reads the pictures */
enum { CELL_MAX = 256, CELL_MIN = 16, LABEL_MIN = 96, FILE_MAX_BYTES = 1 << 28 };

typedef struct sheet {
    const batch *b;
    int channel;
    size_t count;      /* number of pictures */
    int width, height; /* of a cell */
    int columns;
    picture_format format;
} sheet;

/* ---- The sandboxed process ---- */

/* Box filter over the source pixels of each target pixel. Squared values approximate linear light;
 * transparent pixels are blended with white. */
static void shrink_picture(const burnish_image *from, burnish_image *to) {
    const int n = from->channels;
    for (int y = 0; y < to->height; ++y) {
        const int y0 = (int)((int64_t)y * from->height / to->height);
        int y1 = (int)((int64_t)(y + 1) * from->height / to->height);
        y1 = y1 > y0 ? y1 : y0 + 1;
        for (int x = 0; x < to->width; ++x) {
            const int x0 = (int)((int64_t)x * from->width / to->width);
            int x1 = (int)((int64_t)(x + 1) * from->width / to->width);
            uint64_t sum[3] = {0, 0, 0};
            x1 = x1 > x0 ? x1 : x0 + 1;
            for (int v = y0; v < y1; ++v) {
                for (int u = x0; u < x1; ++u) {
                    const uint8_t *p =
                        from->pixels + ((size_t)v * (size_t)from->width + (size_t)u) * (size_t)n;
                    const uint64_t alpha = n == 4 ? p[3] : 255;
                    for (int k = 0; k < 3; ++k) {
                        sum[k] += alpha * p[k] * p[k] + (255 - alpha) * 255 * 255;
                    }
                }
            }
            const double count = 255.0 * (x1 - x0) * (y1 - y0);
            for (int k = 0; k < 3; ++k) {
                to->pixels[((size_t)y * (size_t)to->width + (size_t)x) * 3 + (size_t)k] =
                    (uint8_t)(sqrt((double)sum[k] / count) + 0.5);
            }
        }
    }
}

/* Receives the next picture as a cell; unreadable pictures become white. */
static burnish_status receive_cell(const sheet *s, burnish_image *cell, char *label,
                                   size_t label_size, burnish_error *error) {
    uint64_t size = 0;
    burnish_image whole = {0};
    burnish_status status = burnish_image_create(NULL, cell, s->width, s->height, 3, error);
    if (status == BURNISH_STATUS_OK && (!channel_read(s->channel, label, label_size) ||
                                        !channel_read(s->channel, &size, sizeof size))) {
        status = cli_fail(error, BURNISH_STATUS_READ, "--sheet: the other process has ended");
    }
    label[label_size - 1] = 0;
    uint8_t *bytes = status == BURNISH_STATUS_OK ? malloc((size_t)size + 1) : NULL;
    if (status == BURNISH_STATUS_OK && (!bytes || !channel_read(s->channel, bytes, (size_t)size))) {
        status = cli_fail(error, BURNISH_STATUS_MEMORY, "--sheet: out of memory");
    }
    if (status == BURNISH_STATUS_OK) {
        memset(cell->pixels, 255, (size_t)cell->width * (size_t)cell->height * 3);
        if (size > 0 && burnish_image_decode(NULL, bytes, (size_t)size, label, &whole, NULL) ==
                            BURNISH_STATUS_OK) {
            shrink_picture(&whole, cell);
        }
    }
    burnish_image_destroy(&whole);
    free(bytes);
    return status;
}

enum { LABEL_BYTES = 64 };

static burnish_status make_sheet(const sheet *s, picture_file *file, burnish_error *error) {
    static const uint8_t paper[3] = {255, 255, 255}, ink[3] = {40, 40, 40};
    burnish_sheet_cell *cells = calloc(s->count, sizeof *cells);
    burnish_image *images = calloc(s->count, sizeof *images);
    char(*labels)[LABEL_BYTES] = calloc(s->count, sizeof *labels);
    burnish_image whole = {0};
    burnish_status status = cells && images && labels
                                ? BURNISH_STATUS_OK
                                : cli_fail(error, BURNISH_STATUS_MEMORY, "--sheet: out of memory");
    for (size_t i = 0; i < s->count && status == BURNISH_STATUS_OK; ++i) {
        status = receive_cell(s, &images[i], labels[i], sizeof labels[i], error);
        cells[i] = (burnish_sheet_cell){.image = &images[i],
                                        .label = s->width >= LABEL_MIN ? labels[i] : NULL};
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_image_sheet(&whole, cells, s->count, s->columns, paper, ink, error);
    }
    if (status == BURNISH_STATUS_OK) {
        const burnish_pixels pixels = burnish_image_get_pixels(&whole);
        const picture_options options = {.threads = 1};
        status = picture_encode(s->format, &pixels, &options, file, error);
    }
    for (size_t i = 0; images && i < s->count; ++i) {
        burnish_image_destroy(&images[i]);
    }
    burnish_image_destroy(&whole);
    free(labels);
    free(images);
    free(cells);
    return status;
}

/* Receives all pictures; sends a status, then the sheet's bytes or an error message. */
__attribute__((noreturn)) static void be_decoder(sheet *s) {
    burnish_error error = {BURNISH_STATUS_OK, ""};
    picture_file file = {0};
    burnish_status status = BURNISH_STATUS_OK;
    burnish_processor_count(); /* reads files, once */
    const char *wall = "descriptors";
    int code = 0;
    if (s->b->settings->render.job.sandbox) {
        code = sandbox_lock(DECODER_CHANNEL + 1, 0, &wall);
    }
    if (code != 0) {
        status = cli_fail(&error, BURNISH_STATUS_ARGUMENT,
                          "--sheet: this system can't create a sandbox (%s: %s); use --no-sandbox",
                          wall, strerror(code));
    }
    s->channel = DECODER_CHANNEL;
    if (status == BURNISH_STATUS_OK) {
        status = make_sheet(s, &file, &error);
    }
    const uint64_t reply[2] = {(uint64_t)status,
                               status == BURNISH_STATUS_OK ? file.size : strlen(error.text)};
    const int sent =
        cli_write_all(DECODER_CHANNEL, reply, sizeof reply) &&
        cli_write_all(DECODER_CHANNEL,
                      status == BURNISH_STATUS_OK ? (const void *)file.bytes : error.text,
                      (size_t)reply[1]);
    _exit(sent ? 0 : 1);
}

/* ---- This process ---- */

static int is_shown(const batch_item *item) {
    return !item->has_failed && item->line;
}

static int continues_character(char byte) {
    return ((unsigned char)byte & 0xc0) == 0x80; /* a character of UTF-8 */
}

/* The name, without its middle if it is too long for a cell: names of parts differ at their ends. */
static void write_label(char label[LABEL_BYTES], const char *name, int width) {
    const size_t fits = width / 7 > 8 ? (size_t)width / 7 : 8;
    const size_t most = fits < LABEL_BYTES - 1 ? fits : LABEL_BYTES - 1, length = strlen(name);
    if (length <= most) {
        memcpy(label, name, length + 1);
        return;
    }
    size_t head = (most - 2) / 3, tail = length - (most - 2 - head);
    while (head > 0 && continues_character(name[head])) {
        --head;
    }
    while (tail < length && continues_character(name[tail])) {
        ++tail;
    }
    snprintf(label, LABEL_BYTES, "%.*s..%s", (int)head, name, name + tail);
}

static void send_pictures(const sheet *s) {
    for (size_t i = 0; i < s->b->list.count; ++i) {
        const batch_item *item = &s->b->list.items[i];
        char label[LABEL_BYTES] = "";
        if (!is_shown(item)) {
            continue;
        }
        write_label(label, cli_base_name(item->input), s->width);
        uint8_t *bytes;
        size_t size;
        burnish_error unread;
        cli_read_bytes(item->output, FILE_MAX_BYTES, NULL, &bytes, &size, &unread);
        const uint64_t count = size;
        const int sent = cli_write_all(s->channel, label, sizeof label) &&
                         cli_write_all(s->channel, &count, sizeof count) &&
                         cli_write_all(s->channel, bytes ? bytes : (uint8_t *)label, (size_t)count);
        free(bytes);
        if (!sent) {
            return;
        }
    }
}

static burnish_status receive_sheet(const sheet *s, const char *path, burnish_error *error) {
    uint64_t reply[2];
    char *bytes = NULL;
    burnish_status status = BURNISH_STATUS_OK;
    if (!channel_read(s->channel, reply, sizeof reply) || reply[1] >= (uint64_t)1 << 32 ||
        (reply[0] != BURNISH_STATUS_OK && reply[1] >= sizeof error->text) ||
        reply[0] >= BURNISH_STATUS_COUNT) {
        return cli_fail(error, BURNISH_STATUS_FORMAT,
                        "--sheet: the process that reads the pictures ended");
    }
    bytes = calloc((size_t)reply[1] + 1, 1);
    if (!bytes || !channel_read(s->channel, bytes, (size_t)reply[1])) {
        status = cli_fail(error, BURNISH_STATUS_MEMORY, "--sheet: out of memory");
    } else if (reply[0] != BURNISH_STATUS_OK) {
        status = cli_fail(error, (burnish_status)reply[0], "%s", bytes);
    } else {
        status = cli_file_write(path, bytes, (size_t)reply[1], error);
    }
    free(bytes);
    return status;
}

/* Chooses the largest cells with which the sheet is within the image size limit. */
static burnish_status lay_out(sheet *s, burnish_error *error) {
    const int *size = s->b->settings->render.picture.size;
    const int longest = size[0] > size[1] ? size[0] : size[1];
    for (int side = longest < CELL_MAX ? longest : CELL_MAX;;
         side -= side > 4 * CELL_MIN ? 16 : 4) {
        const burnish_image empty = {.width = (int)((int64_t)size[0] * side / longest),
                                     .height = (int)((int64_t)size[1] * side / longest),
                                     .channels = 3};
        burnish_sheet_cell *cells = calloc(s->count, sizeof *cells);
        int width = 0, height = 0;
        s->width = empty.width > 0 ? empty.width : 1;
        s->height = empty.height > 0 ? empty.height : 1;
        burnish_image cell = empty;
        cell.width = s->width;
        cell.height = s->height;
        for (size_t i = 0; cells && i < s->count; ++i) {
            cells[i] =
                (burnish_sheet_cell){.image = &cell, .label = side >= LABEL_MIN ? "x" : NULL};
        }
        const render_settings *picture = &s->b->settings->render;
        const int is_plain = picture->picture.views.count < 2 && picture->shading.lobes.count < 2;
        s->columns = is_plain && picture->picture.columns > 0
                         ? picture->picture.columns
                         : (int)ceil(sqrt((double)s->count * s->height / s->width));
        s->columns = s->columns > (int)s->count ? (int)s->count : s->columns < 1 ? 1 : s->columns;
        const burnish_status status =
            cells ? burnish_image_sheet_size(cells, s->count, s->columns, &width, &height, error)
                  : cli_fail(error, BURNISH_STATUS_MEMORY, "--sheet: out of memory");
        free(cells);
        if (status == BURNISH_STATUS_OK || status == BURNISH_STATUS_MEMORY) {
            return status;
        }
        if (side <= CELL_MIN) {
            return cli_fail(error, BURNISH_STATUS_ARGUMENT,
                            "--sheet: %zu pictures are too many for one; leave it out", s->count);
        }
    }
}

burnish_status batch_write_sheet(const batch *b, burnish_error *error) {
    sheet s = {.b = b};
    int ends[2];
    for (size_t i = 0; i < b->list.count; ++i) {
        s.count += (size_t)is_shown(&b->list.items[i]);
    }
    if (s.count == 0) {
        return BURNISH_STATUS_OK;
    }
    burnish_status status =
        picture_choose("sheet", b->settings->sheet, PICTURE_8_BIT, PICTURE_AUTO, &s.format, error);
    if (status == BURNISH_STATUS_OK) {
        status = lay_out(&s, error);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (!cli_channel(ends)) {
        return cli_fail(error, BURNISH_STATUS_MEMORY, "--sheet: no socket: %s", strerror(errno));
    }
    const pid_t worker = cli_fork(&(cli_plan){.kept = {CLI_SAME, CLI_SAME, CLI_SAME, ends[1]},
                                              .count = DECODER_CHANNEL + 1,
                                              .ended_by = SIGKILL});
    if (worker == 0) {
        be_decoder(&s);
    }
    close(ends[1]);
    s.channel = ends[0];
    if (worker > 0) {
        send_pictures(&s);
        status = receive_sheet(&s, b->settings->sheet, error);
    } else {
        status = cli_fail(error, BURNISH_STATUS_MEMORY, "--sheet: no process: %s", strerror(errno));
    }
    close(ends[0]);
    if (worker > 0) {
        cli_wait(worker);
    }
    return status;
}

#endif
