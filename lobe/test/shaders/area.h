/* The lines of lobe/test/data/area.csv. The last two columns of rectangles and discs were integrated over the
 * light's area by adaptive Gauss rules in double precision: within 1e-7. Those of GGX, relative to its
 * albedo, are sums of 2^18 samples of visible normals: within 0.001; zeta is the roughness, the axis V. */
#ifndef TEST_SHADERS_AREA_H
#define TEST_SHADERS_AREA_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { AREA_CASES_MAX = 512 };

typedef enum area_shape { AREA_RECT, AREA_DISC, AREA_GGX, AREA_SHAPES } area_shape;

static const char *const AREA_NAMES[AREA_SHAPES] = {"rect", "disc", "ggx"};
/* Largest differences of a shader's values: the disc is a polygon of 12 corners, GGX a sum of two lobes. */
static const float AREA_ERRORS[AREA_SHAPES] = {2e-5f, 2.5e-3f, 0.06f};

typedef struct area_case {
    float shape, sides, order, zeta; /* of area_shape */
    float center[3], half_u[3], half_v[3], normal[3], axis[3];
    float diffuse, specular; /* expected */
} area_case;

/* Returns how many were read, 0 if none can be. */
static inline int read_area_cases(const char *path, area_case *cases) {
    char line[1024];
    int count = 0;
    FILE *file = fopen(path, "r");
    while (file && count < AREA_CASES_MAX && fgets(line, sizeof line, file)) {
        float *fields = &cases[count].shape;
        char *at = strchr(line, ',');
        int i = 1;
        fields[0] = 0;
        while (fields[0] < AREA_SHAPES && strncmp(line, AREA_NAMES[(int)fields[0]], 3) != 0) {
            ++fields[0];
        }
        for (; at && i < (int)(sizeof *cases / sizeof *fields); ++i) {
            fields[i] = strtof(at + 1, &at);
        }
        count += i == (int)(sizeof *cases / sizeof *fields) && fields[0] < AREA_SHAPES;
    }
    if (file) {
        fclose(file);
    }
    return count;
}

#endif
