/* Radiance HDR (G. Ward, "Real Pixels", Graphics Gems II, 1991; "Radiance File Formats"): RGBE
 * pixels, plain or run-length encoded in the old or the new way. A pixel is mantissa 2^(e - 136),
 * without the half that Radiance adds to a mantissa, as other readers have it. */
#include "base/bytes.h"
#include "image/decode/decode.h"

#include <string.h>

enum { LINE_SIZE = 256, NEW_RUNS_LEAST = 8, NEW_RUNS_MOST = 0x7fff };

typedef struct hdr {
    const burnish_encoded *from;
    burnish_memory *memory;
    const uint8_t *next, *end;
    double scale[3];   /* undoes EXPOSURE and COLORCORR */
    int count, length; /* scan lines, and pixels of each */
    int is_transposed, from_right,
        from_below; /* scan lines are columns; axes run down from the end */
} hdr;

static burnish_status hdr_fail(const hdr *h, const char *what) {
    return burnish_fail(h->memory->error, BURNISH_STATUS_FORMAT, "%.200s: %s", h->from->name, what);
}

/* ---- Header ---- */

/* Reads a line without its newline, and not more of it than fits. Returns 0 at the end of the file. */
static int read_line(hdr *h, char line[LINE_SIZE]) {
    const uint8_t *newline = memchr(h->next, '\n', (size_t)(h->end - h->next));
    if (!newline) {
        return 0;
    }
    size_t size = (size_t)(newline - h->next);
    size = size < LINE_SIZE ? size : LINE_SIZE - 1;
    memcpy(line, h->next, size);
    line[size > 0 && line[size - 1] == '\r' ? size - 1 : size] = 0;
    h->next = newline + 1;
    return 1;
}

/* A positive decimal number with an optional exponent; *text moves past it. 0: not one. */
static double read_number(const char **text) {
    const char *t = *text + strspn(*text, " \t");
    double value = 0, unit = 1;
    int digits = 0, exponent = 0;
    for (; *t >= '0' && *t <= '9' && digits < 30; ++t, ++digits) {
        value = value * 10 + (*t - '0');
    }
    for (t += *t == '.'; *t >= '0' && *t <= '9' && digits < 30; ++t, ++digits) {
        value += (*t - '0') * (unit /= 10);
    }
    if (digits > 0 && (*t == 'e' || *t == 'E')) {
        const int is_negative = t[1] == '-';
        for (t += 1 + (t[1] == '-' || t[1] == '+'); *t >= '0' && *t <= '9'; ++t) {
            exponent = exponent < 100 ? exponent * 10 + (*t - '0') : exponent;
        }
        for (; exponent > 0; --exponent) {
            value = is_negative ? value / 10 : value * 10;
        }
    }
    *text = t;
    return value;
}

static burnish_status read_variable(hdr *h, const char *line) {
    static const char exposure[] = "EXPOSURE=", correction[] = "COLORCORR=", format[] = "FORMAT=";
    if (strncmp(line, format, strlen(format)) == 0) {
        return strcmp(line + strlen(format), "32-bit_rle_rgbe") == 0
                   ? BURNISH_STATUS_OK
                   : hdr_fail(h, "only the format 32-bit_rle_rgbe is supported; convert it");
    }
    const int is_exposure = strncmp(line, exposure, strlen(exposure)) == 0;
    if (!is_exposure && strncmp(line, correction, strlen(correction)) != 0) {
        return BURNISH_STATUS_OK;
    }
    line += strlen(is_exposure ? exposure : correction);
    double value = 0;
    for (int k = 0; k < 3; ++k) {
        value = is_exposure && k > 0 ? value : read_number(&line);
        if (!(value >= 1e-30 && value <= 1e30)) {
            return hdr_fail(h, "EXPOSURE and COLORCORR must be positive numbers");
        }
        h->scale[k] /= value;
    }
    return BURNISH_STATUS_OK;
}

/* "-Y 512 +X 1024": the first axis counts scan lines; Y runs up, so -Y is from the top. */
static int read_size(hdr *h, const char *line) {
    int axes[2], signs[2], sizes[2];
    for (int i = 0; i < 2; ++i) {
        line += strspn(line, " ");
        if ((line[0] != '-' && line[0] != '+') || (line[1] != 'X' && line[1] != 'Y')) {
            return 0;
        }
        signs[i] = line[0];
        axes[i] = line[1];
        line += 2;
        const double size = read_number(&line);
        sizes[i] = size < 1e9 ? (int)size : 1000000000;
    }
    h->count = sizes[0];
    h->length = sizes[1];
    h->is_transposed = axes[0] == 'X';
    h->from_right = signs[!h->is_transposed] == '-';
    h->from_below = signs[h->is_transposed] == '+';
    return axes[0] != axes[1];
}

