/* Coordinates as users know them, those of the file: a mesh's with its origin added. */
#ifndef BURNISH_CLI_ORIGIN_H
#define BURNISH_CLI_ORIGIN_H

#include "cli/output.h"

/* The number of fewest digits that a coordinate of the file can have been. */
double cli_file_coordinate(float value, double origin);

/* An array of 3, in the fewest digits; NULL when out of memory. */
cJSON *cli_json_position(const float position[3], const double origin[3]);
cJSON *cli_json_real_position(const double position[3], const double origin[3]);

#endif
