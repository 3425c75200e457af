/* Writes hardware/firmware/object.h: the trefoil knot that the firmware turns, as a closed grid of
 * rings in bytes.
 *
 *     cc -O2 scripts/generate/firmware_object.c -lm -o /tmp/object && /tmp/object >
 * hardware/firmware/object.h
 */
#include <math.h>
#include <stdio.h>

enum { RINGS = 60, SEGMENTS = 10 };

#define PI 3.14159265358979323846
#define TUBE 0.62           /* radius of the tube */
#define SCALE (127.0 / 3.7) /* the knot's largest radius is 3 + TUBE */

static void unit(double v[3]) {
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; ++k) {
        v[k] /= length;
    }
}

/* A point of the knot: it winds 3 times round a ring's core while going round it twice. */
static void knot(double t, double p[3]) {
    p[0] = (2 + cos(3 * t)) * cos(2 * t);
    p[1] = (2 + cos(3 * t)) * sin(2 * t);
    p[2] = sin(3 * t);
}

/* The direction of the tube at t, and two directions across it that close after one turn. */
static void frame(double t, double along[3], double out[3], double side[3]) {
    double a[3], b[3];
    knot(t - 1e-5, a);
    knot(t + 1e-5, b);
    for (int k = 0; k < 3; ++k) {
        along[k] = b[k] - a[k];
    }
    unit(along);
    out[0] = cos(3 * t) * cos(2 * t);
    out[1] = cos(3 * t) * sin(2 * t);
    out[2] = sin(3 * t);
    const double dot = out[0] * along[0] + out[1] * along[1] + out[2] * along[2];
    for (int k = 0; k < 3; ++k) {
        out[k] -= dot * along[k];
    }
    unit(out);
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        side[k] = along[i] * out[j] - along[j] * out[i];
    }
}

int main(void) {
    printf(
        "/* The object that the firmware turns: made by scripts/generate/firmware_object.c.\n"
        " * A trefoil knot, a tube of %d rings of %d points, both closed; for each point x, y, z\n"
        " * and the unit normal, 127 being 1. */\n"
        "#ifndef BURNISH_FIRMWARE_OBJECT_H\n#define BURNISH_FIRMWARE_OBJECT_H\n\n"
        "#include \"flash.h\"\n\n"
        "enum { OBJECT_RINGS = %d, OBJECT_SEGMENTS = %d };\n\n"
        "/* clang-format off */\n"
        "static const int8_t object_points[OBJECT_RINGS][OBJECT_SEGMENTS][6] FLASH = {\n",
        RINGS, SEGMENTS, RINGS, SEGMENTS);
    for (int ring = 0; ring < RINGS; ++ring) {
        const double t = 2 * PI * ring / RINGS;
        double p[3], along[3], out[3], side[3];
        knot(t, p);
        frame(t, along, out, side);
        printf("    {");
        for (int segment = 0; segment < SEGMENTS; ++segment) {
            const double angle = 2 * PI * segment / SEGMENTS;
            int position[3], normal[3];
            for (int k = 0; k < 3; ++k) {
                const double n = cos(angle) * out[k] + sin(angle) * side[k];
                position[k] = (int)lrint(SCALE * (p[k] + TUBE * n));
                normal[k] = (int)lrint(127 * n);
            }
            printf("%s{%d,%d,%d,%d,%d,%d}", segment ? "," : "", position[0], position[1],
                   position[2], normal[0], normal[1], normal[2]);
        }
        printf("},\n");
    }
    printf("};\n/* clang-format on */\n\n#endif\n");
    return 0;
}
