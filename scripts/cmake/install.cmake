# Installs program, libraries, headers, manual page, and the files by which other projects find them. The target
# burnish_installed builds exactly that.
include(CMakePackageConfigHelpers)
add_dependencies(burnish_installed burnish)

install(DIRECTORY include/burnish DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS burnish EXPORT burnish-static)
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
foreach(name 3MF ZSTD PNG JPEG WEBP EXR)
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

# The static library's requirements are private only if there is a shared library.
set(BURNISH_PC_PRIVATE "")
if(BURNISH_SHARED)
  set(BURNISH_PC_PRIVATE ".private")
endif()
configure_file(scripts/cmake/burnish.pc.in burnish.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/burnish.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

if(BURNISH_CLI)
  install(TARGETS burnish_cli)
  add_dependencies(burnish_installed burnish_cli)
  burnish_installed_texts(burnish_cli burnish)
  # For file managers; the thumbnailer needs the sandbox.
  if(UNIX)
    install(FILES packaging/desktop/burnish.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages)
  endif()
  if(BURNISH_SECCOMP_FOUND)
    install(FILES packaging/desktop/burnish.thumbnailer DESTINATION ${CMAKE_INSTALL_DATADIR}/thumbnailers)
  endif()
endif()
