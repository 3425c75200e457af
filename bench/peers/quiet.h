/* Waiting until no other program uses the machine. */
#ifndef BURNISH_BENCH_PEERS_QUIET_H
#define BURNISH_BENCH_PEERS_QUIET_H

/* Waits until the processors were idle for a tenth of a second, at most *budget seconds, which it
 * counts down. Returns 0 if they are still busy, 1 also if that is unknown. */
int burnish_peers_wait_until_quiet(double *budget);

#endif
