/* Text in chunks: cut, parse in parallel, accept in the order of the file, append in parallel. */
#include "mesh/read/io/parallel_text.h"

#include "mesh/read/io/budget.h"
#include "mesh/read/io/streaming.h"

#include <string.h>

enum { CHUNKS_PER_THREAD = 4 /* in a wave: enough to keep threads busy until the slowest ends */ };

/* A chunk that refers to values that may follow it in the file. */
typedef struct forward_chunk {
    const uint8_t *first, *end;
    size_t before[BURNISH_ATTRIBUTE_COUNT], highest[BURNISH_ATTRIBUTE_COUNT];
    size_t damage, damage_before; /* noted in it, and before it, so far */
} forward_chunk;

typedef struct chunk_driver {
    const burnish_grammar *grammar;
    void *state;
    burnish_reader *reader;
    burnish_chunk *chunks; /* of one wave; their arrays are used again by the next */
    size_t most;           /* of them */
    size_t chunk_size;     /* bytes */
    int alone;             /* 1: statements cross the starts that were found, so one at a time */
    burnish_window
        window; /* over a streamed file: the bytes from next to text_end; otherwise all 0 */
    const uint8_t *next, *text_end;
    size_t rows_left, rows_done, bytes_done, wave_rows;
    forward_chunk *forward;
    size_t forward_count, forward_capacity;
} chunk_driver;

/* ---- Parsing ---- */

/* As if nothing had been read; arrays are kept. */
static void reset_chunk(burnish_chunk *chunk) {
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        chunk->data.streams[i].count = 0;
        chunk->relative[i].count = 0;
        chunk->highest[i] = chunk->back[i] = chunk->before[i] = 0;
        chunk->total[i] = SIZE_MAX;
    }
    chunk->data.triangle_count = chunk->polygon_count = chunk->event_count = 0;
    chunk->triangles_before = chunk->rows_before = chunk->rows = 0;
    chunk->used = 0;
    chunk->is_odd = 0;
    chunk->odd_count = 0;
    chunk->status = chunk->data.memory.status = BURNISH_STATUS_OK;
    chunk->exact = NULL;
}

const uint8_t *burnish_chunk_find_line(const uint8_t *from, const uint8_t *end) {
    const uint8_t *newline = memchr(from, '\n', (size_t)(end - from));
    return newline ? newline + 1 : end;
}

static void parse_task(void *user_data, size_t index, int thread) {
    chunk_driver *driver = user_data;
    (void)thread;
    driver->grammar->parse(driver->state, &driver->chunks[index]);
}

/* ---- The text ---- */

/* The offset of a byte of the text in the input. */
static size_t offset_of(const chunk_driver *driver, const uint8_t *at) {
    return driver->window.bytes ? driver->window.offset + (size_t)(at - driver->window.bytes)
                                : (size_t)(at - driver->reader->input->bytes);
}

static size_t bytes_left(const chunk_driver *driver) {
    return driver->reader->input->size - offset_of(driver, driver->next);
}

/* Whether the text ends with the input. */
static int ends_input(const chunk_driver *driver) {
    return offset_of(driver, driver->text_end) == driver->reader->input->size;
}

/* Bytes of a wave, and bytes after it that are examined to find its end. */
static size_t wave_size(const chunk_driver *driver) {
    enum { LONGEST = BURNISH_STREAMED_HEAD }; /* statement, or lines without a start */
    return driver->most * driver->chunk_size + LONGEST;
}

/* Moves the window to the next wave. Returns 0 if the file can't be read. */
static int move_window(chunk_driver *driver) {
    if (ends_input(driver) || (size_t)(driver->text_end - driver->next) >= wave_size(driver)) {
        return 1;
    }
    const int good = burnish_window_move(&driver->window, offset_of(driver, driver->next));
    driver->next = driver->window.bytes;
    driver->text_end = driver->window.bytes + driver->window.size;
    return good;
}

