# A project with nothing of ours but exported headers: they compile without warnings with g++ and
# clang++, those that are here, and a million normals are those of the library, to the last bit. The header
# for CUDA is compiled where there is nvcc.
#   PROGRAM   vndf                      LIBRARY   million_normals.cpp, linked with the library
#   SOURCES   this folder               WORK      a folder for it
#   FLAGS     with which the library was compiled
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status WORKING_DIRECTORY ${WORK})
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "failed (${status}): ${ARGN}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${PROGRAM} build ggx --size 128 --tolerance 1e-4 -o ggx.vndf --quiet)
run(${PROGRAM} build exponential-power:p=0.5 --size 128 --tolerance 1e-3 -o rows.vndf --quiet)
foreach(tables ggx rows)
  run(${PROGRAM} export ${tables}.vndf --as header -o ${tables}.h)
  file(STRINGS ${WORK}/${tables}.h includes REGEX "^#include")
  foreach(include ${includes})
    if(NOT include MATCHES "^#include <[a-z_]+(\\.h)?>$")
      message(FATAL_ERROR "not of the standard library: ${include}")
    endif()
  endforeach()
endforeach()

run(${LIBRARY} library.bin ggx.vndf rows.vndf)
separate_arguments(flags UNIX_COMMAND "${FLAGS}")
find_program(GCC g++)
find_program(CLANG clang++)
foreach(compiler ${GCC} ${CLANG})
  if(NOT compiler)
    continue()
  endif()
  foreach(standard 17 20)
    run(${compiler} -std=c++${standard} ${flags} -Wall -Wextra -Werror -I ${WORK}
        ${SOURCES}/million_normals.cpp -o alone)
    run(${WORK}/alone alone.bin)
    run(${CMAKE_COMMAND} -E compare_files library.bin alone.bin)
  endforeach()
  message("${compiler}: the same million normals")
endforeach()

find_program(NVCC nvcc)
if(NVCC)
  # A block of threads has 48 KiB of shared memory.
  run(${PROGRAM} build ggx --size 128 --tolerance 1e-4 --above-only -o above.vndf --quiet)
  run(${PROGRAM} export above.vndf --as cuda --name ggx -o ggx.cuh)
  run(${NVCC} -O3 -Xptxas -v -I ${WORK} -c ${SOURCES}/cuda_header.cu -o cuda_header.o)
else()
  message("skipped for CUDA: there is no nvcc")
endif()