static burnish_status read_header(hdr *h) {
    char line[LINE_SIZE];
    burnish_status status = BURNISH_STATUS_OK;
    read_line(h, line); /* the signature */
    do {
        if (!read_line(h, line)) {
            return hdr_fail(h, "the header has no end; the file is truncated");
        }
        status = read_variable(h, line);
    } while (line[0] && status == BURNISH_STATUS_OK);
    if (status == BURNISH_STATUS_OK && (!read_line(h, line) || !read_size(h, line))) {
        return hdr_fail(h, "no line such as \"-Y 512 +X 1024\" follows the header");
    }
    return status;
}

/* ---- Scan lines ---- */

/* Four planes of bytes, each in runs. Returns 0 if the data is damaged. */
static int read_new_runs(hdr *h, uint8_t *line) {
    const size_t length = (size_t)h->length;
    h->next += 4;
    for (size_t k = 0; k < 4; ++k) {
        for (size_t i = 0; i < length;) {
            const int is_run = h->end - h->next >= 2 && h->next[0] > 128;
            const size_t count = h->next == h->end ? 0 : is_run ? h->next[0] - 128U : h->next[0];
            if (count == 0 || count > length - i ||
                (size_t)(h->end - h->next) < 1 + (is_run ? 1 : count)) {
                return 0;
            }
            for (size_t j = 0; j < count; ++j, ++i) {
                line[4 * i + k] = h->next[1 + (is_run ? 0 : j)];
            }
            h->next += 1 + (is_run ? 1 : count);
        }
    }
    return 1;
}

/* Pixels; (1, 1, 1, n) repeats the last one n times, several of these n, 256 n, ... times. */
static int read_old_runs(hdr *h, uint8_t *line) {
    const size_t length = (size_t)h->length;
    int shift = 0;
    for (size_t i = 0; i < length;) {
        const uint8_t *p = h->next;
        if (h->end - p < 4) {
            return 0;
        }
        h->next += 4;
        if (p[0] != 1 || p[1] != 1 || p[2] != 1) {
            memcpy(line + 4 * i++, p, 4);
            shift = 0;
            continue;
        }
        const size_t count = shift <= 16 ? (size_t)p[3] << shift : length;
        if (i == 0 || count > length - i) {
            return 0;
        }
        for (size_t j = 0; j < count; ++j, ++i) {
            memcpy(line + 4 * i, line + 4 * (i - 1), 4);
        }
        shift += 8;
    }
    return 1;
}

static int read_scan_line(hdr *h, uint8_t *line) {
    const uint8_t *p = h->next;
    const int is_new = h->length >= NEW_RUNS_LEAST && h->length <= NEW_RUNS_MOST &&
                       h->end - p >= 4 && p[0] == 2 && p[1] == 2 && (p[2] << 8 | p[3]) == h->length;
    return is_new ? read_new_runs(h, line) : read_old_runs(h, line);
}

static void add_scan_line(const hdr *h, int number, const uint8_t *line,
                          const burnish_float_sink *sink) {
    const int width = h->is_transposed ? h->count : h->length;
    const int height = h->is_transposed ? h->length : h->count;
    for (int i = 0; i < h->length; ++i, line += 4) {
        const int x = h->is_transposed ? number : i, y = h->is_transposed ? i : number;
        const uint64_t bits = (uint64_t)(line[3] + 1023 - 136) << 52;
        double unit;
        float rgb[3];
        memcpy(&unit, &bits, sizeof unit);
        for (int k = 0; k < 3; ++k) {
            rgb[k] = line[3] > 0 ? (float)(line[k] * unit * h->scale[k]) : 0.0f;
        }
        sink->add(sink->context, h->from_right ? width - 1 - x : x,
                  h->from_below ? height - 1 - y : y, rgb);
    }
}

burnish_status burnish_decode_hdr(const burnish_encoded *from, burnish_memory *memory,
                                  const burnish_float_sink *sink) {
    hdr h = {.from = from,
             .memory = memory,
             .next = from->bytes,
             .end = from->bytes + from->size,
             .scale = {1, 1, 1}};
    burnish_status status = read_header(&h);
    const uint64_t width = (uint64_t)(h.is_transposed ? h.count : h.length);
    const uint64_t height = (uint64_t)(h.is_transposed ? h.length : h.count);
    if (status == BURNISH_STATUS_OK) {
        status = burnish_decode_check(from, width, height, memory);
    }
    if (status == BURNISH_STATUS_OK) {
        status = sink->begin(sink->context, width, height, 4);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    uint8_t *line = burnish_allocate(memory, (size_t)h.length, 4, from->name);
    status = memory->status;
    for (int i = 0; i < h.count && status == BURNISH_STATUS_OK; ++i) {
        if (read_scan_line(&h, line)) {
            add_scan_line(&h, i, line, sink);
        } else {
            status = burnish_fail(memory->error, BURNISH_STATUS_FORMAT,
                                  "%.200s: scan line %d of %d is damaged, or the file is truncated",
                                  from->name, i + 1, h.count);
        }
    }
    burnish_release(memory->context, line);
    return status;
}
