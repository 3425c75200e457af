# Files for desktops: MIME types, a thumbnailer (if the program has a sandbox), a menu entry (if it has a window), and an icon,
# which the program draws.
set(share ${CMAKE_INSTALL_DATADIR})
set(desktop ${PROJECT_SOURCE_DIR}/packaging/desktop)
install(FILES ${desktop}/burnish.xml DESTINATION ${share}/mime/packages)
if(BURNISH_SECCOMP_FOUND)
  install(FILES ${desktop}/burnish.thumbnailer DESTINATION ${share}/thumbnailers)
endif()
if(BURNISH_VIEW_FOUND)
  install(FILES ${desktop}/burnish.desktop DESTINATION ${share}/applications)
endif()
if(CMAKE_C_FLAGS MATCHES "sanitize=memory") # its program can't use libraries that are not instrumented
  return()
endif()
foreach(size 48 128 256)
  add_custom_command(OUTPUT icon-${size}.png DEPENDS burnish_cli COMMENT "Drawing icon-${size}.png" VERBATIM
    COMMAND burnish_cli render :knot --color=\#d9822b --material=polished --no-background --size=${size} --samples=16 --margin=0.03 --output=- > icon-${size}.png)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/icon-${size}.png RENAME burnish.png DESTINATION ${share}/icons/hicolor/${size}x${size}/apps)
  list(APPEND icons icon-${size}.png)
endforeach()
add_custom_target(burnish_icons ALL DEPENDS ${icons})
add_dependencies(burnish_installed burnish_icons)
