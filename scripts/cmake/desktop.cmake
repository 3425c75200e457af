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
  burnish_installed_text(icon-${size}.png ${share}/icons/hicolor/${size}x${size}/apps burnish.png
    render :knot --color=\#d9822b --material=polished --no-background --size=${size} --samples=16 --margin=0.03 --output=-)
endforeach()
