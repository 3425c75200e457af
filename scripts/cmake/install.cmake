# Installs program, libraries, headers, manual page, and the files by which other projects find them. The target
# burnish_installed builds exactly that.
include(CMakePackageConfigHelpers)
add_custom_target(burnish_installed DEPENDS burnish burnish_theory)

install(DIRECTORY include/burnish base/include/burnish DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY shaders/ DESTINATION ${CMAKE_INSTALL_DATADIR}/burnish/shaders
  PATTERN "*.shade" EXCLUDE)
find_program(BURNISH_PYTHON3 python3)
if(BURNISH_PYTHON3) # the shaders in a file per subject
  add_custom_command(OUTPUT shaders/burnish.glsl COMMAND ${BURNISH_PYTHON3} ${PROJECT_SOURCE_DIR}/scripts/shaders shaders
    DEPENDS scripts/shaders shaders/burnish.shade VERBATIM)
  add_custom_target(burnish_shaders ALL DEPENDS shaders/burnish.glsl)
  add_dependencies(burnish_installed burnish_shaders)
  install(DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/shaders/ DESTINATION ${CMAKE_INSTALL_DATADIR}/burnish/shaders)
else()
  message(STATUS "python3 is missing: of the shaders only one file per language is installed")
endif()
install(TARGETS burnish EXPORT burnish-static)
install(TARGETS burnish_theory EXPORT burnish-theory)
if(BURNISH_SHARED)
  install(TARGETS burnish_shared EXPORT burnish-shared)
  add_dependencies(burnish_installed burnish_shared)
endif()

# For CMake: burnish::static, and burnish::burnish, which is the shared library if there is one.
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/burnish)
install(EXPORT burnish-static NAMESPACE burnish:: DESTINATION ${package})
install(EXPORT burnish-theory NAMESPACE burnish:: DESTINATION ${package})
if(BURNISH_SHARED)
  install(EXPORT burnish-shared NAMESPACE burnish:: DESTINATION ${package})
endif()
# The static library names the targets of its decoders. find_package() looks for them as this build did.
set(BURNISH_CONFIG_DECODERS "")
foreach(name 3MF PNG JPEG WEBP EXR)
  if(FORMAT_${name}_FOUND)
    string(APPEND BURNISH_CONFIG_DECODERS
           "  pkg_check_modules(FORMAT_${name} QUIET IMPORTED_TARGET GLOBAL ${BURNISH_MODULES_${name}})\n")
  endif()
endforeach()
configure_file(scripts/cmake/burnish-config.cmake.in burnish-config.cmake @ONLY)
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/burnish-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/burnish-config.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/burnish-config-version.cmake DESTINATION ${package})

# For pkg-config: the prefix is relative to the .pc file, so the tree can be moved. Folders that a distribution gives as absolute
# paths stay absolute.
function(burnish_pc_folder folder variable)
  if(IS_ABSOLUTE "${folder}")
    set(${variable} "${folder}" PARENT_SCOPE)
  else()
    set(${variable} "\${prefix}/${folder}" PARENT_SCOPE)
  endif()
endfunction()
burnish_pc_folder("${CMAKE_INSTALL_INCLUDEDIR}" BURNISH_PC_INCLUDEDIR)
burnish_pc_folder("${CMAKE_INSTALL_LIBDIR}" BURNISH_PC_LIBDIR)
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
  set(BURNISH_PC_PREFIX "${CMAKE_INSTALL_PREFIX}")
else()
  file(RELATIVE_PATH up "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
  string(REGEX REPLACE "/$" "" up "${up}")
  set(BURNISH_PC_PREFIX "\${pcfiledir}/${up}")
endif()
# The static library's requirements are private only if there is a shared library.
set(BURNISH_PC_PRIVATE "")
if(BURNISH_SHARED)
  set(BURNISH_PC_PRIVATE ".private")
endif()
configure_file(scripts/cmake/burnish.pc.in burnish.pc @ONLY)
configure_file(scripts/cmake/burnish-theory.pc.in burnish-theory.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/burnish.pc ${CMAKE_CURRENT_BINARY_DIR}/burnish-theory.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

if(BURNISH_CLI)
  install(TARGETS burnish_cli)
  install(FILES program/lobe/figures.gp DESTINATION ${CMAKE_INSTALL_DATADIR}/burnish)
  add_dependencies(burnish_installed burnish_cli)
endif()

# Texts that the program writes about itself, if the build can run it.
function(burnish_installed_text output folder name)
  add_custom_command(OUTPUT ${output} COMMAND burnish_cli ${ARGN} > ${output} DEPENDS burnish_cli
                     COMMENT "Writing ${output}" VERBATIM)
  string(MAKE_C_IDENTIFIER "burnish_text_${output}" target)
  add_custom_target(${target} ALL DEPENDS ${output})
  add_dependencies(burnish_installed ${target})
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${output} RENAME ${name} DESTINATION ${folder})
endfunction()
if(BURNISH_CLI AND (NOT CMAKE_CROSSCOMPILING OR CMAKE_CROSSCOMPILING_EMULATOR))
  set(share ${CMAKE_INSTALL_DATADIR})
  burnish_installed_text(burnish.1 ${CMAKE_INSTALL_MANDIR}/man1 burnish.1 help --man)
  burnish_installed_text(burnish.bash ${share}/bash-completion/completions burnish help --completion=bash)
  burnish_installed_text(burnish.zsh ${share}/zsh/site-functions _burnish help --completion=zsh)
  burnish_installed_text(burnish.fish ${share}/fish/vendor_completions.d burnish.fish help --completion=fish)
  include(scripts/cmake/desktop.cmake)
elseif(BURNISH_CLI)
  message(STATUS "Cross build without CMAKE_CROSSCOMPILING_EMULATOR: no man page, no completions")
endif()
