# Sourced: what test_kernels and test_visibility are made of on a processor that this build is not for.
# shellcheck disable=SC2034
flags="-std=c17 -O2 -ffp-contract=off -fno-math-errno -Wall -Wextra -Werror -D_GNU_SOURCE"

# sources SOURCE_DIR TIER
sources() {
    echo "-I$1/include -I$1/src -I$1/test $1/test/test_kernels.c"
    for file in simd/isa shading/batch shading/prepare simd/tier_scalar "simd/tier_$2" core/elementary core/error; do
        echo "$1/src/$file.c"
    done
}

# renderer_sources SOURCE_DIR TIER
renderer_sources() {
    echo "-pthread -I$1/include -I$1/src -I$1/test $1/test/test_visibility.c"
    for file in simd/isa shading/batch shading/prepare core/elementary core/error core/context core/memory core/processors core/srgb core/tasks \
        raster/bins raster/clip raster/geometry raster/samples raster/tier raster/tile \
        shading/attributes shading/interpolate shading/strip shading/shade; do
        echo "$1/src/$file.c"
    done
    for tier in scalar "$2"; do
        echo "$1/src/simd/tier_$tier.c $1/src/raster/raster_$tier.c"
    done
}
