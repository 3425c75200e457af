#include "cli/coordinates.h"

#include <stdio.h>
#include <stdlib.h>

double cli_file_coordinate(float value, double origin) {
    enum { EXACT = 17 }; /* digits that identify any double */
    const double exact = (double)value + origin;
    char text[40];
    if (origin == 0) {
        return exact;
    }
    for (int digits = 1; digits < EXACT; ++digits) {
        snprintf(text, sizeof text, "%.*g", digits, exact);
        const double shorter = strtod(text, NULL);
        if ((float)(shorter - origin) == value) {
            return shorter;
        }
    }
    return exact;
}

cJSON *cli_json_position(const float position[3], const double origin[3]) {
    double file[3];
    if (origin[0] == 0 && origin[1] == 0 && origin[2] == 0) {
        return cli_json_floats(3, position);
    }
    for (int k = 0; k < 3; ++k) {
        file[k] = cli_file_coordinate(position[k], origin[k]);
    }
    return cli_json_reals(3, file);
}

cJSON *cli_json_real_position(const double position[3], const double origin[3]) {
    const double file[3] = {position[0] + origin[0], position[1] + origin[1],
                            position[2] + origin[2]};
    return cli_json_reals(3, file);
}
