/* Sweeps over the bit patterns of a float: every lobe of burnish/lobe.h must give a finite value in
 * [0, 1] for each of them, the family must not decrease, and each must keep the accuracy that
 * lobe.h states. test_lobe takes strides through them, sweep_lobe all 2^32. */
#ifndef BURNISH_TEST_SWEEP_H
#define BURNISH_TEST_SWEEP_H

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "burnish/lobe.h"
#include "support.h"

/* The meaning of the swept float. */
typedef enum {
    SWEEP_FAMILY,           /* cosine of the family; also through at_lambda */
    SWEEP_COMPOSITE,        /* the same of a composite; its order is the multiplications */
    SWEEP_SCHLICK,          /* cosine */
    SWEEP_GX,               /* cosine */
    SWEEP_LYON,             /* x of n = (x, .6, .8), nearly of unit length around 0 */
    SWEEP_SCHLICK_EXPONENT, /* exponent at cosine .99 */
    SWEEP_GX_EXPONENT,      /* the same */
    SWEEP_LYON_EXPONENT,    /* the same, between two fixed vectors */
    SWEEP_ZETA,             /* zeta handed to burnish_lobe_from_zeta */
    SWEEP_CREATE,           /* exponent handed to burnish_lobe_create */
    SWEEP_CREATE_COMPOSITE  /* exponent handed to burnish_composite_create: the peak */
} sweep_kind;

/* Instead of a fit. */
#define NO_FIT BURNISH_FIT_MINIMAX

/* One sweep. fit and order where the lobe has them; exponent where it is not swept. */
typedef struct {
    const char *name;
    sweep_kind kind;
    burnish_lobe_fit fit;
    int order;
    float exponent;
} sweep_case;

static const sweep_case sweep_cases[] = {
    {"family", SWEEP_FAMILY, BURNISH_FIT_SHIFT3, 2, 1},
    {"family", SWEEP_FAMILY, BURNISH_FIT_ENERGY, 2, 10},
    {"family", SWEEP_FAMILY, BURNISH_FIT_SHIFT7, 2, 100},
    {"family", SWEEP_FAMILY, BURNISH_FIT_ENERGY, 2, 65536},
    {"family", SWEEP_FAMILY, BURNISH_FIT_TAYLOR, 2, 3},
    {"family", SWEEP_FAMILY, BURNISH_FIT_ENERGY, 4, 50},
    {"family", SWEEP_FAMILY, BURNISH_FIT_ENERGY, 8, 50},
    {"family", SWEEP_FAMILY, BURNISH_FIT_ENERGY, 16, 100},
    {"family", SWEEP_FAMILY, BURNISH_FIT_ENERGY, 32, 100},
    {"composite", SWEEP_COMPOSITE, NO_FIT, 2, 3},
    {"composite", SWEEP_COMPOSITE, NO_FIT, 3, 10},
    {"composite", SWEEP_COMPOSITE, NO_FIT, 4, 1.5f},
    {"composite", SWEEP_COMPOSITE, NO_FIT, 5, 100},
    {"composite", SWEEP_COMPOSITE, NO_FIT, 6, 65536},
    {"schlick", SWEEP_SCHLICK, NO_FIT, 0, 1},
    {"schlick", SWEEP_SCHLICK, NO_FIT, 0, 100},
    {"schlick", SWEEP_SCHLICK, NO_FIT, 0, 65536},
    {"gx", SWEEP_GX, NO_FIT, 0, 1},
    {"gx", SWEEP_GX, NO_FIT, 0, 100},
    {"lyon", SWEEP_LYON, BURNISH_FIT_TAYLOR, 2, 10},
    {"lyon", SWEEP_LYON, BURNISH_FIT_TAYLOR, 8, 65536},
    {"schlick of exponent", SWEEP_SCHLICK_EXPONENT, NO_FIT, 0, 0},
    {"gx of exponent", SWEEP_GX_EXPONENT, NO_FIT, 0, 0},
    {"lyon of exponent", SWEEP_LYON_EXPONENT, BURNISH_FIT_TAYLOR, 4, 0},
    {"from_zeta", SWEEP_ZETA, NO_FIT, 8, 0},
    {"create", SWEEP_CREATE, BURNISH_FIT_TAYLOR, 32, 0},
    {"create", SWEEP_CREATE, BURNISH_FIT_ENERGY, 2, 0},
    {"create composite", SWEEP_CREATE_COMPOSITE, NO_FIT, 3, 0},
    {"create composite", SWEEP_CREATE_COMPOSITE, NO_FIT, 4, 0},
    {"create composite", SWEEP_CREATE_COMPOSITE, NO_FIT, 5, 0},
    {"create composite", SWEEP_CREATE_COMPOSITE, NO_FIT, 6, 0},
};
enum { SWEEP_CASE_COUNT = sizeof sweep_cases / sizeof sweep_cases[0] };

