/* Structural similarity: Wang, Bovik, Sheikh and Simoncelli, "Image quality assessment: from error
 * visibility to structural similarity", IEEE Transactions on Image Processing 13, 2004. */
#include <string.h>

#include "base/elementary.h"
#include "image/compare.h"

enum {
    REACH = BURNISH_SSIM_TAPS / 2,
    MOMENTS = 5 /* a, b, a a, b b, a b */
};

static const double sigma = 1.5;
static const double c1 = (0.01 * 255) * (0.01 * 255), c2 = (0.03 * 255) * (0.03 * 255);

/* The rows of a band, each filtered along x, of which a window's BURNISH_SSIM_TAPS are kept. */
typedef struct rows {
    double *luma[2];                             /* of the row that is read */
    double *product;                             /* one moment of it */
    double *moments[BURNISH_SSIM_TAPS][MOMENTS]; /* row y at y % BURNISH_SSIM_TAPS */
    uint8_t *codes;
} rows;

burnish_ssim burnish_ssim_make(void) {
    burnish_ssim made;
    double sum = 0;
    for (int i = 0; i < BURNISH_SSIM_TAPS; ++i) {
        const double x = i - REACH;
        made.weights[i] = burnish_expm1(-x * x / (2 * sigma * sigma)) + 1;
        sum += made.weights[i];
    }
    for (int i = 0; i < BURNISH_SSIM_TAPS; ++i) {
        made.weights[i] /= sum;
    }
    return made;
}

size_t burnish_ssim_scratch(int width) {
    return (size_t)width * (sizeof(double) * (3 + BURNISH_SSIM_TAPS * MOMENTS) + 3);
}

static rows lay_out(void *scratch, int width) {
    rows made;
    double *next = scratch;
    const size_t row = (size_t)width;
    made.luma[0] = next;
    made.luma[1] = next + row;
    made.product = next + 2 * row;
    next += 3 * row;
    for (int i = 0; i < BURNISH_SSIM_TAPS; ++i) {
        for (int k = 0; k < MOMENTS; ++k, next += row) {
            made.moments[i][k] = next;
        }
    }
    made.codes = (uint8_t *)next;
    return made;
}

/* sum over i of weights[i] values[x + i] for every window along the row. */
static void filter_windows(const double *restrict weights, const double *restrict values,
                           int windows, double *restrict sums) {
    for (int x = 0; x < windows; ++x) {
        double sum = 0;
        for (int i = 0; i < BURNISH_SSIM_TAPS; ++i) {
            sum += weights[i] * values[x + i];
        }
        sums[x] = sum;
    }
}

static void multiply_rows(const double *restrict a, const double *restrict b, int count,
                          double *restrict product) {
    for (int x = 0; x < count; ++x) {
        product[x] = a[x] * b[x];
    }
}

static void read_row(const burnish_ssim *ssim, const burnish_picture_pair *pair, int y, rows *r) {
    static const int factors[MOMENTS - 2][2] = {{0, 0}, {1, 1}, {0, 1}};
    const int windows = pair->width - 2 * REACH;
    double **moments = r->moments[y % BURNISH_SSIM_TAPS];
    for (int which = 0; which < 2; ++which) {
        burnish_pair_row(pair, which, y, r->codes);
        for (int x = 0; x < pair->width; ++x) { /* BT.601 */
            const uint8_t *code = r->codes + 3 * (size_t)x;
            r->luma[which][x] = (299 * code[0] + 587 * code[1] + 114 * code[2]) / 1000.0;
        }
        filter_windows(ssim->weights, r->luma[which], windows, moments[which]);
    }
    for (int i = 0; i < MOMENTS - 2; ++i) {
        multiply_rows(r->luma[factors[i][0]], r->luma[factors[i][1]], pair->width, r->product);
        filter_windows(ssim->weights, r->product, windows, moments[2 + i]);
    }
}

/* The windows of one row of middles. */
static double sum_row(const burnish_ssim *ssim, const rows *r, int y, int windows) {
    double sum = 0;
    for (int x = 0; x < windows; ++x) {
        double mean[MOMENTS] = {0};
        for (int i = 0; i < BURNISH_SSIM_TAPS; ++i) {
            double *const *row = r->moments[(y - REACH + i) % BURNISH_SSIM_TAPS];
            for (int k = 0; k < MOMENTS; ++k) {
                mean[k] += ssim->weights[i] * row[k][x];
            }
        }
        const double product = mean[0] * mean[1];
        const double squares = mean[0] * mean[0] + mean[1] * mean[1];
        const double covariance = mean[4] - product, variances = mean[2] + mean[3] - squares;
        sum += (2 * product + c1) * (2 * covariance + c2) / ((squares + c1) * (variances + c2));
    }
    return sum;
}

double burnish_ssim_band(const burnish_ssim *ssim, const burnish_picture_pair *pair,
                         burnish_band band, void *scratch) {
    rows r = lay_out(scratch, pair->width);
    const int windows = pair->width - 2 * REACH;
    const int first = band.first > REACH ? band.first : REACH;
    const int end = band.end < pair->height - REACH ? band.end : pair->height - REACH;
    double sum = 0;
    for (int y = first - REACH; y < end + REACH && first < end && windows > 0; ++y) {
        read_row(ssim, pair, y, &r);
        if (y >= first + REACH) {
            sum += sum_row(ssim, &r, y - REACH, windows);
        }
    }
    return sum;
}
