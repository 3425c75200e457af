/* Best constants of composite lobes against cos^n, or against e^-x for n = inf, to 15 digits.
 *
 *   cc -O2 -std=c17 -o composites lobe/scripts/composites.c -lm
 *   ./composites inf 5                 minimax
 *   ./composites 64 5 energy           with the energy of cos^n; curvature: with its curvature
 *   ./composites inf 5 concave         steps may be concave, too; first: the first step is free
 *
 * With x = n lambda and w = max(0, 1 - a x), the first step squares w, and each further one is
 * w <- w (t + (1 - t) w), t = b / (1 + b). For 0 <= t <= 1 it is convex, for 1 < t <= 2 concave and
 * increasing.
 *
 * Levenberg's method lowers the p-norm of the error for growing p, from random constants. Newton's
 * method then solves the conditions for a best approximation: equal errors +-E at the extremes, and
 * weights >= 0 with which their gradients add up to 0. There can be fewer extremes than constants.
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef long double real;

enum {
    STEPS = 8,
    MOST = 10,
    EXTREMES = 12,
    POINTS = 300,
    STARTS = 300,
    SIZE = MOST + EXTREMES + 1
};

typedef enum rule { MINIMAX, ENERGY, CURVATURE } rule;

static real n;      /* the exponent; infinity: e^-x */
static int steps;   /* the first one included */
static int first;   /* the first step that is free: 0 or 1 */
static real t_most; /* 1 or 2 */
static rule kept;   /* what the constants keep; it decides a */
static int count;   /* of constants: t of the free steps, then a */
static uint64_t seed = 1;

static real target(real x, real *slope) {
    if (isinf(n)) {
        *slope = -expl(-x);
        return -*slope;
    }
    real value = x < n ? expl(n * log1pl(-x / n)) : 0;
    *slope = x < n ? -value / (1 - x / n) : 0;
    return value;
}

/* The integral over x from 0 to 1/a, times a. */
static real area(const real t[STEPS]) {
    static real c[(1 << STEPS) + 1], d[(1 << STEPS) + 1];
    memset(c, 0, sizeof c);
    c[1] = 1;
    for (int i = 0, degree = 1; i < steps; ++i, degree *= 2) {
        memset(d, 0, sizeof d);
        for (int j = 1; j <= degree; ++j) {
            d[j] += t[i] * c[j];
            for (int k = 1; k <= degree; ++k) {
                d[j + k] += (1 - t[i]) * c[j] * c[k];
            }
        }
        memcpy(c, d, sizeof c);
    }
    real sum = 0;
    for (int j = 1; j <= 1 << steps; ++j) {
        sum += c[j] / (j + 1);
    }
    return sum;
}

static real slope_of(const real t[STEPS]) {
    real a = kept == ENERGY ? area(t) * (isinf(n) ? 1 : (n + 1) / n) : 1;
    for (int i = 0; i < steps && kept == CURVATURE; ++i) {
        a /= 2 - t[i];
    }
    return a;
}

/* The t of all steps, a, and the derivative of a in each free t. */
static real unpack(const real *v, real t[STEPS], real da[STEPS]) {
    static real last_v[MOST], last_da[STEPS], a;
    memset(t, 0, STEPS * sizeof *t);
    memcpy(t + first, v, (size_t)(steps - first) * sizeof *t);
    if (kept == MINIMAX) {
        return v[count - 1];
    }
    int is_known = a > 0;
    for (int i = 0; i < count; ++i) {
        is_known = is_known && v[i] == last_v[i];
        last_v[i] = v[i];
    }
    if (is_known) {
        memcpy(da, last_da, sizeof last_da);
        return a;
    }
    a = slope_of(t);
    for (int i = first; i < steps; ++i) { /* a polynomial: central differences of fourth order */
        real at[4], t0 = t[i];
        for (int k = 0; k < 4; ++k) {
            t[i] = t0 + (k < 2 ? k - 2 : k - 1) * 1e-4L;
            at[k] = slope_of(t);
        }
        t[i] = t0;
        da[i] = (at[0] - 8 * at[1] + 8 * at[2] - at[3]) / 12e-4L;
    }
    memcpy(last_da, da, sizeof last_da);
    return a;
}

