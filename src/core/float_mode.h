/* The floating-point environment that bits are promised in: rounding to nearest, subnormal numbers
 * kept. Every public function that computes enters it and puts back what its caller had. */
#ifndef BURNISH_CORE_FLOAT_MODE_H
#define BURNISH_CORE_FLOAT_MODE_H

#include <stdint.h>

#if defined(__SSE__)
#include <xmmintrin.h>

/* MXCSR: every exception masked, round to nearest, neither FTZ nor DAZ. */
#define BURNISH_FLOAT_MODE_DEFAULT 0x1f80u

typedef uint32_t burnish_float_mode;

static inline burnish_float_mode burnish_float_mode_enter(void) {
    const burnish_float_mode before = _mm_getcsr();
    _mm_setcsr(BURNISH_FLOAT_MODE_DEFAULT);
    return before;
}

static inline void burnish_float_mode_leave(burnish_float_mode before) {
    _mm_setcsr(before);
}

#elif defined(__aarch64__)

typedef uint64_t burnish_float_mode; /* FPCR */

static inline burnish_float_mode burnish_float_mode_enter(void) {
    burnish_float_mode before;
    __asm__ volatile("mrs %0, fpcr" : "=r"(before));
    __asm__ volatile("msr fpcr, %0" : : "r"((uint64_t)0));
    return before;
}

static inline void burnish_float_mode_leave(burnish_float_mode before) {
    __asm__ volatile("msr fpcr, %0" : : "r"(before));
}

#else
#include <fenv.h>

typedef fenv_t burnish_float_mode;

static inline burnish_float_mode burnish_float_mode_enter(void) {
    burnish_float_mode before;
    fegetenv(&before);
    fesetenv(FE_DFL_ENV);
    return before;
}

static inline void burnish_float_mode_leave(burnish_float_mode before) {
    fesetenv(&before);
}
#endif

#endif
