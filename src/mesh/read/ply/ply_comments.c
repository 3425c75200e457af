/* PLY: comments among the rows of an ASCII body, which the format does not permit. Rows are first
 * read normally. A body that can't be read is searched for comments, and read again from a
 * copy with blanks in their place, which keeps the line numbers. */
#include "mesh/read/ply/ply_rows.h"

#include "mesh/read/ply/ply_header.h"

/* The first words of header lines without meaning, and comments of other programs. */
static int is_comment(const uint8_t *line, const uint8_t *end) {
    static const char *const words[] = {"comment", "obj_info"};
    while (line < end && burnish_is_blank(*line)) {
        ++line;
    }
    for (size_t i = 0; i < sizeof words / sizeof *words; ++i) {
        const size_t size = strlen(words[i]);
        if ((size_t)(end - line) >= size && memcmp(line, words[i], size) == 0 &&
            (line + size == end || burnish_is_blank(line[size]))) {
            return 1;
        }
    }
    return line < end && *line == '#';
}

/* The next comment from a line's start on; `end`: there is none. *last receives its end. */
static const uint8_t *find_comment(const uint8_t *line, const uint8_t *end, const uint8_t **last) {
    while (line < end) {
        *last = burnish_ply_line_end(line, end);
        if (is_comment(line, *last)) {
            return line;
        }
        line = *last + (*last < end);
    }
    return end;
}

/* Moves the start of the body, and the elements' lines for messages, to another copy of the input.
 */
static void move_header(burnish_ply_header *header, const uint8_t *from, const uint8_t *to) {
    for (size_t i = 0; i < header->element_count; ++i) {
        header->elements[i].at = to + (header->elements[i].at - from);
    }
    header->body = to + (header->body - from);
}

static void give_input(burnish_ply_state *ply, const burnish_reader_input *input) {
    move_header(&ply->header, ply->reader->input->bytes, input->bytes);
    ply->reader->input = input;
    ply->reader->counted = NULL;
}

burnish_status burnish_ply_hide_comments(burnish_ply_state *ply, int *any) {
    burnish_reader *reader = ply->reader;
    const burnish_reader_input *input = reader->input;
    const uint8_t *end = input->bytes + input->size, *last = end;
    const uint8_t *at = find_comment(ply->header.body, end, &last);
    *any = at < end;
    if (!*any) {
        return BURNISH_STATUS_OK;
    }
    uint8_t *copy =
        burnish_allocate(&reader->mesh->memory, input->size, 1, "the file without comments");
    if (!copy) {
        return reader->mesh->memory.status;
    }
    memcpy(copy, input->bytes, input->size);
    for (; at < end; at = find_comment(last, end, &last)) {
        burnish_reader_note(reader, &ply->comments, at, "a comment among the rows was ignored");
        memset(copy + (at - input->bytes), ' ', (size_t)(last - at));
    }
    ply->with_comments = input;
    ply->without = *input;
    ply->without.bytes = copy;
    give_input(ply, &ply->without);
    return BURNISH_STATUS_OK;
}

void burnish_ply_show_comments(burnish_ply_state *ply) {
    if (!ply->with_comments) {
        return;
    }
    give_input(ply, ply->with_comments);
    burnish_release(ply->reader->mesh->memory.context, (void *)(uintptr_t)ply->without.bytes);
    ply->with_comments = NULL;
}