/* lobe - target at x, its gradient and its derivative in x. */
static real error_at(const real *v, real x, real *gradient, real *slope) {
    real t[STEPS], da[STEPS], d[STEPS] = {0}, power_slope;
    real a = unpack(v, t, da), w = fmaxl(0, 1 - a * x), by_u = w > 0 ? 1 : 0;
    for (int i = 0; i < steps; ++i) {
        real p = t[i] + 2 * (1 - t[i]) * w;
        for (int j = first; j < i; ++j) {
            d[j] *= p;
        }
        d[i] = w * (1 - w);
        by_u *= p;
        w *= t[i] + (1 - t[i]) * w;
    }
    real value = w - target(x, &power_slope);
    for (int i = first; i < steps; ++i) {
        gradient[i - first] = d[i] - (kept == MINIMAX ? 0 : by_u * x * da[i]);
    }
    if (kept == MINIMAX) {
        gradient[count - 1] = -by_u * x;
    }
    *slope = -by_u * a - power_slope;
    return value;
}

/* Solves a x = b in place, with pivots; 0 if a is singular. */
static int solve(int size, real a[SIZE][SIZE], real *b) {
    for (int i = 0; i < size; ++i) {
        int best = i;
        for (int j = i + 1; j < size; ++j) {
            best = fabsl(a[j][i]) > fabsl(a[best][i]) ? j : best;
        }
        if (!(fabsl(a[best][i]) > 0)) {
            return 0;
        }
        for (int k = 0; k < size; ++k) {
            real swap = a[i][k];
            a[i][k] = a[best][k];
            a[best][k] = swap;
        }
        real swap = b[i];
        b[i] = b[best];
        b[best] = swap;
        for (int j = 0; j < size; ++j) {
            real factor = j == i ? 0 : a[j][i] / a[i][i];
            for (int k = i; k < size && factor != 0; ++k) {
                a[j][k] -= factor * a[i][k];
            }
            b[j] -= factor * b[i];
        }
    }
    for (int i = 0; i < size; ++i) {
        b[i] /= a[i][i];
    }
    return 1;
}

static real x_at(int i, int points) {
    real s = (real)i / points;
    return s * s * fminl(n, 40);
}

/* The constants from free angles: 0 <= t <= t_most, a n >= 1. */
static void constants(const real *q, real *v, real *dv) {
    for (int i = 0; i < count; ++i) {
        int is_a = kept == MINIMAX && i == count - 1;
        v[i] = is_a ? 1 / n + q[i] * q[i] : t_most * (1 - cosl(q[i])) / 2;
        dv[i] = is_a ? 2 * q[i] : t_most * sinl(q[i]) / 2;
    }
}

static real norm(const real *q, real power, real a[SIZE][SIZE], real *b) {
    real v[MOST], dv[MOST], g[MOST], slope, sum = 0, most = 0, e[POINTS + 1];
    constants(q, v, dv);
    for (int i = 0; i <= POINTS; ++i) {
        e[i] = error_at(v, x_at(i, POINTS), g, &slope);
        most = fmaxl(most, fabsl(e[i]));
    }
    memset(b, 0, SIZE * sizeof *b);
    memset(a, 0, SIZE * sizeof *a);
    for (int i = 0; i <= POINTS; ++i) {
        real weight = powl(fabsl(e[i]) / most, power - 2);
        sum += weight * e[i] * e[i] / (most * most);
        if (weight > 1e-12L) {
            error_at(v, x_at(i, POINTS), g, &slope);
            for (int j = 0; j < count; ++j) {
                b[j] -= weight * e[i] * g[j] * dv[j] / (power - 1);
                for (int k = 0; k < count; ++k) {
                    a[j][k] += weight * g[j] * g[k] * dv[j] * dv[k];
                }
            }
        }
    }
    return logl(most) + logl(sum) / power;
}

static void levenberg(real *q, real power) {
    static real a[SIZE][SIZE], trial_a[SIZE][SIZE];
    real b[SIZE], trial_b[SIZE], damping = 0.1L, before = norm(q, power, a, b);
    for (int i = 0; i < 400 && damping < 1e9L; ++i) {
        real trial[MOST], step[SIZE], trace = 0;
        memcpy(trial_a, a, sizeof a);
        memcpy(step, b, sizeof b);
        for (int j = 0; j < count; ++j) {
            trace += a[j][j];
        }
        for (int j = 0; j < count; ++j) {
            trial_a[j][j] += damping * (a[j][j] + 1e-9L * trace);
        }
        if (!solve(count, trial_a, step)) {
            return;
        }
        for (int j = 0; j < count; ++j) {
            trial[j] = q[j] + step[j];
        }
        real now = norm(trial, power, trial_a, trial_b);
        if (now < before) {
            real gain = before - now;
            memcpy(q, trial, sizeof trial);
            memcpy(a, trial_a, sizeof a);
            memcpy(b, trial_b, sizeof b);
            before = now;
            damping *= 0.3L;
            if (gain < 1e-7L) {
                return;
            }
        } else {
            damping *= 4;
        }
    }
}

