/* tinyobjloader: triangulates the OBJ as stored, without welding or generating normals.
 * Usage: bench_load_tinyobj FILE */
#include <tiny_obj_loader.h>

#include <cstdlib>

#include "report.h"

int main(int count, char **arguments) {
    tinyobj::ObjReader reader;
    const double start = load_now();
    if (count < 2 || !reader.ParseFromFile(arguments[1])) {
        std::fprintf(stderr, "bench_load_tinyobj: %s\n", reader.Error().c_str());
        return EXIT_FAILURE;
    }
    size_t triangles = 0;
    for (const auto &shape : reader.GetShapes()) {
        triangles += shape.mesh.num_face_vertices.size();
    }
    load_report(start, triangles);
    return EXIT_SUCCESS;
}
