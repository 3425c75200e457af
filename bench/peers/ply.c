/* Writes a mesh as binary PLY with normals: every program reads the same input, none generates
 * normals. Usage: bench_peers_ply INPUT OUTPUT */
#include <stdio.h>
#include <stdlib.h>

#include "job.h"

static int write_mesh(const burnish_mesh_view *mesh, FILE *file) {
    fprintf(file,
            "ply\nformat binary_little_endian 1.0\nelement vertex %zu\n"
            "property float x\nproperty float y\nproperty float z\n"
            "property float nx\nproperty float ny\nproperty float nz\n"
            "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
            mesh->vertex_count, mesh->triangle_count);
    for (size_t i = 0; i < mesh->vertex_count; ++i) {
        fwrite(mesh->positions + 3 * i, sizeof(float), 3, file);
        fwrite(mesh->normals + 3 * i, sizeof(float), 3, file);
    }
    for (size_t i = 0; i < mesh->triangle_count; ++i) {
        fputc(3, file);
        fwrite(mesh->indices + 3 * i, sizeof(uint32_t), 3, file);
    }
    return !ferror(file);
}

int main(int count, char **arguments) {
    burnish_peers_job job;
    const burnish_peers_view view = {BURNISH_PEERS_WIDTH, BURNISH_PEERS_HEIGHT, 1, 1};
    if (count != 3) {
        fprintf(stderr, "usage: %s INPUT OUTPUT\n", arguments[0]);
        return EXIT_FAILURE;
    }
    if (!burnish_peers_job_open(&job, arguments[1], &view)) {
        return EXIT_FAILURE;
    }
    FILE *file = fopen(arguments[2], "wb");
    int done = file && write_mesh(burnish_mesh_get_view(job.scene), file);
    done = file && fclose(file) == 0 && done;
    burnish_peers_job_close(&job);
    if (!done) {
        fprintf(stderr, "bench_peers_ply: %s can't be written\n", arguments[2]);
    }
    return done ? EXIT_SUCCESS : EXIT_FAILURE;
}
