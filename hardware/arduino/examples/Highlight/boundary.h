/* Boundary memory of the lobe shift7:2: the cosine at which it has fallen to zero.
 * Words are UQ0.15, 15 bits, rounded down: 1 is 32768. It does not fit and is one less.
 * Written by burnish 0.1.0: burnish lobe boundary. */
#include <stdint.h>
#ifdef __AVR__
#include <avr/pgmspace.h>
#endif

/* Entry i belongs to the exponent i + 1. */
static const uint16_t burnish_boundary[64]
#ifdef __AVR__
    PROGMEM
#endif
    = {
        0,     0,  7801, 14043, 17788, 20284, 22068, 23405, 24445, 25278,
    25959, 26526, 27006, 27418, 27774, 28086, 28362, 28606, 28825, 29023,
    29201, 29363, 29511, 29647, 29772, 29887, 29993, 30093, 30185, 30271,
    30351, 30427, 30498, 30565, 30628, 30687, 30743, 30796, 30847, 30895,
    30941, 30984, 31026, 31065, 31103, 31139, 31174, 31207, 31239, 31270,
    31299, 31327, 31354, 31380, 31406, 31430, 31453, 31476, 31498, 31519,
    31540, 31559, 31579, 31597,
};

static inline uint16_t burnish_boundary_at(uint16_t i) {
#ifdef __AVR__
    return (uint16_t)pgm_read_word(&burnish_boundary[i]);
#else
    return burnish_boundary[i];
#endif
}
