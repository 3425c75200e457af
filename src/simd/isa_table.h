/* Template: defines OPS_for(isa), which returns the table OPS_<word> of an instruction set that
 * this build has, and NULL for others. The file that includes this defines OPS as the tables' type.
 */
#include "simd/isa.h"

#define X(name, word) extern const OPS BURNISH_ISA_TABLE(OPS, word);
BURNISH_BUILT_ISAS
#undef X

const OPS *BURNISH_ISA_TABLE(OPS, for)(burnish_isa isa) {
    static const OPS *const tables[BURNISH_ISA_COUNT] = {
#define X(name, word) [BURNISH_ISA_##name] = &BURNISH_ISA_TABLE(OPS, word),
        BURNISH_BUILT_ISAS
#undef X
    };
    return (unsigned)isa < BURNISH_ISA_COUNT ? tables[isa] : NULL;
}
