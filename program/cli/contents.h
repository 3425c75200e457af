/* What a print project consists of, as reports and bindings state it. */
#ifndef TOOL_CLI_CONTENTS_H
#define TOOL_CLI_CONTENTS_H

#include <cjson/cJSON.h>

#include "burnish/mesh.h"

/* The size of a box. Returns 0 if it is empty. */
int cli_box_size(const burnish_box *box, float size[3]);

/* The boxes of all parts, to be freed. NULL: out of memory */
burnish_box *cli_bound_parts(const burnish_mesh *mesh);

/* The box of the parts of a plate, by its number. boxes: of the parts */
burnish_box cli_bound_plate(const burnish_mesh *mesh, const burnish_box *boxes, int plate);

/* Parts, plates and filaments, as `burnish info --json` describes them. Sets *failed to 1 if memory
 * is short. */
cJSON *cli_contents_json(const burnish_mesh *mesh, const burnish_box *boxes, int *failed);

#endif