/* The accuracy that lobe.h states, for every exponent: largest errors, `absolute` in units of
 * 2^-24, `relative` in units in the last place where the exact value is at least 2^-10. */
typedef struct {
    sweep_kind kind;
    int order;
    double absolute, relative;
} sweep_bound;

static const sweep_bound sweep_bounds[] = {
    {SWEEP_FAMILY, 2, 2.25, 70},    {SWEEP_FAMILY, 4, 4, 30},       {SWEEP_FAMILY, 8, 8, 24},
    {SWEEP_FAMILY, 16, 16, 32},     {SWEEP_FAMILY, 32, 32, 50},     {SWEEP_SCHLICK, 0, 1.75, 4},
    {SWEEP_GX, 0, 2, 5.5},          {SWEEP_COMPOSITE, 2, 2.25, 70}, {SWEEP_COMPOSITE, 3, 4.75, 65},
    {SWEEP_COMPOSITE, 4, 9.75, 65}, {SWEEP_COMPOSITE, 5, 20, 65},   {SWEEP_COMPOSITE, 6, 35, 65},
};
enum { SWEEP_BOUND_COUNT = sizeof sweep_bounds / sizeof sweep_bounds[0] };

/* The bound of a case, NULL where lobe.h states none. */
static inline const sweep_bound *sweep_find_bound(sweep_kind kind, int order) {
    for (int i = 0; i < SWEEP_BOUND_COUNT; ++i) {
        if (sweep_bounds[i].kind == kind && sweep_bounds[i].order == order) {
            return &sweep_bounds[i];
        }
    }
    return NULL;
}

/* The result of a sweep. */
typedef struct {
    uint64_t values;       /* evaluated */
    uint64_t outside;      /* not finite, or not in [0, 1], or not 0 for NaN */
    uint64_t decreasing;   /* smaller than at the next lower float */
    uint64_t inconsistent; /* at_lambda differs from at_cosine; a lobe made from bad arguments */
    uint64_t compared;     /* with the exact value, whose largest differences are: */
    double absolute, relative;
} sweep_result;

/* x clamped to [0, 1] in double; the values here are never NaN. */
static inline double sweep_saturate(double x) {
    return x < 0 ? 0 : (x > 1 ? 1 : x);
}

/* The lobe of a case, for SWEEP_FAMILY and SWEEP_COMPOSITE. */
typedef struct {
    burnish_lobe family;
    burnish_composite composite;
} sweep_lobe;

/* Makes it; returns 1 and the cosine's distance from 1 to the lobe's end if there is one. */
static inline int sweep_make(const sweep_case *c, sweep_lobe *lobe, double *width) {
    memset(lobe, 0, sizeof *lobe);
    *width = 1;
    if (c->kind == SWEEP_COMPOSITE) {
        const burnish_composite_aim aim =
            c->fit == NO_FIT ? BURNISH_COMPOSITE_MINIMAX : BURNISH_COMPOSITE_DISPLAY;
        int made = !burnish_composite_create(&lobe->composite, aim, c->order, c->exponent);
        *width = (double)lobe->composite.top / (double)lobe->composite.slope;
        return made;
    }
    if (c->kind != SWEEP_FAMILY) {
        return 1;
    }
    int made = !burnish_lobe_create(&lobe->family, c->fit, c->order, c->exponent);
    *width = lobe->family.zeta < 0.5f ? 2 : 1 / (double)lobe->family.zeta;
    return made;
}

