/* FLIP for pictures of a display: Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem and
 * Fairchild, "FLIP: A Difference Evaluator for Alternating Images", Proceedings of the ACM on
 * Computer Graphics and Interactive Techniques 3(2), 2020; constants as in its section 4 and 5. The
 * viewer sees 67 pixels per degree: a display of 3840 pixels in 0.7 m, from 0.7 m away.
 *
 * Every filter is separable. Rows are filtered along x, kept as long as a window needs them, and
 * filtered along y. Beyond its border a picture goes on with its outermost pixels. */
#include <string.h>

#include "base/elementary.h"
#include "base/numbers.h"
#include "core/srgb.h"
#include "image/compare.h"

enum {
    TAPS = BURNISH_FLIP_TAPS,
    REACH = BURNISH_FLIP_REACH,
    COLORS = 4, /* Y, Cx, and Cz twice */
    PLANES = COLORS + 3
};

static const double pixels_per_degree = 0.7 * 3840 / 0.7 * BURNISH_PI / 180;
static const double feature_width = 0.082; /* degrees */
static const double color_power = 0.7, color_knee = 0.4, knee_error = 0.95;

/* Linear sRGB to XYZ, and what white has there. */
static const double to_xyz[3][3] = {
    {10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794},
    {2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897},
    {1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382}};
static const double from_xyz[3][3] = {{3.241003275, -1.537398934, -0.498615861},
                                      {-0.969224334, 1.875930071, 0.041554224},
                                      {0.055639423, -0.204011202, 1.057148933}};
static const double white[3] = {0.950428545, 1.0, 1.088900371};

/* Which of the planes of a row a filter along x is taken of: Y, Cx, Cz. */
static const int plane_source[PLANES] = {0, 1, 2, 2, 0, 0, 0};

/* The window's rows, and the row that is made of them. */
typedef struct rows {
    float *opponent[3];             /* Y, Cx, Cz of the row that is read, REACH more at each end */
    float *planes[2][PLANES][TAPS]; /* of each picture, filtered along x; row y at y % TAPS */
    float *colors[2][COLORS];       /* filtered along y too */
    float *features[2][4];          /* edges along x and y, points along x and y */
    uint8_t *codes;
} rows;

static double power(double base, double exponent) {
    return base > 0 ? burnish_expm1(exponent * burnish_log(base)) + 1 : 0;
}

/* Cube root of x > 0 within a few ulp: a third of the exponent, then Halley's steps, each of which
 * triples the 5 bits that are right. */
static double cube_root(double x) {
    /* 2/3 of the exponent's bias, less what balances the errors of both signs, 0.0331 of an octave
     */
    const uint64_t bias = UINT64_C(715094163) << 32;
    uint64_t bits;
    double root;
    memcpy(&bits, &x, sizeof bits);
    bits = bits / 3 + bias;
    memcpy(&root, &bits, sizeof root);
    for (int i = 0; i < 3; ++i) {
        const double cube = root * root * root;
        root *= (cube + 2 * x) / (2 * cube + x);
    }
    return root;
}

/* ---- Filters ---- */

static double gaussian(double distance, double variance2) {
    return burnish_expm1(-distance * distance / variance2) + 1;
}

/* A Gaussian of one parameter b of the contrast sensitivity, its weights' sum 1; returns what the
 * sum was. */
static double make_sensitivity(double b, float *weights) {
    double sum = 0, values[TAPS];
    for (int i = 0; i < TAPS; ++i) {
        values[i] = gaussian((i - REACH) / pixels_per_degree, b / (BURNISH_PI * BURNISH_PI));
        sum += values[i];
    }
    for (int i = 0; i < TAPS; ++i) {
        weights[i] = (float)(values[i] / sum);
    }
    return sum;
}

