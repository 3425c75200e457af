#include "mesh/read/io/thinning.h"

#include <string.h>

#include "core/vec3.h"
#include "mesh/read/io/streaming.h"

/* Of a preview; fuzzing takes fewer. */
#ifndef BURNISH_PREVIEW_ROWS
#define BURNISH_PREVIEW_ROWS 10000
#endif
enum { LEAST_ROWS = BURNISH_PREVIEW_ROWS };

/* ---- How many ---- */

static uint64_t base_bytes(const burnish_reader_input *input) {
    return BURNISH_RUN_BYTES + (input->streamed ? 0 : (uint64_t)input->size);
}

uint64_t burnish_thinning_room(const burnish_reader_input *input) {
    const uint64_t limit = input->options->max_memory, base = base_bytes(input);
    return limit == 0 ? UINT64_MAX : limit < base ? 0 : (limit - base) / BURNISH_ROW_BYTES;
}

burnish_status burnish_thinning_step(burnish_reader *reader, uint64_t needed, uint64_t count,
                                     size_t *step) {
    const burnish_reader_input *input = reader->input;
    const uint64_t room = burnish_thinning_room(input);
    *step = 1;
    if (needed <= (room > LEAST_ROWS ? room : LEAST_ROWS) || count < LEAST_ROWS) { /* too few */
        return BURNISH_STATUS_OK;
    }
    if (room < LEAST_ROWS) {
        const uint64_t least = base_bytes(input) + (uint64_t)LEAST_ROWS * BURNISH_ROW_BYTES;
        return burnish_reader_fail(
            reader, BURNISH_STATUS_MEMORY, NULL,
            "max-memory: %llu MB are too few for a preview; give at least %llu MB",
            (unsigned long long)(input->options->max_memory / 1000000),
            (unsigned long long)(least / 1000000 + 1));
    }
    const uint64_t fair = count / room + (count % room > 0);
    *step = fair < 2 ? 2 : (size_t)fair;
    return BURNISH_STATUS_OK;
}

void burnish_thinning_note(burnish_reader *reader, size_t count, const char *what) {
    const size_t step = reader->mesh->thinning;
    if (step > 1) {
        burnish_mesh_data_warn(reader->mesh,
                               "%s: a preview: 1 in %zu of %zu %s is drawn, as a point, since all "
                               "need more memory than max-memory",
                               burnish_show_name(reader->input->name).text, step, count, what);
    }
}

/* ---- Rows ---- */

void burnish_thinning_facet(const float corners[9], float position[3], float normal[3]) {
    const burnish_vec3 a = burnish_vec3_loadf(corners), b = burnish_vec3_loadf(corners + 3),
                       c = burnish_vec3_loadf(corners + 6);
    const burnish_vec3 unit =
        burnish_vec3_normalize(burnish_vec3_cross(burnish_vec3_sub(b, a), burnish_vec3_sub(c, a)));
    const burnish_vec3 sum = burnish_vec3_add(burnish_vec3_add(a, b), c);
    position[0] = (float)(sum.x / 3);
    position[1] = (float)(sum.y / 3);
    position[2] = (float)(sum.z / 3);
    normal[0] = (float)unit.x;
    normal[1] = (float)unit.y;
    normal[2] = (float)unit.z;
}

/* How many of the first rows are kept. */
static size_t kept_rows(const burnish_thinning *thinning, size_t rows) {
    return rows / thinning->step + (rows % thinning->step > 0);
}

/* Keeps one in `factor` of the first `count` items. */
static void keep_some(burnish_mesh_data *mesh, size_t count, size_t factor) {
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        char *items = mesh->streams[i].items;
        const size_t size = burnish_attribute_size((burnish_attribute)i);
        for (size_t k = 1; k * factor < count && items; ++k) {
            memcpy(items + k * size, items + k * factor * size, size);
        }
    }
}

/* Facets, 3 positions each, become points. */
static burnish_status make_facets(burnish_mesh_data *mesh, size_t rows) {
    burnish_mesh_data_drop(mesh, BURNISH_NORMAL);
    if (rows > 0 && burnish_mesh_data_reserve(mesh, BURNISH_NORMAL, rows) != BURNISH_STATUS_OK) {
        return mesh->memory.status;
    }
    for (size_t i = 0; i < rows; ++i) {
        float corners[9];
        memcpy(corners, burnish_positions(mesh) + 9 * i, sizeof corners);
        burnish_thinning_facet(corners, burnish_positions(mesh) + 3 * i,
                               burnish_normals(mesh) + 3 * i);
    }
    return BURNISH_STATUS_OK;
}

