#include "mesh/read/common/preview.h"

#include <stdatomic.h>
#include <string.h>

#include "base/bytes.h"
#include "base/numbers.h"
#include "mesh/read/common/origin.h"
#include "mesh/read/common/points.h"
#include "mesh/read/io/pieces.h"
#include "mesh/read/io/thinning.h"

enum { FACET_SIZE = 50 };

typedef struct facets {
    burnish_mesh_data *mesh;
    size_t step;
    atomic_int is_bad;
} facets;

static void convert(void *user_data, const uint8_t *bytes, size_t first, size_t end) {
    facets *f = user_data;
    for (size_t i = first; i < end; ++i, bytes += f->step * FACET_SIZE) {
        float corners[9];
        for (size_t k = 0; k < 9; ++k) {
            const uint32_t bits = burnish_load32(bytes + 12 + 4 * k);
            memcpy(&corners[k], &bits, sizeof bits);
            if (!burnish_is_finite_bits(bits)) {
                atomic_store(&f->is_bad, 1);
                corners[k] = 0;
            }
        }
        burnish_thinning_facet(corners, burnish_positions(f->mesh) + 3 * i,
                               burnish_normals(f->mesh) + 3 * i);
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
    mesh->thinning = step;
    burnish_thinning_note(reader, count, "triangles");
    return burnish_make_points(reader, NULL, 0);
}