static burnish_status open_window(chunk_driver *driver, const uint8_t *at) {
    const size_t more = driver->most > 3 ? driver->most : 3;
    burnish_window *window = &driver->window;
    window->input = driver->reader->input;
    window->offset = (size_t)(at - window->input->bytes);
    window->capacity = wave_size(driver) + more * driver->chunk_size;
    window->bytes =
        burnish_allocate(&driver->reader->mesh->memory, window->capacity, 1, "a piece of the file");
    driver->next = driver->text_end = window->bytes;
    return driver->reader->mesh->memory.status;
}

/* ---- Cutting ---- */

/* How many bytes may be read ahead. If rows are counted, no more than they are likely to fill,
 * since something else follows them. */
static size_t read_ahead(const chunk_driver *driver) {
    if (driver->alone || driver->most == 1) {
        return 0;
    }
    if (driver->rows_left == SIZE_MAX) {
        return SIZE_MAX;
    }
    const double row =
        driver->rows_done ? (double)driver->bytes_done / (double)driver->rows_done : 0;
    const double bytes = row * (double)driver->rows_left;
    return bytes < 1e15 ? (size_t)bytes : SIZE_MAX;
}

/* The chunks of the next wave. */
static size_t cut_wave(chunk_driver *driver) {
    const uint8_t *first = driver->next, *end = driver->text_end;
    const size_t ahead = read_ahead(driver), size = driver->chunk_size;
    const int is_last = ends_input(driver);
    const int bounded = driver->grammar->find_start && (ahead > size || driver->window.bytes);
    const size_t most = bounded && ahead > size ? driver->most : 1;
    size_t count = 0;
    while (count < most && first < end && (size_t)(first - driver->next) <= ahead &&
           (is_last || (size_t)(end - first) > size)) {
        burnish_chunk *chunk = &driver->chunks[count];
        reset_chunk(chunk);
        chunk->first = first;
        chunk->is_first = count == 0 && driver->bytes_done == 0;
        chunk->text_end = end;
        chunk->bounded = bounded;
        chunk->rows_left = driver->rows_left;
        chunk->end = (size_t)(end - first) <= size ? end
                     : bounded ? driver->grammar->find_start(first + size - 1, end)
                               : first + size;
        if (chunk->end == end && !is_last) { /* the next start is beyond the window */
            break;
        }
        first = chunk->cut = chunk->end;
        ++count;
    }
    return count;
}

/* ---- Accepting ---- */

/* all: the streams of the whole file, or NULL when not all of it was read. */
static burnish_status parse_exactly(chunk_driver *driver, burnish_chunk *chunk,
                                    const forward_chunk *known, const burnish_stream *all) {
    reset_chunk(chunk);
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT && all; ++i) {
        chunk->total[i] = all[i].count;
    }
    memcpy(chunk->before, known->before, sizeof chunk->before);
    chunk->first = known->first;
    chunk->is_first = driver->bytes_done == 0;
    chunk->end = known->end;
    chunk->triangles_before = all ? 0 : driver->reader->mesh->triangle_count;
    chunk->rows_before = driver->rows_done;
    chunk->rows_left = driver->rows_left;
    chunk->bounded = 0;
    chunk->exact = driver->reader;
    chunk->data.memory.error = driver->reader->error;
    driver->grammar->parse(driver->state, chunk);
    chunk->data.memory.error = &chunk->error;
    return chunk->status;
}

/* If earlier chunks had fewer rows left, this chunk may have read other data as rows. */
static void parse_fewer(const chunk_driver *driver, burnish_chunk *chunk) {
    if (chunk->rows_left > driver->rows_left && chunk->rows >= driver->rows_left) {
        reset_chunk(chunk);
        chunk->rows_left = driver->rows_left;
        chunk->end = chunk->cut;
        driver->grammar->parse(driver->state, chunk);
    }
}

/* Whether the indices that were read refer to existing values. */
static int is_in_order(const chunk_driver *driver, const burnish_chunk *chunk,
                       const forward_chunk *known) {
    int good = chunk->status == BURNISH_STATUS_OK && chunk->rows <= driver->rows_left &&
               chunk->data.triangle_count + driver->reader->mesh->triangle_count <=
                   driver->reader->input->options->max_triangles;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        good &= (driver->grammar->lenient >> i & 1) || chunk->back[i] <= known->before[i];
    }
    return good;
}

