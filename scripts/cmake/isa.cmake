# The instruction sets of this build, and their flags. The files *_isa.c of src, which hold the kernels of
# their folder, are compiled once for each set. The processor decides at run time which of them is used.
include(CheckCSourceCompiles)
check_c_source_compiles("#if !defined(__SSE2__)\n#error no\n#endif\nint main(void) { return 0; }" BURNISH_HAS_SSE2)
check_c_source_compiles("#if !defined(__aarch64__)\n#error no\n#endif\nint main(void) { return 0; }" BURNISH_HAS_NEON)
option(BURNISH_VECTORS "Compile other instruction sets than the scalar one" ON)
option(BURNISH_WIDE_VECTORS "Compile AVX2 and AVX-512, which takes compilers half of their time" ON)
set(BURNISH_ISA_NAMES scalar sse2 avx2 avx512 neon wasm) # the words of BURNISH_ISA_LIST in core.h
set(names scalar)
if(BURNISH_HAS_NEON AND BURNISH_VECTORS)
  list(APPEND names neon)
elseif(BURNISH_HAS_SSE2 AND BURNISH_VECTORS)
  list(APPEND names sse2)
endif()
if(BURNISH_HAS_SSE2 AND BURNISH_VECTORS AND BURNISH_WIDE_VECTORS)
  list(APPEND names avx2 avx512)
  set(avx2_flags -mavx2)
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
set(list) # simd/isa.h describes it
foreach(isa ${names})
  string(TOUPPER ${isa} name)
  string(APPEND list "X(${name},${isa})")
endforeach()
set_source_files_properties(src/simd/isa.c src/raster/tile.c src/render/render_ops.c
  src/environment/map_fill.c src/rays/ray_tree.c src/shading/kernels.c
  PROPERTIES COMPILE_DEFINITIONS "BURNISH_BUILT_ISAS=${list}")
set(BURNISH_BUILT_NAMES ${names})

# Compiles *_isa.c once per instruction set of this build; `objects` receives the object files.
#
# The pointer checks of `undefined` double the time that clang takes here. The scalar set keeps them.
function(burnish_isa_objects objects)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS src/*_isa.c)
  set(files)
  foreach(isa ${BURNISH_BUILT_NAMES})
    string(TOUPPER ${isa} name)
    set(checked_flags)
    if(CMAKE_C_FLAGS MATCHES "sanitize=.*undefined" AND NOT isa STREQUAL scalar)
      set(checked_flags -fno-sanitize=null,alignment,object-size,pointer-overflow)
    endif()
    add_library(burnish_${isa} OBJECT ${sources})
    target_include_directories(burnish_${isa} PRIVATE ${PROJECT_SOURCE_DIR} base/include lobe/include include src)
    target_compile_definitions(burnish_${isa} PRIVATE BURNISH_BUILDING BURNISH_VECTOR_${name})
    target_compile_options(burnish_${isa} PRIVATE ${${isa}_flags} ${checked_flags})
    target_link_libraries(burnish_${isa} PRIVATE burnish_options)
    list(APPEND files $<TARGET_OBJECTS:burnish_${isa}>)
  endforeach()
  set(${objects} ${files} PARENT_SCOPE)
endfunction()
# This alternative takes one value at a time.
set_source_files_properties(bench/kernels/scalar.c PROPERTIES COMPILE_OPTIONS
  "-fno-tree-vectorize;-fno-tree-slp-vectorize;-funroll-loops")
