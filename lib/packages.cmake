# The packages that `cpack -G DEB` and `cpack -G TGZ` make in a build folder, one for each part of
# what is installed: vndf-runtime, vndf-dev and vndf-tools.
set(CPACK_COMPONENTS_ALL runtime)
if(NOT VNDF_RUNTIME_ONLY)
  list(APPEND CPACK_COMPONENTS_ALL dev)
endif()
if(TARGET vndf_program)
  list(APPEND CPACK_COMPONENTS_ALL tools)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)  # one package for each
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_STRIP_FILES ON)

set(CPACK_PACKAGE_CONTACT "The vndf authors <vndf@localhost>")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
    "What a renderer links to sample from tables. It needs the standard library
of C++ alone.")
set(CPACK_COMPONENT_DEV_DESCRIPTION
    "The other libraries: distributions, the builder of tables, their files, batches
of samples, and the validator of samplers.")
set(CPACK_COMPONENT_TOOLS_DESCRIPTION
    "The program, which builds and bakes tables, samples from them, renders with
them, and validates samplers.")

# What vndfConfig.cmake looks for, and Boost, which headers include.
set(CPACK_COMPONENT_DEV_DEPENDS runtime)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
    "libboost-dev, libhdf5-dev, libhwy-dev, libmuparser-dev, libopenexr-dev, libpng-dev, \
libtiff-dev, zlib1g-dev")
find_program(VNDF_SHLIBDEPS dpkg-shlibdeps)
find_program(VNDF_FILE file)  # with which CPack finds the programs in a package
mark_as_advanced(VNDF_SHLIBDEPS VNDF_FILE)
if(VNDF_SHLIBDEPS AND VNDF_FILE)
  set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
endif()
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS gnuplot-nox)  # for vndf picture

foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  set(CPACK_ARCHIVE_${upper}_FILE_NAME
      vndf-${component}-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
  # Debian wants the licence in each package.
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/vndf-${component} RENAME copyright
          COMPONENT ${component})
endforeach()

include(CPack)
