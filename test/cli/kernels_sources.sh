# Sourced: what test_kernels is made of on a processor that this build is not for.
# shellcheck disable=SC2034
flags="-std=c17 -O2 -ffp-contract=off -fno-math-errno -Wall -Wextra -Werror -D_GNU_SOURCE"

# sources SOURCE_DIR TIER
sources() {
    echo "-I$1/include -I$1/src -I$1/test -DBURNISH_VERSION=\"0\" $1/test/test_kernels.c"
    for file in kernels/isa kernels/batch kernels/prepare kernels/tier_scalar "kernels/tier_$2" base/elementary base/error; do
        echo "$1/src/$file.c"
    done
}