/* Records a chunk that refers to values not read yet. */
static burnish_status note_forward(chunk_driver *driver, const burnish_chunk *chunk,
                                   const forward_chunk *known) {
    int forward = 0;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        forward |= !(driver->grammar->lenient >> i & 1) &&
                   chunk->highest[i] > known->before[i] + chunk->data.streams[i].count;
    }
    if (forward) {
        burnish_memory *memory = &driver->reader->mesh->memory;
        driver->forward =
            burnish_reserve(memory, driver->forward, &driver->forward_capacity,
                            driver->forward_count + 1, sizeof *driver->forward, "statements");
        if (memory->status != BURNISH_STATUS_OK) {
            return memory->status;
        }
        driver->forward[driver->forward_count] = *known;
        memcpy(driver->forward[driver->forward_count++].highest, chunk->highest,
               sizeof chunk->highest);
    }
    return BURNISH_STATUS_OK;
}

/* Events before the error of a chunk come first: an error in a material library is then the file's
 * first error, wherever chunks end. */
static burnish_status accept_before_error(chunk_driver *driver, const burnish_chunk *chunk,
                                          burnish_status status) {
    burnish_error *error = driver->reader->error;
    const burnish_error found = error ? *error : (burnish_error){0};
    const burnish_status before =
        driver->grammar->accept ? driver->grammar->accept(driver->state, chunk) : BURNISH_STATUS_OK;
    if (before == BURNISH_STATUS_OK && error) {
        *error = found;
    }
    return before == BURNISH_STATUS_OK ? status : before;
}

/* Accepts a chunk, except for copying it; *more becomes 0 if the wave ends with it. */
static burnish_status accept_chunk(chunk_driver *driver, burnish_chunk *chunk, int *more) {
    burnish_mesh_data *mesh = driver->reader->mesh;
    forward_chunk known = {
        .first = chunk->first, .end = chunk->cut, .damage_before = driver->reader->damage.count};
    burnish_status status = BURNISH_STATUS_OK;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        known.before[i] = mesh->streams[i].count;
    }
    parse_fewer(driver, chunk);
    if (driver->window.bytes && (!is_in_order(driver, chunk, &known) || chunk->end != chunk->cut)) {
        return burnish_stop_streaming(driver->reader);
    }
    if (!is_in_order(driver, chunk, &known)) {
        status = parse_exactly(driver, chunk, &known, NULL);
        driver->alone = 1; /* no error, so a statement that crosses the end */
        *more = 0;
        if (status != BURNISH_STATUS_OK) {
            return accept_before_error(driver, chunk, status);
        }
    }
    known.damage = driver->reader->damage.count - known.damage_before;
    if (status == BURNISH_STATUS_OK) {
        status = note_forward(driver, chunk, &known);
    }
    memcpy(chunk->before, known.before, sizeof chunk->before);
    chunk->triangles_before = mesh->triangle_count;
    chunk->rows_before = driver->rows_done;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT && status == BURNISH_STATUS_OK; ++i) {
        if (chunk->data.streams[i].count > BURNISH_VALUE_LIMIT - known.before[i]) {
            status =
                burnish_reader_fail(driver->reader, BURNISH_STATUS_LIMIT, chunk->first,
                                    "more than %zu values; split the mesh", BURNISH_VALUE_LIMIT);
        }
    }
    if (status == BURNISH_STATUS_OK) {
        status = burnish_budget_check(driver->reader,
                                      mesh->streams[BURNISH_POSITION].count +
                                          chunk->data.streams[BURNISH_POSITION].count,
                                      mesh->triangle_count + chunk->data.triangle_count);
    }
    if (status == BURNISH_STATUS_OK && chunk->odd_count > 0) {
        burnish_reader_note(driver->reader, &driver->reader->odd, chunk->odd.bytes,
                            "\"%s\" has an unusual form; it was read",
                            burnish_token_quote(chunk->odd).text);
        driver->reader->odd.count += chunk->odd_count - 1;
    }
    if (status == BURNISH_STATUS_OK && driver->grammar->accept) {
        status = driver->grammar->accept(driver->state, chunk);
    }
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        mesh->streams[i].count += chunk->data.streams[i].count;
    }
    mesh->triangle_count += chunk->data.triangle_count;
    driver->rows_done += chunk->rows;
    driver->rows_left -= driver->rows_left == SIZE_MAX ? 0 : chunk->rows;
    driver->bytes_done += (size_t)(chunk->end - chunk->first);
    driver->next = driver->rows_left > 0 ? chunk->end : chunk->rows_end;
    *more &= driver->rows_left > 0;
    return status;
}

