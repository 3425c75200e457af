/* Messages with a location in the input. They are separate from the table of formats, so programs
 * that use only some reader functions do not link every format. */
#include "mesh/read/io/reader.h"

#include <stdarg.h>
#include <stdio.h>

#include "mesh/read/io/streaming.h"

enum { MESSAGE_SIZE = 300, LINE_SIZE = MESSAGE_SIZE + sizeof(burnish_shown_name) + 64 };

/* Counted from 1, starting at the last message's line if that is not after it. */
static size_t line_at(burnish_reader *reader, const uint8_t *at) {
    const uint8_t *first = reader->input->bytes;
    if (at > first && at == first + reader->input->size) { /* of the last line */
        at -= at[-1] == '\n';
        at -= at > first && at[-1] == '\r';
    }
    if (!reader->counted || at < reader->counted) {
        reader->counted = first;
        reader->line = 1;
    }
    reader->line += burnish_count_lines(reader->counted, at);
    reader->counted = at;
    return reader->line;
}

/* "NAME:LINE: message" into out. A long name loses its beginning to make room for the message. */
static void write_line(char *out, burnish_reader *reader, const uint8_t *at, const char *format,
                       va_list arguments) {
    char message[MESSAGE_SIZE];
    burnish_shown_name name = burnish_show_name(reader->input->name);
    vsnprintf(message, sizeof message, format, arguments);
    if (!at) {
        snprintf(out, LINE_SIZE, "%s: %s", name.text, message);
    } else if (reader->is_binary) {
        snprintf(out, LINE_SIZE, "%s: byte %zu: %s", name.text, (size_t)(at - reader->input->bytes),
                 message);
    } else {
        snprintf(out, LINE_SIZE, "%s:%zu: %s", name.text, line_at(reader, at), message);
    }
}

burnish_status burnish_reader_fail(burnish_reader *reader, burnish_status status, const uint8_t *at,
                                   const char *format, ...) {
    char line[LINE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    write_line(line, reader, reader->input->streamed ? NULL : at, format, arguments);
    va_end(arguments);
    return burnish_fail(reader->error, status, "%s", line);
}

void burnish_reader_warn(burnish_reader *reader, const uint8_t *at, const char *format, ...) {
    char line[LINE_SIZE];
    va_list arguments;
    if (reader->input->streamed) {
        reader->has_warned = 1;
        return;
    }
    va_start(arguments, format);
    write_line(line, reader, at, format, arguments);
    va_end(arguments);
    burnish_mesh_data_warn(reader->mesh, "%s", line);
}

void burnish_reader_note(burnish_reader *reader, burnish_warning_group *group, const uint8_t *at,
                         const char *format, ...) {
    if (reader->input->streamed) {
        reader->has_warned = 1;
    } else if (group->count++ == 0) {
        char line[LINE_SIZE];
        va_list arguments;
        va_start(arguments, format);
        write_line(line, reader, at, format, arguments);
        va_end(arguments);
        burnish_fail(&group->first, BURNISH_STATUS_OK, "%s", line);
    }
}

void burnish_reader_warn_group(burnish_reader *reader, const burnish_warning_group *group) {
    if (group->count == 1) {
        burnish_mesh_data_warn(reader->mesh, "%s", group->first.text);
    } else if (group->count > 1) {
        burnish_mesh_data_warn(reader->mesh, "%s (and %zu more like it)", group->first.text,
                               group->count - 1);
    }
}

burnish_number_text burnish_describe_number(const char *what, burnish_token token,
                                            burnish_number_status status) {
    burnish_number_text text;
    static const char *const advice[] = {
        [BURNISH_NUMBER_OK] = "is out of place",
        [BURNISH_NUMBER_GARBAGE] = "is not a number; write it like 1.5 or -2e-3",
        [BURNISH_NUMBER_ODD] = "has an unusual form; write it like 1.5 or -2e-3",
        [BURNISH_NUMBER_NOT_FINITE] = "is not finite; repair or remove it",
        [BURNISH_NUMBER_RANGE] = "is out of range; scale it to below 3.4e38"};
    snprintf(text.text, sizeof text.text, "%s \"%s\" %s", what, burnish_token_quote(token).text,
             advice[status]);
    return text;
}

burnish_status burnish_fail_triangles(burnish_reader *reader, const uint8_t *at) {
    const uint64_t limit = reader->input->options->max_triangles;
    return burnish_reader_fail(
        reader, BURNISH_STATUS_LIMIT, at, "more than %llu triangles; %s", (unsigned long long)limit,
        limit < BURNISH_TRIANGLES_MAX ? "raise the limit or simplify the mesh"
                                      : "split or simplify the mesh");
}
