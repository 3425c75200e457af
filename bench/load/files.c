/* Writes the loaders' input files. Usage: bench_load_files FOLDER GRID */
#include <stdio.h>
#include <stdlib.h>

#include "torus.h"

static void save(const char *folder, const char *name, bytes file) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *to = fopen(path, "wb");
    if (!to || fwrite(file.data, 1, file.size, to) != file.size || fclose(to) != 0) {
        fprintf(stderr, "bench_load_files: %s can't be written\n", path);
        exit(EXIT_FAILURE);
    }
    free(file.data);
}

int main(int count, char **arguments) {
    const long grid = count > 2 ? strtol(arguments[2], NULL, 10) : 0;
    if (grid < 3 || grid > 20000) {
        fputs("usage: bench_load_files FOLDER GRID, GRID from 3 to 20000\n", stderr);
        return EXIT_FAILURE;
    }
    torus t = make_torus((size_t)grid);
    const char *folder = arguments[1];
    save(folder, "positions.obj", write_obj(&t, 6, 0, 0));
    save(folder, "normals-vt.obj", write_obj(&t, 6, 1, 1));
    save(folder, "ascii.stl", write_stl(&t, 1));
    save(folder, "binary.stl", write_stl(&t, 0));
    save(folder, "ascii.ply", write_ply(&t, 1, 1));
    save(folder, "positions.ply", write_ply(&t, 0, 0));
    save(folder, "normals.ply", write_ply(&t, 0, 1));
    save(folder, "normals.glb", write_glb(&t));
    torus_destroy(&t);
    return EXIT_SUCCESS;
}