/* Local extremes of at least `share` of the largest; returns their number. */
static int find_extremes(const real *v, real share, real *x, real *e, real *most) {
    enum { FINE = 4000 };
    real g[MOST], before, after, all_x[64], all_e[64];
    int found = 0, kept_count = 0;
    *most = 0;
    error_at(v, 0, g, &before);
    for (int i = 1; i <= FINE && found < 64; ++i, before = after) {
        error_at(v, x_at(i, FINE), g, &after);
        if ((before > 0) == (after > 0)) {
            continue;
        }
        real low = x_at(i - 1, FINE), high = x_at(i, FINE), slope;
        for (int k = 0; k < 80; ++k) {
            real middle = (low + high) / 2;
            error_at(v, middle, g, &slope);
            *((slope > 0) == (before > 0) ? &low : &high) = middle;
        }
        all_x[found] = low;
        all_e[found] = error_at(v, low, g, &slope);
        *most = fmaxl(*most, fabsl(all_e[found++]));
    }
    for (int i = 0; i < found && kept_count < EXTREMES; ++i) {
        if (fabsl(all_e[i]) >= share * *most) {
            x[kept_count] = all_x[i];
            e[kept_count++] = all_e[i];
        }
    }
    return kept_count;
}

/* One start of the conditions' solution. Constants at a bound stay there. */
typedef struct system {
    int open[MOST], opens, extremes;
    real v[MOST], weights[EXTREMES], level;
} system_state;

static int residual(const system_state *s, real *f) {
    real x[EXTREMES], e[EXTREMES], g[MOST], most, slope;
    if (find_extremes(s->v, 0.5L, x, e, &most) != s->extremes) {
        return 0;
    }
    memset(f, 0, SIZE * sizeof *f);
    f[s->extremes + s->opens] = -1;
    for (int i = 0; i < s->extremes; ++i) {
        real sign = e[i] > 0 ? 1 : -1;
        error_at(s->v, x[i], g, &slope);
        f[i] = fabsl(e[i]) - s->level;
        for (int j = 0; j < s->opens; ++j) {
            f[s->extremes + j] += s->weights[i] * sign * g[s->open[j]];
        }
        f[s->extremes + s->opens] += s->weights[i];
    }
    return 1;
}

static real *variable(system_state *s, int i) {
    return i < s->opens       ? &s->v[s->open[i]]
           : i < s->opens + 1 ? &s->level
                              : &s->weights[i - s->opens - 1];
}

/* Weights for given extremes by least squares, so that gradients nearly add up to 0. */
static int first_weights(system_state *s, const real *x, const real *e) {
    static real a[SIZE][SIZE];
    real b[SIZE] = {0}, g[EXTREMES][MOST], slope;
    memset(a, 0, sizeof a);
    for (int i = 0; i < s->extremes; ++i) {
        error_at(s->v, x[i], g[i], &slope);
        for (int j = 0; j <= i; ++j) {
            for (int k = 0; k < s->opens; ++k) {
                real product = g[i][s->open[k]] * g[j][s->open[k]];
                a[i][j] += (e[i] > 0) == (e[j] > 0) ? product : -product;
            }
            a[j][i] = a[i][j];
        }
        a[i][i] += 1e-12L;
        a[i][s->extremes] = a[s->extremes][i] = 1;
    }
    b[s->extremes] = 1;
    if (!solve(s->extremes + 1, a, b)) {
        return 0;
    }
    memcpy(s->weights, b, (size_t)s->extremes * sizeof *b);
    return 1;
}