/* ---- Appending ---- */

/* The default of a missing value: white, or 0. */
static void fill_values(burnish_stream *stream, burnish_attribute attribute, size_t first,
                        size_t count) {
    const size_t size = burnish_attribute_size(attribute);
    memset((char *)stream->items + size * first, attribute == BURNISH_COLOR ? 0xFF : 0,
           size * count);
}

/* Capacity for `needed` items, of which there were `before` the wave. If it must grow, as much as
 * there will be if the file goes on like this, but no more than `most`: then arrays hardly ever
 * move. `left`: waves. */
static size_t expected_capacity(size_t needed, size_t capacity, size_t before, double left,
                                uint64_t most) {
    const double all = (double)needed + (double)(needed - before) * left;
    const double fair = all < (double)most ? all : (double)most;
    return needed <= capacity || !(fair > (double)needed) ? needed : (size_t)fair;
}

/* Room in the mesh for what a wave of chunks holds. */
static burnish_status reserve_wave(chunk_driver *driver, size_t count,
                                   const size_t before[BURNISH_ATTRIBUTE_COUNT],
                                   size_t triangles_before) {
    burnish_mesh_data *mesh = driver->reader->mesh;
    const uint64_t budget = burnish_budget_triangles(driver->reader), /* limits vertices as well */
        room = burnish_budget_room(driver->reader->input), most = budget < room ? budget : room;
    const double bytes = (double)(driver->next - driver->chunks[0].first);
    double left = (double)bytes_left(driver) / (bytes > 0 ? bytes : 1);
    if (driver->wave_rows > 0 && (double)driver->rows_left < left * (double)driver->wave_rows) {
        left = (double)driver->rows_left / (double)driver->wave_rows;
    }
    unsigned used = 0;
    size_t polygons = driver->reader->polygon_count;
    for (size_t i = 0; i < count; ++i) {
        used |= driver->chunks[i].used;
        polygons += driver->chunks[i].polygon_count;
    }
    const size_t positions = mesh->streams[BURNISH_POSITION].count;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        burnish_stream *stream = &mesh->streams[i];
        const int per_position = stream->count > 0 && !(driver->grammar->indexed >> i & 1);
        const int new_corners = (used >> i & 1) && !stream->corners;
        if (per_position && stream->count < positions) {
            stream->count = positions;
        }
        stream->items = burnish_reserve(
            &mesh->memory, stream->items, &stream->capacity,
            expected_capacity(stream->count, stream->capacity, before[i], left, most),
            burnish_attribute_size((burnish_attribute)i), "values");
        if (stream->corners || new_corners) {
            stream->corners =
                burnish_reserve(&mesh->memory, stream->corners, &stream->corner_capacity,
                                expected_capacity(mesh->triangle_count, stream->corner_capacity,
                                                  triangles_before, left, most),
                                3 * sizeof *stream->corners, "triangles");
        }
        if (mesh->memory.status != BURNISH_STATUS_OK) {
            return mesh->memory.status;
        }
        if (per_position && before[i] < before[BURNISH_POSITION]) {
            fill_values(stream, (burnish_attribute)i, before[i],
                        before[BURNISH_POSITION] - before[i]);
        }
        if (new_corners) {
            memset(stream->corners, 0xFF, 3 * triangles_before * sizeof *stream->corners);
        }
    }
    driver->reader->polygons =
        burnish_reserve(&mesh->memory, driver->reader->polygons, &driver->reader->polygon_capacity,
                        polygons, sizeof *driver->reader->polygons, "polygons");
    return mesh->memory.status;
}

