/* The lines of test/data/area.csv, whose last two columns were integrated over the light's area by
 * adaptive Gauss rules in double precision: within 1e-7, ellipses as polygons of 2,048 corners. */
#ifndef TEST_SHADERS_AREA_H
#define TEST_SHADERS_AREA_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { AREA_CASES_MAX = 512 };

typedef struct area_case {
    float is_disc, sides, order, zeta;
    float center[3], half_u[3], half_v[3], normal[3], axis[3];
    float diffuse, specular; /* expected */
} area_case;

/* Largest differences of a shader's values: the disc is a polygon of 12 corners. */
static const float AREA_ERROR_RECT = 2e-5f, AREA_ERROR_DISC = 2.5e-3f;

/* Returns how many were read, 0 if none can be. */
static inline int read_area_cases(const char *path, area_case *cases) {
    char line[1024];
    int count = 0;
    FILE *file = fopen(path, "r");
    while (file && count < AREA_CASES_MAX && fgets(line, sizeof line, file)) {
        float *fields = &cases[count].is_disc;
        char *at = strchr(line, ',');
        int i = 1;
        fields[0] = strncmp(line, "disc", 4) == 0;
        for (; at && i < (int)(sizeof *cases / sizeof *fields); ++i) {
            fields[i] = strtof(at + 1, &at);
        }
        count += i == (int)(sizeof *cases / sizeof *fields) && cases[count].zeta > 0.0f;
    }
    if (file) {
        fclose(file);
    }
    return count;
}

#endif
