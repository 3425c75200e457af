/* Inflate by ISA-L. */
#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>

#include "image/decode/gunzip.h"

struct burnish_inflate {
    struct inflate_state state;
    int is_raw;
};

static void inflate_begin(burnish_inflate *inflate) {
    isal_inflate_init(&inflate->state);
    inflate->state.crc_flag = inflate->is_raw ? ISAL_DEFLATE : ISAL_GZIP;
}

burnish_inflate *burnish_inflate_create(burnish_memory *memory, int is_raw) {
    burnish_inflate *made = burnish_allocate_zeroed(memory, 1, sizeof *made, "unpacking");
    if (made) {
        made->is_raw = is_raw;
        inflate_begin(made);
    }
    return made;
}

void burnish_inflate_destroy(const burnish_context *context, burnish_inflate *inflate) {
    burnish_release(context, inflate);
}

burnish_inflate_result burnish_inflate_step(burnish_inflate *inflate, const uint8_t **from,
                                            size_t *left, uint8_t *to, size_t room,
                                            size_t *written) {
    struct inflate_state *state = &inflate->state;
    const uint32_t taken = *left < UINT32_MAX ? (uint32_t)*left : UINT32_MAX;
    const uint32_t given = room < UINT32_MAX ? (uint32_t)room : UINT32_MAX;
    state->next_in = (uint8_t *)(uintptr_t)*from; /* only read */
    state->avail_in = taken;
    state->next_out = to;
    state->avail_out = given;
    const int code = isal_inflate(state);
    *from += taken - state->avail_in;
    *left -= taken - state->avail_in;
    *written = given - state->avail_out;
    if (code != ISAL_DECOMP_OK && code != ISAL_END_INPUT && code != ISAL_OUT_OVERFLOW) {
        return BURNISH_INFLATE_DAMAGED;
    }
    if (state->block_state != ISAL_BLOCK_FINISH) {
        return BURNISH_INFLATE_MORE;
    }
    inflate_begin(inflate);
    return BURNISH_INFLATE_END;
}

uint32_t burnish_inflate_crc32(uint32_t crc, const uint8_t *bytes, size_t size) {
    return crc32_gzip_refl(crc, bytes, size);
}
