/* A model part. */
#ifndef BURNISH_MESH_READ_THREEMF_THREEMF_MODEL_H
#define BURNISH_MESH_READ_THREEMF_THREEMF_MODEL_H

#include "mesh/read/threemf/threemf.h"

/* Reads the model of part `number`. Returns 0 on failure. */
int burnish_threemf_read_model(burnish_threemf *threemf, uint32_t number);

#endif
