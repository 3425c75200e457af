/* assimp's loader with burnish's work: triangulate, join equal vertices, generate missing normals.
 * Usage: bench_load_assimp FILE */
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <stdlib.h>

#include "report.h"

int main(int count, char **arguments) {
    const unsigned steps =
        aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_GenSmoothNormals;
    const double start = load_now();
    const struct aiScene *scene = count > 1 ? aiImportFile(arguments[1], steps) : NULL;
    size_t triangles = 0;
    if (!scene) {
        fprintf(stderr, "bench_load_assimp: %s\n", aiGetErrorString());
        return EXIT_FAILURE;
    }
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
        triangles += scene->mMeshes[i]->mNumFaces;
    }
    load_report(start, triangles);
    return EXIT_SUCCESS;
}
