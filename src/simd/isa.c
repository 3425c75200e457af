/* Which instruction sets there are, and which to take. */
#include "simd/isa.h"

#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>
#endif

const char *burnish_isa_name(burnish_isa isa) {
    static const char *const names[] = {
#define ISA_WORD(name, word, lanes) #word,
        BURNISH_ISA_LIST(ISA_WORD)
#undef ISA_WORD
    };
    return (unsigned)isa < BURNISH_ISA_COUNT ? names[isa] : "unknown";
}

int burnish_isa_lanes(burnish_isa isa) {
    static const int counts[] = {
#define ISA_LANES(name, word, lanes) lanes,
        BURNISH_ISA_LIST(ISA_LANES)
#undef ISA_LANES
    };
    return (unsigned)isa < BURNISH_ISA_COUNT ? counts[isa] : 0;
}

uint32_t burnish_isa_from_cpuid(const burnish_cpuid *cpuid) {
    enum { SSE2 = 1u << 26, OSXSAVE = 1u << 27, AVX = 1u << 28 };        /* leaf 1 */
    enum { AVX2 = 1u << 5, F = 1u << 16, DQ = 1u << 17, BW = 1u << 30 }; /* leaf 7 */
    const uint32_t vl = 1u << 31;                                        /* leaf 7 */
    const uint64_t saves_ymm = 0x06, saves_zmm = 0xe6;                   /* XCR0 */
    const uint32_t avx512 = (uint32_t)F | (uint32_t)DQ | (uint32_t)BW | vl;
    uint32_t mask = 1u << BURNISH_ISA_SCALAR;
    if (!(cpuid->leaf1_edx & SSE2)) {
        return mask;
    }
    mask |= 1u << BURNISH_ISA_SSE2;
    if (!(cpuid->leaf1_ecx & OSXSAVE) || !(cpuid->leaf1_ecx & AVX) || !(cpuid->leaf7_ebx & AVX2) ||
        (cpuid->xcr0 & saves_ymm) != saves_ymm) {
        return mask;
    }
    mask |= 1u << BURNISH_ISA_AVX2;
    if ((cpuid->leaf7_ebx & avx512) == avx512 && (cpuid->xcr0 & saves_zmm) == saves_zmm) {
        mask |= 1u << BURNISH_ISA_AVX512;
    }
    return mask;
}

#if defined(__x86_64__) || defined(__i386__)
static uint32_t ask_processor(void) {
    burnish_cpuid cpuid = {0, 0, 0, 0};
    unsigned a, b, c, d;
    if (__get_cpuid(1, &a, &b, &c, &d)) {
        cpuid.leaf1_ecx = c;
        cpuid.leaf1_edx = d;
        if (c & (1u << 27)) {
            unsigned low, high;
            __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
            cpuid.xcr0 = ((uint64_t)high << 32) | low;
        }
    }
    if (__get_cpuid_count(7, 0, &a, &b, &c, &d)) {
        cpuid.leaf7_ebx = b;
    }
    return burnish_isa_from_cpuid(&cpuid);
}

/* CPUID runs once per process and its forks: in a virtual machine it takes longer than drawing a
 * small mesh. */
static uint32_t processor_mask(void) {
    static atomic_uint_least32_t known; /* 0: not yet */
    uint32_t mask = atomic_load_explicit(&known, memory_order_relaxed);
    if (mask == 0) {
        mask = ask_processor();
        atomic_store_explicit(&known, mask, memory_order_relaxed);
    }
    return mask;
}
#else
static uint32_t processor_mask(void) {
    return ~0u; /* what was built runs */
}
#endif

burnish_isa_flags burnish_isa_available(void) {
#define X(name, word) | 1u << BURNISH_ISA_##name
    return (0u BURNISH_BUILT_ISAS) & processor_mask();
#undef X
}

burnish_isa burnish_isa_best(burnish_isa_flags mask) {
    burnish_isa best = BURNISH_ISA_SCALAR;
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        best = mask >> isa & 1 ? (burnish_isa)isa : best;
    }
    return best;
}

static int find_word(const char *word) {
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        if (strcmp(word, burnish_isa_name((burnish_isa)isa)) == 0) {
            return isa;
        }
    }
    return -1;
}

/* " scalar sse2 avx2", for messages. */
static void list_words(uint32_t mask, char *text, size_t size) {
    size_t length = 0;
    text[0] = 0;
    for (int isa = 0; isa < BURNISH_ISA_COUNT; ++isa) {
        const char *word = burnish_isa_name((burnish_isa)isa);
        if (mask >> isa & 1 && length + strlen(word) + 2 < size) {
            text[length++] = ' ';
            memcpy(text + length, word, strlen(word) + 1);
            length += strlen(word);
        }
    }
}

burnish_status burnish_isa_choose(const char *name, burnish_isa *isa, burnish_error *error) {
    const char *from = "";
    const uint32_t mask = burnish_isa_available();
    char words[64];
    *isa = BURNISH_ISA_SCALAR;
    if (!name || strcmp(name, "auto") == 0) {
        from = BURNISH_ISA_VARIABLE ": ";
        name = getenv(BURNISH_ISA_VARIABLE);
        if (!name || !*name || strcmp(name, "auto") == 0) {
            *isa = burnish_isa_best(mask);
            return BURNISH_STATUS_OK;
        }
    }
    int found = find_word(name);
    list_words(mask, words, sizeof words);
    if (found < 0) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT, "%s\"%.40s\" is not one of auto%s",
                            from, name, words);
    }
    if (!(mask >> found & 1)) {
        return burnish_fail(error, BURNISH_STATUS_ARGUMENT,
                            "%s%s is not available here; use auto or one of%s", from, name, words);
    }
    *isa = (burnish_isa)found;
    return BURNISH_STATUS_OK;
}