/* weights[i]: the positive ones' sum becomes 1, the negative ones' -1. */
static void balance_weights(const double *values, float *weights) {
    double positive = 0, negative = 0;
    for (int i = 0; i < TAPS; ++i) {
        positive += values[i] > 0 ? values[i] : 0;
        negative -= values[i] < 0 ? values[i] : 0;
    }
    for (int i = 0; i < TAPS; ++i) {
        weights[i] = (float)(values[i] / (values[i] > 0 ? positive : negative > 0 ? negative : 1));
    }
}

static void make_features(burnish_flip *made) {
    const double deviation = 0.5 * feature_width * pixels_per_degree;
    double smooth[TAPS], edge[TAPS], point[TAPS];
    for (int i = 0; i < TAPS; ++i) {
        const double x = i - REACH;
        const int inside = x * x <= 81; /* 3 deviations, 8.2 pixels, rounded up */
        smooth[i] = inside ? gaussian(x, 2 * deviation * deviation) : 0;
        edge[i] = -x * smooth[i];
        point[i] = (x * x / (deviation * deviation) - 1) * smooth[i];
    }
    balance_weights(smooth, made->filters[BURNISH_FLIP_SMOOTH]);
    balance_weights(edge, made->filters[BURNISH_FLIP_EDGE]);
    balance_weights(point, made->filters[BURNISH_FLIP_POINT]);
}

/* ---- Colours ---- */

static void multiply_by_matrix(const double matrix[3][3], const double v[3], double product[3]) {
    for (int i = 0; i < 3; ++i) {
        product[i] = matrix[i][0] * v[0] + matrix[i][1] * v[1] + matrix[i][2] * v[2];
    }
}

/* CIE L*a*b* of linear sRGB, a* and b* times L* / 100 after Hunt. */
static void hunt_lab(const double rgb[3], double lab[3]) {
    const double delta = 6.0 / 29;
    double xyz[3], f[3];
    multiply_by_matrix(to_xyz, rgb, xyz);
    for (int k = 0; k < 3; ++k) {
        const double t = xyz[k] / white[k];
        f[k] = t > delta * delta * delta ? cube_root(t) : t / (3 * delta * delta) + 4.0 / 29;
    }
    lab[0] = 116 * f[1] - 16;
    lab[1] = 0.01 * lab[0] * (500 * (f[0] - f[1]));
    lab[2] = 0.01 * lab[0] * (200 * (f[1] - f[2]));
}

/* HyAB, to the power 0.7. */
static double color_distance(const double a[3], const double b[3]) {
    const double l = a[0] > b[0] ? a[0] - b[0] : b[0] - a[0];
    const double x = a[1] - b[1], y = a[2] - b[2];
    return power(l + burnish_sqrt(x * x + y * y), color_power);
}

burnish_flip burnish_flip_make(void) {
    burnish_flip made;
    static const double blue[2][2] = {{34.1, 0.04}, {13.5, 0.025}}; /* a, b of its Gaussians */
    const double green_rgb[3] = {0, 1, 0}, blue_rgb[3] = {0, 0, 1};
    double volumes[2], green_lab[3], blue_lab[3];
    make_sensitivity(0.0047, made.filters[BURNISH_FLIP_ACHROMATIC]);
    make_sensitivity(0.0053, made.filters[BURNISH_FLIP_RED_GREEN]);
    for (int i = 0; i < 2; ++i) {
        const double b = blue[i][1];
        const double sum = make_sensitivity(b, made.filters[BURNISH_FLIP_BLUE_WIDE + i]);
        volumes[i] = blue[i][0] * burnish_sqrt(BURNISH_PI / b) * sum * sum;
    }
    for (int i = 0; i < 2; ++i) {
        made.blue_shares[i] = volumes[i] / (volumes[0] + volumes[1]);
    }
    make_features(&made);
    hunt_lab(green_rgb, green_lab);
    hunt_lab(blue_rgb, blue_lab);
    made.largest_color = color_distance(green_lab, blue_lab);
    return made;
}

/* ---- Rows ---- */

