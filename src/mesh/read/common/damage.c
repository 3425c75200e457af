#include "mesh/read/common/damage.h"

#include <string.h>

#include "base/numbers.h"

int burnish_is_good_position(const burnish_mesh_data *mesh, uint32_t corner) {
    const float *positions = burnish_positions(mesh);
    size_t finite = 0;
    while (corner < mesh->streams[BURNISH_POSITION].count && finite < 3 &&
           burnish_is_finitef(positions[3 * (size_t)corner + finite])) {
        ++finite;
    }
    return finite == 3;
}

void burnish_fill_positions(burnish_mesh_data *mesh) {
    const burnish_stream *positions = &mesh->streams[BURNISH_POSITION];
    float *items = positions->items;
    size_t good = 0;
    while (good < positions->count && !burnish_is_good_position(mesh, (uint32_t)good)) {
        ++good;
    }
    for (size_t i = 0; i < positions->count && good < positions->count; ++i) {
        if (!burnish_is_good_position(mesh, (uint32_t)i)) {
            memcpy(items + 3 * i, items + 3 * good, 3 * sizeof *items);
        }
    }
}

static int is_good_triangle(const burnish_mesh_data *mesh, size_t triangle) {
    const uint32_t *corners = mesh->streams[BURNISH_POSITION].corners + 3 * triangle;
    return burnish_is_good_position(mesh, corners[0]) &&
           burnish_is_good_position(mesh, corners[1]) && burnish_is_good_position(mesh, corners[2]);
}

void burnish_mark_damage(burnish_reader *reader) {
    const burnish_mesh_data *mesh = reader->mesh;
    uint32_t *corners = mesh->streams[BURNISH_POSITION].corners;
    size_t kept = 0;
    for (size_t i = 0; i < reader->polygon_count && reader->damage.count > 0; ++i) {
        const burnish_polygon polygon = reader->polygons[i];
        const size_t first = polygon.first_triangle, triangles = polygon.corner_count - 2;
        size_t good = 0;
        while (good < triangles && is_good_triangle(mesh, first + good)) {
            ++good;
        }
        if (good == triangles) {
            reader->polygons[kept++] = polygon;
        } else {
            memset(corners + 3 * first, 0xFF, 3 * triangles * sizeof *corners);
        }
    }
    reader->polygon_count = reader->damage.count > 0 ? kept : reader->polygon_count;
}

void burnish_drop_points(burnish_reader *reader) {
    burnish_mesh_data *mesh = reader->mesh;
    const size_t count = mesh->streams[BURNISH_POSITION].count;
    const int may_lack = reader->may_lack || reader->damage.count > 0;
    for (int k = BURNISH_ATTRIBUTE_COUNT - 1; k >= 0 && may_lack; --k) {
        burnish_stream *stream = &mesh->streams[k];
        const size_t size = burnish_attribute_size((burnish_attribute)k);
        char *items = stream->items, *to = items;
        if (stream->count != count) {
            continue;
        }
        for (size_t i = 0; i < count; ++i) {
            if (burnish_is_good_position(mesh, (uint32_t)i)) {
                memmove(to, items + size * i, size);
                to += size;
            }
        }
        stream->count = count > 0 ? (size_t)(to - items) / size : 0;
    }
}

void burnish_keep_triangle(burnish_mesh_data *mesh, size_t from, size_t to) {
    for (int k = 0; k < BURNISH_ATTRIBUTE_COUNT; ++k) {
        uint32_t *corners = mesh->streams[k].corners;
        if (corners) {
            memmove(corners + 3 * to, corners + 3 * from, 3 * sizeof *corners);
        }
    }
    if (mesh->triangle_materials) {
        mesh->triangle_materials[to] = mesh->triangle_materials[from];
    }
    if (mesh->triangle_parts) {
        mesh->triangle_parts[to] = mesh->triangle_parts[from];
    }
}

static void drop_triangles(burnish_mesh_data *mesh) {
    size_t kept = 0;
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        if (is_good_triangle(mesh, i)) {
            burnish_keep_triangle(mesh, i, kept++);
        }
    }
    mesh->triangle_count = kept;
    burnish_fill_positions(mesh);
}

burnish_status burnish_drop_damage(burnish_reader *reader) {
    burnish_mesh_data *mesh = reader->mesh;
    const burnish_warning_group *damage = &reader->damage;
    burnish_reader_warn_group(reader, &reader->odd);
    if (damage->count == 0) {
        return BURNISH_STATUS_OK;
    }
    if (mesh->triangle_count > 0) {
        drop_triangles(mesh);
    }
    if (mesh->triangle_count == 0 && mesh->point_count == 0) {
        return burnish_fail(reader->error, BURNISH_STATUS_FORMAT, "%s", damage->first.text);
    }
    burnish_warning_group left_out = {.count = damage->count};
    burnish_fail(&left_out.first, BURNISH_STATUS_OK, "%s; it was left out", damage->first.text);
    burnish_reader_warn_group(reader, &left_out);
    return BURNISH_STATUS_OK;
}
