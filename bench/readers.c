/* Readers: megabytes per second from memory to triangles, per format and number of threads, without
 * building the mesh. Usage: readers [GRID], a torus of 2 GRID^2 triangles */
#include <stdio.h>
#include <stdlib.h>

#include "burnish/mesh.h"
#include "torus.h"

enum { RUNS = 7 };

static int compare_doubles(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void bench(const char *name, bytes input) {
    static const int THREADS[] = {1, 2, 4};
    printf("%-34s %8.1f MB ", name, (double)input.size / 1e6);
    for (size_t t = 0; t < sizeof THREADS / sizeof *THREADS; ++t) {
        burnish_load_options options = burnish_load_options_default();
        double seconds[RUNS];
        options.threads = THREADS[t];
        for (int i = 0; i < RUNS; ++i) {
            burnish_mesh *scene;
            burnish_error error;
            if (burnish_mesh_load_memory(input.data, input.size, "torus", &options, &scene,
                                         &error) != BURNISH_STATUS_OK) {
                fprintf(stderr, "readers: %s\n", error.text);
                exit(EXIT_FAILURE);
            }
            seconds[i] = burnish_mesh_get_info(scene)->read_seconds;
            burnish_mesh_destroy(scene);
        }
        qsort(seconds, RUNS, sizeof *seconds, compare_doubles);
        printf(" %9.0f %9.0f", (double)input.size / 1e6 / seconds[RUNS / 2],
               (double)input.size / 1e6 / seconds[0]);
    }
    putchar('\n');
    free(input.data);
}

int main(int count, char **arguments) {
    const long grid = count > 1 ? strtol(arguments[1], NULL, 10) : 400;
    if (grid < 3 || grid > 20000) {
        fputs("readers: GRID must be a number from 3 to 20000\n", stderr);
        return EXIT_FAILURE;
    }
    torus t = make_torus((size_t)grid);
    printf("%-34s %11s  %19s %19s %19s\n", "readers, MB/s: median and best", "", "1 thread",
           "2 threads", "4 threads");
    bench("OBJ, 6 decimals", write_obj(&t, 6, 0, 0));
    bench("OBJ, 6 decimals, normals", write_obj(&t, 6, 1, 0));
    bench("OBJ, 17 decimals", write_obj(&t, 17, 0, 0));
    bench("OBJ, 6 decimals, normals, vt", write_obj(&t, 6, 1, 1));
    bench("ASCII STL", write_stl(&t, 1));
    bench("binary STL", write_stl(&t, 0));
    bench("ASCII PLY, normals", write_ply(&t, 1, 1));
    bench("binary PLY, normals", write_ply(&t, 0, 1));
    bench("GLB, normals", write_glb(&t));
    torus_destroy(&t);
    return EXIT_SUCCESS;
}