/* The exact value of a lobe at a cosine, with a relative error of a few 2^-53. */
static inline double sweep_exact(const sweep_case *c, const sweep_lobe *made, double cosine) {
    double n = (double)c->exponent;
    if (c->kind == SWEEP_COMPOSITE) {
        const burnish_composite *lobe = &made->composite;
        double v = (double)lobe->top - (double)lobe->slope * (1 - cosine);
        v = v < 0 ? 0 : (v > (double)lobe->top ? (double)lobe->top : v);
        v *= v;
        for (int i = 0; i < lobe->multiplications - 2; ++i) {
            v *= v + (double)lobe->offset[i];
        }
        return v;
    }
    const burnish_lobe lobe = made->family;
    if (c->kind == SWEEP_FAMILY) {
        double u = sweep_saturate(1 - (double)lobe.zeta * (1 - cosine));
        for (int power = 1; power < lobe.order; power *= 2) {
            u *= u;
        }
        return u;
    }
    cosine = sweep_saturate(cosine);
    if (c->kind == SWEEP_SCHLICK) {
        return cosine / (cosine + n * (1 - cosine));
    }
    return cosine * cosine / (cosine * cosine + n / 2 * ((1 - cosine) * (1 + cosine)));
}

/* The unit in the last place of a float at a normal value: its power of two times 2^-23. */
static inline double sweep_unit(double exact) {
    uint64_t bits;
    memcpy(&bits, &exact, sizeof bits);
    bits &= 0x7ff0000000000000u;
    memcpy(&exact, &bits, sizeof exact);
    return exact * 0x1p-23;
}

/* Notes the error of a float value. */
static inline void sweep_compare(sweep_result *result, float value, double exact) {
    ++result->compared;
    double error = (double)value - exact;
    error = error < 0 ? -error : error;
    if (error > result->absolute) {
        result->absolute = error;
    }
    if (exact >= 0x1p-10 && error > result->relative * sweep_unit(exact)) {
        result->relative = error / sweep_unit(exact);
    }
}

/* The value of the swept function at x. */
static inline float sweep_value(const sweep_case *c, const sweep_lobe *made, float x) {
    burnish_lobe lobe = made->family;
    burnish_composite composite;
    static const float unit[3] = {0.0f, 0.6f, 0.8f}, other[3] = {0.1f, 0.55f, 0.83f};
    float vector[3] = {x, 0.6f, 0.8f};
    switch (c->kind) {
    case SWEEP_FAMILY:
        return burnish_lobe_at_cosine(lobe, x);
    case SWEEP_COMPOSITE:
        return burnish_composite_at_cosine(made->composite, x);
    case SWEEP_SCHLICK:
        return burnish_schlick_at_cosine(x, c->exponent);
    case SWEEP_GX:
        return burnish_gx_at_cosine(x, c->exponent);
    case SWEEP_LYON:
        return burnish_lyon_at_vectors(vector, unit, c->exponent, c->order);
    case SWEEP_SCHLICK_EXPONENT:
        return burnish_schlick_at_cosine(0.99f, x);
    case SWEEP_GX_EXPONENT:
        return burnish_gx_at_cosine(0.99f, x);
    case SWEEP_LYON_EXPONENT:
        return burnish_lyon_at_vectors(unit, other, x, c->order);
    case SWEEP_ZETA:
        (void)burnish_lobe_from_zeta(&lobe, x, c->order);
        return burnish_lobe_at_cosine(lobe, 0.75f);
    case SWEEP_CREATE:
        (void)burnish_lobe_create(&lobe, c->fit, c->order, x);
        return burnish_lobe_at_cosine(lobe, 0.75f);
    case SWEEP_CREATE_COMPOSITE:
        (void)burnish_composite_create(&composite, BURNISH_COMPOSITE_MINIMAX, c->order, x);
        return burnish_composite_at_lambda(composite, 0);
    }
    return -1;
}

/* 1 when burnish_lobe_from_zeta or _create accept exactly the range they document, and leave a dark
 * lobe otherwise. */
