# BURNISH_TIERS and BURNISH_BENCH_TIERS: the sources of the vector tiers that the target's processors
# may have, of the kernels and of their contenders, each with its instruction set's flags. Which of
# them runs is found out at run time.
include(CheckCSourceCompiles)
check_c_source_compiles("#if !defined(__SSE2__)\n#error no\n#endif\nint main(void) { return 0; }" BURNISH_HAS_SSE2)
check_c_source_compiles("#if !defined(__aarch64__)\n#error no\n#endif\nint main(void) { return 0; }" BURNISH_HAS_NEON)
set(BURNISH_TIERS)
set(BURNISH_BENCH_TIERS)
set(avx512_flags "-mavx512f;-mavx512dq;-mavx512bw;-mavx512vl;-mprefer-vector-width=512")
if(BURNISH_HAS_SSE2)
  set(BURNISH_TIERS src/kernels/tier_sse2.c src/kernels/tier_avx2.c src/kernels/tier_avx512.c)
  set_source_files_properties(src/kernels/tier_avx2.c PROPERTIES COMPILE_OPTIONS "-mavx2")
  set_source_files_properties(src/kernels/tier_avx512.c PROPERTIES COMPILE_OPTIONS
    "${avx512_flags}")
  set(BURNISH_BENCH_TIERS
    bench/kernels_tier_sse2.c bench/kernels_tier_avx2.c bench/kernels_tier_avx512.c)
  set_source_files_properties(bench/kernels_tier_avx2.c PROPERTIES COMPILE_OPTIONS "-mavx2;-mfma")
  set_source_files_properties(bench/kernels_tier_avx512.c PROPERTIES COMPILE_OPTIONS
    "${avx512_flags}")
elseif(BURNISH_HAS_NEON)
  set(BURNISH_TIERS src/kernels/tier_neon.c)
  set(BURNISH_BENCH_TIERS bench/kernels_tier_neon.c)
endif()
# Its code must take one value at a time.
set_source_files_properties(bench/kernels_scalar.c PROPERTIES COMPILE_OPTIONS
  "-fno-tree-vectorize;-fno-tree-slp-vectorize;-funroll-loops")
# Where there is a vector tier the scalar one is scalar: the reference, and what its name says.
if(BURNISH_TIERS)
  set_source_files_properties(src/kernels/tier_scalar.c bench/kernels_tier_scalar.c PROPERTIES
    COMPILE_OPTIONS "-fno-tree-vectorize;-fno-tree-slp-vectorize")
endif()