static void append_corners(burnish_stream *to, const burnish_chunk *chunk, int attribute) {
    const burnish_stream *from = &chunk->data.streams[attribute];
    const burnish_chunk_slots *relative = &chunk->relative[attribute];
    uint32_t *corners = to->corners + 3 * chunk->triangles_before;
    const size_t size = 3 * chunk->data.triangle_count * sizeof *corners;
    if (!(chunk->used >> attribute & 1)) {
        memset(corners, 0xFF, size);
        return;
    }
    memcpy(corners, from->corners, size);
    for (size_t i = 0; i < relative->count; ++i) {
        corners[relative->items[i]] += (uint32_t)chunk->before[attribute];
    }
}

static void append_task(void *user_data, size_t index, int thread) {
    const chunk_driver *driver = user_data;
    const burnish_chunk *chunk = &driver->chunks[index];
    const burnish_mesh_data *mesh = driver->reader->mesh;
    (void)thread;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        burnish_stream to = mesh->streams[i];
        const burnish_stream *from = &chunk->data.streams[i];
        const int indexed = (int)(driver->grammar->indexed >> i & 1);
        const size_t size = burnish_attribute_size((burnish_attribute)i);
        const size_t before = chunk->before[indexed ? i : BURNISH_POSITION];
        if (from->count > 0) {
            memcpy((char *)to.items + size * before, from->items, size * from->count);
        } else if (!indexed && to.count > 0) {
            fill_values(&to, (burnish_attribute)i, before,
                        chunk->data.streams[BURNISH_POSITION].count);
        }
        if (to.corners) {
            append_corners(&to, chunk, i);
        }
    }
}

static void append_polygons(burnish_reader *reader, const burnish_chunk *chunk) {
    for (size_t i = 0; i < chunk->polygon_count; ++i) {
        reader->polygons[reader->polygon_count] = chunk->polygons[i];
        reader->polygons[reader->polygon_count++].first_triangle +=
            (uint32_t)chunk->triangles_before;
    }
}

/* ---- The loop ---- */

/* Reports progress to the context. A file that is read again never reports less than before. */
static void tell_progress(const chunk_driver *driver) {
    const burnish_reader_input *input = driver->reader->input;
    const double fraction = (double)offset_of(driver, driver->next) / (double)input->size;
    if (!driver->reader->mesh->is_silent && (!input->told || fraction >= *input->told)) {
        burnish_tasks_progress(driver->reader->mesh->tasks, BURNISH_STAGE_READ, fraction);
        if (input->told) {
            *input->told = fraction;
        }
    }
}

static burnish_status read_wave(chunk_driver *driver) {
    burnish_mesh_data *mesh = driver->reader->mesh;
    size_t before[BURNISH_ATTRIBUTE_COUNT], triangles_before = mesh->triangle_count, used = 0;
    burnish_status status = BURNISH_STATUS_OK;
    const int is_there = !driver->window.bytes || move_window(driver);
    const size_t count = is_there ? cut_wave(driver) : 0;
    if (count == 0) {
        return burnish_stop_streaming(driver->reader);
    }
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        before[i] = mesh->streams[i].count;
    }
    burnish_tasks_run(mesh->tasks, count, 1, 0, parse_task, driver);
    driver->wave_rows = driver->rows_done;
    for (int more = 1; used < count && more && status == BURNISH_STATUS_OK; ++used) {
        status = accept_chunk(driver, &driver->chunks[used], &more);
    }
    driver->wave_rows = driver->rows_done - driver->wave_rows;
    if (status == BURNISH_STATUS_OK) {
        status = reserve_wave(driver, used, before, triangles_before);
    }
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_tasks_run(mesh->tasks, used, 1, 0, append_task, driver);
    for (size_t i = 0; i < used; ++i) {
        append_polygons(driver->reader, &driver->chunks[i]);
    }
    tell_progress(driver);
    return driver->reader->has_warned ? burnish_stop_streaming(driver->reader)
                                      : burnish_tasks_check(mesh->tasks, driver->reader->error);
}

