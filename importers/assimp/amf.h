/* AMF (ISO/ASTM 52915). It is read here because libassimp 5.2.5 reads only the first volume of each
 * object, and ignores the rotation of instances. */
#ifndef BURNISH_IMPORT_ASSIMP_AMF_H
#define BURNISH_IMPORT_ASSIMP_AMF_H

#include "importer.h"

/* Reads objects, volumes, constellations and colours; ends with importer_fail on errors. */
void assimp_read_amf(const importer_input *input, importer_mesh *mesh);

#endif
