/* How threads wait for each other: asleep. An OpenMP runtime lets them spin for milliseconds unless
 * it is told otherwise, and on a machine that does other work as well the one that spins takes the
 * processor from the one it waits for: a bunny in 256x256 then takes 86 ms instead of 13. The
 * runtime reads its settings before main, or with the first parallel loop: this comes before both.
 * Whoever sets the variable decides. */
#include <stdlib.h>

enum { FIRST = 101 /* the earliest priority that is left to programs */ };

__attribute__((constructor(FIRST))) static void wait_asleep(void) {
    setenv("OMP_WAIT_POLICY", "passive", 0);
}
