/* Loops over arrays of doubles, compiled for AVX2 too where the processor may have it; which one
 * runs is found out at run time. Plain IEEE operations have the same bits in either. */
#ifndef BURNISH_BASE_WIDE_H
#define BURNISH_BASE_WIDE_H

#define BURNISH_ALWAYS_INLINE static inline __attribute__((always_inline))

/* Defines `name` (linkage: static or nothing) with the parameters `declared`; it calls name_body,
 * which must be BURNISH_ALWAYS_INLINE, with `passed`. */
#if defined(__x86_64__) && defined(__GNUC__)
#define BURNISH_WIDE(linkage, name, declared, passed)                                              \
    __attribute__((target("avx2"))) static void name##_avx2 declared {                             \
        name##_body passed;                                                                        \
    }                                                                                              \
    linkage void name declared {                                                                   \
        if (__builtin_cpu_supports("avx2")) {                                                      \
            name##_avx2 passed;                                                                    \
        } else {                                                                                   \
            name##_body passed;                                                                    \
        }                                                                                          \
    }
#else
#define BURNISH_WIDE(linkage, name, declared, passed)                                              \
    linkage void name declared {                                                                   \
        name##_body passed;                                                                        \
    }
#endif

#endif
