# Sourced: what tests of kernels and test_visibility are made of on a processor that this build is not for.
# shellcheck disable=SC2034
flags="-std=c17 -O2 -ffp-contract=off -fno-math-errno -Wall -Wextra -Werror -D_GNU_SOURCE"

# sources SOURCE_DIR NAME: of test_NAME
sources() {
    echo "-I$1/include -I$1/src -I$1/test $1/test/test_$2.c"
    echo "$1"/src/simd/*.c
    for file in shading/kernels shading/lobe_fit shading/lobe_words shading/shader core/elementary core/error core/memory; do
        echo "$1/src/$file.c"
    done
}

# renderer_sources SOURCE_DIR
renderer_sources() {
    echo "-pthread -I$1/include -I$1/src -I$1/test"
    echo "$1"/src/simd/*.c "$1"/src/raster/*.c "$1"/src/shading/*.c "$1"/src/render/surface.c "$1"/src/render/caps.c "$1"/src/render/occlusion_share.c "$1"/src/render/texture_points.c "$1"/src/render/texture_shade.c
    for file in context elementary error memory processors srgb tasks pool; do
        echo "$1/src/core/$file.c"
    done
}
