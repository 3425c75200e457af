/* Meshes that no file holds: vertices of the program's own, and an OBJ in memory whose material
 * library the program hands over.
 *
 *     cc own_mesh.c $(pkg-config --cflags --libs burnish) -o own_mesh && ./own_mesh
 */
#include <stdio.h>
#include <string.h>

#include "burnish/mesh.h"

/* A vertex as a program may have it: burnish reads it where it lies, by its stride. */
typedef struct vertex {
    float position[3], texture_coordinates[2];
    unsigned char color[4];
} vertex;

static burnish_status make_square(burnish_mesh **mesh, burnish_error *error) {
    static const vertex vertices[] = {{{0, 0, 0}, {0, 0}, {255, 0, 0, 255}},
                                      {{1, 0, 0}, {1, 0}, {0, 255, 0, 255}},
                                      {{1, 1, 0}, {1, 1}, {0, 0, 255, 255}},
                                      {{0, 1, 0}, {0, 1}, {255, 255, 0, 255}}};
    static const unsigned short indices[] = {0, 1, 2, 0, 2, 3};
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh_description square = burnish_mesh_description_default();
    square.name = "square";
    square.positions = (burnish_array){vertices[0].position, 4, sizeof(vertex)};
    square.colors = (burnish_array){vertices[0].color, 4, sizeof(vertex)};
    square.texture_coordinates =
        (burnish_array){vertices[0].texture_coordinates, 4, sizeof(vertex)};
    square.indices = (burnish_array){indices, 6, 0};
    square.index_size = sizeof *indices;
    options.keep_texture_coordinates = 1;
    return burnish_mesh_create(&square, &options, mesh, error);
}

/* A burnish_file_loader: what would be beside the OBJ if it were a file. */
static burnish_status load_from_program(void *user_data, const char *name, uint64_t max_bytes,
                                        const void **bytes, size_t *size, burnish_error *error) {
    const char *library = user_data;
    if (strcmp(name, "paint.mtl") != 0 || strlen(library) > max_bytes) {
        error->status = BURNISH_STATUS_READ;
        snprintf(error->text, sizeof error->text, "the program has no %.100s", name);
        return error->status;
    }
    *bytes = library;
    *size = strlen(library);
    return BURNISH_STATUS_OK;
}

static burnish_status load_obj(burnish_mesh **mesh, burnish_error *error) {
    static const char obj[] = "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n";
    static char mtl[] = "newmtl red\nKd 1 0 0\n";
    burnish_load_options options = burnish_load_options_default();
    options.referenced_files = (burnish_file_loader){load_from_program, NULL, mtl};
    return burnish_mesh_load_memory(obj, sizeof obj - 1, "red.obj", &options, mesh, error);
}

int main(void) {
    burnish_error error;
    burnish_mesh *square = NULL, *red = NULL;
    if (make_square(&square, &error) != BURNISH_STATUS_OK ||
        load_obj(&red, &error) != BURNISH_STATUS_OK) {
        fprintf(stderr, "own_mesh: %s\n", error.text);
        burnish_mesh_destroy(square);
        return burnish_status_exit_code(error.status);
    }
    printf("square: %zu vertices, %zu triangles\n", burnish_mesh_get_view(square)->vertex_count,
           burnish_mesh_get_view(square)->triangle_count);
    printf("red.obj: diffuse %g, %zu warnings\n",
           (double)burnish_mesh_get_material(red, 0)->diffuse[0],
           burnish_mesh_get_warning_count(red));
    burnish_mesh_destroy(square);
    burnish_mesh_destroy(red);
    return 0;
}
