# Compiler flags of each instruction set. Every src/simd/isa_NAME.c is compiled; without its flags it defines no kernels. The program
# chooses among them at run time.
include(CheckCSourceCompiles)
check_c_source_compiles("#if !defined(__SSE2__)\n#error no\n#endif\nint main(void) { return 0; }" BURNISH_HAS_SSE2)
check_c_source_compiles("#if !defined(__aarch64__)\n#error no\n#endif\nint main(void) { return 0; }" BURNISH_HAS_NEON)
option(BURNISH_WIDE_VECTORS "Compile AVX2 and AVX-512, which takes compilers half of their time" ON)
if(BURNISH_HAS_SSE2 AND BURNISH_WIDE_VECTORS)
  set(avx2_flags -mavx2)
  set(avx2_bench_flags -mfma) # alternatives in the benchmark make no promise of bits
  set(avx512_flags -mavx512f -mavx512dq -mavx512bw -mavx512vl -mprefer-vector-width=512)
  if(MINGW) # gcc aligns the stack to 16 bytes there, but uses aligned moves for wider vectors
    list(APPEND avx2_flags -Wa,-muse-unaligned-vector-move)
    list(APPEND avx512_flags -Wa,-muse-unaligned-vector-move)
  endif()
endif()
if(BURNISH_HAS_SSE2 OR BURNISH_HAS_NEON)
  # The scalar set is the reference, so the compiler must not vectorise it.
  set(scalar_flags -fno-tree-vectorize -fno-tree-slp-vectorize)
endif()
# The names of the instruction sets.
file(GLOB BURNISH_ISA_NAMES CONFIGURE_DEPENDS src/simd/isa_*.c)
list(TRANSFORM BURNISH_ISA_NAMES REPLACE "^.*/isa_([a-z0-9]+)\\.c$" "\\1")
# With sanitizers, clang takes minutes per file of vector code at -O2, half as long at -O1, and a quarter without the pointer checks of
# `undefined`. The scalar set keeps these checks, except in the fuzzer.
foreach(isa ${BURNISH_ISA_NAMES})
  set(checked_flags)
  if(CMAKE_C_FLAGS MATCHES "sanitize=.*undefined")
    set(checked_flags -O1)
    if(NOT isa STREQUAL scalar OR CMAKE_C_FLAGS MATCHES "fuzzer")
      list(APPEND checked_flags -fno-sanitize=null,alignment,object-size,pointer-overflow)
    endif()
  endif()
  set_source_files_properties(src/simd/isa_${isa}.c PROPERTIES COMPILE_OPTIONS "${${isa}_flags};${checked_flags}")
endforeach()
# This alternative takes one value at a time.
set_source_files_properties(bench/kernels_scalar.c PROPERTIES COMPILE_OPTIONS
  "-fno-tree-vectorize;-fno-tree-slp-vectorize;-funroll-loops")
