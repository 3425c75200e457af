/* Text without libc's formats, which would use the locale. */
#include "image/text/writer.h"

#include <string.h>

void burnish_put(burnish_text_writer *w, const char *text, size_t size) {
    w->text =
        burnish_reserve(&w->memory, w->text, &w->capacity, w->size + size + 1, 1, "a drawing");
    if (w->memory.status == BURNISH_STATUS_OK) {
        memcpy(w->text + w->size, text, size);
        w->size += size;
        w->text[w->size] = 0;
    }
}

void burnish_put_text(burnish_text_writer *w, const char *text) {
    burnish_put(w, text, strlen(text));
}

void burnish_put_decimal(burnish_text_writer *w, int64_t value, int digits, int needs_blank) {
    char text[32];
    uint64_t rest = value < 0 ? 0u - (uint64_t)value : (uint64_t)value;
    int at = (int)sizeof text, is_fraction = 0;
    for (int i = 0; i < digits; ++i, rest /= 10) {
        is_fraction |= rest % 10 != 0;
        if (is_fraction) {
            text[--at] = (char)('0' + rest % 10);
        }
    }
    if (is_fraction) {
        text[--at] = '.';
    }
    for (; rest > 0 || at == (int)sizeof text; rest /= 10) {
        text[--at] = (char)('0' + rest % 10);
    }
    if (value < 0) {
        text[--at] = '-';
    } else if (needs_blank) {
        text[--at] = ' ';
    }
    burnish_put(w, text + at, sizeof text - (size_t)at);
}

void burnish_put_number(burnish_text_writer *w, const char *before, int32_t hundredths,
                        const char *after) {
    burnish_put_text(w, before);
    burnish_put_decimal(w, hundredths, 2, 0);
    burnish_put_text(w, after);
}

int32_t burnish_to_hundredths(float value) {
    const double scaled = (double)value * 100, most = 1e9;
    const double kept = scaled > -most ? scaled < most ? scaled : most : -most;
    return (int32_t)(kept < 0 ? kept - 0.5 : kept + 0.5);
}