size_t burnish_flip_scratch(int width) {
    const size_t planes = 3 + 2 * (PLANES * TAPS + COLORS + 4);
    return ((size_t)width * planes + 3 * (size_t)(2 * REACH)) * sizeof(float) + 3 * (size_t)width;
}

static rows lay_out(void *scratch, int width) {
    rows made;
    float *next = scratch;
    const size_t row = (size_t)width;
    for (int k = 0; k < 3; ++k, next += row + 2 * REACH) {
        made.opponent[k] = next;
    }
    for (int which = 0; which < 2; ++which) {
        for (int k = 0; k < PLANES; ++k) {
            for (int i = 0; i < TAPS; ++i, next += row) {
                made.planes[which][k][i] = next;
            }
        }
        for (int k = 0; k < COLORS; ++k, next += row) {
            made.colors[which][k] = next;
        }
        for (int k = 0; k < 4; ++k, next += row) {
            made.features[which][k] = next;
        }
    }
    made.codes = (uint8_t *)next;
    return made;
}

/* sum over i of weights[i] values[x + i]. */
static void filter_x(const float *restrict weights, const float *restrict values, int width,
                     float *restrict sums) {
    for (int x = 0; x < width; ++x) {
        float sum = 0;
        for (int i = 0; i < TAPS; ++i) {
            sum += weights[i] * values[x + i];
        }
        sums[x] = sum;
    }
}

/* The same down the rows around y. */
static void filter_y(const float *restrict weights, float *const kept[TAPS], int y, int height,
                     int width, float *restrict sums) {
    for (int x = 0; x < width; ++x) {
        sums[x] = 0;
    }
    for (int i = 0; i < TAPS; ++i) {
        int from = y + i - REACH;
        from = from < 0 ? 0 : from < height ? from : height - 1;
        const float *restrict row = kept[from % TAPS];
        for (int x = 0; x < width; ++x) {
            sums[x] += weights[i] * row[x];
        }
    }
}

/* Y, Cx, Cz of a row, continued at both ends. */
static void read_opponent(const burnish_picture_pair *pair, int which, int y, rows *r) {
    const int width = pair->width;
    burnish_pair_row(pair, which, y, r->codes);
    for (int x = 0; x < width; ++x) {
        const uint8_t *code = r->codes + 3 * (size_t)x;
        const double rgb[3] = {burnish_srgb_to_linear[code[0]], burnish_srgb_to_linear[code[1]],
                               burnish_srgb_to_linear[code[2]]};
        double xyz[3];
        multiply_by_matrix(to_xyz, rgb, xyz);
        const double luma = xyz[1] / white[1];
        r->opponent[0][x + REACH] = (float)(116 * luma - 16);
        r->opponent[1][x + REACH] = (float)(500 * (xyz[0] / white[0] - luma));
        r->opponent[2][x + REACH] = (float)(200 * (luma - xyz[2] / white[2]));
    }
    for (int k = 0; k < 3; ++k) {
        for (int x = 0; x < REACH; ++x) {
            r->opponent[k][x] = r->opponent[k][REACH];
            r->opponent[k][width + REACH + x] = r->opponent[k][width + REACH - 1];
        }
    }
}

static void read_row(const burnish_flip *flip, const burnish_picture_pair *pair, int y, rows *r) {
    for (int which = 0; which < 2; ++which) {
        read_opponent(pair, which, y, r);
        for (int k = 0; k < PLANES; ++k) {
            filter_x(flip->filters[k], r->opponent[plane_source[k]], pair->width,
                     r->planes[which][k][y % TAPS]);
        }
    }
}

