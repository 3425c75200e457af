/* AMF (ISO/ASTM 52915). Of libassimp 5.2.5 it has the first volume of each object alone, and
 * instances without their turns, so it is read here. */
#ifndef BURNISH_IMPORT_ASSIMP_AMF_H
#define BURNISH_IMPORT_ASSIMP_AMF_H

#include "importer.h"

/* Reads objects, volumes, constellations and colours; ends with importer_fail on errors. */
void assimp_read_amf(const importer_input *input, importer_mesh *mesh);

#endif
