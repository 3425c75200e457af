/* burnish's loader: welded, with normals, ready to be drawn. Usage: bench_load_burnish FILE THREADS
 */
#include <stdlib.h>

#include "burnish/mesh.h"
#include "report.h"

int main(int count, char **arguments) {
    burnish_load_options options = burnish_load_options_default();
    burnish_mesh *mesh;
    burnish_error error;
    if (count < 3) {
        fputs("usage: bench_load_burnish FILE THREADS\n", stderr);
        return EXIT_FAILURE;
    }
    options.threads = atoi(arguments[2]);
    options.keep_texture_coordinates = 1;
    const double start = load_now();
    if (burnish_mesh_load(arguments[1], &options, &mesh, &error) != BURNISH_STATUS_OK) {
        fprintf(stderr, "bench_load_burnish: %s\n", error.text);
        return EXIT_FAILURE;
    }
    load_report(start, burnish_mesh_get_view(mesh)->triangle_count);
    burnish_mesh_destroy(mesh);
    return EXIT_SUCCESS;
}