static void filter_rows(const burnish_flip *flip, const burnish_picture_pair *pair, int y,
                        rows *r) {
    static const int along_x[4] = {BURNISH_FLIP_EDGE, BURNISH_FLIP_SMOOTH, BURNISH_FLIP_POINT,
                                   BURNISH_FLIP_SMOOTH};
    static const int along_y[4] = {BURNISH_FLIP_SMOOTH, BURNISH_FLIP_EDGE, BURNISH_FLIP_SMOOTH,
                                   BURNISH_FLIP_POINT};
    for (int which = 0; which < 2; ++which) {
        for (int k = 0; k < COLORS; ++k) {
            filter_y(flip->filters[k], r->planes[which][k], y, pair->height, pair->width,
                     r->colors[which][k]);
        }
        for (int k = 0; k < 4; ++k) {
            filter_y(flip->filters[along_y[k]], r->planes[which][along_x[k]], y, pair->height,
                     pair->width, r->features[which][k]);
        }
    }
}

/* ---- The error of a pixel ---- */

static void filtered_lab(const burnish_flip *flip, float *const colors[COLORS], int x,
                         double lab[3]) {
    const double cz = flip->blue_shares[0] * colors[BURNISH_FLIP_BLUE_WIDE][x] +
                      flip->blue_shares[1] * colors[BURNISH_FLIP_BLUE_NARROW][x];
    const double luma = (colors[BURNISH_FLIP_ACHROMATIC][x] + 16) / 116;
    const double xyz[3] = {white[0] * (luma + colors[BURNISH_FLIP_RED_GREEN][x] / 500),
                           white[1] * luma, white[2] * (luma - cz / 200)};
    double rgb[3];
    multiply_by_matrix(from_xyz, xyz, rgb);
    for (int k = 0; k < 3; ++k) {
        rgb[k] = rgb[k] < 0 ? 0 : rgb[k] < 1 ? rgb[k] : 1;
    }
    hunt_lab(rgb, lab);
}

/* Differences up to the knee take errors up to 0.95, the rest what is left. */
static double color_error(const burnish_flip *flip, const double a[3], const double b[3]) {
    const double distance = color_distance(a, b), knee = color_knee * flip->largest_color;
    if (distance < knee) {
        return knee_error / knee * distance;
    }
    return knee_error + (distance - knee) / (flip->largest_color - knee) * (1 - knee_error);
}

static double length_of_pair(float x, float y) {
    return burnish_sqrt((double)x * x + (double)y * y) / 116; /* Y of white minus Y of black */
}

/* The larger of the differences of edges and of points, raised to 1/2. */
static double feature_error(const rows *r, int x) {
    double largest = 0;
    for (int kind = 0; kind < 4; kind += 2) {
        const double a = length_of_pair(r->features[0][kind][x], r->features[0][kind + 1][x]);
        const double b = length_of_pair(r->features[1][kind][x], r->features[1][kind + 1][x]);
        const double difference = a > b ? a - b : b - a;
        largest = difference > largest ? difference : largest;
    }
    largest *= 0.70710678118654752440; /* of both axes at once */
    return burnish_sqrt(largest < 1 ? largest : 1);
}

static double sum_row(const burnish_flip *flip, const rows *r, int width, float *map) {
    double sum = 0;
    for (int x = 0; x < width; ++x) {
        double a[3], b[3];
        filtered_lab(flip, r->colors[0], x, a);
        filtered_lab(flip, r->colors[1], x, b);
        const double error = power(color_error(flip, a, b), 1 - feature_error(r, x));
        if (map) {
            map[x] = (float)error;
        }
        sum += error;
    }
    return sum;
}

double burnish_flip_band(const burnish_flip *flip, const burnish_picture_pair *pair,
                         burnish_band band, void *scratch, float *map) {
    rows r = lay_out(scratch, pair->width);
    int read = band.first > REACH ? band.first - REACH : 0;
    double sum = 0;
    for (int y = band.first; y < band.end; ++y) {
        for (; read <= y + REACH && read < pair->height; ++read) {
            read_row(flip, pair, read, &r);
        }
        filter_rows(flip, pair, y, &r);
        sum += sum_row(flip, &r, pair->width, map ? map + (size_t)y * (size_t)pair->width : NULL);
    }
    return sum;
}
