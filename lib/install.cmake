# What is installed: each room with its headers, a package for find_package(vndf) and one for
# pkg-config. None of the files has an absolute path, so the installed folder may be moved. It is in
# two parts, which `cmake --install BUILD --component PART` and packages.cmake tell apart: runtime, and
# dev for the other rooms.
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME runtime)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/vndf)
set(rooms support batch devices io distributions precompute validate)

# The runtime, with the headers of its folders and those of vndf/support, of which it uses some.
set(excluded_headers)
foreach(room batch devices io distributions precompute validate bench)
  list(APPEND excluded_headers PATTERN vndf/${room} EXCLUDE)
endforeach()
install(TARGETS vndf EXPORT vndf_runtime)
install(EXPORT vndf_runtime NAMESPACE vndf:: FILE vndf-runtime.cmake DESTINATION ${package_dir})
install(DIRECTORY vndf ${CMAKE_CURRENT_BINARY_DIR}/vndf DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h" PATTERN "*-inl.h" EXCLUDE ${excluded_headers})

write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/vndfConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES vndfConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/vndfConfigVersion.cmake
        DESTINATION ${package_dir})

file(RELATIVE_PATH prefix_from_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(vndf.pc.in vndf.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/vndf.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/tables/FORMAT.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev)
foreach(room ${rooms})
  if(TARGET vndf_${room})
    install(TARGETS vndf_${room} EXPORT vndf_${room})
    install(EXPORT vndf_${room} NAMESPACE vndf:: FILE vndf-${room}.cmake DESTINATION ${package_dir})
    if(NOT room STREQUAL "support")  # whose headers are in the runtime
      install(DIRECTORY vndf/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/vndf
              FILES_MATCHING PATTERN "*.h" PATTERN "*-inl.h" EXCLUDE)
    endif()
  endif()
endforeach()
