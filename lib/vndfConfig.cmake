# find_package(vndf): targets vndf::vndf, vndf::io, vndf::precompute and
# vndf::validate. FindHDF5 needs C enabled.
enable_language(C)
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(HDF5 COMPONENTS C)
find_dependency(OpenEXR 3)
include(${CMAKE_CURRENT_LIST_DIR}/vndfTargets.cmake)
