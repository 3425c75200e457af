/* Lobes: their values, which are the same as in pictures. */
#include <stddef.h>

#include "base/wasm/module.h"
#include "burnish/kernels.h"

WASM_EXPORT(lobe_values)
int lobe_values(const char *words, double exponent, size_t count, const float *cosines,
                float *values);
WASM_EXPORT(lobe_example) const char *lobe_example(size_t index);

/* values[i] = lobe(cosines[i]), the bits of burnish_kernels_lobe_of_cosines. Returns 1, or 0 after
 * an error. */
int lobe_values(const char *words, double exponent, size_t count, const float *cosines,
                float *values) {
    burnish_error *error = module_error();
    burnish_lobe_spec lobe;
    return burnish_lobe_spec_parse(words, &lobe, error) == BURNISH_STATUS_OK &&
           burnish_kernels_lobe_of_cosines(burnish_kernels_best(), &lobe, (float)exponent, count,
                                           cosines, values, error) == BURNISH_STATUS_OK;
}

/* An example of each kind of lobe, NULL past the last. */
const char *lobe_example(size_t index) {
    return burnish_lobe_spec_example(index);
}
