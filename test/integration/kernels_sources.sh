# Sourced by the tests that cross-compile the kernel tests and test_visibility: their sources.
flags="-std=c17 -O2 -ffp-contract=off -fno-math-errno -Wall -Wextra -Werror -D_GNU_SOURCE"

# includes SOURCE_DIR
includes() { echo "-I$1 -I$1/include -I$1/base/include -I$1/lobe/include -I$1/src -I$1/base/test -I$1/test/support"; }

# kernel_sources SOURCE_DIR
kernel_sources() {
    echo "$1"/src/simd/*.c
    echo "$1"/lobe/spec/*.c "$1/src/shading/kernels.c" "$1/src/shading/shader.c"
    for file in elementary error layout memory; do
        echo "$1/base/$file.c"
    done
}

# renderer_sources SOURCE_DIR: those of the kernels are among them. An archive of them gives a link what it asks for alone.
renderer_sources() {
    find "$1/src/simd" "$1/src/raster" "$1/src/shading" "$1/src/environment" "$1/src/rays" "$1/src/render" -name '*.c' ! -name '*_isa.c'
    echo "$1"/src/mesh/data/*.c
    echo "$1"/lobe/spec/*.c
    for file in processors srgb tasks pool; do
        echo "$1/src/core/$file.c"
    done
    for file in context elementary error layout memory; do
        echo "$1/base/$file.c"
    done
}

# built_isas WORD: the flag by which the other files know the instruction sets scalar and WORD
built_isas() { echo "-DBURNISH_BUILT_ISAS=X(SCALAR,scalar)X($(echo "$1" | tr a-z A-Z),$1)"; }

# compile_isa COMPILER SOURCE_DIR WORD FOLDER...: the kernels of src/FOLDER for scalar and WORD, in the current folder
compile_isa() {
    compiler_=$1 source_=$2 word_=$3
    shift 3
    for folder_ in "$@"; do
        for isa_ in scalar "$word_"; do
            $compiler_ $flags -c $(includes "$source_") -DBURNISH_VECTOR_$(echo "$isa_" | tr a-z A-Z) \
                "$(find "$source_/src/$folder_" -name "${folder_}_isa.c")" -o "${folder_}_$isa_.o"
        done
    done
}