/* Whether a chunk refers to values that the file does not have. */
static int is_beyond(const chunk_driver *driver, const forward_chunk *forward) {
    int any = 0;
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        any |= !(driver->grammar->lenient >> i & 1) &&
               forward->highest[i] > driver->reader->mesh->streams[i].count;
    }
    return any;
}

/* At the end of the file: notes the faces that refer to missing values. They are in the mesh, and
 * left out of it later. */
static burnish_status check_forward(chunk_driver *driver) {
    burnish_reader *reader = driver->reader;
    burnish_status status = BURNISH_STATUS_OK;
    int any = 0;
    for (size_t k = 0; k < driver->forward_count && status == BURNISH_STATUS_OK; ++k) {
        const forward_chunk *forward = &driver->forward[k];
        if (!is_beyond(driver, forward)) {
            continue;
        }
        if (driver->window.bytes) {
            return burnish_stop_streaming(reader);
        }
        const size_t count = reader->damage.count - forward->damage; /* which are noted again */
        const int is_first = !any && forward->damage_before == 0; /* perhaps another first place */
        reader->damage.count = is_first ? 0 : count;
        status = parse_exactly(driver, &driver->chunks[0], forward, reader->mesh->streams);
        reader->damage.count += is_first ? count : 0;
        any = 1;
    }
    return status;
}

static void close_driver(chunk_driver *driver) {
    const burnish_context *context = driver->reader->mesh->memory.context;
    for (size_t i = 0; i < driver->most; ++i) {
        burnish_chunk *chunk = &driver->chunks[i];
        burnish_mesh_data_destroy(&chunk->data);
        for (int k = 0; k < BURNISH_ATTRIBUTE_COUNT; ++k) {
            burnish_release(context, chunk->relative[k].items);
        }
        burnish_release(context, chunk->polygons);
        burnish_release(context, chunk->events);
        burnish_release(context, chunk->scratch);
    }
    burnish_release(context, driver->window.bytes);
    burnish_release(context, driver->chunks);
    burnish_release(context, driver->forward);
}

burnish_status burnish_chunks_read(const burnish_grammar *grammar, void *state,
                                   burnish_reader *reader, const uint8_t **at, size_t *rows) {
    burnish_mesh_data *mesh = reader->mesh;
    const size_t given = reader->input->chunk_size;
    chunk_driver driver = {.grammar = grammar,
                           .state = state,
                           .reader = reader,
                           .next = *at,
                           .text_end = reader->input->bytes + reader->input->size,
                           .chunk_size = given ? given : BURNISH_CHUNK_SIZE,
                           .rows_left = rows ? *rows : SIZE_MAX};
    if (reader->input->streamed && !grammar->find_start) {
        return burnish_stop_streaming(reader);
    }
    const size_t chunks = (size_t)(driver.text_end - *at) / driver.chunk_size + 1;
    const size_t threads = (size_t)burnish_tasks_threads(mesh->tasks);
    const size_t most = threads > 1 ? CHUNKS_PER_THREAD * threads : 1;
    driver.most = most < chunks ? most : chunks;
    driver.chunks =
        burnish_allocate_zeroed(&mesh->memory, driver.most, sizeof *driver.chunks, "chunks");
    if (!driver.chunks) {
        return mesh->memory.status;
    }
    for (size_t i = 0; i < driver.most; ++i) {
        burnish_chunk *chunk = &driver.chunks[i];
        chunk->data = burnish_mesh_data_begin(mesh->memory.context, NULL, &chunk->error);
        chunk->most = burnish_budget_triangles(reader);
    }
    burnish_status status = reader->input->streamed ? open_window(&driver, *at) : BURNISH_STATUS_OK;
    while (status == BURNISH_STATUS_OK && bytes_left(&driver) > 0 && driver.rows_left > 0) {
        status = read_wave(&driver);
    }
    if (status == BURNISH_STATUS_OK) {
        status = check_forward(&driver);
    }
    *at = reader->input->bytes + offset_of(&driver, driver.next);
    if (rows) {
        *rows = driver.rows_left;
    }
    close_driver(&driver);
    return status;
}
