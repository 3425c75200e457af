/* Asks the processor for VECTORS before anything runs that is compiled for them. */
#include <stdio.h>

int test_arrays_q15(int count, char **arguments);

int main(int count, char **arguments) {
    if (!__builtin_cpu_supports(VECTORS)) {
        puts("skipped: this processor has no " VECTORS);
        return 77;
    }
    return test_arrays_q15(count, arguments);
}
