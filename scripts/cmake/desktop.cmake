# What file managers need: MIME types, thumbnails where the program has its sandbox, the window's menu entry
# where it has one, and an icon that it draws itself.
set(share ${CMAKE_INSTALL_DATADIR})
set(desktop ${PROJECT_SOURCE_DIR}/packaging/desktop)
install(FILES ${desktop}/burnish.xml DESTINATION ${share}/mime/packages)
if(BURNISH_SECCOMP_FOUND)
  install(FILES ${desktop}/burnish.thumbnailer DESTINATION ${share}/thumbnailers)
endif()
if(BURNISH_VIEW_FOUND)
  install(FILES ${desktop}/burnish.desktop DESTINATION ${share}/applications)
endif()
if(CMAKE_C_FLAGS MATCHES "sanitize=memory") # whose program can't use libraries that are not instrumented
  return()
endif()
foreach(size 48 128 256)
  burnish_installed_text(icon-${size}.png ${share}/icons/hicolor/${size}x${size}/apps burnish.png
    render :knot --color=\#d9822b --material=polished --no-background --size=${size} --samples=16 --margin=0.03 --output=-)
endforeach()
