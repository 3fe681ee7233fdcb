# Packages are made, unpacked, and looked into: each has what it should have and nothing else.

# make_packages(TREE KIND) makes the packages of a build tree, a TGZ or DEB, and unpacks each into
# ${work}/KIND/COMPONENT. `components` are those that were made.
function(make_packages tree kind)
  set(made ${work}/made)
  run(${CMAKE_CPACK_COMMAND} -G ${kind} -B ${made} --config ${tree}/CPackConfig.cmake)
  file(GLOB packages ${made}/*.deb ${made}/*.tar.gz)
  set(components)
  foreach(package ${packages})
    string(REGEX REPLACE ".*/vndf-([a-z]+)[_-].*" "\\1" component ${package})
    list(APPEND components ${component})
    file(MAKE_DIRECTORY ${work}/${kind}/${component})
    if(kind STREQUAL "DEB")
      run(dpkg-deb -x ${package} ${work}/unpacked)
      run(dpkg-deb -e ${package} ${work}/${kind}/${component}-control)
      file(RENAME ${work}/unpacked/usr ${work}/${kind}/${component})
    else()
      file(ARCHIVE_EXTRACT INPUT ${package} DESTINATION ${work}/${kind}/${component})
    endif()
  endforeach()
  file(REMOVE_RECURSE ${made} ${work}/unpacked)
  set(components ${components} PARENT_SCOPE)
endfunction()

# check_files(KIND COMPONENT HAS ONLY) sees that the unpacked package has files that match each of HAS,
# and no others than match ONLY.
function(check_files kind component has only)
  file(GLOB_RECURSE files RELATIVE ${work}/${kind}/${component} ${work}/${kind}/${component}/*)
  foreach(one ${has})
    if(NOT one IN_LIST files)
      message(FATAL_ERROR "the ${kind} of ${component} does not have ${one}")
    endif()
  endforeach()
  list(FILTER files EXCLUDE REGEX "^(${only}|share/doc/vndf-${component}/copyright)$")
  if(files)
    message(FATAL_ERROR "the ${kind} of ${component} has ${files}")
  endif()
endfunction()

# check_dependencies(COMPONENT DEPENDS) sees on what a Debian package depends.
function(check_dependencies component depends)
  file(STRINGS ${work}/DEB/${component}-control/control found REGEX "^Depends: ${depends}")
  if(NOT found)
    message(FATAL_ERROR "vndf-${component} does not depend on ${depends}")
  endif()
endfunction()

# check_packages() checks all packages of BUILD, in both kinds where dpkg-deb is there, and sets
# `installed` to the unpacked runtime.
function(check_packages)
  find_program(dpkg_deb dpkg-deb)
  find_program(dpkg_shlibdeps dpkg-shlibdeps)
  find_program(file_program file)
  set(kinds TGZ)
  if(dpkg_deb)
    list(APPEND kinds DEB)
  endif()
  set(cmake lib/cmake/vndf/vndf)
  foreach(kind ${kinds})
    make_packages(${BUILD} ${kind})
    check_files(${kind} runtime "lib/libvndf.a;include/vndf/kernel_tables.h;share/doc/vndf/FORMAT.md"
        "include/vndf/(|baking/|bsdf/|kernel_text/|reference/|support/)[a-z0-9_]+.h|lib/libvndf.a|\
${cmake}(Config|ConfigVersion|-runtime|-runtime-[a-z]+).cmake|lib/pkgconfig/vndf.pc|\
share/doc/vndf/(LICENSE|FORMAT.md)")
    check_files(${kind} dev "lib/libvndf_io.a;include/vndf/precompute/build_tables.h"
        "include/vndf/(batch|devices|distributions|io|precompute|validate)/[a-z0-9_/]+.h|\
lib/libvndf_[a-z]+.a|${cmake}-(batch|devices|distributions|io|precompute|support|validate)(|-[a-z]+).cmake")
    if("tools" IN_LIST components)
      check_files(${kind} tools "bin/vndf" "bin/vndf|share/man/man1/vndf(-[a-z]+)*.1.gz")
    endif()
  endforeach()
  if(dpkg_deb)
    check_dependencies(dev "vndf-runtime .= [0-9.]+., libboost-dev, libhdf5-dev, libhwy-dev")
  endif()
  if(dpkg_deb AND dpkg_shlibdeps AND file_program AND "tools" IN_LIST components)
    check_dependencies(tools ".*libhdf5-[0-9]+")
  endif()
  list(GET kinds -1 kind)
  set(installed ${work}/${kind}/runtime PARENT_SCOPE)
endfunction()
