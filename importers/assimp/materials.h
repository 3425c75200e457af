/* Materials and textures of libassimp's scenes. */
#ifndef BURNISH_IMPORT_ASSIMP_MATERIALS_H
#define BURNISH_IMPORT_ASSIMP_MATERIALS_H

#include <assimp/scene.h>

#include "importer.h"

/* One material for each of the scene's, and the textures that they use: embedded textures, and
 * names of texture files. Returns for each the set of texture coordinates that they have. */
const unsigned *assimp_read_materials(const struct aiScene *scene, const char *extension,
                                      importer_mesh *mesh);

#endif