static int newton(system_state *s) {
    static real a[SIZE][SIZE];
    real x[EXTREMES], e[EXTREMES], f[SIZE], moved[SIZE];
    s->opens = 0;
    for (int i = 0; i < count; ++i) {
        int is_a = kept == MINIMAX && i == count - 1;
        real low = is_a ? 1 / n : 0, high = is_a ? HUGE_VALL : t_most;
        if (s->v[i] - low < 1e-5L || high - s->v[i] < 1e-5L) {
            s->v[i] = s->v[i] - low < 1e-5L ? low : high;
        } else {
            s->open[s->opens++] = i;
        }
    }
    s->extremes = find_extremes(s->v, 0.5L, x, e, &s->level);
    if (!first_weights(s, x, e)) {
        return 0;
    }
    int size = s->extremes + s->opens + 1;
    for (int round = 0; round < 10; ++round) {
        if (!residual(s, f)) {
            return 0;
        }
        for (int j = 0; j < size; ++j) {
            real *y = variable(s, j), old = *y, h = 1e-11L * fmaxl(fabsl(old), 1e-3L);
            *y = old + h;
            if (!residual(s, moved)) {
                return 0;
            }
            *y = old;
            for (int i = 0; i < size; ++i) {
                a[i][j] = (moved[i] - f[i]) / h;
            }
        }
        if (!solve(size, a, f)) {
            return 0;
        }
        real largest = 0;
        for (int j = 0; j < size; ++j) {
            *variable(s, j) -= f[j];
            largest = j < s->opens ? fmaxl(largest, fabsl(f[j])) : largest;
        }
        if (largest < 1e-16L) {
            return 1;
        }
    }
    return 1;
}

static real uniform(void) {
    seed = seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (real)(seed >> 11) * 0x1p-53L;
}

static void print(const system_state *s, real error, int is_solved) {
    real t[STEPS], da[STEPS], x[EXTREMES], e[EXTREMES], most, foot = 1;
    real a = unpack(s->v, t, da);
    printf("n %Lg, %d multiplications: error %.15Lg%s\n", n, steps + 1, error,
           is_solved ? "" : " (conditions not solved)");
    printf("  zeta/n %.15Lg, zeta %.15Lg\n", a, a * n);
    for (int i = first; i < steps; ++i) {
        printf("  t %.15Lg  b %.15Lg\n", t[i], t[i] / (1 - t[i]));
        foot *= i > 0 ? t[i] : 1;
    }
    printf("  foot %.6Lg, energy %.9Lg", foot, area(t) / a * (isinf(n) ? 1 : (n + 1) / n));
    int extremes = find_extremes(s->v, 0.999L, x, e, &most);
    printf(", %d extremes:", extremes);
    for (int i = 0; i < extremes; ++i) {
        printf(" %c%.6Lf (%.4Lf)", e[i] > 0 ? '+' : '-', x[i], is_solved ? s->weights[i] : NAN);
    }
    printf("\n");
}

/* The best of all starts; returns its error. */
static real search(system_state *best, int *is_solved) {
    real least = HUGE_VALL, x[EXTREMES], e[EXTREMES];
    for (int start = 0; start < 10 << count; ++start) {
        real q[MOST], dv[MOST], error;
        system_state s = {0};
        for (int i = 0; i < count; ++i) {
            q[i] = acosl(1 - 2 * powl(uniform(), i + 1));
        }
        if (kept == MINIMAX) {
            q[count - 1] = sqrtl(0.4L / (1 << (steps / 2)) * (0.3L + uniform()));
        }
        levenberg(q, 2);
        constants(q, s.v, dv);
        find_extremes(s.v, 0.5L, x, e, &error);
        if (error > 2 * least) {
            continue;
        }
        for (real power = 4; power < 600; power *= 2) {
            levenberg(q, power);
        }
        constants(q, s.v, dv);
        find_extremes(s.v, 0.5L, x, e, &error);
        system_state better = s;
        real better_error;
        int worked = newton(&better);
        find_extremes(better.v, 0.5L, x, e, &better_error);
        worked = worked && better_error < error;
        for (int i = 0; i < better.extremes && worked; ++i) {
            worked = better.weights[i] >= 0;
        }
        error = worked ? better_error : error;
        if (error < least * (1 - 1e-9L)) {
            least = error;
            *best = worked ? better : s;
            *is_solved = worked;
        }
    }
    return least;
}

int main(int argc, char **argv) {
    if (argc < 3 || argc > 4 || atoi(argv[2]) < 2 || atoi(argv[2]) > STEPS) {
        fprintf(stderr,
                "composites: write n (or inf), 2 to %d multiplications, and optionally energy, "
                "curvature, concave or first\n",
                STEPS);
        return 2;
    }
    const char *word = argc > 3 ? argv[3] : "";
    n = strtold(argv[1], NULL);
    steps = atoi(argv[2]) - 1;
    first = strcmp(word, "first") != 0;
    t_most = strcmp(word, "concave") == 0 ? 2 : 1;
    kept = strcmp(word, "energy") == 0      ? ENERGY
           : strcmp(word, "curvature") == 0 ? CURVATURE
                                            : MINIMAX;
    count = steps - first + (kept == MINIMAX);
    system_state best = {0};
    int is_solved = 0;
    real least = search(&best, &is_solved);
    print(&best, least, is_solved);
    return 0;
}