static inline int sweep_accepts(const sweep_case *c, float x) {
    burnish_lobe lobe;
    burnish_composite composite;
    int wanted = c->kind == SWEEP_ZETA ? x > 0 && x <= 65536 : x >= 1 && x <= 65536;
    burnish_lobe_status status;
    if (c->kind == SWEEP_CREATE_COMPOSITE) {
        status = burnish_composite_create(&composite, BURNISH_COMPOSITE_MINIMAX, c->order, x);
        return (status == BURNISH_LOBE_OK) == wanted &&
               burnish_composite_at_lambda(composite, 0) == (wanted ? 1.0f : 0.0f) &&
               burnish_composite_at_cosine(composite, 0) == 0.0f;
    }
    if (c->kind == SWEEP_CREATE) {
        wanted = wanted && (c->order == 2 || x >= (float)c->order);
        status = burnish_lobe_create(&lobe, c->fit, c->order, x);
    } else {
        status = burnish_lobe_from_zeta(&lobe, x, c->order);
    }
    int made = status == BURNISH_LOBE_OK;
    return made == wanted &&
           (made ? lobe.zeta > 0 && lobe.order == c->order : lobe.zeta == 0 && lobe.order == 0);
}

/* Sweeps every stride-th of the 2^32 bit patterns into *result, which starts as zero. */
static inline void sweep_run(const sweep_case *c, uint64_t stride, sweep_result *result) {
    sweep_lobe lobe;
    double width;
    int comparable = sweep_find_bound(c->kind, c->order) != NULL;
    result->inconsistent += !sweep_make(c, &lobe, &width);
    for (uint64_t bits = 0; bits < (uint64_t)1 << 32; bits += stride) {
        float x = test_float_of_bits((uint32_t)bits);
        float value = sweep_value(c, &lobe, x);
        ++result->values;
        result->outside += !(value >= 0.0f && value <= 1.0f) || (x != x && value != 0.0f);
        if (c->kind == SWEEP_FAMILY || c->kind == SWEEP_COMPOSITE) {
            /* the next pattern is the next float away from 0; at the infinities it is a NaN */
            float next = sweep_value(c, &lobe, test_float_of_bits((uint32_t)bits + 1));
            float same = c->kind == SWEEP_FAMILY
                             ? burnish_lobe_at_lambda(lobe.family, 1.0f - x)
                             : burnish_composite_at_lambda(lobe.composite, 1.0f - x);
            int is_number = (bits & 0x7fffffffu) < 0x7f800000u;
            result->decreasing += is_number && (bits >> 31 ? next > value : next < value);
            result->inconsistent += value != same;
        }
        if (c->kind == SWEEP_ZETA || c->kind >= SWEEP_CREATE) {
            result->inconsistent += !sweep_accepts(c, x);
        }
        /* below 2^-32 the family's lobes and their errors are those of 0; schlick's and gx's are
         * relative to x alone */
        float magnitude = x < 0 ? -x : x;
        if (comparable && magnitude <= 1 && (magnitude >= 0x1p-32f || x == 0)) {
            sweep_compare(result, value, sweep_exact(c, &lobe, (double)x));
        }
    }
}

/* 1 when the errors found keep the bound, and something was compared; prints them. */
static inline int sweep_keeps(const sweep_bound *bound, const sweep_result *result) {
    double absolute = result->absolute * 0x1p+24;
    printf("  absolute %.2f of %.2f, relative %.2f of %.2f", absolute, bound->absolute,
           result->relative, bound->relative);
    return result->compared > 0 && absolute <= bound->absolute &&
           result->relative <= bound->relative;
}

/* 1 when a sweep found nothing wrong; prints its line. */
static inline int sweep_report(const sweep_case *c, const sweep_result *result) {
    static const char *const fits[] = {"taylor", "energy",    "level", "shift7",
                                       "shift3", "projected", "-"};
    const sweep_bound *bound = sweep_find_bound(c->kind, c->order);
    printf("%-19s %-6s %2d %6g: %llu values", c->name, fits[c->fit], c->order, (double)c->exponent,
           (unsigned long long)result->values);
    int good = result->values > 0 && result->outside == 0 && result->decreasing == 0 &&
               result->inconsistent == 0;
    if (bound != NULL) {
        good = sweep_keeps(bound, result) && good;
    }
    if (good) {
        printf("\n");
    } else {
        printf("  WRONG: outside [0, 1] %llu, decreasing %llu, inconsistent %llu\n",
               (unsigned long long)result->outside, (unsigned long long)result->decreasing,
               (unsigned long long)result->inconsistent);
    }
    return good;
}

#endif
