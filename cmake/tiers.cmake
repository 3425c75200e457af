# BURNISH_TIERS: the sources of the vector tiers that the target's processors may have, each with its
# instruction set's flags. Which of them runs is found out at run time.
include(CheckCSourceCompiles)
check_c_source_compiles("#if !defined(__SSE2__)\n#error no\n#endif\nint main(void) { return 0; }" BURNISH_HAS_SSE2)
check_c_source_compiles("#if !defined(__aarch64__)\n#error no\n#endif\nint main(void) { return 0; }" BURNISH_HAS_NEON)
set(BURNISH_TIERS)
if(BURNISH_HAS_SSE2)
  set(BURNISH_TIERS src/kernels/tier_sse2.c src/kernels/tier_avx2.c src/kernels/tier_avx512.c)
  set_source_files_properties(src/kernels/tier_avx2.c PROPERTIES COMPILE_OPTIONS "-mavx2")
  set_source_files_properties(src/kernels/tier_avx512.c PROPERTIES COMPILE_OPTIONS
    "-mavx512f;-mavx512dq;-mavx512bw;-mavx512vl;-mprefer-vector-width=512")
elseif(BURNISH_HAS_NEON)
  set(BURNISH_TIERS src/kernels/tier_neon.c)
endif()
