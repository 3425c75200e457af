/* The floating-point environment that bits are promised in: rounding to nearest, subnormal numbers
 * kept. Every public function that computes enters it and puts back what its caller had. */
#ifndef BURNISH_CORE_ENVIRONMENT_H
#define BURNISH_CORE_ENVIRONMENT_H

#include <stdint.h>

#if defined(__SSE__)
#include <xmmintrin.h>

/* MXCSR: every exception masked, round to nearest, neither FTZ nor DAZ. */
#define BURNISH_ENVIRONMENT_DEFAULT 0x1f80u

typedef uint32_t burnish_environment;

static inline burnish_environment burnish_environment_enter(void) {
    const burnish_environment before = _mm_getcsr();
    _mm_setcsr(BURNISH_ENVIRONMENT_DEFAULT);
    return before;
}

static inline void burnish_environment_leave(burnish_environment before) {
    _mm_setcsr(before);
}

#elif defined(__aarch64__)

typedef uint64_t burnish_environment; /* FPCR */

static inline burnish_environment burnish_environment_enter(void) {
    burnish_environment before;
    __asm__ volatile("mrs %0, fpcr" : "=r"(before));
    __asm__ volatile("msr fpcr, %0" : : "r"((uint64_t)0));
    return before;
}

static inline void burnish_environment_leave(burnish_environment before) {
    __asm__ volatile("msr fpcr, %0" : : "r"(before));
}

#else
#include <fenv.h>

typedef fenv_t burnish_environment;

static inline burnish_environment burnish_environment_enter(void) {
    burnish_environment before;
    fegetenv(&before);
    fesetenv(FE_DFL_ENV);
    return before;
}

static inline void burnish_environment_leave(burnish_environment before) {
    fesetenv(&before);
}
#endif

#endif
