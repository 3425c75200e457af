/* Refuses compilers' options that would break the promise of bits: every operation rounds once, to
 * its own type, in the order that is written. Every file of the library sees this (a test tries).
 */
#ifndef BURNISH_BASE_ARITHMETIC_H
#define BURNISH_BASE_ARITHMETIC_H

#include <float.h>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) ||           \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error                                                                                             \
    "burnish gives the same pixels everywhere: build it without -ffast-math and its parts (-Ofast, -ffinite-math-only, -fassociative-math)"
#endif

#if !defined(FLT_EVAL_METHOD) || FLT_EVAL_METHOD != 0
#error                                                                                             \
    "burnish gives the same pixels everywhere: float must be computed as float. Add -msse2 -mfpmath=sse on i386, -fexcess-precision=fast on s390x"
#endif

#endif
