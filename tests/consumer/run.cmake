# A renderer's project uses the library in one WAY, and its programs run:
#   find_package      a CMake project with an installed copy of BUILD
#   add_subdirectory  a CMake project with SOURCE inside
#   compiler          the COMPILER alone with an installed copy of BUILD, no CMake package
#   runtime           both, with the runtime alone, built where no other package can be found
#   packages          a CMake project with the runtime's package, which is looked into as are the others
# Installed copies are moved before they are used.
cmake_minimum_required(VERSION 3.25)
set(work ${BUILD}/consumer-${WAY})
set(installed ${work}/moved)
include(${CMAKE_CURRENT_LIST_DIR}/packages.cmake)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed (${status}): ${ARGN}")
  endif()
endfunction()

# install(TREE) installs a build tree, and sees that no package file knows a place of this machine.
function(install tree)
  run(${CMAKE_COMMAND} --install ${tree} --prefix ${work}/installed)
  file(RENAME ${work}/installed ${installed})
  file(GLOB_RECURSE packages ${installed}/*.cmake ${installed}/*.pc)
  foreach(package ${packages})
    file(STRINGS ${package} places REGEX "${SOURCE}|${BUILD}|${work}|\"/usr|;/usr")
    if(places)
      message(FATAL_ERROR "${package} cannot be moved: ${places}")
    endif()
  endforeach()
endfunction()

# build_consumer(OPTIONS...) configures the project and builds the programs that TARGETS names.
function(build_consumer targets)
  run(${CMAKE_COMMAND} -S ${SOURCE}/tests/consumer -B ${work}/build -G ${GENERATOR}
      -D VNDF_SOURCE=${SOURCE} -D CMAKE_BUILD_TYPE=${CONFIG} -D CMAKE_CXX_COMPILER=${COMPILER} ${ARGN})
  run(${CMAKE_COMMAND} --build ${work}/build --parallel --target ${targets})
  run(${work}/build/runtime_only)
endfunction()

# compile_headers() compiles all installed headers at once, so that none is missing. The text of the
# kernel is no header of its own: kernel.h includes it.
function(compile_headers)
  file(GLOB_RECURSE headers RELATIVE ${installed}/include ${installed}/include/*.h)
  list(FILTER headers EXCLUDE REGEX "kernel_text")
  list(TRANSFORM headers REPLACE "(.+)" "#include <\\1>")
  list(JOIN headers "\n" text)
  file(WRITE ${work}/all_headers.cpp "${text}\n")
  run(${COMPILER} -std=c++20 -fsyntax-only -I ${installed}/include ${work}/all_headers.cpp)
endfunction()

file(REMOVE_RECURSE ${work})
set(nothing)  # with which no other package is found
foreach(package Threads hwy HDF5 OpenEXR ZLIB PNG TIFF Boost muparser CLI11 fmt nlohmann_json
                benchmark Catch2 Doxygen embree)
  list(APPEND nothing -D CMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
if(WAY STREQUAL "runtime")
  run(${CMAKE_COMMAND} -S ${SOURCE} -B ${work}/runtime -G ${GENERATOR} -D VNDF_RUNTIME_ONLY=ON
      -D CMAKE_BUILD_TYPE=${CONFIG} -D CMAKE_CXX_COMPILER=${COMPILER} ${nothing})
  run(${CMAKE_COMMAND} --build ${work}/runtime --parallel)
  make_packages(${work}/runtime TGZ)
  if(NOT components STREQUAL "runtime")
    message(FATAL_ERROR "packages of the runtime alone: ${components}")
  endif()
  install(${work}/runtime)
  compile_headers()
  build_consumer("runtime_only;render" -D CONSUMER_WAY=find_package -D VNDF_COMPONENTS=runtime
                 -D CMAKE_PREFIX_PATH=${installed} ${nothing})
  return()
endif()

if(WAY STREQUAL "packages")
  check_packages()
  compile_headers()
  build_consumer("runtime_only;render" -D CONSUMER_WAY=find_package -D VNDF_COMPONENTS=runtime
                 -D CMAKE_PREFIX_PATH=${installed} ${nothing})
  return()
endif()

if(WAY STREQUAL "add_subdirectory")
  # own_distribution is configured with the builder's target, and would compile all of it again.
  build_consumer("runtime_only;render" -D CONSUMER_WAY=${WAY})
  return()
endif()
install(${BUILD})

if(WAY STREQUAL "compiler")
  file(GLOB_RECURSE library ${installed}/libvndf.a)
  run(${COMPILER} -std=c++20 -I ${installed}/include ${SOURCE}/tests/consumer/runtime_only.cpp
      ${library} -o ${work}/runtime_only)
  run(${work}/runtime_only)
  return()
endif()

if(WAY STREQUAL "find_package")
  build_consumer("runtime_only;render;own_distribution" -D CONSUMER_WAY=${WAY}
                 -D CMAKE_PREFIX_PATH=${installed})
  run(${installed}/bin/vndf --version)
endif()
run(${work}/build/own_distribution ${work}/student-t.vndf)
run(${work}/build/render ${work}/student-t.vndf)
