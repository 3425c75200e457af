/* Points as lines of numbers: XYZ, PTS, ASC and CSV, which no specification describes. x, y and z come
 * first, unless a line of names above says otherwise; then an intensity, a colour, a normal, as the
 * values suggest. Blanks, commas or semicolons separate them. Lines above the first row, such as the
 * count of PTS, are ignored. */
#include "mesh/read/cloud/separators.h"
#include "mesh/read/io/streaming.h"
#include "mesh/read/ply/ply_header.h"

enum {
    COLUMNS = 32,
    HEADER_LINES = 64, /* that may come before the first row */
    SAMPLE_ROWS = 1024
};

/* The values of a column in the first rows. */
typedef struct xyz_column {
    burnish_token name;
    int is_whole;
    double low, high;
    size_t units; /* rows in which it begins a vector of length 1 */
    burnish_ply_role role;
} xyz_column;

typedef struct xyz_file {
    burnish_reader *reader;
    xyz_column columns[COLUMNS];
    size_t column_count, rows;
    int has_names, has_other; /* other: a row with other columns than the first */
    const uint8_t *first;     /* row */
    burnish_ply_header header;
    burnish_reader_input blank; /* with blanks for separators */
} xyz_file;

/* ---- Separators ---- */

/* The separator of a line that is not a blank; 0: none. A comma within numbers that blanks separate
 * is a decimal one. */
static uint8_t separator_of(const burnish_token line) {
    const uint8_t *p = line.bytes, *end = p + line.size;
    size_t inner = 0, commas = 0;
    int words = 1;
    for (; p < end; ++p) {
        if (*p == ';') {
            return ';';
        }
        words += burnish_is_blank(*p) && !burnish_is_blank(p[-1]);
        commas += *p == ',';
        inner += *p == ',' && p + 1 < end && !burnish_is_blank(p[1]);
    }
    return commas == 0 || (words >= 3 && inner == commas && commas <= (size_t)words) ? 0 : ',';
}

/* A line that may be a row or names. */
static burnish_token next_row(burnish_lexer *lexer) {
    burnish_lexer_skip_blank_lines(lexer);
    return burnish_lexer_rest(lexer);
}

static uint8_t find_separator(const uint8_t *bytes, size_t size) {
    burnish_lexer lexer = burnish_lexer_open(bytes, size, 0);
    uint8_t separator = 0;
    for (int i = 0; i < HEADER_LINES && !separator && lexer.next < lexer.end; ++i) {
        const burnish_token line = next_row(&lexer);
        const uint8_t c = line.size > 0 ? *line.bytes : 0;
        separator = (c >= '0' && c <= '9') || c == '-' || c == '.' ? separator_of(line) : 0;
    }
    return separator;
}

/* Separator 0: none. */
static void copy_blank(const uint8_t *bytes, size_t size, uint8_t separator, uint8_t *copy) {
    for (size_t i = 0; i < size; ++i) {
        const int is_blank = separator && (bytes[i] == separator || bytes[i] == '"');
        copy[i] = is_blank ? ' ' : bytes[i];
    }
}

burnish_status burnish_blank_separators(burnish_reader *reader, size_t at,
                                        burnish_reader_input *blank) {
    const uint8_t separator =
        find_separator(reader->input->bytes + at, burnish_reader_head(reader) - at);
    if (!separator) {
        return BURNISH_STATUS_OK;
    }
    if (reader->input->streamed) {
        return burnish_stop_streaming(reader);
    }
    uint8_t *copy =
        burnish_allocate(&reader->mesh->memory, reader->input->size, 1, "a copy of the file");
    if (!copy) {
        return reader->mesh->memory.status;
    }
    copy_blank(reader->input->bytes, reader->input->size, separator, copy);
    *blank = *reader->input;
    blank->bytes = copy;
    reader->input = blank;
    return BURNISH_STATUS_OK;
}

/* ---- Columns ---- */

/* The numbers of a line; NaN for other words. Returns how many there are, and *count of words. */
static size_t read_numbers(burnish_token line, double values[COLUMNS], int whole[COLUMNS],
                           size_t *count) {
    *count = 0;
    if (line.size == 0) {
        return 0;
    }
    burnish_lexer lexer = {line.bytes, line.bytes + line.size, 0};
    burnish_token word;
    burnish_number_status number;
    size_t numbers = 0;
    while (*count < COLUMNS && burnish_lexer_double(&lexer, &word, &values[*count], &number)) {
        const int is_number = number == BURNISH_NUMBER_OK || number == BURNISH_NUMBER_ODD ||
                              number == BURNISH_NUMBER_NOT_FINITE;
        if (!is_number || number == BURNISH_NUMBER_NOT_FINITE) {
            values[*count] = __builtin_nan("");
        }
        whole[*count] = !memchr(word.bytes, '.', word.size);
        numbers += (size_t)is_number;
        ++*count;
    }
    return numbers;
}

