/* Sums of lobes fitted to the lobes of rough surfaces. */
#include "theory/internal.h"
#include "theory/lobe_sum.h"
#include "theory/lobe_sums_table.h"

burnish_status burnish_theory_lobe_sum_fit(burnish_theory_distribution distribution, double alpha,
                                           int count, burnish_theory_lobe_sum *sum,
                                           burnish_error *error) {
    if (!(alpha > 0 && alpha <= 1)) {
        return burnish_theory_fail(error, "alpha %g is not in (0, 1]", alpha);
    }
    if (count < 1 || count > BURNISH_THEORY_LOBE_SUM_MAX) {
        return burnish_theory_fail(error, "%d lobes: a sum has 1 to %d", count,
                                   BURNISH_THEORY_LOBE_SUM_MAX);
    }
    burnish_lobe_sum_evaluate(
        &burnish_lobe_sum_rows[distribution == BURNISH_THEORY_BECKMANN][count - 1], count, alpha,
        sum);
    return BURNISH_STATUS_OK;
}

void burnish_theory_lobe_sum_compare(burnish_theory_distribution distribution, double alpha,
                                     const burnish_theory_lobe_sum *sum,
                                     burnish_theory_lobe_sum_error *error) {
    burnish_lobe_sum_grid grid = {.count = BURNISH_LOBE_SUM_POINTS};
    burnish_lobe_sum_prepare(distribution, alpha, &grid);
    burnish_lobe_sum_measure(&grid, sum, error);
}
