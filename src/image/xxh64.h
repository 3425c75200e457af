/* XXH64 with seed 0 (doc/xxhash_spec.md of xxHash), over pieces of any size. The library has its
 * own to build without other libraries. */
#ifndef BURNISH_IMAGE_XXH64_H
#define BURNISH_IMAGE_XXH64_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

enum { BURNISH_XXH64_STRIPE = 32 };

typedef struct burnish_xxh64 {
    uint64_t lanes[4];
    uint64_t size;                      /* bytes so far */
    uint8_t rest[BURNISH_XXH64_STRIPE]; /* the last size % 32 of them */
} burnish_xxh64;

static const uint64_t burnish_xxh64_primes[5] = {0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F,
                                                 0x165667B19E3779F9, 0x85EBCA77C2B2AE63,
                                                 0x27D4EB2F165667C5};

static inline burnish_xxh64 burnish_xxh64_begin(void) {
    const uint64_t *p = burnish_xxh64_primes;
    return (burnish_xxh64){.lanes = {p[0] + p[1], p[1], 0, 0 - p[0]}};
}

static inline uint64_t burnish_xxh64_rotate(uint64_t x, int by) {
    return x << by | x >> (64 - by);
}

/* `count` bytes, at most 8, as a little-endian number. */
static inline uint64_t burnish_xxh64_load(const uint8_t *bytes, int count) {
    uint64_t value = 0;
    for (int i = 0; i < count; ++i) {
        value |= (uint64_t)bytes[i] << 8 * i;
    }
    return value;
}

static inline uint64_t burnish_xxh64_mix(uint64_t lane, uint64_t input) {
    const uint64_t *p = burnish_xxh64_primes;
    return burnish_xxh64_rotate(lane + input * p[1], 31) * p[0];
}

static inline void burnish_xxh64_stripe(burnish_xxh64 *state, const uint8_t *bytes) {
    for (int i = 0; i < 4; ++i) {
        state->lanes[i] = burnish_xxh64_mix(state->lanes[i], burnish_xxh64_load(bytes + 8 * i, 8));
    }
}

static inline void burnish_xxh64_update(burnish_xxh64 *state, const uint8_t *bytes, size_t size) {
    size_t kept = (size_t)(state->size % BURNISH_XXH64_STRIPE);
    state->size += size;
    while (kept + size >= BURNISH_XXH64_STRIPE) {
        const size_t taken = BURNISH_XXH64_STRIPE - kept;
        if (kept > 0) {
            memcpy(state->rest + kept, bytes, taken);
        }
        burnish_xxh64_stripe(state, kept > 0 ? state->rest : bytes);
        bytes += taken;
        size -= taken;
        kept = 0;
    }
    if (size > 0) {
        memcpy(state->rest + kept, bytes, size);
    }
}

static inline uint64_t burnish_xxh64_end(const burnish_xxh64 *state) {
    const uint64_t *p = burnish_xxh64_primes, *lane = state->lanes;
    uint64_t hash = p[4];
    if (state->size >= BURNISH_XXH64_STRIPE) {
        hash = burnish_xxh64_rotate(lane[0], 1) + burnish_xxh64_rotate(lane[1], 7) +
               burnish_xxh64_rotate(lane[2], 12) + burnish_xxh64_rotate(lane[3], 18);
        for (int i = 0; i < 4; ++i) {
            hash = (hash ^ burnish_xxh64_mix(0, lane[i])) * p[0] + p[3];
        }
    }
    hash += state->size;
    const uint8_t *bytes = state->rest;
    const uint8_t *end = bytes + state->size % BURNISH_XXH64_STRIPE;
    for (; end - bytes >= 8; bytes += 8) {
        hash ^= burnish_xxh64_mix(0, burnish_xxh64_load(bytes, 8));
        hash = burnish_xxh64_rotate(hash, 27) * p[0] + p[3];
    }
    for (; end - bytes >= 4; bytes += 4) {
        hash ^= burnish_xxh64_load(bytes, 4) * p[0];
        hash = burnish_xxh64_rotate(hash, 23) * p[1] + p[2];
    }
    for (; bytes < end; ++bytes) {
        hash = burnish_xxh64_rotate(hash ^ *bytes * p[4], 11) * p[0];
    }
    hash = (hash ^ hash >> 33) * p[1];
    hash = (hash ^ hash >> 29) * p[2];
    return hash ^ hash >> 32;
}

#endif
