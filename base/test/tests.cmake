# Every test has labels.
#   unit cli         need nothing but the packages of the groups build and test: `make test`
#   figures shaders view python hardware firmware cross bits importers
#                    need more packages, and are skipped without them: `make test-all` runs these too
#   job              a job of scripts/job in its brief form; the preset everything has them
# These say which sanitizers a test is useful under:
#   asan tsan msan   `make check` runs it
#   asan-long tsan-long msan-long   only `make asan`, `make tsan` or `make msan` does
# And this one keeps CI short:
#   long             other tests and jobs cover it: .ci/run leaves it out

set(BASE_TEST ${CMAKE_CURRENT_LIST_DIR})

# burnish_test(NAME LABELS COMMAND...): LABELS is a list. Exit code 77 skips a test, and its last line is the reason: a tool is missing.
# A test that skips a part of itself prints "SKIPPED: PART, REASON". scripts/ctest lists both.
function(burnish_test name labels)
  add_test(NAME ${name} COMMAND ${ARGN})
  set_tests_properties(${name} PROPERTIES LABELS "${labels}" SKIP_RETURN_CODE 77)
endfunction()

# burnish_skipped_test(NAME LABEL REASON): instead of a test that this build can't have.
function(burnish_skipped_test name label reason)
  burnish_test(${name} ${label} sh -c "echo '${reason}'; exit 77")
endfunction()

# burnish_unit_test(SOURCE LABELS LIBRARY...): test_NAME.c becomes the test NAME; it includes support.h and gets the arguments of
# the variable NAME_arguments. MemorySanitizer's build has only the tests with its labels.
function(burnish_unit_test source labels)
  get_filename_component(program ${source} NAME_WE)
  string(REPLACE "test_" "" name ${program})
  if(CMAKE_C_FLAGS MATCHES "sanitize=memory" AND NOT ("msan" IN_LIST labels OR "msan-long" IN_LIST labels))
    return()
  endif()
  add_executable(${program} ${source})
  target_include_directories(${program} PRIVATE ${BASE_TEST} ${BASE_TEST}/../.. ${CMAKE_CURRENT_SOURCE_DIR}/..)
  target_compile_definitions(${program} PRIVATE TEST_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
    TEST_DATA_DIR="${CMAKE_CURRENT_SOURCE_DIR}/data" TEST_BINARY_DIR="${CMAKE_CURRENT_BINARY_DIR}")
  target_link_libraries(${program} PRIVATE ${ARGN} burnish_options m)
  burnish_test(${name} "unit;${labels}" ${program} ${${name}_arguments})
  foreach(sanitizer asan tsan msan) # the programs of `make check`
    if(NOT TARGET tests_${sanitizer})
      add_custom_target(tests_${sanitizer})
    endif()
    if(sanitizer IN_LIST labels)
      add_dependencies(tests_${sanitizer} ${program})
    endif()
  endforeach()
endfunction()
