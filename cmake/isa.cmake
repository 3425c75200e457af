# The flags of each instruction set that the target's processors may have. Every src/simd/isa_<name>.c
# is compiled; without its flags it says that it has nothing. Which of them runs is found out at run
# time. BURNISH_BENCH_TIERS: the contenders of the benchmark.
include(CheckCSourceCompiles)
check_c_source_compiles("#if !defined(__SSE2__)\n#error no\n#endif\nint main(void) { return 0; }" BURNISH_HAS_SSE2)
check_c_source_compiles("#if !defined(__aarch64__)\n#error no\n#endif\nint main(void) { return 0; }" BURNISH_HAS_NEON)
set(BURNISH_ISA_NAMES scalar)
set(scalar_flags)
set(avx2_flags -mavx2)
set(avx512_flags -mavx512f -mavx512dq -mavx512bw -mavx512vl -mprefer-vector-width=512)
if(MINGW) # gcc aligns Windows' stack to 16 bytes only, and moves vectors there as if it were more
  list(APPEND avx2_flags -Wa,-muse-unaligned-vector-move)
  list(APPEND avx512_flags -Wa,-muse-unaligned-vector-move)
endif()
if(BURNISH_HAS_SSE2)
  list(APPEND BURNISH_ISA_NAMES sse2 avx2 avx512)
elseif(BURNISH_HAS_NEON)
  list(APPEND BURNISH_ISA_NAMES neon)
endif()
if(BURNISH_HAS_SSE2 OR BURNISH_HAS_NEON)
  # Where there are vectors the scalar set is scalar: the reference, and what its name says.
  set(scalar_flags -fno-tree-vectorize -fno-tree-slp-vectorize)
endif()
set(BURNISH_BENCH_TIERS)
foreach(isa ${BURNISH_ISA_NAMES})
  set_source_files_properties(src/simd/isa_${isa}.c PROPERTIES COMPILE_OPTIONS "${${isa}_flags}")
  # the contenders need not keep bits: they may fuse
  list(APPEND BURNISH_BENCH_TIERS bench/kernels_tier_${isa}.c)
  set(bench_flags ${${isa}_flags})
  if(isa STREQUAL avx2)
    list(APPEND bench_flags -mfma)
  endif()
  set_source_files_properties(bench/kernels_tier_${isa}.c PROPERTIES COMPILE_OPTIONS "${bench_flags}")
endforeach()
# Its code must take one value at a time.
set_source_files_properties(bench/kernels_scalar.c PROPERTIES COMPILE_OPTIONS
  "-fno-tree-vectorize;-fno-tree-slp-vectorize;-funroll-loops")
