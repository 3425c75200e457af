/* Coordinates of the input file: coordinates of a mesh plus its origin. */
#ifndef TOOL_CLI_COORDINATES_H
#define TOOL_CLI_COORDINATES_H

#include "base/cli/output.h"

/* The number with the fewest digits that the file's coordinate can have been. */
double cli_file_coordinate(float value, double origin);

/* An array of 3 such numbers; NULL when out of memory. */
cJSON *cli_json_position(const float position[3], const double origin[3]);
cJSON *cli_json_real_position(const double position[3], const double origin[3]);

#endif
