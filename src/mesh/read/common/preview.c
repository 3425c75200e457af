#include "mesh/read/common/preview.h"

#include <stdatomic.h>
#include <string.h>

#include "core/bytes.h"
#include "core/numbers.h"
#include "core/vector.h"
#include "mesh/read/common/origin.h"
#include "mesh/read/common/points.h"
#include "mesh/read/io/pieces.h"

enum {
    BASE_BYTES = 80 << 20, /* the program, an image, depth maps, tile lists, light */
    LEAST_ROWS = 10000,    /* of a preview */
    FACET_SIZE = 50
};

burnish_status burnish_preview_step(burnish_reader *reader, uint64_t count, size_t bytes,
                                    size_t *step) {
    const burnish_reader_input *input = reader->input;
    const uint64_t limit = input->options->max_memory;
    const uint64_t base = BASE_BYTES + (input->pieces ? 0 : (uint64_t)input->size);
    const uint64_t least = base + (uint64_t)LEAST_ROWS * bytes;
    *step = 1;
    if (limit == 0 || count * bytes + base <= limit) {
        return BURNISH_STATUS_OK;
    }
    if (limit < least) {
        return burnish_reader_fail(reader, BURNISH_STATUS_LIMIT, NULL,
                                   "max-memory: %llu MB are too few for a preview; give at least "
                                   "%llu MB",
                                   (unsigned long long)(limit / 1000000),
                                   (unsigned long long)(least / 1000000 + 1));
    }
    const uint64_t kept = (limit - base) / bytes;
    *step = (size_t)((count + kept - 1) / kept);
    return BURNISH_STATUS_OK;
}

void burnish_preview_note(burnish_reader *reader, size_t step, size_t count, const char *what) {
    reader->mesh->thinning = step;
    if (step > 1) {
        burnish_mesh_data_warn(reader->mesh,
                               "%s: a preview: 1 in %zu of %zu %s is drawn, as a point, since all "
                               "need more memory than max-memory",
                               burnish_show_name(reader->input->name).text, step, count, what);
    }
}

typedef struct facets {
    burnish_mesh_data *mesh;
    size_t step;
    atomic_int is_bad;
} facets;

static void convert(void *user_data, const uint8_t *bytes, size_t first, size_t end) {
    facets *f = user_data;
    for (size_t i = first; i < end; ++i, bytes += f->step * FACET_SIZE) {
        burnish_vec3 p[3];
        for (size_t k = 0; k < 3; ++k) {
            float corner[3];
            for (size_t c = 0; c < 3; ++c) {
                const uint32_t bits = burnish_load32(bytes + 12 + 12 * k + 4 * c);
                memcpy(&corner[c], &bits, sizeof bits);
                if (!burnish_is_finite_bits(bits)) {
                    atomic_store(&f->is_bad, 1);
                    corner[c] = 0;
                }
            }
            p[k] = burnish_vec3_loadf(corner);
        }
        const burnish_vec3 normal =
            burnish_vec3_cross(burnish_vec3_sub(p[1], p[0]), burnish_vec3_sub(p[2], p[0]));
        const burnish_vec3 sum = burnish_vec3_add(burnish_vec3_add(p[0], p[1]), p[2]);
        const burnish_vec3 unit = burnish_vec3_normalize(normal);
        float *position = burnish_positions(f->mesh) + 3 * i,
              *to = burnish_normals(f->mesh) + 3 * i;
        position[0] = (float)(sum.x / 3);
        position[1] = (float)(sum.y / 3);
        position[2] = (float)(sum.z / 3);
        to[0] = (float)unit.x;
        to[1] = (float)unit.y;
        to[2] = (float)unit.z;
    }
}

burnish_status burnish_preview_facets(burnish_reader *reader, size_t offset, size_t count,
                                      size_t step) {
    burnish_mesh_data *mesh = reader->mesh;
    const size_t kept = count / step;
    facets f = {.mesh = mesh, .step = step};
    burnish_mesh_data_reserve(mesh, BURNISH_POSITION, kept);
    if (burnish_mesh_data_reserve(mesh, BURNISH_NORMAL, kept) != BURNISH_STATUS_OK) {
        return mesh->memory.status;
    }
    atomic_init(&f.is_bad, 0);
    burnish_status status =
        burnish_reader_rows(reader, offset, step * FACET_SIZE, kept, convert, &f);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    if (atomic_load(&f.is_bad)) {
        return burnish_reader_fail(reader, BURNISH_STATUS_FORMAT, NULL,
                                   "a coordinate is not finite; repair the file");
    }
    mesh->streams[BURNISH_POSITION].count = mesh->streams[BURNISH_NORMAL].count = kept;
    burnish_move_positions(mesh);
    burnish_preview_note(reader, step, count, "triangles");
    return burnish_make_points(reader, NULL, 0);
}