/* The words of a line above the rows as names of columns, if they are as many and x, y and z among
 * them. */
static void take_names(xyz_file *xyz, burnish_token line) {
    xyz->has_names = 0;
    while (line.size > 0 && (*line.bytes == '#' || *line.bytes == '/')) {
        ++line.bytes;
        --line.size;
    }
    if (line.size == 0) {
        return;
    }
    burnish_lexer lexer = {line.bytes, line.bytes + line.size, 0};
    burnish_token names[COLUMNS], word;
    unsigned roles = 0;
    size_t count = 0;
    for (; burnish_lexer_token(&lexer, &word); ++count) {
        if (count == xyz->column_count) {
            return;
        }
        names[count] = word;
        roles |= 1u << burnish_ply_role_of(word);
    }
    xyz->has_names = count == xyz->column_count && (roles & 7) == 7;
    for (size_t i = 0; i < count && xyz->has_names; ++i) {
        xyz->columns[i].name = names[i];
    }
}

static void add_row(xyz_file *xyz, const double values[COLUMNS], const int whole[COLUMNS]) {
    for (size_t i = 0; i < xyz->column_count; ++i) {
        xyz_column *column = &xyz->columns[i];
        column->low = xyz->rows == 0 || !(column->low <= values[i]) ? values[i] : column->low;
        column->high = xyz->rows == 0 || !(column->high >= values[i]) ? values[i] : column->high;
        column->is_whole = (xyz->rows == 0 || column->is_whole) && whole[i];
        if (i + 2 < xyz->column_count) {
            const double length = values[i] * values[i] + values[i + 1] * values[i + 1] +
                                  values[i + 2] * values[i + 2];
            column->units += length > 0.98 && length < 1.02;
        }
    }
    ++xyz->rows;
}

/* Finds the first row, and looks at it and those that follow. 0: there is none. */
static int take_xyz_sample(xyz_file *xyz, const uint8_t *bytes, size_t size) {
    burnish_lexer lexer = burnish_lexer_open(bytes, size, 0);
    burnish_token line, above = {lexer.next, 0};
    double values[COLUMNS];
    int whole[COLUMNS];
    size_t count;
    for (int i = 0; i < HEADER_LINES && xyz->rows == 0; ++i) {
        line = next_row(&lexer);
        const size_t numbers = read_numbers(line, values, whole, &count);
        if (line.size == 0) {
            return 0;
        }
        xyz->column_count = count;
        if (numbers >= 3 && *line.bytes != '#') {
            take_names(xyz, above);
            if (xyz->has_names || (values[0] == values[0] && values[1] == values[1])) {
                xyz->first = line.bytes;
                add_row(xyz, values, whole);
            }
        }
        above = line;
    }
    while (xyz->rows > 0 && xyz->rows < SAMPLE_ROWS && lexer.next < lexer.end) {
        line = next_row(&lexer);
        read_numbers(line, values, whole, &count);
        if (count == xyz->column_count && lexer.next < lexer.end) {
            add_row(xyz, values, whole);
        } else if (line.size > 0 && *line.bytes != '#' && *line.bytes != '/' &&
                   lexer.next < lexer.end) {
            xyz->has_other = 1;
            break;
        }
    }
    return xyz->rows > 0;
}

/* Whether three columns may be a colour, or a normal. */
static int are_xyz_colors(const xyz_file *xyz, size_t i) {
    const xyz_column *c = &xyz->columns[i];
    int are_bytes = 1, are_shares = 1;
    for (int k = 0; k < 3 && i + 2 < xyz->column_count; ++k) {
        are_bytes &= c[k].low >= 0 && c[k].high <= 255 && c[k].is_whole;
        are_shares &= c[k].low >= 0 && c[k].high <= 1 && !c[k].is_whole;
    }
    return i + 2 < xyz->column_count && (are_bytes || are_shares);
}

static int are_xyz_normals(const xyz_file *xyz, size_t i) {
    const xyz_column *c = &xyz->columns[i];
    return i + 2 < xyz->column_count && 10 * c[0].units >= 9 * xyz->rows &&
           !(c[0].is_whole && c[1].is_whole && c[2].is_whole && c[0].low >= 0 && c[1].low >= 0);
}

/* Roles of columns without names. */
static void guess_roles(xyz_file *xyz) {
    int has_scalar = 0, has_normals = 0, has_colors = 0;
    for (size_t i = 0; i < xyz->column_count;) {
        const size_t left = xyz->column_count - i;
        const int is_position = i == 0;
        const int is_normal = !is_position && !has_normals && are_xyz_normals(xyz, i);
        const int is_color = !is_position && !has_colors && !is_normal && are_xyz_colors(xyz, i) &&
                             !(left % 3 == 1 && are_xyz_colors(xyz, i + 1));
        const burnish_ply_role first = is_position                   ? BURNISH_PLY_X
                                       : is_normal                   ? BURNISH_PLY_NX
                                       : is_color                    ? BURNISH_PLY_RED
                                       : has_scalar || left % 3 != 1 ? BURNISH_PLY_OTHER
                                                                     : BURNISH_PLY_S;
        const size_t size = is_position || is_normal || is_color ? 3 : 1;
        for (size_t k = 0; k < size; ++k, ++i) {
            xyz->columns[i].role = size == 3 ? (burnish_ply_role)(first + k) : first;
        }
        has_scalar |= first == BURNISH_PLY_S;
        has_normals |= is_normal;
        has_colors |= is_color;
    }
}

