# The flags of each instruction set that the target's processors may have. Every src/simd/isa_<name>.c
# is compiled; without its flags it says that it has nothing. Which of them runs is found out at run
# time.
include(CheckCSourceCompiles)
check_c_source_compiles("#if !defined(__SSE2__)\n#error no\n#endif\nint main(void) { return 0; }" BURNISH_HAS_SSE2)
check_c_source_compiles("#if !defined(__aarch64__)\n#error no\n#endif\nint main(void) { return 0; }" BURNISH_HAS_NEON)
option(BURNISH_WIDE_VECTORS "Compile AVX2 and AVX-512, which takes compilers half of their time" ON)
if(BURNISH_HAS_SSE2 AND BURNISH_WIDE_VECTORS)
  set(avx2_flags -mavx2)
  set(avx2_bench_flags -mfma) # the benchmark's contenders need not keep bits: they may fuse
  set(avx512_flags -mavx512f -mavx512dq -mavx512bw -mavx512vl -mprefer-vector-width=512)
  if(MINGW) # gcc aligns Windows' stack to 16 bytes only, and moves vectors there as if it were more
    list(APPEND avx2_flags -Wa,-muse-unaligned-vector-move)
    list(APPEND avx512_flags -Wa,-muse-unaligned-vector-move)
  endif()
endif()
if(BURNISH_HAS_SSE2 OR BURNISH_HAS_NEON)
  # Where there are vectors the scalar set is scalar: the reference, and what its name says.
  set(scalar_flags -fno-tree-vectorize -fno-tree-slp-vectorize)
endif()
# The words of the instruction sets.
file(GLOB BURNISH_ISA_NAMES CONFIGURE_DEPENDS src/simd/isa_*.c)
list(TRANSFORM BURNISH_ISA_NAMES REPLACE "^.*/isa_([a-z0-9]+)\\.c$" "\\1")
# Checked vector code takes clang minutes per file at -O2, half of that at -O1, and a quarter without what
# `undefined` knows of pointers. The templates have those checks where the scalar set includes them; inputs of
# the fuzzer need none of them.
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
# Its code must take one value at a time.
set_source_files_properties(bench/kernels_scalar.c PROPERTIES COMPILE_OPTIONS
  "-fno-tree-vectorize;-fno-tree-slp-vectorize;-funroll-loops")
