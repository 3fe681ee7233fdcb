# find_package(vndf) gives the targets that lib/CMakeLists.txt lists, all but vndf::bench. FindHDF5
# needs the language C, which a C++ project may not have enabled.
enable_language(C)
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(HDF5 COMPONENTS C)
find_dependency(OpenEXR 3)
find_dependency(ZLIB)
find_dependency(PNG)
find_dependency(TIFF 4.5)
find_dependency(hwy 1)
include(${CMAKE_CURRENT_LIST_DIR}/vndfTargets.cmake)
