# find_package(vndf): targets vndf::vndf, vndf::batch, vndf::io, vndf::precompute and
# vndf::validate. FindHDF5 needs C enabled.
enable_language(C)
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(HDF5 COMPONENTS C)
find_dependency(OpenEXR 3)
find_dependency(hwy 1)
include(${CMAKE_CURRENT_LIST_DIR}/vndfTargets.cmake)
