# A renderer's project uses the library in one WAY, and its programs run:
#   find_package      a CMake project with an installed copy of BUILD
#   add_subdirectory  a CMake project with SOURCE inside
#   compiler          the COMPILER alone with an installed copy of BUILD, no CMake package
set(work ${BUILD}/consumer-${WAY})
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed (${status}): ${ARGN}")
  endif()
endfunction()

file(REMOVE_RECURSE ${work})
if(NOT WAY STREQUAL "add_subdirectory")
  run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${work}/installed)
endif()

if(WAY STREQUAL "compiler")
  file(GLOB_RECURSE library ${work}/installed/libvndf.a)
  run(${COMPILER} -std=c++20 -I ${work}/installed/include ${SOURCE}/tests/consumer/runtime_only.cpp
      ${library} -o ${work}/runtime_only)
  run(${work}/runtime_only)
  return()
endif()

run(${CMAKE_COMMAND} -S ${SOURCE}/tests/consumer -B ${work}/build -G ${GENERATOR}
    -D CONSUMER_WAY=${WAY} -D VNDF_SOURCE=${SOURCE} -D CMAKE_BUILD_TYPE=${CONFIG}
    -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${work}/installed)
run(${CMAKE_COMMAND} --build ${work}/build --parallel
    --target runtime_only render own_distribution)
run(${work}/build/runtime_only)
run(${work}/build/own_distribution ${work}/student-t.vndf)
run(${work}/build/render ${work}/student-t.vndf)
if(WAY STREQUAL "find_package")
  run(${work}/installed/bin/vndf --version)
endif()
