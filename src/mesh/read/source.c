/* What a burnish_source owns: release, and its warnings. */
#include "mesh/read/source.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { WARNING_LIMIT = 16, WARNING_SIZE = 480 };

void burnish_source_destroy(burnish_source *source) {
    if (!source) {
        return;
    }
    for (size_t i = 0; i < source->warning_count; ++i) {
        free(source->warnings[i]);
    }
    free(source->warnings);
    free(source->materials);
    free(source->triangle_materials);
    free(source->corner_normals);
    free(source->corner_positions);
    free(source->normals);
    free(source->colors);
    free(source->positions);
    *source = (burnish_source){0};
}

void burnish_source_warn(burnish_source *source, const char *format, ...) {
    if (source->warning_count >= WARNING_LIMIT ||
        burnish_legacy_reserve((void **)&source->warnings, &source->warning_capacity,
                               source->warning_count + 1, sizeof *source->warnings, "warnings",
                               NULL) != BURNISH_STATUS_OK) {
        return;
    }
    char line[WARNING_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    for (char *c = line; *c; ++c) {
        if ((unsigned char)*c < 32 || *c == 127) {
            *c = '?';
        }
    }
    char *copy = strdup(line);
    if (copy) {
        source->warnings[source->warning_count++] = copy;
    }
}

static void move_stream(void *items, size_t count, uint32_t *corners, size_t triangles,
                        burnish_stream *stream) {
    *stream = (burnish_stream){items, count, count, corners, corners ? triangles : 0};
}

void burnish_source_move(burnish_source *source, burnish_mesh_data *mesh) {
    const int has_normals = source->corner_normals != NULL;
    move_stream(source->positions, source->position_count, source->corner_positions,
                source->triangle_count, &mesh->streams[BURNISH_POSITION]);
    move_stream(source->colors, source->colors ? source->position_count : 0, NULL, 0,
                &mesh->streams[BURNISH_COLOR]);
    if (has_normals) {
        move_stream(source->normals, source->normal_count, source->corner_normals,
                    source->triangle_count, &mesh->streams[BURNISH_NORMAL]);
    } else {
        free(source->normals);
    }
    mesh->triangle_count = source->triangle_count;
    mesh->triangle_materials = source->triangle_materials;
    mesh->triangle_material_capacity = source->triangle_material_capacity;
    mesh->materials = source->materials;
    mesh->material_count = source->material_count;
    mesh->material_capacity = source->material_capacity;
    mesh->warnings = source->warnings;
    mesh->warning_count = source->warning_count;
    mesh->warning_capacity = source->warning_capacity;
    *source = (burnish_source){.pool = source->pool};
}
