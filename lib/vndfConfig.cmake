# find_package(vndf) gives every target that was installed. With COMPONENTS (runtime, support, batch,
# io, distributions, precompute, validate) it gives those and what they are built on, and looks for
# the dependencies of no others: COMPONENTS runtime needs nothing. The target of the runtime is
# vndf::vndf, those of the others are vndf::batch and so on.
include(CMakeFindDependencyMacro)

foreach(component ${vndf_FIND_COMPONENTS})
  if(vndf_FIND_REQUIRED_${component} AND NOT EXISTS ${CMAKE_CURRENT_LIST_DIR}/vndf-${component}.cmake)
    set(vndf_FOUND FALSE)
    set(vndf_NOT_FOUND_MESSAGE "this installation of vndf has no component '${component}'")
    return()
  endif()
endforeach()

# What each component is built on. A component comes before those that it needs.
set(vndf_components validate precompute distributions io batch support runtime)
set(vndf_validate_needs precompute)
set(vndf_precompute_needs distributions)
set(vndf_distributions_needs runtime support)
set(vndf_io_needs runtime support)
set(vndf_batch_needs runtime)

set(vndf_wanted ${vndf_FIND_COMPONENTS})
foreach(component ${vndf_components})
  set(file ${CMAKE_CURRENT_LIST_DIR}/vndf-${component}.cmake)
  if(NOT vndf_FIND_COMPONENTS AND EXISTS ${file})
    list(APPEND vndf_wanted ${component})
  endif()
  if(component IN_LIST vndf_wanted)
    list(APPEND vndf_wanted ${vndf_${component}_needs})
  endif()
endforeach()

if(support IN_LIST vndf_wanted)
  find_dependency(Threads)
endif()
if(batch IN_LIST vndf_wanted)
  find_dependency(hwy 1)
endif()
if(io IN_LIST vndf_wanted)
  enable_language(C)  # for FindHDF5
  find_dependency(HDF5 COMPONENTS C)
  find_dependency(OpenEXR 3)
  find_dependency(ZLIB)
  find_dependency(PNG)
  find_dependency(TIFF 4.5)
endif()
if(distributions IN_LIST vndf_wanted)
  find_dependency(muparser)
endif()

list(REVERSE vndf_components)
foreach(component ${vndf_components})
  set(file ${CMAKE_CURRENT_LIST_DIR}/vndf-${component}.cmake)
  if(component IN_LIST vndf_wanted AND EXISTS ${file})
    include(${file})
    set(vndf_${component}_FOUND TRUE)
  endif()
endforeach()
