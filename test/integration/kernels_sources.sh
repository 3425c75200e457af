# Sourced: what tests of kernels and test_visibility are made of on a processor that this build is not for.
# shellcheck disable=SC2034
flags="-std=c17 -O2 -ffp-contract=off -fno-math-errno -Wall -Wextra -Werror -D_GNU_SOURCE"

# includes SOURCE_DIR
includes() { echo "-I$1/include -I$1/src -I$1/test/support"; }

# kernel_sources SOURCE_DIR
kernel_sources() {
    echo "$1"/src/simd/*.c
    for file in shading/kernels shading/lobe_fit shading/lobe_words shading/shader core/elementary core/error core/memory; do
        echo "$1/src/$file.c"
    done
}

# renderer_sources SOURCE_DIR: those of the kernels are among them
renderer_sources() {
    echo "$1"/src/simd/*.c "$1"/src/raster/*.c "$1"/src/shading/*.c
    for file in surface attributes caps masks occlusion_share texture_levels texture_points texture_reduce texture_shade; do
        find "$1/src/render" -name "$file.c"
    done
    for file in context elementary error memory processors srgb tasks pool; do
        echo "$1/src/core/$file.c"
    done
}
