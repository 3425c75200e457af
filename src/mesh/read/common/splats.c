#include "mesh/read/common/splats.h"

#include "base/numbers.h"
#include "core/vec3.h"
#include "mesh/read/common/points.h"

enum { GRAIN = 1 << 12, FLOATS = sizeof(burnish_splat) / sizeof(float) };

/* Colours beyond white may be meant, since the rest of a scene darkens them. */
#define BRIGHTEST 16.0F

/* Opacity below which a splat is hardly seen. */
#define FAINT 0.1F

typedef struct maker {
    const burnish_mesh_data *mesh;
    int is_trained;
    atomic_size_t bad, first_bad;
} maker;

burnish_status burnish_reserve_splats(burnish_reader *reader, size_t count) {
    burnish_mesh_data *mesh = reader->mesh;
    const burnish_status status = burnish_check_points(reader, count, 0);
    if (status != BURNISH_STATUS_OK) {
        return status;
    }
    burnish_mesh_data_reserve(mesh, BURNISH_POSITION, count);
    burnish_mesh_data_reserve(mesh, BURNISH_SPLAT, count);
    mesh->streams[BURNISH_POSITION].count = mesh->streams[BURNISH_SPLAT].count = count;
    return mesh->memory.status;
}

static float limit(float x, float most) {
    return x < 0 ? 0 : x > most ? most : x;
}

burnish_splat burnish_splat_of(const burnish_splat_values *values) {
    burnish_splat splat = {.opacity = limit(values->opacity, 1)};
    double q[4] = {1, 0, 0, 0}, length = 0;
    for (int i = 0; i < 4; ++i) {
        length += (double)values->rotation[i] * (double)values->rotation[i];
    }
    length = burnish_sqrt(length);
    for (int i = 0; i < 4 && length != 0; ++i) {
        q[i] = (double)values->rotation[i] / length;
    }
    for (int i = 0; i < 3; ++i) { /* row i of the rotation's matrix is its axis i */
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double x = q[1 + i], y = q[1 + j], z = q[1 + k], size = (double)values->scale[i];
        splat.axes[i][i] = (float)(size * (1 - 2 * (y * y + z * z)));
        splat.axes[i][j] = (float)(size * 2 * (x * y + q[0] * z));
        splat.axes[i][k] = (float)(size * 2 * (x * z - q[0] * y));
        splat.color[i] = limit(values->color[i], BRIGHTEST);
    }
    return splat;
}

static burnish_splat finish_trained(const void *item) {
    burnish_splat_values values;
    memcpy(&values, item, sizeof values);
    for (int i = 0; i < 3; ++i) {
        values.scale[i] = (float)burnish_splat_exp((double)values.scale[i]);
        values.color[i] = burnish_splat_color((double)values.color[i]);
    }
    values.opacity = (float)(1 / (1 + burnish_splat_exp(-(double)values.opacity)));
    return burnish_splat_of(&values);
}

/* The position of a bad splat becomes NaN. */
static void finish_splats(void *user_data, size_t first, size_t end) {
    maker *m = user_data;
    burnish_splat *splats = m->mesh->streams[BURNISH_SPLAT].items;
    for (size_t i = first; i < end; ++i) {
        const float *values = (const float *)&splats[i];
        float *position = burnish_positions(m->mesh) + 3 * i;
        int good = 1;
        if (m->is_trained) {
            splats[i] = finish_trained(&splats[i]);
        }
        for (int k = 0; k < FLOATS; ++k) {
            good &= burnish_is_finitef(values[k]);
        }
        for (int k = 0; k < 3 && !m->is_trained; ++k) {
            good &= burnish_is_finitef(position[k]);
        }
        if (!good) {
            position[0] = __builtin_nanf("");
            atomic_fetch_add(&m->bad, 1);
            burnish_lower_to(&m->first_bad, i);
        }
    }
}

burnish_status burnish_make_splats(burnish_reader *reader, int is_trained) {
    maker m = {.mesh = reader->mesh, .is_trained = is_trained, .first_bad = SIZE_MAX};
    burnish_tasks_ranges(reader->mesh->tasks, reader->mesh->streams[BURNISH_SPLAT].count, GRAIN,
                         finish_splats, &m);
    const size_t bad = atomic_load(&m.bad);
    if (bad > 0) {
        burnish_reader_note(reader, &reader->damage, NULL,
                            "splat %zu has a value that is not finite", atomic_load(&m.first_bad));
        reader->damage.count += bad - 1;
    }
    return burnish_make_points(reader, NULL, 0);
}

burnish_status burnish_make_splats_beside(burnish_reader *reader) {
    burnish_mesh_data *mesh = reader->mesh, *splats = mesh->splats;
    reader->mesh = splats;
    burnish_status status = burnish_make_splats(reader, 0);
    reader->mesh = mesh;
    mesh->memory.status = splats->memory.status;
    if (status == BURNISH_STATUS_FORMAT) { /* reader->damage has been noted */
        burnish_mesh_data_destroy(splats);
        burnish_release(mesh->memory.context, splats);
        mesh->splats = NULL;
        status = BURNISH_STATUS_OK;
        if (reader->error) {
            *reader->error = (burnish_error){0};
        }
    }
    return status;
}

burnish_status burnish_visible_splats(burnish_mesh_data *mesh, float **positions, size_t *count,
                                      double *size) {
    const burnish_splat *splats = mesh->streams[BURNISH_SPLAT].items;
    const size_t all = mesh->streams[BURNISH_SPLAT].count;
    *positions = burnish_allocate(&mesh->memory, all, 3 * sizeof **positions, "splats");
    *count = 0;
    *size = 0;
    for (float least = FAINT; *positions && *count * 10 < all; least = 0) {
        *count = 0;
        *size = 0;
        for (size_t i = 0; i < all; ++i) {
            if (splats[i].opacity >= least) {
                double longest = 0;
                for (int k = 0; k < 3; ++k) {
                    const double length =
                        burnish_vec3_length(burnish_vec3_loadf(splats[i].axes[k]));
                    longest = length > longest ? length : longest;
                }
                memcpy(*positions + 3 * (*count)++, burnish_positions(mesh) + 3 * i,
                       3 * sizeof **positions);
                *size += longest;
            }
        }
    }
    *size /= (double)(*count + (*count == 0));
    return mesh->memory.status;
}