static burnish_ply_role role_of_named(burnish_token name) {
    const burnish_ply_role role = burnish_ply_role_of(name);
    return burnish_token_is_caseless(name, "intensity") ||
                   burnish_token_is_caseless(name, "reflectance")
               ? BURNISH_PLY_S
           : role >= BURNISH_PLY_ALPHA && role <= BURNISH_PLY_T ? BURNISH_PLY_OTHER
                                                                : role;
}

static burnish_status describe_columns(xyz_file *xyz) {
    static const char *const names[] = {"x",   "y",     "z",    "nx",    "ny",       "nz",
                                        "red", "green", "blue", "alpha", "intensity"};
    burnish_status status =
        burnish_ply_add_element(xyz->reader, &xyz->header,
                                (burnish_ply_element){.name = {(const uint8_t *)"points", 6},
                                                      .kind = BURNISH_PLY_ELEMENT_VERTEX,
                                                      .count = SIZE_MAX,
                                                      .at = xyz->first});
    unsigned roles = 0;
    if (!xyz->has_names) {
        guess_roles(xyz);
    }
    for (size_t i = 0; i < xyz->column_count && status == BURNISH_STATUS_OK; ++i) {
        xyz_column *column = &xyz->columns[i];
        column->role = xyz->has_names ? role_of_named(column->name) : column->role;
        if (column->role != BURNISH_PLY_OTHER && roles >> column->role & 1) {
            column->role = BURNISH_PLY_OTHER; /* a name that is there twice */
        }
        roles |= 1u << column->role;
        if (!xyz->has_names) {
            const char *name = column->role < BURNISH_PLY_T ? names[column->role] : "";
            column->name = (burnish_token){(const uint8_t *)name, strlen(name)};
        }
        const burnish_ply_type type =
            column->role < BURNISH_PLY_RED || column->role > BURNISH_PLY_BLUE || column->high <= 1
                ? BURNISH_PLY_FLOAT32
            : column->high <= 255 ? BURNISH_PLY_UINT8
                                  : BURNISH_PLY_UINT16;
        status = burnish_ply_add_property(
            xyz->reader, &xyz->header,
            (burnish_ply_property){.type = type, .role = column->role, .name = column->name});
    }
    xyz->header.tint = roles >> BURNISH_PLY_S & 1 && !(roles >> BURNISH_PLY_RED & 1)
                           ? BURNISH_PLY_GREY
                           : BURNISH_PLY_NO_TINT;
    return status;
}

/* ---- All ---- */

static burnish_status xyz_read(burnish_reader *reader) {
    const burnish_reader_input *input = reader->input;
    const size_t head = burnish_reader_head(reader);
    xyz_file xyz = {.reader = reader};
    burnish_status status = burnish_blank_separators(reader, 0, &xyz.blank);
    if (status == BURNISH_STATUS_OK && !take_xyz_sample(&xyz, reader->input->bytes, head)) {
        status = burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, reader->input->bytes,
                                     "no line begins with three numbers, x, y and z; if it is a "
                                     "list of atoms, convert it with a program of chemistry");
    }
    if (status == BURNISH_STATUS_OK) {
        xyz.header.is_open = 1;
        xyz.header.body = xyz.first;
        status = describe_columns(&xyz);
    }
    status = burnish_ply_read_described(reader, &xyz.header, status);
    reader->input = input;
    reader->counted = NULL;
    burnish_release(reader->mesh->memory.context, (void *)(uintptr_t)xyz.blank.bytes);
    return status;
}

/* Lines of numbers, three or more of them, as many in each. */
static int xyz_recognise(const uint8_t *bytes, size_t size) {
    enum { LOOKED_AT = 4096, LEAST_ROWS = 2 };
    xyz_file xyz = {.rows = 0};
    uint8_t copy[LOOKED_AT];
    const size_t looked_at = size < LOOKED_AT ? size : LOOKED_AT;
    copy_blank(bytes, looked_at, find_separator(bytes, looked_at), copy);
    return take_xyz_sample(&xyz, copy, looked_at) && xyz.rows >= LEAST_ROWS && !xyz.has_other;
}

const burnish_format_reader burnish_reader_xyz = {
    .recognise = xyz_recognise, .read = xyz_read, .can_stream = 1};