burnish_status burnish_thinning_begin(const burnish_thinning *thinning, burnish_mesh_data *mesh,
                                      size_t rows) {
    burnish_release(mesh->memory.context, mesh->streams[BURNISH_POSITION].corners);
    mesh->streams[BURNISH_POSITION].corners = NULL;
    mesh->streams[BURNISH_POSITION].corner_capacity = 0;
    for (int i = BURNISH_POSITION + 1; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        if (thinning->indexed >> i & 1) {
            burnish_mesh_data_drop(mesh, (burnish_attribute)i);
        }
    }
    const burnish_status status =
        thinning->are_facets ? make_facets(mesh, rows) : BURNISH_STATUS_OK;
    keep_some(mesh, rows, thinning->step);
    return status;
}

static int is_kept(const burnish_thinning *thinning, int attribute) {
    return thinning->are_facets
               ? attribute <= BURNISH_NORMAL
               : attribute == BURNISH_POSITION || !(thinning->indexed >> attribute & 1);
}

burnish_status burnish_thinning_reserve(burnish_thinning *thinning, burnish_mesh_data *mesh,
                                        const burnish_chunk *chunks, size_t count, size_t before,
                                        size_t rows) {
    while (kept_rows(thinning, rows) > thinning->most) {
        keep_some(mesh, kept_rows(thinning, before), 2);
        thinning->step *= 2;
    }
    const size_t old = kept_rows(thinning, before), all = kept_rows(thinning, rows);
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        burnish_stream *stream = &mesh->streams[i];
        const int is_new = !stream->items;
        int is_used = !is_new || thinning->are_facets;
        for (size_t k = 0; k < count; ++k) {
            is_used |= chunks[k].data.streams[i].count > 0;
        }
        if (!is_used || !is_kept(thinning, i) || all == 0) {
            continue;
        }
        const size_t size = burnish_attribute_size((burnish_attribute)i);
        stream->items =
            burnish_reserve(&mesh->memory, stream->items, &stream->capacity, all, size, "values");
        if (mesh->memory.status != BURNISH_STATUS_OK) {
            return mesh->memory.status;
        }
        const size_t from = is_new ? 0 : old; /* what no chunk sets: white, or 0 */
        memset((char *)stream->items + size * from, i == BURNISH_COLOR ? 0xFF : 0,
               size * (all - from));
    }
    return BURNISH_STATUS_OK;
}

void burnish_thinning_append(const burnish_thinning *thinning, burnish_mesh_data *mesh,
                             const burnish_chunk *chunk) {
    const size_t step = thinning->step, corners = thinning->are_facets ? 3 : 1;
    const size_t before = chunk->before[BURNISH_POSITION] / corners;
    const size_t count = chunk->data.streams[BURNISH_POSITION].count / corners;
    const float *facets = burnish_positions(&chunk->data);
    for (size_t to = kept_rows(thinning, before); to * step < before + count; ++to) {
        const size_t from = to * step - before;
        if (thinning->are_facets) {
            burnish_thinning_facet(facets + 9 * from, burnish_positions(mesh) + 3 * to,
                                   burnish_normals(mesh) + 3 * to);
            continue;
        }
        for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
            const burnish_stream *stream = &chunk->data.streams[i];
            const size_t size = burnish_attribute_size((burnish_attribute)i);
            if (is_kept(thinning, i) && from < stream->count) {
                memcpy((char *)mesh->streams[i].items + size * to,
                       (const char *)stream->items + size * from, size);
            }
        }
    }
}

void burnish_thinning_end(const burnish_thinning *thinning, burnish_mesh_data *mesh, size_t rows) {
    for (int i = 0; i < BURNISH_ATTRIBUTE_COUNT; ++i) {
        mesh->streams[i].count = mesh->streams[i].items ? kept_rows(thinning, rows) : 0;
    }
    mesh->triangle_count = 0;
    mesh->thinning = thinning->step;
}
