# What both halves install. The target burnish_installed builds exactly that.
add_custom_target(burnish_installed)
install(DIRECTORY ${CMAKE_CURRENT_LIST_DIR}/include/burnish DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

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
# Texts that the program writes about itself, if the build can run it.
function(burnish_installed_text program output folder name)
  add_custom_command(OUTPUT ${output} COMMAND ${program} ${ARGN} > ${output} DEPENDS ${program}
                     COMMENT "Writing ${output}" VERBATIM)
  string(MAKE_C_IDENTIFIER "burnish_text_${output}" target)
  add_custom_target(${target} ALL DEPENDS ${output})
  add_dependencies(burnish_installed ${target})
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${output} RENAME ${name} DESTINATION ${folder})
endfunction()
