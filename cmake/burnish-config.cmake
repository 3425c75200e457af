# find_package(burnish) gives the target burnish::burnish.
include(CMakeFindDependencyMacro)
find_dependency(PkgConfig)
find_dependency(OpenMP COMPONENTS C)
pkg_check_modules(DEFLATE REQUIRED IMPORTED_TARGET libdeflate)
include(${CMAKE_CURRENT_LIST_DIR}/burnish-targets.cmake)
